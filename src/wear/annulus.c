/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The wear rate of each node: pressure and slip of the springs, by matrices that are made once. Allocates and
 * frees annuli; uses `law` and `number`. */
#include "wear/annulus.h"

#include <math.h>
#include <stdlib.h>

#include "law/check.h"
#include "law/normal.h"
#include "number/real.h"

/* The scalar product in four partial sums, which compilers vectorise. */
static double dot(const double *a, const double *b, size_t n) {
    double s[4] = {0, 0, 0, 0};
    size_t i = 0;
    for (; i + 4 <= n; i += 4)
        for (size_t j = 0; j < 4; j++)
            s[j] += a[i + j] * b[i + j];
    for (; i < n; i++)
        s[0] += a[i] * b[i];
    return s[0] + s[1] + (s[2] + s[3]);
}

static double *row_g(const fret_annulus *a, size_t i) {
    const size_t n = a->count, within = i < n ? i : n;
    return a->to_g + within * (within - 1) / 2 + (i - within) * (n - 1);
}
static double *row_p(const fret_annulus *a, size_t i) {
    return a->to_p + i * (a->count - 1) - i * (i + 1) / 2 + i;
}

/* int_a^b s^(m-1) ds, and its first moment about the middle of a..b. */
static fret_real between(fret_real m, fret_real a, fret_real b, fret_real *moment) {
    const fret_real from = a > 0 ? fret_pow(a, m) : 0, to = fret_pow(b, m), whole = (to - from) / m;
    *moment = (b * to - a * from) / (m + 1) - (a + b) / 2 * whole;
    return whole;
}

/* ---- making ------------------------------------------------------------------------------------ */

/* Places nodes densest at `steep`, an eighth of them inside it, or evenly where steep = 0 (slip reaches the
 * axis); beyond the ring the spacing grows outwards. */
static void make_places(fret_annulus *a, fret_real inner, fret_real steep, fret_real outer, fret_real second,
                        fret_real end) {
    const size_t n = a->count, within = steep > inner ? n / 8 : 0;
    for (size_t i = 0; i < a->rows; i++) {
        const fret_real u = i < within ? 1 - (fret_real)i / (fret_real)within
                            : i < n    ? (fret_real)(i - within) / (fret_real)(n - 1 - within)
                                       : (fret_real)(i + 1 - n) / (fret_real)(a->rows - n),
                        part = (steep > 0 ? u : 1) * u * (3 - u) / 2, far = i < within ? inner : outer;
        a->x[i] = i < n ? steep + part * (far - steep) : outer + (end - outer) * u * u;
    }
    a->x[0] = inner;
    a->x[1] = fminl(a->x[1], second);
}

/* Row of node i: factors of the change of f (or w) in the cells from..to, the integral of f' times the
 * distance in t to the power m - 1. Within a cell f' varies linearly, with the slope between the middles of
 * its neighbours (its own at an end): errors are of second order instead of 1 + m. */
static void make_row(const fret_annulus *a, fret_real m, size_t i, size_t from, size_t to, double *row) {
    const fret_real *x = a->x;
    for (size_t j = from; j <= to; j++) {
        const bool within = j < i;
        const size_t nearer = within ? j + 1 : j, l = j > from ? j - 1 : j, r = j < to ? j + 1 : j;
        const fret_real near = within ? (x[i] - x[nearer]) * (x[i] + x[nearer])
                                      : (x[nearer] - x[i]) * (x[nearer] + x[i]),
                        d = (x[j + 1] - x[j]) * (x[j + 1] + x[j]);
        fret_real moment;
        const fret_real whole = between(m, near, near + d, &moment);
        row[j - from] += (double)(whole / d);
        if (l == r)
            continue;
        const double bend =
            (within ? -2 : 2) * (double)moment / (a->t[r + 1] + a->t[r] - a->t[l + 1] - a->t[l]);
        row[r - from] += bend / (a->t[r + 1] - a->t[r]);
        row[l - from] -= bend / (a->t[l + 1] - a->t[l]);
    }
}

static void make_weights(fret_annulus *a, fret_real m, fret_real stiff) {
    const fret_real *x = a->x;
    for (size_t j = 0; j + 1 < a->count; j++) {
        fret_real moment;
        const fret_real whole = between(m, x[j] * x[j], x[j + 1] * x[j + 1], &moment),
                        lean = moment / ((x[j + 1] - x[j]) * (x[j + 1] + x[j]));
        a->weight[j] += (double)(stiff * (whole / 2 - lean));
        a->weight[j + 1] += (double)(stiff * (whole / 2 + lean));
        make_row(a, m, j, j, a->count - 2, row_p(a, j));
    }
    for (size_t i = 1; i < a->rows; i++)
        make_row(a, m, i, 0, (i < a->count ? i : a->count - 1) - 1, row_g(a, i));
}

fret_status fret_annulus_make(const fret_normal *normal, const fret_wear_held *held, fret_real inner,
                              fret_real steep, fret_real outer, fret_real second, size_t count,
                              fret_annulus *out) {
    enum { BEYOND = 64 };
    const fret_foundation *f = fret_normal_foundation(normal);
    const fret_point start = fret_law_at_radius(normal, inner);
    const fret_real m = (f->k + 1) / 2, stiff = f->cN0 * fret_pow(f->c0, -f->k),
                    end = fminl(fret_normal_end(normal), 4 * outer);
    const size_t rows = count + (end > outer ? BEYOND : 0), half = count * (count - 1) / 2;
    double **const part[] = {&out->t, &out->g0,   &out->x1k, &out->weight, &out->g,
                             &out->w, &out->slip, &out->p,   &out->change};
    enum { PARTS = sizeof part / sizeof *part };
    *out = (fret_annulus){.count = count, .rows = rows, .of_slope = (double)(stiff / FRET_PI)};
    out->x = calloc(rows, sizeof *out->x);
    out->t = calloc(PARTS * rows + 2 * half + (rows - count) * (count - 1), sizeof *out->t);
    if (!out->x || !out->t)
        return fret_fail(FRET_NO_MEMORY, NULL, 0, 0);
    for (size_t i = 1; i < PARTS; i++)
        *part[i] = out->t + i * rows;
    out->to_p = out->t + PARTS * rows;
    out->to_g = out->to_p + half;
    make_places(out, inner, steep, outer, second, end);
    for (size_t i = 0; i < rows; i++) {
        const fret_real x = out->x[i];
        out->t[i] = (double)((x - inner) * (x + inner));
        out->g0[i] = (double)(fret_normal_profile(normal, x) - start.y);
        out->x1k[i] = (double)fret_pow(x, 1 - f->k);
    }
    make_weights(out, m, stiff);
    out->inner = (double)fret_normal_stiffness(normal, inner);
    out->within = (double)start.F;
    out->by_depth = held->by_depth;
    out->by_displacement = held->by_displacement;
    out->press = (double)(held->press - (held->by_depth ? start.y : start.F));
    out->mu = held->mu;
    out->eta = (double)f->eta;
    out->amplitude = held->amplitude / (held->mu * (held->by_displacement ? out->eta : 1));
    out->alpha = held->alpha;
    return fret_ok();
}

void fret_annulus_free(fret_annulus *a) {
    free(a->t); /* all arrays are one allocation */
    free(a->x);
}

/* ---- the rate ---------------------------------------------------------------------------------- */

/* The change of g by the worn depths h. A uniform depth h[0] adds itself. */
static void added_profile(fret_annulus *a, const double *h, size_t rows) {
    for (size_t j = 0; j + 1 < a->count; j++)
        a->change[j] = h[j + 1] - h[j];
    a->g[0] = h[0];
    for (size_t i = 1; i < rows; i++)
        a->g[i] = h[0] + a->x1k[i] * dot(row_g(a, i), a->change, i < a->count ? i : a->count - 1);
}

static void worn_profile(fret_annulus *a, const double *h, size_t rows) {
    added_profile(a, h, rows);
    for (size_t i = 0; i < rows; i++)
        a->g[i] += a->g0[i];
}

static void pressures(const fret_annulus *a, const double *change, size_t last, double *p) {
    for (size_t i = 0; i < a->count; i++)
        p[i] = i < last ? a->of_slope * dot(row_p(a, i), change + i, last - i) : 0;
}

/* The compression of spring i at a depth. Springs up to `touched` may pull; others press where reached. */
static double pressed(const fret_annulus *a, size_t i, size_t touched, double depth) {
    return i <= touched || a->g[i] < depth ? depth - a->g[i] : 0;
}

/* The depth at a normal force, by Newton's method from `depth`: F_N is convex and piecewise linear, so that
 * it ends after finitely many steps. */
static double depth_of(const fret_annulus *a, double load, size_t touched, double depth) {
    double step = INFINITY;
    for (int i = 0; i < 100 && fabs(step) > 1e-15 * fabs(depth); i++) {
        double left = load - a->inner * depth, K = a->inner;
        for (size_t j = 0; j < a->count; j++)
            if (j <= touched || a->g[j] < depth) {
                left -= a->weight[j] * (depth - a->g[j]);
                K += a->weight[j];
            }
        step = left / K;
        depth += step;
    }
    return depth;
}

/* The depth under what is held; a held depth counts from the worn tip. */
static double press_depth(const fret_annulus *a, size_t touched) {
    return a->by_depth ? a->press + a->g[0] : depth_of(a, a->press, touched, a->depth);
}

const double *fret_annulus_profile(fret_annulus *a, const double *h, double *depth) {
    worn_profile(a, h, a->rows);
    *depth = press_depth(a, 0) - a->g[0]; /* as if no spring had been touched before */
    return a->g;
}

/* The depth range that slips at the turning point, delta_A/(mu eta). F_A held: what sticks carries F_N -
 * F_A/mu. */
static fret_status find_slipped(const fret_annulus *a, double *slipped) {
    double load = a->inner * a->depth;
    for (size_t i = 0; i < a->count; i++)
        load += a->weight[i] * a->w[i];
    if (!a->by_displacement && a->amplitude > (load + a->within) * (1 + 1e-12))
        return fret_fail(FRET_GROSS_SLIP, "FA", a->amplitude * a->mu, a->mu * (load + a->within));
    *slipped = a->by_displacement ? a->amplitude : a->depth - depth_of(a, load - a->amplitude, 0, a->depth);
    if (a->inner > 0 || !a->by_displacement) /* the springs inside the inner end stick */
        *slipped = fmin(*slipped, a->depth - a->g[0]);
    return fret_ok();
}

/* The gap f of a profile g: inverts added_profile row by row. */
static void gap_of(fret_annulus *a, const double *g, double *f) {
    f[0] = g[0];
    for (size_t i = 1; i < a->count; i++) {
        const double *row = row_g(a, i);
        a->change[i - 1] = ((g[i] - g[0]) / a->x1k[i] - dot(row, a->change, i - 1)) / row[i - 1];
        f[i] = f[i - 1] + a->change[i - 1];
    }
}

fret_status fret_annulus_rate(fret_annulus *a, const double *h, double *rate) {
    double slipped, work = 0;
    size_t last = a->touched;
    worn_profile(a, h, a->count);
    a->depth = press_depth(a, a->touched);
    for (size_t i = 0; i < a->count; i++) {
        a->w[i] = pressed(a, i, a->touched, a->depth);
        last = a->w[i] > 0 && i > last ? i : last;
    }
    const fret_status st = find_slipped(a, &slipped);
    if (st.code)
        return st;
    for (size_t j = 0; j + 1 < a->count; j++)
        a->change[j] = a->w[j] - a->w[j + 1];
    pressures(a, a->change, last + 1 < a->count ? last + 1 : last, a->p);
    for (size_t i = 0; i < a->count; i++)
        a->g[i] = a->mu * a->eta * fmax(slipped - a->w[i], 0);
    gap_of(a, a->g, a->slip); /* the surface slip follows from that of the springs as f from g */
    for (size_t i = 0; i < a->count; i++) {
        rate[i] = 4 * a->mu * a->alpha * a->p[i] * a->slip[i];
        work += a->weight[i] * a->w[i] * fmax(slipped - a->w[i], 0);
    }
    rate[a->count] = 4 * a->mu * a->mu * a->eta * work;
    return fret_ok();
}

void fret_annulus_touch(fret_annulus *a) {
    for (size_t i = a->touched; i < a->count; i++)
        if (a->w[i] > 0)
            a->touched = i;
}

double fret_annulus_norm(const fret_annulus *a, const double *h) {
    double sum = 0;
    for (size_t i = 0; i + 1 < a->count; i++)
        sum += h[i + 1] * h[i + 1] * (a->t[i + 1] - a->t[i]);
    return sqrt(sum);
}

fret_real fret_annulus_volume(const fret_annulus *a, const double *h) {
    fret_real sum = 0;
    for (size_t i = 0; i + 1 < a->count; i++)
        sum += FRET_PI / 2 * ((fret_real)h[i] + h[i + 1]) * (a->x[i + 1] - a->x[i]) * (a->x[i + 1] + a->x[i]);
    return sum;
}

double fret_annulus_stiffness(fret_annulus *a, double *v) {
    double found = 0;
    for (int n = 0; n < 60; n++) {
        const double size = sqrt(dot(v, v, a->count)), before = found;
        for (size_t i = 0; i < a->count; i++)
            v[i] = size > 0 ? v[i] / size : i % 2 ? -1 : 1;
        added_profile(a, v, a->count);
        for (size_t j = 0; j + 1 < a->count; j++)
            a->change[j] = a->g[j + 1] - a->g[j];
        pressures(a, a->change, a->count - 1, a->p);
        for (size_t i = 0; i < a->count; i++)
            v[i] = 4 * a->mu * a->alpha * a->slip[i] * a->p[i];
        found = sqrt(dot(v, v, a->count));
        if (size > 0 && fabs(found - before) < 0.01 * found)
            break;
    }
    return 1.2 * found;
}
