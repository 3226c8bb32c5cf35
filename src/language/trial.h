/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Trials: expressions in a scratch scene with some inputs, the load program or the instant changed; the
 * user's scene is untouched. Sweeps, `at`, states along a load, solve, fit and the rest loop over this. */
#ifndef LANGUAGE_TRIAL_H
#define LANGUAGE_TRIAL_H

#include "language/beside.h"

/* Expressions are evaluated in the trial's scene from trial_open to trial_close. */
typedef struct trial {
    calc *c;
    scene scene;
    scene *outer; /* the scene that it replaces */
    bool sound;   /* its program is known to run to the end */
    struct hidden_name {
        size_t index;
        own_name old;
    } * hidden; /* the user's names that have another value */
    size_t hidden_count, hidden_room;
} trial;

trial *trial_open(calc *c, calc_error *error);
/* Sets an input or a name; checks the range of an input, runs nothing. */
bool trial_set(trial *t, const knob *p, long double v, calc_error *error);
/* Sets all changes. At an instant along a load expressions then see the same instant of the changed scene.
 * wrong: index of the change that failed, or `count`. */
bool trial_change(trial *t, const knob_value by[], size_t count, size_t *wrong, calc_error *error);
/* Restores the scene as opened; names keep their values. */
void trial_reset(trial *t);
void trial_close(trial *t); /* accepts NULL */

/* Reads NAME at the cursor as a knob: an input that the scene takes, or a name. A new name is known to
 * expressions until the trial or the caller drops it. */
bool knob_read(calc *c, lexer *lx, knob *out);
/* The same, whether or not the scene takes the input now. */
bool knob_name(calc *c, lexer *lx, knob *out);

/* Can the two be changed together? Not if they are one, or one replaces the other; the error is about `b`. */
bool knob_apart(const knob *a, const knob *b, size_t at, size_t len, calc_error *error);

/* The same for an input, or a name that has a value. */
bool knob_known(calc *c, lexer *lx, knob *out);

/* For EXPR at NAME = EXPR, ...: opens a trial with these changes, to be closed, and sets *body to EXPR. For
 * other expressions *t = NULL and *body = e. */
bool expr_changed(calc *c, const expr *e, trial **t, const expr **body, calc_error *error);

/* The part of the load that states are taken from. */
typedef enum along_what { ALONG_PROGRAM, ALONG_CYCLE, ALONG_LOAD } along_what;

/* A trial along its load: an iterator over instants, at which expressions are evaluated. */
typedef struct trial_along {
    trial *t;
    scene_trace trace;
    instant now;
    beside beside;
    double first, last; /* range of time */
} trial_along;
/* Starts at points + 1 instants, even in time; turns: and at turning points. from: the mark where a load
 * tried on the scene (ALONG_LOAD, scene_append) begins. After false do not end it. */
bool trial_along_begin(trial_along *a, trial *t, along_what what, load_mark from, size_t points, bool turns,
                       calc_error *error);
/* The same between two times of the load. */
bool trial_along_between(trial_along *a, trial *t, double first, double last, size_t points, bool turns,
                         calc_error *error);
/* The range of time of `what`. */
bool trial_along_span(trial *t, along_what what, load_mark from, double *first, double *last,
                      calc_error *error);
/* Moves to the next instant; false: the end, or an error. */
bool trial_along_next(trial_along *a, calc_error *error);
void trial_along_end(trial_along *a);

#endif
