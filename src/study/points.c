/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Computes points one by one in this process or by a team. Depends on language/trial and team.h. */
#include "study/points.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "number/real.h"
#include "study/team.h"
#include "text/clock.h"

enum { PORTION = 256 }; /* most points in a part of a team's work */

/* ---- knobs ------------------------------------------------------------------------------------- */

bool knob_present(calc *c, const knob *k, double *v) {
    long double now;
    if (!k->is_input) {
        const own_name *row = &c->names.row[k->name];
        *v = (double)row->v.v;
        return row->known && !row->definition;
    }
    if (!scene_get(c->now, k->in, &now, error_quiet()))
        return false;
    *v = (double)now;
    return true;
}

bool knob_lacks(const calc *c, const knob *k, const char *what_for, const char *advice, calc_error *error) {
    const definition *d = k->is_input ? NULL : (const definition *)c->names.row[k->name].definition;
    long double none;
    if (k->is_input && !*advice) /* scene_get raises the error */
        return scene_get(c->now, k->in, &none, error);
    if (!d)
        return calc_fail(error, 0, 0, "%s has no value%s%s", k->text, what_for, advice);
    if (d->parameters)
        return calc_fail(error, 0, 0, "%s is a function: it has no value%s%s", k->text, what_for, advice);
    return calc_fail(error, 0, 0, "%s has no value of its own%s (it follows %s := %.*s)%s", k->text, what_for,
                     k->text, LEX_SHOWN(strlen(d->text)), d->text, advice);
}

double points_step(double part, double x, double scale) {
    return part * fmax(fabs(x), scale);
}

const long double points_slope[POINTS_SLOPES] = {3 / 4.0L, -3 / 20.0L, 1 / 60.0L};

bool points_ratios(double lo, double hi) {
    return lo > 0 && hi > 0 && (hi >= 10 * lo || lo >= 10 * hi);
}

long double points_place(long double lo, long double hi, bool ratios, long double part) {
    if (part == 1)
        return hi;
    return ratios ? lo * fret_pow(hi / lo, part) : lo + (hi - lo) * part;
}

void knob_text(const knob *k, double v, char text[KNOB_TEXT]) {
    char number[CALC_VALUE_TEXT];
    calc_value_text(k->d, v, number);
    snprintf(text, KNOB_TEXT, "%s = %s", k->text, number);
}

/* ---- opening and closing ----------------------------------------------------------------------- */

bool points_open(points *p, calc *c, const knob *knobs, size_t count, const expr *e, size_t n,
                 calc_error *error) {
    *p = (points){.c = c, .knobs = knobs, .count = count, .e = e, .n = n, .error = error};
    error_clear(&p->none);
    p->now = malloc((2 * count + 1) * sizeof *p->now);
    p->v = malloc((n + 1) * sizeof *p->v);
    if (!p->now || !p->v)
        return calc_no_memory(error);
    p->next = p->now + count;
    return points_anew(p);
}

bool points_anew(points *p) {
    trial_close(p->t);
    p->t = trial_open(p->c, p->error);
    for (size_t i = 0; i < p->count; i++)
        p->now[i] = (long double)NAN;
    return p->t != NULL;
}

void points_dismiss(points *p) {
    team_end(p->team);
    p->team = NULL;
}

void points_close(points *p) {
    points_dismiss(p);
    calc_word(p->c, p->error);
    trial_close(p->t);
    free(p->now);
    free(p->v);
}

/* ---- one point --------------------------------------------------------------------------------- */

bool points_failed(points *p, const calc_error *error) {
    if (error->stop || error->strange || error->circle) {
        *p->error = *error;
    } else if (!p->none.raised) {
        p->none = *error;
        calc_word(p->c, &p->none);
    }
    return false;
}

/* Equal, including the sign of zero. */
static bool is_same(long double x, long double now) {
    return x == now && (x != 0 || signbit(x) == signbit(now));
}

bool points_put(points *p, size_t i, long double x, calc_error *error) {
    p->now[i] = (long double)NAN;
    if (!trial_set(p->t, &p->knobs[i], x, error))
        return false;
    p->now[i] = x;
    return true;
}

bool points_set(points *p, const long double x[]) {
    calc_error error;
    error_clear(&error);
    p->none.raised = false;
    if (p->error->raised || calc_stopped(p->c->scene.stop, p->error))
        return false;
    p->evaluations++;
    for (size_t i = 0; i < p->count; i++)
        if (!is_same(x[i], p->now[i]) && !points_put(p, i, x[i], &error)) /* keeps the scene's caches */
            return points_failed(p, &error);
    return true;
}

static void fill_missing(const points *p, size_t from, value v[]) {
    for (size_t i = from; i < p->n; i++)
        v[i] = (value){(long double)NAN, DIM_NONE};
}

bool points_look(points *p, value v[]) {
    calc_error error;
    error_clear(&error);
    p->none.raised = false;
    if (p->c->scene.pulse)
        p->c->scene.pulse();
    for (size_t i = 0; i < p->n && !p->error->raised; i++) {
        if (expr_eval(p->c, &p->e[i], &v[i], &error))
            continue;
        fill_missing(p, i, v);
        points_failed(p, &error);
        error_clear(&error);
    }
    return !p->error->raised && !p->none.raised;
}

bool points_at(points *p, const long double x[], value v[]) {
    if (points_set(p, x))
        return points_look(p, v);
    fill_missing(p, 0, v);
    return false;
}

bool points_keeps(points *p, size_t i, dim of, dim *d, bool *known) {
    const expr *e = &p->e[i];
    if (!*known)
        *d = of;
    *known = true;
    if (dim_equal(of, *d))
        return true;
    p->error->strange = true;
    return calc_fail(p->error, e->at, e->len, "%.*s has no fixed dimension: it changes on the way",
                     LEX_SHOWN(e->len), e->text + e->at);
}

bool points_keep_sides(points *p, const value v[2], dim *d, bool *known) {
    const expr *right = &p->e[1];
    char is[128], wants[128];
    if (!points_keeps(p, 0, v[0].d, d, known))
        return false;
    if (dim_equal(v[1].d, *d) || (v[1].v == 0 && dim_equal(v[1].d, DIM_NONE)))
        return true;
    dim_describe(v[1].d, is, sizeof is);
    dim_describe(*d, wants, sizeof wants);
    return calc_fail(p->error, right->at, right->len, "the left side is %s, the right side is %s", wants, is);
}

/* ---- a run over many points -------------------------------------------------------------------- */

static bool hand_over(points *p, const points_run *run, size_t i, const value v[], const calc_error *why) {
    p->done++;
    return run->take(run->context, i, v, why) && !p->error->raised;
}

static bool one_here(points *p, const points_run *run, size_t i, const long double x[]) {
    const bool watched = !p->team && !p->alone;
    const double began = watched ? clock_wall() : 0;
    const bool all = points_at(p, x, p->v);
    if (watched) {
        p->taken += clock_wall() - began;
        p->watched++;
    }
    return hand_over(p, run, i, p->v, all ? NULL : p->error->raised ? p->error : &p->none);
}

/* The input of a part: the knobs of its points. */
typedef struct portion {
    size_t count;
    long double x[];
} portion;

/* The result of a part: values, and the errors of points that lack one. */
typedef struct outcome {
    scene_use used;
    calc_error why[PORTION];
    value v[];
} outcome;

/* Computes a part in a worker, on its own copy of the points. False: an error ends the computation; the
 * parent then computes the part again and raises the same error. */
static bool work(void *context, const void *in, void *out) {
    points *p = context;
    const portion *given = in;
    outcome *found = out;
    error_clear(p->error);
    p->t->scene.used = 0;
    for (size_t k = 0; k < given->count; k++)
        if (!points_at(p, given->x + k * p->count, found->v + k * p->n))
            found->why[k] = p->error->raised ? *p->error : p->none;
    found->used = scene_answered_by(&p->t->scene);
    return !p->error->raised;
}

typedef struct sharing {
    points *p;
    const points_run *run;
    size_t first, portion; /* first point of the shared work; points of a part */
} sharing;

static void give_portion(void *context, size_t part, void *in) {
    const sharing *sh = context;
    const size_t i = sh->first + part * sh->portion, left = sh->run->count - i;
    portion *given = in;
    given->count = left < sh->portion ? left : sh->portion;
    for (size_t k = 0; k < given->count; k++)
        sh->run->give(sh->run->context, i + k, given->x + k * sh->p->count);
}

static bool lacks(const value *v, size_t n) {
    for (size_t i = 0; i < n; i++)
        if (isnan(v[i].v))
            return true;
    return false;
}

static bool take_portion(void *context, size_t part, const void *in, const void *out) {
    const sharing *sh = context;
    points *p = sh->p;
    const portion *given = in;
    const outcome *found = out;
    const size_t i = sh->first + part * sh->portion;
    if (!out) {
        for (size_t k = 0; k < given->count; k++)
            if (!one_here(p, sh->run, i + k, given->x + k * p->count))
                return false;
        return true;
    }
    scene_also_used(&p->t->scene, found->used);
    p->evaluations += (unsigned)given->count;
    for (size_t k = 0; k < given->count; k++) {
        const value *v = found->v + k * p->n;
        const bool gap = lacks(v, p->n);
        if (gap)
            p->none = found->why[k];
        if (!hand_over(p, sh->run, i + k, v, gap ? &p->none : NULL))
            return false;
    }
    return true;
}

/* Is there a team for the `left` points of this run? Starts one as soon as that pays. */
static bool shared(points *p, size_t left) {
    const size_t to_come = p->all > p->done + left ? p->all - p->done : left;
    if (p->team || p->alone || !team_pays(p->taken, (double)p->watched, (double)(p->watched + to_come)))
        return p->team && left > 1;
    const size_t in = sizeof(portion) + PORTION * p->count * sizeof(long double),
                 out = sizeof(outcome) + PORTION * p->n * sizeof(value);
    p->team = team_begin(&(team_job){.c = p->c, .in = in, .out = out, .work = work, .context = p});
    p->alone = !p->team;
    return p->team != NULL;
}

/* Points of a part: few, so that all workers share slow points, but at least 1 ms worth of quick ones. */
static size_t portion_of(const points *p, size_t left) {
    static const double worth = 1e-3; /* seconds */
    const double many = (double)left, quick = worth * (double)p->watched / p->taken;
    return (size_t)fmin(fmax(fmax(many / 64, fmin(many / 16, quick)), 1), PORTION);
}

static bool share(points *p, const points_run *run, size_t first) {
    const size_t left = run->count - first;
    sharing sh = {.p = p, .run = run, .first = first, .portion = portion_of(p, left)};
    const team_run parts = {.parts = (left + sh.portion - 1) / sh.portion,
                            .give = give_portion,
                            .take = take_portion,
                            .context = &sh};
    const bool ok = team_work(p->team, &parts);
    if (!ok)
        points_dismiss(p); /* workers may still be busy with parts of this run */
    return !calc_stopped(p->c->scene.stop, p->error) && ok;
}

bool points_go(points *p, const points_run *run) {
    for (size_t i = 0; i < run->count; i++) {
        if (shared(p, run->count - i))
            return share(p, run, i);
        run->give(run->context, i, p->next);
        if (!one_here(p, run, i, p->next))
            return false;
    }
    return !calc_stopped(p->c->scene.stop, p->error);
}
