/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The transform (3) of a sampled gap: rows that are far away count by their moments. Not installed. */
#ifndef FRET_LAW_TRANSFORM_H
#define FRET_LAW_TRANSFORM_H

#include "law/table.h"

typedef struct fret_transform fret_transform;

/* Borrows the table and the rule. Errors: FRET_NO_MEMORY, FRET_INTERRUPTED. */
fret_status fret_transform_make(const struct fret_table *table, const fret_rule *rule, fret_stop stop,
                                fret_transform **out);
void fret_transform_free(fret_transform *transform);

/* g at the distance e beyond the row `from`, of a gap that goes on from the row `last` <= from as it does
 * just after that one. */
fret_real fret_transform_at(const fret_transform *transform, size_t last, size_t from, fret_real e);
/* What the jump of f'' at a row adds to g at the distance e beyond it. */
fret_real fret_transform_jump(const fret_transform *transform, size_t row, fret_real e);

#endif
