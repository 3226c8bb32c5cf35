/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "gap.h"

#include "table.h"

dd_scaled fret_kappa_parts(double n, double k) {
    dd k1 = dd_sum(1, k), d = {k1.hi / 2, k1.lo / 2}, top = dd_add_d(dd_of(n / 2), 1);
    const dd over[] = {dd_add_d(d, 1), top}, under[] = {dd_add(top, d)};
    dd_scaled q = dd_gamma_quotient(over, 2, under, 1);
    q.factor = dd_mul(q.factor, dd_div(dd_add_d(k1, n), k1));
    return q;
}

fret_real fret_kappa(double n, double k) {
    dd_scaled q = fret_kappa_parts(n, k);
    return dd_value(dd_mul(q.factor, dd_exp(q.log)));
}

/* ---- the kernel near its singularity ----------------------------------------------------------- */

/* The last moment by its series, the others downwards: every term is positive. */
fret_edge fret_edge_moments(const fret_rule *rule, fret_real v) {
    if (v <= 0)
        return (fret_edge){{0}, 0};
    fret_real m = (rule->k + 1) / 2, power = fret_pow(v, m), sum = 0, vn = 1, v3 = v * v * v;
    fret_edge out = {.rim = power * fret_pow(2 - v, m)};
    for (int n = 0; n < FRET_SERIES; n++) {
        fret_real term = rule->series[n] * vn;
        sum += term;
        if (term < 1e-21L * sum)
            break;
        vn *= v;
    }
    out.moment[FRET_EDGE - 1] = power * v3 * v * sum;
    fret_real boundary = out.rim * v3; /* v^(j-1) rim */
    for (int j = FRET_EDGE - 1; j > 0; j--) {
        out.moment[j - 1] = (boundary + (2 * m + (j - 1)) * out.moment[j]) / (2 * (m + (j - 1)));
        boundary /= v;
    }
    return out;
}

static void make_series(fret_rule *rule) {
    fret_real beta = (1 - rule->k) / 2, m = (rule->k + 1) / 2, c = fret_pow(2, -beta);
    for (int n = 0; n < FRET_SERIES; n++) {
        rule->series[n] = c / (m + (FRET_EDGE - 1) + n);
        c *= (beta + n) / (2 * (fret_real)(n + 1));
    }
}

/* ---- shapes ------------------------------------------------------------------------------------ */

/* One row a shape: the gap and the profile for r > b, and which parameters it reads. In units of the contact
 * radius, with s = r/a, flat = b/a, K = (1-s^2)^((k-1)/2):
 *   g = a int f' K ds, I = a^(k+2)/(k+1) int s^2 f' K ds. */
typedef struct shape {
    fret_real (*f)(const fret_gap *, fret_real r);
    fret_profile (*profile)(const fret_gap *, const fret_rule *, fret_real a, fret_real e);
    bool b, R, slope;
} shape;

fret_profile fret_profile_of(fret_real k, fret_real a, fret_real g, fret_real slope, fret_real I) {
    return (fret_profile){a * g, slope, fret_pow(a, k + 2) / (k + 1) * I};
}

static fret_real cone_f(const fret_gap *gap, fret_real r) {
    return gap->slope * (r - gap->b);
}
static fret_profile cone_profile(const fret_gap *gap, const fret_rule *rule, fret_real a, fret_real e) {
    fret_real k = rule->k, v = e / a, flat = gap->b / a;
    fret_edge m = fret_edge_moments(rule, v);
    fret_real g = gap->slope * m.moment[0], rim = gap->slope * flat * m.rim;
    return fret_profile_of(k, a, g, g + rim / (v * (2 - v)), (g + rim) / (k + 2));
}

static fret_real paraboloid_f(const fret_gap *gap, fret_real r) {
    return (r - gap->b) * (r + gap->b) / (2 * (fret_real)gap->R);
}
static fret_profile paraboloid_profile(const fret_gap *gap, const fret_rule *rule, fret_real a, fret_real e) {
    fret_real k = rule->k, m = (k + 1) / 2, v = e / a, flat = gap->b / a, z = v * (2 - v);
    fret_real rim = a / gap->R * fret_pow(z, m), g = rim / (2 * m);
    return fret_profile_of(k, a, g, 2 * g + rim * flat * flat / z,
                           rim * (1 + m * (1 - z)) / (2 * m * (m + 1)));
}

static fret_real rounded_f(const fret_gap *gap, fret_real r) {
    return (r - gap->b) * (r - gap->b) / (2 * (fret_real)gap->R);
}
static fret_profile rounded_profile(const fret_gap *gap, const fret_rule *rule, fret_real a, fret_real e) {
    fret_real k = rule->k, v = e / a, flat = gap->b / a, z = v * (2 - v), steep = a / gap->R;
    fret_edge m = fret_edge_moments(rule, v);
    fret_real g = steep * (v * m.moment[0] - m.moment[1]);
    return fret_profile_of(k, a, g, 2 * g + steep * flat * m.moment[0],
                           (g + steep * m.rim * z / (k + 3)) / (k + 2));
}

static fret_real sphere_f(const fret_gap *gap, fret_real r) {
    fret_real R = gap->R;
    return r * r / (R + sqrtl((R - r) * (R + r)));
}
/* Term by term: f has the powers r^2, r^4, ... with positive factors. */
static fret_profile sphere_profile(const fret_gap *gap, const fret_rule *rule, fret_real a, fret_real e) {
    (void)e;
    fret_real k = rule->k, m1 = (k + 3) / 2, q = a / gap->R * (a / gap->R), term = a / (gap->R * (k + 1));
    fret_real g = 0, slope = 0, I = 0;
    for (int n = 0; n < 1000; n++) {
        fret_real rise = (2 * n + 2) * term;
        g += term;
        slope += rise;
        I += rise / (2 * n + 3 + k);
        if (rise < 1e-21L * slope)
            break;
        term *= q * (n + 0.5L) / (m1 + n);
    }
    return fret_profile_of(k, a, g, slope, I);
}

static const shape shapes[] = {
    [FRET_GAP_FLAT_CONE] = {cone_f, cone_profile, .b = true, .slope = true},
    [FRET_GAP_FLAT_PARABOLOID] = {paraboloid_f, paraboloid_profile, .b = true, .R = true},
    [FRET_GAP_FLAT_ROUNDED] = {rounded_f, rounded_profile, .b = true, .R = true},
    [FRET_GAP_EXACT_SPHERE] = {sphere_f, sphere_profile, .R = true},
};

static bool is_powers(const fret_gap *gap) {
    return gap->kind == FRET_GAP_POWER || gap->kind == FRET_GAP_SUM;
}

fret_status fret_gap_check(const fret_gap *gap) {
    fret_status st = fret_ok();
    if (is_powers(gap)) {
        for (int i = 0; i < gap->terms && !st.code; i++) {
            const fret_power *p = &gap->power[i];
            st = fret_check_positive("n", p->n);
            if (!st.code)
                st = fret_check_positive("r0", p->r0);
            if (!st.code && gap->kind == FRET_GAP_POWER)
                st = fret_check_positive("h", p->h);
            if (!st.code && !isfinite(p->h))
                st = fret_fail(FRET_NOT_FINITE, "A", p->h, 0);
        }
        return st;
    }
    if (gap->kind == FRET_GAP_TABLE)
        return st;
    const shape *s = &shapes[gap->kind];
    if (s->b)
        st = fret_check_positive("b", gap->b);
    if (!st.code && s->R)
        st = fret_check_positive("R", gap->R);
    if (!st.code && s->slope)
        st = fret_check_positive("slope", gap->slope);
    return st;
}

fret_real fret_gap_start(const fret_gap *gap) {
    if (is_powers(gap))
        return 0;
    if (gap->kind == FRET_GAP_TABLE)
        return fret_table_start(gap->table);
    return shapes[gap->kind].b ? gap->b : 0;
}

fret_real fret_gap_tip(const fret_gap *gap) {
    if (gap->kind == FRET_GAP_TABLE)
        return fret_table_pointed(gap->table) ? 1 : 2;
    fret_real least = is_powers(gap) ? (fret_real)INFINITY : 2;
    for (int i = 0; i < gap->terms && is_powers(gap); i++)
        least = gap->power[i].h != 0 ? fminl(least, gap->power[i].n) : least;
    return least;
}

fret_real fret_gap_end(const fret_gap *gap) {
    /* near the equator g grows without bound, and its series no longer converges */
    return gap->kind == FRET_GAP_EXACT_SPHERE ? 0.95L * gap->R
           : gap->kind == FRET_GAP_TABLE      ? fret_table_end(gap->table)
                                              : (fret_real)INFINITY;
}

fret_real fret_gap_kink(const fret_gap *gap, fret_real e) {
    return gap->kind == FRET_GAP_TABLE ? fret_table_kink(gap->table, e) : 0;
}

fret_status fret_gap_f(const fret_gap *gap, fret_real r, fret_real *f) {
    if (r < 0)
        return fret_fail(FRET_NEGATIVE, "r", (double)r, 0);
    if (r > fret_gap_end(gap))
        return fret_fail(FRET_OUTSIDE, "r", (double)r, (double)fret_gap_end(gap));
    *f = 0;
    if (is_powers(gap)) {
        for (int i = 0; i < gap->terms; i++)
            *f += r > 0 ? gap->power[i].h * fret_ratio_pow(r, gap->power[i].r0, gap->power[i].n) : 0;
    } else if (r > fret_gap_start(gap)) {
        *f = gap->kind == FRET_GAP_TABLE ? fret_table_f(gap->table, r) : shapes[gap->kind].f(gap, r);
    }
    return fret_ok();
}

void fret_gap_rule(const fret_gap *gap, double k, fret_rule *rule) {
    rule->k = k;
    for (int i = 0; is_powers(gap) && i < gap->terms; i++)
        rule->kappa[i] = fret_kappa(gap->power[i].n, k);
    if (!is_powers(gap))
        make_series(rule);
}

fret_profile fret_gap_profile(const fret_gap *gap, const fret_rule *rule, fret_real e) {
    if (gap->kind == FRET_GAP_TABLE)
        return fret_table_profile(gap->table, rule, e);
    if (!is_powers(gap))
        return shapes[gap->kind].profile(gap, rule, fret_gap_start(gap) + e, e);
    fret_real k = rule->k, a = e, ak = fret_pow(a, k + 1);
    fret_profile out = {0, 0, 0};
    for (int i = 0; i < gap->terms; i++) {
        const fret_power *p = &gap->power[i];
        fret_real n = p->n, g = rule->kappa[i] * p->h * fret_ratio_pow(a, p->r0, n);
        out.g += g;
        out.slope += n * g / a;
        out.I += n * g * ak / ((k + 1) * (n + (k + 1)));
    }
    return out;
}

fret_status fret_gap_g(const fret_gap *gap, double k, fret_real x, fret_real *g, fret_real *slope) {
    x = fabsl(x);
    if (x > fret_gap_end(gap))
        return fret_fail(FRET_OUTSIDE, "x", (double)x, (double)fret_gap_end(gap));
    fret_profile out = {0, 0, 0};
    if (x > fret_gap_start(gap)) {
        fret_rule rule;
        fret_gap_rule(gap, k, &rule);
        out = fret_gap_profile(gap, &rule, x - fret_gap_start(gap));
    }
    *g = out.g;
    if (slope)
        *slope = out.slope;
    return fret_ok();
}
