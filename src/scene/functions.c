/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Functions of the scene as it is pressed, tangentially unloaded: closed forms. */
#include "scene/functions.h"

/* ---- pressing ---------------------------------------------------------------------------------- */

static bool pressed_by(scene *s, load_by by, value v, fret_press *out, calc_error *error) {
    const fret_normal *normal;
    if (!scene_normal(s, &normal, error))
        return false;
    scene_used_closed(s);
    fret_status st = press_to(normal, by, (double)v.v, out);
    return calc_status(error, &st);
}

bool call_a(scene *s, value F, long double *out, calc_error *error) {
    fret_press press;
    if (!pressed_by(s, BY_FORCE, F, &press, error))
        return false;
    *out = press.a;
    return true;
}

bool call_dz(scene *s, value F, long double *out, calc_error *error) {
    fret_press press;
    if (!pressed_by(s, BY_FORCE, F, &press, error))
        return false;
    *out = press.dz;
    return true;
}

bool call_FN(scene *s, value d, long double *out, calc_error *error) {
    fret_press press;
    if (s->gaps && d.v < 0)
        d.v = 0;
    if (!pressed_by(s, BY_DISPLACEMENT, d, &press, error))
        return false;
    *out = press.F;
    return true;
}

bool call_p0(scene *s, value F, long double *out, calc_error *error) {
    const fret_normal *normal;
    fret_press press;
    fret_field *field = NULL;
    if (!scene_normal(s, &normal, error) || !pressed_by(s, BY_FORCE, F, &press, error))
        return false;
    s->used |= USED(MODEL_QUADRATURE);
    fret_status st = fret_field_of_press(normal, &press, &field);
    if (!st.code)
        st = fret_field_peak(field, NULL, out);
    fret_field_free(field);
    return calc_status(error, &st);
}

/* ---- tangential loading ------------------------------------------------------------------------ */

/* By force or displacement. */
static bool load_first(scene *s, value arg, bool by_force, fret_loading *out, calc_error *error) {
    fret_pressed contact;
    if (!scene_contact(s, &contact, error))
        return false;
    fret_status st = by_force ? fret_loading_by_force(&contact, (double)arg.v, out)
                              : fret_loading_by_displacement(&contact, (double)arg.v, out);
    return calc_status(error, &st);
}

bool call_c(scene *s, value F, long double *out, calc_error *error) {
    fret_loading first;
    if (!load_first(s, F, true, &first, error))
        return false;
    *out = first.c;
    return true;
}

bool call_dx(scene *s, value F, long double *out, calc_error *error) {
    fret_loading first;
    if (!load_first(s, F, true, &first, error))
        return false;
    *out = first.dx;
    return true;
}

bool call_Fx(scene *s, value d, long double *out, calc_error *error) {
    fret_loading first;
    if (!load_first(s, d, false, &first, error))
        return false;
    *out = first.Fx;
    return true;
}

bool call_dW(scene *s, value FA, long double *out, calc_error *error) {
    fret_pressed contact;
    if (!scene_contact(s, &contact, error))
        return false;
    fret_status st = fret_cycle_loss_by_force(&contact, (double)FA.v, out);
    return calc_status(error, &st);
}

bool call_dWd(scene *s, value dxA, long double *out, calc_error *error) {
    fret_pressed contact;
    if (!scene_contact(s, &contact, error))
        return false;
    fret_status st = fret_cycle_loss_by_displacement(&contact, (double)dxA.v, out);
    return calc_status(error, &st);
}
