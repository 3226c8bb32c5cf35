/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The table of materials: moduli and yield stresses at room temperature, as in handbooks. Uses `text`. */
#include "scene/presets.h"

#include <stdio.h>

#include "text/words.h"

static const char callister[] = "Callister, Materials Science and Engineering, appendix B";

static const preset presets[] = {
    {"steel", 210e9, 0.3, 0, "EN 1993-1-1, 3.2.6"},
    {"aluminium", 70e9, 0.33, 0, "EN 1999-1-1, 3.2.5"},
    {"aluminum", 70e9, 0.33, 0, "EN 1999-1-1, 3.2.5"},
    {"titanium", 114e9, 0.34, 0, callister},
    {"Ti-6Al-4V", 114e9, 0.34, 830e6, "Callister, Materials Science and Engineering, appendix B: annealed"},
    {"Inconel", 208e9, 0.29, 1034e6, "makers' data sheets of Inconel 718, aged: AMS 5662"},
    {"copper", 120e9, 0.34, 0, callister},
    {"bronze", 110e9, 0.34, 0, callister},
    {"glass", 70e9, 0.22, 0, callister},
    {"alumina", 370e9, 0.22, 0, callister},
    {"silicon-nitride", 304e9, 0.3, 0, callister},
    {"tungsten-carbide", 630e9, 0.22, 0, "makers' data sheets, 6 % cobalt"},
    {"S355", 210e9, 0.3, 355e6, "EN 1993-1-1, 3.2.6 and table 3.1: S355, up to 40 mm"},
    {"PTFE", 0.5e9, 0.46, 0, callister},
    {"rubber", 5e6, 0.5, 0, "incompressible, of medium hardness"},
};
enum { PRESETS = sizeof presets / sizeof *presets };

const preset *preset_row(size_t i) {
    return i < PRESETS ? &presets[i] : NULL;
}

const char *preset_name(size_t i) {
    return i < PRESETS ? presets[i].name : NULL;
}

void preset_numbers(const preset *p, char text[PRESET_NUMBERS]) {
    snprintf(text, PRESET_NUMBERS, "E0=%.10g GPa nu=%.10g", p->E0 / 1e9, p->nu);
    if (p->yield > 0)
        text_add(text, PRESET_NUMBERS, ", yield %.10g MPa", p->yield / 1e6);
}

const char *second_name(size_t i) {
    static const char *const others[SECOND_WORDS] = {"same", "rigid"};
    return i < SECOND_WORDS ? others[i] : preset_name(i - SECOND_WORDS);
}
