/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The normal contact from inside, and its law as the tangential problem sees it. Not installed. */
#ifndef FRET_CONTACT_NORMAL_H
#define FRET_CONTACT_NORMAL_H

#include <float.h>

#include "contact/gap.h"
#include "contact/material.h"
#include "fret/normal.h"

/* Of fret_normal_prepare, see pieces.h. */
struct fret_pieces;
void fret_pieces_free(struct fret_pieces *pieces);
void fret_pieces_stop(struct fret_pieces *pieces, fret_stop stop); /* for what they make when asked */

struct fret_normal {
    fret_foundation foundation;
    fret_wide_foundation wide_foundation;
    fret_gap gap;
    fret_rule rule;
    fret_real p;                /* power law: F_N ~ delta_z^p, p = (n+k+1)/n; 0 for other shapes */
    fret_real pm1;              /* p-1 = (k+1)/n without cancellation */
    fret_real q;                /* 1/p */
    fret_real s;                /* n+k+1: F_N ~ a^s */
    fret_real end;              /* largest contact radius that the gap supports [m]; infinite for a power */
    bool falls;                 /* because g(x) begins to fall there */
    fret_stop stop;             /* or NULL */
    struct fret_pieces *pieces; /* or NULL: of fret_normal_prepare */
    double prepared;            /* the load up to which they were asked for [N]; 0: they were not */
    double borne;               /* and the error that they may have */
    bool shared;                /* they are those of another contact */
    bool thin;                  /* with all digits of thin slices: of a copy that asks at constant F_N */
    struct {
        dd p, q, s;                   /* to 100 bits */
        dd ln_r0, ln_depth, ln_force; /* logarithms of r0, and of depth and force at a = r0 [m], [N] */
    } wide;                           /* power law */
};

/* fret_normal_is_power where it is asked often. */
static inline bool fret_normal_closed(const fret_normal *n) {
    return n->p > 0;
}

/* Shall long work end? Loops over rows, springs and slices ask; what they then return is of no use. */
static inline bool fret_stopped(const fret_normal *n) {
    return n->stop && *n->stop;
}

/* FRET_INTERRUPTED for work on a contact that was stopped, else the status. */
static inline fret_status fret_unless_stopped(const fret_normal *n, fret_status st) {
    return fret_stopped(n) ? (fret_status){FRET_INTERRUPTED, NULL, 0, 0} : st;
}

/* mu and F_N must be positive: FRET_NOT_POSITIVE, FRET_NOT_FINITE. */
fret_status fret_contact_check(const fret_contact *contact);

/* Does a law that ends at `most` know `value`? A double's rounding beyond it counts as its end: what a
 * contact that reaches the end of its gap answers must be carried when it is given back. */
static inline bool fret_law_reaches(fret_real most, fret_real value) {
    return value <= most * (1 + 4 * DBL_EPSILON);
}

/* Can doubles hold what it is pressed to? */
bool fret_press_held(const fret_press *press);

/* F_N [N] of a contact whose profile is known. */
fret_real fret_force_of(const fret_normal *normal, const fret_profile *profile);

/* Distance from the start of the gap to the radius of the depth, or the load, `target`; infinity where the
 * gap ends before it is reached, 0 where it lies so close to a flat end that no digit shows it. By a search:
 * for gaps without a closed form. */
fret_real fret_search_radius(const fret_normal *normal, bool by_force, fret_real target);
/* The depth of the load `value`, or the load of that depth, which that search found at e. */
fret_real fret_law_other(const fret_normal *normal, bool by_force, fret_real value, fret_real e);

/* The law as the tangential problem sees it, for the depth y of an inner contact, 0 <= y. */
fret_real fret_law_radius(const fret_normal *normal, fret_real y); /* a(y) [m] */
fret_real fret_law_force(const fret_normal *normal, fret_real y);  /* F_N(y) [N] */
fret_real fret_law_depth(const fret_normal *normal, fret_real F);  /* F_N^-1(F) [m] */

/* All of them at once, from the depth y or from the load F: one search where there is no closed form. */
typedef struct fret_point {
    fret_real y, F, a, K; /* depth [m], F_N(y) [N], radius [m], dF_N/dy [N/m] (0 at y = 0) */
} fret_point;
/* The same where pieces know it; else false. Depth g at the distance e from the start of the gap. */
bool fret_law_prepared(const fret_normal *normal, bool by_force, fret_real value, fret_point *out);
bool fret_law_prepared_depth(const fret_normal *normal, fret_real e, fret_real *depth);
/* Depth by load, or load by depth, where they know it but no radius that would do. */
bool fret_law_unplaced(const fret_normal *normal, bool by_force, fret_real value, fret_real *other);
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

/* The slice of a thickness, or load, `target`, beyond which `left` is left, with all digits where that is
 * little. */
fret_slice fret_law_slice_to(const fret_normal *normal, const fret_level *outer, bool by_load,
                             fret_real target, fret_real left);

/* The load w of a slice from its thickness, and the thickness from its load. */
fret_real fret_law_load(const fret_normal *normal, const fret_level *outer, fret_real h);
fret_real fret_law_thickness(const fret_normal *normal, const fret_level *outer, fret_real w);

/* The same for all but an inner part that is known by itself, which may be far smaller than the whole. */
fret_real fret_law_load_outside(const fret_normal *normal, const fret_level *outer, fret_real inner_depth);
fret_real fret_law_thickness_outside(const fret_normal *normal, const fret_level *outer,
                                     fret_real inner_load);

/* Radius [m] of a level: from its load, which tells it best. */
fret_real fret_law_level_radius(const fret_normal *normal, const fret_level *level);

/* ln a(y) of a power law. */
dd fret_law_log_radius(const fret_normal *normal, fret_real y);

/* int dK = K(y)-K(y-h) [N/m] over the slice. */
fret_real fret_law_stiffness_drop(const fret_normal *normal, const fret_level *outer, fret_real h);

#endif
