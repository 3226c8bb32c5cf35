/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The run of a trial's load, and the scenes beside it. */
#include "language/along.h"

bool trial_along_span(trial *t, along_what what, load_mark from, double *first, double *last,
                      calc_error *error) {
    const scene *s = &t->scene;
    if (!s->end.steps)
        return calc_fail(error, 0, 0, "there is no load yet: press first (press FN=100 N)");
    *first = what == ALONG_LOAD ? program_time(s->program, from) : 0;
    *last = program_time(s->program, s->end);
    if (what != ALONG_CYCLE)
        return true;
    const size_t cycle = program_last_cycle(s->program, s->end);
    if (cycle == NO_CYCLE)
        return calc_fail(error, 0, 0, "no cycle has been run yet: cycle first (cycle FA=20 N)");
    *last = program_time(s->program, (load_mark){cycle + 1, s->end.cycles});
    *first = *last - 1;
    return true;
}

bool trial_along_between(trial_along *a, trial *t, double first, double last, size_t points, bool turns,
                         calc_error *error) {
    const bool lasts = last > first;
    *a = (trial_along){.t = t, .first = first, .last = last};
    a->beside.looks =
        watch_times(first, lasts ? (last - first) / (double)points : 1, lasts ? points : 0, turns);
    return trace_begin(&a->trace, &t->scene, a->beside.looks, true, error);
}

bool trial_along_begin(trial_along *a, trial *t, along_what what, load_mark from, size_t points, bool turns,
                       calc_error *error) {
    double first, last;
    *a = (trial_along){.t = t};
    return trial_along_span(t, what, from, &first, &last, error) &&
           trial_along_between(a, t, first, last, points, turns, error);
}

bool trial_along_next(trial_along *a, calc_error *error) {
    scene *s = &a->t->scene;
    do {
        if (!trace_next(&a->trace, error))
            return false;
        a->now = (instant){.run = trace_now(&a->trace), .beside = &a->beside};
    } while (a->now.run->time < a->first || a->now.run->time > a->last);
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
