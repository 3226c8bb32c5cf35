/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The gap after Nw cycles of wear: runs of wear, shared by scenes that wear equally. Uses the library. */
#include <math.h>
#include <stdlib.h>

#include "scene/scene.h"

/* A wear path: an unworn law, what is held, and the run of its wear. */
struct wear_path {
    counted base;
    fret_normal *normal; /* unworn */
    shared_table *table; /* table of its gap, or NULL */
    fret_wear_held held;
    fret_wear_run *run;
    worn_gap *last; /* the last result */
};

static void worn_end(counted *self) {
    worn_gap *w = (worn_gap *)self;
    fret_wear_free(w->wear);
    fret_normal_free(w->normal);
    free(w);
}

static void path_end(counted *self) {
    wear_path *p = (wear_path *)self;
    counted_drop(p->last ? &p->last->base : NULL);
    fret_wear_run_free(p->run);
    fret_normal_free(p->normal);
    counted_drop(p->table ? &p->table->base : NULL);
    free(p);
}

/* ---- what is held ------------------------------------------------------------------------------ */

/* F_N or the depth, as imposed by the press and constant up to the cycle. */
static bool held_press(scene *s, fret_wear_held *out, calc_error *error) {
    const load_step *step = s->program->steps;
    const size_t cycle = program_last_cycle(s->program, s->end);
    long double v = 0;
    out->by_depth = step->normal == BY_DISPLACEMENT;
    if (step->normal > BY_DISPLACEMENT)
        return calc_fail(error, 0, 0, "wear holds FN or dz: press by one of them (press FN=100 N)");
    for (size_t i = 1; i < cycle; i++)
        if (load_moves_normal(&step[i]))
            return calc_fail(error, 0, 0,
                             "wear needs a constant FN up to its cycle, but step %zu changes it: press anew",
                             i);
    if (!scene_get(s, press_input((load_by)step->normal), &v, error))
        return false;
    out->press = (double)v;
    return true;
}

static bool held_cycle(scene *s, fret_wear_held *out, calc_error *error) {
    load_item cycle;
    if (!scene_last_cycle(s, &cycle, error))
        return false;
    if (load_moves_normal(&cycle.step))
        return calc_fail(error, 0, 0, "wear needs a constant FN, but it swings in this cycle (FNA)");
    if (cycle.step.tangential == BY_RIG)
        return calc_fail(error, 0, 0, "wear holds FA or dxA, but this cycle was given by drigA");
    out->by_displacement = cycle.step.tangential == BY_DISPLACEMENT;
    out->amplitude = cycle.step.tangential_value;
    return true;
}

static bool find_held(scene *s, fret_wear_held *out, calc_error *error) {
    long double alpha = 0;
    *out = (fret_wear_held){.mu = 0};
    if (!scene_get(s, IN_ALPHA_W, &alpha, error) || !held_cycle(s, out, error) ||
        !held_press(s, out, error) || !scene_friction(s, &out->mu, error))
        return false;
    out->alpha = (double)alpha;
    return true;
}

/* ---- paths ------------------------------------------------------------------------------------- */

static bool same_held(const fret_wear_held *a, const fret_wear_held *b) {
    return a->by_depth == b->by_depth && a->by_displacement == b->by_displacement && a->press == b->press &&
           a->amplitude == b->amplitude && a->mu == b->mu && a->alpha == b->alpha;
}

/* Makes the wear path of the scene, shared with clones; a new one if the law or what is held differs. */
static bool find_path(scene *s, const fret_wear_held *held, calc_error *error) {
    wear_path *p = s->wears;
    if (p && same_held(&p->held, held) && fret_normal_same(p->normal, s->answers.normal))
        return true;
    counted_drop(p ? &p->base : NULL);
    s->wears = p = calloc(1, sizeof *p);
    if (!p)
        return calc_no_memory(error);
    p->base = (counted){1, path_end};
    p->held = *held;
    p->normal = fret_normal_hold(s->answers.normal);
    p->table = counted_hold(s->in.table ? &s->in.table->base : NULL);
    const fret_status st = fret_wear_run_make(p->normal, held, WEAR_TOLERANCE, &p->run);
    if (st.code) {
        counted_drop(&p->base);
        s->wears = NULL;
    }
    if (st.code == FRET_SINGULAR)
        return calc_fail(error, 0, 0,
                         "where it slips at r = %.6g um pressure is infinite: that wears at once",
                         1e6 * st.value);
    return calc_status(error, st);
}

/* ---- running ----------------------------------------------------------------------------------- */

static void pulse(double cycles, void *user) {
    const scene *s = user;
    (void)cycles;
    if (s->pulse)
        s->pulse();
}

static bool make_worn(scene *s, double Nw, calc_error *error) {
    wear_path *p = s->wears;
    worn_gap *w = calloc(1, sizeof *w);
    if (!w)
        return calc_no_memory(error);
    w->base = (counted){1, worn_end};
    w->normal = fret_normal_hold(p->normal);
    w->held = p->held;
    w->Nw = Nw;
    const fret_status st = fret_wear_after(p->run, Nw, pulse, s, &w->wear);
    if (st.code) {
        counted_drop(&w->base);
        return calc_status(error, st);
    }
    counted_drop(p->last ? &p->last->base : NULL);
    p->last = w;
    return true;
}

bool scene_worn(scene *s, const fret_wear **out, calc_error *error) {
    long double Nw = 0;
    fret_wear_held held;
    worn_gap **mine = &s->answers.worn;
    *out = NULL;
    if (s->before || s->settling & INPUT_BIT(IN_NW) || !inputs_any(&s->in, INPUT_BIT(IN_NW)))
        return true;
    if (!scene_get(s, IN_NW, &Nw, error))
        return false;
    if (!(Nw > 0))
        return true;
    if (!find_held(s, &held, error) || !scene_unworn(s, error))
        return false;
    if (*mine && (*mine)->Nw == (double)Nw && same_held(&(*mine)->held, &held)) {
        *out = (*mine)->wear;
        return true;
    }
    if (*mine) /* runs and fields may borrow its law */
        scene_forget(s);
    if (!scene_unworn(s, error) || !find_path(s, &held, error) ||
        (!(s->wears->last && s->wears->last->Nw == (double)Nw) && !make_worn(s, (double)Nw, error)))
        return false;
    *mine = counted_hold(&s->wears->last->base);
    *out = (*mine)->wear;
    return true;
}

bool scene_normal(scene *s, const fret_normal **normal, calc_error *error) {
    const fret_wear *wear;
    if (!scene_unworn(s, error) || !scene_worn(s, &wear, error))
        return false;
    *normal = wear ? fret_wear_law(wear) : s->answers.normal;
    scene_used_law(s, *normal);
    return true;
}

bool scene_is_worn(const scene *s) {
    return s->answers.worn && s->in.v[IN_NW] > 0 && !s->before;
}

bool scene_is_power(const scene *s) {
    return (!s->in.geometry || geometry_is_power(s->in.geometry)) && !scene_is_worn(s);
}

void scene_take_wear(scene *s, scene *from) {
    if (s->wears)
        return;
    s->wears = from->wears;
    from->wears = NULL;
}

bool scene_wear_limit(scene *s, fret_wear **out, calc_error *error) {
    fret_wear_held held;
    if (!find_held(s, &held, error) || !scene_unworn(s, error))
        return false;
    const fret_status st = fret_wear_limit(s->answers.normal, &held, out);
    if (st.code == FRET_GROSS_SLIP)
        return calc_fail(
            error, 0, 0, "nothing sticks in the end, so wear has no limit; it has one for %s < %.6g %s",
            held.by_displacement ? "dxA" : "FA", (double)st.limit * (held.by_displacement ? 1e6 : 1),
            held.by_displacement ? "um" : "N");
    return calc_status(error, st);
}
