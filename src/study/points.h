/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Evaluates expressions at many points. A point is a set of values of some inputs and names ("knobs"), which
 * are set on a scratch scene. Points are computed one by one or, if that pays, by a team of processes, with
 * the same digits. Depends on language/trial; changes the scratch scene alone and prints nothing. */
#ifndef STUDY_POINTS_H
#define STUDY_POINTS_H

#include "language/trial.h"

/* ---- knobs ---- */

/* The present value of the knob; false: it has none. */
bool knob_present(calc *c, const knob *k, double *v);
/* Raises the error that the knob has no value, why, what it was wanted for (" to start from"), and advice. */
bool knob_lacks(const calc *c, const knob *k, const char *what_for, const char *advice, calc_error *error);

/* The step of a difference quotient at x: part max(|x|, scale). The scale keeps the step from vanishing at x
 * = 0: the standard deviation of the name, the range searched, or what the data show. */
double points_step(double part, double x, double scale);
/* f'(x) = sum of points_slope[j-1] (f(x+jh) - f(x-jh))/h over j = 1..3, of sixth order. */
enum { POINTS_SLOPES = 3 };
extern const long double points_slope[POINTS_SLOPES];

/* Is the range searched in equal ratios: both ends positive and a factor of 10 apart? */
bool points_ratios(double lo, double hi);
/* The value at a part 0..1 of the range, in equal ratios or equal steps. */
long double points_place(long double lo, long double hi, bool ratios, long double part);
/* Writes "mu = 0.3". */
enum { KNOB_TEXT = LEX_NAME + CALC_VALUE_TEXT + 4 };
void knob_text(const knob *k, double v, char text[KNOB_TEXT]);

/* ---- points ---- */

/* A column of a table that expressions see as a name. */
typedef struct column_knob {
    knob name;
    const double *v;
} column_knob;

typedef struct points {
    calc *c;
    trial *t;
    const knob *knobs; /* borrowed, like the expressions */
    size_t count;      /* of knobs */
    const expr *e;
    size_t n;             /* of expressions */
    size_t all;           /* points expected in several runs; 0: not known */
    unsigned evaluations; /* points computed */
    calc_error *error;    /* raised: the whole computation ends */
    calc_error none;      /* the first reason why the latest point lacks a value: raised, in words */
    /* private */
    long double *now, *next; /* values of the knobs: as they are set, and of the next point */
    value *v;
    struct team *team;
    bool alone;           /* do not begin a team */
    size_t done, watched; /* points computed in all, and with their time measured */
    double taken;         /* seconds for the points watched */
} points;

/* Opens a scratch scene, which expressions see until points_close. */
bool points_open(points *p, calc *c, const knob *knobs, size_t count, const expr *e, size_t n,
                 calc_error *error);
/* Words the error while its scene still exists, and frees. To be called also if points_open has failed. */
void points_close(points *p);
/* Begins again with a fresh scratch scene and the user's names as they are outside. */
bool points_anew(points *p);
/* Ends the team. To be called before a knob is changed: workers have a copy of the old one. */
void points_dismiss(points *p);

/* Sets one knob. */
bool points_put(points *p, size_t i, long double x, calc_error *error);
/* Sets the knobs that differ; evaluates nothing. False: the scene refuses, or p->error is raised. */
bool points_set(points *p, const long double x[]);
/* Evaluates the expressions; NaN stands for a missing value. False: one is missing, or p->error is raised. */
bool points_look(points *p, value v[]);
/* points_set, then points_look. */
bool points_at(points *p, const long double x[], value v[]);
/* Records an error: in p->error if it ends the computation, else in p->none. Returns false. */
bool points_failed(points *p, const calc_error *error);
/* Checks that expression i keeps its dimension, *d, which the first call (*known false) sets. */
bool points_keeps(points *p, size_t i, dim of, dim *d, bool *known);

/* Checks that the two sides of an equation, expressions 0 and 1, keep the dimension *d; a bare 0 has any. */
bool points_keep_sides(points *p, const value v[2], dim *d, bool *known);

/* A run over points 0, 1, ...; both callbacks are called in this order. */
typedef struct points_run {
    size_t count;
    /* Fills in the values x of the knobs at point i. */
    void (*give)(void *context, size_t i, long double x[]);
    /* Receives the values at point i. why: the first error if one is NaN, else NULL. False ends the run. */
    bool (*take)(void *context, size_t i, const value v[], const calc_error *why);
    void *context;
} points_run;

/* Computes all points of the run. False: p->error is raised, or `take` has ended the run. */
bool points_go(points *p, const points_run *run);

#endif
