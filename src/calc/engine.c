/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The table of models and how they step. */
#include "calc/engine.h"

static fret_status memory_make(const fret_normal *normal, double mu, unsigned count, double radius, void **out) {
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

static fret_status springs_make(const fret_normal *normal, double mu, unsigned count, double radius, void **out) {
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

static void springs_state(const void *self, fret_state *out) {
    fret_springs_state(self, out);
}

static void springs_end(void *self) {
    fret_springs_free(self);
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
    [MODEL_SPRINGS] = {.name = "springs",
                       .title = "springs",
                       .count = "the number of springs",
                       .chosen = true,
                       .make = springs_make,
                       .step = springs_step,
                       .state = springs_state,
                       .forces = springs_state,
                       .end = springs_end},
};

fret_status engine_make(engine *e, model_id id, const fret_normal *normal, double mu, unsigned count, double radius) {
    *e = (engine){.kind = &models[id]};
    return e->kind->make(normal, mu, count, radius, &e->self);
}

void engine_end(engine *e) {
    if (e->self)
        e->kind->end(e->self);
    e->self = NULL;
}

fret_status engine_step(engine *e, const fret_step *step) {
    fret_status st = e->kind->step(e->self, step);
    if (!st.code && e->kind->last_loss)
        e->spent += e->kind->last_loss(e->self);
    return st;
}

void engine_state(const engine *e, fret_state *out) {
    e->kind->state(e->self, out);
}

void engine_forces(const engine *e, fret_state *out) {
    e->kind->forces(e->self, out);
}

fret_status engine_copy(engine *to, const engine *from, const fret_normal *normal, double mu) {
    fret_status st = {FRET_OK, NULL, 0, 0};
    if (!to->self)
        st = engine_make(to, (model_id)(from->kind - models), normal, mu, 0, 0);
    if (!st.code)
        st = from->kind->copy(to->self, from->self);
    to->spent = from->spent;
    return st;
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
