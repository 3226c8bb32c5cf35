/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One law, and one field, asked by several threads at once, and laws made like it: questions on what is const
 * write nothing, so each gets what it gets alone. The room `portable` runs this under ThreadSanitizer, which
 * knows what two have touched. */
#include <pthread.h>

#include "fret/cycle.h"
#include "fret/field.h"
#include "unit.h"

enum { THREADS = 4, STEPS = 60, PLACES = 20, ANSWERS = 4 * STEPS + 4 * PLACES, SIZES = 20 };

typedef struct asker {
    pthread_t thread;
    const fret_normal *law;
    const fret_field *field;
    fret_real answer[ANSWERS];
    int failed;
} asker;

static void step(asker *a, fret_contact *c, int i, fret_real out[4]) {
    const double s = sin(1.7 * i), FN = 100 + 20 * cos(0.9 * i);
    fret_pressed pressed = {.normal = a->law, .mu = 0.4};
    fret_state now;
    a->failed += fret_contact_step(c, &(fret_step){FRET_TO_FORCE, FRET_TO_FX, FN, 30 * s}).code != 0;
    fret_contact_state(c, &now);
    a->failed += fret_press_by_depth(a->law, 1e-6 * (1 + i % 7), &pressed.press).code != 0;
    a->failed += fret_cycle_loss_by_force(&pressed, 0.1 * (double)pressed.press.F, &out[3]).code != 0;
    out[0] = now.dx;
    out[1] = now.W;
    out[2] = now.c;
}

static void *ask(void *context) {
    asker *a = context;
    fret_contact *c = NULL;
    fret_real *next = a->answer;
    a->failed += fret_contact_make(a->law, 0.4, FRET_EXACT, &c).code != 0;
    for (int i = 0; i < STEPS && c; i++, next += 4)
        step(a, c, i, next);
    for (int i = 0; i < PLACES; i++, next += 4) {
        const fret_real r = 2e-5L * (fret_real)(i + 1);
        a->failed += fret_field_pressure(a->field, r, &next[0]).code != 0;
        a->failed += fret_field_surface(a->field, r, &next[1]).code != 0;
        a->failed += fret_field_traction(a->field, r, &next[2]).code != 0;
        a->failed += fret_field_surface_x(a->field, r, &next[3]).code != 0;
    }
    fret_contact_free(c);
    return NULL;
}

/* Laws of other sizes and materials, like the one. */
static void *make(void *context) {
    asker *a = context;
    for (int i = 0; i < SIZES; i++) {
        fret_material material = unit_make_scene(2, 0.3).material;
        fret_gap gap = *fret_normal_gap(a->law);
        fret_press press = {.F = 0};
        fret_normal *n = NULL;
        material.body[i % 2].E0 *= 1 + i;
        gap.R *= 1 + i / 2;
        a->failed += fret_normal_make(&material, &gap, a->law, NULL, &n).code != 0;
        a->failed += !n || fret_press_by_force(n, 100, &press).code != 0;
        a->answer[i] = press.dz;
        fret_normal_free(n);
    }
    return NULL;
}

static void at_once(void *(*run)(void *), const fret_normal *law, const fret_field *field, int answers) {
    static asker alone, all[THREADS];
    alone = (asker){.law = law, .field = field};
    run(&alone);
    CHECK(!alone.failed);
    for (int i = 0; i < THREADS; i++)
        all[i] = (asker){.law = law, .field = field};
    int made = 0;
    while (made < THREADS && !pthread_create(&all[made].thread, NULL, run, &all[made]))
        made++;
    CHECK(made == THREADS);
    for (int i = 0; i < made; i++) {
        pthread_join(all[i].thread, NULL);
        CHECK(!all[i].failed);
        for (int j = 0; j < answers; j++)
            CHECK(all[i].answer[j] == alone.answer[j]);
    }
}

static void shared(const fret_gap *gap) {
    unit_scene s = unit_make_scene(2, 0.3);
    fret_contact *c = NULL;
    fret_field *field = NULL;
    const fret_normal *law = unit_keep_normal(&s.material, gap);
    CHECK_OK(fret_contact_make(law, 0.4, FRET_EXACT, &c));
    CHECK_OK(fret_contact_step(c, &(fret_step){FRET_TO_FORCE, FRET_TO_FX, 100, 0}));
    CHECK_OK(fret_contact_step(c, &(fret_step){FRET_TO_FORCE, FRET_TO_FX, 110, 20}));
    CHECK_OK(fret_field_make(c, &field));
    at_once(ask, law, field, ANSWERS);
    at_once(make, law, field, SIZES);
    fret_field_free(field);
    fret_contact_free(c);
}

static void power_law(void) {
    const unit_scene s = unit_make_scene(2, 0.3);
    shared(&s.gap);
}

static void shape(void) {
    shared(&(fret_gap){.kind = FRET_GAP_FLAT_ROUNDED, .b = 1e-4, .R = 1e-2});
}

static void rows(void) {
    enum { ROWS = 50 };
    static double r[ROWS], f[ROWS];
    struct fret_table *table = NULL;
    for (int i = 0; i < ROWS; i++) {
        r[i] = 2e-3 * i / (ROWS - 1);
        f[i] = r[i] * r[i] / 0.02;
    }
    CHECK_OK(fret_table_make(r, f, ROWS, NULL, &table));
    shared(&(fret_gap){.kind = FRET_GAP_TABLE, .table = table});
    while (unit.normals)
        fret_normal_free(unit.normal[--unit.normals]);
    fret_table_free(table);
}

int main(int argc, char **argv) {
    unit_start("threads", argc, argv);
    CASE(power_law());
    CASE(shape());
    CASE(rows());
    return unit_finish();
}
