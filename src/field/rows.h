/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The cells of a sampled gap as fields want them. Not installed. */
#ifndef FRET_FIELD_ROWS_H
#define FRET_FIELD_ROWS_H

#include "law/cells.h"
#include "law/normal.h"

struct fret_rows;

/* Of the rows beyond the first one, up to the one at or beyond the distance e. NULL in `out` where there is
 * none. Error: FRET_NO_MEMORY. */
fret_status fret_rows_make_slopes(const fret_normal *normal, fret_real e, struct fret_rows **out);
void fret_rows_free(struct fret_rows *rows);

/* Part i of count: from one radius to another, y = 0..1 linear in the square of the radius x, which grows by
 * width, the depth is depth + y (P(y) + y^m Q(y)), m = (k+1)/2, and g' dx/dy is S(y) + y^m B(y). */
typedef struct fret_row_part {
    fret_real inner, outer, width, depth;
    const fret_real *P, *Q, *S, *B;
    int depths[2], slopes[2]; /* how many powers they have */
} fret_row_part;
size_t fret_rows_parts(const struct fret_rows *rows);
fret_row_part fret_rows_part(const struct fret_rows *rows, size_t i);

#endif
