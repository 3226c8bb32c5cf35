/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The law of a shape without a closed form as polynomials, piece by piece: for many values of one contact.
 * Made once, only read afterwards. Not installed. */
#ifndef FRET_CONTACT_PIECES_H
#define FRET_CONTACT_PIECES_H

#include <stdbool.h>

#include "contact/normal.h"

struct fret_pieces;

/* Is it the law alone that is good, since it is made of rows that are not smooth, and the depth of a radius
 * off by more than `borne`? Then radii, and for borne = 0 slices of few rows, want the profile itself. */
bool fret_pieces_rough(const struct fret_pieces *pieces, double borne);

/* Does it go on row by row beyond the polynomials? */
bool fret_pieces_by_rows(const struct fret_pieces *pieces);

/* Each of these: false where the pieces do not reach, or would lose digits. */

/* The law at the depth, or the load, `value`, all but K. */
bool fret_pieces_point(const struct fret_pieces *pieces, bool by_force, fret_real value, fret_point *out);
/* g at the distance e from the start of the gap. */
bool fret_pieces_depth(const struct fret_pieces *pieces, fret_real e, fret_real *depth);
/* The slice inwards from `outer` whose thickness, or load, is `target`, beyond which `left` is left: its
 * thickness and its integrals. thin: with all digits of thin ones, which may take making rows; not for rates
 * that are integrated, smooth as polynomials are. */
bool fret_pieces_slice(const struct fret_pieces *pieces, const fret_level *outer, bool by_load, bool thin,
                       fret_real target, fret_real left, fret_real *h, fret_slice *out);

/* Of the same slice its load from its thickness, or its thickness from its load. */
bool fret_pieces_across(const struct fret_pieces *pieces, const fret_level *outer, bool by_load, bool thin,
                        fret_real target, fret_real *other);

/* The mean of F_N over depths. */
bool fret_pieces_mean(const struct fret_pieces *pieces, fret_real from, fret_real to, fret_real *mean);
/* What fret_phase_loss is to give, [0] where the phase begins, [1] where it ends, and how far it may be off:
 * more than `enough` of it where it is a small difference. */
bool fret_pieces_phase(const struct fret_pieces *pieces, bool by_load, const fret_real edge[2],
                       const fret_real front[2], fret_real enough, fret_real *out, fret_real *bound);

#endif
