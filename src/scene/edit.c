/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Changes of a scene that succeed completely or leave it as it was: of its inputs, and of its load. Uses
 * answers; no answer uses this file. */
#include "scene/scene.h"

static bool complete(const scene *s) {
    const inputs *in = &s->in;
    return inputs_any(in, INPUT_MODULUS) && (inputs_know_nu(in) || in->set[IN_ESTAR]) &&
           (in->geometry || !in->bindings) && (in->v[IN_K] == 0 || in->set[IN_C0]);
}

/* Before a load definitions may lack inputs, but not make a circle: one in c0 shows only when k is no longer
 * 0. */
static bool no_circle(scene *s, calc_error *error) {
    long double v;
    for (input in = 0; in < INPUTS; in++)
        if (s->in.bindings & INPUT_BIT(in) && !scene_get(s, in, &v, error) && error->circle)
            return false;
    error_clear(error);
    return true;
}

/* Are all inputs and the program valid together? */
static bool all_holds(scene *s, calc_error *error) {
    const fret_normal *normal;
    const fret_contact *contact;
    const fret_press *press;
    fret_material material;
    long double mu;
    for (input in = 0; in < INPUTS; in++)
        if (s->in.set[in] && !(s->in.bindings & INPUT_BIT(in)) && !input_check(in, s->in.v[in], error))
            return false;
    if (s->end.steps == 0) {
        if (!no_circle(s, error))
            return false;
        if (!complete(s) ||
            (s->in.geometry ? scene_normal(s, &normal, error) : scene_material(s, false, &material, error)))
            return true;
        const bool waits =
            error->kind == ERROR_MISSING && (error->input == IN_FN || !s->in.geometry); /* c0 := a0 */
        if (waits)
            error_clear(error);
        return waits;
    }
    const bool friction = inputs_any(&s->in, INPUT_BIT(IN_MU));
    if (friction || s->end.steps > 1)
        return (!friction || scene_get(s, IN_MU, &mu, error)) && scene_history(s, &contact, error);
    return scene_press(s, &press, error);
}

bool scene_edit(scene *s, void (*edit)(inputs *, void *), void *context, calc_error *error) {
    scene_mark before;
    calc_error mine;
    error_clear(&mine);
    scene_save(s, &before, true);
    edit(&s->in, context);
    if (all_holds(s, &mine)) {
        scene_keep(&before);
        return true;
    }
    scene_restore(s, &before);
    *error = mine;
    return false;
}

static bool start_program(scene *s, const load_step *press, calc_error *error) {
    scene_mark before;
    const fret_press *p;
    scene_save(s, &before, true);
    if (scene_append(s, press, NULL, error) && scene_press(s, &p, error)) {
        scene_keep(&before);
        return true;
    }
    scene_restore(s, &before);
    return false;
}

bool scene_load(scene *s, const load_step *step, const cycle_extra *extra, calc_error *error) {
    return step->kind == LOAD_PRESS ? start_program(s, step, error) : load_go_on(s, step, extra, error);
}
