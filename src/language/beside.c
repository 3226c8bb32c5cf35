/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Scenes beside the one whose load is looked at. Each is run ahead, looked at as that one is, so that it
 * takes the same way to the last digit, and leaves its states behind, some of the way at a time. */
#include "language/beside.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "number/array.h"

/* The state at an instant. */
typedef struct stop {
    runner run;
    sight coarse[LEVELS - 1];
} stop;

struct side {
    scene scene; /* changed */
    knob_value by[CHANGES];
    size_t count;
    calc_error error; /* raised: its load cannot be */
    stop *stop;       /* `stops` of them are valid, `made` have storage */
    size_t stops, made, room;
    size_t next;         /* of them to be asked for */
    double from;         /* the time of the first */
    size_t held, budget; /* slices that they hold, and may hold */
    bool full, no_memory;
    instant now;
    beside beside; /* further changes */
};

/* ---- life -------------------------------------------------------------------------------------- */

static void side_free(side *s) {
    beside_end(&s->beside);
    for (size_t i = 0; i < s->made; i++)
        engine_end(&s->stop[i].run.engine);
    free(s->stop);
    scene_free(&s->scene);
    free(s);
}

void beside_end(beside *b) {
    while (b->count)
        side_free(b->side[--b->count]);
}

static bool same_changes(const side *s, const knob_value by[], size_t count) {
    bool same = s->count == count;
    for (size_t i = 0; i < count && same; i++) {
        const knob *p = &s->by[i].p, *q = &by[i].p;
        same = p->is_input == q->is_input && (p->is_input ? p->in == q->in : p->name == q->name) &&
               s->by[i].v == by[i].v && dim_equal(p->d, q->d);
    }
    return same;
}

/* Values that are new at each instant need no states ahead. */
enum { HELD = 1 << 17, FEW = SIDES / 4 };

static side *side_make(beside *b, const scene *changed, const knob_value by[], size_t count) {
    side *s = calloc(1, sizeof *s);
    if (!s)
        return NULL;
    if (b->count == SIDES)
        side_free(b->side[--b->count]);
    scene_clone(&s->scene, changed);
    s->scene.now = NULL;
    memcpy(s->by, by, count * sizeof *by);
    s->count = count;
    s->budget = b->count < FEW ? HELD : 1;
    s->beside.looks = b->looks;
    b->side[b->count++] = s;
    return s;
}

/* To the front. */
static side *side_find(beside *b, const scene *changed, const knob_value by[], size_t count) {
    size_t i = 0;
    while (i < b->count && !same_changes(b->side[i], by, count))
        i++;
    if (i == b->count) {
        if (!side_make(b, changed, by, count))
            return NULL;
        i = b->count - 1;
    }
    side *s = b->side[i];
    memmove(b->side + 1, b->side, i * sizeof *b->side);
    return b->side[0] = s;
}

/* ---- running ahead ----------------------------------------------------------------------------- */

static bool keep_runner(side *s, stop *to, const runner *r) {
    engine kept = to->run.engine;
    to->run = *r;
    to->run.engine = kept;
    to->run.load = NULL;
    to->run.watch = NULL;
    if (r->coarse)
        memcpy(to->coarse, r->coarse, sizeof to->coarse);
    const fret_status st = engine_copy(&to->run.engine, &r->engine);
    s->no_memory = st.code;
    return !st.code;
}

/* Looks less than this part of their distance apart are at the same instant. */
static const double APART = 1e-8;

static bool keep(const runner *r, void *context) {
    enum { RUNNER = 8 }; /* about its size, in slices */
    side *s = context;
    if (r->time < s->from - APART * s->beside.looks.every)
        return true;
    s->full = s->held >= s->budget;
    if (s->full)
        return false;
    stop *grown = fret_array_for(s->stop, &s->room, s->stops + 1, sizeof *grown);
    s->no_memory = !grown;
    if (!grown)
        return false;
    s->stop = grown;
    if (s->stops == s->made)
        s->stop[s->made++].run.engine = (engine){.contact = NULL};
    fret_state now;
    engine_forces(&r->engine, &now);
    s->held += now.slices + RUNNER;
    return keep_runner(s, &s->stop[s->stops++], r);
}

/* once: at this time alone, which is no turning point here. */
static bool run_ahead(side *s, double time, bool once, calc_error *error) {
    calc_error mine;
    watch w = s->beside.looks;
    error_clear(&mine);
    if (once)
        w = watch_times(time, w.every, 0, false);
    w.see = keep;
    w.context = s;
    w.limit = true;
    if (s->held) /* there are more to come than have been kept */
        s->budget = 2 * s->budget < HELD ? 2 * s->budget : HELD;
    s->from = time;
    s->stops = s->next = s->held = 0;
    s->full = s->no_memory = false;
    s->scene.now = NULL;
    scene_moved(&s->scene);
    bool ok = scene_trace(&s->scene, &w, &mine);
    if (s->no_memory)
        return calc_no_memory(error);
    ok = ok || s->full;
    s->scene.sound = ok;
    if (!ok)
        *error = mine;
    if (!ok && !mine.stop)
        s->error = mine;
    return ok;
}

/* The one at the time, from the last one that was asked for on; or NULL. */
static stop *stop_at(side *s, double time) {
    while (s->next + 1 < s->stops &&
           fabs(s->stop[s->next + 1].run.time - time) < fabs(s->stop[s->next].run.time - time))
        s->next++;
    const bool there =
        s->next < s->stops && fabs(s->stop[s->next].run.time - time) <= APART * s->beside.looks.every;
    return there ? &s->stop[s->next] : NULL;
}

bool beside_scene(beside *b, const scene *changed, const knob_value by[], size_t count, double time,
                  scene **out, calc_error *error) {
    side *s = side_find(b, changed, by, count);
    if (!s)
        return calc_no_memory(error);
    if (s->error.raised) {
        *error = s->error;
        return false;
    }
    stop *at = stop_at(s, time);
    for (int once = 0; once < 2 && !at; once++) {
        if (!run_ahead(s, time, once, error))
            return false;
        at = stop_at(s, time);
    }
    if (!at) /* unreached: one load, run in any scene, passes the same times */
        return calc_fail(error, 0, 0, "there is no such instant in the changed scene");
    if (at->run.coarse)
        at->run.coarse = at->coarse;
    s->now = (instant){.run = &at->run, .beside = &s->beside};
    s->scene.now = &s->now;
    scene_moved(&s->scene);
    s->scene.used = 0;
    *out = &s->scene;
    return true;
}
