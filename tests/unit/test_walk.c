/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A load that is walked in parts ends where one ends that is run at once, to the last bit, wherever it waits;
 * a walk follows its scene. */
#include "unit.h"

#define unit calc_unit /* names that calc has too */
#define value calc_value
#define quantity calc_quantity
#include "calc/walk.h"
#undef unit
#undef value
#undef quantity

typedef struct looker {
    walk *walk;
    unsigned every, seen; /* waits at every so many looks; 0: never */
} looker;

static bool see(const runner *r, void *context) {
    looker *l = context;
    (void)r;
    l->seen++;
    if (l->every && l->seen % l->every == 0)
        l->walk->watch.wait = true;
    return true;
}

static void push(calc *c, load_step step, cycle_extra extra) {
    calc_error error;
    error_clear(&error);
    CHECK(scene_load(c->now, &step, step.kind == LOAD_CYCLE ? &extra : NULL, &error));
}

static void begin(calc *c, bool swings) {
    calc_init(c, NULL);
    inputs *in = &c->now->in;
    inputs_put(in, IN_E0, 210e9);
    inputs_put(in, IN_NU, 0.3);
    inputs_put(in, IN_MU, 0.4);
    inputs_geometry(in, geometry_find("sphere", 6), NULL, NULL);
    inputs_put(in, IN_RADIUS, 0.01);
    push(c, (load_step){.kind = LOAD_PRESS, .normal = BY_FORCE, .normal_value = 100}, (cycle_extra){0});
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

/* The state at the end, by so many waits; how often it has waited. */
static unsigned walk_all(calc *c, unsigned every, fret_state *out) {
    walk w = {.begun = false};
    looker l = {&w, every, 0};
    calc_error error;
    bool anew = false;
    unsigned waits = 0;
    error_clear(&error);
    CHECK(walk_follow(&w, c, &anew, &error) && anew);
    while (w.run.at.steps < w.scene.end.steps && waits < 1000000) {
        CHECK(walk_on(&w, w.scene.end.steps, 5, true, see, &l, &error));
        waits += w.run.at.steps < w.scene.end.steps;
    }
    engine_state(&w.run.engine, out);
    CHECK(walk_follow(&w, c, &anew, &error) && !anew); /* nothing has changed */
    walk_end(&w);
    return waits;
}

static void parts(bool swings) {
    static const unsigned every[] = {1, 2, 7, 100};
    calc c;
    fret_state whole, sliced;
    begin(&c, swings);
    CHECK(walk_all(&c, 0, &whole) == 0);
    for (size_t i = 0; i < sizeof every / sizeof *every; i++) {
        const unsigned waits = walk_all(&c, every[i], &sliced);
        CHECK(every[i] > 7 && !swings ? waits == 0 : waits >= (swings ? 300u : 4u) / every[i]);
        CHECK(sliced.Fx == whole.Fx && sliced.dx == whole.dx && sliced.W == whole.W && sliced.U == whole.U &&
              sliced.FN == whole.FN && sliced.dz == whole.dz && sliced.c == whole.c);
    }
    calc_free(&c);
}

int main(int argc, char **argv) {
    unit_start("walk", argc, argv);
    parts(false);
    parts(true);
    return unit_finish();
}
