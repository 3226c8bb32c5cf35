/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A load of many rows: it waits until something is asked, forces that are shown with few digits are had in
 * double, and agree with the diagram that has taken the same steps one by one; all else, and what is small
 * beside what the load went through, is that diagram's to the last bit. */
#include "calc/engine.h"
#include "failing.h"
#include "language.h"

static volatile sig_atomic_t stop;

enum { ROWS = 6000, ENOUGH = 4096 };

/* Rows by F_N and F_x or by dz and dx, of which the last are given; the exact diagram behind each. */
typedef struct history {
    load_by by;
    double normal[ROWS], tangential[ROWS], FN_most;
    fret_normal *contact;
    fret_contact *exact;
} history;
static history h;

static double FN_size = 100;

static void make_rows(load_by by, double tangential_size, double last_normal, double last_tangential) {
    const double normal = by == BY_FORCE ? FN_size : 9e-6, tangential = tangential_size;
    h = (history){.by = by};
    for (int i = 0; i < ROWS; i++) {
        h.normal[i] = normal * (1 + 0.1 * sin(0.013 * i));
        h.tangential[i] = tangential * (15 * sin(0.37 * i) + 8 * sin(0.0113 * i)) / 40;
    }
    h.normal[ROWS - 1] = last_normal;
    h.tangential[ROWS - 1] = last_tangential;
}

/* The contact of the scene, stepped by the library. */
static void step_exactly(calc *c, int rows) {
    const fret_normal *normal;
    fret_material material;
    const bool by_force = h.by == BY_FORCE;
    fret_step step = {FRET_TO_FORCE, FRET_KEEP_DX, 100, 0};
    CHECK(scene_normal(c->now, &normal, fresh()) && scene_material(c->now, false, &material, fresh()));
    CHECK_OK(fret_normal_make(&material, fret_normal_gap(normal), NULL, NULL, &h.contact));
    CHECK_OK(fret_contact_make(h.contact, 0.4, FRET_EXACT, &h.exact));
    CHECK_OK(fret_contact_step(h.exact, &step));
    for (int i = 0; i < rows; i++) {
        step = (fret_step){by_force ? FRET_TO_FORCE : FRET_TO_DEPTH, by_force ? FRET_TO_FX : FRET_TO_DX,
                           h.normal[i], h.tangential[i]};
        CHECK_OK(fret_contact_step(h.exact, &step));
    }
}

static void free_exact(void) {
    fret_contact_free(h.exact);
    fret_normal_free(h.contact);
}

static bool load_rows(calc *c, int rows) {
    const unsigned char by = (unsigned char)h.by;
    const load_step step = {.kind = LOAD_STEP, .normal = by, .tangential = by};
    size_t bad;
    return scene_load_rows(c->now, step, h.normal, h.tangential, (size_t)rows, &bad, fresh());
}

static void begin(calc *c, int digits, int rows) {
    press_steel(c, &stop, 0);
    scene_set_model(c->now, true, MODEL_CLOSED, 0);
    scene_show(c->now, digits);
    CHECK(load_rows(c, rows));
    c->now->used = 0;
}

static size_t waiting(const calc *c) {
    return c->now->end.steps - c->now->answers.run[0].at.steps;
}

typedef struct forces {
    double FN, dz, a, Fx, dx, W;
} forces;

static forces asked(calc *c) {
    const fret_press *press;
    const fret_state *now;
    long double FN = 0;
    CHECK(scene_forces(c->now, &now, fresh()));
    forces f = {.Fx = (double)now->Fx, .dx = (double)now->dx, .W = (double)now->W};
    CHECK(scene_press(c->now, &press, fresh()) && scene_FN(c->now, &FN, fresh()) && FN == press->F);
    f.FN = (double)FN;
    f.dz = (double)press->dz;
    f.a = (double)press->a;
    return f;
}

static forces told(void) {
    fret_state now;
    fret_contact_state(h.exact, &now);
    return (forces){(double)now.FN, (double)now.dz, (double)now.a,
                    (double)now.Fx, (double)now.dx, (double)now.W};
}

/* By which, and how many steps wait then. */
static void must_be(calc *c, bool in_double) {
    fret_press most;
    const forces is = asked(c), want = told();
    if (!in_double) {
        CHECK(!memcmp(&is, &want, sizeof is) && c->now->used == USED(MODEL_MEMORY) && waiting(c) == 0);
        return;
    }
    CHECK(c->now->used == USED(MODEL_DOUBLE) && waiting(c) > 0);
    CHECK_OK(fret_press_by_force(h.contact, 120, &most)); /* more than any */
    const fret_pressed contact = {.normal = h.contact, .mu = 0.4, .press = most};
    const double slip = (double)fret_gross_slip(&contact);
    CHECK_ABS(is.FN, want.FN, 120, 1e-14L);
    CHECK_ABS(is.dz, want.dz, (double)most.dz, 1e-14L);
    CHECK_ABS(is.a, want.a, (double)most.a, 1e-14L);
    CHECK_ABS(is.Fx, want.Fx, 48, 3e-14L);
    CHECK_ABS(is.dx, want.dx, slip, 3e-14L);
    CHECK_ABS(is.W, want.W, want.W + 48 * slip, 1e-13L);
}

/* As text of so many digits; then all of them, and as text again, for which no step waits any more. */
static void rows_of(load_by by, double size, double normal, double tangential, int digits, bool in_double) {
    calc c;
    make_rows(by, size, normal, tangential);
    begin(&c, digits, ROWS);
    CHECK(waiting(&c) == ROWS);
    step_exactly(&c, ROWS);
    must_be(&c, in_double);
    scene_show(c.now, 0);
    c.now->used = 0;
    must_be(&c, false);
    scene_show(c.now, digits);
    c.now->used = 0;
    must_be(&c, false);
    free_exact();
    calc_free(&c);
}

/* A hundredth of the last digit is 1e-8 of a value of six digits, and the forces of the load are sure to
 * 1e-13 of the largest: they tell a value down to 1e-5 of that. */
static void small_values(void) {
    const double dz = 9e-6, dx = 1e-7;
    rows_of(BY_FORCE, 40, 104, 9, 6, true);
    rows_of(BY_FORCE, 40, 104, 9, 10, true);
    rows_of(BY_FORCE, 40, 104, 9, 11, false);
    rows_of(BY_FORCE, 40, 104, 9, 0, false);
    rows_of(BY_FORCE, 40, 104, -6e-4, 6, true);
    rows_of(BY_FORCE, 40, 104, 3e-4, 6, false);
    rows_of(BY_FORCE, 40, 104, 0, 6, false);
    rows_of(BY_FORCE, 40, 2e-3, 6e-4, 6, true);
    rows_of(BY_FORCE, 40, 1e-4, 3e-5, 6, false);
    rows_of(BY_FORCE, 1e-4, 104, 9, 6, true);
    rows_of(BY_FORCE, 1e-9, 104, 3, 6, true);
    rows_of(BY_FORCE, 1e-9, 104, 1, 6, false); /* next to nothing has been dissipated */
    FN_size = 1e-3;                            /* the press counts, too */
    rows_of(BY_FORCE, 4e-4, 8e-4, 2e-4, 6, false);
    FN_size = 1;
    rows_of(BY_FORCE, 0.4, 0.9, 0.1, 6, true);
    FN_size = 100;
    rows_of(BY_DISPLACEMENT, 4e-6, dz, dx, 6, true);
    rows_of(BY_DISPLACEMENT, 4e-6, dz, 1e-12, 6, false);
    rows_of(BY_DISPLACEMENT, 4e-6, 1e-9, dx, 6, false);
}

static void few_rows(void) {
    calc c;
    make_rows(BY_FORCE, 40, 104, 9);
    for (int rows = ENOUGH - 1; rows <= ENOUGH; rows++) {
        begin(&c, 6, rows);
        step_exactly(&c, rows);
        must_be(&c, rows == ENOUGH);
        free_exact();
        calc_free(&c);
    }
}

/* What forces do not tell, a step and a cycle are of the exact diagram, and so is all behind them; rows
 * behind a cycle do not wait. */
static void goes_on(void) {
    static const load_step slide = {.kind = LOAD_STEP,
                                    .tangential = BY_FORCE,
                                    .tangential_value = 5,
                                    .points = 1},
                           cycle = {.kind = LOAD_CYCLE, .tangential = BY_FORCE, .tangential_value = 5};
    const fret_step same = {FRET_KEEP_NORMAL, FRET_TO_FX, 0, 5};
    const fret_state *now;
    calc c;
    make_rows(BY_FORCE, 40, 104, 9);
    begin(&c, 6, ROWS);
    step_exactly(&c, ROWS);
    must_be(&c, true);
    fret_state want;
    fret_contact_state(h.exact, &want);
    CHECK(scene_state(c.now, &now, fresh()) && now->c == want.c && now->U == want.U && waiting(&c) == 0);
    c.now->used = 0;
    must_be(&c, false);
    free_exact();
    calc_free(&c);
    begin(&c, 6, ROWS);
    step_exactly(&c, ROWS);
    must_be(&c, true);
    c.now->used = 0;
    CHECK(load(&c, slide, (cycle_extra){0}) && waiting(&c) == 0);
    CHECK_OK(fret_contact_step(h.exact, &same));
    must_be(&c, false);
    CHECK(load(&c, cycle, (cycle_extra){.times = 1}) && load_rows(&c, ROWS) && waiting(&c) == 0);
    free_exact();
    calc_free(&c);
}

/* Gross slip on the way, or a model that was asked for: not to be had so. */
static void never(void) {
    calc c;
    make_rows(BY_FORCE, 40, 104, 9);
    h.tangential[5] = 0.4 * h.normal[5];
    begin(&c, 6, ROWS);
    CHECK(waiting(&c) == 0);
    calc_free(&c);
    make_rows(BY_FORCE, 40, 104, 9);
    press_steel(&c, &stop, 0);
    scene_set_model(c.now, false, MODEL_MEMORY, 0);
    scene_show(c.now, 6);
    CHECK(load_rows(&c, ROWS) && waiting(&c) == 0);
    calc_free(&c);
    press_steel(&c, &stop, 12); /* no power law */
    scene_set_model(c.now, true, MODEL_CLOSED, 0);
    scene_show(c.now, 6);
    CHECK(load_rows(&c, 100) && waiting(&c) == 0);
    calc_free(&c);
}

/* F_N ~ dz^6, of which the diagram in double promises less. */
static void steep(void) {
    calc c;
    const fret_state *now;
    for (int i = 0; i < 2; i++) {
        calc_init(&c, &stop);
        inputs *in = &c.now->in;
        inputs_put(in, IN_E0, 210e9);
        inputs_put(in, IN_NU, 0.3);
        inputs_put(in, IN_MU, 0.4);
        inputs_geometry(in, geometry_find("power", 5), NULL, NULL);
        inputs_put(in, IN_N, i ? 0.2 : 0.3);
        inputs_put(in, IN_A, i ? 1e-5 : 3e-5);
        scene_set_model(c.now, true, MODEL_CLOSED, 0);
        CHECK(load(&c, (load_step){.kind = LOAD_PRESS, .normal = BY_FORCE, .normal_value = 100},
                   (cycle_extra){0}));
        scene_show(c.now, 6);
        make_rows(BY_FORCE, 40, 104, 9);
        CHECK(load_rows(&c, ROWS) && waiting(&c) == (i ? 0 : ROWS));
        c.now->used = 0;
        CHECK(scene_forces(c.now, &now, fresh()) && c.now->used == USED(i ? MODEL_MEMORY : MODEL_DOUBLE));
        calc_free(&c);
    }
}

/* Without memory, or interrupted, the exact diagram is asked, which tells it. */
static void trouble(void) {
    const fret_state *now;
    bool failed = true, without = false;
    calc c;
    make_rows(BY_FORCE, 40, 104, 9);
    for (int n = 0; failed && n < 100; n++) {
        begin(&c, 6, ROWS);
        left = n;
        const bool ok = scene_forces(c.now, &now, fresh());
        failed = left < 0;
        left = -1;
        CHECK(ok || out_of_memory(&c));
        without = without || (ok && c.now->used == USED(MODEL_MEMORY));
        CHECK(scene_forces(c.now, &now, fresh()) && fabsl(now->Fx - 9) < 1e-12L);
        calc_free(&c);
    }
    CHECK(!failed && without);
    begin(&c, 6, ROWS);
    stop = 1;
    CHECK(!scene_forces(c.now, &now, fresh()) && error.stop);
    stop = 0;
    CHECK(scene_forces(c.now, &now, fresh()) && fabsl(now->Fx - 9) < 1e-12L);
    calc_free(&c);
}

int main(int argc, char **argv) {
    unit_start("test_long_load", argc, argv);
    CASE(small_values());
    CASE(few_rows());
    CASE(goes_on());
    CASE(never());
    CASE(steep());
    CASE(trouble());
    return unit_finish();
}
