/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The loops of fret/scenes.h for each instruction set. Not installed. */
#ifndef FRET_FAST_SCENES_H
#define FRET_FAST_SCENES_H

#include "fret/scenes.h"

enum { FRET_SCENE_BLOCK = 64 };

/* Columns of a block, so that a group of any width is whole. */
typedef enum fret_scene_input {
    SCENE_E0,
    SCENE_NU,
    SCENE_E0_2,
    SCENE_NU_2,
    SCENE_K,
    SCENE_C0,
    SCENE_N,
    SCENE_H,
    SCENE_R0,
    SCENE_F,
    SCENE_MU,
    SCENE_FX,
    SCENE_INPUTS
} fret_scene_input;

typedef enum fret_scene_output {
    SCENE_HN,
    SCENE_HT,
    SCENE_BETA,
    SCENE_CN0,
    SCENE_CT0,
    SCENE_ETA,
    SCENE_KAPPA,
    SCENE_A,
    SCENE_DZ,
    SCENE_KN,
    SCENE_SLIP,
    SCENE_C,
    SCENE_DX,
    SCENE_LOSS,
    SCENE_OUTPUTS
} fret_scene_output;

typedef struct fret_scene_block {
    size_t count;
    bool alike, rigid; /* the second body is as the first, or is rigid */
    bool pushed;       /* there is F_x */
    double in[SCENE_INPUTS][FRET_SCENE_BLOCK];
    double out[SCENE_OUTPUTS][FRET_SCENE_BLOCK];
} fret_scene_block;

typedef struct fret_scene_variant {
    const char *name;
    bool (*runs)(void);
    void (*run)(fret_scene_block *b);
} fret_scene_variant;

/* The best first; the last one runs everywhere. */
extern const fret_scene_variant fret_scene_variants[];
extern const size_t fret_scene_variant_count;

#endif
