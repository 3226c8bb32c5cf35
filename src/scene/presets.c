/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The table of materials: moduli at room temperature, as handbooks round them. */
#include "scene/presets.h"

static const char callister[] = "Callister, Materials Science and Engineering, appendix B";

static const preset presets[] = {
    {"steel", 210e9, 0.3, "EN 1993-1-1, 3.2.6"},
    {"aluminium", 70e9, 0.33, "EN 1999-1-1, 3.2.5"},
    {"aluminum", 70e9, 0.33, "EN 1999-1-1, 3.2.5"},
    {"titanium", 114e9, 0.34, callister},
    {"Ti-6Al-4V", 114e9, 0.34, callister},
    {"Inconel", 208e9, 0.29, "makers' data sheets of Inconel 718"},
    {"copper", 120e9, 0.34, callister},
    {"bronze", 110e9, 0.34, callister},
    {"glass", 70e9, 0.22, callister},
    {"alumina", 370e9, 0.22, callister},
    {"silicon-nitride", 304e9, 0.3, callister},
    {"tungsten-carbide", 630e9, 0.22, "makers' data sheets, 6 % cobalt"},
    {"PTFE", 0.5e9, 0.46, callister},
    {"rubber", 5e6, 0.5, "incompressible, of medium hardness"},
};
enum { PRESETS = sizeof presets / sizeof *presets };

const preset *preset_row(size_t i) {
    return i < PRESETS ? &presets[i] : NULL;
}

const char *preset_name(size_t i) {
    return i < PRESETS ? presets[i].name : NULL;
}

const char *second_name(size_t i) {
    static const char *const others[SECOND_WORDS] = {"same", "rigid"};
    return i < SECOND_WORDS ? others[i] : preset_name(i - SECOND_WORDS);
}
