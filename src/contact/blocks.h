/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The rows of a large table in blocks, each made when it is first asked for: for slices thinner than the
 * polynomials of many rows together have digits for. Not installed. */
#ifndef FRET_CONTACT_BLOCKS_H
#define FRET_CONTACT_BLOCKS_H

#include "contact/piece.h"

struct fret_blocks;

/* Up to the distance e; the table must outlive it, the contact need not. NULL in `out` where no row begins
 * there. Error: FRET_NO_MEMORY. */
fret_status fret_blocks_make(const fret_normal *normal, fret_real e, struct fret_blocks **out);
void fret_blocks_free(struct fret_blocks *blocks);

/* The slice that begins at the depth or load `outer`, in which this drops by `drop`: its sums, K at its inner
 * end, and by how much the other drops. False where it ends before the rows, or where memory does. May be
 * asked from many threads. */
bool fret_blocks_slice(struct fret_blocks *blocks, bool by_load, fret_real outer, fret_real drop,
                       stretch *sum, fret_real *K, fret_real *other);

#endif
