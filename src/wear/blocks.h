/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A run of wear, block by block of cycles. Not installed. */
#ifndef FRET_WEAR_BLOCKS_H
#define FRET_WEAR_BLOCKS_H

#include "wear/annulus.h"

/* What has been run in one ring: rows of cycles, depths with the work, and their rates, one at each end of a
 * block. */
typedef struct fret_blocks {
    fret_annulus ring;
    size_t count, room;
    double *row;
} fret_blocks;

struct fret_wear_run {
    const fret_normal *normal; /* borrowed */
    fret_wear_held held;
    double tolerance;
    size_t nodes, count, room; /* of each ring; rings, ever wider */
    fret_blocks *blocks;
    double step, fastest;   /* cycles of the next block; the fastest decay */
    long rates, tried;      /* so far; blocks of the last ring */
    bool arrived;           /* the rest would wear next to nothing */
    double *before, *stiff; /* vectors, in one piece: scratch of a step, of the fastest decay */
};

/* A ring from where the last one has come to, or the first; nodes are closest at `steep`. Errors:
 * FRET_GROSS_SLIP, FRET_NO_MEMORY, FRET_INTERRUPTED. */
fret_status fret_blocks_begin(fret_wear_run *run, fret_real inner, fret_real steep, fret_real outer);

/* One block further, or a wider ring. Errors, after which it is as before: as of fret_wear_after. */
fret_status fret_blocks_go_on(fret_wear_run *run);

/* How far it has come. */
double fret_blocks_reached(const fret_wear_run *run);

/* The ring at so many cycles, at most those, and depths there, at [nodes] the work: between the ends of a
 * block cubic. */
fret_annulus *fret_blocks_at(const fret_wear_run *run, double cycles, double *h);

void fret_blocks_free(fret_blocks *blocks);

#endif
