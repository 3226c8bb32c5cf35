/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Elementary functions of double-doubles: a table near the argument, then a short series. Of libm uses the
 * ends of range of log, ldexp and frexp. */
#include "number/dd.h"

#include <float.h>
#include <stdlib.h>

#include "number/bits.h"
#include "number/constants.h"

/* c[0] + u c[step] + u^2 c[2 step] ... to double precision, even and odd terms as independent sums. */
static inline double tail(const dd *c, int step, int pairs, double u) {
    double u2 = u * u, even = 0, odd = 0;
    for (int i = pairs - 1; i >= 0; i--) {
        even = c[2 * i * step].hi + u2 * even;
        odd = c[(2 * i + 1) * step].hi + u2 * odd;
    }
    return even + u * odd;
}

/* exp(r)-1, |r| <= ln 2/128: terms r^n/n! with n > 5 are below 2^-47 r, so that double will do. */
static dd expm1_series(dd r) {
    const dd *c = inverse_factorial;
    dd r2 = dd_mul(r, r),
       p = dd_extend(c[4], dd_mul(r, dd_extend(c[5], dd_of(r.hi * tail(c + 6, 1, 4, r.hi)))));
    p = dd_extend(dd_extend(c[2], dd_mul(r, c[3])), dd_mul(r2, p));
    return dd_extend(r, dd_mul(r2, p));
}

static const double small_argument = 0.0054;

/* exp(x) = result 2^e */
static dd exp_core(dd x, int *e) {
    double n = fret_whole(x.hi * 92.332482616893656877);
    dd r = dd_sub(x, dd_mul_d(ln2_64, n));
    r = dd_add_d(r, -n * ln2_64_rest);
    int j = (int)n & 63;
    *e = ((int)n - j) / 64;
    dd two = power_of_two[j];
    return dd_extend(two, dd_mul(two, expm1_series(r)));
}

/* 2 atanh(s) = 2 (s + s^3/3 + ...), |s| < 0.0040 */
static dd log_series(dd s) {
    dd s2 = dd_mul(s, s);
    dd p = dd_extend(inverse[5], dd_of(s2.hi * tail(inverse + 7, 2, 2, s2.hi)));
    p = dd_extend(inverse[3], dd_mul(s2, p));
    p = dd_extend(s, dd_mul(dd_mul(s, s2), p));
    return (dd){2 * p.hi, 2 * p.lo};
}

/* ln(m 2^e), 0.7 < m < 1.42, by ln m = ln C + 2 atanh((m-C)/(m+C)) with C = j/128 near m. */
static dd log_core(dd m, int e) {
    double j = fret_whole(128 * m.hi), C = j / 128;
    dd l = log_series(dd_div(dd_add_d(m, -C), dd_add_d(m, C)));
    if (e == 0 && C == 1)
        return l;
    l = dd_add(l, log_128[(int)j - 90]);
    return dd_add(dd_add_d(dd_mul_d(ln2, e), e * ln2_rest), l);
}

static int normalise(dd *m, int e) { /* from 0.5 .. 1 to 0.71 .. 1.41 */
    if (m->hi < 0.70710678118654752) {
        *m = (dd){2 * m->hi, 2 * m->lo};
        e--;
    }
    return e;
}

dd fret_dd_exp(dd x) {
    int e;
    if (!(fabs(x.hi) <= 745))
        return dd_of(x.hi > 0 ? INFINITY : x.hi < 0 ? 0 : NAN);
    dd m = exp_core(x, &e);
    double half = fret_two_to(e / 2), other = fret_two_to(e - e / 2); /* 2^e may overflow or underflow */
    return (dd){m.hi * half * other, m.lo * half * other};
}

dd fret_dd_expm1(dd x) {
    return fabs(x.hi) < small_argument ? expm1_series(x) : dd_add_d(fret_dd_exp(x), -1);
}

dd fret_dd_log(dd x) {
    return fret_dd_log_scaled(x, 0);
}

dd fret_dd_log_scaled(dd x, int scale) {
    if (!(x.hi > 0 && x.hi <= DBL_MAX))
        return dd_of(log(x.hi));
    int e = fret_exponent(x.hi);
    dd m;
    if (abs(e) <= FRET_PLAIN)
        m = (dd){x.hi * fret_two_to(-e), x.lo * fret_two_to(-e)};
    else {
        m.hi = frexp(x.hi, &e);
        m.lo = ldexp(x.lo, -e);
    }
    e = normalise(&m, e);
    return log_core(m, e + scale);
}

dd fret_dd_log1p(dd x) {
    return fabs(x.hi) < small_argument ? log_series(dd_div(x, dd_add_d(x, 2))) : fret_dd_log(dd_add_d(x, 1));
}

/* sin x, |x| <= pi/2, by sin x = 3 s - 4 s^3, s = sin(x/3). */
static dd sine(dd x) {
    const dd *c = inverse_factorial;
    dd y = dd_div(x, dd_of(3)), y2 = dd_mul(y, y);
    dd y4 = dd_mul(y2, y2),
       p = dd_extend(c[11], dd_neg(dd_mul(y2, dd_extend(c[13], dd_of(-y2.hi * tail(c + 15, 2, 3, -y2.hi))))));
    p = dd_extend(dd_extend(c[7], dd_neg(dd_mul(y2, c[9]))), dd_mul(y4, p));
    p = dd_extend(dd_extend(c[3], dd_neg(dd_mul(y2, c[5]))), dd_mul(y4, p));
    dd s = dd_extend(y, dd_neg(dd_mul(dd_mul(y, y2), p)));
    dd s2 = dd_mul(s, s);
    return dd_mul(s, dd_sub(dd_of(3), (dd){4 * s2.hi, 4 * s2.lo}));
}

dd fret_dd_sin_quarter(dd x) {
    return sine(dd_mul(x, half_pi));
}

/* Gamma(x) = exp(result)/rising: Stirling's series, if x < 16 at x+16 with the factor x ... (x+15). */
static dd gamma_part(dd x, dd *rising) {
    *rising = dd_of(1);
    if (x.hi < 16) { /* in pairs: (x+j)(x+15-j) = x(x+15) + j(15-j) */
        dd w = dd_mul(x, dd_add_d(x, 15));
        dd part[8];
        for (int j = 0; j < 8; j++)
            part[j] = dd_add_d(w, j * (15 - j));
        for (int n = 4; n > 0; n /= 2) /* as a tree, so that products are independent */
            for (int j = 0; j < n; j++)
                part[j] = dd_mul(part[j], part[j + n]);
        *rising = part[0];
        x = dd_add_d(x, 16);
    }
    dd z = dd_div(dd_of(1), x), z2 = dd_mul(z, z);
    double u = z2.hi, rest = stirling[3].hi + u * tail(stirling + 4, 1, 6, u);
    dd p = dd_extend(stirling[2], dd_of(u * rest));
    p = dd_extend(stirling[1], dd_mul(z2, p));
    p = dd_mul(z, dd_extend(stirling[0], dd_mul(z2, p)));
    dd l = dd_mul(dd_add_d(x, -0.5), fret_dd_log(x));
    return dd_add(dd_add(dd_sub(l, x), half_log_2pi), p);
}

dd_scaled fret_dd_gamma_quotient(const dd *over, int m, const dd *under, int n) {
    dd_scaled q = {dd_of(1), dd_of(0)};
    dd top = dd_of(1), bottom = dd_of(1), rising, log;
    for (int i = 0; i < m; i++) {
        q.log = dd_add(q.log, gamma_part(over[i], &rising));
        bottom = dd_mul(bottom, rising);
    }
    for (int i = 0; i < n; i++) {
        if (i == 0 || under[i].hi != under[i - 1].hi || under[i].lo != under[i - 1].lo)
            log = gamma_part(under[i], &rising);
        q.log = dd_sub(q.log, log);
        top = dd_mul(top, rising);
    }
    q.factor = dd_div(top, bottom);
    return q;
}

fret_real fret_dd_exp_real(dd x) {
    int e;
    if (!(fabs(x.hi) < 12000))
        return x.hi > 0 ? (fret_real)INFINITY : x.hi < 0 ? 0 : (fret_real)NAN;
    dd m = exp_core(x, &e);
    return fret_scaled(dd_value(m), e);
}

dd fret_dd_log_real(fret_real x) {
    int e;
    if (!(x > 0 && x <= LDBL_MAX))
        return dd_of(log((double)x));
    dd m = dd_from(fret_mantissa(x, &e));
    e = normalise(&m, e);
    return log_core(m, e);
}
