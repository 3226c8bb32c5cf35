/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Minimum of a function of one variable. Not installed. */
#ifndef FRET_NUMBER_LEAST_H
#define FRET_NUMBER_LEAST_H

#include "number/root.h"

/* The x between lo and hi where f is least, to `part` of hi - lo, by golden-section search from `guess`. f
 * must fall up to x and rise from there; its slope is not used. Half of the digits of x determine f. */
fret_real fret_least(fret_function *f, void *context, fret_real lo, fret_real hi, fret_real guess,
                     fret_real part);

#endif
