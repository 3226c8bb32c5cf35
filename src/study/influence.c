/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Conditioning by differences between neighbouring numbers. Depends on language/trial and text/clock. */
#include "study/influence.h"

#include <float.h>
#include <math.h>

#include "text/clock.h"

/* ---- finding the causes ------------------------------------------------------------------------ */

static void add_input(const scene *s, input in, influence_study *out) {
    if (!s->in.set[in] || s->in.v[in] == 0 || s->in.bindings & INPUT_BIT(in))
        return;
    const quantity *q = quantity_of_input(in);
    out->cause[out->count++] =
        (cause){.name = q->name, .v = {s->in.v[in], quantity_dim(q, s)}, .kind = CAUSE_INPUT, .in = in};
}

static void add_step(influence_study *out, const char *name, load_by by, double *step, bool tangential,
                     bool increment) {
    if (*step != 0)
        out->cause[out->count++] = (cause){.name = name,
                                           .v = {*step, by == BY_FORCE ? DIM_FORCE : DIM_LENGTH},
                                           .kind = CAUSE_STEP,
                                           .step = step,
                                           .tangential = tangential,
                                           .increment = increment};
}

/* Lists the causes in the order in which a session sets them. */
static void find_causes(const scene *s, program *own, influence_study *out) {
    static const input of_cycle[] = {IN_FNA, IN_PHASE, IN_FA, IN_DXA, IN_DRIGA, IN_NW};
    for (input in = 0; in < INPUTS; in++)
        if (!(INPUT_BIT(in) & INPUT_CYCLE))
            add_input(s, in, out);
    load_step *last = own ? &own->steps[s->end.steps - 1] : NULL;
    for (size_t i = 0; i < sizeof of_cycle / sizeof *of_cycle; i++)
        add_input(s, of_cycle[i], out);
    if (own && last->kind == LOAD_STEP && last->normal)
        add_step(out, last->normal == BY_FORCE ? "step FN" : "step dz", (load_by)last->normal,
                 &last->normal_value, false, last->relative & RELATIVE_NORMAL);
    if (own && last->kind == LOAD_STEP && last->tangential)
        add_step(out, quantity_of_step((load_by)last->tangential)->name, (load_by)last->tangential,
                 &last->tangential_value, true, last->relative & RELATIVE_TANGENTIAL);
}

bool cause_is_load(const cause *c) {
    return c->kind == CAUSE_STEP ||
           (c->kind == CAUSE_INPUT && INPUT_BIT(c->in) & (INPUT_PRESS | INPUT_CYCLE));
}

/* ---- changing a cause -------------------------------------------------------------------------- */

typedef struct probe {
    trial *t;
    const expr *e;
    long double result;
    program *own;      /* a copy of the load program whose steps are changed; NULL: there is no load */
    calc_error *error; /* raised: the study ends */
} probe;

static bool set_to(probe *p, const cause *c, double x, calc_error *error) {
    scene *s = &p->t->scene;
    knob k = {.is_input = true, .in = c->in, .d = c->v.d};
    if (c->kind == CAUSE_INPUT)
        return trial_set(p->t, &k, x, error);
    counted_drop(s->program);
    s->program = counted_hold(p->own);
    *c->step = x;
    scene_forget(s);
    return true;
}

/* Computes the result with the cause set to x and all else unchanged; false: the scene refuses x. */
static bool moved_to(probe *p, const cause *c, double x, long double *out) {
    calc_error *why = error_quiet();
    value v = {0};
    trial_reset(p->t);
    const bool ok = set_to(p, c, x, why) && expr_eval(p->t->c, p->e, &v, why);
    if (c->kind == CAUSE_STEP)
        *c->step = (double)c->v.v;
    if (why->stop && !p->error->raised)
        *p->error = *why;
    *out = v.v;
    return ok;
}

/* Relative first and second differences of the result for a step h: *change is the effect of the cause,
 * *noise its uncertainty by rounding and curvature. Returns how many of the two neighbours are valid. */
static int differences(probe *p, const cause *c, double h, long double *change, long double *noise) {
    long double at[2];
    int valid = 0, side = 0;
    for (int sign = -1; sign <= 1 && !p->error->raised; sign += 2)
        if (moved_to(p, c, (double)c->v.v + sign * h, &at[valid])) {
            valid++;
            side = sign;
        }
    if (valid == 1) { /* at the end of its range: differences to one side */
        if (!moved_to(p, c, (double)c->v.v + 2 * side * h, &at[1]))
            return 0;
        *change = fabsl((at[0] - p->result) / p->result);
        *noise = fabsl((at[1] - 2 * at[0] + p->result) / p->result);
    } else if (valid == 2) {
        *change = fabsl((at[1] - at[0]) / 2 / p->result);
        *noise = fabsl((at[1] - 2 * p->result + at[0]) / p->result);
    }
    return valid;
}

/* Tries steps of 1, 2^12 and 2^24 units in the last place and takes the least uncertain: close to a
 * singularity only neighbouring numbers give the slope, elsewhere a wider step exceeds rounding. */
static void find_influence(probe *p, cause *c) {
    const double x = fabs((double)c->v.v), ulp = nextafter(x, INFINITY) - x;
    long double least = HUGE_VALL; /* uncertainty of change */
    int nearest = 0;
    c->digit = ulp / (long double)x;
    for (int bits = 0; bits <= 24 && !p->error->raised; bits += 12) {
        long double change = 0, noise = 0, scale = (long double)(1 << bits);
        const int valid = differences(p, c, ulp * (double)scale, &change, &noise);
        if (bits == 0)
            nearest = valid;
        if (valid == 0 || valid < nearest)
            break;
        if (change == 0 && noise == 0)
            continue;
        noise += DBL_EPSILON;
        if (noise / scale < least) {
            least = noise / scale;
            c->change = change / scale;
        }
        if (noise < change / 64)
            break;
    }
    c->refused = nearest < 2;
    c->influence = nearest == 0                           ? INFLUENCE_HIDDEN
                   : least == HUGE_VALL                   ? INFLUENCE_NONE
                   : c->change + least < 0.01L * c->digit ? INFLUENCE_SMALL
                   : least > c->change / 2                ? INFLUENCE_HIDDEN
                                                          : INFLUENCE_SHOWN;
}

static bool probe_all(probe *p, influence_study *out) {
    const double start = clock_worked();
    for (size_t i = 0; i < out->count; i++) {
        if (clock_worked() - start < (double)INFLUENCE_SECONDS)
            find_influence(p, &out->cause[i]);
        else
            out->cause[i].influence = INFLUENCE_SKIPPED;
        if (p->error->raised || calc_stopped(p->t->scene.stop, p->error))
            return false;
    }
    return true;
}

bool influences(calc *c, const expr *e, long double result, influence_study *out, calc_error *error) {
    const scene *s = c->now;
    probe p = {.e = e, .result = result, .error = error};
    out->count = 0;
    if (result == 0)
        return true;
    if (s->end.steps && !(p.own = program_copy(s->program, s->end)))
        return calc_no_memory(error);
    find_causes(s, p.own, out);
    bool ok = (p.t = trial_open(c, error)) && probe_all(&p, out);
    if (p.t)
        p.t->scene.used = 0; /* the models used here must not be reported as those of the answer */
    trial_close(p.t);
    counted_drop(p.own);
    return ok;
}
