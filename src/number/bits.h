/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Numbers by their words: bits, exponents, rounding to whole numbers, where libm's calls take as long as a
 * product of double-doubles. Rounding to nearest is assumed. Not installed. */
#ifndef FRET_NUMBER_BITS_H
#define FRET_NUMBER_BITS_H

#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "fret/base.h"

/* Inlined also without optimisation: the caller's instruction set applies. Who counts branches has them once.
 */
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

/* |x| < 2^51 rounded to a whole number: by adding and taking away. */
static inline double fret_whole(double x) {
    const double big = 6755399441055744.0; /* 1.5 2^52 */
    double sum = x + big;
    return sum - big;
}

/* 2^e and the exponent of x > 0; |e| <= FRET_PLAIN does for all but the ends of the range. */
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

/* x = result 2^e, result in 0.5 .. 1; where x rounds to a power of 2, below 0.5 */
static inline fret_real fret_mantissa(fret_real x, int *e) {
    *e = fret_exponent((double)x);
    return abs(*e) <= FRET_PLAIN ? x * fret_two_to(-*e) : frexpl(x, e);
}

#endif
