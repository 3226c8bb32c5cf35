/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Least squares over cubic B-splines, by the normal equations: a local basis keeps them well conditioned, and
 * a step of iterative refinement removes their rounding. If noise makes the profile fall, the nearest convex
 * spline is taken: its coefficients are convex over the Greville abscissae. Depends on GSL and text. */
#include "study/smooth.h"

#include <gsl/gsl_blas.h>
#include <gsl/gsl_bspline.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_linalg.h>
#include <gsl/gsl_poly.h>
#include <gsl/gsl_version.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "language/calc.h"
#include "number/array.h"

#if GSL_MAJOR_VERSION == 2 && GSL_MINOR_VERSION < 8 /* other names for the same functions */
static int gsl_bspline_init_augment(const gsl_vector *ends, gsl_bspline_workspace *w) {
    return gsl_bspline_knots(ends, w);
}

static int gsl_bspline_basis(double x, gsl_vector *basis, size_t *first, gsl_bspline_workspace *w) {
    size_t last;
    return gsl_bspline_eval_nonzero(x, basis, first, &last, w);
}

static int gsl_bspline_basis_deriv(double x, size_t order, gsl_matrix *basis, size_t *first,
                                   gsl_bspline_workspace *w) {
    size_t last;
    return gsl_bspline_deriv_eval_nonzero(x, order, basis, first, &last, w);
}
#endif

/* The first two basis functions carry f(0) and f'(0), which are 0: they are left out. */
enum { ORDER = 4, FIXED = 2 };

/* A row: |r| and f divided by their largest values. */
typedef struct row {
    double r, f;
} row;

typedef struct rows {
    row *row; /* in ascending order of |r| */
    size_t count, distinct;
    double *at;  /* the distinct |r| */
    double r, f; /* largest |r| and |f| [m] */
} rows;

typedef struct candidate {
    size_t pieces, unknowns; /* the last unknown is the offset */
    gsl_bspline_workspace *spline;
    gsl_vector *ends, *c, *right; /* of pieces; coefficients; right side */
    gsl_matrix *normal, *factor;  /* normal equations and their Cholesky factor */
    double rms, worst, at;
    bool grows;         /* (r f')' >= 0, so that the MDR profile g(x) grows */
    double falls, drop; /* r from which f falls, and by how much */
} candidate;

static bool rows_make(rows *all, const double *r, const double *f, size_t count, calc_error *error) {
    *all = (rows){.row = malloc(count * sizeof *all->row), .at = malloc(count * sizeof *all->at)};
    if (!all->row || !all->at)
        return calc_no_memory(error);
    for (size_t i = 0; i < count; i++) {
        all->r = fmax(all->r, fabs(r[i]));
        all->f = fmax(all->f, fabs(f[i]));
    }
    if (!(all->r > 0 && all->f > 0))
        return calc_fail(error, 0, 0, "the rows are all at %s = 0", all->r > 0 ? "f" : "r");
    all->count = count;
    for (size_t i = 0; i < count; i++)
        all->row[i] = (row){fabs(r[i]) / all->r, f[i] / all->f};
    qsort(all->row, count, sizeof *all->row, fret_ascending);
    for (size_t i = 0; i < count; i++)
        if (i == 0 || all->row[i].r > all->row[i - 1].r)
            all->at[all->distinct++] = all->row[i].r;
    return true;
}

/* ---- one fit ----------------------------------------------------------------------------------- */

static void candidate_end(candidate *t) {
    if (t->spline)
        gsl_bspline_free(t->spline);
    gsl_vector_free(t->ends);
    gsl_vector_free(t->c);
    gsl_vector_free(t->right);
    gsl_matrix_free(t->normal);
    gsl_matrix_free(t->factor);
    *t = (candidate){.pieces = 0};
}

static bool candidate_begin(candidate *t, const rows *all, size_t pieces, calc_error *error) {
    const size_t unknowns = pieces + ORDER - 1 - FIXED + 1; /* + 1: the offset */
    *t = (candidate){.pieces = pieces,
                     .unknowns = unknowns,
                     .spline = gsl_bspline_alloc(ORDER, pieces + 1),
                     .ends = gsl_vector_alloc(pieces + 1),
                     .c = gsl_vector_calloc(unknowns),
                     .right = gsl_vector_alloc(unknowns),
                     .normal = gsl_matrix_calloc(unknowns, unknowns),
                     .factor = gsl_matrix_alloc(unknowns, unknowns)};
    if (!t->spline || !t->ends || !t->c || !t->right || !t->normal || !t->factor)
        return calc_no_memory(error);
    for (size_t i = 0; i <= pieces; i++)
        gsl_vector_set(t->ends, i, i ? all->at[i * (all->distinct - 1) / pieces] : 0);
    gsl_bspline_init_augment(t->ends, t->spline);
    return true;
}

/* A row of the design matrix: the basis functions that are not 0 at r, and their unknowns; offset last. */
typedef struct line {
    double v[ORDER + 1];
    size_t at[ORDER + 1], count;
} line;

static line line_at(const candidate *t, double r) {
    line out = {.count = 0};
    double at[ORDER];
    gsl_vector_view basis = gsl_vector_view_array(at, ORDER);
    size_t first;
    gsl_bspline_basis(r, &basis.vector, &first, t->spline);
    for (size_t j = first; j < first + ORDER; j++)
        if (j >= FIXED) {
            out.v[out.count] = at[j - first];
            out.at[out.count++] = j - FIXED;
        }
    out.v[out.count] = 1;
    out.at[out.count++] = t->unknowns - 1;
    return out;
}

static double residual(const candidate *t, const line *x, double f) {
    for (size_t j = 0; j < x->count; j++)
        f -= x->v[j] * gsl_vector_get(t->c, x->at[j]);
    return f;
}

/* Adds the least-squares solution for the residuals to the coefficients. begin: first sets up equations. */
static bool improve(candidate *t, const rows *all, bool begin, file_stop stop, calc_error *error) {
    gsl_vector_set_zero(t->right);
    for (size_t i = 0; i < all->count; i++) {
        const line x = line_at(t, all->row[i].r);
        const double rest = residual(t, &x, all->row[i].f);
        if (calc_stopped(stop, error))
            return false;
        for (size_t j = 0; j < x.count; j++) {
            *gsl_vector_ptr(t->right, x.at[j]) += x.v[j] * rest;
            for (size_t k = 0; k < x.count && begin; k++)
                *gsl_matrix_ptr(t->normal, x.at[j], x.at[k]) += x.v[j] * x.v[k];
        }
    }
    if (begin) {
        gsl_matrix_memcpy(t->factor, t->normal);
        if (gsl_linalg_cholesky_decomp1(t->factor)) /* unreached: each piece has four different r */
            return calc_fail(error, 0, 0, "%zu different r are too few for %zu pieces: take fewer",
                             all->distinct, t->pieces);
    }
    gsl_linalg_cholesky_svx(t->factor, t->right);
    gsl_vector_add(t->c, t->right);
    return true;
}

static void judge_profile(candidate *t, const rows *all) {
    double squares = 0;
    t->worst = -1;
    for (size_t i = 0; i < all->count; i++) {
        const line x = line_at(t, all->row[i].r);
        const double rest = fabs(residual(t, &x, all->row[i].f));
        squares += rest * rest;
        if (rest > t->worst) {
            t->worst = rest;
            t->at = all->row[i].r;
        }
    }
    t->rms = sqrt(squares / (double)all->count);
}

/* f and f' at the end of a piece. */
static void end_of(const candidate *t, size_t i, double *f, double *slope) {
    double at[ORDER][2];
    gsl_matrix_view basis = gsl_matrix_view_array(at[0], ORDER, 2);
    size_t first;
    gsl_bspline_basis_deriv(gsl_vector_get(t->ends, i), 1, &basis.matrix, &first, t->spline);
    *f = *slope = 0;
    for (size_t j = first; j < first + ORDER && i > 0; j++)
        if (j >= FIXED) {
            const double c = gsl_vector_get(t->c, j - FIXED);
            *f += c * at[j - first][0];
            *slope += c * at[j - first][1];
        }
}

/* Finds `grows`, `falls`, `drop`. f' is a parabola on each piece: f is extremal at its zeros and at ends. */
static void look_for_fall(candidate *t) {
    double f0, s0, f1 = 0, s1 = 0, top = 0, top_at = 0;
    t->grows = true;
    t->drop = 0;
    for (size_t i = 0; i < t->pieces; i++) {
        const double r0 = gsl_vector_get(t->ends, i), h = gsl_vector_get(t->ends, i + 1) - r0;
        f0 = f1;
        s0 = s1 * h;
        end_of(t, i + 1, &f1, &s1);
        const double d1 = 3 * (f1 - f0) - 2 * s0 - s1 * h, d2 = s0 + s1 * h - 2 * (f1 - f0);
        double x[4] = {0, 1, 1, 1}; /* f = f0 + s0 x + d1 x^2 + d2 x^3, x = 0..1 */
        const int zeros = gsl_poly_solve_quadratic(3 * d2, 2 * d1, s0, &x[1], &x[2]);
        for (int j = 0; j < 4; j++) {
            if ((j == 1 || j == 2) && (j > zeros || !(x[j] > 0 && x[j] < 1)))
                continue;
            const double f = j == 3 ? f1 : f0 + x[j] * (s0 + x[j] * (d1 + x[j] * d2));
            if (top - f > t->drop) {
                t->falls = t->drop > 0 ? t->falls : top_at;
                t->drop = top - f;
            }
            if (f > top) {
                top = f;
                top_at = r0 + x[j] * h;
            }
        }
        /* (r f')' is a parabola q0 + q1 x + q2 x^2 on the piece */
        const double q1 = 2 * (2 * d1 + 3 * d2 * r0 / h), q2 = 9 * d2, q0 = s0 + 2 * d1 * r0 / h;
        const double vertex = q2 > 0 ? -q1 / (2 * q2) : 0;
        t->grows = t->grows && q0 + q1 + q2 >= 0 && /* x = 0 is x = 1 of the piece before */
                   (!(vertex > 0 && vertex < 1) || q0 + vertex * (q1 + vertex * q2) >= 0);
    }
}

/* ---- the nearest convex spline ----------------------------------------------------------------- */

/* The least squares of the unknowns that are not `zero`. False: their matrix is singular. */
static bool solve_rest(const gsl_matrix *M, const gsl_vector *right, const bool *zero, gsl_matrix *factor,
                       gsl_vector *x) {
    for (size_t i = 0; i < x->size; i++) {
        gsl_vector_set(x, i, zero[i] ? 0 : gsl_vector_get(right, i));
        for (size_t j = 0; j < x->size; j++)
            gsl_matrix_set(factor, i, j, zero[i] || zero[j] ? i == j : gsl_matrix_get(M, i, j));
    }
    return !gsl_linalg_cholesky_decomp1(factor) && !gsl_linalg_cholesky_svx(factor, x);
}

/* Moves x to `wanted`, or until an unknown becomes 0, which then is `zero`; true: x has arrived. */
static bool approach(gsl_vector *x, const gsl_vector *wanted, bool *zero) {
    const size_t last = x->size - 1;
    double part = 1;
    size_t stop = last;
    for (size_t i = 0; i < last; i++) {
        const double from = gsl_vector_get(x, i), to = gsl_vector_get(wanted, i);
        if (!zero[i] && to <= 0 && from / (from - to) < part) {
            part = from / (from - to);
            stop = i;
        }
    }
    for (size_t i = 0; i <= last; i++)
        *gsl_vector_ptr(x, i) += part * (gsl_vector_get(wanted, i) - gsl_vector_get(x, i));
    for (size_t i = 0; i < last; i++)
        if (i == stop || gsl_vector_get(x, i) <= 0) {
            gsl_vector_set(x, i, 0);
            zero[i] = true;
        }
    return stop == last;
}

/* Frees the `zero` unknown that descends most steeply; false: none descends. */
static bool free_one(const gsl_matrix *M, const gsl_vector *right, const gsl_vector *x, bool *zero) {
    double best = 1e-12 * gsl_blas_dnrm2(right);
    size_t found = x->size;
    for (size_t i = 0; i < x->size; i++) {
        const gsl_vector_const_view of = gsl_matrix_const_row(M, i);
        double product;
        gsl_blas_ddot(&of.vector, x, &product);
        if (zero[i] && gsl_vector_get(right, i) - product > best) {
            best = gsl_vector_get(right, i) - product;
            found = i;
        }
    }
    if (found < x->size)
        zero[found] = false;
    return found < x->size;
}

/* Least squares M x = right with x >= 0 but for the last, from a start x (Lawson and Hanson). Stops early if
 * rounding makes the matrix singular: the solution so far is good enough. False: out of memory. */
static bool nonnegative(const gsl_matrix *M, const gsl_vector *right, gsl_vector *x) {
    const size_t n = x->size;
    gsl_vector *wanted = gsl_vector_alloc(n);
    gsl_matrix *factor = gsl_matrix_alloc(n, n);
    bool *zero = calloc(n, sizeof *zero);
    const bool ok = wanted && factor && zero;
    for (size_t i = 0; i + 1 < n && ok; i++) {
        gsl_vector_set(x, i, fmax(gsl_vector_get(x, i), 0));
        zero[i] = gsl_vector_get(x, i) == 0;
    }
    for (size_t round = 0; ok && round < 3 * n; round++) {
        if (!solve_rest(M, right, zero, factor, wanted)) /* unreached: no such rows are known */
            break;
        if (approach(x, wanted, zero) && !free_one(M, right, x, zero))
            break;
    }
    gsl_vector_free(wanted);
    gsl_matrix_free(factor);
    free(zero);
    return ok;
}

/* c = T e: the second differences e of the coefficients must not be negative; the offset is free. */
static bool make_convex(candidate *t, const rows *all) {
    const size_t n = t->unknowns;
    gsl_matrix *T = gsl_matrix_calloc(n, n), *AT = gsl_matrix_alloc(n, n), *M = gsl_matrix_alloc(n, n);
    gsl_vector *e = gsl_vector_alloc(n), *right = gsl_vector_alloc(n);
    bool ok = T && AT && M && e && right;
    for (size_t i = 0; i + 1 < n && ok; i++)
        for (size_t j = 0; j <= i; j++)
            gsl_matrix_set(T, i, j,
                           gsl_bspline_greville_abscissa(i + FIXED, t->spline) -
                               gsl_bspline_greville_abscissa(j + FIXED - 1, t->spline));
    if (ok) {
        gsl_matrix_set(T, n - 1, n - 1, 1);
        gsl_blas_dgemm(CblasNoTrans, CblasNoTrans, 1, t->normal, T, 0, AT);
        gsl_blas_dgemm(CblasTrans, CblasNoTrans, 1, T, AT, 0, M);
        gsl_blas_dgemv(CblasNoTrans, 1, t->normal, t->c, 0, e); /* the right side of the normal equations */
        gsl_blas_dgemv(CblasTrans, 1, T, e, 0, right);
        gsl_vector_memcpy(e, t->c);
        gsl_blas_dtrsv(CblasLower, CblasNoTrans, CblasNonUnit, T, e);
        ok = nonnegative(M, right, e);
    }
    if (ok) {
        gsl_blas_dgemv(CblasNoTrans, 1, T, e, 0, t->c);
        judge_profile(t, all);
    }
    gsl_matrix_free(T);
    gsl_matrix_free(AT);
    gsl_matrix_free(M);
    gsl_vector_free(e);
    gsl_vector_free(right);
    return ok;
}

/* Can noise explain the larger squares of the convex spline? Its constraints add the noise of `unknowns`
 * terms at most: p plus 4 standard deviations (2p)^1/2, in variances. */
static bool noise_alone(const candidate *t, const rows *all, double nearest) {
    const double p = (double)t->unknowns, left = (double)all->count - p;
    return t->rms * t->rms <= nearest * nearest * (1 + (p + 4 * sqrt(2 * p)) / left);
}

static bool attempt(candidate *t, const rows *all, size_t pieces, file_stop stop, calc_error *error) {
    if (!candidate_begin(t, all, pieces, error))
        return false;
    for (int pass = 0; pass < 2; pass++)
        if (!improve(t, all, pass == 0, stop, error))
            return false;
    judge_profile(t, all);
    look_for_fall(t);
    if (t->grows)
        return true;
    const double nearest = t->rms;
    const bool small = t->drop > 0 && t->drop <= 3 * nearest;
    gsl_vector_memcpy(t->right, t->c);
    if (!make_convex(t, all))
        return calc_no_memory(error);
    if (small || noise_alone(t, all, nearest)) {
        t->drop = 0;
    } else { /* not noise: keep the spline. If f does not fall it can be pressed as far as g grows */
        gsl_vector_memcpy(t->c, t->right);
        judge_profile(t, all);
    }
    return true;
}

/* ---- how many pieces --------------------------------------------------------------------------- */

/* A falling profile was mostly measured beyond the rim, unless it falls from the apex or far below it. */
static const char *advice(const candidate *t) {
    double end, slope;
    end_of(t, t->pieces, &end, &slope);
    if (t->falls == 0 || end < -t->drop / 2)
        return "f is the gap and grows outward; the sign or the apex may be the cause";
    return t->pieces == 1 ? "leave out what lies beyond" : "leave out what lies beyond, or take fewer pieces";
}

/* False, with the error, if the profile falls by more than noise. */
static bool rises(const candidate *t, const rows *all, calc_error *error) {
    char where[CALC_VALUE_TEXT], drop[CALC_VALUE_TEXT];
    calc_value_text(DIM_LENGTH, t->falls * all->r, where);
    calc_value_text(DIM_LENGTH, t->drop * all->f, drop);
    return t->drop == 0 ||
           calc_fail(error, 0, 0,
                     "the profile of %zu piece%s falls from r = %s on, by %s, which is no noise: %s",
                     t->pieces, t->pieces == 1 ? "" : "s", where, drop, advice(t));
}

/* Each piece needs four different r. */
static size_t most_pieces(const rows *all, size_t most) {
    return all->distinct / 4 < most ? all->distinct / 4 : most;
}

/* Takes the fewest pieces within how.within, or those with the least cross-validation error. */
static bool choose_pieces(candidate *t, const rows *all, smoothing how, file_stop stop, calc_error *error) {
    const size_t most = most_pieces(all, SMOOTH_PIECES_TRIED);
    const bool freely = how.by == SMOOTH_FREELY;
    char wanted[CALC_VALUE_TEXT], got[CALC_VALUE_TEXT];
    double best = INFINITY, least = INFINITY;
    size_t pieces = 1;
    calc_error falls = ERROR_NONE;
    for (size_t i = 1; i <= most; i += freely ? 1 + i / 8 : 1) { /* the error hardly changes in between */
        if (!attempt(t, all, i, stop, error))
            return false;
        if (!freely && t->rms * all->f <= how.within && rises(t, all, &falls))
            return true;
        const double score = t->rms / (1 - (double)t->unknowns / (double)all->count);
        pieces = score < best ? i : pieces;
        best = fmin(score, best);
        least = fmin(least, t->rms * all->f);
        candidate_end(t);
    }
    if (freely)
        return attempt(t, all, pieces, stop, error) && rises(t, all, error);
    calc_value_text(DIM_LENGTH, how.within, wanted);
    calc_value_text(DIM_LENGTH, least, got);
    *error = falls;
    return calc_fail(error, 0, 0,
                     "no profile of up to %zu pieces comes within %s (rms): the nearest is %s off", most,
                     wanted, got);
}

/* ---- the answer -------------------------------------------------------------------------------- */

static bool hand_out(const candidate *t, const rows *all, smooth_answer *out, calc_error *error) {
    const size_t n = t->pieces + 1;
    out->pieces = t->pieces;
    out->r = malloc(3 * n * sizeof *out->r);
    if (!out->r)
        return calc_no_memory(error);
    out->f = out->r + n;
    out->slope = out->f + n;
    for (size_t i = 0; i < n; i++) {
        double f, slope;
        end_of(t, i, &f, &slope);
        out->r[i] = gsl_vector_get(t->ends, i) * all->r;
        out->f[i] = f * all->f;
        out->slope[i] = slope * all->f / all->r;
    }
    out->rms = t->rms * all->f;
    out->worst = t->worst * all->f;
    out->at = t->at * all->r;
    out->offset = gsl_vector_get(t->c, t->unknowns - 1) * all->f;
    return true;
}

static bool choose(candidate *t, const rows *all, smoothing how, file_stop stop, calc_error *error) {
    const size_t most = most_pieces(all, SMOOTH_PIECES_MOST);
    if (most == 0)
        return calc_fail(error, 0, 0, "%zu different r are too few to smooth", all->distinct);
    if (how.by != SMOOTH_PIECES)
        return choose_pieces(t, all, how, stop, error);
    if (how.pieces > most)
        return calc_fail(error, 0, 0, "%zu different r allow at most %zu pieces", all->distinct, most);
    return attempt(t, all, how.pieces, stop, error) && rises(t, all, error);
}

bool smooth(const double *r, const double *f, size_t count, smoothing how, file_stop stop, smooth_answer *out,
            calc_error *error) {
    rows all;
    candidate t = {.pieces = 0};
    *out = (smooth_answer){.pieces = 0};
    gsl_set_error_handler_off();
    const bool ok = rows_make(&all, r, f, count, error) && choose(&t, &all, how, stop, error) &&
                    hand_out(&t, &all, out, error);
    candidate_end(&t);
    free(all.row);
    free(all.at);
    return ok;
}

void smooth_free(smooth_answer *a) {
    free(a->r);
    *a = (smooth_answer){.pieces = 0};
}
