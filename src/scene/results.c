/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Getters of the table of quantities that compute more than a member of a state. Uses the library. */
#include "scene/functions.h"

#include "number/real.h"

/* Is the input imposed by the press and unchanged since? */
static bool is_imposed(scene *s, input in) {
    const load_reach *reach;
    return s->in.set[in] && !s->now && scene_reach(s, &reach, error_quiet()) && !reach->normal_varies;
}

/* The largest pressure. Nodes of a worn gap lie 1 % of the radius apart: a pressure that rises within that is
 * marked, since finer nodes would tell another one. */
static fret_status peak_of(scene *s, const fret_field *field, long double *out) {
    fret_real r, beside;
    s->used |= USED(MODEL_QUADRATURE);
    fret_status st = fret_field_peak(field, &r, out);
    if (!st.code && scene_is_worn(s)) {
        st = fret_field_pressure(field, 0.99L * r, &beside);
        s->used |= !st.code && beside < 0.9L * *out ? ASKED_STEEP : 0;
    }
    return st;
}

bool get_p0(scene *s, long double *out, calc_error *error) {
    const fret_field *field;
    if (is_imposed(s, IN_P0))
        return scene_get(s, IN_P0, out, error);
    if (!scene_pressed_field(s, &field, error))
        return false;
    return calc_status(error, peak_of(s, field, out));
}

bool pressed_by(scene *s, bool by_force, long double v, fret_press *out, calc_error *error) {
    const fret_normal *normal;
    if (!scene_normal(s, &normal, error))
        return false;
    scene_used_closed(s);
    if (s->gaps && !by_force && v < 0)
        v = 0;
    return calc_status(error, (by_force ? fret_press_by_force : fret_press_by_depth)(normal, (double)v, out));
}

bool call_p0(scene *s, value F, long double *out, calc_error *error) {
    const fret_normal *normal;
    fret_press press;
    fret_field *field = NULL;
    if (!scene_normal(s, &normal, error) || !pressed_by(s, true, F.v, &press, error))
        return false;
    fret_status st = fret_field_of_press(normal, &press, &field);
    if (!st.code)
        st = peak_of(s, field, out);
    fret_field_free(field);
    return calc_status(error, st);
}

bool get_pmean(scene *s, long double *out, calc_error *error) {
    const fret_press *press;
    if (is_imposed(s, IN_PMEAN))
        return scene_get(s, IN_PMEAN, out, error);
    if (!scene_press(s, &press, error))
        return false;
    *out = press->F > 0 ? press->F / (FRET_PI * press->a * press->a) : 0;
    return true;
}

bool get_Un(scene *s, long double *out, calc_error *error) {
    const fret_press *press;
    const fret_normal *normal;
    if (!scene_press(s, &press, error) || !scene_normal(s, &normal, error))
        return false;
    *out = fret_normal_energy(normal, press);
    return true;
}

bool get_Vwear(scene *s, long double *out, calc_error *error) {
    const fret_wear *wear;
    long double alpha = 0;
    s->used |= USED(MODEL_BLOCKS);
    if (!scene_get(s, IN_ALPHA_W, &alpha, error) || !scene_worn(s, &wear, error))
        return false;
    *out = wear ? fret_wear_volume(wear) : 0;
    return true;
}

bool get_dVwear(scene *s, long double *out, calc_error *error) {
    long double alpha = 0;
    if (!scene_get(s, IN_ALPHA_W, &alpha, error) || !scene_cycle_loss(s, out, error))
        return false;
    *out *= alpha;
    return true;
}

bool get_kn(scene *s, long double *out, calc_error *error) {
    const fret_press *press;
    const fret_normal *normal;
    if (!scene_press(s, &press, error) || !scene_normal(s, &normal, error))
        return false;
    *out = press->a > 0 ? fret_normal_stiffness(normal, press->a) : 0;
    return true;
}

/* ---- the scene against its k = 0 twin ---------------------------------------------------------- */

static bool k0_contact(scene *s, fret_pressed *out, calc_error *error) {
    long double FN = 0;
    if (!scene_FN(s, &FN, error) || !scene_k0(s, &out->normal, error))
        return false;
    scene_used_closed(s);
    return calc_status(error, fret_press_by_force(out->normal, (double)FN, &out->press));
}

bool twin_press(scene *s, fret_press *out, calc_error *error) {
    fret_pressed contact;
    if (!k0_contact(s, &contact, error))
        return false;
    *out = contact.press;
    return true;
}

bool get_dx0max(scene *s, long double *out, calc_error *error) {
    fret_pressed contact;
    if (!k0_contact(s, &contact, error) || !scene_friction(s, &contact.mu, error))
        return false;
    *out = fret_gross_slip(&contact);
    return true;
}

bool get_dxmax(scene *s, long double *out, calc_error *error) {
    fret_pressed contact;
    if (!scene_contact(s, &contact, error))
        return false;
    *out = fret_gross_slip(&contact);
    return true;
}

/* ---- coefficients ------------------------------------------------------------------------------ */

bool foundation_of(scene *s, bool only_normal, fret_foundation *out, calc_error *error) {
    const fret_normal *normal;
    fret_material material;
    s->used |= USED(MODEL_CLOSED);
    if (!only_normal && s->in.set[IN_ESTAR] && !inputs_know_nu(&s->in))
        return calc_missing(error, IN_NU);
    if (s->in.geometry) {
        if (!scene_normal(s, &normal, error))
            return false;
        *out = *fret_normal_foundation(normal);
        return true;
    }
    if (!scene_material(s, false, &material, error))
        return false;
    return calc_status(error, fret_foundation_make(&material, out));
}

bool get_kappa(scene *s, long double *out, calc_error *error) {
    long double n = 0, k = 0;
    if (s->in.geometry && !geometry_is_power(s->in.geometry))
        return calc_fail(error, 0, 0, "kappa is defined for a gap of a single power, not for geometry %s",
                         s->in.geometry->name);
    if (!scene_get(s, IN_N, &n, error) || !scene_get(s, IN_K, &k, error))
        return false;
    s->used |= USED(MODEL_CLOSED);
    *out = fret_kappa((double)n, (double)k);
    return true;
}

/* ---- the load ---------------------------------------------------------------------------------- */

bool get_W1D(scene *s, long double *out, calc_error *error) {
    const fret_contact *contact;
    const load_reach *reach;
    double mu;
    if (!scene_friction(s, &mu, error) || !scene_reach(s, &reach, error) ||
        !scene_straight(s, &contact, error))
        return false;
    if (reach->normal_varies)
        return calc_fail(error, 0, 0, "W1D is defined at constant FN; W is the energy dissipated");
    s->used |= USED(MODEL_MEMORY);
    *out = fret_contact_slip_work(contact);
    return true;
}

bool get_drig(scene *s, long double *out, calc_error *error) {
    fret_loading first;
    const fret_state *now;
    long double K_rig = 0;
    if (!scene_get(s, IN_K_RIG, &K_rig, error))
        return false;
    if (scene_closed_state(s)) {
        if (!scene_first_loading(s, &first, error))
            return false;
        *out = first.dx + first.Fx / K_rig;
        return true;
    }
    if (!scene_state(s, &now, error))
        return false;
    *out = now->dx + now->Fx / K_rig;
    return true;
}

bool get_time(scene *s, long double *out, calc_error *error) {
    const load_reach *reach;
    if (!scene_reach(s, &reach, error))
        return false;
    *out = scene_time(s);
    return true;
}
