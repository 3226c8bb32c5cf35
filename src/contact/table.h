/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Sampled gaps, and what their profile shares with the other shapes. Not installed. */
#ifndef FRET_CONTACT_TABLE_H
#define FRET_CONTACT_TABLE_H

#include "contact/gap.h"

/* int_0^v u^j (u (2-u))^alpha du, j = 0..4, and (v (2-v))^(alpha+1), 0 <= v <= 1: u = 1-r/a is the distance
 * from the edge. */
enum { FRET_EDGE = 5 };
typedef struct fret_edge {
    fret_real moment[FRET_EDGE], rim;
} fret_edge;
fret_edge fret_edge_moments(const fret_rule *rule, fret_real v);

fret_real fret_table_start(const struct fret_table *table);
fret_real fret_table_end(const struct fret_table *table);
bool fret_table_pointed(const struct fret_table *table); /* begins with a slope, like a cone */
bool fret_table_grows(const struct fret_table *table);   /* as fret_gap_grows */
fret_real fret_table_kink(const struct fret_table *table, fret_real e);
fret_real fret_table_f(const struct fret_table *table, fret_real r);
fret_profile fret_table_profile(const struct fret_table *table, const fret_rule *rule, fret_real e);

#endif
