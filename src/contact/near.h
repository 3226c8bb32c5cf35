/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A power law of which values are asked again and again: from the nearest of places where it is known, which
 * are looked up and kept. Not installed. */
#ifndef FRET_CONTACT_NEAR_H
#define FRET_CONTACT_NEAR_H

#include "contact/normal.h"

/* Positions and thicknesses are kept in two coordinates. A straight step in (delta_z, delta_x) moves
 * edge and slip front linearly in depth; a straight step in (F_N, F_x) moves them linearly in load,
 * by the same rule: delta_x/(mu eta) = int sigma dy + const and F_x/mu = int sigma dF_N. */
typedef enum coordinate { DEPTH, LOAD } coordinate;

/* v ~ y^s: load by depth or depth by load. (1+z)^s = 1 + s z + ... = sum of binomial[i] z^i; the first of
 * them to all bits. */
enum { FRET_NEAR_LEADING = 5, FRET_NEAR_TERMS = 24, FRET_NEAR_PLACES = 32 };
typedef struct fret_near_law {
    fret_real s, sm1; /* sm1 = s-1 without cancellation */
    fret_real leading[FRET_NEAR_LEADING];
    double binomial[FRET_NEAR_TERMS];
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

/* The other coordinate at y > 0, to 2^-63; NaN near the ends of the range. No digit depends on what was asked
 * before. */
fret_real fret_near_value(fret_near *near, coordinate by, fret_real y);

/* The same to 2^-67, as a sum of which the second part is a thirtieth. */
fret_real fret_near_parts(fret_near *near, coordinate by, fret_real y, fret_real *rest);

#endif
