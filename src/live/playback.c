/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Runs a load in slices and keeps points for its curve and states to play. */
#include "live/playback.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "number/array.h"

enum { TRACK_POINTS = 20000 };

/* ---- the curve --------------------------------------------------------------------------------- */

static extent larger(extent a, extent b) {
    return (extent){fmax(a.dx, b.dx), fmax(a.Fx, b.Fx), fmax(a.a, b.a), fmax(a.bound, b.bound),
                    fmax(a.energy, b.energy)};
}

static bool add_track_point(track *t, track_point p) {
    if (t->count == TRACK_POINTS) {
        t->count /= 2;
        memmove(t->point, t->point + t->count, t->count * sizeof *t->point);
    }
    if (!fret_array_room(&t->point, &t->room, t->count + 1, sizeof *t->point))
        return false;
    t->point[t->count++] = p;
    return true;
}

static void begin_track(track *t) {
    t->before = larger(t->before, t->most);
    t->most = (extent){0, 0, 0, 0, 0};
    t->count = 0;
}

/* ---- what is kept of a run --------------------------------------------------------------------- */

/* Has nothing moved since the first state kept? */
static bool stands_still(const playback *w, const fret_state *s) {
    return w->shots == 1 && (double)s->Fx == w->play[0].Fx && (double)s->a == w->play[0].a;
}

/* Correct digits where chords replace a sine. */
enum { CHORD_DIGITS = 4 };

static bool keep_shot(playback *w, calc *c, calc_error *error) {
    if (!w->play)
        w->play = calloc(PLAY_SHOTS, sizeof *w->play);
    if (!w->play)
        return calc_no_memory(error);
    shot *to = &w->play[w->shots];
    walk_enter(&w->walk, c);
    const bool ok = shot_take(c, to, error);
    walk_leave(&w->walk, c);
    if (w->walk.run.level)
        to->digits = CHORD_DIGITS;
    w->shots += ok;
    return ok;
}

/* Gets the state and the point of the curve there, and widens the extent of the curve. */
static track_point point_of(track *t, const runner *r, fret_state *s) {
    engine_state(&r->engine, s);
    const track_point p = {r->time, (double)s->dx, (double)s->Fx, (double)s->W, (double)s->U};
    const extent here = {fabs(p.dx), fabs(p.Fx), (double)s->a,
                         (double)fret_contact_bound(r->engine.contact, 0), fmax(p.W, p.U)};
    t->most = larger(t->most, here);
    return p;
}

/* Adds a point to the curve and keeps its state, if it is to be played. Leaves out points too close to see: a
 * swinging period has many chords, and each state costs time. */
static bool take_point(playback *w, calc *c, calc_error *error) {
    static const double APART = 1.0 / 64; /* in time: a period takes 1 */
    const runner *r = &w->walk.run;
    track *t = &w->track;
    fret_state s;
    if (!r->turning && r->time - t->point[t->count - 1].time < APART)
        return true;
    if (!add_track_point(t, point_of(t, r, &s)))
        return calc_no_memory(error);
    if (!w->reached || r->time < w->from)
        return true;
    if (!stands_still(w, &s))
        return keep_shot(w, c, error);
    w->play[0].time = r->time;
    return true;
}

/* ---- walking ----------------------------------------------------------------------------------- */

void playback_drop_states(playback *w) {
    w->item = NO_ITEM;
    w->from = 0;
    w->reached = false;
    w->shots = 0;
}

bool playback_follow(playback *w, calc *c, size_t item, calc_error *error) {
    bool anew;
    playback_drop_states(w);
    w->item = item;
    if (item != NO_ITEM && w->walk.run.at.steps + w->walk.run.within > item)
        walk_end(&w->walk); /* run again: it is past the beginning of the item */
    if (!walk_follow(&w->walk, c, &anew, error))
        return false;
    if (anew) {
        begin_track(&w->track);
        if (!add_track_point(&w->track, (track_point){.time = 0})) {
            walk_end(&w->walk);
            return calc_no_memory(error);
        }
    }
    return true;
}

/* Into how many parts each leg of the load is divided for the curve: fewer if there are many legs. */
static unsigned parts_of(const scene *s) {
    enum { STATES = 1200, FEWEST = 2, MOST = 24 };
    size_t legs = s->end.steps;
    for (size_t i = 0; i < s->end.cycles; i++)
        legs += 2 * (size_t)s->program->cycles[i].times;
    const size_t parts = STATES / legs;
    return parts < FEWEST ? FEWEST : parts > MOST ? MOST : (unsigned)parts;
}

/* Periods that repeat the one before are skipped: the last point is moved to the end of the load. */
static void move_last_point(playback *w) {
    track *t = &w->track;
    fret_state s;
    t->point[t->count - 1] = point_of(t, &w->walk.run, &s);
}

bool playback_go_on(playback *w, calc *c, bool (*late)(void), calc_error *error) {
    enum { PARTS = 38 }; /* of each leg that is played */
    walk *k = &w->walk;
    const size_t end = k->scene.end.steps;
    const unsigned parts = parts_of(&k->scene);
    bool ok = true;
    do {
        if (!w->reached && k->run.at.steps >= w->item) { /* never so for NO_ITEM */
            w->reached = true;
            ok = k->run.time < w->from || keep_shot(w, c, error);
        }
        if (ok && walk_next(k, w->reached || w->item > end ? end : w->item, w->reached ? PARTS : parts,
                            w->reached, error))
            ok = take_point(w, c, error);
        ok = ok && !error->raised;
    } while (ok && !playback_idle(w) && !(late && late()));
    if (!ok) {
        walk_end(k); /* a run that failed within a step cannot go on */
    } else if (playback_done(w)) {
        move_last_point(w);
        w->track.before = (extent){0, 0, 0, 0, 0};
    }
    return ok;
}

bool playback_done(const playback *w) {
    return w->walk.run.at.steps == w->walk.scene.end.steps;
}

bool playback_idle(const playback *w) {
    return playback_done(w) || (w->reached && w->shots == PLAY_SHOTS);
}

void playback_add_period(playback *w) {
    static const double LITTLE = 1e-9;
    const scene *s = &w->walk.scene;
    if (w->item == NO_ITEM) {
        w->item = s->end.steps - 1;
        w->from = program_time(s->program, s->end) - LITTLE;
    }
    walk_more(&w->walk);
}

void playback_drop_before(playback *w, double time) {
    size_t i = 0;
    while (i + 1 < w->shots && w->play[i + 1].time <= time)
        i++;
    if (i > PLAY_SHOTS / 4) {
        w->shots -= i;
        memmove(w->play, w->play + i, w->shots * sizeof *w->play);
    }
}

extent playback_extent(const playback *w) {
    return larger(w->track.most, w->track.before);
}

void playback_end(playback *w) {
    walk_end(&w->walk);
    free(w->track.point);
    free(w->play);
    *w = (playback){.item = NO_ITEM};
}
