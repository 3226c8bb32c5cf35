/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The same load in scenes with other inputs, beside a run that is being looked at: their states at its
 * instants, one after the other. */
#ifndef LANGUAGE_BESIDE_H
#define LANGUAGE_BESIDE_H

#include "language/calc.h"

enum { SIDES = 16 };
typedef struct beside {
    watch looks;              /* of that run: watch_times */
    struct side *side[SIDES]; /* those made last */
    size_t made;
} beside;

/* What expressions are to see: the scene with these changes, given without them having been run, at this
 * time of its load. */
bool beside_scene(beside *b, const scene *changed, const knob_value by[], size_t count, double time,
                  scene **out, calc_error *error);
void beside_end(beside *b);

#endif
