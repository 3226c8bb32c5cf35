/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Integrals over a name, and the largest and smallest of values over a name or along a load. Reads no text;
 * changes the scratch scene of its trial alone. */
#ifndef LANGUAGE_OVER_H
#define LANGUAGE_OVER_H

#include "language/trial.h"

typedef struct over {
    trial *t;
    const knob *name; /* which goes from lo to hi; NULL: along that load, in time */
    along_what what;
    long double lo, hi;
    bool (*value)(void *context, value *out); /* of the expression as things stand */
    void *context;
    calc_error *error;
    dim d; /* of the expression, once `known` */
    bool known;
} over;

/* The integral over the name, without its dimension. *error: how far it may be off, of the integral of its
 * magnitude. An integral that does not converge is an error. */
bool over_integral(over *o, long double *out, long double *error);
/* The largest, or the smallest, to rounding: of 257 places the best, then places between its neighbours. */
bool over_extreme(over *o, bool largest, long double *out);

#endif
