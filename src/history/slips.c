/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The record of slip phases. Allocates it. */
#include "history/slips.h"

#include <stdlib.h>

#include "law/check.h"
#include "number/array.h"

fret_status fret_slips_make(fret_slips **out) {
    *out = calloc(1, sizeof **out);
    return *out ? fret_ok() : fret_fail(FRET_NO_MEMORY, NULL, 0, 0);
}

void fret_slips_free(fret_slips *s) {
    if (!s)
        return;
    free(s->phase);
    free(s->swung);
    free(s);
}

void fret_slips_clear(fret_slips *s) {
    s->count = s->swings = 0;
    s->failed = false;
}

size_t fret_slips_count(const fret_slips *s) {
    return s->count;
}

void fret_slips_repeat(fret_slips *s, size_t first, double times) {
    for (size_t i = first; i < s->count; i++)
        s->phase[i].gain *= 1 + (fret_real)times;
}

void fret_slips_add(fret_slips *s, const slip_phase *phase) {
    if (!s)
        return;
    s->failed |= !fret_array_room(&s->phase, &s->room, s->count + 1, sizeof *s->phase);
    if (!s->failed)
        s->phase[s->count++] = *phase;
}
