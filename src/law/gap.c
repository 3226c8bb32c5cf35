/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The shapes of the gap: f(r), g(x) and the properties of each. No other file asks which shape a gap has; a
 * new shape is a row of shapes[] and its functions. */
#include "law/gap.h"

#include "law/check.h"
#include "law/table.h"
#include "number/real.h"

dd_scaled fret_kappa_parts(double n, double k) {
    dd k1 = dd_sum(1, k), d = {k1.hi / 2, k1.lo / 2}, top = dd_add_d(dd_of(n / 2), 1);
    const dd over[] = {dd_add_d(d, 1), top}, under[] = {dd_add(top, d)};
    dd_scaled q = fret_dd_gamma_quotient(over, 2, under, 1);
    q.factor = dd_mul(q.factor, dd_div(dd_add_d(k1, n), k1));
    return q;
}

fret_real fret_kappa(double n, double k) {
    if (fret_check_positive("n", n).code || fret_check_k(k).code)
        return (fret_real)NAN;
    dd_scaled q = fret_kappa_parts(n, k);
    return dd_value(dd_mul(q.factor, fret_dd_exp(q.log)));
}

/* The profiles use g = a int f' (1-s^2)^((k-1)/2) ds, s = r/a; flat: b/a. */

static fret_real powers_f(const fret_gap *gap, fret_real r) {
    fret_real f = 0;
    for (int i = 0; i < gap->terms; i++)
        f += gap->power[i].h * fret_ratio_pow(r, gap->power[i].r0, gap->power[i].n);
    return f;
}
static fret_profile powers_profile(const fret_gap *gap, const fret_rule *rule, fret_real e) {
    fret_profile out = {0, 0};
    for (int i = 0; i < gap->terms; i++) {
        const fret_power *p = &gap->power[i];
        fret_real g = rule->kappa[i] * p->h * fret_ratio_pow(e, p->r0, p->n);
        out.g += g;
        out.slope += p->n * g / e;
    }
    return out;
}
static fret_real powers_tip(const fret_gap *gap) {
    fret_real least = INFINITY;
    for (int i = 0; i < gap->terms; i++)
        least = gap->power[i].h != 0 ? fminl(least, gap->power[i].n) : least;
    return least;
}

static int powers_series(const fret_gap *gap, const fret_rule *rule, fret_real a, fret_term *term) {
    for (int i = 0; i < gap->terms; i++) {
        const fret_power *p = &gap->power[i];
        const fret_real G = rule->kappa[i] * p->h * fret_ratio_pow(a, p->r0, p->n);
        term[i] = (fret_term){p->n, G, rule->kappa[i]};
    }
    return gap->terms;
}

static fret_real flat_start(const fret_gap *gap) {
    return gap->b;
}

static fret_real cone_f(const fret_gap *gap, fret_real r) {
    return gap->slope * (r - gap->b);
}
static fret_profile cone_profile(const fret_gap *gap, const fret_rule *rule, fret_real e) {
    fret_real a = gap->b + e, v = e / a, flat = gap->b / a;
    fret_edge m = fret_edge_moments(rule, v);
    fret_real g = gap->slope * m.moment[0];
    return (fret_profile){a * g, g + gap->slope * flat * m.rim / (v * (2 - v))};
}

static fret_real paraboloid_f(const fret_gap *gap, fret_real r) {
    return (r - gap->b) * (r + gap->b) / (2 * (fret_real)gap->R);
}
static fret_profile paraboloid_profile(const fret_gap *gap, const fret_rule *rule, fret_real e) {
    fret_real a = gap->b + e, m = (rule->k + 1) / 2, v = e / a, flat = gap->b / a, z = v * (2 - v);
    fret_real rim = a / gap->R * fret_pow(z, m), g = rim / (2 * m);
    return (fret_profile){a * g, 2 * g + rim * flat * flat / z};
}

static fret_real rounded_f(const fret_gap *gap, fret_real r) {
    return (r - gap->b) * (r - gap->b) / (2 * (fret_real)gap->R);
}
static fret_profile rounded_profile(const fret_gap *gap, const fret_rule *rule, fret_real e) {
    fret_real a = gap->b + e, v = e / a, flat = gap->b / a, steep = a / gap->R;
    fret_edge m = fret_edge_moments(rule, v);
    fret_real g = steep * (v * m.moment[0] - m.moment[1]);
    return (fret_profile){a * g, 2 * g + steep * flat * m.moment[0]};
}

static fret_real sphere_f(const fret_gap *gap, fret_real r) {
    fret_real R = gap->R;
    return r * r / (R + sqrtl((R - r) * (R + r)));
}
/* By the series of f in r^2, r^4, ..., whose coefficients are positive. */
static fret_profile sphere_profile(const fret_gap *gap, const fret_rule *rule, fret_real e) {
    fret_real a = e, k = rule->k, m1 = (k + 3) / 2, q = a / gap->R * (a / gap->R),
              term = a / (gap->R * (k + 1));
    fret_real g = 0, slope = 0, rise;
    int n = 0;
    do { /* q <= 0.95^2 */
        rise = (2 * n + 2) * term;
        g += term;
        slope += rise;
        term *= q * (n + 0.5L) / (m1 + n);
        n++;
    } while (rise > 1e-21L * slope);
    return (fret_profile){a * g, slope};
}

static int sphere_series(const fret_gap *gap, const fret_rule *rule, fret_real a, fret_term *term) {
    const fret_real m = (rule->k + 1) / 2, q = a / gap->R * (a / gap->R);
    fret_real G = a * a / (2 * m * gap->R), kappa = 1 / m, all = 0;
    for (int i = 0; i < FRET_MOST_TERMS; i++) {
        term[i] = (fret_term){2 * i + 2, G, kappa};
        all += (i + 1) * G;
        if ((i + 1) * G < 1e-18L * all)
            return i + 1;
        G *= q * (i + 0.5L) / (m + 1 + i);
        kappa *= (i + 2) / (i + 1 + m);
    }
    return 0;
}

static fret_real sphere_end(const fret_gap *gap) {
    return 0.95L * gap->R; /* near the equator g grows without bound and its series converges too slowly */
}
static fret_real sampled_f(const fret_gap *gap, fret_real r) {
    return fret_table_f(gap->table, r);
}
static fret_profile sampled_profile(const fret_gap *gap, const fret_rule *rule, fret_real e) {
    return fret_table_profile(gap->table, rule, e);
}
static fret_real sampled_start(const fret_gap *gap) {
    return fret_table_start(gap->table);
}
static fret_real sampled_end(const fret_gap *gap) {
    return fret_table_end(gap->table);
}
static fret_real sampled_tip(const fret_gap *gap) {
    return fret_table_pointed(gap->table) ? 1 : 2;
}
/* Valid within the first row. In the order 2, 1, 3 powers that differ by 2 are neighbours. */
static int sampled_series(const fret_gap *gap, const fret_rule *rule, fret_real a, fret_term *term) {
    static const int powers[] = {2, 1, 3};
    fret_real factor[3];
    int terms = 0;
    if (!fret_table_tip(gap->table, a, factor))
        return 0;
    for (int i = 0; i < 3; i++) {
        const int n = powers[i];
        const fret_real f = factor[n - 1] * (n == 1 ? a : n == 2 ? a * a : a * a * a);
        if (f != 0)
            term[terms++] = (fret_term){n, rule->kappa[n - 1] * f, rule->kappa[n - 1]};
    }
    return terms;
}

/* ---- worn -------------------------------------------------------------------------------------- */

static fret_real worn_place(const fret_gap *gap, fret_real r) {
    return (r - gap->worn->inner) * (r + gap->worn->inner);
}
static fret_real worn_f(const fret_gap *gap, fret_real r) {
    fret_real f = 0;
    (void)fret_gap_f(&gap->worn->of, r, &f);
    return r > gap->worn->inner ? f + fret_table_f(gap->worn->h, worn_place(gap, r)) : f;
}
static fret_real worn_start(const fret_gap *gap) {
    return gap->worn->inner > 0 ? fret_gap_start(&gap->worn->of) : 0;
}
static fret_real worn_end(const fret_gap *gap) {
    return sqrtl(gap->worn->inner * gap->worn->inner + fret_table_end(gap->worn->g));
}
static fret_real worn_tip(const fret_gap *gap) {
    return gap->worn->inner > 0 ? fret_gap_tip(&gap->worn->of) : 2;
}
static fret_profile worn_profile(const fret_gap *gap, const fret_rule *rule, fret_real e) {
    const struct fret_worn *w = gap->worn;
    const fret_real a = worn_start(gap) + e, v = worn_place(gap, a);
    fret_real c[3];
    if (!(v > 0))
        return fret_gap_profile(&w->of, rule, e);
    const size_t row = fret_table_row_count(w->g, v) - 1;
    const fret_real x = v - fret_table_distance(w->g, row);
    fret_table_slope(w->g, row, c);
    return (fret_profile){w->at_inner + fret_table_f(w->g, v) + w->lift * v,
                          2 * a * (c[0] + x * (c[1] + x * c[2]) + w->lift)};
}
static int worn_series(const fret_gap *gap, const fret_rule *rule, fret_real a, fret_term *term) {
    const struct fret_worn *w = gap->worn;
    const fret_real m = (rule->k + 1) / 2;
    fret_real factor[3], power = 1, kappa = 1;
    if (w->inner > 0)
        return fret_gap_series(&w->of, rule, a, term);
    if (!fret_table_tip(w->g, a * a * (1 - 1e-15L), factor))
        return 0;
    factor[0] += w->lift;
    for (int i = 0; i < 3; i++) {
        power *= a * a;
        kappa *= (i + 1) / (i + m);
        term[i] = (fret_term){2 * (i + 1), factor[i] * power, kappa};
    }
    return 3;
}

/* ---- far away ---------------------------------------------------------------------------------- */

/* Far beyond a flat end, with c = b/x, m = (k+1)/2,
 *   int_b^x (x^2-r^2)^(m-1) dr = x^(2m-1) (kappa(1,k) - sum (1-m)_j/j! c^(2j+1)/(2j+1)),
 *   int_b^x 2 r (x^2-r^2)^(m-1) dr = x^2m/m (1-c^2)^m.
 * The functions below add the terms of a cone of slope `steep`, with powers 1, 0, -2, -4 ..., or of a
 * paraboloid of radius R, with powers 2, 0, -2 ..., to the factors of x^2, x, 1, x^-2 ... */
static void add_far_cone(const fret_gap *gap, const fret_rule *rule, fret_real x0, fret_real steep,
                         fret_real factor[FRET_MOST_TERMS]) {
    const fret_real c = gap->b / x0, m = (rule->k + 1) / 2;
    fret_real part = c;
    factor[1] += steep * x0 * fret_kappa(1, (double)rule->k);
    for (int j = 0; j + 2 < FRET_MOST_TERMS; j++) {
        factor[j + 2] -= steep * x0 * part / (fret_real)(2 * j + 1);
        part *= c * c * ((fret_real)(j + 1) - m) / (fret_real)(j + 1);
    }
}
static void add_far_paraboloid(const fret_gap *gap, const fret_rule *rule, fret_real x0,
                               fret_real factor[FRET_MOST_TERMS]) {
    const fret_real c = gap->b / x0, m = (rule->k + 1) / 2;
    fret_real part = x0 * x0 / (2 * m * gap->R);
    for (int j = 0; j + 1 < FRET_MOST_TERMS; j++) {
        factor[j == 0 ? 0 : j + 1] += part;
        part *= c * c * ((fret_real)j - m) / (fret_real)(j + 1);
    }
}
static void far_cone(const fret_gap *gap, const fret_rule *rule, fret_real x0, fret_real *factor) {
    add_far_cone(gap, rule, x0, gap->slope, factor);
}
static void far_paraboloid(const fret_gap *gap, const fret_rule *rule, fret_real x0, fret_real *factor) {
    add_far_paraboloid(gap, rule, x0, factor);
}
static void far_rounded(const fret_gap *gap, const fret_rule *rule, fret_real x0, fret_real *factor) {
    add_far_paraboloid(gap, rule, x0, factor);
    add_far_cone(gap, rule, x0, -gap->b / (fret_real)gap->R, factor);
}

/* One row per shape. Without a function: start 0, end infinity, tip 2 (f ~ r^2), no series. A gap that starts
 * at 0 and is neither powers nor sampled needs an end: cells are cut up to there. */
typedef struct shape {
    fret_real (*f)(const fret_gap *, fret_real r); /* f, profile: beyond the start; or NULL */
    fret_profile (*profile)(const fret_gap *, const fret_rule *, fret_real e);
    fret_real (*start)(const fret_gap *), (*end)(const fret_gap *), (*tip)(const fret_gap *);
    int (*series)(const fret_gap *, const fret_rule *, fret_real a, fret_term *);
    void (*far)(const fret_gap *, const fret_rule *, fret_real x0, fret_real *factor);
    bool powers, closed, sharp; /* uses power[]; see fret_gap_closed, fret_gap_sharp */
    bool sampled, worn;         /* uses the table; uses worn */
    bool b, R, slope;           /* uses these, which must be positive */
} shape;

static const shape shapes[] = {
    [FRET_GAP_POWER] = {.f = powers_f,
                        .profile = powers_profile,
                        .tip = powers_tip,
                        .series = powers_series,
                        .powers = true,
                        .closed = true},
    [FRET_GAP_SUM] = {.f = powers_f,
                      .profile = powers_profile,
                      .tip = powers_tip,
                      .series = powers_series,
                      .powers = true},
    [FRET_GAP_FLAT_CONE] = {.f = cone_f,
                            .profile = cone_profile,
                            .start = flat_start,
                            .far = far_cone,
                            .sharp = true,
                            .b = true,
                            .slope = true},
    [FRET_GAP_FLAT_PARABOLOID] = {.f = paraboloid_f,
                                  .profile = paraboloid_profile,
                                  .start = flat_start,
                                  .far = far_paraboloid,
                                  .sharp = true,
                                  .b = true,
                                  .R = true},
    [FRET_GAP_FLAT_ROUNDED] = {.f = rounded_f,
                               .profile = rounded_profile,
                               .start = flat_start,
                               .far = far_rounded,
                               .b = true,
                               .R = true},
    [FRET_GAP_EXACT_SPHERE] =
        {.f = sphere_f, .profile = sphere_profile, .end = sphere_end, .series = sphere_series, .R = true},
    [FRET_GAP_FLAT] = {.start = flat_start, .end = flat_start, .sharp = true, .b = true},
    [FRET_GAP_TABLE] = {.f = sampled_f,
                        .profile = sampled_profile,
                        .start = sampled_start,
                        .end = sampled_end,
                        .tip = sampled_tip,
                        .series = sampled_series,
                        .sampled = true},
    [FRET_GAP_WORN] = {.f = worn_f,
                       .profile = worn_profile,
                       .start = worn_start,
                       .end = worn_end,
                       .tip = worn_tip,
                       .series = worn_series,
                       .worn = true},
};

enum { SHAPES = sizeof shapes / sizeof *shapes };

static const shape *shape_of(const fret_gap *gap) {
    return &shapes[gap->kind];
}

static fret_status check_powers(const fret_gap *gap) {
    fret_status st = fret_ok();
    for (int i = 0; i < gap->terms && !st.code; i++) {
        const fret_power *p = &gap->power[i];
        st = fret_check_positive("n", p->n);
        if (!st.code)
            st = fret_check_positive("r0", p->r0);
        if (!st.code && shape_of(gap)->closed)
            st = fret_check_positive("h", p->h);
        if (!st.code && !isfinite(p->h))
            st = fret_fail(FRET_NOT_FINITE, "A", p->h, 0);
    }
    return st;
}

/* Checks what must hold before anything is looked up in shapes[] or in the gap. */
static fret_status check_kind(const fret_gap *gap) {
    if ((unsigned)gap->kind >= SHAPES)
        return fret_fail(FRET_OUTSIDE, "kind", (double)gap->kind, SHAPES - 1);
    const shape *s = shape_of(gap);
    const int most = s->closed ? 1 : FRET_GAP_TERMS;
    if (s->powers && (gap->terms < 1 || gap->terms > most))
        return fret_fail(FRET_OUTSIDE, "terms", gap->terms, most);
    if (s->worn && !gap->worn)
        return fret_fail(FRET_OUTSIDE, "worn", 0, 0);
    return s->sampled && !gap->table ? fret_fail(FRET_OUTSIDE, "table", 0, 0) : fret_ok();
}

fret_status fret_gap_check(const fret_gap *gap) {
    fret_status st = check_kind(gap);
    if (st.code)
        return st;
    const shape *s = shape_of(gap);
    st = s->powers ? check_powers(gap) : fret_ok();
    if (!st.code && s->b)
        st = fret_check_positive("b", gap->b);
    if (!st.code && s->R)
        st = fret_check_positive("R", gap->R);
    if (!st.code && s->slope)
        st = fret_check_positive("slope", gap->slope);
    return st;
}

fret_real fret_gap_start(const fret_gap *gap) {
    const shape *s = shape_of(gap);
    return s->start ? s->start(gap) : 0;
}

fret_real fret_gap_end(const fret_gap *gap) {
    const shape *s = shape_of(gap);
    return s->end ? s->end(gap) : (fret_real)INFINITY;
}

fret_real fret_gap_tip(const fret_gap *gap) {
    const shape *s = shape_of(gap);
    return s->tip ? s->tip(gap) : 2;
}

int fret_gap_powers(const fret_gap *gap) {
    return shape_of(gap)->powers ? gap->terms : 0;
}

int fret_gap_series(const fret_gap *gap, const fret_rule *rule, fret_real a,
                    fret_term term[FRET_MOST_TERMS]) {
    const shape *s = shape_of(gap);
    return s->series ? s->series(gap, rule, a, term) : 0;
}

int fret_gap_far(const fret_gap *gap, const fret_rule *rule, fret_real x0, fret_term term[FRET_MOST_TERMS]) {
    static const fret_real LITTLE = 1e-21L;
    fret_real factor[FRET_MOST_TERMS] = {0};
    int terms = 0;
    shape_of(gap)->far(gap, rule, x0, factor);
    for (int i = 0; i < FRET_MOST_TERMS; i++)
        if (fabsl(factor[i]) > LITTLE * (factor[0] + factor[1]))
            term[terms++] = (fret_term){i == 0 ? 2 : i == 1 ? 1 : 4 - 2 * i, factor[i], 0};
    return terms;
}

bool fret_gap_same(const fret_gap *a, const fret_gap *b) {
    const shape *s = shape_of(a);
    if (a->kind != b->kind || (s->b && a->b != b->b) || (s->R && a->R != b->R) ||
        (s->slope && a->slope != b->slope) || (s->sampled && a->table != b->table) ||
        (s->worn && a->worn != b->worn) || (s->powers && a->terms != b->terms))
        return false;
    for (int i = 0; s->powers && i < a->terms; i++)
        if (a->power[i].n != b->power[i].n || a->power[i].h != b->power[i].h ||
            a->power[i].r0 != b->power[i].r0)
            return false;
    return true;
}

fret_gap fret_gap_unit(const fret_gap *gap, fret_real *radii, fret_real *depths) {
    const shape *s = shape_of(gap);
    const fret_real R = s->R ? gap->R : 1;
    fret_gap unit = *gap;
    *radii = s->b ? gap->b : R;
    *depths = s->slope ? *radii * gap->slope : *radii * *radii / R;
    unit.b = s->b ? 1 : gap->b;
    unit.R = s->R ? 1 : gap->R;
    unit.slope = s->slope ? 1 : gap->slope;
    return unit;
}

const struct fret_worn *fret_gap_worn(const fret_gap *gap) {
    return shape_of(gap)->worn ? gap->worn : NULL;
}

/* The gap before any wear. */
static const fret_gap *unworn(const fret_gap *gap) {
    for (const struct fret_worn *w; (w = fret_gap_worn(gap)); gap = &w->of)
        ;
    return gap;
}

bool fret_gap_sharp(const fret_gap *gap) {
    return shape_of(unworn(gap))->sharp;
}

bool fret_gap_closed(const fret_gap *gap) {
    return shape_of(gap)->closed;
}

fret_gap fret_gap_of_worn(const struct fret_worn *worn) {
    return (fret_gap){.kind = FRET_GAP_WORN, .worn = worn};
}

bool fret_gap_sampled(const fret_gap *gap) {
    return shape_of(gap)->sampled || shape_of(gap)->worn;
}

fret_status fret_gap_f(const fret_gap *gap, fret_real r, fret_real *f) {
    if (!isfinite(r))
        return fret_fail(FRET_NOT_FINITE, "r", (double)r, 0);
    if (r < 0)
        return fret_fail(FRET_NEGATIVE, "r", (double)r, 0);
    if (r > fret_gap_end(gap))
        return fret_fail(FRET_OUTSIDE, "r", (double)r, (double)fret_gap_end(gap));
    *f = r > fret_gap_start(gap) ? shape_of(gap)->f(gap, r) : 0;
    return fret_ok();
}

void fret_gap_rule(const fret_gap *gap, double k, fret_rule *rule) {
    gap = unworn(gap);
    rule->k = k;
    if (!shape_of(gap)->powers)
        fret_rule_series(rule, k);
    for (int i = 0; shape_of(gap)->powers && i < gap->terms; i++)
        rule->kappa[i] = fret_kappa(gap->power[i].n, k);
    for (int i = 0; shape_of(gap)->sampled && i < 3; i++) /* kappa of r, r^2, r^3 */
        rule->kappa[i] = fret_kappa(i + 1, k);
}

fret_profile fret_gap_profile(const fret_gap *gap, const fret_rule *rule, fret_real e) {
    return shape_of(gap)->profile(gap, rule, e);
}

fret_status fret_gap_g(const fret_gap *gap, double k, fret_real x, fret_real *g, fret_real *slope) {
    const fret_status st = fret_check_k(k);
    if (st.code)
        return st;
    x = fabsl(x);
    if (!isfinite(x))
        return fret_fail(FRET_NOT_FINITE, "x", (double)x, 0);
    if (x > fret_gap_end(gap))
        return fret_fail(FRET_OUTSIDE, "x", (double)x, (double)fret_gap_end(gap));
    fret_profile out = {0, 0};
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
