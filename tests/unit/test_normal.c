/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "law/normal.h"
#include "unit.h"

static const double nan_ = (double)NAN, inf_ = (double)INFINITY;

static void reference(void) {
    unit_table t;
    if (!unit_open(&t, "scene.csv"))
        return;
    const fret_real tol = UNIT_TOL(2e-17L, 1e-14L);
    while (unit_row(&t)) {
        unit_scene s = unit_read_scene(&t, 0);
        double FN = unit_input(&t, UNIT_SCENE_COLUMNS);
        const int out = UNIT_SCENE_COLUMNS + 2;
        fret_real a = unit_result(&t, out), dz = unit_result(&t, out + 1), kn = unit_result(&t, out + 7);
        const fret_normal *n = unit_make_normal(&s);
        fret_press p = {.F = 0}, back;
        CHECK_OK(fret_press_by_force(n, FN, &p));
        CHECK(p.F == FN);
        CHECK_REL(p.a, a, tol);
        CHECK_REL(p.dz, dz, tol);
        CHECK_REL(n->foundation.eta, unit_result(&t, out + 6), UNIT_TOL(5e-18L, 4e-15L));
        CHECK_REL(fret_normal_stiffness(n, a), kn, tol);
        fret_real e = 1 / s.gap.power[0].n; /* conditioning of the inverses */
        CHECK_REL(fret_law_force(n, dz), (fret_real)FN, tol * (1 + n->p));
        CHECK_REL(fret_law_depth(n, FN), dz, tol);
        CHECK_REL(fret_law_radius(n, dz), a, tol * (1 + e));

        /* round trips by way of doubles, whose rounding is followed to first order by the exponents */
        double dz_ = (double)p.dz, a_ = (double)p.a;
        CHECK_OK(fret_press_by_depth(n, dz_, &back));
        CHECK(back.dz == dz_);
        CHECK_REL(back.F, FN * (1 + n->p * (dz_ - p.dz) / p.dz), tol * (1 + n->p));
        CHECK_REL(back.a, p.a * (1 + e * (dz_ - p.dz) / p.dz), tol * (1 + e));
        CHECK_OK(fret_press_by_radius(n, a_, &back));
        CHECK(back.a == a_);
        CHECK_REL(back.F, FN * (1 + n->s * (a_ - p.a) / p.a), tol * (1 + n->s));
        CHECK_REL(back.dz, p.dz * (1 + (a_ - p.a) / p.a / e), tol * (1 + 1 / e));
    }
}

static void law(void) {
    for (int i = 0; i < 25; i++) {
        static const double ns[] = {0.5, 1, 2, 3, 8}, ks[] = {-0.9, -0.5, 0, 0.5, 0.9};
        unit_scene s = unit_make_scene(ns[i % 5], ks[i / 5]);
        const fret_normal *n = unit_make_normal(&s);
        CHECK(fret_law_force(n, 0) == 0 && fret_law_depth(n, 0) == 0 && fret_law_radius(n, 0) == 0);
        fret_real last_F = 0, last_a = 0;
        for (double y = 1e-9; y < 1e-3; y *= 1.7) {
            fret_real F = fret_law_force(n, y), a = fret_law_radius(n, y);
            CHECK(F > last_F && a > last_a);
            CHECK_REL(fret_law_depth(n, F), (fret_real)y, UNIT_TOL(2e-17L, 1e-14L));
            last_F = F;
            last_a = a;
            /* k_n = dF/d dz, central difference of relative step d: error p^2 d^2 */
            fret_real d = 1e-5L,
                      slope = (fret_law_force(n, y * (1 + d)) - fret_law_force(n, y * (1 - d))) / (2 * d * y);
            CHECK_REL(fret_normal_stiffness(n, a), slope, 1e-9L + n->p * n->p * d * d);
        }
        /* thickness and load of a slice are inverse, also for thin slices */
        const fret_level edge = {1e-6L, fret_law_force(n, 1e-6L)};
        for (double x = 1e-15; x < 1; x *= 2.3) {
            fret_real w = fret_law_load(n, &edge, x * 1e-6L), h = fret_law_thickness(n, &edge, w);
            CHECK_REL(h, x * 1e-6L, UNIT_TOL(1e-17L, 1e-14L) * (1 + 1 / (n->p * powl(1 - x, n->p))));
            CHECK_REL(w, fret_law_slice(n, &edge, x * 1e-6L).w, UNIT_TOL(1e-17L, 1e-14L));
        }
        for (fret_real x = 1; x > 1e-18L; x /= 7) {
            const fret_level inner = {x * edge.y, fret_law_force(n, x * edge.y)};
            CHECK_REL(fret_law_level_radius(n, &inner), fret_law_radius(n, inner.y),
                      UNIT_TOL(1e-16L, 1e-13L));
        }
        CHECK(fret_law_load(n, &edge, 0) == 0 && fret_law_thickness(n, &edge, 0) == 0);
        CHECK_REL(fret_law_load(n, &edge, edge.y), edge.F, UNIT_TOL(1e-18L, 1e-15L));
        CHECK_REL(fret_law_thickness(n, &edge, edge.F), edge.y, UNIT_TOL(1e-18L, 1e-15L));
        fret_slice none = fret_law_slice(n, &edge, 0);
        CHECK(none.w == 0 && fret_slice_moment(&none) == 0 && none.G == 0 && none.L == 0);
    }
}

static void slices(void) {
    unit_table t;
    if (!unit_open(&t, "slice.csv"))
        return;
    while (unit_row(&t)) {
        unit_scene s = unit_make_scene(unit_input(&t, 0), unit_input(&t, 1));
        double x = unit_input(&t, 2);
        const fret_normal *n = unit_make_normal(&s);
        /* at y = 1, F = 1 the slice is exactly h = x */
        const fret_level edge = {1, 1};
        fret_slice got = fret_law_slice(n, &edge, x);
        CHECK_REL(got.w, unit_result(&t, 3), UNIT_TOL(2e-17L, 1e-14L));
        CHECK_REL(fret_slice_moment(&got), unit_result(&t, 4), UNIT_TOL(2e-17L, 1e-14L));
        CHECK_REL(got.G, unit_result(&t, 5), UNIT_TOL(2e-17L, 1e-14L));
        CHECK_REL(got.L, unit_result(&t, 6), UNIT_TOL(2e-16L, 1e-13L));
        CHECK_REL(fret_law_load(n, &edge, x), unit_result(&t, 3), UNIT_TOL(2e-17L, 1e-14L));
    }
}

/* Two equal spheres of 10 mm, 210 GPa, 0.3, at 100 N: Hertz. */
static void hertz(void) {
    unit_scene s = {.material = {{{210e9, 0.3, false}, {210e9, 0.3, false}}, 0, 1e-3}, .mu = 0.3};
    s.gap.kind = FRET_GAP_POWER;
    s.gap.terms = 1;
    s.gap.power[0] = (fret_power){2, 100, 1};
    const fret_normal *n = unit_make_normal(&s);
    fret_press p = {.F = 0};
    CHECK_OK(fret_press_by_force(n, 100, &p));
    fret_real nu = 0.3, modulus = 210e9L / (2 * (1 - nu * nu)), a = cbrtl(3 * 100 * 0.005L / (4 * modulus));
    CHECK_REL(p.a, a, UNIT_TOL(1e-18L, 2e-15L));
    CHECK_REL(p.dz, a * a / 0.005L, UNIT_TOL(2e-18L, 2e-15L));
    CHECK_REL(p.a, 0.148125e-3L, 5e-6L);
    CHECK_REL(p.dz, 4.38819e-6L, 1e-6L);
    CHECK_REL(fret_normal_stiffness(n, p.a), 2 * modulus * a, UNIT_TOL(2e-18L, 2e-15L));
    CHECK_REL(n->p, 1.5L, 1e-18L);
    CHECK_REL(fret_kappa(2, 0), 2.0L, 2e-18L);
}

static void scales(void) {
    /* a high power, nanometres: a^(n+k+1) alone would underflow, A overflow */
    unit_scene s = unit_make_scene(50, 0.5);
    s.gap.power[0] = (fret_power){50, 1e-9, 1e-9};
    const fret_normal *n = unit_make_normal(&s);
    fret_press p = {.F = 0};
    CHECK_OK(fret_press_by_radius(n, 1e-9, &p));
    CHECK(p.F > 0 && isfinite(p.F) && p.dz > 1e-10L && p.dz < 1e-8L);
    fret_press q = {.F = 0};
    CHECK_OK(fret_press_by_force(n, (double)p.F, &q));
    CHECK_REL(q.a, 1e-9L, 1e-15L);
    /* k = 0: c0 does not matter */
    unit_scene one = unit_make_scene(2, 0), other = one;
    other.material.c0 = 123.0;
    const fret_normal *n1 = unit_make_normal(&one), *n2 = unit_make_normal(&other);
    CHECK_OK(fret_press_by_force(n1, 10, &p));
    CHECK_OK(fret_press_by_force(n2, 10, &q));
    CHECK_REL(p.a, q.a, UNIT_TOL(1e-18L, 1e-15L));
    CHECK_REL(p.dz, q.dz, UNIT_TOL(1e-18L, 1e-15L));
}

static void errors(void) {
    unit_scene s = unit_make_scene(2, 0.3), bad;
    const fret_normal *n = unit_make_normal(&s);
    typedef fret_status press(const fret_normal *, double, fret_press *);
    static press *const by[] = {fret_press_by_force, fret_press_by_depth, fret_press_by_radius};
    static const char *const name[] = {"FN", "dz", "a"};
    const double wild[] = {nan_, inf_, -inf_};
    for (int i = 0; i < 3; i++) {
        fret_press p = {.F = 7, .dz = 7, .a = 7};
        for (int j = 0; j < 3; j++)
            CHECK_ERROR(by[i](n, wild[j], &p), FRET_NOT_FINITE, name[i]);
        CHECK_ERROR(by[i](n, -1e-3, &p), FRET_NEGATIVE, name[i]);
        CHECK(p.F == 7 && p.dz == 7 && p.a == 7);
        CHECK_OK(by[i](n, 0, &p));
        CHECK(p.F == 0 && p.dz == 0 && p.a == 0);
    }
    CHECK(fret_normal_end(n) == inf_); /* a power goes on for ever, a sphere for 0.95 of its radius */
    const fret_gap sphere = {.kind = FRET_GAP_EXACT_SPHERE, .R = 0.01};
    CHECK_REL(fret_normal_end(unit_keep_normal(&s.material, &sphere)), 0.0095L, 1e-15L);
    for (int i = 0; i < 3; i++)
        CHECK(isnan(fret_normal_profile(n, wild[i])));
    fret_press p = {.F = 7, .dz = 7, .a = 7};
    CHECK_CODE(fret_press_by_depth(n, 1e300, &p), FRET_OVERFLOW);
    CHECK_CODE(fret_press_by_radius(n, 1e200, &p), FRET_OVERFLOW);
    CHECK_CODE(fret_press_by_depth(n, 1e-300, &p), FRET_OVERFLOW); /* the force would be 0 */
    CHECK(p.F == 7);

    fret_normal *none = NULL;
    bad = s;
    bad.material.k = 1;
    CHECK_ERROR(fret_normal_make(&bad.material, &bad.gap, NULL, NULL, &none), FRET_BAD_K, "k");
    bad = s;
    bad.material.body[0].E0 = -1;
    CHECK_ERROR(fret_normal_make(&bad.material, &bad.gap, NULL, NULL, &none), FRET_NOT_POSITIVE, "E0");
    bad = s;
    bad.material.body[1].nu = 0.7;
    CHECK_ERROR(fret_normal_make(&bad.material, &bad.gap, NULL, NULL, &none), FRET_BAD_NU, "nu_2");
    bad = s;
    bad.gap.power[0].n = 0;
    CHECK_ERROR(fret_normal_make(&bad.material, &bad.gap, NULL, NULL, &none), FRET_NOT_POSITIVE, "n");
    bad.gap.power[0].n = nan_;
    CHECK_ERROR(fret_normal_make(&bad.material, &bad.gap, NULL, NULL, &none), FRET_NOT_FINITE, "n");
    bad = s;
    bad.material.body[0].rigid = bad.material.body[1].rigid = true;
    CHECK_CODE(fret_normal_make(&bad.material, &bad.gap, NULL, NULL, &none), FRET_BOTH_RIGID);
    CHECK(none == NULL); /* untouched */
    fret_normal_free(NULL);
}

/* A place found from its depth and from its load is the same place. */
static void places(void) {
    static const double ks[] = {-0.7, 0, 0.6};
    for (int i = 0; i < 6; i++) {
        const fret_material material = {{{210e9, 0.3, false}, {70e9, 0.33, false}}, ks[i % 3], 1e-3};
        fret_gap gap = {.kind = FRET_GAP_POWER, .terms = 1, .power = {{2, 0.005, 0.01}}};
        if (i >= 3)
            gap = (fret_gap){.kind = FRET_GAP_FLAT_ROUNDED, .b = 1e-4, .R = 0.01};
        const fret_normal *n = unit_keep_normal(&material, &gap);
        for (int j = -3; j <= 2; j++) {
            fret_real F = powl(10, j);
            fret_point p = fret_law_at_force(n, F), q = fret_law_at_depth(n, p.y);
            CHECK(p.F == F && q.y == p.y);
            CHECK_REL(q.F, F, 1e-16L);
            CHECK_REL(q.a, p.a, 1e-16L);
            CHECK_REL(p.y, fret_law_depth(n, F), 1e-16L);
            CHECK_REL(p.a, fret_law_radius(n, p.y), 1e-16L);
            CHECK_REL(p.K, fret_normal_stiffness(n, p.a), 1e-16L);
        }
        fret_point open = fret_law_at_depth(n, 0);
        CHECK(open.F == 0 && open.y == 0 && open.K == 0);
    }
}

/* By the foundation and what the shape reads of the gap. */
static void sameness(void) {
    const fret_material steel = {.body = {{210e9, 0.3, false}, {210e9, 0.3, false}}, .c0 = 1};
    fret_material soft = steel;
    soft.body[1].E0 = 70e9;
    const fret_gap round = {.kind = FRET_GAP_FLAT_ROUNDED, .b = 1e-4, .R = 0.01};
    fret_gap other = round, unread = round;
    other.R = 0.02;
    unread.slope = 3;
    fret_normal *n[4] = {NULL};
    CHECK_OK(fret_normal_make(&steel, &round, NULL, NULL, &n[0]));
    CHECK_OK(fret_normal_make(&steel, &unread, NULL, NULL, &n[1]));
    CHECK_OK(fret_normal_make(&steel, &other, n[0], NULL, &n[2]));
    CHECK_OK(fret_normal_make(&soft, &round, n[0], NULL, &n[3]));
    CHECK(fret_normal_same(n[0], n[0]) && fret_normal_same(n[0], n[1]));
    CHECK(!fret_normal_same(n[0], n[2]) && !fret_normal_same(n[0], n[3]));
    for (int i = 0; i < 4; i++)
        fret_normal_free(n[i]);
}

int main(int argc, char **argv) {
    unit_start("normal", argc, argv);
    CASE(reference());
    CASE(law());
    CASE(slices());
    CASE(hertz());
    CASE(scales());
    CASE(places());
    CASE(errors());
    CASE(sameness());
    return unit_finish();
}
