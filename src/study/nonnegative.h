/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Least squares with unknowns that must not be negative (GSL). Knows numbers alone. */
#ifndef STUDY_NONNEGATIVE_H
#define STUDY_NONNEGATIVE_H

#include <gsl/gsl_matrix.h>
#include <stdbool.h>

/* From the normal equations M x = right: the x >= 0 of the least squares, of which the last unknown is free.
 * False: out of memory. */
bool nonnegative(const gsl_matrix *M, const gsl_vector *right, gsl_vector *x);

#endif
