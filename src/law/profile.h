/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the profiles of all shapes share: the kernel of (3) near its singularity. Not installed. */
#ifndef FRET_LAW_PROFILE_H
#define FRET_LAW_PROFILE_H

#include "fret/gap.h"

/* What (3) needs to know of k: (2-u)^((k-1)/2), the kernel's factor that is smooth at the edge, as a series
 * in the distance u from the edge; term n is divided by (k+1)/2+4+n. Powers need kappa(n,k) of each term. */
enum { FRET_SERIES = 64 };
typedef struct fret_rule {
    fret_real k, series[FRET_SERIES], kappa[FRET_GAP_TERMS];
} fret_rule;

/* The series of an exponent k; kappa is left alone. */
void fret_rule_series(fret_rule *rule, fret_real k);

/* g and g'. */
typedef struct fret_profile {
    fret_real g, slope;
} fret_profile;

/* int_0^v u^j (u (2-u))^alpha du, j = 0..4, and (v (2-v))^(alpha+1), 0 <= v <= 1: u = 1-r/a is the distance
 * from the edge. */
enum { FRET_EDGE = 5 };
typedef struct fret_edge {
    fret_real moment[FRET_EDGE], rim;
} fret_edge;
fret_edge fret_edge_moments(const fret_rule *rule, fret_real v);

#endif
