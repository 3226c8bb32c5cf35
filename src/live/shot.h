/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What is drawn, as plain numbers: the state of a scene at an instant, and the way that led there. Knows no
 * screen. */
#ifndef LIVE_SHOT_H
#define LIVE_SHOT_H

#include "calc/trial.h"

enum { SHOT_SAMPLES = 96, SHOT_RINGS = 32, SHOT_VALUES = 11 };

typedef struct shot_ring {
    double radius; /* its outer edge [m] */
    double sigma;  /* slope of the memory: 0 where it never slipped, -1 or 1 where it has */
} shot_ring;

typedef struct shot {
    double time;
    double a, c, dx, Fx;
    double slip;                                     /* mu F_N [N] */
    double bound;                                    /* the largest displacement of a spring, B(0) [m] */
    double u[SHOT_SAMPLES + 1], B[SHOT_SAMPLES + 1]; /* at r = a i/SHOT_SAMPLES [m] */
    shot_ring ring[SHOT_RINGS];                      /* from the innermost */
    size_t rings;
    bool known[SHOT_VALUES]; /* the numbers: shot_name */
    long double value[SHOT_VALUES];
    dim d[SHOT_VALUES];
} shot;

const char *shot_name(size_t i);
/* Of the scene that expressions see. like: an earlier one, whose bounds may be taken over, or NULL. */
bool shot_take(calc *c, const shot *like, shot *out, calc_error *error);

/* The way so far: a polyline with every turning point; the oldest part goes where it is long. */
typedef struct track_point {
    double time, dx, Fx, W, U;
} track_point;
typedef struct track {
    track_point *point;
    size_t count, room;
    double dx, Fx, a, bound, energy; /* the largest magnitudes on the way */
    /* what it was made for */
    const program *program;
    size_t steps;
    inputs in; /* only to be compared */
} track;

/* Brings it up to the end of the load of the scene that expressions see; now is that end, and way, if not
 * empty, what shots_along took. */
bool track_follow(track *t, calc *c, const shot *now, const shot *way, size_t count, calc_error *error);
void track_free(track *t);

/* States on the way of the last item of the load, evenly in time; false: there is none, or no memory. */
bool shots_along(calc *c, shot *out, size_t count, size_t *taken, calc_error *error);
/* Has a cycle more brought the scene, as track_follow saw it last, to `now`, where the same cycle began and
 * ended before? Then its states are those again, later and with more lost. */
bool shots_again(const track *t, const calc *c, const shot *now, shot *way, size_t count);

#endif
