/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Inputs of every row, and results as they are asked for. */
#include "calc/rows.h"

#include <math.h>
#include <string.h>

enum { VALUES = sizeof(fret_scene_values) / sizeof(double *) };

/* ---- inputs ------------------------------------------------------------------------------------ */

static bool put_material(scene_rows *r, const inputs *in, size_t i) {
    calc_error unused;
    fret_material m;
    error_clear(&unused);
    if (!inputs_material(in, in->v[IN_K], &m, &unused))
        return false;
    for (int j = 0; j < 2; j++) {
        r->E0[j][i] = m.body[j].E0;
        r->nu[j][i] = m.body[j].nu;
    }
    r->k[i] = m.k;
    r->c0[i] = m.c0;
    return true;
}

/* A single power, pressed by force; 1 where there is nothing. */
static void put_load(scene_rows *r, const inputs *in, size_t i) {
    fret_gap gap = {.power = {{2, 1, 1}}};
    if (in->geometry)
        in->geometry->gap(in, &gap);
    r->n[i] = gap.power[0].n;
    r->h[i] = gap.power[0].h;
    r->r0[i] = gap.power[0].r0;
    r->F[i] = r->pressed ? in->v[IN_FN] : 1;
    r->mu[i] = r->rubs ? in->v[IN_MU] : 1;
}

/* What the load program says, which no row changes. */
static bool look_at_load(scene_rows *r) {
    scene *s = r->s;
    const load_reach *reach;
    calc_error unused;
    load_item cycle;
    double mu;
    error_clear(&unused);
    r->pressed = s->end.steps > 0 && s->in.geometry;
    r->rubs = scene_friction(s, &mu, &unused); /* mu of a row is set, too */
    r->cycles = r->pushed = false;
    if (!r->pressed)
        return true;
    if (s->program->steps[0].normal != BY_FORCE || !scene_reach(s, &reach, &unused) || reach->normal_varies)
        return false;
    if (INPUT_BIT(r->in) & INPUT_CYCLE || !r->rubs)
        return true;
    r->pushed = scene_closed_state(s) && reach->by == BY_FORCE && reach->end != 0;
    r->end = reach->end;
    if (scene_closed_loss(s)) { /* of a cycle, which nothing follows */
        scene_last_cycle(s, &cycle, &unused);
        r->cycles = cycle.step.tangential == BY_FORCE;
        r->amplitude = cycle.step.tangential_value;
    }
    return true;
}

bool rows_begin(scene_rows *r, scene *s, input in, const long double x[], size_t count) {
    r->s = s;
    r->in = in;
    r->count = count;
    r->x = x;
    for (int i = 0; i < ROWS_KINDS; i++)
        r->values[i].ready = false;
    if (s->in.bindings || (s->in.geometry && !s->in.geometry->power) || !look_at_load(r))
        return false;
    inputs row = s->in; /* nothing is bound: no one counts */
    for (size_t i = 0; i < count; i++) {
        if (input_status(in, (double)x[i]).code)
            return false;
        inputs_put(&row, in, (double)x[i]);
        if (!put_material(r, &row, i))
            return false;
        put_load(r, &row, i);
    }
    const bool alike = row.second == SECOND_SAME;
    r->of = (fret_scenes){.E0 = {r->E0[0], alike ? NULL : r->E0[1]},
                          .nu = {r->nu[0], r->nu[1]},
                          .k = r->k,
                          .c0 = r->c0,
                          .n = r->n,
                          .h = r->h,
                          .r0 = r->r0,
                          .F = r->F,
                          .mu = r->mu,
                          .rigid = row.second == SECOND_RIGID};
    if (r->of.rigid)
        r->of.E0[1] = NULL;
    return true;
}

/* ---- results ----------------------------------------------------------------------------------- */

static fret_scene_values all_of(rows_values *v) {
    double *at[VALUES];
    fret_scene_values out;
    for (int i = 0; i < VALUES; i++)
        at[i] = v->v[i];
    memcpy(&out, at, sizeof out);
    return out;
}

static void run(scene_rows *r, const fret_scenes *of, rows_values *to) {
    const fret_scene_values out = all_of(to);
    fret_batch_scenes(of, &out, r->count);
}

static const double *push(scene_rows *r, double size) {
    for (size_t i = 0; i < r->count; i++)
        r->push[i] = fabs(size);
    return r->push;
}

static const rows_values *values_of(scene_rows *r, rows_kind kind) {
    rows_values *v = &r->values[kind];
    fret_scenes of = r->of;
    if (v->ready)
        return v;
    double zero[SCENE_ROWS];
    if (kind == ROWS_TWIN) {
        memset(zero, 0, sizeof zero);
        of.k = zero;
    } else if (kind != ROWS_PRESSED) {
        of.Fx = push(r, kind == ROWS_CYCLE ? r->amplitude : r->end);
    }
    run(r, &of, v);
    v->ready = true;
    return v;
}

/* Which scenes answer for a quantity. */
static rows_kind kind_of(const scene_rows *r, const quantity *q) {
    switch (q->rows) {
    case ROWS_OF_CYCLE:
        return ROWS_CYCLE;
    case ROWS_OF_PUSH:
        return ROWS_PUSHED;
    case ROWS_OF_TWIN:
        return ROWS_TWIN;
    default: /* what a cycle wants holds the rest too */
        return r->cycles ? ROWS_CYCLE : ROWS_PRESSED;
    }
}

bool rows_have(const scene_rows *r, const quantity *q, bool call) {
    if (call)
        return q->rows_by && r->pressed && (q->rows_by == ROWS_BY_LOAD || r->rubs);
    if (quantity_is_input(q) && quantity_input(q) != IN_A)
        return true;
    switch (q->rows) {
    case ROWS_OF_NOTHING:
        return false;
    case ROWS_OF_MATERIAL:
        return true;
    case ROWS_OF_SHAPE:
        return r->s->in.geometry;
    case ROWS_OF_PRESS:
        return r->pressed;
    case ROWS_OF_FRICTION:
        return r->pressed && r->rubs;
    case ROWS_OF_CYCLE:
        return r->cycles;
    case ROWS_OF_PUSH:
        return r->pushed;
    case ROWS_OF_TWIN:
        return r->pressed && (q->at_row != offsetof(fret_scene_values, slip) || r->rubs);
    }
    return false;
}

static bool to_long(const scene_rows *r, const double *v, long double out[]) {
    bool all = true;
    for (size_t i = 0; i < r->count; i++) {
        out[i] = v[i];
        all = all && isfinite(v[i]);
    }
    return all;
}

/* Inputs may follow from each other. */
static bool inputs_at(const scene_rows *r, input which, long double out[]) {
    calc_error unused;
    inputs row = r->s->in;
    error_clear(&unused);
    for (size_t i = 0; i < r->count; i++) {
        inputs_put(&row, r->in, (double)r->x[i]);
        if (!inputs_get(&row, which, &out[i], &unused))
            return false;
    }
    return true;
}

bool rows_quantity(scene_rows *r, const quantity *q, long double out[]) {
    if (quantity_is_input(q))
        return inputs_at(r, quantity_input(q), out);
    const rows_values *v = values_of(r, kind_of(r, q));
    if (!to_long(r, v->v[q->at_row / sizeof(double *)], out))
        return false;
    r->s->used |= USED(MODEL_CLOSED) | USED(MODEL_VECTORS);
    for (size_t i = 0; q->at_row == offsetof(fret_scene_values, dx) && i < r->count; i++)
        out[i] = copysignl(out[i], r->end);
    return true;
}

bool rows_call(scene_rows *r, const quantity *q, const long double *arg, size_t stride, long double out[]) {
    double argument[SCENE_ROWS], result[SCENE_ROWS];
    fret_scenes of = r->of;
    fret_scene_values to = {.hN = NULL};
    double *at = result;
    for (size_t i = 0; i < r->count; i++)
        argument[i] = (double)arg[i * stride];
    *(q->rows_by == ROWS_BY_LOAD ? &of.F : &of.Fx) = argument;
    memcpy((char *)&to + q->at_row, &at, sizeof at);
    fret_batch_scenes(&of, &to, r->count);
    if (!to_long(r, result, out))
        return false;
    r->s->used |= USED(MODEL_CLOSED) | USED(MODEL_VECTORS);
    return true;
}
