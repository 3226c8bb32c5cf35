/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The foundation in double-doubles. Not installed. */
#ifndef FRET_LAW_MATERIAL_H
#define FRET_LAW_MATERIAL_H

#include "fret/material.h"
#include "number/dd.h"

/* The moduli to 100 bits, since 1 - F_x/(mu F_N) near gross slip uses up the 64 of long double. */
typedef struct fret_wide_foundation {
    dd cN0, eta; /* cN0: c_N0/2^scale */
    int scale;
} fret_wide_foundation;

/* As fret_foundation_make; also gives the moduli in full. */
fret_status fret_foundation_make_wide(const fret_material *material, fret_foundation *out,
                                      fret_wide_foundation *wide);

#endif
