/* SPDX-License-Identifier: GPL-3.0-or-later */
/* States of a scene as plain numbers. Changes no scene. */
#include "live/shot.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const char *const names[SHOT_VALUES] = {"FN", "Fx", "dx", "dz", "a", "c", "c/a", "W", "U", "dW", "kt"};
enum { SHOT_W = 7, SHOT_U, SHOT_DW };

const char *shot_name(size_t i) {
    return names[i];
}

/* ---- a state ----------------------------------------------------------------------------------- */

static void take_values(calc *c, shot *out) {
    for (size_t i = 0; i < SHOT_VALUES; i++) {
        const quantity *q = quantity_find(names[i], strlen(names[i]));
        calc_error ignored;
        error_clear(&ignored);
        out->known[i] = q && quantity_get(q, c->now, &out->value[i], &ignored);
        out->d[i] = q ? q->d : DIM_NONE;
        if (!q) { /* c/a, of two that have been read */
            out->known[i] = out->known[i - 1] && out->known[i - 2] && out->value[i - 2] > 0;
            out->value[i] = out->known[i] ? out->value[i - 1] / out->value[i - 2] : 0;
        }
    }
}

/* Parts of uniform slope; only the outermost where there are many. */
static void take_rings(const fret_memory *memory, shot *out) {
    fret_segment part;
    size_t count = 0;
    out->rings = 0;
    while (fret_memory_segment(memory, count, &part))
        count++;
    for (size_t i = count > SHOT_RINGS ? count - SHOT_RINGS : 0; i < count; i++) {
        fret_press edge = {.a = 0};
        fret_memory_segment(memory, i, &part);
        if (part.outer > 0 &&
            !fret_press_by_depth(fret_memory_normal(memory), (double)part.outer, &edge).code)
            out->ring[out->rings++] = (shot_ring){(double)edge.a, (double)part.sigma};
    }
}

/* What friction allows depends on F_N alone: taken over from a shot of the same press. */
static void take_bounds(const fret_memory *memory, const shot *like, shot *out) {
    if (like && like->a == out->a && like->bound == out->bound) {
        memcpy(out->B, like->B, sizeof out->B);
        return;
    }
    for (int i = 0; i <= SHOT_SAMPLES; i++)
        out->B[i] = (double)fret_memory_bound(memory, out->a * (fret_real)i / SHOT_SAMPLES);
}

/* u is straight in the depth, and so in the bound B = mu eta (dz - y), on each slice:
 * fret_memory_displacement at the places of the bounds, which are known. */
static void take_displacements(const fret_memory *memory, double dz, shot *out) {
    const double rise = dz > 0 ? out->bound / dz : 0; /* mu eta */
    fret_segment part;
    size_t slice = 0;
    bool any = fret_memory_segment(memory, 0, &part);
    for (int i = 0; i <= SHOT_SAMPLES; i++) {
        const double y = rise > 0 ? dz - out->B[i] / rise : 0;
        while (any && y > (double)part.outer && fret_memory_segment(memory, slice + 1, &part))
            slice++;
        out->u[i] = any ? (double)part.u - rise * (double)part.sigma * (y - (double)part.inner) : 0;
    }
}

bool shot_take(calc *c, const shot *like, shot *out, calc_error *error) {
    const fret_memory *memory;
    fret_state state;
    if (!scene_memory(c->now, &memory, error))
        return false;
    fret_memory_state(memory, &state);
    out->time = scene_time(c->now);
    out->a = (double)state.a;
    out->c = (double)state.c;
    out->dx = (double)state.dx;
    out->Fx = (double)state.Fx;
    out->slip = fret_memory_friction(memory) * (double)state.FN;
    out->bound = (double)fret_memory_bound(memory, 0);
    take_bounds(memory, like, out);
    take_displacements(memory, (double)state.dz, out);
    take_rings(memory, out);
    take_values(c, out);
    return true;
}

/* ---- the way ----------------------------------------------------------------------------------- */

enum { TRACK_POINTS = 20000 };

static void widen(track *t, double a, double bound) {
    t->a = fmax(t->a, a);
    t->bound = fmax(t->bound, bound);
}

static bool add(track *t, track_point p) {
    if (t->count == TRACK_POINTS) {
        t->count /= 2;
        memmove(t->point, t->point + t->count, t->count * sizeof *t->point);
    }
    if (t->count == t->room) {
        const size_t room = t->room ? 2 * t->room : 256;
        track_point *grown = realloc(t->point, room * sizeof *grown);
        if (!grown)
            return false;
        t->point = grown;
        t->room = room;
    }
    t->point[t->count++] = p;
    t->dx = fmax(t->dx, fabs(p.dx));
    t->Fx = fmax(t->Fx, fabs(p.Fx));
    t->energy = fmax(t->energy, fmax(p.W, p.U));
    return true;
}

static track_point point_of(const fret_state *s, double time) {
    return (track_point){time, (double)s->dx, (double)s->Fx, (double)s->W, (double)s->U};
}

/* Of a swinging period's many chords as many as can be told apart: each state takes its time. */
static bool see(const runner *r, void *context) {
    static const double APART = 1.0 / 64;
    track *t = context;
    fret_state s;
    if (!r->turning && t->count && r->time - t->point[t->count - 1].time < APART)
        return true;
    engine_state(&r->engine, &s);
    widen(t, (double)s.a, (double)fret_memory_bound(r->engine.self, 0));
    return add(t, point_of(&s, r->time));
}

/* A step that is small on the screen is drawn as it is: long sessions by hand stay quick. */
static bool same_inputs(const inputs *a, const inputs *b) {
    return !memcmp(a->v, b->v, sizeof a->v) && !memcmp(a->set, b->set, sizeof a->set) && a->bindings == 0 &&
           b->bindings == 0 && a->geometry == b->geometry && a->table == b->table && a->second == b->second;
}

static bool grown(const track *t, const scene *s) {
    return t->count && s->program == t->program && s->end.steps == t->steps + 1 &&
           same_inputs(&s->in, &t->in);
}

static bool grown_little(const track *t, const scene *s, const shot *now) {
    enum { SMALL = 12 }; /* of what makes it slide */
    if (!grown(t, s) || s->program->steps[t->steps].kind != LOAD_STEP)
        return false;
    const track_point *last = &t->point[t->count - 1];
    return fabs(now->dx - last->dx) * SMALL <= now->bound && fabs(now->Fx - last->Fx) * SMALL <= now->slip;
}

/* In how many parts each leg is drawn: a frame must not take long. */
static unsigned parts_of(const scene *s) {
    enum { STATES = 1200, FEWEST = 2, MOST = 24 };
    size_t legs = s->end.steps;
    for (size_t i = 0; i < s->end.cycles; i++)
        legs += 2 * (size_t)s->program->cycles[i].times;
    const size_t parts = STATES / legs;
    return parts < FEWEST ? FEWEST : parts > MOST ? MOST : (unsigned)parts;
}

static bool track_again(track *t, scene *s, calc_error *error) {
    t->count = 0;
    t->dx = t->Fx = t->a = t->bound = t->energy = 0;
    watch w = watch_points(parts_of(s));
    w.see = see;
    w.context = t;
    if (!add(t, (track_point){.time = 0}))
        return calc_no_memory(error);
    return scene_trace(s, &w, error);
}

static bool add_shot(track *t, const shot *s) {
    const double W = (double)s->value[SHOT_W], U = (double)s->value[SHOT_U];
    widen(t, s->a, s->bound);
    return add(t, (track_point){s->time, s->dx, s->Fx, W, U});
}

bool track_follow(track *t, calc *c, const shot *now, const shot *way, size_t count, calc_error *error) {
    scene *s = c->now;
    bool ok = true;
    if (grown_little(t, s, now)) {
        ok = add_shot(t, now) || calc_no_memory(error);
    } else if (grown(t, s) && count > 1) {
        for (size_t i = 0; i < count && ok; i++)
            ok = add_shot(t, &way[i]) || calc_no_memory(error);
    } else if (s->program != t->program || s->end.steps != t->steps || !same_inputs(&s->in, &t->in)) {
        ok = track_again(t, s, error);
    }
    widen(t, now->a, now->bound);
    t->program = ok ? s->program : NULL;
    t->steps = s->end.steps;
    t->in = s->in;
    return ok;
}

void track_free(track *t) {
    free(t->point);
    *t = (track){.point = NULL};
}

/* ---- the last item of the load ----------------------------------------------------------------- */

typedef struct shots {
    calc *c;
    shot *out;
    size_t count, taken;
} shots;

static bool look(void *context, double time, calc_error *error) {
    shots *s = context;
    if (s->taken == s->count)
        return true;
    if (!shot_take(s->c, s->taken ? &s->out[s->taken - 1] : NULL, &s->out[s->taken], error))
        return false;
    s->out[s->taken++].time = time;
    return true;
}

bool shots_along(calc *c, shot *out, size_t count, size_t *taken, calc_error *error) {
    shots s = {c, out, count, 0};
    const load_mark end = c->now->end;
    if (!end.steps)
        return false;
    const bool cycle = c->now->program->steps[end.steps - 1].kind == LOAD_CYCLE;
    const load_mark from = {end.steps - 1, end.cycles - (cycle ? 1 : 0)};
    trial *t = trial_open(c, error);
    bool ok = t && trial_along(t, ALONG_LOAD, from, count - 1, false, look, &s, error);
    if (t)
        trial_close(t);
    *taken = s.taken;
    return ok && s.taken > 0;
}

static bool same_state(const shot *a, const shot *b) {
    const double tight = 1e-9;
    return fabs(a->a - b->a) <= tight * b->a && fabs(a->c - b->c) <= tight * b->a &&
           fabs(a->dx - b->dx) <= tight * b->bound && fabs(a->Fx - b->Fx) <= tight * b->slip;
}

static bool same_cycle(const calc *c) {
    const program *p = c->now->program;
    const load_mark end = c->now->end;
    return end.steps > 1 && end.cycles > 1 && p->steps[end.steps - 1].kind == LOAD_CYCLE &&
           p->steps[end.steps - 2].kind == LOAD_CYCLE &&
           !memcmp(&p->cycles[end.cycles - 1], &p->cycles[end.cycles - 2], sizeof *p->cycles);
}

bool shots_again(const track *t, const calc *c, const shot *now, shot *way, size_t count) {
    if (count < 2 || !grown(t, c->now) || !same_cycle(c) || !same_state(&way[0], now) ||
        !same_state(&way[count - 1], now))
        return false;
    const double later = now->time - way[count - 1].time;
    const long double lost = now->value[SHOT_W] - way[count - 1].value[SHOT_W];
    for (size_t i = 0; i < count; i++) {
        way[i].time += later;
        way[i].value[SHOT_W] += lost;
        way[i].known[SHOT_DW] = now->known[SHOT_DW];
        way[i].value[SHOT_DW] = now->value[SHOT_DW];
    }
    return true;
}
