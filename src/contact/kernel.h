/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Elementary functions in double, for one number and for eight lanes, the same bits for both and on every
 * machine: + - * / and whole-word operations alone, no libm, no tables, no fused multiply-add (which
 * -ffp-contract=off forbids). Rounding to nearest is assumed. Not installed. */
#ifndef FRET_KERNEL_H
#define FRET_KERNEL_H

#include <math.h>
#include <stdint.h>
#include <string.h>

/* Inlined also without optimisation: the caller's instruction set applies. */
#define KERNEL_INLINE static inline __attribute__((always_inline))

KERNEL_INLINE uint64_t kernel_bits(double x) {
    uint64_t u;
    memcpy(&u, &x, sizeof u);
    return u;
}

KERNEL_INLINE double kernel_value(uint64_t u) {
    double x;
    memcpy(&x, &u, sizeof x);
    return x;
}

#define V double
#define U uint64_t
#define BITS kernel_bits
#define VALUE kernel_value
#define SELECT(mask, yes, no) ((mask) ? (yes) : (no))
#define NAMED(name) one_##name
#include "kernel_body.h"
#undef V
#undef U
#undef BITS
#undef VALUE
#undef SELECT
#undef NAMED

/* The compiler makes 1, 2 or 4 registers of them. */
enum { KERNEL_LANES = 8 };
typedef double kernel_lanes __attribute__((vector_size(KERNEL_LANES * sizeof(double))));
typedef uint64_t kernel_words __attribute__((vector_size(KERNEL_LANES * sizeof(uint64_t))));

#define V kernel_lanes
#define U kernel_words
#define BITS(x) ((kernel_words)(x))
#define VALUE(u) ((kernel_lanes)(u))
#define SELECT(mask, yes, no) VALUE((BITS(yes) & (kernel_words)(mask)) | (BITS(no) & ~(kernel_words)(mask)))
#define NAMED(name) eight_##name
#include "kernel_body.h"
#undef V
#undef U
#undef BITS
#undef VALUE
#undef SELECT
#undef NAMED

/* The functions of one number, as in libm; measured worst errors in ulp are those of tests/unit/test_batch.c.
 */

static inline double kernel_exp(double x) {
    double zero = 0, out;
    one_exp_sum(&x, &zero, &out);
    return out;
}

static inline double kernel_expm1(double x) {
    double out;
    if (!(x < 690)) /* e^x - 1 = e^x there; NaN */
        return kernel_exp(x);
    if (x < -50)
        return -1;
    if (x == 0)
        return x;
    one_expm1(&x, &out);
    return out;
}

/* A number > 0 made normal: x = *x 2^-returned. */
KERNEL_INLINE double kernel_normal(double *x) {
    if (*x >= 0x1p-1022)
        return 0;
    *x *= 0x1p54;
    return 54;
}

static inline double kernel_log(double x) {
    if (!(x > 0 && x < (double)INFINITY))
        return x == 0 ? -(double)INFINITY : x > 0 ? x : (double)NAN;
    double m, e, unit, zero = 0, out, lift = kernel_normal(&x);
    one_reduce(&x, &m, &e, &unit);
    e -= lift;
    m -= 1;
    one_log_of(&m, &zero, &e, &out);
    return out;
}

static inline double kernel_log1p(double x) {
    if (!(x > -1 && x < 0x1p60) || x == 0)
        return x == 0 ? x : kernel_log(1 + x);
    double u = 1 + x, m, e, unit, f = x, low = 0, out;
    one_reduce(&u, &m, &e, &unit);
    if (e != 0) {
        low = (x < 1 ? x - (u - 1) : 1 - (u - x)) * unit;
        f = m - 1;
    }
    one_log_of(&f, &low, &e, &out);
    return out;
}

/* x^y of x >= 0; NaN for negative x. */
static inline double kernel_pow(double x, double y) {
    if (y == 0 || x == 1)
        return 1;
    if (!(x > 0 && x < (double)INFINITY && fabs(y) < (double)INFINITY)) {
        if (!(x >= 0) || y != y)
            return (double)NAN;
        return (x > 1) == (y > 0) ? (double)INFINITY : 0;
    }
    double m, e, unit, zero = 0, lh, ll, h, l, out, lift = kernel_normal(&x);
    one_reduce(&x, &m, &e, &unit);
    e -= lift;
    m -= 1;
    one_log_pair(&m, &zero, &e, &lh, &ll);
    if (fabs(y) >= 0x1p100) { /* overflows or vanishes; the halves of the product would be infinite */
        h = lh > 0 ? y : -y;
        l = 0;
    } else {
        one_product(&lh, &y, &h, &l);
        l += ll * y;
    }
    one_exp_sum(&h, &l, &out);
    return out;
}

#endif
