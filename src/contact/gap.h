/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What normal.c and field.c need of a gap beyond the public header. Not installed. */
#ifndef FRET_GAP_PRIVATE_H
#define FRET_GAP_PRIVATE_H

#include "dd.h"
#include "fret/gap.h"
#include "special.h"

/* Profile and its moments at contact radius a: g, g', and I = int_0^a x^k (g(a)-g(x)) dx. */
typedef struct fret_profile {
    fret_real g, slope, I;
} fret_profile;

/* ln kappa(n,k) = .log + ln .factor */
dd_scaled fret_kappa_parts(double n, double k);

/* What fret_gap_profile needs to know of the exponent k. */
void fret_gap_rule(const fret_gap *gap, double k, fret_rule *rule);

/* At contact radius fret_gap_start + e, e > 0: near a flat end g ~ e^((k+1)/2), which a radius that has
 * swallowed e could not tell. Valid gaps only. */
fret_profile fret_gap_profile(const fret_gap *gap, const fret_rule *rule, fret_real e);

/* True only if g grows throughout; false is not yet a verdict. */
bool fret_table_grows(const struct fret_table *table);

/* Distance from the start of the last place below e > 0 where the profile is not smooth: the start itself or
 * a row of a table. */
fret_real fret_gap_kink(const fret_gap *gap, fret_real e);

/* The power of r that a gap without a flat end begins with. */
fret_real fret_gap_tip(const fret_gap *gap);

/* Radius below which f = 0 (the flat end), and the radius where the gap ends (INFINITY: nowhere). */
fret_real fret_gap_start(const fret_gap *gap);
fret_real fret_gap_end(const fret_gap *gap);

#endif
