/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The run of a trial's load, and the scenes beside it. */
#include "language/along.h"

bool trial_along_begin(trial_along *a, trial *t, along_what what, load_mark from, size_t points, bool turns,
                       calc_error *error) {
    scene *s = &t->scene;
    *a = (trial_along){.t = t};
    if (!s->end.steps)
        return calc_fail(error, 0, 0, "there is no load yet: press first (press FN=100 N)");
    a->last = program_time(s->program, s->end);
    if (what == ALONG_LOAD)
        a->first = program_time(s->program, from);
    if (what == ALONG_CYCLE) {
        const size_t cycle = program_last_cycle(s->program, s->end);
        if (cycle == NO_CYCLE)
            return calc_fail(error, 0, 0, "no cycle has been run yet: use along cycle FA=...");
        a->last = program_time(s->program, (load_mark){cycle + 1, s->end.cycles});
        a->first = a->last - 1;
    }
    const bool lasts = a->last > a->first;
    a->beside.looks =
        watch_times(a->first, lasts ? (a->last - a->first) / (double)points : 1, lasts ? points : 0, turns);
    return trace_begin(&a->trace, s, a->beside.looks, true, error);
}

bool trial_along_next(trial_along *a, calc_error *error) {
    scene *s = &a->t->scene;
    do {
        if (!trace_next(&a->trace, error))
            return false;
        a->now = (instant){.run = trace_now(&a->trace), .beside = &a->beside};
    } while (a->now.run->time < a->first - 1e-9 || a->now.run->time > a->last + 1e-9);
    s->now = &a->now;
    scene_moved(s);
    return true;
}

void trial_along_end(trial_along *a) {
    a->t->scene.now = NULL;
    scene_moved(&a->t->scene);
    trace_end(&a->trace);
    beside_end(&a->beside);
}
