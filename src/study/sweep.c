/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Running a sweep, curve by curve, on a scratch scene. */
#include "study/sweep.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "number/real.h"
#include "study/refine.h"

typedef struct state {
    const sweep *s;
    sweep_job *job;
    trial *t;
    size_t curve;
    sweep_range range;
    long double *values;              /* of a row */
    long double (*block)[EXPR_BLOCK]; /* of the expressions */
} state;

static bool stopped(const state *st) {
    const volatile sig_atomic_t *stop = st->job->c->scene.stop;
    return stop && *stop && !calc_interrupted(st->job->error);
}

static void say_value(char *to, size_t size, dim d, long double v) {
    char unit_text[100];
    const long double scale = unit_choose(d, v, 6, unit_text, sizeof unit_text);
    snprintf(to, size, "%.6g%s%s", (double)(v / scale), *unit_text ? " " : "", unit_text);
}

static void say_where(state *st, long double x) {
    const sweep *s = st->s;
    char at[120], with[60 + LEX_NAME] = "";
    say_value(at, sizeof at, s->along ? DIM_NONE : st->range.d, x);
    if (s->curves) {
        snprintf(with, sizeof with, ", %s = ", s->with.text);
        say_value(with + strlen(with), sizeof with - strlen(with), s->with.d, s->value[st->curve]);
    }
    snprintf(st->job->where, sizeof st->job->where, "at %s = %s%s", s->along ? "time" : s->var.text, at,
             with);
}

/* A gap, unless the error is one that no other value would mend. */
static bool gap(state *st, calc_error *error, long double x) {
    if (error->stop || error->strange || error->circle) {
        *st->job->error = *error;
        if (!error->stop) {
            say_where(st, x);
            calc_append(st->job->c, st->job->error, " (%s)", st->job->where);
        }
        return false;
    }
    if (!st->job->missing.raised) {
        st->job->missing = *error;
        calc_word(st->job->c, &st->job->missing);
        say_where(st, x);
    }
    return true;
}

static bool fits(state *st, size_t i, dim d, long double x) {
    sweep_job *job = st->job;
    if (!job->known[i]) {
        job->known[i] = true;
        job->d[i] = d;
        return true;
    }
    if (dim_equal(job->d[i], d))
        return true;
    char is[128], should[128];
    const expr *e = &job->expressions[i];
    dim_describe(d, is, sizeof is);
    dim_unit(job->d[i], should, sizeof should);
    say_where(st, x);
    return calc_fail(job->error, e->at, e->len, "%.*s is %s: it cannot be shown in %s (%s)",
                     LEX_SHOWN(e->len), e->text + e->at, is,
                     job->units && job->units[i] ? job->units[i] : should, job->where);
}

/* The expressions in the scene as it stands. */
static bool evaluate_row(state *st, long double x) {
    sweep_job *job = st->job;
    for (size_t i = 0; i < job->count; i++) {
        value v;
        calc_error error;
        error_clear(&error);
        st->values[i] = (long double)NAN;
        if (expr_eval(job->c, &job->expressions[i], &v, &error)) {
            if (!fits(st, i, v.d, x))
                return false;
            st->values[i] = v.v;
            job->values++;
            continue;
        }
        if (!gap(st, &error, x) ||
            (!job->known[i] && expr_dim(job->c, &job->expressions[i], &v.d) && !fits(st, i, v.d, x)))
            return false;
    }
    return !stopped(st);
}

static bool give_row(state *st, long double x) {
    return st->job->row(st->job->context, st->s, st->curve, x, st->values);
}

/* ---- for NAME = LO .. HI ----------------------------------------------------------------------- */

long double sweep_value(const sweep *s, const sweep_range *r, long double part) {
    if (part == 1)
        return r->hi;
    return s->log ? r->lo * fret_pow(r->hi / r->lo, part) : r->lo + (r->hi - r->lo) * part;
}

static long double sweep_at(const state *st, long double part) {
    return sweep_value(st->s, &st->range, part);
}

/* Many rows at once, all expressions or none. An input that is swept makes a new scene of every row. */
static bool run_block(state *st, const long double *x, size_t rows) {
    sweep_job *job = st->job;
    dim d;
    if (st->s->var.is_input)
        return false;
    for (size_t i = 0; i < job->count; i++)
        if (!expr_eval_block(job->c, &job->expressions[i], st->s->var.name, x, rows, st->block[i], &d) ||
            (job->known[i] && !dim_equal(job->d[i], d)) || !fits(st, i, d, x[0]))
            return false;
    job->values += rows * job->count;
    return true;
}

static bool one_row(state *st, long double x) {
    calc_error error;
    error_clear(&error);
    knob var = st->s->var;
    var.d = st->range.d;
    if (trial_set(st->t, &var, x, &error))
        return evaluate_row(st, x);
    for (size_t i = 0; i < st->job->count; i++) {
        dim d;
        st->values[i] = (long double)NAN;
        if (!st->job->known[i] && expr_dim(st->job->c, &st->job->expressions[i], &d) && !fits(st, i, d, x))
            return false;
    }
    return gap(st, &error, x);
}

static void progress(const state *st, size_t row) {
    const size_t curves = st->s->curves ? st->s->curves : 1;
    if (st->job->progress)
        st->job->progress(st->job->context,
                          ((double)st->curve + (double)row / (double)(st->s->steps + 1)) / (double)curves);
}

/* Up to EXPR_BLOCK rows, one after the other in `out`. */
static bool evaluate_rows(void *context, const long double *part, size_t rows, long double *out) {
    state *st = context;
    const size_t count = st->job->count;
    long double x[EXPR_BLOCK] = {0};
    for (size_t r = 0; r < rows; r++)
        x[r] = sweep_at(st, part[r]);
    const bool whole = run_block(st, x, rows);
    for (size_t r = 0; r < rows; r++) {
        for (size_t j = 0; whole && j < count; j++)
            st->values[j] = st->block[j][r];
        if (!whole && !one_row(st, x[r]))
            return false;
        memcpy(out + r * count, st->values, count * sizeof *out);
    }
    return !stopped(st);
}

static bool give_part(void *context, long double part, const long double *values) {
    state *st = context;
    return st->job->row(st->job->context, st->s, st->curve, sweep_at(st, part), values);
}

/* Every row goes out as soon as it is there: an error loses none before it. */
static bool run_evenly(state *st) {
    const size_t steps = st->s->steps, count = st->job->count;
    long double x[EXPR_BLOCK];
    bool ok = true;
    for (size_t i = 0, rows; ok && i <= steps; i += rows) {
        rows = steps - i < EXPR_BLOCK ? steps - i + 1 : EXPR_BLOCK;
        for (size_t r = 0; r < rows; r++)
            x[r] = sweep_at(st, (long double)(i + r) / (long double)steps);
        progress(st, i);
        const bool whole = run_block(st, x, rows);
        for (size_t r = 0; ok && r < rows; r++) {
            for (size_t j = 0; whole && j < count; j++)
                st->values[j] = st->block[j][r];
            ok = (whole || one_row(st, x[r])) && give_row(st, x[r]);
        }
        ok = ok && !stopped(st);
    }
    return ok;
}

static bool run_range(state *st) {
    knob var = st->s->var;
    var.d = st->range.d;
    if (!var.is_input && !trial_set(st->t, &var, st->range.lo, st->job->error))
        return false;
    if (!st->s->refine)
        return run_evenly(st);
    const refinement r = {.count = st->job->count,
                          .steps = st->s->steps,
                          .rows = EXPR_BLOCK,
                          .evaluate = evaluate_rows,
                          .give = give_part,
                          .context = st};
    return refine(&r, st->job->error);
}

/* ---- along a load ------------------------------------------------------------------------------ */

static bool look(void *context, double time, calc_error *error) {
    state *st = context;
    (void)error;
    return evaluate_row(st, time) && give_row(st, time);
}

bool sweep_try_load(trial *t, const sweep_range *range, load_mark *from, calc_error *error) {
    scene *tried = &t->scene;
    double mu;
    *from = tried->end;
    if (!tried->end.steps)
        return calc_fail(error, 0, 0, "there is no load yet: press first (press FN=100 N)");
    if (!scene_friction(tried, &mu, error) ||
        !scene_append(tried, &range->step, range->step.kind == LOAD_CYCLE ? &range->extra : NULL, error))
        return false;
    for (input in = 0; in < INPUTS; in++)
        if (range->bound[in])
            inputs_bind(&tried->in, in, counted_hold(range->bound[in]));
    return true;
}

static bool run_along(state *st) {
    const sweep *s = st->s;
    load_mark from = st->t->scene.end;
    if (s->what == ALONG_LOAD && !sweep_try_load(st->t, &st->range, &from, st->job->error))
        return false;
    calc_error error;
    error_clear(&error);
    if (trial_along(st->t, s->what, from, s->steps, s->turns, look, st, &error))
        return true;
    if (!st->job->error->raised)
        *st->job->error = error;
    return false;
}

/* ---- curves ------------------------------------------------------------------------------------ */

static bool run_curve(state *st) {
    const sweep *s = st->s;
    calc_error *error = st->job->error;
    if (s->curves && !trial_set(st->t, &s->with, s->value[st->curve], error))
        return false;
    st->range = (sweep_range){.lo = 0};
    bool ok = s->range(s, &st->range, error);
    if (ok && !s->along && s->log && !(st->range.lo > 0 && st->range.hi > 0))
        ok = calc_fail(error, 0, 0, "a logarithmic sweep needs positive ends");
    ok = ok && (s->along ? run_along : run_range)(st);
    for (input in = 0; in < INPUTS; in++)
        counted_drop(st->range.bound[in]);
    return ok;
}

bool sweep_nothing(sweep_job *job) {
    *job->error = job->missing;
    calc_append(job->c, job->error, " (%s)", job->where);
    return false;
}

bool sweep_run(const sweep *s, sweep_job *job) {
    const size_t curves = s->curves ? s->curves : 1;
    state st = {.s = s, .job = job};
    if (!job->part) {
        error_clear(&job->missing);
        job->values = 0;
    }
    st.values = malloc(job->count * sizeof *st.values);
    st.block = malloc(job->count * sizeof *st.block);
    bool ok = st.values && st.block;
    if (!ok)
        calc_no_memory(job->error);
    for (; st.curve < curves && ok; st.curve++) {
        st.t = trial_open(job->c, job->error);
        ok = st.t && run_curve(&st);
        calc_word(job->c, job->error);
        if (st.t)
            trial_close(st.t);
    }
    free(st.values);
    free(st.block);
    return ok && (job->part || job->values > 0 || !job->missing.raised || sweep_nothing(job));
}
