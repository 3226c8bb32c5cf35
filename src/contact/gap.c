/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "gap.h"

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

/* ---- the kernel near its singularity ----------------------------------------------------------- */

/* int_0^v u^j (u (2-u))^alpha du, j = 0..4, and (v (2-v))^(alpha+1), 0 <= v <= 1: u = 1-r/a is the distance
 * from the edge. */
enum { EDGE = 5 };
typedef struct edge {
    fret_real moment[EDGE], rim;
} edge;

/* The last moment by its series, the others downwards: every term is positive. */
static edge edge_moments(const fret_rule *rule, fret_real v) {
    if (v <= 0)
        return (edge){{0}, 0};
    fret_real m = (rule->k + 1) / 2, power = fret_pow(v, m), sum = 0, vn = 1, v3 = v * v * v;
    edge out = {.rim = power * fret_pow(2 - v, m)};
    for (int n = 0; n < FRET_SERIES; n++) {
        fret_real term = rule->series[n] * vn;
        sum += term;
        if (term < 1e-21L * sum)
            break;
        vn *= v;
    }
    out.moment[EDGE - 1] = power * v3 * v * sum;
    fret_real boundary = out.rim * v3; /* v^(j-1) rim */
    for (int j = EDGE - 1; j > 0; j--) {
        out.moment[j - 1] = (boundary + (2 * m + (j - 1)) * out.moment[j]) / (2 * (m + (j - 1)));
        boundary /= v;
    }
    return out;
}

static void make_series(fret_rule *rule) {
    fret_real beta = (1 - rule->k) / 2, m = (rule->k + 1) / 2, c = fret_pow(2, -beta);
    for (int n = 0; n < FRET_SERIES; n++) {
        rule->series[n] = c / (m + (EDGE - 1) + n);
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

static fret_profile profile_of(fret_real k, fret_real a, fret_real g, fret_real slope, fret_real I) {
    return (fret_profile){a * g, slope, fret_pow(a, k + 2) / (k + 1) * I};
}

static fret_real cone_f(const fret_gap *gap, fret_real r) {
    return gap->slope * (r - gap->b);
}
static fret_profile cone_profile(const fret_gap *gap, const fret_rule *rule, fret_real a, fret_real e) {
    fret_real k = rule->k, v = e / a, flat = gap->b / a;
    edge m = edge_moments(rule, v);
    fret_real g = gap->slope * m.moment[0], rim = gap->slope * flat * m.rim;
    return profile_of(k, a, g, g + rim / (v * (2 - v)), (g + rim) / (k + 2));
}

static fret_real paraboloid_f(const fret_gap *gap, fret_real r) {
    return (r - gap->b) * (r + gap->b) / (2 * (fret_real)gap->R);
}
static fret_profile paraboloid_profile(const fret_gap *gap, const fret_rule *rule, fret_real a, fret_real e) {
    fret_real k = rule->k, m = (k + 1) / 2, v = e / a, flat = gap->b / a, z = v * (2 - v);
    fret_real rim = a / gap->R * fret_pow(z, m), g = rim / (2 * m);
    return profile_of(k, a, g, 2 * g + rim * flat * flat / z, rim * (1 + m * (1 - z)) / (2 * m * (m + 1)));
}

static fret_real rounded_f(const fret_gap *gap, fret_real r) {
    return (r - gap->b) * (r - gap->b) / (2 * (fret_real)gap->R);
}
static fret_profile rounded_profile(const fret_gap *gap, const fret_rule *rule, fret_real a, fret_real e) {
    fret_real k = rule->k, v = e / a, flat = gap->b / a, z = v * (2 - v), steep = a / gap->R;
    edge m = edge_moments(rule, v);
    fret_real g = steep * (v * m.moment[0] - m.moment[1]);
    return profile_of(k, a, g, 2 * g + steep * flat * m.moment[0],
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
    return profile_of(k, a, g, slope, I);
}

static const shape shapes[] = {
    [FRET_GAP_FLAT_CONE] = {cone_f, cone_profile, .b = true, .slope = true},
    [FRET_GAP_FLAT_PARABOLOID] = {paraboloid_f, paraboloid_profile, .b = true, .R = true},
    [FRET_GAP_FLAT_ROUNDED] = {rounded_f, rounded_profile, .b = true, .R = true},
    [FRET_GAP_EXACT_SPHERE] = {sphere_f, sphere_profile, .R = true},
};

/* ---- sampled gaps ------------------------------------------------------------------------------ */

/* Cubic Hermite pieces with Steffen's slopes: monotone data give a monotone gap, f' is continuous, and the
 * error falls with the third power of the spacing. Per piece f' = d0 + d1 t + d2 t^2, t = r - r_i. */
struct fret_table {
    size_t count, blocks;
    double *r, *f, *d0, *d1, *d2;
    double start; /* it may begin flat */
    struct block *block;
};

/* Pieces far from the edge are summed in blocks, by Taylor's series of the kernel about the middle c of the
 * block: f' and r f'' count through their moments over x = (r-c)/d. A block precedes its two halves. */
enum { TAYLOR = 32, LEAF = 8 };
typedef struct block {
    size_t first, last, next;                 /* pieces; the first block that is no part of this one */
    fret_real c, d;                           /* middle and half-width */
    fret_real slope[TAYLOR + 2], rf2[TAYLOR]; /* int f' x^n dr, int r f'' x^n dr */
} block;

static fret_real f1_of(const struct fret_table *t, size_t i, fret_real x) {
    return t->d0[i] + x * (t->d1[i] + x * t->d2[i]);
}
static fret_real f2_of(const struct fret_table *t, size_t i, fret_real x) {
    return t->d1[i] + 2 * x * t->d2[i];
}

static const fret_real inverse[TAYLOR + 4] = {
    1.0L / 1,  1.0L / 2,  1.0L / 3,  1.0L / 4,  1.0L / 5,  1.0L / 6,  1.0L / 7,  1.0L / 8,  1.0L / 9,
    1.0L / 10, 1.0L / 11, 1.0L / 12, 1.0L / 13, 1.0L / 14, 1.0L / 15, 1.0L / 16, 1.0L / 17, 1.0L / 18,
    1.0L / 19, 1.0L / 20, 1.0L / 21, 1.0L / 22, 1.0L / 23, 1.0L / 24, 1.0L / 25, 1.0L / 26, 1.0L / 27,
    1.0L / 28, 1.0L / 29, 1.0L / 30, 1.0L / 31, 1.0L / 32, 1.0L / 33, 1.0L / 34, 1.0L / 35, 1.0L / 36};

/* The first moments of one piece about its own middle. */
static void piece_moments(const struct fret_table *t, size_t i, int count, block *b) {
    fret_real d = ((fret_real)t->r[i + 1] - t->r[i]) / 2, c = t->r[i] + d;
    fret_real p[3] = {f1_of(t, i, d), d * f2_of(t, i, d), d * d * t->d2[i]}, q1 = 2 * d * t->d2[i];
    fret_real q[3] = {c * f2_of(t, i, d), c * q1 + d * f2_of(t, i, d), d * q1};
    b->c = c;
    b->d = d;
    for (int n = 0; n < count + 2; n++) {
        fret_real even = 2 * d * inverse[n], odd = 2 * d * inverse[n + 1], second = 2 * d * inverse[n + 2];
        b->slope[n] = n % 2 ? p[1] * odd : p[0] * even + p[2] * second;
        if (n < count)
            b->rf2[n] = n % 2 ? q[1] * odd : q[0] * even + q[2] * second;
    }
}

/* A part of a block, no wider than half of it, by Gauss's rule: the series of the kernel converges fast. */
static void add_part(block *b, const struct fret_table *t, size_t i, fret_real lo, fret_real h) {
    for (int j = 0; j < 8; j++) {
        fret_real x = lo + h * fret_gauss_node[j], r = t->r[i] + x, z = (r - b->c) / b->d;
        fret_real w = h * fret_gauss_weight[j], f1 = w * f1_of(t, i, x), rf2 = w * r * f2_of(t, i, x);
        for (int n = 0; n < TAYLOR + 2; n++) {
            b->slope[n] += f1;
            f1 *= z;
            if (n < TAYLOR)
                b->rf2[n] += rf2;
            rf2 *= z;
        }
    }
}

/* Adds the moments of a half, moved to the middle of the whole. */
static void add_moved(block *whole, const block *part) {
    fret_real shift = (part->c - whole->c) / whole->d, ratio = part->d / whole->d, power = 1;
    fret_real slope[TAYLOR + 2], rf2[TAYLOR + 2] = {0};
    for (int n = 0; n < TAYLOR + 2; n++) {
        slope[n] = part->slope[n] * power;
        if (n < TAYLOR)
            rf2[n] = part->rf2[n] * power;
        power *= ratio;
    }
    for (int pass = 1; pass < TAYLOR + 2; pass++) /* binomials */
        for (int n = TAYLOR + 1; n >= pass; n--) {
            slope[n] += shift * slope[n - 1];
            rf2[n] += shift * rf2[n - 1];
        }
    for (int n = 0; n < TAYLOR + 2; n++) {
        whole->slope[n] += slope[n];
        if (n < TAYLOR)
            whole->rf2[n] += rf2[n];
    }
}

static size_t block_count(size_t pieces) {
    return pieces <= LEAF ? 1 : 1 + block_count(pieces / 2) + block_count(pieces - pieces / 2);
}

static const block *make_block(struct fret_table *t, size_t first, size_t last) {
    block *b = &t->block[t->blocks++];
    fret_real lo = t->r[first], hi = t->r[last];
    *b = (block){.first = first, .last = last, .c = (lo + hi) / 2, .d = (hi - lo) / 2};
    if (last - first > LEAF) {
        size_t middle = first + (last - first) / 2;
        add_moved(b, make_block(t, first, middle));
        add_moved(b, make_block(t, middle, last));
    } else {
        for (size_t i = first; i < last; i++) {
            fret_real h = (fret_real)t->r[i + 1] - t->r[i];
            int parts = h > b->d ? 2 : 1;
            for (int j = 0; j < parts; j++)
                add_part(b, t, i, h * j / parts, h / parts);
        }
    }
    b->next = t->blocks;
    return b;
}

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
    block *blocks = data ? malloc(block_count(count - 1) * sizeof *blocks) : NULL;
    if (!blocks) {
        free(data);
        free(t);
        return fret_fail(FRET_NO_MEMORY, NULL, 0, 0);
    }
    *t = (struct fret_table){
        count, 0, data, data + count, data + 2 * count, data + 3 * count, data + 4 * count, 0, blocks};
    memcpy(t->r, r, count * sizeof *r);
    memcpy(t->f, f, count * sizeof *f);
    table_slopes(t);
    make_block(t, 0, count - 1);
    for (size_t i = 1; i + 1 < count && f[i] <= 0; i++)
        t->start = r[i];
    *out = t;
    return fret_ok();
}

void fret_table_free(struct fret_table *t) {
    if (t) {
        free(t->block);
        free(t->r);
    }
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

/* int f' K, int r^2 f' K and int r f'' K over a part of the contact, in units of its radius. */
typedef struct sums {
    fret_real g, I, s;
} sums;

/* Terms that a block of half-width d needs whose middle is u away from the edge; 0: it is too near. */
static int far_terms(fret_real d, fret_real u) {
    fret_real ratio = d / u;
    int count = 1;
    if (!(u > 0 && ratio <= 0.25L))
        return 0;
    for (fret_real left = 1e21L * ratio; left > 1 && count < TAYLOR; left *= ratio)
        count++;
    return count;
}

/* u: distance of the middle from the edge. */
static void add_far(sums *all, const block *b, int count, fret_real alpha, fret_real a, fret_real u) {
    fret_real D = u * (a + b->c), x1 = 2 * b->c * b->d / D, x2 = b->d * b->d / D;
    fret_real q = 1, old = 0, slope[3] = {0, 0, 0}, rf2 = 0;
    for (int n = 0; n < count; n++) {
        for (int j = 0; j < 3; j++)
            slope[j] += q * b->slope[n + j];
        rf2 += q * b->rf2[n];
        fret_real next = (x1 * (n - alpha) * q + x2 * (n - 1 - 2 * alpha) * old) * inverse[n];
        old = q;
        q = next;
    }
    fret_real K = fret_pow(D / (a * a), alpha) / a, c = b->c / a, d = b->d / a;
    all->g += K * slope[0];
    all->I += K * (c * c * slope[0] + 2 * c * d * slope[1] + d * d * slope[2]);
    all->s += K * rf2;
}

/* A piece near the edge or at it: the kernel's moments between its ends, lo and hi. */
static void add_near(sums *all, const struct fret_table *t, size_t i, fret_real a, fret_real v,
                     const edge *lo, const edge *hi) {
    fret_real d1 = t->d1[i] * a, d2 = t->d2[i] * a * a, m[EDGE];
    for (int j = 0; j < EDGE; j++)
        m[j] = lo->moment[j] - hi->moment[j];
    /* f' and r f'' in powers of the distance from the edge; v: that of the piece's start */
    fret_real p[3] = {t->d0[i] + v * (d1 + v * d2), -(d1 + 2 * v * d2), d2};
    for (int j = 0; j < 3; j++) {
        all->g += p[j] * m[j];
        all->I += p[j] * (m[j] - 2 * m[j + 1] + m[j + 2]);
    }
    all->s += -p[1] * (m[0] - m[1]) - 2 * p[2] * (m[1] - m[2]);
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

static fret_profile profile_of_table(const fret_gap *gap, const fret_rule *rule, fret_real e) {
    const struct fret_table *t = gap->table;
    fret_real k = rule->k, alpha = (k - 1) / 2, start = fret_gap_start(gap), a = start + e;
    sums all = {0, 0, 0};
    for (size_t i = 0; i < t->blocks;) {
        const block *b = &t->block[i];
        fret_real middle = (start - b->c) + e;
        bool leaf = b->next == i + 1;
        int terms = far_terms(b->d, middle);
        i = leaf || terms || middle <= -b->d ? b->next : i + 1;
        if (terms)
            add_far(&all, b, terms, alpha, a, middle);
        if (terms || !leaf)
            continue;
        edge lo, hi = {{0}, 0};
        bool known = false; /* hi, at the start of this piece */
        for (size_t j = b->first; j < b->last && (start - t->r[j]) + e > 0; j++) {
            block piece;
            piece.d = ((fret_real)t->r[j + 1] - t->r[j]) / 2;
            middle = (start - (t->r[j] + piece.d)) + e;
            terms = far_terms(piece.d, middle);
            if (terms) {
                piece_moments(t, j, terms, &piece);
                add_far(&all, &piece, terms, alpha, a, middle);
                known = false;
                continue;
            }
            fret_real v = ((start - t->r[j]) + e) / a;
            lo = known ? hi : edge_moments(rule, v);
            hi = edge_moments(rule, ((start - t->r[j + 1]) + e) / a);
            known = true;
            add_near(&all, t, j, a, v, &lo, &hi);
        }
    }
    return profile_of(k, a, all.g, all.g + all.s, all.I);
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
    if (gap->kind == FRET_GAP_TABLE)
        return gap->table->start;
    return shapes[gap->kind].b ? gap->b : 0;
}

fret_real fret_gap_tip(const fret_gap *gap) {
    if (gap->kind == FRET_GAP_TABLE)
        return gap->table->d0[0] > 0 ? 1 : 2;
    fret_real least = is_powers(gap) ? (fret_real)INFINITY : 2;
    for (int i = 0; i < gap->terms && is_powers(gap); i++)
        least = gap->power[i].h != 0 ? fminl(least, gap->power[i].n) : least;
    return least;
}

fret_real fret_gap_end(const fret_gap *gap) {
    /* near the equator g grows without bound, and its series no longer converges */
    return gap->kind == FRET_GAP_EXACT_SPHERE ? 0.95L * gap->R
           : gap->kind == FRET_GAP_TABLE      ? (fret_real)gap->table->r[gap->table->count - 1]
                                              : (fret_real)INFINITY;
}

fret_real fret_gap_kink(const fret_gap *gap, fret_real e) {
    if (gap->kind != FRET_GAP_TABLE)
        return 0;
    const double *r = gap->table->r;
    fret_real start = fret_gap_start(gap);
    size_t i = table_piece(gap->table, start + e);
    while (i > 0 && r[i] - start >= e)
        i--;
    return fmaxl(r[i] - start, 0);
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

void fret_gap_rule(const fret_gap *gap, double k, fret_rule *rule) {
    rule->k = k;
    for (int i = 0; is_powers(gap) && i < gap->terms; i++)
        rule->kappa[i] = fret_kappa(gap->power[i].n, k);
    if (!is_powers(gap))
        make_series(rule);
}

fret_profile fret_gap_profile(const fret_gap *gap, const fret_rule *rule, fret_real e) {
    if (gap->kind == FRET_GAP_TABLE)
        return profile_of_table(gap, rule, e);
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
