/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The results of a scene, computed on demand by the cheapest exact model. Uses the library. */
#include <math.h>

#include "scene/scene.h"

/* ---- the normal contact now -------------------------------------------------------------------- */

static bool press_of_program(scene *s, calc_error *error) {
    const fret_normal *normal;
    return scene_normal(s, &normal, error) && load_press(s, normal, &s->answers.press, error);
}

bool scene_press(scene *s, const fret_press **press, calc_error *error) {
    const load_reach *reach;
    const runner *run;
    fret_state state;
    answers *a = &s->answers;
    *press = &a->press;
    if (!scene_reach(s, &reach, error))
        return false;
    const bool moves = reach->normal_varies || s->now;
    if (!a->press_ready) {
        if (!moves) {
            if (!press_of_program(s, error))
                return false;
        } else if (!load_run(s, &run, error)) {
            return false;
        } else {
            engine_state(&run->engine, &state);
            a->press = (fret_press){.F = state.FN, .dz = state.dz, .a = state.a};
        }
        a->press_ready = true;
    }
    if (moves)
        s->used |= USED(MODEL_MEMORY);
    else
        scene_used_closed(s);
    return true;
}

bool scene_FN(scene *s, long double *FN, calc_error *error) {
    const load_reach *reach;
    const fret_press *press;
    if (!scene_reach(s, &reach, error))
        return false;
    if (!s->now && !reach->normal_varies && s->program->steps[0].normal == BY_FORCE)
        return scene_get(s, IN_FN, FN, error);
    if (!scene_press(s, &press, error))
        return false;
    *FN = press->F;
    return true;
}

bool scene_contact(scene *s, fret_pressed *out, calc_error *error) {
    const fret_press *press;
    if (!scene_normal(s, &out->normal, error) || !scene_press(s, &press, error) ||
        !scene_friction(s, &out->mu, error))
        return false;
    out->press = *press;
    s->used |= ASKED_TANGENTIAL;
    return true;
}

/* ---- the tangential state ---------------------------------------------------------------------- */

bool scene_widest(scene *s, double *radius, calc_error *error) {
    scene_trace t;
    watch ends = watch_path(1);
    long double a = 0;
    fret_state state;
    ends.once = true;
    if (!trace_begin(&t, s, ends, false, error))
        return false;
    while (trace_next(&t, error)) {
        engine_state(&trace_now(&t)->engine, &state);
        a = fmaxl(a, state.a);
    }
    *radius = fmin((double)(a * (1 + 1e-12L)), (double)fret_normal_end(t.load.normal));
    trace_end(&t);
    return !error->raised;
}

/* Was another model than the memory diagram chosen to step? */
static bool is_springs(const scene *s) {
    return s->model == MODEL_SPRINGS && !s->now;
}

/* Runs the springs at all levels that the load needs. */
static bool springs_state(scene *s, calc_error *error) {
    load_view load;
    runner run[LEVELS];
    double radius;
    unsigned made = 0;
    fret_status st = status_ok;
    if (!scene_load_of(s, &load, error) || !scene_widest(s, &radius, error))
        return false;
    const unsigned levels = s->answers.reach.swings ? LEVELS : 1;
    while (made < levels && !st.code) {
        runner *r = &run[made];
        *r = (runner){.load = &load, .level = made++};
        st = engine_springs(&r->engine, load.normal, load.mu, s->springs, radius, FRET_WEIGHT_CELL);
        if (!st.code)
            st = run_to(r, load.end);
    }
    if (!st.code)
        run_view_now(run, levels, &s->answers.end);
    runs_end(run, &made);
    return calc_status(error, st);
}

bool scene_state(scene *s, const fret_state **state, calc_error *error) {
    answers *a = &s->answers;
    const bool springs = is_springs(s);
    const unsigned used = s->used; /* the run that checks the program does not count as an answer */
    if (!a->state_ready) {
        const runner *run = NULL;
        if (!load_run(s, &run, error))
            return false;
        if (s->model == MODEL_CLOSED)
            return calc_fail(error, 0, 0, "no closed form for this: set model auto");
        if (springs && !springs_state(s, error))
            return false;
        if (!springs)
            run_view_now(s->now ? s->now->run : a->run, s->now ? s->now->levels : a->levels, &a->end);
        a->state_ready = true;
    }
    s->used = used | USED(springs ? MODEL_SPRINGS : MODEL_MEMORY);
    if (!springs && a->levels)
        scene_used_law(s, fret_contact_normal(a->run[0].engine.contact));
    *state = &a->end.state;
    return true;
}

void scene_set_model(scene *s, model_id model, unsigned springs) {
    s->model = model;
    s->springs = springs;
    scene_moved(s);
}

/* ---- closed forms ------------------------------------------------------------------------------ */

bool scene_loading(scene *s, bool by_force, double v, fret_loading *out, calc_error *error) {
    fret_pressed contact;
    if (!scene_contact(s, &contact, error))
        return false;
    return calc_status(error,
                       (by_force ? fret_loading_by_force : fret_loading_by_displacement)(&contact, v, out));
}

bool scene_loss(scene *s, bool by_force, double amplitude, long double *out, calc_error *error) {
    fret_pressed contact;
    if (!scene_contact(s, &contact, error))
        return false;
    return calc_status(error, (by_force ? fret_cycle_loss_by_force
                                        : fret_cycle_loss_by_displacement)(&contact, amplitude, out));
}

void scene_used_closed(scene *s) {
    if (scene_is_power(s))
        s->used |= USED(MODEL_CLOSED);
    else if (s->answers.normal)
        scene_used_law(s, scene_is_worn(s) ? fret_wear_law(s->answers.worn->wear) : s->answers.normal);
}

static const load_reach *closed_reach(scene *s) {
    const load_reach *reach;
    const bool allowed = (s->model == MODEL_AUTO || s->model == MODEL_CLOSED) && !s->now && s->end.steps > 0;
    const bool closed = allowed && scene_reach(s, &reach, error_quiet());
    return closed && !reach->normal_varies && !reach->rig ? reach : NULL; /* a rig needs a root */
}

bool scene_closed_state(scene *s) {
    const load_reach *reach = closed_reach(s);
    return reach && reach->first;
}

bool scene_closed_loss(scene *s) {
    const load_reach *reach = closed_reach(s);
    return reach && reach->closed;
}

bool scene_first_loading(scene *s, fret_loading *out, calc_error *error) {
    const fret_press *press;
    const load_reach *reach = &s->answers.reach;
    if (!scene_press(s, &press, error))
        return false;
    if (!reach->by) {
        *out = (fret_loading){0, 0, press->a, press->dz};
        return true;
    }
    const bool ok = scene_loading(s, reach->by == BY_FORCE, reach->end, out, error);
    if (!ok && error->kind == ERROR_STATUS && error->status.code == FRET_GROSS_SLIP &&
        reach->last_cycle + 1 == s->end.steps)
        error->status.quantity = "FA"; /* as the error of a cycle that is run */
    return ok;
}

bool scene_cycle_loss(scene *s, long double *loss, calc_error *error) {
    load_item cycle;
    const fret_state *state;
    const runner *run;
    if (s->now && !load_run(s, &run, error))
        return false;
    if (s->now && !run->closed)
        return calc_fail(error, 0, 0, "no cycle has been closed yet");
    if (!s->now && !scene_last_cycle(s, &cycle, error))
        return false;
    if (scene_closed_loss(s))
        return scene_loss(s, cycle.step.tangential == BY_FORCE, cycle.step.tangential_value, loss, error);
    if (!scene_state(s, &state, error))
        return false;
    *loss = s->answers.end.loss;
    return true;
}

/* ---- fields ------------------------------------------------------------------------------------ */

bool scene_pressed_field(scene *s, const fret_field **field, calc_error *error) {
    const fret_normal *normal;
    const fret_press *press;
    fret_status st = status_ok;
    if (!scene_normal(s, &normal, error) || !scene_press(s, &press, error))
        return false;
    if (!s->answers.pressed)
        st = fret_field_of_press(normal, press, &s->answers.pressed);
    *field = s->answers.pressed;
    return calc_status(error, st);
}

bool scene_dragged_field(scene *s, const fret_field **field, calc_error *error) {
    const fret_contact *now;
    double mu;
    fret_status st = status_ok;
    s->used |= USED(MODEL_MEMORY);
    if (!scene_friction(s, &mu, error) || !scene_history(s, &now, error))
        return false;
    if (!s->answers.dragged)
        st = fret_field_make(now, &s->answers.dragged);
    *field = s->answers.dragged;
    return calc_status(error, st);
}

bool scene_stress_field(scene *s, const fret_field **field, calc_error *error) {
    const load_reach *reach;
    const fret_contact *now, *straight;
    if (!scene_reach(s, &reach, error))
        return false;
    if (!reach->by)
        return scene_pressed_field(s, field, error);
    if (s->answers.straight) {
        *field = s->answers.straight;
        return true;
    }
    if (!scene_dragged_field(s, field, error) || !scene_history(s, &now, error))
        return false;
    if (!fret_contact_curved(now))
        return true;
    if (!scene_straight(s, &straight, error))
        return false;
    const fret_status st = fret_field_make(straight, &s->answers.straight);
    *field = s->answers.straight;
    return calc_status(error, st);
}

/* ---- running it again -------------------------------------------------------------------------- */

bool trace_begin(scene_trace *t, scene *s, watch w, bool limit, calc_error *error) {
    const runner *unused;
    *t = (scene_trace){.levels = 0};
    if (!scene_load_of(s, &t->load, error))
        return false;
    const bool swings = s->answers.reach.swings, may_be_sine = swings && limit && load_takes_sine(&t->load);
    /* an impossible load is refused before its first look; sine or chords are for the whole load */
    if (!(s->sound && !may_be_sine) && (!load_run(s, &unused, error) || !scene_load_of(s, &t->load, error)))
        return false;
    s->used |= USED(MODEL_MEMORY);
    const bool sine = may_be_sine && s->answers.run[0].engine.sine, chords = swings && !sine;
    const unsigned levels = chords && limit ? LEVELS : 1;
    fret_status st = status_ok;
    while (t->levels < levels && !st.code) {
        runner *r = &t->run[t->levels];
        *r = (runner){.load = &t->load, .watch = w, .level = chords && !limit ? LEVELS - 1 : t->levels};
        st = engine_make(&r->engine, t->load.normal, t->load.mu);
        r->engine.sine = sine;
        t->levels++;
    }
    if (st.code)
        trace_end(t);
    return calc_status(error, st);
}

bool trace_next(scene_trace *t, calc_error *error) {
    bool there = false;
    for (unsigned i = 0; i < t->levels; i++) {
        runner *r = &t->run[i];
        there = run_next(r, t->load.end);
        if (!calc_status(error, r->status))
            return false;
    }
    return there;
}

const runner *trace_now(const scene_trace *t) {
    return &t->run[t->levels - 1];
}

void trace_end(scene_trace *t) {
    runs_end(t->run, &t->levels);
}
