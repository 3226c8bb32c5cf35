/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Derivatives and samples. */
#include "study/uncertainty.h"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_randist.h>
#include <gsl/gsl_rng.h>
#include <math.h>

typedef struct state {
    const uncertainty_question *of;
    ask q;
    dim d[UNCERTAIN_VALUES];
    bool known[UNCERTAIN_VALUES];
} state;

/* All expressions there; false: one has no value, or the question has ended. */
static bool all_at(state *s, const double *x, long double v[UNCERTAIN_VALUES]) {
    bool ok = ask_set(&s->q, x);
    for (size_t i = 0; i < s->of->expressions && ok; i++)
        ok = ask_value(&s->q, &s->of->e[i], &s->d[i], &s->known[i], &v[i]);
    return ok;
}

/* ---- first order ------------------------------------------------------------------------------- */

/* One error at most, that of the user. */
static bool no_value(const state *s, calc_error *error, const char *beside) {
    if (!error->raised) {
        *error = s->q.none;
        if (beside)
            calc_append(s->of->c, error, " (close beside the present %s, for the derivative)", beside);
    }
    return false;
}

/* Differences of sixth order, as optimise.c has them. */
static bool derivative(state *s, const double *x, size_t i, double h, long double slope[UNCERTAIN_VALUES]) {
    static const long double weight[] = {3 / 4.0L, -3 / 20.0L, 1 / 60.0L};
    double up[UNCERTAIN_NAMES], down[UNCERTAIN_NAMES];
    long double above[UNCERTAIN_VALUES], below[UNCERTAIN_VALUES];
    for (size_t k = 0; k < UNCERTAIN_NAMES; k++)
        up[k] = down[k] = x[k];
    for (size_t k = 0; k < s->of->expressions; k++)
        slope[k] = 0;
    for (int j = 1; j <= 3; j++) {
        up[i] = x[i] + j * h;
        down[i] = x[i] - j * h;
        if (!all_at(s, up, above) || !all_at(s, down, below))
            return false;
        const long double apart = (long double)up[i] - down[i]; /* as it has been rounded */
        for (size_t k = 0; k < s->of->expressions; k++)
            slope[k] += 2 * j * weight[j - 1] * (above[k] - below[k]) / apart;
    }
    return true;
}

static bool first_order(state *s, uncertainty_answer *out, calc_error *error) {
    const uncertainty_question *of = s->of;
    long double v[UNCERTAIN_VALUES], slope[UNCERTAIN_VALUES];
    double variance[UNCERTAIN_VALUES] = {0};
    if (!all_at(s, out->x, v))
        return no_value(s, error, NULL);
    for (size_t i = 0; i < of->count; i++) {
        const double h = out->x[i] != 0 ? 1e-3 * fabs(out->x[i]) : of->deviation[i];
        /* close to the end of the scene a smaller step must do */
        if (!derivative(s, out->x, i, h, slope) &&
            (error->raised || !derivative(s, out->x, i, 1e-3 * h, slope)))
            return no_value(s, error, of->name[i].text);
        for (size_t k = 0; k < of->expressions; k++) {
            const double part = (double)slope[k] * of->deviation[i];
            out->value[k].share[i] = part * part;
            variance[k] += part * part;
        }
    }
    for (size_t k = 0; k < of->expressions; k++) {
        uncertain *u = &out->value[k];
        u->v = v[k];
        u->d = s->d[k];
        u->deviation = sqrt(variance[k]);
        for (size_t i = 0; i < of->count; i++)
            u->share[i] = variance[k] > 0 ? u->share[i] / variance[k] : 0;
    }
    return true;
}

/* ---- Monte Carlo ------------------------------------------------------------------------------- */

/* Mean and sum of squared distances from it, as they go along (Welford). */
static void take(uncertain *u, double v, double *squares) {
    const double off = v - u->mean;
    u->samples++;
    u->mean += off / u->samples;
    *squares += off * (v - u->mean);
}

static bool differs(const uncertain *u) {
    const double n = u->samples;
    if (u->samples < 2)
        return false;
    const double mean = fmax(0.05 * u->deviation, 3 * u->spread / sqrt(n));
    const double spread = fmax(0.05 * u->deviation, 3 * u->spread / sqrt(2 * n));
    return fabs(u->mean - (double)u->v) > mean || fabs(u->spread - u->deviation) > spread;
}

static bool monte_carlo(state *s, uncertainty_answer *out, calc_error *error) {
    const uncertainty_question *of = s->of;
    double squares[UNCERTAIN_VALUES] = {0}, x[UNCERTAIN_NAMES];
    gsl_rng *rng = gsl_rng_alloc(gsl_rng_mt19937);
    if (!rng)
        return calc_no_memory(error);
    gsl_rng_set(rng, of->seed);
    for (unsigned n = 0; n < of->samples && !error->raised; n++) {
        for (size_t i = 0; i < of->count; i++)
            x[i] = out->x[i] + gsl_ran_gaussian_ziggurat(rng, of->deviation[i]);
        const bool set = ask_set(&s->q, x);
        if (!set && !out->missing.raised)
            out->missing = s->q.none;
        for (size_t k = 0; k < of->expressions && set; k++) {
            long double v;
            if (ask_value(&s->q, &of->e[k], &s->d[k], &s->known[k], &v))
                take(&out->value[k], (double)v, &squares[k]);
            else if (!out->missing.raised)
                out->missing = s->q.none;
        }
    }
    gsl_rng_free(rng);
    for (size_t k = 0; k < of->expressions; k++) {
        uncertain *u = &out->value[k];
        u->spread = u->samples > 1 ? sqrt(squares[k] / (u->samples - 1)) : 0;
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
        if (!ask_present(question->c, &question->name[i], &out->x[i]))
            return calc_fail(error, 0, 0, "%s has no value", question->name[i].text);
    if (!ask_open(&s.q, question->c, question->name, question->count, error))
        return false;
    bool ok = first_order(&s, out, error) && monte_carlo(&s, out, error);
    out->evaluations = s.q.evaluations;
    ask_close(&s.q);
    return ok;
}
