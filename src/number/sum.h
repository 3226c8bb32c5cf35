/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Compensated sums. Not installed. */
#ifndef FRET_NUMBER_SUM_H
#define FRET_NUMBER_SUM_H

#include <math.h>

#include "fret/base.h"

/* A sum with Neumaier's compensation: 1e8 small terms without drift. */
typedef struct fret_sum {
    fret_real sum, rest;
} fret_sum;

static inline void fret_sum_add(fret_sum *s, fret_real x) {
    fret_real t = s->sum + x;
    s->rest += fabsl(s->sum) >= fabsl(x) ? (s->sum - t) + x : (x - t) + s->sum;
    s->sum = t;
}

static inline fret_real fret_sum_value(const fret_sum *s) {
    return s->sum + s->rest;
}

#endif
