/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Expressions over two names at once: sweeps over the first, one for each value of the second. */
#ifndef STUDY_GRID_H
#define STUDY_GRID_H

#include "study/sweep.h"

typedef struct grid {
    sweep a, b; /* both for NAME = LO .. HI */
} grid;

/* As sweep_run; rows see the second name and its value as `with` of the sweep. */
bool grid_run(const grid *g, sweep_job *job);

#endif
