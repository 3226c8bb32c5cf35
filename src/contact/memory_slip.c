/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Slip at constant normal load: a zone eats inwards from the edge. Touches the slices of its contact. */
#include "contact/slices.h"

#include "contact/check.h"
#include "number/quadrature.h"

/* int over distances 0..d from the edge of [F(y)-F(y-t)-tK(y-t)] dt: what a front that has reached d has
 * dissipated, per mu^2 eta and gain. */
static fret_slice edge_slice(const fret_memory *m, fret_real d) {
    const fret_level edge = {m->edge[DEPTH], m->edge[LOAD]};
    return fret_law_slice(m->normal, &edge, d);
}

typedef struct rise {
    const fret_memory *m;
    fret_real d, h;
} rise;

static fret_real rise_rate(fret_real t, fret_real rest, void *context) {
    const rise *r = context;
    (void)rest;
    return fret_stopped(r->m->normal) ? 0 : edge_slice(r->m, r->d + r->h * t).G;
}

/* L2-L1, also where the two levels are too close for a difference: by quadrature of G, which is singular at
 * the centre and the smoother the farther that is. */
static fret_real level_rise(const fret_memory *m, fret_real d1, fret_real L1, fret_real d2, fret_real L2) {
    const fret_real h = d2 - d1, inside = m->edge[DEPTH] - d2;
    if (h > 1e-5L * d2)
        return L2 - L1;
    rise r = {m, d1, h};
    if (inside < h)
        return h * fret_integrate(rise_rate, &r);
    if (inside < 1e4L * h)
        return h * fret_integrate_smooth(rise_rate, &r);
    const fret_real mid = (d1 + d2) / 2, offset = h / 2 * 0.5773502691896257645091487805019574556L;
    return h / 2 * (edge_slice(m, mid - offset).G + edge_slice(m, mid + offset).G);
}

static fret_real inner_level(const fret_memory *m, slice *sl, fret_real d) {
    if (sl->edge != m->edge_id) {
        sl->L = edge_slice(m, d).L;
        sl->edge = m->edge_id;
    }
    return sl->L;
}

/* The outermost slice at the end of a step at constant F_N, to `at`; the other coordinate follows. */
static void keep_inner(fret_memory *m, coordinate by, fret_real s, double goal, fret_real eaten[2],
                       fret_real at[2]) {
    const fret_level edge = {m->edge[DEPTH], m->edge[LOAD]};
    const size_t i = m->count - 1;
    const coordinate other = by == DEPTH ? LOAD : DEPTH;
    slice *top = &m->slices[i];
    const dd scale = by == LOAD ? dd_of(m->mu) : dd_mul_d(m->normal->wide_foundation.eta, m->mu);
    const dd bound = dd_mul(scale, dd_from2(m->edge[by], fret_memory_edge_rest(m, by, m->edge[by])));
    const dd to = by == LOAD ? dd_of(goal) : dd_sub(dd_of(goal), dd_from(m->slid));
    const dd left = dd_div(s < 0 ? dd_add(bound, to) : dd_sub(bound, to), scale);
    top->thick[by] = thick_at_brink(m, i, by, s, left);
    at[by] = inner_of(m, i, by) + top->thick[by];
    eaten[by] = m->edge[by] - at[by];
    if (by == DEPTH) {
        at[LOAD] = fret_law_force(m->normal, at[DEPTH]);
        eaten[LOAD] = fret_law_load_outside(m->normal, &edge, at[DEPTH]);
    } else {
        at[DEPTH] = fret_law_depth(m->normal, at[LOAD]);
        eaten[DEPTH] = fret_law_thickness_outside(m->normal, &edge, at[LOAD]);
    }
    const fret_level outer = {at[DEPTH], at[LOAD]};
    if (2 * inner_of(m, i, by) < at[by])
        top->thick[other] = at[other] - inner_of(m, i, other);
    else
        top->thick[other] = by == DEPTH ? fret_law_load(m->normal, &outer, top->thick[DEPTH])
                                        : fret_law_thickness(m->normal, &outer, top->thick[LOAD]);
}

/* The front of a slip zone of sign s at constant normal load: the zone eats inwards from the edge. */
typedef struct slip_front {
    coordinate by;
    fret_real s, drive;        /* drive left */
    fret_real eaten[2], at[2]; /* so far, counted from the edge; the place */
} slip_front;

/* Each of the three moves returns what edge_slice gives at the new front. */

/* All of the outermost slice. */
static fret_real eat_slice(fret_memory *m, slip_front *f, fret_real cap) {
    slice *top = &m->slices[m->count - 1];
    f->drive = cap < f->drive ? f->drive - cap : 0;
    for (coordinate i = DEPTH; i <= LOAD; i++) {
        f->eaten[i] += top->thick[i];
        f->at[i] = top->inner[i];
    }
    const fret_real level = inner_level(m, top, f->eaten[DEPTH]);
    m->count--;
    return level;
}

/* Up to a small core. */
static fret_real eat_to_core(fret_memory *m, slip_front *f, double goal) {
    keep_inner(m, f->by, f->s, goal, f->eaten, f->at);
    resum_top(m);
    f->drive = 0;
    return edge_slice(m, f->eaten[DEPTH]).L;
}

/* A part of the outermost slice, until the drive is used up. */
static fret_real eat_part(fret_memory *m, slip_front *f, fret_real gain) {
    slice *top = &m->slices[m->count - 1];
    const fret_level outer = {f->at[DEPTH], f->at[LOAD]};
    const fret_real d = f->eaten[DEPTH];
    fret_real part[2] = {f->drive / gain, f->drive / gain};
    if (f->by == LOAD)
        part[DEPTH] = fret_law_thickness(m->normal, &outer, part[LOAD]);
    const fret_slice whole = edge_slice(m, d + part[DEPTH]);
    if (f->by == DEPTH) /* a difference of loads from the edge does unless the part is thin */
        part[LOAD] = part[DEPTH] > 1e-4L * d ? whole.w - f->eaten[LOAD]
                                             : fret_law_load(m->normal, &outer, part[DEPTH]);
    for (coordinate i = DEPTH; i <= LOAD; i++) {
        f->eaten[i] += part[i];
        f->at[i] -= part[i];
        top->thick[i] -= part[i];
    }
    resum_top(m);
    f->drive = 0;
    return whole.L;
}

/* The zone becomes the outermost slice; `level` spares its inner end a quadrature. */
static void push_zone(fret_memory *m, const slip_front *f, fret_real level) {
    push(m, f->eaten, f->at, f->s, 0);
    slice *top = &m->slices[m->count - 1];
    if (top->inner[f->by] == f->at[f->by]) { /* not merged into the slice below */
        top->L = level;
        top->edge = m->edge_id;
    }
}

/* Tangential step at constant normal load, to F_x or delta_x = goal: the slip zone eats inwards until its
 * drive is used up. Drive left at the centre is gross slip. */
fret_real fret_memory_slip(fret_memory *m, coordinate by, fret_real drive, double goal) {
    const fret_real snap = 1e-17L * m->edge[by]; /* a turning point is reached up to rounding */
    slip_front f = {by, drive < 0 ? -1 : 1, fabsl(drive), {0, 0}, {m->edge[DEPTH], m->edge[LOAD]}};
    fret_real loss = 0, level = 0;
    while (m->count && f.drive > 0) {
        const slice *top = &m->slices[m->count - 1];
        const fret_real gain = 1 - f.s * top->sigma, cap = gain * top->thick[by], d = f.eaten[DEPTH];
        fret_real next;
        if (cap - f.drive <= snap && cap - f.drive <= 1e-6L * cap)
            next = eat_slice(m, &f, cap);
        else if (8 * (cap - f.drive) < gain * (m->edge[by] - 8 * inner_of(m, m->count - 1, by)))
            next = eat_to_core(m, &f, goal);
        else
            next = eat_part(m, &f, gain);
        if (gain > 0)
            loss += gain * (d > 0 ? level_rise(m, d, level, f.eaten[DEPTH], next) : next);
        level = next;
    }
    if (!m->count) {
        f.at[DEPTH] = f.at[LOAD] = 0;
        if (by == DEPTH) {
            loss += f.drive * m->edge[LOAD];
            m->slid += f.s * m->mu_eta * f.drive;
        }
    }
    if (f.eaten[LOAD] > 0)
        push_zone(m, &f, level);
    return loss;
}
