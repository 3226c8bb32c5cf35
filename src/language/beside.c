/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Scenes beside the one whose load is looked at, run along with it and with the same looks, so that all take
 * the same steps to the last digit. Uses `scene`. */
#include "language/beside.h"

#include <stdlib.h>
#include <string.h>

typedef struct side {
    scene scene; /* changed */
    knob_value by[CHANGES];
    size_t count;
    calc_error error;        /* raised: its load is impossible */
    scene_trace along, once; /* runs with the looks of the run; with one look */
    instant now;
    beside beside; /* scenes with further changes */
} side;

/* ---- life -------------------------------------------------------------------------------------- */

static void side_free(side *s) {
    if (!s)
        return;
    beside_end(&s->beside);
    trace_end(&s->along);
    trace_end(&s->once);
    scene_free(&s->scene);
    free(s);
}

void beside_end(beside *b) {
    for (size_t i = 0; i < SIDES; i++) {
        side_free(b->side[i]);
        b->side[i] = NULL;
    }
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

/* Finds or makes the scene of these changes; the oldest one is replaced. */
static side *side_find(beside *b, const scene *changed, const knob_value by[], size_t count) {
    for (size_t i = 0; i < SIDES && b->side[i]; i++)
        if (same_changes(b->side[i], by, count))
            return b->side[i];
    side *s = calloc(1, sizeof *s), **at = &b->side[b->made % SIDES];
    if (!s)
        return NULL;
    side_free(*at);
    scene_clone(&s->scene, changed);
    s->scene.now = NULL;
    memcpy(s->by, by, count * sizeof *by);
    s->count = count;
    s->beside.looks = b->looks;
    b->made++;
    return *at = s;
}

/* ---- running along ----------------------------------------------------------------------------- */

/* Looks closer than this part of their spacing are at the same instant. */
static const double APART = 1e-8;

static bool begin(side *s, scene_trace *t, watch w, calc_error *error) {
    scene_look(&s->scene, NULL);
    return trace_begin(t, &s->scene, w, true, error);
}

/* Runs on to the look at this time; NULL: there is none, or an error. */
static const scene_trace *run_along(side *s, double time, calc_error *error) {
    const double little = APART * s->beside.looks.every;
    bool there = true;
    if (!s->along.levels)
        there = begin(s, &s->along, s->beside.looks, error) && trace_next(&s->along, error);
    while (there && trace_now(&s->along)->time < time - little)
        there = trace_next(&s->along, error);
    return there && trace_now(&s->along)->time <= time + little ? &s->along : NULL;
}

/* Runs to this time alone, which is no look of this scene's own run. */
static const scene_trace *run_once(side *s, double time, calc_error *error) {
    trace_end(&s->once);
    const bool there = begin(s, &s->once, watch_times(time, s->beside.looks.every, 0, false), error) &&
                       trace_next(&s->once, error);
    if (!there && !error->raised) /* not reached: a load passes the same times in every scene */
        calc_fail(error, 0, 0, "there is no such instant in the changed scene");
    return there ? &s->once : NULL;
}

bool beside_scene(beside *b, const scene *changed, const knob_value by[], size_t count, double time,
                  scene **out, calc_error *error) {
    side *s = side_find(b, changed, by, count);
    calc_error mine;
    if (!s)
        return calc_no_memory(error);
    if (s->error.raised) {
        *error = s->error;
        return false;
    }
    error_clear(&mine);
    const scene_trace *t = run_along(s, time, &mine);
    if (!t && !mine.raised)
        t = run_once(s, time, &mine);
    if (!t) {
        *error = mine;
        if (!mine.stop)
            s->error = mine;
        return false;
    }
    s->now = (instant){t->run, t->levels, &s->beside};
    scene_look(&s->scene, &s->now);
    s->scene.used = 0;
    *out = &s->scene;
    return true;
}
