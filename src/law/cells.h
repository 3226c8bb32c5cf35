/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The law of a shape without a closed form, cell by cell: made once, for a stiffness of 1, then only read.
 * Not installed. */
#ifndef FRET_LAW_CELLS_H
#define FRET_LAW_CELLS_H

#include <float.h>
#include <stdatomic.h>

#include "law/cell.h"
#include "law/gap.h"

/* Lengths of runs: powers of two. */
enum { FRET_RUNS = 40 };

typedef struct fret_cells {
    atomic_size_t users;
    struct fret_cells *unit; /* of which these are scaled, or NULL */
    fret_gap gap;            /* of which gap and exponent */
    double k;
    fret_rule rule;
    size_t count, room;
    fret_cell *cell;              /* from the centre, or the flat end, outwards */
    fret_stretch *run[FRET_RUNS]; /* run[l][i]: the 2^l cells from i 2^l on */
    fret_real most[2];            /* depth and load at the end */
    fret_real end, error;         /* the last radius; what is left of the polynomials, relative to depth */
    bool falls;                   /* g begins to fall there */
} fret_cells;

/* Of a gap that has been checked. Shapes with sizes are cut where those are 1, and scaled. like: NULL, or
 * cells, which are shared or scaled where shape and exponent are the same; which they were cannot be told.
 * Errors: FRET_NOT_MONOTONE, FRET_NO_MEMORY, FRET_INTERRUPTED. */
fret_status fret_cells_make(const fret_gap *gap, double k, fret_cells *like, fret_stop stop,
                            fret_cells **out);
void fret_cells_free(fret_cells *cells);

/* Does a law that ends at `most` know `value`? A double's rounding beyond it counts as its end: what a
 * contact that reaches the end of its gap answers must be carried when it is given back. */
static inline bool fret_cells_reach(fret_real most, fret_real value) {
    return value <= most * (1 + 4 * DBL_EPSILON);
}

/* A place: s of cell i. At s = 0, where it is all zeros, it has not been looked for, or is the very first. */
typedef struct fret_place {
    size_t i;
    fret_real s;
} fret_place;

/* Where depth or load is `value`; false: beyond the end. */
bool fret_cells_find(const fret_cells *cells, int by, fret_real value, fret_place *out);
/* Where the radius is x, not beyond the end. */
fret_place fret_cells_at(const fret_cells *cells, fret_real x);
/* Depth or load there; K = dF/dy; radius. */
fret_real fret_cells_level(const fret_cells *cells, int by, const fret_place *place);
fret_real fret_cells_stiffness(const fret_cells *cells, const fret_place *place);
fret_real fret_cells_radius(const fret_cells *cells, const fret_place *place);
/* Where depth or load is less than at `outer` by `drop`, and `left` is left, each with all digits where it is
 * little: found unless `inner` knows it. Returns how far back that is, with all digits: from the outer place
 * where both are in one cell, else from the outer end of the inner one's cell. */
fret_real fret_cells_inner(const fret_cells *cells, int by, const fret_place *outer, fret_real drop,
                           fret_real left, fret_place *inner);
/* Depth or load between a place and one so far back. */
fret_real fret_cells_fall(const fret_cells *cells, int by, const fret_place *outer, const fret_place *inner,
                          fret_real back);
/* From the one place to the other; K at the inner one. */
fret_stretch fret_cells_between(const fret_cells *cells, const fret_place *outer, const fret_place *inner,
                                fret_real back, fret_real *K);

#endif
