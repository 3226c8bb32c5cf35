/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Derivatives and samples. */
#include "study/uncertainty.h"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_randist.h>
#include <gsl/gsl_rng.h>
#include <math.h>

#include "calc/clock.h"
#include "study/team.h"

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

/* Close to the end of the scene, or where the deviation is far greater than the value, a smaller step must
 * do. */
static bool derivative_of(state *s, const double *x, size_t i, long double slope[UNCERTAIN_VALUES],
                          const calc_error *error) {
    const double h = ask_step(1e-3, x[i], 0.1 * s->of->deviation[i]),
                 steps[] = {h, 1e-3 * h, 1e-3 * fabs(x[i])};
    for (size_t k = 0; k < sizeof steps / sizeof *steps && steps[k] > 0 && !error->raised; k++)
        if (derivative(s, x, i, steps[k], slope))
            return true;
    return false;
}

static bool first_order(state *s, uncertainty_answer *out, calc_error *error) {
    const uncertainty_question *of = s->of;
    long double v[UNCERTAIN_VALUES], slope[UNCERTAIN_VALUES];
    /* squares leave the range of double where what they are of does not */
    long double variance[UNCERTAIN_VALUES] = {0}, part[UNCERTAIN_VALUES][UNCERTAIN_NAMES];
    if (!all_at(s, out->x, v))
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
        u->v = v[k];
        u->d = s->d[k];
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

/* Mean and sum of squared distances from it, as they go along (Welford). */
static void take(uncertain *u, double v, long double *squares) {
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

/* Samples go in portions, to a team where it pays; they are drawn, and counted, in their order. */
enum { SAMPLES = 16 };

typedef struct portion {
    unsigned samples;
    double x[SAMPLES][UNCERTAIN_NAMES];
} portion;

typedef struct outcome {
    scene_use used;
    bool missing;                        /* a value is */
    double v[SAMPLES][UNCERTAIN_VALUES]; /* NaN: there is none */
} outcome;

typedef struct sampling {
    state *s;
    uncertainty_answer *answer;
    gsl_rng *rng;
    long double squares[UNCERTAIN_VALUES];
    unsigned drawn, counted;
    double taken; /* seconds */
    team *t;
} sampling;

static void draw(void *context, size_t part, void *in) {
    sampling *m = context;
    const uncertainty_question *of = m->s->of;
    portion *p = in;
    (void)part;
    for (p->samples = 0; p->samples < SAMPLES && m->drawn < of->samples; p->samples++, m->drawn++)
        for (size_t i = 0; i < of->count; i++)
            p->x[p->samples][i] = m->answer->x[i] + gsl_ran_gaussian_ziggurat(m->rng, of->deviation[i]);
}

static bool evaluate(void *context, const void *in, void *out) {
    sampling *m = context;
    state *s = m->s;
    const portion *p = in;
    outcome *o = out;
    calc_error *missing = &m->answer->missing;
    error_clear(missing);
    s->q.t->scene.used = 0;
    for (unsigned n = 0; n < p->samples && !s->q.error->raised; n++) {
        const bool set = ask_set(&s->q, p->x[n]);
        for (size_t k = 0; k < s->of->expressions; k++) {
            long double v;
            const bool has = set && ask_value(&s->q, &s->of->e[k], &s->d[k], &s->known[k], &v);
            o->v[n][k] = has ? (double)v : (double)NAN;
            if (!has && !missing->raised)
                *missing = s->q.none;
        }
    }
    o->used = scene_answered_by(&s->q.t->scene);
    o->missing = missing->raised;
    return !s->q.error->raised;
}

static bool count(void *context, size_t part, const void *in, const void *out) {
    sampling *m = context;
    state *s = m->s;
    const portion *p = in;
    const outcome *o = out;
    outcome own;
    (void)part;
    if (!o || (o->missing && !m->answer->missing.raised)) {
        const calc_error before = m->answer->missing;
        const scene_use used = scene_answered_by(&s->q.t->scene);
        const double began = clock_wall();
        const bool ok = evaluate(m, p, &own);
        m->taken += clock_wall() - began;
        scene_also_used(&s->q.t->scene, used);
        if (before.raised)
            m->answer->missing = before;
        if (!ok)
            return false;
        o = &own;
    } else {
        s->q.evaluations += p->samples;
        scene_also_used(&s->q.t->scene, o->used);
    }
    for (unsigned n = 0; n < p->samples; n++)
        for (size_t k = 0; k < s->of->expressions; k++)
            if (!isnan(o->v[n][k]))
                take(&m->answer->value[k], o->v[n][k], &m->squares[k]);
    m->counted += p->samples;
    return true;
}

static bool sample(sampling *m) {
    const unsigned all = m->s->of->samples;
    portion p;
    while (m->counted < all && !team_pays(m->s->of->c, m->taken, m->counted, all)) {
        draw(m, 0, &p);
        if (!count(m, 0, &p, NULL))
            return false;
    }
    const team_run rest = {
        .parts = (all - m->counted + SAMPLES - 1) / SAMPLES, .give = draw, .take = count, .context = m};
    m->t = rest.parts ? team_begin(&(team_job){.c = m->s->of->c,
                                               .in = sizeof(portion),
                                               .out = sizeof(outcome),
                                               .work = evaluate,
                                               .context = m})
                      : NULL;
    if (m->t)
        return team_work(m->t, &rest) || m->s->q.error->raised || calc_interrupted(m->s->q.error);
    for (size_t i = 0; i < rest.parts; i++) {
        draw(m, i, &p);
        if (!count(m, i, &p, NULL))
            return false;
    }
    return true;
}

static bool monte_carlo(state *s, uncertainty_answer *out, calc_error *error) {
    sampling m = {.s = s, .answer = out, .rng = gsl_rng_alloc(gsl_rng_mt19937)};
    if (!m.rng)
        return calc_no_memory(error);
    gsl_rng_set(m.rng, s->of->seed);
    sample(&m);
    team_end(m.t);
    gsl_rng_free(m.rng);
    for (size_t k = 0; k < s->of->expressions; k++) {
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
        if (!ask_present(question->c, &question->name[i], &out->x[i]))
            return ask_lacks(question->c, &question->name[i], "", "", error);
    if (!ask_open(&s.q, question->c, question->name, question->count, error))
        return false;
    bool ok = first_order(&s, out, error) && monte_carlo(&s, out, error);
    out->evaluations = s.q.evaluations;
    ask_close(&s.q);
    return ok;
}
