/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Double-double functions against 80-digit values; powers of long double against those of the C library. */
#include "number/dd.h"
#include "number/real.h"

#include "unit.h"

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

static void long_double(void) {
    const fret_real inf = INFINITY, bit = UNIT_TOL(1.1e-19L, 2.3e-16L);
    unsigned long long seed = 2;
    for (int i = 0; i < 20000; i++) {
        const fret_real x = powl(10, (fret_real)unit_random(&seed, -25, 3)), y = unit_random(&seed, -3, 3);
        CHECK_REL(fret_pow(x, y), powl(x, y), (2 + fabsl(y * logl(x))) * bit);
        CHECK_REL(fret_pow(x, 40 * y), powl(x, 40 * y), (2 + fabsl(40 * y * logl(x))) * bit);
        CHECK_REL(fret_ratio_pow(x, 3, y), powl(x / 3, y), 5 * bit);
        if (x > 1e-10L)
            CHECK_REL(fret_beta(x, 1), 1 / x, 4 * bit);
    }
    CHECK(fret_pow(0, 2) == 0 && fret_pow(0, -2) == inf && fret_pow(0, 0) == 1 && fret_pow(5, 0) == 1);
    CHECK(fret_pow(1, 1e30L) == 1 && fret_pow(-2, 3) == -8 && isnan(fret_pow(-2, 0.5L)));
    CHECK(fret_pow(inf, 2) == inf && fret_pow(inf, -1) == 0 && fret_pow(2, 1e30L) == inf);
    CHECK(fret_pow(2, inf) == inf && fret_pow(0.5L, inf) == 0 && fret_pow(0.5L, 1e30L) == 0);
    CHECK(fret_pow(3, 20000) == inf && fret_pow(3, -20000) == 0);
    CHECK(isnan(fret_pow(NAN, 2)) && isnan(fret_pow(2, NAN)));
}

static void limits(void) {
    const fret_real inf = INFINITY;
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

int main(int argc, char **argv) {
    unit_start("dd", argc, argv);
    CASE(reference());
    CASE(arithmetic());
    CASE(long_double());
    CASE(limits());
    return unit_finish();
}
