/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The law of a sampled gap row by row, for rows too many or too rough for polynomials. Not installed. */
#ifndef FRET_CONTACT_ROWS_H
#define FRET_CONTACT_ROWS_H

#include "contact/piece.h"

struct fret_rows;

/* From the row that holds the distance `from`, beyond the first one, to the first row at or beyond the
 * distance e. error: or NULL, the largest relative one of F_N(delta) that was found. NULL in `out` where
 * there is no such row. Errors: FRET_NO_MEMORY, FRET_INTERRUPTED. */
fret_status fret_rows_make(const fret_normal *normal, fret_real from, fret_real e, struct fret_rows **out,
                           fret_real *error);
void fret_rows_free(struct fret_rows *rows);

/* A place: so much of a part of a row, that to the power of its kink; how far depth and load are above the
 * beginning of the part, by DEPTHS and LOADS, NaN where that has not been asked for. */
typedef struct fret_spot {
    size_t part;
    fret_real along, power, rise[2];
} fret_spot;

/* Where the distance, the depth or the load is `value`; false: not among the rows. */
typedef enum fret_spot_by { SPOT_DISTANCE, SPOT_DEPTH, SPOT_LOAD } fret_spot_by;
bool fret_rows_find(const struct fret_rows *rows, fret_spot_by by, fret_real value, fret_spot *out);

/* Depth or load there, by DEPTHS or LOADS, and the distance. */
fret_real fret_rows_level(const struct fret_rows *rows, int by, const fret_spot *spot);
fret_real fret_rows_distance(const struct fret_rows *rows, const fret_spot *spot);

/* Where depth or load are less than at `outer` by `drop`, with all digits where that is little; false: not
 * among the rows. */
bool fret_rows_drop(const struct fret_rows *rows, fret_spot_by by, const fret_spot *outer, fret_real drop,
                    fret_spot *out);

/* DEPTHS or LOADS: how far the one is above the other, with the same digits. */
fret_real fret_rows_fall(const struct fret_rows *rows, int by, const fret_spot *outer,
                         const fret_spot *inner);

/* Both ends. */
fret_spot fret_rows_inner(void);
fret_spot fret_rows_outer(const struct fret_rows *rows);

/* dF_N/dy there. */
fret_real fret_rows_stiffness(const struct fret_rows *rows, const fret_spot *spot);

/* The same for fields: of parts with slopes in place of loads, to be asked for them alone. Part i of count:
 * from one radius to another, y = 0..1 linear in the square of the radius x, which grows by width, the depth
 * is depth + y (P(y) + y^m Q(y)), m = (k+1)/2, and g' dx/dy is S(y) + y^m B(y). */
typedef struct fret_row_part {
    fret_real inner, outer, width, depth;
    const fret_real *P, *Q, *S, *B;
    int depths[2], slopes[2]; /* how many powers they have */
} fret_row_part;
fret_status fret_rows_make_slopes(const fret_normal *normal, fret_real e, struct fret_rows **out);
size_t fret_rows_parts(const struct fret_rows *rows);
fret_row_part fret_rows_part(const struct fret_rows *rows, size_t i);

/* From one place inwards to another. */
stretch fret_rows_between(const struct fret_rows *rows, const fret_spot *outer, const fret_spot *inner);

#endif
