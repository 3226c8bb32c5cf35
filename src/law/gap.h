/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the mechanics needs of a gap beyond the public header: the one place that tells shapes apart is gap.c.
 * Not installed. */
#ifndef FRET_LAW_GAP_H
#define FRET_LAW_GAP_H

#include <stdbool.h>

#include "law/profile.h"
#include "number/dd.h"

/* A gap that has worn from the radius `inner` on, as rows in v = r^2 - inner^2: by how much g is more than at
 * `inner`, but for lift times v, with which it grows throughout; and how much deeper it has worn than there,
 * `tip`. Within it is the gap as it was. */
struct fret_worn {
    fret_gap of;
    fret_real inner, at_inner, lift, tip;
    struct fret_table *g, *h;
};
/* Of a worn gap, else NULL. */
const struct fret_worn *fret_gap_worn(const fret_gap *gap);

/* What fret_gap_profile needs to know of the exponent k. */
void fret_gap_rule(const fret_gap *gap, double k, fret_rule *rule);

/* ln kappa(n,k) = .log + ln .factor */
dd_scaled fret_kappa_parts(double n, double k);

/* At contact radius fret_gap_start + e, e > 0: near a flat end g ~ e^((k+1)/2), which a radius that has
 * swallowed e could not tell. Valid gaps only. */
fret_profile fret_gap_profile(const fret_gap *gap, const fret_rule *rule, fret_real e);

/* Radius below which f = 0 (the flat end), and the radius where the gap ends (INFINITY: nowhere). */
fret_real fret_gap_start(const fret_gap *gap);
fret_real fret_gap_end(const fret_gap *gap);

/* The power of r that a gap without a flat end begins with. */
fret_real fret_gap_tip(const fret_gap *gap);

/* Is there an edge at the flat end, where f' jumps and the pressure is infinite? */
bool fret_gap_sharp(const fret_gap *gap);

/* The powers of a gap that is a sum of such, and how many; 0 for other shapes. */
int fret_gap_powers(const fret_gap *gap, const fret_power **power);

/* The profile within a contact of radius a as powers, g(x) = sum of G (x/a)^n, each of the power G/kappa
 * (r/a)^n of the gap. How many; 0 where it is none, or of too many for that. */
enum { FRET_MOST_TERMS = 24 };
typedef struct fret_term {
    fret_real n, G, kappa;
} fret_term;
int fret_gap_series(const fret_gap *gap, const fret_rule *rule, fret_real a, fret_term term[FRET_MOST_TERMS]);

/* The same of a flat-ended gap from the radius x0 = 4 b or more on. */
int fret_gap_far(const fret_gap *gap, const fret_rule *rule, fret_real x0, fret_term term[FRET_MOST_TERMS]);

/* The gap that a table is, and that wear has left. */
fret_gap fret_gap_of_table(const struct fret_table *table);
fret_gap fret_gap_of_worn(const struct fret_worn *worn);

/* Are two gaps that have passed the same? */
bool fret_gap_same(const fret_gap *gap, const fret_gap *other);

/* The gap of this shape whose sizes are 1: its radii are `radii` times as large, its depths `depths` times.
 * Of powers and of tables the gap itself. */
fret_gap fret_gap_unit(const fret_gap *gap, fret_real *radii, fret_real *depths);

/* One power: the contact has closed forms. */
bool fret_gap_closed(const fret_gap *gap);

/* Sampled, smooth from row to row alone? */
bool fret_gap_sampled(const fret_gap *gap);

/* True only if g grows throughout; false is not yet a verdict. */
bool fret_gap_grows(const fret_gap *gap);

#endif
