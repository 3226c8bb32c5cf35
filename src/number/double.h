/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Elementary functions of one double, as in libm: the same on every machine, by + - * / and whole-word
 * operations alone, no fused multiply-add (which -ffp-contract=off forbids). log, log1p and expm1 look up
 * most of the result, which vectors (lanes.h) cannot: shorter chains. Measured: 0.9 ulp, expm1 1.5 ulp. Not
 * installed. */
#ifndef FRET_NUMBER_DOUBLE_H
#define FRET_NUMBER_DOUBLE_H

#include "number/constants.h"
#define LANES 1
#include "number/lanes.h"

static inline double fret_double_exp(double x) {
    double one = 1, zero = 0, out;
    lanes1_exp_times(&one, &x, &zero, &out);
    return out;
}

/* exp(x) = high + tail, |x| < 700. */
static inline double double_exp_parts(double x, double *tail) {
    const double integer = 0x1.8p52; /* added, rounds, and leaves the number in the low bits */
    double shifted = x * 0x1.71547652b82fep+6 + integer, n = shifted - integer;
    double first = x - n * (double)ln2_64_short, rest = n * (double)ln2_64_left, r = first - rest, r2 = r * r;
    const dd *root = &power_of_two[fret_bits(shifted) & 63];
    const uint64_t exponent = fret_bits(shifted) >> 6 << 52;
    double high = fret_from_bits(fret_bits(root->hi) + exponent),
           scale = fret_from_bits(exponent + fret_bits(1));
    double p = first +
               (r2 * ((0.5 + r * (1 / 6.0)) + r2 * ((1 / 24.0 + r * (1 / 120.0)) + r2 * (1 / 720.0))) - rest);
    *tail = root->lo * scale + high * p;
    return high;
}

static inline double fret_double_expm1(double x) {
    if (!(x < 38)) /* e^x - 1 = e^x there; NaN */
        return fret_double_exp(x);
    if (x < -38)
        return -1;
    double tail;
    const double high = double_exp_parts(x, &tail);
    return (high - 1) + tail;
}

/* exp(x), |x| < 700: as fret_double_exp in a shorter chain. */
static inline double double_exp_near(double x) {
    double tail;
    const double high = double_exp_parts(x, &tail);
    return high + tail;
}

/* A number > 0 made normal: x = *x 2^-returned. */
FRET_INLINE double double_normal(double *x) {
    if (*x >= 0x1p-1022)
        return 0;
    *x *= 0x1p54;
    return 54;
}

/* e ln 2 + log(m + low), 0.7 < m < 1.42: near a short C, log m = log C + 2 atanh s, s = (m-C)/(m+C). */
static inline double double_log_near(double m, double low, double e) {
    const double integer = 0x1.8p45; /* added, rounds to multiples of 1/128 */
    double f = (m - 1) + low;
    if (e == 0 && fabs(f) < 1 / 64.0) { /* no logarithm of C hides the rounding of s */
        double s = f / (2 + f), w = s * s, half = 0.5 * f * f;
        return f - (half - s * (half + w * ((2 / 3.0 + w * (2 / 5.0)) + (w * w) * (2 / 7.0))));
    }
    double shifted = m + integer, C = shifted - integer, s = ((m - C) + low) / (m + C), w = s * s;
    const dd *near = &log_128[(fret_bits(shifted) & 0xff) - 90];
    double first = e * (double)ln2_short, sum = first + near->hi;
    double rest = ((first - sum) + near->hi) + (near->lo + e * (double)ln2_left);
    return sum + (2 * s + ((s * w) * (2 / 3.0 + w * (2 / 5.0)) + rest));
}

static inline double fret_double_log(double x) {
    if (!(x > 0 && x < (double)INFINITY))
        return x == 0 ? -(double)INFINITY : x > 0 ? x : (double)NAN;
    double m, e, factor, lift = double_normal(&x);
    lanes1_reduce(&x, &m, &e, &factor);
    return double_log_near(m, 0, e - lift);
}

static inline double fret_double_log1p(double x) {
    double u = 1 + x, low = x - (u - 1), m = u, e = 0, factor;
    if (!(x > -0.29 && x < 0.41)) {
        if (!(x > -1 && x < 0x1p60))
            return fret_double_log(u);
        lanes1_reduce(&u, &m, &e, &factor);
        low = (x < 1 ? low : 1 - (u - x)) * factor;
    }
    return double_log_near(m, low, e);
}

/* x^y for normal x > 0: 4e-16 (1 + |y ln x|); 0 below exp(-700), infinite above exp(700). Of the logarithm it
 * is the absolute error that counts: no case apart near 1, which would be hard to foresee. */
static inline double fret_double_power(double x, double y) {
    const double integer = 0x1.8p45;
    double m, e, factor;
    lanes1_reduce(&x, &m, &e, &factor);
    double shifted = m + integer, C = shifted - integer, s = (m - C) / (m + C), w = s * s;
    const dd *near = &log_128[(fret_bits(shifted) & 0xff) - 90];
    const double first = e * (double)ln2_short + near->hi,
                 rest = 2 * s + ((s * w) * (2 / 3.0 + w * (2 / 5.0)) + (near->lo + e * (double)ln2_left));
    const double l = y * (first + rest);
    if (!(fabs(l) < 700))
        return l > 0 ? (double)INFINITY : l < 0 ? 0 : (double)NAN;
    return double_exp_near(l);
}

#endif
