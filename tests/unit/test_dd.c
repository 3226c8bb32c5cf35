/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Double-double functions against 80-digit values; the long double ones against those of the C library. */
#include "number/dd.h"
#include "number/real.h"

#include "unit.h"

#include "number/double.h"
#include "number/powers.h"

typedef dd dd_function(dd x);

static dd gamma_of(dd x) {
    dd_scaled q = fret_dd_gamma_quotient(&x, 1, NULL, 0);
    return dd_mul(q.factor, fret_dd_exp(q.log));
}

static const struct {
    const char *name;
    dd_function *f;
    fret_real tolerance; /* absolute part of the exponent of exp and gamma: |x| 2^-105 */
} functions[] = {
    {"exp", fret_dd_exp, 2e-29L},     {"expm1", fret_dd_expm1, 2e-29L},     {"log", fret_dd_log, 2e-31L},
    {"log1p", fret_dd_log1p, 2e-30L}, {"sin", fret_dd_sin_quarter, 1e-31L}, {"gamma", gamma_of, 5e-28L},
};

static void reference(void) {
    unit_table t;
    int seen[6] = {0};
    if (!unit_open(&t, "dd.csv"))
        return;
    while (unit_row(&t))
        for (int i = 0; i < 6; i++) {
            if (strcmp(t.cell[0], functions[i].name) != 0)
                continue;
            dd x = {unit_input(&t, 1), unit_input(&t, 2)}, got = functions[i].f(x);
            fret_real hi = unit_input(&t, 3), error = (got.hi - hi) + (got.lo - unit_input(&t, 4));
            error -= unit_input(&t, 5);
            CHECK_ABS(error / (hi != 0 ? hi : 1), 0, 1, functions[i].tolerance);
            seen[i]++;
        }
    for (int i = 0; i < 6; i++)
        CHECK(seen[i] > 100);
}

/* Products and quotients come back; sums keep what one double would lose. */
static void arithmetic(void) {
    unsigned long long seed = 1;
    for (int i = 0; i < 1000; i++) {
        dd a = {unit_random(&seed, 0.5, 2), unit_random(&seed, -5e-17, 5e-17)};
        dd b = {unit_random(&seed, 0.5, 2), unit_random(&seed, -5e-17, 5e-17)};
        dd back = dd_sub(dd_div(dd_mul(a, b), b), a), root = dd_sub(dd_mul(dd_sqrt(a), dd_sqrt(a)), a);
        CHECK_ABS(back.hi, 0, 1, 1e-30L);
        CHECK_ABS(root.hi, 0, 1, 1e-30L);
        dd sum = dd_sub(dd_add(a, dd_of(1e10)), dd_of(1e10));
        CHECK_ABS(dd_sub(sum, a).hi, 0, 1, 1e-21L);
        CHECK(dd_add(a, dd_neg(a)).hi == 0);
        fret_real wide = dd_value(a) / 3;
        CHECK(dd_value(dd_from(wide)) == wide);
        dd third = dd_div(a, dd_of(3));
        CHECK_ABS(dd_sub(dd_from2(dd_value(third), dd_rest(third)), third).hi, 0, 1, 1e-31L);
    }
}

/* Two ulps of 64 bits; libm's own may be one off. */
static void long_double(void) {
    const fret_real tol = UNIT_TOL(2.5e-19L, 5e-16L);
    unsigned long long seed = 2;
    for (int i = 0; i < 20000; i++) {
        fret_real x = unit_random(&seed, -1, 1) * powl(10, (fret_real)unit_random(&seed, -25, 3));
        fret_real y = unit_random(&seed, -3, 3), positive = fabsl(x);
        CHECK_REL(fret_exp(x), expl(x), tol);
        CHECK_REL(fret_expm1(x), expm1l(x), tol);
        CHECK_REL(fret_log(positive), logl(positive), tol);
        CHECK_REL(fret_log1p(positive), log1pl(positive), tol);
        CHECK_REL(fret_log1p(x / 1001), log1pl(x / 1001), tol);
        CHECK_REL(fret_pow(positive, y), powl(positive, y), tol);
        CHECK_REL(fret_pow(positive, 40 * y), powl(positive, 40 * y), tol);
        CHECK_REL(fret_ratio_pow(positive, 3, y), powl(positive / 3, y), 2 * tol);
        CHECK_ABS(fret_sin(x), sinl(x), 1, tol);
        CHECK_ABS(fret_cos(x), cosl(x), 1, tol);
        CHECK_REL(fret_atan2(x, y), atan2l(x, y), tol);
        if (positive > 1e-10L && positive < 30)
            CHECK_REL(fret_gamma(positive), tgammal(positive), 20 * tol);
    }
}

static void limits(void) {
    const fret_real inf = INFINITY;
    CHECK(fret_exp(-inf) == 0 && fret_exp(inf) == inf && fret_exp(0) == 1 && isnan(fret_exp(NAN)));
    CHECK(fret_log(0) == -inf && fret_log(inf) == inf && isnan(fret_log(-1)) && fret_log(1) == 0);
    CHECK(fret_log1p(-1) == -inf && isnan(fret_log1p(-2)) && fret_expm1(-inf) == -1);
    CHECK(fret_pow(0, 2) == 0 && fret_pow(0, -2) == inf && fret_pow(0, 0) == 1 && fret_pow(5, 0) == 1);
    CHECK(fret_pow(-2, 3) == -8 && fret_pow(-2, 2) == 4 && isnan(fret_pow(-2, 0.5L)));
    CHECK(fret_pow(3, 2) == 9 && fret_pow(10, 22) == 1e22L && fret_pow(2, -1000) == ldexpl(1, -1000));
    CHECK(fret_pow(inf, 2) == inf && fret_pow(inf, -1) == 0 && fret_pow(2, 1e30L) == inf);
    CHECK(fret_sin(0) == 0 && fret_cos(0) == 1 && isnan(fret_sin(inf)));
    CHECK(fret_atan2(0, -1) == atan2l(0, -1) && fret_atan2(1, 0) > 1.57L);
    CHECK(fret_gamma(5) == 24 && isnan(fret_gamma(-3)) && fret_gamma(1e6L) == inf);
    CHECK_REL(fret_gamma(-2.5L), -8 * sqrtl(3.14159265358979323846264338327950288L) / 15, 1e-18L);
    CHECK(fret_log(expl(-11000)) < -10999 && fret_exp(-11000) > 0);
}

static void far_limits(void) {
    const fret_real inf = INFINITY;
    CHECK(fret_log10(0) == -inf && fret_log10(inf) == inf && isnan(fret_log10(-1)));
    CHECK(isnan(fret_log(NAN)) && isnan(fret_log1p(NAN)) && fret_log1p(inf) == inf);
    CHECK(isnan(fret_pow(NAN, 2)) && isnan(fret_pow(2, NAN)));
    CHECK(fret_pow(2, inf) == inf && fret_pow(0.5L, inf) == 0 && fret_pow(2, -inf) == 0);
    CHECK(fret_pow(0.5L, 1e30L) == 0 && fret_pow(0.5L, -1e30L) == inf && fret_pow(2, -1e30L) == 0);
    CHECK(fret_pow(-2, -3) == -0.125L && fret_pow(3, 20000) == inf && fret_pow(3, -20000) == 0);
    CHECK(fret_sin(1e13L) == sinl(1e13L) && fret_cos(1e13L) == cosl(1e13L) && isnan(fret_cos(inf)));
    CHECK(fret_atan2(inf, 1) == atan2l(inf, 1) && fret_atan2(1, inf) == 0 && isnan(fret_atan2(NAN, 1)));
    CHECK(isnan(fret_gamma(NAN)) && isnan(fret_gamma(-inf)) && fret_gamma(inf) == inf &&
          isnan(fret_gamma(-4)));
    CHECK_REL(fret_gamma(-3.5L), 16 * sqrtl(3.14159265358979323846264338327950288L) / 105, 1e-18L);
    CHECK(fret_dd_exp_real(dd_of(20000)) == inf && fret_dd_exp_real(dd_of(-20000)) == 0);
    CHECK(isnan(fret_dd_exp_real(dd_of((double)NAN))) && isnan(fret_dd_exp(dd_of((double)NAN)).hi));
    CHECK(fret_dd_log(dd_of(0)).hi == -inf && fret_dd_log(dd_of((double)INFINITY)).hi == inf);
    CHECK(isnan(fret_dd_log(dd_of(-1)).hi) && isnan(fret_dd_log(dd_of((double)NAN)).hi));
    CHECK(fret_dd_log_real(inf).hi == inf && isnan(fret_dd_log_real(-1).hi) &&
          isnan(fret_dd_log_real(NAN).hi));
    /* Gamma(5)/Gamma(3)^2, the equal ones asked once; Gamma(5)/(Gamma(3) Gamma(3+e)) is another */
    const dd five = dd_of(5), alike[2] = {{3, 0}, {3, 0}}, apart[2] = {{3, 0}, {3, 1e-16}};
    const dd_scaled q = fret_dd_gamma_quotient(&five, 1, alike, 2),
                    r = fret_dd_gamma_quotient(&five, 1, apart, 2);
    const fret_real one = fret_dd_exp_real(q.log) * dd_value(q.factor),
                    other = fret_dd_exp_real(r.log) * dd_value(r.factor);
    CHECK_REL(one, 6, 1e-18L);
    CHECK_REL(one - other, 6 * 1e-16L * 0.92278433509846713939L, 1e-2L); /* psi(3) */
}

/* Of one double, against long ones; at the ends of the range as in libm. */
static void doubles(void) {
    const double inf = (double)INFINITY, nan = (double)NAN;
    unsigned long long seed = 5;
    for (int i = 0; i < 20000; i++) {
        const double x = unit_random(&seed, -1, 1) * pow(10, unit_random(&seed, -12, 2)), up = fabs(x),
                     wide = ldexp(unit_random(&seed, 0.5, 1), (int)unit_random(&seed, -1073, 1023));
        CHECK_REL(fret_double_exp(x), expl(x), 1.1 * DBL_EPSILON);
        CHECK_REL(fret_double_expm1(x), expm1l(x), 2 * DBL_EPSILON);
        CHECK_REL(fret_double_log(up), logl(up), DBL_EPSILON);
        CHECK_REL(fret_double_log(wide), logl(wide), DBL_EPSILON);
        CHECK_REL(fret_double_log1p(up), log1pl(up), DBL_EPSILON);
        CHECK_REL(fret_double_log1p(-up / 101), log1pl(-up / 101), DBL_EPSILON);
    }
    CHECK(fret_double_exp(800) == inf && fret_double_exp(-800) == 0 && isnan(fret_double_exp(nan)));
    CHECK(fret_double_expm1(inf) == inf && fret_double_expm1(-inf) == -1 && isnan(fret_double_expm1(nan)));
    CHECK(fret_double_log(0) == -inf && fret_double_log(inf) == inf && isnan(fret_double_log(-1)) &&
          isnan(fret_double_log(nan)));
    CHECK(fret_double_log1p(-1) == -inf && fret_double_log1p(inf) == inf && isnan(fret_double_log1p(-2)) &&
          isnan(fret_double_log1p(nan)));
    CHECK_REL(fret_double_log1p(1e300), logl(1e300L), DBL_EPSILON);
    CHECK(fret_double_power(1e-300, -10) == inf && fret_double_power(1e-300, 10) == 0 &&
          isnan(fret_double_power(2, nan)));
}

/* Powers by tables, also where their cells and octaves meet, and beyond them. */
static void powers(void) {
    unsigned long long seed = 2;
    for (int i = 0; i < 40; i++) {
        const double s = i ? unit_random(&seed, 0.01, 6) : 6;
        fret_double_powers shorter;
        fret_powers longer;
        fret_double_powers_make(s, &shorter);
        fret_powers_make(s, &longer);
        for (int j = 0; j < 4000; j++) {
            const double corner = (1 + floor(unit_random(&seed, 0, FRET_CELLS)) / (double)FRET_CELLS) *
                                  ldexp(1, (int)floor(unit_random(&seed, -34, 3)));
            const double x = j % 4 == 0   ? corner
                             : j % 4 == 1 ? corner * (1 - DBL_EPSILON / 2)
                             : j % 4 == 2 ? unit_random(&seed, 0.5, 2)
                                          : exp(unit_random(&seed, -24, 1.4));
            const bool in_table = x >= 0.5 && x < 2, in_octaves = x >= 0x1p-30 && x < 4;
            const fret_real want = fret_pow(x, s), wide = x * (1 + 0.3L * DBL_EPSILON);
            CHECK_REL(fret_double_power_of(&shorter, x), want,
                      UNIT_TOL(in_table     ? 1.25e-16L
                               : in_octaves ? 4e-16L
                                            : 5e-14L,
                               1e-13L));
            CHECK_REL(fret_power_of(&longer, x), want, UNIT_TOL(in_octaves ? 4e-19L : 3e-17L, 1e-13L));
            CHECK_REL(fret_power_of(&longer, wide), fret_pow(wide, s),
                      UNIT_TOL(in_octaves ? 4e-19L : 3e-17L, 1e-13L));
        }
    }
    fret_powers half;
    fret_powers_make(0.5L, &half);
    CHECK_REL(fret_power_of(&half, 1e-3000L * 1e-1000L), fret_pow(1e-4000L, 0.5L), UNIT_TOL(1e-15L, 1));
}

int main(int argc, char **argv) {
    unit_start("dd", argc, argv);
    CASE(reference());
    CASE(arithmetic());
    CASE(long_double());
    CASE(limits());
    CASE(far_limits());
    CASE(doubles());
    CASE(powers());
    return unit_finish();
}
