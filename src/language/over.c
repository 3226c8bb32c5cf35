/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Values of an expression over a range: their integral, the largest, the smallest. */
#include "language/over.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "language/along.h"
#include "number/integral.h"

/* ---- one value --------------------------------------------------------------------------------- */

static bool look(over *o, long double *v) {
    calc *c = o->t->c;
    value now;
    if (calc_stopped(c->scene.stop, o->error))
        return false;
    if (c->scene.pulse)
        c->scene.pulse();
    if (!o->value(o->context, &now))
        return false;
    if (!o->known)
        o->d = now.d;
    o->known = true;
    *v = now.v;
    return dim_equal(now.d, o->d) ||
           calc_fail(o->error, 0, 0, "the expression has no dimension of its own: it changes on the way");
}

static bool look_at(over *o, long double x, long double *v) {
    const knob_value by = {*o->name, x};
    size_t wrong;
    o->t->c->now = &o->t->scene; /* not the one beside it that has been seen last */
    return trial_change(o->t, &by, 1, &wrong, o->error) && look(o, v);
}

/* ---- the integral ------------------------------------------------------------------------------ */

/* A part of it. */
typedef struct part {
    over *o;
    long double lo, hi;
    bool magnitude;
} part;

/* At an end itself it need have no value. */
static fret_real integrand(fret_real t, fret_real rest, void *context) {
    const part *p = context;
    over *o = p->o;
    const long double width = p->hi - p->lo, x = t < 0.5L ? p->lo + width * t : p->hi - width * rest;
    long double v = 0;
    calc_error mine, *error = o->error;
    if (error->raised)
        return 0;
    error_clear(&mine);
    o->error = &mine;
    if (!look_at(o, x, &v) && (mine.stop || (x != o->lo && x != o->hi)))
        *error = mine;
    o->error = error;
    return p->magnitude ? fabsl(v) : v;
}

static fret_estimate integral(over *o, long double lo, long double hi, long double tolerance, bool magnitude) {
    part p = {o, lo, hi, magnitude};
    const long double width = hi - lo;
    const fret_estimate whole = fret_integral(integrand, &p, tolerance);
    return (fret_estimate){whole.value * width, whole.error * fabsl(width)};
}

/* From `far` to a singular end: what lies between halves of the distance, whose sums go on as their limit does
 * (Wynn's epsilon, exact for powers of the distance). x keeps its digits there, which at the end itself it
 * loses. */
static fret_estimate to_end(over *o, long double far, long double end) {
    enum { HALVES = 24 };
    long double row[HALVES + 1], sum = 0, from = far, rounding = 0, last = NAN;
    fret_estimate best = {0, INFINITY};
    for (int n = 0; n <= HALVES && !o->error->raised; n++) {
        const long double to = end - (end - from) / 2;
        const fret_estimate piece = integral(o, from, to, 1e-15L, false);
        long double above = 0;
        row[n] = sum += piece.value;
        rounding += piece.error;
        from = to;
        for (int j = n; j > 0; j--) {
            const long double old = row[j - 1];
            row[j - 1] = above + 1 / (row[j] - old);
            above = old;
        }
        const long double off = fabsl(row[n % 2] - last) + rounding;
        if (off < best.error)
            best = (fret_estimate){row[n % 2], off};
        last = row[n % 2];
    }
    return best;
}

bool over_integral(over *o, long double *out, long double *error) {
    static const long double good = 1e-14L, poor = 1e-6L;
    fret_estimate all = integral(o, o->lo, o->hi, 1e-16L, false);
    long double size = fabsl(all.value);
    if (all.error > good * size && !o->error->raised)
        size = integral(o, o->lo, o->hi, 1e-3L, true).value;
    if (all.error > good * size && !o->error->raised) {
        const long double mid = o->lo + (o->hi - o->lo) / 2;
        fret_estimate left = to_end(o, mid, o->lo), right = to_end(o, mid, o->hi);
        const fret_estimate both = {right.value - left.value, left.error + right.error};
        if (both.error < all.error)
            all = both;
    }
    *out = all.value;
    *error = size > 0 ? all.error / size : 0;
    return !o->error->raised &&
           (*error <= poor || calc_fail(o->error, 0, 0, "the integral does not converge"));
}

/* ---- the largest and the smallest -------------------------------------------------------------- */

/* A value above those beside it, at the places next to it. */
typedef struct peak {
    long double v, spread, left, right; /* spread: how far above the lower one */
} peak;

enum { PEAKS = 4 };
typedef struct search {
    over *o;
    int sign;
    size_t seen, peaks;
    long double x[3], v[3]; /* the latest */
    peak peak[PEAKS];       /* highest first */
} search;

/* Is the one before the latest a peak? */
static void close_peak(search *s) {
    const long double v = s->v[1];
    size_t i = s->peaks;
    if (v < s->v[0] || v < s->v[2])
        return;
    while (i > 0 && s->peak[i - 1].v < v)
        i--;
    if (i == PEAKS)
        return;
    s->peaks += s->peaks < PEAKS;
    for (size_t j = s->peaks - 1; j > i; j--)
        s->peak[j] = s->peak[j - 1];
    s->peak[i] = (peak){v, v - fminl(s->v[0], s->v[2]), s->x[0], s->x[2]};
}

/* The first and the last are their own neighbours. */
static void take(search *s, long double x, long double v) {
    for (int i = 0; i < 2; i++) {
        s->x[i] = s->seen ? s->x[i + 1] : x;
        s->v[i] = s->seen ? s->v[i + 1] : s->sign * v;
    }
    s->x[2] = x;
    s->v[2] = s->sign * v;
    if (s->seen++)
        close_peak(s);
}

static bool scan_along(search *s, long double lo, long double hi, size_t points) {
    over *o = s->o;
    trial_along a;
    long double v;
    if (!trial_along_between(&a, o->t, (double)lo, (double)hi, points, o->error))
        return false;
    while (trial_along_next(&a, o->error) && look(o, &v))
        take(s, (long double)scene_time(&o->t->scene), v);
    trial_along_end(&a);
    return !o->error->raised;
}

static bool scan(search *s, long double lo, long double hi, size_t points) {
    long double v;
    s->seen = s->peaks = 0;
    if (!s->o->name && !scan_along(s, lo, hi, points))
        return false;
    for (size_t i = 0; s->o->name && i <= points; i++) {
        const long double t = (long double)i / (long double)points, x = lo * (1 - t) + hi * t;
        if (!look_at(s->o, x, &v))
            return false;
        take(s, x, v);
    }
    take(s, s->x[2], s->sign * s->v[2]);
    return true;
}

/* Between its neighbours, until all that is left is alike to rounding. */
static bool climb(search *s, peak p, long double *most) {
    enum { PLACES = 16 };
    *most = fmaxl(*most, p.v);
    while (p.spread > 4 * LDBL_EPSILON * fabsl(p.v) &&
           p.right - p.left > 4 * LDBL_EPSILON * fmaxl(fabsl(p.left), fabsl(p.right))) {
        const long double width = p.right - p.left;
        if (!scan(s, p.left, p.right, PLACES))
            return false;
        p = s->peak[0];
        *most = fmaxl(*most, p.v);
        if (p.right - p.left > width / 2) /* steps of time end */
            return true;
    }
    return true;
}

bool over_extreme(over *o, bool largest, long double *out) {
    enum { PLACES = 256, PER_TIME = 32, AT_MOST = 16384 };
    search s = {.o = o, .sign = largest ? 1 : -1};
    const long double many = o->name ? 0 : PER_TIME * (o->hi - o->lo);
    if (!scan(&s, o->lo, o->hi, (size_t)fminl(fmaxl(many, PLACES), AT_MOST)))
        return false;
    peak found[PEAKS];
    const size_t count = s.peaks;
    long double most = s.peak[0].v;
    memcpy(found, s.peak, sizeof found);
    for (size_t i = 0; i < count; i++)
        if (found[i].v + found[i].spread > most && !climb(&s, found[i], &most))
            return false;
    *out = s.sign * most;
    return true;
}
