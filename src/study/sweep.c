/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Running a sweep, curve by curve, on a scratch scene. */
#include "study/sweep.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "calc/clock.h"
#include "number/real.h"
#include "study/refine.h"
#include "study/team.h"

enum { PORTION = 256 }; /* rows, at most */

typedef struct state {
    const sweep *s;
    sweep_job *job;
    trial *t;
    size_t curve;
    long double with; /* its value */
    sweep_range range;
    long double *values; /* of a portion, row by row */
    long double *row;    /* of the row that is being evaluated */
    /* of the range */
    size_t rows;
    const long double *part; /* where each row is in it, 0..1; NULL: evenly */
    long double *out;        /* of all rows; NULL: they go to the job as soon as they are there */
} state;

static bool stopped(const state *st) {
    return calc_stopped(st->job->c->scene.stop, st->job->error);
}

static void say_where(state *st, long double x) {
    const sweep *s = st->s;
    char at[120], with[60 + LEX_NAME] = "";
    calc_amount(s->along ? DIM_NONE : st->range.d, x, 6, at, sizeof at);
    if (s->curves) {
        snprintf(with, sizeof with, ", %s = ", s->with.text);
        calc_amount(s->with.d, s->value[st->curve], 6, with + strlen(with), sizeof with - strlen(with));
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

/* The first that is found holds for all. */
static bool is_its_dim(sweep_job *job, size_t i, dim d) {
    if (!job->known[i]) {
        job->known[i] = true;
        job->d[i] = d;
    }
    return dim_equal(job->d[i], d);
}

static void find_dim(sweep_job *job, size_t i) {
    dim d;
    if (!job->known[i] && expr_dim(job->c, &job->expressions[i], &d))
        is_its_dim(job, i, d);
}

static bool fits(state *st, size_t i, dim d, long double x) {
    sweep_job *job = st->job;
    if (is_its_dim(job, i, d))
        return true;
    char is[128], should[128];
    const expr *e = &job->expressions[i];
    dim_describe(d, is, sizeof is);
    dim_unit(job->d[i], should, sizeof should);
    say_where(st, x);
    const char *in = job->units && job->units[i] ? job->units[i] : should;
    return calc_fail(job->error, e->at, e->len, "%.*s is %s: it cannot be shown %s%s (%s)", LEX_SHOWN(e->len),
                     e->text + e->at, is, *in ? "in " : "as a number", in, job->where);
}

/* The expressions in the scene as it stands. */
static bool evaluate_row(state *st, long double x) {
    sweep_job *job = st->job;
    for (size_t i = 0; i < job->count; i++) {
        value v;
        calc_error error;
        error_clear(&error);
        st->row[i] = (long double)NAN;
        if (expr_eval(job->c, &job->expressions[i], &v, &error)) {
            if (!fits(st, i, v.d, x))
                return false;
            st->row[i] = v.v;
            job->values++;
            continue;
        }
        if (!gap(st, &error, x))
            return false;
        find_dim(job, i);
    }
    return !stopped(st);
}

/* ---- for NAME = LO .. HI ----------------------------------------------------------------------- */

long double sweep_value(const sweep *s, const sweep_range *r, long double part) {
    if (part == 1)
        return r->hi;
    return s->log ? r->lo * fret_pow(r->hi / r->lo, part) : r->lo + (r->hi - r->lo) * part;
}

static long double place(const state *st, size_t row) {
    return sweep_value(st->s, &st->range,
                       st->part ? st->part[row] : (long double)row / (long double)st->s->steps);
}

static bool one_row(state *st, long double x) {
    calc_error error;
    error_clear(&error);
    knob var = st->s->var;
    var.d = st->range.d;
    if (trial_set(st->t, &var, x, &error))
        return evaluate_row(st, x);
    for (size_t i = 0; i < st->job->count; i++) {
        st->row[i] = (long double)NAN;
        find_dim(st->job, i);
    }
    return gap(st, &error, x);
}

/* How many rows there are before one that ends it. */
static size_t evaluate(state *st, const long double *x, size_t rows, long double *values) {
    for (size_t r = 0; r < rows; r++) {
        st->row = values + r * st->job->count;
        if (!one_row(st, x[r]))
            return r;
    }
    return rows;
}

static bool give_rows(state *st, size_t first, const long double *x, const long double *values, size_t rows) {
    const size_t count = st->job->count;
    st->job->done += rows;
    if (st->out)
        memcpy(st->out + first * count, values, rows * count * sizeof *values);
    for (size_t r = 0; !st->out && r < rows; r++)
        if (!st->job->row(st->job->context, st->s, st->curve, x[r], values + r * count))
            return false;
    return !stopped(st);
}

/* An error loses no row before it. */
static bool run_rows(state *st, size_t first, const long double *x, size_t rows) {
    const double began = clock_wall();
    const size_t n = evaluate(st, x, rows, st->values);
    st->job->taken += clock_wall() - began;
    return give_rows(st, first, x, st->values, n) && n == rows;
}

/* ---- by a team --------------------------------------------------------------------------------- */

/* Rows one after the other, and the circumstances of their curve. */
typedef struct portion {
    long double with;
    sweep_range range;
    size_t rows;
    long double x[PORTION];
} portion;

/* What comes of them; behind it a found for each expression, and the values, row by row. */
typedef struct outcome {
    scene_use used;
    bool missing; /* a value is */
    size_t values;
} outcome;

typedef struct found {
    dim d;
    bool known;
} found;

static size_t found_at(void) {
    return (sizeof(outcome) + 63) / 64 * 64;
}

static size_t values_at(size_t count) {
    return found_at() + (count * sizeof(found) + 63) / 64 * 64;
}

/* Fixes the name of `with`. */
static bool set_curve(state *st, calc_error *error) {
    return !st->s->curves || trial_set(st->t, &st->s->with, st->with, error);
}

/* As it went with the one who gives. */
static void begin_curve(state *st, calc_error *error) {
    knob var = st->s->var;
    var.d = st->range.d;
    st->t = trial_open(st->job->c, error);
    if (!st->t) /* unreached: memory runs out here alone */
        _exit(0);
    set_curve(st, error);
    if (!var.is_input)
        trial_set(st->t, &var, st->range.lo, error);
    if (error->raised) /* unreached: memory runs out here alone */
        _exit(0);
}

/* In a copy, whose state is its own. */
static bool work(void *context, const void *in, void *out) {
    state *st = context;
    sweep_job *job = st->job;
    const portion *p = in;
    outcome *o = out;
    found *f = (found *)((char *)out + found_at());
    error_clear(job->error);
    error_clear(&job->missing);
    job->values = 0;
    const bool same = p->with == st->with;
    st->range = p->range;
    st->with = p->with;
    if (!same) {
        trial_close(st->t);
        begin_curve(st, job->error);
    }
    st->t->scene.used = 0;
    const bool ok =
        evaluate(st, p->x, p->rows, (long double *)((char *)out + values_at(job->count))) == p->rows;
    *o = (outcome){scene_answered_by(&st->t->scene), job->missing.raised, job->values};
    for (size_t i = 0; i < job->count; i++)
        f[i] = (found){job->d[i], job->known[i]};
    return ok;
}

typedef struct sharing {
    state *st;
    size_t first, rows; /* where it begins; rows of a portion */
} sharing;

static void give(void *context, size_t part, void *in) {
    const sharing *sh = context;
    const state *st = sh->st;
    portion *p = in;
    const size_t row = sh->first + part * sh->rows;
    p->with = st->with;
    p->range = st->range;
    p->rows = st->rows - row < sh->rows ? st->rows - row : sh->rows;
    for (size_t i = 0; i < p->rows; i++)
        p->x[i] = place(st, row + i);
}

/* Dimensions as they have been found before, and no gap that would be the first to be told. */
static bool agrees(const sweep_job *job, const outcome *o, const found *f) {
    for (size_t i = 0; i < job->count; i++)
        if (f[i].known != job->known[i] || !dim_equal(f[i].d, job->d[i]))
            return false;
    return !o->missing || job->missing.raised;
}

static bool take(void *context, size_t part, const void *in, const void *out) {
    const sharing *sh = context;
    state *st = sh->st;
    sweep_job *job = st->job;
    const portion *p = in;
    const outcome *o = out;
    const size_t row = sh->first + part * sh->rows;
    if (!o || !agrees(job, o, (const found *)((const char *)out + found_at())))
        return run_rows(st, row, p->x, p->rows);
    const long double *values = (const long double *)((const char *)out + values_at(job->count));
    job->values += o->values;
    scene_also_used(&st->t->scene, o->used);
    return give_rows(st, row, p->x, values, p->rows);
}

/* Few where there are few, so that a team can share those that take long. */
static size_t portion_rows(const state *st) {
    const size_t rows = st->rows / 64;
    return rows < 1 ? 1 : rows < PORTION ? rows : PORTION;
}

/* Has it come to be worth while? */
static bool shared(state *st) {
    sweep_job *job = st->job;
    if (job->team || job->alone || !team_pays(job->c, job->taken, (double)job->done, (double)job->all))
        return job->team;
    const size_t out = values_at(job->count) + PORTION * job->count * sizeof *st->values;
    job->team =
        team_begin(&(team_job){.c = job->c, .in = sizeof(portion), .out = out, .work = work, .context = st});
    job->alone = !job->team;
    return job->team;
}

/* From a row on. */
static bool share(state *st, size_t row) {
    sharing sh = {.st = st, .first = row, .rows = portion_rows(st)};
    const team_run run = {
        .parts = (st->rows - row + sh.rows - 1) / sh.rows, .give = give, .take = take, .context = &sh};
    const bool ok = team_work(st->job->team, &run);
    return !stopped(st) && ok;
}

static bool run_all(state *st) {
    sweep_job *job = st->job;
    const size_t most = portion_rows(st);
    long double x[PORTION];
    if (job->done + st->rows > job->all)
        job->all = job->done + st->rows;
    for (size_t i = 0, rows; i < st->rows; i += rows) {
        if (st->rows - i > most && shared(st))
            return share(st, i);
        rows = st->rows - i < most ? st->rows - i : most;
        for (size_t r = 0; r < rows; r++)
            x[r] = place(st, i + r);
        if (!run_rows(st, i, x, rows))
            return false;
    }
    return true;
}

void sweep_begin(sweep_job *job, size_t rows) {
    error_clear(&job->missing);
    job->values = job->done = 0;
    job->all = rows;
    job->taken = 0;
}

void sweep_end(sweep_job *job) {
    team_end(job->team);
    job->team = NULL;
}

/* ---- even rows, or where they are wanted ------------------------------------------------------- */

static bool evaluate_rows(void *context, const long double *part, size_t rows, long double *out) {
    state *st = context;
    st->part = part;
    st->rows = rows;
    st->out = out;
    return run_all(st);
}

static bool give_part(void *context, long double part, const long double *values) {
    state *st = context;
    return st->job->row(st->job->context, st->s, st->curve, sweep_value(st->s, &st->range, part), values);
}

static bool run_range(state *st) {
    knob var = st->s->var;
    var.d = st->range.d;
    if (!var.is_input && !trial_set(st->t, &var, st->range.lo, st->job->error))
        return false;
    st->rows = st->s->steps + 1;
    if (!st->s->refine)
        return run_all(st);
    const refinement r = {.count = st->job->count,
                          .steps = st->s->steps,
                          .evaluate = evaluate_rows,
                          .give = give_part,
                          .context = st};
    return refine(&r, st->job->error);
}

/* ---- along a load ------------------------------------------------------------------------------ */

static bool look(void *context, double time, calc_error *error) {
    state *st = context;
    (void)error;
    st->row = st->values;
    return evaluate_row(st, time) && st->job->row(st->job->context, st->s, st->curve, time, st->row);
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
    st->with = s->curves ? s->value[st->curve] : 0;
    if (!set_curve(st, error))
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

bool sweep_has_values(sweep_job *job) {
    if (job->values > 0)
        return true;
    *job->error = job->missing;
    calc_append(job->c, job->error, " (%s)", job->where);
    return false;
}

bool sweep_run(const sweep *s, sweep_job *job) {
    const size_t curves = s->curves ? s->curves : 1;
    state st = {.s = s, .job = job};
    if (!job->part)
        sweep_begin(job, curves * (s->steps + 1));
    st.values = malloc(PORTION * job->count * sizeof *st.values);
    bool ok = st.values;
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
    if (!job->part)
        sweep_end(job);
    return ok && (job->part || sweep_has_values(job));
}
