/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Conditioning: how far a change in the last digit of each input, and of the last load, moves the value of an
 * expression. Depends on language/trial: the scene stays as it is. Prints nothing. */
#ifndef STUDY_INFLUENCE_H
#define STUDY_INFLUENCE_H

#include "language/trial.h"

/* The effect of a cause on the result. */
typedef enum influence {
    INFLUENCE_NONE,
    INFLUENCE_SMALL,   /* condition number below 0.01 */
    INFLUENCE_HIDDEN,  /* not smooth here, or hidden by rounding */
    INFLUENCE_SKIPPED, /* not computed: time is up */
    INFLUENCE_SHOWN    /* `change` holds it */
} influence;

/* A number that the result depends on. Changing it by `digit` changes the result by `change`, relatively. */
typedef struct cause {
    const char *name;
    value v;
    enum { CAUSE_INPUT, CAUSE_STEP } kind;
    input in;        /* CAUSE_INPUT */
    double *step;    /* CAUSE_STEP: target of the last step; valid within influences() alone */
    bool tangential; /* CAUSE_STEP: a target of F_x or delta_x */
    bool increment;  /* CAUSE_STEP: the target was given by += */
    bool refused;    /* it lies at the end of its range: a neighbouring number is not valid */
    long double digit, change;
    influence influence;
} cause;

enum { CAUSES = INPUTS + 2 };
enum { INFLUENCE_SECONDS = 3 }; /* processor time after which further causes are INFLUENCE_SKIPPED */

typedef struct influence_study {
    cause cause[CAUSES];
    size_t count; /* 0: the result is 0, which has no relative change */
} influence_study;

/* Does the cause belong to the load program? */
bool cause_is_load(const cause *c);

/* Finds the causes of the value of e, which is `result` in the scene c->now: the inputs, unless they follow a
 * live definition, and the last step. `change` is good to about two digits. Errors: interrupted, out of
 * memory. */
bool influences(calc *c, const expr *e, long double result, influence_study *out, calc_error *error);

#endif
