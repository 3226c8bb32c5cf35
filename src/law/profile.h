/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The kernel of (3) near its singularity, which the profiles of all shapes share. Not installed. */
#ifndef FRET_LAW_PROFILE_H
#define FRET_LAW_PROFILE_H

#include "fret/gap.h"

/* What (3) needs of k: the coefficients of (2-u)^((k-1)/2), the smooth factor of the kernel, as a series in
 * the distance u from the edge, term n divided by (k+1)/2+4+n; and for powers kappa(n,k) of each term. */
enum { FRET_SERIES = 64 };
typedef struct fret_rule {
    fret_real k, series[FRET_SERIES], kappa[FRET_GAP_TERMS];
} fret_rule;

/* Computes the series for k; leaves kappa alone. */
void fret_rule_series(fret_rule *rule, fret_real k);

/* g and g'. */
typedef struct fret_profile {
    fret_real g, slope;
} fret_profile;

/* moment[j] = int_0^v u^j (u (2-u))^alpha du, j = 0..4, rim = (v (2-v))^(alpha+1), 0 <= v <= 1, alpha =
 * (k-1)/2: u = 1-r/a is the distance from the edge. */
enum { FRET_EDGE = 5 };
typedef struct fret_edge {
    fret_real moment[FRET_EDGE], rim;
} fret_edge;
fret_edge fret_edge_moments(const fret_rule *rule, fret_real v);

#endif
