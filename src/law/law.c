/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The law F_N(delta), its inverse and sums over slices: closed forms for power laws, else cells. Pure. */
#include <float.h>

#include "law/cells.h"
#include "law/normal.h"
#include "number/real.h"

/* ---- the power law ----------------------------------------------------------------------------- */

/* The power law in logarithms of force, depth and radius. */
static dd force_of_depth(const fret_normal *n, dd y) {
    return dd_add(n->wide.ln_force, dd_mul(n->wide.p, dd_sub(y, n->wide.ln_depth)));
}
static dd depth_of_force(const fret_normal *n, dd F) {
    return dd_add(n->wide.ln_depth, dd_mul(n->wide.q, dd_sub(F, n->wide.ln_force)));
}
static dd radius_of_depth(const fret_normal *n, dd y) {
    return dd_add(n->wide.ln_r0, dd_div(dd_sub(y, n->wide.ln_depth), dd_of(n->gap.power[0].n)));
}

/* Moments of the law F = y^p over the distances t = 0..x from the edge y = 1, pm1 = p-1:
 *   w = int K dt, m1 = int t dK, L = int m1 dt;  K = p y^(p-1). */
typedef struct moments {
    fret_real w, m1, L;
} moments;
/* The closed forms lose digits like (p x)^-3, which the guard digits cover down to p x = 0.2. Below that the
 * binomial series of (1-t)^(p-2) is integrated: its terms a fall at least as fast as p x, and integrated
 * twice, to (1-t)^p, they are -a/((i+1)(i+2)). */
static moments moments_series(fret_real pm1, fret_real x) {
    enum { LEADING = 6, MOST = 60 }; /* terms after the leading ones are below 2^-13: double will do */
    static const fret_real inv[LEADING + 2] = {1.0L / 1, 1.0L / 2, 1.0L / 3, 1.0L / 4,
                                               1.0L / 5, 1.0L / 6, 1.0L / 7, 1.0L / 8};
    fret_real p = 1 + pm1, a = p * pm1 * x * x, slope = pm1 * x, w = 0, m1 = 0, L = 0;
    const double ratio = (double)x, fall = (double)slope, small = 1e-20 * (double)a;
    for (int i = 0; i < LEADING; i++) {
        fret_real c = a * inv[i + 1];
        w += c * inv[i];
        m1 += c;
        L += c * inv[i + 2];
        a *= x - slope * inv[i];
    }
    double term = (double)a, wt = 0, m1t = 0, Lt = 0;
    double first = 1.0 / (LEADING + 1), second = 1.0 / (LEADING + 2);
    for (int i = LEADING; i < MOST && fabs(term) > small; i++) {
        const double c = term * second, third = 1.0 / (i + 3);
        wt += c * first;
        m1t += c;
        Lt += c * third;
        term *= ratio - fall * first;
        first = second;
        second = third;
    }
    return (moments){p * x - (w + wt), m1 + m1t, (L + Lt) * x};
}

/* log: ln(1-x), given apart since x may be rounded to 1. */
static moments power_moments(fret_real pm1, fret_real x, fret_real log) {
    fret_real p = 1 + pm1;
    if (isinf(log))
        return (moments){1, 1, pm1 / (p + 1)};
    if (p * x < 0.2L)
        return moments_series(pm1, x);
    /* arranged so that m1 = int t dK and m2 = int t^2 dK keep their factor p-1 */
    fret_real em = expm1l(pm1 * log), y = 1 + em; /* y = (1-x)^(p-1) */
    fret_real m1 = -em * (1 + pm1 * x) - pm1 * x;
    fret_real m2 = (-2 * em - y * pm1 * x * (2 + p * x)) / (2 + pm1);
    return (moments){x * y - em, m1, x * m1 - m2};
}

/* left: depth at the inner end over that at the outer end. */
static fret_slice power_slice(const fret_normal *n, const fret_level *outer, fret_real h, fret_real left) {
    const fret_real y = outer->y, F = outer->F, x = h / y, K = n->p * F / y;
    const fret_real log = x < 0.5L ? log1pl(-x) : left > 0 ? logl(left) : -(fret_real)INFINITY;
    const moments m = power_moments(n->pm1, x, log);
    return (fret_slice){.h = h,
                        .w = F * m.w,
                        .fall = -K * expm1l(n->pm1 * log),
                        .G = F * m.m1,
                        .L = F * y * m.L,
                        .K = K * expl(n->pm1 * log)};
}

static fret_point power_point(const fret_normal *n, bool by_force, fret_real value) {
    fret_point p;
    p.y = by_force ? fret_law_depth(n, value) : value;
    p.F = by_force ? value : fret_law_force(n, value);
    p.K = n->p * p.F / p.y;
    p.a = fret_law_radius(n, p.y);
    return p;
}

/* ---- cells ------------------------------------------------------------------------------------- */

/* True so close to a flat end that no radius resolves it: there the load is K y to every digit. */
static bool is_at_end(const fret_normal *n, const fret_place *p) {
    return p->i == 0 && !(p->s > 0) && fret_gap_start(&n->gap) > 0;
}

static bool find_place(const fret_normal *n, bool by_load, fret_real value, fret_place *at) {
    return at->s > 0 ||
           fret_cells_find(n->cells, by_load ? BY_LOAD : BY_DEPTH, by_load ? value / n->stiff : value, at);
}

/* The load of a depth, or the depth of a load, whose place is known. */
static fret_real other_at(const fret_normal *n, bool by_load, fret_real value, const fret_place *at) {
    if (is_at_end(n, at)) {
        const fret_real K = n->stiff * fret_cells_stiffness(n->cells, at);
        return by_load ? value / K : K * value;
    }
    return by_load ? fret_cells_level(n->cells, BY_DEPTH, at)
                   : n->stiff * fret_cells_level(n->cells, BY_LOAD, at);
}

static fret_point cell_point(const fret_normal *n, bool by_force, fret_real value) {
    fret_place p = {0, 0};
    if (!find_place(n, by_force, value, &p))
        return (fret_point){(fret_real)NAN, (fret_real)NAN, (fret_real)NAN, (fret_real)NAN};
    const fret_real other = other_at(n, by_force, value, &p);
    return (fret_point){by_force ? other : value, by_force ? value : other, fret_cells_radius(n->cells, &p),
                        n->stiff * fret_cells_stiffness(n->cells, &p)};
}

/* The places of the ends of a slice; false beyond the end of the law. */
static bool find_ends(const fret_normal *n, const fret_level *outer, bool by_load, fret_real target,
                      fret_real left, fret_place at[2], fret_real *back) {
    const fret_real per = by_load ? 1 / n->stiff : 1, begin = n->cells->cell[0].begin;
    if (!find_place(n, by_load, by_load ? outer->F : outer->y, &at[0]))
        return false;
    if (left > 0) {
        *back = fret_cells_inner(n->cells, by_load ? BY_LOAD : BY_DEPTH, &at[0], target * per, left * per,
                                 &at[1]);
        return true;
    }
    at[1] = (fret_place){0, begin};
    *back = (at[0].i > 0 ? 1 : at[0].s) - begin;
    return true;
}

static fret_slice cell_slice(const fret_normal *n, const fret_level *outer, bool by_load, fret_real target,
                             fret_real left, fret_place at[2]) {
    fret_real K, back;
    if (!find_ends(n, outer, by_load, target, left, at, &back))
        return (fret_slice){(fret_real)NAN, (fret_real)NAN, (fret_real)NAN,
                            (fret_real)NAN, (fret_real)NAN, (fret_real)NAN};
    const fret_stretch sum = fret_cells_between(n->cells, &at[0], &at[1], back, &K);
    const fret_real G = n->stiff * sum.G;
    K *= n->stiff;
    fret_slice out = {
        .h = target, .w = target, .fall = n->stiff * sum.K, .G = G, .L = n->stiff * sum.L, .K = K};
    if (by_load)
        out.h = is_at_end(n, &at[0]) ? target / K : sum.h;
    else
        out.w = G + target * K;
    return out;
}

/* ---- both -------------------------------------------------------------------------------------- */

static fret_point point_at(const fret_normal *n, bool by_force, fret_real value) {
    if (value <= 0)
        return (fret_point){0, 0, fret_gap_start(&n->gap), 0};
    return fret_normal_closed(n) ? power_point(n, by_force, value) : cell_point(n, by_force, value);
}

fret_point fret_law_at_depth(const fret_normal *n, fret_real y) {
    return point_at(n, false, y);
}

fret_point fret_law_at_force(const fret_normal *n, fret_real F) {
    return point_at(n, true, F);
}

fret_point fret_law_at_radius(const fret_normal *n, fret_real a) {
    if (!(a > fret_gap_start(&n->gap)))
        return point_at(n, false, 0);
    if (fret_normal_closed(n))
        return power_point(n, false, fret_gap_profile(&n->gap, &n->rule, a).g);
    const fret_place p = fret_cells_at(n->cells, a);
    return (fret_point){fret_cells_level(n->cells, BY_DEPTH, &p),
                        n->stiff * fret_cells_level(n->cells, BY_LOAD, &p), a,
                        n->stiff * fret_cells_stiffness(n->cells, &p)};
}

fret_real fret_law_radius(const fret_normal *n, fret_real y) {
    if (fret_normal_closed(n))
        return y > 0 ? fret_dd_exp_real(radius_of_depth(n, fret_dd_log_real(y))) : 0;
    return point_at(n, false, y).a;
}

fret_real fret_law_distance(const fret_normal *n, fret_real y) {
    fret_place p;
    if (fret_normal_closed(n))
        return fret_law_radius(n, y);
    if (!(y > 0))
        return 0;
    if (!fret_cells_find(n->cells, BY_DEPTH, y, &p))
        return (fret_real)INFINITY;
    const fret_cell *c = &n->cells->cell[p.i];
    return p.i > 0 || c->powers ? fret_cell_radius(c, p.s) - fret_gap_start(&n->gap)
                                : c->width * p.s / (c->x + sqrtl(c->x * c->x + c->width * p.s));
}

fret_place fret_law_place(const fret_normal *n, fret_real a) {
    static const fret_real NEAR = 0.9L;
    return fret_normal_closed(n) || !(fret_gap_start(&n->gap) < NEAR * a) || !(a < n->end)
               ? (fret_place){0, 0}
               : fret_cells_at(n->cells, a);
}

fret_real fret_law_other(const fret_normal *n, bool by_load, fret_real value, fret_place *at) {
    if (value <= 0)
        return 0;
    if (!fret_normal_closed(n))
        return find_place(n, by_load, value, at) ? other_at(n, by_load, value, at) : (fret_real)NAN;
    const dd log = fret_dd_log_real(value);
    return fret_dd_exp_real(by_load ? depth_of_force(n, log) : force_of_depth(n, log));
}

fret_real fret_law_force(const fret_normal *n, fret_real y) {
    return fret_law_other(n, false, y, &(fret_place){0, 0});
}

fret_real fret_law_depth(const fret_normal *n, fret_real F) {
    return fret_law_other(n, true, F, &(fret_place){0, 0});
}

fret_slice fret_law_slice_to(const fret_normal *n, const fret_level *outer, bool by_load, fret_real target,
                             fret_real left, fret_place at[2]) {
    if (!(target > 0))
        return (fret_slice){0, 0, 0, 0, 0, fret_law_at_depth(n, outer->y).K};
    if (!fret_normal_closed(n))
        return cell_slice(n, outer, by_load, fminl(target, by_load ? outer->F : outer->y), left,
                          at ? at : (fret_place[2]){{0, 0}, {0, 0}});
    if (!by_load)
        return power_slice(n, outer, target, left / outer->y);
    const fret_real inner =
        left > 0 ? fret_pow(left / outer->F, n->q) : 0; /* keeps the digits of a small rest */
    return power_slice(n, outer, inner < 0.5L ? outer->y * (1 - inner) : fret_law_thickness(n, outer, target),
                       inner);
}

fret_slice fret_law_slice(const fret_normal *n, const fret_level *outer, fret_real h) {
    return fret_law_slice_to(n, outer, false, h, outer->y - h, NULL);
}

fret_real fret_law_fall(const fret_normal *n, const fret_level *outer, bool by_load, fret_real target,
                        fret_real left, fret_place at[2]) {
    const fret_real whole = by_load ? outer->F : outer->y, other = by_load ? outer->y : outer->F;
    fret_real back;
    if (target >= whole)
        return other;
    if (fret_normal_closed(n))
        return -other * expm1l((by_load ? n->q : n->p) * log1pl(-target / whole));
    if (!find_ends(n, outer, by_load, target, left, at, &back))
        return (fret_real)NAN;
    if (is_at_end(n, &at[0]))
        return other * (target / whole);
    const fret_real fall = fret_cells_fall(n->cells, by_load ? BY_DEPTH : BY_LOAD, &at[0], &at[1], back);
    return by_load ? fall : n->stiff * fall;
}

fret_real fret_slice_moment(const fret_slice *s) {
    return (s->h * s->h * s->K + (s->h * s->G - s->L)) / 2;
}

fret_real fret_normal_energy(const fret_normal *n, const fret_press *press) {
    if (!(press->dz > 0))
        return 0;
    const fret_slice all =
        fret_law_slice_to(n, &(fret_level){press->dz, press->F}, false, press->dz, 0, NULL);
    return fret_slice_moment(&all);
}

fret_real fret_law_load(const fret_normal *n, const fret_level *outer, fret_real h) {
    return fret_law_fall(n, outer, false, h, outer->y - h, (fret_place[2]){{0, 0}, {0, 0}});
}

fret_real fret_law_thickness(const fret_normal *n, const fret_level *outer, fret_real w) {
    return fret_law_fall(n, outer, true, w, outer->F - w, (fret_place[2]){{0, 0}, {0, 0}});
}

fret_real fret_law_level_radius(const fret_normal *n, const fret_level *level) {
    if (!fret_normal_closed(n))
        return fret_law_radius(n, level->y);
    if (level->F <= 0)
        return 0;
    dd l = dd_sub(fret_dd_log_real(level->F), n->wide.ln_force);
    return fret_dd_exp_real(dd_add(n->wide.ln_r0, dd_div(l, n->wide.s)));
}
