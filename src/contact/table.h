/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Sampled gaps: what gap.c asks of them. Not installed. */
#ifndef FRET_CONTACT_TABLE_H
#define FRET_CONTACT_TABLE_H

#include <stdbool.h>

#include "contact/profile.h"

fret_real fret_table_start(const struct fret_table *table);
fret_real fret_table_end(const struct fret_table *table);
bool fret_table_pointed(const struct fret_table *table); /* begins with a slope, like a cone */
/* f as a sum of factors by r, r^2, r^3 up to r; false: it is none. */
bool fret_table_tip(const struct fret_table *table, fret_real r, fret_real factor[3]);
size_t fret_table_rows(const struct fret_table *table, fret_real r); /* up to r */
bool fret_table_grows(const struct fret_table *table);               /* as fret_gap_grows */
fret_real fret_table_kink(const struct fret_table *table, fret_real e);
fret_real fret_table_f(const struct fret_table *table, fret_real r);
fret_real fret_table_bend(const struct fret_table *table, const fret_rule *rule, fret_real kink, fret_real e);
fret_profile fret_table_profile(const struct fret_table *table, const fret_rule *rule, fret_real e);

/* The distance of a row from the start; the last row at or below a distance e > 0. */
fret_real fret_table_distance(const struct fret_table *table, size_t row);
size_t fret_table_row(const struct fret_table *table, fret_real e);
/* f' from the row to the next one, c0 + c1 t + c2 t^2 at the distance t beyond it; and how that differs from
 * what the row before goes on with. */
void fret_table_slope(const struct fret_table *table, size_t row, fret_real c[3]);
void fret_table_jump(const struct fret_table *table, size_t row, fret_real c[3]);
/* out[i] = int f' ((a^2-r^2)/(a unit))^((k-1)/2+i) dr, i = 0, 1, and [2] that of f' + r f'' with i = 0,
 * between the rows first and last, neither beyond the radius a = start + e. */
void fret_table_part(const struct fret_table *table, const fret_rule *rule, size_t first, size_t last,
                     fret_real e, fret_real unit, fret_real out[3]);
/* Adds the same of the quadratic of one row, which goes on, from so far before e to so near before it. */
void fret_table_within(const struct fret_table *table, const fret_rule *rule, size_t row, fret_real far,
                       fret_real near, fret_real e, fret_real unit, fret_real out[3]);

/* Stretch i, which is followed by its two halves unless next = i + 1: the pieces first .. last-1, moments
 * int f' x^n dr and int r f'' x^n dr, x = (r-c)/d, the first of them
 * exact, the rest to a double's digits, which are all that count of them. false: there are no more. */
enum { FRET_TABLE_MOMENTS = 32, FRET_TABLE_EXACT = 9 };
typedef struct fret_table_stretch {
    size_t first, last, next;
    fret_real c, d;
    const fret_real *slope, *rf2;
} fret_table_stretch;
bool fret_table_block(const struct fret_table *table, size_t i, fret_table_stretch *out);
/* How many terms count of Taylor's series about the middle of what is `half` wide to both sides, `away` from
 * what is singular; 0: it is too near. */
int fret_table_terms(fret_real half, fret_real away);

#endif
