/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Runs a load in slices and keeps points for its curve. */
#include "live/playback.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "number/array.h"

enum { TRACK_POINTS = 20000 };

/* ---- the curve --------------------------------------------------------------------------------- */

static bool add_track_point(track *t, const runner *r) {
    fret_state s;
    if (t->count == TRACK_POINTS) {
        t->count /= 2;
        memmove(t->point, t->point + t->count, t->count * sizeof *t->point);
    }
    if (!fret_array_room(&t->point, &t->room, t->count + 1, sizeof *t->point))
        return false;
    engine_state(&r->engine, &s);
    const track_point p = {r->time, (double)s.dx, (double)s.Fx, (double)s.W, (double)s.U};
    const extent most = t->most;
    t->most = (extent){fmax(most.dx, fabs(p.dx)), fmax(most.Fx, fabs(p.Fx)), fmax(most.a, (double)s.a),
                       fmax(most.bound, (double)fret_contact_bound(r->engine.contact, 0)),
                       fmax(most.energy, fmax(p.W, p.U))};
    t->point[t->count++] = p;
    return true;
}

const track *playback_curve(const playback *w) {
    return playback_there(w, w->from) || !w->before.count ? &w->track : &w->before;
}

/* ---- the run ----------------------------------------------------------------------------------- */

/* Into how many parts each leg of the load is divided for the curve: fewer if there are many legs. */
static unsigned parts_of(const scene *s) {
    enum { STATES = 1200, FEWEST = 2, MOST = 24 };
    size_t legs = s->end.steps;
    for (size_t i = 0; i < s->end.cycles; i++)
        legs += 2 * (size_t)s->program->cycles[i].times;
    const size_t parts = STATES / legs;
    return parts < FEWEST ? FEWEST : parts > MOST ? MOST : (unsigned)parts;
}

static void end_run(playback *w) {
    trace_end(&w->trace);
    if (w->begun)
        scene_free(&w->scene);
    w->begun = false;
}

bool playback_begin(playback *w, calc *c, double from, calc_error *error) {
    if (w->begun && playback_there(w, w->from)) {
        const track other = w->before;
        w->before = w->track;
        w->track = other;
    }
    end_run(w);
    w->track.count = 0;
    w->track.most = (extent){0, 0, 0, 0, 0};
    w->from = from;
    scene_clone(&w->scene, c->now);
    w->scene.sound = w->begun = true;
    watch looks = watch_path(parts_of(&w->scene));
    looks.once = true;
    if (!trace_begin(&w->trace, &w->scene, looks, false, error))
        return false;
    return add_track_point(&w->track, trace_now(&w->trace)) || calc_no_memory(error);
}

bool playback_there(const playback *w, double time) {
    const runner *r = &w->trace.run[0];
    return r->time >= time || r->at.steps == w->scene.end.steps;
}

/* Runs to the next look, or the end, and adds a point to the curve. Leaves out points too close to see: a
 * swinging period has many chords. */
static bool run_on(playback *w, calc_error *error) {
    static const double APART = 1.0 / 64, LITTLE = 1e-9; /* in time: a period takes 1 */
    enum { PARTS = 38 };                                 /* of each leg that is played */
    runner *r = &w->trace.run[0];
    track *t = &w->track;
    if (r->time > w->from - LITTLE) {
        r->watch.points = PARTS;
        r->watch.once = false;
    }
    const bool looks = trace_next(&w->trace, error);
    if (error->raised)
        return false;
    if (looks && !r->turning && r->time - t->point[t->count - 1].time < APART)
        return true;
    return add_track_point(t, r) || calc_no_memory(error);
}

bool playback_run(playback *w, double time, bool (*late)(void), calc_error *error) {
    while (!playback_there(w, time) && !(late && late()))
        if (!run_on(w, error))
            return false;
    return true;
}

/* Correct digits where chords replace a sine. */
enum { CHORD_DIGITS = 4 };

bool playback_shot(playback *w, calc *c, shot *out, calc_error *error) {
    scene *const outer = c->now;
    w->now = (instant){.run = w->trace.run, .levels = 1};
    c->now = &w->scene;
    scene_look(&w->scene, &w->now);
    const bool ok = shot_take(c, out, error);
    out->digits = w->trace.run[0].level ? CHORD_DIGITS : 0;
    scene_look(&w->scene, NULL);
    c->now = outer;
    return ok;
}

void playback_end(playback *w) {
    end_run(w);
    free(w->track.point);
    free(w->before.point);
    *w = (playback){.begun = false};
}
