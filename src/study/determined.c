/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Eigenvectors of J^T J, columns of J scaled to 1: what the data tell least. Depends on residuals.h, GSL. */
#include "study/determined.h"

#include <gsl/gsl_blas.h>
#include <gsl/gsl_eigen.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

/* Advice for pairs of names that the data often determine only in combination. */
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
    {"E0", "K_rig", "measure K_rig with the bodies clamped together, or loops at several FN"},
    {"E0", "E0_2", "a contact shows the sum of both compliances: give the modulus of one body"},
};

const char *determined_instead(const char *a, const char *b) {
    for (size_t i = 0; i < sizeof pairs / sizeof *pairs; i++)
        if ((!strcmp(pairs[i].a, a) && !strcmp(pairs[i].b, b)) ||
            (!strcmp(pairs[i].a, b) && !strcmp(pairs[i].b, a)))
            return pairs[i].instead;
    return NULL;
}

/* The advice for the first pair of names that has one. */
static const char *instead_of(const residuals *r, const size_t *shown, size_t count) {
    const char *instead = NULL;
    for (size_t i = 0; i < count && !instead; i++)
        for (size_t j = 0; j < i && !instead; j++)
            instead = determined_instead(r->of->name[shown[i]].text, r->of->name[shown[j]].text);
    return instead ? instead : "give the value of one";
}

/* Raises the error that names the unknowns of eigenvector v, a direction that the data do not determine. */
static bool cannot_tell(const residuals *r, const gsl_matrix *V, size_t v, calc_error *error) {
    char list[FIT_NAMES * (LEX_NAME + 6)] = "";
    size_t shown[FIT_NAMES], count = 0;
    for (size_t i = 0; i < r->of->count; i++)
        if (fabs(gsl_matrix_get(V, i, v)) > 0.05)
            shown[count++] = i;
    for (size_t i = 0; i < count; i++)
        list_word(list, sizeof list, i + 1 == count ? " and " : ", ", r->of->name[shown[i]].text);
    if (count > 1)
        return calc_fail(error, 0, 0, "the data cannot tell %s apart: they determine only a combination; %s",
                         list, instead_of(r, shown, count));
    /* one name against turning points, or turning points alone */
    return calc_fail(error, 0, 0,
                     "the data do not determine %s: the rows near the turning points are too few",
                     *list ? list : "where dx turns");
}

/* C = (J^T J)^-1 by eigenvectors V and eigenvalues e of the scaled matrix: V diag(1/e) V^T over the norms. */
static void covariance(const gsl_matrix *V, const gsl_vector *e, const double *norm,
                       double C[UNKNOWNS][UNKNOWNS]) {
    const size_t p = V->size1;
    for (size_t i = 0; i < p; i++)
        for (size_t j = 0; j < p; j++) {
            double sum = 0;
            for (size_t k = 0; k < p; k++)
                sum += gsl_matrix_get(V, i, k) * gsl_matrix_get(V, j, k) / gsl_vector_get(e, k);
            C[i][j] = sum / (norm[i] * norm[j]);
        }
}

static bool decompose(const residuals *r, gsl_matrix *N, gsl_matrix *V, gsl_vector *e,
                      gsl_eigen_symmv_workspace *w, double C[UNKNOWNS][UNKNOWNS], calc_error *error) {
    static const double apart = 1e-5; /* least ratio of singular values of the scaled J */
    const size_t p = r->unknowns;
    const gsl_matrix_const_view J = gsl_matrix_const_view_array(r->slopes, r->count, p);
    double norm[UNKNOWNS], most = 0;
    gsl_blas_dsyrk(CblasLower, CblasTrans, 1, &J.matrix, 0, N);
    for (size_t i = 0; i < p; i++) {
        norm[i] = sqrt(gsl_matrix_get(N, i, i));
        most = fmax(most, norm[i]);
    }
    for (size_t i = 0; i < p; i++) {
        if (!(norm[i] > 1e-9 * most) && i < r->of->count)
            return calc_fail(error, 0, 0, "the data do not determine %s: nothing in them depends on it",
                             r->of->name[i].text);
        norm[i] = norm[i] > 0 ? norm[i] : 1;
    }
    for (size_t i = 0; i < p; i++)
        for (size_t j = 0; j <= i; j++)
            gsl_matrix_set(N, i, j, gsl_matrix_get(N, i, j) / (norm[i] * norm[j]));
    gsl_eigen_symmv(N, e, V, w); /* N is finite: this converges */
    gsl_eigen_symmv_sort(e, V, GSL_EIGEN_SORT_VAL_DESC);
    if (gsl_vector_get(e, p - 1) < apart * apart * gsl_vector_get(e, 0))
        return cannot_tell(r, V, p - 1, error);
    covariance(V, e, norm, C);
    return true;
}

bool determined(residuals *r, double C[UNKNOWNS][UNKNOWNS], calc_error *error) {
    const size_t p = r->unknowns;
    if (!residuals_slopes(r))
        return false;
    gsl_matrix *N = gsl_matrix_alloc(p, p), *V = gsl_matrix_alloc(p, p);
    gsl_vector *e = gsl_vector_alloc(p);
    gsl_eigen_symmv_workspace *w = gsl_eigen_symmv_alloc(p);
    const bool ok = N && V && e && w ? decompose(r, N, V, e, w, C, error) : calc_no_memory(error);
    if (w)
        gsl_eigen_symmv_free(w);
    gsl_matrix_free(N);
    gsl_matrix_free(V);
    gsl_vector_free(e);
    return ok;
}
