/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Takes the state of a scene as plain numbers. Changes no scene. */
#include "live/shot.h"

#include <string.h>

const char *const shot_names[SHOT_VALUES] = {"FN", "Fx", "dx", "dz", "a", "c", "c/a", "W", "U", "dW", "kt"};

/* ---- a state ----------------------------------------------------------------------------------- */

static void take_values(calc *c, shot *out) {
    for (size_t i = 0; i < SHOT_VALUES; i++) {
        const quantity *q = quantity_find(shot_names[i], strlen(shot_names[i]));
        out->known[i] = q && quantity_get(q, c->now, &out->value[i], error_quiet());
        out->d[i] = q ? q->d : DIM_NONE;
        if (!q) { /* c/a is no quantity: from the two values before it */
            out->known[i] = out->known[i - 1] & (out->value[i - 2] > 0);
            out->value[i] = out->known[i] ? out->value[i - 1] / out->value[i - 2] : 0;
        }
    }
}

/* Rings of one slope of the memory diagram each; only the outermost ones if there are too many. */
static void take_rings(const fret_contact *contact, shot *out) {
    fret_segment part;
    size_t count = 0;
    out->rings = 0;
    while (fret_contact_segment(contact, count, &part))
        count++;
    for (size_t i = count > SHOT_RINGS ? count - SHOT_RINGS : 0; i < count; i++) {
        fret_press edge = {.a = 0};
        fret_contact_segment(contact, i, &part);
        fret_press_by_depth(fret_contact_normal(contact), (double)part.outer, &edge);
        out->ring[out->rings++] = (shot_ring){(double)edge.a, (double)part.sigma};
    }
}

static void take_springs(const fret_contact *contact, shot *out) {
    for (int i = 0; i <= SHOT_SAMPLES; i++) {
        const fret_real x = out->a * (fret_real)i / (fret_real)SHOT_SAMPLES;
        out->u[i] = (double)fret_contact_displacement(contact, x);
        out->B[i] = (double)fret_contact_bound(contact, x);
    }
}

bool shot_take(calc *c, shot *out, calc_error *error) {
    const fret_contact *contact;
    fret_state state;
    if (!scene_straight(c->now, &contact, error))
        return false;
    fret_contact_state(contact, &state);
    out->a = (double)state.a;
    out->c = (double)state.c;
    out->dx = (double)state.dx;
    out->Fx = (double)state.Fx;
    out->slip = fret_contact_friction(contact) * (double)state.FN;
    out->bound = (double)fret_contact_bound(contact, 0);
    take_springs(contact, out);
    take_rings(contact, out);
    take_values(c, out);
    out->digits = 0;
    return true;
}

bool shot_lost(calc *c, double a, double lost[SHOT_SAMPLES + 1]) {
    const load_reach *reach;
    long double v;
    if (!scene_reach(c->now, &reach, error_quiet()) || reach->swings || !c->now->end.cycles)
        return false;
    for (int i = 0; i <= SHOT_SAMPLES; i++) {
        if (!scene_work(c->now, true, (long double)a * i / (double)SHOT_SAMPLES, &v, error_quiet()))
            return false;
        lost[i] = (double)v;
    }
    return true;
}
