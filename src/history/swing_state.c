/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What follows from the memory curve of a swing: displacement, energy, state, slip fronts, a copy as a
 * memory. Pure. */
#include <float.h>
#include <string.h>

#include "history/memory.h"
#include "history/swing.h"
#include "number/real.h"
#include "number/root.h"

/* ---- along the curve --------------------------------------------------------------------------- */

/* An integrand: of int sigma dy, or of int T sigma dy, T = (P-M)/2, for the stored energy. */
typedef struct along {
    const fret_swing *curve;
    const arc *arc;
    bool energy;
} along;

/* dy/dN */
static fret_real compliance(const fret_normal *n, fret_real N) {
    if (fret_stopped(n))
        return 0;
    return fret_normal_closed(n) ? n->q * fret_law_depth(n, N) / N : 1 / fret_law_at_force(n, N).K;
}

static fret_real along_rate(fret_real t, fret_real rest, void *context) {
    const along *l = context;
    const arc *p = l->arc;
    const fret_real s = p->lo * rest + p->hi * t, m = load_path_at(&p->path, M, s),
                    up = load_path_at(&p->path, P, s);
    const fret_real N = (m + up) / 2, T = (up - m) / 2;
    const fret_real dT = (load_path_fall(&p->path, M, s) - load_path_fall(&p->path, P, s)) / 2;
    return (l->energy ? T : 1) * dT * compliance(l->curve->normal, N);
}

void fret_swing_compute_sums(fret_swing *c) {
    for (size_t i = 0; i < c->count; i++) {
        arc *p = &c->arcs[i];
        for (int which = 0; which < 2 && p->curved && !p->known; which++)
            p->sum[which] = (p->hi - p->lo) * fret_swing_integral(c, along_rate, &(along){c, p, which});
        p->known = true;
    }
}

static fret_real sum_along(const fret_swing *c, bool energy) {
    fret_real sum = 0;
    for (size_t i = 0; i < c->count; i++) {
        const arc *p = &c->arcs[i];
        if (p->curved) {
            sum += p->sum[energy];
            continue;
        }
        const fret_real N0 = (p->first[M] + p->first[P]) / 2, N1 = (p->last[M] + p->last[P]) / 2;
        const fret_real T0 = (p->first[P] - p->first[M]) / 2, T1 = (p->last[P] - p->last[M]) / 2;
        if (!(N1 > N0))
            continue;
        const fret_level outer = {fret_law_depth(c->normal, N1), N1};
        const fret_real h = fret_law_thickness(c->normal, &outer, N1 - N0), sigma = (T1 - T0) / (N1 - N0);
        const fret_slice part = fret_law_slice(c->normal, &outer, h);
        sum += energy ? sigma * (h * T0 + sigma * fret_slice_moment(&part)) : sigma * h;
    }
    return sum;
}

/* ---- by displacement --------------------------------------------------------------------------- */

/* A slip front that moves inwards along `which` at constant F_N moves delta_x by mu eta int dw/K, w the
 * coordinate, 1/K the compliance at the load. */
typedef struct passing {
    const fret_swing *curve;
    const arc *arc;
    int which;
    fret_real from, rest;
} passing;

static fret_real passing_rate(fret_real t, fret_real rest, void *context) {
    const passing *l = context;
    const arc *p = l->arc;
    const fret_real s = l->from * rest + p->hi * t,
                    N = (load_path_at(&p->path, M, s) + load_path_at(&p->path, P, s)) / 2;
    return -load_path_fall(&p->path, l->which, s) * compliance(l->curve->normal, N);
}

static fret_real passed(const fret_swing *c, const arc *p, int which, fret_real from) {
    return (p->hi - from) * fret_swing_integral(c, passing_rate, &(passing){c, p, which, from, 0});
}

static fret_real passed_less(fret_real s, fret_real *slope, void *context) {
    passing *l = context;
    l->from = s;
    *slope = -passing_rate(0, 1, l);
    return passed(l->curve, l->arc, l->which, s) - l->rest;
}

/* The level at which the front has passed `rest` of a curved arc, whose whole is `whole`. */
static fret_real curved_front(const fret_swing *c, const arc *p, int which, fret_real rest, fret_real whole) {
    passing l = {c, p, which, 0, rest};
    return load_path_at(
        &p->path, which,
        fret_root(passed_less, &l, p->lo, p->hi, p->hi - (p->hi - p->lo) * sqrtl(rest / whole)));
}

fret_real fret_swing_front(const fret_swing *c, int which, fret_real *left) {
    for (size_t i = c->count; i-- > 0;) {
        const arc *p = &c->arcs[i];
        const fret_real span = p->last[which] - p->first[which];
        const fret_real N0 = (p->first[M] + p->first[P]) / 2, N1 = (p->last[M] + p->last[P]) / 2;
        if (!(span > 0))
            continue;
        const fret_level outer = {fret_law_depth(c->normal, N1), N1};
        const fret_real steep = span / (N1 - N0);
        const fret_real whole =
            p->curved ? passed(c, p, which, p->lo) : steep * fret_law_thickness(c->normal, &outer, N1 - N0);
        if (*left < whole) {
            const fret_real rest = *left;
            *left = 0;
            return p->curved ? curved_front(c, p, which, rest, whole)
                             : p->last[which] - steep * fret_law_load(c->normal, &outer, rest / steep);
        }
        *left -= whole;
    }
    return 0;
}

/* ---- springs ----------------------------------------------------------------------------------- */

void fret_swing_loads(const load_path *w, load_path *out) {
    *out = (load_path){.harmonic = true, .mean = w->mean};
    for (int i = M; i <= P; i++) {
        fret_real x = 0, y = 0;
        for (int j = M; j <= P; j++) {
            const fret_real half = (i == P && j == M ? -1 : 1) * w->size[j] / 2;
            x += half * cosl(w->lag[j]);
            y += half * sinl(w->lag[j]);
        }
        out->size[i] = sqrtl(x * x + y * y);
        out->lag[i] = atan2l(y, x);
    }
}

/* The s at which the load on a curved arc is N. */
static fret_real time_of(const arc *p, fret_real N) {
    load_path loads;
    fret_swing_loads(&p->path, &loads);
    return load_path_when(&loads, M, N, p->lo, p->hi);
}

/* int sigma dy over the part of an arc outside the depth y, where the load is N. */
static fret_real outside(const fret_swing *c, const arc *p, fret_real y, fret_real N) {
    const fret_real N0 = (p->first[M] + p->first[P]) / 2, N1 = (p->last[M] + p->last[P]) / 2;
    if (!(N1 > N && N1 > N0))
        return 0;
    if (p->curved && N0 >= N)
        return p->sum[0];
    if (p->curved) {
        arc part = *p;
        part.lo = time_of(p, N);
        return (part.hi - part.lo) * fret_swing_integral(c, along_rate, &(along){c, &part, false});
    }
    const fret_real inner = N0 > N ? fret_law_depth(c->normal, N0) : y;
    return (p->last[P] - p->first[P] - (p->last[M] - p->first[M])) / 2 / (N1 - N0) *
           (fret_law_depth(c->normal, N1) - inner);
}

fret_real fret_swing_displacement(const fret_swing *c, fret_real x) {
    const fret_real y = fret_normal_profile(c->normal, x);
    if (isnan(x) || !(y < c->dz))
        return isnan(x) ? x : 0;
    const fret_real N = fret_law_force(c->normal, y);
    fret_real sum = 0;
    for (size_t i = c->count; i-- > 0;)
        sum += outside(c, &c->arcs[i], y, N);
    return c->mu * c->normal->foundation.eta * sum;
}

/* ---- the state --------------------------------------------------------------------------------- */

/* The rounding of the ends of an arc, which come from rounded forces. */
static fret_real rounding(const fret_swing *c) {
    return 16 * DBL_EPSILON * c->scale;
}

/* True for a slip zone: straight along one coordinate. */
static bool is_zone(const fret_swing *c, const arc *p, int which) {
    return !p->curved && fabsl(p->last[1 - which] - p->first[1 - which]) <= rounding(c) &&
           p->last[which] - p->first[which] > rounding(c);
}

/* Skips arcs, inwards, that are as small as rounding. */
static const arc *past_rounding(const fret_swing *c, const arc *from) {
    while (from > c->arcs && from->last[M] - from->first[M] + from->last[P] - from->first[P] <= rounding(c))
        from--;
    return from;
}

/* The arc that determines the stick radius, as in diagram_body.h. */
static const arc *outermost(const fret_swing *c) {
    const arc *top = &c->arcs[c->count - 1], *zone = past_rounding(c, top), *next = zone;
    const int which = is_zone(c, zone, P) ? P : M;
    if (!is_zone(c, zone, which))
        return top;
    while (next > c->arcs && is_zone(c, next, which)) {
        zone = next;
        next = past_rounding(c, next - 1);
    }
    return is_zone(c, next, which) ? next : zone;
}

fret_real fret_swing_dx(const fret_swing *c) {
    return c->slid + c->mu * c->normal->foundation.eta * sum_along(c, false);
}

void fret_swing_state(const fret_swing *c, fret_state *out) {
    const fret_real mu_eta = c->mu * c->normal->foundation.eta;
    *out = (fret_state){.FN = c->FN,
                        .dz = c->dz,
                        .a = c->a,
                        .Fx = c->Fx,
                        .dx = c->held ? (fret_real)c->goal : fret_swing_dx(c),
                        .c = c->a,
                        .W = fret_sum_value(&c->W),
                        .U = c->mu * mu_eta * sum_along(c, true),
                        .kn = fret_normal_stiffness(c->normal, c->a),
                        .slices = c->count};
    fret_real inner = c->a;
    if (c->count) {
        const arc *top = outermost(c);
        const bool forward = is_zone(c, top, P) || top->first[M] == top->last[M],
                   backward = is_zone(c, top, M) || top->first[P] == top->last[P];
        const fret_real N = (top->first[M] + top->first[P]) / 2;
        if (forward || backward)
            out->c =
                N > 0 ? fret_law_level_radius(c->normal, &(fret_level){fret_law_depth(c->normal, N), N}) : 0;
        if (c->direction > 0 ? forward : backward)
            inner = out->c;
    }
    out->kt = inner > 0 ? fret_normal_stiffness(c->normal, inner) / c->normal->foundation.eta : 0;
}

/* ---- as a memory ------------------------------------------------------------------------------- */

enum { SAMPLES = 640 };

/* Appends a straight layer to the memory, between two points. */
static void put_layer(fret_memory *m, const fret_real from[2], const fret_real to[2]) {
    const fret_real N0 = (from[M] + from[P]) / 2, N1 = (to[M] + to[P]) / 2, load = N1 - N0;
    if (!(load > 0))
        return;
    fret_place at[2] = {{0, 0}, m->edge.at};
    const fret_level outer = {fret_law_other(m->normal, true, N1, &at[0]), N1};
    const fret_real back = fmaxl(0, to[M] - from[M]), on = fmaxl(0, to[P] - from[P]), turn = (on - back) / 2;
    layer *l = &m->layers[m->count++];
    *l = (layer){m->edge, (on - back) / (on + back)}; /* exactly 1 or -1 where it slips */
    m->edge = (point){{outer.y, N1},
                      {l->inner.t[DEPTH] + l->sigma * fret_law_fall(m->normal, &outer, true, load, N0, at),
                       l->inner.t[LOAD] + turn},
                      at[0]};
}

fret_status fret_swing_memory(const fret_swing *c, fret_memory *m) {
    fret_state now;
    const fret_status st = fret_memory_reserve(m, c->count * SAMPLES + 4);
    if (st.code)
        return st;
    fret_swing_state(c, &now);
    fret_memory_reset(m);
    for (size_t i = 0; i < c->count; i++) {
        const arc *p = &c->arcs[i];
        fret_real from[2] = {p->first[M], p->first[P]}, to[2];
        for (int j = 1; p->curved && j < SAMPLES; j++) {
            const fret_real s = p->lo + (p->hi - p->lo) * j / (fret_real)SAMPLES;
            to[M] = load_path_at(&p->path, M, s);
            to[P] = load_path_at(&p->path, P, s);
            put_layer(m, from, to);
            memcpy(from, to, sizeof from);
        }
        put_layer(m, from, p->last);
    }
    m->edge.y[DEPTH] = m->dz = c->dz;
    m->edge.y[LOAD] = c->FN;
    m->imposed = (double)c->FN == c->FN ? LOAD : DEPTH;
    m->slid = now.dx - m->mu_eta * m->edge.t[DEPTH];
    m->direction = c->direction;
    m->dx = now.dx;
    m->Fx = c->Fx;
    m->W = c->W.sum;
    m->W_rest = c->W.rest;
    m->last_loss = c->last_loss;
    return st;
}
