/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The largest pressure, presses to a pressure, the energy of pressing, and the flat punch: against closed
 * forms and the references. */
#include "law/normal.h"
#include "number/real.h"
#include "unit.h"

static fret_gap shape_of(fret_gap_kind kind) {
    return (fret_gap){.kind = kind,
                      .terms = 2,
                      .power = {{2, 5e-6, 1e-3}, {4, 2e-6, 1e-3}},
                      .b = 2e-4,
                      .R = 1e-2,
                      .slope = 0.01};
}

static fret_real pressure_at(const fret_normal *n, const fret_press *press, fret_real r) {
    fret_field *f = NULL;
    fret_real p = 0;
    CHECK_OK(fret_field_of_press(n, press, &f));
    CHECK_OK(fret_field_pressure(f, r, &p));
    fret_field_free(f);
    return p;
}

static fret_real peak_of(const fret_normal *n, const fret_press *press, fret_real *r) {
    fret_field *f = NULL;
    fret_real p = 0;
    CHECK_OK(fret_field_of_press(n, press, &f));
    CHECK_OK(fret_field_peak(f, r, &p));
    fret_field_free(f);
    return p;
}

static fret_real mean_of(const fret_press *press) {
    return press->F / (FRET_PI * press->a * press->a);
}

/* A press that was found is one by its force, and has that pressure. */
static void check_found(const fret_press *found, const fret_press *wanted) {
    CHECK_REL(found->F, wanted->F, 1e-14);
    CHECK_REL(found->a, wanted->a, 1e-14);
    CHECK_REL(found->dz, wanted->dz, 1e-14);
}

static void powers(void) {
    unit_table t;
    if (!unit_open(&t, "peak.csv"))
        return;
    while (unit_row(&t)) {
        const double k = unit_input(&t, 1);
        const unit_scene s = unit_make_scene(unit_input(&t, 0), k);
        const fret_pressed c = unit_make_contact(&s, 100);
        fret_press found;
        fret_real r, p0 = peak_of(c.normal, &c.press, &r);
        CHECK_REL(p0 / mean_of(&c.press), unit_result(&t, 3), 1e-13);
        CHECK_ABS(r / c.press.a, unit_result(&t, 2), 1, 1e-5); /* p is flat there */
        CHECK_OK(fret_press_by_peak(c.normal, (double)p0, &found));
        check_found(&found, &c.press);
        CHECK_OK(fret_press_by_mean(c.normal, (double)mean_of(&c.press), &found));
        check_found(&found, &c.press);
        const fret_real n = s.gap.power[0].n;
        CHECK_REL(fret_normal_energy(c.normal, &c.press), n / (2 * n + k + 1) * c.press.F * c.press.dz,
                  1e-17);
    }
}

/* Hertz: p_0 = (6 F E*^2/(pi^3 R^2))^(1/3), U_n = 2/5 F delta_z. */
static void hertz(void) {
    const fret_material steel = {{{210e9, 0.3, false}, {210e9, 0.3, false}}, 0, 1};
    const fret_gap gap = {.kind = FRET_GAP_POWER, .terms = 1, .power = {{2, 5e-3, 1e-2}}};
    const fret_normal *n = unit_keep_normal(&steel, &gap);
    const fret_real E = 210e9L / (2 * (1 - 0.3 * (fret_real)0.3)), R = 1e-2;
    fret_press p;
    fret_real r;
    CHECK_OK(fret_press_by_peak(n, 1e9, &p));
    CHECK_REL(p.F, FRET_PI * FRET_PI * FRET_PI * R * R * 1e27L / (6 * E * E), 1e-15);
    CHECK_REL(peak_of(n, &p, &r), 1e9L, 1e-15);
    CHECK(r == 0);
    CHECK_REL(fret_normal_energy(n, &p), 0.4L * p.F * p.dz, 1e-18);
    CHECK_OK(fret_press_by_mean(n, 1e9, &p));
    CHECK_REL(mean_of(&p), 1e9L, 1e-15);
    CHECK_REL(p.a, 3 * FRET_PI * R * 1e9L / (4 * E), 1e-15);
    CHECK(fret_normal_energy(n, &(fret_press){.F = 0}) == 0);
}

typedef struct law {
    const fret_normal *normal;
} law;

static fret_real force_at(fret_real y, fret_real from_0, fret_real to_dz, const void *context) {
    (void)from_0;
    (void)to_dz;
    return fret_law_force(((const law *)context)->normal, y);
}

/* No place presses harder than the peak; the way back; the energy by its definition. */
static void shapes(void) {
    static const fret_gap_kind kinds[] = {FRET_GAP_SUM, FRET_GAP_FLAT_CONE, FRET_GAP_FLAT_PARABOLOID,
                                          FRET_GAP_FLAT_ROUNDED, FRET_GAP_EXACT_SPHERE};
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++)
        for (int j = 0; j < 3; j++) {
            unit_scene s = unit_make_scene(2, j == 0 ? 0 : j == 1 ? 0.3 : -0.3);
            s.gap = shape_of(kinds[i]);
            const bool sharp = kinds[i] == FRET_GAP_FLAT_CONE || kinds[i] == FRET_GAP_FLAT_PARABOLOID;
            const fret_pressed c = unit_make_contact(&s, 100);
            const law of = {c.normal};
            fret_press found;
            CHECK_OK(fret_press_by_mean(c.normal, (double)mean_of(&c.press), &found));
            check_found(&found, &c.press);
            CHECK_REL(fret_normal_energy(c.normal, &c.press), unit_integrate(force_at, &of, 0, c.press.dz),
                      1e-14);
            if (sharp && s.material.k <= 0) {
                const fret_status st = fret_press_by_peak(c.normal, 1e9, &found);
                CHECK_CODE(st, FRET_SINGULAR);
                CHECK(st.value == s.gap.b);
                continue;
            }
            fret_real r, most = 0;
            const fret_real p0 = peak_of(c.normal, &c.press, &r);
            for (int x = 0; x < 500; x++)
                most = fmaxl(most, pressure_at(c.normal, &c.press, c.press.a * (fret_real)x / 500));
            CHECK(p0 >= most * (1 - 1e-13L) && p0 < 1.1L * most && (!sharp || r == s.gap.b));
            CHECK_REL(pressure_at(c.normal, &c.press, r), p0, 1e-13);
            CHECK_OK(fret_press_by_peak(c.normal, (double)p0, &found));
            CHECK_REL(found.F, c.press.F, 1e-11);
            CHECK_REL(peak_of(c.normal, &found, NULL), (fret_real)(double)p0, 1e-13);
        }
}

/* Where the mean pressure rises and falls, the least load that reaches it, in any units of force. */
static void least(void) {
    static const fret_gap gaps[] = {
        {FRET_GAP_FLAT_CONE, .b = 2e-4, .slope = 0.02},
        {FRET_GAP_SUM, .terms = 2, .power = {{1, 0.01, 1}, {3, 1e6, 1}}},
    };
    for (size_t i = 0; i < sizeof gaps / sizeof *gaps; i++)
        for (int power = -9; power <= 9; power += 3) {
            unit_scene s = unit_make_scene(2, -0.5);
            const double in = pow(10, power);
            for (int body = 0; body < 2; body++)
                s.material.body[body].E0 *= in;
            s.gap = gaps[i];
            const fret_normal *n = unit_make_normal(&s);
            fret_press found, one;
            const double pmean = (i ? 9e9 : 5e8) * in;
            CHECK_OK(fret_press_by_mean(n, pmean, &found));
            CHECK_REL(mean_of(&found), pmean, 1e-13);
            CHECK_OK(fret_press_by_force(n, 1e6 * in, &one)); /* beyond the other load */
            CHECK((mean_of(&one) > pmean) == (i == 1));
            for (double F = (double)found.F / 1.01; F > 1e-9 * in; F /= 1.1) {
                CHECK_OK(fret_press_by_force(n, F, &one));
                CHECK((mean_of(&one) > pmean) == (i == 1));
            }
        }
}

/* What no load reaches, and what tells no load. */
static void refused(void) {
    unit_scene s = unit_make_scene(1, 0);
    const fret_normal *cone = unit_make_normal(&s);
    fret_press p;
    CHECK_CODE(fret_press_by_peak(cone, 1e9, &p), FRET_SINGULAR);
    CHECK_ERROR(fret_press_by_mean(cone, 1e9, &p), FRET_OUTSIDE, "pmean");
    CHECK_ERROR(fret_press_by_mean(cone, -1, &p), FRET_NOT_POSITIVE, "pmean");
    CHECK_ERROR(fret_press_by_mean(cone, (double)INFINITY, &p), FRET_NOT_FINITE, "pmean");
    s.gap = shape_of(FRET_GAP_FLAT_CONE);
    CHECK_ERROR(fret_press_by_mean(unit_make_normal(&s), 1e12, &p), FRET_OUTSIDE, "pmean");
    s.gap = shape_of(FRET_GAP_EXACT_SPHERE);
    CHECK_ERROR(fret_press_by_peak(unit_make_normal(&s), 1e13, &p), FRET_TABLE_SHORT, "p0");
}

/* F_N = 2 c_N0 c0^-k b^(k+1)/(k+1) delta_z, p = F_N (k+1)/(2 pi b^2) (1-r^2/b^2)^((k-1)/2); nothing slips
 * before all of it does. */
static void punch(void) {
    static const double gradings[] = {-0.7, 0, 0.5};
    for (size_t i = 0; i < 3; i++) {
        const double k = gradings[i];
        unit_scene s = unit_make_scene(2, k);
        s.gap = shape_of(FRET_GAP_FLAT);
        const fret_pressed c = unit_make_contact(&s, 100);
        const fret_foundation *f = fret_normal_foundation(c.normal);
        const fret_real b = s.gap.b, stiff = 2 * f->cN0 * b / (1 + k) * powl(b / (fret_real)s.material.c0, k);
        fret_press p;
        fret_loading l;
        fret_real value;
        fret_field *field = NULL;
        CHECK_REL(c.press.dz, 100 / stiff, 1e-18);
        CHECK(c.press.a == b && fret_normal_end(c.normal) == b);
        CHECK_OK(fret_press_by_depth(c.normal, 1e-6, &p));
        CHECK_REL(p.F, 1e-6 * stiff, 1e-18);
        CHECK_REL(fret_normal_energy(c.normal, &p), p.F * p.dz / 2, 1e-18);
        CHECK_ERROR(fret_press_by_radius(c.normal, (double)b, &p), FRET_OUTSIDE, "a");
        CHECK_ERROR(fret_press_by_radius(c.normal, 1e-4, &p), FRET_OUTSIDE, "a");
        CHECK_ERROR(fret_press_by_radius(c.normal, 1e-3, &p), FRET_TABLE_SHORT, "a");
        CHECK_OK(fret_press_by_mean(c.normal, 1e9, &p));
        CHECK_REL(p.F, 1e9L * FRET_PI * b * b, 1e-15);
        CHECK_REL(pressure_at(c.normal, &c.press, b / 2),
                  100 * (1 + (fret_real)k) / (2 * FRET_PI * b * b) * powl(0.75L, ((fret_real)k - 1) / 2),
                  1e-17);
        CHECK_OK(fret_field_of_press(c.normal, &c.press, &field));
        const fret_status st = fret_field_peak(field, NULL, &value);
        CHECK_CODE(st, FRET_SINGULAR);
        CHECK(st.value == (double)b);
        CHECK_OK(fret_field_surface(field, b / 2, &value));
        CHECK_REL(value, c.press.dz, 1e-18);
        CHECK_OK(fret_field_surface(field, 2 * b, &value));
        if (k == 0) /* 2/pi delta_z asin(b/r) */
            CHECK_REL(value, c.press.dz / 3, 1e-17);
        fret_field_free(field);
        CHECK_OK(fret_gap_f(&s.gap, b, &value));
        CHECK(value == 0);
        CHECK_ERROR(fret_gap_f(&s.gap, 2 * b, &value), FRET_OUTSIDE, "r");
        CHECK_OK(fret_loading_by_force(&c, 30, &l));
        CHECK(l.c == b);
        CHECK_REL(l.dx, f->eta * 30 / stiff, 1e-18);
        CHECK_OK(fret_cycle_loss_by_force(&c, 30, &value));
        CHECK(value == 0);
        CHECK_OK(fret_cycle_loss_by_displacement(&c, (double)(2 * fret_gross_slip(&c)), &value));
        CHECK_REL(value, 4 * (fret_real)s.mu * 100 * fret_gross_slip(&c), 1e-15);
    }
}

/* The memory diagram and springs along the same steps: the springs of a punch are alike, and exact. */
static void punch_on_its_way(void) {
    static const fret_step steps[] = {
        {FRET_TO_FORCE, FRET_KEEP_DX, 100, 0}, {FRET_TO_FORCE, FRET_TO_FX, 120, 30},
        {FRET_TO_FORCE, FRET_TO_FX, 80, 31},   {FRET_TO_DEPTH, FRET_TO_DX, 4e-7, 3e-6},
        {FRET_TO_FORCE, FRET_TO_FX, 90, -30},  {FRET_KEEP_NORMAL, FRET_TO_DX, 0, -1e-6}};
    unit_scene s = unit_make_scene(2, 0.3);
    s.gap = shape_of(FRET_GAP_FLAT);
    const fret_normal *n = unit_make_normal(&s);
    fret_contact *memory = NULL;
    fret_springs *springs = NULL;
    fret_state a, b;
    CHECK_OK(fret_contact_make(n, s.mu, FRET_EXACT, &memory));
    CHECK_OK(fret_springs_make(n, s.mu, 50, s.gap.b, FRET_WEIGHT_CELL, &springs));
    for (size_t i = 0; i < sizeof steps / sizeof *steps; i++) {
        CHECK_OK(fret_contact_step(memory, &steps[i]));
        CHECK_OK(fret_springs_step(springs, &steps[i], 1));
        fret_contact_state(memory, &a);
        fret_springs_state(springs, &b);
        CHECK_REL(b.FN, a.FN, 1e-13);
        CHECK_ABS(b.Fx, a.Fx, s.mu * a.FN, 1e-13);
        CHECK_ABS(b.dx, a.dx, 1e-6, 1e-13);
        CHECK_ABS(b.W, a.W, 1e-4, 1e-13);
        CHECK_ABS(b.U, a.U, 1e-5, 1e-13);
        CHECK(a.a == s.gap.b);
    }
    fret_contact_free(memory);
    fret_springs_free(springs);
}

int main(int argc, char **argv) {
    unit_start("press", argc, argv);
    CASE(powers());
    CASE(hertz());
    CASE(shapes());
    CASE(least());
    CASE(refused());
    CASE(punch());
    CASE(punch_on_its_way());
    return unit_finish();
}
