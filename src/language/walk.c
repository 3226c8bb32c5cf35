/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A scene of its own that follows another one, and a run of its load. */
#include "language/walk.h"

#include <string.h>

void walk_end(walk *w) {
    if (!w->begun)
        return;
    engine_end(&w->run.engine);
    scene_free(&w->scene);
    *w = (walk){.begun = false};
}

/* ---- what is the same -------------------------------------------------------------------------- */

/* Amplitudes and what the press imposes are compared with the steps that have them. */
static bool same_bodies(const inputs *a, const inputs *b) {
    const bool wears = inputs_any(a, INPUT_BIT(IN_NW)) || inputs_any(b, INPUT_BIT(IN_NW)); /* by all of it */
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

/* Items at the beginning of the scene's load that are those of the walk. */
static load_mark same_items(const walk *w, const scene *s, size_t last_cycle) {
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
    return at;
}

/* ---- following --------------------------------------------------------------------------------- */

/* The items of s from the mark on, with their values. */
static bool take_items(walk *w, const scene *s, size_t last_cycle, load_mark at, calc_error *error) {
    scene *own = &w->scene;
    while (at.steps < s->end.steps) {
        const load_item item = program_item(s->program, at, last_cycle, &s->in);
        const bool cycle = item.step.kind == LOAD_CYCLE;
        if (!program_append(own->program, &own->end, &item.step, cycle ? &item.extra : NULL))
            return calc_no_memory(error);
        at = own->end;
    }
    own->answers.reach_ready = false;
    return true;
}

static void put_inputs(walk *w, const inputs *in) {
    inputs own;
    inputs_copy(&own, in);
    inputs_drop(&w->scene.in);
    w->scene.in = own;
}

static bool begin(walk *w, calc *c, size_t last_cycle, calc_error *error) {
    program *own = program_make();
    scene before = w->scene;
    engine_end(&w->run.engine);
    *w = (walk){.begun = own != NULL};
    if (own) {
        scene_clone(&w->scene, c->now);
        scene_take_contact(&w->scene, &before);
        counted_drop(&w->scene.program->base);
        w->scene.program = own;
        w->scene.end = (load_mark){0, 0};
    }
    scene_free(&before);
    if (!own)
        return calc_no_memory(error);
    return take_items(w, c->now, last_cycle, (load_mark){0, 0}, error);
}

static bool make_run(walk *w, calc_error *error) {
    engine_end(&w->run.engine);
    w->run = (runner){.load = &w->load, .watch = watch_way(1)};
    const fret_status st = engine_make(&w->run.engine, w->load.normal, w->load.mu);
    return calc_status(error, &st);
}

/* A swinging load may want another contact than the one before it. */
static bool stands(const walk *w) {
    return w->run.engine.contact && fret_contact_normal(w->run.engine.contact) == w->load.normal;
}

bool walk_follow(walk *w, calc *c, bool *anew, calc_error *error) {
    scene *s = c->now;
    const load_reach *reach;
    if (!s->end.steps)
        return calc_missing(error, IN_FN);
    if (!scene_reach(s, &reach, error)) /* definitions have their values */
        return false;
    const size_t last_cycle = reach->last_cycle;
    *anew = !w->begun || !same_bodies(&w->scene.in, &s->in) ||
            same_items(w, s, last_cycle).steps < w->scene.end.steps;
    if (*anew ? !begin(w, c, last_cycle, error) : !take_items(w, s, last_cycle, w->scene.end, error))
        return false;
    put_inputs(w, &s->in);
    if (!scene_load_of(&w->scene, &w->load, error))
        return false;
    w->load.last_cycle = NO_CYCLE;
    if (!*anew && !stands(w))
        *anew = true;
    if (*anew && !make_run(w, error))
        return false;
    w->run.level = w->scene.answers.reach.swings ? LEVELS - 1 : 0;
    return true;
}

/* ---- walking ----------------------------------------------------------------------------------- */

bool walk_next(walk *w, size_t item, unsigned points, bool all, calc_error *error) {
    w->run.watch.points = points;
    w->run.watch.once = !all;
    return run_next(&w->run, (load_mark){item, 0}) || (calc_status(error, &w->run.status), false);
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
    w->now = (instant){.run = &w->run};
    w->outer = c->now;
    c->now = &w->scene;
    w->scene.now = &w->now;
    scene_moved(&w->scene);
}

void walk_leave(walk *w, calc *c) {
    c->now = w->outer;
    w->scene.now = NULL;
    scene_moved(&w->scene);
}
