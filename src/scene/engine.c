/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The table of models, and how they step. Uses the library and `number`. */
#include "scene/engine.h"

#include <float.h>
#include <math.h>

#include "number/root.h"
#include "text/error.h"

const model_row models[MODELS] = {
    [MODEL_CLOSED] = {.name = "closed", .title = "closed form"},
    [MODEL_MEMORY] = {.name = "memory", .title = "memory diagram", .steps = true},
    [MODEL_QUADRATURE] = {.name = "quadrature", .title = "quadrature"},
    [MODEL_PIECES] = {.name = "polynomials", .title = "polynomials"},
    [MODEL_SPRINGS] = {.name = "springs", .title = "springs", .steps = true},
    [MODEL_BLOCKS] = {.name = "blocks", .title = "blocks of cycles"},
};

fret_status engine_make(engine *e, const fret_normal *normal, double mu) {
    *e = (engine){.contact = NULL};
    return fret_contact_make(normal, mu, FRET_EXACT, &e->contact);
}

fret_status engine_springs(engine *e, const fret_normal *normal, double mu, unsigned count, double radius,
                           fret_weight rule) {
    *e = (engine){.contact = NULL};
    return fret_springs_make(normal, mu, count, radius, rule, &e->springs);
}

void engine_end(engine *e) {
    fret_contact_free(e->contact);
    fret_springs_free(e->springs);
    e->contact = NULL;
    e->springs = NULL;
}

/* For springs a ramp by force that changes F_N is not straight: 64 parts have an error of 1e-8. */
static fret_status step_in_parts(engine *e, const fret_step *step, unsigned parts) {
    const bool ramp = step->normal_by != FRET_KEEP_NORMAL && step->tangential_by == FRET_TO_FX;
    if (e->springs)
        return fret_springs_step(e->springs, step, ramp ? parts : 1);
    const fret_status st = fret_contact_step(e->contact, step);
    if (!st.code)
        e->spent += fret_contact_last_loss(e->contact);
    return st;
}

fret_status engine_step(engine *e, const fret_step *step) {
    return step_in_parts(e, step, 64);
}

fret_status engine_chord(engine *e, const fret_step *step) {
    return step_in_parts(e, step, 1);
}

fret_status engine_swing(engine *e, const fret_sine *load, double from, double to) {
    const fret_status st = fret_contact_swing(e->contact, load, from, to);
    if (!st.code)
        e->spent += fret_contact_last_loss(e->contact);
    return st;
}

void engine_state(const engine *e, fret_state *out) {
    if (e->springs)
        fret_springs_state(e->springs, out);
    else
        fret_contact_state(e->contact, out);
    out->W += e->more;
}

void engine_forces(const engine *e, fret_state *out) {
    if (e->springs)
        fret_springs_state(e->springs, out);
    else
        fret_contact_forces(e->contact, out);
    out->W += e->more;
}

fret_status engine_copy(engine *to, const engine *from) {
    fret_status st = status_ok;
    if (from->springs) {
        fret_springs_free(to->springs);
        to->springs = NULL;
        st = fret_springs_clone(from->springs, &to->springs);
    } else if (!to->contact) {
        st = fret_contact_make(fret_contact_normal(from->contact), fret_contact_friction(from->contact),
                               FRET_EXACT, &to->contact);
    }
    if (from->contact && !st.code)
        st = fret_contact_copy(to->contact, from->contact);
    to->sine = from->sine;
    to->spent = from->spent;
    to->more = from->more;
    return st;
}

/* ---- at the rig -------------------------------------------------------------------------------- */

/* Context of the search for a displacement at the rig, tried on copies of the engine. */
typedef struct rig_search {
    const engine *from;
    engine tried;
    fret_step step;
    fret_real K, d;
    fret_status st;
} rig_search;

/* delta_x + F_x/K - d after a step to dx. The step goes to dx rounded to double; the rest is linear. */
static fret_real off_at_rig(fret_real dx, fret_real *slope, void *context) {
    rig_search *s = context;
    fret_state now = {.Fx = 0};
    s->step.tangential = (double)dx;
    if (!s->st.code)
        s->st = engine_copy(&s->tried, s->from);
    if (!s->st.code)
        s->st = engine_step(&s->tried, &s->step);
    if (s->st.code)
        return 0; /* ends the search */
    engine_state(&s->tried, &now);
    if (s->step.normal_by == FRET_KEEP_NORMAL) /* with a normal change kt is not dF_x/ddx */
        *slope = 1 + now.kt / s->K;
    return dx - s->d + (now.Fx + now.kt * (dx - (double)dx)) / s->K;
}

/* F_x grows with the end delta_x of a straight step: the root lies within F_x/K of d and, at constant F_N, on
 * the side of the present delta_x to which the rig moves. */
fret_status engine_at_rig(const engine *e, double K_rig, fret_step *step) {
    rig_search s = {.from = e, .step = *step, .K = K_rig, .d = step->tangential};
    const bool keeps = step->normal_by == FRET_KEEP_NORMAL;
    fret_state now;
    fret_real slope = 0;
    engine_state(e, &now);
    const fret_real travel = s.d - now.dx - now.Fx / s.K,
                    digits = fabsl(now.dx) * (1 + now.kt / s.K) + fabsl(now.Fx) / s.K;
    if (keeps && fabsl(travel) <= 2 * (fret_real)DBL_EPSILON * digits) {
        step->tangential_by = FRET_KEEP_DX; /* rounding must not cause a reversal */
        return s.st;
    }
    const fret_real off = off_at_rig(s.d, &slope, &s),
                    beyond = s.d - off - copysignl(DBL_EPSILON * (fabsl(s.d) + fabsl(off)), off);
    fret_real lo = fminl(s.d, beyond), hi = fmaxl(s.d, beyond);
    if (keeps && travel > 0)
        lo = fmaxl(lo, now.dx);
    else if (keeps)
        hi = fminl(hi, now.dx);
    step->tangential = (double)fret_root(off_at_rig, &s, lo, hi, now.dx + travel / (1 + now.kt / s.K));
    engine_end(&s.tried);
    return s.st;
}

fret_status engine_watch(engine *e, fret_slips *slips) {
    e->slips = slips;
    return fret_contact_watch(e->contact, slips);
}

void engine_repeat(engine *e, unsigned times, long double loss) {
    e->more += times * loss;
    e->times = 1 + times;
    if (e->slips)
        fret_slips_repeat(e->slips, e->begun, times);
}

static long double dissipated(const engine *e) {
    fret_state now;
    engine_forces(e, &now);
    return now.W;
}

void engine_mark(engine *e) {
    e->spent = e->springs ? dissipated(e) : 0;
    e->begun = e->slips ? fret_slips_count(e->slips) : 0;
}

void engine_close(engine *e) {
    e->closed[0] = e->begun;
    e->closed[1] = e->slips ? fret_slips_count(e->slips) : 0;
    e->times = 1;
}

long double engine_spent(const engine *e) {
    return e->springs ? dissipated(e) - e->spent : e->spent;
}
