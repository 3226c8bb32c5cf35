/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Sampled gaps: what gap.c asks of them. Not installed. */
#ifndef FRET_CONTACT_TABLE_H
#define FRET_CONTACT_TABLE_H

#include <stdbool.h>

#include "contact/profile.h"

fret_real fret_table_start(const struct fret_table *table);
fret_real fret_table_end(const struct fret_table *table);
bool fret_table_pointed(const struct fret_table *table);             /* begins with a slope, like a cone */
size_t fret_table_rows(const struct fret_table *table, fret_real r); /* up to r */
bool fret_table_grows(const struct fret_table *table);               /* as fret_gap_grows */
fret_real fret_table_kink(const struct fret_table *table, fret_real e);
fret_real fret_table_f(const struct fret_table *table, fret_real r);
fret_real fret_table_bend(const struct fret_table *table, const fret_rule *rule, fret_real kink, fret_real e);
fret_profile fret_table_profile(const struct fret_table *table, const fret_rule *rule, fret_real e);

#endif
