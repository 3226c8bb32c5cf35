/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Integrals, largest and smallest values of an expression over a range. Uses `scene` and `number`. */
#include "language/over.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "number/integral.h"
#include "number/real.h"

/* ---- one value --------------------------------------------------------------------------------- */

static bool evaluate(over *o, long double *v) {
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
           calc_fail(o->error, 0, 0, "the expression has no fixed dimension: it changes on the way");
}

/* Appends the place x to an error. */
static void over_where(const over *o, long double x) {
    char at[CALC_VALUE_TEXT];
    calc_value_text(o->name ? o->name->d : DIM_NONE, (double)x, at);
    if (!o->error->stop && o->error->kind != ERROR_MISSING)
        calc_append(o->t->c, o->error, " (at %s = %s)", o->name ? o->name->text : "time", at);
}

static bool evaluate_at(over *o, long double x, long double *v) {
    const knob_value by = {*o->name, x};
    size_t wrong;
    o->t->c->now = &o->t->scene; /* not the changed scene of an earlier evaluation */
    return trial_change(o->t, &by, 1, &wrong, o->error) && evaluate(o, v);
}

/* ---- the integral ------------------------------------------------------------------------------ */

/* A part of the range between places where the integrand may be singular. Next to one, `end`, it is a power
 * of the distance, of which x keeps too few digits: a value at x is scaled to the exact distance. */
typedef struct part {
    over *o;
    long double lo, hi;
    bool magnitude;
    long double end, power; /* power 0: not next to `end` */
    bool lost;              /* a value at an end is missing */
    size_t seen;
} part;

/* Where x rounds to an end the value may be missing: the rule cannot converge then, and is left soon. */
static fret_real integrand(fret_real t, fret_real rest, void *context) {
    enum { ENOUGH = 2000 };
    part *p = context;
    over *o = p->o;
    const long double width = p->hi - p->lo,
                      away = t < 0.5L ? (p->lo - p->end) + width * t : (p->hi - p->end) - width * rest,
                      x = p->end + away;
    long double v = 0;
    calc_error mine, *error = o->error;
    if (error->raised || (p->lost && p->seen++ > ENOUGH))
        return 0;
    error_clear(&mine);
    o->error = &mine;
    const bool had = evaluate_at(o, x, &v),
               at_end = x == p->lo || x == p->hi || t < LDBL_EPSILON || rest < LDBL_EPSILON;
    p->lost = p->lost || !had;
    if (!had && (mine.stop || mine.strange || !at_end)) {
        over_where(o, x);
        *error = mine;
    }
    o->error = error;
    if (p->power != 0)
        v *= fret_pow(away / (x - p->end), p->power);
    return p->magnitude ? fabsl(v) : v;
}

/* Integrates a part; its error is infinite if a value is missing. */
static fret_estimate sum_of(part *p, long double tolerance) {
    const fret_estimate whole = fret_integral(integrand, p, tolerance);
    const long double error = p->lost ? INFINITY : whole.error * fabsl(p->hi - p->lo);
    return (fret_estimate){whole.value * (p->hi - p->lo), error};
}

static fret_estimate integrate(over *o, long double lo, long double hi, long double tolerance,
                               bool magnitude) {
    return sum_of(&(part){.o = o, .lo = lo, .hi = hi, .magnitude = magnitude}, tolerance);
}

/* The integral from `far` to a singular end, as the limit of sums over halved distances (Wynn's epsilon
 * algorithm, exact for sums of powers of the distance). If the last pieces do not shrink there is no limit; a
 * limit that the last pieces contradict belongs to another law farther from the end, and is rejected. */
static fret_estimate integrate_to_end(over *o, long double far, long double end) {
    enum { HALVES = 64 };
    int exponent;
    (void)frexpl(end - far, &exponent);
    long double row[HALVES + 1], away = copysignl(ldexpl(0.5L, exponent), far - end), last = NAN, before = 0,
                                 shrinks = 0, off = INFINITY;
    const fret_estimate first = integrate(o, far, end + away, 1e-15L, false);
    long double sum = first.value, rounding = first.error;
    fret_estimate best = {0, INFINITY};
    for (int n = 0; n <= HALVES && !o->error->raised; n++, away /= 2) {
        const long double digits = LDBL_EPSILON * fabsl(2 * end / away);
        part p = {.o = o, .lo = end + away, .hi = end + away / 2, .end = end};
        if (digits > 1e-2L)
            break;
        if (n > 1 && shrinks > 0)
            p.power = -log2l(shrinks) - 1;
        const fret_estimate piece = sum_of(&p, 1e-15L + 4 * digits);
        long double above = 0;
        row[n] = sum += piece.value;
        rounding += piece.error;
        shrinks = fabsl(piece.value / before);
        before = piece.value;
        for (int j = n; j > 0; j--) {
            const long double old = row[j - 1];
            row[j - 1] = above + 1 / (row[j] - old);
            above = old;
        }
        const long double earlier = off, now = row[n % 2];
        off = fabsl(now - last);
        if (off + earlier + rounding < best.error) /* agrees with the last two; false for NaN */
            best = (fret_estimate){now, off + earlier + rounding};
        last = now;
    }
    if (!(shrinks < 0.999L) && before != 0)
        return (fret_estimate){sum, INFINITY};
    const long double rest = before != 0 ? before * shrinks / (1 - shrinks) : 0;
    return fabsl(best.value - sum - rest) <= fabsl(rest) + best.error + rounding
               ? best
               : (fret_estimate){sum + rest, fabsl(rest) + rounding};
}

/* The integral between two edges; *size: of its magnitude. A worn gap is piecewise cubic with hundreds of
 * pieces, and is not worth the last digits. */
static fret_estimate integrate_part(over *o, bool worn, long double lo, long double hi, long double *size) {
    const long double good = worn ? 1e-4L : 1e-14L;
    fret_estimate all = integrate(o, lo, hi, worn ? 1e-5L : 1e-16L, false);
    *size = fabsl(all.value);
    if (isfinite(all.error) && all.error > good * *size)
        *size = integrate(o, lo, hi, 1e-3L, true).value;
    if (all.error <= good * *size || o->error->raised)
        return all;
    const long double mid = lo + (hi - lo) / 2;
    const fret_estimate left = integrate_to_end(o, mid, lo), right = integrate_to_end(o, mid, hi);
    const fret_estimate both = {right.value - left.value, left.error + right.error};
    const long double rough = fabsl(all.value);
    const bool agree = fabsl(both.value - all.value) <= 4 * (both.error + all.error);
    if ((both.error < all.error && agree) || !isfinite(all.error))
        all = both;
    if (!isfinite(all.error)) /* nothing is certain: harmless if the part is a small share of the whole */
        all.error = fmaxl(rough, fabsl(left.value) + fabsl(right.value));
    *size = fmaxl(*size, fmaxl(fabsl(all.value), isfinite(both.error) ? 0 : all.error));
    return all;
}

/* Where parts end: at a place off the middle, so that no rule is symmetric about a pole, whose sides would
 * cancel; over a radius at b and a, where pressure may be singular; just inside b if the contact reaches
 * little beyond a flat end; and at kinks of friction's work, if it was asked for. */
enum { EDGES = 200 };
static size_t edges(over *o, bool *worn, long double at[EDGES]) {
    static const char *const names[] = {"b", "a"};
    long double v[3];
    size_t count = 0, found = 0;
    calc_error *error = o->error;
    at[count++] = o->lo + 0.381966L * (o->hi - o->lo);
    o->error = error_quiet();
    evaluate_at(o, at[0], v);
    o->error = error;
    *worn = scene_is_worn(&o->t->scene);
    for (size_t i = 0; i < 2 && dim_equal(o->name->d, DIM_LENGTH) && !o->name->is_input; i++) {
        found += quantity_get(quantity_find(names[i], 1), &o->t->scene, &v[found], error_quiet());
        if (i == 1 && found == 2 && v[1] > v[0] && v[1] < 1.1L * v[0])
            v[found++] = v[0] - (v[1] - v[0]);
    }
    for (size_t i = 0; i < found; i++) {
        at[count++] = v[i];
        at[count++] = -v[i];
    }
    if (count > 1)
        count += scene_work_edges(&o->t->scene, at + count, EDGES - count);
    return count;
}

bool over_integral(over *o, long double *out, long double *error) {
    static const long double alike = 1e-15L;
    long double edge[EDGES], size = 0, off = 0, sum = 0;
    bool worn;
    const size_t count = edges(o, &worn, edge);
    const int sign = o->lo < o->hi ? 1 : -1;
    const long double poor = worn ? 1e-4L : 1e-6L;
    if (scene_work_chords(&o->t->scene))
        return calc_fail(o->error, 0, 0,
                         "friction's work is not smooth in r under this load, which is run in chords: "
                         "the integrals of WdA and dWdA are W and dW");
    for (long double lo = o->lo, hi; lo != o->hi && !o->error->raised; lo = hi) {
        long double own;
        hi = o->hi;
        for (size_t i = 0; i < count; i++)
            if (sign * (edge[i] - lo) > alike * fabsl(o->hi - o->lo) && sign * edge[i] < sign * hi)
                hi = edge[i];
        const fret_estimate here = integrate_part(o, worn, lo, hi, &own);
        sum += here.value;
        off += here.error;
        size += fabsl(own);
    }
    *out = sum;
    *error = size > 0 ? off / size : 0;
    return !o->error->raised &&
           (off <= poor * size ||
            calc_fail(
                o->error, 0, 0,
                "the integral does not converge: the integrand may be infinite, or oscillate without end"));
}

/* ---- the largest and the smallest -------------------------------------------------------------- */

/* A value above its neighbours', and their places. */
typedef struct peak {
    long double v, spread, left, right; /* spread: height above the lower neighbour */
} peak;

enum { PEAKS = 128, FEW = 4 };
typedef struct search {
    over *o;
    int sign;
    size_t seen, peaks;
    long double x[3], v[3]; /* the last three samples */
    peak peak[PEAKS];       /* highest first */
} search;

/* Records sample `at` of the last three if it is a peak; at an end both others lie on one side. */
static void record_peak(search *s, int at, int near, int other) {
    const long double v = s->v[at];
    size_t i = s->peaks;
    if (v < s->v[near] || (at == 1 && v < s->v[other]))
        return;
    while (i > 0 && s->peak[i - 1].v < v)
        i--;
    if (i == PEAKS)
        return;
    s->peaks += s->peaks < PEAKS;
    for (size_t j = s->peaks - 1; j > i; j--)
        s->peak[j] = s->peak[j - 1];
    s->peak[i] = (peak){v, v - fminl(s->v[near], s->v[other]), s->x[at > 1], s->x[at < 1 ? 1 : 2]};
}

static void add_sample(search *s, long double x, long double v) {
    for (int i = 0; i < 2; i++) {
        s->x[i] = s->seen ? s->x[i + 1] : x;
        s->v[i] = s->seen ? s->v[i + 1] : s->sign * v;
    }
    s->x[2] = x;
    s->v[2] = s->sign * v;
    if (++s->seen == 3)
        record_peak(s, 0, 1, 2);
    if (s->seen >= 3)
        record_peak(s, 1, 0, 2);
}

static bool scan_along(search *s, long double lo, long double hi, size_t points) {
    over *o = s->o;
    trial_along a;
    long double v;
    if (!trial_along_between(&a, o->t, (double)lo, (double)hi, points, true, o->error))
        return false;
    while (trial_along_next(&a, o->error)) {
        if (!evaluate(o, &v)) {
            over_where(o, (long double)scene_time(&o->t->scene));
            break;
        }
        add_sample(s, (long double)scene_time(&o->t->scene), v);
    }
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
        if (!evaluate_at(s->o, x, &v)) {
            over_where(s->o, x);
            return false;
        }
        add_sample(s, x, v);
    }
    if (s->seen == 2)
        record_peak(s, 1, 0, 2);
    if (s->seen)
        record_peak(s, 2, 1, 0);
    return true;
}

/* Scans between the neighbours of a peak until values agree to rounding. */
static bool refine_peak(search *s, peak p, long double *most) {
    enum { PLACES = 16 };
    *most = fmaxl(*most, p.v);
    while (p.spread > 4 * LDBL_EPSILON * fabsl(p.v) &&
           p.right - p.left > 4 * LDBL_EPSILON * fmaxl(fabsl(p.left), fabsl(p.right))) {
        const long double width = p.right - p.left;
        if (!scan(s, p.left, p.right, PLACES))
            return false;
        if (!s->peaks) /* no instant between them */
            return true;
        p = s->peak[0];
        *most = fmaxl(*most, p.v);
        if (p.right - p.left > width / 2) /* time has no finer steps */
            return true;
    }
    return true;
}

bool over_extreme(over *o, bool largest, long double *out) {
    enum { PLACES = 256, AT_MOST = 16384 };
    static const long double per_time = 32;
    search s = {.o = o, .sign = largest ? 1 : -1};
    const long double many = o->name ? 0 : per_time * (o->hi - o->lo);
    if (!scan(&s, o->lo, o->hi, (size_t)fminl(fmaxl(many, PLACES), AT_MOST)))
        return false;
    if (!s.peaks)
        return calc_fail(o->error, 0, 0, "the part of the load has no instant");
    peak found[PEAKS];
    const size_t count = o->name || s.peaks < FEW ? s.peaks : FEW; /* periods of a load have equal peaks */
    long double most = s.peak[0].v;
    memcpy(found, s.peak, sizeof found);
    for (size_t i = 0; i < count; i++)
        if (found[i].v + found[i].spread > most && !refine_peak(&s, found[i], &most))
            return false;
    *out = s.sign * most;
    return true;
}
