/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The profile of a contact as polynomials, for fields at many places. Made once, only read afterwards. Not
 * installed. */
#ifndef FRET_FIELD_DENSITY_H
#define FRET_FIELD_DENSITY_H

#include "law/normal.h"

struct fret_density;

/* Up to the radius a. *out is NULL where polynomials are no good: ask the quadrature. */
fret_status fret_density_make(const fret_normal *normal, fret_real a, struct fret_density **out);
void fret_density_free(struct fret_density *density);

/* How far g' is off, relative. */
fret_real fret_density_error(const struct fret_density *density);
/* The radius where it begins: the start of the gap, or the first row of a table, within which that is a sum
 * of powers (fret_gap_series). */
fret_real fret_density_from(const struct fret_density *density);
/* g there. */
fret_real fret_density_from_depth(const struct fret_density *density);

/* A flat punch's surface but for its depth: int_0^a x^k (r^2-x^2)^-m dx, r > a. */
fret_real fret_density_flat(const struct fret_density *density, fret_real a, fret_real r);

/* Contacts one within the other, radii rising; weight: of what lies between the last one and this. */
typedef struct fret_cut {
    fret_real a, weight;
} fret_cut;

/* Weighted integrals from where it begins, m = (k+1)/2: int g' (x^2-r^2)^(m-1) dx over x > r, and
 * int x^k g (r^2-x^2)^-m dx for r beyond all cuts. */
fret_real fret_density_pressure(const struct fret_density *density, const fret_cut *cut, size_t count,
                                fret_real r);
fret_real fret_density_surface(const struct fret_density *density, const fret_cut *cut, size_t count,
                               fret_real r);

#endif
