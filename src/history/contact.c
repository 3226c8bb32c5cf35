/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The functions of fret/contact.h, by the memory diagram, exact or in double, or the swing. Allocates
 * these. */
#include "history/contact.h"

#include <math.h>
#include <stdlib.h>

#include "history/diagram.h"
#include "history/swing.h"
#include "law/check.h"

/* ---- life -------------------------------------------------------------------------------------- */

fret_status fret_contact_make(const fret_normal *normal, double mu, fret_exactness exactness,
                              fret_contact **out) {
    if (exactness == FRET_DOUBLE && !fret_normal_closed(normal))
        return fret_fail(FRET_OUTSIDE, "n", 0, 0);
    fret_contact *c = calloc(1, sizeof *c);
    if (!c)
        return fret_fail(FRET_NO_MEMORY, NULL, 0, 0);
    const fret_status st = exactness == FRET_DOUBLE ? fret_diagram_make(normal, mu, &c->diagram)
                                                    : fret_memory_make(normal, mu, &c->memory);
    c->normal = normal;
    c->mu = mu;
    if (st.code)
        free(c);
    else
        *out = c;
    return st;
}

void fret_contact_free(fret_contact *c) {
    if (!c)
        return;
    fret_memory_free(c->memory);
    fret_diagram_free(c->diagram);
    fret_swing_free(c->swing);
    free(c);
}

void fret_contact_reset(fret_contact *c) {
    c->curved = false;
    if (c->diagram)
        fret_diagram_reset(c->diagram);
    else
        fret_memory_reset(c->memory);
}

static fret_status other_exactness(void) {
    return fret_fail(FRET_OUTSIDE, "exactness", 0, 0);
}

fret_status fret_contact_copy(fret_contact *to, const fret_contact *from) {
    if (!to->diagram != !from->diagram)
        return other_exactness();
    fret_status st = fret_ok();
    if (from->curved && !to->swing)
        st = fret_swing_make(from->memory, &to->swing);
    if (to->swing)
        to->swing->slips = to->slips;
    if (!st.code)
        st = from->curved    ? fret_swing_copy(to->swing, from->swing)
             : from->diagram ? fret_diagram_copy(to->diagram, from->diagram)
                             : fret_memory_copy(to->memory, from->memory);
    if (st.code)
        return st;
    to->normal = from->normal;
    to->mu = from->mu;
    to->curved = from->curved;
    return st;
}

fret_status fret_contact_chords(fret_contact *to, const fret_contact *from) {
    if (to->diagram || from->diagram)
        return other_exactness();
    const fret_status st = from->curved ? fret_swing_memory(from->swing, to->memory)
                                        : fret_memory_copy(to->memory, from->memory);
    to->curved = to->curved && st.code;
    return st;
}

const fret_normal *fret_contact_normal(const fret_contact *c) {
    return c->normal;
}

double fret_contact_friction(const fret_contact *c) {
    return c->mu;
}

bool fret_contact_curved(const fret_contact *c) {
    return c->curved;
}

fret_status fret_contact_watch(fret_contact *c, fret_slips *slips) {
    if (c->diagram)
        return other_exactness();
    c->slips = c->memory->slips = slips;
    if (c->swing)
        c->swing->slips = slips;
    return fret_ok();
}

/* ---- loads ------------------------------------------------------------------------------------- */

fret_status fret_contact_step(fret_contact *c, const fret_step *step) {
    return c->diagram  ? fret_diagram_step(c->diagram, step)
           : c->curved ? fret_swing_step(c->swing, step)
                       : fret_memory_step(c->memory, step);
}

void fret_contact_count_loss(fret_contact *c, bool on) {
    if (c->diagram)
        fret_diagram_count_loss(c->diagram, on);
}

/* Makes a swing from the state of the memory, after a first or another straight history. */
static fret_status begin_swing(fret_contact *c) {
    fret_swing *made = NULL;
    const fret_status st = fret_swing_make(c->memory, &made);
    if (st.code)
        return st;
    fret_swing_free(c->swing);
    c->swing = made;
    return st;
}

fret_status fret_contact_swing(fret_contact *c, const fret_sine *sine, double from, double to) {
    if (c->diagram)
        return other_exactness();
    fret_status st = c->curved ? fret_ok() : begin_swing(c);
    if (!st.code && !fret_swing_fits(c->swing, sine, from))
        st = fret_fail(FRET_OUTSIDE, "FA", sine->FA, 0);
    if (!st.code)
        st = fret_swing_part(c->swing, sine, from, to);
    c->curved = c->curved || !st.code;
    return st;
}

/* ---- answers ----------------------------------------------------------------------------------- */

void fret_contact_state(const fret_contact *c, fret_state *out) {
    if (c->diagram)
        fret_diagram_state(c->diagram, out);
    else if (c->curved)
        fret_swing_state(c->swing, out);
    else
        fret_memory_state(c->memory, out);
}

void fret_contact_forces(const fret_contact *c, fret_state *out) {
    if (c->diagram)
        fret_diagram_forces(c->diagram, out);
    else if (c->curved)
        fret_swing_state(c->swing, out);
    else
        fret_memory_forces(c->memory, out);
}

fret_real fret_contact_last_loss(const fret_contact *c) {
    return c->diagram  ? (fret_real)fret_diagram_last_loss(c->diagram)
           : c->curved ? c->swing->last_loss
                       : c->memory->last_loss;
}

bool fret_contact_segment(const fret_contact *c, size_t i, fret_segment *out) {
    return c->memory && !c->curved && fret_memory_segment(c->memory, i, out);
}

fret_real fret_contact_displacement(const fret_contact *c, fret_real x) {
    return c->diagram  ? (fret_real)NAN
           : c->curved ? fret_swing_displacement(c->swing, x)
                       : fret_memory_displacement(c->memory, x);
}

fret_real fret_contact_bound(const fret_contact *c, fret_real x) {
    const fret_real y = fret_normal_profile(c->normal, x);
    fret_state now;
    fret_contact_forces(c, &now);
    return isnan(x) || c->diagram ? (fret_real)NAN
           : y < now.dz           ? c->mu * c->normal->foundation.eta * (now.dz - y)
                                  : 0;
}

fret_real fret_contact_slip_work(const fret_contact *c) {
    return c->diagram || c->curved ? (fret_real)NAN : fret_memory_slip_work(c->memory);
}

/* ---- keeping ----------------------------------------------------------------------------------- */

fret_status fret_contact_pack(const fret_contact *c, double out[], size_t room, size_t *count) {
    const fret_memory *m = c->memory;
    fret_memory *chords = NULL;
    fret_status st = fret_ok();
    if (c->curved) {
        st = fret_memory_make(c->normal, c->mu, &chords);
        if (!st.code)
            st = fret_swing_memory(c->swing, chords);
        m = chords;
    }
    if (!st.code) {
        *count = c->diagram ? fret_diagram_packed(c->diagram) : fret_memory_packed(m);
        if (*count > room)
            st = fret_fail(FRET_OUTSIDE, "room", (double)room, (double)*count);
        else if (c->diagram)
            fret_diagram_pack(c->diagram, out);
        else
            fret_memory_pack(m, out);
    }
    fret_memory_free(chords);
    return st;
}

fret_status fret_contact_unpack(fret_contact *c, const double from[], size_t count) {
    const fret_status st = c->diagram ? fret_diagram_unpack(c->diagram, from, count)
                                      : fret_memory_unpack(c->memory, from, count);
    c->curved = c->curved && st.code;
    return st;
}
