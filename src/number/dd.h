/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Double-double arithmetic: a number is the unevaluated sum hi + lo, about 100 bits, by basic IEEE
 * operations. Inline functions are named dd_..., others fret_dd_... Not installed. */
#ifndef FRET_DD_H
#define FRET_DD_H

#include <math.h>

#include "fret/base.h"
#include "number/pair.h"

static inline dd dd_of(double x) {
    return (dd){x, 0};
}

static inline dd dd_quick_sum(double a, double b) { /* |a| >= |b| */
    double s = a + b;
    return (dd){s, b - (s - a)};
}

/* a + b exactly */
static inline dd dd_sum(double a, double b) {
    double s = a + b, v = s - a;
    return (dd){s, (a - (s - v)) + (b - v)};
}

/* a b exactly, unless it leaves 1e-290 .. 1e290 */
static inline dd dd_prod(double a, double b) {
    double p = a * b;
#ifdef FP_FAST_FMA
    return (dd){p, fma(a, b, -p)};
#else
    double x = 134217729 * a, ah = x - (x - a), al = a - ah;
    double y = 134217729 * b, bh = y - (y - b), bl = b - bh;
    return (dd){p, ((ah * bh - p) + ah * bl + al * bh) + al * bl};
#endif
}

static inline dd dd_add(dd a, dd b) {
    dd s = dd_sum(a.hi, b.hi), t = dd_sum(a.lo, b.lo);
    s = dd_quick_sum(s.hi, s.lo + t.hi);
    return dd_quick_sum(s.hi, s.lo + t.lo);
}

/* a + b in fewer operations, for |a| >= |b| and |a + b| >= |a|/2. */
static inline dd dd_extend(dd a, dd b) {
    dd s = dd_quick_sum(a.hi, b.hi);
    return dd_quick_sum(s.hi, s.lo + (a.lo + b.lo));
}

static inline dd dd_add_d(dd a, double b) {
    dd s = dd_sum(a.hi, b);
    return dd_quick_sum(s.hi, s.lo + a.lo);
}

static inline dd dd_neg(dd a) {
    return (dd){-a.hi, -a.lo};
}

static inline dd dd_sub(dd a, dd b) {
    return dd_add(a, dd_neg(b));
}

static inline dd dd_mul(dd a, dd b) {
    dd p = dd_prod(a.hi, b.hi);
    return dd_quick_sum(p.hi, p.lo + (a.hi * b.lo + a.lo * b.hi));
}

static inline dd dd_mul_d(dd a, double b) {
    dd p = dd_prod(a.hi, b);
    return dd_quick_sum(p.hi, p.lo + a.lo * b);
}

static inline dd dd_div(dd a, dd b) {
    double q = a.hi / b.hi;
    dd p = dd_prod(b.hi, q);
    double left = (((a.hi - p.hi) - p.lo) + a.lo) - b.lo * q; /* the first difference is exact */
    return dd_quick_sum(q, left / b.hi);
}

static inline dd dd_sqrt(dd a) { /* a > 0 */
    double x = sqrt(a.hi);
    dd r = dd_sub(a, dd_prod(x, x));
    return dd_quick_sum(x, r.hi / (2 * x));
}

/* Exact where long double has no more than 106 bits and x is within the range of double. */
static inline dd dd_from(fret_real x) {
    double hi = (double)x;
    return (dd){hi, (double)(x - hi)};
}

static inline fret_real dd_value(dd a) {
    return (fret_real)a.hi + a.lo;
}

/* x + rest to all bits, where long double holds less than 106. */
static inline dd dd_from2(fret_real x, double rest) {
    return dd_add_d(dd_from(x), rest);
}

/* a - dd_value(a), to double */
static inline double dd_rest(dd a) {
    return (double)((a.hi - dd_value(a)) + a.lo);
}

/* Elementary functions, to 2^-98 relative (fret_dd_exp, fret_dd_expm1: plus |x| 2^-105). */
dd fret_dd_exp(dd x);
dd fret_dd_expm1(dd x);
dd fret_dd_log(dd x);                   /* x > 0 */
dd fret_dd_log_scaled(dd x, int scale); /* ln(x 2^scale) */
dd fret_dd_log1p(dd x);                 /* x > -1 */
/* sin(pi x/2), 0 <= x <= 1. */
dd fret_dd_sin_quarter(dd x);

/* Gamma(over[0]) .../(Gamma(under[0]) ...) = factor exp(log); m and n arguments, all >= 1/2. */
typedef struct dd_scaled {
    dd factor, log;
} dd_scaled;
dd_scaled fret_dd_gamma_quotient(const dd *over, int m, const dd *under, int n);

/* ln x, x > 0, and exp x over the whole range of long double. */
dd fret_dd_log_real(fret_real x);
fret_real fret_dd_exp_real(dd x);

#endif
