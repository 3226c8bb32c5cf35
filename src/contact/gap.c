/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "gap.h"

fret_real fret_kappa(fret_real n, fret_real k) {
    fret_real d = (k + 1) / 2;
    return (n + (k + 1)) / (k + 1) * tgammal(1 + d) / fret_gamma_ratio(1 + n / 2, d);
}

/* One row a shape: the gap, its two derivatives for r > start, and which parameters it reads. */
typedef struct shape {
    fret_real (*f)(const fret_gap *, fret_real r);
    fret_real (*f1)(const fret_gap *, fret_real r);
    fret_real (*f2)(const fret_gap *, fret_real r);
    bool b, R, slope;
} shape;

static fret_real cone_f(const fret_gap *gap, fret_real r) {
    return gap->slope * (r - gap->b);
}
static fret_real cone_f1(const fret_gap *gap, fret_real r) {
    (void)r;
    return gap->slope;
}
static fret_real cone_f2(const fret_gap *gap, fret_real r) {
    (void)gap, (void)r;
    return 0;
}
static fret_real paraboloid_f(const fret_gap *gap, fret_real r) {
    return (r - gap->b) * (r + gap->b) / (2 * (fret_real)gap->R);
}
static fret_real paraboloid_f1(const fret_gap *gap, fret_real r) {
    return r / gap->R;
}
static fret_real curved_f2(const fret_gap *gap, fret_real r) {
    (void)r;
    return 1 / (fret_real)gap->R;
}
static fret_real rounded_f(const fret_gap *gap, fret_real r) {
    return (r - gap->b) * (r - gap->b) / (2 * (fret_real)gap->R);
}
static fret_real rounded_f1(const fret_gap *gap, fret_real r) {
    return (r - gap->b) / gap->R;
}
static fret_real sphere_f(const fret_gap *gap, fret_real r) {
    fret_real R = gap->R;
    return r * r / (R + sqrtl((R - r) * (R + r)));
}
static fret_real sphere_f1(const fret_gap *gap, fret_real r) {
    fret_real R = gap->R;
    return r / sqrtl((R - r) * (R + r));
}
static fret_real sphere_f2(const fret_gap *gap, fret_real r) {
    fret_real R = gap->R, s = (R - r) * (R + r);
    return R * R / (s * sqrtl(s));
}

static const shape shapes[] = {
    [FRET_GAP_FLAT_CONE] = {cone_f, cone_f1, cone_f2, .b = true, .slope = true},
    [FRET_GAP_FLAT_PARABOLOID] = {paraboloid_f, paraboloid_f1, curved_f2, .b = true, .R = true},
    [FRET_GAP_FLAT_ROUNDED] = {rounded_f, rounded_f1, curved_f2, .b = true, .R = true},
    [FRET_GAP_EXACT_SPHERE] = {sphere_f, sphere_f1, sphere_f2, .R = true},
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
    return !is_powers(gap) && shapes[gap->kind].b ? gap->b : 0;
}

fret_real fret_gap_end(const fret_gap *gap) {
    return gap->kind == FRET_GAP_EXACT_SPHERE ? (fret_real)gap->R : (fret_real)INFINITY;
}

fret_status fret_gap_f(const fret_gap *gap, fret_real r, fret_real *f) {
    if (r < 0)
        return fret_fail(FRET_NEGATIVE, "r", (double)r, 0);
    if (r > fret_gap_end(gap))
        return fret_fail(FRET_OUTSIDE, "r", (double)r, (double)fret_gap_end(gap));
    *f = 0;
    if (is_powers(gap)) {
        for (int i = 0; i < gap->terms; i++)
            *f += gap->power[i].h * powl(r / gap->power[i].r0, gap->power[i].n);
    } else if (r > fret_gap_start(gap)) {
        *f = shapes[gap->kind].f(gap, r);
    }
    return fret_ok();
}

/* With r = a s:  g = a int f'(as) (1-s^2)^((k-1)/2) ds,  I = a^(k+3)/(k+1)/a ... int s^2 f'(as) (...) ds.
 * The rule's weight takes the singular factor (1-s)^((k-1)/2); the rest is smooth. */
static fret_profile profile_by_rule(const fret_gap *gap, const fret_rule *rule, fret_real a) {
    const shape *sh = &shapes[gap->kind];
    fret_real b = fret_gap_start(gap), k = rule->k, alpha = (k - 1) / 2;
    fret_real span = (a - b) / a, sum_g = 0, sum_I = 0, sum_2 = 0;
    for (int i = 0; i < FRET_RULE; i++) {
        fret_real v = span * rule->v[i], s = 1 - v;
        fret_real w = rule->weight[i] * powl(2 - v, alpha), r = a * s;
        fret_real f1 = w * sh->f1(gap, r);
        sum_g += f1;
        sum_I += f1 * s * s;
        sum_2 += w * s * sh->f2(gap, r);
    }
    fret_real scale = powl(span, alpha + 1);
    fret_profile out;
    out.g = a * scale * sum_g;
    out.I = powl(a, k + 2) / (k + 1) * scale * sum_I;
    out.slope = scale * (sum_g + a * sum_2);
    if (b > 0)
        out.slope += sh->f1(gap, b) * (b / a) * powl(span * (1 + b / a), alpha);
    return out;
}

fret_profile fret_gap_profile(const fret_gap *gap, const fret_rule *rule, fret_real a) {
    if (!is_powers(gap))
        return profile_by_rule(gap, rule, a);
    fret_real k = rule->k, ak = powl(a, k + 1);
    fret_profile out = {0, 0, 0};
    for (int i = 0; i < gap->terms; i++) {
        const fret_power *p = &gap->power[i];
        fret_real n = p->n, g = fret_kappa(n, k) * p->h * powl(a / p->r0, n);
        out.g += g;
        out.slope += n * g / a;
        out.I += n * g * ak / ((k + 1) * (n + (k + 1)));
    }
    return out;
}

fret_status fret_gap_g(const fret_gap *gap, fret_real k, fret_real x, fret_real *g, fret_real *slope) {
    x = fabsl(x);
    if (x > fret_gap_end(gap))
        return fret_fail(FRET_OUTSIDE, "x", (double)x, (double)fret_gap_end(gap));
    fret_profile out = {0, 0, 0};
    if (x > fret_gap_start(gap)) {
        fret_rule rule = {.k = k};
        if (!is_powers(gap)) {
            fret_status st = fret_rule_make(k, &rule);
            if (st.code)
                return st;
        }
        out = fret_gap_profile(gap, &rule, x);
    }
    *g = out.g;
    if (slope)
        *slope = out.slope;
    return fret_ok();
}
