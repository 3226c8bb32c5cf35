/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The closed forms for arrays of scenes, in blocks, once for each instruction set. Pure. */
#include "fast/scenes.h"

#include <float.h>
#include <math.h>

#include "fast/batch.h"
#include "number/bits.h"
#include "number/constants.h"
#include "number/processor.h"

#define LANES_ALSO "fast/scenes_body.h"
#define LANES 2
#include "number/lanes.h"
#ifdef __x86_64__
#define LANES 4
#include "number/lanes.h"
#define LANES 8
#include "number/lanes.h"
#endif

#define VARIANT(set, lanes, target)                                                                          \
    target static void set##_run(fret_scene_block *b) {                                                      \
        for (size_t i = 0; i < b->count; i += sizeof(lanes##_numbers) / sizeof(double))                      \
            lanes##_scene(b, i);                                                                             \
    }
#define ROW(set)                                                                                             \
    { #set, fret_runs_##set, set##_run }

#ifdef __x86_64__
VARIANT(avx512, lanes8, FRET_AVX512) /* unreached: not every processor has it */
VARIANT(avx2, lanes4, FRET_AVX2)
#endif

VARIANT(plain, lanes2, )
const fret_scene_variant fret_scene_variants[] = {
#ifdef __x86_64__
    ROW(avx512),
    ROW(avx2),
#endif
    ROW(plain),
};
const size_t fret_scene_variant_count = sizeof fret_scene_variants / sizeof *fret_scene_variants;

static const fret_scene_variant *best(void) {
    return &fret_scene_variants[fret_best_variant()];
}

/* What is left of a block holds numbers that make no trouble. */
static void fill(fret_scene_block *b, const fret_scenes *s, size_t first, size_t count) {
    const double *const from[SCENE_INPUTS] = {
        [SCENE_E0] = s->E0[0],
        [SCENE_NU] = s->nu[0],
        [SCENE_E0_2] = b->alike || b->rigid ? s->E0[0] : s->E0[1],
        [SCENE_NU_2] = b->alike || b->rigid ? s->nu[0] : s->nu[1],
        [SCENE_K] = s->k,
        [SCENE_C0] = s->c0,
        [SCENE_N] = s->n,
        [SCENE_H] = s->h,
        [SCENE_R0] = s->r0,
        [SCENE_F] = s->F,
        [SCENE_MU] = s->mu,
        [SCENE_FX] = s->Fx,
    };
    b->count = count;
    for (int i = 0; i < SCENE_INPUTS; i++)
        for (size_t j = 0; j < FRET_SCENE_BLOCK; j++)
            b->in[i][j] = from[i] ? from[i][first + (j < count ? j : 0)] : 0;
}

bool fret_batch_scenes(const fret_scenes *s, const fret_scene_values *out, size_t count) {
    const fret_scene_variant *v = best();
    fret_scene_block b = {.alike = !s->rigid && !s->E0[1], .rigid = s->rigid, .pushed = s->Fx};
    double *const to[SCENE_OUTPUTS] = {
        [SCENE_HN] = out->hN,   [SCENE_HT] = out->hT,    [SCENE_BETA] = out->beta,   [SCENE_CN0] = out->cN0,
        [SCENE_CT0] = out->cT0, [SCENE_ETA] = out->eta,  [SCENE_KAPPA] = out->kappa, [SCENE_A] = out->a,
        [SCENE_DZ] = out->dz,   [SCENE_KN] = out->kn,    [SCENE_SLIP] = out->slip,   [SCENE_C] = out->c,
        [SCENE_DX] = out->dx,   [SCENE_LOSS] = out->loss};
    bool missing = false;
    for (size_t i = 0; i < count; i += FRET_SCENE_BLOCK) {
        const size_t n = count - i < FRET_SCENE_BLOCK ? count - i : FRET_SCENE_BLOCK;
        fill(&b, s, i, n);
        v->run(&b);
        for (int j = 0; j < SCENE_OUTPUTS; j++)
            for (size_t r = 0; to[j] && r < n; r++) {
                to[j][i + r] = b.out[j][r];
                missing |= isnan(b.out[j][r]);
            }
    }
    return missing;
}
