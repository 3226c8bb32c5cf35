/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a bend of a sampled gap does to the pressure everywhere, and all of them together: the pressure of a
 * contact as if g' had no end. Not installed. */
#ifndef FRET_CONTACT_RIPPLE_H
#define FRET_CONTACT_RIPPLE_H

#include "contact/density.h"
#include "contact/table.h"

/* With m = (k+1)/2 and h = (r f')', g'(x) = x^-k int_0^x h (x^2-s^2)^(m-1) ds: the pressure of a contact of
 * radius a is int_0^a h(s) K(s,r) ds less what lies beyond a, with
 *   K(s,r) = int_max(s,r)^oo x^-k (x^2-r^2)^(m-1) (x^2-s^2)^(m-1) dx = r^(k-1) Y(s/r).
 * Y(1+u) = sum u^n (smooth[n] + bent[n] S), S = (|u|^k-1)/k. */
enum { FRET_RIPPLE = 40 };
typedef struct fret_ripple {
    fret_real k, m, whole; /* whole = B(m,1-m)/2 */
    fret_real smooth[FRET_RIPPLE], bent[FRET_RIPPLE], centre[FRET_RIPPLE * 3];
    fret_real one[FRET_RIPPLE], with[FRET_RIPPLE], over[FRET_RIPPLE]; /* 1/(n+1), 1/(n+1+k), 1/((n+1)(n+2)) */
} fret_ripple;

void fret_ripple_make(fret_ripple *ripple, fret_real k);
/* Y and Y' at y > 0, y != 1; u = y-1. */
void fret_ripple_at(const fret_ripple *ripple, fret_real y, fret_real u, fret_real out[2]);

/* The weighted integrals of h K over the rows between cuts, r >= 0; radii of cuts rise, all of them beyond
 * the start of the gap. Infinite where it is. */
fret_real fret_ripple_sum(const fret_ripple *ripple, const struct fret_table *table, const fret_cut *cut,
                          size_t count, fret_real r);

#endif
