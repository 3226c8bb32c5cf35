/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The gap as the other files of law, and the rooms above, see it. Not installed. */
#ifndef FRET_LAW_GAP_H
#define FRET_LAW_GAP_H

#include <stdbool.h>

#include "law/profile.h"
#include "number/dd.h"

/* A gap worn outside the radius `inner`, as tables over v = r^2 - inner^2: g is at_inner + lift v + the table
 * g, the depth worn is tip + the table h, f counts from the worn tip. Within `inner` it is `of`. */
struct fret_worn {
    fret_gap of;
    fret_real inner, at_inner, lift, tip;
    struct fret_table *g, *h;
};
/* The wear of a worn gap, else NULL. */
const struct fret_worn *fret_gap_worn(const fret_gap *gap);

/* Computes what fret_gap_profile needs of the exponent k. */
void fret_gap_rule(const fret_gap *gap, double k, fret_rule *rule);

/* ln kappa(n,k) = .log + ln .factor */
dd_scaled fret_kappa_parts(double n, double k);

/* g and g' at the contact radius fret_gap_start + e, e > 0, of a gap that has been checked: near a flat end g
 * ~ e^((k+1)/2), and the sum of start and e would lose digits of e. */
fret_profile fret_gap_profile(const fret_gap *gap, const fret_rule *rule, fret_real e);

/* The radius below which f = 0 (the flat end), and the radius where the gap ends, or INFINITY. */
fret_real fret_gap_start(const fret_gap *gap);
fret_real fret_gap_end(const fret_gap *gap);

/* The leading power of r at the tip of a gap without a flat end. */
fret_real fret_gap_tip(const fret_gap *gap);

/* True if the flat end has an edge, where f' jumps and the pressure may be infinite. */
bool fret_gap_sharp(const fret_gap *gap);

/* The number of powers of a gap that is a sum of powers; 0 for other shapes. */
int fret_gap_powers(const fret_gap *gap);

/* The profile within a contact of radius a as powers, g(x) = sum of G (x/a)^n, each the transform of the
 * power G/kappa (r/a)^n of the gap. Returns their number; 0 if there is no series, or too long a one. */
enum { FRET_MOST_TERMS = 24 };
typedef struct fret_term {
    fret_real n, G, kappa;
} fret_term;
int fret_gap_series(const fret_gap *gap, const fret_rule *rule, fret_real a, fret_term term[FRET_MOST_TERMS]);

/* The same for a flat-ended gap beyond the radius x0 >= 4 b; kappa is 0. */
int fret_gap_far(const fret_gap *gap, const fret_rule *rule, fret_real x0, fret_term term[FRET_MOST_TERMS]);

/* The gap that wear has left; it borrows worn. */
fret_gap fret_gap_of_worn(const struct fret_worn *worn);

/* True if two gaps that have been checked are the same. */
bool fret_gap_same(const fret_gap *gap, const fret_gap *other);

/* The gap of the same shape with its sizes set to 1; the radii of `gap` are `radii` times as large, its
 * depths `depths` times. Powers and tables have no sizes: the gap itself. */
fret_gap fret_gap_unit(const fret_gap *gap, fret_real *radii, fret_real *depths);

/* True for a single power, for which the contact has closed forms. */
bool fret_gap_closed(const fret_gap *gap);

/* True for a sampled or worn gap, which is smooth between its rows alone. */
bool fret_gap_sampled(const fret_gap *gap);

#endif
