/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "fret/normal.h"

#include <float.h>

#include "gap.h"
#include "special.h"

/* Radii are handled as their distance e from the start of the gap. */
static fret_profile profile(const fret_normal *n, fret_real e) {
    return fret_gap_profile(&n->gap, &n->rule, e);
}

/* Finds the first radius where g falls: the contact is a disc up to there. Sums with a negative term and
 * tables can do so; sampled at 400 radii, then bisected. */
static fret_status find_end(fret_normal *n) {
    const fret_gap *gap = &n->gap;
    fret_real start = fret_gap_start(gap), last = fret_gap_end(gap), lo = start, first = 1e-12L;
    n->end = last;
    bool negative = gap->kind == FRET_GAP_TABLE && !fret_table_grows(gap->table);
    for (int i = 0; i < gap->terms && gap->kind == FRET_GAP_SUM; i++)
        negative = negative || gap->power[i].h < 0;
    if (!negative)
        return fret_ok();
    bool table = gap->kind == FRET_GAP_TABLE;
    for (int i = 1; i <= 400; i++) {
        fret_real x = table ? start + (last - start) * i / 400 : first * fret_pow(1e18L, i / 400.0L);
        if (profile(n, x - start).slope >= 0) {
            lo = x;
            continue;
        }
        if (i == 1)
            return fret_fail(FRET_NOT_MONOTONE, "r", (double)(table ? x : 0), 0);
        fret_real hi = x;
        for (int j = 0; j < 60; j++) {
            fret_real mid = (lo + hi) / 2;
            if (profile(n, mid - start).slope >= 0)
                lo = mid;
            else
                hi = mid;
        }
        if (table)
            return fret_fail(FRET_NOT_MONOTONE, "r", (double)lo, 0);
        n->end = lo;
        n->falls = true;
        break;
    }
    return fret_ok();
}

/* Depth and force of the power law at a = r0, in logarithms: any exponent, no overflow. */
static void make_power(fret_normal *n) {
    const fret_foundation *f = &n->foundation;
    const fret_power *g = &n->gap.power[0];
    const double k = (double)f->k;
    dd k1 = dd_sum(1, k), s = dd_add_d(k1, g->n);
    n->wide.s = s;
    n->wide.p = dd_div(s, dd_of(g->n));
    n->wide.q = dd_div(dd_of(g->n), s);
    n->s = dd_value(s);
    n->p = dd_value(n->wide.p);
    n->q = dd_value(n->wide.q);
    n->pm1 = dd_value(dd_div(k1, dd_of(g->n)));
    dd_scaled kappa = fret_kappa_parts(g->n, k);
    n->rule.k = f->k;
    n->rule.kappa[0] = dd_value(dd_mul(kappa.factor, dd_exp(kappa.log)));
    int e;
    double h = frexp(g->h, &e);
    dd r0 = dd_log(dd_of(g->r0));
    n->wide.ln_r0 = r0;
    n->wide.ln_depth = dd_add(kappa.log, dd_log_scaled(dd_mul_d(kappa.factor, h), e));
    /* 2 cN0 n/((k+1) s) (r0/c0)^k r0 */
    dd force = dd_div(dd_mul_d(f->wide.cN0, 2 * g->n), dd_mul(k1, s));
    force = dd_log_scaled(force, f->wide.scale);
    if (k != 0)
        force = dd_add(force, dd_mul_d(dd_sub(r0, dd_log(dd_of((double)f->c0))), k));
    n->wide.ln_force = dd_add(dd_add(force, r0), n->wide.ln_depth);
}

fret_status fret_normal_make(const fret_material *material, const fret_gap *gap, fret_normal *out) {
    fret_normal n = {.gap = *gap};
    fret_status st = fret_foundation_make(material, &n.foundation);
    if (!st.code)
        st = fret_gap_check(gap);
    if (st.code)
        return st;
    n.end = INFINITY;
    if (gap->kind == FRET_GAP_POWER) {
        make_power(&n);
    } else {
        fret_gap_rule(gap, material->k, &n.rule);
        st = find_end(&n);
    }
    if (!st.code)
        *out = n;
    return st;
}

fret_real fret_normal_stiffness(const fret_normal *n, fret_real a) {
    const fret_foundation *f = &n->foundation;
    return a > 0 ? 2 * f->cN0 * a * fret_pow(a / f->c0, f->k) / (1 + f->k)
                 : 0; /* k < 0: not 0 times infinity */
}

/* F_N of a contact of radius a whose profile is known. */
static fret_real force_of(const fret_normal *n, const fret_profile *p) {
    return 2 * n->foundation.cN0 * fret_pow(n->foundation.c0, -n->foundation.k) * p->I;
}

/* Newton in ln e, where depth and force are nearly powers, kept in a bracket. Returns e; infinity where the
 * gap ends before the target is reached. */
static fret_real solve_radius(const fret_normal *n, bool by_force, fret_real target) {
    fret_real start = fret_gap_start(&n->gap), end = n->end;
    if (target <= 0)
        return 0;
    if (isfinite(end)) {
        fret_profile p = profile(n, end - start);
        if ((by_force ? force_of(n, &p) : p.g) < target)
            return INFINITY;
    }
    fret_real lo = 0, hi = isfinite(end) ? end - start : (fret_real)INFINITY,
              e = isfinite(end) ? end / 16
                  : start > 0   ? start / 16
                                : 1e-4L;
    for (int i = 0; i < 400; i++) {
        fret_profile p = profile(n, e);
        fret_real value = by_force ? force_of(n, &p) : p.g;
        if (value < target)
            lo = e;
        else
            hi = e;
        fret_real slope = e * p.slope * (by_force ? fret_normal_stiffness(n, start + e) : 1) / value;
        fret_real next = e * fret_exp(fret_log(target / value) / slope);
        if (fabsl(next - e) <= 1e-11L * e) /* quadratic: the next step would be 1e-22 */
            return next;
        if (!(next > lo && next < hi)) {
            if (!isfinite(hi))
                next = 4 * e;
            else
                next = lo > 0 ? sqrtl(lo) * sqrtl(hi) : hi / 16;
        }
        if (isfinite(hi) && hi - lo <= 2 * LDBL_EPSILON * hi)
            return next;
        e = next;
    }
    return e;
}

/* The power law in logarithms. */
static dd force_of_depth(const fret_normal *n, dd y) {
    return dd_add(n->wide.ln_force, dd_mul(n->wide.p, dd_sub(y, n->wide.ln_depth)));
}
static dd depth_of_force(const fret_normal *n, dd F) {
    return dd_add(n->wide.ln_depth, dd_mul(n->wide.q, dd_sub(F, n->wide.ln_force)));
}
static dd radius_of_depth(const fret_normal *n, dd y) {
    return dd_add(n->wide.ln_r0, dd_div(dd_sub(y, n->wide.ln_depth), dd_of(n->gap.power[0].n)));
}

fret_real fret_law_radius(const fret_normal *n, fret_real y) {
    if (n->p > 0)
        return y > 0 ? dd_exp_real(radius_of_depth(n, dd_log_real(y))) : 0;
    return fret_gap_start(&n->gap) + solve_radius(n, false, y);
}

fret_real fret_law_force(const fret_normal *n, fret_real y) {
    if (y <= 0)
        return 0;
    if (n->p > 0)
        return dd_exp_real(force_of_depth(n, dd_log_real(y)));
    fret_profile p = profile(n, solve_radius(n, false, y));
    return force_of(n, &p);
}

fret_real fret_law_depth(const fret_normal *n, fret_real F) {
    if (F <= 0)
        return 0;
    if (n->p > 0)
        return dd_exp_real(depth_of_force(n, dd_log_real(F)));
    return profile(n, solve_radius(n, true, F)).g;
}

static fret_point point_at(const fret_normal *n, bool by_force, fret_real value) {
    fret_point p = {0, 0, fret_gap_start(&n->gap), 0};
    if (value <= 0)
        return p;
    if (n->p > 0) {
        p.y = by_force ? fret_law_depth(n, value) : value;
        p.F = by_force ? value : fret_law_force(n, value);
        p.K = n->p * p.F / p.y;
        p.a = fret_law_radius(n, p.y);
        return p;
    }
    fret_real e = solve_radius(n, by_force, value);
    fret_profile profile_there = profile(n, e);
    p.y = by_force ? profile_there.g : value;
    p.F = by_force ? value : force_of(n, &profile_there);
    p.a += e;
    p.K = fret_normal_stiffness(n, p.a);
    return p;
}

fret_point fret_law_at_depth(const fret_normal *n, fret_real y) {
    return point_at(n, false, y);
}

fret_point fret_law_at_force(const fret_normal *n, fret_real F) {
    return point_at(n, true, F);
}

/* Slices of shapes without a closed form, over the annulus between two distances from the start:
 * dK = 2 cN0 (x/c0)^k dx. */

/* Thin slices inwards from `outer`, with `target` the thickness or the load: as integrals of the slope of the
 * profile, where differences of depths would lose digits. Not where a kink of the profile is near. */
static bool thin_slice(const fret_normal *n, fret_real outer, bool by_load, fret_real target, fret_real *h,
                       fret_slice *out) {
    fret_real start = fret_gap_start(&n->gap), reach = outer - fret_gap_kink(&n->gap, outer);
    if (n->gap.kind == FRET_GAP_EXACT_SPHERE)
        reach = fminl(reach, n->gap.R - outer);
    fret_real width = 0, step, K[8], dy[8], dw[8], depth, load;
    for (int i = 0; i < 8; i++) {
        fret_real inner = outer - width, rate = profile(n, inner).slope, missing = target;
        if (by_load)
            rate *= fret_normal_stiffness(n, start + inner);
        depth = load = 0;
        for (int j = 0; j < 8 && width > 0; j++) {
            fret_real e = outer - width * fret_gauss_node[j];
            K[j] = fret_normal_stiffness(n, start + e);
            dy[j] = width * profile(n, e).slope;
            dw[j] = K[j] * dy[j];
            depth += fret_gauss_weight[j] * dy[j];
            load += fret_gauss_weight[j] * dw[j];
        }
        missing -= by_load ? load : depth;
        if (fabsl(missing) <= 16 * LDBL_EPSILON * target)
            break;
        step = missing / rate;
        width += step;
        if (!(width > 0 && width < 0.03L * reach))
            return false;
    }
    fret_real t[8], sums[3] = {0, 0, 0};
    fret_gauss_running(dy, t);
    for (int j = 0; j < 8; j++) {
        fret_real x = start + (outer - width * fret_gauss_node[j]);
        fret_real dK = (1 + n->foundation.k) * K[j] / x * width;
        sums[0] += fret_gauss_weight[j] * t[j] * dw[j];
        sums[1] += fret_gauss_weight[j] * t[j] * dK;
        sums[2] += fret_gauss_weight[j] * t[j] * (depth - t[j]) * dK;
    }
    *h = depth;
    *out = (fret_slice){load, sums[0], sums[1], sums[2]};
    return true;
}

/* The others: t = y-g(x); G = int t dK, L = int t (h-t) dK, int t^2 dK. */
typedef struct annulus {
    const fret_normal *normal;
    fret_real start, y, h, G, L, t2;
} annulus;

static void annulus_add(annulus *s, fret_real e, fret_real dK) {
    fret_real t = s->y - (e > 0 ? profile(s->normal, e).g : 0);
    s->G += t * dK;
    s->L += t * (s->h - t) * dK;
    s->t2 += t * t * dK;
}

/* Gauss's rule between distances lo and hi of the kink: linear in the fourth root of the distance, which
 * makes the kink, a power (k+3)/2 of it, smooth enough; linear in the distance where the kink is far. */
static void annulus_gauss(annulus *s, fret_real kink, fret_real lo, fret_real hi) {
    const fret_foundation *f = &s->normal->foundation;
    bool far = lo > 0.8L * hi;
    const fret_real wide = hi / (s->start + kink + hi);
    int parts = lo > 0.97L * hi || wide < 0.002L ? 1 : wide < 0.02L ? 2 : wide < 0.2L ? 4 : 8;
    fret_real from = far ? lo : sqrtl(sqrtl(lo)), span = (far ? hi : sqrtl(sqrtl(hi))) - from;
    for (int j = 0; j < 8 * parts; j++) {
        fret_real v = from + span * (j / 8 + fret_gauss_node[j % 8]) / parts,
                  e = kink + (far ? v : v * v * v * v);
        fret_real dx = fret_gauss_weight[j % 8] * span / parts * (far ? 1 : 4 * v * v * v);
        annulus_add(s, e, 2 * f->cN0 * fret_pow((s->start + e) / f->c0, f->k) * dx);
    }
}

/* From a flat end, where the profile is a power of e: by Gauss's rule, linear in ln e, down to where no
 * contribution is left. */
static void annulus_flat(annulus *s, fret_real lo, fret_real hi) {
    const fret_foundation *f = &s->normal->foundation;
    fret_real span = lo > 0 ? fminl(fret_log(hi / lo), 42) : 42;
    int parts = (int)(2 * span) + 1;
    for (int j = 0; j < 8 * parts; j++) {
        fret_real e = hi * fret_exp(-span / parts * (j / 8 + fret_gauss_node[j % 8]));
        fret_real dx = fret_gauss_weight[j % 8] * span / parts * e;
        annulus_add(s, e, 2 * f->cN0 * fret_pow((s->start + e) / f->c0, f->k) * dx);
    }
}

/* From the centre: linear in K, since x^k may be singular there. */
static void annulus_centre(annulus *s, fret_real lo, fret_real hi) {
    fret_real k1 = 1 + s->normal->foundation.k, span = lo > 0 ? -fret_expm1(k1 * fret_log(lo / hi)) : 1;
    fret_real K = fret_normal_stiffness(s->normal, hi) * span;
    for (int i = 0; i < FRET_EXPONENTIAL; i++) {
        fret_node node = fret_exponential_node(i);
        annulus_add(s, hi * fret_exp(fret_log1p(-span * node.rest) / k1), K * node.weight);
    }
}

fret_slice fret_law_slice(const fret_normal *n, const fret_level *outer, fret_real h) {
    fret_real y = outer->y, start = fret_gap_start(&n->gap);
    fret_slice out = {0, 0, 0, 0};
    if (h <= 0)
        return out;
    if (n->p > 0) {
        fret_moments m = fret_power_moments(n->pm1, h / y);
        fret_real F = outer->F, Fy = F * y;
        return (fret_slice){F * m.w, Fy * m.J, F * m.m1, Fy * m.L};
    }
    fret_real hi = solve_radius(n, false, y), lo = 0;
    if (thin_slice(n, hi, false, h, &h, &out))
        return out;
    out.w = outer->F;
    if (h < y) {
        lo = solve_radius(n, false, y - h);
        fret_profile inner = profile(n, lo);
        out.w -= force_of(n, &inner);
    }
    annulus s = {.normal = n, .start = start, .y = y, .h = h};
    while (hi > lo) {
        fret_real kink = fret_gap_kink(&n->gap, hi), next = fret_gap_kink(&n->gap, kink);
        while (kink > 0 && hi - next < 1e-3L * (start + hi)) { /* rows as close leave no trace one by one */
            kink = next;
            next = fret_gap_kink(&n->gap, kink);
        }
        fret_real end = fmaxl(kink, lo);
        if (kink > 0 || end > 0.8L * hi)
            annulus_gauss(&s, kink, end - kink, hi - kink);
        else if (start > 0)
            annulus_flat(&s, end, hi);
        else
            annulus_centre(&s, end, hi);
        hi = end;
    }
    fret_real K = fret_normal_stiffness(n, start + lo);
    out.J = (h * h * K + s.t2) / 2;
    out.G = s.G;
    out.L = s.L;
    return out;
}

fret_real fret_law_load(const fret_normal *n, const fret_level *outer, fret_real h) {
    fret_real y = outer->y;
    fret_slice thin;
    if (h >= y)
        return outer->F;
    if (n->p > 0)
        return -outer->F * fret_expm1(n->p * fret_log1p(-h / y));
    if (h <= 0)
        return 0;
    if (thin_slice(n, solve_radius(n, false, y), false, h, &h, &thin))
        return thin.w;
    return outer->F - fret_law_force(n, y - h);
}

fret_real fret_law_thickness(const fret_normal *n, const fret_level *outer, fret_real w) {
    fret_real y = outer->y, F = outer->F, h = 0;
    fret_slice thin;
    if (w >= F)
        return y;
    if (n->p > 0)
        return -y * fret_expm1(n->q * fret_log1p(-w / F));
    if (w <= 0 || thin_slice(n, solve_radius(n, true, F), true, w, &h, &thin))
        return h;
    return y - fret_law_depth(n, F - w);
}

static fret_status finish(const fret_press *p, fret_press *out) {
    if (!(p->F <= DBL_MAX && p->dz <= DBL_MAX && p->a <= DBL_MAX))
        return fret_fail(FRET_OVERFLOW, NULL, (double)p->F, DBL_MAX);
    if (!(p->F >= DBL_MIN && p->dz >= DBL_MIN && p->a >= DBL_MIN) && (p->F != 0 || p->dz != 0))
        return fret_fail(FRET_OVERFLOW, NULL, (double)p->F, DBL_MIN);
    *out = *p;
    return fret_ok();
}

fret_real fret_law_load_outside(const fret_normal *n, const fret_level *outer, fret_real inner_depth) {
    if (n->p > 0 && inner_depth > 0)
        return -outer->F * fret_expm1(n->p * fret_log(inner_depth / outer->y));
    return outer->F - fret_law_force(n, inner_depth);
}

fret_real fret_law_thickness_outside(const fret_normal *n, const fret_level *outer, fret_real inner_load) {
    if (n->p > 0 && inner_load > 0)
        return -outer->y * fret_expm1(n->q * fret_log(inner_load / outer->F));
    return outer->y - fret_law_depth(n, inner_load);
}

fret_real fret_law_level_radius(const fret_normal *n, const fret_level *level) {
    if (!(n->p > 0))
        return fret_law_radius(n, level->y);
    if (level->F <= 0)
        return 0;
    dd l = dd_sub(dd_log_real(level->F), n->wide.ln_force);
    return dd_exp_real(dd_add(n->wide.ln_r0, dd_div(l, n->wide.s)));
}

/* Completes a state at distance e from the start of the gap. */
static fret_status at_radius(const fret_normal *n, const char *name, double value, fret_real e, fret_press *s,
                             fret_press *out) {
    if (!isfinite(e))
        return fret_fail(n->falls ? FRET_NOT_MONOTONE : FRET_TABLE_SHORT, n->falls ? "r" : name,
                         n->falls ? (double)n->end : value, (double)n->end);
    fret_profile p = {0, 0, 0};
    if (e > 0)
        p = profile(n, e);
    s->a = fret_gap_start(&n->gap) + e;
    if (s->F < 0)
        s->F = force_of(n, &p);
    if (s->dz < 0)
        s->dz = p.g;
    return finish(s, out);
}

fret_status fret_press_force(const fret_normal *n, double F, fret_press *out) {
    fret_status st = fret_check_not_negative("FN", F);
    if (st.code)
        return st;
    fret_press s = {.F = F, .dz = -1};
    if (F > 0 && n->p > 0) {
        dd l = dd_sub(dd_log(dd_of(F)), n->wide.ln_force);
        dd dz = dd_exp(dd_add(n->wide.ln_depth, dd_mul(n->wide.q, l)));
        s.a = dd_exp_real(dd_add(n->wide.ln_r0, dd_div(l, n->wide.s)));
        s.dz = dd_value(dz);
        s.dz_rest = dd_rest(dz);
        return finish(&s, out);
    }
    return at_radius(n, "FN", F, solve_radius(n, true, F), &s, out);
}

fret_status fret_press_depth(const fret_normal *n, double dz, fret_press *out) {
    fret_status st = fret_check_not_negative("dz", dz);
    if (st.code)
        return st;
    fret_press s = {.F = -1, .dz = dz};
    if (dz > 0 && n->p > 0) {
        dd l = dd_sub(dd_log(dd_of(dz)), n->wide.ln_depth);
        dd F = dd_exp(dd_add(n->wide.ln_force, dd_mul(n->wide.p, l)));
        s.a = dd_exp_real(dd_add(n->wide.ln_r0, dd_div(l, dd_of(n->gap.power[0].n))));
        s.F = dd_value(F);
        s.F_rest = dd_rest(F);
        return finish(&s, out);
    }
    return at_radius(n, "dz", dz, solve_radius(n, false, dz), &s, out);
}

fret_status fret_press_radius(const fret_normal *n, double a, fret_press *out) {
    fret_status st = fret_check_not_negative("a", a);
    if (st.code)
        return st;
    fret_press s = {.F = -1, .dz = -1, .a = a};
    if (a > 0 && n->p > 0) {
        dd l = dd_sub(dd_log(dd_of(a)), n->wide.ln_r0);
        dd F = dd_exp(dd_add(n->wide.ln_force, dd_mul(n->wide.s, l)));
        dd dz = dd_exp(dd_add(n->wide.ln_depth, dd_mul_d(l, n->gap.power[0].n)));
        s = (fret_press){dd_value(F), dd_value(dz), a, dd_rest(F), dd_rest(dz)};
        return finish(&s, out);
    }
    if (a < fret_gap_start(&n->gap))
        return fret_fail(FRET_OUTSIDE, "a", a, (double)fret_gap_start(&n->gap));
    return at_radius(n, "a", a, a > n->end ? (fret_real)INFINITY : a - fret_gap_start(&n->gap), &s, out);
}
