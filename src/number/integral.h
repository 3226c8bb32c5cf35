/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Integrals, with how far they may be off. Not installed. */
#ifndef FRET_NUMBER_INTEGRAL_H
#define FRET_NUMBER_INTEGRAL_H

#include "fret/base.h"

/* f gets t and 1-t, each with all its digits: it may be singular at either end. */
typedef fret_real fret_integrand(fret_real t, fret_real rest, void *context);

typedef struct fret_estimate {
    fret_real value, error;
} fret_estimate;

/* int_0^1 f dt to `tolerance` of int_0^1 |f| dt, 1e-18 at best: 26 values where f is smooth, up to 170 where
 * it is algebraic at an end, and 32 for each halving towards a kink or a singularity within. The error is an
 * estimate: next to kinks it may be some times too small, and the rounding of f it does not know. Ends
 * steeper than t^-0.7 want a substitution. */
fret_estimate fret_integral(fret_integrand *f, void *context, fret_real tolerance);

/* The same in one part, for who knows that f is smooth but for powers at its ends: 24 values, where these do
 * not agree up to 170. */
fret_real fret_integral_ends(fret_integrand *f, void *context, fret_real tolerance);

/* The same by eight points alone, for who knows that f is smooth. */
fret_real fret_integral_smooth(fret_integrand *f, void *context);

/* Their nodes on 0..1: 1e-20 where its argument varies by less than 20 %. */
extern const fret_real fret_gauss_node[8], fret_gauss_weight[8];

#endif
