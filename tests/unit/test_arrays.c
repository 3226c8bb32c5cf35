/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "unit.h"

#include "arrays/arrays.h"

static const double nan_ = (double)NAN, inf_ = (double)INFINITY;
static unsigned long long state = 1;

static double uniform(double lo, double hi) {
    return unit_random(&state, lo, hi);
}

/* Spread evenly in the logarithm. */
static double spread(double lo, double hi) {
    return exp(uniform(log(lo), log(hi)));
}

static bool same_bits(const double *x, const double *y, size_t count) {
    return memcmp(x, y, count * sizeof *x) == 0;
}

/* Normal results to a tolerance; smaller ones need only be small. */
#define CHECK_NORMAL(value, expected, tolerance)                                                             \
    do {                                                                                                     \
        const fret_real want_ = (expected);                                                                  \
        if (fabsl(want_) >= 2 * DBL_MIN)                                                                     \
            CHECK_REL(value, want_, tolerance);                                                              \
        else                                                                                                 \
            CHECK(fabs(value) <= 3 * DBL_MIN);                                                               \
    } while (0)

/* False where the contact itself is out of range. */
static bool make(double n, double k, double mu, double FN, fret_pressed *out) {
    const unit_scene s = unit_make_scene(n, k);
    *out = (fret_pressed){.normal = unit_make_normal(&s), .mu = mu};
    return !fret_press_by_force(out->normal, FN, &out->press).code;
}

enum { LOADS = 72 }; /* a block and a half group more */

/* Loads of each kind: small, middling, near gross slip. */
static void fill(const fret_pressed *c, double loads[LOADS]) {
    fret_real limit = c->mu * c->press.F;
    for (int i = 0; i < LOADS; i++) {
        fret_real t = i % 4 == 0   ? uniform(0, 1)
                      : i % 4 == 1 ? spread(1e-300, 1)
                      : i % 4 == 2 ? 1 - (fret_real)spread(1e-15, 1)
                                   : uniform(0.9, 1);
        loads[i] = (double)(t * limit);
    }
    loads[0] = 0;
    loads[1] = (double)(limit * (1 - 1e-16L)); /* gross slip but for rounding */
}

/* Measured over 1e6 loads: loss 1.12e-15, c 3.6e-16, dx 5.2e-16, a 2.2e-16, dz 3.1e-16. */
static void compare(const fret_pressed *c) {
    const fret_real of_loss = UNIT_TOL(2e-15L, 5e-15L), of_rest = UNIT_TOL(1e-15L, 1e-13L);
    double loads[LOADS], loss[LOADS], radius[LOADS], dx[LOADS];
    fill(c, loads);
    CHECK_OK(fret_arrays_loss(c, loads, loss, LOADS));
    for (int i = 0; i < LOADS; i++) {
        fret_real want = -1;
        CHECK_OK(fret_cycle_loss_by_force(c, loads[i], &want));
        CHECK_NORMAL(loss[i], want, of_loss);
    }
    CHECK(loss[0] == 0);
    for (int i = 0; i < LOADS; i += 2)
        loads[i] = -loads[i];
    CHECK_OK(fret_arrays_loading(c, loads, radius, dx, LOADS));
    for (int i = 0; i < LOADS; i++) {
        fret_loading want = {0, -1, -1, -1};
        CHECK_OK(fret_loading_by_force(c, loads[i], &want));
        CHECK_NORMAL(radius[i], want.c, of_rest);
        CHECK_NORMAL(dx[i], want.dx, of_rest);
    }
    CHECK(radius[0] == (double)c->press.a && dx[0] == 0 && radius[1] == 0);
    for (int i = 0; i < LOADS; i++) {
        fret_press want;
        double a, dz, F = spread(1e-20, 1e20);
        fret_status st = fret_press_by_force(c->normal, F, &want);
        CHECK_CODE(fret_arrays_press(c->normal, &F, &a, &dz, 1), st.code);
        if (!st.code) {
            CHECK_REL(a, want.a, of_rest);
            CHECK_REL(dz, want.dz, of_rest);
        }
    }
}

static void accuracy(void) {
    static const double ns[] = {1e-6, 1e-3, 0.5, 1, 2, 10, 400, 1e6};
    static const double ks[] = {-1 + 1e-15, -0.9, -0.5, 0, 0.3, 0.9, 1 - 1e-15};
    int made = 0;
    fret_pressed c;
    for (int i = 0; i < 8; i++)
        for (int j = 0; j < 7; j++)
            if (make(ns[i], ks[j], 0.3, 100, &c)) {
                compare(&c);
                made++;
            }
    for (int i = 0; i < 300; i++) {
        double n = i % 2 ? spread(0.1, 10) : spread(1e-6, 1e6), k = uniform(-1, 1);
        double mu = spread(0.01, 3), FN = spread(1e-6, 1e6);
        if (make(n, k, mu, FN, &c)) {
            compare(&c);
            made++;
        }
    }
    CHECK(made > 300);
}

/* The loops for this processor and those for all. */
static void bits(void) {
    static const double special[] = {0, -0.0, 1e-320, 1e300, 1e-300};
    fret_pressed c;
    for (int round = 0; round < 60; round++) {
        double loads[LOADS], got[2][LOADS], want[2][LOADS];
        double *const to[2] = {got[0], got[1]}, *const all[2] = {want[0], want[1]},
                      *const first[2] = {got[0]}, *const all_first[2] = {want[0]};
        CHECK(make(spread(0.01, 100), uniform(-1, 1), 0.4, 100, &c));
        fill(&c, loads);
        CHECK_OK(fret_arrays_ask(FRET_LOSSES, &c, loads, first, LOADS, false));
        CHECK_OK(fret_arrays_ask(FRET_LOSSES, &c, loads, all_first, LOADS, true));
        CHECK(same_bits(got[0], want[0], LOADS));
        CHECK_OK(fret_arrays_ask(FRET_LOADINGS, &c, loads, to, LOADS, false));
        CHECK_OK(fret_arrays_ask(FRET_LOADINGS, &c, loads, all, LOADS, true));
        CHECK(same_bits(got[0], want[0], LOADS) && same_bits(got[1], want[1], LOADS));
        for (size_t i = 0; i < sizeof special / sizeof *special; i++)
            loads[7 * i] = special[i];
        const fret_status st = fret_arrays_ask(FRET_PRESSES, c.normal, loads, to, LOADS, false);
        CHECK_CODE(fret_arrays_ask(FRET_PRESSES, c.normal, loads, all, LOADS, true), st.code);
        const size_t good = st.code ? 14 : LOADS; /* a denormal load may be beyond the exact function */
        CHECK(same_bits(got[0], want[0], good) && same_bits(got[1], want[1], good));
    }
}

/* An array of any length, whole or one by one, and nothing beyond its end. */
static void lengths(void) {
    fret_pressed c;
    double loads[LOADS], one[LOADS], got[LOADS + 1];
    CHECK(make(2, 0.3, 0.4, 100, &c));
    fill(&c, loads);
    for (size_t i = 0; i < LOADS; i++)
        CHECK_OK(fret_arrays_loss(&c, loads + i, one + i, 1));
    for (size_t count = 0; count <= LOADS; count++) {
        got[count] = 7;
        CHECK_OK(fret_arrays_loss(&c, loads, got, count));
        CHECK(same_bits(got, one, count) && got[count] == 7);
    }
}

typedef struct answer {
    double loss, radius, dx;
} answer;

static answer ask(const fret_pressed *c, double F) {
    answer out = {nan_, nan_, nan_};
    CHECK_OK(fret_arrays_loading(c, &F, &out.radius, &out.dx, 1));
    if (F >= 0)
        CHECK_OK(fret_arrays_loss(c, &F, &out.loss, 1));
    return out;
}

static void gross_slip(void) {
    fret_pressed c;
    CHECK(make(2, 0.4, 0.3, 100, &c));
    fret_real loss = -1, slip = fret_gross_slip(&c);
    CHECK_OK(fret_cycle_loss_by_force(&c, 30, &loss)); /* 0.3 * 100 is less than 30 */
    CHECK_REL(ask(&c, 30).loss, loss, UNIT_TOL(5e-16L, 2e-15L));
    CHECK(ask(&c, 30).radius == 0 && ask(&c, -30).radius == 0);
    CHECK_REL(ask(&c, -30).dx, -slip, UNIT_TOL(2e-16L, 1e-15L));
    double F = 30 * (1 + 5e-16), none;
    CHECK_CODE(fret_arrays_loss(&c, &F, &none, 1), FRET_GROSS_SLIP);
    F = -31;
    CHECK_CODE(fret_arrays_loading(&c, &F, &none, NULL, 1), FRET_GROSS_SLIP);
    CHECK(ask(&c, 5).dx == -ask(&c, -5).dx);
}

/* Shapes and magnitudes without a fast path: the scalar functions, rounded. */
static void others(void) {
    unit_scene s = unit_make_scene(2, 0.3);
    for (int which = 0; which < 2; which++) {
        double mu = which ? 1e-290 : 0.4, FN = which ? 1e-9 : 50,
               loads[3] = {0, 0.25 * mu * FN, 0.9 * mu * FN};
        double loss[3], radius[3], dx[3], F[3] = {0, 1, 20}, a[3], dz[3];
        if (!which) {
            s.gap.kind = FRET_GAP_FLAT_ROUNDED;
            s.gap.b = 1e-3;
            s.gap.R = 0.1;
        } else {
            s.gap.kind = FRET_GAP_POWER;
        }
        fret_pressed c = {.mu = mu};
        c.normal = unit_make_normal(&s);
        CHECK_OK(fret_press_by_force(c.normal, FN, &c.press));
        CHECK_OK(fret_arrays_loss(&(fret_pressed){c.normal, mu, c.press}, loads, loss, 3));
        CHECK_OK(fret_arrays_loading(&(fret_pressed){c.normal, mu, c.press}, loads, radius, dx, 3));
        CHECK_OK(fret_arrays_press(c.normal, F, a, dz, 3));
        for (int i = 0; i < 3; i++) {
            fret_real want = -1;
            fret_loading f;
            fret_press p;
            CHECK_OK(fret_cycle_loss_by_force(&(fret_pressed){c.normal, mu, c.press}, loads[i], &want));
            CHECK_OK(fret_loading_by_force(&(fret_pressed){c.normal, mu, c.press}, loads[i], &f));
            CHECK_OK(fret_press_by_force(c.normal, F[i], &p));
            CHECK(loss[i] == (double)want);
            CHECK(radius[i] == (double)f.c);
            CHECK(dx[i] == (double)f.dx);
            CHECK_REL(a[i], p.a, 1e-15L);
            CHECK_REL(dz[i], p.dz, 1e-15L);
        }
        double one[3]; /* each by itself */
        CHECK_OK(fret_arrays_loading(&(fret_pressed){c.normal, mu, c.press}, loads, one, NULL, 3));
        CHECK(same_bits(one, radius, 3));
        CHECK_OK(fret_arrays_loading(&(fret_pressed){c.normal, mu, c.press}, loads, NULL, one, 3));
        CHECK(same_bits(one, dx, 3));
        CHECK_OK(fret_arrays_press(c.normal, F, one, NULL, 3));
        CHECK(same_bits(one, a, 3));
        CHECK_OK(fret_arrays_press(c.normal, F, NULL, one, 3));
        CHECK(same_bits(one, dz, 3));
    }
}

static void errors(void) {
    fret_pressed c;
    CHECK(make(2, 0.4, 0.5, 64, &c));
    const fret_normal *n = c.normal;
    double F[20], x[20], y[20];
    for (int i = 0; i < 20; i++)
        F[i] = i;

    /* nothing to do is no error, and nothing is touched */
    CHECK_OK(fret_arrays_loss(&(fret_pressed){n, 0.5, c.press}, NULL, NULL, 0));
    CHECK_OK(fret_arrays_loading(&(fret_pressed){n, 0.5, c.press}, NULL, NULL, NULL, 0));
    CHECK_OK(fret_arrays_press(n, NULL, NULL, NULL, 0));

    /* the first offending load of several, results before it in place */
    static const struct {
        double load;
        fret_code code;
    } bad[] = {{nan_, FRET_NOT_FINITE}, {inf_, FRET_NOT_FINITE}, {-1, FRET_NEGATIVE}, {33, FRET_GROSS_SLIP}};
    for (size_t b = 0; b < 4; b++)
        for (int at = 0; at < 20; at += 3) {
            F[at] = bad[b].load;
            F[19] = -2;
            fret_status st = fret_arrays_loss(&(fret_pressed){n, 0.5, c.press}, F, x, 20);
            CHECK_ERROR(st, bad[b].code, "FA");
            CHECK(st.value == bad[b].load || isnan(bad[b].load));
            for (int i = 0; i < at; i++)
                CHECK(x[i] == ask(&c, F[i]).loss);
            F[19] = 19;
            bool odd = bad[b].code == FRET_NEGATIVE; /* -1 N is no error in loading */
            st = fret_arrays_loading(&(fret_pressed){n, 0.5, c.press}, F, x, y, 20);
            CHECK_CODE(st, odd ? FRET_OK : bad[b].code);
            for (int i = 0; i < at; i++)
                CHECK(x[i] == ask(&c, F[i]).radius && y[i] == ask(&c, F[i]).dx);
            st = fret_arrays_press(n, F, x, y, 20);
            CHECK_CODE(st, bad[b].code == FRET_GROSS_SLIP ? FRET_OK : bad[b].code);
            F[at] = at;
        }
    F[5] = 1e-310; /* the radius would do, the depth not */
    CHECK_CODE(fret_arrays_press(n, F, x, y, 20), FRET_OVERFLOW);
    F[5] = 5;

    /* one output alone gives the same */
    double z[20];
    CHECK_OK(fret_arrays_loading(&(fret_pressed){n, 0.5, c.press}, F, x, y, 20));
    CHECK_OK(fret_arrays_loading(&(fret_pressed){n, 0.5, c.press}, F, z, NULL, 20));
    CHECK(same_bits(x, z, 20));
    CHECK_OK(fret_arrays_loading(&(fret_pressed){n, 0.5, c.press}, F, NULL, z, 20));
    CHECK(same_bits(y, z, 20));
    CHECK_OK(fret_arrays_press(n, F, x, y, 20));
    CHECK_OK(fret_arrays_press(n, F, z, NULL, 20));
    CHECK(same_bits(x, z, 20));
    CHECK_OK(fret_arrays_press(n, F, NULL, z, 20));
    CHECK(same_bits(y, z, 20));

    x[0] = 7;
    const fret_press open = {.F = 0};
    CHECK_ERROR(fret_arrays_loss(&(fret_pressed){n, 0, c.press}, F, x, 20), FRET_NOT_POSITIVE, "mu");
    CHECK_ERROR(fret_arrays_loading(&(fret_pressed){n, nan_, c.press}, F, x, y, 20), FRET_NOT_FINITE, "mu");
    CHECK_ERROR(fret_arrays_loss(&(fret_pressed){n, 0.5, open}, F, x, 20), FRET_NOT_POSITIVE, "FN");
    CHECK_ERROR(fret_arrays_loss(&(fret_pressed){n, -1, c.press}, F, x, 20), FRET_NOT_POSITIVE, "mu");
    CHECK(x[0] == 7);
}

int main(int argc, char **argv) {
    unit_start("arrays", argc, argv);
    CASE(accuracy());
    CASE(bits());
    CASE(lengths());
    CASE(gross_slip());
    CASE(others());
    CASE(errors());
    return unit_finish();
}
