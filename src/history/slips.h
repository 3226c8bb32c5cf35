/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The record of slip phases, kept while a contact is stepped. Not installed. */
#ifndef FRET_HISTORY_SLIPS_H
#define FRET_HISTORY_SLIPS_H

#include "fret/contact.h"

/* A phase of slip: a slip front moves inwards through one slope, and the springs outside it slip by mu eta
 * dm, dm = gain times the fall of the depth of the front. Front and edge move linearly in depth or in load.
 * GROSS: the front is at the centre, and the gain is the whole dm. */
typedef struct slip_phase {
    enum { LINEAR_IN_DEPTH, LINEAR_IN_LOAD, GROSS, SWUNG } kind;
    fret_real edge[2], front[2], gain;
    size_t swung; /* SWUNG: index into swung[]; the gain is 1 */
} slip_phase;

struct swung_phase; /* history/swing.h */

struct fret_slips {
    size_t count, room, swings, swing_room;
    slip_phase *phase;
    struct swung_phase *swung;
    bool failed; /* out of memory: the record is incomplete */
};

/* Appends a phase; does nothing if slips is NULL. */
void fret_slips_add(fret_slips *slips, const slip_phase *phase);

#endif
