/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Runs a sweep, curve by curve, on a scratch scene. Depends on points.h and refine.h. */
#include "study/sweep.h"

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "language/trial.h"
#include "study/refine.h"

typedef struct curve_run {
    const sweep *s;
    sweep_job *job;
    size_t curve;
    sweep_range range;
    long double *row;  /* values of the present row */
    size_t first, end; /* rows of the curve that are wanted */
    size_t rows;       /* rows of the present run of points */
    /* rows for refine(), each a part 0..1 and then its values; NULL: even rows, passed to the job */
    long double *refined;
} curve_run;

/* Writes job->where: "at X = ..., WITH = ...". */
static void say_where(curve_run *st, long double x) {
    const sweep *s = st->s;
    char at[120], with[60 + LEX_NAME] = "";
    calc_amount(st->range.d, x, 6, at, sizeof at);
    if (s->curves) {
        snprintf(with, sizeof with, ", %s = ", s->with.text);
        calc_amount(s->with.d, sweep_with(s, st->curve), 6, with + strlen(with), sizeof with - strlen(with));
    }
    snprintf(st->job->where, sizeof st->job->where, "at %s = %s%s", s->var.text, at, with);
}

/* Appends the place to an error that ends the sweep; for gaps keeps the reason of the first. */
static void say_why(curve_run *st, const calc_error *why, long double x) {
    sweep_job *job = st->job;
    const bool ends = job->error->raised;
    if ((ends && job->error->stop) || (!ends && job->missing.raised))
        return;
    say_where(st, x);
    if (ends)
        calc_append(job->c, job->error, " (%s)", job->where);
    else
        job->missing = *why;
}

/* Does expression i keep its dimension? The first one found holds for all rows. */
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

static void check_dim(curve_run *st, size_t i, dim d, long double x) {
    sweep_job *job = st->job;
    if (is_its_dim(job, i, d))
        return;
    char is[128], should[128];
    const expr *e = &job->expressions[i];
    dim_describe(d, is, sizeof is);
    dim_unit(job->d[i], should, sizeof should);
    say_where(st, x);
    const char *in = job->units && job->units[i] ? job->units[i] : should;
    calc_raise(job->error, e->at, e->len, "%.*s is %s: it cannot be shown %s%s (%s)", LEX_SHOWN(e->len),
               e->text + e->at, is, *in ? "in " : "as a number", in, job->where);
}

/* A gap (NaN) has no dimension: find_dim derives it from the expression. */
static void take_value(curve_run *st, size_t i, const value *v, long double x) {
    st->row[i] = v->v;
    if (isnan(v->v)) {
        find_dim(st->job, i);
        return;
    }
    st->job->values++;
    check_dim(st, i, v->d, x);
}

static bool take_row(curve_run *st, size_t row, long double x, const value v[], const calc_error *why) {
    sweep_job *job = st->job;
    if (why)
        say_why(st, why, x);
    for (size_t i = 0; i < job->count && !job->error->raised; i++)
        take_value(st, i, &v[i], x);
    if (job->error->raised)
        return false;
    if (st->refined)
        memcpy(st->refined + row * (job->count + 1) + 1, st->row, job->count * sizeof *st->row);
    return st->refined || job->row(job->context, st->s, st->curve, x, st->row);
}

/* ---- for NAME = LO .. HI ----------------------------------------------------------------------- */

/* The value of the name at a part 0..1 of its range; from a list, the nearest item. */
static long double sweep_value(const sweep *s, const sweep_range *r, long double part) {
    return r->listed ? r->list[lroundl(part * (long double)(r->listed - 1))]
                     : points_place(r->lo, r->hi, s->log, part);
}

long double sweep_with(const sweep *s, size_t curve) {
    return s->across ? sweep_value(s->across, &s->ends, (long double)curve / (long double)s->across->steps)
                     : s->value[curve];
}

/* The x of a row of a table: the value of its only name, or the row's number. */
static long double row_of(const sweep_rows *at, size_t row) {
    return at->names == 1 ? (long double)at->column[0].v[row] : (long double)(row + 1);
}

static long double place(const curve_run *st, size_t row) {
    return sweep_value(st->s, &st->range,
                       st->refined ? st->refined[row * (st->job->count + 1)]
                                   : (long double)(st->first + row) / (long double)st->s->steps);
}

static void give_swept(void *context, size_t row, long double x[]) {
    const curve_run *st = context;
    const sweep *s = st->s;
    if (s->curves)
        *x++ = sweep_with(s, st->curve);
    for (size_t i = 0; s->at && i < s->at->names; i++)
        *x++ = s->at->column[i].v[st->first + row];
    if (!s->at)
        *x = place(st, row);
}

static bool take_swept(void *context, size_t row, const value v[], const calc_error *why) {
    curve_run *st = context;
    const sweep_rows *at = st->s->at;
    return take_row(st, row, at ? row_of(at, st->first + row) : place(st, row), v, why);
}

static bool run_all(curve_run *st) {
    return points_go(&st->job->p,
                     &(points_run){.count = st->rows, .give = give_swept, .take = take_swept, .context = st});
}

/* ---- even rows, or refined ones ---------------------------------------------------------------- */

static bool evaluate_rows(void *context, long double *row, size_t rows) {
    curve_run *st = context;
    st->refined = row;
    st->rows = rows;
    return run_all(st);
}

static bool give_part(void *context, long double part, const long double *values) {
    curve_run *st = context;
    return st->job->row(st->job->context, st->s, st->curve, sweep_value(st->s, &st->range, part), values);
}

/* Sets the dimension of the range, which may differ from curve to curve. Gives a name a first value: if a
 * team computes the rows, find_dim still needs one in this process. */
static bool begin_range(curve_run *st) {
    points *p = &st->job->p;
    const size_t i = st->s->curves > 0;
    knob *var = &st->job->knobs[i];
    const sweep_rows *at = st->s->at;
    bool ok = true;
    for (size_t n = 0; at && n < at->names && ok; n++)
        ok = at->column[n].name.is_input || points_put(p, i + n, at->column[n].v[0], p->error);
    if (at)
        return ok;
    if (!dim_equal(var->d, st->range.d))
        points_dismiss(p);
    var->d = st->range.d;
    return var->is_input || points_put(p, i, st->range.lo, p->error);
}

static bool run_range(curve_run *st) {
    if (!begin_range(st))
        return false;
    st->rows = (st->end < st->s->steps + 1 ? st->end : st->s->steps + 1) - st->first;
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

static bool look_along(curve_run *st, double time) {
    points *p = &st->job->p;
    const bool all = points_look(p, p->v);
    return take_row(st, 0, time, p->v, all ? NULL : &p->none) && !calc_stopped(p->c->scene.stop, p->error);
}

/* Appends the load of the range to the trial's load program; *from becomes its beginning. */
static bool try_load(trial *t, const sweep_range *range, load_mark *from, calc_error *error) {
    scene *tried = &t->scene;
    *from = tried->end;
    if (!tried->end.steps)
        return calc_fail(error, 0, 0, "there is no load yet: press first (press FN=100 N)");
    if (!scene_append(tried, &range->step, range->step.kind == LOAD_CYCLE ? &range->extra : NULL, error))
        return false;
    for (input in = 0; in < INPUTS; in++)
        if (range->bound[in])
            inputs_bind(&tried->in, in, counted_hold(range->bound[in]));
    return true;
}

static bool run_along(curve_run *st) {
    const sweep *s = st->s;
    trial *t = st->job->p.t;
    load_mark from = t->scene.end;
    if (s->what == ALONG_LOAD && !try_load(t, &st->range, &from, st->job->error))
        return false;
    trial_along a;
    calc_error error = ERROR_NONE;
    bool ok = trial_along_begin(&a, t, s->what, from, s->steps, s->turns, &error);
    for (size_t row = 0; ok && row < st->end && trial_along_next(&a, &error); row++)
        ok = row < st->first ? !calc_stopped(t->scene.stop, &error) : look_along(st, scene_time(&t->scene));
    trial_along_end(&a);
    if (error.raised && !st->job->error->raised)
        *st->job->error = error;
    return ok && !error.raised;
}

/* ---- curves ------------------------------------------------------------------------------------ */

size_t sweep_length(const sweep *s) {
    return (s->curves ? s->curves : 1) * (s->steps + 1);
}

/* Sets st->first and st->end to the rows of the curve that are wanted; false: none. */
static bool is_wanted(curve_run *st) {
    sweep_job *job = st->job;
    const size_t rows = st->s->steps + 1, before = job->before;
    job->before += rows;
    st->first = job->from > before ? job->from - before : 0;
    st->end = job->to > before ? job->to - before : 0;
    return st->first < st->end && st->first < rows;
}

static bool run_curve(curve_run *st) {
    const sweep *s = st->s;
    points *p = &st->job->p;
    if (!is_wanted(st))
        return true;
    if (!points_anew(p) || (s->curves && !points_put(p, 0, sweep_with(s, st->curve), p->error)))
        return false;
    st->range = (sweep_range){.lo = 0};
    bool ok = s->range(s, &st->range, p->error);
    ok = ok && (s->along ? run_along : run_range)(st);
    for (input in = 0; in < INPUTS; in++)
        counted_drop(st->range.bound[in]);
    return ok;
}

static bool run_curves(const sweep *s, sweep_job *job) {
    const size_t curves = s->curves ? s->curves : 1;
    curve_run st = {.s = s, .job = job, .row = malloc((job->count + 1) * sizeof *st.row)};
    bool ok = st.row || calc_no_memory(job->error);
    for (; st.curve < curves && ok; st.curve++)
        ok = run_curve(&st);
    free(st.row);
    return ok;
}

static bool open_sweep(const sweep *s, sweep_job *job) {
    const size_t rows = sweep_length(s);
    size_t count = 0;
    error_clear(&job->missing);
    job->values = job->before = 0;
    if (!job->to)
        job->to = SIZE_MAX;
    if (s->curves)
        job->knobs[count++] = s->with;
    for (size_t i = 0; s->at && i < s->at->names; i++)
        job->knobs[count++] = s->at->column[i].name;
    if (!s->along && !s->at)
        job->knobs[count++] = s->var;
    const bool ok = points_open(&job->p, job->c, job->knobs, count, job->expressions, job->count, job->error);
    job->p.all = job->to < rows ? job->to - job->from : rows;
    job->p.alone = !job->count; /* the callback reads the scene, which must be in this process */
    return ok;
}

bool sweep_run(const sweep *s, sweep_job *job) {
    const bool ok = open_sweep(s, job) && run_curves(s, job);
    points_close(&job->p);
    if (!ok || !job->count || job->values > 0 || job->from > 0 || job->to < job->before)
        return ok;
    *job->error = job->missing;
    return calc_append(job->c, job->error, " (%s)", job->where), false;
}

/* ---- over two names ---------------------------------------------------------------------------- */

static bool keep(void *context, const sweep *s, size_t curve, long double x, const long double *values) {
    grid_values *to = context;
    to->a[to->at % to->rows] = x;
    to->b[curve] = sweep_with(s, curve);
    memcpy(to->v + to->at++ * to->count, values, to->count * sizeof *values);
    return true;
}

bool grid_keep(const sweep *s, sweep_job *job, grid_values *out) {
    *out = (grid_values){.rows = s->steps + 1, .across = s->curves, .count = job->count};
    out->a = calloc(out->rows, sizeof *out->a);
    out->b = calloc(out->across, sizeof *out->b);
    out->v = calloc(out->rows * out->across, out->count * sizeof *out->v);
    if (!out->a || !out->b || !out->v)
        return calc_no_memory(job->error);
    job->row = keep;
    job->context = out;
    return sweep_run(s, job);
}

void grid_values_free(grid_values *values) {
    free(values->a);
    free(values->b);
    free(values->v);
}
