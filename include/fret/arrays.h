/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef FRET_ARRAYS_H
#define FRET_ARRAYS_H

#include <stddef.h>

#include "fret/normal.h"

FRET_BEGIN

/* The closed forms in double, for many loads at once: twenty times as fast as the functions of cycle.h and
 * normal.h, where 15 digits will do; with the same bits on every processor. This holds for power laws. For
 * other shapes, and where mu F_N, delta_x,max or their product leaves 1e-270..1e270, the results are those of
 * the functions named, rounded to double. Accuracy is relative, for the arguments as given and results that
 * are not denormal. Errors are those of the function named for the first load that is out of range: results
 * before it are valid, those from there on are unspecified. Arrays hold `count` numbers each and must not
 * overlap. */

/* Energies [J] dissipated in cycles -FA .. FA, as fret_cycle_loss_by_force: 2e-15. Range 0 <= FA <= mu F_N
 * [N]. */
fret_status fret_arrays_loss(const fret_pressed *contact, const double FA[], double loss[], size_t count);

/* Stick radii [m] and displacements [m] of first loading to Fx [N], |Fx| <= mu F_N, as fret_loading_by_force:
 * 1e-15. c or dx may be NULL. */
fret_status fret_arrays_loading(const fret_pressed *contact, const double Fx[], double c[], double dx[],
                                size_t count);

/* Contact radii [m] and indentation depths [m] of the loads F [N] >= 0, as fret_press_by_force: 1e-15.
 * a or dz may be NULL. */
fret_status fret_arrays_press(const fret_normal *normal, const double F[], double a[], double dz[],
                              size_t count);

FRET_END

#endif
