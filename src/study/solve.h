/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Where two expressions are equal: a scan that finds brackets, then steps of the secant within them. */
#ifndef STUDY_SOLVE_H
#define STUDY_SOLVE_H

#include "study/points.h"

typedef struct solve_question {
    calc *c;
    knob name;
    const expr *sides; /* left and right */
    bool given;        /* the range is */
    double lo, hi;     /* it */
} solve_question;

typedef struct solve_answer {
    double x;
    double lo, hi; /* the bracket that the method began with */
    unsigned evaluations;
    bool jumps;   /* elsewhere the sides jump past each other: a root beside that may not have been seen */
    bool touches; /* the sides do not pass each other there: half of the digits are lost */
} solve_answer;

/* Without a range: the range of an input that has two ends, else three decades on either side of the present
 * value. Between places where the sides come nearest without passing they may still meet, or a pole may hide
 * that they do: looked for by the golden section. Where they jump, swing or touch, and before it is said that
 * there is no root, the scan is repeated, finer. Errors: no root, with the place that comes closest and the
 * edge of what the scene allows; several roots; a jump instead of a root. The answer is good to the last
 * digits that the expressions carry.
 */
bool solve(const solve_question *question, solve_answer *out, calc_error *error);

#endif
