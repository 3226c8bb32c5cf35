/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The table of named materials, with their sources. Touches no scene. */
#ifndef SCENE_PRESETS_H
#define SCENE_PRESETS_H

#include <stddef.h>

typedef struct preset {
    const char *name;
    double E0, nu;
    double yield; /* yield stress [Pa] of the grade that the source names; 0: none */
    const char *source;
} preset;

const preset *preset_row(size_t i); /* NULL after the last */
const char *preset_name(size_t i);
/* Writes the row as "E0=210 GPa nu=0.3". */
enum { PRESET_NUMBERS = 64 };
void preset_numbers(const preset *p, char text[PRESET_NUMBERS]);
/* The words that `second` takes: same, rigid, then the presets. */
enum { SECOND_WORDS = 2 };
const char *second_name(size_t i);

#endif
