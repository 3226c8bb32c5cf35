/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Residuals of equations and of loops, and what they say of the names. */
#include "study/fit.h"

#include <gsl/gsl_blas.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_linalg.h>
#include <gsl/gsl_multifit_nlinear.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "measured/branches.h"
#include "study/points.h"

/* Where a trial point has no value its residuals are this large: the step is taken back. */
static const double refused = 1e6;
enum { ITERATIONS = 200, BEGINNINGS = 4, MANY = 4, TURNS = 64, UNKNOWNS = FIT_NAMES + TURNS };
static const double apart = 1e-5;    /* of the two places of a difference, as a part of q */
static const double visible = 1e-6;  /* residuals of a loop, as a part of it */
static const double rounding = 1e-9; /* of equations, as a part of their sides */
#define NO_ROW ((size_t)-1)

typedef struct state {
    const fit_question *of;
    points p;
    expr sides[2];                       /* left and right */
    knob knobs[FIT_NAMES + FIT_COLUMNS]; /* names, and columns behind them */
    branches loop;
    double K_rig, d0, F0; /* of a loop that is read at the rig, else 0 */
    /* Names, and behind them turning points; rows, and behind them those as measured. */
    size_t parameters, residuals;
    size_t stride; /* every such row is looked at */
    double start[UNKNOWNS], scale[UNKNOWNS];
    /* parameter i is start exp(q-1), or start + scale (q-1) */
    bool ratio[UNKNOWNS], bounded[UNKNOWNS];
    double unit;    /* of the residuals */
    double largest; /* side of the equations computed so far */
    double size;    /* of the sides at the present values; of a loop, of F_x */
    dim d;
    bool known;
    bool twice;
    size_t bad_row;   /* the last one without a value; NO_ROW: it was not a row's fault */
    double *residual; /* as they are computed */
    fit_points *kept; /* NULL, or where the sides of equations go, too */
    double *above, *below;
    gsl_vector *beside;       /* where these are */
    gsl_matrix *J;            /* used up by what is asked of it */
    long double x[FIT_NAMES]; /* of the names, present */
    unsigned evaluations;
} state;

static double parameter(const state *s, size_t i, double q) {
    return s->ratio[i] ? s->start[i] * exp(q - 1) : s->start[i] + s->scale[i] * (q - 1);
}

/* ---- residuals --------------------------------------------------------------------------------- */

typedef struct sides {
    state *s;
    double *out; /* left - right of all rows */
} sides;

static void give_data(void *context, size_t row, long double x[]) {
    const state *s = ((const sides *)context)->s;
    const fit_question *of = s->of;
    for (size_t i = 0; i < of->count; i++)
        x[i] = s->x[i];
    for (size_t j = 0; j < of->columns; j++)
        x[of->count + j] = of->column[j].v[row * s->stride];
}

static bool take_sides(void *context, size_t row, const long double x[], const value v[],
                       const calc_error *why) {
    const sides *to = context;
    state *s = to->s;
    (void)x;
    s->bad_row = row * s->stride;
    if (why || !points_keeps(&s->p, 0, v[0].d, &s->d, &s->known))
        return false;
    if (!dim_equal(v[1].d, s->d)) {
        const expr *right = &s->sides[1];
        char is[128], wants[128];
        dim_describe(s->d, wants, sizeof wants);
        dim_describe(v[1].d, is, sizeof is);
        return calc_fail(s->p.error, right->at, right->len, "the left side is %s, the right side is %s",
                         wants, is);
    }
    to->out[row * s->stride] = (double)(v[0].v - v[1].v);
    if (s->kept) {
        s->kept->left[row] = (double)v[0].v;
        s->kept->right[row] = (double)v[1].v;
    }
    s->largest = fmax(s->largest, (double)fmaxl(fabsl(v[0].v), fabsl(v[1].v)));
    return true;
}

static bool equations(state *s, double *out) {
    sides to = {s, out};
    return points_go(&s->p, &(points_run){.count = (s->of->rows - 1) / s->stride + 1,
                                          .give = give_data,
                                          .take = take_sides,
                                          .context = &to});
}

/* The press that everything begins with. */
static bool press_of(state *s, load_step *out, calc_error *error) {
    scene *tried = &s->p.t->scene;
    const fit_loop *loop = &s->of->loop;
    long double imposed;
    *out = (load_step){.kind = LOAD_PRESS, .normal = BY_FORCE};
    if (loop->normal) {
        out->normal = (unsigned char)loop->normal_by;
        out->normal_value = s->loop.noisy ? s->loop.load[0] : loop->normal[0];
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

static unsigned char driven(const fit_loop *loop) {
    return loop->rig ? BY_RIG : BY_DISPLACEMENT;
}

static fret_status run_rows(state *s, runner *r, double *out) {
    const fit_loop *loop = &s->of->loop;
    fret_status st = {.code = FRET_OK};
    fret_state now;
    for (size_t pass = 0; pass < 1u + s->twice; pass++)
        for (size_t i = 0; i < s->of->rows && !st.code; i++) {
            load_item item = {.step = {.kind = LOAD_STEP,
                                       .tangential = driven(loop),
                                       .tangential_value = loop->dx[i] - s->d0}};
            if (loop->normal) {
                item.step.normal = (unsigned char)loop->normal_by;
                item.step.normal_value = loop->normal[i];
            }
            s->bad_row = i;
            st = run_item(r, &item);
            engine_forces(&r->engine, &now);
            out[i] = loop->Fx[i] - s->F0 - (double)now.Fx;
        }
    return st;
}

typedef struct way {
    state *s;
    runner *r;
    fret_status status;
} way;

static bool step_branch(void *context, double dx, double normal, double *x, double *F) {
    way *w = context;
    const fit_loop *loop = &w->s->of->loop;
    fret_state now;
    load_item item = {
        .step = {.kind = LOAD_STEP, .tangential = driven(loop), .tangential_value = dx - w->s->d0}};
    if (loop->normal) {
        item.step.normal = (unsigned char)loop->normal_by;
        item.step.normal_value = normal;
    }
    w->status = run_item(w->r, &item);
    engine_forces(&w->r->engine, &now);
    *x = dx;
    *F = (double)now.Fx + w->s->F0;
    return !w->status.code;
}

static fret_status run_branches(state *s, runner *r, double *out) {
    way w = {.s = s, .r = r, .status = {.code = FRET_OK}};
    s->bad_row = NO_ROW;
    branches_across(&s->loop, s->stride, step_branch, &w);
    memcpy(out, s->loop.across, s->residuals * sizeof *out);
    return w.status;
}

static bool read_rig(state *s, scene *tried, calc_error *error) {
    static const input of[] = {IN_K_RIG, IN_D0, IN_F0};
    double *const to[] = {&s->K_rig, &s->d0, &s->F0};
    for (size_t i = 0; i < 3; i++) {
        long double v;
        if (!scene_get(tried, of[i], &v, error))
            return false;
        *to[i] = (double)v;
    }
    s->loop.rest = s->d0;
    return true;
}

static bool loop_run(state *s, double *out, fret_status (*run)(state *s, runner *r, double *out)) {
    scene *tried = &s->p.t->scene;
    load_view view = {.in = &tried->in, .stop = s->of->c->scene.stop};
    runner r = {.load = &view};
    load_item press = {.extra = {0}};
    calc_error error;
    error_clear(&error);
    s->bad_row = NO_ROW;
    if (!points_set(&s->p, s->x))
        return false;
    tried->used |= ASKED_TANGENTIAL;
    if (!scene_normal(tried, &view.normal, &error) || !scene_friction(tried, &view.mu, &error) ||
        !press_of(s, &press.step, &error) || (s->of->loop.rig && !read_rig(s, tried, &error)))
        return points_failed(&s->p, &error);
    view.K_rig = s->K_rig;
    fret_status st = engine_make(&r.engine, MODEL_MEMORY, view.normal, view.mu, 0, 0);
    if (!st.code)
        st = run_item(&r, &press);
    if (!st.code)
        st = run(s, &r, out);
    engine_end(&r.engine);
    s->d = s->loop.noisy ? DIM_NONE : DIM_FORCE;
    s->known = true;
    if (!s->p.error->raised && !calc_status(&error, &st))
        points_failed(&s->p, &error);
    return !st.code && !s->p.error->raised;
}

/* left - right, or measured - computed F_x, in SI; of a loop with noise in both columns in units of these. */
static bool residuals(state *s, const gsl_vector *q, double *out) {
    const size_t names = s->of->count;
    for (size_t i = 0; i < names; i++)
        s->x[i] = parameter(s, i, gsl_vector_get(q, i));
    for (size_t i = names; i < s->parameters; i++)
        s->loop.turn[i - names] = parameter(s, i, gsl_vector_get(q, i));
    s->evaluations++;
    return s->of->left ? equations(s, out) : loop_run(s, out, s->loop.noisy ? run_branches : run_rows);
}

static int gsl_residuals(const gsl_vector *q, void *context, gsl_vector *f) {
    state *s = context;
    if (residuals(s, q, s->residual)) {
        for (size_t i = 0; i < s->residuals; i++)
            gsl_vector_set(f, i, s->residual[i] / s->unit);
        return GSL_SUCCESS;
    }
    gsl_vector_set_all(f, refused);
    return s->p.error->raised ? GSL_EFAILED : GSL_SUCCESS;
}

/* With one parameter at q. */
static bool residuals_beside(state *s, size_t i, double q, double *out) {
    gsl_vector_set(s->beside, i, q);
    return residuals(s, s->beside, out);
}

static void no_slope(const state *s, size_t i, double q) {
    char at[ASK_TEXT] = "a turning point";
    if (i < s->of->count)
        ask_text(&s->of->name[i], parameter(s, i, q), at);
    calc_fail(s->p.error, 0, 0, "no value close beside %s, for the derivative: %s", at, s->p.none.text);
}

/* Every so many parameters from `first` to before `end`. */
typedef struct comb {
    size_t first, every, end;
} comb;

static bool residuals_moved(state *s, const gsl_vector *q, const comb *of, double by, double *out) {
    gsl_vector_memcpy(s->beside, q);
    for (size_t i = of->first; i < of->end; i += of->every)
        gsl_vector_set(s->beside, i, gsl_vector_get(q, i) + by);
    return residuals(s, s->beside, out);
}

/* Differences about q; at the end of the scene, where one of the two has no value, from q to the other. */
static bool differences(state *s, const gsl_vector *q, const comb *of) {
    const double at = gsl_vector_get(q, of->first), h = ask_step(apart / 2, at, 1);
    double hi = h, lo = -h;
    const bool above = residuals_moved(s, q, of, hi, s->above),
               below = residuals_moved(s, q, of, lo, s->below);
    if (!above && !below)
        no_slope(s, of->first, at);
    if (!above)
        residuals_moved(s, q, of, hi = 0, s->above);
    if (!below)
        residuals_moved(s, q, of, lo = 0, s->below);
    for (size_t row = 0; row < s->residuals; row++)
        s->above[row] = (s->above[row] - s->below[row]) / s->unit / (hi - lo);
    return !s->p.error->raised;
}

/* A turning point is felt until the next but one wipes it out: rows of the branches behind it. */
enum { FELT = 3 };
static void put_slopes(const state *s, const comb *of, gsl_matrix *J) {
    const size_t names = s->of->count, ends = s->loop.turns + 1;
    const bool alone = of->first + of->every >= of->end;
    for (size_t i = of->first; i < of->end; i += of->every) {
        const size_t next = i - names + 1, begin = alone ? 0 : s->loop.first[next],
                     end = alone                ? s->residuals
                           : next + FELT > ends ? s->of->rows
                                                : s->loop.first[next + FELT];
        for (size_t row = begin; row < end; row++)
            gsl_matrix_set(J, row, i, s->above[row]);
        if (!alone)
            gsl_matrix_set(J, s->of->rows + i - names, i, s->above[s->of->rows + i - names]);
    }
}

/* Names one by one; turning points far from each other at once, the last of a closed loop, which comes before
 * all, by itself. */
static int gsl_jacobian(const gsl_vector *q, void *context, gsl_matrix *J) {
    state *s = context;
    const size_t names = s->of->count, all = s->parameters, last = all - (s->twice && all > names);
    gsl_matrix_set_zero(J);
    for (size_t i = 0; i < all; i++) {
        const bool turn = i >= names && i < last;
        const comb of = {i, turn ? FELT : 1, turn ? last : i + 1};
        if (turn && i >= names + FELT)
            continue;
        if (!differences(s, q, &of))
            return GSL_EFAILED;
        put_slopes(s, &of, J);
    }
    return GSL_SUCCESS;
}

/* ---- the start --------------------------------------------------------------------------------- */

/* A loop that begins in its midst came from somewhere: its own last period. */
static bool begins_midway(const fit_question *of) {
    const fit_loop *l = &of->loop;
    double dx = 0, Fx = 0;
    for (size_t i = 0; i < of->rows; i++) {
        dx = fmax(dx, fabs(l->dx[i]));
        Fx = fmax(Fx, fabs(l->Fx[i]));
    }
    const bool at_rest = fabs(l->dx[0]) < 0.05 * dx && fabs(l->Fx[0]) < 0.05 * Fx;
    const size_t last = of->rows - 1;
    return !at_rest && fabs(l->dx[last] - l->dx[0]) < 0.1 * dx && fabs(l->Fx[last] - l->Fx[0]) < 0.2 * Fx;
}

/* Of a measured loop. */
static double largest_force(const state *s) {
    double largest = 0;
    for (size_t i = 0; i < s->of->rows; i++)
        largest = fmax(largest, fabs(s->of->loop.Fx[i]));
    return s->loop.noisy ? largest / s->loop.noise_Fx : largest;
}

/* How far the sides move when a name does, as a part of their size, to where they have values. */
static double effect(state *s, size_t i, double by) {
    double most = 0;
    s->scale[i] = by; /* q = 2 and q = 0 are then the start, more or less by that */
    if (!residuals_beside(s, i, 2, s->above) && !residuals_beside(s, i, 0, s->above))
        most = (double)INFINITY;
    for (size_t row = 0; row < s->residuals && isfinite(most); row++)
        most = fmax(most, fabs(s->above[row] - s->residual[row]));
    gsl_vector_set(s->beside, i, 1);
    return most / s->size;
}

/* The size of a name is its own value, where a change by as much shows in the sides. A value near 0 tells no
 * size: that is looked for by decades, and is what would move the sides by a tenth. */
static double scale_of(state *s, size_t i) {
    static const double clear = 1e-3, visible_part = 1e-6, decades = 64;
    const double own = fabs(s->start[i]);
    double lo = -decades, hi = decades;
    if (!(s->size > 0) || (own > 0 && effect(s, i, own) >= clear))
        return own > 0 ? own : 1;
    while (hi - lo > 0.2) {
        const double mid = (lo + hi) / 2;
        if (effect(s, i, pow(10, mid)) < visible_part)
            lo = mid;
        else
            hi = mid;
    }
    if (hi == decades) /* nothing shows: determined() reports it */
        return own > 0 ? own : 1;
    const double by = pow(10, hi), part = effect(s, i, by);
    return isfinite(part) ? 0.1 * by / part : by;
}

/* At the present values; a name that is a ratio, or has a range, has its scale. */
static void choose_scales(state *s) {
    gsl_vector_set_all(s->beside, 1);
    s->size = s->of->left ? s->largest : largest_force(s);
    for (size_t i = 0; i < s->of->count; i++)
        if (!s->ratio[i] && !s->bounded[i])
            s->scale[i] = scale_of(s, i);
}

static void choose_unit(state *s) {
    const gsl_vector_const_view f = gsl_vector_const_view_array(s->residual, s->residuals);
    s->unit = gsl_blas_dnrm2(&f.vector) / sqrt((double)s->residuals);
    if (!(s->unit > 0))
        s->unit = 1;
}

/* The part 0..1 of a sequence that fills a box evenly, one base a name. */
static double evenly(unsigned i, size_t name) {
    static const unsigned base[FIT_NAMES] = {2, 3, 5, 7, 11, 13, 17, 19};
    double part = 0, digit = 1;
    for (; i; i /= base[name]) {
        digit /= base[name];
        part += digit * (i % base[name]);
    }
    return part;
}

/* The sum of squares at these names; infinite where there is none. */
static double misfit(state *s, const double *at) {
    double sum = 0;
    for (size_t i = 0; i < s->of->count; i++)
        s->x[i] = at[i];
    memset(s->residual, 0, s->residuals * sizeof *s->residual);
    if (!(s->of->left ? equations(s, s->residual) : loop_run(s, s->residual, run_branches)))
        return (double)INFINITY;
    for (size_t i = 0; i < s->residuals; i++)
        sum += s->residual[i] * s->residual[i];
    return sum;
}

/* The start that is given is one of many: others about it, by decades or over a range, then closer to the
 * best of them. A name that has no size of its own stays. */
static void seek(state *s) {
    enum { SAMPLES = 48, ROWS = 200, ROUNDS = 4 };
    static const double decades[ROUNDS] = {4, 1, 0.3, 0.1};
    const size_t names = s->of->count;
    double best[FIT_NAMES], least;
    s->stride = (s->of->left ? s->of->rows : branches_glance(&s->loop)) / ROWS + 1;
    memcpy(best, s->start, sizeof best);
    least = misfit(s, best);
    for (unsigned round = 0; round < ROUNDS; round++) {
        double centre[FIT_NAMES], at[FIT_NAMES];
        memcpy(centre, best, sizeof centre);
        for (unsigned k = 1; k <= SAMPLES * names && !s->p.error->raised; k++) {
            for (size_t i = 0; i < names; i++) {
                const double part = 2 * evenly(k, i) - 1, reach = decades[round];
                at[i] = s->bounded[i] ? centre[i] + part * fmin(reach, 1) * 5 * s->scale[i]
                                      : centre[i] * pow(10, reach * part);
            }
            const double now = misfit(s, at);
            if (now < least) {
                least = now;
                memcpy(best, at, sizeof best);
            }
        }
    }
    s->stride = 1;
    memcpy(s->start, best, names * sizeof *best);
}

static bool begin_fit(state *s, gsl_vector *q, bool moved, calc_error *error) {
    const fit_question *of = s->of;
    for (size_t i = 0; i < of->count; i++) {
        const knob *k = &of->name[i];
        double lo = -(double)INFINITY, hi = (double)INFINITY;
        if (!ask_present(of->c, k, &s->start[i]))
            return ask_lacks(of->c, k, " to start from", "", error);
        if (k->is_input)
            input_range(k->in, &lo, &hi);
        if (of->from)
            s->start[i] = of->from[i];
        s->ratio[i] = lo == 0 && s->start[i] > 0;
        s->bounded[i] = isfinite(lo) && isfinite(hi);
        s->scale[i] = s->bounded[i] ? 0.1 * (hi - lo) : 1;
    }
    for (size_t i = of->count; i < s->parameters; i++) {
        s->start[i] = s->loop.level[i - of->count];
        s->scale[i] = s->loop.range;
    }
    if (moved || (!of->left && !of->from))
        seek(s);
    gsl_vector_set_all(q, 1);
    if (!residuals(s, q, s->residual)) {
        if (!error->raised) {
            *error = s->p.none;
            if (s->bad_row != NO_ROW)
                calc_append(of->c, error, " (row %zu of the data)", s->bad_row + 1);
        }
        return false;
    }
    choose_unit(s);
    choose_scales(s);
    return !error->raised;
}

/* A scale taken at the start may be wrong: where another name is 0 there, nothing may depend on this one. So
 * scales are taken anew where the fit has ended, and where one differs much, or the residuals have become
 * small beside their unit, the fit is repeated. */
static bool begin_again(state *s, gsl_vector *q, bool *again, calc_error *error) {
    const state before = *s;
    *again = false;
    for (size_t i = 0; i < s->parameters; i++)
        s->start[i] = parameter(s, i, gsl_vector_get(q, i));
    gsl_vector_set_all(s->beside, 1);
    s->largest = 0;
    if (!residuals(s, s->beside, s->residual))
        return false; /* unreached: the fit has just been there */
    choose_scales(s);
    choose_unit(s);
    *again = s->unit < 0.01 * before.unit && s->unit > rounding * s->size;
    for (size_t i = 0; i < s->of->count; i++)
        *again = *again || fabs(log10(s->scale[i] / before.scale[i])) > 2;
    if (*again)
        gsl_vector_set_all(q, 1);
    else
        s->unit = before.unit;
    for (size_t i = 0; i < s->parameters && !*again; i++) {
        s->start[i] = before.start[i];
        s->scale[i] = before.scale[i];
    }
    return !error->raised;
}

/* ---- what the data say ------------------------------------------------------------------------- */

/* (J^T J)^-1 from J = U S V^T diag(norm). GSL's own does not look whether it has got its memory. */
static void covariance(const gsl_matrix *V, const gsl_vector *sv, const double *norm,
                       double C[UNKNOWNS][UNKNOWNS]) {
    const size_t p = V->size1;
    for (size_t i = 0; i < p; i++)
        for (size_t j = 0; j < p; j++) {
            double sum = 0;
            for (size_t k = 0; k < p; k++) {
                const double s = gsl_vector_get(sv, k);
                sum += gsl_matrix_get(V, i, k) / s * (gsl_matrix_get(V, j, k) / s);
            }
            C[i][j] = sum / (norm[i] * norm[j]);
        }
}

/* What tells two names apart that a loop, or whatever the data are, shows together. */
static const struct {
    const char *a, *b, *instead;
} pairs[] = {
    {"E0", "k", "depths at loads decades apart tell k: fit k, E0 for depth = dz(force) to FILE.csv"},
    {"E0", "c0", "a contact shows E0/c0^k alone: give c0, where E = E0"},
    {"k", "c0", "a contact shows E0/c0^k alone: give c0, where E = E0"},
    {"mu", "FN", "measure FN: a column FN beside Fx"},
    {"E0", "FN", "measure FN: a column FN beside Fx"},
    {"E0", "nu", "give nu, which changes little"},
    {"E0", "R", "measure the shape: a profile of the body (geometry file)"},
    {"E0", "K_rig", "measure K_rig on a body that does not yield, or loops at several FN"},
    {"E0", "E0_2", "a contact shows the sum of both compliances: give the modulus of one body"},
};

const char *fit_instead(const char *a, const char *b) {
    for (size_t i = 0; i < sizeof pairs / sizeof *pairs; i++)
        if ((!strcmp(pairs[i].a, a) && !strcmp(pairs[i].b, b)) ||
            (!strcmp(pairs[i].a, b) && !strcmp(pairs[i].b, a)))
            return pairs[i].instead;
    return NULL;
}

/* Of the first pair among the names that the direction v takes along. */
static const char *instead_of(const state *s, const gsl_matrix *V, size_t v) {
    const char *instead = NULL;
    for (size_t i = 0; i < s->of->count && !instead; i++)
        for (size_t j = 0; j < i && !instead; j++)
            if (fabs(gsl_matrix_get(V, i, v)) > 0.05 && fabs(gsl_matrix_get(V, j, v)) > 0.05)
                instead = fit_instead(s->of->name[i].text, s->of->name[j].text);
    return instead ? instead : "give the value of one";
}

/* In plain words, where columns of the Jacobian vanish or depend on each other; else the covariances of a
 * unit variance. */
static bool determined(state *s, gsl_multifit_nlinear_workspace *w, double C[UNKNOWNS][UNKNOWNS],
                       calc_error *error) {
    const size_t p = s->parameters, names = s->of->count;
    gsl_matrix *J = s->J, *V = gsl_matrix_alloc(p, p);
    gsl_vector *sv = gsl_vector_alloc(p), *tau = gsl_vector_alloc(p);
    double norm[UNKNOWNS], most = 0;
    bool ok = V && sv && tau;
    gsl_matrix_memcpy(J, gsl_multifit_nlinear_jac(w));
    for (size_t i = 0; i < p; i++) {
        const gsl_vector_const_view column = gsl_matrix_const_column(J, i);
        norm[i] = gsl_blas_dnrm2(&column.vector);
        most = fmax(most, norm[i]);
    }
    for (size_t i = 0; i < p && ok; i++) {
        gsl_vector_view column = gsl_matrix_column(J, i);
        if (!(norm[i] > 1e-9 * most) && i < names)
            ok = calc_fail(error, 0, 0, "the data do not determine %s: nothing in them depends on it",
                           s->of->name[i].text);
        else
            gsl_vector_scale(&column.vector, 1 / norm[i]);
    }
    if (ok) { /* of J = Q R that of R; finite columns: it converges; unlike others it allocates nothing, which
                 it would not check */
        gsl_matrix_view R = gsl_matrix_submatrix(J, 0, 0, p, p);
        gsl_linalg_QR_decomp(J, tau);
        for (size_t i = 1; i < p; i++)
            for (size_t j = 0; j < i; j++)
                gsl_matrix_set(&R.matrix, i, j, 0);
        gsl_linalg_SV_decomp_jacobi(&R.matrix, V, sv);
    }
    if (ok && gsl_vector_get(sv, p - 1) < 1e-5 * gsl_vector_get(sv, 0)) {
        char list[FIT_NAMES * (LEX_NAME + 6)] = "";
        size_t left = 0;
        for (size_t i = 0; i < names; i++)
            left += fabs(gsl_matrix_get(V, i, p - 1)) > 0.05;
        const bool several = left > 1;
        for (size_t i = 0; i < names; i++)
            if (fabs(gsl_matrix_get(V, i, p - 1)) > 0.05) {
                left--;
                snprintf(list + strlen(list), sizeof list - strlen(list), "%s%s", s->of->name[i].text,
                         left > 1 ? ", "
                         : left   ? " and "
                                  : "");
            }
        if (several)
            ok = calc_fail(error, 0, 0, "the data cannot tell %s apart: only a combination of them shows; %s",
                           list, instead_of(s, V, p - 1));
        else /* a name against turning points, or these alone */
            ok = calc_fail(error, 0, 0,
                           "the data do not determine %s: the rows near the turning points are too few",
                           *list ? list : "where dx turns");
    }
    if (ok)
        covariance(V, sv, norm, C);
    gsl_matrix_free(V);
    gsl_vector_free(sv);
    gsl_vector_free(tau);
    return ok || error->raised ? ok : calc_no_memory(error);
}

/* ---- solving ----------------------------------------------------------------------------------- */

/* GSL stops where it makes no progress. That is the end where the step that is left is small beside the
 * standard error, or beside the name itself. */
static bool arrived(state *s, gsl_multifit_nlinear_workspace *w, calc_error *error) {
    const gsl_vector *f = gsl_multifit_nlinear_residual(w);
    const gsl_matrix *J = gsl_multifit_nlinear_jac(w);
    const size_t n = s->residuals, p = s->parameters;
    double C[UNKNOWNS][UNKNOWNS], pull[UNKNOWNS];
    if (!determined(s, w, C, error))
        return false;
    for (size_t i = 0; i < p; i++) {
        const gsl_vector_const_view column = gsl_matrix_const_column(J, i);
        gsl_blas_ddot(&column.vector, f, &pull[i]);
    }
    const double v = pow(gsl_blas_dnrm2(f), 2) / (double)(n - p);
    for (size_t i = 0; i < p; i++) {
        double step = 0;
        for (size_t j = 0; j < p; j++)
            step += C[i][j] * pull[j];
        if (!(fabs(step) < fmax(1e-6 * sqrt(C[i][i] * v), 1e-10)))
            return calc_fail(error, 0, 0, "the fit does not settle: %s", gsl_strerror(GSL_EMAXITER));
    }
    return true;
}

/* In place of GSL's driver, which an interrupt would not end. */
static int drive(const state *s, gsl_multifit_nlinear_workspace *w) {
    int status = GSL_CONTINUE, info;
    for (int i = 0; i < ITERATIONS && status == GSL_CONTINUE; i++) {
        const int step = gsl_multifit_nlinear_iterate(w);
        if (s->p.error->raised)
            return GSL_EFAILED;
        if (step == GSL_ENOPROG && i == 0) /* may have begun at the end: arrived() looks */
            return GSL_EMAXITER;
        status = gsl_multifit_nlinear_test(1e-10, 1e-10, 0, &info, w);
    }
    return status == GSL_SUCCESS ? GSL_SUCCESS : GSL_EMAXITER;
}

static bool descend(state *s, gsl_multifit_nlinear_workspace *w, gsl_vector *q, fit_answer *out,
                    calc_error *error) {
    gsl_multifit_nlinear_fdf fdf = {
        .f = gsl_residuals, .df = gsl_jacobian, .n = s->residuals, .p = s->parameters, .params = s};
    int status = gsl_multifit_nlinear_init(q, &fdf, w);
    if (!status)
        status = drive(s, w);
    if (error->raised)
        return false;
    out->iterations += (unsigned)gsl_multifit_nlinear_niter(w);
    gsl_vector_memcpy(q, gsl_multifit_nlinear_position(w));
    return !status || arrived(s, w, error);
}

/* A drift, an offset or a model that does not fit leaves residuals that go together from row to row. */
static void look_for_drift(const state *s, const gsl_vector *f, fit_answer *out) {
    const size_t n = s->of->rows;
    const double size = s->of->left ? INFINITY : largest_force(s);
    double squares = 0, products = 0, before = 0;
    for (size_t i = 0; i < n; i++) {
        const double r = gsl_vector_get(f, i);
        squares += r * r;
        products += r * before;
        before = r;
    }
    out->together = squares > 0 ? products / squares : 0;
    out->drifts = out->rms > visible * size && out->together > 0.5 && out->together > 4 / sqrt((double)n);
}

static bool judge_fit(state *s, gsl_multifit_nlinear_workspace *w, const gsl_vector *q, fit_answer *out,
                      calc_error *error) {
    const size_t p = s->of->count;
    const gsl_vector *f = gsl_multifit_nlinear_residual(w);
    const double squares = pow(gsl_blas_dnrm2(f), 2), v = squares / (double)(s->of->rows - p);
    double C[UNKNOWNS][UNKNOWNS];
    out->rms = sqrt(squares / (double)s->of->rows) * s->unit;
    look_for_drift(s, f, out);
    const bool ok = determined(s, w, C, error);
    for (size_t i = 0; i < p && ok; i++) {
        const double x = parameter(s, i, gsl_vector_get(q, i));
        out->value[i] = x;
        out->deviation[i] = sqrt(C[i][i] * v) * fabs(s->ratio[i] ? x : s->scale[i]);
        for (size_t j = 0; j < p; j++)
            out->correlation[i][j] = C[i][j] / sqrt(C[i][i] * C[j][j]);
    }
    out->d = s->d;
    out->twice = s->twice;
    out->noisy = s->loop.noisy;
    out->turns = s->parameters - p;
    out->noise_dx = s->loop.noise_dx;
    out->noise_Fx = s->loop.noise_Fx;
    out->evaluations = s->evaluations;
    return ok;
}

static bool run_once(state *s, gsl_multifit_nlinear_workspace *w, gsl_vector *q, bool moved, fit_answer *out,
                     calc_error *error) {
    bool again = true;
    if (!begin_fit(s, q, moved, error))
        return false;
    for (int i = 0; i < BEGINNINGS && again; i++)
        if (!descend(s, w, q, out, error) || !begin_again(s, q, &again, error))
            return false;
    return judge_fit(s, w, q, out, error);
}

/* What is wrong from the start that was given may be right from another. */
static bool run_fit(state *s, gsl_multifit_nlinear_workspace *w, gsl_vector *q, fit_answer *out,
                    calc_error *error) {
    s->above = s->residual + s->residuals;
    s->below = s->above + s->residuals;
    if (run_once(s, w, q, false, out, error))
        return true;
    const calc_error first = *error;
    if ((!s->of->left && !s->of->from) || error->stop || error->strange || error->circle)
        return false;
    error_clear(error);
    if (run_once(s, w, q, true, out, error))
        return true;
    if (!error->stop)
        *error = first;
    return false;
}

void fit_points_free(fit_points *p) {
    free(p->left);
    *p = (fit_points){.nodes = 0};
}

/* Once more at the answer. */
static bool keep_points(state *s, const gsl_vector *q, fit_points *p, calc_error *error) {
    const size_t n = s->of->rows;
    p->nodes = s->loop.noisy ? branches_nodes(&s->loop) : 0;
    p->left = malloc((3 * n + 2 * p->nodes) * sizeof *p->left);
    if (!p->left)
        return calc_no_memory(error);
    p->right = p->left + n;
    p->residual = p->right + n;
    p->x = p->residual + n;
    p->y = p->x + p->nodes;
    for (size_t i = 0; i < 2 * p->nodes; i++) /* a last branch without rows is not gone through */
        p->x[i] = (double)NAN;
    s->kept = p;
    s->loop.x = p->nodes ? p->x : NULL;
    s->loop.F = p->y;
    const bool ok = residuals(s, q, s->residual);
    memcpy(p->residual, s->residual, n * sizeof *p->residual);
    for (size_t i = 0; i < n && !s->of->left; i++) {
        p->left[i] = s->of->loop.Fx[i];
        p->right[i] = p->left[i] - p->residual[i];
    }
    return ok;
}

static bool begin_points(state *s, calc_error *error) {
    static const size_t passes = 10; /* a fit goes through the rows more often than that */
    const fit_question *of = s->of;
    for (size_t i = 0; i < of->count; i++)
        s->knobs[i] = of->name[i];
    for (size_t j = 0; j < of->columns; j++)
        s->knobs[of->count + j] = of->column[j].name;
    if (of->left) {
        s->sides[0] = *of->left;
        s->sides[1] = *of->right;
    }
    const size_t columns = of->left ? of->columns : 0;
    const bool ok =
        points_open(&s->p, of->c, s->knobs, of->count + columns, s->sides, of->left ? 2 : 0, error);
    if (ok)
        s->p.t->scene.gaps = true;
    s->p.all = passes * of->rows;
    return ok;
}

static bool begin_loop(state *s, calc_error *error) {
    const fit_question *of = s->of;
    const fit_loop *loop = &of->loop;
    s->loop = (branches){.rows = of->rows, .dx = loop->dx, .Fx = loop->Fx, .normal = loop->normal};
    s->twice = loop->closed || begins_midway(of);
    if (!branches_find(&s->loop, loop->noise_dx, loop->noise_Fx, s->twice, error))
        return false;
    if (s->loop.noisy) {
        s->parameters += s->loop.turns;
        s->residuals += s->loop.turns;
    }
    return s->parameters - of->count <= TURNS ||
           calc_fail(error, 0, 0,
                     "dx turns %zu times: more than %d turning points with noise are not fitted at once",
                     s->loop.turns, TURNS);
}

bool fit(const fit_question *question, fit_answer *out, calc_error *error) {
    gsl_multifit_nlinear_parameters method = gsl_multifit_nlinear_default_parameters();
    state s = {.of = question, .parameters = question->count, .residuals = question->rows, .stride = 1};
    *out = (fit_answer){.rms = 0};
    gsl_set_error_handler_off();
    if (question->rows <= question->count)
        return calc_fail(error, 0, 0, "%zu rows cannot determine %zu parameters", question->rows,
                         question->count);
    if (!begin_points(&s, error) || (!question->left && !begin_loop(&s, error)))
        return branches_free(&s.loop), points_close(&s.p), false;
    const size_t n = s.residuals, p = s.parameters;
    if (p > question->count + MANY)
        method.solver =
            gsl_multifit_nlinear_solver_cholesky; /* half the time; noise leaves no digits to lose */
    gsl_multifit_nlinear_workspace *w = gsl_multifit_nlinear_alloc(gsl_multifit_nlinear_trust, &method, n, p);
    gsl_vector *q = gsl_vector_alloc(p);
    s.beside = gsl_vector_alloc(p);
    s.J = gsl_matrix_alloc(n, p);
    s.residual = malloc(3 * n * sizeof *s.residual);
    bool ok = w && q && s.beside && s.J && s.residual;
    ok = ok ? run_fit(&s, w, q, out, error) : calc_no_memory(error);
    ok = ok && (!question->points || keep_points(&s, q, question->points, error));
    if (w)
        gsl_multifit_nlinear_free(w);
    gsl_vector_free(q);
    gsl_vector_free(s.beside);
    gsl_matrix_free(s.J);
    free(s.residual);
    branches_free(&s.loop);
    points_close(&s.p);
    return ok;
}
