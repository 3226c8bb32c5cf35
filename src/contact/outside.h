/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The surface outside of a contact by the rows of its table, of which nothing is made before. Not installed.
 */
#ifndef FRET_CONTACT_OUTSIDE_H
#define FRET_CONTACT_OUTSIDE_H

#include "contact/kernel.h"
#include "contact/table.h"

/* With m = (k+1)/2 and r > a, int_0^a x^k g (r^2-x^2)^-m dx = int f'(s) phi(s) ds over the contact: phi is
 * what a flat punch has whose squares of a and r are less by s^2, half of B_T(m,1-m), T =
 * (a^2-s^2)/(r^2-s^2), phi' = -s/(r^2-s^2) ((r^2-a^2)/(a^2-s^2))^(1-m). */
typedef struct fret_outside {
    flat_field flat;
    fret_real over[FRET_TABLE_MOMENTS + 2], with[FRET_TABLE_MOMENTS + 4]; /* 1/(n+1), 1/(n+m) */
} fret_outside;

void fret_outside_make(fret_outside *outside, fret_real k);

/* int_0^a x^k (dz-g) (r^2-x^2)^-m dx of a contact beyond the start of the table, r > a. */
fret_real fret_outside_surface(const fret_outside *outside, const struct fret_table *table, fret_real dz,
                               fret_real a, fret_real r);

#endif
