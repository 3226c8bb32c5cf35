/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What rows are made of, for rows.c and rows_make.c alone. */
#ifndef FRET_CONTACT_ROW_PARTS_H
#define FRET_CONTACT_ROW_PARTS_H

#include "contact/piece.h"
#include "number/bits.h"

enum { ROW_BINOMIALS = 12 };

/* Polynomials of the integrals of a part. */
enum { SUM_K, SUM_G, SUM_L = SUM_G + 2, SUMS = SUM_L + 3 };

/* Within a row y = 0..1 is linear in the square of the radius x. Depth and load are smooth there but for the
 * kink where the row begins: they rise by y (P(y) + y^m Q(y)), m = (k+1)/2, with polynomials P and Q. A part
 * is a row, or as much of it as is no longer than it is far from the kink before: there 20 nodes do, and
 * fewer where rows bend little. Of what lies below y, G = y^2 (P + y^m Q) and L = y^3 (P + y^m Q + y^2m R),
 * and dF/dy rises by y P. */
typedef struct part {
    fret_real x, width, rate;  /* radius of its inner end; its length in x^2; dK/dy at the inner end */
    size_t term;               /* P and Q of the depth, then of the load, then those of `sum` */
    unsigned char count[2][2]; /* how many */
    unsigned char sum[SUMS];
} part;

struct fret_rows {
    fret_real start, m, C;
    size_t count, room, terms, most_terms;
    part *part;
    fret_real *term;
    fret_real *reach[3]; /* where each part begins, and the last one ends: distance, depth, load */
    stretch *run[RUNS];  /* as those of pieces */
    fret_real binomial[ROW_BINOMIALS]; /* of (1+z)^(m-1) */
};

/* The powers of y. */
FRET_INLINE fret_real sum_of(const fret_real *c, size_t count, fret_real y) {
    fret_real sum = 0;
    while (count-- > 0)
        sum = sum * y + c[count];
    return sum;
}

/* All of the part i, from its end inwards. */
stretch fret_rows_whole(const struct fret_rows *all, size_t i);

#endif
