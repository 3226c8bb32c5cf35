/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Solves an equation in one name: a scan for brackets, then the secant method. Depends on points.h. */
#ifndef STUDY_SOLVE_H
#define STUDY_SOLVE_H

#include "study/points.h"

typedef struct solve_question {
    calc *c;
    knob name;
    const expr *sides; /* left and right */
    bool given;        /* lo, hi are the range to search */
    double lo, hi;
} solve_question;

typedef struct solve_answer {
    double x;
    double lo, hi; /* the bracket that the method began with */
    unsigned evaluations;
    bool jumps; /* the difference jumps through 0 elsewhere: a root near the jump may be missed */
    bool level; /* the sides are equal all the way between two places, of which x is one */
    double from, to;
    bool touches; /* the sides touch without crossing: half of the digits are lost */
} solve_answer;

/* Finds the one x where both sides are equal, to the last digits that the expressions carry. Without a range
 * it searches that of an input with two ends, else three decades on either side of the present value. Minima
 * of the distance of the sides are searched by golden section: two roots or a tangency may hide there. If the
 * difference jumps, swings, touches 0 or has no root, a finer scan follows. Errors: no root, with the nearest
 * place and the limit of the scene; several roots; a jump instead. */
bool solve(const solve_question *question, solve_answer *out, calc_error *error);

#endif
