/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What several files ask of the state of the full-screen mode, and numbers as text. Runs no statement. */
#include "live/state.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>

#include "text/characters.h"

void live_tell(live *l, bool bad, const char *format, ...) {
    char text[LIVE_LINE];
    va_list args;
    va_start(args, format);
    vsnprintf(text, sizeof text, format, args);
    va_end(args);
    characters_shown(text, l->status, sizeof l->status);
    l->bad = bad;
    l->changed = true;
}

double live_nice(double v) {
    const double ten = pow(10, floor(log10(v))), part = v / ten;
    return ten * (part < 1.5 ? 1 : part < 3.5 ? 2 : part < 7.5 ? 5 : 10);
}

void live_amount(double v, dim d, char *text, size_t size) {
    calc_amount(d, v, 3, text, size);
}

size_t live_sides(const live *l) {
    return l->compared.on ? COMPARED : 1;
}

const side *side_first(const live *l) {
    return &l->side[l->compared.on && *l->side[0].trouble];
}
