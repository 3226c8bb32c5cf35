/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A measured loop with noise in both columns, as branches between turning points: the distance of each row
 * from the curve of a model, in units of the two noises. Depends on turning.h; the model is a callback. */
#ifndef MEASURED_BRANCHES_H
#define MEASURED_BRANCHES_H

#include <stdbool.h>
#include <stddef.h>

#include "measured/turning.h"

/* Callback: moves the contact to the displacement dx, under `normal` if a normal load is measured at each row
 * (else 0). *x, *F: the point of the measured curve that corresponds. False: the model has no such state. */
typedef bool branches_step(void *context, double dx, double normal, double *x, double *F);

typedef struct branches {
    size_t rows;
    const double *dx, *Fx, *normal; /* rows, borrowed; normal may be NULL */
    double noise_dx, noise_Fx;      /* standard deviations */
    double compliance, d0, F0;      /* of the rig: the contact's d_x is dx - d0 - compliance (Fx - F0) */
    size_t passed;         /* turning points that the model passes before the first row: whole cycles, or 0 */
    bool noisy;            /* the noise of d_x matters: turning points are unknowns */
    size_t turns;          /* number of turning points; there are turns + 1 branches */
    double *level, *force; /* dx and Fx of each turning point, as measured */
    double range;          /* of dx */
    size_t *first;         /* first row of each branch, then `rows` */
    turning *about;        /* rows about each turning point */
    double *turn;          /* trial values: the contact's d_x at each turning point */
    double *across;        /* distance of each row, then of each turning point */
    double *x, *F;         /* NULL, or room for branches_nodes values: receives the curve */
    bool warm;             /* start from the feet of perpendiculars of the last call without `warm` */
    /* private */
    bool up;               /* d_x increases in the first branch; then directions alternate */
    double end, end_force; /* dx and Fx at the end of the last branch */
    double *foot, *sums;   /* foot of each row; for each turning point the sums of level and variance */
    double *load;          /* normal loads at the nodes of all branches */
    double *memory;
} branches;

/* Finds the branches of b->rows. noise_dx, noise_Fx: 0 to estimate them. steady: the rows begin within a
 * steady cycle, not at rest. Free with branches_free always. */
bool branches_find(branches *b, double noise_dx, double noise_Fx, bool steady, calc_error *error);
void branches_free(branches *b);

/* The number of nodes of the curve. */
size_t branches_nodes(const branches *b);
/* The number of rows in the first 6 branches, enough for a coarse search. */
size_t branches_glance(const branches *b);
/* Sets b->turn to the measured turning points. */
void branches_begin(branches *b);
/* Computes b->across for b->turn, with n > 1 only every n-th row of the first 6 branches, else 0. Subtracts
 * the bias from noise in both columns, half the curvature of the curve. False: `step` has failed. */
bool branches_across(branches *b, size_t n, branches_step *step, void *context);
#endif
