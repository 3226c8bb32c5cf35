/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "unit.h"

static const double nan_ = (double)NAN, inf_ = (double)INFINITY;
static const fret_real pi = 3.14159265358979323846264338327950288L;

static fret_gap power_gap(double n, double h, double r0) {
    fret_gap gap = {.kind = FRET_GAP_POWER, .terms = 1};
    gap.power[0] = (fret_power){n, h, r0};
    return gap;
}

static void kappa_reference(void) {
    unit_table t;
    if (!unit_open(&t, "kappa.csv"))
        return;
    while (unit_row(&t))
        CHECK_REL(fret_kappa(unit_input(&t, 0), unit_input(&t, 1)), unit_result(&t, 2),
                  UNIT_TOL(3e-18L, 2e-15L));
    for (int i = -9; i <= 9; i++) {
        const double k = i / 10.0;
        const fret_real k1 = (fret_real)k + 1;
        CHECK_REL(fret_kappa(2, k), 2 / k1, UNIT_TOL(2e-18L, 2e-15L));
        CHECK_REL(fret_kappa(4, k), 8 / (k1 * (k1 + 2)), UNIT_TOL(2e-18L, 2e-15L));
    }
    CHECK_REL(fret_kappa(1, 0), pi / 2, UNIT_TOL(2e-18L, 2e-15L));
    CHECK_REL(fret_kappa(3, 0), 3 * pi / 4, UNIT_TOL(2e-18L, 2e-15L));
    CHECK_REL(fret_kappa(1e6L, 0.999999), 1.0L + 0, 1e-5L); /* k -> 1: g = f */
}

/* (3) with r = x sin(angle): x int f'(r) cos^k. */
typedef struct transform {
    const fret_gap *gap;
    fret_real k, x;
} transform;

static fret_real forward(fret_real angle, fret_real from, fret_real to, const void *context) {
    const transform *c = context;
    const fret_power *p = &c->gap->power[0];
    fret_real sine = angle < 0.1L ? sinl(from) : cosl(to), cosine = sinl(to);
    return c->x * p->n * p->h / p->r0 * powl(c->x * sine / p->r0, (fret_real)p->n - 1) * powl(cosine, c->k);
}

/* and back: f(r) = (2 cos(pi k/2)/pi) int_0^r x^k g(x) (r^2-x^2)^(-(1+k)/2) dx. */
static fret_real backward(fret_real angle, fret_real from, fret_real to, const void *context) {
    const transform *c = context;
    fret_real g = 0, sine = angle < 0.1L ? sinl(from) : cosl(to);
    fret_status st = fret_gap_g(c->gap, (double)c->k, c->x * sine, &g, NULL);
    return st.code ? (fret_real)NAN : 2 / pi * cosl(pi * c->k / 2) * g * powl(sine / sinl(to), c->k);
}

static void power(void) {
    static const double ns[] = {0.5, 1, 2, 2.5, 4, 8}, ks[] = {-0.7, -0.3, 0, 0.4, 0.8};
    static const fret_real xs[] = {1e-9L, 3e-5L, 1e-3L, 2.0L};
    for (int i = 0; i < 30; i++) {
        double n = ns[i % 6], k = ks[i / 6];
        fret_gap gap = power_gap(n, 2e-5, 1.5e-3);
        CHECK_OK(fret_gap_check(&gap));
        for (int j = 0; j < 4; j++) {
            fret_real x = xs[j], f = -1, g = -1, slope = -1, same = -1, expected = 2e-5 * powl(x / 1.5e-3, n);
            CHECK_OK(fret_gap_f(&gap, x, &f));
            CHECK_REL(f, expected, UNIT_TOL(2e-17L, 4e-15L));
            CHECK_OK(fret_gap_g(&gap, k, x, &g, &slope));
            CHECK_REL(g, fret_kappa(n, k) * expected, UNIT_TOL(2e-17L, 4e-15L));
            CHECK_REL(slope, n * g / x, UNIT_TOL(2e-17L, 4e-15L));
            CHECK_OK(fret_gap_g(&gap, k, -x, &same, NULL)); /* even */
            CHECK(same == g);
            const transform c = {&gap, k, x};
            CHECK_REL(unit_integrate(forward, &c, 0, pi / 2), g, UNIT_TOL(1e-15L, 1e-13L));
            CHECK_REL(unit_integrate(backward, &c, 0, pi / 2), f, UNIT_TOL(1e-15L, 1e-13L));
        }
        fret_real f = -1, g = -1;
        CHECK_OK(fret_gap_f(&gap, 1.5e-3, &f));
        CHECK_REL(f, (fret_real)2e-5, UNIT_TOL(1e-18L, 1e-15L));
        CHECK_OK(fret_gap_f(&gap, 0, &f));
        CHECK_OK(fret_gap_g(&gap, k, 0, &g, NULL));
        CHECK(f == 0 && g == 0);
    }
    /* a high power at small radii: A itself, h/r0^n, would overflow */
    fret_gap steep = power_gap(50, 1e-9, 1e-9);
    fret_real g = -1;
    CHECK_OK(fret_gap_g(&steep, 0.3, 1e-9, &g, NULL));
    CHECK_REL(g, fret_kappa(50, 0.3) * (fret_real)1e-9, UNIT_TOL(1e-17L, 2e-15L));
}

static void errors(void) {
    const double wild[] = {nan_, inf_, -inf_};
    fret_gap gap;
    for (int i = 0; i < 3; i++) {
        gap = power_gap(wild[i], 1e-5, 1e-3);
        CHECK_ERROR(fret_gap_check(&gap), FRET_NOT_FINITE, "n");
        gap = power_gap(2, wild[i], 1e-3);
        CHECK_CODE(fret_gap_check(&gap), FRET_NOT_FINITE);
        gap = power_gap(2, 1e-5, wild[i]);
        CHECK_CODE(fret_gap_check(&gap), FRET_NOT_FINITE);
    }
    for (double bad = 0; bad >= -1; bad--) {
        gap = power_gap(bad, 1e-5, 1e-3);
        CHECK_ERROR(fret_gap_check(&gap), FRET_NOT_POSITIVE, "n");
        gap = power_gap(2, bad, 1e-3);
        CHECK_CODE(fret_gap_check(&gap), FRET_NOT_POSITIVE);
        gap = power_gap(2, 1e-5, bad);
        CHECK_CODE(fret_gap_check(&gap), FRET_NOT_POSITIVE);
    }
    fret_real f = 7;
    gap = power_gap(2, 1e-5, 1e-3);
    CHECK_ERROR(fret_gap_f(&gap, -1e-3L, &f), FRET_NEGATIVE, "r");
    for (int i = 0; i < 3; i++) {
        CHECK_ERROR(fret_gap_f(&gap, wild[i], &f), FRET_NOT_FINITE, "r");
        CHECK_ERROR(fret_gap_g(&gap, 0.3, wild[i], &f, NULL), FRET_NOT_FINITE, "x");
        CHECK(isnan(fret_kappa(wild[i], 0)) && isnan(fret_kappa(2, wild[i])));
    }
    CHECK(isnan(fret_kappa(0, 0)) && isnan(fret_kappa(2, -1)) && isnan(fret_kappa(2, 1)));
    CHECK_ERROR(fret_gap_g(&gap, 1, 1e-3L, &f, NULL), FRET_BAD_K, "k");
    CHECK_ERROR(fret_gap_g(&gap, nan_, 1e-3L, &f, NULL), FRET_NOT_FINITE, "k");
    CHECK(f == 7); /* untouched */
    for (int terms = -1; terms <= FRET_GAP_TERMS + 1; terms++)
        for (int sum = 0; sum <= 1; sum++) {
            gap = (fret_gap){.kind = sum ? FRET_GAP_SUM : FRET_GAP_POWER, .terms = terms};
            for (int i = 0; i < FRET_GAP_TERMS; i++)
                gap.power[i] = (fret_power){2, 1e-5, 1e-3};
            if (terms >= 1 && terms <= (sum ? FRET_GAP_TERMS : 1))
                CHECK_OK(fret_gap_check(&gap));
            else
                CHECK_ERROR(fret_gap_check(&gap), FRET_OUTSIDE, "terms");
        }
    gap = (fret_gap){.kind = FRET_GAP_TABLE};
    CHECK_ERROR(fret_gap_check(&gap), FRET_OUTSIDE, "table");
    gap = (fret_gap){.kind = FRET_GAP_WORN};
    CHECK_ERROR(fret_gap_check(&gap), FRET_OUTSIDE, "worn");
    gap.kind = (fret_gap_kind)(FRET_GAP_WORN + 1);
    CHECK_ERROR(fret_gap_check(&gap), FRET_OUTSIDE, "kind");
    CHECK((int)fret_gap_check(&gap).limit == FRET_GAP_WORN);
}

int main(int argc, char **argv) {
    unit_start("gap", argc, argv);
    CASE(kappa_reference());
    CASE(power());
    CASE(errors());
    return unit_finish();
}
