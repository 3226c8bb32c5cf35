/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A contact from inside, for fields. Not installed. */
#ifndef FRET_HISTORY_CONTACT_H
#define FRET_HISTORY_CONTACT_H

#include "fret/contact.h"

typedef struct fret_memory fret_memory;
typedef struct fret_diagram fret_diagram;
typedef struct fret_swing fret_swing;

/* One of memory and diagram; a swing once it has swung: then the memory is of before. */
struct fret_contact {
    const fret_normal *normal; /* borrowed */
    double mu;
    fret_memory *memory;   /* FRET_EXACT */
    fret_diagram *diagram; /* FRET_DOUBLE */
    fret_swing *swing;     /* room to swing in, or NULL */
    bool curved;
    fret_slips *slips; /* borrowed, or NULL */
};

#endif
