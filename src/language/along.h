/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A trial along its load: expressions see it at one instant after the other. Changes that scene alone. */
#ifndef LANGUAGE_ALONG_H
#define LANGUAGE_ALONG_H

#include "language/beside.h"
#include "language/trial.h"

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
