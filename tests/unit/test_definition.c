/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The loss by its definition, against tables of 36 digits and against the closed forms. */
#include "unit.h"

static fret_real loss, error;

static fret_status by_force(const fret_pressed *c, double FA) {
    fret_loading peak = {0, 0, 0, 0};
    const fret_status st = fret_loading_by_force(c, FA, &peak);
    return st.code ? st : fret_cycle_loss_by_definition(c, &peak, &loss, &error);
}

static fret_status by_displacement(const fret_pressed *c, double dA) {
    fret_loading peak = {0, 0, 0, 0};
    const fret_status st = fret_loading_by_displacement(c, dA, &peak);
    return st.code ? st : fret_cycle_loss_by_definition(c, &peak, &loss, &error);
}

static void scenes(void) {
    unit_table t;
    if (!unit_open(&t, "scene.csv"))
        return;
    while (unit_row(&t)) {
        unit_scene s = unit_read_scene(&t, 0);
        double FN = unit_input(&t, UNIT_SCENE_COLUMNS), FA = unit_input(&t, UNIT_SCENE_COLUMNS + 1);
        fret_pressed c = unit_make_contact(&s, FN);
        CHECK_OK(by_force(&c, FA));
        CHECK(error >= LDBL_EPSILON && error < UNIT_TOL(1e-17L, 1e-14L));
        CHECK_REL(loss, unit_result(&t, UNIT_SCENE_COLUMNS + 2 + 5), UNIT_TOL(2e-17L, 1e-14L));
    }
}

/* Other shapes: the closed form integrates the same by parts, over slices of the load. */
static void shapes(void) {
    static const double ks[] = {-0.7, 0, 0.5}, ts[] = {1e-4, 0.1, 0.5, 0.9, 1};
    static const fret_gap gaps[] = {
        {.kind = FRET_GAP_SUM, .terms = 2, .power = {{2, 50, 1}, {4, 2e6, 1}}},
        {.kind = FRET_GAP_FLAT_CONE, .b = 1e-4, .slope = 0.01},
        {.kind = FRET_GAP_FLAT_PARABOLOID, .b = 1e-4, .R = 1e-2},
        {.kind = FRET_GAP_FLAT_ROUNDED, .b = 1e-4, .R = 1e-2},
        {.kind = FRET_GAP_EXACT_SPHERE, .R = 1e-2},
    };
    for (size_t i = 0; i < sizeof gaps / sizeof *gaps; i++)
        for (size_t j = 0; j < sizeof ks / sizeof *ks; j++) {
            unit_scene s = unit_make_scene(2, ks[j]);
            s.gap = gaps[i];
            fret_pressed c = unit_make_contact(&s, 100);
            for (size_t l = 0; l < sizeof ts / sizeof *ts; l++) {
                fret_real same;
                double FA = ts[l] * c.mu * 100;
                CHECK_OK(fret_cycle_loss_by_force(&c, FA, &same));
                CHECK_OK(by_force(&c, FA));
                CHECK_ABS(error, 0, 1, UNIT_TOL(1e-12L, 1e-9L));
                CHECK_REL(loss, same, UNIT_TOL(1e-12L, 1e-9L));
                same = loss;
                fret_loading peak;
                CHECK_OK(fret_loading_by_force(&c, FA, &peak));
                CHECK_OK(by_displacement(&c, (double)peak.dx));
                CHECK_REL(loss, same, 1e-11L);
            }
        }
}

/* Near a flat end and k = -1 nearly all of the annulus lies within the last digits of its radius: what the
 * reference cannot tell it says. */
static void flat_ends(void) {
    static const double ks[] = {-0.7, -0.8, -0.9, -0.95}, rests[] = {0.3, 1e-2, 1e-4, 1e-8},
                        loads[] = {100, 1e4};
    static const fret_gap gaps[] = {{.kind = FRET_GAP_FLAT_CONE, .b = 1e-4, .slope = 0.01},
                                    {.kind = FRET_GAP_FLAT_PARABOLOID, .b = 1e-4, .R = 1e-2},
                                    {.kind = FRET_GAP_FLAT_ROUNDED, .b = 1e-4, .R = 1e-2}};
    for (size_t i = 0; i < sizeof gaps / sizeof *gaps; i++)
        for (size_t j = 0; j < sizeof ks / sizeof *ks; j++)
            for (size_t n = 0; n < sizeof loads / sizeof *loads; n++) {
                unit_scene s = unit_make_scene(2, ks[j]);
                s.gap = gaps[i];
                fret_pressed c = unit_make_contact(&s, loads[n]);
                for (size_t l = 0; l < sizeof rests / sizeof *rests; l++) {
                    fret_real same;
                    double FA = (1 - rests[l]) * c.mu * loads[n];
                    CHECK_OK(fret_cycle_loss_by_force(&c, FA, &same));
                    CHECK_OK(by_force(&c, FA));
                    CHECK(error < 1e-5L);
                    CHECK_REL(loss, same, fmaxl(error, UNIT_TOL(1e-13L, 1e-9L)));
                }
            }
}

/* Nothing of a rigid punch slips until all slides. */
static void punch(void) {
    unit_scene s = unit_make_scene(2, 0.3);
    s.gap = (fret_gap){.kind = FRET_GAP_FLAT, .b = 1e-4};
    const fret_pressed c = unit_make_contact(&s, 100);
    const fret_real max = fret_gross_slip(&c);
    const double dA = 2.5 * (double)max;
    CHECK_OK(by_force(&c, c.mu * 50));
    CHECK(loss == 0 && error == 0);
    CHECK_OK(by_displacement(&c, dA));
    CHECK_REL(loss, 4 * c.mu * 100.0L * (dA - max), UNIT_TOL(1e-17L, 1e-14L));
}

/* By displacement, into gross slip. */
static void amplitudes(void) {
    unit_scene s = unit_make_scene(2, -0.5);
    fret_pressed c = unit_make_contact(&s, 100);
    fret_real max = fret_gross_slip(&c), same;
    static const double part[] = {1e-6, 0.3, 1, 2.5};
    for (size_t i = 0; i < sizeof part / sizeof *part; i++) {
        double dA = (double)(part[i] * max);
        CHECK_OK(fret_cycle_loss_by_displacement(&c, dA, &same));
        CHECK_OK(by_displacement(&c, dA));
        CHECK_REL(loss, same, UNIT_TOL(2e-18L, 1e-14L));
        CHECK_OK(by_displacement(&c, -dA)); /* as the cycle turns there too */
        CHECK_REL(loss, same, UNIT_TOL(2e-18L, 1e-14L));
    }
    CHECK_OK(by_force(&c, 0));
    CHECK(loss == 0);
    const fret_loading none = {0, 0, c.press.a, c.press.dz};
    CHECK_OK(fret_cycle_loss_by_definition(&c, &none, &loss, &error));
    CHECK(loss == 0);
    CHECK_ERROR(fret_cycle_loss_by_definition(&(fret_pressed){c.normal, -1, c.press}, &none, &loss, &error),
                FRET_NOT_POSITIVE, "mu");
}

/* A sampled gap has corners: the closed form, which begins anew at each, is met. */
static void sampled(void) {
    enum { ROWS = 50 };
    double r[ROWS], f[ROWS];
    for (int i = 0; i < ROWS; i++) {
        r[i] = 1e-5 * i;
        f[i] = 2e-6 * pow(r[i] / 1e-4, 1.6);
    }
    unit_scene s = unit_make_scene(2, 0);
    struct fret_table *table = NULL;
    CHECK_OK(fret_table_make(r, f, ROWS, NULL, &table));
    s.gap = (fret_gap){.kind = FRET_GAP_TABLE, .table = table};
    fret_pressed c = unit_make_contact(&s, 20);
    fret_real closed = 0;
    CHECK_OK(by_force(&c, 4));
    CHECK(error < UNIT_TOL(1e-16L, 1e-12L));
    CHECK_OK(fret_cycle_loss_by_force(&c, 4, &closed));
    CHECK_REL(closed, loss, UNIT_TOL(2e-15L, 1e-12L));
    fret_table_free(table);
}

int main(int argc, char **argv) {
    unit_start("definition", argc, argv);
    CASE(scenes());
    CASE(shapes());
    CASE(flat_ends());
    CASE(punch());
    CASE(amplitudes());
    CASE(sampled());
    return unit_finish();
}
