/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A shot: what the views draw of a scene at one instant, as plain numbers. Uses no screen. */
#ifndef LIVE_SHOT_H
#define LIVE_SHOT_H

#include "language/trial.h"

enum { SHOT_SAMPLES = 96, SHOT_RINGS = 32, SHOT_VALUES = 11 };

typedef struct shot_ring {
    double radius; /* outer edge [m] */
    double sigma;  /* slope of the memory diagram: 0 where it never slipped, -1 or 1 where it has */
} shot_ring;

typedef struct shot {
    double a, c, dx, Fx;                             /* [m], [m], [m], [N] */
    double slip;                                     /* force of gross slip, mu F_N [N] */
    double bound;                                    /* largest displacement of a spring, B(0) [m] */
    double u[SHOT_SAMPLES + 1], B[SHOT_SAMPLES + 1]; /* springs and bound [m] at x = a i/SHOT_SAMPLES */
    shot_ring ring[SHOT_RINGS];                      /* from the innermost */
    size_t rings;
    bool known[SHOT_VALUES]; /* the table of numbers, named by shot_names: is there a value? */
    long double value[SHOT_VALUES];
    dim d[SHOT_VALUES];
    int digits; /* correct digits of the values; 0: all */
} shot;

extern const char *const shot_names[SHOT_VALUES];
/* Takes a shot of the scene that expressions see, at its instant. False with the error. */
bool shot_take(calc *c, shot *out, calc_error *error);

/* Gets friction's work per area in the last closed cycle [J/m^2] at r = a i/SHOT_SAMPLES; false if there is
 * none, or F_N is not constant. */
bool shot_lost(calc *c, double a, double lost[SHOT_SAMPLES + 1]);

#endif
