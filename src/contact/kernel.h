/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Elementary functions in double, for one number and (kernel_lanes.h) for several at once, the same bits for
 * both and on every machine: + - * / and whole-word operations alone, no libm, no tables, no fused
 * multiply-add (which -ffp-contract=off forbids). Rounding to nearest is assumed. Not installed. */
#ifndef FRET_KERNEL_H
#define FRET_KERNEL_H

#include <math.h>
#include <stdbool.h>
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

/* Whether some word of a mask is not 0. */
KERNEL_INLINE bool kernel_any(const void *mask, int lanes) {
    typedef int64_t pair __attribute__((vector_size(16)));
    pair part[4];
    memcpy(part, mask, (size_t)lanes * sizeof(int64_t));
    if (lanes > 4)
        part[0] |= part[2] | part[3];
    if (lanes > 2)
        part[0] |= part[1];
    return (part[0][0] | part[0][1]) != 0;
}

#define LANES 1
#include "kernel_lanes.h"

/* The functions of one number, as in libm. Measured: 0.9 ulp, expm1 1.7 ulp. */

static inline double kernel_exp(double x) {
    double one = 1, zero = 0, out;
    lanes1_exp_times(&one, &x, &zero, &out);
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
    lanes1_expm1(&x, &out);
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
    double m, e, factor, zero = 0, out, lift = kernel_normal(&x);
    lanes1_reduce(&x, &m, &e, &factor);
    e -= lift;
    m -= 1;
    lanes1_log_of(&m, &zero, &e, &out);
    return out;
}

static inline double kernel_log1p(double x) {
    if (!(x > -1 && x < 0x1p60) || x == 0)
        return x == 0 ? x : kernel_log(1 + x);
    double u = 1 + x, m, e, factor, f = x, low = 0, out;
    lanes1_reduce(&u, &m, &e, &factor);
    if (e != 0) {
        low = (x < 1 ? x - (u - 1) : 1 - (u - x)) * factor;
        f = m - 1;
    }
    lanes1_log_of(&f, &low, &e, &out);
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
    double m, e, factor, zero = 0, lh, ll, out, lift = kernel_normal(&x);
    lanes1_reduce(&x, &m, &e, &factor);
    e -= lift;
    m -= 1;
    lanes1_log_pair(&m, &zero, &e, &lh, &ll);
    /* beyond 2^100 all overflows or vanishes, and halves of the product would be infinite */
    const double exponent[2] = {y > 0x1p100 ? 0x1p100 : y < -0x1p100 ? -0x1p100 : y, 0};
    lanes1_power(&lh, &ll, exponent, 1, &out);
    return out;
}

#endif
