/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A run of wear: blocks of cycles, in ever wider rings. Not installed. */
#ifndef FRET_WEAR_BLOCKS_H
#define FRET_WEAR_BLOCKS_H

#include "wear/annulus.h"

/* The results in one ring, one row at each end of a block: cycles, depths and work, and their rates. */
typedef struct fret_blocks {
    fret_annulus ring;
    size_t count, room;
    double *row;
} fret_blocks;

struct fret_wear_run {
    const fret_normal *normal; /* borrowed */
    fret_wear_held held;
    double tolerance;
    size_t nodes, count, room; /* nodes of each ring; number of rings, and their capacity */
    fret_blocks *blocks;
    double step, fastest;   /* cycles of the next block; fastest decay rate per cycle */
    long rates, tried;      /* evaluations of the rate so far; blocks tried in the last ring */
    bool arrived;           /* the remaining wear is negligible */
    double *before, *stiff; /* work vectors, one allocation: of a step, of the stiffness */
};

/* Adds a ring that starts at the state of the last one, or unworn; nodes are densest at `steep`. Errors:
 * FRET_GROSS_SLIP, FRET_NO_MEMORY, FRET_INTERRUPTED. */
fret_status fret_blocks_begin(fret_wear_run *run, fret_real inner, fret_real steep, fret_real outer);

/* Runs a block, or makes a wider ring. Errors, which leave the run as it was: those of fret_wear_after. */
fret_status fret_blocks_go_on(fret_wear_run *run);

/* The cycles run so far. */
double fret_blocks_reached(const fret_wear_run *run);

/* The ring at a number of cycles <= those run, its depths h, and in h[nodes] the work: cubic in a block. */
fret_annulus *fret_blocks_at(const fret_wear_run *run, double cycles, double *h);

void fret_blocks_free(fret_blocks *blocks);

#endif
