/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The law of a shape without a closed form: cells for unit stiffness, only read once made. Not installed. */
#ifndef FRET_LAW_CELLS_H
#define FRET_LAW_CELLS_H

#include <float.h>
#include <stdatomic.h>

#include "law/cell.h"
#include "law/gap.h"

/* Runs of 2^l cells, l = 0, 1 .. */
enum { FRET_RUNS = 40 };

typedef struct fret_cells {
    atomic_size_t users;
    struct fret_cells *unit; /* the cells of unit size that were scaled to make these */
    fret_gap gap;            /* the gap, and the exponent k, of the cells */
    double k;
    fret_rule rule;
    size_t count, room;
    fret_cell *cell;              /* from the centre, or the flat end, outwards */
    fret_stretch *run[FRET_RUNS]; /* run[l][i]: sums over the 2^l cells from number i 2^l on */
    fret_real most[2];            /* largest depth and load, at the end */
    fret_real end, error;         /* the largest radius; relative error of depth */
    bool falls;                   /* g begins to fall at the end */
} fret_cells;

/* Makes the cells of a gap that has been checked. Shapes with sizes are cut with their sizes set to 1, then
 * scaled. like: NULL, or cells to share or scale if their shape and exponent are the same; the result has the
 * same bits either way. Errors: FRET_NOT_MONOTONE, FRET_NO_MEMORY, FRET_INTERRUPTED. */
fret_status fret_cells_make(const fret_gap *gap, double k, fret_cells *like, fret_stop stop,
                            fret_cells **out);
void fret_cells_free(fret_cells *cells);

/* True if `value` is at most `most`, the end of a law, plus a rounding error: a depth or load computed at the
 * end of the gap and rounded to double must be accepted again. */
static inline bool fret_cells_reach(fret_real most, fret_real value) {
    return value <= most * (1 + 4 * DBL_EPSILON);
}

/* A place in the law: s of cell i. All zeros: not yet found, or the innermost place. */
typedef struct fret_place {
    size_t i;
    fret_real s;
} fret_place;

/* The place where depth or load is `value`; false beyond the end. */
bool fret_cells_find(const fret_cells *cells, int by, fret_real value, fret_place *out);
/* The place of the radius x, which must not lie beyond the end. */
fret_place fret_cells_at(const fret_cells *cells, fret_real x);
/* Depth or load, K = dF/dy, and radius at a place. */
fret_real fret_cells_level(const fret_cells *cells, int by, const fret_place *place);
fret_real fret_cells_stiffness(const fret_cells *cells, const fret_place *place);
fret_real fret_cells_radius(const fret_cells *cells, const fret_place *place);
/* Finds `inner`, unless it is known, where depth or load is less than at `outer` by `drop` and has the value
 * `left`; each of the two must have all its digits. Returns the distance in s to it, with all digits: from
 * `outer` if both are in one cell, else from the outer end of the cell of `inner`. */
fret_real fret_cells_inner(const fret_cells *cells, int by, const fret_place *outer, fret_real drop,
                           fret_real left, fret_place *inner);
/* The fall of depth or load from `outer` to `inner`; back: the result of fret_cells_inner. */
fret_real fret_cells_fall(const fret_cells *cells, int by, const fret_place *outer, const fret_place *inner,
                          fret_real back);
/* Sums over the slice between two places; K: its value at the inner one. */
fret_stretch fret_cells_between(const fret_cells *cells, const fret_place *outer, const fret_place *inner,
                                fret_real back, fret_real *K);

#endif
