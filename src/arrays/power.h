/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Logarithms, exponentials and powers in double, in a form that compilers vectorise: + - * / and integer
 * operations, no libm, no branch, no fused multiply-add, so that all instruction sets give the same bits. Not
 * installed. */
#ifndef FRET_ARRAYS_POWER_H
#define FRET_ARRAYS_POWER_H

#include "number/bits.h"

#define ONE 0x3ff0000000000000u
#define INTEGER 0x1.8p52              /* added to |x| < 2^51, rounds x and leaves it in the low bits */
#define LN2_HIGH 0x1.62e42fefa3800p-1 /* 42 bits: its product with an exponent is exact */
#define LN2_LOW 0x1.ef35793c76730p-45

/* holds ? a : b, by bits, since a branch would prevent vectors. */
FRET_INLINE double choose(bool holds, double a, double b) {
    const uint64_t mask = -(uint64_t)holds;
    return fret_from_bits((fret_bits(a) & mask) | (fret_bits(b) & ~mask));
}

/* The leading 26 bits: the product of two such numbers is exact. */
FRET_INLINE double head(double x) {
    return fret_from_bits(fret_bits(x) & 0xfffffffff8000000u);
}

/* high + low, an unevaluated sum. */
typedef struct two {
    double high, low;
} two;

/* a b to 2^-104. */
FRET_INLINE two product(double a, double b) {
    const double ah = head(a), al = a - ah, bh = head(b), bl = b - bh, p = a * b;
    return (two){p, (((ah * bh - p) + ah * bl) + al * bh) + al * bl};
}

/* x = m 2^e with m in [sqrt(1/2), sqrt(2)), x > 0 normal; factor = 2^-e. */
typedef struct reduced {
    double m, e, factor;
} reduced;
FRET_INLINE reduced reduce(double x) {
    const uint64_t shifted = fret_bits(x) + (ONE - 0x3fe6a09e667f3bcdu),
                   exponent = (shifted & 0xfff0000000000000u) - ONE;
    return (reduced){fret_from_bits(fret_bits(x) - exponent),
                     fret_from_bits((shifted >> 52) | 0x4330000000000000u) - (0x1p52 + 1023),
                     fret_from_bits(ONE - exponent)};
}

/* e ln 2 + log(1+f+low), sqrt(1/2) <= 1+f <= sqrt(2), |low| <= ulp(f), to 2^-66: with z = f/(2+f), log(1+f) =
 * 2 atanh z = 2z + 2 z^3 (1/3 + z^2 P), each factor cut so that products of leading halves are exact. */
FRET_INLINE two log_of(double f, double low, double e) {
    const double d = 2.0 + f, z = f / d, zh = head(z), dh = head(d), dl = (f - (dh - 2.0)) + low,
                 zl = (((f - zh * dh) - zh * dl) + low) * (0.5 - 0.5 * z), /* 1/(2+f) = (1-z)/2 */
        square = zh * zh, square_low = zl * (zh + z), w = z * z, w2 = w * w,
                 tail = w * (((0x1.999999999999ap-3 + w * 0x1.2492492492523p-3) +
                              w2 * (0x1.c71c71c6ea3a7p-4 + w * 0x1.745d177ae7ca4p-4)) +
                             (w2 * w2) * ((0x1.3b1395b312af8p-4 + w * 0x1.1118cdef60706p-4) +
                                          w2 * (0x1.df7b9e38d150dp-5 + w * 0x1.e039c40bcc6e0p-5))),
                 c = 0x1.5555555555555p-2 + tail, ch = head(c),
                 cl = ((0x1.5555555555555p-2 - ch) + tail) + 0x1.5555555555555p-56, sh = head(square),
                 cube = zh * sh, cube_low = zh * ((square - sh) + square_low) + zl * w, qh = head(cube),
                 ql = (cube - qh) + cube_low, v = qh * ch, vl = qh * cl + ql * c, sum = zh + v,
                 small = ((zh - sum) + v) + (zl + vl), first = e * LN2_HIGH,
                 total = first + 2.0 * sum, /* |first| > |2 sum| or e = 0 */
        rest = ((first - total) + 2.0 * sum) + (2.0 * small + e * LN2_LOW), high = total + rest;
    return (two){high, (total - high) + rest};
}

/* exp(x+low) = 2^k (1+p), |x| < 1420, |low| <= ulp(x); k is an integer. */
typedef struct exponential {
    double k, p;
} exponential;
FRET_INLINE exponential exp_of(double x, double low) {
    const double n = (x * 0x1.71547652b82fep+0 + INTEGER) - INTEGER, rh = x - n * LN2_HIGH,
                 rl = low - n * LN2_LOW, r = rh + rl, r2 = r * r, r4 = r2 * r2,
                 q = (((0.5 + r * 0x1.5555555555559p-3) +
                       r2 * (0x1.555555555555ap-5 + r * 0x1.111111110f6afp-7)) +
                      r4 * ((0x1.6c16c16c14470p-10 + r * 0x1.a01a01afe52d1p-13) +
                            r2 * (0x1.a01a01b0ae7c3p-16 + r * 0x1.71ddf8538c8d5p-19))) +
                     (r4 * r4) *
                         ((0x1.27e4c5b0f91b8p-22 + r * 0x1.af5ebf270a614p-26) + r2 * 0x1.1f954d1e3e439p-29);
    return (exponential){n, r + (((rh - r) + rl) + r2 * q)};
}

/* 2^k, -1022 <= k <= 1023. */
FRET_INLINE double two_to(double k) {
    return fret_from_bits((fret_bits(k + INTEGER) << 52) + ONE);
}

/* exp(x)-1, |x| < 700. */
FRET_INLINE double exp_less_1(double x) {
    const exponential e = exp_of(x, 0);
    const double f = two_to(e.k);
    return f * e.p + (f - 1.0);
}

/* factor b^(y[0]+y[1]), factor > 0, from log b; over- or underflows only where the result does. */
FRET_INLINE double power(two log, const double y[2], double factor) {
    const two x = product(log.high, y[0]);
    const double low = x.low + (log.high * y[1] + log.low * y[0]),
                 cut = choose(x.high < -1416.0, -1416.0, choose(x.high > 1416.0, 1416.0, x.high));
    const exponential e = exp_of(cut, choose(cut == x.high, low, 0));
    const double k1 = (0.5 * e.k + INTEGER) - INTEGER;
    return (((1.0 + e.p) * two_to(k1)) * factor) * two_to(e.k - k1);
}

#endif
