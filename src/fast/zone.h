/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A power law in double, and what a zone of slip dissipates under it. Not installed. */
#ifndef FRET_FAST_ZONE_H
#define FRET_FAST_ZONE_H

#include "number/bits.h"

/* libm's are calls. */
static inline double lesser(double a, double b) {
    return a < b ? a : b;
}

static inline double greater(double a, double b) {
    return a > b ? a : b;
}

/* v ~ y^s: load by depth or depth by load. Of a law with less bend than FRET_ZONE_STRAIGHT the bend is taken
 * by itself. */
#define FRET_ZONE_STRAIGHT 0.2
enum { FRET_ZONE_TERMS = 14, FRET_ZONE_HALVES = 8 };

typedef struct fret_double_law {
    double s, sm1, bend;          /* sm1 = s-1, bend = |s (s-1)| */
    int halves;                   /* 2s where powers go by square roots, else 0 */
    double y, per_y, v;           /* v of y, near the largest so far */
    double reach, per_reach;      /* the polynomial is good for 1-reach .. 1 */
    double near[FRET_ZONE_TERMS]; /* of (y/Y)^(s-2) in 1 - 2 (1-y/Y)/reach, over (j+1)(j+2) */
} fret_double_law;

/* sm1 = s-1 without cancellation. */
void fret_double_law_make(double s, double sm1, fret_double_law *out);

/* x^s, x > 0 */
double fret_double_law_power(const fret_double_law *law, double x);

/* v(y), y >= 0: 4e-16 (s+1) of the largest v. Hertz's root in a line: a call takes as long. */
FRET_INLINE double fret_double_law_value(const fret_double_law *law, double y) {
    const double x = y * law->per_y;
    if (!(x > 0))
        return 0;
    return law->v * (law->halves == 3 ? sqrt(x) * x : fret_double_law_power(law, x));
}

/* While the edge moves from edge[0] to edge[1] the front goes inwards from front[0] to front[1], both evenly;
 * the thickness of the zone and the way of the front are told by themselves, with their digits. */
typedef struct fret_zone {
    double edge[2], front[2], thick[2], travel;
    double edge_v[2], front_v[2]; /* their v, < 0 where not known */
} fret_zone;

/* |int [v(D) - v(d) - (D-d) v'(d)] dd|, D the edge, d the front, 0 <= d <= D <= Y; V = v(Y). */
double fret_zone_loss(const fret_double_law *law, const fret_zone *zone, double Y, double V);

/* The mean of v between two places of known v. */
double fret_double_law_mean(const fret_double_law *law, double y0, double v0, double y1, double v1);

#endif
