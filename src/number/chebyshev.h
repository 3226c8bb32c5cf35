/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Polynomials through values at Chebyshev's nodes, of z in -1..1 or of y = (1+z)/2 in 0..1. Not installed. */
#ifndef FRET_NUMBER_CHEBYSHEV_H
#define FRET_NUMBER_CHEBYSHEV_H

#include <stdbool.h>

#include "fret/base.h"

enum { FRET_CHEBYSHEV = 20 }; /* the most nodes */

typedef struct fret_chebyshev {
    int count;
    bool from_nil;                                   /* of y */
    fret_real wave[4 * FRET_CHEBYSHEV];              /* cos(pi i/(2 count)) */
    fret_real node[FRET_CHEBYSHEV];                  /* from the upper end downwards */
    fret_real at[FRET_CHEBYSHEV][FRET_CHEBYSHEV];    /* T_i at node j */
    fret_real power[FRET_CHEBYSHEV][FRET_CHEBYSHEV]; /* T_i in powers of z or y */
} fret_chebyshev;

/* count: even. */
void fret_chebyshev_make(fret_chebyshev *c, int count, bool from_nil);

/* The factors of T_i through the values at the nodes; the first `count` of them as powers, 0 up to the most.
 */
void fret_chebyshev_terms(const fret_chebyshev *c, const fret_real *value, fret_real *term);
void fret_chebyshev_powers(const fret_chebyshev *c, const fret_real *term, int count, fret_real *power);

#endif
