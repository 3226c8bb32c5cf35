/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The playback of a load: its curve, and states of its last item to play. The load is run (language/walk) a
 * little in each frame, so that no frame waits for it. Uses no screen. */
#ifndef LIVE_PLAYBACK_H
#define LIVE_PLAYBACK_H

#include "language/walk.h"
#include "live/shot.h"

/* The curve: a polyline with every turning point. If it grows too long the older half is dropped. */
typedef struct track_point {
    double time, dx, Fx, W, U;
} track_point;
typedef struct extent {
    double dx, Fx, a, bound, energy; /* the largest magnitudes */
} extent;
typedef struct track {
    track_point *point;
    size_t count, room;
    extent most;   /* of this curve */
    extent before; /* of the curve before it, until this one is complete: scales must not jump meanwhile */
} track;

enum { PLAY_SHOTS = 256 };
#define NO_ITEM ((size_t)-1)

typedef struct playback {
    walk walk;
    track track;
    size_t item;  /* states of this item of the load and the following are kept; NO_ITEM: none are */
    double from;  /* from this time on */
    bool reached; /* the walk has reached the item */
    shot *play;   /* the states to play, PLAY_SHOTS at most */
    size_t shots;
} playback;

/* Prepares for the load of the scene that expressions see; goes on where the load that has been run is its
 * beginning. item: keep the states of this item and the following, from its first motion, or NO_ITEM. */
bool playback_follow(playback *w, calc *c, size_t item, calc_error *error);
/* Runs the load on until late() is true (NULL: never), its end, or PLAY_SHOTS states to play. False with the
 * error. */
bool playback_go_on(playback *w, calc *c, bool (*late)(void), calc_error *error);
/* Has the load been run to its end? */
bool playback_done(const playback *w);
/* Has playback_go_on nothing to do: the end is reached, or there are enough states to play? */
bool playback_idle(const playback *w);
/* Adds one more period of the cycle that the load ends with, and keeps its states. */
void playback_add_period(playback *w);
/* Drops the states to play and keeps no more of them. */
void playback_drop_states(playback *w);
/* Drops the states before this time, but for the last of them. */
void playback_drop_before(playback *w, double time);
extent playback_extent(const playback *w);
void playback_end(playback *w);

#endif
