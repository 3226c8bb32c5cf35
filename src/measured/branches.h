/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A measured loop with noise in both columns, as branches between turning points: how far each row is from
 * the curve of a model, across it, in units of the two noises. Knows numbers, and the model by a function. */
#ifndef MEASURED_BRANCHES_H
#define MEASURED_BRANCHES_H

#include <stdbool.h>
#include <stddef.h>

#include "measured/turning.h"

/* One step of the contact to a displacement, under this normal load where there is one to each row (else 0),
 * and where that lies on the measured curve. False: the model cannot. */
typedef bool branches_step(void *context, double dx, double normal, double *x, double *F);

typedef struct branches {
    size_t rows;
    const double *dx, *Fx, *normal; /* borrowed; normal may be NULL */
    double noise_dx, noise_Fx;
    double compliance, d0, F0; /* of what is measured: the contact's d_x is dx - d0 - compliance (Fx - F0) */
    bool twice;                /* a closed loop from its midst: its turning points are run through first */
    bool noisy;                /* turning points are unknowns: d_x has a noise that matters */
    size_t turns;              /* turning points */
    double *level;             /* of them, as measured, */
    double *force;             /* and F_x there */
    double range;              /* of d_x */
    size_t *first;             /* row of each branch, of which there is one more; and their end */
    turning *about;            /* rows about each turning point */
    double *turn;              /* d_x of the contact, as they are tried */
    double *across;            /* of each row: its distance; then of each turning point */
    double *x, *F;             /* NULL, or room for branches_nodes: the curve, as it is gone through */
    bool warm; /* feet of perpendiculars are close to those of the last time that it was not so */
    /* private */
    bool up;               /* the first of them; the others follow in turn */
    double end, end_force; /* of the last */
    double *foot, *spread; /* of rows; of turning points the level and the variance so far */
    double *load;          /* normal loads at the nodes of all branches */
    double *memory;
} branches;

/* noise_dx, noise_Fx: given, or 0. Free with branches_free whatever comes. */
bool branches_find(branches *b, double noise_dx, double noise_Fx, bool twice, calc_error *error);
void branches_free(branches *b);

size_t branches_nodes(const branches *b);
/* Rows of the first branches, which tell as much as a glance needs. */
size_t branches_glance(const branches *b);
/* Turning points as measured, where the contact is. */
void branches_begin(branches *b);
/* Distances of all rows from the curve at the present turning points; of every n-th row, n > 1: of the first
 * branches alone, where others are 0. With noise
 * in both columns across has a bias of half the curvature of the curve, which is taken off. */
bool branches_across(branches *b, size_t n, branches_step *step, void *context);
#endif
