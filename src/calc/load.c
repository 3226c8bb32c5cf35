/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The load program of a scene: storing it, running it on a model, and the answers that follow. */
#include <math.h>
#include <stdlib.h>

#include "calc/scene.h"
#include "number/real.h"

static bool friction_for_program(const scene *s, double *mu, calc_error *error) {
    /* a press alone can be shown without friction */
    if (!s->set[IN_MU] && s->steps <= 1) {
        *mu = 1;
        return true;
    }
    return scene_friction(s, mu, error);
}

typedef struct runner {
    const scene *s;
    fret_memory *memory;
    fret_springs *springs;  /* instead of memory */
    bool chords;            /* within a period of a cycle */
    load_observer *observe; /* or NULL */
    void *context;
    unsigned points;
    unsigned parts; /* cut each straight step into so many and sum the loop area; 0: neither */
    long double area, Fx, dx;
    size_t index, cycle; /* next step of the program, and next of its cycles */
    long double cycle_loss;
    long double spent; /* dissipated on memory, step by step: W may be far larger */
} runner;

/* A ramp by force that changes F_N is no straight line for the springs: 64 parts, an error of 1e-8. */
static fret_status run_on(runner *r, const fret_step *step) {
    bool ramp = step->normal_by != FRET_KEEP_NORMAL && step->tangential_by == FRET_TO_FX;
    if (r->springs)
        return fret_springs_step(r->springs, step, ramp ? 64 : 1);
    fret_status st = fret_memory_step(r->memory, step);
    if (!st.code)
        r->spent += fret_memory_last_loss(r->memory);
    return st;
}

static void forces_of(const runner *r, fret_state *out) {
    if (r->springs)
        fret_springs_state(r->springs, out);
    else
        fret_memory_forces(r->memory, out);
}

/* int F_x d(delta_x) by the trapezoidal rule. */
static void sum_area(runner *r) {
    fret_state now;
    forces_of(r, &now);
    r->area += (now.dx - r->dx) * (now.Fx + r->Fx) / 2;
    r->Fx = now.Fx;
    r->dx = now.dx;
}

static void seen(runner *r) {
    fret_state now;
    if (r->parts)
        sum_area(r);
    if (r->observe) {
        fret_memory_state(r->memory, &now);
        r->observe(&now, r->index, r->context);
    }
}

static fret_status unless_stopped(const runner *r, fret_status st) {
    if (!st.code && r->s->stop && *r->s->stop)
        st = (fret_status){FRET_INTERRUPTED, NULL, 0, 0};
    return st;
}

static fret_status take(runner *r, const fret_step *step, unsigned points) {
    fret_status st;
    if (!r->observe && !r->parts)
        return run_on(r, step);
    fret_state from;
    forces_of(r, &from);
    if (r->parts)
        points = r->parts;
    for (unsigned i = 1; i < points; i++) {
        if (r->s->stop && *r->s->stop)
            return (fret_status){FRET_INTERRUPTED, NULL, 0, 0};
        fret_step part = *step;
        long double t = (long double)i / points;
        long double n0 = step->normal_by == FRET_TO_FORCE ? from.FN : from.dz;
        long double t0 = step->tangential_by == FRET_TO_FX ? from.Fx : from.dx;
        part.normal = (double)(n0 + (step->normal - n0) * t);
        part.tangential = (double)(t0 + (step->tangential - t0) * t);
        st = run_on(r, &part);
        if (st.code)
            return st;
        seen(r);
    }
    st = run_on(r, step);
    if (!st.code)
        seen(r);
    return st;
}

/* One period from F_x = +FA: at constant F_N its two branches, else chords of the harmonic path. */
static fret_status period(runner *r, const load_step *c, const cycle_extra *x, long double FN) {
    fret_step step = {FRET_KEEP_NORMAL, c->tangential == BY_FORCE ? FRET_TO_FX : FRET_TO_DX, 0, 0};
    fret_status st = {FRET_OK, NULL, 0, 0};
    if (c->normal_value == 0) {
        unsigned points = c->points ? (c->points + 1) / 2 : r->points;
        for (int sign = -1; sign <= 1 && !st.code; sign += 2) {
            step.tangential = sign * c->tangential_value;
            st = take(r, &step, points);
        }
        return st;
    }
    unsigned chords = c->points ? c->points : 200;
    const double pi = 3.14159265358979323846;
    step.normal_by = FRET_TO_FORCE;
    r->chords = true;
    for (unsigned i = 1; i <= chords && !st.code; i++) {
        double angle = 2 * pi * i / chords; /* from the top of F_x */
        step.tangential = i == chords ? c->tangential_value : c->tangential_value * (double)fret_cos(angle);
        step.normal = (double)(FN + c->normal_value * fret_cos(angle + x->phase));
        st = unless_stopped(r, take(r, &step, 1));
    }
    r->chords = false;
    return st;
}

static fret_status run_cycle(runner *r, const load_step *c, const cycle_extra *x) {
    fret_state state;
    forces_of(r, &state);
    long double FN = state.FN;
    fret_step first = {FRET_KEEP_NORMAL, c->tangential == BY_FORCE ? FRET_TO_FX : FRET_TO_DX, 0,
                       c->tangential_value};
    if (c->normal_value != 0) {
        first.normal_by = FRET_TO_FORCE;
        first.normal = (double)(FN + c->normal_value * fret_cos(x->phase));
    }
    fret_status st = take(r, &first, r->points);
    for (unsigned i = 0; i < x->times && !st.code; i++) {
        forces_of(r, &state);
        long double before = state.W;
        r->spent = 0;
        st = period(r, c, x, FN);
        forces_of(r, &state);
        r->cycle_loss = r->springs ? state.W - before : r->spent;
        st = unless_stopped(r, st);
    }
    if (st.code == FRET_GROSS_SLIP && c->tangential == BY_FORCE && c->normal_value == 0)
        st.quantity = "FA";
    return st;
}

static fret_status run_step(runner *r, const load_step *c, const cycle_extra *x) {
    if (c->kind == LOAD_CYCLE)
        return run_cycle(r, c, x);
    fret_step step = {FRET_KEEP_NORMAL, FRET_KEEP_DX, c->normal_value, c->tangential_value};
    if (c->kind == LOAD_PRESS) {
        step.normal_by = c->normal == BY_FORCE ? FRET_TO_FORCE : FRET_TO_DEPTH;
        if (c->normal == BY_FORCE)
            step.normal = r->s->in[IN_FN]; /* FN is an input: it may have been changed since */
        if (c->normal == BY_RADIUS) {
            fret_press p;
            fret_status st = fret_press_by_radius(r->s->normal, c->normal_value, &p);
            if (st.code)
                return st;
            step.normal = (double)p.dz;
        }
        return take(r, &step, 1);
    }
    fret_state now = {0};
    if (!c->normal && (c->relative & 2) && c->tangential_value == 0)
        return (fret_status){FRET_OK, NULL, 0, 0}; /* rounding must not make it a reversal */
    if (c->relative)
        forces_of(r, &now);
    if (c->normal) {
        step.normal_by = c->normal == BY_FORCE ? FRET_TO_FORCE : FRET_TO_DEPTH;
        if (c->relative & 1)
            step.normal = (double)((c->normal == BY_FORCE ? now.FN : now.dz) + step.normal);
    }
    if (c->tangential) {
        step.tangential_by = c->tangential == BY_FORCE ? FRET_TO_FX : FRET_TO_DX;
        if (c->relative & 2)
            step.tangential = (double)((c->tangential == BY_FORCE ? now.Fx : now.dx) + step.tangential);
    }
    return take(r, &step, c->points ? c->points : c->tangential || c->normal ? r->points : 1);
}

/* A step straight to a displacement, the normal force as it is. */
static bool is_slide(const load_step *step) {
    return step->kind == LOAD_STEP && !step->normal && step->tangential == BY_DISPLACEMENT && !step->relative;
}

/* At constant F_N only turning points count: a displacement on the way to the next one need not be taken. */
static bool on_the_way(const scene *s, size_t i) {
    const load_step *step = &s->program[i];
    if (i + 1 >= s->steps || !is_slide(step) || !is_slide(step + 1) || !is_slide(step - 1))
        return false;
    const double here = step->tangential_value, last = step[-1].tangential_value,
                 next = step[1].tangential_value;
    return here == next || (last < here && here < next) || (last > here && here > next);
}

/* Runs the program from where the runner is to step `end`. */
static fret_status run_until(runner *r, size_t end) {
    const scene *s = r->s;
    const bool seen_by_all = r->observe || r->parts || r->springs;
    fret_status st = {FRET_OK, NULL, 0, 0};
    for (; r->index < end; r->index++) {
        const load_step *step = &s->program[r->index];
        const cycle_extra *x = step->kind == LOAD_CYCLE ? &s->cycles[r->cycle] : NULL;
        if (seen_by_all || !on_the_way(s, r->index))
            st = run_step(r, step, x);
        st = unless_stopped(r, st);
        if (st.code)
            break;
        r->cycle += x != NULL;
    }
    return st;
}

/* Brings memory up to the end of the program. */
static bool catch_up(scene *s, calc_error *error) {
    const fret_normal *normal;
    double mu;
    if (!scene_normal(s, &normal, error) || !friction_for_program(s, &mu, error))
        return false;
    if (!s->memory) {
        fret_status st = fret_memory_make(normal, mu, &s->memory);
        if (st.code)
            return scene_status(s, error, &st);
        s->applied = s->applied_cycles = 0;
    }
    runner r = {.s = s,
                .memory = s->memory,
                .points = 1,
                .index = s->applied,
                .cycle = s->applied_cycles,
                .cycle_loss = s->cycle_loss};
    if (s->applied < s->steps && s->steps > 1)
        s->used |= USED_MEMORY;
    fret_status st = run_until(&r, s->steps);
    s->applied = r.index;
    s->applied_cycles = r.cycle;
    s->cycle_loss = r.cycle_loss;
    if (st.code) {
        fret_memory_free(s->memory); /* half-run: not to be used */
        s->memory = NULL;
        s->applied = s->applied_cycles = 0;
    }
    return scene_status(s, error, &st);
}

static bool store(scene *s, const load_step *step, const cycle_extra *extra, calc_error *error) {
    if (s->steps == s->room) {
        size_t room = s->room ? 2 * s->room : 16;
        load_step *grown = realloc(s->program, room * sizeof *grown);
        if (!grown)
            return calc_fail(error, 0, 0, "out of memory: the load program has %zu steps", s->steps);
        s->program = grown;
        s->room = room;
    }
    if (extra && s->cycle_count == s->cycle_room) {
        size_t room = s->cycle_room ? 2 * s->cycle_room : 4;
        cycle_extra *grown = realloc(s->cycles, room * sizeof *grown);
        if (!grown)
            return calc_fail(error, 0, 0, "out of memory: the load program has %zu steps", s->steps);
        s->cycles = grown;
        s->cycle_room = room;
    }
    s->program[s->steps++] = *step;
    if (extra)
        s->cycles[s->cycle_count++] = *extra;
    return true;
}

/* A press starts a new program; the old one stays until the new one stands. */
static bool start_program(scene *s, const load_step *press, calc_error *error) {
    scene old = *s;
    scene_hand_over(s);
    scene_forget(s);
    s->program = NULL;
    s->cycles = NULL;
    s->steps = s->room = s->cycle_count = s->cycle_room = 0;
    s->normal_varies = false;
    s->set[IN_FN] = press->normal == BY_FORCE;
    s->in[IN_FN] = press->normal_value;
    const fret_press *p;
    if (store(s, press, NULL, error) && scene_press(s, &p, error)) {
        scene_drop(&old);
        free(old.program);
        free(old.cycles);
        return true;
    }
    scene_drop(s);
    free(s->program);
    free(s->cycles);
    *s = old;
    return false;
}

/* spare holds the state of the contact so far */
static bool keep_spare(scene *s, double mu, calc_error *error) {
    fret_status st = {FRET_OK, NULL, 0, 0};
    if (!s->spare)
        st = fret_memory_make(s->normal, mu, &s->spare);
    if (!st.code)
        st = fret_memory_copy(s->spare, s->memory);
    return scene_status(s, error, &st);
}

static void use_spare(scene *s) {
    fret_memory *half = s->memory;
    s->memory = s->spare;
    s->spare = half;
    s->state_ready = s->press_ready = false;
}

bool scene_begin(scene *s, calc_error *error) {
    double mu;
    if (!s->steps)
        return calc_fail(error, 0, 0, "there is no load yet: press first (press FN=100 N)");
    if (!scene_friction(s, &mu, error) || !catch_up(s, error) || !keep_spare(s, mu, error))
        return false;
    s->mark = s->steps;
    s->mark_cycles = s->cycle_count;
    s->mark_varies = s->normal_varies;
    return true;
}

void scene_roll_back(scene *s) {
    use_spare(s);
    s->steps = s->applied = s->mark;
    s->cycle_count = s->applied_cycles = s->mark_cycles;
    s->normal_varies = s->mark_varies;
}

/* To slide to a displacement at constant F_N is always possible: such a step waits until a result is asked.
 */
static bool can_wait(const scene *s, const load_step *step) {
    return s->memory && is_slide(step);
}

bool scene_load(scene *s, const load_step *step, const cycle_extra *extra, calc_error *error) {
    if (step->kind == LOAD_PRESS)
        return start_program(s, step, error);
    if (!s->steps)
        return calc_fail(error, 0, 0, "there is no load yet: press first (press FN=100 N)");
    double mu;
    if (!scene_friction(s, &mu, error))
        return false;
    if (can_wait(s, step)) {
        s->state_ready = false;
        return store(s, step, extra, error);
    }
    if (!catch_up(s, error) || !store(s, step, extra, error))
        return false;
    /* a single step leaves memory as it was when it fails; a cycle works on a copy */
    if (extra && !keep_spare(s, mu, error)) {
        s->steps--;
        s->cycle_count--;
        return false;
    }
    runner r = {.s = s, .memory = s->memory, .points = 1, .cycle_loss = s->cycle_loss};
    fret_status st = run_step(&r, step, extra);
    if (st.code) {
        s->steps--;
        if (extra) {
            s->cycle_count--;
            use_spare(s);
        }
        return scene_status(s, error, &st);
    }
    s->used |= USED_MEMORY;
    s->applied = s->steps;
    s->applied_cycles = s->cycle_count;
    s->cycle_loss = r.cycle_loss;
    s->state_ready = false;
    if (step->kind == LOAD_STEP ? step->normal != BY_NONE : step->normal_value != 0)
        s->normal_varies = true, s->press_ready = false;
    return true;
}

bool scene_press(scene *s, const fret_press **press, calc_error *error) {
    if (!s->press_ready) {
        const fret_normal *normal;
        if (!s->steps)
            return calc_fail(error, 0, 0, "there is no load yet: press first (press FN=100 N)");
        if (!scene_normal(s, &normal, error))
            return false;
        if (s->normal_varies) {
            const fret_memory *memory;
            fret_state state;
            if (!scene_memory(s, &memory, error))
                return false;
            fret_memory_state(memory, &state);
            s->press = (fret_press){.F = state.FN, .dz = state.dz, .a = state.a};
        } else {
            const load_step *step = &s->program[0];
            double v = step->normal == BY_FORCE ? s->in[IN_FN] : step->normal_value;
            fret_status st = step->normal == BY_FORCE          ? fret_press_by_force(normal, v, &s->press)
                             : step->normal == BY_DISPLACEMENT ? fret_press_by_depth(normal, v, &s->press)
                                                               : fret_press_by_radius(normal, v, &s->press);
            if (st.code)
                return scene_status(s, error, &st);
        }
        s->press_ready = !s->normal_varies; /* else it moves with every step */
    }
    if (s->normal_varies)
        s->used |= USED_MEMORY;
    else
        scene_used_closed(s);
    *press = &s->press;
    return true;
}

bool scene_memory(scene *s, const fret_memory **memory, calc_error *error) {
    if (!s->steps)
        return calc_fail(error, 0, 0, "there is no load yet: press first (press FN=100 N)");
    if ((!s->memory || s->applied < s->steps) && !catch_up(s, error))
        return false;
    *memory = s->memory;
    return true;
}

static void widest(const fret_state *state, size_t step, void *context) {
    long double *a = context;
    (void)step;
    if (state->a > *a)
        *a = state->a;
}

/* Springs wide enough for the largest contact of the program. */
static bool make_springs(scene *s, unsigned count, fret_springs **out, calc_error *error) {
    const fret_normal *normal;
    double mu;
    long double a = 0;
    if (!scene_normal(s, &normal, error) || !friction_for_program(s, &mu, error) ||
        !scene_trace(s, 0, widest, &a, error))
        return false;
    fret_status st = fret_springs_make(normal, mu, count, (double)(a * (1 + 1e-12L)), FRET_WEIGHT_CELL, out);
    return scene_status(s, error, &st);
}

static bool run_springs(scene *s, calc_error *error) {
    runner r = {.s = s, .points = 1};
    if (!make_springs(s, s->springs, &r.springs, error))
        return false;
    fret_status st = run_until(&r, s->steps);
    if (!st.code)
        fret_springs_state(r.springs, &s->state);
    s->springs_loss = r.cycle_loss;
    fret_springs_free(r.springs);
    return scene_status(s, error, &st);
}

bool scene_state(scene *s, const fret_state **state, calc_error *error) {
    const fret_memory *memory;
    unsigned used = s->used; /* what only checks the load program does not answer */
    if (!s->state_ready) {
        if (!scene_memory(s, &memory, error))
            return false;
        if (s->model == MODEL_CLOSED)
            return calc_fail(error, 0, 0, "no closed form for this: set model auto");
        if (s->model == MODEL_SPRINGS) {
            if (!run_springs(s, error))
                return false;
        } else {
            fret_memory_state(memory, &s->state);
        }
        s->state_ready = true;
    }
    s->used = used | (s->model == MODEL_SPRINGS ? USED_SPRINGS : USED_MEMORY);
    *state = &s->state;
    return true;
}

void scene_set_model(scene *s, scene_model model, unsigned springs) {
    s->model = model;
    s->springs = springs;
    s->state_ready = s->press_ready = false;
}

void scene_used_closed(scene *s) {
    s->used |= !s->geometry || s->geometry->kind == FRET_GAP_POWER ? USED_CLOSED : USED_QUADRATURE;
}

static void reach_step(load_reach *r, const load_step *step, const cycle_extra *x) {
    const double v = step->tangential_value, size = fabs(v);
    if (!r->by)
        r->by = (load_by)step->tangential;
    r->alike = r->alike && step->tangential == r->by && !(step->relative & 2);
    r->first = r->alike && size >= r->most;
    r->most = fmax(r->most, size);
    r->end = v;
    if (x) /* a second period is closed whatever came before */
        r->closed = r->first || x->times > 1;
}

static const load_reach *reach_of(scene *s) {
    load_reach *r = &s->reach;
    if (r->seen == 0 || r->seen > s->steps)
        *r = (load_reach){.seen = 1, .alike = true, .first = true};
    for (; r->seen < s->steps; r->seen++) {
        const load_step *step = &s->program[r->seen];
        reach_step(r, step, step->kind == LOAD_CYCLE ? &s->cycles[r->cycles++] : NULL);
    }
    return r;
}

bool scene_closed_state(scene *s) {
    return s->steps > 0 && (s->model == MODEL_AUTO || s->model == MODEL_CLOSED) && !s->normal_varies &&
           reach_of(s)->first;
}

bool scene_closed_loss(scene *s) {
    return (s->model == MODEL_AUTO || s->model == MODEL_CLOSED) && !s->normal_varies && reach_of(s)->closed;
}

const char *scene_model_name(const scene *s, bool closed) {
    if (closed)
        return !s->geometry || s->geometry->kind == FRET_GAP_POWER
                   ? "closed form"
                   : "closed form, with quadrature over the gap";
    return s->model == MODEL_SPRINGS ? "springs" : "memory diagram (exact)";
}

bool scene_first_loading(scene *s, fret_loading *out, calc_error *error) {
    const fret_normal *normal;
    const fret_press *press;
    if (!scene_normal(s, &normal, error) || !scene_press(s, &press, error))
        return false;
    const load_reach *r = reach_of(s);
    if (!r->by) {
        *out = (fret_loading){0, 0, press->a, press->dz};
        return true;
    }
    double mu;
    if (!scene_friction(s, &mu, error))
        return false;
    const fret_contact contact = {normal, mu, *press};
    fret_status st = r->by == BY_FORCE ? fret_loading_by_force(&contact, r->end, out)
                                       : fret_loading_by_displacement(&contact, r->end, out);
    return scene_status(s, error, &st);
}

const load_step *scene_last_cycle(const scene *s) {
    for (size_t i = s->steps; i-- > 0;)
        if (s->program[i].kind == LOAD_CYCLE)
            return &s->program[i];
    return NULL;
}

bool scene_cycle_loss(scene *s, long double *loss, calc_error *error) {
    const load_step *c = scene_last_cycle(s);
    if (!c)
        return calc_fail(error, 0, 0, "no cycle has been run yet: use cycle FA=... or the function dW(FA)");
    if (!scene_closed_loss(s)) {
        const fret_state *state;
        if (!scene_state(s, &state, error))
            return false;
        *loss = s->model == MODEL_SPRINGS ? s->springs_loss : s->cycle_loss;
        return true;
    }
    const fret_normal *normal;
    const fret_press *press;
    double mu;
    if (!scene_normal(s, &normal, error) || !scene_press(s, &press, error) || !scene_friction(s, &mu, error))
        return false;
    const fret_contact contact = {normal, mu, *press};
    fret_status st = c->tangential == BY_FORCE
                         ? fret_cycle_loss_by_force(&contact, c->tangential_value, loss)
                         : fret_cycle_loss_by_displacement(&contact, c->tangential_value, loss);
    return scene_status(s, error, &st);
}

bool scene_trace(scene *s, unsigned points, load_observer *observe, void *context, calc_error *error) {
    const fret_memory *unused;
    const fret_normal *normal;
    double mu;
    if (!scene_memory(s, &unused, error) || !scene_normal(s, &normal, error) ||
        !friction_for_program(s, &mu, error))
        return false;
    runner r = {.s = s, .observe = observe, .context = context, .points = points ? points : 1};
    s->used |= USED_MEMORY;
    fret_status st = fret_memory_make(normal, mu, &r.memory);
    if (!st.code)
        st = run_until(&r, s->steps);
    fret_memory_free(r.memory);
    return scene_status(s, error, &st);
}

struct cycle_run {
    runner r;
    const load_step *cycle;
    const cycle_extra *extra;
    long double FN; /* about which the normal force swings */
};

bool cycle_run_open(scene *s, unsigned springs, unsigned parts, cycle_run **out, calc_error *error) {
    const load_step *last = scene_last_cycle(s);
    const fret_normal *normal;
    double mu;
    if (!last)
        return calc_fail(error, 0, 0, "no cycle has been run yet: use cycle FA=...");
    if (!scene_normal(s, &normal, error) || !scene_friction(s, &mu, error))
        return false;
    cycle_run *run = calloc(1, sizeof *run);
    if (!run)
        return calc_fail(error, 0, 0, "out of memory");
    run->r = (runner){.s = s, .points = 1, .parts = parts};
    run->cycle = last;
    fret_status st = {FRET_OK, NULL, 0, 0};
    bool ok = true;
    if (springs)
        ok = make_springs(s, springs, &run->r.springs, error);
    else
        st = fret_memory_make(normal, mu, &run->r.memory);
    if (ok && !st.code)
        st = run_until(&run->r, (size_t)(last - s->program));
    if (ok && !st.code) {
        fret_state state;
        run->extra = &s->cycles[run->r.cycle];
        cycle_extra before = *run->extra;
        before.times--;
        forces_of(&run->r, &state);
        run->FN = state.FN;
        st = unless_stopped(&run->r, run_step(&run->r, last, &before));
    }
    if (ok && scene_status(s, error, &st)) {
        *out = run;
        return true;
    }
    cycle_run_close(run);
    return false;
}

static void energies(const runner *r, fret_state *out) {
    if (r->springs)
        fret_springs_state(r->springs, out);
    else
        fret_memory_state(r->memory, out);
}

bool cycle_run_period(cycle_run *run, long double *loss, long double *area, calc_error *error) {
    runner *r = &run->r;
    fret_state from, to;
    if (loss || area)
        energies(r, &from);
    r->area = 0;
    fret_status st = period(r, run->cycle, run->extra, run->FN);
    if (!st.code && (loss || area)) {
        energies(r, &to);
        if (loss)
            *loss = to.W - from.W;
        if (area) /* what goes into the contact and is not stored */
            *area = r->area - (to.U - from.U);
    }
    return scene_status(r->s, error, &st);
}

void cycle_run_close(cycle_run *run) {
    if (!run)
        return;
    fret_springs_free(run->r.springs);
    fret_memory_free(run->r.memory);
    free(run);
}
