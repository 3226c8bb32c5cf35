/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The foundation to more digits than its public face. Not installed. */
#ifndef FRET_LAW_MATERIAL_H
#define FRET_LAW_MATERIAL_H

#include "fret/material.h"
#include "number/dd.h"

/* To 100 bits, where 64 would be spent near a limit, as 1 - F_x/(mu F_N) is. */
typedef struct fret_wide_foundation {
    dd cN0, eta; /* c_N0/2^scale */
    int scale;
} fret_wide_foundation;

/* fret_foundation_make, and the same in full. */
fret_status fret_foundation_make_wide(const fret_material *material, fret_foundation *out,
                                      fret_wide_foundation *wide);

#endif
