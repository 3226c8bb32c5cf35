/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Propagation of uncertainty from inputs to values: first order by derivatives, and a Monte Carlo simulation
 * beside it (independent normal inputs). Depends on points.h and GSL. */
#ifndef STUDY_UNCERTAINTY_H
#define STUDY_UNCERTAINTY_H

#include "study/points.h"

enum { UNCERTAIN_NAMES = 12, UNCERTAIN_VALUES = 20 };

/* Callback: receives a sample; NaN: no value. False ends the sampling. */
typedef bool uncertainty_take(void *context, size_t sample, const value v[]);

typedef struct uncertainty_question {
    calc *c;
    knob name[UNCERTAIN_NAMES];
    double deviation[UNCERTAIN_NAMES]; /* standard deviations, > 0 */
    size_t count;
    const expr *e;
    size_t expressions;
    unsigned samples; /* of the Monte Carlo simulation */
    unsigned seed;
    const double *const *given; /* the values of all samples for each expression; NULL: draw them */
    size_t from, to;            /* samples to draw: from .. to-1. A sample depends on seed and number alone */
    uncertainty_take *take;     /* called for each sample drawn; or NULL */
    void *context;
} uncertainty_question;

typedef struct uncertain {
    long double v; /* at the present inputs */
    dim d;
    double deviation;              /* first-order standard deviation, sqrt(sum (dv/dx_i s_i)^2) */
    double share[UNCERTAIN_NAMES]; /* of each input in its variance, 0..1 */
    double mean, spread;           /* mean and standard deviation of the samples; NaN: too few samples */
    unsigned samples;              /* samples that have a value */
    bool differs; /* v, deviation differ from mean, spread by more than 5 % of the deviation and 3 standard
                     errors */
} uncertain;

typedef struct uncertainty_answer {
    uncertain value[UNCERTAIN_VALUES];
    double x[UNCERTAIN_NAMES]; /* present values of the inputs */
    unsigned evaluations;
    calc_error missing; /* why the first sample drawn without a value has none: raised */
} uncertainty_answer;

/* Derivatives are differences of sixth order with steps of 1e-3 max(|x|, deviation/10), good to 1e-12
 * relative if the expression is smooth over them. Errors: an input has no value; an expression has no value,
 * or no derivative since the limit of what the scene allows lies within a millionth of the input. */
bool uncertainty(const uncertainty_question *question, uncertainty_answer *out, calc_error *error);

#endif
