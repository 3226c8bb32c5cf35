/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Functions of the scene as it is pressed, tangentially unloaded: closed forms. */
#include "scene/functions.h"

bool pressed_by(scene *s, bool by_force, long double v, fret_press *out, calc_error *error) {
    const fret_normal *normal;
    if (!scene_normal(s, &normal, error))
        return false;
    scene_used_closed(s);
    if (s->gaps && !by_force && v < 0)
        v = 0;
    fret_status st = (by_force ? fret_press_by_force : fret_press_by_depth)(normal, (double)v, out);
    return calc_status(error, &st);
}

bool call_p0(scene *s, value F, long double *out, calc_error *error) {
    const fret_normal *normal;
    fret_press press;
    fret_field *field = NULL;
    if (!scene_normal(s, &normal, error) || !pressed_by(s, true, F.v, &press, error))
        return false;
    s->used |= USED(MODEL_QUADRATURE);
    fret_status st = fret_field_of_press(normal, &press, &field);
    if (!st.code)
        st = fret_field_peak(field, NULL, out);
    fret_field_free(field);
    return calc_status(error, &st);
}

bool loaded_by(scene *s, bool by_force, long double v, fret_loading *out, calc_error *error) {
    fret_pressed contact;
    if (!scene_contact(s, &contact, error))
        return false;
    fret_status st =
        (by_force ? fret_loading_by_force : fret_loading_by_displacement)(&contact, (double)v, out);
    return calc_status(error, &st);
}

bool loss_by(scene *s, bool by_force, long double v, long double *out, calc_error *error) {
    fret_pressed contact;
    if (!scene_contact(s, &contact, error))
        return false;
    fret_status st =
        (by_force ? fret_cycle_loss_by_force : fret_cycle_loss_by_displacement)(&contact, (double)v, out);
    return calc_status(error, &st);
}
