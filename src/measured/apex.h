/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The apex of a measured profile: where the profile is symmetric. Depends on text/error and number. */
#ifndef MEASURED_APEX_H
#define MEASURED_APEX_H

#include "text/error.h"

/* What apex_find has found; all zero unless the profile rises on both sides. */
typedef struct apex {
    bool moved;  /* the apex is significantly away from r = 0: r and f have been shifted */
    bool tilted; /* the profile is significantly tilted about it */
    double at;   /* position of the apex [m] */
    double tilt; /* slope df/dr that has been subtracted */
} apex;

/* Finds the apex of the rows r, f [m], in any order, and moves them so that it is at r = 0. The apex is the x
 * that minimises the mean square of f(x+d) - f(x-d) - 2 t d relative to the variance of f(x+d) + f(x-d), over
 * the rows x+d whose mirror image lies between rows; f(x-d) is interpolated by a parabola. The tilt t is 0
 * unless it reduces the asymmetry significantly. A tilted paraboloid is a shifted one and gets no tilt. */
bool apex_find(double *r, double *f, size_t rows, apex *out, calc_error *error);

#endif
