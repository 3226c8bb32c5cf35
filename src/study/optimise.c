/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Scans, golden section and Newton's method. Depends on points.h, number/least and GSL. */
#include "study/optimise.h"

#include <float.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_linalg.h>
#include <math.h>

#include "number/least.h"

/* LINE, FINE: steps of a scan along the only name; EDGE: halvings; ROUNDS: of the golden section. */
enum { N = OPTIMISE_NAMES, LINE = 16, FINE = 8 * LINE, EDGE = 16, ROUNDS = 8 };

/* Width of a bracket, relative to its distance from the ends, that suffices for Newton's method. */
#define NARROW 2e-3

/* A place, as parts u = 0..1 of the ranges, and the value f to be minimised there; NaN: none. */
typedef struct place {
    double u[N];
    long double f;
} place;

typedef struct search {
    const optimise_question *of;
    points p;
    bool ratios[N];
    bool known, varies; /* `d` is known; two values have differed */
    dim d;
    long double seen;      /* the first value */
    bool fixed[N];         /* the name stays at an end of its range */
    int steps;             /* of a scan along one name */
    double from[N], to[N]; /* the window that is searched, in parts of the ranges */
    place best;            /* so far */
    calc_error why;        /* why the latest place without a value has none */
} search;

static double knob_of(const search *s, size_t i, double u) {
    return (double)points_place(s->of->lo[i], s->of->hi[i], s->ratios[i], fmin(fmax(u, 0), 1));
}

static void set_knobs(const search *s, const double *u, long double x[N]) {
    for (size_t i = 0; i < s->of->count; i++)
        x[i] = knob_of(s, i, u[i]);
}

/* The value to be minimised; NaN: none, or p.error is raised. */
static long double take_value(search *s, const value *v, const calc_error *why) {
    if (why)
        s->why = *why;
    if (why || !points_keeps(&s->p, 0, v->d, &s->d, &s->known))
        return (long double)NAN;
    if (isnan(s->seen))
        s->seen = v->v;
    s->varies = s->varies || v->v != s->seen;
    return s->of->most ? -v->v : v->v;
}

static long double at_parts(search *s, const double *u) {
    long double x[N];
    value v = {.v = (long double)NAN};
    set_knobs(s, u, x);
    return take_value(s, &v, points_at(&s->p, x, &v) ? NULL : &s->p.none);
}

/* Replaces *best by *now if that is better, and says whether it was. */
static bool better(place *best, const place *now) {
    const bool is = now->f < best->f || (isnan(best->f) && !isnan(now->f));
    if (is)
        *best = *now;
    return is;
}

/* Less by more than the tolerance of a search, so that of equal optima the first is taken. */
static bool is_less(long double f, long double than) {
    return f < than - 1e-9L * fabsl(than) || isnan(than);
}

/* ---- many places at once ----------------------------------------------------------------------- */

enum { PLACES = FINE + 1 };

/* Places along one name, in ascending order. */
typedef struct places {
    search *s;
    size_t count;
    place at[PLACES];
} places;

static void give_place(void *context, size_t i, long double x[]) {
    const places *p = context;
    set_knobs(p->s, p->at[i].u, x);
}

static bool take_place(void *context, size_t i, const value v[], const calc_error *why) {
    places *p = context;
    p->at[i].f = take_value(p->s, v, why);
    return true;
}

static bool at_all(places *p) {
    return points_go(&p->s->p,
                     &(points_run){.count = p->count, .give = give_place, .take = take_place, .context = p});
}

/* The index of the best place, the first of equal ones; p->count if no place has a value. */
static size_t best_of(const places *p) {
    size_t best = p->count;
    for (size_t i = 0; i < p->count; i++)
        if (!isnan(p->at[i].f) && (best == p->count || p->at[i].f < p->at[best].f))
            best = i;
    return best;
}

/* May the optimum lie near place i, which is not the best? Yes beside a place without a value, since f may
 * fall up to the limit of the scene; else if no neighbour is better and one is worse by more than i is worse
 * than the best. */
static bool is_rival(const places *p, size_t i, size_t best) {
    const long double f = p->at[i].f, before = i > 0 ? p->at[i - 1].f : f,
                      after = i + 1 < p->count ? p->at[i + 1].f : f, highest = fmaxl(before, after);
    if (isnan(f) || i == best)
        return false;
    return isnan(before) || isnan(after) ||
           (!is_less(before, f) && !is_less(after, f) && is_less(f, highest) &&
            f - (highest - f) < p->at[best].f);
}

static bool has_rivals(const places *p) {
    const size_t best = best_of(p);
    size_t i = 0;
    while (i < p->count && !is_rival(p, i, best))
        i++;
    return i < p->count;
}

/* ---- along one name ---------------------------------------------------------------------------- */

/* A search along one name. At each place the names after it are optimised by searches of their own, which
 * follows steep valleys and the limit of a scene; the names before it are held. */
typedef struct line {
    search *s;
    size_t axis;
    place base, best; /* the names held; the best place so far */
} line;

static bool search_line(line *l);

static double best_part(const line *l) {
    return l->best.u[l->axis];
}

static place line_place(const line *l, double u) {
    place at = l->base;
    at.u[l->axis] = u;
    return at;
}

static const place nowhere = {.f = (long double)NAN};

static bool is_innermost(const line *l) {
    return l->axis + 1 == l->s->of->count;
}

static place line_at(line *l, double u) {
    place at = line_place(l, u);
    if (is_innermost(l)) {
        at.f = at_parts(l->s, at.u);
    } else {
        at.f = (long double)NAN;
        line inner = {.s = l->s, .axis = l->axis + 1, .base = at, .best = at};
        search_line(&inner);
        at = inner.best;
    }
    better(&l->best, &at);
    return at;
}

static fret_real line_value(fret_real u, fret_real *slope, void *context) {
    line *l = context;
    (void)slope;
    return l->s->p.error->raised ? 0 : line_at(l, (double)u).f;
}

/* Golden section within lo .. hi about the best place, to NARROW times its distance from the ends of the
 * range or times the window. */
static bool narrow(line *l, double lo, double hi) {
    static const double round = 1e-2; /* relative tolerance of one round */
    const double window = l->s->to[l->axis] - l->s->from[l->axis];
    for (int i = 0; i < ROUNDS && hi - lo > NARROW * fmin(window, fmin(best_part(l), 1 - best_part(l)));
         i++) {
        const double apart = round * (hi - lo);
        fret_least(line_value, l, lo, hi, best_part(l), round);
        lo = fmax(lo, best_part(l) - apart);
        hi = fmin(hi, best_part(l) + apart);
    }
    return !l->s->p.error->raised;
}

/* The best place is an end of the range: stays there unless a place a little inside is better. */
static bool leave_end(line *l, double next) {
    const double end = best_part(l);
    line_at(l, end + (next - end) * 1e-4);
    if (l->s->p.error->raised)
        return false;
    return best_part(l) == end || narrow(l, fmin(end, next), fmax(end, next));
}

/* Goes from the best place to the limit before `bad`, a neighbour without a value, even where f rises: it may
 * fall again close to gross slip. Then searches about the best place met. other: the neighbour on the far
 * side, or the place itself; NaN: a neighbour that is better. */
static bool approach_edge(line *l, double bad, double other) {
    const double begin = best_part(l);
    double good = begin, before = other, after = bad; /* the neighbours with values of the best place */
    bool falls = true;                                /* the best place is the nearest to the limit */
    for (int i = 0; i < EDGE; i++) {
        const double mid = bad + (good - bad) / 2;
        const long double f = line_at(l, mid).f;
        if (l->s->p.error->raised)
            return false;
        if (isnan(f)) {
            bad = mid;
            continue;
        }
        if (best_part(l) == mid)
            before = good, falls = true;
        else if (falls)
            after = mid, falls = false;
        good = mid;
    }
    if (falls || (best_part(l) == begin && isnan(other)))
        return true;
    return best_part(l) == begin && other == begin ? leave_end(l, after)
                                                   : narrow(l, fmin(before, after), fmax(before, after));
}

static bool scan_line(line *l, places *all, int parts) {
    const double from = l->s->from[l->axis], to = l->s->to[l->axis];
    all->count = (size_t)parts + 1;
    for (int i = 0; i <= parts; i++)
        all->at[i] = line_place(l, i < parts ? from + (to - from) * i / parts : to);
    if (is_innermost(l))
        return at_all(all);
    for (int i = 0; i <= parts && !l->s->p.error->raised; i++)
        all->at[i] = line_at(l, all->at[i].u[l->axis]);
    return !l->s->p.error->raised;
}

/* Searches about place i of the scan, which is l->best. */
static bool go_about(line *l, const places *all, size_t i) {
    const place *here = &all->at[i], *before = i > 0 ? here - 1 : here,
                *after = i + 1 < all->count ? here + 1 : here;
    const double lo = before->u[l->axis], u = best_part(l), hi = after->u[l->axis];
    if (isnan(before->f))
        return approach_edge(l, lo, is_less(after->f, here->f) ? (double)NAN : hi);
    if (isnan(after->f))
        return approach_edge(l, hi, is_less(before->f, here->f) ? (double)NAN : lo);
    if (u == lo || u == hi)
        return leave_end(l, u == lo ? hi : lo);
    return narrow(l, lo, hi);
}

static bool search_line(line *l) {
    places all = {.s = l->s};
    const line begin = *l;
    line found = begin;
    if (!scan_line(l, &all, l->s->steps) ||
        (l->s->steps == LINE && has_rivals(&all) && !scan_line(l, &all, FINE)))
        return false;
    const size_t best = best_of(&all);
    for (size_t i = 0; i < all.count; i++) {
        line one = begin;
        one.best = all.at[i];
        if (i != best && !is_rival(&all, i, best))
            continue;
        if (!go_about(&one, &all, i))
            return false;
        if (is_less(one.best.f, found.best.f))
            found = one;
    }
    *l = found;
    return true;
}

/* ---- Newton's method --------------------------------------------------------------------------- */

/* f''(x) = sum of second_weight[j-1] (f(x+jh) + f(x-jh) - 2 f(x))/h^2 over j = 1..3, of sixth order. */
static const long double second_weight[POINTS_SLOPES] = {3 / 2.0L, -3 / 20.0L, 1 / 90.0L};

static long double moved(search *s, size_t i, double by, size_t j, double also) {
    place to = s->best;
    to.u[i] += by;
    to.u[j] += also;
    return at_parts(s, to.u);
}

/* Gradient and Hessian at the best place; false: a value is missing, a kink is near, or p.error is raised. */
static bool differences(search *s, const size_t *free, size_t count, const double h[N], gsl_vector *g,
                        gsl_matrix *H) {
    for (size_t a = 0; a < count; a++) {
        const size_t i = free[a];
        long double slope = 0, bend = 0, apart[POINTS_SLOPES];
        for (int j = 1; j <= POINTS_SLOPES; j++) {
            const long double up = moved(s, i, j * h[i], i, 0), down = moved(s, i, -j * h[i], i, 0);
            slope += points_slope[j - 1] * (up - down);
            apart[j - 1] = (up - s->best.f) + (down - s->best.f);
            bend += second_weight[j - 1] * apart[j - 1];
        }
        gsl_vector_set(g, a, (double)(slope / h[i]));
        gsl_matrix_set(H, a, a, (double)(bend / ((long double)h[i] * h[i])));
        for (size_t b = 0; b < a; b++) {
            const size_t j = free[b];
            const long double cross = moved(s, i, h[i], j, h[j]) - moved(s, i, h[i], j, -h[j]) -
                                      moved(s, i, -h[i], j, h[j]) + moved(s, i, -h[i], j, -h[j]);
            gsl_matrix_set(H, a, b, (double)(cross / (4 * (long double)h[i] * h[j])));
            gsl_matrix_set(H, b, a, gsl_matrix_get(H, a, b));
        }
        /* apart[2]/apart[1] is (3/2)^2 at a smooth minimum, but at most 2 within h of a kink */
        if (isnan(slope) || !(apart[2] > 2.1L * apart[1]))
            return false;
    }
    return !s->p.error->raised;
}

/* One Newton step; *length: its length in parts of the ranges. False: not possible. */
static bool newton_step(search *s, const size_t *free, size_t count, gsl_vector *g, gsl_matrix *H,
                        gsl_vector *step, double *length) {
    double h[N] = {0};
    place to = s->best;
    for (size_t a = 0; a < count; a++) {
        const double u = to.u[free[a]], rest = fmin(u, 1 - u);
        h[free[a]] = fmin(points_step(1e-3, u, 1), 0.05 * rest); /* of the range */
        if (h[free[a]] < 1e-9)
            return false;
    }
    if (!differences(s, free, count, h, g, H) || gsl_linalg_cholesky_decomp1(H))
        return false;
    gsl_linalg_cholesky_solve(H, g, step);
    *length = 0;
    for (size_t a = 0; a < count; a++) {
        const double by = gsl_vector_get(step, a), at = to.u[free[a]];
        if (!(fabs(by) < fmin(0.1, fmin(at, 1 - at))))
            return false;
        to.u[free[a]] -= by;
        *length = fmax(*length, fabs(by));
    }
    to.f = at_parts(s, to.u);
    /* close to the optimum f is constant but for rounding, while the gradient still points there */
    if (!(to.f <= s->best.f + 1e-9L * fabsl(s->best.f)))
        return false;
    s->best = to;
    return true;
}

/* Newton's method from the best place; *sharp: it has converged. */
static bool sharpen(search *s, bool *sharp) {
    size_t free[N], count = 0;
    for (size_t i = 0; i < s->of->count; i++)
        if (!s->fixed[i])
            free[count++] = i;
    *sharp = !count;
    if (!count)
        return true;
    gsl_vector *g = gsl_vector_alloc(count), *step = gsl_vector_alloc(count);
    gsl_matrix *H = gsl_matrix_alloc(count, count);
    bool ok = g && step && H;
    double length;
    for (int i = 0; i < 6 && ok && !*sharp; i++) {
        if (!newton_step(s, free, count, g, H, step, &length))
            break;
        *sharp = length < 1e-8;
    }
    gsl_vector_free(g);
    gsl_vector_free(step);
    gsl_matrix_free(H);
    return ok ? !s->p.error->raised : calc_no_memory(s->p.error);
}

/* ---- answers ----------------------------------------------------------------------------------- */

/* Searches the window, and says which names are at an end of their range. */
static bool search_window(search *s, optimise_end end[N]) {
    static const double little = 1e-12;
    line l = {.s = s, .best = nowhere};
    if (!search_line(&l))
        return false;
    if (isnan(s->best.f) || l.best.f < s->best.f)
        s->best = l.best;
    for (size_t i = 0; i < s->of->count; i++) {
        end[i] = s->best.u[i] < little ? END_LOW : s->best.u[i] > 1 - little ? END_HIGH : END_INNER;
        s->fixed[i] = end[i] != END_INNER;
    }
    return true;
}

/* Searches windows about the best place, each a sixteenth of the last unless the place moves, until that
 * brings no more. */
static bool zoom(search *s, optimise_end end[N]) {
    enum { WINDOWS = 40, IDLE = 6 };
    int idle = 0;
    double width = 0.25;
    s->steps /= 2;
    for (int i = 0; i < WINDOWS && idle < IDLE && width > 1e-12; i++) {
        const place before = s->best;
        double far = 0;
        for (size_t n = 0; n < s->of->count; n++) {
            s->from[n] = fmax(0, before.u[n] - width / 2);
            s->to[n] = fmin(1, before.u[n] + width / 2);
        }
        if (!search_window(s, end))
            return false;
        for (size_t n = 0; n < s->of->count; n++)
            far = fmax(far, fabs(s->best.u[n] - before.u[n]));
        idle = s->best.f < before.f ? 0 : idle + 1;
        if (far <= width / 4)
            width /= 16;
    }
    return true;
}

/* Marks the names along which a neighbour has no value. */
static void find_limits(search *s, optimise_end end[N]) {
    static const double near = 1e-6;
    for (size_t i = 0; i < s->of->count; i++)
        if (end[i] == END_INNER && (isnan(moved(s, i, near, i, 0)) || isnan(moved(s, i, -near, i, 0))))
            end[i] = END_SCENE;
}

static bool answer_optimum(search *s, optimise_answer *out, calc_error *error) {
    static const int steps[N] = {LINE, 12, 8};
    const expr *e = s->of->e;
    s->steps = steps[s->of->count - 1];
    for (size_t i = 0; i < s->of->count; i++)
        s->to[i] = 1;
    if (!search_window(s, out->end))
        return false;
    if (isnan(s->best.f))
        return calc_fail(error, e->at, e->len, "no value at any place tried in the range: %s", s->why.text);
    if (!s->varies)
        return calc_fail(error, e->at, e->len, "%.*s is the same everywhere in the range", LEX_SHOWN(e->len),
                         e->text + e->at);
    if (!sharpen(s, &out->sharp))
        return false;
    if (!out->sharp) {
        if (!zoom(s, out->end))
            return false;
        find_limits(s, out->end);
    }
    for (size_t i = 0; i < s->of->count; i++)
        out->x[i] = knob_of(s, i, s->best.u[i]);
    out->value = s->of->most ? -s->best.f : s->best.f;
    out->d = s->d;
    out->why = s->why;
    out->evaluations = s->p.evaluations;
    return !error->raised;
}

bool optimise(const optimise_question *question, optimise_answer *out, calc_error *error) {
    search s = {.of = question, .best = nowhere, .seen = (long double)NAN};
    *out = (optimise_answer){.value = 0};
    gsl_set_error_handler_off();
    for (size_t i = 0; i < question->count; i++)
        s.ratios[i] = points_ratios(question->lo[i], question->hi[i]);
    const bool ok = points_open(&s.p, question->c, question->name, question->count, question->e, 1, error) &&
                    answer_optimum(&s, out, error);
    points_close(&s.p);
    return ok;
}
