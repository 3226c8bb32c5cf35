/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Elementary functions of long double, the same digits from every compiler and C library: tables and short
 * series where these do, double-doubles where rounding would show. libm decides special arguments alone. */
#include "number/real.h"

#include <stdlib.h>

#include "number/bits.h"
#include "number/constants.h"
#include "number/dd.h"

static const fret_real negligible = 1e-40L; /* beside 1 */

/* exp(r)-1, |r| <= ln 2/128 */
static fret_real expm1_short(fret_real r) {
    fret_real r2 = r * r, r4 = r2 * r2;
    fret_real low = r2 * (1 / 2.0L + r * (1 / 6.0L)) + r4 * (1 / 24.0L + r * (1 / 120.0L));
    return r + (low + r4 * r2 * (1 / 720.0L + r * (1 / 5040.0L + r * (1 / 40320.0L))));
}

/* Splits exp(x) = 2^e (two + rest). */
static int exp_short(fret_real x, double *two, fret_real *rest) {
    double n = fret_whole((double)x * 92.332482616893656877);
    fret_real r = (x - (fret_real)n * ln2_64_short) - (fret_real)n * ln2_64_left;
    int j = (int)n & 63;
    fret_real p = expm1_short(r);
    *two = power_of_two[j].hi;
    *rest = *two * p + (power_of_two[j].lo + power_of_two[j].lo * p);
    return ((int)n - j) / 64;
}

fret_real fret_exp(fret_real x) {
    double two;
    fret_real rest;
    if (!(fabsl(x) < 12000))
        return x > 0 ? (fret_real)INFINITY : x < 0 ? 0 : (fret_real)NAN;
    int e = exp_short(x, &two, &rest);
    return fret_scaled(two + rest, e);
}

fret_real fret_expm1(fret_real x) {
    double two;
    fret_real rest;
    if (fabsl(x) < 0.0054L)
        return expm1_short(x);
    if (!(fabsl(x) < 700))
        return fret_exp(x) - 1;
    int e = exp_short(x, &two, &rest);
    fret_real scale = fret_scaled(1, e);
    return (two * scale - 1) + rest * scale;
}

/* 2 atanh(s), |s| < 0.0040 */
static fret_real log_short(fret_real s) {
    fret_real s2 = s * s, s4 = s2 * s2;
    return 2 * s + 2 * s * s2 * ((1 / 3.0L + s2 * (1 / 5.0L)) + s4 * (1 / 7.0L + s2 * (1 / 9.0L)));
}

/* ln(x + part), part below the last place of x */
static fret_real log_of(fret_real x, fret_real part) {
    int e;
    fret_real m = fret_mantissa(x, &e);
    if (m < 0.70710678118654752L) {
        m *= 2;
        e--;
    }
    double j = fret_whole(128 * (double)m), C = j / 128;
    fret_real l = log_short((m - C) / (m + C)) + part / x;
    if (e == 0 && C == 1)
        return l;
    const dd *near = &log_128[(int)j - 90];
    return (e * ln2_short + near->hi) + (l + (e * ln2_left + near->lo));
}

fret_real fret_log(fret_real x) {
    if (!(x > 0) || isinf(x))
        return x > 0 ? x : x < 0 || isnan(x) ? (fret_real)NAN : -(fret_real)INFINITY;
    return log_of(x, 0);
}

fret_real fret_log10(fret_real x) {
    static const dd ln_10 = {0x1.26bb1bbb55516p+1, -0x1.f48ad494ea3e9p-53};
    return x > 0 && isfinite(x) ? dd_value(dd_div(fret_dd_log_real(x), ln_10)) : fret_log(x);
}

fret_real fret_log1p(fret_real x) {
    if (fabsl(x) < 0.0078L)
        return log_short(x / (2 + x));
    fret_real u = 1 + x;
    if (!(u > 0) || isinf(u))
        return fret_log(u);
    return log_of(u, fabsl(x) < 1 ? x - (u - 1) : 1 - (u - x));
}

fret_real fret_pow(fret_real x, fret_real y) {
    if (y == 0 || x == 1)
        return 1;
    if (isnan(x) || isnan(y) || isinf(y))
        return powl(x, y);
    if (x < 0) {
        fret_real whole_y = floorl(y);
        if (whole_y != y)
            return (fret_real)NAN;
        return fmodl(y, 2) != 0 ? -fret_pow(-x, y) : fret_pow(-x, y);
    }
    if (x == 0 || isinf(x))
        return (x == 0) == (y > 0) ? 0 : (fret_real)INFINITY;
    if (fabsl(y) > 1e25L)
        return (x > 1) == (y > 0) ? (fret_real)INFINITY : 0;
    fret_real l = y * log_of(x, 0);
    if (fabsl(l) < 2) /* beyond, the rounding of l would show */
        return fret_exp(l);
    return fret_dd_exp_real(dd_mul(fret_dd_log_real(x), dd_from(y)));
}

fret_real fret_ratio_pow(fret_real x, fret_real x0, fret_real y) {
    return fret_dd_exp_real(dd_mul(dd_sub(fret_dd_log_real(x), fret_dd_log_real(x0)), dd_from(y)));
}

/* x = quarter (pi/2) + r, |r| <= pi/4 */
static dd reduce(fret_real x, int *quarter) {
    dd d = dd_from(x);
    double n = fret_whole(d.hi * 0.63661977236758134308);
    *quarter = (int)fmod(n, 4) & 3;
    d = dd_sub(d, dd_mul_d(half_pi, n));
    return dd_add_d(d, -n * half_pi_rest);
}

/* sin(r + rest) and cos(r + rest), |r| <= pi/4, rest no more than a rounding: series, whose last terms need
 * no more than a double. */
static fret_real sin_short(fret_real r, fret_real rest) {
    const fret_real r2 = r * r;
    const double z = (double)r2, z2 = z * z;
    const double tail = (1 / 362880.0 - z * (1 / 39916800.0)) +
                        z2 * ((1 / 6227020800.0 - z * (1 / 1307674368000.0)) +
                              z2 * (1 / 355687428096000.0 - z * (1 / 121645100408832000.0)));
    return r + (rest - r * r2 * (1 / 6.0L - r2 * (1 / 120.0L - r2 * (1 / 5040.0L - r2 * tail))));
}

static fret_real cos_short(fret_real r, fret_real rest) {
    const fret_real r2 = r * r;
    const double z = (double)r2, z2 = z * z;
    const double tail = (1 / 40320.0 - z * (1 / 3628800.0)) +
                        z2 * ((1 / 479001600.0 - z * (1 / 87178291200.0)) +
                              z2 * (1 / 20922789888000.0 - z * (1 / 6402373705728000.0)));
    const fret_real big = 0x1.8p31L, head = (r + big) - big, left = r - head; /* its square is exact */
    const fret_real half = head * head / 2, most = 1 - half;
    return most + (((1 - most) - half) - ((left * (r + head) / 2 + r * rest) -
                                          r2 * r2 * (1 / 24.0L - r2 * (1 / 720.0L - r2 * tail))));
}

static fret_real sin_of(fret_real x, int ahead) {
    int quarter;
    if (fabsl(x) < negligible)
        return ahead ? 1 : x;
    if (!(fabsl(x) < 1e12L)) /* reduced to 1e-35 up to here */
        return ahead ? cosl(x) : sinl(x);
    dd r = reduce(x, &quarter);
    quarter = (quarter + ahead) & 3;
    const fret_real near = dd_value(r), rest = (r.hi - near) + r.lo;
    const fret_real s = quarter & 1 ? cos_short(near, rest) : sin_short(near, rest);
    return quarter & 2 ? -s : s;
}

fret_real fret_sin(fret_real x) {
    return sin_of(x, 0);
}

fret_real fret_cos(fret_real x) {
    return sin_of(x, 1);
}

/* One step from a result to 24 bits, in which C libraries do not differ: its error is the cube of that one's.
 */
fret_real fret_atan2(fret_real y, fret_real x) {
    const fret_real about = (float)atan2((double)y, (double)x);
    if (!(isfinite(x) && isfinite(y)) || fabsl(about) < 1e-30L)
        return atan2l(y, x);
    fret_real s = fret_sin(about), c = fret_cos(about);
    dd Y = dd_from(y), X = dd_from(x), S = dd_from(s), C = dd_from(c);
    dd turn = dd_sub(dd_mul(Y, C), dd_mul(X, S)), along = dd_add(dd_mul(X, C), dd_mul(Y, S));
    return about + (fret_real)(turn.hi / along.hi);
}

fret_real fret_gamma(fret_real x) {
    if (isnan(x) || x > 1760 || x == -(fret_real)INFINITY)
        return x > 0 ? (fret_real)INFINITY : (fret_real)NAN;
    if (x < 0.5L) {
        if (x > -0.5L)
            return fret_gamma(1 + x) / x;
        fret_real near = rintl(x), s = fret_sin(dd_value(fret_dd_pi) * (x - near));
        if (x == near)
            return (fret_real)NAN;
        return dd_value(fret_dd_pi) / ((fmodl(near, 2) != 0 ? -s : s) * fret_gamma(1 - x));
    }
    dd one = dd_from(x);
    dd_scaled q = fret_dd_gamma_quotient(&one, 1, NULL, 0);
    return fret_dd_exp_real(q.log) * dd_value(q.factor);
}

/* Gamma(x) = Gamma(1+x)/x keeps small arguments away from the pole. */
fret_real fret_beta(fret_real x, fret_real y) {
    dd a = dd_from(x), b = dd_from(y), c = dd_add(a, b);
    const dd over[] = {dd_add_d(a, 1), dd_add_d(b, 1)}, under[] = {dd_add_d(c, 1)};
    dd_scaled q = fret_dd_gamma_quotient(over, 2, under, 1);
    return fret_dd_exp_real(q.log) * dd_value(q.factor) * (x + y) / x / y;
}
