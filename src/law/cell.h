/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One cell of the law: an interval of the radius in which depth, load and the sums over slices are
 * polynomials, or sums of powers. Not installed. */
#ifndef FRET_LAW_CELL_H
#define FRET_LAW_CELL_H

#include <stdbool.h>

#include "number/chebyshev.h"

/* Sums over a slice of the law, t the distance in depth from its outer end: thickness h, K: int dK, G = int t
 * dK and L = int t (h-t) dK, with K = dF/dy. All are positive and add up without differences. The load over
 * the slice is G + h K, K at its inner end. */
typedef struct fret_stretch {
    fret_real h, K, G, L;
} fret_stretch;

/* The sums over two adjacent slices together. */
fret_stretch fret_stretch_join(const fret_stretch *outer, const fret_stretch *inner);
/* The sums over the outer part: the whole less the inner part. Loses digits if the outer part is small. */
fret_stretch fret_stretch_less(const fret_stretch *whole, const fret_stretch *inner);

/* Selects depth or load, each counted from the inner end of a cell. */
enum { BY_DEPTH, BY_LOAD };

/* Coefficients of the polynomials of a cell, in s = 0..1, linear in the square of the radius. With P, Q, R
 * for the series in the order of the names, q the exponent of a kink at the inner end, mu that of K:
 *   y - y0 = s P + s^q Q (RISE),   K - K0 = s^mu P (STIFFNESS),   and for the slice from s to the inner end
 *   G = s^(mu+1) P + s^(mu+q) Q,   L = s^(mu+2) P + s^(mu+q+1) Q + s^(mu+2q) R.
 * mu = 1 except at the centre, where K ~ s^m, m = (k+1)/2, and q = 1/2 for odd powers of r. Elsewhere q = m +
 * 1 where f'' jumps, m where f' jumps: the transform (3) of a jump is v^q times a series in v = x^2-x0^2.
 * AREA, for fields, not at the centre: y dK/ds = P + s^q Q. */
enum { RISE, RISE_Q, STIFFNESS, PART_G, PART_GQ, PART_L, PART_LQ, PART_LQQ, AREA, AREA_Q, FRET_CELL_SERIES };
enum { FRET_CELL_TERMS = 20 };

/* A cell may instead hold a sum of powers, y = sum of G_i s^n_i, s = x/x0, from s = 1 on, or from the centre
 * on if all n_i > 0, with the G_i in of[RISE] and the n_i in of[RISE_Q]. */
typedef struct fret_cell {
    fret_real x, width; /* radius of the inner end, or x0; extent in x^2 (powers: largest s; punch: 0) */
    fret_real y, F, K;  /* at the inner end, for unit stiffness: K = x^(2m) */
    fret_real rise[2];  /* increase of depth and load over the cell */
    fret_real q, mu, m;
    fret_real begin, K_at_1; /* s of the inner end, 1 for powers off the centre; K at s = 1 */
    double steep[2];         /* d ln(rise)/d ln s at the outer end */
    bool powers;
    unsigned char count[FRET_CELL_SERIES];
    fret_real of[FRET_CELL_SERIES][FRET_CELL_TERMS];
} fret_cell;

/* Depth or load above the inner end, at s. */
fret_real fret_cell_rise(const fret_cell *cell, int by, fret_real s);
/* The derivative of that with respect to s. */
fret_real fret_cell_rate(const fret_cell *cell, int by, fret_real s);
/* K at s. */
fret_real fret_cell_stiffness(const fret_cell *cell, fret_real s);
/* The s where depth or load is `rise` above the inner end; 0 if it underflows. */
fret_real fret_cell_find(const fret_cell *cell, int by, fret_real rise);
/* The fall of depth or load from s to s - back, to all digits also for small `back`. */
fret_real fret_cell_fall(const fret_cell *cell, int by, fret_real s, fret_real back);
/* The `back` over which depth or load falls by `drop` from s; guess: a start value, or 0. */
fret_real fret_cell_find_back(const fret_cell *cell, int by, fret_real s, fret_real drop, fret_real guess);
/* Sums over the slice from s to the inner end, and from s to s - back. */
fret_stretch fret_cell_below(const fret_cell *cell, fret_real s);
fret_stretch fret_cell_part(const fret_cell *cell, fret_real s, fret_real back);
/* The radius at s, and the s of a radius. */
fret_real fret_cell_radius(const fret_cell *cell, fret_real s);
fret_real fret_cell_place(const fret_cell *cell, fret_real x);

/* Completes a cell that has RISE, RISE_Q (and y, F, K at the inner end), by fits at the Chebyshev nodes.
 * True: the polynomials have converged. */
bool fret_cell_complete(fret_cell *cell, const fret_chebyshev *nodes);
/* Coefficients c of the polynomial through the values at the nodes, without trailing Chebyshev terms up to
 * `little`. Returns their number; tail: the size of the last two Chebyshev terms. */
int fret_cell_fit(const fret_chebyshev *nodes, const fret_real *value, fret_real little, fret_real *c,
                  fret_real *tail);

#endif
