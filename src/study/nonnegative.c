/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Lawson and Hanson's active set: those that are positive are found one by one. */
#include "study/nonnegative.h"

#include <gsl/gsl_blas.h>
#include <gsl/gsl_linalg.h>
#include <math.h>
#include <stdlib.h>

typedef struct state {
    const gsl_matrix *M;
    const gsl_vector *right;
    gsl_vector *x, *wanted;
    gsl_matrix *part; /* of M, for those in use */
    size_t n, count;
    size_t *used; /* the free one first */
} state;

/* The least squares of those in use alone. */
static bool solve_used(state *s) {
    gsl_matrix_view M = gsl_matrix_submatrix(s->part, 0, 0, s->count, s->count);
    gsl_vector_view x = gsl_vector_subvector(s->wanted, 0, s->count);
    for (size_t i = 0; i < s->count; i++) {
        gsl_vector_set(&x.vector, i, gsl_vector_get(s->right, s->used[i]));
        for (size_t j = 0; j < s->count; j++)
            gsl_matrix_set(&M.matrix, i, j, gsl_matrix_get(s->M, s->used[i], s->used[j]));
    }
    const int status = gsl_linalg_cholesky_decomp1(&M.matrix);
    gsl_linalg_cholesky_svx(&M.matrix, &x.vector);
    return !status;
}

/* Goes to what is wanted, or only until an unknown becomes 0, which is then no longer in use; true: arrived.
 */
static bool approach(state *s) {
    double part = 1;
    size_t stop = 0, kept = 1;
    for (size_t i = 1; i < s->count; i++) {
        const double from = gsl_vector_get(s->x, s->used[i]), to = gsl_vector_get(s->wanted, i);
        if (to <= 0 && from / (from - to) < part) {
            part = from / (from - to);
            stop = i;
        }
    }
    for (size_t i = 0; i < s->count; i++) {
        double *x = gsl_vector_ptr(s->x, s->used[i]);
        *x += part * (gsl_vector_get(s->wanted, i) - *x);
    }
    if (stop)
        gsl_vector_set(s->x, s->used[stop], 0);
    for (size_t i = 1; i < s->count; i++) {
        const size_t which = s->used[i];
        if (gsl_vector_get(s->x, which) <= 0)
            gsl_vector_set(s->x, which, 0);
        else
            s->used[kept++] = which;
    }
    s->count = kept;
    return stop == 0;
}

/* The one left out that would lessen the squares most; n: none. */
static size_t best_unused(const state *s) {
    double best = 1e-12 * gsl_blas_dnrm2(s->right);
    size_t found = s->n;
    for (size_t i = 0; i + 1 < s->n; i++) {
        double slope = gsl_vector_get(s->right, i);
        bool used = false;
        for (size_t j = 0; j < s->count; j++) {
            slope -= gsl_matrix_get(s->M, i, s->used[j]) * gsl_vector_get(s->x, s->used[j]);
            used = used || s->used[j] == i;
        }
        if (!used && slope > best) {
            best = slope;
            found = i;
        }
    }
    return found;
}

/* Ends early where rounding makes those in use singular: what has been found is good enough. */
static void run_active_set(state *s) {
    s->used[s->count++] = s->n - 1;
    for (size_t round = 0, next = 0; next < s->n; round++) {
        do
            if (!solve_used(s) || round == 3 * s->n) /* unreached: by no rows that have been met */
                return;
        while (!approach(s));
        next = best_unused(s);
        if (next < s->n)
            s->used[s->count++] = next;
    }
}

bool nonnegative(const gsl_matrix *M, const gsl_vector *right, gsl_vector *x) {
    const size_t n = x->size;
    state s = {.M = M,
               .right = right,
               .x = x,
               .wanted = gsl_vector_alloc(n),
               .part = gsl_matrix_alloc(n, n),
               .n = n,
               .used = malloc(n * sizeof *s.used)};
    gsl_vector_set_zero(x);
    const bool ok = s.wanted && s.part && s.used;
    if (ok)
        run_active_set(&s);
    gsl_vector_free(s.wanted);
    gsl_matrix_free(s.part);
    free(s.used);
    return ok;
}
