/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Changes of a scene that succeed completely or leave it as it was: of its inputs, and of its load. Uses
 * answers; no answer uses this file. */
#include "scene/scene.h"

/* Are the inputs that are given within their ranges? */
static bool given_holds(const scene *s, calc_error *error) {
    for (input in = 0; in < INPUTS; in++)
        if (s->in.set[in] && !(s->in.bindings & INPUT_BIT(in)) && !input_check(in, s->in.v[in], error))
            return false;
    return true;
}

/* Before a load, what is missing may follow: an input, or what a definition uses (c0 := a0). */
static bool begins(scene *s, calc_error *error) {
    const fret_normal *normal;
    fret_material material;
    calc_error mine;
    error_clear(&mine);
    const bool known = scene_settle(s, INPUT_MATERIAL, &mine);
    if ((!known && !s->in.geometry) || (known && inputs_material(&s->in, s->in.v[IN_K], &material, &mine) &&
                                        (!s->in.geometry || scene_normal(s, &normal, &mine))))
        return true;
    if (mine.kind == ERROR_MISSING && !mine.circle && !mine.stop)
        return true;
    *error = mine;
    return false;
}

static bool program_holds(scene *s, calc_error *error) {
    const fret_contact *contact;
    const fret_press *press;
    long double mu;
    if (s->end.steps == 0)
        return begins(s, error);
    const bool friction = inputs_any(&s->in, INPUT_BIT(IN_MU));
    return (!friction || scene_get(s, IN_MU, &mu, error)) && scene_press(s, &press, error) &&
           (!(friction || s->end.steps > 1) || scene_history(s, &contact, error));
}

/* Are the inputs that follow from others within their ranges and no circle, even if nothing needs them yet?
 * One that has no value may wait. */
static bool bound_holds(scene *s, calc_error *error) {
    for (input in = 0; s->in.bindings >> in; in++) {
        calc_error mine;
        long double v;
        error_clear(&mine);
        if (s->in.bindings & INPUT_BIT(in) && !scene_get(s, in, &v, &mine) &&
            (mine.stop || mine.circle || mine.strange || (mine.kind == ERROR_STATUS && mine.input >= 0))) {
            *error = mine;
            return false;
        }
    }
    return true;
}

/* Are all inputs and the program valid together? */
static bool all_holds(scene *s, calc_error *error) {
    return given_holds(s, error) && program_holds(s, error) && bound_holds(s, error);
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
    scene_save(s, &before, true);
    if (scene_append(s, press, NULL, error) && all_holds(s, error)) {
        scene_keep(&before);
        return true;
    }
    scene_restore(s, &before);
    return false;
}

bool scene_load(scene *s, const load_step *step, const cycle_extra *extra, calc_error *error) {
    return step->kind == LOAD_PRESS ? start_program(s, step, error) : load_go_on(s, step, extra, error);
}
