/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How sure values are whose inputs are uncertain: first order from derivatives, and a Monte Carlo beside it
 * (normal deviates, independent inputs). */
#ifndef STUDY_UNCERTAINTY_H
#define STUDY_UNCERTAINTY_H

#include "study/points.h"

enum { UNCERTAIN_NAMES = 12, UNCERTAIN_VALUES = 20 };

/* One sample; NaN: no value. False ends them. */
typedef bool uncertainty_take(void *context, size_t sample, const value v[]);

typedef struct uncertainty_question {
    calc *c;
    knob name[UNCERTAIN_NAMES];
    double deviation[UNCERTAIN_NAMES]; /* standard, > 0 */
    size_t count;
    const expr *e;
    size_t expressions;
    unsigned samples; /* of the Monte Carlo */
    unsigned seed;
    const double *const *given; /* the values of all samples, by expression; NULL: they are drawn: */
    size_t from, to; /* from the first on and before the other: each by the seed and its number alone */
    uncertainty_take *take; /* is told of each; or NULL */
    void *context;
} uncertainty_question;

typedef struct uncertain {
    long double v; /* at the present inputs */
    dim d;
    double deviation;              /* first order: sqrt(sum (dv/dx_i s_i)^2) */
    double share[UNCERTAIN_NAMES]; /* of its variance, by input */
    double mean, spread;           /* of the samples; NaN: of none, and of one */
    unsigned samples;              /* that have a value */
    bool differs; /* the Monte Carlo says something else: by more than 5 % of the deviation, and more than so
                     many samples err by */
} uncertain;

typedef struct uncertainty_answer {
    uncertain value[UNCERTAIN_VALUES];
    double x[UNCERTAIN_NAMES]; /* the present inputs */
    unsigned evaluations;
    calc_error missing; /* why some samples have no value: raised, where they are drawn */
} uncertainty_answer;

/* Errors: an input without a value; an expression without one there, or without a derivative (the end of what
 * the scene allows is within a millionth of the input). Derivatives are differences of sixth order over a
 * thousandth of the input, or of a tenth of its deviation where that is more: good to 1e-12 of themselves
 * where the expression is smooth over as much. */
bool uncertainty(const uncertainty_question *question, uncertainty_answer *out, calc_error *error);

#endif
