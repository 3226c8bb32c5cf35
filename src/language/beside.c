/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Scenes beside the one whose load is looked at, each run on from instant to instant along with it. Uses
 * `scene`. */
#include "language/beside.h"

#include <stdlib.h>
#include <string.h>

typedef struct side {
    scene scene; /* changed */
    knob_value by[CHANGES];
    size_t count;
    scene_trace run; /* of its load, up to `time` */
    double time;
    instant now;
    beside beside; /* scenes with further changes */
} side;

static void side_free(side *s) {
    if (!s)
        return;
    beside_end(&s->beside);
    trace_end(&s->run);
    scene_free(&s->scene);
    free(s);
}

void beside_end(beside *b) {
    for (size_t i = 0; i < SIDES; i++)
        side_free(b->side[i]);
    *b = (beside){.made = 0};
}

static bool same_changes(const side *s, const knob_value by[], size_t count) {
    bool same = s->count == count;
    for (size_t i = 0; i < count && same; i++)
        same = !strcmp(s->by[i].p.text, by[i].p.text) && s->by[i].v == by[i].v &&
               dim_equal(s->by[i].p.d, by[i].p.d);
    return same;
}

/* Finds or makes the scene of these changes; the oldest one is replaced. */
static side *side_find(beside *b, const scene *changed, const knob_value by[], size_t count) {
    for (size_t i = 0; i < SIDES && b->side[i]; i++)
        if (same_changes(b->side[i], by, count))
            return b->side[i];
    side *s = calloc(1, sizeof *s), **at = &b->side[b->made++ % SIDES];
    if (!s)
        return NULL;
    side_free(*at);
    scene_clone(&s->scene, changed);
    memcpy(s->by, by, count * sizeof *by);
    s->count = count;
    return *at = s;
}

/* Runs on to this time; from the press if it is past it. A load passes the same times in every scene. */
static bool run_on(side *s, double time, calc_error *error) {
    const watch there = watch_times(time, 1, 0, false);
    if (s->run.levels && s->time == time)
        return true;
    if (s->time > time)
        trace_end(&s->run);
    scene_look(&s->scene, NULL);
    if (!s->run.levels && !trace_begin(&s->run, &s->scene, there, true, error))
        return false;
    for (unsigned i = 0; i < s->run.levels; i++)
        s->run.run[i].watch = there;
    s->time = time;
    return trace_next(&s->run, error) || (trace_end(&s->run), false);
}

bool beside_scene(beside *b, const scene *changed, const knob_value by[], size_t count, double time,
                  scene **out, calc_error *error) {
    side *s = side_find(b, changed, by, count);
    if (!s)
        return calc_no_memory(error);
    if (!run_on(s, time, error))
        return false;
    s->now = (instant){s->run.run, s->run.levels, &s->beside};
    scene_look(&s->scene, &s->now);
    s->scene.used = 0;
    *out = &s->scene;
    return true;
}
