/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The table of models and how they step. */
#include "calc/engine.h"

#include <stdlib.h>

static fret_status memory_make(const fret_normal *normal, double mu, unsigned count, double radius,
                               void **out) {
    fret_memory *m = NULL;
    fret_status st = fret_memory_make(normal, mu, &m);
    (void)count, (void)radius;
    *out = m;
    return st;
}

static fret_status memory_step(void *self, const fret_step *step) {
    return fret_memory_step(self, step);
}

static fret_status memory_copy(void *to, const void *from) {
    return fret_memory_copy(to, from);
}

static void memory_state(const void *self, fret_state *out) {
    fret_memory_state(self, out);
}

static void memory_forces(const void *self, fret_state *out) {
    fret_memory_forces(self, out);
}

static long double memory_last_loss(const void *self) {
    return fret_memory_last_loss(self);
}

static void memory_end(void *self) {
    fret_memory_free(self);
}

static fret_status springs_make(const fret_normal *normal, double mu, unsigned count, double radius,
                                void **out) {
    fret_springs *s = NULL;
    fret_status st = fret_springs_make(normal, mu, count, radius, FRET_WEIGHT_CELL, &s);
    *out = s;
    return st;
}

/* A ramp by force that changes F_N is no straight line for the springs: 64 parts, an error of 1e-8. */
static fret_status springs_step(void *self, const fret_step *step) {
    bool ramp = step->normal_by != FRET_KEEP_NORMAL && step->tangential_by == FRET_TO_FX;
    return fret_springs_step(self, step, ramp ? 64 : 1);
}

static fret_status springs_chord(void *self, const fret_step *step) {
    return fret_springs_step(self, step, 1);
}

static void springs_state(const void *self, fret_state *out) {
    fret_springs_state(self, out);
}

static void springs_end(void *self) {
    fret_springs_free(self);
}

static fret_status diagram_make(const fret_normal *normal, double mu, unsigned count, double radius,
                                void **out) {
    fret_diagram *d = NULL;
    fret_status st = fret_diagram_make(normal, mu, 0, &d);
    (void)count, (void)radius;
    *out = d;
    return st;
}

static fret_status diagram_step(void *self, const fret_step *step) {
    return fret_diagram_step(self, step);
}

static void diagram_state(const void *self, fret_state *out) {
    fret_diagram_state(self, out);
}

static void diagram_forces(const void *self, fret_state *out) {
    fret_diagram_now now;
    fret_diagram_forces(self, &now);
    *out = (fret_state){.FN = now.FN, .dz = now.dz, .Fx = now.Fx, .dx = now.dx, .W = now.W};
}

static long double diagram_last_loss(const void *self) {
    fret_diagram_now now;
    fret_diagram_forces(self, &now);
    return now.last_loss;
}

static void diagram_end(void *self) {
    fret_diagram_free(self);
}

const model_row models[MODELS] = {
    [MODEL_CLOSED] = {.name = "closed", .title = "closed form", .chosen = true},
    [MODEL_MEMORY] = {.name = "memory",
                      .title = "memory diagram",
                      .chosen = true,
                      .make = memory_make,
                      .step = memory_step,
                      .copy = memory_copy,
                      .state = memory_state,
                      .forces = memory_forces,
                      .last_loss = memory_last_loss,
                      .end = memory_end},
    [MODEL_QUADRATURE] = {.name = "quadrature", .title = "quadrature"},
    [MODEL_PIECES] = {.name = "polynomials", .title = "polynomials"},
    [MODEL_SPRINGS] = {.name = "springs",
                       .title = "springs",
                       .count = "the number of springs",
                       .chosen = true,
                       .make = springs_make,
                       .step = springs_step,
                       .chord = springs_chord,
                       .state = springs_state,
                       .forces = springs_state,
                       .end = springs_end},
    [MODEL_VECTORS] = {.name = "vectors", .title = "vectors to 2e-15"},
    [MODEL_DOUBLE] = {.name = "double",
                      .title = "memory diagram in double, to 3e-14",
                      .chosen = true,
                      .power = true,
                      .rounding = 3e-14,
                      .make = diagram_make,
                      .step = diagram_step,
                      .state = diagram_state,
                      .forces = diagram_forces,
                      .last_loss = diagram_last_loss,
                      .end = diagram_end},
};

/* ---- the sine itself --------------------------------------------------------------------------- */

/* A memory until something swings. */
typedef struct sine {
    fret_memory *memory; /* from then on to be shown only */
    fret_swing *swing;   /* or NULL */
    bool shown;          /* memory is up to date */
} sine;

static const fret_status no_memory = {FRET_NO_MEMORY, NULL, 0, 0};

static void sine_end(void *self) {
    sine *s = self;
    fret_memory_free(s->memory);
    fret_swing_free(s->swing);
    free(s);
}

static fret_status sine_make(const fret_normal *normal, double mu, unsigned count, double radius,
                             void **out) {
    sine *s = calloc(1, sizeof *s);
    (void)count, (void)radius;
    const fret_status st = s ? fret_memory_make(normal, mu, &s->memory) : no_memory;
    if (st.code)
        free(s);
    else
        *out = s;
    return st;
}

static fret_status sine_step(void *self, const fret_step *step) {
    sine *s = self;
    s->shown = false;
    return s->swing ? fret_swing_step(s->swing, step) : fret_memory_step(s->memory, step);
}

static fret_status sine_copy(void *to, const void *from) {
    sine *t = to;
    const sine *s = from;
    fret_status st = fret_memory_copy(t->memory, s->memory);
    t->shown = s->shown;
    if (!s->swing) {
        fret_swing_free(t->swing);
        t->swing = NULL;
        return st;
    }
    if (!st.code && !t->swing)
        st = fret_swing_make(s->memory, &t->swing);
    return st.code ? st : fret_swing_copy(t->swing, s->swing);
}

static void sine_state(const void *self, fret_state *out) {
    const sine *s = self;
    if (s->swing)
        fret_swing_state(s->swing, out);
    else
        fret_memory_state(s->memory, out);
}

static long double sine_last_loss(const void *self) {
    const sine *s = self;
    return s->swing ? fret_swing_last_loss(s->swing) : fret_memory_last_loss(s->memory);
}

static const model_row sine_model = {.name = "memory",
                                     .title = "memory diagram",
                                     .make = sine_make,
                                     .step = sine_step,
                                     .copy = sine_copy,
                                     .state = sine_state,
                                     .forces = sine_state,
                                     .last_loss = sine_last_loss,
                                     .end = sine_end};

bool engine_is_sine(const engine *e) {
    return e->kind == &sine_model;
}

fret_status engine_to_sine(engine *e) {
    sine *s = calloc(1, sizeof *s);
    if (!s)
        return no_memory;
    s->memory = e->self;
    s->shown = true;
    e->self = s;
    e->kind = &sine_model;
    return (fret_status){FRET_OK, NULL, 0, 0};
}

fret_status engine_swing(engine *e, const fret_sine *load, double from, double to, bool *taken) {
    fret_status st = {FRET_OK, NULL, 0, 0};
    *taken = false;
    sine *s = e->self;
    if (!s->swing)
        st = fret_swing_make(s->memory, &s->swing);
    if (st.code || (from == 0 && !fret_swing_fits(s->swing, load)))
        return st;
    st = fret_swing_part(s->swing, load, from, to);
    s->shown = false;
    *taken = !st.code;
    e->spent += fret_swing_last_loss(s->swing);
    return st;
}

/* As it was when it was last shown. */
static const fret_memory *old_memory(const engine *e) {
    return engine_is_sine(e) ? ((const sine *)e->self)->memory : e->self;
}

const fret_normal *engine_normal(const engine *e) {
    return fret_memory_normal(old_memory(e));
}

double engine_friction(const engine *e) {
    return fret_memory_friction(old_memory(e));
}

const fret_swing *engine_curve(const engine *e) {
    const sine *s = engine_is_sine(e) ? e->self : NULL;
    return s ? s->swing : NULL;
}

const fret_memory *engine_memory(const engine *e) {
    if (!engine_is_sine(e))
        return e->self;
    sine *s = e->self;
    if (s->swing && !s->shown && fret_swing_memory(s->swing, s->memory).code)
        return NULL;
    s->shown = true;
    return s->memory;
}

/* ---- any model --------------------------------------------------------------------------------- */

fret_status engine_make(engine *e, model_id id, const fret_normal *normal, double mu, unsigned count,
                        double radius) {
    *e = (engine){.kind = &models[id]};
    return e->kind->make(normal, mu, count, radius, &e->self);
}

void engine_end(engine *e) {
    if (e->self)
        e->kind->end(e->self);
    e->self = NULL;
}

static fret_status take(engine *e, const fret_step *step, fret_status (*how)(void *, const fret_step *)) {
    fret_status st = how(e->self, step);
    if (!st.code && e->kind->last_loss)
        e->spent += e->kind->last_loss(e->self);
    return st;
}

fret_status engine_step(engine *e, const fret_step *step) {
    return take(e, step, e->kind->step);
}

fret_status engine_chord(engine *e, const fret_step *step) {
    return take(e, step, e->kind->chord ? e->kind->chord : e->kind->step);
}

void engine_state(const engine *e, fret_state *out) {
    e->kind->state(e->self, out);
    out->W += e->more;
}

void engine_forces(const engine *e, fret_state *out) {
    e->kind->forces(e->self, out);
    out->W += e->more;
}

fret_status engine_copy(engine *to, const engine *from, const fret_normal *normal, double mu) {
    fret_status st = {FRET_OK, NULL, 0, 0};
    if (to->self && to->kind != from->kind)
        engine_end(to);
    if (!to->self) {
        to->kind = from->kind;
        st = to->kind->make(normal, mu, 0, 0, &to->self);
    }
    if (!st.code)
        st = from->kind->copy(to->self, from->self);
    to->spent = from->spent;
    to->more = from->more;
    return st;
}

void engine_repeat(engine *e, unsigned times, long double loss) {
    e->more += times * loss;
}

static long double dissipated(const engine *e) {
    fret_state now;
    engine_forces(e, &now);
    return now.W;
}

void engine_mark(engine *e) {
    e->spent = e->kind->last_loss ? 0 : dissipated(e);
}

long double engine_spent(const engine *e) {
    return e->kind->last_loss ? e->spent : dissipated(e) - e->spent;
}
