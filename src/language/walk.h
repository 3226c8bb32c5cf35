/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A load program run again look by look, for who shows it and must not keep anybody waiting. Changes no scene
 * but its own. */
#ifndef LANGUAGE_WALK_H
#define LANGUAGE_WALK_H

#include "language/calc.h"

typedef struct walk {
    scene scene;    /* of its own, with the program as it runs */
    load_view load; /* of it */
    runner run;
    instant now;
    scene *outer; /* whom expressions see otherwise */
    bool begun;
} walk;

/* Goes for the load of the scene that expressions see. As far as that is the load it has run, with the same
 * inputs, it stays where it is; else it stands before the press again, and *anew says so. False with the
 * error: there is no such load. */
bool walk_follow(walk *w, calc *c, bool *anew, calc_error *error);
/* On to the next look before this item of the program; false: it is there, or the error. Legs without chords
 * are seen in so many parts. all: periods that repeat those before, too. */
bool walk_next(walk *w, size_t item, unsigned points, bool all, calc_error *error);
/* One more period of the cycle that the load ends with. */
void walk_more(walk *w);
/* Expressions see the state here, until walk_leave. */
void walk_enter(walk *w, calc *c);
void walk_leave(walk *w, calc *c);
void walk_end(walk *w);
/* Do they load alike? */
bool walk_same_item(const load_item *a, const load_item *b);

#endif
