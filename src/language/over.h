/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Integrals over a name, and the largest and smallest value over a name or along a load. Reads no text;
 * changes only the scratch scene of its trial. */
#ifndef LANGUAGE_OVER_H
#define LANGUAGE_OVER_H

#include "language/trial.h"

typedef struct over {
    trial *t;
    const knob *name; /* varies from lo to hi; NULL: time along the load */
    along_what what;
    long double lo, hi;
    bool (*value)(void *context, value *out); /* evaluates the expression in the present trial */
    void *context;
    calc_error *error;
    dim d; /* dimension of the expression, once `known` */
    bool known;
} over;

/* The integral over the name, as a number in SI. *error: estimate of its error, relative to the integral of
 * the magnitude. An integral that does not converge is an error. */
bool over_integral(over *o, long double *out, long double *error);
/* The largest or smallest value to rounding: the best of 257 places or more, refined between neighbours. */
bool over_extreme(over *o, bool largest, long double *out);

#endif
