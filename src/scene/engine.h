/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Models: what can answer for a scene, and those of them that step along a load. One table: the runner, `set
 * model`, `accuracy`, `explain` and `set timing` derive from it. Touches the mechanics alone. */
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

/* What has answered: bits of scene.used. */
#define USED(id) (1u << (id))
/* Another one: something that friction is a part of was asked for. */
#define ASKED_TANGENTIAL USED(MODELS)

typedef struct model_row {
    const char *name;  /* after `set model`, and where it is named */
    const char *title; /* for explain */
    const char *count; /* what its number means, as in `springs N`; NULL: it has none */
    bool chosen;       /* `set model` can ask for it */
    bool steps;        /* along any load; else it has a formula only */
} model_row;

extern const model_row models[MODELS];

/* A model on its way: a contact, or springs. */
typedef struct engine {
    fret_contact *contact;
    fret_springs *springs;
    fret_slips *slips; /* what slips is added to these, of who wants to know; or NULL */
    size_t begun;      /* how many there were at engine_mark */
    size_t closed[2];  /* of the last period: the first of them, and one beyond the last; none: both alike */
    unsigned times;    /* that period stands for so many */
    bool sine;         /* swinging loads are taken as they are */
    long double spent; /* dissipated since engine_mark, step by step: W may be far larger */
    long double more;  /* dissipated in periods that were not run: engine_repeat */
} engine;

/* The memory diagram; or so many springs, of the largest contact radius to come. */
fret_status engine_make(engine *e, const fret_normal *normal, double mu);
fret_status engine_springs(engine *e, const fret_normal *normal, double mu, unsigned count, double radius,
                           fret_weight rule);
void engine_end(engine *e);
fret_status engine_step(engine *e, const fret_step *step);
/* A step that stands for a part of a curve: as long as it goes from end to end, any path near it will do. */
fret_status engine_chord(engine *e, const fret_step *step);
void engine_state(const engine *e, fret_state *out);
void engine_forces(const engine *e, fret_state *out);
/* The step whose tangential target is one of delta_x + F_x/K_rig becomes one to the delta_x that ends there,
 * to rounding; where that is where it is now, one that keeps it. */
fret_status engine_at_rig(const engine *e, double K_rig, fret_step *step);
/* A copy made anew in `to`, of the same contact or cells. */
fret_status engine_copy(engine *to, const engine *from);
/* `times` more periods that begin and end in the present state, each with the loss. */
void engine_repeat(engine *e, unsigned times, long double loss);
/* A period of the sine itself, or the part from one of its times, 0..1, to another; FRET_OUTSIDE where the
 * contact cannot, nothing has changed. */
fret_status engine_swing(engine *e, const fret_sine *sine, double from, double to);
/* Slips are the caller's. */
fret_status engine_watch(engine *e, fret_slips *slips);
/* From here on engine_spent counts: a period begins; and has ended. */
void engine_mark(engine *e);
void engine_close(engine *e);
long double engine_spent(const engine *e);

#endif
