/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Interpolating polynomials at Chebyshev nodes, in z on -1..1 or in y = (1+z)/2 on 0..1. Not installed. */
#ifndef FRET_NUMBER_CHEBYSHEV_H
#define FRET_NUMBER_CHEBYSHEV_H

#include <stdbool.h>

#include "fret/base.h"

enum { FRET_CHEBYSHEV = 20 }; /* the most nodes */

typedef struct fret_chebyshev {
    int count;
    bool from_nil;                                   /* nodes and powers are those of y */
    fret_real wave[4 * FRET_CHEBYSHEV];              /* cos(pi i/(2 count)) */
    fret_real node[FRET_CHEBYSHEV];                  /* in descending order */
    fret_real at[FRET_CHEBYSHEV][FRET_CHEBYSHEV];    /* T_i at node j */
    fret_real power[FRET_CHEBYSHEV][FRET_CHEBYSHEV]; /* coefficients of T_i in z or y */
} fret_chebyshev;

/* The nodes and tables for `count` nodes, an even number. */
void fret_chebyshev_make(fret_chebyshev *c, int count, bool from_nil);

/* Coefficients of the T_i from the values at the nodes. */
void fret_chebyshev_terms(const fret_chebyshev *c, const fret_real *value, fret_real *term);
/* FRET_CHEBYSHEV coefficients of powers from the first `count` coefficients of the T_i. */
void fret_chebyshev_powers(const fret_chebyshev *c, const fret_real *term, int count, fret_real *power);

#endif
