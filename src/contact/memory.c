/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The memory diagram as an object: made, copied, asked for its state. Steps are in memory_step.c. Allocates
 * its slices. */
#include "contact/memory.h"

#include <float.h>
#include <stdlib.h>
#include <string.h>

#include "contact/check.h"
#include "number/array.h"

fret_status fret_memory_make(const fret_normal *normal, double mu, fret_memory **out) {
    fret_status st = fret_check_positive("mu", mu);
    if (st.code)
        return st;
    fret_memory *m = calloc(1, sizeof *m);
    slice *slices = calloc(8, sizeof *slices);
    if (!m || !slices) {
        free(m);
        free(slices);
        return fret_fail(FRET_NO_MEMORY, NULL, 0, 0);
    }
    m->normal = normal;
    m->mu = mu;
    m->mu_eta = mu * normal->foundation.eta;
    m->loss_scale = mu * m->mu_eta;
    m->slices = slices;
    m->room = 8;
    fret_memory_reset(m);
    *out = m;
    return fret_ok();
}

void fret_memory_free(fret_memory *m) {
    if (m) {
        free(m->slices);
        free(m->near);
    }
    free(m);
}

void fret_memory_reset(fret_memory *m) {
    m->edge[DEPTH] = m->edge[LOAD] = m->slid = m->last_loss = 0;
    m->gap = 0;
    m->W = (fret_sum){0, 0};
    m->count = 0;
    m->moves = 0;
    m->pressed_near = false;
    m->direction = 1;
    m->held = FRET_KEEP_DX;
    m->edge_id = 1; /* 0: never computed */
}

fret_status fret_memory_reserve(fret_memory *m, size_t count) {
    if (count <= m->room)
        return fret_ok();
    slice *grown = fret_array_for(m->slices, &m->room, count, sizeof *grown);
    if (!grown)
        return fret_fail(FRET_NO_MEMORY, NULL, 0, 0);
    m->slices = grown;
    return fret_ok();
}

fret_status fret_memory_copy(fret_memory *to, const fret_memory *from) {
    if (to == from)
        return fret_ok();
    fret_status st = fret_memory_reserve(to, from->count);
    if (st.code)
        return st;
    slice *slices = to->slices;
    size_t room = to->room;
    fret_near *near = to->near;
    *to = *from;
    to->slices = slices;
    to->room = room;
    to->near = near;
    if (near)
        fret_near_move(near, from->normal);
    memcpy(slices, from->slices, from->count * sizeof *slices);
    return fret_ok();
}

void fret_memory_forces(const fret_memory *m, fret_state *out) {
    *out = (fret_state){
        .FN = m->edge[LOAD],
        .dz = m->gap > 0 ? -m->gap : m->edge[DEPTH],
        .Fx = m->held == FRET_TO_FX ? (fret_real)m->goal : m->mu * fret_memory_total(m, LOAD),
        .dx = m->held == FRET_TO_DX ? (fret_real)m->goal : fret_memory_dx(m),
        .W = fret_sum_value(&m->W),
        .slices = m->count,
    };
}

fret_press fret_memory_pressed(const fret_memory *m) {
    fret_press p = {.F = m->edge[LOAD],
                    .dz = m->edge[DEPTH],
                    .a = m->radius,
                    .F_rest = m->edge_rest[LOAD],
                    .dz_rest = m->edge_rest[DEPTH]};
    if (m->pressed_near) /* what was pressed near can be pressed */
        (void)(m->told_by == FRET_TO_FORCE ? fret_press_by_force(m->normal, m->told, &p)
                                           : fret_press_by_depth(m->normal, m->told, &p));
    return p;
}

double fret_memory_edge_rest(const fret_memory *m, coordinate by, fret_real edge) {
    if (!m->pressed_near)
        return m->edge_rest[by];
    if ((m->told_by == FRET_TO_FORCE) == (by == LOAD))
        return 0; /* it was told so */
    const fret_press p = fret_memory_pressed(m);
    return (double)(by == LOAD ? (p.F - edge) + p.F_rest : (p.dz - edge) + p.dz_rest);
}

static fret_real moment_of(const fret_memory *m, const fret_level *outer, fret_real h) {
    const fret_slice s = fret_law_slice(m->normal, outer, h);
    return fret_slice_moment(&s);
}

/* U = mu^2 eta/2 int v^2 dK with v the sum of sigma from the edge: from the centre outwards, a slice of
 * thickness h adds sigma h T + sigma^2 J to the half integral, T the sum of sigma dF_N inside it. */
static fret_real stored(const fret_memory *m) {
    fret_real sum = 0, T = 0;
    for (size_t i = 0; i < m->count && !fret_stopped(m->normal); i++) {
        const slice *sl = &m->slices[i];
        const fret_real *end = i + 1 < m->count ? sl[1].inner : m->edge, h = sl->thick[DEPTH];
        const fret_level outer = {end[DEPTH], end[LOAD]};
        if (sl->sigma != 0 && h > 0)
            sum += sl->sigma * h * T + sl->sigma * sl->sigma * moment_of(m, &outer, h);
        T = sl->sum[LOAD];
    }
    return m->loss_scale * sum;
}

/* Inwards from a slice, past those that are as thin as the rounding of loads. */
static const slice *past_rounding(const fret_memory *m, const slice *from) {
    const fret_real rounding = 4 * DBL_EPSILON * m->edge[LOAD];
    while (from > m->slices && from->thick[LOAD] <= rounding)
        from--;
    return from;
}

/* The slice that tells c: slip that a load has come back to, but for its rounding, is not hidden by what that
 * leaves at the edge, or where the present slip meets it. */
static const slice *outermost(const fret_memory *m) {
    const slice *top = &m->slices[m->count - 1], *zone = past_rounding(m, top), *next = zone;
    if (fabsl(zone->sigma) < 1)
        return top;
    while (next > m->slices && next->sigma == zone->sigma) {
        zone = next;
        next = past_rounding(m, next - 1);
    }
    return next->sigma == zone->sigma ? next : zone;
}

void fret_memory_state(const fret_memory *m, fret_state *out) {
    fret_memory_forces(m, out);
    if (!m->count)
        return;
    const slice *top = outermost(m);
    out->U = stored(m);
    out->a = fret_memory_pressed(m).a;
    out->kn = fret_normal_stiffness(m->normal, out->a);
    out->c = out->a;
    if (fabsl(top->sigma) >= 1)
        out->c = top == m->slices
                     ? 0
                     : fret_law_level_radius(m->normal, &(fret_level){top->inner[DEPTH], top->inner[LOAD]});
    bool goes_on = top->sigma * m->direction >= 1;
    fret_real inner = goes_on ? out->c : out->a;
    out->kt = inner > 0 ? fret_normal_stiffness(m->normal, inner) / m->normal->foundation.eta : 0;
}

const fret_normal *fret_memory_normal(const fret_memory *m) {
    return m->normal;
}

double fret_memory_friction(const fret_memory *m) {
    return m->mu;
}

fret_real fret_memory_last_loss(const fret_memory *m) {
    return m->last_loss;
}

int fret_memory_segment(const fret_memory *m, size_t i, fret_segment *out) {
    if (i >= m->count)
        return 0;
    const slice *sl = &m->slices[i];
    fret_real outer = i + 1 < m->count ? sl[1].inner[DEPTH] : m->edge[DEPTH];
    fret_real inside = i ? sl[-1].sum[DEPTH] : 0;
    *out = (fret_segment){sl->inner[DEPTH], outer, sl->sigma,
                          m->mu_eta * (fret_memory_total(m, DEPTH) - inside)};
    return 1;
}

/* The depth of the spring at distance |x|; false where none is in contact. */
static bool spring_at(const fret_memory *m, fret_real x, fret_real *y) {
    const fret_real r = fabsl(x);
    if (!m->count || (!m->pressed_near && r >= m->radius))
        return false;
    const fret_real g = fret_normal_profile(m->normal, r);
    *y = g > m->edge[DEPTH] ? m->edge[DEPTH] : g; /* by rounding; NaN stays */
    return true;
}

/* From the edge inwards, where u begins at 0: near the edge no difference loses digits. */
fret_real fret_memory_displacement(const fret_memory *m, fret_real x) {
    fret_real y, u = 0;
    if (!spring_at(m, x, &y))
        return 0;
    size_t i = m->count - 1;
    fret_real outer = m->edge[DEPTH];
    for (; i > 0 && m->slices[i].inner[DEPTH] > y; i--) {
        u += m->slices[i].sigma * m->slices[i].thick[DEPTH];
        outer = m->slices[i].inner[DEPTH];
    }
    return m->mu_eta * (u + m->slices[i].sigma * (outer - y));
}

fret_real fret_memory_bound(const fret_memory *m, fret_real x) {
    fret_real y;
    return spring_at(m, x, &y) ? m->mu_eta * (m->edge[DEPTH] - y) : 0;
}

/* int |u (delta_x-u)| dK over a part of a slice, of thickness h, without a change of sign within: with t the
 * distance from its outer end u = u0 + s t and delta_x-u = v0 - s t. */
static fret_real slip_part(const fret_memory *m, const fret_level *outer, fret_real h, fret_real u0,
                           fret_real v0, fret_real s) {
    const fret_slice part = fret_law_slice(m->normal, outer, h);
    const fret_real t2 = h * part.G - part.L; /* int t^2 dK */
    const fret_real ends = u0 != 0 && v0 != 0 ? u0 * v0 * part.fall : 0;
    return fabsl(ends + s * (v0 - u0) * part.G - s * s * t2);
}

/* The same over a slice, cut where u or delta_x-u changes sign. */
static fret_real slip_slice(const fret_memory *m, const fret_level *outer, fret_real h, fret_real u0,
                            fret_real v0, fret_real s) {
    fret_real cut[2] = {s != 0 ? -u0 / s : 0, s != 0 ? v0 / s : 0}, sum = 0, from = 0;
    if (cut[0] > cut[1]) {
        const fret_real first = cut[1];
        cut[1] = cut[0];
        cut[0] = first;
    }
    for (int i = 0; i <= 2; i++) {
        const fret_real to = i < 2 ? fminl(cut[i], h) : h;
        if (!(to > from))
            continue;
        fret_level at = *outer;
        if (from > 0)
            at = (fret_level){outer->y - from, fret_law_force(m->normal, outer->y - from)};
        sum += slip_part(m, &at, to - from, u0 + s * from, v0 - s * from, s);
        from = to;
    }
    return sum;
}

fret_real fret_memory_slip_work(const fret_memory *m) {
    const fret_real dx = fret_memory_dx(m);
    fret_real sum = 0, u = 0;
    fret_level outer = {m->edge[DEPTH], m->edge[LOAD]};
    for (size_t i = m->count; i-- > 0 && !fret_stopped(m->normal);) {
        const slice *sl = &m->slices[i];
        /* to the very centre, where K may rise so steeply that the rounding of a thickness shows */
        const fret_real h = i ? sl->thick[DEPTH] : outer.y, s = m->mu_eta * sl->sigma;
        sum += slip_slice(m, &outer, h, u, dx - u, s);
        u += s * h;
        outer = (fret_level){sl->inner[DEPTH], sl->inner[LOAD]};
    }
    if (m->count) /* the springs under a flat end all touch at depth 0 */
        sum += fabsl(u * (dx - u)) * fret_normal_stiffness(m->normal, fret_gap_start(&m->normal->gap));
    return sum > 0 ? -sum / m->normal->foundation.eta : 0;
}
