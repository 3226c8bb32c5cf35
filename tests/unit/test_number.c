/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The integrator, the root, sums and polynomials, against values in closed form. */
#include "number/chebyshev.h"
#include "number/integral.h"
#include "number/least.h"
#include "number/real.h"
#include "number/root.h"
#include "number/sum.h"
#include "unit.h"

/* ---- integrals --------------------------------------------------------------------------------- */

typedef struct shape {
    fret_real (*f)(fret_real t, fret_real rest, const struct shape *s);
    fret_real a, b;
    long asked;
} shape;

static fret_real called(fret_real t, fret_real rest, void *context) {
    shape *s = context;
    s->asked++;
    return s->f(t, rest, s);
}

static fret_real power_of_t(fret_real t, fret_real rest, const shape *s) {
    (void)rest;
    return fret_pow(t, s->a);
}

static fret_real powers(fret_real t, fret_real rest, const shape *s) {
    return fret_pow(t, s->a - 1) * fret_pow(rest, s->b - 1);
}

static fret_real wave(fret_real t, fret_real rest, const shape *s) {
    (void)rest;
    return expl(s->a * t) * cosl(s->b * t);
}

static fret_real kinked(fret_real t, fret_real rest, const shape *s) {
    (void)rest;
    return fret_pow(fabsl(t - s->a), s->b);
}

static fret_real peak(fret_real t, fret_real rest, const shape *s) {
    (void)rest;
    return s->b / (FRET_PI * ((t - s->a) * (t - s->a) + s->b * s->b));
}

static fret_real rounded(fret_real t, fret_real rest, const shape *s) {
    (void)rest;
    return s->a * roundl(expl(t) / s->a); /* noise as large as that */
}

/* What it is known to be, and that it is not farther off than it says, within so many values; noise: of f. */
static void meets(shape s, fret_real want, fret_real size, fret_real tolerance, fret_real noise, long most) {
    const fret_estimate got = fret_integral(called, &s, tolerance);
    const fret_real off = fabsl(got.value - want) / size, said = got.error / size;
    CHECK(off <= UNIT_TOL((s.f == kinked ? 20 : 1) * fmaxl(tolerance, said) + noise + 4e-19L, 1e-13L));
    CHECK(said <= UNIT_TOL(8 * tolerance + 10 * noise + 4e-19L, 1e-12L));
    CHECK(s.asked <= UNIT_TOL(most, 1000000));
    if (getenv("FRET_UNIT_VERBOSE"))
        printf("a = %Lg, b = %Lg: %.0Le: off by %.1Le, said %.1Le, %ld values\n", s.a, s.b, tolerance, off,
               said, s.asked);
}

static void integrals(void) {
    static const fret_real tolerances[] = {1e-18L, 1e-17L, 1e-14L, 1e-10L};
    for (size_t i = 0; i < sizeof tolerances / sizeof *tolerances; i++) {
        const fret_real tol = tolerances[i];
        for (int n = 0; n < 16; n++) /* eight points are exact */
            meets((shape){power_of_t, n, 0, 0}, 1 / (fret_real)(n + 1), 1 / (fret_real)(n + 1), tol, 0, 26);
        meets((shape){wave, 0.3L, 0, 0}, expm1l(0.3L) / 0.3L, 1, tol, 0, 26);
        meets((shape){wave, 0, 30, 0}, sinl(30.0L) / 30, 2 / FRET_PI, tol, 0, 1600);
        meets((shape){wave, -50, 0, 0}, -expm1l(-50.0L) / 50, 0.02L, tol, 0, 1600);
        for (int j = 1; j < 12; j++) { /* singular at one end or both */
            const fret_real a = 0.25L * j + 0.1L;
            meets((shape){power_of_t, a - 1, 0, 0}, 1 / a, 1 / a, tol, 0, 170);
            meets((shape){powers, a, 0.7L, 0}, fret_beta(a, 0.7L), fret_beta(a, 0.7L), tol, 0, 170);
        }
        for (int j = 1; j < 20; j++) { /* kinks, and steeper places, anywhere */
            const fret_real a = sqrtl(0.0025L) * j + 1e-3L,
                            b = j % 3 == 0   ? 0.5L
                                : j % 3 == 1 ? 1
                                             : 2.5L,
                            want = (fret_pow(a, b + 1) + fret_pow(1 - a, b + 1)) / (b + 1);
            meets((shape){kinked, a, b, 0}, want, want, tol, 0, 7000);
        }
        for (fret_real a = 0.009L; a > 1e-5L;
             a /= 1.7L) { /* and before the first point, after the last one */
            const fret_real want = (a * a + (1 - a) * (1 - a)) / 2;
            meets((shape){kinked, a, 1, 0}, want, want, tol, 0, 7000);
            meets((shape){kinked, 1 - a, 1, 0}, want, want, tol, 0, 7000);
        }
        for (fret_real b = 0.1L; b > 1e-6L; b /= 10) /* next to the axis, in the midst and at an end */
            for (fret_real a = 0; a < 0.5L; a += 0.21L)
                meets((shape){peak, a, b, 0}, (atanl((1 - a) / b) + atanl(a / b)) / FRET_PI, 1, tol,
                      1e-20L / b, b < 1e-3L ? 40000 : 6000);
    }
}

/* Noise ends the halving. */
static void noise(void) {
    for (fret_real a = 1e-16L; a < 1e-7L; a *= 10) {
        shape s = {rounded, a, 0, 0};
        const fret_estimate got = fret_integral(called, &s, 1e-18L);
        CHECK_ABS(got.value, expm1l(1), 1, a);
        CHECK(s.asked < 20000);
    }
}

/* ---- roots ------------------------------------------------------------------------------------- */

typedef struct curve {
    int kind;
    bool sloped;
    fret_real at;
    long asked;
} curve;

static fret_real curve_at(fret_real x, fret_real *slope, void *context) {
    curve *c = context;
    const fret_real v = x - c->at;
    fret_real f = 0, d = 0;
    c->asked++;
    if (c->kind == 0) {
        f = v;
        d = 1;
    } else if (c->kind == 1) { /* flat there, as many zeros are */
        f = v * v * v;
        d = 3 * v * v;
    } else if (c->kind == 2) { /* steep there: Newton's steps lead away */
        f = copysignl(fret_pow(fabsl(v), 0.3L), v);
        d = v == 0 ? 0 : 0.3L * fret_pow(fabsl(v), -0.7L);
    } else if (c->kind == 3) {
        f = -atanl(1e6L * v);
        d = -1e6L / (1 + 1e12L * v * v);
    } else if (c->kind == 4) {
        f = v < 0 ? -1 : 1; /* no slope, no zero */
    } else {
        f = expl(x) - expl(c->at);
        d = expl(x);
    }
    if (c->sloped)
        *slope = d;
    return f;
}

/* x^3 - 2 in double; counts its calls. */
static double cube_less_2(double x, void *asked) {
    ++*(int *)asked;
    return x * x * x - 2;
}

static void roots(void) {
    static const fret_real places[] = {1e-20L, 1e-3L, 0.1L, 1 / 3.0L, 0.5L, 0.75L, 1 - 1e-10L};
    static const long most[] = {8, 240, 100, 40, 80, 40};
    for (size_t i = 0; i < sizeof places / sizeof *places; i++)
        for (int kind = 0; kind < 6; kind++)
            for (int sloped = 0; sloped < 2; sloped++)
                for (int guess = -1; guess < 3; guess++) {
                    curve c = {kind, sloped, places[i], 0};
                    const fret_real x = fret_root(curve_at, &c, 0, 1, 0.4L * guess);
                    if (kind == 1) /* what v^3 tells of v */
                        CHECK_ABS(x, c.at, 1, 1e-15L);
                    else
                        CHECK_ABS(x, c.at, kind == 5 ? 1 : c.at, 4 * LDBL_EPSILON);
                    CHECK(c.asked <=
                          (i == 0 ? 400 : most[kind])); /* halves find what is far smaller than all */
                }
    curve c = {0, true, 0, 0}; /* at an end */
    CHECK(fret_root(curve_at, &c, 0, 1, 0.5L) == 0);
    CHECK(fret_root(curve_at, &c, -1, 0, 5) == 0);
    CHECK(fret_root(curve_at, &c, -3, 1, -2) == 0);
    c = (curve){5, true, 0.3L, 0}; /* from nearby a few steps do */
    fret_root(curve_at, &c, -10, 10, 0.3001L);
    CHECK(c.asked <= 8);
    int asked = 0;
    CHECK_ABS(fret_root_double(cube_less_2, &asked, 1, 2), cbrtl(2), 1, DBL_EPSILON);
    CHECK(asked <= 16 &&
          fret_root_double(cube_less_2, &asked, -10, 1e9) == fret_root_double(cube_less_2, &asked, 1, 2));
}

/* ---- the least --------------------------------------------------------------------------------- */

typedef struct valley {
    fret_real at, power;
    int asked;
} valley;

static fret_real valley_at(fret_real x, fret_real *slope, void *context) {
    valley *v = context;
    (void)slope;
    v->asked++;
    return powl(fabsl(x - v->at), v->power) - 1;
}

static void valleys(void) {
    static const fret_real powers[] = {1, 2, 4, 0.5L}, places[] = {0.3L, 1e-9L, 0.999L, 0.5L};
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 4; j++) {
            valley v = {places[j], powers[i], 0};
            const fret_real x = fret_least(valley_at, &v, 0, 1, 0.4L, 1e-12L);
            /* f is known to 1e-19 of 1 */
            CHECK_ABS(x, v.at, 1, 1e-12L + 2 * powl(LDBL_EPSILON, 1 / powers[i]));
            CHECK(v.asked < 70);
        }
    valley end = {2, 2, 0}; /* it falls to an end */
    CHECK_ABS(fret_least(valley_at, &end, 0, 1, 0.5L, 1e-6L), 1, 1, 1e-6L);
    valley close = {1, 2, 0}; /* to neighbouring numbers */
    CHECK_ABS(fret_least(valley_at, &close, 0.5L, 1.5L, 0.75L, 0), 1, 1, 1e-9L);
}

/* ---- sums and polynomials ---------------------------------------------------------------------- */

static void sums(void) {
    fret_sum s = {0, 0};
    fret_sum_add(&s, 1);
    for (int i = 0; i < 1000000; i++)
        fret_sum_add(&s, LDBL_EPSILON / 8);
    fret_sum_add(&s, 1e30L);
    fret_sum_add(&s, -1e30L);
    CHECK_REL(fret_sum_value(&s), 1 + 125000 * LDBL_EPSILON, LDBL_EPSILON);
}

static fret_real value_of(const fret_real *c, fret_real x) {
    fret_real sum = 0;
    for (int i = FRET_CHEBYSHEV; i-- > 0;)
        sum = sum * x + c[i];
    return sum;
}

static void polynomials(void) {
    fret_chebyshev rule; /* through the values of a function, in powers */
    fret_real value[FRET_CHEBYSHEV], term[FRET_CHEBYSHEV], power[FRET_CHEBYSHEV];
    for (int from_nil = 0; from_nil < 2; from_nil++) {
        fret_chebyshev_make(&rule, 20, from_nil);
        for (int i = 0; i < 20; i++)
            value[i] = expl(rule.node[i] / 2);
        fret_chebyshev_terms(&rule, value, term);
        fret_chebyshev_powers(&rule, term, 16, power);
        for (int i = 0; i <= 10; i++) {
            const fret_real x = from_nil ? i / 10.0L : i / 5.0L - 1;
            CHECK_REL(value_of(power, x), expl(x / 2), UNIT_TOL(1e-17L, 1e-13L));
        }
    }
}

int main(int argc, char **argv) {
    unit_start("number", argc, argv);
    CASE(integrals());
    CASE(noise());
    CASE(roots());
    CASE(valleys());
    CASE(sums());
    CASE(polynomials());
    return unit_finish();
}
