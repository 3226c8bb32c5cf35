/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Expressions at many points: values of some inputs and names, which are set on a scratch scene. One point
 * after the other, or, where that pays, by a team of processes: digits do not depend on how many work.
 * Changes the scratch scene alone; reads and prints nothing. */
#ifndef STUDY_POINTS_H
#define STUDY_POINTS_H

#include "language/trial.h"

/* ---- what is moved ---- */

/* The value of the knob now, if it has one. */
bool knob_present(calc *c, const knob *k, double *v);
/* It has none, `to start from`: the error says so, why, where a live definition stands for it, and what to
 * do. */
bool knob_lacks(const calc *c, const knob *k, const char *what_for, const char *advice, calc_error *error);

/* The step of a difference quotient at x: this part of the size of the name there. That is |x|, and where it
 * is less the scale, without which the step would come to nothing at 0: what else tells how far the name
 * goes, be it its deviation, the range that is searched or what the data show. */
double points_step(double part, double x, double scale);
/* Weights of f(x+jh)-f(x-jh) in a slope, over h: sixth order. */
enum { POINTS_SLOPES = 3 };
extern const long double points_slope[POINTS_SLOPES];

/* Is a range searched in ratios? The place of a part 0..1 of it, evenly or, both ends on one side of 0, so.
 */
bool points_ratios(double lo, double hi);
long double points_place(long double lo, long double hi, bool ratios, long double part);
/* "mu = 0.3" */
enum { KNOB_TEXT = LEX_NAME + CALC_VALUE_TEXT + 4 };
void knob_text(const knob *k, double v, char text[KNOB_TEXT]);

/* ---- points ---- */

/* A column of a table as a name of expressions. */
typedef struct column_knob {
    knob name;
    const double *v;
} column_knob;

typedef struct points {
    calc *c;
    trial *t;
    const knob *knobs; /* borrowed, as the expressions */
    size_t count;
    const expr *e;
    size_t n;
    size_t all;           /* points that will come in several runs, as far as is known; else 0 */
    unsigned evaluations; /* of scenes */
    calc_error *error;    /* raised: all has ended */
    calc_error none;      /* the first reason why the latest point lacks a value: raised, in words */
    /* private */
    long double *now, *next; /* knobs as they are set, and as they come */
    value *v;
    struct team *team;
    bool alone; /* no team is to be begun */
    size_t done, watched;
    double taken; /* seconds, for those that have been watched */
} points;

/* Expressions see the scratch scene until it is closed. */
bool points_open(points *p, calc *c, const knob *knobs, size_t count, const expr *e, size_t n,
                 calc_error *error);
/* Puts the error into words while the scene is still seen. After a failed opening, too. */
void points_close(points *p);
/* The scene, and the user's names, as they were at first. */
bool points_anew(points *p);
/* Before a knob becomes another: those at work have not seen it. */
void points_dismiss(points *p);

/* One knob. */
bool points_put(points *p, size_t i, long double x, calc_error *error);
/* All of them, where they are not so already; runs nothing. False: there is no such scene, or all has ended.
 */
bool points_set(points *p, const long double x[]);
/* The expressions in the scene as it stands. What has no value is NaN; false: one has none, or all has ended.
 */
bool points_look(points *p, value v[]);
/* points_set, then points_look. */
bool points_at(points *p, const long double x[], value v[]);
/* Takes an error as that of a point, or as the end; false. */
bool points_failed(points *p, const calc_error *error);
/* The value of expression i has the dimension that it had at first: *d, where `known` has become true. */
bool points_keeps(points *p, size_t i, dim of, dim *d, bool *known);

/* Expressions 0 and 1 as two sides to be compared: the same of the left one, and the right one is like it; a
 * bare 0 is. */
bool points_keep_sides(points *p, const value v[2], dim *d, bool *known);

/* Points 0, 1, ...: both are called in their order. */
typedef struct points_run {
    size_t count;
    void (*give)(void *context, size_t i, long double x[]);
    /* why: the first error where a value is NaN, else NULL; one that ends all has been raised. False ends the
     * run. */
    bool (*take)(void *context, size_t i, const long double x[], const value v[], const calc_error *why);
    void *context;
} points_run;

/* False: all has ended, or `take` has ended this run. */
bool points_go(points *p, const points_run *run);

#endif
