/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Sampled gaps: a smooth monotone curve through the rows, and its profile row by row. Allocates, and frees,
 * its tables. */
#include "law/table.h"

#include <stdlib.h>
#include <string.h>

#include "law/check.h"
#include "number/integral.h"
#include "number/real.h"

/* Cubic Hermite pieces, with Steffen's slopes unless slopes are given: monotone data give a monotone gap, f'
 * is continuous, and the error falls with the third power of the spacing. In each piece f' = d0 + d1 t + d2
 * t^2, t = r - r_i. */
struct fret_table {
    size_t count;
    double *r, *f, *d0, *d1, *d2;
    double start;   /* radius of a flat end, or 0 */
    double within;  /* tolerance of thinning, relative to the largest f */
    fret_stop stop; /* while the table is made */
};

static fret_real f1_of(const struct fret_table *t, size_t i, fret_real x) {
    return t->d0[i] + x * (t->d1[i] + x * t->d2[i]);
}
static fret_real f2_of(const struct fret_table *t, size_t i, fret_real x) {
    return t->d1[i] + 2 * x * t->d2[i];
}

static bool stopped(const struct fret_table *t) {
    return t->stop && *t->stop;
}

static fret_real sign_of(fret_real x) {
    return x > 0 ? 1 : x < 0 ? -1 : 0;
}

static void steffen_slopes(struct fret_table *t) {
    size_t n = t->count;
    for (size_t i = 0; i < n && !stopped(t); i++) {
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
        /* at the ends: the parabola through the nearest three points, limited to the sign of the data */
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
}

static void hermite_pieces(struct fret_table *t) {
    for (size_t i = 0; i + 1 < t->count && !stopped(t); i++) {
        fret_real h = (fret_real)t->r[i + 1] - t->r[i], s = ((fret_real)t->f[i + 1] - t->f[i]) / h;
        t->d1[i] = (double)(2 * (3 * s - 2 * (fret_real)t->d0[i] - t->d0[i + 1]) / h);
        t->d2[i] = (double)(3 * ((fret_real)t->d0[i] + t->d0[i + 1] - 2 * s) / (h * h));
    }
}

/* ---- many rows --------------------------------------------------------------------------------- */

enum { MANY = 2000 };

/* True if the cubic between rows i and j is within a part `within` of f, or of 1e-3 `most` if f is less, at
 * all rows between and halfway from row to row. */
static bool spans(const struct fret_table *t, size_t i, size_t j, double within, double most) {
    static const double little = 1e-3;
    const fret_real h = (fret_real)t->r[j] - t->r[i], s = ((fret_real)t->f[j] - t->f[i]) / h;
    const double c1 = (double)((3 * s - 2 * (fret_real)t->d0[i] - t->d0[j]) / h),
                 c2 = (double)(((fret_real)t->d0[i] + t->d0[j] - 2 * s) / (h * h));
    for (size_t k = i; k < j; k++)
        for (int half = 0; half < 2; half++) {
            const double x = half * (t->r[k + 1] - t->r[k]) / 2, u = t->r[k] - t->r[i] + x,
                         f = t->f[k] + x * (t->d0[k] + x * (t->d1[k] / 2 + x * t->d2[k] / 3)),
                         cubic = t->f[i] + u * (t->d0[i] + u * (c1 + u * c2));
            if (!(fabs(cubic - f) <= within * fmax(fabs(f), little * most)))
                return false;
        }
    return true;
}

/* The last row up to `last` that a piece from row i may span: by doubling the step, then bisection. */
static size_t reach_of(const struct fret_table *t, size_t i, size_t last, double within, double most) {
    size_t step = 1;
    while (i + 2 * step <= last && spans(t, i, i + 2 * step, within, most))
        step *= 2;
    size_t near = i + step, far = i + 2 * step < last ? i + 2 * step : last + 1;
    while (far - near > 1) {
        const size_t middle = near + (far - near) / 2;
        *(spans(t, i, middle, within, most) ? &near : &far) = middle;
    }
    return near;
}

/* Thins the rows and returns how many remain; only counts them unless `keep`. The flat end keeps its
 * radius. */
static size_t thin_out(struct fret_table *t, double within, double most, bool keep) {
    size_t left = 1;
    for (size_t i = 0; i + 1 < t->count && !stopped(t); left++) {
        i = reach_of(t, i, t->r[i] < t->start ? fret_table_row(t, 0) : t->count - 1, within, most);
        if (keep) {
            t->r[left] = t->r[i];
            t->f[left] = t->f[i];
            t->d0[left] = t->d0[i];
        }
    }
    return left;
}

/* Thins to MANY rows by the smallest of the tolerances that does, else by the largest. */
static void thin(struct fret_table *t) {
    static const double parts[] = {1e-14, 1e-13, 1e-12, 1e-11, 1e-10, 1e-9, 1e-8, 1e-7, 1e-6};
    double most = 0;
    int i = 0;
    for (size_t j = 0; j < t->count; j++)
        most = fmax(most, fabs(t->f[j]));
    while (i < 8 && thin_out(t, parts[i], most, false) > MANY)
        i++;
    const size_t left = thin_out(t, parts[i], most, true);
    if (stopped(t))
        return;
    t->count = left;
    t->within = parts[i];
    hermite_pieces(t);
}

fret_status fret_table_make(const double *r, const double *f, size_t count, fret_stop stop,
                            struct fret_table **out) {
    return fret_table_sloped(r, f, NULL, count, stop, out);
}

fret_status fret_table_sloped(const double *r, const double *f, const double *slope, size_t count,
                              fret_stop stop, struct fret_table **out) {
    for (size_t i = 0; i < count; i++) {
        if (slope && !isfinite(slope[i]))
            return fret_fail(FRET_NOT_FINITE, "slope", slope[i], 0);
        if (!isfinite(r[i]) || !isfinite(f[i]))
            return fret_fail(FRET_NOT_FINITE, isfinite(r[i]) ? "f" : "r", isfinite(r[i]) ? f[i] : r[i], 0);
        if (i ? r[i] <= r[i - 1] : r[0] != 0)
            return fret_fail(FRET_BAD_TABLE, "r", r[i], i ? r[i - 1] : 0);
        if (i == 0 && f[0] != 0)
            return fret_fail(FRET_BAD_TABLE, "f", f[0], 0);
    }
    if (count < 2)
        return fret_fail(FRET_BAD_TABLE, "count", (double)count, 2);
    struct fret_table *t = calloc(1, sizeof *t);
    double *data = t ? malloc(5 * count * sizeof *data) : NULL;
    if (!data) {
        free(t);
        return fret_fail(FRET_NO_MEMORY, NULL, 0, 0);
    }
    *t = (struct fret_table){.count = count,
                             .r = data,
                             .f = data + count,
                             .d0 = data + 2 * count,
                             .d1 = data + 3 * count,
                             .d2 = data + 4 * count,
                             .stop = stop};
    memcpy(t->r, r, count * sizeof *r);
    memcpy(t->f, f, count * sizeof *f);
    if (slope)
        memcpy(t->d0, slope, count * sizeof *slope);
    else
        steffen_slopes(t);
    for (size_t i = 1; i + 1 < count && f[i] == 0; i++)
        t->start = r[i];
    hermite_pieces(t);
    if (count > MANY + 1)
        thin(t);
    if (stopped(t)) {
        fret_table_free(t);
        return fret_fail(FRET_INTERRUPTED, NULL, 0, 0);
    }
    t->stop = NULL;
    *out = t;
    return fret_ok();
}

void fret_table_free(struct fret_table *t) {
    if (t)
        free(t->r);
    free(t);
}

/* The piece that contains r. */
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

fret_real fret_table_f(const struct fret_table *t, fret_real r) {
    size_t i = table_piece(t, r);
    fret_real x = r - t->r[i];
    return t->f[i] + x * (t->d0[i] + x * (t->d1[i] / 2 + x * t->d2[i] / 3));
}

double fret_table_within(const struct fret_table *t) {
    return t->within;
}

size_t fret_table_count(const struct fret_table *t) {
    return t->count;
}

fret_real fret_table_start(const struct fret_table *t) {
    return t->start;
}

fret_real fret_table_end(const struct fret_table *t) {
    return t->r[t->count - 1];
}

size_t fret_table_row_count(const struct fret_table *t, fret_real r) {
    return r < fret_table_end(t) ? table_piece(t, r) + 1 : t->count;
}

bool fret_table_pointed(const struct fret_table *t) {
    return t->d0[0] > 0;
}

bool fret_table_tip(const struct fret_table *t, fret_real r, fret_real factor[3]) {
    if (t->start > 0 || r > t->r[1])
        return false;
    factor[0] = t->d0[0];
    factor[1] = t->d1[0] / 2;
    factor[2] = t->d2[0] / 3;
    return true;
}

/* int f' K and int r f'' K over the contact, in units of its radius a: g = a int f' K, g' their sum. */
typedef struct sums {
    fret_real g, s;
} sums;

/* Adds a piece far from the edge, by eight of its half-widths or more: by Gauss's rule. */
static void add_far(sums *all, const struct fret_table *t, size_t i, fret_real alpha, fret_real a,
                    fret_real away) {
    const fret_real h = (fret_real)t->r[i + 1] - t->r[i];
    for (int j = 0; j < 8; j++) {
        const fret_real x = h * fret_gauss_node[j], r = t->r[i] + x,
                        K = h / a * fret_gauss_weight[j] * fret_pow((away - x) / a * ((a + r) / a), alpha);
        all->g += K * f1_of(t, i, x);
        all->s += K * r * f2_of(t, i, x);
    }
}

/* Adds a piece near or at the edge: by the moments of the kernel between its ends lo and hi. */
static void add_near(sums *all, const struct fret_table *t, size_t i, fret_real a, fret_real v,
                     const fret_edge *lo, const fret_edge *hi) {
    fret_real d1 = t->d1[i] * a, d2 = t->d2[i] * a * a, m[3];
    for (int j = 0; j < 3; j++)
        m[j] = lo->moment[j] - hi->moment[j];
    /* f' and r f'' in powers of the distance from the edge, v being that of the start of the piece */
    all->g += (t->d0[i] + v * (d1 + v * d2)) * m[0] - (d1 + 2 * v * d2) * m[1] + d2 * m[2];
    all->s += (d1 + 2 * v * d2) * (m[0] - m[1]) - 2 * d2 * (m[1] - m[2]);
}

fret_profile fret_table_profile(const struct fret_table *t, const fret_rule *rule, fret_real e) {
    static const fret_real FAR = 8;
    const fret_real alpha = (rule->k - 1) / 2, start = t->start, a = start + e;
    sums all = {0, 0};
    for (size_t i = 0; i + 1 < t->count && (start - t->r[i]) + e > 0; i++) {
        const fret_real half = ((fret_real)t->r[i + 1] - t->r[i]) / 2, away = (start - t->r[i]) + e;
        if (away >= (FAR + 1) * half) {
            add_far(&all, t, i, alpha, a, away);
            continue;
        }
        const fret_edge lo = fret_edge_moments(rule, away / a),
                        hi = fret_edge_moments(rule, ((start - t->r[i + 1]) + e) / a);
        add_near(&all, t, i, a, away / a, &lo, &hi);
    }
    return (fret_profile){a * all.g, all.g + all.s};
}

fret_real fret_table_distance(const struct fret_table *t, size_t row) {
    return (fret_real)t->r[row] - t->start;
}

size_t fret_table_row(const struct fret_table *t, fret_real e) {
    size_t i = table_piece(t, fmaxl(t->start + e, 0));
    while (i > 0 && fret_table_distance(t, i) > e)
        i--;
    return i;
}

void fret_table_slope(const struct fret_table *t, size_t row, fret_real c[3]) {
    c[0] = t->d0[row];
    c[1] = t->d1[row];
    c[2] = t->d2[row];
}

void fret_table_jump(const struct fret_table *t, size_t row, fret_real c[3]) {
    const fret_real h = (fret_real)t->r[row] - t->r[row - 1];
    c[0] = 0;
    c[1] = t->d1[row] - (t->d1[row - 1] + 2 * h * t->d2[row - 1]);
    c[2] = (fret_real)t->d2[row] - t->d2[row - 1];
}
