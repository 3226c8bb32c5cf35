/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Powers against the kernels (x^2-r^2)^(m-1) and (r^2-x^2)^-m: in s = x^2, scaled to a ring, these are powers
 * of a distance, and the integrals have closed forms. No state but what is passed. Not installed. */
#ifndef FRET_CONTACT_KERNEL_H
#define FRET_CONTACT_KERNEL_H

#include "fret/base.h"
#include "number/chebyshev.h"

enum { MOST = FRET_CHEBYSHEV, SERIES = 120 };

/* y^q times the powers y^j, y in 0..1, with what their integrals need of q and m. */
typedef struct powers {
    fret_real q;
    int of_m, whole;              /* q = of_m m + whole */
    fret_real over[MOST + 1];     /* 1/(q+j+1) */
    fret_real with[MOST + 1];     /* 1/(q+j+1+m) */
    fret_real edge[SERIES];       /* ratios of terms: (n-q)/(m+1+n) */
    fret_real below[SERIES];      /* (1-m+n)/(q+2+n) */
    fret_real top[SERIES];        /* the same with q+MOST for q */
    fret_real span[SERIES];       /* 1/(q+m-n) */
    fret_real twice;              /* 2^(q+m) */
    fret_real from_one, from_nil; /* int_1^2 t^q (t-1)^(m-1) dt, int_0^2 t^q (t+1)^(m-1) dt */
    fret_real whole_beta;         /* int_0^1 t^(q+MOST) (1-t)^-m dt */
} powers;

/* What integrals from d to x, or up to x, have in common, whatever q is: d >= 0 the distance of r, rest that
 * of x from r; what takes time, where it is wanted. */
typedef struct reach {
    fret_real m, d, x, rest;
    fret_real rim, x_m, d_m, span; /* rest^m or rest^(1-m), x^m, d^m, ln(x/2d) */
} reach;

/* For q = of_m m + whole. */
void fret_kernel_power(powers *p, int of_m, int whole, fret_real m);

/* I[j] for j < count: int y^(q+j) (y-d)^(m-1) dy from d to x; */
void fret_kernel_above(const powers *p, const reach *c, int count, fret_real *I);
/* the same from 0 to x with y+d for y-d; */
void fret_kernel_below(const powers *p, const reach *c, int count, fret_real *I);
/* int_0^x y^(q+j) (d-y)^-m dy, d >= x. */
void fret_kernel_beyond(const powers *p, const reach *c, int count, fret_real *I);

#endif
