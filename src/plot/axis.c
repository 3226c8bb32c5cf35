/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Limits of axes, steps of tics, levels of contours. Depends on script.h. */
#include <float.h>
#include <math.h>

#include "plot/script.h"

/* Relative difference below which two numbers are equal but for rounding. */
static const double same = 1e-9;

static void span(plot_extent *e, double v, bool log) {
    if (isfinite(v) && (!log || v > 0)) {
        e->lo = fmin(e->lo, v);
        e->hi = fmax(e->hi, v);
    }
}

/* Is x monotonic? Gaps (NaN) do not count. */
static bool one_way(const plot_series *s) {
    bool up = true, down = true;
    for (size_t i = 1; i < s->count; i++) {
        up &= !(s->x[i] < s->x[i - 1]);
        down &= !(s->x[i] > s->x[i - 1]);
    }
    return up || down;
}

/* Is v within the limits? lo > hi: an axis from right to left. */
static bool inside(double v, double lo, double hi) {
    return lo > hi ? inside(v, hi, lo) : !(v < lo) && !(v > hi);
}

static plot_extents extent_of(const plot_panel *p) {
    plot_extents e = {{INFINITY, -INFINITY, !p->airy}, {INFINITY, -INFINITY, true}};
    for (size_t j = 0; j < p->count; j++) {
        const plot_series *s = p->series[j];
        if (s->role == PLOT_MEASURED || (s->role == PLOT_CURVE && !one_way(s)))
            e.x.graph = false;
        for (size_t i = 0; i < s->count; i++) {
            /* points outside the limits of x are not shown and must not widen y */
            if (!isfinite(s->x[i]) || !isfinite(s->y[i]) || !inside(s->x[i], p->xlo, p->xhi))
                continue;
            span(&e.x, s->x[i], p->logx);
            span(&e.y, s->y[i], p->logy);
            if (s->y2)
                span(&e.y, s->y2[i], p->logy);
        }
    }
    for (size_t i = 0; i < p->map.nx; i++)
        span(&e.x, p->map.x[i], p->logx);
    for (size_t i = 0; i < p->map.ny; i++)
        span(&e.y, p->map.y[i], p->logy);
    e.y.graph = p->map.nx > 0; /* a map fills its frame */
    return e;
}

plot_extents plot_settle(plot_panel *p) {
    const plot_extents e = extent_of(p);
    for (size_t i = 0; i < p->count; i++)
        plot_thin(p->series[i], p->series[i]->role == PLOT_MEASURED ? PLOT_MARKS : PLOT_WRITTEN);
    return e;
}

static plot_extent join(plot_extent a, plot_extent b) {
    return (plot_extent){fmin(a.lo, b.lo), fmax(a.hi, b.hi), a.graph && b.graph};
}

plot_extents plot_extent_join(plot_extents a, plot_extents b) {
    return (plot_extents){join(a.x, b.x), join(a.y, b.y)};
}

/* Widens the limits that are not fixed. */
static void widen(plot_axis *a, bool tight) {
    double lo = a->log ? log10(a->lo) : a->lo, hi = a->log ? log10(a->hi) : a->hi;
    double most = fmax(fabs(lo), fabs(hi)), width = hi - lo;
    double below = 0, above = 0;
    if (!(width > same * most)) { /* one value */
        below = above = a->log ? 0.5 : most > 0 ? 0.1 * most : 1;
    } else if (!tight) {
        below = above = 0.05 * width;
        /* an axis that begins close to 0 begins at 0 */
        if (!a->log && lo >= 0 && lo < 0.05 * width)
            below = lo;
        if (!a->log && hi <= 0 && -hi < 0.05 * width)
            above = -hi;
    }
    if (!a->fixed_lo)
        a->lo = a->log ? a->lo / pow(10, below) : lo - below;
    if (!a->fixed_hi)
        a->hi = a->log ? a->hi * pow(10, above) : hi + above;
}

static bool limits(const char *name, plot_axis *a, plot_extent e, double lo, double hi, bool airy,
                   calc_error *error) {
    a->fixed_lo = isfinite(lo);
    a->fixed_hi = isfinite(hi);
    a->lo = a->fixed_lo ? lo : e.lo;
    a->hi = a->fixed_hi ? hi : e.hi;
    if (a->log && ((a->fixed_lo && lo <= 0) || (a->fixed_hi && hi <= 0)))
        return calc_fail(error, 0, 0, "a logarithmic %s axis needs limits above 0", name);
    if (a->fixed_lo && a->fixed_hi && lo == hi)
        return calc_fail(error, 0, 0, "the limits of the %s axis are the same", name);
    if (a->fixed_lo && a->fixed_hi && lo > hi) { /* from right to left */
        a->lo = hi;
        a->hi = lo;
        a->flip = !a->flip;
    }
    if (!(a->lo <= a->hi))
        return calc_fail(error, 0, 0,
                         isfinite(e.lo) ? "nothing lies within the limits of the %s axis"
                         : a->log       ? "there is nothing above 0 to plot on a logarithmic %s axis"
                                        : "there is nothing to plot along %s",
                         name);
    widen(a, e.graph || !airy);
    /* gnuplot computes differences of limits, which must not overflow or underflow */
    if (!(fabs(a->lo) < 1e300 && fabs(a->hi) < 1e300 && (a->lo == 0 || fabs(a->lo) > DBL_MIN) &&
          (a->hi == 0 || fabs(a->hi) > DBL_MIN)))
        return calc_fail(error, 0, 0, "the numbers along %s are too large or too small to plot", name);
    return true;
}

bool plot_axes(const plot_panel *p, const plot_extents *e, bool airy, plot_axis *x, plot_axis *y,
               calc_error *error) {
    *x = (plot_axis){.log = p->logx, .flip = p->flipx};
    *y = (plot_axis){.log = p->logy, .flip = p->flipy};
    return limits("x", x, e->x, p->xlo, p->xhi, airy, error) &&
           limits("y", y, e->y, p->ylo, p->yhi, airy, error);
}

size_t plot_columns(const plot_figure *f) {
    size_t n = 0;
    for (size_t i = 0; i < f->count; i++)
        n += !f->panel[i]->below;
    return n;
}

double plot_part(const plot_axis *a, double v) {
    return a->log ? log(v / a->lo) / log(a->hi / a->lo) : (v - a->lo) / (a->hi - a->lo);
}

double plot_step(double least) {
    double power = pow(10, floor(log10(least)));
    static const double steps[] = {1, 2, 5};
    for (size_t i = 0; i < sizeof steps / sizeof *steps; i++)
        if (steps[i] * power >= least * (1 - same))
            return steps[i] * power;
    return 10 * power;
}

size_t plot_log_tics(const plot_axis *a, double at[PLOT_TICS]) {
    const bool wide = a->hi > 5 * a->lo;
    const double step = plot_step((a->hi - a->lo) / 5);
    size_t n = 0;
    for (double v = wide ? plot_step(a->lo) : ceil(a->lo / step - same) * step;
         v <= a->hi * (1 + same) && n < PLOT_TICS; v = wide ? plot_step(1.5 * v) : v + step)
        at[n++] = v;
    return n;
}

size_t plot_levels(const plot_map *m, double *level, size_t room) {
    double lo = INFINITY, hi = -INFINITY;
    for (size_t i = 0; i < m->nx * m->ny; i++)
        if (isfinite(m->z[i])) {
            lo = fmin(lo, m->z[i]);
            hi = fmax(hi, m->z[i]);
        }
    size_t n = 0;
    if (!(hi - lo > same * fmax(fabs(lo), fabs(hi))))
        return 0;
    if (lo > 0 && hi / lo > 300) { /* at powers of ten, and at 2 and 5 times these if there is room */
        const double decades = log10(hi / lo), skip = ceil(decades / ((double)room - 1));
        const bool fine = 3 * decades < (double)room - 1;
        for (double v = pow(10, floor(log10(lo))); v < hi && n < room;
             v = fine ? plot_step(1.5 * v) : v * pow(10, skip))
            if (v > lo)
                level[n++] = v;
        return n;
    }
    double step = plot_step((hi - lo) / (double)room);
    for (double k = floor(lo / step) + 1; k * step < hi && n < room; k++)
        level[n++] = k * step;
    return n;
}
