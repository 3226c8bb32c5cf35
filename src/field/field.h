/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A field from inside. Not installed. */
#ifndef FRET_FIELD_FIELD_H
#define FRET_FIELD_FIELD_H

#include "field/kernel.h"
#include "field/ring.h"
#include "fret/field.h"
#include "history/contact.h"
#include "history/swing.h"

struct fret_field {
    const fret_normal *normal;    /* borrowed */
    fret_real of_slope, of_depth; /* what fields are of the sums of ring.h */
    double mu;
    int loads;            /* sums that are wanted: of what is only pressed one */
    size_t slices, heads; /* heads: those that end within the head */
    slice *slice;
    fret_real head, head_depth; /* the radius up to which depth is a sum of powers, and g there */
    fret_real punch[LOADS];     /* depth of what no radius tells from a flat punch */
    const slice *end;           /* of fret_field_cut, whose rings end there; or NULL */
    flat_field flat;
    size_t sums;
    rings *sum[FRET_GAP_TERMS]; /* of what lies beyond the head, or of steep powers */
    fret_swing swung;           /* curved arcs; none: count 0 */
    fret_real dx, slid;         /* delta_x, and what gross slip has of it */
};

/* The same to be pressed less deep, of one that is only pressed: borrows all of it, and `end`, which it sets.
 * To be asked once it is cut, not to be freed. */
void fret_field_part(const fret_field *field, slice *end, fret_field *out);
void fret_field_cut(const fret_field *field, fret_real depth, fret_field *part);
/* Do all contacts that hold r press infinitely there? */
bool fret_field_infinite(const fret_normal *normal, fret_real r);
/* By how much of its depth the surface at r has not followed: depth - u_z(r); f(r) within. */
fret_status fret_field_left(const fret_field *field, fret_real r, fret_real *left);

/* What curved arcs add to the sums: int sigma times the field of a flat punch dy along them; factor: what
 * turns depth sums into surfaces. */
fret_real fret_swing_slope(const fret_swing *swing, fret_real r);
fret_real fret_swing_surface(const fret_swing *swing, const flat_field *flat, fret_real factor, fret_real r);

#endif
