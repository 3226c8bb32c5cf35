/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The work of friction per area at a radius, summed over the recorded phases of slip. Allocates and frees
 * works; uses `law`, `history` and `number`. */
#include "fret/work.h"

#include <stdlib.h>
#include <string.h>

#include "field/field.h"
#include "law/check.h"

struct fret_work {
    const fret_normal *normal; /* borrowed */
    double mu;
    fret_field *whole; /* the pressed field of the deepest contact, or NULL */
    size_t count;
    slip_phase *phase;
    swung_phase *swung;
};

static fret_real load_of(const load_path *w, fret_real s) {
    return (load_path_at(w, M, s) + load_path_at(w, P, s)) / 2;
}

/* Does the normal force of a path turn in (lo, hi), and when? Once at most while M or P falls. */
static bool turns(const load_path *w, fret_real lo, fret_real hi, fret_real *when) {
    load_path loads;
    if (!w->harmonic)
        return false;
    fret_swing_loads(w, &loads);
    *when = loads.lag[M] + FRET_PI * ceill((lo - loads.lag[M]) / FRET_PI);
    return *when > lo && *when < hi;
}

/* ---- making ------------------------------------------------------------------------------------ */

/* The largest depth of the contact edge during a phase. */
static fret_real deepest(const fret_work *w, const slip_phase *p) {
    const fret_real most = fmaxl(p->edge[0], p->edge[1]);
    fret_real when;
    if (p->kind != SWUNG)
        return p->kind == LINEAR_IN_LOAD ? fret_law_depth(w->normal, most) : most;
    const swung_phase *s = &w->swung[p->swung];
    fret_real N = fmaxl(load_of(&s->path, s->lo), load_of(&s->path, s->hi));
    if (turns(&s->path, s->lo, s->hi, &when))
        N = fmaxl(N, load_of(&s->path, when));
    return fret_law_depth(w->normal, N);
}

static fret_status copy_phases(fret_work *w, const fret_slips *slips, size_t first, size_t end) {
    end = end < slips->count ? end : slips->count;
    w->count = first < end ? end - first : 0;
    w->phase = calloc(w->count + 1, sizeof *w->phase);
    w->swung = calloc(slips->swings + 1, sizeof *w->swung);
    if (slips->failed || !w->phase || !w->swung)
        return fret_fail(FRET_NO_MEMORY, NULL, 0, 0);
    if (w->count > 0)
        memcpy(w->phase, slips->phase + first, w->count * sizeof *w->phase);
    if (slips->swings > 0)
        memcpy(w->swung, slips->swung, slips->swings * sizeof *w->swung);
    return fret_ok();
}

fret_status fret_work_make(const fret_normal *normal, double mu, const fret_slips *slips, size_t first,
                           size_t end, fret_work **out) {
    fret_work *w = calloc(1, sizeof *w);
    fret_press press = {.dz = 0};
    *out = w;
    if (!w)
        return fret_fail(FRET_NO_MEMORY, NULL, 0, 0);
    w->normal = normal;
    w->mu = mu;
    fret_status st = copy_phases(w, slips, first, end);
    for (size_t i = 0; i < w->count && !st.code; i++)
        press.dz = fmaxl(press.dz, deepest(w, &w->phase[i]));
    if (!st.code && press.dz > 0)
        st = fret_field_of_press(normal, &press, &w->whole);
    if (st.code) {
        fret_work_free(w);
        *out = NULL;
    }
    return st;
}

void fret_work_free(fret_work *w) {
    if (!w)
        return;
    fret_field_free(w->whole);
    free(w->phase);
    free(w->swung);
    free(w);
}

/* ---- a place ----------------------------------------------------------------------------------- */

/* The radius asked for, and the depth and normal force of the contact that ends there: both 0 up to the
 * start of the gap, infinite beyond its end. */
typedef struct place_asked {
    const fret_work *work;
    fret_real r, at[2];
    fret_field part;
    slice end;
    fret_real depth, p; /* cache: p(r) of the contact of this depth */
    fret_status st;
} place_asked;

static void keep(place_asked *a, fret_status st) {
    if (!a->st.code)
        a->st = st;
}

/* p(r) in the contact of a given depth. */
static fret_real pressure(place_asked *a, fret_real depth) {
    if (depth != a->depth) {
        fret_field_cut(a->work->whole, depth, &a->part);
        keep(a, fret_field_pressure(&a->part, a->r, &a->p));
        a->depth = depth;
    }
    return a->p;
}

/* int K dd over fronts up to a depth: depth - u_z(r). */
static fret_real carried(place_asked *a, fret_real depth) {
    fret_real left;
    fret_field_cut(a->work->whole, depth, &a->part);
    keep(a, fret_field_left(&a->part, a->r, &left));
    return left;
}

/* K: the slip at r per unit of slip of the springs outside a front at the radius d. */
static fret_real carry(const place_asked *a, fret_real d) {
    const fret_field *f = a->work->whole;
    return d >= a->r ? 0 : d > 0 ? 1 - f->of_depth * fret_kernel_flat(&f->flat, d, a->r) : 1;
}

static fret_real depth_of(const place_asked *a, coordinate by, fret_real at) {
    return by == DEPTH ? at : fret_law_depth(a->work->normal, at);
}

static fret_real tolerance(const place_asked *a) {
    return fret_normal_closed(a->work->normal) ? 1e-14L : 1e-12L;
}

/* ---- straight phases --------------------------------------------------------------------------- */

/* Context of a straight phase, between two depths of the front, or of the edge in gross slip. */
typedef struct straight {
    place_asked *place;
    const slip_phase *phase;
    fret_real from, to;
} straight;

static fret_real straight_rate(fret_real t, fret_real rest, void *context) {
    const straight *s = context;
    const slip_phase *p = s->phase;
    place_asked *a = s->place;
    const fret_real depth = s->from * rest + s->to * t;
    if (fret_stopped(a->work->normal))
        return 0;
    if (p->kind == GROSS)
        return pressure(a, depth);
    const coordinate by = p->kind == LINEAR_IN_LOAD ? LOAD : DEPTH;
    const fret_real at = by == LOAD ? fret_law_force(a->work->normal, depth) : depth,
                    part = (p->front[0] - at) / (p->front[0] - p->front[1]),
                    edge = p->edge[0] + (p->edge[1] - p->edge[0]) * part;
    return pressure(a, depth_of(a, by, edge)) * carry(a, fret_law_radius(a->work->normal, depth));
}

static fret_real gross_work(place_asked *a, const slip_phase *p) {
    straight s = {a, p, fmaxl(p->edge[0], a->at[DEPTH]), fmaxl(p->edge[1], a->at[DEPTH])};
    const fret_real rise = p->edge[1] - p->edge[0];
    if (rise == 0)
        return p->edge[0] > a->at[DEPTH] ? p->gain * pressure(a, p->edge[0]) : 0;
    return s.from == s.to
               ? 0
               : p->gain * (s.to - s.from) / rise * fret_integral_ends(straight_rate, &s, tolerance(a));
}

/* The work of the part of a straight phase in which the front lies inside r and the edge outside: the front
 * is never outside the edge. */
static fret_real straight_work(place_asked *a, const slip_phase *p) {
    const coordinate by = p->kind == LINEAR_IN_LOAD ? LOAD : DEPTH;
    const fret_real at = a->at[by], travel = p->front[0] - p->front[1], rise = p->edge[1] - p->edge[0];
    const fret_real crosses = rise != 0 ? (at - p->edge[0]) / rise : 0;
    fret_real from = 0, to = 1;
    if (!(travel > 0) || !(p->front[1] < at) || !(fmaxl(p->edge[0], p->edge[1]) > at))
        return 0;
    if (p->edge[0] < at)
        from = crosses;
    else if (p->edge[1] < at)
        to = crosses;
    if (!(to > from))
        return 0;
    const fret_real first = from > 0 ? p->front[0] - travel * from : p->front[0],
                    last = to < 1 ? p->front[0] - travel * to : p->front[1];
    straight s = {a, p, first < at ? depth_of(a, by, first) : a->at[DEPTH], depth_of(a, by, last)};
    return p->gain * (rise == 0
                          ? pressure(a, depth_of(a, by, p->edge[0])) * (carried(a, s.from) - carried(a, s.to))
                          : (s.from - s.to) * fret_integral_ends(straight_rate, &s, tolerance(a)));
}

/* ---- harmonic loads ---------------------------------------------------------------------------- */

typedef struct swing_integral {
    place_asked *place;
    const swung_phase *phase;
    fret_real lo, hi, end; /* end: the level (M or P) of the front at hi */
} swing_integral;

/* As slip_rate of history/swing.c: counts from the end, where the level may be 0. */
static fret_real swung_rate(fret_real t, fret_real rest, void *context) {
    const swing_integral *l = context;
    const swung_phase *p = l->phase;
    place_asked *a = l->place;
    const fret_normal *n = a->work->normal;
    const fret_real s = l->lo * rest + l->hi * t,
                    level = p->path.harmonic ? load_path_at(&p->path, p->which, s)
                                             : l->end - p->path.span[p->which] * ((l->hi - l->lo) * rest),
                    inner = fret_swing_other(&p->front, p->which, fminl(level, p->front.last[p->which]));
    const fret_point front = fret_law_at_force(n, (level + inner) / 2);
    if (fret_stopped(n) || !(front.K > 0))
        return 0;
    return pressure(a, fret_law_depth(n, load_of(&p->path, s))) * carry(a, front.a) *
           load_path_fall(&p->path, p->which, s) / front.K;
}

/* The work while the normal force is monotone, over the times at which the contact reaches beyond r. */
static fret_real swung_part(place_asked *a, const swung_phase *p, fret_real lo, fret_real hi) {
    const fret_real N = a->at[LOAD], first = load_of(&p->path, lo), last = load_of(&p->path, hi);
    load_path loads = p->path;
    swing_integral s = {a, p, lo, hi, 0};
    if (!(fmaxl(first, last) > N) || !(hi > lo))
        return 0;
    if (fminl(first, last) < N) {
        fret_real when = lo + (hi - lo) * ((N - first) / (last - first));
        if (p->path.harmonic) {
            fret_swing_loads(&p->path, &loads);
            when = load_path_when(&loads, M, N, lo, hi);
        }
        *(first < N ? &s.lo : &s.hi) = when;
    }
    s.end = load_path_at(&p->path, p->which, s.hi);
    return (s.hi - s.lo) * fret_integral_ends(swung_rate, &s, tolerance(a));
}

/* The level (M or P, by `which`) of an arc where its normal force is N; infinite if N lies off the arc. */
static fret_real level_at(const arc *p, int which, fret_real N) {
    const fret_real first = (p->first[M] + p->first[P]) / 2, last = (p->last[M] + p->last[P]) / 2;
    load_path loads;
    if (!(N < last))
        return (fret_real)INFINITY;
    if (!(N > first))
        return -(fret_real)INFINITY;
    if (!p->curved)
        return p->first[which] + (p->last[which] - p->first[which]) * ((N - first) / (last - first));
    fret_swing_loads(&p->path, &loads);
    return load_path_at(&p->path, which, load_path_when(&loads, M, N, p->lo, p->hi));
}

static fret_real swung_work(place_asked *a, const swung_phase *p) {
    const fret_real level = level_at(&p->front, p->which, a->at[LOAD]),
                    first = load_path_at(&p->path, p->which, p->lo),
                    last = load_path_at(&p->path, p->which, p->hi);
    const fret_real from = level < first ? load_path_when(&p->path, p->which, level, p->lo, p->hi) : p->lo;
    fret_real turn;
    if (!(last < level))
        return 0;
    return turns(&p->path, from, p->hi, &turn) ? swung_part(a, p, from, turn) + swung_part(a, p, turn, p->hi)
                                               : swung_part(a, p, from, p->hi);
}

/* The normal force at which the front's arc has this level. */
static fret_real front_load(const swung_phase *p, fret_real level) {
    const fret_real here = fmaxl(fminl(level, p->front.last[p->which]), p->front.first[p->which]);
    return (here + fret_swing_other(&p->front, p->which, here)) / 2;
}

/* Normal forces, or depths, of edge and front where a phase begins and ends; returns their number. */
static size_t ends_of(const fret_work *w, const slip_phase *p, fret_real at[FRET_WORK_ENDS]) {
    if (p->kind != SWUNG) {
        at[0] = p->edge[0];
        at[1] = p->edge[1];
        at[2] = p->front[0];
        at[3] = p->front[1];
        return p->kind == GROSS ? 2 : 4;
    }
    const swung_phase *s = &w->swung[p->swung];
    at[0] = load_of(&s->path, s->lo);
    at[1] = load_of(&s->path, s->hi);
    at[2] = front_load(s, load_path_at(&s->path, s->which, s->lo));
    at[3] = front_load(s, load_path_at(&s->path, s->which, s->hi));
    if (!turns(&s->path, s->lo, s->hi, &at[4]))
        return 4;
    at[5] = front_load(s, load_path_at(&s->path, s->which, at[4]));
    at[4] = load_of(&s->path, at[4]);
    return 6;
}

size_t fret_work_edges(const fret_work *w, size_t phase, fret_real r[FRET_WORK_ENDS]) {
    size_t count = 0;
    if (phase >= w->count)
        return 0;
    const slip_phase *p = &w->phase[phase];
    const bool loads = p->kind == SWUNG || p->kind == LINEAR_IN_LOAD;
    const size_t ends = ends_of(w, p, r);
    for (size_t i = 0; i < ends; i++)
        if (r[i] > 0)
            r[count++] = fret_law_radius(w->normal, loads ? fret_law_depth(w->normal, r[i]) : r[i]);
    return count;
}

fret_status fret_work_at(const fret_work *w, fret_real r, fret_real *out) {
    const fret_normal *n = w->normal;
    place_asked a = {.work = w, .r = r, .depth = -1, .st = fret_check_not_negative("r", (double)r)};
    fret_sum sum = {0, 0};
    *out = 0;
    if (a.st.code || !w->whole || r >= w->whole->slice->a)
        return a.st;
    fret_field_part(w->whole, &a.end, &a.part);
    if (r > fret_gap_start(&n->gap)) {
        const fret_point at = fret_law_at_radius(n, r);
        a.at[DEPTH] = at.y;
        a.at[LOAD] = at.F;
    }
    for (size_t i = 0; i < w->count && !a.st.code; i++) {
        const slip_phase *p = &w->phase[i];
        fret_sum_add(&sum, fmaxl(0, p->kind == GROSS   ? gross_work(&a, p)
                                    : p->kind == SWUNG ? p->gain * swung_work(&a, &w->swung[p->swung])
                                                       : straight_work(&a, p)));
    }
    *out = w->mu * w->mu * n->foundation.eta * fret_sum_value(&sum);
    return fret_unless_stopped(n, a.st);
}
