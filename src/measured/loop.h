/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a measured hysteresis loop says of itself, cycle by cycle. Knows numbers alone. */
#ifndef MEASURED_LOOP_H
#define MEASURED_LOOP_H

#include "text/error.h"

/* From one turning point of d_x to the next but one. Amplitudes and centre are those of d_x and F_x between
 * the last two turning points, where noise has been averaged (turning_level). */
typedef struct loop_cycle {
    size_t first, last; /* rows that it begins and ends with; last < first: around the end of the file */
    double dW; /* area of the polygon of its rows, closed, of several cycles less their drift: of M rows to a
                  cycle (2pi/M)^2/6 too small [J] */
    double dxA, FA;   /* amplitudes [m, N] */
    double dx0, Fx0;  /* centre */
    double secant;    /* FA/dxA [N/m] */
    double unloading; /* slope behind the turning points, from the first 30 % of the fall of F_x [N/m] */
    double flank;     /* slope before them, over the last 10 % of the way, as a part of that */
    double ratio;     /* dW/(4 FA dxA) */
    bool slides;      /* the flank is flat: below 0.05 and twice its standard error */
} loop_cycle;

typedef struct loop_answer {
    loop_cycle *cycle;
    size_t cycles;
    double noise_dx, noise_Fx; /* standard deviations, from row to row */
    double drift_dx, drift_Fx; /* of the centre, a cycle; of one cycle, from its first row to its last */
    bool at_rest; /* row 1 is at dx = 0 and Fx = 0, to a part of 0.05 of the amplitudes or the noise */
} loop_answer;

/* Rows of d_x and F_x in their order. Errors: d_x does not come back. Free with loop_free whatever comes. */
bool loop_find(const double *dx, const double *Fx, size_t rows, loop_answer *out, calc_error *error);
void loop_free(loop_answer *a);

#endif
