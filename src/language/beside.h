/* SPDX-License-Identifier: GPL-3.0-or-later */
/* States of scenes with other inputs at the instants of a run that is being looked at. */
#ifndef LANGUAGE_BESIDE_H
#define LANGUAGE_BESIDE_H

#include "language/calc.h"

enum { SIDES = 16 };
typedef struct beside {
    struct side *side[SIDES]; /* cache of the last ones made */
    size_t made;
} beside;

/* Sets *out to the scene with these changes at this time of its load. changed: that scene, not run yet. */
bool beside_scene(beside *b, const scene *changed, const knob_value by[], size_t count, double time,
                  scene **out, calc_error *error);
void beside_end(beside *b);

#endif
