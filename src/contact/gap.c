/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "gap.h"

#include "kernel.h"

#include <stdlib.h>
#include <string.h>

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

/* One row a shape: the gap, its two derivatives for r > start, and which parameters it reads. */
typedef struct shape {
    fret_real (*f)(const fret_gap *, fret_real r);
    fret_real (*f1)(const fret_gap *, fret_real r, fret_real x); /* x = r-b with all its digits */
    fret_real (*f2)(const fret_gap *, fret_real r);
    bool b, R, slope;
} shape;

static fret_real cone_f(const fret_gap *gap, fret_real r) {
    return gap->slope * (r - gap->b);
}
static fret_real cone_f1(const fret_gap *gap, fret_real r, fret_real x) {
    (void)r, (void)x;
    return gap->slope;
}
static fret_real cone_f2(const fret_gap *gap, fret_real r) {
    (void)gap, (void)r;
    return 0;
}
static fret_real paraboloid_f(const fret_gap *gap, fret_real r) {
    return (r - gap->b) * (r + gap->b) / (2 * (fret_real)gap->R);
}
static fret_real paraboloid_f1(const fret_gap *gap, fret_real r, fret_real x) {
    (void)x;
    return r / gap->R;
}
static fret_real curved_f2(const fret_gap *gap, fret_real r) {
    (void)r;
    return 1 / (fret_real)gap->R;
}
static fret_real rounded_f(const fret_gap *gap, fret_real r) {
    return (r - gap->b) * (r - gap->b) / (2 * (fret_real)gap->R);
}
static fret_real rounded_f1(const fret_gap *gap, fret_real r, fret_real x) {
    (void)r;
    return x / gap->R;
}
static fret_real sphere_f(const fret_gap *gap, fret_real r) {
    fret_real R = gap->R;
    return r * r / (R + sqrtl((R - r) * (R + r)));
}
static fret_real sphere_f1(const fret_gap *gap, fret_real r, fret_real x) {
    (void)x;
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

/* ---- sampled gaps ------------------------------------------------------------------------------ */

/* Cubic Hermite pieces with Steffen's slopes: monotone data give a monotone gap, f' is continuous, and the
 * error falls with the third power of the spacing. Per piece f' = d0 + d1 t + d2 t^2, t = r - r_i. */
struct fret_table {
    size_t count;
    double *r, *f, *d0, *d1, *d2;
};

static fret_real sign_of(fret_real x) {
    return x > 0 ? 1 : x < 0 ? -1 : 0;
}

static void table_slopes(struct fret_table *t) {
    size_t n = t->count;
    for (size_t i = 0; i < n; i++) {
        fret_real h1, s1, h2, s2, p;
        if (i > 0 && i + 1 < n) {
            h1 = (fret_real)t->r[i] - t->r[i - 1];
            h2 = (fret_real)t->r[i + 1] - t->r[i];
            s1 = ((fret_real)t->f[i] - t->f[i - 1]) / h1;
            s2 = ((fret_real)t->f[i + 1] - t->f[i]) / h2;
            p = (s1 * h2 + s2 * h1) / (h1 + h2);
            t->d0[i] =
                (double)((sign_of(s1) + sign_of(s2)) * fminl(fminl(fabsl(s1), fabsl(s2)), fabsl(p) / 2));
            continue;
        }
        /* ends: the parabola through the three nearest points, limited to keep the sense of the data */
        size_t a = i ? n - 2 : 0, b = n > 2 ? (i ? n - 3 : 1) : a;
        h1 = (fret_real)t->r[a + 1] - t->r[a];
        h2 = (fret_real)t->r[b + 1] - t->r[b];
        s1 = ((fret_real)t->f[a + 1] - t->f[a]) / h1;
        s2 = ((fret_real)t->f[b + 1] - t->f[b]) / h2;
        p = n > 2 ? s1 + (s1 - s2) * h1 / (h1 + h2) : s1;
        if (p * s1 <= 0)
            p = 0;
        else if (fabsl(p) > 2 * fabsl(s1))
            p = 2 * s1;
        t->d0[i] = (double)p;
    }
    for (size_t i = 0; i + 1 < n; i++) {
        fret_real h = (fret_real)t->r[i + 1] - t->r[i], s = ((fret_real)t->f[i + 1] - t->f[i]) / h;
        t->d1[i] = (double)(2 * (3 * s - 2 * (fret_real)t->d0[i] - t->d0[i + 1]) / h);
        t->d2[i] = (double)(3 * ((fret_real)t->d0[i] + t->d0[i + 1] - 2 * s) / (h * h));
    }
}

fret_status fret_table_make(const double *r, const double *f, size_t count, struct fret_table **out) {
    for (size_t i = 0; i < count; i++) {
        if (!isfinite(r[i]) || !isfinite(f[i]))
            return fret_fail(FRET_NOT_FINITE, isfinite(r[i]) ? "f" : "r", isfinite(r[i]) ? f[i] : r[i], 0);
        if (i == 0 ? r[0] != 0 || f[0] != 0 : r[i] <= r[i - 1])
            return fret_fail(FRET_BAD_TABLE, "r", r[i], i ? r[i - 1] : 0);
    }
    if (count < 2)
        return fret_fail(FRET_BAD_TABLE, "r", count ? r[0] : 0, 0);
    struct fret_table *t = calloc(1, sizeof *t);
    double *data = t ? malloc(5 * count * sizeof *data) : NULL;
    if (!data) {
        free(t);
        return fret_fail(FRET_NO_MEMORY, NULL, 0, 0);
    }
    *t = (struct fret_table){count, data, data + count, data + 2 * count, data + 3 * count, data + 4 * count};
    memcpy(t->r, r, count * sizeof *r);
    memcpy(t->f, f, count * sizeof *f);
    table_slopes(t);
    *out = t;
    return fret_ok();
}

void fret_table_free(struct fret_table *t) {
    if (t)
        free(t->r);
    free(t);
}

/* The piece that holds r. */
static size_t table_piece(const struct fret_table *t, fret_real r) {
    size_t lo = 0, hi = t->count - 1;
    while (hi - lo > 1) {
        size_t mid = (lo + hi) / 2;
        if (t->r[mid] <= r)
            lo = mid;
        else
            hi = mid;
    }
    return lo;
}

static fret_real table_f(const fret_gap *gap, fret_real r) {
    const struct fret_table *t = gap->table;
    size_t i = table_piece(t, r);
    fret_real x = r - t->r[i];
    return t->f[i] + x * (t->d0[i] + x * (t->d1[i] / 2 + x * t->d2[i] / 3));
}

/* int f' K, int f' r^2 K and int r f'' K over a piece, K = (a^2-r^2)^((k-1)/2). */
typedef struct piece_sums {
    fret_real g, I, s;
} piece_sums;

static void piece_add(piece_sums *sum, const struct fret_table *t, size_t i, fret_real r, fret_real weight) {
    fret_real x = r - t->r[i], f1 = t->d0[i] + x * (t->d1[i] + x * t->d2[i]),
              f2 = t->d1[i] + 2 * x * t->d2[i];
    sum->g += weight * f1;
    sum->I += weight * f1 * r * r;
    sum->s += weight * r * f2;
}

/* From r to a with the polynomial of piece i: exact up to the smooth factor (a+r)^alpha. */
static piece_sums piece_to_edge(const struct fret_table *t, const fret_rule *rule, size_t i, fret_real r,
                                fret_real a) {
    fret_real alpha = (rule->k - 1) / 2, span = a - r, scale = fret_pow(span, alpha + 1);
    piece_sums sum = {0, 0, 0};
    for (int j = 0; j < FRET_RULE; j++) {
        fret_real x = a - span * rule->v[j];
        piece_add(&sum, t, i, x, scale * rule->weight[j] * fret_pow(a + x, alpha));
    }
    return sum;
}

/* Far from the edge three points in double do: tables have up to 1e5 pieces, nearly all of them far. */
static void far_add(piece_sums *sum, const struct fret_table *t, size_t i, double a, double alpha) {
    static const double node[3] = {0.1127016653792583, 0.5, 0.8872983346207417};
    static const double weight[3] = {5.0 / 18, 8.0 / 18, 5.0 / 18};
    double h = t->r[i + 1] - t->r[i], g = 0, I = 0, s = 0;
    for (int j = 0; j < 3; j++) {
        double x = h * node[j], r = t->r[i] + x, w = h * weight[j] * kernel_pow((a - r) * (a + r), alpha);
        double f1 = t->d0[i] + x * (t->d1[i] + x * t->d2[i]), f2 = t->d1[i] + 2 * x * t->d2[i];
        g += w * f1;
        I += w * f1 * r * r;
        s += w * r * f2;
    }
    sum->g += g;
    sum->I += I;
    sum->s += s;
}

/* f' + r f'' >= 0 everywhere makes g grow, and costs nothing to see. */
bool fret_table_grows(const struct fret_table *t) {
    for (size_t i = 0; i + 1 < t->count; i++)
        for (int j = 0; j <= 4; j++) {
            double h = t->r[i + 1] - t->r[i], x = h * j / 4;
            if (t->d0[i] + x * (t->d1[i] + x * t->d2[i]) + (t->r[i] + x) * (t->d1[i] + 2 * x * t->d2[i]) < 0)
                return false;
        }
    return true;
}

static fret_profile profile_of_table(const fret_gap *gap, const fret_rule *rule, fret_real a) {
    const struct fret_table *t = gap->table;
    fret_real k = rule->k, alpha = (k - 1) / 2;
    size_t last = table_piece(t, a);
    piece_sums all = piece_to_edge(t, rule, last, t->r[last], a);
    for (size_t i = last; i-- > 0;) {
        fret_real lo = t->r[i], hi = t->r[i + 1];
        if (a - hi < 3 * (hi - lo)) { /* too near: the difference of two pieces that end at the edge */
            piece_sums outer = piece_to_edge(t, rule, i, lo, a), inner = piece_to_edge(t, rule, i, hi, a);
            all.g += outer.g - inner.g;
            all.I += outer.I - inner.I;
            all.s += outer.s - inner.s;
            continue;
        }
        if (a - hi > 30 * (hi - lo)) {
            far_add(&all, t, i, (double)a, (double)alpha);
            continue;
        }
        for (int j = 0; j < 8; j++) { /* the singularity is some pieces away */
            fret_real r = lo + (hi - lo) * fret_gauss_node[j];
            piece_add(&all, t, i, r, (hi - lo) * fret_gauss_weight[j] * fret_pow((a - r) * (a + r), alpha));
        }
    }
    fret_profile out = {fret_pow(a, 1 - k) * all.g, fret_pow(a, -k) * (all.g + all.s), all.I / (k + 1)};
    return out;
}

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
    if (gap->kind != FRET_GAP_TABLE)
        return shapes[gap->kind].b ? gap->b : 0;
    size_t i = 0; /* a table may begin flat */
    while (i + 2 < gap->table->count && gap->table->f[i + 1] <= 0)
        i++;
    return gap->table->r[i];
}

fret_real fret_gap_end(const fret_gap *gap) {
    /* near the equator g grows without bound, and the rule no longer resolves it */
    return gap->kind == FRET_GAP_EXACT_SPHERE ? 0.95L * gap->R
           : gap->kind == FRET_GAP_TABLE      ? (fret_real)gap->table->r[gap->table->count - 1]
                                              : (fret_real)INFINITY;
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
        *f = gap->kind == FRET_GAP_TABLE ? table_f(gap, r) : shapes[gap->kind].f(gap, r);
    }
    return fret_ok();
}

/* With r = a s:  g = a int f'(as) (1-s^2)^((k-1)/2) ds,  I = a^(k+2)/(k+1) int s^2 f'(as) (1-s^2)^((k-1)/2)
 * ds. The rule's weight takes the singular factor (1-s)^((k-1)/2); the rest is smooth. */
static fret_profile profile_by_rule(const fret_gap *gap, const fret_rule *rule, fret_real e) {
    const shape *sh = &shapes[gap->kind];
    fret_real b = fret_gap_start(gap), a = b + e, k = rule->k, alpha = (k - 1) / 2;
    fret_real span = e / a, sum_g = 0, sum_I = 0, sum_2 = 0;
    for (int i = 0; i < FRET_RULE; i++) {
        fret_real v = span * rule->v[i], s = 1 - v;
        fret_real w = rule->weight[i] * fret_pow(2 - v, alpha), r = a * s;
        fret_real f1 = w * sh->f1(gap, r, e * (1 - rule->v[i]));
        sum_g += f1;
        sum_I += f1 * s * s;
        sum_2 += w * s * sh->f2(gap, r);
    }
    fret_real scale = fret_pow(span, alpha + 1);
    fret_profile out;
    out.g = a * scale * sum_g;
    out.I = fret_pow(a, k + 2) / (k + 1) * scale * sum_I;
    out.slope = scale * (sum_g + a * sum_2);
    if (b > 0)
        out.slope += sh->f1(gap, b, 0) * (b / a) * fret_pow(span * (1 + b / a), alpha);
    return out;
}

fret_status fret_gap_rule(const fret_gap *gap, double k, fret_rule *rule) {
    rule->k = k;
    for (int i = 0; is_powers(gap) && i < gap->terms; i++)
        rule->kappa[i] = fret_kappa(gap->power[i].n, k);
    return is_powers(gap) ? fret_ok() : fret_rule_make(k, rule);
}

fret_profile fret_gap_profile(const fret_gap *gap, const fret_rule *rule, fret_real e) {
    if (gap->kind == FRET_GAP_TABLE)
        return profile_of_table(gap, rule, fret_gap_start(gap) + e);
    if (!is_powers(gap))
        return profile_by_rule(gap, rule, e);
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
        fret_status st = fret_gap_rule(gap, k, &rule);
        if (st.code)
            return st;
        out = fret_gap_profile(gap, &rule, x - fret_gap_start(gap));
    }
    *g = out.g;
    if (slope)
        *slope = out.slope;
    return fret_ok();
}
