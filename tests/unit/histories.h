/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The parts of contacts, for tests that look within. */
#ifndef HISTORIES_H
#define HISTORIES_H

#include "history/contact.h"
#include "history/diagram.h"
#include "history/swing.h"

/* A contact that holds a memory, which it does not own. */
#define CONTACT_OF(m) (&(const fret_contact){.normal = (m)->normal, .mu = (m)->mu, .memory = (m)})

/* The same of one that has swung. */
#define SWUNG(s) (&(const fret_contact){.normal = (s)->normal, .mu = (s)->mu, .swing = (s), .curved = true})

static inline bool same_state(const fret_state *a, const fret_state *b) {
    return a->FN == b->FN && a->dz == b->dz && a->a == b->a && a->Fx == b->Fx && a->dx == b->dx &&
           a->c == b->c && a->W == b->W && a->U == b->U && a->kn == b->kn && a->kt == b->kt &&
           a->slices == b->slices;
}

#endif
