/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Expressions over two names at once: sweeps over the first, one for each value of the second. */
#ifndef STUDY_GRID_H
#define STUDY_GRID_H

#include "study/sweep.h"

typedef struct grid {
    sweep a, b; /* both for NAME = LO .. HI */
} grid;

/* Its values as they come, the first name running faster. */
typedef struct grid_values {
    size_t rows, across; /* of the first name, of the second */
    size_t count;        /* expressions */
    size_t at;           /* values of them so far */
    long double *a, *b, *v;
} grid_values;

/* As sweep_run; rows see the second name and its value as `with` of the sweep. */
bool grid_run(const grid *g, sweep_job *job);
/* The same, kept; to be freed whatever comes. */
bool grid_keep(const grid *g, sweep_job *job, grid_values *out);
void grid_values_free(grid_values *values);

#endif
