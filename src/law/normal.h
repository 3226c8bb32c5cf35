/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The inside of the normal contact, and its law as the tangential problem uses it. Not installed. */
#ifndef FRET_LAW_NORMAL_H
#define FRET_LAW_NORMAL_H

#include <float.h>
#include <stdatomic.h>

#include "fret/normal.h"
#include "law/cells.h"
#include "law/material.h"

struct fret_normal {
    fret_foundation foundation;
    fret_wide_foundation wide_foundation;
    fret_gap gap;
    fret_rule rule;
    fret_real p;    /* power law: F_N ~ delta_z^p, p = (n+k+1)/n; 0 for other shapes */
    fret_real pm1;  /* p-1 = (k+1)/n without cancellation */
    fret_real q;    /* 1/p */
    fret_real s;    /* n+k+1: F_N ~ a^s */
    fret_real end;  /* largest contact radius [m]; infinite for a power */
    fret_stop stop; /* or NULL */
    atomic_size_t users;
    fret_cells *cells; /* NULL for a power law; loads are those of the cells times `stiff` */
    fret_real stiff;   /* dF_N/d delta_z at a = 1 m */
    struct {
        dd p, q, s;                   /* as above, to 100 bits */
        dd ln_r0, ln_depth, ln_force; /* logarithms of r0 [m], and of depth [m] and force [N] at a = r0 */
    } wide;                           /* power law */
};

/* fret_normal_is_power, inline. */
static inline bool fret_normal_closed(const fret_normal *n) {
    return n->p > 0;
}

/* True for a flat punch, where a = b at any load. */
static inline bool fret_normal_punch(const fret_normal *n) {
    return fret_gap_start(&n->gap) >= n->end;
}

/* True if the stop flag is set. Loops over rows, springs and slices then end, with useless results. */
static inline bool fret_stopped(const fret_normal *n) {
    return n->stop && *n->stop;
}

/* FRET_INTERRUPTED if the stop flag is set, else the status. */
static inline fret_status fret_unless_stopped(const fret_normal *n, fret_status st) {
    return fret_stopped(n) ? (fret_status){FRET_INTERRUPTED, NULL, 0, 0} : st;
}

/* Makes a contact of the same bodies with another gap; it keeps the stop flag of `from`. Errors as of
 * fret_normal_make. */
fret_status fret_normal_reshape(const fret_normal *from, const fret_gap *gap, fret_normal **out);

/* Checks that mu and F_N are positive: FRET_NOT_POSITIVE, FRET_NOT_FINITE. */
fret_status fret_contact_check(const fret_pressed *contact);

/* The law for the depth y of an inner contact; 0 for y, F <= 0, but a = b of a flat end. */
fret_real fret_law_radius(const fret_normal *normal, fret_real y); /* a(y) [m] */
fret_real fret_law_force(const fret_normal *normal, fret_real y);  /* F_N(y) [N] */
fret_real fret_law_depth(const fret_normal *normal, fret_real F);  /* F_N^-1(F) [m] */

/* a(y) less the radius of the flat end [m], with all digits next to that end. */
fret_real fret_law_distance(const fret_normal *normal, fret_real y);

/* A point of the law, from its depth, load or radius. */
typedef struct fret_point {
    fret_real y, F, a, K; /* depth [m], F_N(y) [N], radius [m], dF_N/dy [N/m] (0 at y = 0) */
} fret_point;
fret_point fret_law_at_depth(const fret_normal *normal, fret_real y);
fret_point fret_law_at_force(const fret_normal *normal, fret_real F);
fret_point fret_law_at_radius(const fret_normal *normal, fret_real a); /* up to fret_normal_end */

/* A level of the contact: a depth y and F_N(y), both known. */
typedef struct fret_level {
    fret_real y, F;
} fret_level;

/* Sums over a slice of the law inwards from a level, with all digits for thin slices too. t is the distance
 * in depth from the level: thickness h [m], load w = int K dt [N], the fall of K = dF_N/dy [N/m], G = int t
 * dK [N], L = int t (h-t) dK [N m], and K at the inner end. Others follow: int (h-t) dK = h fall - G, int t^2
 * dK = h G - L, int t K dt = (h h K + h G - L)/2. For the inverse law, depth as a function of load with 1/K
 * in the place of K, the first two are G/K and (h fall - G)/(K + fall), and L is the same: twice the area
 * between the law and its chord. */
typedef struct fret_slice {
    fret_real h, w, fall, G, L, K;
} fret_slice;

/* The place of the contact radius a, or zeros (to be found later) for a power law and next to a flat end,
 * where a radius does not tell it. */
fret_place fret_law_place(const fret_normal *normal, fret_real a);
/* The load of a depth, or the depth of a load. at: its place, found unless known. */
fret_real fret_law_other(const fret_normal *normal, bool by_load, fret_real value, fret_place *at);

/* The slice of thickness, or load, `target`, inside which the depth, or load, `left` remains; both with all
 * digits. at: the places of its outer and inner end, found unless known; or NULL. */
fret_slice fret_law_slice_to(const fret_normal *normal, const fret_level *outer, bool by_load,
                             fret_real target, fret_real left, fret_place at[2]);
/* The load of that slice if by thickness, its thickness if by load. */
fret_real fret_law_fall(const fret_normal *normal, const fret_level *outer, bool by_load, fret_real target,
                        fret_real left, fret_place at[2]);
/* The slice of thickness h, 0 <= h <= y. */
fret_slice fret_law_slice(const fret_normal *normal, const fret_level *outer, fret_real h);
/* int t K dt over a slice [N m]. */
fret_real fret_slice_moment(const fret_slice *slice);

/* The load w of a slice from its thickness, and the thickness from its load. */
fret_real fret_law_load(const fret_normal *normal, const fret_level *outer, fret_real h);
fret_real fret_law_thickness(const fret_normal *normal, const fret_level *outer, fret_real w);

/* The contact radius [m] of a level, from its load, which determines it best. */
fret_real fret_law_level_radius(const fret_normal *normal, const fret_level *level);

#endif
