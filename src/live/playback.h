/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The playback of a load: it is run again from its beginning, a little in each frame, so that no frame waits
 * for it; where the run stands is what plays, and behind it is the curve. Uses no screen. */
#ifndef LIVE_PLAYBACK_H
#define LIVE_PLAYBACK_H

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
    extent most;
} track;

typedef struct playback {
    scene scene;       /* a copy of the scene whose load it is */
    scene_trace trace; /* its run */
    instant now;
    bool begun;
    double from; /* the time from which the load plays; INFINITY: it does not */
    track track,
        before; /* the curve, and the one before it, which is shown until this one has reached `from` */
} playback;

/* Begins to run the load of the scene that expressions see; the scene must have run it. False with the error.
 */
bool playback_begin(playback *w, calc *c, double from, calc_error *error);
/* Runs the load on to this time, or until late() is true (NULL: never). False with the error. */
bool playback_run(playback *w, double time, bool (*late)(void), calc_error *error);
/* Has the run reached this time, or its end? */
bool playback_there(const playback *w, double time);
/* Takes the state that the run has reached. */
bool playback_shot(playback *w, calc *c, shot *out, calc_error *error);
/* The curve to be shown: of one point or more. */
const track *playback_curve(const playback *w);
void playback_end(playback *w);

#endif
