/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The limit of wear in closed form. Not installed. */
#ifndef FRET_WEAR_LIMIT_H
#define FRET_WEAR_LIMIT_H

#include "field/field.h"
#include "fret/wear.h"

/* The depth y, radius c and normal force F of what sticks in the end; delta_z; the rim b of the worn ring. */
typedef struct fret_wear_end {
    const fret_normal *normal; /* borrowed */
    fret_real y, c, F, depth, b;
    fret_field *field; /* the pressed field at the depth y */
} fret_wear_end;

/* Errors: those of fret_wear_limit; FRET_GROSS_SLIP: nothing sticks in the end, so there is no limit. */
fret_status fret_wear_end_make(const fret_normal *normal, const fret_wear_held *held, fret_wear_end *out);
void fret_wear_end_free(fret_wear_end *end);

/* The worn depth at r [m], and the volume [m^3]. */
fret_status fret_wear_end_depth(const fret_wear_end *end, fret_real r, fret_real *h);
fret_status fret_wear_end_volume(const fret_wear_end *end, fret_real *volume);

#endif
