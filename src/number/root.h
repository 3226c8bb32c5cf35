/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Where a function of one number changes its sign. Not installed. */
#ifndef FRET_NUMBER_ROOT_H
#define FRET_NUMBER_ROOT_H

#include "fret/base.h"

/* f(x), and in *slope its derivative; 0, as it is before, where that is not known. */
typedef fret_real fret_function(fret_real x, fret_real *slope, void *context);

/* The place between lo < hi, where f has different signs, at which it is 0, to the last digit that f tells.
 * Steps of Newton, without a slope of the secant, from `guess` if that lies within; half of what is left
 * where they leave it or do not halve themselves. */
fret_real fret_root(fret_function *f, void *context, fret_real lo, fret_real hi, fret_real guess);

#endif
