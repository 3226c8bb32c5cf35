/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Points of curves over 0..1, evenly spaced and then more of them where a picture of the curves bends, jumps
 * or breaks off. Knows nothing of what is evaluated. */
#ifndef STUDY_REFINE_H
#define STUDY_REFINE_H

#include "text/error.h"

typedef struct refinement {
    size_t count; /* values of a row; one that is not finite is a gap */
    size_t steps; /* even ones to begin with */
    /* Of so many rows, each the part and behind it room for the values, fills these; false: an error, or
     * stopped. */
    bool (*evaluate)(void *context, long double *row, size_t rows);
    /* Takes the rows in the end, in their order. */
    bool (*give)(void *context, long double part, const long double *values);
    void *context;
} refinement;

/* Lines between the points then keep within 1/2000 of the height of the picture, unless a curve bends on less
 * than 1e-5 of the width, or goes beyond twice the height of its bulk, as at a pole. */
bool refine(const refinement *r, calc_error *error);

#endif
