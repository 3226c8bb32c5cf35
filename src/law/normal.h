/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The normal contact from inside, and its law as the tangential problem sees it. Not installed. */
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
    fret_real end;  /* largest contact radius that the gap supports [m]; infinite for a power */
    fret_stop stop; /* or NULL */
    atomic_size_t users;
    fret_cells *cells; /* NULL: a power law. Loads are theirs times `stiff` */
    fret_real stiff;   /* dF_N/d delta_z at a = 1 m */
    struct {
        dd p, q, s;                   /* to 100 bits */
        dd ln_r0, ln_depth, ln_force; /* logarithms of r0, and of depth and force at a = r0 [m], [N] */
    } wide;                           /* power law */
};

/* fret_normal_is_power where it is asked often. */
static inline bool fret_normal_closed(const fret_normal *n) {
    return n->p > 0;
}

/* Is there nothing beyond the flat end, so that a = b at any load? */
static inline bool fret_normal_punch(const fret_normal *n) {
    return fret_gap_start(&n->gap) >= n->end;
}

/* Shall long work end? Loops over rows, springs and slices ask; what they then return is of no use. */
static inline bool fret_stopped(const fret_normal *n) {
    return n->stop && *n->stop;
}

/* FRET_INTERRUPTED for work on a contact that was stopped, else the status. */
static inline fret_status fret_unless_stopped(const fret_normal *n, fret_status st) {
    return fret_stopped(n) ? (fret_status){FRET_INTERRUPTED, NULL, 0, 0} : st;
}

/* A contact of the same bodies with another gap; what stops `from` stops it too. Errors as of
 * fret_normal_make. */
fret_status fret_normal_reshape(const fret_normal *from, const fret_gap *gap, fret_normal **out);

/* mu and F_N must be positive: FRET_NOT_POSITIVE, FRET_NOT_FINITE. */
fret_status fret_contact_check(const fret_pressed *contact);

/* The law as the tangential problem sees it, for the depth y of an inner contact, 0 <= y. */
fret_real fret_law_radius(const fret_normal *normal, fret_real y); /* a(y) [m] */
fret_real fret_law_force(const fret_normal *normal, fret_real y);  /* F_N(y) [N] */
fret_real fret_law_depth(const fret_normal *normal, fret_real F);  /* F_N^-1(F) [m] */

/* How far a(y) is beyond the start of the gap [m]: near a flat end the radius would not tell. */
fret_real fret_law_distance(const fret_normal *normal, fret_real y);

/* All of them at once, from the depth y or from the load F. */
typedef struct fret_point {
    fret_real y, F, a, K; /* depth [m], F_N(y) [N], radius [m], dF_N/dy [N/m] (0 at y = 0) */
} fret_point;
fret_point fret_law_at_depth(const fret_normal *normal, fret_real y);
fret_point fret_law_at_force(const fret_normal *normal, fret_real F);
fret_point fret_law_at_radius(const fret_normal *normal, fret_real a); /* up to fret_normal_end */

/* A place in the contact: its depth y and F_N(y), both known where slices are cut. */
typedef struct fret_level {
    fret_real y, F;
} fret_level;

/* What a slice of the law carries, from a level inwards, with all digits of thin ones too; t is the distance
 * in depth from there: its thickness h [m], load w = int K dt [N], the fall of K = dF_N/dy [N/m], and G = int
 * t dK [N],   L = int t (h-t) dK [N m];   K: at the inner end. Others follow: int (h-t) dK = h fall - G, int
 * t^2 dK = h G - L, int t K dt = (h h K + h G - L)/2. Of the law that tells depth by load, with 1/K in the
 * place of K, they are G/K, (h fall - G)/(K + fall), and the same L: twice the area between the law and its
 * chord. */
typedef struct fret_slice {
    fret_real h, w, fall, G, L, K;
} fret_slice;

/* The place of a pressed contact by its radius; next to a flat end, where that tells too little, and of a
 * power law it stays to be looked for. */
fret_place fret_law_place(const fret_normal *normal, fret_real a);
/* The load of a depth, or the depth of a load. at: its place, looked for unless it is known. */
fret_real fret_law_other(const fret_normal *normal, bool by_load, fret_real value, fret_place *at);

/* Of a thickness, or load, `target`, beyond which `left` is left, with all digits where that is little. at:
 * its outer and inner end, looked for unless they are known; or NULL. */
fret_slice fret_law_slice_to(const fret_normal *normal, const fret_level *outer, bool by_load,
                             fret_real target, fret_real left, fret_place at[2]);
/* Its load, or thickness, alone. */
fret_real fret_law_fall(const fret_normal *normal, const fret_level *outer, bool by_load, fret_real target,
                        fret_real left, fret_place at[2]);
/* Of the thickness h, 0 <= h <= y. */
fret_slice fret_law_slice(const fret_normal *normal, const fret_level *outer, fret_real h);
/* int t K dt over it, t from the outer end [N m]. */
fret_real fret_slice_moment(const fret_slice *slice);

/* The load w of a slice from its thickness, and the thickness from its load. */
fret_real fret_law_load(const fret_normal *normal, const fret_level *outer, fret_real h);
fret_real fret_law_thickness(const fret_normal *normal, const fret_level *outer, fret_real w);

/* Radius [m] of a level: from its load, which tells it best. */
fret_real fret_law_level_radius(const fret_normal *normal, const fret_level *level);

#endif
