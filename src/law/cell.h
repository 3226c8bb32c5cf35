/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One cell of the law: an interval of the radius in which depth, load and what is asked of slices are
 * polynomials, or sums of powers. Not installed. */
#ifndef FRET_LAW_CELL_H
#define FRET_LAW_CELL_H

#include <stdbool.h>

#include "number/chebyshev.h"

/* What a slice of the law carries, from its outer end inwards, t the distance in depth from that end: its
 * thickness h, int dK, G = int t dK and L = int t (h-t) dK, K = dF/dy. All are positive and add up without a
 * difference. The load is G + h K, K at the inner end. */
typedef struct fret_stretch {
    fret_real h, K, G, L;
} fret_stretch;

/* Outer part first. */
fret_stretch fret_stretch_join(const fret_stretch *outer, const fret_stretch *inner);
/* The outer part of a stretch, which loses digits where that is small. */
fret_stretch fret_stretch_less(const fret_stretch *whole, const fret_stretch *inner);

/* Depths and loads above the inner end of a cell. */
enum { BY_DEPTH, BY_LOAD };

/* The polynomials of a cell, in s = 0..1, linear in the square of the radius. With q the power of the kink
 * where it begins, and mu that of the stiffness: y - y0 = s P + s^q Q,   K - K0 = s^mu k, and of what lies
 * below s G = s^(mu+1) P + s^(mu+q) Q,   L = s^(mu+2) P + s^(mu+q+1) Q + s^(mu+2q) R. mu = 1 but at the
 * centre, where K ~ s^m, m = (k+1)/2; there q = 1/2 for odd powers of r. Elsewhere q = m + 1 where f'' jumps,
 * m where f' does: the transform (3) of the jump is v^q times a series in v = x^2-x0^2. For fields, not at
 * the centre: y dK/ds = A + s^q Q. */
enum { RISE, RISE_Q, STIFFNESS, PART_G, PART_GQ, PART_L, PART_LQ, PART_LQQ, AREA, AREA_Q, FRET_CELL_SERIES };
enum { FRET_CELL_TERMS = 20 };

/* A cell may be a sum of powers instead, y = sum of G_i s^n_i with s = x/x0 from 1 on, or from the centre on
 * where y is 0 at 0: powers G_i in of[0], exponents n_i in of[1]. */
typedef struct fret_cell {
    fret_real x, width; /* radius of its inner end; its length in x^2, of powers the last s, of a punch 0 */
    fret_real y, F, K;  /* at the inner end, for unit stiffness: K = x^2m */
    fret_real rise[2];  /* of depth and load over the cell */
    fret_real q, mu, m;
    fret_real begin, K_at_1; /* s of the inner end, 1 for powers that begin off the centre; K at s = 1 */
    double steep[2];         /* d ln(rise)/d ln s at its outer end */
    bool powers;
    unsigned char count[FRET_CELL_SERIES];
    fret_real of[FRET_CELL_SERIES][FRET_CELL_TERMS];
} fret_cell;

/* Depth or load above the inner end. */
fret_real fret_cell_rise(const fret_cell *cell, int by, fret_real s);
/* Its derivative by s. */
fret_real fret_cell_rate(const fret_cell *cell, int by, fret_real s);
/* K there. */
fret_real fret_cell_stiffness(const fret_cell *cell, fret_real s);
/* s where depth or load is `rise` above the inner end; 0 where it underflows. */
fret_real fret_cell_find(const fret_cell *cell, int by, fret_real rise);
/* How much less it is at s - back, with all digits where that is little. */
fret_real fret_cell_fall(const fret_cell *cell, int by, fret_real s, fret_real back);
/* back where depth or load has fallen by `drop` from s on; guess: of it, or 0. */
fret_real fret_cell_find_back(const fret_cell *cell, int by, fret_real s, fret_real drop, fret_real guess);
/* From s inwards to the inner end. */
fret_stretch fret_cell_below(const fret_cell *cell, fret_real s);
/* From s inwards to s - back. */
fret_stretch fret_cell_part(const fret_cell *cell, fret_real s, fret_real back);
/* The radius there, and s of a radius. */
fret_real fret_cell_radius(const fret_cell *cell, fret_real s);
fret_real fret_cell_place(const fret_cell *cell, fret_real x);

/* While it is made: of RISE, RISE_Q (and K at the inner end) the rest; by fits at the nodes of Chebyshev.
 * true: the polynomials have converged. */
bool fret_cell_complete(fret_cell *cell, const fret_chebyshev *nodes);
/* A polynomial through values at the nodes, as many terms as are not `little`; how large the last two are. */
int fret_cell_fit(const fret_chebyshev *nodes, const fret_real *value, fret_real little, fret_real *c,
                  fret_real *tail);

#endif
