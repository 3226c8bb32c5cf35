/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Blocks of cycles. Not installed. */
#ifndef FRET_WEAR_BLOCKS_H
#define FRET_WEAR_BLOCKS_H

#include "wear/annulus.h"

/* From the depths h [count], and at [count] the work, `cycles` on. full: whether the contact has come to the
 * last node, where it stops. Errors: FRET_GROSS_SLIP, FRET_NO_MEMORY, FRET_INTERRUPTED. */
fret_status fret_blocks_run(fret_annulus *annulus, double *h, double cycles, double tolerance, fret_stop stop,
                            fret_wear_told told, void *user, bool *full);

#endif
