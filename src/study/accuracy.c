/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Measures every model of a cycle. Only reads the scene, but for scene.used, which notes the models run. */
#include "study/accuracy.h"

#include <math.h>
#include <stdio.h>

#include "text/clock.h"

const family_row families[FAMILIES] = {
    [FAMILY_CLOSED] = {"closed form", "", MODEL_CLOSED},
    [FAMILY_MEMORY] = {"memory diagram", "", MODEL_MEMORY},
    [FAMILY_QUADRATURE] = {"quadrature", "", MODEL_QUADRATURE},
    [FAMILY_LOOP] = {"loop area (21)", "M", MODEL_MEMORY},
    [FAMILY_SPRINGS] = {"springs", "N", MODEL_SPRINGS},
    [FAMILY_MIDPOINT] = {"springs, midpoint", "N", MODEL_SPRINGS},
};

static const long double rounding = 4e-19L; /* least uncertainty of a reference */
static const long double nothing = 1e-29L;  /* a loss below this part of the stored energy is rounding */

/* ---- measuring --------------------------------------------------------------------------------- */

typedef struct bench {
    scene *s;
    calc_error *error;
    accuracy_study *study;
    double budget, end;   /* processor seconds, and the clock when they are spent */
    double enough;        /* processor seconds for timing one model */
    load_view load;       /* the load that is run: the program, or pressing and a cycle alone */
    load_item cycle;      /* its last period is measured */
    double radius;        /* of the largest contact during the load */
    fret_pressed contact; /* without a program: at constant F_N */
    fret_loading peak;    /* the state at the amplitude */
} bench;

static bool bench_stopped(const bench *b) {
    return calc_stopped(b->s->stop, b->error);
}

static void pulse(const bench *b) {
    if (b->s->pulse)
        b->s->pulse();
}

/* Callback: computes one cycle of a model; loss NULL: only to measure the time. */
typedef fret_status cycle_of(void *model, long double *loss);

/* The processor time of a cycle: repeats it until the runs take b->enough in all. */
static bool time_of(bench *b, cycle_of *cycle, void *model, double *seconds) {
    for (unsigned long count = 1; *seconds * (double)count < b->enough;) {
        count =
            *seconds * 4 * (double)count < b->enough ? 4 * count : (unsigned long)(b->enough / *seconds) + 1;
        const double start = clock_worked();
        fret_status st = status_ok;
        for (unsigned long i = 0; i < count && !st.code; i++) {
            if (bench_stopped(b))
                return false;
            st = cycle(model, NULL);
        }
        if (!calc_status(b->error, st))
            return false;
        *seconds = (clock_worked() - start) / (double)count;
    }
    return true;
}

/* Adds a row: the value of the first cycle, and the time of a cycle. */
static bool measure(bench *b, model_family family, unsigned long size, cycle_of *cycle, void *model) {
    accuracy_study *study = b->study;
    accuracy_row *row = &study->row[study->count];
    *row = (accuracy_row){.family = family, .size = size};
    pulse(b);
    const double start = clock_worked();
    fret_status st = cycle(model, &row->value);
    row->seconds = clock_worked() - start;
    if (!calc_status(b->error, st) || !time_of(b, cycle, model, &row->seconds))
        return false;
    row->error = fabsl(row->value / study->value - 1);
    row->below = row->error <= study->agreement;
    if (row->below)
        row->error = study->agreement;
    study->count++;
    b->s->used |= USED(families[family].model);
    return !bench_stopped(b);
}

/* Is there time for ten times the size, which takes ten times as long to set up and to run, twice at least?
 * Small models are always measured. */
static bool affords(const bench *b, double setting_up) {
    const accuracy_row *last = &b->study->row[b->study->count - 1];
    const double next = 10 * (setting_up + 2 * last->seconds);
    return (last->family != FAMILY_LOOP && last->size < 1000) || clock_worked() + next < b->end;
}

/* ---- formulas of a cycle at constant F_N ------------------------------------------------------- */

static fret_status closed_loss(const bench *b, long double *out) {
    return (b->study->by_force ? fret_cycle_loss_by_force
                               : fret_cycle_loss_by_displacement)(&b->contact, b->study->amplitude, out);
}

static fret_status find_peak(bench *b) {
    return (b->study->by_force ? fret_loading_by_force
                               : fret_loading_by_displacement)(&b->contact, b->study->amplitude, &b->peak);
}

static fret_status closed_cycle(void *model, long double *loss) {
    long double unused;
    return closed_loss(model, loss ? loss : &unused);
}

/* The quadrature is the reference too: its row shows the uncertainty of the reference. */
static fret_status quadrature_cycle(void *model, long double *loss) {
    bench *b = model;
    long double unused, error;
    fret_status st = find_peak(b);
    if (!st.code)
        st = fret_cycle_loss_by_definition(&b->contact, &b->peak, loss ? loss : &unused, &error);
    return st;
}

/* ---- models that run the load ------------------------------------------------------------------ */

/* Two levels finer than those of the scene. */
enum { FINEST = LEVELS + 1 };

/* Runs that stand before the last period of the load: one, or one for each number of chords of a limit. */
typedef struct running {
    runner run[LEVELS];
    unsigned levels;
    unsigned long looks; /* records in the last period */
} running;

/* Does F_N swing in the load program? Without that one run with straight steps is exact. */
static bool swings(const bench *b) {
    return b->study->program && b->s->answers.reach.swings;
}

/* Does the scene follow the sine of a swinging load itself, without chords? */
static bool by_sine(const bench *b) {
    return swings(b) && b->s->answers.levels == 1;
}

/* For k < 0 midpoint weights lose stiffness and the contact gets wider: doubles radius and springs. */
static fret_status make_engine(const bench *b, model_family family, unsigned springs, engine *out) {
    const fret_normal *normal = b->load.normal;
    const bool midpoint = family == FAMILY_MIDPOINT;
    const unsigned wider = midpoint && fret_normal_foundation(normal)->k < 0 ? 2 : 1;
    return families[family].model == MODEL_SPRINGS
               ? engine_springs(out, normal, b->load.mu, wider * springs, wider * b->radius,
                                midpoint ? FRET_WEIGHT_MIDPOINT : FRET_WEIGHT_CELL)
               : engine_make(out, normal, b->load.mu);
}

/* Runs to the beginning of the last period. */
static fret_status approach(const bench *b, runner *r) {
    const load_item press = {
        .step = {.kind = LOAD_PRESS, .normal = BY_FORCE, .normal_value = (double)b->contact.press.F}};
    load_item before = b->cycle;
    before.extra.times--;
    fret_status st = b->study->program ? run_to(r, (load_mark){b->load.last_cycle, b->load.end.cycles - 1})
                                       : run_item(r, &press);
    return st.code ? st : run_item(r, &before);
}

static const watch nowhere = {WATCH_NOTHING, .points = 0};

/* Begins runs with `levels` numbers of chords from level `first` on; 0: one run along the sine. */
static fret_status begin_running(const bench *b, running *m, model_family family, unsigned springs,
                                 unsigned first, unsigned levels, watch w) {
    fret_status st = status_ok;
    *m = (running){.levels = 0};
    do {
        runner *r = &m->run[m->levels];
        *r = (runner){.load = &b->load, .level = first + m->levels, .watch = w};
        st = make_engine(b, family, springs, &r->engine);
        r->engine.sine = levels == 0;
        m->levels++;
        if (!st.code)
            st = approach(b, r);
    } while (m->levels < levels && !st.code);
    if (st.code)
        runs_end(m->run, &m->levels);
    return st;
}

/* The loss of the last period, or its limit over the levels; *moved: relative uncertainty of the limit. */
static fret_status limit_cycle(running *m, long double *loss, long double *moved) {
    long double at[LEVELS] = {0};
    fret_status st = status_ok;
    for (unsigned i = 0; i < m->levels && !st.code; i++) {
        runner *r = &m->run[i];
        run_more(r);
        while (run_item_next(r))
            ;
        st = r->status;
        at[i] = r->cycle_loss;
    }
    *moved = 0;
    *loss = m->levels > 1 ? run_limit(at, moved) : at[0];
    return st;
}

static fret_status stepped_cycle(void *model, long double *loss) {
    long double unused, moved;
    return limit_cycle(model, loss ? loss : &unused, &moved);
}

/* Work done on the contact less the change of stored energy: int F_x d(delta_x) by the trapezoidal rule. */
static fret_status area_cycle(void *model, long double *loss) {
    running *m = model;
    runner *r = &m->run[0];
    fret_state from = {0}, last, now;
    long double area = 0;
    if (loss)
        engine_state(&r->engine, &from);
    engine_forces(&r->engine, &last);
    m->looks = 0;
    for (run_more(r); run_item_next(r); last = now) {
        engine_forces(&r->engine, &now);
        area += (now.dx - last.dx) * (now.Fx + last.Fx) / 2;
        m->looks++;
    }
    if (!r->status.code && loss) {
        engine_state(&r->engine, &now);
        *loss = area - (now.U - from.U);
    }
    return r->status;
}

/* Measures one row; *more: the model exists, and there is time for a larger one. FAMILY_LOOP records a period
 * at the ends of its chords or, for constant F_N, at `size` equal parts of the time of each branch. Springs
 * do not exist if the gap ends too early or overflows. */
static bool measure_model(bench *b, model_family family, unsigned size, unsigned level, bool *more) {
    const bool loop = family == FAMILY_LOOP, springs = families[family].model == MODEL_SPRINGS;
    const bool chords = swings(b) && !(family == FAMILY_MEMORY && by_sine(b));
    const double start = clock_worked();
    running m;
    pulse(b);
    fret_status st = begin_running(b, &m, family, springs ? size : 0, loop ? level : 0,
                                   loop || !swings(b) ? 1
                                   : chords           ? LEVELS
                                                      : 0,
                                   nowhere);
    *more = !st.code;
    if (springs && st.code && fret_status_category(st.code) != FRET_CAT_SYSTEM)
        return true;
    if (!calc_status(b->error, st))
        return false;
    if (loop)
        m.run[0].watch = watch_path(size);
    const double setting_up = clock_worked() - start;
    const bool ok = measure(b, family, size, loop ? area_cycle : stepped_cycle, &m);
    if (ok && loop)
        b->study->row[b->study->count - 1].size = m.looks / 2;
    runs_end(m.run, &m.levels);
    *more = ok && affords(b, setting_up);
    return ok;
}

/* Measures a family, each time with ten times the size, as long as there is time. */
static bool measure_models(bench *b, model_family family, unsigned size, unsigned most) {
    bool more = true;
    for (unsigned level = 0; more && size <= most; level += 2, size *= 10)
        if (!measure_model(b, family, size, level, &more))
            return false;
    return true;
}

/* ---- the reference ----------------------------------------------------------------------------- */

static bool steady_reference(bench *b) {
    accuracy_study *study = b->study;
    fret_status st = find_peak(b);
    if (!st.code)
        st = fret_cycle_loss_by_definition(&b->contact, &b->peak, &study->value, &study->agreement);
    if (st.code == FRET_GROSS_SLIP)
        st.quantity = "FA";
    if (!isfinite((double)study->value)) /* it is 0 after a failure */
        st = (fret_status){FRET_OVERFLOW, NULL, 0, 0};
    if (!calc_status(b->error, st))
        return false;
    if (!(study->value > 0)) /* a general gap, with slip below the rounding of long double */
        return calc_fail(b->error, 0, 0, "dW is 0, or so small that no model of this gap can tell it from 0");
    snprintf(study->reference, sizeof study->reference, "quadrature in long double");
    study->automatic = fret_normal_is_power(b->contact.normal) ? "closed form"
                                                               : "closed form, with polynomials over the gap";
    study->why = "constant FN";
    return true;
}

/* The loss of the last period with chords of the finest levels; parts > 0: straight steps cut in parts. */
static bool refined(bench *b, unsigned parts, long double *loss, long double *moved) {
    running m;
    fret_state now = {.U = 0};
    fret_status st = begin_running(b, &m, FAMILY_MEMORY, 0, parts ? 0 : FINEST - LEVELS + 1,
                                   parts ? 1 : LEVELS, parts ? watch_points(parts) : nowhere);
    if (!st.code) {
        st = limit_cycle(&m, loss, moved);
        engine_state(&m.run[0].engine, &now);
        runs_end(m.run, &m.levels);
    }
    if (*loss < nothing * now.U)
        *loss = 0;
    return calc_status(b->error, st);
}

static bool straight_reference(bench *b) {
    accuracy_study *study = b->study;
    long double coarse = 0, unused;
    if (!refined(b, 4, &coarse, &unused) || !refined(b, 8, &study->value, &unused))
        return false;
    study->agreement = fabsl(study->value - coarse) / study->value;
    snprintf(study->reference, sizeof study->reference, "memory diagram, straight steps cut in 8");
    study->why = "FN has changed on the way";
    return true;
}

static bool sine_reference(bench *b) {
    accuracy_study *study = b->study;
    snprintf(study->reference, sizeof study->reference, "memory diagram, limit of up to %d chords a period",
             RUN_CHORDS << FINEST);
    study->why = by_sine(b) ? "FN swings: the sine itself" : "FN swings: chords taken to their limit";
    return refined(b, 0, &study->value, &study->agreement);
}

static bool find_reference(bench *b) {
    accuracy_study *study = b->study;
    study->automatic = "memory diagram";
    if (!(!study->program ? steady_reference : swings(b) ? sine_reference : straight_reference)(b))
        return false;
    if (!(study->value > 0))
        return calc_fail(b->error, 0, 0, "nothing slips in the last cycle: dW is 0");
    study->agreement = fmaxl(study->agreement, rounding);
    return true;
}

static bool measure_all(bench *b) {
    const bool steady = !b->study->program;
    bool more;
    bool ok = find_reference(b) && (!steady || measure(b, FAMILY_CLOSED, 0, closed_cycle, b)) &&
              measure_model(b, FAMILY_MEMORY, 0, 0, &more) && measure_models(b, FAMILY_LOOP, 10, 10000) &&
              (!steady || measure(b, FAMILY_QUADRATURE, 0, quadrature_cycle, b));
    const bool midpoint =
        steady && fret_normal_foundation(b->load.normal)->k != 0; /* for k = 0 both weights are equal */
    b->end -= midpoint ? b->budget / 4 : 0;                       /* reserved for the midpoint springs */
    ok = ok && measure_models(b, FAMILY_SPRINGS, 100, 1000000);
    b->end += midpoint ? b->budget / 4 : 0;
    return ok && (!midpoint || measure_models(b, FAMILY_MIDPOINT, 100, 1000000));
}

/* ---- the load ---------------------------------------------------------------------------------- */

/* The amplitude that is given, else that of the load program, else half of the sliding force. */
static bool choose_amplitude(bench *b, const accuracy_load *given, const load_reach *reach) {
    const fret_state *state;
    accuracy_study *out = b->study;
    out->by_force = given->by_force;
    out->amplitude = given->amplitude;
    out->from = FROM_USER;
    if (given->given)
        return true;
    if (b->s->end.cycles) {
        scene_last_cycle(b->s, &b->cycle, b->error); /* cannot fail: scene_reach has read it */
        out->by_force = b->cycle.step.tangential == BY_FORCE;
        out->amplitude = b->cycle.step.tangential_value;
        out->program = reach->normal_varies || reach->rig;
        out->from = FROM_CYCLE;
        return true;
    }
    if (!scene_state(b->s, &state, b->error))
        return false;
    out->by_force = true;
    out->amplitude = fabs((double)state->Fx);
    out->from = FROM_STEP;
    if (!(out->amplitude > 0)) {
        out->amplitude = b->contact.mu * (double)out->FN / 2;
        out->from = FROM_LIMIT;
    }
    return true;
}

/* Sets up the load. At constant F_N all models that take a double get the same one, which the gap carries. */
static bool choose_load(bench *b, const accuracy_load *given) {
    scene *s = b->s;
    accuracy_study *out = b->study;
    calc_error *error = b->error;
    long double unused;
    const load_reach *pressed; /* first: a missing load is reported before missing friction */
    if (!scene_reach(s, &pressed, error) || !scene_contact(s, &b->contact, error))
        return false;
    out->FN = b->contact.press.F;
    if (!choose_amplitude(b, given, pressed))
        return false;
    if (out->program)
        return scene_load_of(s, &b->load, error) && scene_widest(s, &b->radius, error);
    const double F = (double)out->FN;
    fret_status st =
        fret_press_by_force(b->contact.normal, F > out->FN ? nextafter(F, 0) : F, &b->contact.press);
    if (!st.code)
        st = closed_loss(b, &unused);
    b->load = (load_view){.normal = b->contact.normal, .mu = b->contact.mu, .stop = s->stop};
    b->cycle = (load_item){.step = {.kind = LOAD_CYCLE,
                                    .tangential = out->by_force ? BY_FORCE : BY_DISPLACEMENT,
                                    .tangential_value = out->amplitude},
                           .extra = {.times = 1}};
    b->radius = (double)b->contact.press.a;
    return calc_status(error, st);
}

bool accuracy_measure(scene *s, const accuracy_load *load, accuracy_study *out, calc_error *error) {
    bench b = {.s = s, .error = error, .study = out};
    *out = (accuracy_study){.count = 0};
    if (!choose_load(&b, load))
        return false;
    b.budget = load->seconds;
    b.end = clock_worked() + load->seconds;
    b.enough = fmin(0.02, load->seconds / 150);
    b.cycle.step.points = 0; /* no records during the cycle */
    return measure_all(&b);
}
