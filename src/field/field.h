/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The structure of a field, for the files of this room and for `wear`. Not installed. */
#ifndef FRET_FIELD_FIELD_H
#define FRET_FIELD_FIELD_H

#include "field/kernel.h"
#include "field/ring.h"
#include "fret/field.h"
#include "history/contact.h"
#include "history/swing.h"

struct fret_field {
    const fret_normal *normal;    /* borrowed */
    fret_real of_slope, of_depth; /* factors from the sums of ring.h to pressure [Pa] and displacement [m] */
    double mu;
    int loads;            /* 1: normal sums only, of a press; LOADS: tangential ones too */
    size_t slices, heads; /* heads: number of slices that end within the head */
    slice *slice;
    fret_real head, head_depth; /* radius up to which g is a sum of powers, and g there */
    fret_real punch[LOADS];     /* sum of weighted depths of slices whose radius rounds to the flat end */
    const slice *end;           /* slice that replaces all others (fret_field_cut), or NULL */
    flat_field flat;
    size_t sums;
    rings *sum[FRET_GAP_TERMS]; /* the cells beyond the head, and each steep power */
    fret_swing swung;           /* curved arcs after a harmonic load; count 0: none */
    fret_real dx, slid;         /* delta_x, and the part of it that is gross slip */
};

/* Makes `out` a view of a pressed field that fret_field_cut can set to any smaller depth. The view borrows
 * `field` and `end`; do not free it, and do not evaluate it before the first cut. */
void fret_field_part(const fret_field *field, slice *end, fret_field *out);
void fret_field_cut(const fret_field *field, fret_real depth, fret_field *part);
/* Is the pressure at r infinite in every contact that reaches r (sharp edge, tip, or edge of a punch)? */
bool fret_field_infinite(const fret_normal *normal, fret_real r);
/* left = depth - u_z(r) [m], which is f(r) inside the contact. */
fret_status fret_field_left(const fret_field *field, fret_real r, fret_real *left);

/* The share of curved arcs in the sums: the integral along them of sigma dy times the field of a flat
 * punch. factor: fret_field.of_depth, from depth sums to displacements. */
fret_real fret_swing_slope(const fret_swing *swing, fret_real r);
fret_real fret_swing_surface(const fret_swing *swing, const flat_field *flat, fret_real factor, fret_real r);

#endif
