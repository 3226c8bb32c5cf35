/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A load that is walked in parts ends where one ends that is run at once, to the last bit, wherever it rests
 * and is followed; a walk follows its scene. */
#include <float.h>

#include "language.h"

static void push(calc *c, load_step step, cycle_extra extra) {
    CHECK(load(c, step, extra));
}

static void begin(calc *c, bool swings) {
    press_steel(c, NULL, 0);
    push(c, (load_step){.kind = LOAD_STEP, .tangential = BY_FORCE, .tangential_value = 20, .points = 1},
         (cycle_extra){0});
    push(c,
         (load_step){.kind = LOAD_CYCLE,
                     .tangential = BY_FORCE,
                     .tangential_value = 12,
                     .normal_value = swings ? 30 : 0},
         (cycle_extra){.times = 3, .phase = 1});
    push(c,
         (load_step){.kind = LOAD_STEP, .tangential = BY_DISPLACEMENT, .tangential_value = 1e-7, .points = 1},
         (cycle_extra){0});
    push(c, (load_step){.kind = LOAD_CYCLE, .tangential = BY_DISPLACEMENT, .tangential_value = 2e-7},
         (cycle_extra){.times = 2});
}

/* The state at the end; followed at every so many looks, 0: never. How often that was. */
static unsigned walk_all(calc *c, unsigned every, fret_state *out) {
    walk w = {.begun = false};
    bool anew = false;
    unsigned looks = 0, rests = 0;
    CHECK(walk_follow(&w, c, &anew, fresh()) && anew);
    while (walk_next(&w, w.scene.end.steps, 5, true, &error))
        if (every && ++looks % every == 0) {
            CHECK(walk_follow(&w, c, &anew, &error) && !anew); /* nothing has changed */
            rests++;
        }
    CHECK(!error.raised && w.run.at.steps == w.scene.end.steps);
    engine_state(&w.run.engine, out);
    walk_end(&w);
    return rests;
}

static void parts(bool swings) {
    static const unsigned every[] = {1, 2, 7, 100};
    calc c;
    fret_state whole, sliced;
    begin(&c, swings);
    CHECK(walk_all(&c, 0, &whole) == 0);
    for (size_t i = 0; i < sizeof every / sizeof *every; i++) {
        const unsigned rests = walk_all(&c, every[i], &sliced);
        CHECK(every[i] > 7 && !swings ? rests == 0 : rests >= (swings ? 300u : 4u) / every[i]);
        CHECK(sliced.Fx == whole.Fx && sliced.dx == whole.dx && sliced.W == whole.W && sliced.U == whole.U &&
              sliced.FN == whole.FN && sliced.dz == whole.dz && sliced.c == whole.c);
    }
    calc_free(&c);
}

/* ---- what is the same -------------------------------------------------------------------------- */

static const load_step pressing = {.kind = LOAD_PRESS, .normal = BY_FORCE, .normal_value = 100};
static const load_step sliding = {
    .kind = LOAD_STEP, .tangential = BY_FORCE, .tangential_value = 20, .points = 1};
static const load_step swaying = {.kind = LOAD_CYCLE, .tangential = BY_FORCE, .tangential_value = 12};

/* A press, a step, `more` where it is one, and a cycle of three periods. */
static void load_again(calc *c, const load_step *more, const load_step *cycle, cycle_extra extra) {
    push(c, pressing, (cycle_extra){0});
    push(c, sliding, (cycle_extra){0});
    if (more)
        push(c, *more, (cycle_extra){0});
    push(c, *cycle, extra);
}

/* Does the walk begin anew for the scene as it is, and end where that ends? */
static bool goes_anew(walk *w, calc *c) {
    bool anew = false;
    fret_state got;
    const fret_state *want;
    error_clear(&error);
    CHECK(walk_follow(w, c, &anew, &error));
    while (walk_next(w, w->scene.end.steps, 5, true, &error))
        ;
    CHECK(!error.raised);
    engine_state(&w->run.engine, &got);
    CHECK(scene_state(c->now, &want, &error));
    const fret_real little = w->scene.answers.reach.swings ? 1e-5L : 1e-15L; /* chords; repeated periods */
    CHECK_REL(got.FN, want->FN, 2 * LDBL_EPSILON); /* powers are counted from where the way has been */
    CHECK(got.Fx == want->Fx);
    CHECK_REL(got.dx, want->dx, little);
    CHECK_REL(got.W, want->W, little);
    CHECK_REL(got.U, want->U, little);
    return anew;
}

static void follows(void) {
    static const cycle_extra three = {.times = 3};
    calc c;
    walk w = {.begun = false};
    bool anew;
    begin(&c, false);
    inputs *in = &c.now->in;
    error_clear(&error);
    load_again(&c, NULL, &swaying, three);
    CHECK(goes_anew(&w, &c) && !goes_anew(&w, &c));
    /* what is appended is run on; what comes before anything that has been run is not */
    load_step more = sliding;
    more.tangential_value = 5;
    push(&c, more, (cycle_extra){0});
    CHECK(!goes_anew(&w, &c));
    load_again(&c, NULL, &swaying, three);
    CHECK(goes_anew(&w, &c));
    /* another of each value that a step has */
    load_step other[7];
    for (int i = 0; i < 7; i++)
        other[i] = more;
    other[1].tangential_value = 6;
    other[2] = other[1], other[2].relative = RELATIVE_TANGENTIAL;
    other[3].normal = BY_FORCE, other[3].normal_value = 99;
    other[4].normal = BY_FORCE, other[4].normal_value = 98;
    other[5].tangential = BY_DISPLACEMENT, other[5].tangential_value = 5e-8;
    other[6].normal = BY_DISPLACEMENT, other[6].normal_value = 3e-6, other[6].tangential = BY_NONE;
    for (int i = 0; i < 7; i++) {
        load_again(&c, &other[i], &swaying, three);
        CHECK(goes_anew(&w, &c) && !goes_anew(&w, &c));
    }
    /* and of each that a cycle has */
    load_step cycle = swaying;
    load_again(&c, &more, &cycle, (cycle_extra){.times = 2});
    CHECK(goes_anew(&w, &c));
    load_again(&c, &more, &cycle, (cycle_extra){.times = 2, .phase = 1});
    CHECK(goes_anew(&w, &c));
    cycle.normal_value = 10;
    load_again(&c, &more, &cycle, (cycle_extra){.times = 2, .phase = 1});
    CHECK(goes_anew(&w, &c));
    load_again(&c, &more, &swaying, three);
    CHECK(goes_anew(&w, &c));
    scene_put(c.now, IN_FA, 11); /* amplitudes of the last cycle are inputs */
    CHECK(goes_anew(&w, &c));
    scene_put(c.now, IN_FN, 101);
    CHECK(goes_anew(&w, &c) && !goes_anew(&w, &c));
    /* other bodies */
    scene_put(c.now, IN_E0, 200e9);
    CHECK(goes_anew(&w, &c));
    scene_put(c.now, IN_MU, 0.5);
    CHECK(goes_anew(&w, &c));
    in->second = SECOND_RIGID;
    scene_forget(c.now, false);
    CHECK(goes_anew(&w, &c));
    inputs_geometry(in, geometry_find("cone"), NULL, NULL);
    inputs_put(in, IN_SLOPE, 0.05);
    scene_forget(c.now, false);
    CHECK(goes_anew(&w, &c));
    fret_gap sum = {.kind = FRET_GAP_SUM, .terms = 1, .power = {{.n = 2, .h = 1e-4, .r0 = 1e-3}}};
    for (int i = 0; i < 3; i++) {
        if (i == 1)
            sum.power[0].h = 2e-4;
        if (i == 2)
            sum.power[sum.terms++] = (fret_power){.n = 4, .h = 1e-5, .r0 = 1e-3};
        inputs_geometry(in, geometry_find("sum"), &sum, NULL);
        scene_forget(c.now, false);
        CHECK(goes_anew(&w, &c) && !goes_anew(&w, &c));
    }
    for (int i = 0; i < 2; i++) { /* two tables, the same numbers */
        inputs_geometry(in, geometry_find("file"), NULL, rows_of_sphere(40));
        scene_forget(c.now, false);
        CHECK(goes_anew(&w, &c) && !goes_anew(&w, &c));
    }
    /* a load that swings runs on in the same contact */
    scene_put(c.now, IN_MU, 0.6);
    CHECK(goes_anew(&w, &c));
    cycle = swaying;
    cycle.normal_value = 5;
    push(&c, cycle, (cycle_extra){.times = 1});
    CHECK(!goes_anew(&w, &c));
    load_again(&c, NULL, &swaying, three);
    CHECK(goes_anew(&w, &c));
    /* what follows another value may have changed; what has none is said */
    CHECK(assign(&c, "FA := 0.1*mu*FN") && goes_anew(&w, &c) && goes_anew(&w, &c));
    CHECK(assign(&c, "FA = 11 N") && goes_anew(&w, &c) && !goes_anew(&w, &c));
    CHECK(assign(&c, "y = 11 N") && assign(&c, "FA := y"));
    c.names.row[0].v.v = -1; /* behind its back */
    scene_forget(c.now, true);
    CHECK(!walk_follow(&w, &c, &anew, &error) && error.raised);
    error_clear(&error);
    c.names.row[0].v.v = 11;
    CHECK(assign(&c, "FA = 11 N"));
    /* a load that there is not */
    scene_reset(c.now, false);
    CHECK(!walk_follow(&w, &c, &anew, &error) && error.kind == ERROR_MISSING && error.input == IN_FN);
    walk_end(&w);
    calc_free(&c);
}

int main(int argc, char **argv) {
    unit_start("walk", argc, argv);
    CASE(parts(false));
    CASE(parts(true));
    CASE(follows());
    return unit_finish();
}
