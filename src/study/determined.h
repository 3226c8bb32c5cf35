/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What data say of the unknowns, by J^T J at the least sum of squares. */
#ifndef STUDY_DETERMINED_H
#define STUDY_DETERMINED_H

#include "study/residuals.h"

/* What to measure that tells two names apart, or NULL. */
const char *determined_instead(const char *a, const char *b);
/* Covariances of a unit variance of those that vary, (J^T J)^-1; in plain words why there are none, where
 * columns of J vanish or depend on each other. */
bool determined(residuals *r, double C[UNKNOWNS][UNKNOWNS], calc_error *error);

#endif
