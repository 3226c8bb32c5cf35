/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Where an expression is largest or smallest over ranges of one to three names: a grid, then the golden
 * section or the simplex of Nelder and Mead (GSL), then Newton's method on differences of sixth order. */
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
    bool most; /* the largest value, else the smallest */
} optimise_question;

typedef enum optimise_end {
    END_INNER, /* within its range */
    END_LOW,   /* at an end of it: beyond, it would be better still */
    END_HIGH,
    END_SCENE /* where the scene ends */
} optimise_end;

typedef struct optimise_answer {
    double x[OPTIMISE_NAMES];
    optimise_end end[OPTIMISE_NAMES];
    long double value;
    dim d;
    bool sharp; /* Newton's method has settled: the place is good to what the expression's digits allow, about
                   1e-12 of the range; else, as at a kink, to half the digits */
    calc_error why; /* of END_SCENE: what is wrong beyond */
    unsigned evaluations;
} optimise_answer;

/* Errors: no value anywhere; a value that is the same everywhere. The search goes on about each place of the
 * grid that is better than those beside it and may lead to the best: of 17 places, or, where there are
 * several such, of 129; of 7 times 7, or 5 times 5 times 5. */
bool optimise(const optimise_question *question, optimise_answer *out, calc_error *error);

#endif
