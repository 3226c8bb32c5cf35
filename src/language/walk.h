/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A run of a load program look by look, for displays that must not block. Changes no scene but its own. */
#ifndef LANGUAGE_WALK_H
#define LANGUAGE_WALK_H

#include "language/calc.h"

typedef struct walk {
    scene scene;    /* own copy, with the program as it runs */
    load_view load; /* the load of that scene */
    runner run;
    instant now;
    scene *outer; /* c->now outside walk_enter .. walk_leave */
    bool begun;
} walk;

/* Makes the walk follow the load of c->now. If it has run a beginning of this load with the same inputs, its
 * position stays; else it restarts at the press, and *anew is set. False: error, no load. */
bool walk_follow(walk *w, calc *c, bool *anew, calc_error *error);
/* Runs to the next look before step `item` of the program; false: reached, or an error. Legs without chords
 * have `points` looks. all: also run periods that repeat those before. */
bool walk_next(walk *w, size_t item, unsigned points, bool all, calc_error *error);
/* Adds a period to the cycle that ends the load. */
void walk_more(walk *w);
/* Expressions see the present state, until walk_leave. */
void walk_enter(walk *w, calc *c);
void walk_leave(walk *w, calc *c);
void walk_end(walk *w);
/* Are two steps equal? */
bool walk_same_item(const load_item *a, const load_item *b);

#endif
