/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "calc/scene.h"
#include "number/real.h"

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

void scene_forget(scene *s) {
    s->press_ready = s->state_ready = false;
    s->applied = s->applied_cycles = 0;
    s->reach = (load_reach){0};
    scene_drop(s);
}

void scene_drop(scene *s) {
    fret_memory_free(s->memory);
    fret_normal_free(s->normal);
    fret_normal_free(s->k0);
    scene_hand_over(s);
}

void scene_hand_over(scene *s) {
    s->memory = NULL;
    s->normal = s->k0 = NULL;
}

static void drop_table(shared_table *t) {
    if (t && --t->users == 0) {
        fret_table_free(t->table);
        free(t);
    }
}

void scene_free(scene *s) {
    scene_forget(s);
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
    to->spare = NULL;
    scene_hand_over(to);
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
    scene_forget(s);
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
            *out = gap.power[0].h * fret_ratio_pow(1, gap.power[0].r0, gap.power[0].n);
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

static bool make_normal(const scene *s, double k, fret_normal **out, calc_error *error) {
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
    if (!s->normal && !make_normal(s, s->in[IN_K], &s->normal, error))
        return false;
    *normal = s->normal;
    return true;
}

bool scene_k0(scene *s, const fret_normal **normal, calc_error *error) {
    if (!s->k0 && !make_normal(s, 0, &s->k0, error))
        return false;
    *normal = s->k0;
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
    fret_normal *normal = s->normal, *k0 = s->k0;
    if (in == IN_MU || in == IN_FN) /* they do not depend on these */
        s->normal = s->k0 = NULL;
    scene_forget(s);
    if (in == IN_MU || in == IN_FN) {
        s->normal = normal;
        s->k0 = k0;
    }
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
    scene_hand_over(s); /* kept by old until the new one stands */
    edit(s, context);
    scene_forget(s);
    calc_error mine = {0};
    if (validate(s, &mine)) {
        scene_drop(&old);
        return true;
    }
    scene_drop(s);
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
