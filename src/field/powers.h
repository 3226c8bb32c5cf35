/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Fields of a contact of radius a whose profile is a sum of powers G (x/a)^n. Pure. Not installed. */
#ifndef FRET_FIELD_POWERS_H
#define FRET_FIELD_POWERS_H

#include "field/kernel.h"
#include "law/gap.h"

/* int_r^a g' (x^2-r^2)^((k-1)/2) dx, r < a. */
fret_real fret_powers_slope(const fret_term *term, int terms, fret_real k, fret_real a, fret_real r);
/* The same at r = 0 over b < x < a, which stays finite where the integral from 0 does not. */
fret_real fret_powers_ring(const fret_term *term, int terms, fret_real k, fret_real a, fret_real b);
/* int_0^a x^k (dz-g) (r^2-x^2)^(-(1+k)/2) dx, r > a. */
fret_real fret_powers_surface(const fret_term *term, int terms, const flat_field *flat, fret_real dz,
                              fret_real a, fret_real r);

#endif
