/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "dd.h"

#include <stdlib.h>

#include "kernel.h"

const dd dd_pi = {2 * 0x1.921fb54442d18p+0, 2 * 0x1.1a62633145c07p-54};

/* x near 700 in units of ln 2/64; adding and taking away rounds to a whole number. */
static double whole(double x) {
    const double big = 6755399441055744.0; /* 1.5 2^52 */
    double sum = x + big;
    return sum - big;
}

/* 2^e and the exponent of x > 0 from the words themselves, where libm takes as long as a product of
 * double-doubles; |e| <= PLAIN does for all but the ends of the range. */
enum { PLAIN = 1000 };

static double two_to(int e) {
    return kernel_value((uint64_t)(1023 + e) << 52);
}

static int exponent(double x) {
    return (int)(kernel_bits(x) >> 52) - 1022;
}

static fret_real scaled(fret_real x, int e) {
    return abs(e) <= PLAIN ? x * two_to(e) : ldexpl(x, e);
}

/* x = result 2^e, result in 0.5 .. 1; where x rounds to a power of 2, below 0.5 */
static fret_real mantissa(fret_real x, int *e) {
    *e = exponent((double)x);
    return abs(*e) <= PLAIN ? x * two_to(-*e) : frexpl(x, e);
}

/* c[0] + u c[step] + u^2 c[2 step] ... to double, even and odd terms side by side */
static inline double tail(const dd *c, int step, int pairs, double u) {
    double u2 = u * u, even = 0, odd = 0;
    for (int i = pairs - 1; i >= 0; i--) {
        even = c[2 * i * step].hi + u2 * even;
        odd = c[(2 * i + 1) * step].hi + u2 * odd;
    }
    return even + u * odd;
}

/* exp(r)-1, |r| <= ln 2/128: r^n/n! for n > 5 is below 2^-47 r and needs no second part. */
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
    double n = whole(x.hi * 92.332482616893656877);
    dd r = dd_sub(x, dd_mul_d(ln2_64, n));
    r = dd_add_d(r, -n * ln2_64_rest);
    int j = (int)n & 63;
    *e = ((int)n - j) / 64;
    dd two = power_of_two[j];
    return dd_extend(two, dd_mul(two, expm1_series(r)));
}

/* 2 atanh(s), |s| < 0.0040 */
static dd log_series(dd s) {
    dd s2 = dd_mul(s, s);
    dd p = dd_extend(inverse[5], dd_of(s2.hi * tail(inverse + 7, 2, 2, s2.hi)));
    p = dd_extend(inverse[3], dd_mul(s2, p));
    p = dd_extend(s, dd_mul(dd_mul(s, s2), p));
    return (dd){2 * p.hi, 2 * p.lo};
}

/* ln(m 2^e), 0.7 < m < 1.42: near a short C, ln m = ln C + 2 atanh((m-C)/(m+C)) */
static dd log_core(dd m, int e) {
    double j = whole(128 * m.hi), C = j / 128;
    dd l = log_series(dd_div(dd_add_d(m, -C), dd_add_d(m, C)));
    if (e == 0 && C == 1)
        return l;
    l = dd_add(l, log_128[(int)j - 90]);
    return dd_add(dd_add_d(dd_mul_d(ln2, e), e * ln2_rest), l);
}

static int normalise(dd *m, int e) { /* from 0.5 .. 1 */
    if (m->hi < 0.70710678118654752) {
        *m = (dd){2 * m->hi, 2 * m->lo};
        e--;
    }
    return e;
}

dd dd_exp(dd x) {
    int e;
    if (x.hi > 745 || x.hi < -745)
        return dd_of(x.hi > 0 ? INFINITY : 0);
    dd m = exp_core(x, &e);
    double half = two_to(e / 2), other = two_to(e - e / 2); /* 2^e may leave the range */
    return (dd){m.hi * half * other, m.lo * half * other};
}

dd dd_expm1(dd x) {
    return fabs(x.hi) < small_argument ? expm1_series(x) : dd_add_d(dd_exp(x), -1);
}

dd dd_log(dd x) {
    return dd_log_scaled(x, 0);
}

dd dd_log_scaled(dd x, int scale) {
    int e = exponent(x.hi);
    dd m;
    if (abs(e) <= PLAIN)
        m = (dd){x.hi * two_to(-e), x.lo * two_to(-e)};
    else {
        m.hi = frexp(x.hi, &e);
        m.lo = ldexp(x.lo, -e);
    }
    e = normalise(&m, e);
    return log_core(m, e + scale);
}

dd dd_log1p(dd x) {
    return fabs(x.hi) < small_argument ? log_series(dd_div(x, dd_add_d(x, 2))) : dd_log(dd_add_d(x, 1));
}

/* |x| <= pi/2, by sin x = 3 s - 4 s^3, s = sin(x/3) */
static dd sin_core(dd x) {
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

dd dd_sin_quarter(dd x) {
    return sin_core(dd_mul(x, half_pi));
}

/* Gamma(x) = exp(log)/rising: Stirling's series at 16 and more, reached by the rising factorial. */
static dd gamma_part(dd x, dd *rising) {
    *rising = dd_of(1);
    if (x.hi < 16) { /* x ... (x+15) in pairs: (x+j)(x+15-j) = x(x+15) + j(15-j) */
        dd w = dd_mul(x, dd_add_d(x, 15));
        dd part[8];
        for (int j = 0; j < 8; j++)
            part[j] = dd_add_d(w, j * (15 - j));
        for (int n = 4; n > 0; n /= 2) /* as a tree: products that do not wait for each other */
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
    dd l = dd_mul(dd_add_d(x, -0.5), dd_log(x));
    return dd_add(dd_add(dd_sub(l, x), half_log_2pi), p);
}

dd_scaled dd_gamma_quotient(const dd *over, int m, const dd *under, int n) {
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

/* ---- long double ------------------------------------------------------------------------------- */

static const fret_real negligible = 1e-40L; /* beside 1 */

fret_real dd_exp_real(dd x) {
    int e;
    if (!(fabs(x.hi) < 12000))
        return x.hi > 0 ? (fret_real)INFINITY : x.hi < 0 ? 0 : (fret_real)NAN;
    dd m = exp_core(x, &e);
    return scaled(dd_value(m), e);
}

dd dd_log_real(fret_real x) {
    int e;
    dd m = dd_from(mantissa(x, &e));
    e = normalise(&m, e);
    return log_core(m, e);
}

/* exp(r)-1, |r| <= ln 2/128 */
static fret_real expm1_short(fret_real r) {
    fret_real r2 = r * r, r4 = r2 * r2;
    fret_real low = r2 * (1 / 2.0L + r * (1 / 6.0L)) + r4 * (1 / 24.0L + r * (1 / 120.0L));
    return r + (low + r4 * r2 * (1 / 720.0L + r * (1 / 5040.0L + r * (1 / 40320.0L))));
}

/* Splits exp(x) = 2^e (two + rest). */
static int exp_short(fret_real x, double *two, fret_real *rest) {
    double n = whole((double)x * 92.332482616893656877);
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
    return scaled(two + rest, e);
}

fret_real fret_expm1(fret_real x) {
    double two;
    fret_real rest;
    if (fabsl(x) < 0.0054L)
        return expm1_short(x);
    if (!(fabsl(x) < 700))
        return fret_exp(x) - 1;
    int e = exp_short(x, &two, &rest);
    fret_real scale = scaled(1, e);
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
    fret_real m = mantissa(x, &e);
    if (m < 0.70710678118654752L) {
        m *= 2;
        e--;
    }
    double j = whole(128 * (double)m), C = j / 128;
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
    return x > 0 && isfinite(x) ? dd_value(dd_div(dd_log_real(x), ln_10)) : fret_log(x);
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
    return dd_exp_real(dd_mul(dd_log_real(x), dd_from(y)));
}

fret_real fret_ratio_pow(fret_real x, fret_real x0, fret_real y) {
    return dd_exp_real(dd_mul(dd_sub(dd_log_real(x), dd_log_real(x0)), dd_from(y)));
}

/* x = quarter (pi/2) + r, |r| <= pi/4 */
static dd reduce(fret_real x, int *quarter) {
    dd d = dd_from(x);
    double n = whole(d.hi * 0.63661977236758134308);
    *quarter = (int)fmod(n, 4) & 3;
    d = dd_sub(d, dd_mul_d(half_pi, n));
    return dd_add_d(d, -n * half_pi_rest);
}

static fret_real sin_of(fret_real x, int ahead) {
    int quarter;
    if (fabsl(x) < negligible)
        return ahead ? 1 : x;
    if (!(fabsl(x) < 1e12L)) /* reduced to 1e-35 up to here */
        return ahead ? cosl(x) : sinl(x);
    dd r = reduce(x, &quarter);
    quarter = (quarter + ahead) & 3;
    if (quarter & 1)
        r = dd_sub(half_pi, r.hi < 0 ? dd_neg(r) : r);
    fret_real s = dd_value(sin_core(r));
    return quarter & 2 ? -s : s;
}

fret_real fret_sin(fret_real x) {
    return sin_of(x, 0);
}

fret_real fret_cos(fret_real x) {
    return sin_of(x, 1);
}

/* One Newton step from the double result: its error is the square of that one's. */
fret_real fret_atan2(fret_real y, fret_real x) {
    fret_real about = atan2((double)y, (double)x);
    if (!(isfinite(x) && isfinite(y)) || about == 0)
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
        fret_real near = rintl(x), s = fret_sin(dd_value(dd_pi) * (x - near));
        if (x == near)
            return (fret_real)NAN;
        return dd_value(dd_pi) / ((fmodl(near, 2) != 0 ? -s : s) * fret_gamma(1 - x));
    }
    dd one = dd_from(x);
    dd_scaled q = dd_gamma_quotient(&one, 1, NULL, 0);
    return dd_exp_real(q.log) * dd_value(q.factor);
}

/* Gamma(x) = Gamma(1+x)/x keeps small arguments away from the pole. */
fret_real fret_beta(fret_real x, fret_real y) {
    dd a = dd_from(x), b = dd_from(y), c = dd_add(a, b);
    const dd over[] = {dd_add_d(a, 1), dd_add_d(b, 1)}, under[] = {dd_add_d(c, 1)};
    dd_scaled q = dd_gamma_quotient(over, 2, under, 1);
    return dd_exp_real(q.log) * dd_value(q.factor) * (x + y) / x / y;
}
