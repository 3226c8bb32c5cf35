/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Grids, simplices and Newton's method over parts of ranges. */
#include "study/optimise.h"

#include <float.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_linalg.h>
#include <gsl/gsl_min.h>
#include <gsl/gsl_multimin.h>
#include <math.h>

#include "number/real.h"

/* Names are turned into parts of their ranges, 0 to 1. */
enum { N = OPTIMISE_NAMES, LINE = 16, SLOPES = 3, EDGE_EVALUATIONS = 60, SIMPLEX_STEPS = 400, RESTARTS = 40 };

/* Narrow enough for Newton's method. */
#define NARROW 2e-3

typedef struct search {
    const optimise_question *of;
    ask q;
    bool ratios[N];
    bool known, varies;
    dim d;
    long double seen; /* the first value */
    double lo, hi;    /* bracket of a single name; lo = hi: none */
    bool fixed[N];    /* at an end of the range */
    double u[N];      /* the best place so far */
    long double f;    /* and what is there, to be made small */
    calc_error why;
} search;

static double place_of(const search *s, size_t i, double u) {
    const optimise_question *of = s->of;
    if (u <= 0 || u >= 1)
        return u <= 0 ? of->lo[i] : of->hi[i];
    if (!s->ratios[i])
        return (double)(of->lo[i] + ((long double)of->hi[i] - of->lo[i]) * u);
    return (double)(of->lo[i] * fret_pow((long double)of->hi[i] / of->lo[i], u));
}

/* To be made small; NaN: no value there, or the question has ended. */
static long double at(search *s, const double *u) {
    double x[N];
    long double v;
    for (size_t i = 0; i < s->of->count; i++)
        x[i] = place_of(s, i, u[i]);
    if (!ask_set(&s->q, x) || !ask_value(&s->q, s->of->e, &s->d, &s->known, &v)) {
        if (s->q.none.raised)
            s->why = s->q.none;
        return (long double)NAN;
    }
    if (isnan(s->seen))
        s->seen = v;
    s->varies = s->varies || v != s->seen;
    return s->of->most ? -v : v;
}

static bool better(search *s, const double *u, long double f) {
    if (!(f < s->f) && !isnan(s->f))
        return false;
    s->f = f;
    for (size_t i = 0; i < s->of->count; i++)
        s->u[i] = u[i];
    return true;
}

/* ---- one name ---------------------------------------------------------------------------------- */

static double gsl_line(double u, void *context) {
    return (double)at(context, &u);
}

/* A bracket of three, the best inside, made narrow: to this part of what is left on either side. */
static bool narrow(search *s, double lo, double hi, double part) {
    const double f = (double)s->f, u = s->u[0];
    gsl_min_fminimizer *m = gsl_min_fminimizer_alloc(gsl_min_fminimizer_brent);
    gsl_function line = {gsl_line, s};
    if (!m)
        return calc_no_memory(s->q.error);
    const double at_lo = (double)at(s, &lo), at_hi = (double)at(s, &hi);
    int status = gsl_min_fminimizer_set_with_values(m, &line, u, f, lo, at_lo, hi, at_hi);
    for (int i = 0; !status && i < 40; i++) {
        status = gsl_min_fminimizer_iterate(m);
        const double now = gsl_min_fminimizer_x_minimum(m),
                     width = gsl_min_fminimizer_x_upper(m) - gsl_min_fminimizer_x_lower(m);
        better(s, &now, gsl_min_fminimizer_f_minimum(m));
        if (width < part * fmin(now, 1 - now))
            break;
    }
    s->lo = gsl_min_fminimizer_x_lower(m);
    s->hi = gsl_min_fminimizer_x_upper(m);
    gsl_min_fminimizer_free(m);
    return !s->q.error->raised;
}

/* The best place has a neighbour without a value: go there. other: the neighbour on the far side. */
static bool approach_edge(search *s, double bad, double other, optimise_end *end) {
    calc_error why = s->why;
    while (s->q.evaluations < EDGE_EVALUATIONS && fabs(bad - s->u[0]) > DBL_EPSILON * fabs(bad)) {
        const double mid = bad + (s->u[0] - bad) / 2, good = s->u[0];
        const long double f = at(s, &mid);
        if (s->q.error->raised)
            return false;
        if (isnan(f)) {
            bad = mid;
            why = s->why;
        } else if (better(s, &mid, f)) {
            other = good;
        } else {
            return narrow(s, fmin(mid, other), fmax(mid, other), NARROW);
        }
    }
    *end = END_SCENE;
    s->why = why;
    return true;
}

/* At an end of the range, unless it is better a little inside. */
static bool leave_end(search *s, double end, double next, optimise_end *found) {
    const double inside = end + (next - end) * 1e-4;
    const long double f = at(s, &inside);
    if (s->q.error->raised)
        return false;
    if (!better(s, &inside, f)) {
        *found = end > 0 ? END_HIGH : END_LOW;
        s->fixed[0] = true;
        return true;
    }
    return narrow(s, fmin(end, next), fmax(end, next), NARROW);
}

static bool search_line(search *s, optimise_end *end) {
    double u[LINE + 1];
    long double f[LINE + 1];
    int best = -1;
    for (int i = 0; i <= LINE; i++) {
        u[i] = (double)i / LINE;
        f[i] = at(s, &u[i]);
        if (s->q.error->raised)
            return false;
        if (better(s, &u[i], f[i]) && !isnan(f[i]))
            best = i;
    }
    if (best < 0)
        return true;
    if (best > 0 && isnan(f[best - 1]))
        return approach_edge(s, u[best - 1], u[best < LINE ? best + 1 : best], end);
    if (best < LINE && isnan(f[best + 1]))
        return approach_edge(s, u[best + 1], u[best ? best - 1 : best], end);
    if (best == 0 || best == LINE)
        return leave_end(s, u[best], u[best ? LINE - 1 : 1], end);
    return narrow(s, u[best - 1], u[best + 1], NARROW);
}

/* ---- several names ----------------------------------------------------------------------------- */

/* The ends of the ranges do not stop a simplex in the angles u = sin^2. */
static double gsl_angles(const gsl_vector *v, void *context) {
    search *s = context;
    double u[N] = {0};
    size_t next = 0;
    for (size_t i = 0; i < s->of->count; i++) {
        const double sine = s->fixed[i] ? 0 : sin(gsl_vector_get(v, next++));
        u[i] = s->fixed[i] ? s->u[i] : sine * sine;
    }
    const long double f = at(s, u);
    return isnan(f) ? DBL_MAX : (double)f;
}

static bool simplex(search *s, size_t free, double step, double size) {
    gsl_multimin_function f = {gsl_angles, free, s};
    gsl_vector *start = gsl_vector_alloc(free), *steps = gsl_vector_alloc(free);
    gsl_multimin_fminimizer *m = gsl_multimin_fminimizer_alloc(gsl_multimin_fminimizer_nmsimplex2, free);
    bool ok = start && steps && m;
    if (ok) {
        size_t next = 0;
        for (size_t i = 0; i < s->of->count; i++)
            if (!s->fixed[i])
                gsl_vector_set(start, next++, asin(sqrt(s->u[i])));
        gsl_vector_set_all(steps, step);
        int status = gsl_multimin_fminimizer_set(m, &f, start, steps);
        for (int i = 0; !status && i < SIMPLEX_STEPS && !s->q.error->raised; i++) {
            status = gsl_multimin_fminimizer_iterate(m);
            if (gsl_multimin_fminimizer_size(m) < size)
                break;
        }
        double u[N];
        next = 0;
        for (size_t i = 0; i < s->of->count; i++) {
            const double sine = s->fixed[i] ? 0 : sin(gsl_vector_get(gsl_multimin_fminimizer_x(m), next++));
            u[i] = s->fixed[i] ? s->u[i] : sine * sine;
        }
        if (!s->q.error->raised)
            better(s, u, gsl_multimin_fminimizer_minimum(m) < DBL_MAX ? at(s, u) : (long double)NAN);
    }
    if (m)
        gsl_multimin_fminimizer_free(m);
    gsl_vector_free(start);
    gsl_vector_free(steps);
    return ok ? !s->q.error->raised : calc_no_memory(s->q.error);
}

static bool search_grid(search *s) {
    const size_t count = s->of->count, side = count == 2 ? 7 : 5;
    size_t places = 1;
    for (size_t i = 0; i < count; i++)
        places *= side;
    for (size_t p = 0; p < places; p++) {
        double u[N];
        for (size_t i = 0, rest = p; i < count; i++, rest /= side)
            u[i] = (double)(rest % side) / (double)(side - 1);
        const long double f = at(s, u);
        if (s->q.error->raised)
            return false;
        better(s, u, f);
    }
    return true;
}

/* Names that have come to an end of their range stay there. */
static size_t fix_ends(search *s, optimise_end end[N]) {
    size_t free = 0;
    for (size_t i = 0; i < s->of->count; i++) {
        const double to = s->u[i] < 0.5 ? 0 : 1;
        double u[N];
        for (size_t j = 0; j < N; j++)
            u[j] = s->u[j];
        u[i] = to;
        if (!s->fixed[i] && fabs(s->u[i] - to) < 1e-3 && (s->u[i] == to || better(s, u, at(s, u)))) {
            /* it may only have begun there */
            u[i] = to > 0 ? 1 - 1e-4 : 1e-4;
            if (better(s, u, at(s, u)))
                continue;
            s->fixed[i] = true;
            end[i] = to > 0 ? END_HIGH : END_LOW;
        }
    }
    for (size_t i = 0; i < s->of->count; i++)
        free += !s->fixed[i];
    return free;
}

static bool search_several(search *s, optimise_end end[N]) {
    if (!search_grid(s))
        return false;
    if (isnan(s->f))
        return true;
    if (!simplex(s, s->of->count, 0.15, 1e-4))
        return false;
    const size_t before = s->of->count, free = fix_ends(s, end);
    return !free || s->q.error->raised || free == before || simplex(s, free, 0.02, 1e-4);
}

/* ---- Newton's method --------------------------------------------------------------------------- */

/* Weights of f(x+jh)-f(x-jh) over h and of f(x+jh)+f(x-jh)-2f(x) over h^2: sixth order. */
static const long double first_weight[SLOPES] = {3 / 4.0L, -3 / 20.0L, 1 / 60.0L};
static const long double second_weight[SLOPES] = {3 / 2.0L, -3 / 20.0L, 1 / 90.0L};

static long double moved(search *s, size_t i, double by, size_t j, double also) {
    double u[N];
    for (size_t k = 0; k < N; k++)
        u[k] = s->u[k];
    u[i] += by;
    u[j] += also;
    return at(s, u);
}

/* Gradient and curvature at the best place; false: not all neighbours have values, or the question has ended.
 */
static bool differences(search *s, const size_t *free, size_t count, const double h[N], gsl_vector *g,
                        gsl_matrix *H) {
    for (size_t a = 0; a < count; a++) {
        const size_t i = free[a];
        long double slope = 0, bend = 0;
        for (int j = 1; j <= SLOPES; j++) {
            const long double up = moved(s, i, j * h[i], i, 0), down = moved(s, i, -j * h[i], i, 0);
            slope += first_weight[j - 1] * (up - down);
            bend += second_weight[j - 1] * ((up - s->f) + (down - s->f));
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
        if (isnan(gsl_vector_get(g, a)))
            return false;
    }
    return !s->q.error->raised;
}

/* One step; *length of it in parts of the ranges. False: none can be made. */
static bool newton_step(search *s, const size_t *free, size_t count, gsl_vector *g, gsl_matrix *H,
                        gsl_vector *step, double *length) {
    double h[N] = {0}, u[N];
    for (size_t a = 0; a < count; a++) {
        const double rest = fmin(s->u[free[a]], 1 - s->u[free[a]]);
        h[free[a]] = fmin(1e-3, 0.05 * rest);
        if (h[free[a]] < 1e-9)
            return false;
    }
    if (!differences(s, free, count, h, g, H) || gsl_linalg_cholesky_decomp1(H) ||
        gsl_linalg_cholesky_solve(H, g, step))
        return false;
    *length = 0;
    for (size_t k = 0; k < N; k++)
        u[k] = s->u[k];
    for (size_t a = 0; a < count; a++) {
        u[free[a]] -= gsl_vector_get(step, a);
        *length = fmax(*length, fabs(gsl_vector_get(step, a)));
        if (!(u[free[a]] > 0 && u[free[a]] < 1))
            return false;
    }
    if (!(*length < 0.1))
        return false;
    const long double f = at(s, u);
    /* where the value stands still, its slope still tells */
    if (!(f <= s->f + 1e-9L * fabsl(s->f)))
        return false;
    s->f = f;
    for (size_t k = 0; k < N; k++)
        s->u[k] = u[k];
    return true;
}

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
    double last = 1, length = 1;
    for (int i = 0; i < 6 && ok && !*sharp; i++, last = length) {
        if (!newton_step(s, free, count, g, H, step, &length) || length > last)
            break;
        *sharp = length < 1e-8 || (i > 0 && length * length / last < 1e-15);
    }
    gsl_vector_free(g);
    gsl_vector_free(step);
    gsl_matrix_free(H);
    return ok ? !s->q.error->raised : calc_no_memory(s->q.error);
}

/* ---- answers ----------------------------------------------------------------------------------- */

/* A place that Newton's method does not reach because a neighbour has no value. */
static void end_of_scene(search *s, optimise_answer *out) {
    for (size_t i = 0; i < s->of->count; i++)
        if (!s->fixed[i] && out->end[i] == END_INNER &&
            (isnan(moved(s, i, 1e-4, i, 0)) || isnan(moved(s, i, -1e-4, i, 0))))
            out->end[i] = END_SCENE;
}

/* Several names without Newton's method: a simplex that begins anew, also along the edge of the scene, until
 * nothing is gained. */
static bool stay_blunt(search *s, optimise_answer *out) {
    size_t free = 0;
    for (size_t i = 0; i < s->of->count; i++)
        free += !s->fixed[i];
    for (int i = 0; i < RESTARTS && free; i++) {
        const long double before = s->f;
        if (!simplex(s, free, i % 2 ? 0.1 : 0.02, 1e-9))
            return false;
        if (i % 2 && before - s->f <= 1e-9L * fabsl(s->f))
            break;
    }
    end_of_scene(s, out);
    return true;
}

static bool answer(search *s, optimise_answer *out, calc_error *error) {
    const expr *e = s->of->e;
    if (!(s->of->count == 1 ? search_line(s, out->end) : search_several(s, out->end)))
        return false;
    if (isnan(s->f))
        return calc_fail(error, e->at, e->len, "no value anywhere in the range: %s", s->why.text);
    if (!s->varies)
        return calc_fail(error, e->at, e->len, "%.*s is the same everywhere in the range", LEX_SHOWN(e->len),
                         e->text + e->at);
    if (out->end[0] != END_SCENE && !sharpen(s, &out->sharp))
        return false;
    if (!out->sharp &&
        !(s->of->count == 1 ? !(s->lo < s->hi) || narrow(s, s->lo, s->hi, 1e-8) : stay_blunt(s, out)))
        return false;
    for (size_t i = 0; i < s->of->count; i++)
        out->x[i] = place_of(s, i, s->u[i]);
    out->value = s->of->most ? -s->f : s->f;
    out->d = s->d;
    out->why = s->why;
    out->evaluations = s->q.evaluations;
    return !error->raised;
}

bool optimise(const optimise_question *question, optimise_answer *out, calc_error *error) {
    search s = {.of = question, .f = (long double)NAN, .seen = (long double)NAN};
    *out = (optimise_answer){.value = 0};
    gsl_set_error_handler_off();
    for (size_t i = 0; i < question->count; i++)
        s.ratios[i] = ask_in_ratios(question->lo[i], question->hi[i]);
    if (!ask_open(&s.q, question->c, question->name, question->count, error))
        return false;
    bool ok = answer(&s, out, error);
    ask_close(&s.q);
    return ok;
}
