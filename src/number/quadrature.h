/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Quadrature over 0..1: double exponential for singular ends, Gauss-Legendre for smooth integrands. Not
 * installed. */
#ifndef FRET_NUMBER_QUADRATURE_H
#define FRET_NUMBER_QUADRATURE_H

#include "number/integral.h"

/* int_0^1 f dt by double-exponential quadrature; what wants no error: other callers take fret_integral. */
fret_real fret_integrate(fret_integrand *f, void *context);

/* The same by eight Gauss-Legendre points: 1e-20 where f is smooth and its argument varies by less than 20 %.
 */
fret_real fret_integrate_smooth(fret_integrand *f, void *context);

/* The same by eight points in either half where they add up to those of the whole to `agree` of it, as
 * between places that are close; else as fret_integrate. */
fret_real fret_integrate_short(fret_integrand *f, void *context, fret_real agree);

/* The same by halves, and halves of these, until they add up to `tolerance` of the integral, for integrands
 * that are smooth but for kinks; at most 2^24 of them. */
fret_real fret_integrate_pieces(fret_integrand *f, void *context, fret_real tolerance);

/* A point and its mirror image together. */
typedef double fret_two __attribute__((vector_size(16)));

#endif
