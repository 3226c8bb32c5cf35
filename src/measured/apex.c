/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Minimises the asymmetry of a profile, over a grid of positions and then within it. Depends on number. */
#include "measured/apex.h"

#include <math.h>
#include <stdlib.h>

#include "number/array.h"
#include "number/least.h"

typedef struct place {
    double r, f;
} place;

/* `square`: mean square of f(x+d) - f(x-d) - 2 tilt d; `relative`: that over the variance of f(x+d) + f(x-d),
 * which is tiny on a flank, symmetric but for a tilt. */
typedef struct asymmetry {
    double relative, square, tilt;
    size_t pairs;
} asymmetry;

static const double rounding = 1e-12; /* relative rounding error of a difference of sums of squares */

/* The parabola through three places; the value of the middle one if two of them coincide. */
static double interpolate(const place *p, double r) {
    const double a = p[0].r, b = p[1].r, c = p[2].r;
    if (!(a < b && b < c))
        return p[1].f;
    return p[0].f * (r - b) * (r - c) / ((a - b) * (a - c)) +
           p[1].f * (r - a) * (r - c) / ((b - a) * (b - c)) +
           p[2].f * (r - a) * (r - b) / ((c - a) * (c - b));
}

static asymmetry asymmetry_about(const place *p, size_t n, double x, bool tilted) {
    asymmetry a = {INFINITY, INFINITY, 0, 0};
    double DD = 0, Dd = 0, dd = 0, E = 0, EE = 0;
    size_t right = 0;
    while (right < n && p[right].r <= x)
        right++;
    for (size_t left = right; right < n; right++) {
        const double d = p[right].r - x;
        while (left > 0 && p[left - 1].r > x - d)
            left--;
        if (left == 0)
            break;
        const size_t first = left + 1 < n ? left - 1 : n - 3;
        const double other = interpolate(p + first, x - d), D = p[right].f - other,
                     S = p[right].f + other - 2 * p[n / 2].f;
        E += S;
        EE += S * S;
        DD += D * D;
        Dd += D * d;
        dd += d * d;
        a.pairs++;
    }
    if (a.pairs < 4 + (size_t)tilted)
        return a;
    a.tilt = tilted ? Dd / dd / 2 : 0;
    const double varies = (EE - E * E / (double)a.pairs) / (double)(a.pairs - 1);
    a.square = fmax(0, DD - 2 * a.tilt * Dd) / (double)(a.pairs - 1 - tilted);
    a.relative = varies > rounding * (DD + EE) ? a.square / varies : INFINITY;
    return a;
}

typedef struct sought {
    const place *p;
    size_t n;
    bool tilted;
} sought;

static fret_real relative_about(fret_real x, fret_real *slope, void *context) {
    const sought *s = context;
    (void)slope;
    return asymmetry_about(s->p, s->n, (double)x, s->tilted).relative;
}

/* The position of the least asymmetry, at least a tenth of the length away from both ends. */
static asymmetry least(const place *p, size_t n, bool tilted, double *at) {
    enum { PLACES = 160 };
    sought s = {p, n, tilted};
    const double first = 0.9 * p[0].r + 0.1 * p[n - 1].r, step = 0.8 * (p[n - 1].r - p[0].r) / (double)PLACES;
    asymmetry best = {INFINITY, INFINITY, 0, 0};
    for (size_t i = 0; i <= PLACES; i++) {
        const asymmetry now = asymmetry_about(p, n, first + (double)i * step, tilted);
        if (now.relative < best.relative) {
            best = now;
            *at = first + (double)i * step;
        }
    }
    *at = (double)fret_least(relative_about, &s, *at - step, *at + step, *at, 1e-12L);
    return asymmetry_about(p, n, *at, tilted);
}

/* Do both ends rise by a tenth of the height above the lowest place, by means over 5 % of the places? */
static bool rises_on_both(const place *p, size_t n) {
    const size_t part = n / 20 + 1;
    double low = INFINITY, high = -INFINITY, first = 0, last = 0;
    for (size_t i = 0; i + part <= n; i += part) {
        double mean = 0;
        for (size_t j = i; j < i + part; j++)
            mean += p[j].f / (double)part;
        first = i == 0 ? mean : first;
        last = mean;
        low = fmin(low, mean);
        high = fmax(high, mean);
    }
    return first - low > 0.1 * (high - low) && last - low > 0.1 * (high - low);
}

/* Is the asymmetry larger than the least by 12 standard deviations of a mean square of as many pairs? */
static bool exceeds(const asymmetry *a, const asymmetry *least_of_all) {
    return a->relative > rounding &&
           !(a->square <= least_of_all->square * (1 + 12 * sqrt(2 / (double)least_of_all->pairs)));
}

bool apex_find(double *r, double *f, size_t rows, apex *out, calc_error *error) {
    *out = (apex){.moved = false};
    place *p = malloc((rows + 1) * sizeof *p);
    if (!p)
        return calc_no_memory(error);
    for (size_t i = 0; i < rows; i++)
        p[i] = (place){r[i], f[i]};
    qsort(p, rows, sizeof *p, fret_ascending);
    if (rows >= 8 && p[0].r < p[rows - 1].r && rises_on_both(p, rows)) {
        double at = 0, tilted_at = 0;
        const asymmetry plain = least(p, rows, false, &at), tilted = least(p, rows, true, &tilted_at),
                        here = asymmetry_about(p, rows, 0, false);
        out->tilted = exceeds(&plain, &tilted) && 2 * tilted.pairs > plain.pairs;
        out->at = out->tilted ? tilted_at : at;
        out->tilt = out->tilted ? tilted.tilt : 0;
        out->moved = out->tilted || exceeds(&here, &plain);
    }
    free(p);
    for (size_t i = 0; i < rows && out->moved; i++) {
        r[i] -= out->at;
        f[i] -= out->tilt * r[i];
    }
    return true;
}
