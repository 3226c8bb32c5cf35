/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef FRET_ARRAYS_H
#define FRET_ARRAYS_H

#include <stddef.h>

#include "fret/normal.h"

FRET_BEGIN

/* Closed forms in double for arrays of loads: twenty times as fast as the functions of cycle.h and normal.h,
 * accurate to 15 digits, and the same bits on every processor. This holds for power laws. For other shapes,
 * and where mu F_N, delta_x,max or their product leaves 1e-270..1e270, the results are those of the function
 * named below, rounded to double. Accuracy is relative, for arguments taken as exact and results that are not
 * denormal. An error is that of the named function for the first load out of range: results before that load
 * are valid, the others unspecified. Arrays hold `count` numbers each and must not overlap. */

/* Energies [J] dissipated in cycles -FA .. FA, 0 <= FA <= mu F_N [N], as by fret_cycle_loss_by_force, to
 * 2e-15. */
fret_status fret_arrays_loss(const fret_pressed *contact, const double FA[], double loss[], size_t count);

/* Stick radii [m] and displacements [m] of first loading to Fx [N], |Fx| <= mu F_N, as by
 * fret_loading_by_force, to 1e-15. c or dx may be NULL. */
fret_status fret_arrays_loading(const fret_pressed *contact, const double Fx[], double c[], double dx[],
                                size_t count);

/* Contact radii and indentation depths [m] under the loads F [N] >= 0, as by fret_press_by_force, to 1e-15.
 * Either may be NULL. */
fret_status fret_arrays_press(const fret_normal *normal, const double F[], double a[], double dz[],
                              size_t count);

FRET_END

#endif
