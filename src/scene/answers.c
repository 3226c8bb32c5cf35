/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What follows from a scene, made ready on demand: the cheapest model answers that is exact. */
#include <math.h>

#include "scene/load.h"

static const fret_status fine = {FRET_OK, NULL, 0, 0};

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
    const fret_state *state;
    if (!scene_reach(s, &reach, error))
        return false;
    if (!s->now && !reach->normal_varies && s->program->steps[0].normal == BY_FORCE)
        return scene_get(s, IN_FN, FN, error);
    if (s->now ? !scene_forces(s, &state, error) : !scene_press(s, &press, error))
        return false;
    *FN = s->now ? state->FN : press->F;
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

/* The state at the end of runs at all levels. */
static void swinging_state(answers *a, const runner run[LEVELS]) {
    sight at[LEVELS], limit;
    for (unsigned i = 0; i < LEVELS; i++)
        run_sight(&run[i], &at[i]);
    sight_limit(at, &limit);
    a->state = limit.state;
    a->loss = limit.loss;
}

/* Of the load on its way. */
static bool widest_contact(scene *s, long double *a, calc_error *error) {
    scene_trace t;
    watch ends = watch_ends();
    fret_state state;
    ends.once = true;
    *a = 0;
    if (!trace_begin(&t, s, ends, false, error))
        return false;
    while (trace_next(&t, error)) {
        engine_state(&trace_now(&t)->engine, &state);
        *a = fmaxl(*a, state.a);
    }
    trace_end(&t);
    return !error->raised;
}

bool scene_engine(scene *s, const load_view *load, model_id model, unsigned count, engine *out,
                  calc_error *error) {
    long double a = 0;
    if (models[model].count && !widest_contact(s, &a, error))
        return false;
    const double radius = fmin((double)(a * (1 + 1e-12L)), (double)fret_normal_end(load->normal));
    fret_status st = engine_make(out, model, load->normal, load->mu, count, radius);
    return calc_status(error, &st);
}

/* A model that steps, other than the memory diagram, was asked for. */
static bool is_stepped(const scene *s) {
    return !s->automatic && s->model != MODEL_MEMORY && models[s->model].steps && !s->now;
}

/* At all levels that the load wants: they look at the load beside them. */
static bool stepped_state(scene *s, calc_error *error) {
    load_view load;
    runner run[LEVELS];
    unsigned made = 0;
    bool ok = scene_load_of(s, &load, error);
    const unsigned levels = s->answers.reach.swings ? LEVELS : 1;
    while (made < levels && ok) {
        runner *r = &run[made];
        *r = (runner){.load = &load, .level = made++};
        ok = scene_engine(s, &load, s->model, s->springs, &r->engine, error);
        fret_status st = ok ? run_to(r, load.end) : fine;
        ok = ok && calc_status(error, &st);
    }
    if (ok && levels > 1) {
        swinging_state(&s->answers, run);
    } else if (ok) {
        engine_state(&run[0].engine, &s->answers.state);
        s->answers.loss = run[0].cycle_loss;
    }
    while (made)
        engine_end(&run[--made].engine);
    return ok;
}

static void memory_state(scene *s, const runner *run) {
    answers *a = &s->answers;
    sight now;
    if (!s->now && a->levels > 1) {
        swinging_state(a, a->run);
        return;
    }
    run_sight(run, &now);
    a->state = now.state;
    a->loss = now.loss;
}

bool scene_state(scene *s, const fret_state **state, calc_error *error) {
    const bool stepped = is_stepped(s);
    const unsigned used = s->used; /* what only checks the load program does not answer */
    if (!s->answers.state_ready) {
        const runner *run = NULL;
        if (!load_run(s, &run, error))
            return false;
        if (!s->automatic && s->model == MODEL_CLOSED)
            return calc_fail(error, 0, 0, "no closed form for this: set model auto");
        if (stepped && !stepped_state(s, error))
            return false;
        if (!stepped)
            memory_state(s, run);
        s->answers.state_ready = true;
    }
    s->used = used | USED(stepped ? s->model : MODEL_MEMORY);
    if (!stepped && s->answers.levels)
        scene_used_law(s, fret_contact_normal(s->answers.run[0].engine.contact));
    *state = &s->answers.state;
    return true;
}

bool scene_forces(scene *s, const fret_state **state, calc_error *error) {
    answers *a = &s->answers;
    const runner *run = s->now ? s->now->run : NULL;
    if (!s->now || a->state_ready || run->coarse || (!s->automatic && s->model == MODEL_CLOSED))
        return scene_state(s, state, error);
    engine_forces(&run->engine, &a->state);
    s->used |= USED(MODEL_MEMORY);
    *state = &a->state;
    return true;
}

void scene_set_model(scene *s, bool automatic, model_id model, unsigned springs) {
    s->automatic = automatic;
    s->model = model;
    s->springs = springs;
    scene_moved(s);
}

/* ---- closed forms ------------------------------------------------------------------------------ */

void scene_used_closed(scene *s) {
    if (scene_is_power(s))
        s->used |= USED(MODEL_CLOSED);
    else if (s->answers.normal)
        scene_used_law(s, scene_is_worn(s) ? fret_wear_law(s->answers.worn->wear) : s->answers.normal);
}

static const load_reach *closed_reach(scene *s) {
    const load_reach *reach;
    const bool allowed = (s->automatic || s->model == MODEL_CLOSED) && !s->now && s->end.steps > 0;
    const bool closed = allowed && scene_reach(s, &reach, error_quiet());
    return closed && !reach->normal_varies && !reach->rig ? reach : NULL; /* at the rig a root is sought */
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
    fret_pressed contact;
    if (!scene_press(s, &press, error))
        return false;
    if (!reach->by) {
        *out = (fret_loading){0, 0, press->a, press->dz};
        return true;
    }
    if (!scene_contact(s, &contact, error))
        return false;
    fret_status st = reach->by == BY_FORCE ? fret_loading_by_force(&contact, reach->end, out)
                                           : fret_loading_by_displacement(&contact, reach->end, out);
    return calc_status(error, &st);
}

bool scene_cycle_loss(scene *s, long double *loss, calc_error *error) {
    load_item cycle;
    const fret_state *state;
    fret_pressed contact;
    const runner *run;
    if (s->now && !load_run(s, &run, error))
        return false;
    if (s->now && !run->closed)
        return calc_fail(error, 0, 0, "no cycle has been closed yet");
    if (!s->now && !scene_last_cycle(s, &cycle, error))
        return false;
    if (!scene_closed_loss(s)) {
        if (!scene_state(s, &state, error))
            return false;
        *loss = s->answers.loss;
        return true;
    }
    if (!scene_contact(s, &contact, error))
        return false;
    const double amplitude = cycle.step.tangential_value;
    fret_status st = cycle.step.tangential == BY_FORCE
                         ? fret_cycle_loss_by_force(&contact, amplitude, loss)
                         : fret_cycle_loss_by_displacement(&contact, amplitude, loss);
    return calc_status(error, &st);
}

/* ---- fields ------------------------------------------------------------------------------------ */

bool scene_pressed_field(scene *s, const fret_field **field, calc_error *error) {
    const fret_normal *normal;
    const fret_press *press;
    fret_status st = {.code = FRET_OK};
    if (!scene_normal(s, &normal, error) || !scene_press(s, &press, error))
        return false;
    if (!s->answers.pressed)
        st = fret_field_of_press(normal, press, &s->answers.pressed);
    *field = s->answers.pressed;
    return calc_status(error, &st);
}

bool scene_dragged_field(scene *s, const fret_field **field, calc_error *error) {
    const fret_contact *now;
    double mu;
    fret_status st = {.code = FRET_OK};
    s->used |= USED(MODEL_MEMORY);
    if (!scene_friction(s, &mu, error) || !scene_history(s, &now, error))
        return false;
    if (!s->answers.dragged)
        st = fret_field_make(now, &s->answers.dragged);
    *field = s->answers.dragged;
    return calc_status(error, &st);
}

bool scene_stress_field(scene *s, const fret_field **field, calc_error *error) {
    const load_reach *reach;
    const fret_contact *now, *straight;
    fret_status st = fine;
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
    st = fret_field_make(straight, &s->answers.straight);
    *field = s->answers.straight;
    return calc_status(error, &st);
}

/* ---- running it again -------------------------------------------------------------------------- */

bool trace_begin(scene_trace *t, scene *s, watch w, bool limit, calc_error *error) {
    const runner *unused;
    *t = (scene_trace){.levels = 0};
    if (!scene_load_of(s, &t->load, error))
        return false;
    const bool swings = s->answers.reach.swings, may_be_sine = swings && limit && load_takes_sine(&t->load);
    /* a load that cannot be is refused before anything of it is seen, and none is taken in two ways */
    if (!(s->sound && !may_be_sine) && (!load_run(s, &unused, error) || !scene_load_of(s, &t->load, error)))
        return false;
    s->used |= USED(MODEL_MEMORY);
    const bool sine = may_be_sine && s->answers.run[0].engine.sine, chords = swings && !sine;
    const unsigned levels = chords && limit ? LEVELS : 1;
    fret_status st = fine;
    while (t->levels < levels && !st.code) {
        runner *r = &t->run[t->levels];
        *r = (runner){.load = &t->load, .watch = w, .level = chords && !limit ? LEVELS - 1 : t->levels};
        st = engine_make(&r->engine, MODEL_MEMORY, t->load.normal, t->load.mu, 0, 0);
        r->engine.sine = sine;
        t->levels++;
    }
    if (st.code)
        trace_end(t);
    return calc_status(error, &st);
}

bool trace_next(scene_trace *t, calc_error *error) {
    bool there = false;
    for (unsigned i = 0; i < t->levels; i++) {
        runner *r = &t->run[i];
        there = run_next(r, t->load.end);
        if (!calc_status(error, &r->status))
            return false;
        if (i + 1 < t->levels)
            run_sight(r, &t->coarse[i]);
        else
            r->coarse = i ? t->coarse : NULL;
    }
    return there;
}

const runner *trace_now(const scene_trace *t) {
    return &t->run[t->levels - 1];
}

void trace_end(scene_trace *t) {
    while (t->levels)
        engine_end(&t->run[--t->levels].engine);
}
