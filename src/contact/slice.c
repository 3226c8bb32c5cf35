/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Integrals over slices of depths, exact also for thin ones: closed for the power law, by quadrature for
 * other shapes. */
#include "contact/pieces.h"

#include <float.h>

#include "contact/piece.h"
#include "contact/rows.h"
#include "number/quadrature.h"
#include "number/real.h"

/* Radii are handled as their distance e from the start of the gap. */
static fret_profile profile(const fret_normal *n, fret_real e) {
    return fret_gap_profile(&n->gap, &n->rule, e);
}

/* Moments of the power law F = y^p at y = 1, pm1 = p-1, over distances 0..x from the edge:
 *   w = int K dt, J = int t K dt, m1 = int t dK, L = int m1 dt;  K = p y^(p-1). */
typedef struct moments {
    fret_real w, J, m1, L;
} moments;
/* The closed forms lose digits like (p x)^-3, within the guard digits down to p x = 0.2; beyond, the
 * series of (1-t)^(p-2) under the integral has terms a falling at least as fast as p x. Integrated twice it
 * is the one of (1-t)^p, of terms -a/((i+1)(i+2)). */
static moments moments_series(fret_real pm1, fret_real x) {
    enum { LEADING = 6, MOST = 60 }; /* all terms after the leading ones are below 2^-13: double will do */
    static const fret_real inv[LEADING + 2] = {1.0L / 1, 1.0L / 2, 1.0L / 3, 1.0L / 4,
                                               1.0L / 5, 1.0L / 6, 1.0L / 7, 1.0L / 8};
    fret_real p = 1 + pm1, a = p * pm1 * x * x, slope = pm1 * x, w = 0, J = 0, m1 = 0, L = 0;
    const double ratio = (double)x, fall = (double)slope, small = 1e-20 * (double)a;
    for (int i = 0; i < LEADING; i++) {
        fret_real c = a * inv[i + 1];
        w += c * inv[i];
        J += a * inv[i] * inv[i + 2];
        m1 += c;
        L += c * inv[i + 2];
        a *= x - slope * inv[i];
    }
    double term = (double)a, wt = 0, Jt = 0, m1t = 0, Lt = 0;
    double first = 1.0 / (LEADING + 1), second = 1.0 / (LEADING + 2);
    for (int i = LEADING; i < MOST && fabs(term) > small; i++) {
        const double c = term * second, third = 1.0 / (i + 3);
        wt += c * first;
        Jt += term * first * third;
        m1t += c;
        Lt += c * third;
        term *= ratio - fall * first;
        first = second;
        second = third;
    }
    return (moments){p * x - (w + wt), (p * x / 2 - (J + Jt)) * x, m1 + m1t, (L + Lt) * x};
}

static moments power_moments(fret_real pm1, fret_real x) {
    fret_real p = 1 + pm1;
    if (x >= 1)
        return (moments){1, 1 / (p + 1), 1, pm1 / (p + 1)};
    if (p * x < 0.2L)
        return moments_series(pm1, x);
    /* arranged so that m1 = int t dK and m2 = int t^2 dK keep their factor p-1 */
    fret_real em = expm1l(pm1 * log1pl(-x)), y = 1 + em; /* y = (1-x)^(p-1) */
    fret_real m1 = -em * (1 + pm1 * x) - pm1 * x;
    fret_real m2 = (-2 * em - y * pm1 * x * (2 + p * x)) / (2 + pm1);
    return (moments){x * y - em, (m2 + p * x * x * y) / 2, m1, x * m1 - m2};
}

/* Slices of shapes without a closed form, as integrals between two distances from the start:
 * dK = 2 cN0 (x/c0)^k dx. */

/* Thin slices inwards from `outer`, with `target` the thickness or the load: as integrals of the slope of the
 * profile, where differences of depths would lose digits. Not where a kink of the profile is near. */
static bool thin_slice(const fret_normal *n, fret_real outer, bool by_load, fret_real target, fret_real *h,
                       fret_slice *out) {
    fret_real start = fret_gap_start(&n->gap), reach = fret_gap_reach(&n->gap, outer);
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

/* The others: t = y-g(x). */
typedef struct cut {
    const fret_normal *normal;
    fret_real start, y;
    stretch sum; /* of the thickness h */
} cut;

static void cut_add(cut *s, fret_real e, fret_real dK) {
    fret_real t = s->y - (e > 0 ? profile(s->normal, e).g : 0);
    s->sum.K += dK;
    s->sum.G += t * dK;
    s->sum.L += t * (s->sum.h - t) * dK;
}

/* Gauss's rule between distances lo and hi of the kink: linear in the fourth root of the distance, which
 * makes the kink, a power (k+3)/2 of it, smooth enough; linear in the distance where the kink is far. */
static void cut_by_roots(cut *s, fret_real kink, fret_real lo, fret_real hi) {
    const fret_foundation *f = &s->normal->foundation;
    bool far = lo > 0.8L * hi;
    const fret_real wide = hi / (s->start + kink + hi);
    int parts = lo > 0.97L * hi || wide < 0.002L ? 1 : wide < 0.02L ? 2 : wide < 0.2L ? 4 : 8;
    fret_real from = far ? lo : sqrtl(sqrtl(lo)), span = (far ? hi : sqrtl(sqrtl(hi))) - from;
    for (int j = 0; j < 8 * parts; j++) {
        fret_real v = from + span * (j / 8 + fret_gauss_node[j % 8]) / parts,
                  e = kink + (far ? v : v * v * v * v);
        fret_real dx = fret_gauss_weight[j % 8] * span / parts * (far ? 1 : 4 * v * v * v);
        cut_add(s, e, 2 * f->cN0 * fret_pow((s->start + e) / f->c0, f->k) * dx);
    }
}

/* From a flat end, where the profile is a power of e: by Gauss's rule, linear in ln e, down to where no
 * contribution is left. */
static void cut_at_flat(cut *s, fret_real lo, fret_real hi) {
    const fret_foundation *f = &s->normal->foundation;
    fret_real span = lo > 0 ? fminl(logl(hi / lo), 42) : 42;
    int parts = (int)(2 * span) + 1;
    for (int j = 0; j < 8 * parts; j++) {
        fret_real e = hi * expl(-span / parts * (j / 8 + fret_gauss_node[j % 8]));
        fret_real dx = fret_gauss_weight[j % 8] * span / parts * e;
        cut_add(s, e, 2 * f->cN0 * fret_pow((s->start + e) / f->c0, f->k) * dx);
    }
}

/* From the centre: linear in K, since x^k may be singular there. */
static void cut_at_centre(cut *s, fret_real lo, fret_real hi) {
    fret_real k1 = 1 + s->normal->foundation.k, span = lo > 0 ? -expm1l(k1 * logl(lo / hi)) : 1;
    fret_real K = fret_normal_stiffness(s->normal, hi) * span;
    for (int i = 0; i < FRET_EXPONENTIAL; i++) {
        fret_node node = fret_exponential_node(i);
        cut_add(s, hi * expl(log1pl(-span * node.rest) / k1), K * node.weight);
    }
}

/* The rows of a table between two distances, for one slice from depth or load `outer` of a thickness `target`
 * of the same; false: it does not begin among rows beyond the first. The caller frees them. */
typedef struct among {
    struct fret_rows *rows;
    fret_spot outer, inner;
    bool ends; /* there too: else `inner` is where they begin */
} among;

static bool find_rows(const fret_normal *n, bool by_load, fret_real outer, fret_real target, fret_real lo,
                      fret_real hi, among *out) {
    const fret_spot_by how = by_load ? SPOT_LOAD : SPOT_DEPTH;
    if (!fret_gap_sampled(&n->gap) || fret_rows_make(n, lo, hi, &out->rows, NULL).code || !out->rows)
        return false;
    if (!fret_rows_find(out->rows, how, outer, &out->outer)) {
        fret_rows_free(out->rows);
        return false;
    }
    out->ends = fret_rows_drop(out->rows, how, &out->outer, target, &out->inner);
    if (!out->ends)
        out->inner = fret_rows_inner();
    return true;
}

/* Of a slice of a table what lies among its rows, in their own law: its sums, and where it ends. */
static fret_real cut_rows(const fret_normal *n, fret_real y, fret_real h, fret_real lo, fret_real hi,
                          stretch *sum) {
    among a;
    if (!find_rows(n, false, y, h, lo, hi, &a))
        return hi;
    *sum = fret_rows_between(a.rows, &a.outer, &a.inner);
    const fret_real end = a.ends ? lo : fret_rows_distance(a.rows, &a.inner);
    fret_rows_free(a.rows);
    return end;
}

/* The slice that goes from one distance to another, by quadrature from kink to kink. */
static stretch cut_at_kinks(const fret_normal *n, fret_real y, fret_real h, fret_real lo, fret_real hi) {
    const fret_real least = 1e-4L * (hi - lo);
    cut s = {.normal = n, .start = fret_gap_start(&n->gap), .y = y, .sum.h = h};
    while (hi > lo && !fret_stopped(n)) {
        fret_real kink = fret_gap_kink(&n->gap, hi), next = fret_gap_kink(&n->gap, kink);
        while (kink > 0 && hi - next < least) { /* rows as close leave no trace one by one */
            kink = next;
            next = fret_gap_kink(&n->gap, kink);
        }
        fret_real end = fmaxl(kink, lo);
        if (kink > 0 || end > 0.8L * hi)
            cut_by_roots(&s, kink, end - kink, hi - kink);
        else if (s.start > 0)
            cut_at_flat(&s, end, hi);
        else
            cut_at_centre(&s, end, hi);
        hi = end;
    }
    return s.sum;
}

fret_slice fret_law_slice(const fret_normal *n, const fret_level *outer, fret_real h) {
    fret_real y = outer->y, start = fret_gap_start(&n->gap);
    fret_slice out = {0, 0, 0, 0};
    if (h <= 0)
        return out;
    if (fret_normal_closed(n)) {
        const moments m = power_moments(n->pm1, h / y);
        fret_real F = outer->F, Fy = F * y;
        return (fret_slice){F * m.w, Fy * m.J, F * m.m1, Fy * m.L};
    }
    if (n->pieces && fret_pieces_slice(n->pieces, outer, false, n->thin, h, y - h, &h, &out))
        return out;
    fret_real hi = fret_search_radius(n, false, y), lo = 0;
    if (hi <= 0) {
        const fret_real K = fret_normal_stiffness(n, start);
        return (fret_slice){K * h, K * h * h / 2, 0, 0};
    }
    if (thin_slice(n, hi, false, h, &h, &out))
        return out;
    stretch sum = {0, 0, 0, 0};
    out.w = outer->F;
    if (h < y) {
        lo = fret_search_radius(n, false, y - h);
        out.w -= fret_law_other(n, false, y - h, lo);
    }
    hi = cut_rows(n, y, h, lo, hi, &sum);
    if (hi > lo) {
        const stretch rest = cut_at_kinks(n, y - sum.h, h - sum.h, lo, hi);
        sum = fret_stretch_join(&sum, &rest);
    }
    const fret_real K = fret_normal_stiffness(n, start + lo);
    out.J = (h * h * K + (h * sum.G - sum.L)) / 2;
    out.G = sum.G;
    out.L = sum.L;
    return out;
}

fret_slice fret_law_slice_to(const fret_normal *n, const fret_level *outer, bool by_load, fret_real target,
                             fret_real left) {
    fret_slice out;
    fret_real h;
    if (n->pieces && fret_pieces_slice(n->pieces, outer, by_load, n->thin, target, left, &h, &out))
        return out;
    return fret_law_slice(n, outer, by_load ? fret_law_thickness(n, outer, target) : target);
}

/* Of a slice its load from its thickness, or its thickness from its load, where levels would differ by too
 * few digits. */
static bool thin_across(const fret_normal *n, const fret_level *outer, bool by_load, fret_real target,
                        fret_real *other) {
    const fret_real whole = by_load ? outer->F : outer->y, hi = fret_search_radius(n, by_load, whole);
    fret_slice thin;
    fret_real h;
    among a;
    if (hi <= 0) {
        *other = fret_law_other(n, by_load, target, 0);
        return true;
    }
    if (thin_slice(n, hi, by_load, target, &h, &thin)) {
        *other = by_load ? h : thin.w;
        return true;
    }
    if (target > 0.01L * whole ||
        !find_rows(n, by_load, whole, target, fret_search_radius(n, by_load, whole - target), hi, &a))
        return false;
    *other = fret_rows_fall(a.rows, by_load ? DEPTHS : LOADS, &a.outer, &a.inner);
    fret_rows_free(a.rows);
    return a.ends;
}

fret_real fret_law_load(const fret_normal *n, const fret_level *outer, fret_real h) {
    fret_real y = outer->y, w;
    if (h >= y)
        return outer->F;
    if (fret_normal_closed(n))
        return -outer->F * expm1l(n->p * log1pl(-h / y));
    if (h <= 0)
        return 0;
    if ((n->pieces && fret_pieces_across(n->pieces, outer, false, n->thin, h, &w)) ||
        thin_across(n, outer, false, h, &w))
        return w;
    return outer->F - fret_law_force(n, y - h);
}

fret_real fret_law_thickness(const fret_normal *n, const fret_level *outer, fret_real w) {
    fret_real y = outer->y, F = outer->F, h;
    if (w >= F)
        return y;
    if (fret_normal_closed(n))
        return -y * expm1l(n->q * log1pl(-w / F));
    if (w <= 0)
        return 0;
    if ((n->pieces && fret_pieces_across(n->pieces, outer, true, n->thin, w, &h)) ||
        thin_across(n, outer, true, w, &h))
        return h;
    return y - fret_law_depth(n, F - w);
}

fret_real fret_law_stiffness_drop(const fret_normal *n, const fret_level *outer, fret_real h) {
    const fret_real y = outer->y, K = fret_normal_stiffness(n, fret_law_level_radius(n, outer));
    if (h >= y)
        return K - fret_normal_stiffness(n, fret_gap_start(&n->gap));
    if (fret_normal_closed(n))
        return -K * expm1l(n->pm1 * log1pl(-h / y));
    return K - fret_normal_stiffness(n, fret_law_radius(n, y - h));
}
