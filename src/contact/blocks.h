/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The rows of a table in blocks, each made when it is first asked for. May be asked from many threads; no
 * digit depends on what was asked before. Not installed. */
#ifndef FRET_CONTACT_BLOCKS_H
#define FRET_CONTACT_BLOCKS_H

#include "contact/piece.h"
#include "contact/rows.h"

struct fret_blocks;

/* Up to the distance e. at_once: all rows as one block, made here. error: that of the law by them, as of
 * fret_rows_make, of one block; where it is not NULL, no block is used that is off by more than `enough`. The
 * table must outlive it, the contact need not. NULL in `out` where no row begins there. Errors:
 * FRET_NO_MEMORY, FRET_INTERRUPTED. */
fret_status fret_blocks_make(const fret_normal *normal, fret_real e, bool at_once, fret_real enough,
                             struct fret_blocks **out, fret_real *error);
void fret_blocks_free(struct fret_blocks *blocks);

/* Each of these: false also where `stop` is set, or memory runs out. */
typedef struct fret_place {
    const struct fret_rows *rows;
    size_t block;
    fret_spot spot;
} fret_place;

/* As fret_rows_find. */
bool fret_blocks_find(struct fret_blocks *blocks, fret_stop stop, fret_spot_by by, fret_real value,
                      fret_place *out);
bool fret_blocks_inner(struct fret_blocks *blocks, fret_stop stop, fret_place *out);

/* As fret_rows_drop. */
bool fret_blocks_drop(struct fret_blocks *blocks, fret_stop stop, fret_spot_by by, const fret_place *outer,
                      fret_real drop, fret_place *out);

/* Where the rows begin: its distance, depth or load. */
fret_real fret_blocks_begin(const struct fret_blocks *blocks, fret_spot_by by);

/* As fret_rows_fall and fret_rows_between. */
fret_real fret_blocks_fall(const struct fret_blocks *blocks, int by, const fret_place *outer,
                           const fret_place *inner);
bool fret_blocks_between(struct fret_blocks *blocks, fret_stop stop, const fret_place *outer,
                         const fret_place *inner, stretch *sum);

#endif
