/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The inside of a contact, for this room and for fields. Not installed. */
#ifndef FRET_HISTORY_CONTACT_H
#define FRET_HISTORY_CONTACT_H

#include "fret/contact.h"

typedef struct fret_memory fret_memory;
typedef struct fret_diagram fret_diagram;
typedef struct fret_swing fret_swing;

/* A memory or a diagram; and a swing once a load has swung, which holds the state while `curved`. */
struct fret_contact {
    const fret_normal *normal; /* borrowed */
    double mu;
    fret_memory *memory;   /* FRET_EXACT */
    fret_diagram *diagram; /* FRET_DOUBLE */
    fret_swing *swing;     /* made by the first swinging load, or NULL */
    bool curved;
    fret_slips *slips; /* borrowed, or NULL */
};

#endif
