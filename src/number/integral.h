/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Integrals with error estimates. Not installed. */
#ifndef FRET_NUMBER_INTEGRAL_H
#define FRET_NUMBER_INTEGRAL_H

#include "fret/base.h"

/* The integrand, given t and rest = 1-t, both to full relative accuracy: it may be singular at either end. */
typedef fret_real fret_integrand(fret_real t, fret_real rest, void *context);

typedef struct fret_estimate {
    fret_real value, error;
} fret_estimate;

/* int_0^1 f dt to `tolerance` times int_0^1 |f| dt, at best 1e-18. Takes 26 values if f is smooth, up to 170
 * if it has a power at an end, and 32 for each bisection towards a kink or a singularity within. The error is
 * an estimate: next to kinks it may be several times too small, and it does not include the rounding of f.
 * Ends steeper than t^-0.7 need a substitution. */
fret_estimate fret_integral(fret_integrand *f, void *context, fret_real tolerance);

/* The same without bisection, for an f smooth except for powers at its ends: 24 values, or up to 170. */
fret_real fret_integral_ends(fret_integrand *f, void *context, fret_real tolerance);

/* The same by the 8-point Gauss rule alone, for a smooth f. */
fret_real fret_integral_smooth(fret_integrand *f, void *context);

/* Its nodes and weights on 0..1; the rule errs by 1e-20 where the argument of a power varies by up to 20
 * %. */
extern const fret_real fret_gauss_node[8], fret_gauss_weight[8];

#endif
