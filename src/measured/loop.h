/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Measures of a hysteresis loop, cycle by cycle, without a model. Depends on turning.h. */
#ifndef MEASURED_LOOP_H
#define MEASURED_LOOP_H

#include "text/error.h"

/* A cycle: from a turning point of d_x to the next but one. Amplitudes and centre are taken between the last
 * two turning points, at levels averaged over the noise (turning_level). */
typedef struct loop_cycle {
    size_t first, last; /* rows where it begins and ends; last < first: it wraps around the end of the file */
    double dW; /* loss: area of the closed polygon of its rows, less the drift between cycles [J]. With M rows
                  per cycle it is low by the part (2pi/M)^2/6 */
    double dxA, FA;   /* amplitudes [m, N] */
    double dx0, Fx0;  /* centre [m, N] */
    double secant;    /* FA/dxA [N/m] */
    double unloading; /* mean slope behind the turning points, from the first 30 % of the fall of F_x [N/m] */
    double flank;     /* mean slope before them, over the last 10 % of d_x, relative to `unloading` */
    double ratio;     /* dW/(4 FA dxA) */
    bool slides;      /* gross slip: `flank` is below 0.05 plus twice its standard error */
} loop_cycle;

typedef struct loop_answer {
    loop_cycle *cycle;
    size_t cycles;
    double noise_dx, noise_Fx; /* standard deviations [m, N]; 0: too few rows to tell */
    double drift_dx, drift_Fx; /* of the centre per cycle; of a single cycle, from first to last row */
    bool at_rest; /* the first row is at dx = 0, Fx = 0, to 0.05 of the amplitudes or 4 times the noise */
} loop_answer;

/* Measures rows of d_x [m] and F_x [N] in the order of time. Fails if no cycle closes, naming how often d_x
 * turns. Free with loop_free, also after a failure. */
bool loop_find(const double *dx, const double *Fx, size_t rows, loop_answer *out, calc_error *error);
void loop_free(loop_answer *a);

#endif
