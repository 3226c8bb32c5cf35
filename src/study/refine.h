/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Points of curves over 0..1: evenly spaced, then more of them where a plot of the curves bends, jumps or
 * breaks off. Depends on text/error; what is evaluated is a callback. */
#ifndef STUDY_REFINE_H
#define STUDY_REFINE_H

#include "text/error.h"

typedef struct refinement {
    size_t count; /* values of a row; one that is not finite is a gap */
    size_t steps; /* even steps to begin with */
    /* Computes `rows` rows, each a part 0..1 with room for values behind it. False: error, or stopped. */
    bool (*evaluate)(void *context, long double *row, size_t rows);
    /* Receives the final rows in ascending order. False ends it. */
    bool (*give)(void *context, long double part, const long double *values);
    void *context;
} refinement;

/* Lines between the points then deviate by less than about 1/2000 of the height of the plot, except where a
 * curve bends within 1e-5 of the width or is more than twice the height of its bulk away, as at a pole. */
bool refine(const refinement *r, calc_error *error);

#endif
