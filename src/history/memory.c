/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The exact memory diagram, under any law. Allocates the layers of its contact. */
#include "history/memory.h"

#include "number/dd.h"

/* The accuracy of positions on the curve: the rounding of long double. */
#define LITTLE 1e-17L

/* ---- the law ----------------------------------------------------------------------------------- */

static fret_level level_of(coordinate by, const place *p) {
    return by == LOAD ? (fret_level){p->v, p->y} : (fret_level){p->y, p->v};
}

FRET_INLINE void law_find(const fret_memory *m, coordinate by, place *p) {
    if (fret_normal_closed(m->normal) && p->v < 0)
        p->v = power_value(&m->law[by], p->y);
    else if (p->v < 0)
        p->v = fret_law_other(m->normal, by == LOAD, p->y, &p->at);
}

static fret_real law_fall(const fret_memory *m, coordinate by, place *edge, fret_real thick, place *inner) {
    if (2 * thick < edge->y) {
        const fret_level level = level_of(by, edge);
        fret_place at[2] = {edge->at, inner->at};
        const fret_real fall = fret_law_fall(m->normal, &level, by == LOAD, thick, inner->y, at);
        inner->at = at[1];
        if (inner->v < 0)
            inner->v = edge->v - fall;
        return fall;
    }
    law_find(m, by, inner);
    return edge->v - inner->v;
}

FRET_INLINE bow law_bow(const fret_memory *m, coordinate by, const place *outer, const place *inner,
                        fret_real w) {
    if (fret_normal_closed(m->normal))
        return power_bow(&m->law[by], outer, inner, w);
    const bool by_load = by == LOAD;
    const fret_level level = level_of(by, outer);
    fret_place at[2] = {outer->at, inner->at};
    const fret_slice s = fret_law_slice_to(m->normal, &level, by_load, w, inner->y, at);
    const fret_real N = (s.h * s.fall - s.G) / (by_load ? s.K + s.fall : 1),
                    G = !by_load  ? s.G
                        : s.K > 0 ? s.G / s.K
                                  : 0; /* at the centre K = 0 */
    return (bow){(w * G - s.L) / (w * w), 2 * s.L / (w * w), (w * N - s.L) / (w * w)};
}

static bool law_holds(const fret_memory *m, coordinate by, fret_real y) {
    fret_press p;
    return !press_by(m->normal, by, (double)y, &p).code;
}

fret_press fret_memory_pressed(const fret_memory *m) {
    fret_press p = {.F = 0}; /* cannot fail: it succeeded before */
    (void)press_by(m->normal, m->imposed, (double)m->edge.y[m->imposed], &p);
    return p;
}

/* y - s t with all digits: F_N - s F_x/mu, or delta_z - s (delta_x - slid)/(mu eta). */
static fret_real law_level(const fret_memory *m, coordinate by, fret_real s, const place *edge,
                           fret_real level) {
    fret_press p = {.F = 0};
    double rest = 0;
    (void)level;
    if (m->imposed != by) {
        (void)press_by(m->normal, m->imposed, (double)edge->v, &p);
        rest = (double)(by == LOAD ? (p.F - edge->y) + p.F_rest : (p.dz - edge->y) + p.dz_rest);
    }
    const dd scale = by == LOAD ? dd_of(m->mu) : dd_mul_d(m->normal->wide_foundation.eta, m->mu);
    const dd bound = dd_mul(scale, dd_from2(edge->y, rest)),
             to = by == LOAD ? dd_from(m->Fx) : dd_sub(dd_from(m->dx), dd_from(m->slid));
    return fmaxl(dd_value(dd_div(s < 0 ? dd_add(bound, to) : dd_sub(bound, to), scale)), 0);
}

static fret_real law_radius(const fret_memory *m) {
    return fret_memory_pressed(m).a;
}

#include "history/diagram_body.h"

static void law_slips(fret_memory *m, coordinate by, fret_real gain, const slip_front *a, const slip_front *b,
                      fret_real travel) {
    if (travel > 0)
        fret_slips_add(m->slips, &(slip_phase){.kind = by == DEPTH ? LINEAR_IN_DEPTH : LINEAR_IN_LOAD,
                                               .edge = {a->edge.y, b->edge.y},
                                               .front = {a->at.y, b->at.y},
                                               .gain = gain});
}

static void law_slips_all(fret_memory *m, fret_real e, const place *from, const place *to) {
    fret_slips_add(m->slips, &(slip_phase){.kind = GROSS, .edge = {from->y, to->y}, .gain = e});
}

/* Widens the range to the value: what lies between values in range is in range. */
static fret_status law_prepare(fret_memory *m, coordinate by, double y) {
    fret_press p;
    if (fret_normal_closed(m->normal))
        return choose_reference(m, by, y);
    const fret_status st = press_by(m->normal, by, y, &p);
    for (coordinate i = DEPTH; i <= LOAD && !st.code; i++) {
        const fret_real at = i == LOAD ? p.F : p.dz;
        m->low[i] = fminl(m->low[i], at);
        m->high[i] = fmaxl(m->high[i], at);
    }
    return st;
}

fret_status fret_step_load(double mu, const fret_step *step, fret_real FN, fret_real *load) {
    const fret_real limit = FN, to = step->tangential / (fret_real)mu;
    if (!isfinite(step->tangential))
        return fret_fail(FRET_NOT_FINITE, "Fx", step->tangential, 0);
    *load = to;
    if (fabsl(to) > limit * (1 - (fret_real)DBL_EPSILON)) {
        if (fabsl(to) > limit * (1 + (fret_real)DBL_EPSILON))
            return fret_fail(FRET_GROSS_SLIP, "Fx", step->tangential, (double)(mu * limit));
        *load = copysignl(limit, to); /* mu F_N up to its rounding */
    }
    return fret_ok();
}

/* ---- the object -------------------------------------------------------------------------------- */

fret_status fret_memory_reserve(fret_memory *m, size_t count) {
    return reserve(m, count);
}

fret_status fret_memory_step(fret_memory *m, const fret_step *step) {
    const fret_status st = diagram_step(m, step);
    return st.code ? st : fret_unless_stopped(m->normal, st);
}

/* ---- along the curve --------------------------------------------------------------------------- */

bool fret_memory_segment(const fret_memory *m, size_t i, fret_segment *out) {
    if (i >= m->count)
        return false;
    const layer *l = &m->layers[i];
    *out = (fret_segment){l->inner.y[DEPTH], outer_of(m, l)->y[DEPTH], l->sigma,
                          m->mu_eta * (m->edge.t[DEPTH] - l->inner.t[DEPTH])};
    return true;
}

/* Sums from the edge inwards, where u = 0: near the edge no difference loses digits. */
fret_real fret_memory_displacement(const fret_memory *m, fret_real x) {
    const fret_real y = fret_normal_profile(m->normal, x);
    fret_real u = 0;
    if (isnan(x) || !m->count || !(y < m->edge.y[DEPTH])) /* none is left by loads 1e17 times as large */
        return isnan(x) ? x : 0;
    const layer *l = &m->layers[m->count - 1];
    for (; l > m->layers && l->inner.y[DEPTH] > y; l--)
        u += l->sigma * layer_thickness(l, outer_of(m, l), DEPTH);
    return m->mu_eta * (u + l->sigma * (outer_of(m, l)->y[DEPTH] - y));
}

/* int |u (delta_x-u)| dK over a part of a layer, of thickness h, in which the sign does not change: with t
 * the distance from its outer end, u = u0 + s t and delta_x-u = v0 - s t. */
static fret_real slip_part(const fret_memory *m, const fret_level *outer, fret_real h, fret_real u0,
                           fret_real v0, fret_real s) {
    const fret_slice part = fret_law_slice(m->normal, outer, h);
    const fret_real t2 = h * part.G - part.L; /* int t^2 dK */
    const fret_real ends = u0 != 0 && v0 != 0 ? u0 * v0 * part.fall : 0;
    return fabsl(ends + s * (v0 - u0) * part.G - s * s * t2);
}

/* The same over a layer, in parts between the zeros of u and of delta_x-u. */
static fret_real slip_layer(const fret_memory *m, const fret_level *outer, fret_real h, fret_real u0,
                            fret_real v0, fret_real s) {
    fret_real cut_at[2] = {s != 0 ? -u0 / s : 0, s != 0 ? v0 / s : 0}, sum = 0, from = 0;
    if (cut_at[0] > cut_at[1]) {
        const fret_real first = cut_at[1];
        cut_at[1] = cut_at[0];
        cut_at[0] = first;
    }
    for (int i = 0; i <= 2; i++) {
        const fret_real to = i < 2 ? fminl(cut_at[i], h) : h;
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
    const fret_real dx = m->slid + m->mu_eta * m->edge.t[DEPTH];
    fret_real sum = 0, u = 0;
    for (size_t i = m->count; i-- > 0 && !fret_stopped(m->normal);) {
        const layer *l = &m->layers[i];
        const point *end = outer_of(m, l);
        const fret_level outer = {end->y[DEPTH], end->y[LOAD]};
        /* exactly to the centre, where a steep K would show the rounding of a thickness */
        const fret_real h = i ? layer_thickness(l, end, DEPTH) : outer.y, s = m->mu_eta * l->sigma;
        sum += slip_layer(m, &outer, h, u, dx - u, s);
        u += s * h;
    }
    if (m->count) /* the springs under a flat end all touch at depth 0 */
        sum += fabsl(u * (dx - u)) * fret_normal_stiffness(m->normal, fret_gap_start(&m->normal->gap));
    return sum > 0 ? -sum / m->normal->foundation.eta : 0;
}
