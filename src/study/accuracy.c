/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Measures every model of a cycle. Touches the scene only to ask it; what has been run is told to scene.used.
 */
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

static const long double rounding = 4e-19L; /* no reference is better */
static const long double nothing = 1e-29L;  /* of what is stored: what rounding leaves where nothing slips */
static const fret_status fine = {FRET_OK, NULL, 0, 0};

/* ---- measuring --------------------------------------------------------------------------------- */

typedef struct bench {
    scene *s;
    calc_error *error;
    accuracy_study *study;
    accuracy_progress *progress;
    void *context;
    double budget, end; /* seconds of the processor; when it is spent */
    double enough;      /* seconds, to time one model */
} bench;

static bool bench_stopped(const bench *b) {
    return calc_stopped(b->s->stop, b->error);
}

static void tell_row(const bench *b, model_family family, unsigned long size) {
    b->progress(b->context, &(accuracy_row){.family = family, .size = size});
}

/* One cycle of a model; loss NULL: only for the time. */
typedef fret_status cycle_of(void *model, long double *loss);

static bool time_of(bench *b, cycle_of *cycle, void *model, double *seconds) {
    for (unsigned long count = 1; *seconds * (double)count < b->enough;) {
        count =
            *seconds * 4 * (double)count < b->enough ? 4 * count : (unsigned long)(b->enough / *seconds) + 1;
        const double start = clock_worked();
        fret_status st = fine;
        for (unsigned long i = 0; i < count && !st.code; i++) {
            if (bench_stopped(b))
                return false;
            st = cycle(model, NULL);
        }
        if (!calc_status(b->error, &st))
            return false;
        *seconds = (clock_worked() - start) / (double)count;
    }
    return true;
}

/* Enters a row: the value of the first cycle, the time of as many as it takes to measure it. */
static bool measure(bench *b, model_family family, unsigned long size, cycle_of *cycle, void *model) {
    accuracy_study *study = b->study;
    accuracy_row *row = &study->row[study->count];
    *row = (accuracy_row){.family = family, .size = size};
    tell_row(b, family, size);
    const double start = clock_worked();
    fret_status st = cycle(model, &row->value);
    row->seconds = clock_worked() - start;
    if (!calc_status(b->error, &st) || !time_of(b, cycle, model, &row->seconds))
        return false;
    row->error = fabsl(row->value / study->value - 1);
    row->below = row->error <= study->agreement;
    if (row->below)
        row->error = study->agreement;
    study->count++;
    b->s->used |= USED(families[family].model);
    return !bench_stopped(b);
}

/* The next model of this kind has ten times the size and takes ten times as long to set up and to run, twice
 * at least. Is there time for it? Small ones are always measured. */
static bool affords(const bench *b, double setting_up) {
    const accuracy_row *last = &b->study->row[b->study->count - 1];
    const double next = 10 * (setting_up + 2 * last->seconds);
    return (last->family != FAMILY_LOOP && last->size < 1000) || clock_worked() + next < b->end;
}

/* ---- models of a cycle at constant F_N --------------------------------------------------------- */

/* Everything that its models need. */
typedef struct steady {
    const bench *b;
    fret_pressed contact;
    bool by_force;
    double amplitude;
    fret_loading peak;
    unsigned size;
    engine engine; /* of those that step */
} steady;

static fret_status closed_loss(const steady *m, long double *out) {
    return m->by_force ? fret_cycle_loss_by_force(&m->contact, m->amplitude, out)
                       : fret_cycle_loss_by_displacement(&m->contact, m->amplitude, out);
}

static fret_status find_peak(steady *m) {
    return m->by_force ? fret_loading_by_force(&m->contact, m->amplitude, &m->peak)
                       : fret_loading_by_displacement(&m->contact, m->amplitude, &m->peak);
}

static fret_status closed_cycle(void *model, long double *loss) {
    long double unused;
    return closed_loss(model, loss ? loss : &unused);
}

/* Where F_N is constant this is the reference too: its row shows how far that can be trusted. */
static fret_status quadrature_cycle(void *model, long double *loss) {
    steady *m = model;
    long double unused, error;
    fret_status st = find_peak(m);
    if (!st.code)
        st = fret_cycle_loss_by_definition(&m->contact, &m->peak, loss ? loss : &unused, &error);
    return st;
}

static fret_status step_to(steady *m, double part) {
    const fret_step step = {FRET_KEEP_NORMAL, m->by_force ? FRET_TO_FX : FRET_TO_DX, 0, part * m->amplitude};
    return *m->b->s->stop ? (fret_status){FRET_INTERRUPTED, NULL, 0, 0} : engine_step(&m->engine, &step);
}

/* Down and up again. */
static fret_status stepped_cycle(void *model, long double *loss) {
    steady *m = model;
    fret_status st = fine;
    if (loss)
        engine_mark(&m->engine);
    for (int sign = -1; sign <= 1 && !st.code; sign += 2)
        st = step_to(m, sign);
    if (loss)
        *loss = engine_spent(&m->engine);
    return st;
}

/* Each branch in m->size steps of a harmonic load. */
static fret_status loop_cycle(void *model, long double *loss) {
    const double pi = 3.14159265358979323846;
    steady *m = model;
    fret_state last, now;
    long double area = 0;
    engine_forces(&m->engine, &last);
    for (unsigned i = 1; i <= 2 * m->size; i++) {
        const double part = i == m->size ? -1 : i == 2 * m->size ? 1 : cos(pi * i / m->size);
        fret_status st = step_to(m, part);
        if (st.code)
            return st;
        engine_forces(&m->engine, &now);
        area += (now.dx - last.dx) * (now.Fx + last.Fx) / 2;
        last = now;
    }
    if (loss)
        *loss = area;
    return fine;
}

/* Pressed and taken to the first turning point. */
static fret_status ready(steady *m) {
    const fret_step down = {FRET_TO_FORCE, FRET_KEEP_DX, (double)m->contact.press.F, 0};
    fret_status st = engine_step(&m->engine, &down);
    return st.code ? st : step_to(m, 1);
}

static bool memory_rows(bench *b, steady *m) {
    fret_status st = engine_make(&m->engine, MODEL_MEMORY, m->contact.normal, m->contact.mu, 0, 0);
    if (!st.code)
        st = ready(m);
    bool ok = calc_status(b->error, &st) && measure(b, FAMILY_MEMORY, 0, stepped_cycle, m);
    for (m->size = 10; ok && m->size <= 10000; m->size *= 10) {
        ok = measure(b, FAMILY_LOOP, m->size, loop_cycle, m);
        if (ok && !affords(b, 0))
            break;
    }
    engine_end(&m->engine);
    return ok;
}

static fret_status springs_ready(steady *m, unsigned count, double radius, fret_weight rule) {
    m->engine = (engine){.kind = &models[MODEL_SPRINGS]};
    fret_status st =
        fret_springs_make(m->contact.normal, m->contact.mu, count, radius, rule, &m->engine.springs);
    if (!st.code)
        st = ready(m);
    if (st.code)
        engine_end(&m->engine);
    return st;
}

/* With midpoint weights some stiffness is missing where k < 0: the contact that carries F_N is wider. Where
 * the gap ends before, or is beyond all numbers, there are no such springs. */
static bool springs_rows(bench *b, steady *m, model_family family) {
    const bool midpoint = family == FAMILY_MIDPOINT;
    const fret_weight rule = midpoint ? FRET_WEIGHT_MIDPOINT : FRET_WEIGHT_CELL;
    const unsigned wider = midpoint && fret_normal_foundation(m->contact.normal)->k < 0 ? 2 : 1;
    bool ok = true;
    for (unsigned count = 100; ok && count <= 1000000; count *= 10) {
        const double start = clock_worked();
        tell_row(b, family, count);
        fret_status st = springs_ready(m, wider * count, wider * (double)m->contact.press.a, rule);
        if (st.code && fret_status_category(st.code) != FRET_CAT_SYSTEM)
            break;
        if (!calc_status(b->error, &st))
            return false;
        const double setting_up = clock_worked() - start;
        ok = measure(b, family, count, stepped_cycle, m);
        engine_end(&m->engine);
        if (ok && !affords(b, setting_up))
            break;
    }
    return ok;
}

static bool steady_reference(bench *b, steady *m) {
    accuracy_study *study = b->study;
    fret_status st = find_peak(m);
    if (!st.code)
        st = fret_cycle_loss_by_definition(&m->contact, &m->peak, &study->value, &study->agreement);
    if (st.code == FRET_GROSS_SLIP)
        st.quantity = "FA";
    if (!isfinite((double)study->value)) /* 0 where it failed */
        st = (fret_status){FRET_OVERFLOW, NULL, 0, 0};
    if (!calc_status(b->error, &st))
        return false;
    if (!(study->value > 0)) /* a general gap, and less slip than a long double tells from none */
        return calc_fail(b->error, 0, 0, "the load is too small: no model of this gap can tell dW from 0");
    study->agreement = fmaxl(study->agreement, rounding);
    snprintf(study->reference, sizeof study->reference, "quadrature in long double");
    study->automatic = fret_normal_is_power(m->contact.normal) ? "closed form"
                                                               : "closed form, with polynomials over the gap";
    study->why = "constant FN";
    return true;
}

static bool measure_steady(bench *b, steady *m) {
    bool ok = steady_reference(b, m) && measure(b, FAMILY_CLOSED, 0, closed_cycle, m) && memory_rows(b, m) &&
              measure(b, FAMILY_QUADRATURE, 0, quadrature_cycle, m);
    b->end -= b->budget / 4; /* kept for the last */
    ok = ok && springs_rows(b, m, FAMILY_SPRINGS);
    b->end += b->budget / 4;
    /* at k = 0 the weights are the same */
    return ok && (fret_normal_foundation(m->contact.normal)->k == 0 || springs_rows(b, m, FAMILY_MIDPOINT));
}

/* ---- models of any other load program ---------------------------------------------------------- */

/* Two levels beyond those of the scene. */
enum { FINEST = LEVELS + 1 };

/* The last period of the program, on one model; on several numbers of chords where they are taken to the
 * limit. */
typedef struct general {
    load_view load;
    load_item cycle;
    runner run[LEVELS];
    unsigned levels;
    bool sine;           /* no chords: as the scene answers */
    unsigned long looks; /* of the last period */
} general;

/* Straight steps alone are exact in one. */
static bool swings(const bench *b) {
    return b->s->answers.reach.swings;
}

static void close_general(general *g) {
    for (unsigned i = 0; i < g->levels; i++)
        engine_end(&g->run[i].engine);
    g->levels = 0;
}

/* Runs to the beginning of the last period. */
static fret_status approach(general *g, runner *r) {
    const load_mark here = {g->load.last_cycle, g->load.end.cycles - 1};
    fret_status st = run_to(r, here);
    load_item before = g->cycle;
    before.extra.times--;
    return st.code ? st : run_item(r, &before);
}

static const watch nowhere = {.next = NULL};

/* `levels` numbers of chords, from level `first` on; springs 0: the memory diagram. The watch cuts every
 * leg. */
static bool open_general(bench *b, general *g, unsigned springs, unsigned first, unsigned levels, watch w) {
    calc_error *error = b->error;
    g->levels = 0;
    if (!scene_load_of(b->s, &g->load, error)) /* unreached: the scene has answered for this load */
        return false;
    g->cycle = program_item(g->load.program, (load_mark){g->load.last_cycle, g->load.end.cycles - 1},
                            g->load.last_cycle, g->load.in);
    g->cycle.step.points = 0; /* nothing is recorded here */
    for (unsigned i = 0; i < levels; i++) {
        runner *r = &g->run[i];
        *r = (runner){.load = &g->load, .level = first + i, .watch = w};
        fret_status st = fine;
        if (springs && !scene_engine(b->s, &g->load, MODEL_SPRINGS, springs, &r->engine, error)) {
            close_general(g);
            return false;
        }
        if (!springs)
            st = engine_make(&r->engine, MODEL_MEMORY, g->load.normal, g->load.mu, 0, 0);
        r->engine.sine = g->sine;
        g->levels = i + 1;
        if (!st.code)
            st = approach(g, r);
        if (!calc_status(error, &st)) {
            close_general(g);
            return false;
        }
    }
    return true;
}

/* The loss of one model, or its limit; moved: relative, what that is good to. */
static fret_status limit_cycle(general *g, long double *loss, long double *moved) {
    long double at[LEVELS] = {0};
    fret_status st = fine;
    for (unsigned i = 0; i < g->levels && !st.code; i++) {
        runner *r = &g->run[i];
        run_more(r);
        while (run_item_next(r))
            ;
        st = r->status;
        at[i] = r->cycle_loss;
    }
    *moved = 0;
    *loss = g->levels > 1 ? run_limit(at, moved) : at[0];
    return st;
}

static fret_status general_cycle(void *model, long double *loss) {
    long double unused, moved;
    return limit_cycle(model, loss ? loss : &unused, &moved);
}

/* What goes into the contact and is not stored: int F_x d(delta_x) by the trapezoidal rule, between looks. */
static fret_status area_cycle(void *model, long double *loss) {
    general *g = model;
    runner *r = &g->run[0];
    fret_state from = {0}, last, now;
    long double area = 0;
    if (loss)
        engine_state(&r->engine, &from);
    engine_forces(&r->engine, &last);
    g->looks = 0;
    for (run_more(r); run_item_next(r); last = now) {
        engine_forces(&r->engine, &now);
        area += (now.dx - last.dx) * (now.Fx + last.Fx) / 2;
        g->looks++;
    }
    if (!r->status.code && loss) {
        engine_state(&r->engine, &now);
        *loss = area - (now.U - from.U);
    }
    return r->status;
}

/* Does the scene answer for a swinging load without chords? */
static bool by_sine(const bench *b) {
    const answers *a = &b->s->answers;
    return swings(b) && a->levels == 1;
}

/* more: is there time for one that is larger? */
static bool general_row(bench *b, model_family family, unsigned springs, bool *more) {
    general g = {.sine = family == FAMILY_MEMORY && by_sine(b)};
    const unsigned levels = swings(b) && !g.sine ? LEVELS : 1;
    const double start = clock_worked();
    tell_row(b, family, springs);
    if (!open_general(b, &g, springs, 0, levels, nowhere))
        return false;
    const double setting_up = clock_worked() - start;
    bool ok = measure(b, family, springs, general_cycle, &g);
    close_general(&g);
    *more = ok && affords(b, setting_up);
    return ok;
}

/* A period seen at the ends of its chords, or where F_N is constant in it, each branch in so many parts. */
static bool loop_row(bench *b, unsigned level, unsigned parts, bool *more) {
    general g = {.levels = 0};
    const double start = clock_worked();
    if (!open_general(b, &g, 0, level, 1, nowhere))
        return false;
    const bool swinging = g.cycle.step.normal_value != 0;
    g.run[0].watch = swinging ? watch_ends() : watch_points(parts);
    const double setting_up = clock_worked() - start;
    bool ok =
        measure(b, FAMILY_LOOP, swinging ? (unsigned long)(RUN_CHORDS << level) / 2 : parts, area_cycle, &g);
    if (ok)
        b->study->row[b->study->count - 1].size = g.looks / 2;
    close_general(&g);
    *more = ok && affords(b, setting_up);
    return ok;
}

/* The loss of the last period in chords of the finest levels; or where all is straight, each step cut in
 * `parts`. */
static bool refined(bench *b, unsigned parts, long double *loss, long double *moved) {
    general g = {.levels = 0};
    fret_state now;
    if (!open_general(b, &g, 0, parts ? 0 : FINEST - LEVELS + 1, parts ? 1 : LEVELS,
                      parts ? watch_points(parts) : nowhere))
        return false;
    fret_status st = limit_cycle(&g, loss, moved);
    engine_state(&g.run[0].engine, &now);
    if (*loss < nothing * now.U)
        *loss = 0;
    close_general(&g);
    return calc_status(b->error, &st);
}

static bool straight_reference(bench *b, accuracy_study *study) {
    long double coarse = 0, unused;
    if (!refined(b, 4, &coarse, &unused) || !refined(b, 8, &study->value, &unused))
        return false;
    study->agreement = fabsl(study->value - coarse) / study->value;
    snprintf(study->reference, sizeof study->reference, "memory diagram, straight steps cut in 8");
    study->why = "FN has changed on the way";
    return true;
}

static bool sine_reference(bench *b, accuracy_study *study) {
    snprintf(study->reference, sizeof study->reference, "memory diagram, limit of up to %d chords a period",
             RUN_CHORDS << FINEST);
    study->why = by_sine(b) ? "FN swings: the sine itself" : "FN swings: chords taken to their limit";
    return refined(b, 0, &study->value, &study->agreement);
}

static bool general_reference(bench *b) {
    accuracy_study *study = b->study;
    if (!(swings(b) ? sine_reference : straight_reference)(b, study))
        return false;
    if (!(study->value > 0))
        return calc_fail(b->error, 0, 0, "nothing slips in the last cycle: dW is 0");
    study->agreement = fmaxl(study->agreement, rounding);
    study->automatic = "memory diagram";
    return true;
}

static bool measure_general(bench *b) {
    bool more = true;
    bool ok = general_reference(b) && general_row(b, FAMILY_MEMORY, 0, &more);
    for (unsigned i = 0, parts = 10; ok && more && i < 4; i++, parts *= 10)
        ok = loop_row(b, 2 * i, parts, &more);
    more = true;
    for (unsigned count = 100; ok && more && count <= 1000000; count *= 10)
        ok = general_row(b, FAMILY_SPRINGS, count, &more);
    return ok;
}

/* ---- the load ---------------------------------------------------------------------------------- */

/* Of the load program where none is given. */
static bool choose_amplitude(scene *s, const accuracy_load *given, accuracy_study *out, double mu,
                             const load_reach *reach, calc_error *error) {
    const fret_state *state;
    load_item cycle;
    out->by_force = given->by_force;
    out->amplitude = given->amplitude;
    out->from = FROM_USER;
    if (given->given)
        return true;
    if (s->end.cycles) {
        scene_last_cycle(s, &cycle, error); /* cannot fail: scene_reach has read it */
        out->by_force = cycle.step.tangential == BY_FORCE;
        out->amplitude = cycle.step.tangential_value;
        out->program = reach->normal_varies || reach->rig;
        out->from = FROM_CYCLE;
        return true;
    }
    if (!scene_state(s, &state, error))
        return false;
    out->by_force = true;
    out->amplitude = fabs((double)state->Fx);
    out->from = FROM_STEP;
    if (!(out->amplitude > 0)) {
        out->amplitude = mu * (double)out->FN / 2;
        out->from = FROM_LIMIT;
    }
    return true;
}

static bool choose_load(scene *s, const accuracy_load *given, accuracy_study *out, steady *m,
                        calc_error *error) {
    long double unused;
    const load_reach *pressed; /* first: a missing load is reported before missing friction */
    if (!scene_reach(s, &pressed, error) || !scene_contact(s, &m->contact, error))
        return false;
    out->FN = m->contact.press.F;
    if (!choose_amplitude(s, given, out, m->contact.mu, pressed, error))
        return false;
    m->by_force = out->by_force;
    m->amplitude = out->amplitude;
    if (out->program)
        return true;
    /* the models that take a double all get the same one, which the gap carries */
    const double F = (double)out->FN;
    fret_status st =
        fret_press_by_force(m->contact.normal, F > out->FN ? nextafter(F, 0) : F, &m->contact.press);
    if (!st.code)
        st = closed_loss(m, &unused);
    return calc_status(error, &st);
}

bool accuracy_measure(scene *s, const accuracy_load *load, accuracy_progress *progress, void *context,
                      accuracy_study *out, calc_error *error) {
    bench b = {.s = s, .error = error, .study = out, .progress = progress, .context = context};
    steady m = {.b = &b};
    *out = (accuracy_study){.count = 0};
    if (!choose_load(s, load, out, &m, error))
        return false;
    b.budget = load->seconds;
    b.end = clock_worked() + load->seconds;
    b.enough = fmin(0.02, load->seconds / 150);
    return out->program ? measure_general(&b) : measure_steady(&b, &m);
}
