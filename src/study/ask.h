/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Inputs and names that questions are asked about: what they are now, how far to go with them, and in words.
 * Reads the scene and the names, changes nothing. */
#ifndef STUDY_ASK_H
#define STUDY_ASK_H

#include "language/calc.h"

/* The value of the knob now, if it has one. */
bool ask_present(calc *c, const knob *k, double *v);
/* It has none, `to start from`: the error says so, why, where a live definition stands for it, and what to
 * do. */
bool ask_lacks(const calc *c, const knob *k, const char *what_for, const char *advice, calc_error *error);

/* The step of a difference quotient at x: this part of the size of the name there. That is |x|, and where it
 * is less the scale, without which the step would come to nothing at 0: what else tells how far the name
 * goes, be it its deviation, the range that is searched or what the data show. */
double ask_step(double part, double x, double scale);
/* Weights of f(x+jh)-f(x-jh) in a slope, over h: sixth order. */
enum { ASK_SLOPES = 3 };
extern const long double ask_slope[ASK_SLOPES];

/* Is a range searched in ratios? */
bool ask_in_ratios(double lo, double hi);
/* "mu = 0.3" */
enum { ASK_TEXT = LEX_NAME + CALC_VALUE_TEXT + 4 };
void ask_text(const knob *k, double v, char text[ASK_TEXT]);

#endif
