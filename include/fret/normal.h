/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef FRET_NORMAL_H
#define FRET_NORMAL_H

#include "fret/gap.h"
#include "fret/material.h"

/* The frictionless normal contact: F_N, indentation depth delta_z and contact radius a, each from
 * each. As a function of depth, F_N(delta) is all that the tangential problem needs to know of
 * shape and grading. */
typedef struct fret_normal {
    fret_foundation foundation;
    fret_gap gap;
    fret_rule rule;
    fret_real p;   /* power law: F_N ~ delta_z^p, p = (n+k+1)/n; 0 for other shapes */
    fret_real pm1; /* p-1 = (k+1)/n without cancellation */
    fret_real q;   /* 1/p */
    fret_real s;   /* n+k+1: F_N ~ a^s */
    fret_real end; /* largest contact radius that the gap supports [m]; infinite for a power */
    bool falls;    /* because g(x) begins to fall there */
    struct {
        fret_pair p, q, s;                   /* to 100 bits */
        fret_pair ln_r0, ln_depth, ln_force; /* logarithms of r0, and of depth and force at a = r0 [m], [N] */
    } wide;                                  /* power law */
} fret_normal;

/* One state of the normal contact, each member from the same load. */
typedef struct fret_press {
    fret_real F;            /* F_N [N] */
    fret_real dz;           /* delta_z [m] */
    fret_real a;            /* [m] */
    double F_rest, dz_rest; /* what does not fit in F and dz: near gross slip it shows */
} fret_press;

/* Errors: those of fret_foundation_make and fret_gap_check; FRET_NOT_MONOTONE. */
fret_status fret_normal_make(const fret_material *material, const fret_gap *gap, fret_normal *out);

/* delta_z = g(a), F_N = 2 int_0^a c_N(x) [g(a)-g(x)] dx (10)-(13); power law:
 *   F_N = 2 cN0 c0^-k kappa A n a^(n+k+1)/((k+1)(n+k+1)).
 * Arguments >= 0. Errors: FRET_NEGATIVE, FRET_NOT_FINITE, FRET_OVERFLOW, FRET_TABLE_SHORT.
 * Accuracy: 1e-19 relative for power laws with n 1e-6..1e6, 1e-17 for other shapes, 2e-16 for tables. */
fret_status fret_press_force(const fret_normal *normal, double F, fret_press *out);
fret_status fret_press_depth(const fret_normal *normal, double dz, fret_press *out);
fret_status fret_press_radius(const fret_normal *normal, double a, fret_press *out);

/* Normal stiffness k_n = dF_N/d delta_z = 2 cN0 c0^-k a^(k+1)/(k+1) [N/m], a > 0 [m]. */
fret_real fret_normal_stiffness(const fret_normal *normal, fret_real a);

/* The law as the tangential problem sees it, for the depth y of an inner contact, 0 <= y. */
fret_real fret_law_radius(const fret_normal *normal, fret_real y); /* a(y) [m] */
fret_real fret_law_force(const fret_normal *normal, fret_real y);  /* F_N(y) [N] */
fret_real fret_law_depth(const fret_normal *normal, fret_real F);  /* F_N^-1(F) [m] */

/* All of them at once, from the depth y or from the load F: one search where there is no closed form. */
typedef struct fret_point {
    fret_real y, F, a, K; /* depth [m], F_N(y) [N], radius [m], dF_N/dy [N/m] (0 at y = 0) */
} fret_point;
fret_point fret_law_at_depth(const fret_normal *normal, fret_real y);
fret_point fret_law_at_force(const fret_normal *normal, fret_real F);

/* A place in the contact: its depth y and F_N(y), both known where slices are cut. */
typedef struct fret_level {
    fret_real y, F;
} fret_level;

/* Integrals over the slice of depths [y-h, y], 0 <= h <= y, exact also for thin slices (shapes other than the
 * power law: 1e-14 relative; where a row of a table lies within a slice thinner than 1e-5 y, 1e-18 y/h);
 * K = dF_N/dy, t the distance from y:
 *   w = int K dt = F_N(y)-F_N(y-h) [N], J = int t K dt [N m],
 *   G = int t dK = w - h K(y-h) [N],    L = int_0^h G dt [N m]. */
typedef struct fret_slice {
    fret_real w, J, G, L;
} fret_slice;
fret_slice fret_law_slice(const fret_normal *normal, const fret_level *outer, fret_real h);

/* The load w of a slice from its thickness, and the thickness from its load. */
fret_real fret_law_load(const fret_normal *normal, const fret_level *outer, fret_real h);
fret_real fret_law_thickness(const fret_normal *normal, const fret_level *outer, fret_real w);

/* The same for all but an inner part that is known by itself, which may be far smaller than the whole. */
fret_real fret_law_load_outside(const fret_normal *normal, const fret_level *outer, fret_real inner_depth);
fret_real fret_law_thickness_outside(const fret_normal *normal, const fret_level *outer,
                                     fret_real inner_load);

/* Radius [m] of a level: from its load, which tells it best. */
fret_real fret_law_level_radius(const fret_normal *normal, const fret_level *level);

#endif
