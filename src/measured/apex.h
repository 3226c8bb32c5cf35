/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Where a measured profile is its own mirror image. Knows numbers alone. */
#ifndef MEASURED_APEX_H
#define MEASURED_APEX_H

#include "text/error.h"

/* Of a profile that rises on both sides, else nothing. */
typedef struct apex {
    bool moved;  /* it is not at r = 0, by more than chance */
    bool tilted; /* its sides differ in slope */
    double at;   /* [m] */
    double tilt; /* f grows by so much with r, taken off */
} apex;

/* Rows r, f in any order. Of all x and, where by more than chance less is left then, of all tilts t, those
 * with the least mean square of f(x+d) - f(x-d) - 2td, as a part of that of f(x+d) + f(x-d) about its mean,
 * over the rows whose mirror image lies between rows; f(x-d) by the parabola through three of them. r and f
 * are then counted from there. A paraboloid that is tilted is one whose apex is elsewhere: no tilt is found.
 */
bool apex_find(double *r, double *f, size_t rows, apex *out, calc_error *error);

#endif
