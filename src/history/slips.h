/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What slips, as it is kept while a contact is stepped. Not installed. */
#ifndef FRET_HISTORY_SLIPS_H
#define FRET_HISTORY_SLIPS_H

#include "fret/contact.h"

/* A front of slip on its way inwards through one slope: springs outside it slip by mu eta dm, dm = gain times
 * the fall of its depth. Front and edge go evenly, by depth or by load. Gross slip: the front is at the
 * centre, and dm comes to the gain. */
typedef struct slip_phase {
    enum { BY_DEPTHS, BY_LOADS, GROSS, SWUNG } kind;
    fret_real edge[2], front[2], gain;
    size_t swung; /* of a swinging load, whose gain is 1: number among those */
} slip_phase;

struct swung_phase; /* history/swing.h */

struct fret_slips {
    size_t count, room, swings, swing_room;
    slip_phase *phase;
    struct swung_phase *swung;
    bool failed; /* out of memory: something is missing */
};

/* Nothing where slips is NULL. */
void fret_slips_add(fret_slips *slips, const slip_phase *phase);

#endif
