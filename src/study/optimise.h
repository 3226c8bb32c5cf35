/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The maximum or minimum of an expression over ranges of one to three names: a scan and golden section along
 * the first name, at each place of which the others are optimised likewise; then Newton's method on
 * differences of sixth order. Depends on points.h, GSL. */
#ifndef STUDY_OPTIMISE_H
#define STUDY_OPTIMISE_H

#include "study/points.h"

enum { OPTIMISE_NAMES = 3 };

typedef struct optimise_question {
    calc *c;
    knob name[OPTIMISE_NAMES];
    double lo[OPTIMISE_NAMES], hi[OPTIMISE_NAMES]; /* lo < hi */
    size_t count;
    const expr *e;
    bool most; /* maximise, else minimise */
} optimise_question;

typedef enum optimise_end {
    END_INNER, /* inside the range */
    END_LOW,   /* at the lower end of the range: the optimum may lie beyond */
    END_HIGH,
    END_SCENE /* at the limit beyond which the scene allows no value */
} optimise_end;

typedef struct optimise_answer {
    double x[OPTIMISE_NAMES];
    optimise_end end[OPTIMISE_NAMES];
    long double value;
    dim d;
    bool sharp; /* Newton's method has converged: x is good to about 1e-12 of the range; else, as at a kink,
                   to half the digits */
    calc_error why; /* for END_SCENE: the error beyond */
    unsigned evaluations;
} optimise_answer;

/* Searches from each place of a scan that is better than its neighbours and may lead to the optimum. A scan
 * has 17 places for one name, 129 if several of them qualify, 13 for each of two names and 9 for each of
 * three. Where Newton's method fails, as at a kink or the limit of the scene, ever narrower windows follow.
 * Some 50 evaluations for one name, 1e3 for two and 1e4 for three; at kinks ten times as many. Errors: no
 * value at any place tried; the same value everywhere. */
bool optimise(const optimise_question *question, optimise_answer *out, calc_error *error);

#endif
