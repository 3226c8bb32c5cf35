/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Start values, the minimisation, standard errors and intervals. Depends on residuals.h and GSL. */
#include "study/fit.h"

#include <gsl/gsl_blas.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_multilarge_nlinear.h>
#include <gsl/gsl_qrng.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "study/determined.h"

/* Residuals at a trial point without a value: so large that the solver rejects the step. */
static const double refused = 1e6;
enum { ITERATIONS = 200, BEGINNINGS = 4 };
static const double visible = 1e-6;  /* residuals of a loop relative to its F_x; smaller ones show no drift */
static const double rounding = 1e-9; /* residuals relative to the sides; smaller ones are rounding */

typedef struct fitting {
    residuals r;
    bool bounded[UNKNOWNS]; /* inputs whose range has two ends */
    double size;            /* largest side of the equations at the present values; for a loop, largest F_x */
    gsl_multilarge_nlinear_workspace *w;
    unsigned iterations;
} fitting;

/* ---- callbacks for the solver ------------------------------------------------------------------ */

static void put_unknowns(residuals *r, const gsl_vector *q) {
    for (size_t i = 0; i < r->unknowns; i++)
        r->q[i] = gsl_vector_get(q, i);
}

static int gsl_residuals(const gsl_vector *q, void *context, gsl_vector *f) {
    residuals *r = context;
    put_unknowns(r, q);
    if (residuals_at(r, r->out)) {
        for (size_t i = 0; i < r->count; i++)
            gsl_vector_set(f, i, r->out[i] / r->unit);
        return GSL_SUCCESS;
    }
    gsl_vector_set_all(f, refused);
    return r->p.error->raised ? GSL_EFAILED : GSL_SUCCESS;
}

static int gsl_slopes(CBLAS_TRANSPOSE_t transposed, const gsl_vector *q, const gsl_vector *u, void *context,
                      gsl_vector *v, gsl_matrix *N) {
    residuals *r = context;
    put_unknowns(r, q);
    if (!residuals_slopes(r))
        return GSL_EFAILED;
    const gsl_matrix_const_view J = gsl_matrix_const_view_array(r->slopes, r->count, r->unknowns);
    gsl_blas_dgemv(transposed, 1, &J.matrix, u, 0, v);
    if (N)
        gsl_blas_dsyrk(CblasLower, CblasTrans, 1, &J.matrix, 0, N);
    return GSL_SUCCESS;
}

/* ---- the start --------------------------------------------------------------------------------- */

/* The largest |F_x| of a measured loop, in the unit of the residuals. */
static double largest_force(const residuals *r) {
    double largest = 0;
    for (size_t i = 0; i < r->of->rows; i++)
        largest = fmax(largest, fabs(r->of->loop.Fx[i]));
    return r->loop.noisy ? largest / r->loop.noise_Fx : largest;
}

static void put_at_start(residuals *r) {
    for (size_t i = 0; i < r->unknowns; i++)
        r->q[i] = 1;
}

/* The largest change of a residual, relative to s->size, when name i changes by `by` (by -by if there is no
 * value); infinite if neither has a value. */
static double effect(fitting *s, size_t i, double by) {
    residuals *r = &s->r;
    double most = 0;
    r->scale[i] = by; /* then q = 2 and q = 0 stand for start + by and start - by */
    r->q[i] = 2;
    if (!residuals_at(r, r->above)) {
        r->q[i] = 0;
        most = residuals_at(r, r->above) ? 0 : (double)INFINITY;
    }
    r->q[i] = 1;
    for (size_t row = 0; row < r->count && isfinite(most); row++)
        most = fmax(most, fabs(r->above[row] - r->out[row]));
    return most / s->size;
}

/* The scale of a name: its own value if a change by that shows in the residuals; else, as for a value near 0,
 * the change that would move the residuals by a tenth of their size, searched by decades. */
static double scale_of(fitting *s, size_t i) {
    static const double clear = 1e-3, visible_part = 1e-6, decades = 64;
    const double own = fabs(s->r.start[i]);
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
    if (hi == decades) /* no effect: determined() reports it */
        return own > 0 ? own : 1;
    const double by = pow(10, hi), part = effect(s, i, by);
    return isfinite(part) ? 0.1 * by / part : by;
}

/* Finds the scales at the present values, but for names with `ratio` or a range, which need none. */
static void choose_scales(fitting *s) {
    residuals *r = &s->r;
    s->size = r->of->sides ? r->largest : largest_force(r);
    for (size_t i = 0; i < r->of->count; i++)
        if (!r->ratio[i] && !s->bounded[i])
            r->scale[i] = scale_of(s, i);
}

static void choose_unit(residuals *r) {
    const gsl_vector_const_view f = gsl_vector_const_view_array(r->out, r->count);
    r->unit = gsl_blas_dnrm2(&f.vector) / sqrt((double)r->count);
    if (!(r->unit > 0))
        r->unit = 1;
}

/* The sum of squares of about 200 rows at these names, with measured turning points; infinite: no value. */
static double glance(residuals *r, const double *at) {
    const size_t rows = r->of->sides ? r->of->rows : branches_glance(&r->loop);
    double sum = 0;
    memcpy(r->start, at, r->of->count * sizeof *at);
    put_at_start(r);
    r->stride = rows / 200 + 1;
    const bool ok = residuals_at(r, r->out);
    r->stride = 0;
    for (size_t i = 0; i < r->count && ok; i++)
        sum += r->out[i] * r->out[i];
    return ok ? sum : (double)INFINITY;
}

/* The range of the columns with the dimension of the name, perhaps their offset; false: there are none. */
static bool spanned(const residuals *r, size_t name, double *lo, double *hi) {
    const fit_question *of = r->of;
    bool any = false;
    for (size_t j = 0; j < of->columns && !r->ratio[name]; j++)
        for (size_t i = 0; i < of->rows && dim_equal(of->column[j].name.d, of->name[name].d); i++) {
            const double v = of->column[j].v[i];
            *lo = any ? fmin(*lo, v) : v;
            *hi = any ? fmax(*hi, v) : v;
            any = true;
        }
    return any;
}

/* Replaces *best by the best of many start values: a Halton sequence about it, over `farthest` decades or the
 * range of the input, then in ever smaller boxes about the best. Every other start takes a name that may be
 * an offset from the range of its columns. False: the given start was the best. */
static bool seek(fitting *s, double *best, double farthest) {
    enum { SAMPLES = 24, ROUNDS = 8 };
    residuals *r = &s->r;
    const size_t names = r->of->count;
    double lo[FIT_NAMES], hi[FIT_NAMES], part[FIT_NAMES], centre[FIT_NAMES], at[FIT_NAMES];
    bool span[FIT_NAMES];
    gsl_qrng *even = gsl_qrng_alloc(gsl_qrng_halton, (unsigned)names);
    if (!even)
        return calc_no_memory(r->p.error);
    for (size_t i = 0; i < names; i++)
        span[i] = spanned(r, i, &lo[i], &hi[i]);
    const double given = glance(r, best);
    double least = given;
    for (unsigned round = 0; round < ROUNDS; round++) {
        memcpy(centre, best, names * sizeof *best);
        gsl_qrng_init(even);
        for (unsigned k = 1; k <= SAMPLES * names && !r->p.error->raised; k++) {
            gsl_qrng_get(even, part);
            for (size_t i = 0; i < names; i++) {
                const double by = (2 * part[i] - 1) / (1u << round);
                at[i] = s->bounded[i]      ? centre[i] + by * 5 * r->scale[i]
                        : span[i] && k % 2 ? (round ? centre[i] : (lo[i] + hi[i]) / 2) + by * (hi[i] - lo[i])
                                           : centre[i] * pow(10, farthest * by);
            }
            const double now = glance(r, at);
            if (now < least) {
                least = now;
                memcpy(best, at, names * sizeof *best);
            }
        }
    }
    gsl_qrng_free(even);
    return least < given;
}

/* Reads the start values, and sets ratio, bounded and a first scale of each name. */
static bool read_start(fitting *s, double *start, calc_error *error) {
    residuals *r = &s->r;
    const fit_question *of = r->of;
    for (size_t i = 0; i < of->count; i++) {
        const knob *k = &of->name[i];
        double lo = -(double)INFINITY, hi = (double)INFINITY;
        if (!knob_present(of->c, k, &start[i]))
            return knob_lacks(of->c, k, " to start from", "", error);
        if (k->is_input)
            input_range(k->in, &lo, &hi);
        if (of->from)
            start[i] = of->from[i];
        r->ratio[i] = lo == 0 && start[i] > 0;
        s->bounded[i] = isfinite(lo) && isfinite(hi);
        r->scale[i] = s->bounded[i] ? 0.1 * (hi - lo) : 1;
    }
    return true;
}

static bool begin_fit(fitting *s, const double *start, calc_error *error) {
    residuals *r = &s->r;
    const size_t names = r->of->count;
    r->has_slopes = false;
    if (r->unknowns > names) /* sets r->loop.turn */
        glance(r, start);
    memcpy(r->start, start, names * sizeof *start);
    for (size_t i = names; i < r->unknowns; i++) {
        r->start[i] = r->loop.turn[i - names];
        r->scale[i] = r->loop.range;
    }
    put_at_start(r);
    if (!residuals_at(r, r->out)) {
        if (!error->raised) {
            *error = r->p.none;
            if (r->bad_row != NO_ROW)
                calc_append(r->of->c, error, " (row %zu of the data)", r->bad_row + 1);
        }
        return false;
    }
    choose_unit(r);
    choose_scales(s);
    return !error->raised;
}

/* Restores the unknowns and their scaling. */
static void go_back(residuals *r, const residuals *to) {
    memcpy(r->q, to->q, sizeof r->q);
    memcpy(r->start, to->start, sizeof r->start);
    memcpy(r->scale, to->scale, sizeof r->scale);
    r->unit = to->unit;
}

/* The scale found at the start may be wrong: if another name is 0 there, nothing may depend on this one.
 * Scales are found again at the end of the fit; if one differs by a factor of 100, or the residuals have
 * fallen below 1 % of their unit, the fit is to be repeated. */
static bool begin_again(fitting *s, bool *again, calc_error *error) {
    residuals *r = &s->r;
    const residuals before = *r;
    *again = false;
    for (size_t i = 0; i < r->unknowns; i++)
        r->start[i] = residuals_unknown(r, i);
    put_at_start(r);
    r->largest = 0;
    if (!residuals_at(r, r->out))
        return false; /* unreached: the fit has just been there */
    choose_scales(s);
    choose_unit(r);
    *again = r->unit < 0.01 * before.unit && r->unit > rounding * s->size;
    for (size_t i = 0; i < r->of->count; i++)
        *again = *again || fabs(log10(r->scale[i] / before.scale[i])) > 2;
    r->has_slopes = r->has_slopes && !*again;
    if (!*again)
        go_back(r, &before);
    return !error->raised;
}

/* ---- solving ----------------------------------------------------------------------------------- */

/* Has the solver converged? If GSL stopped without progress: yes if the remaining Newton step of each name is
 * small relative to its standard error or to the name. If it stopped with small steps: yes unless the Newton
 * step promises to reduce the squares by more than their variance, as at a kink. */
static bool arrived(fitting *s, bool small, calc_error *error) {
    residuals *r = &s->r;
    const gsl_vector *f = gsl_multilarge_nlinear_residual(s->w);
    const size_t p = r->unknowns;
    double C[UNKNOWNS][UNKNOWNS], pull[UNKNOWNS], promised = 0;
    gsl_vector_view of = gsl_vector_view_array(pull, p);
    bool ok = true;
    if (!determined(r, C, error))
        return false;
    const gsl_matrix_const_view J = gsl_matrix_const_view_array(r->slopes, r->count, p);
    gsl_blas_dgemv(CblasTrans, 1, &J.matrix, f, 0, &of.vector);
    const double v = pow(gsl_blas_dnrm2(f), 2) / (double)(r->count - p);
    for (size_t i = 0; i < p; i++) {
        double step = 0;
        for (size_t j = 0; j < p; j++)
            step += C[i][j] * pull[j];
        promised += fabs(step) < 1e6 ? step * pull[i] : 0; /* larger steps are of undetermined unknowns */
        ok = ok && (small || i >= r->of->count || fabs(step) < fmax(1e-6 * sqrt(C[i][i] * v), 1e-10));
    }
    const bool exact = r->unit * sqrt(v) < rounding * s->size;
    return (ok && (!small || exact || promised < v)) ||
           calc_fail(error, 0, 0, "the fit does not converge: %s", gsl_strerror(GSL_EMAXITER));
}

/* Replaces GSL's driver, which an interrupt would not end. */
static int drive(fitting *s) {
    int status = GSL_CONTINUE, info;
    for (int i = 0; i < ITERATIONS && status == GSL_CONTINUE; i++) {
        const int step = gsl_multilarge_nlinear_iterate(s->w);
        if (s->r.p.error->raised)
            return GSL_EFAILED;
        if (step == GSL_ENOPROG && i == 0) /* perhaps begun at the minimum: arrived() checks */
            return GSL_EMAXITER;
        status = gsl_multilarge_nlinear_test(1e-10, 1e-10, 0, &info, s->w);
    }
    if (status == GSL_SUCCESS)
        gsl_multilarge_nlinear_iterate(s->w); /* one more takes exact data to rounding; it may do nothing */
    return s->r.p.error->raised ? GSL_EFAILED : status == GSL_SUCCESS ? GSL_SUCCESS : GSL_EMAXITER;
}

/* Minimises from r->q and returns the solver's status. Raises an error if memory is out. */
static int descend(fitting *s, calc_error *error) {
    const gsl_multilarge_nlinear_parameters method = gsl_multilarge_nlinear_default_parameters();
    residuals *r = &s->r;
    gsl_multilarge_nlinear_fdf fdf = {
        .f = gsl_residuals, .df = gsl_slopes, .n = r->count, .p = r->unknowns, .params = r};
    double q[UNKNOWNS];
    const gsl_vector_view from = gsl_vector_view_array(q, r->unknowns);
    memcpy(q, r->q, sizeof q);
    if (!s->w)
        s->w = gsl_multilarge_nlinear_alloc(gsl_multilarge_nlinear_trust, &method, r->count, r->unknowns);
    if (!s->w)
        return calc_no_memory(error), GSL_ENOMEM;
    int status = gsl_multilarge_nlinear_init(&from.vector, &fdf, s->w);
    if (!status)
        status = drive(s);
    s->iterations += (unsigned)gsl_multilarge_nlinear_niter(s->w);
    put_unknowns(r, gsl_multilarge_nlinear_position(s->w));
    return status;
}

static bool settle(fitting *s, calc_error *error) {
    const int status = descend(s, error);
    return !error->raised && arrived(s, !status, error);
}

/* A drift, an offset or a model that does not fit makes successive residuals correlate. */
static void look_for_drift(const residuals *r, const gsl_vector *f, fit_answer *out) {
    const size_t n = r->of->rows;
    const double size = r->of->sides ? INFINITY : largest_force(r);
    double squares = 0, products = 0, before = 0;
    for (size_t i = 0; i < n; i++) {
        const double now = gsl_vector_get(f, i);
        squares += now * now;
        products += now * before;
        before = now;
    }
    out->together = squares > 0 ? products / squares : 0;
    out->drifts = out->rms > visible * size && out->together > 0.5 && out->together > 4 / sqrt((double)n);
}

static bool judge_fit(fitting *s, fit_answer *out, calc_error *error) {
    residuals *r = &s->r;
    const size_t p = r->of->count;
    const gsl_vector *f = gsl_multilarge_nlinear_residual(s->w);
    const double squares = pow(gsl_blas_dnrm2(f), 2), v = squares / (double)(r->of->rows - p);
    double C[UNKNOWNS][UNKNOWNS];
    *out = (fit_answer){
        .d = r->d, .twice = r->loop.passed > 0, .noisy = r->loop.noisy, .turns = r->unknowns - p};
    out->rms = sqrt(squares / (double)r->of->rows) * r->unit;
    look_for_drift(r, f, out);
    const bool ok = determined(r, C, error);
    for (size_t i = 0; i < p && ok; i++) {
        const double x = residuals_unknown(r, i);
        out->value[i] = x;
        out->deviation[i] = sqrt(C[i][i] * v) * fabs(r->ratio[i] ? x : r->scale[i]);
        for (size_t j = 0; j < p; j++)
            out->correlation[i][j] = C[i][j] / sqrt(C[i][i] * C[j][j]);
    }
    out->noise_dx = r->loop.noise_dx;
    out->noise_Fx = r->loop.noise_Fx;
    return ok;
}

static bool run_from(fitting *s, const double *start, fit_answer *out, calc_error *error) {
    bool again = true;
    if (!begin_fit(s, start, error))
        return false;
    for (int i = 0; i < BEGINNINGS && again; i++)
        if (!settle(s, error) || !begin_again(s, &again, error))
            return false;
    return judge_fit(s, out, error);
}

/* Fits from the given start and from the best of many; the smaller rms wins, and a failure of one does not
 * matter if the other succeeds. A loop begins with the best of many and uses the given start only if that
 * fails. Start values that are close to the answer (of->from) are used alone. */
static bool run_fit(fitting *s, fit_answer *out, calc_error *error) {
    static const double near = 1, far = 4; /* decades; far off, a periodic model repeats */
    residuals *r = &s->r;
    const fit_question *of = r->of;
    const bool loop = !of->sides && !of->from;
    double start[FIT_NAMES] = {0}, other[FIT_NAMES];
    fit_answer second;
    if (!read_start(s, start, error))
        return false;
    memcpy(other, start, sizeof other);
    if (loop)
        seek(s, start, far);
    bool ok = !error->raised && run_from(s, start, out, error);
    if (of->from || (loop && ok) || error->stop || error->strange || error->circle)
        return ok;
    const calc_error first = *error;
    const residuals there = *r;
    error_clear(error);
    if ((loop || seek(s, other, ok ? near : far)) && run_from(s, other, &second, error) &&
        !(ok && out->rms <= second.rms * (1 + 1e-6))) {
        *out = second;
        return true;
    }
    if (error->stop || loop)
        return false;
    *error = first;
    go_back(r, &there);
    r->has_slopes = false;
    return ok;
}

/* ---- intervals --------------------------------------------------------------------------------- */

/* The profile of the sum of squares along one name about the minimum. */
typedef struct profile {
    fitting *s;
    double q[UNKNOWNS], C[UNKNOWNS][UNKNOWNS]; /* minimum, (J^T J)^-1 */
    double v, least;                           /* variance of the residuals, sum of squares at the minimum */
    size_t name;
    double error; /* standard error of the name, in q */
} profile;

static double squares_of(const residuals *r) {
    double sum = 0;
    for (size_t row = 0; row < r->count; row++)
        sum += r->out[row] / r->unit * (r->out[row] / r->unit);
    return sum;
}

/* The growth of the sum of squares, in variances, when the name moves by `by` standard errors and the others
 * follow along the valley of the parabola. Infinite: there is no value. */
static double grown(const profile *p, double by) {
    residuals *r = &p->s->r;
    const size_t i = p->name;
    const double off = r->ratio[i] ? log1p(by * p->error) : by * p->error;
    if (!(off > -INFINITY))
        return (double)INFINITY;
    for (size_t j = 0; j < r->unknowns; j++)
        r->q[j] = p->q[j] + off * p->C[j][i] / p->C[i][i];
    return residuals_at(r, r->out) ? (squares_of(r) - p->least) / p->v : (double)INFINITY;
}

/* The same with the others fitted again. */
static double profiled(const profile *p, double by) {
    residuals *r = &p->s->r;
    const double start = grown(p, by);
    double end = start;
    if (!isfinite(start) || r->unknowns == 1)
        return start;
    r->held = p->name;
    r->has_slopes = false;
    descend(p->s, r->p.error);
    if (!r->p.error->raised)
        end = (pow(gsl_blas_dnrm2(gsl_multilarge_nlinear_residual(p->s->w)), 2) - p->least) / p->v;
    r->held = r->unknowns;
    r->has_slopes = false;
    return fmin(start, end);
}

/* The distance from the minimum to one side, in standard errors, at which the sum of squares has grown by one
 * variance; infinite: more than 64. */
static double reach(const profile *p, double side) {
    static const double far = 64;
    double lo = 0, hi = 1, at = profiled(p, side);
    while (at < 1 && hi < far) {
        lo = hi;
        hi *= 2;
        at = profiled(p, side * hi);
    }
    while (at >= 1 && hi - lo > 0.02 * hi && !p->s->r.p.error->raised) {
        const double mid = (lo + hi) / 2;
        if (profiled(p, side * mid) < 1)
            lo = mid;
        else
            hi = mid;
    }
    return at < 1 ? side * (double)INFINITY : side * (lo + hi) / 2;
}

/* Is the growth at one standard error near 1? Mostly the valley of the parabola shows it without fitting. */
static bool is_even(const profile *p, double side) {
    static const double near = 0.1, part = 0.2;
    return fabs(grown(p, side) - 1) < near || fabs(profiled(p, side) - 1) < part;
}

static bool find_intervals(fitting *s, fit_answer *out, calc_error *error) {
    residuals *r = &s->r;
    profile p = {.s = s};
    memcpy(p.q, r->q, sizeof p.q);
    if (!determined(r, p.C, error) || !residuals_at(r, r->out))
        return false;
    p.least = squares_of(r);
    p.v = p.least / (double)(r->of->rows - r->of->count);
    for (size_t i = 0; i < r->of->count && p.v > 0 && !error->raised; i++) {
        p.name = i;
        p.error = sqrt(p.C[i][i] * p.v);
        out->uneven[i] = !is_even(&p, -1) || !is_even(&p, 1);
        if (!out->uneven[i])
            continue;
        out->below[i] = -reach(&p, -1) * out->deviation[i];
        out->above[i] = reach(&p, 1) * out->deviation[i];
    }
    memcpy(r->q, p.q, sizeof r->q);
    return !error->raised;
}

void fit_points_free(fit_points *p) {
    free(p->left);
    *p = (fit_points){.nodes = 0};
}

/* Computes the residuals at the answer again and stores the points. */
static bool keep_points(residuals *r, fit_points *p, calc_error *error) {
    const size_t n = r->of->rows;
    p->nodes = r->loop.noisy ? branches_nodes(&r->loop) : 0;
    p->left = malloc((3 * n + 2 * p->nodes) * sizeof *p->left);
    if (!p->left)
        return calc_no_memory(error);
    p->right = p->left + n;
    p->residual = p->right + n;
    p->x = p->residual + n;
    p->y = p->x + p->nodes;
    for (size_t i = 0; i < 2 * p->nodes; i++) /* a last branch without rows has no curve */
        p->x[i] = (double)NAN;
    r->kept = p;
    r->loop.x = p->nodes ? p->x : NULL;
    r->loop.F = p->y;
    const bool ok = residuals_at(r, r->out);
    memcpy(p->residual, r->out, n * sizeof *p->residual);
    for (size_t i = 0; i < n && !r->of->sides; i++) {
        p->left[i] = r->of->loop.Fx[i];
        p->right[i] = p->left[i] - p->residual[i];
    }
    return ok;
}

static bool fit_as(const fit_question *question, fit_answer *out, calc_error *error) {
    *out = (fit_answer){.rms = 0};
    gsl_set_error_handler_off();
    if (question->rows <= question->count)
        return calc_fail(error, 0, 0, "%zu row%s cannot determine %zu parameter%s", question->rows,
                         question->rows == 1 ? "" : "s", question->count, question->count == 1 ? "" : "s");
    fitting *s = calloc(1, sizeof *s);
    if (!s)
        return calc_no_memory(error);
    residuals *r = &s->r;
    bool ok = residuals_open(r, question, error);
    ok = ok && run_fit(s, out, error) && (!question->points || find_intervals(s, out, error));
    out->evaluations = r->evaluations;
    out->iterations = s->iterations;
    ok = ok && (!question->points || keep_points(r, question->points, error));
    if (s->w)
        gsl_multilarge_nlinear_free(s->w);
    residuals_close(r);
    free(s);
    return ok;
}

/* Does a path begin at rest or within a steady cycle? The way that fits better is taken. */
bool fit(const fit_question *question, fit_answer *out, calc_error *error) {
    fit_question one = *question;
    fit_points other = {.nodes = 0};
    fit_answer steady;
    calc_error why = ERROR_NONE;
    bool ok = fit_as(question, out, error);
    if (question->sides || question->loop.steady || error->stop)
        return ok;
    one.loop.steady = true;
    one.points = question->points ? &other : NULL;
    one.from = ok ? out->value : question->from;
    if (fit_as(&one, &steady, &why) && steady.twice && !(ok && out->rms <= steady.rms * (1 + 1e-6))) {
        error_clear(error);
        *out = steady;
        ok = true;
        if (question->points) {
            const fit_points rest = *question->points;
            *question->points = other;
            other = rest;
        }
    } else if (why.stop) {
        *error = why;
        ok = false;
    }
    fit_points_free(&other);
    return ok;
}
