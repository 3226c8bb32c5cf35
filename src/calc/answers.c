/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What follows from a scene, made ready on demand: the load program is run as far as it has grown, the
 * cheapest model that is exact answers. */
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "number/array.h"

#include "calc/scene.h"

static const fret_status fine = {FRET_OK, NULL, 0, 0};

static bool used_pieces(scene *s, const fret_normal *normal) {
    const double error = fret_normal_prepared(normal);
    if (isnan(error))
        return false;
    scene_also_used(s, (scene_use){USED(MODEL_PIECES), error});
    return true;
}

/* ---- running the program ----------------------------------------------------------------------- */

/* A press alone can be shown without friction. */
static bool friction_for_program(scene *s, double *mu, calc_error *error) {
    *mu = 1;
    return (!s->in.set[IN_MU] && !(s->in.bindings & INPUT_BIT(IN_MU)) && s->end.steps <= 1) ||
           scene_friction(s, mu, error);
}

static bool press_by(scene *s, const fret_normal *normal, fret_press *out, calc_error *error) {
    const load_step *step = &s->program->steps[0];
    long double by = step->normal_value;
    if (step->normal == BY_FORCE && !scene_get(s, IN_FN, &by, error))
        return false;
    fret_status st = step->normal == BY_FORCE          ? fret_press_by_force(normal, (double)by, out)
                     : step->normal == BY_DISPLACEMENT ? fret_press_by_depth(normal, (double)by, out)
                                                       : fret_press_by_radius(normal, (double)by, out);
    return calc_status(error, &st);
}

/* The largest F_N of the load; a gap that does not carry it refuses it where it comes to it. */
static double force_of_load(const load_reach *reach, const fret_normal *normal, const fret_press *press) {
    const double dz = fmax((double)press->dz, reach->dz_most) + reach->dz_more;
    const double FN = fmax((double)press->F, reach->FN_most) + reach->FN_more;
    fret_press deepest;
    return dz == (double)press->dz || fret_press_by_depth(normal, dz, &deepest).code
               ? FN
               : fmax(FN, (double)deepest.F);
}

/* Values along an oblique path are many, and so are the rows of some tables; a power law needs nothing of the
 * kind. */
static bool normal_of_load(scene *s, const load_reach *reach, const fret_normal **out, calc_error *error) {
    fret_press press;
    if (!scene_normal(s, out, error))
        return false;
    const bool asked = s->many || reach->oblique;
    if (fret_normal_is_power(*out) || (!asked && !fret_normal_dense(*out, fret_normal_end(*out))))
        return true;
    return press_by(s, *out, &press, error) &&
           ((!asked && !fret_normal_dense(*out, press.a)) ||
            scene_many_normal(s, force_of_load(reach, *out, &press), out, error));
}

bool scene_load_of(scene *s, load_view *out, calc_error *error) {
    const load_reach *reach;
    long double FN;
    *out = (load_view){.program = s->program,
                       .end = s->end,
                       .in = &s->in,
                       .stop = s->stop,
                       .pulse = s->pulse,
                       .trailed = s->trailed};
    if (!scene_reach(s, &reach, error) || !normal_of_load(s, reach, &out->normal, error) ||
        !friction_for_program(s, &out->mu, error))
        return false;
    if (s->program->steps[0].normal == BY_FORCE && !scene_get(s, IN_FN, &FN, error))
        return false;
    out->last_cycle = reach->last_cycle;
    return true;
}

static void drop_runs(answers *a) {
    for (unsigned i = 0; i < LEVELS; i++)
        engine_end(&a->run[i].engine);
    a->levels = 0;
}

/* From the first swinging cycle on: by force, or to a displacement at constant F_N. */
static bool goes_with_sine(const load_step *step) {
    return step->tangential == BY_FORCE || (step->tangential == BY_DISPLACEMENT && !load_moves_normal(step));
}

/* Can a swinging load be taken as it is? On no table of rows. */
static bool takes_sine(const load_view *load) {
    bool swings = false;
    for (load_mark at = {0, 0}; at.steps < load->end.steps; at.steps++) {
        const load_item item = program_item(load->program, at, load->last_cycle, load->in);
        swings = swings || (item.step.kind == LOAD_CYCLE && load_moves_normal(&item.step));
        if (swings && !goes_with_sine(&item.step))
            return false;
        at.cycles += item.step.kind == LOAD_CYCLE;
    }
    return fret_swing_takes(load->normal);
}

/* As many runs as the load wants, or none: those that are new start where the first one is. */
static fret_status raise_levels(answers *a, const load_view *load) {
    const bool sine = a->reach.swings && !a->chords && takes_sine(load);
    const unsigned wanted = a->reach.swings && !sine ? LEVELS : 1;
    fret_status st = fine;
    /* more than are wanted: in chords, as a load that was refused would have had them */
    if (a->levels && ((engine_is_sine(&a->run[0].engine) ? !sine : a->levels > wanted) ||
                      engine_normal(&a->run[0].engine) != load->normal))
        drop_runs(a);
    if (a->levels == 0) {
        if (load->trailed && !a->trail)
            a->trail = calloc(1, sizeof *a->trail); /* without it figures take longer */
        a->run[0] = (runner){.load = load, .trail = a->trail};
        st = engine_make(&a->run[0].engine, MODEL_MEMORY, load->normal, load->mu, 0, 0);
        a->levels = !st.code;
    }
    if (sine && !st.code && !engine_is_sine(&a->run[0].engine))
        st = engine_to_sine(&a->run[0].engine);
    while (a->levels < wanted && !st.code) {
        runner *r = &a->run[a->levels];
        *r = a->run[0];
        r->level = a->levels;
        r->engine.self = NULL;
        r->trail = NULL;
        st = engine_copy(&r->engine, &a->run[0].engine, load->normal, load->mu);
        a->levels++; /* to be dropped, too, if there is only half of it */
    }
    if (st.code)
        drop_runs(a);
    return st;
}

static fret_status run_levels(answers *a, const load_view *load) {
    fret_status st = fine;
    for (unsigned i = 0; i < a->levels && !st.code; i++) {
        a->run[i].load = load;
        st = run_to(&a->run[i], load->end);
    }
    if (!a->run[0].chorded)
        return st;
    a->chords = true; /* the contact opens: what is not the sine itself wants its limit */
    drop_runs(a);
    st = raise_levels(a, load);
    return st.code ? st : run_levels(a, load);
}

/* Brings the memory up to the end of the program, or to the step at which it fails. */
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
    if (!st.code)
        st = run_levels(a, &load);
    if (st.code) {
        for (unsigned i = 0; i < a->levels; i++)
            *steps = a->run[i].at.steps < *steps ? a->run[i].at.steps : *steps;
        drop_runs(a); /* half-run: not to be used */
    }
    return calc_status(error, &st);
}

static bool catch_up(scene *s, calc_error *error) {
    size_t steps;
    return run_up(s, &steps, error);
}

/* Keeps the contacts as they are; the storage is used again. */
static fret_status keep_spares(answers *a, const load_view *load) {
    fret_status st = fine;
    for (unsigned i = 0; i < a->levels && !st.code; i++) {
        engine kept = a->spare[i].engine;
        a->spare[i] = a->run[i];
        a->spare[i].engine = kept;
        st = engine_copy(&a->spare[i].engine, &a->run[i].engine, load->normal, load->mu);
    }
    return st;
}

static void use_spares(answers *a) {
    for (unsigned i = 0; i < a->levels; i++) {
        runner half = a->run[i];
        a->run[i] = a->spare[i];
        a->spare[i] = half;
    }
}

/* The diagram in double was asked for, which tells the state without the exact one. */
static bool by_double(const scene *s) {
    return !s->automatic && s->model == MODEL_DOUBLE && !s->now && s->answers.normal &&
           fret_normal_is_power(s->answers.normal);
}

/* Can the step not fail? Both forces, or both displacements, well within what friction and the range of
 * numbers allow. */
static bool is_tame(const load_step *step, double mu) {
    const double normal = step->normal_value, tangential = fabs(step->tangential_value);
    if (step->kind != LOAD_STEP || step->relative || step->normal != step->tangential || !(normal >= 1e-30) ||
        !(normal <= 1e30))
        return false;
    return step->normal == BY_FORCE ? tangential <= mu * normal * (1 - 1e-12) : tangential <= 1e30;
}

/* What is always possible waits until a result is asked: to slide to a displacement at constant F_N, and,
 * where the exact diagram is not to answer, any step that cannot fail. */
static bool can_wait(const scene *s, const load_step *step, double mu) {
    return s->answers.levels && (load_is_slide(step) || (by_double(s) && is_tame(step, mu)));
}

static bool start_program(scene *s, const load_step *press, calc_error *error) {
    scene_mark before;
    const fret_press *p;
    scene_save(s, &before, true);
    if (scene_append(s, press, NULL, error) && scene_press(s, &p, error)) {
        scene_drop(&before);
        return true;
    }
    scene_back(s, &before);
    return false;
}

/* The step that has just been appended. A single step leaves the memory as it was when it fails; a cycle, or
 * one of several levels, needs the spares. */
static bool run_appended(scene *s, bool whole, calc_error *error) {
    answers *a = &s->answers;
    load_view load;
    if (!scene_load_of(s, &load, error))
        return false;
    fret_status st = raise_levels(a, &load);
    const bool spares = whole || a->levels > 1, chords = a->chords;
    const runner before = a->run[0];
    if (!st.code && spares)
        st = keep_spares(a, &load);
    if (st.code)
        return calc_status(error, &st);
    st = run_levels(a, &load);
    if (!st.code)
        return true;
    if (a->chords != chords) /* begun anew: to be run again when it is asked for */
        drop_runs(a);
    else if (spares)
        use_spares(a);
    else
        a->run[0] = before;
    a->chords = chords;
    return calc_status(error, &st);
}

static bool append_step(scene *s, const load_step *step, const cycle_extra *extra, calc_error *error) {
    if (extra && s->end.cycles)
        program_freeze(s->program, program_last_cycle(s->program, s->end), s->end.cycles - 1, &s->in);
    if (!program_append(s->program, &s->end, step, extra))
        return calc_no_memory(error);
    if (extra) {
        program_to_inputs(step, extra, &s->in);
        s->settled &= ~INPUT_CYCLE;
        s->answers.reach.last_cycle = s->end.steps - 1;
    }
    s->answers.state_ready = s->answers.press_ready = false;
    return true;
}

bool scene_load(scene *s, const load_step *step, const cycle_extra *extra, calc_error *error) {
    double mu;
    if (step->kind == LOAD_PRESS)
        return start_program(s, step, error);
    if (!s->end.steps)
        return calc_missing(error, IN_FN);
    if (!scene_friction(s, &mu, error))
        return false;
    if (can_wait(s, step, mu))
        return append_step(s, step, extra, error);
    if (!catch_up(s, error))
        return false;
    const load_reach reached = s->answers.reach;
    const load_mark end = s->end;
    inputs before; /* a cycle changes them */
    if (extra)
        inputs_copy(&before, &s->in);
    bool ok = append_step(s, step, extra, error) && run_appended(s, extra != NULL, error);
    if (ok) {
        s->used |= USED(MODEL_MEMORY);
    } else {
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
        step.normal_value = normal[i];
        step.tangential_value = tangential[i];
        wait = wait && can_wait(s, &step, mu);
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

/* The run that has come to the end of the program, or to now. */
static bool present_run(scene *s, const runner **run, calc_error *error) {
    *run = s->now ? s->now->run : NULL;
    if (s->now && !*run) {
        *s->now->lacking = true;
        return calc_fail(error, 0, 0, "only forces are known here"); /* to be asked of a run again */
    }
    if (s->now)
        return true;
    if (!s->end.steps)
        return calc_missing(error, IN_FN);
    if (!catch_up(s, error))
        return false;
    *run = &s->answers.run[s->answers.levels - 1];
    return true;
}

bool scene_memory(scene *s, const fret_memory **memory, calc_error *error) {
    const runner *run;
    if (!present_run(s, &run, error))
        return false;
    *memory = engine_memory(&run->engine);
    return *memory || calc_no_memory(error);
}

bool scene_curve(scene *s, const fret_swing **curve, calc_error *error) {
    const runner *run;
    if (!present_run(s, &run, error))
        return false;
    *curve = engine_curve(&run->engine);
    return true;
}

/* ---- the normal contact now -------------------------------------------------------------------- */

static bool press_of_program(scene *s, calc_error *error) {
    const fret_normal *normal;
    return scene_normal(s, &normal, error) && press_by(s, normal, &s->answers.press, error);
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
        } else if (by_double(s)) {
            const fret_state *now;
            if (!scene_state(s, &now, error))
                return false;
            a->press = (fret_press){.F = now->FN, .dz = now->dz, .a = now->a};
        } else if (!present_run(s, &run, error)) {
            return false;
        } else {
            engine_state(&run->engine, &state);
            a->press = (fret_press){.F = state.FN, .dz = state.dz, .a = state.a};
        }
        a->press_ready = true;
    }
    if (moves)
        s->used |= USED(by_double(s) ? MODEL_DOUBLE : MODEL_MEMORY);
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

bool scene_contact(scene *s, fret_contact *out, calc_error *error) {
    const fret_press *press;
    if (!scene_normal(s, &out->normal, error) || !scene_press(s, &press, error) ||
        !scene_friction(s, &out->mu, error))
        return false;
    out->press = *press;
    const bool many = (s->many || fret_normal_dense(out->normal, press->a)) && press->F > 0 &&
                      !fret_normal_is_power(out->normal);
    if (many && !scene_many_normal(s, (double)press->F, &out->normal, error))
        return false;
    if (many && used_pieces(s, out->normal))
        s->used &= ~USED(MODEL_QUADRATURE);
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

static bool widest(const runner *r, void *context) {
    long double *a = context;
    fret_state state;
    engine_state(&r->engine, &state);
    *a = fmaxl(*a, state.a);
    return true;
}

bool scene_engine(scene *s, const load_view *load, model_id model, unsigned count, engine *out,
                  calc_error *error) {
    long double a = 0;
    watch w = watch_ends();
    w.see = widest;
    w.once = true;
    w.context = &a;
    if (models[model].count && !scene_trace(s, &w, error))
        return false;
    if (models[model].power && !fret_normal_is_power(load->normal))
        return calc_fail(error, 0, 0, "`%s` is for gaps of a single power: set model auto",
                         models[model].name);
    fret_status st = engine_make(out, model, load->normal, load->mu, count, (double)(a * (1 + 1e-12L)));
    return calc_status(error, &st);
}

/* A model that steps, other than the memory diagram, was asked for. */
static bool is_stepped(const scene *s) {
    return !s->automatic && s->model != MODEL_MEMORY && models[s->model].make && !s->now;
}

bool scene_runs(scene *s, runs *out, calc_error *error) {
    *out = (runs){.levels = 0};
    bool ok = scene_load_of(s, &out->load, error);
    const unsigned levels = s->answers.reach.swings ? LEVELS : 1;
    while (out->levels < levels && ok) {
        runner *r = &out->run[out->levels];
        *r = (runner){.load = &out->load, .level = out->levels++};
        ok = scene_engine(s, &out->load, s->model, s->springs, &r->engine, error);
        fret_status st = ok ? run_to(r, out->load.end) : fine;
        ok = ok && calc_status(error, &st);
    }
    if (!ok)
        runs_end(out);
    return ok;
}

void runs_end(runs *r) {
    while (r->levels)
        engine_end(&r->run[--r->levels].engine);
}

static bool stepped_state(scene *s, calc_error *error) {
    runs all;
    if (!scene_runs(s, &all, error))
        return false;
    if (all.levels > 1) {
        swinging_state(&s->answers, all.run);
    } else {
        engine_state(&all.run[0].engine, &s->answers.state);
        s->answers.loss = all.run[0].cycle_loss;
    }
    runs_end(&all);
    return true;
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
        if (!(by_double(s) && s->end.steps > 0) && !present_run(s, &run, error))
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
        used_pieces(s, engine_normal(&s->answers.run[0].engine));
    *state = &s->answers.state;
    return true;
}

bool scene_forces(scene *s, const fret_state **state, calc_error *error) {
    answers *a = &s->answers;
    const runner *run = s->now ? s->now->run : NULL;
    if (!s->now || a->state_ready || (run && run->coarse) || (!s->automatic && s->model == MODEL_CLOSED))
        return scene_state(s, state, error);
    const double *kept = s->now->kept;
    if (kept)
        a->state = (fret_state){.FN = kept[TRAIL_FN],
                                .dz = kept[TRAIL_DZ],
                                .Fx = kept[TRAIL_FX],
                                .dx = kept[TRAIL_DX],
                                .W = kept[TRAIL_W]};
    else
        engine_forces(&run->engine, &a->state);
    s->used |= USED(MODEL_MEMORY);
    *state = &a->state;
    return true;
}

void scene_set_model(scene *s, bool automatic, model_id model, unsigned springs) {
    s->automatic = automatic;
    s->model = model;
    s->springs = springs;
    s->answers.state_ready = s->answers.press_ready = false;
}

/* ---- closed forms ------------------------------------------------------------------------------ */

void scene_used_closed(scene *s) {
    s->used |= USED(s->in.geometry->power ? MODEL_CLOSED : MODEL_QUADRATURE);
}

static const load_reach *closed_reach(scene *s) {
    const load_reach *reach;
    calc_error ignored;
    error_clear(&ignored);
    const bool allowed = (s->automatic || s->model == MODEL_CLOSED) && !s->now && s->end.steps > 0;
    return allowed && scene_reach(s, &reach, &ignored) && !reach->normal_varies ? reach : NULL;
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
    fret_contact contact;
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
    fret_contact contact;
    const runner *run;
    if (s->now && !present_run(s, &run, error))
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

/* ---- running it again -------------------------------------------------------------------------- */

/* What the coarser levels saw, look by look. */
typedef struct looks {
    sight (*at)[LEVELS - 1];
    size_t count, room, next;
    unsigned level; /* that looks on now */
    runner *finest;
    const watch *for_whom;
    bool no_memory;
} looks;

static bool keep_look(const runner *r, void *context) {
    looks *l = context;
    if (l->level == 0) {
        void *grown = fret_array_for(l->at, &l->room, l->count + 1, sizeof *l->at);
        l->no_memory = !grown;
        if (!grown)
            return false;
        l->at = grown;
        l->count++;
    }
    if (l->next < l->count)
        run_sight(r, &l->at[l->next++][l->level]);
    return true;
}

static bool look_deeper(const runner *r, void *context) {
    looks *l = context;
    l->finest->coarse = l->next < l->count ? l->at[l->next++] : NULL;
    return l->for_whom->see(r, l->for_whom->context);
}

static fret_status trace_level(const load_view *load, unsigned level, bool sine, watch *w, looks *before,
                               bool *halted) {
    runner r = {.load = load, .watch = w, .level = level};
    if (before)
        before->finest = &r;
    fret_status st = engine_make(&r.engine, MODEL_MEMORY, load->normal, load->mu, 0, 0);
    if (sine && !st.code)
        st = engine_to_sine(&r.engine);
    if (!st.code)
        st = run_to(&r, load->end);
    engine_end(&r.engine);
    *halted = r.halted;
    return st;
}

/* All levels, one after the other: whoever looks on sees the finest, and with it the limit. */
static fret_status trace_limit(const load_view *load, watch *w, bool *halted, bool *no_memory) {
    looks l = {.for_whom = w};
    fret_status st = fine;
    for (; l.level < LEVELS && !st.code; l.level++) {
        watch at = *w;
        at.see = l.level < LEVELS - 1 ? keep_look : look_deeper;
        at.context = &l;
        l.next = 0;
        st = trace_level(load, l.level, false, &at, &l, halted);
    }
    *no_memory = l.no_memory;
    free(l.at);
    return st;
}

bool scene_trace(scene *s, watch *w, calc_error *error) {
    load_view load;
    const runner *unused;
    bool halted, no_memory = false;
    if (!scene_load_of(s, &load, error))
        return false;
    const bool swings = s->answers.reach.swings, may_be_sine = swings && w->limit && takes_sine(&load);
    /* a load that cannot be is refused before anything of it is seen, and none is taken in two ways */
    if (!(s->sound && !may_be_sine) && (!present_run(s, &unused, error) || !scene_load_of(s, &load, error)))
        return false;
    s->used |= USED(MODEL_MEMORY);
    const bool sine = may_be_sine && engine_is_sine(&s->answers.run[0].engine);
    const fret_status st = swings && w->limit && !sine
                               ? trace_limit(&load, w, &halted, &no_memory)
                               : trace_level(&load, swings && !sine ? LEVELS - 1 : 0, sine, w, NULL, &halted);
    if (no_memory)
        return calc_no_memory(error);
    if (halted && error->raised)
        return false;
    return calc_status(error, &st);
}
