/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Residuals of equations or a loop, by rows or across its branches. Depends on measured and points.h. */
#include "study/residuals.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double apart = 1e-5; /* relative distance in q between the two places of a central difference */

double residuals_unknown(const residuals *r, size_t i) {
    return r->ratio[i] ? r->start[i] * exp(r->q[i] - 1) : r->start[i] + r->scale[i] * (r->q[i] - 1);
}

/* ---- equations --------------------------------------------------------------------------------- */

static size_t step_of(const residuals *r) {
    return r->stride ? r->stride : 1;
}

static void give_data(void *context, size_t row, long double x[]) {
    const residuals *r = context;
    const fit_question *of = r->of;
    for (size_t i = 0; i < of->count; i++)
        x[i] = r->x[i];
    for (size_t j = 0; j < of->columns; j++)
        x[of->count + j] = of->column[j].v[row * step_of(r)];
}

static bool take_sides(void *context, size_t row, const value v[], const calc_error *why) {
    residuals *r = context;
    r->bad_row = row * step_of(r);
    if (why || !points_keep_sides(&r->p, v, &r->d, &r->known))
        return false;
    r->to[r->bad_row] = (double)(v[0].v - v[1].v);
    if (r->kept) {
        r->kept->left[row] = (double)v[0].v;
        r->kept->right[row] = (double)v[1].v;
    }
    r->largest = fmax(r->largest, (double)fmaxl(fabsl(v[0].v), fabsl(v[1].v)));
    return true;
}

static bool equations(residuals *r, double *out) {
    r->to = out;
    return points_go(&r->p, &(points_run){.count = (r->of->rows - 1) / step_of(r) + 1,
                                          .give = give_data,
                                          .take = take_sides,
                                          .context = r});
}

/* ---- loops ------------------------------------------------------------------------------------- */

/* The press with which the run begins: the first measured normal load, else the scene's own. */
static bool press_of(residuals *r, load_step *out, calc_error *error) {
    scene *tried = &r->p.t->scene;
    const fit_loop *loop = &r->of->loop;
    long double imposed;
    *out = (load_step){.kind = LOAD_PRESS, .normal = BY_FORCE};
    if (loop->normal) {
        out->normal = (unsigned char)loop->normal_by;
        out->normal_value = r->loop.noisy ? r->loop.load[0] : loop->normal[0];
        return true;
    }
    if (!tried->end.steps)
        return calc_fail(error, 0, 0, "there is no load yet: press first (press FN=100 N)");
    *out = tried->program->steps[0];
    if (!scene_get(tried, press_input((load_by)out->normal), &imposed, error))
        return false;
    out->normal_value = (double)imposed;
    return true;
}

/* Runs a step to a displacement of the contact or of the rig; *now becomes the forces. */
static fret_status step_to(const residuals *r, runner *run, unsigned char by, double to, double normal,
                           fret_state *now) {
    const fit_loop *loop = &r->of->loop;
    load_item item = {.step = {.kind = LOAD_STEP, .tangential = by, .tangential_value = to}};
    if (loop->normal) {
        item.step.normal = (unsigned char)loop->normal_by;
        item.step.normal_value = normal;
    }
    const fret_status st = run_item(run, &item);
    engine_forces(&run->engine, now);
    return st;
}

static fret_status run_rows(residuals *r, runner *run, double *out) {
    const fit_loop *loop = &r->of->loop;
    fret_status st = status_ok;
    fret_state now;
    for (int pass = 0; pass < 2; pass++)
        for (size_t i = 0; i < (pass ? r->of->rows : r->loop.first[r->loop.passed]) && !st.code; i++) {
            r->bad_row = i;
            st = step_to(r, run, loop->rig ? BY_RIG : BY_DISPLACEMENT, loop->dx[i] - r->loop.d0,
                         loop->normal ? loop->normal[i] : 0, &now);
            out[i] = loop->Fx[i] - r->loop.F0 - (double)now.Fx;
        }
    return st;
}

typedef struct branch_run {
    residuals *r;
    runner *run;
    fret_status status;
} branch_run;

/* Steps by the displacement of the contact, from which the readings of the rig follow. */
static bool step_branch(void *context, double dx, double normal, double *x, double *F) {
    branch_run *w = context;
    fret_state now;
    w->status = step_to(w->r, w->run, BY_DISPLACEMENT, dx, normal, &now);
    *x = dx + w->r->loop.compliance * (double)now.Fx + w->r->loop.d0;
    *F = (double)now.Fx + w->r->loop.F0;
    return !w->status.code;
}

static fret_status run_branches(residuals *r, runner *run, double *out) {
    branch_run w = {.r = r, .run = run, .status = status_ok};
    r->bad_row = NO_ROW;
    if (r->stride)
        branches_begin(&r->loop);
    branches_across(&r->loop, step_of(r), step_branch, &w);
    memcpy(out, r->loop.across, r->count * sizeof *out);
    return w.status;
}

static bool read_rig(residuals *r, scene *tried, calc_error *error) {
    static const input of[] = {IN_K_RIG, IN_D0, IN_F0};
    double *const to[] = {&r->K_rig, &r->loop.d0, &r->loop.F0};
    for (size_t i = 0; i < 3; i++) {
        long double v;
        if (!scene_get(tried, of[i], &v, error))
            return false;
        *to[i] = (double)v;
    }
    r->loop.compliance = 1 / r->K_rig;
    return true;
}

static bool loop_run(residuals *r, double *out) {
    scene *tried = &r->p.t->scene;
    load_view view = {.in = &tried->in, .stop = r->of->c->scene.stop};
    runner run = {.load = &view};
    load_item press = {.extra = {0}};
    calc_error error = ERROR_NONE;
    r->bad_row = NO_ROW;
    if (!points_set(&r->p, r->x))
        return false;
    tried->used |= ASKED_TANGENTIAL;
    if (!scene_normal(tried, &view.normal, &error) || !scene_friction(tried, &view.mu, &error) ||
        !press_of(r, &press.step, &error) || (r->of->loop.rig && !read_rig(r, tried, &error)))
        return points_failed(&r->p, &error);
    view.K_rig = r->K_rig;
    fret_status st = engine_make(&run.engine, view.normal, view.mu);
    if (!st.code)
        st = run_item(&run, &press);
    if (!st.code)
        st = r->loop.noisy || r->stride ? run_branches(r, &run, out) : run_rows(r, &run, out);
    engine_end(&run.engine);
    r->d = r->loop.noisy ? DIM_NONE : DIM_FORCE;
    r->known = true;
    if (!r->p.error->raised && !calc_status(&error, st))
        points_failed(&r->p, &error);
    return !st.code && !r->p.error->raised;
}

/* ---- both -------------------------------------------------------------------------------------- */

bool residuals_at(residuals *r, double *out) {
    const size_t names = r->of->count;
    for (size_t i = 0; i < names; i++)
        r->x[i] = residuals_unknown(r, i);
    for (size_t i = names; i < r->unknowns && !r->stride; i++)
        r->loop.turn[i - names] = residuals_unknown(r, i);
    memcpy(r->now, r->q, sizeof r->now);
    r->evaluations++;
    if (r->stride)
        memset(out, 0, r->count * sizeof *out);
    return r->of->sides ? equations(r, out) : loop_run(r, out);
}

/* ---- slopes ------------------------------------------------------------------------------------ */

/* A turning point affects the rows from the branch that it ends until the next but one turning point erases
 * it from the memory of the contact, and the levels of the turning points there. The last one that is passed
 * before all rows affects them all, as names do; with it go those behind it. */
enum { FELT = 4 };

/* The number of turning points that affect only some rows. */
static size_t banded(const residuals *r) {
    const size_t turns = r->unknowns - r->of->count, passed = r->loop.passed;
    return passed && turns ? passed - 1 : turns;
}

static void put_slopes(residuals *r, size_t unknown, size_t begin, size_t end) {
    for (size_t row = begin; row < end; row++)
        r->slopes[row * r->unknowns + unknown] = r->above[row] / r->unit;
}

/* Stores the differences in r->above, in the rows that the unknown affects; the others stay 0. */
static void keep_slopes(residuals *r, size_t unknown) {
    const size_t names = r->of->count, turns = r->unknowns - names, turn = unknown - names, end = turn + FELT;
    if (unknown < names || turn >= banded(r)) {
        put_slopes(r, unknown, 0, r->count);
        return;
    }
    put_slopes(r, unknown, r->loop.first[turn], r->loop.first[end <= turns ? end : turns + 1]);
    put_slopes(r, unknown, r->of->rows + turn, r->of->rows + (end < turns ? end : turns));
}

/* The residuals with q changed by `by` for every `every`-th unknown from `first` on. */
static bool at_moved(residuals *r, size_t first, size_t every, size_t end, double by, double *out) {
    double kept[UNKNOWNS];
    memcpy(kept, r->q, sizeof kept);
    for (size_t i = first; i < end; i += every)
        r->q[i] += by;
    const bool ok = residuals_at(r, out);
    memcpy(r->q, kept, sizeof kept);
    return ok;
}

static void no_slope(const residuals *r, size_t i) {
    char at[KNOB_TEXT] = "a turning point";
    if (i < r->of->count)
        knob_text(&r->of->name[i], residuals_unknown(r, i), at);
    calc_fail(r->p.error, 0, 0, "no value close to %s, for the derivative: %s", at, r->p.none.text);
}

/* r->above becomes the central differences about q; one-sided at the limit of the scene. */
static bool differences(residuals *r, size_t first, size_t every, size_t end) {
    const double h = points_step(apart / 2, r->q[first], 1);
    double hi = h, lo = -h;
    const bool above = at_moved(r, first, every, end, hi, r->above),
               below = at_moved(r, first, every, end, lo, r->below);
    if (!above && !below)
        no_slope(r, first);
    if (!above)
        at_moved(r, first, every, end, hi = 0, r->above);
    if (!below)
        at_moved(r, first, every, end, lo = 0, r->below);
    for (size_t row = 0; row < r->count; row++)
        r->above[row] = (r->above[row] - r->below[row]) / (hi - lo);
    return !r->p.error->raised;
}

/* Names are moved one by one; turning points that affect different rows together. */
bool residuals_slopes(residuals *r) {
    const size_t names = r->of->count, bands = banded(r);
    if (r->has_slopes && !memcmp(r->sloped, r->q, sizeof r->q))
        return true;
    if (memcmp(r->now, r->q, sizeof r->q) && !residuals_at(r, r->above) && r->p.error->raised)
        return false;
    memcpy(r->sloped, r->q, sizeof r->q);
    r->has_slopes = false;
    r->loop.warm = true;
    for (size_t first = 0; first < r->unknowns && !r->p.error->raised; first++) {
        const bool comb = first >= names && first < names + bands; /* moves every FELT-th turning point */
        const size_t every = comb ? FELT : 1, end = comb ? names + bands : first + 1;
        if (comb && first >= names + FELT)
            continue;
        if (first == r->held)
            memset(r->above, 0, r->count * sizeof *r->above);
        else
            differences(r, first, every, end);
        for (size_t i = first; i < end; i += every)
            keep_slopes(r, i);
    }
    r->loop.warm = false;
    memcpy(r->now, r->q, sizeof r->now);
    r->has_slopes = !r->p.error->raised;
    return r->has_slopes;
}

/* ---- opening ----------------------------------------------------------------------------------- */

static bool open_points(residuals *r, calc_error *error) {
    static const size_t passes = 10; /* a fit evaluates all rows at least as often */
    const fit_question *of = r->of;
    for (size_t i = 0; i < of->count; i++)
        r->knobs[i] = of->name[i];
    for (size_t j = 0; j < of->columns; j++)
        r->knobs[of->count + j] = of->column[j].name;
    const size_t columns = of->sides ? of->columns : 0;
    const bool ok =
        points_open(&r->p, of->c, r->knobs, of->count + columns, of->sides, of->sides ? 2 : 0, error);
    if (ok)
        r->p.t->scene.gaps = true;
    r->p.all = passes * of->rows;
    return ok;
}

static bool open_loop(residuals *r, calc_error *error) {
    const fit_question *of = r->of;
    const fit_loop *loop = &of->loop;
    r->loop = (branches){.rows = of->rows, .dx = loop->dx, .Fx = loop->Fx, .normal = loop->normal};
    if ((loop->rig && !read_rig(r, &r->p.t->scene, error)) ||
        !branches_find(&r->loop, loop->noise_dx, loop->noise_Fx, loop->steady, error))
        return false;
    if (r->loop.noisy) {
        r->unknowns += r->loop.turns;
        r->count += r->loop.turns;
    }
    return r->unknowns - of->count <= FIT_TURNS ||
           calc_fail(error, 0, 0,
                     "dx turns %zu times: more than %d turning points with noise are not fitted at once",
                     r->loop.turns, FIT_TURNS);
}

bool residuals_open(residuals *r, const fit_question *of, calc_error *error) {
    *r = (residuals){.of = of, .unknowns = of->count, .count = of->rows, .unit = 1};
    if (!open_points(r, error) || (!of->sides && !open_loop(r, error)))
        return false;
    for (size_t i = 0; i < r->unknowns; i++)
        r->q[i] = 1;
    r->held = r->unknowns;
    r->memory = calloc((3 + r->unknowns) * r->count, sizeof *r->memory);
    r->out = r->memory;
    if (!r->memory)
        return calc_no_memory(error);
    r->above = r->out + r->count;
    r->below = r->above + r->count;
    r->slopes = r->below + r->count;
    return true;
}

void residuals_close(residuals *r) {
    free(r->memory);
    branches_free(&r->loop);
    points_close(&r->p);
}
