/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Integrals of powers against the kernels (x^2-r^2)^(m-1) and (r^2-x^2)^-m. In s = x^2, scaled to a ring,
 * they become powers of a distance with closed forms. Pure functions. Not installed. */
#ifndef FRET_FIELD_KERNEL_H
#define FRET_FIELD_KERNEL_H

#include "fret/base.h"
#include "number/chebyshev.h"

enum { MOST = FRET_CHEBYSHEV, SERIES = 120 };

/* Tables for the integrals of y^(q+j), y in 0..1, j < MOST: what depends on q and m alone. */
typedef struct powers {
    fret_real q;
    int of_m, whole;      /* q = of_m m + whole */
    fret_real over[MOST]; /* 1/(q+j+1) */
    fret_real with[MOST]; /* 1/(q+j+1+m) */
    fret_real last;       /* 1/(q+MOST+1) */
    /* factors of the recurrences in j: (q+j+1) with, (q+j+1+m) over, (q+j+2-m) over */
    fret_real rise[MOST], fall[MOST], lapse[MOST];
    /* coefficients of power series in z, with Q = q + MOST */
    fret_real edge[SERIES];                 /* m int_0^1 (1-t)^(m-1) (1-z t)^q dt */
    fret_real below[SERIES];                /* (q+1) int_0^1 (1-t)^q (1-z t)^(m-1) dt */
    fret_real top[SERIES];                  /* (Q+1) int_0^1 (1-t)^Q (1-z t)^(m-1) dt */
    fret_real within[SERIES];               /* int_0^1 t^Q (1-z t)^-m dt */
    fret_real rim[SERIES];                  /* int_0^1 t^-m (1-z t)^Q dt */
    fret_real far[SERIES];                  /* int_1^oo t^(q+m-1) (1-z/t)^(m-1) dt without term `nearest` */
    int nearest;                            /* the n of `far` with the largest 1/(n-q-m) */
    fret_real away, nearest_b, nearest_two; /* for n = nearest: q+m-n; binomial factor; 2^(q+m-n) */
    fret_real above_nil, below_nil;         /* coefficients of d^(q+m) in the integrals above and below r */
    fret_real whole_beta;                   /* int_0^1 t^Q (1-t)^-m dt */
} powers;

/* The limits of an integral, in scaled squares: d >= 0 is the distance of r from the origin of y, x the
 * other limit, rest = |x - r|. The powers and the logarithm are set only where an integral needs them. */
typedef struct distances {
    fret_real m, d, x, rest;
    fret_real rim, x_m, d_m, span; /* rest^m or rest^(1-m), x^m, d^m, ln(x/2d) */
} distances;

/* The displacement outside a flat punch, int_0^a x^k (r^2-x^2)^-m dx: coefficients of its series in (a/r)^2
 * and, near the edge, in 1-(a/r)^2; whole is its value at r = a, times 2. */
typedef struct flat_field {
    fret_real m, whole;
    fret_real centre[SERIES], edge[SERIES];
} flat_field;

/* Makes the series; the integral for a <= r. */
void fret_kernel_flat_make(flat_field *f, fret_real m);
fret_real fret_kernel_flat(const flat_field *f, fret_real a, fret_real r);
/* The same by q = (a/r)^2 and away = 1-q. */
fret_real fret_kernel_flat_of(const flat_field *f, fret_real q, fret_real away);

/* Fills the tables for the exponent q = of_m m + whole. */
void fret_kernel_power(powers *p, int of_m, int whole, fret_real m);

/* I[j] = int_d^x y^(q+j) (y-d)^(m-1) dy for j < count. */
void fret_kernel_above(const powers *p, const distances *c, int count, fret_real *I);
/* I[j] = int_0^x y^(q+j) (y+d)^(m-1) dy. */
void fret_kernel_below(const powers *p, const distances *c, int count, fret_real *I);
/* I[j] = int_0^x y^(q+j) (d-y)^-m dy, d >= x. */
void fret_kernel_beyond(const powers *p, const distances *c, int count, fret_real *I);

#endif
