/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Bracketed root of a function of one variable. Not installed. */
#ifndef FRET_NUMBER_ROOT_H
#define FRET_NUMBER_ROOT_H

#include "fret/base.h"

/* Returns f(x) and sets *slope to f'(x), or leaves it 0 if that is unknown. */
typedef fret_real fret_function(fret_real x, fret_real *slope, void *context);

/* The root of f between lo < hi, where f has different signs, to the last digit that f determines. Starts
 * from `guess` if that lies between them, with Newton steps, or secant steps if the slope is unknown; bisects
 * if a step leaves the bracket or does not halve the step before the last. */
fret_real fret_root(fret_function *f, void *context, fret_real lo, fret_real hi, fret_real guess);
/* The same for f in double, from the middle and by secant steps, until the next x is the same double. */
double fret_root_double(double (*f)(double x, void *context), void *context, double lo, double hi);

#endif
