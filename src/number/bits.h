/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Bits, exponents and rounding of doubles by integer operations, where calls of libm take as long as a
 * product of double-doubles. Assumes rounding to nearest. Not installed. */
#ifndef FRET_NUMBER_BITS_H
#define FRET_NUMBER_BITS_H

#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "fret/base.h"

/* Inlined even without optimisation, for the caller's instruction set. Coverage builds count each branch
 * once. */
#ifndef FRET_INLINE
#define FRET_INLINE static inline __attribute__((always_inline))
#endif

FRET_INLINE uint64_t fret_bits(double x) {
    uint64_t u;
    memcpy(&u, &x, sizeof u);
    return u;
}

FRET_INLINE double fret_from_bits(uint64_t u) {
    double x;
    memcpy(&x, &u, sizeof x);
    return x;
}

/* |x| < 2^51 rounded to an integer: adding 1.5 2^52 leaves no bits for a fraction. */
static inline double fret_whole(double x) {
    const double big = 6755399441055744.0;
    double sum = x + big;
    return sum - big;
}

/* 2^e, and the e of x = m 2^e, 0.5 <= m < 1, x normal; |e| <= FRET_PLAIN avoids the ends of the range. */
enum { FRET_PLAIN = 1000 };

static inline double fret_two_to(int e) {
    return fret_from_bits((uint64_t)(1023 + e) << 52);
}

static inline int fret_exponent(double x) {
    return (int)(fret_bits(x) >> 52) - 1022;
}

static inline fret_real fret_scaled(fret_real x, int e) {
    return abs(e) <= FRET_PLAIN ? x * fret_two_to(e) : ldexpl(x, e);
}

/* x = result 2^e, 0.5 <= result < 1, or just below 0.5 if x rounds to a power of 2. */
static inline fret_real fret_mantissa(fret_real x, int *e) {
    *e = fret_exponent((double)x);
    return abs(*e) <= FRET_PLAIN ? x * fret_two_to(-*e) : frexpl(x, e);
}

#endif
