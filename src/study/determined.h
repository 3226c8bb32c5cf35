/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How well the data determine the unknowns, by J^T J at the minimum. Depends on residuals.h and GSL. */
#ifndef STUDY_DETERMINED_H
#define STUDY_DETERMINED_H

#include "study/residuals.h"

/* Advice what to measure or to give so that two names can be told apart; NULL: none. */
const char *determined_instead(const char *a, const char *b);
/* C becomes (J^T J)^-1, the covariance for a unit variance of the residuals. False with an error that names
 * the unknowns if columns of J vanish or depend on each other. */
bool determined(residuals *r, double C[UNKNOWNS][UNKNOWNS], calc_error *error);

#endif
