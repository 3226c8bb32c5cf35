/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The transform (3) of a sampled gap, with distant rows summed by moments. Not installed. */
#ifndef FRET_LAW_TRANSFORM_H
#define FRET_LAW_TRANSFORM_H

#include "law/table.h"

typedef struct fret_transform fret_transform;

/* Makes the moments. Borrows the table and the rule. Errors: FRET_NO_MEMORY, FRET_INTERRUPTED. */
fret_status fret_transform_make(const struct fret_table *table, const fret_rule *rule, fret_stop stop,
                                fret_transform **out);
void fret_transform_free(fret_transform *transform);

/* g at the distance e beyond the row `from`, if the gap goes on from the row `last` <= from by its cubic. */
fret_real fret_transform_at(const fret_transform *transform, size_t last, size_t from, fret_real e);
/* The part of g, at the distance e beyond a row, that the jump of f'' at that row adds. */
fret_real fret_transform_jump(const fret_transform *transform, size_t row, fret_real e);

#endif
