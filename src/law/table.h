/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Sampled gaps, for gap.c, cells_make.c and transform.c. Not installed. */
#ifndef FRET_LAW_TABLE_H
#define FRET_LAW_TABLE_H

#include <stdbool.h>

#include "law/profile.h"

fret_real fret_table_start(const struct fret_table *table);
fret_real fret_table_end(const struct fret_table *table);
bool fret_table_pointed(const struct fret_table *table); /* f'(0) > 0, like a cone */
/* f as the sum of factors times r, r^2, r^3, valid up to r; false if there is none. */
bool fret_table_tip(const struct fret_table *table, fret_real r, fret_real factor[3]);
size_t fret_table_row_count(const struct fret_table *table, fret_real r); /* the number of rows up to r */
fret_real fret_table_f(const struct fret_table *table, fret_real r);
fret_profile fret_table_profile(const struct fret_table *table, const fret_rule *rule, fret_real e);

/* The distance of a row from the start; the last row at or before a distance e >= 0. */
fret_real fret_table_distance(const struct fret_table *table, size_t row);
size_t fret_table_row(const struct fret_table *table, fret_real e);
/* f' = c0 + c1 t + c2 t^2 at the distance t beyond a row, up to the next; and that less the continuation of
 * the row before. */
void fret_table_slope(const struct fret_table *table, size_t row, fret_real c[3]);
void fret_table_jump(const struct fret_table *table, size_t row, fret_real c[3]);
#endif
