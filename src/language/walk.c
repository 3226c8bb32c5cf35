/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A scene that follows another one, and a run of its load. Uses `scene`. */
#include "language/walk.h"

void walk_end(walk *w) {
    if (!w->begun)
        return;
    engine_end(&w->run.engine);
    scene_free(&w->scene);
    *w = (walk){.begun = false};
}

/* ---- comparison -------------------------------------------------------------------------------- */

/* Are the inputs equal, apart from amplitudes and the press, which are compared with the steps? */
static bool same_bodies(const inputs *a, const inputs *b) {
    const bool wears =
        inputs_any(a, INPUT_BIT(IN_NW)) || inputs_any(b, INPUT_BIT(IN_NW)); /* needs all inputs */
    return !a->bindings && !b->bindings &&
           inputs_same(a, b, wears ? ~(input_set)0 : ~(INPUT_CYCLE | INPUT_PRESS));
}

bool walk_same_item(const load_item *a, const load_item *b) {
    const load_step *s = &a->step, *t = &b->step;
    return s->kind == t->kind && s->normal == t->normal && s->tangential == t->tangential &&
           s->relative == t->relative && s->normal_value == t->normal_value &&
           s->tangential_value == t->tangential_value &&
           (s->kind != LOAD_CYCLE || (a->extra.times == b->extra.times && a->extra.phase == b->extra.phase));
}

/* The number of steps at the beginning of the scene's load that equal those of the walk. */
static size_t same_items(const walk *w, const scene *s, size_t last_cycle) {
    const load_mark end = w->scene.end;
    load_mark at = {0, 0};
    while (at.steps < end.steps && at.steps < s->end.steps) {
        const load_item mine = program_item(w->scene.program, at, NO_CYCLE, &w->scene.in);
        const load_item its = program_item(s->program, at, last_cycle, &s->in);
        if (!walk_same_item(&mine, &its))
            break;
        at.steps++;
        at.cycles += mine.step.kind == LOAD_CYCLE;
    }
    return at.steps;
}

/* ---- following --------------------------------------------------------------------------------- */

/* Copies the inputs and the load of s. all: keeps the results, which these inputs did not change; else only
 * the contact, if it is the same. */
static bool take_scene(walk *w, const scene *s, size_t last_cycle, bool all, calc_error *error) {
    program *own = program_copy(s->program, s->end);
    scene before = w->scene;
    if (!own)
        return calc_no_memory(error);
    if (last_cycle != NO_CYCLE)
        program_freeze(own, last_cycle, s->end.cycles - 1, &s->in);
    scene_clone(&w->scene, s);
    counted_drop(&w->scene.program->base);
    w->scene.program = own;
    if (all) {
        w->scene.answers = before.answers;
        w->scene.answers.reach_ready = false;
        before.answers = (answers){.normal = NULL};
    } else {
        scene_take_contact(&w->scene, &before);
    }
    scene_free(&before);
    w->begun = true;
    return true;
}

static bool make_run(walk *w, calc_error *error) {
    engine_end(&w->run.engine);
    w->run = (runner){.load = &w->load, .watch = watch_path(1)};
    return calc_status(error, engine_make(&w->run.engine, w->load.normal, w->load.mu));
}

/* Is there a run on this contact? A harmonic load may need another contact than the load before it. */
static bool has_run(const walk *w) {
    return w->run.engine.contact && fret_contact_normal(w->run.engine.contact) == w->load.normal;
}

bool walk_follow(walk *w, calc *c, bool *anew, calc_error *error) {
    scene *s = c->now;
    const load_reach *reach;
    if (!s->end.steps)
        return calc_missing(error, IN_FN);
    if (!scene_reach(s, &reach, error)) /* this also evaluates definitions */
        return false;
    const bool goes_on = w->begun && same_bodies(&w->scene.in, &s->in) &&
                         same_items(w, s, reach->last_cycle) == w->scene.end.steps;
    if (!goes_on)
        engine_end(&w->run.engine);
    if (!take_scene(w, s, reach->last_cycle, goes_on, error))
        return false;
    if (!scene_load_of(&w->scene, &w->load, error))
        return false;
    w->load.last_cycle = NO_CYCLE;
    *anew = !has_run(w);
    if (*anew && !make_run(w, error))
        return false;
    w->run.level = w->scene.answers.reach.swings ? LEVELS - 1 : 0;
    return true;
}

/* ---- walking ----------------------------------------------------------------------------------- */

bool walk_next(walk *w, size_t item, unsigned points, bool all, calc_error *error) {
    w->run.watch.points = points;
    w->run.watch.once = !all;
    return run_next(&w->run, (load_mark){item, 0}) || (calc_status(error, w->run.status), false);
}

void walk_more(walk *w) {
    runner *r = &w->run;
    if (r->at.steps == w->scene.end.steps) {
        r->at.steps--;
        r->at.cycles--;
        r->within = true;
    }
    if (r->within && r->at.steps + 1 == w->scene.end.steps)
        run_more(r);
    w->scene.program->cycles[w->scene.end.cycles - 1].times++;
}

void walk_enter(walk *w, calc *c) {
    w->now = (instant){.run = &w->run, .levels = 1};
    w->outer = c->now;
    c->now = &w->scene;
    scene_look(&w->scene, &w->now);
}

void walk_leave(walk *w, calc *c) {
    c->now = w->outer;
    scene_look(&w->scene, NULL);
}
