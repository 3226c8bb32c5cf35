/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The way of the load: its curve, and states of an item to play. Walked in parts, so that no frame waits for
 * it. Knows no screen. */
#ifndef LIVE_WAY_H
#define LIVE_WAY_H

#include "language/walk.h"
#include "live/shot.h"

/* A polyline with every turning point; the oldest part goes where it is long. */
typedef struct track_point {
    double time, dx, Fx, W, U;
} track_point;
typedef struct extent {
    double dx, Fx, a, bound, energy; /* the largest magnitudes */
} extent;
typedef struct track {
    track_point *point;
    size_t count, room;
    extent most;   /* on the way */
    extent before; /* of the way that it replaces, until it is complete: the picture must not breathe */
} track;

enum { PLAY_SHOTS = 256 };
#define NO_ITEM ((size_t)-1)

typedef struct load_way {
    walk walk;
    track path;
    size_t item; /* of the load, whose states are wanted; or NO_ITEM */
    double from; /* this time on */
    bool within; /* the walk has come to it */
    shot *play;  /* those that are ahead */
    size_t shots;
} load_way;

/* Goes for the load of the scene that expressions see. item: states of this item and what follows are wanted,
 * from where it moves. */
bool way_follow(load_way *w, calc *c, size_t item, calc_error *error);
/* Goes on until it is late, or all is walked, or there are enough states ahead. late: NULL: never. */
bool way_on(load_way *w, calc *c, bool (*late)(void), calc_error *error);
/* All is walked. */
bool way_done(const load_way *w);
/* Is there nothing to do for way_on? */
bool way_rests(const load_way *w);
/* One more period of the cycle that it ends with; its states are wanted. */
void way_more(load_way *w);
/* No states are wanted any more: there is no end to wait for. */
void way_unwatch(load_way *w);
/* The states before this time are no longer wanted, but for the last of them. */
void way_pass(load_way *w, double time);
extent way_extent(const load_way *w);
void way_end(load_way *w);

#endif
