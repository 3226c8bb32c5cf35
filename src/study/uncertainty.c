/* SPDX-License-Identifier: GPL-3.0-or-later */
/* First order by derivatives, and the Monte Carlo simulation. Depends on points.h and GSL. */
#include "study/uncertainty.h"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_errno.h>
#include <math.h>
#include <stdint.h>

typedef struct state {
    const uncertainty_question *of;
    points p;
    dim d[UNCERTAIN_VALUES];
    bool known[UNCERTAIN_VALUES];
} state;

/* All values keep their dimensions; a missing one (NaN) has none. */
static bool keep_dims(state *s, const value v[]) {
    for (size_t k = 0; k < s->of->expressions; k++)
        if (!isnan(v[k].v) && !points_keeps(&s->p, k, v[k].d, &s->d[k], &s->known[k]))
            return false;
    return true;
}

/* Evaluates all expressions; false: one has no value, or p.error is raised. */
static bool all_at(state *s, const long double x[], value v[UNCERTAIN_VALUES]) {
    return points_at(&s->p, x, v) && keep_dims(s, v);
}

/* ---- first order ------------------------------------------------------------------------------- */

/* Raises the reason why a value is missing, unless an error is raised already. */
static bool no_value(const state *s, calc_error *error, const char *name) {
    if (!error->raised) {
        *error = s->p.none;
        if (name)
            calc_append(s->of->c, error, " (close beside the present %s, for the derivative)", name);
    }
    return false;
}

static bool derivative(state *s, const double *x, size_t i, double h, long double slope[UNCERTAIN_VALUES]) {
    long double up[UNCERTAIN_NAMES], down[UNCERTAIN_NAMES];
    value above[UNCERTAIN_VALUES], below[UNCERTAIN_VALUES];
    for (size_t k = 0; k < UNCERTAIN_NAMES; k++)
        up[k] = down[k] = x[k];
    for (size_t k = 0; k < s->of->expressions; k++)
        slope[k] = 0;
    for (int j = 1; j <= POINTS_SLOPES; j++) {
        up[i] = x[i] + j * h;
        down[i] = x[i] - j * h;
        if (!all_at(s, up, above) || !all_at(s, down, below))
            return false;
        const long double apart = up[i] - down[i]; /* 2 j h with the rounding of x */
        for (size_t k = 0; k < s->of->expressions; k++)
            slope[k] += 2 * j * points_slope[j - 1] * (above[k].v - below[k].v) / apart;
    }
    return true;
}

/* Tries smaller steps close to the limit of the scene, or if the deviation is far greater than the value. */
static bool derivative_of(state *s, const double *x, size_t i, long double slope[UNCERTAIN_VALUES],
                          const calc_error *error) {
    const double h = points_step(1e-3, x[i], 0.1 * s->of->deviation[i]),
                 steps[] = {h, 1e-3 * h, 1e-3 * fabs(x[i])};
    for (size_t k = 0; k < sizeof steps / sizeof *steps && steps[k] > 0 && !error->raised; k++)
        if (derivative(s, x, i, steps[k], slope))
            return true;
    return false;
}

static bool first_order(state *s, uncertainty_answer *out, calc_error *error) {
    const uncertainty_question *of = s->of;
    long double x[UNCERTAIN_NAMES], slope[UNCERTAIN_VALUES];
    value v[UNCERTAIN_VALUES];
    /* long double: squares could overflow or underflow a double */
    long double variance[UNCERTAIN_VALUES] = {0}, part[UNCERTAIN_VALUES][UNCERTAIN_NAMES];
    for (size_t i = 0; i < of->count; i++)
        x[i] = out->x[i];
    if (!all_at(s, x, v))
        return no_value(s, error, NULL);
    for (size_t i = 0; i < of->count; i++) {
        if (!derivative_of(s, out->x, i, slope, error))
            return no_value(s, error, of->name[i].text);
        for (size_t k = 0; k < of->expressions; k++) {
            const long double moved = slope[k] * of->deviation[i];
            part[k][i] = moved * moved;
            variance[k] += part[k][i];
        }
    }
    for (size_t k = 0; k < of->expressions; k++) {
        uncertain *u = &out->value[k];
        u->v = v[k].v;
        u->d = v[k].d;
        u->deviation = (double)sqrtl(variance[k]);
        if (isinf(u->deviation))
            return calc_fail(error, of->e[k].at, of->e[k].len,
                             "the deviation is too large for double precision");
        for (size_t i = 0; i < of->count; i++)
            u->share[i] = variance[k] > 0 ? (double)(part[k][i] / variance[k]) : 0;
    }
    return true;
}

/* ---- Monte Carlo ------------------------------------------------------------------------------- */

/* Updates the mean and the sum of squared deviations from it (Welford). */
static void take_sample(uncertain *u, double v, long double *squares) {
    const long double off = (long double)v - u->mean;
    u->samples++;
    u->mean += (double)(off / u->samples);
    *squares += off * ((long double)v - u->mean);
}

static bool differs(const uncertain *u) {
    const double n = u->samples;
    if (u->samples < 2)
        return false;
    const double mean = fmax(0.05 * u->deviation, 3 * u->spread / sqrt(n));
    const double spread = fmax(0.05 * u->deviation, 3 * u->spread / sqrt(2 * n));
    return fabs(u->mean - (double)u->v) > mean || fabs(u->spread - u->deviation) > spread;
}

/* The i-th 64 random bits of the sequence `key`, from a counter alone (SplitMix64, Steele et al. 2014). */
static uint64_t random_bits(uint64_t key, uint64_t i) {
    uint64_t z = key + (i + 1) * UINT64_C(0x9e3779b97f4a7c15);
    z = (z ^ (z >> 30)) * UINT64_C(0xbf58476d1ce4e5b9);
    z = (z ^ (z >> 27)) * UINT64_C(0x94d049bb133111eb);
    return z ^ (z >> 31);
}

/* Each sample has its own sequence, so that it can be drawn without those before it. */
static double normal_deviate(unsigned seed, size_t sample, size_t i) {
    const uint64_t own = random_bits(random_bits(seed, 0), sample);
    return gsl_cdf_ugaussian_Pinv(((double)(random_bits(own, i) >> 11) + 0.5) * 0x1p-53);
}

typedef struct sampling {
    state *s;
    uncertainty_answer *answer;
    long double squares[UNCERTAIN_VALUES];
} sampling;

static void draw_sample(void *context, size_t i, long double x[]) {
    const sampling *m = context;
    const uncertainty_question *of = m->s->of;
    for (size_t k = 0; k < of->count; k++)
        x[k] = m->answer->x[k] + of->deviation[k] * normal_deviate(of->seed, of->from + i, k);
}

static void count_sample(sampling *m, const value v[]) {
    for (size_t k = 0; k < m->s->of->expressions; k++)
        if (!isnan(v[k].v))
            take_sample(&m->answer->value[k], (double)v[k].v, &m->squares[k]);
}

static bool take_drawn(void *context, size_t i, const value v[], const calc_error *why) {
    sampling *m = context;
    const uncertainty_question *of = m->s->of;
    if (why && !m->answer->missing.raised)
        m->answer->missing = *why;
    count_sample(m, v);
    return keep_dims(m->s, v) && (!of->take || of->take(of->context, of->from + i, v));
}

static void count_given(sampling *m) {
    value v[UNCERTAIN_VALUES] = {{.v = 0}};
    for (size_t i = 0; i < m->s->of->samples; i++) {
        for (size_t k = 0; k < m->s->of->expressions; k++)
            v[k].v = m->s->of->given[k][i];
        count_sample(m, v);
    }
}

static bool monte_carlo(state *s, uncertainty_answer *out, const calc_error *error) {
    const uncertainty_question *of = s->of;
    sampling m = {.s = s, .answer = out};
    if (of->given)
        count_given(&m);
    else
        points_go(&s->p,
                  &(points_run){
                      .count = of->to - of->from, .give = draw_sample, .take = take_drawn, .context = &m});
    for (size_t k = 0; k < of->expressions; k++) {
        uncertain *u = &out->value[k];
        u->mean = u->samples > 0 ? u->mean : NAN;
        u->spread = u->samples > 1 ? (double)sqrtl(m.squares[k] / (u->samples - 1)) : NAN;
        u->differs = differs(u);
    }
    return !error->raised;
}

bool uncertainty(const uncertainty_question *question, uncertainty_answer *out, calc_error *error) {
    state s = {.of = question};
    *out = (uncertainty_answer){.evaluations = 0};
    error_clear(&out->missing);
    gsl_set_error_handler_off();
    for (size_t i = 0; i < question->count; i++)
        if (!knob_present(question->c, &question->name[i], &out->x[i]))
            return knob_lacks(question->c, &question->name[i], "", "", error);
    const bool ok = points_open(&s.p, question->c, question->name, question->count, question->e,
                                question->expressions, error) &&
                    first_order(&s, out, error) && monte_carlo(&s, out, error);
    out->evaluations = s.p.evaluations;
    points_close(&s.p);
    return ok;
}
