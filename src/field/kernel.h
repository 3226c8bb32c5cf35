/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Powers against the kernels (x^2-r^2)^(m-1) and (r^2-x^2)^-m: in s = x^2, scaled to a ring, these are powers
 * of a distance, and the integrals have closed forms. No state but what is passed. Not installed. */
#ifndef FRET_FIELD_KERNEL_H
#define FRET_FIELD_KERNEL_H

#include "fret/base.h"
#include "number/chebyshev.h"

enum { MOST = FRET_CHEBYSHEV, SERIES = 120 };

/* y^q times the powers y^j, y in 0..1, with what their integrals need of q and m. */
typedef struct powers {
    fret_real q;
    int of_m, whole;      /* q = of_m m + whole */
    fret_real over[MOST]; /* 1/(q+j+1) */
    fret_real with[MOST]; /* 1/(q+j+1+m) */
    fret_real last;       /* 1/(q+MOST+1) */
    /* of one integral what the next or the last one takes: (q+j+1) with, (q+j+1+m) over, (q+j+2-m) over */
    fret_real rise[MOST], fall[MOST], lapse[MOST];
    /* terms of series in z; Q = q + MOST */
    fret_real edge[SERIES];                 /* m int_0^1 (1-t)^(m-1) (1-z t)^q dt */
    fret_real below[SERIES];                /* (q+1) int_0^1 (1-t)^q (1-z t)^(m-1) dt */
    fret_real top[SERIES];                  /* (Q+1) int_0^1 (1-t)^Q (1-z t)^(m-1) dt */
    fret_real within[SERIES];               /* int_0^1 t^Q (1-z t)^-m dt */
    fret_real rim[SERIES];                  /* int_0^1 t^-m (1-z t)^Q dt */
    fret_real far[SERIES];                  /* int_1^oo t^(q+m-1) (1-z/t)^(m-1) dt, without the nearest */
    int nearest;                            /* of far the term n whose 1/(n-q-m) is the largest */
    fret_real away, nearest_b, nearest_two; /* q+m-n; what it is a multiple of; 2^(q+m-n) */
    fret_real above_nil, below_nil;         /* the rest of far, of d^(q+m) */
    fret_real whole_beta;                   /* int_0^1 t^Q (1-t)^-m dt */
} powers;

/* What integrals from d to x, or up to x, have in common, whatever q is: d >= 0 the distance of r, rest that
 * of x from r; what takes time, where it is wanted. */
typedef struct distances {
    fret_real m, d, x, rest;
    fret_real rim, x_m, d_m, span; /* rest^m or rest^(1-m), x^m, d^m, ln(x/2d) */
} distances;

/* The field of a flat punch outside, int_0^a x^k (r^2-x^2)^-m dx: by its series in (a/r)^2 and, near the
 * edge, in what is left of 1. */
typedef struct flat_field {
    fret_real m, whole;
    fret_real centre[SERIES], edge[SERIES];
} flat_field;

void fret_kernel_flat_make(flat_field *f, fret_real m);
fret_real fret_kernel_flat(const flat_field *f, fret_real a, fret_real r);
/* With q = (a/r)^2 and away = 1-q. */
fret_real fret_kernel_flat_of(const flat_field *f, fret_real q, fret_real away);

/* For q = of_m m + whole. */
void fret_kernel_power(powers *p, int of_m, int whole, fret_real m);

/* I[j] for j < count: int y^(q+j) (y-d)^(m-1) dy from d to x; */
void fret_kernel_above(const powers *p, const distances *c, int count, fret_real *I);
/* the same from 0 to x with y+d for y-d; */
void fret_kernel_below(const powers *p, const distances *c, int count, fret_real *I);
/* int_0^x y^(q+j) (d-y)^-m dy, d >= x. */
void fret_kernel_beyond(const powers *p, const distances *c, int count, fret_real *I);

#endif
