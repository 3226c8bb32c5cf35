/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A power law of which values are asked again and again: from the nearest of places where it is known, which
 * are looked up and kept. Not installed. */
#ifndef FRET_CONTACT_NEAR_H
#define FRET_CONTACT_NEAR_H

#include "contact/normal.h"
#include "number/bits.h"

/* Positions and thicknesses are kept in two coordinates. A straight step in (delta_z, delta_x) moves
 * edge and slip front linearly in depth; a straight step in (F_N, F_x) moves them linearly in load,
 * by the same rule: delta_x/(mu eta) = int sigma dy + const and F_x/mu = int sigma dF_N. */
typedef enum coordinate { DEPTH, LOAD } coordinate;

/* v ~ y^s: load by depth or depth by load. (1+z)^s = 1 + s z + ... = sum of binomial[i] z^i; the first of
 * them to all bits. */
enum { FRET_NEAR_LEADING = 5, FRET_NEAR_TERMS = 24, FRET_NEAR_WAY = 8, FRET_NEAR_PLACES = 32 };
typedef struct fret_near_law {
    fret_real s, sm1; /* sm1 = s-1 without cancellation */
    fret_real leading[FRET_NEAR_LEADING];
    double binomial[FRET_NEAR_TERMS], rest[FRET_NEAR_TERMS]; /* rest: of the leading what double leaves out */
    /* Of a way from C(1-w) to C(1+w), x = w^2 up to most_square: the mean of the law is that of both ends
     * less x (first_sag + x (sag[0] + ...)) of it, half their difference w (s + x (first_lean + x (lean[0] +
     * ...))) of it. */
    fret_real first_sag, first_lean;
    double sag[FRET_NEAR_WAY], lean[FRET_NEAR_WAY], most_square;
    struct {
        double at, rest;  /* 0: none yet; rest: what v leaves out */
        fret_real v, per; /* v: NaN near the ends of the range; 1/at */
    } place[FRET_NEAR_PLACES];
} fret_near_law;

typedef struct fret_near {
    const fret_normal *normal; /* borrowed */
    dd made_of[3];             /* what tells its law from others */
    fret_near_law law[2];      /* of the coordinate into the other */
} fret_near;

/* libm's are calls; of a NaN the second. */
static inline fret_real fret_greater(fret_real a, fret_real b) {
    return a > b ? a : b;
}

static inline fret_real fret_lesser(fret_real a, fret_real b) {
    return a < b ? a : b;
}

/* Is the law one of those that this does for: a power that is not steep? */
bool fret_near_fits(const fret_normal *normal);
void fret_near_make(const fret_normal *normal, fret_near *out);

/* Lends it another contact; keeps the places where the law is the same. */
void fret_near_move(fret_near *near, const fret_normal *normal);

/* Place i becomes y. */
void fret_near_keep(fret_near *near, coordinate by, size_t i, double y);

/* The other coordinate at y > 0 to 2^-67, as a sum of which the second part is a thirtieth; NaN near the ends
 * of the range. No digit depends on what was asked before. Sixteen places in each octave: y = C (1+x),
 * |x| <= 1/32. In a line: a call would pass long doubles through memory. */
FRET_INLINE fret_real fret_near_parts(fret_near *near, coordinate by, fret_real y, fret_real *rest) {
    fret_near_law *law = &near->law[by];
    const double size = (double)y;
    const uint64_t half = UINT64_C(1) << 47, cell = fret_bits(size) >> 48;
    const double C = fret_from_bits(cell << 48 | half);
    const size_t i = cell % FRET_NEAR_PLACES;
    if (!(size > 1e-290 && size < 1e290))
        return *rest = (fret_real)NAN;
    if (law->place[i].at != C)
        fret_near_keep(near, by, i, C);
    const double *b = law->binomial;
    const fret_real x = (y - C) * law->place[i].per, V = law->place[i].v;
    const double z = (double)x, z2 = z * z, z4 = z2 * z2;
    const double tail = ((b[3] + z * b[4]) + z2 * (b[5] + z * b[6])) +
                        z4 * ((b[7] + z * b[8]) + z2 * (b[9] + z * b[10]) + z4 * (b[11] + z * b[12]));
    const fret_real Vx = V * x;
    *rest = Vx * law->leading[1] + (law->place[i].rest + (Vx * x) * (law->leading[2] + x * tail));
    return V;
}

/* The same to 2^-63. */
FRET_INLINE fret_real fret_near_value(fret_near *near, coordinate by, fret_real y) {
    fret_real rest;
    const fret_real most = fret_near_parts(near, by, y, &rest);
    return most + rest;
}

#endif
