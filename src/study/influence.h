/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Conditioning: how far the last digit of each number that an expression depends on moves its value. Works on
 * a trial: the scene stays as it is. Prints nothing. */
#ifndef STUDY_INFLUENCE_H
#define STUDY_INFLUENCE_H

#include "language/trial.h"

/* What a change of a cause does to a result. */
typedef enum influence {
    INFLUENCE_NONE,
    INFLUENCE_SMALL,  /* condition number below 0.01 */
    INFLUENCE_HIDDEN, /* not smooth here, or hidden by rounding */
    INFLUENCE_LEFT,   /* not looked for: it takes too long */
    INFLUENCE_ZERO,   /* nor here: a name at 0 has no last digit, and no change of it is relative */
    INFLUENCE_SHOWN
} influence;

/* One number that the result depends on. A change in its last digit moves the result by change, both
 * relative. */
typedef struct cause {
    const char *name;
    value v;
    enum { CAUSE_INPUT, CAUSE_STEP, CAUSE_NAME, CAUSE_ARGUMENT } kind;
    input in;        /* CAUSE_INPUT */
    size_t own;      /* CAUSE_NAME: index of the user's name */
    double *step;    /* CAUSE_STEP: press by dz or a, or target of the last step; for influences() alone */
    bool tangential; /* CAUSE_STEP: a target of F_x or delta_x */
    bool increment;  /* given by += */
    bool refused;    /* one neighbour is no valid value: the end of its range */
    long double digit, change;
    influence influence;
} cause;

enum { CAUSE_NAMES = 8, CAUSES = INPUTS + 3 + CAUSE_NAMES + 1 };
enum { INFLUENCE_SECONDS = 3 }; /* of the processor, after which the rest is left out */

typedef struct influence_study {
    cause cause[CAUSES];
    size_t count; /* 0: the result is 0, which has no relative change */
} influence_study;

/* Does the cause belong to the load program? */
bool cause_is_load(const cause *c);

/* Causes of the value of e, which is `result` in the scene c->now: its inputs, the press, the last step, the
 * user's names; those bound to a definition follow it and are none themselves. call: where e is a call of
 * this quantity, its argument is a cause too; else NULL. Accuracy: the two digits that one prints. Error:
 * interrupted, memory. */
bool influences(calc *c, const expr *e, long double result, const quantity *call, value argument,
                influence_study *out, calc_error *error);

#endif
