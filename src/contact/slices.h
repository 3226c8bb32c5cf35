/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The slices of a memory diagram, for the files of its steps. Not installed. */
#ifndef FRET_CONTACT_SLICES_H
#define FRET_CONTACT_SLICES_H

#include <math.h>

#include "contact/memory.h"
#include "number/dd.h"

static inline void resum(slice *s, bool innermost) {
    for (coordinate by = DEPTH; by <= LOAD; by++)
        s->sum[by] = s->sigma * s->thick[by] + (innermost ? 0 : s[-1].sum[by]);
}

static inline void resum_top(fret_memory *m) {
    resum(&m->slices[m->count - 1], m->count == 1);
}

/* Slopes that differ by less than `rounding` merge, else a ramp in many small steps would pile up slices;
 * the mean keeps F_x. */
static inline void push(fret_memory *m, const fret_real thick[2], const fret_real inner[2], fret_real sigma,
                        fret_real rounding) {
    slice *top = &m->slices[m->count ? m->count - 1 : 0];
    if (m->count && fabsl(top->sigma - sigma) <= rounding && (fabsl(sigma) < 1) == (fabsl(top->sigma) < 1)) {
        fret_real both = top->thick[LOAD] + thick[LOAD];
        if (both > 0 && fabsl(sigma) < 1)
            top->sigma = (top->sigma * top->thick[LOAD] + sigma * thick[LOAD]) / both;
        top->thick[DEPTH] += thick[DEPTH];
        top->thick[LOAD] = both;
    } else {
        slice *added = &m->slices[m->count++];
        for (coordinate i = DEPTH; i <= LOAD; i++) {
            added->thick[i] = thick[i];
            added->inner[i] = inner[i];
        }
        added->sigma = sigma;
        added->edge = 0;
    }
    resum_top(m);
}

/* Close to gross slip of sense s the part that sticks is far smaller than the contact. It is told by the
 * distance of F_x from mu F_N, or of delta_x from delta_x,max, taken with all digits: how thick is the slice
 * i, where the front ends? */
static inline fret_real thick_at_brink(const fret_memory *m, size_t i, coordinate by, fret_real s, dd left) {
    const slice *end = &m->slices[i];
    const fret_real inside = i ? end->inner[by] - s * end[-1].sum[by] : 0;
    return fret_greater((dd_value(left) - inside) / (1 - s * end->sigma), 0);
}

static inline fret_real inner_of(const fret_memory *m, size_t i, coordinate by) {
    return i ? m->slices[i].inner[by] : 0;
}

/* Tangential step at constant normal load, to F_x or delta_x = goal. Returns what it dissipates, per mu^2
 * eta. */
fret_real fret_memory_slip(fret_memory *memory, coordinate by, fret_real drive, double goal);

#endif
