/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The elementary functions of lanes.h: included by that alone. + - * / and whole-word
 * operations, no libm, no fused multiply-add.
 * Wants V (a vector of doubles), U (as many 64-bit words), M (what comparisons give), BITS and VALUE
 * between V and U, SELECT(mask, yes, no) and NAMED(name). Arguments go by address: vectors wider
 * than the target's registers have no stable calling convention. */

#define ONE 0x3ff0000000000000u
#define INTEGER 0x1.8p52 /* added to |x| < 2^51, rounds it and leaves it in the low bits */

/* x = m 2^e with m in [sqrt(1/2), sqrt(2)), x > 0 normal; factor = 2^-e. */
FRET_INLINE void NAMED(reduce)(const V *x, V *m, V *e, V *factor) {
    U shifted = BITS(*x) + (ONE - 0x3fe6a09e667f3bcdu);
    U exponent = (shifted & 0xfff0000000000000u) - ONE;
    *m = VALUE(BITS(*x) - exponent);
    *factor = VALUE(ONE - exponent);
    *e = VALUE((shifted >> 52) | 0x4330000000000000u) - (0x1p52 + 1023);
}

#define LN2_HIGH 0x1.62e42fefa3800p-1 /* 42 bits: its product with an exponent is exact */
#define LN2_LOW 0x1.ef35793c76730p-45

/* e ln 2 + log(1+f+low), sqrt(1/2) <= 1+f <= sqrt(2), |low| <= ulp(f): 0.7 ulp while e = 0, else 1 ulp.
 * With z = f/(2+f), log(1+f) = 2 atanh z = f - f^2/2 + z (f^2/2 + R), R = 2 z^2/3 + 2 z^4/5 + ... */
FRET_INLINE void NAMED(log_of)(const V *f, const V *low, const V *e, V *out) {
    V x = *f, z = x / (2.0 + x), half = 0.5 * x * x, w = z * z, w2 = w * w;
    V r = ((0x1.5555555555558p-1 + w * 0x1.9999999995224p-2) +
           w2 * (0x1.2492492e03e05p-2 + w * 0x1.c71c62d0402aep-3)) +
          (w2 * w2) * ((0x1.7462ba27c8794p-3 + w * 0x1.39fdb949c5e05p-3) + w2 * 0x1.2b5fbed6295a5p-3);
    V rest = (z * half + (*e * LN2_LOW + (*low - *low * x))) + (z * w) * r;
    *out = *e * LN2_HIGH - ((half - rest) - x);
}

/* exp(x+low) = 2^k (1+p), |x| < 1420, |low| <= ulp(x); k is returned as a number. */
FRET_INLINE void NAMED(exp_of)(const V *x, const V *low, V *k, V *p) {
    V n = (*x * 0x1.71547652b82fep+0 + INTEGER) - INTEGER;
    V rh = *x - n * LN2_HIGH, rl = *low - n * LN2_LOW, r = rh + rl;
    V r2 = r * r, r4 = r2 * r2;
    V q = (((0.5 + r * 0x1.5555555555559p-3) + r2 * (0x1.555555555555ap-5 + r * 0x1.111111110f6afp-7)) +
           r4 * ((0x1.6c16c16c14470p-10 + r * 0x1.a01a01afe52d1p-13) +
                 r2 * (0x1.a01a01b0ae7c3p-16 + r * 0x1.71ddf8538c8d5p-19))) +
          (r4 * r4) * ((0x1.27e4c5b0f91b8p-22 + r * 0x1.af5ebf270a614p-26) + r2 * 0x1.1f954d1e3e439p-29);
    *p = r + (((rh - r) + rl) + r2 * q);
    *k = n;
}

/* 2^k, -1022 <= k <= 1023. */
FRET_INLINE void NAMED(two_to)(const V *k, V *out) {
    *out = VALUE((BITS(*k + INTEGER) << 52) + ONE);
}

/* factor exp(x+low), factor > 0; NaN of NaN. Over- or underflows only where the result does. */
FRET_INLINE void NAMED(exp_times)(const V *factor, const V *x, const V *low, V *out) {
    V h = SELECT(*x < -1416.0, (V){0} - 1416.0, *x), k, p, f1, f2;
    h = SELECT(h > 1416.0, (V){0} + 1416.0, h);
    V l = SELECT(h == *x, *low, (V){0});
    NAMED(exp_of)(&h, &l, &k, &p);
    V k1 = (0.5 * k + INTEGER) - INTEGER, k2 = k - k1;
    NAMED(two_to)(&k1, &f1);
    NAMED(two_to)(&k2, &f2);
    *out = (((1.0 + p) * f1) * *factor) * f2;
}

#undef ONE
#undef INTEGER
#undef LN2_HIGH
#undef LN2_LOW
