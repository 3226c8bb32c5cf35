/* SPDX-License-Identifier: GPL-3.0-or-later */
/* An expression in (inputs, load program, instant): some of these changed, the user's scene untouched.
 * Sweeps, `at`, states along a load, solve, fit and the rest are short loops over this. */
#ifndef LANGUAGE_TRIAL_H
#define LANGUAGE_TRIAL_H

#include "language/beside.h"

/* Expressions see the trial's scene from trial_open to trial_close. */
typedef struct trial {
    calc *c;
    scene scene;
    scene *outer; /* whom it stands for */
    bool sound;   /* whose program runs to its end */
    struct hidden_name {
        size_t index;
        own_name old;
    } * hidden; /* names of the user that have another value */
    size_t hidden_count, hidden_room;
} trial;

trial *trial_open(calc *c, calc_error *error);
/* Sets an input or a name; checks the input's range, runs nothing. */
bool trial_set(trial *t, const knob *p, long double v, calc_error *error);
/* Sets all of them; at an instant on the way of a load expressions see the same instant of the changed scene.
 * wrong: which of them cannot be, or `count`. */
bool trial_change(trial *t, const knob_value by[], size_t count, size_t *wrong, calc_error *error);
/* Back to the scene as it was opened; names keep their values. */
void trial_reset(trial *t);
void trial_close(trial *t); /* NULL too */

/* NAME at the cursor as a parameter: an input that the scene takes, or a name; a new one is known to
 * expressions until the trial, or whoever called, drops it. */
bool knob_read(calc *c, lexer *lx, knob *out);
/* The same, whatever the scene takes now. */
bool knob_name(calc *c, lexer *lx, knob *out);

/* The same of an input, or of a name that has a value. */
bool knob_known(calc *c, lexer *lx, knob *out);

/* EXPR at NAME = EXPR, ...: a trial with these changes, to be closed, and what is meant in it; of another
 * expression NULL and itself. */
bool expr_changed(calc *c, const expr *e, trial **t, const expr **body, calc_error *error);

/* Which load the states come from. */
typedef enum along_what { ALONG_PROGRAM, ALONG_CYCLE, ALONG_LOAD } along_what;

/* A trial along its load: expressions see it at one instant after the other. */
typedef struct trial_along {
    trial *t;
    scene_trace trace;
    instant now;
    beside beside;
    double first, last; /* times that count */
} trial_along;
/* At `points`+1 instants, evenly in time; turns: at the turning points too. from: the mark where a load tried
 * on it (ALONG_LOAD, scene_append) begins. False: it need not be ended. */
bool trial_along_begin(trial_along *a, trial *t, along_what what, load_mark from, size_t points, bool turns,
                       calc_error *error);
/* The same between two times of its load. */
bool trial_along_between(trial_along *a, trial *t, double first, double last, size_t points, bool turns,
                         calc_error *error);
/* The times that `what` goes from and to. */
bool trial_along_span(trial *t, along_what what, load_mark from, double *first, double *last,
                      calc_error *error);
/* On to the next instant; false: the end, or the error. */
bool trial_along_next(trial_along *a, calc_error *error);
void trial_along_end(trial_along *a);

#endif
