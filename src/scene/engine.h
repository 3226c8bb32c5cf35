/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The models that can answer for a scene, and those of them that step along a load. One table: the runner,
 * `set model`, `accuracy`, `explain` and `set timing` derive from it. Touches the mechanics alone. */
#ifndef SCENE_ENGINE_H
#define SCENE_ENGINE_H

#include <stdbool.h>

#include "fret/fret.h"

typedef enum model_id {
    MODEL_CLOSED,
    MODEL_MEMORY,
    MODEL_QUADRATURE,
    MODEL_PIECES,
    MODEL_SPRINGS,
    MODEL_BLOCKS,
    MODELS,
    MODEL_AUTO = MODELS /* the closed form where there is one, else the memory diagram */
} model_id;

/* Bits of scene.used: the models that have answered. */
#define USED(id) (1u << (id))
/* Another bit of it: a result that depends on friction was asked for. */
#define ASKED_TANGENTIAL USED(MODELS)
/* And another: a largest pressure that the nodes of a worn gap do not resolve. */
#define ASKED_STEEP USED(MODELS + 1)

typedef struct model_row {
    const char *name;  /* the word of `set model`, also used in answers */
    const char *title; /* shown by explain */
    bool steps;        /* can step along any load; else it has a formula only */
} model_row;

extern const model_row models[MODELS];

/* A model at a state of a load: a memory diagram or springs. */
typedef struct engine {
    fret_contact *contact;
    fret_springs *springs;
    fret_slips *slips; /* phases of slip are recorded here; or NULL */
    size_t begun;      /* number of slips at engine_mark */
    size_t closed[2];  /* slips of the last period: first, and one beyond the last; equal: none */
    unsigned times;    /* number of equal periods that the last period stands for */
    bool sine;         /* harmonic loads are taken as sines, not as chords */
    long double spent; /* dissipated since engine_mark, summed by step (W may be far larger) */
    long double more;  /* dissipated in periods that were not run (engine_repeat) */
} engine;

/* Makes a memory diagram, or `count` springs out to `radius`, the largest contact radius to come. */
fret_status engine_make(engine *e, const fret_normal *normal, double mu);
fret_status engine_springs(engine *e, const fret_normal *normal, double mu, unsigned count, double radius,
                           fret_weight rule);
void engine_end(engine *e);
fret_status engine_step(engine *e, const fret_step *step);
/* A step along a chord of a curve: only its end points matter, so that springs need no intermediate steps. */
fret_status engine_chord(engine *e, const fret_step *step);
/* The state; forces: only F_N, dz, F_x, dx and W of it. */
void engine_state(const engine *e, fret_state *out);
void engine_forces(const engine *e, fret_state *out);
/* Turns a step to delta_x + F_x/K_rig into one to the delta_x with that value, to rounding; if that is the
 * present delta_x, into one that keeps it. */
fret_status engine_at_rig(const engine *e, double K_rig, fret_step *step);
/* Copies the state of `from` to `to`, whose contact has the same law or is NULL. */
fret_status engine_copy(engine *to, const engine *from);
/* Counts `times` more periods that begin and end in the present state, each with this loss. */
void engine_repeat(engine *e, unsigned times, long double loss);
/* A period of a harmonic load, or its part between two times in 0..1. FRET_OUTSIDE: the contact cannot take
 * it, and nothing has changed. */
fret_status engine_swing(engine *e, const fret_sine *sine, double from, double to);
/* Records phases of slip in `slips`, which the caller owns. */
fret_status engine_watch(engine *e, fret_slips *slips);
/* engine_mark starts a period, from which engine_spent counts; engine_close ends it. */
void engine_mark(engine *e);
void engine_close(engine *e);
long double engine_spent(const engine *e);

#endif
