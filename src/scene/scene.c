/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The life of a scene, its inputs, and saved states. Answers are in answers.c, checked changes in edit.c.
 * Uses the library and `text`. */
#include "scene/scene.h"

#include <math.h>

/* ---- life -------------------------------------------------------------------------------------- */

void friction_work_end(friction_work *w) {
    for (unsigned i = 0; i < LEVELS; i++) {
        fret_work_free(w->far[i]);
        fret_work_free(w->period[i]);
    }
    *w = (friction_work){.levels = 0};
}

/* Frees the fields of a state that has changed. */
static void forget_fields(answers *a) {
    fret_field_free(a->pressed);
    fret_field_free(a->dragged);
    fret_field_free(a->straight);
    a->pressed = a->dragged = a->straight = NULL;
    friction_work_end(&a->work);
}

static void answers_end(answers *a) {
    runs_end(a->run, &a->levels);
    fret_contact_free(a->chorded);
    forget_fields(a);
    counted_drop(a->worn); /* after runs and fields, which borrow laws */
    fret_normal_free(a->normal);
    fret_normal_free(a->k0);
    *a = (answers){.normal = NULL};
}

void scene_init(scene *s, const volatile sig_atomic_t *stop, scene_definition *evaluate, void *context) {
    static const volatile sig_atomic_t never;
    *s = (scene){.model = MODEL_AUTO, .stop = stop ? stop : &never, .evaluate = evaluate, .context = context};
}

void scene_moved(scene *s) {
    forget_fields(&s->answers);
    s->answers.press_ready = false;
    s->answers.state_ready = false;
}

void scene_look(scene *s, const instant *now) {
    s->now = now;
    scene_moved(s);
}

scene_use scene_answered_by(const scene *s) {
    return (scene_use){s->used, s->pieces_error};
}

void scene_also_used(scene *s, scene_use also) {
    if (also.models & USED(MODEL_PIECES))
        s->pieces_error =
            s->used & USED(MODEL_PIECES) ? fmax(s->pieces_error, also.pieces_error) : also.pieces_error;
    s->used |= also.models;
}

void scene_used_law(scene *s, const fret_normal *normal) {
    const double error = fret_normal_error(normal);
    if (!isnan(error))
        scene_also_used(s, (scene_use){USED(MODEL_PIECES), error});
}

void scene_forget(scene *s) {
    answers_end(&s->answers);
    s->settled = 0;
    s->sound = false;
}

/* Drops what a saved state replaces. */
static void drop_state(scene *s) {
    scene_forget(s);
    inputs_drop(&s->in);
    counted_drop(s->program);
    s->program = NULL;
    s->end = (load_mark){0, 0};
}

void scene_free(scene *s) {
    drop_state(s);
    for (int i = 0; i < 2; i++) {
        fret_normal_free(s->like[i]);
        s->like[i] = NULL;
    }
    counted_drop(s->wears);
    s->wears = NULL;
}

void scene_clone(scene *to, const scene *from) {
    *to = *from;
    to->answers = (answers){.normal = NULL};
    for (int i = 0; i < 2; i++)
        to->like[i] = from->like[i] ? fret_normal_hold(from->like[i]) : NULL;
    counted_hold(to->wears);
    inputs_copy(&to->in, &from->in);
    counted_hold(to->program);
}

void scene_reset(scene *s, bool all) {
    if (all) {
        scene_free(s);
        s->model = MODEL_AUTO;
        return;
    }
    scene_forget(s);
    counted_drop(s->program);
    s->program = NULL;
    s->end = (load_mark){0, 0};
    inputs_unset(&s->in, INPUT_CYCLE | INPUT_PRESS);
}

/* ---- saved states ------------------------------------------------------------------------------ */

void scene_save(scene *s, scene_mark *m, bool move) {
    inputs_copy(&m->in, &s->in);
    m->program = counted_hold(s->program);
    m->end = s->end;
    m->answers = (answers){.normal = NULL};
    if (move) {
        m->answers = s->answers;
        s->answers = (answers){.normal = NULL};
        s->settled = 0;
    }
}

void scene_keep(scene_mark *m) {
    inputs_drop(&m->in);
    counted_drop(m->program);
    m->program = NULL;
    answers_end(&m->answers);
}

void scene_restore(scene *s, scene_mark *m) {
    drop_state(s);
    s->in = m->in;
    s->program = m->program;
    s->end = m->end;
    s->answers = m->answers;
}

/* ---- inputs ------------------------------------------------------------------------------------ */

/* Moves a scene back to where a definition is evaluated: for an amplitude the beginning of its cycle, for all
 * others the press, with the amplitudes to come and earlier cycles as they were. */
static void rewind_for_definition(scene *then, bool amplitude) {
    const load_mark end = then->end;
    const bool cycle = !then->before && end.cycles > 0;
    const size_t steps = cycle ? program_last_cycle(then->program, end) : end.steps;
    then->now = NULL;
    if (cycle && amplitude)
        then->end = (load_mark){steps, end.cycles - 1};
    else if (!amplitude && end.steps > 1)
        then->end = (load_mark){1, 0};
    then->early = then->early || (!amplitude && steps > 1);
    then->before = then->before || cycle;
}

static bool settle(scene *s, input in, calc_error *error) {
    const input_set bit = INPUT_BIT(in);
    const bool amplitude = bit & INPUT_CYCLE;
    if (s->settling & bit) {
        error->circle = true;
        calc_missing(error, (int)in);
        return false;
    }
    scene then;
    value v = {0};
    scene_clone(&then, s);
    then.settling |= bit;
    if (in != IN_NW)
        rewind_for_definition(&then, amplitude);
    bool ok = s->evaluate(s->context, &then, in, s->in.bound[in], &v, error);
    scene_free(&then);
    if (!ok && (error->circle || error->strange))
        error->input = (int)in; /* whose definition is wrong, whatever the scene */
    if (amplitude && s->before && s->early && !error->circle) {
        error_clear(error);
        return calc_fail(error, 0, 0,
                         "an amplitude set by := has a value only from the beginning of its cycle");
    }
    if (!ok || !input_check(in, (double)v.v, error))
        return false;
    s->in.v[in] = (double)v.v;
    s->in.set[in] = true;
    s->settled |= bit;
    return true;
}

bool scene_settle(scene *s, input_set set, calc_error *error) {
    input_set waiting = s->in.bindings & set & ~s->settled;
    for (input in = 0; waiting >> in; in++)
        if (waiting & INPUT_BIT(in) && !settle(s, in, error))
            return false;
    return true;
}

/* The inputs that the value of `in` may come from; the dimension of A needs n. */
static input_set depends_on(const inputs *given, input in) {
    const input_set bit = INPUT_BIT(in);
    return in == IN_A                                      ? INPUT_GEOMETRY
           : in == IN_NU_2                                 ? bit | INPUT_BIT(IN_NU)
           : bit & INPUT_MODULI && !inputs_any(given, bit) ? INPUT_MATERIAL
                                                           : bit;
}

bool scene_get(scene *s, input in, long double *out, calc_error *error) {
    return scene_settle(s, depends_on(&s->in, in), error) && inputs_get(&s->in, in, out, error);
}

void scene_put(scene *s, input in, double v) {
    inputs_put(&s->in, in, v);
    scene_forget(s);
}

/* ---- the contact ------------------------------------------------------------------------------- */

bool scene_material(scene *s, bool homogeneous, fret_material *out, calc_error *error) {
    if (!scene_settle(s, INPUT_MATERIAL, error))
        return false;
    const double k = homogeneous ? 0 : s->in.v[IN_K];
    return (k == 0 || scene_settle(s, INPUT_BIT(IN_C0), error)) && inputs_material(&s->in, k, out, error);
}

bool scene_gap(scene *s, fret_gap *out, calc_error *error) {
    return scene_settle(s, INPUT_GEOMETRY, error) && inputs_gap(&s->in, out, error);
}

static bool make_normal(scene *s, bool homogeneous, fret_normal **out, calc_error *error) {
    fret_material material;
    fret_gap gap;
    if (!scene_material(s, homogeneous, &material, error) || !scene_gap(s, &gap, error))
        return false;
    fret_normal **like = &s->like[homogeneous];
    const fret_status st = fret_normal_make(&material, &gap, *like, s->stop, out);
    if (st.code)
        return calc_status(error, st);
    fret_normal_stop(*out, s->stop);
    fret_normal_free(*like);
    *like = fret_normal_hold(*out);
    return true;
}

bool scene_unworn(scene *s, calc_error *error) {
    return s->answers.normal || make_normal(s, false, &s->answers.normal, error);
}

bool scene_k0(scene *s, const fret_normal **normal, calc_error *error) {
    if (!s->answers.k0 && !make_normal(s, true, &s->answers.k0, error))
        return false;
    *normal = s->answers.k0;
    return true;
}

bool scene_friction(scene *s, double *mu, calc_error *error) {
    long double v = 0;
    if (!scene_get(s, IN_MU, &v, error))
        return false;
    *mu = (double)v;
    if (!(*mu > 0))
        return calc_fail(error, 0, 0, "mu = 0: without friction no Fx can be carried (friction 0.4)");
    return inputs_know_nu(&s->in) || calc_missing(error, IN_NU);
}

/* ---- the load ---------------------------------------------------------------------------------- */

double scene_time(const scene *s) {
    return s->now ? s->now->run->time : program_time(s->program, s->end);
}

bool scene_last_cycle(scene *s, load_item *out, calc_error *error) {
    if (!s->program || !s->end.cycles)
        return calc_fail(error, 0, 0, "no cycle has been run yet: use cycle FA=... or the function dW(FA)");
    if (!s->before && !scene_settle(s, INPUT_CYCLE, error))
        return false;
    const size_t i = program_last_cycle(s->program, s->end);
    *out = program_item(s->program, (load_mark){i, s->end.cycles - 1}, s->before ? NO_CYCLE : i, &s->in);
    return true;
}

static void reach_step(load_reach *r, const load_step *step, unsigned times) {
    const double v = step->tangential_value, size = fabs(v);
    if (!r->by)
        r->by = (load_by)step->tangential;
    r->alike = r->alike && step->tangential == r->by && !(step->relative & RELATIVE_TANGENTIAL);
    r->first = r->alike && size >= r->most;
    r->most = fmax(r->most, size);
    r->end = v;
    r->normal_varies = r->normal_varies || load_moves_normal(step);
    r->rig = r->rig || step->tangential == BY_RIG;
    if (step->kind == LOAD_CYCLE) { /* a second period always closes */
        r->closed = r->first || times > 1;
        r->swings = r->swings || step->normal_value != 0;
    }
}

bool scene_reach(scene *s, const load_reach **out, calc_error *error) {
    load_reach *r = &s->answers.reach;
    if (!s->end.steps)
        return calc_missing(error, IN_FN);
    if (s->end.cycles && !s->before && !scene_settle(s, INPUT_CYCLE, error))
        return false;
    if (!s->answers.reach_ready || r->seen.steps > s->end.steps) {
        *r = (load_reach){.seen = {1, 0}, .alike = true, .first = true};
        r->last_cycle = s->before ? NO_CYCLE : program_last_cycle(s->program, s->end);
        s->answers.reach_ready = true;
    }
    while (r->seen.steps < s->end.steps) {
        const load_step *step = &s->program->steps[r->seen.steps];
        if (step->kind == LOAD_CYCLE) {
            const load_item item = program_item(s->program, r->seen, r->last_cycle, &s->in);
            reach_step(r, &item.step, item.extra.times);
            r->seen.cycles++;
        } else {
            reach_step(r, step, 1);
        }
        r->seen.steps++;
    }
    *out = r;
    return true;
}
