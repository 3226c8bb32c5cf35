/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Friction's work by radius: runs the load program again and records its slip. Uses the library. */
#include <stdint.h>

#include "scene/scene.h"

/* Runs to the end of the program or to an instant. With the same looks as the instant's run, since other
 * divisions of a load in time change it. */
static fret_status run_watched(runner *r, const instant *now) {
    if (!now)
        return run_to(r, r->load->end);
    r->watch = now->run->watch;
    r->watch.sample = 0;
    while (run_next(r, r->load->end) && r->time < now->run->time)
        ;
    return r->status;
}

static fret_status keep_works(friction_work *w, const runner *r) {
    const unsigned i = w->levels;
    const engine *e = &r->engine;
    fret_status st = fret_work_make(r->load->normal, r->load->mu, e->slips, 0, SIZE_MAX, &w->far[i]);
    w->times[i] = e->times;
    return st.code || !r->closed ? st
                                 : fret_work_make(r->load->normal, r->load->mu, e->slips, e->closed[0],
                                                  e->closed[1], &w->period[i]);
}

/* Runs one level and keeps its works. */
static fret_status make_level(friction_work *w, const load_view *load, const instant *now, unsigned level,
                              bool sine) {
    runner r = {.load = load, .level = level};
    fret_slips *slips = NULL;
    fret_status st = engine_make(&r.engine, load->normal, load->mu);
    r.engine.sine = sine;
    if (!st.code)
        st = fret_slips_make(&slips);
    if (!st.code)
        st = engine_watch(&r.engine, slips);
    if (!st.code)
        st = run_watched(&r, now);
    if (!st.code)
        st = keep_works(w, &r);
    w->levels++;
    engine_end(&r.engine);
    fret_slips_free(slips);
    return st;
}

/* Makes the works as the load itself was run: as a sine or at all levels; at an instant at its level only. */
static bool make_work(scene *s, calc_error *error) {
    friction_work *w = &s->answers.work;
    load_view load;
    const runner *run;
    fret_status st = status_ok;
    if (!load_run(s, &run, error) || !scene_load_of(s, &load, error))
        return false;
    const unsigned levels = s->now ? 1 : s->answers.levels;
    while (w->levels < levels && !st.code)
        st = make_level(w, &load, s->now, s->now ? run->level : w->levels, run->engine.sine);
    if (st.code)
        friction_work_end(w);
    return calc_status(error, st);
}

bool scene_work(scene *s, bool period, long double r, long double *out, calc_error *error) {
    friction_work *w = &s->answers.work;
    load_item cycle;
    double mu;
    long double at[LEVELS], unused;
    fret_status st = status_ok;
    s->used |= USED(MODEL_MEMORY);
    if (!scene_friction(s, &mu, error) || (period && !s->now && !scene_last_cycle(s, &cycle, error)) ||
        (!w->levels && !make_work(s, error)))
        return false;
    if (period && !w->period[0])
        return calc_fail(error, 0, 0, "no cycle has been closed yet");
    for (unsigned i = 0; i < w->levels && !st.code; i++) {
        st = fret_work_at(period ? w->period[i] : w->far[i], r, &at[i]);
        at[i] /= period ? w->times[i] : 1;
    }
    if (!st.code)
        *out = w->levels == LEVELS ? run_limit(at, &unused) : at[0];
    return calc_status(error, st);
}

bool scene_work_chords(const scene *s) {
    return s->answers.work.levels == LEVELS;
}

size_t scene_work_edges(const scene *s, long double r[], size_t room) {
    const friction_work *w = &s->answers.work;
    long double own[FRET_WORK_ENDS];
    size_t count = 0, ends;
    for (unsigned level = 0; level < w->levels; level++)
        for (size_t phase = 0; (ends = fret_work_edges(w->far[level], phase, own)); phase++)
            for (size_t i = 0; i < ends && count < room; i++)
                r[count++] = own[i];
    return count;
}
