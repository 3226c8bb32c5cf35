/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What is drawn of a scene at an instant, as plain numbers. Knows no screen. */
#ifndef LIVE_SHOT_H
#define LIVE_SHOT_H

#include "language/trial.h"

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
    int digits; /* that the numbers are known to; 0: all that are printed */
} shot;

const char *shot_name(size_t i);
/* Of the scene that expressions see. */
bool shot_take(calc *c, shot *out, calc_error *error);

/* Friction's work per area in the last closed cycle [J/m^2], at r = a i/SHOT_SAMPLES; false: there is none,
 * or F_N is not constant. */
bool shot_lost(calc *c, double a, double lost[SHOT_SAMPLES + 1]);

#endif
