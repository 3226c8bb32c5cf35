/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Noise by differences, turning points by a threshold, levels by fitted curves. Depends on number/array. */
#include "measured/turning.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "number/array.h"

bool turning_noise(const double *v, size_t n, double *noise, calc_error *error) {
    enum { ORDER = 6 };
    double *d = malloc((2 * n + 1) * sizeof *d), binomial = 1; /* (2k over k) */
    if (!d)
        return calc_no_memory(error);
    *noise = n > 2 * ORDER ? INFINITY : 0;
    memcpy(d, v, n * sizeof *d);
    for (size_t k = 1; k <= ORDER && n > 2 * ORDER; k++) {
        double *size = d + n;
        for (size_t i = 0; i + k < n; i++)
            d[i] = d[i + 1] - d[i];
        binomial *= 2 * (2 * (double)k - 1) / (double)k;
        if (k % 2)
            continue;
        for (size_t i = 0; i + k < n; i++)
            size[i] = fabs(d[i]);
        qsort(size, n - k, sizeof *size, fret_ascending);
        *noise = fmin(*noise, size[(n - k) / 2] / (0.6745 * sqrt(binomial)));
    }
    free(d);
    return true;
}

/* How far v must come back for a turning point. */
static double threshold(const double *v, size_t n, double noise) {
    double lo = v[0], hi = v[0], step = INFINITY;
    for (size_t i = 1; i < n; i++) {
        lo = fmin(lo, v[i]);
        hi = fmax(hi, v[i]);
        step = v[i] != v[i - 1] ? fmin(step, fabs(v[i] - v[i - 1])) : step;
    }
    const double range = hi - lo;
    return fmax(fmin(0.25 * range, 8 * noise), fmin(0.1 * range, 2.5 * step));
}

size_t turning_points(const double *v, size_t n, double noise, size_t *at) {
    const double back = threshold(v, n, noise);
    size_t count = 0, hi = 0, lo = 0;
    int direction = 0; /* of v; 0: not known yet */
    for (size_t i = 1; i < n; i++) {
        hi = v[i] > v[hi] ? i : hi;
        lo = v[i] < v[lo] ? i : lo;
        if (direction >= 0 && v[hi] - v[i] > back) {
            if (direction > 0)
                at[count++] = hi;
            direction = -1;
            lo = i;
        } else if (direction <= 0 && v[i] - v[lo] > back) {
            if (direction < 0)
                at[count++] = lo;
            direction = 1;
            hi = i;
        }
    }
    return count;
}

bool turning_parabola(const double *x, const double *y, size_t n, double x0, bool line, double c[3]) {
    long double M[3][4] = {{0}}, size = 0; /* the normal equations, their right side behind */
    const size_t terms = n < 4 || line ? 2 : 3;
    for (size_t i = 0; i < n; i++)
        size = fmaxl(size, fabsl((long double)x[i] - x0));
    for (size_t i = 0; i < n && size > 0; i++) {
        const long double u = ((long double)x[i] - x0) / size, power[] = {1, u, u * u},
                          v = (long double)y[i] - y[0];
        for (size_t k = 0; k < terms; k++) {
            for (size_t l = 0; l < terms; l++)
                M[k][l] += power[k] * power[l];
            M[k][3] += power[k] * v;
        }
    }
    c[2] = 0;
    for (size_t k = 0; k < terms; k++) { /* positive definite: no pivots */
        if (!(M[k][k] > 1e-12L * (long double)n))
            return false;
        for (size_t r = 0; r < terms; r++)
            for (size_t l = 4; l-- > k && r != k;)
                M[r][l] -= M[r][k] / M[k][k] * M[k][l];
    }
    for (size_t k = 0; k < terms; k++)
        c[k] = (double)(M[k][3] / M[k][k] / powl(size, (long double)k));
    c[0] += y[0];
    return true;
}

turning turning_about(const double *v, size_t row, size_t from, size_t to, double noise) {
    enum { MOST = TURNING_MOST, LEAST = 5 };
    double at[MOST], c[3];
    size_t first = row, last = row;
    while (first > from && last - first + 1 < MOST / 2 && fabs(v[first - 1] - v[row]) <= 6 * noise)
        first--;
    while (last < to && last - first + 1 < MOST && fabs(v[last + 1] - v[row]) <= 6 * noise)
        last++;
    const size_t n = last - first + 1;
    for (size_t i = 0; i < n; i++)
        at[i] = (double)i;
    const double here = (double)(row - first);
    if (n < LEAST || !turning_parabola(at, v + first, n, here, false, c))
        return (turning){.first = row, .n = 1};
    const double top = c[2] != 0 ? here - c[1] / (2 * c[2]) : here;
    return (turning){.first = first, .n = n, .here = here, .top = fmin(fmax(top, 0), (double)(n - 1))};
}

/* Least squares for h + p min(u, 0) + q max(u, 0), u = i - top: a, b, c are the weights of the values in h,
 * from the inverse of the normal equations. False: one side has no rows. */
static bool set_ridge(turning *t, double top) {
    double left[2] = {0}, right[2] = {0}; /* sums of u, u^2 */
    for (size_t i = 0; i < t->n; i++) {
        const double u = (double)i - top;
        double *side = u < 0 ? left : right;
        side[0] += u;
        side[1] += u * u;
    }
    t->sharp = true;
    t->top = top;
    if (!(left[1] > 0 && right[1] > 0))
        return false;
    t->a = 1 / ((double)t->n - left[0] * left[0] / left[1] - right[0] * right[0] / right[1]);
    t->b = -t->a * left[0] / left[1];
    t->c = -t->a * right[0] / right[1];
    return t->a > 0;
}

double turning_weight(const turning *t, size_t i) {
    const double rows = (double)t->n, square = rows * rows, middle = (rows - 1) / 2, mean = (square - 1) / 12,
                 x = t->top - middle, u = (double)i - middle;
    if (t->n == 1)
        return 1;
    const double off = (double)i - t->top;
    if (t->sharp)
        return t->a + (off < 0 ? t->b : t->c) * off;
    return 1 / rows + x * u / (rows * mean) +
           (x * x - mean) * (u * u - mean) / (rows * mean * (square - 4) / 15);
}

double turning_crest(const double *v, const turning *t) {
    const double *at = v + t->first;
    double level = 0;
    for (size_t i = 0; i < t->n; i++)
        level += turning_weight(t, i) * (at[i] - at[0]);
    return at[0] + level;
}

/* The residual sum of squares of the two lines. */
static double ridge_left(const double *v, const turning *t) {
    const double crest = turning_crest(v, t);
    double slope[2] = {0}, square[2] = {0}, squares = 0;
    for (size_t i = 0; i < t->n; i++) {
        const double u = (double)i - t->top;
        slope[u >= 0] += u * (v[t->first + i] - crest);
        square[u >= 0] += u * u;
    }
    for (size_t i = 0; i < t->n; i++) {
        const double u = (double)i - t->top,
                     off = v[t->first + i] - crest - slope[u >= 0] / square[u >= 0] * u;
        squares += off * off;
    }
    return squares;
}

double turning_sharpen(const double *v, turning *t) {
    const turning before = *t;
    double best = t->top, least = INFINITY;
    for (size_t k = 4; k + 4 <= 4 * (t->n - 1) && t->n > 1; k++) {
        const double left = set_ridge(t, (double)k / 4) ? ridge_left(v, t) : INFINITY;
        if (left < least) {
            least = left;
            best = t->top;
        }
    }
    if (!isfinite(least) || !set_ridge(t, best))
        *t = before;
    return least;
}

double turning_residual(const double *v, const turning *t) {
    double at[TURNING_MOST] = {0}, c[3], squares = 0;
    for (size_t i = 0; i < t->n; i++)
        at[i] = (double)i;
    if (t->n == 1 || !turning_parabola(at, v + t->first, t->n, 0, false, c))
        return INFINITY;
    for (size_t i = 0; i < t->n; i++) {
        const double off = v[t->first + i] - c[0] - at[i] * (c[1] + at[i] * c[2]);
        squares += off * off;
    }
    return squares;
}

double turning_level(const double *v, size_t row, size_t from, size_t to, double noise, bool crest) {
    turning t = turning_about(v, row, from, to, noise);
    t.top = crest ? t.top : t.here;
    return turning_crest(v, &t);
}
