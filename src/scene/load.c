/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The load program of a scene: appends possible steps, and runs it as far as answers need. Uses `text`. */
#include "scene/scene.h"

#include <math.h>

/* A program without tangential steps needs no friction: mu = 1 where there is none. */
static bool friction_for_program(scene *s, const load_reach *reach, double *mu, calc_error *error) {
    const bool given = inputs_any(&s->in, INPUT_BIT(IN_MU)) && inputs_know_nu(&s->in);
    long double v = 0;
    *mu = 1;
    if (!reach->by && given && !scene_get(s, IN_MU, &v, error))
        return false;
    return (!reach->by && !(v > 0)) || scene_friction(s, mu, error);
}

static bool rig_for_program(scene *s, double *K_rig, calc_error *error) {
    long double v = 0;
    if (!inputs_any(&s->in, INPUT_BIT(IN_K_RIG)))
        return calc_fail(error, 0, 0,
                         "the load is given by drig, but there is no rig (rig stiffness=80 N/um)");
    const bool ok = scene_get(s, IN_K_RIG, &v, error);
    *K_rig = (double)v;
    return ok;
}

bool load_press(scene *s, const fret_normal *normal, fret_press *out, calc_error *error) {
    const load_by by = (load_by)s->program->steps[0].normal;
    long double to;
    if (!scene_get(s, press_input(by), &to, error))
        return false;
    fret_status st = press_to(normal, by, (double)to, out);
    if (st.code == FRET_OUTSIDE && by == BY_RADIUS && to == fret_normal_end(normal))
        return calc_fail(error, 0, 0,
                         "the contact radius of a flat punch is b at any load: press by FN or dz");
    return calc_status(error, st);
}

bool scene_load_of(scene *s, load_view *out, calc_error *error) {
    const load_reach *reach;
    long double imposed;
    *out =
        (load_view){.program = s->program, .end = s->end, .in = &s->in, .stop = s->stop, .pulse = s->pulse};
    if (!scene_reach(s, &reach, error) || !scene_normal(s, &out->normal, error) ||
        !friction_for_program(s, reach, &out->mu, error) ||
        !scene_get(s, press_input((load_by)s->program->steps[0].normal), &imposed, error) ||
        (reach->rig && !rig_for_program(s, &out->K_rig, error)))
        return false;
    out->last_cycle = reach->last_cycle;
    return true;
}

/* From the first cycle with FNA on, a step must go by force, or to a displacement at constant F_N. */
static bool goes_with_sine(const load_step *step) {
    return step->tangential == BY_FORCE || (step->tangential && !load_moves_normal(step));
}

bool load_takes_sine(const load_view *load) {
    bool swings = false;
    for (load_mark at = {0, 0}; at.steps < load->end.steps; at.steps++) {
        const load_item item = program_item(load->program, at, load->last_cycle, load->in);
        swings = swings || (item.step.kind == LOAD_CYCLE && load_moves_normal(&item.step));
        if (swings && !goes_with_sine(&item.step))
            return false;
        at.cycles += item.step.kind == LOAD_CYCLE;
    }
    return fret_normal_swings(load->normal);
}

/* Makes as many runs as the load needs; new ones copy the state of the first. On error there is none. */
static fret_status raise_levels(answers *a, const load_view *load) {
    const bool sine = a->reach.swings && !a->chords && load_takes_sine(load);
    const unsigned wanted = a->reach.swings && !sine ? LEVELS : 1;
    fret_status st = status_ok;
    /* too many levels, or chords, may remain from a load that was refused */
    if (a->levels && ((a->run[0].engine.sine ? !sine : a->levels > wanted) ||
                      fret_contact_normal(a->run[0].engine.contact) != load->normal))
        runs_end(a->run, &a->levels);
    if (a->levels == 0) {
        a->run[0] = (runner){.load = load};
        st = engine_make(&a->run[0].engine, load->normal, load->mu);
        a->levels = !st.code;
    }
    a->run[0].engine.sine = sine;
    while (a->levels < wanted && !st.code) {
        runner *r = &a->run[a->levels];
        *r = a->run[0];
        r->level = a->levels;
        r->engine = (engine){.contact = NULL};
        st = engine_copy(&r->engine, &a->run[0].engine);
        a->levels++; /* counted even if incomplete, so that runs_end frees it */
    }
    if (st.code)
        runs_end(a->run, &a->levels);
    return st;
}

static fret_status run_levels(answers *a, const load_view *load) {
    fret_status st = status_ok;
    for (unsigned i = 0; i < a->levels && !st.code; i++) {
        a->run[i].load = load;
        st = run_to(&a->run[i], load->end);
    }
    if (!a->run[0].chorded)
        return st;
    a->chords = true; /* the contact opens: chords at all levels instead */
    runs_end(a->run, &a->levels);
    st = raise_levels(a, load);
    return st.code ? st : run_levels(a, load);
}

/* Runs the memory diagram to the end of the program, or to the step that fails (*steps). A single step that
 * is refused leaves the contact as it was; all other partial runs are dropped. */
static bool run_up(scene *s, size_t *steps, calc_error *error) {
    answers *a = &s->answers;
    load_view load;
    *steps = s->end.steps;
    if (a->levels && a->run[a->levels - 1].at.steps == s->end.steps)
        return true;
    if (!scene_load_of(s, &load, error))
        return false;
    if (s->end.steps > 1)
        s->used |= USED(MODEL_MEMORY);
    fret_status st = raise_levels(a, &load);
    if (st.code)
        return calc_status(error, st);
    const runner before = a->run[0];
    const bool chords = a->chords, single = a->levels == 1 && before.at.steps + 1 == s->end.steps &&
                                            s->program->steps[before.at.steps].kind == LOAD_STEP;
    st = run_levels(a, &load);
    if (!st.code)
        return true;
    for (unsigned i = 0; i < a->levels; i++)
        *steps = a->run[i].at.steps < *steps ? a->run[i].at.steps : *steps;
    if (single && st.code != FRET_INTERRUPTED)
        a->run[0] = before;
    else
        runs_end(a->run, &a->levels);
    a->chords = chords;
    return calc_status(error, st);
}

static bool catch_up(scene *s, calc_error *error) {
    size_t steps;
    return run_up(s, &steps, error);
}

/* A slide to a displacement at constant F_N is always possible, at a rig if there is one: it runs when a
 * result is asked for. */
static bool can_wait(scene *s, const load_step *step) {
    double K_rig;
    return s->answers.levels && load_is_slide(step) &&
           (step->tangential != BY_RIG || rig_for_program(s, &K_rig, error_quiet()));
}

/* Limit [m] of the depth of a step: the way back from farther has no digits left for the contact. A press,
 * which comes from nowhere, may have any depth. */
static const double DEEPEST = 1e8;

static bool append_step(scene *s, const load_step *step, const cycle_extra *extra, calc_error *error) {
    if (step->kind == LOAD_STEP && step->normal == BY_DISPLACEMENT && !(fabs(step->normal_value) < DEEPEST))
        return calc_fail(error, 0, 0, "dz = %.6g m: a step must stay less than 1e8 m deep",
                         step->normal_value);
    if (extra && s->end.cycles)
        program_freeze(s->program, program_last_cycle(s->program, s->end), s->end.cycles - 1, &s->in);
    if (!program_append(s->program, &s->end, step, extra))
        return calc_no_memory(error);
    program_to_inputs(step, extra, &s->in);
    if (extra) {
        s->settled &= ~INPUT_CYCLE;
        s->answers.reach.last_cycle = s->end.steps - 1;
    }
    scene_moved(s);
    return true;
}

bool scene_append(scene *s, const load_step *step, const cycle_extra *extra, calc_error *error) {
    const bool press = step->kind == LOAD_PRESS;
    program *own = press ? program_make() : program_copy(s->program, s->end);
    if (!own)
        return calc_no_memory(error);
    counted_drop(s->program);
    s->program = own;
    s->end = press ? (load_mark){0, 0} : s->end;
    const bool ok = append_step(s, step, extra, error);
    scene_forget(s);
    return ok;
}

bool load_go_on(scene *s, const load_step *step, const cycle_extra *extra, calc_error *error) {
    double mu;
    if (!s->end.steps)
        return calc_missing(error, IN_FN);
    if (step->tangential && !scene_friction(s, &mu, error))
        return false;
    if (can_wait(s, step))
        return append_step(s, step, extra, error);
    if (!catch_up(s, error))
        return false;
    const load_reach reached = s->answers.reach;
    const load_mark end = s->end;
    inputs before; /* a cycle changes the inputs */
    if (extra)
        inputs_copy(&before, &s->in);
    const bool ok = append_step(s, step, extra, error) && catch_up(s, error);
    if (!ok) {
        s->end = end;
        s->answers.reach = reached;
        if (extra) {
            inputs_drop(&s->in);
            inputs_copy(&s->in, &before);
        }
    }
    if (extra)
        inputs_drop(&before);
    return ok;
}

bool scene_load_rows(scene *s, load_step step, const double *normal, const double *tangential, size_t count,
                     size_t *row, calc_error *error) {
    const size_t first = s->end.steps;
    double mu;
    *row = 0;
    if (!scene_friction(s, &mu, error) || (!s->answers.levels && !catch_up(s, error)))
        return false;
    bool wait = true;
    for (size_t i = 0; i < count; i++) {
        step.normal_value = normal ? normal[i] : 0;
        step.tangential_value = tangential[i];
        wait = wait && can_wait(s, &step);
        if (!append_step(s, &step, NULL, error)) {
            *row = i;
            return false;
        }
    }
    size_t steps;
    if (wait || run_up(s, &steps, error))
        return true;
    *row = steps > first ? steps - first : 0;
    return false;
}

bool load_run(scene *s, const runner **run, calc_error *error) {
    *run = NULL;
    if (s->now) {
        *run = &s->now->run[s->now->levels - 1];
        return true;
    }
    if (!s->end.steps)
        return calc_missing(error, IN_FN);
    if (!catch_up(s, error))
        return false;
    *run = &s->answers.run[s->answers.levels - 1];
    return true;
}

bool scene_history(scene *s, const fret_contact **contact, calc_error *error) {
    const runner *run;
    if (!load_run(s, &run, error))
        return false;
    *contact = run->engine.contact;
    return true;
}

bool scene_straight(scene *s, const fret_contact **contact, calc_error *error) {
    if (!scene_history(s, contact, error))
        return false;
    if (!fret_contact_curved(*contact))
        return true;
    fret_contact **chords = &s->answers.chorded;
    const fret_normal *normal = fret_contact_normal(*contact);
    fret_status st = status_ok;
    if (*chords && fret_contact_normal(*chords) != normal) {
        fret_contact_free(*chords);
        *chords = NULL;
    }
    if (!*chords)
        st = fret_contact_make(normal, fret_contact_friction(*contact), FRET_EXACT, chords);
    if (!st.code)
        st = fret_contact_chords(*chords, *contact);
    *contact = *chords;
    return calc_status(error, st);
}
