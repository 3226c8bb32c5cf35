/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The exact memory diagram from inside, for what follows its curve. Not installed. */
#ifndef FRET_HISTORY_MEMORY_H
#define FRET_HISTORY_MEMORY_H

#include "fret/memory.h"

#define NUMBER fret_real
#define DIAGRAM fret_memory
#define FUNCTION(f) f##l
#define POWER fret_pow
#include "history/diagram_type.h"
#include "history/steps.h"

/* The edge with its radius, and all digits. */
fret_press fret_memory_pressed(const fret_memory *memory);

/* Room for `count` layers. Error: FRET_NO_MEMORY. */
fret_status fret_memory_reserve(fret_memory *memory, size_t count);

/* The outer end of layer i. */
static inline const point *fret_memory_outer(const fret_memory *m, size_t i) {
    return i + 1 < m->count ? &m->layers[i + 1].inner : &m->edge;
}

/* Gross slip while the edge moves from one depth to another: the mean of F_N [N]. */
fret_real fret_memory_mean_force(const fret_memory *memory, fret_real from, fret_real to);

#endif
