/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Depth and load of a sampled gap at many places, a few rows at a time: for making what is kept of each row.
 * Not installed. */
#ifndef FRET_CONTACT_LEAVES_H
#define FRET_CONTACT_LEAVES_H

#include "contact/normal.h"

struct fret_leaves;

/* Of the rows first .. first+count-1, which begin beyond the start of the gap; e: where they end. slopes: g'
 * in place of each load. Errors: FRET_NO_MEMORY, FRET_INTERRUPTED. */
fret_status fret_leaves_make(const fret_normal *normal, size_t first, size_t count, fret_real e, bool slopes,
                             struct fret_leaves **out);
void fret_leaves_free(struct fret_leaves *leaves);

/* Depth and load at the distance e, in the row: what they would be if f' went on as before the row; and what
 * the kink at the row adds. */
fret_level fret_leaves_before(const struct fret_leaves *leaves, size_t row, fret_real e);
fret_level fret_leaves_bend(const struct fret_leaves *leaves, size_t row, fret_real e);

#endif
