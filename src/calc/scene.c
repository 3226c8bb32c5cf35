/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "calc/scene.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "calc/quantity.h"

/* ---- geometries -------------------------------------------------------------------------------- */

static const geometry geometries[] = {
    {"cone",
     FRET_GAP_POWER,
     1,
     {IN_SLOPE, INPUTS, INPUTS},
     "cone slope=0.05 | cone angle=3 deg",
     "f = slope r"},
    {"paraboloid", FRET_GAP_POWER, 2, {IN_RADIUS, INPUTS, INPUTS}, "paraboloid R=10 mm", "f = r^2/(2R)"},
    {"sphere", FRET_GAP_POWER, 2, {IN_RADIUS, INPUTS, INPUTS}, "sphere R=10 mm", "Hertz: the paraboloid"},
    {"power",
     FRET_GAP_POWER,
     0,
     {IN_N, INPUTS, INPUTS},
     "power n=3 A=50 m^-2 | power n=3 h=1 um r0=1 mm",
     "f = A r^n = h (r/r0)^n"},
    {"sum", FRET_GAP_SUM, 0, {INPUTS, INPUTS, INPUTS}, "sum 2:50 m^-1, 4:2e6 m^-3", "f = sum of A r^n"},
    {"flat-cone",
     FRET_GAP_FLAT_CONE,
     0,
     {IN_B, IN_SLOPE, INPUTS},
     "flat-cone b=1 mm slope=0.05",
     "f = slope (r-b), r > b"},
    {"flat-paraboloid",
     FRET_GAP_FLAT_PARABOLOID,
     0,
     {IN_B, IN_RADIUS, INPUTS},
     "flat-paraboloid b=1 mm R=10 mm",
     "f = (r^2-b^2)/(2R), r > b"},
    {"flat-rounded",
     FRET_GAP_FLAT_ROUNDED,
     0,
     {IN_B, IN_RADIUS, INPUTS},
     "flat-rounded b=1 mm R=10 mm",
     "f = (r-b)^2/(2R), r > b"},
    {"exact-sphere",
     FRET_GAP_EXACT_SPHERE,
     0,
     {IN_RADIUS, INPUTS, INPUTS},
     "exact-sphere R=10 mm",
     "f = R - sqrt(R^2-r^2)"},
    {"file",
     FRET_GAP_TABLE,
     0,
     {INPUTS, INPUTS, INPUTS},
     "file gap.csv",
     "rows of r, f with units in the header"},
};

const geometry *geometry_row(size_t i) {
    return i < sizeof geometries / sizeof *geometries ? &geometries[i] : NULL;
}

const geometry *geometry_find(const char *name, size_t len) {
    for (size_t i = 0; i < sizeof geometries / sizeof *geometries; i++)
        if (strlen(geometries[i].name) == len && !memcmp(geometries[i].name, name, len))
            return &geometries[i];
    return NULL;
}

/* R and slope enter as h and r0 without a rounding: r^2/(2R) = (R/2) (r/R)^2. */
static fret_gap gap_of(const scene *s) {
    const geometry *g = s->geometry;
    if (g->kind == FRET_GAP_SUM)
        return s->sum;
    if (g->kind == FRET_GAP_TABLE)
        return (fret_gap){.kind = FRET_GAP_TABLE, .table = s->table->table};
    fret_gap gap = {
        .kind = g->kind, .terms = 1, .b = s->in[IN_B], .R = s->in[IN_RADIUS], .slope = s->in[IN_SLOPE]};
    if (g->n == 1)
        gap.power[0] = (fret_power){1, s->in[IN_SLOPE], 1};
    else if (g->n == 2)
        gap.power[0] = (fret_power){2, s->in[IN_RADIUS] / 2, s->in[IN_RADIUS]};
    else if (s->set[IN_A])
        gap.power[0] = (fret_power){s->in[IN_N], s->in[IN_A], 1};
    else
        gap.power[0] = (fret_power){s->in[IN_N], s->in[IN_H], s->in[IN_R0]};
    return gap;
}

/* ---- life -------------------------------------------------------------------------------------- */

static void forget_results(scene *s) {
    s->normal_ready = s->press_ready = s->k0_ready = s->state_ready = false;
    s->applied = s->applied_cycles = 0;
    fret_memory_free(s->memory);
    s->memory = NULL;
}

static void drop_table(shared_table *t) {
    if (t && --t->users == 0) {
        fret_table_free(t->table);
        free(t);
    }
}

void scene_free(scene *s) {
    forget_results(s);
    drop_table(s->table);
    fret_memory_free(s->spare);
    if (!s->borrowed) {
        free(s->program);
        free(s->cycles);
    }
    *s = (scene){.stop = s->stop};
}

void scene_clone(scene *to, const scene *from) {
    *to = *from;
    to->borrowed = true;
    if (to->table)
        to->table->users++;
    to->memory = to->spare = NULL;
    to->applied = to->applied_cycles = 0;
    to->state_ready = false;
}

void scene_reset(scene *s, bool all) {
    if (all) {
        scene_free(s);
        return;
    }
    s->steps = s->cycle_count = 0;
    s->normal_varies = false;
    s->set[IN_FN] = false;
    forget_results(s);
}

/* ---- inputs ------------------------------------------------------------------------------------ */

/* Arguments of functions and of cycle are no quantities of the scene, but have a dimension too. */
static dim argument_dimension(const char *name) {
    const quantity *q;
    for (size_t i = 0; (q = quantity_row(i)); i++)
        if (q->argument && !strcmp(q->argument, name))
            return q->argument_d;
    return !strcmp(name, "FNA") ? DIM_FORCE : !strcmp(name, "dxA") ? DIM_LENGTH : DIM_NONE;
}

bool scene_status(const scene *s, calc_error *error, const fret_status *st) {
    if (!st->code)
        return true;
    if (st->code == FRET_INTERRUPTED)
        error->stop = true;
    dim d = DIM_NONE;
    const quantity *q = st->quantity ? quantity_find(st->quantity, strlen(st->quantity)) : NULL;
    if (q)
        d = quantity_dim(q, s);
    else if (st->quantity)
        d = argument_dimension(st->quantity);
    char unit_text[128] = "", limit_unit[128] = "";
    long double scale = unit_choose(d, st->value, 6, unit_text, sizeof unit_text);
    long double limit_scale = unit_choose(d, st->limit, 6, limit_unit, sizeof limit_unit);
    const char *gap1 = *unit_text ? " " : "", *gap2 = *limit_unit ? " " : "";
    double given = (double)(st->value / scale), limit = (double)(st->limit / limit_scale);
    if (st->code == FRET_GROSS_SLIP)
        return calc_fail(error, 0, 0, "%s = %.6g%s%s exceeds mu*FN = %.6g%s%s: gross slip; %s to slide",
                         st->quantity, given, gap1, unit_text, limit, gap2, limit_unit,
                         strcmp(st->quantity, "FA") ? "step by displacement (dx=...)"
                                                    : "cycle by displacement (dxA=...)");
    if (st->code == FRET_TABLE_SHORT) {
        limit_scale = unit_choose(DIM_LENGTH, st->limit, 6, limit_unit, sizeof limit_unit);
        return calc_fail(error, 0, 0,
                         "%s = %.6g%s%s cannot be carried: the gap supports contact radii up to %.6g %s",
                         st->quantity, given, gap1, unit_text, (double)(st->limit / limit_scale), limit_unit);
    }
    if (st->code == FRET_OUTSIDE && st->limit > 0)
        return calc_fail(error, 0, 0, "%s = %.6g%s%s %s (limit %.6g%s%s)", st->quantity, given, gap1,
                         unit_text, fret_status_rule(st->code), limit, gap2, limit_unit);
    if (!st->quantity)
        return calc_fail(error, 0, 0, "%s", fret_status_rule(st->code));
    return calc_fail(error, 0, 0, "%s = %.6g%s%s %s", st->quantity, given, gap1, unit_text,
                     fret_status_rule(st->code));
}

/* Range of one input on its own. */
static fret_status input_status(input in, double v) {
    static const char *const names[INPUTS] = {"E0", "nu", "k", "c0", "E0_2", "nu_2", "mu",   "FN",
                                              "n",  "A",  "h", "r0", "R",    "b",    "slope"};
    fret_code code = FRET_OK;
    if (!isfinite(v))
        code = FRET_NOT_FINITE;
    else if (in == IN_K)
        code = v > -1 && v < 1 ? FRET_OK : FRET_BAD_K;
    else if (in == IN_NU || in == IN_NU_2)
        code = v > -1 && v <= 0.5 ? FRET_OK : FRET_BAD_NU;
    else if (v <= 0)
        code = FRET_NOT_POSITIVE;
    return (fret_status){code, names[in], v, 0};
}

bool scene_check(const scene *s, input in, double v, calc_error *error) {
    fret_status st = input_status(in, v);
    return scene_status(s, error, &st);
}

bool scene_get(const scene *s, input in, long double *out, calc_error *error) {
    bool here = s->set[in];
    switch (in) {
    case IN_K:
        here = true;
        break;
    case IN_E0_2:
    case IN_NU_2:
        if (s->second == SECOND_RIGID)
            return calc_fail(error, 0, 0, "the second body is rigid");
        if (s->second == SECOND_SAME || !here)
            return scene_get(s, in == IN_E0_2 ? IN_E0 : IN_NU, out, error);
        break;
    case IN_N:
        if (s->geometry && s->geometry->n > 0) {
            *out = (long double)s->geometry->n;
            return true;
        }
        break;
    case IN_A:
        if (!here && s->geometry && s->geometry->kind == FRET_GAP_POWER) {
            fret_gap gap = gap_of(s);
            *out = gap.power[0].h * powl(gap.power[0].r0, -(long double)gap.power[0].n);
            return true;
        }
        break;
    default:
        break;
    }
    if (!here) {
        const char *name = input_status(in, 1).quantity;
        if (in <= IN_NU)
            return calc_fail(error, 0, 0,
                             "%s is not set: give the material first (material E0=210 GPa nu=0.3)", name);
        if (in == IN_MU)
            return calc_fail(error, 0, 0, "mu is not set: give the friction first (friction 0.4)");
        if (in == IN_C0)
            return calc_fail(error, 0, 0, "c0 is not set: E(z) = E0 (z/c0)^k needs it (c0 = 1 mm)");
        if (in == IN_FN)
            return calc_fail(error, 0, 0, "there is no load yet: press first (press FN=100 N)");
        if (!s->geometry)
            return calc_fail(error, 0, 0, "%s is not set: give the geometry first (geometry sphere R=10 mm)",
                             name);
        return calc_fail(error, 0, 0, "%s is no parameter of geometry %s", name, s->geometry->name);
    }
    *out = s->in[in];
    return true;
}

static bool make_normal(const scene *s, double k, fret_normal *out, calc_error *error) {
    long double v;
    fret_material m = {.k = k, .c0 = 1};
    if (!scene_get(s, IN_E0, &v, error))
        return false;
    m.body[0].E0 = (double)v;
    if (!scene_get(s, IN_NU, &v, error))
        return false;
    m.body[0].nu = (double)v;
    m.body[1] = m.body[0];
    if (s->second == SECOND_RIGID) {
        m.body[1].rigid = true;
    } else if (s->second == SECOND_GIVEN) {
        if (!scene_get(s, IN_E0_2, &v, error))
            return false;
        m.body[1].E0 = (double)v;
        if (!scene_get(s, IN_NU_2, &v, error))
            return false;
        m.body[1].nu = (double)v;
    }
    if (k != 0) {
        if (!scene_get(s, IN_C0, &v, error))
            return false;
        m.c0 = (double)v;
    }
    if (!s->geometry)
        return calc_fail(error, 0, 0, "there is no geometry yet: give one first (geometry sphere R=10 mm)");
    fret_gap gap = gap_of(s);
    fret_status st = fret_normal_make(&m, &gap, out);
    return scene_status(s, error, &st);
}

bool scene_normal(scene *s, const fret_normal **normal, calc_error *error) {
    if (!s->normal_ready && !make_normal(s, s->in[IN_K], &s->normal, error))
        return false;
    s->normal_ready = true;
    *normal = &s->normal;
    return true;
}

bool scene_k0(scene *s, const fret_normal **normal, calc_error *error) {
    if (!s->k0_ready && !make_normal(s, 0, &s->k0, error))
        return false;
    s->k0_ready = true;
    *normal = &s->k0;
    return true;
}

bool scene_friction(const scene *s, double *mu, calc_error *error) {
    long double v = 0;
    if (!scene_get(s, IN_MU, &v, error))
        return false;
    *mu = (double)v;
    return true;
}

static bool is_geometry_input(input in) {
    return in >= IN_N;
}

void scene_put(scene *s, input in, double v) {
    s->in[in] = v;
    s->set[in] = true;
    if ((in == IN_E0_2 || in == IN_NU_2) && s->second != SECOND_GIVEN) {
        input other = in == IN_E0_2 ? IN_NU_2 : IN_E0_2;
        s->set[other] = false;
        s->second = SECOND_GIVEN;
    }
    if (in == IN_A) /* A and h (r/r0)^n are two ways to say the same */
        s->set[IN_H] = s->set[IN_R0] = false;
    else if (in == IN_H || in == IN_R0)
        s->set[IN_A] = false;
    bool keep = in == IN_MU || in == IN_FN;
    bool normal_ready = keep && s->normal_ready, k0_ready = keep && s->k0_ready;
    forget_results(s);
    s->normal_ready = normal_ready;
    s->k0_ready = k0_ready;
}

/* Everything that the present inputs and program claim must hold. */
static bool validate(scene *s, calc_error *error) {
    const fret_normal *normal;
    const fret_memory *memory;
    for (input in = 0; in < INPUTS; in++)
        if (s->set[in]) {
            fret_status st = input_status(in, s->in[in]);
            if (st.code)
                return scene_status(s, error, &st);
        }
    if (s->steps) {
        long double mu;
        if (s->set[IN_MU] || s->steps > 1)
            return (s->set[IN_MU] || scene_get(s, IN_MU, &mu, error)) && scene_memory(s, &memory, error);
        const fret_press *press;
        return scene_press(s, &press, error);
    }
    bool complete = s->set[IN_E0] && s->set[IN_NU] && s->geometry && (s->in[IN_K] == 0 || s->set[IN_C0]);
    return !complete || scene_normal(s, &normal, error);
}

bool scene_edit(scene *s, void (*edit)(scene *, void *), void *context, calc_error *error) {
    scene old = *s;
    s->memory = NULL; /* kept by old until the new one stands */
    edit(s, context);
    forget_results(s);
    calc_error mine = {0};
    if (validate(s, &mine)) {
        fret_memory_free(old.memory);
        return true;
    }
    fret_memory_free(s->memory);
    fret_memory *spare = s->spare;
    *s = old;
    s->spare = spare;
    if (!error->raised)
        *error = mine;
    return false;
}

static void use_table(scene *s, void *context) {
    s->table = context;
    s->geometry = geometry_find("file", 4);
    for (input in = IN_N; in < INPUTS; in++)
        s->set[in] = false;
}

bool scene_set_table(scene *s, struct fret_table *table, const char *name, calc_error *error) {
    shared_table *shared = malloc(sizeof *shared), *old = s->table;
    if (!shared) {
        fret_table_free(table);
        return calc_fail(error, 0, 0, "out of memory");
    }
    *shared = (shared_table){.users = 1, .table = table};
    size_t n = strlen(name) < sizeof shared->name ? strlen(name) : sizeof shared->name - 1;
    memcpy(shared->name, name, n);
    bool ok = scene_edit(s, use_table, shared, error);
    drop_table(ok ? old : shared);
    return ok;
}

typedef struct one_input {
    input in;
    double v;
} one_input;

static void put_one(scene *s, void *context) {
    const one_input *one = context;
    scene_put(s, one->in, one->v);
}

bool scene_set(scene *s, input in, double v, calc_error *error) {
    fret_status st = input_status(in, v);
    if (st.code)
        return scene_status(s, error, &st);
    if (is_geometry_input(in)) {
        const geometry *g = s->geometry;
        if (!g)
            return calc_fail(error, 0, 0,
                             "there is no geometry yet: give one first (geometry sphere R=10 mm)");
        bool takes = g->required[0] == in || g->required[1] == in ||
                     (g->kind == FRET_GAP_POWER && g->n == 0 &&
                      (in == IN_A || ((in == IN_H || in == IN_R0) && s->set[IN_H])));
        if (!takes)
            return calc_fail(error, 0, 0, "%s is no parameter of geometry %s (%s)", st.quantity, g->name,
                             g->usage);
    }
    if (in == IN_FN && (!s->steps || s->program[0].normal != BY_FORCE)) {
        if (!s->steps)
            return scene_load(s, &(load_step){.kind = LOAD_PRESS, .normal = BY_FORCE, .normal_value = v},
                              NULL, error);
        return calc_fail(error, 0, 0, "the press was not given as FN: press again (press FN=...)");
    }
    one_input one = {in, v};
    return scene_edit(s, put_one, &one, error);
}

/* ---- the load program -------------------------------------------------------------------------- */

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
    size_t index;
    long double cycle_loss;
} runner;

/* A ramp by force that changes F_N is no straight line for the springs: 64 parts, an error of 1e-8. */
static fret_status run_on(runner *r, const fret_step *step) {
    bool ramp = step->normal_by != FRET_KEEP_NORMAL && step->tangential_by == FRET_TO_FX;
    return r->springs ? fret_springs_step(r->springs, step, ramp ? 64 : 1)
                      : fret_memory_step(r->memory, step);
}

static void forces_of(const runner *r, fret_state *out) {
    if (r->springs)
        fret_springs_state(r->springs, out);
    else
        fret_memory_forces(r->memory, out);
}

static fret_status take(runner *r, const fret_step *step, unsigned points) {
    fret_status st;
    if (!r->observe)
        return run_on(r, step);
    fret_state from, now;
    forces_of(r, &from);
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
        fret_memory_state(r->memory, &now);
        r->observe(&now, r->index, r->context);
    }
    st = run_on(r, step);
    if (!st.code) {
        fret_memory_state(r->memory, &now);
        r->observe(&now, r->index, r->context);
    }
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
        step.tangential = i == chords ? c->tangential_value : c->tangential_value * cos(angle);
        step.normal = (double)(FN + c->normal_value * cos(angle + x->phase));
        st = take(r, &step, 1);
        if (r->s->stop && *r->s->stop && !st.code)
            st = (fret_status){FRET_INTERRUPTED, NULL, 0, 0};
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
        first.normal = (double)(FN + c->normal_value * cos(x->phase));
    }
    fret_status st = take(r, &first, r->points);
    for (unsigned i = 0; i < x->times && !st.code; i++) {
        forces_of(r, &state);
        long double before = state.W;
        st = period(r, c, x, FN);
        forces_of(r, &state);
        r->cycle_loss = state.W - before;
        if (r->s->stop && *r->s->stop && !st.code)
            st = (fret_status){FRET_INTERRUPTED, NULL, 0, 0};
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
            fret_status st = fret_press_radius(&r->s->normal, c->normal_value, &p);
            if (st.code)
                return st;
            step.normal = (double)p.dz;
        }
        return take(r, &step, 1);
    }
    fret_state now = {0};
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
    runner r = {.s = s, .memory = s->memory, .points = 1, .cycle_loss = s->cycle_loss};
    while (s->applied < s->steps) {
        const load_step *step = &s->program[s->applied];
        const cycle_extra *x = step->kind == LOAD_CYCLE ? &s->cycles[s->applied_cycles] : NULL;
        fret_status st = run_step(&r, step, x);
        if (!st.code && s->stop && *s->stop)
            st = (fret_status){FRET_INTERRUPTED, NULL, 0, 0};
        if (st.code) {
            fret_memory_free(s->memory); /* half-run: not to be used */
            s->memory = NULL;
            s->applied = s->applied_cycles = 0;
            return scene_status(s, error, &st);
        }
        s->applied++;
        s->applied_cycles += x != NULL;
    }
    s->cycle_loss = r.cycle_loss;
    return true;
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
    s->memory = NULL;
    forget_results(s);
    s->program = NULL;
    s->cycles = NULL;
    s->steps = s->room = s->cycle_count = s->cycle_room = 0;
    s->normal_varies = false;
    s->set[IN_FN] = press->normal == BY_FORCE;
    s->in[IN_FN] = press->normal_value;
    const fret_press *p;
    if (store(s, press, NULL, error) && scene_press(s, &p, error)) {
        fret_memory_free(old.memory);
        free(old.program);
        free(old.cycles);
        return true;
    }
    fret_memory_free(s->memory);
    free(s->program);
    free(s->cycles);
    *s = old;
    return false;
}

/* spare holds the state of the contact so far */
static bool keep_spare(scene *s, double mu, calc_error *error) {
    fret_status st = {FRET_OK, NULL, 0, 0};
    if (!s->spare)
        st = fret_memory_make(&s->normal, mu, &s->spare);
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

bool scene_load(scene *s, const load_step *step, const cycle_extra *extra, calc_error *error) {
    if (step->kind == LOAD_PRESS)
        return start_program(s, step, error);
    if (!s->steps)
        return calc_fail(error, 0, 0, "there is no load yet: press first (press FN=100 N)");
    double mu;
    if (!scene_friction(s, &mu, error) || !catch_up(s, error) || !store(s, step, extra, error))
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
            s->press = (fret_press){state.FN, state.dz, state.a};
        } else {
            const load_step *step = &s->program[0];
            double v = step->normal == BY_FORCE ? s->in[IN_FN] : step->normal_value;
            fret_status st = step->normal == BY_FORCE          ? fret_press_force(normal, v, &s->press)
                             : step->normal == BY_DISPLACEMENT ? fret_press_depth(normal, v, &s->press)
                                                               : fret_press_radius(normal, v, &s->press);
            if (st.code)
                return scene_status(s, error, &st);
        }
        s->press_ready = !s->normal_varies; /* else it moves with every step */
    }
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

/* The whole program on springs, wide enough for the largest contact on the way. */
static bool run_springs(scene *s, calc_error *error) {
    const fret_normal *normal;
    double mu;
    long double a = 0;
    if (!scene_normal(s, &normal, error) || !friction_for_program(s, &mu, error) ||
        !scene_trace(s, 0, widest, &a, error))
        return false;
    runner r = {.s = s, .points = 1};
    fret_status st =
        fret_springs_make(normal, mu, s->springs, (double)(a * (1 + 1e-12L)), FRET_WEIGHT_CELL, &r.springs);
    size_t cycle = 0;
    for (size_t i = 0; i < s->steps && !st.code; i++) {
        const cycle_extra *x = s->program[i].kind == LOAD_CYCLE ? &s->cycles[cycle++] : NULL;
        st = run_step(&r, &s->program[i], x);
        if (!st.code && s->stop && *s->stop)
            st = (fret_status){FRET_INTERRUPTED, NULL, 0, 0};
    }
    if (!st.code)
        fret_springs_state(r.springs, &s->state);
    s->springs_loss = r.cycle_loss;
    fret_springs_free(r.springs);
    return scene_status(s, error, &st);
}

bool scene_state(scene *s, const fret_state **state, calc_error *error) {
    const fret_memory *memory;
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
    *state = &s->state;
    return true;
}

void scene_set_model(scene *s, scene_model model, unsigned springs) {
    s->model = model;
    s->springs = springs;
    s->state_ready = s->press_ready = false;
}

bool scene_closed_state(const scene *s) {
    if (s->model == MODEL_MEMORY || s->model == MODEL_SPRINGS)
        return false;
    return s->steps == 1 ||
           (s->steps == 2 && s->program[1].kind == LOAD_STEP && s->program[1].normal == BY_NONE);
}

bool scene_closed_loss(const scene *s) {
    return !s->normal_varies && (s->model == MODEL_AUTO || s->model == MODEL_CLOSED);
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
    if (s->steps == 1) {
        *out = (fret_loading){0, 0, press->a, press->dz};
        return true;
    }
    double mu;
    if (!scene_friction(s, &mu, error))
        return false;
    const load_step *step = &s->program[1];
    fret_status st = step->tangential == BY_FORCE
                         ? fret_loading_force(normal, mu, press, step->tangential_value, out)
                         : fret_loading_displacement(normal, mu, press, step->tangential_value, out);
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
    fret_status st = c->tangential == BY_FORCE
                         ? fret_cycle_loss(normal, mu, press, c->tangential_value, loss)
                         : fret_cycle_loss_displacement(normal, mu, press, c->tangential_value, loss);
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
    fret_status st = fret_memory_make(normal, mu, &r.memory);
    size_t cycle = 0;
    for (size_t i = 0; i < s->steps && !st.code; i++) {
        const cycle_extra *x = s->program[i].kind == LOAD_CYCLE ? &s->cycles[cycle++] : NULL;
        r.index = i;
        st = run_step(&r, &s->program[i], x);
        if (!st.code && s->stop && *s->stop)
            st = (fret_status){FRET_INTERRUPTED, NULL, 0, 0};
    }
    fret_memory_free(r.memory);
    return scene_status(s, error, &st);
}
