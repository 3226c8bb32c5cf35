/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The memory diagram in double beside the exact one, step by step, over random histories. */
#include "hard.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

/* A law F_N ~ delta_z^((n+k+1)/n), and a part of the steps. */
static const struct {
    double n, k;
    unsigned shorter;
} laws[] = {{2, 0, 1},       {1, 0, 10},       {2, 0.3, 10},    {2, -0.5, 10},
            {0.5, 0.99, 10}, {0.5, -0.99, 10}, {100, 0.99, 10}, {100, -0.99, 10},
            {2, 0.99, 10},   {2, -0.99, 10},   {0.2, 0.7, 10}};

/* What is asked next; sizes are in those of the deepest press. */
typedef struct state {
    double F, z, x; /* F_N [N], delta_z and mu eta delta_z [m] of that press */
    double mu;
    fret_state now;
    unsigned long i;
    double size; /* of the steps for a while */
    hard_random *r;
} state;

/* As a sine, of period 1; libm's differs from place to place. */
static double wave(double t) {
    const double x = t - floor(t);
    return x < 0.5 ? 16 * x * (0.5 - x) : 16 * (x - 0.5) * (x - 1);
}

static double either(hard_random *r, double least, double most) {
    return least + (most - least) * hard_uniform(r);
}

static fret_step by_depth(const state *s, double dz, double dx) {
    return (fret_step){FRET_TO_DEPTH, FRET_TO_DX, dz * s->z, dx * s->x};
}

/* F_x as a part of mu F_N. */
static fret_step by_force(const state *s, double FN, double part) {
    return (fret_step){FRET_TO_FORCE, FRET_TO_FX, FN * s->F, part * (s->mu * (FN * s->F))};
}

static fret_step kept(const state *s) {
    return (fret_step){FRET_KEEP_NORMAL, FRET_TO_DX, 0, either(s->r, -1.4, 1.4) * s->x};
}

static fret_step kept_small(const state *s) {
    return (fret_step){FRET_KEEP_NORMAL, FRET_TO_DX, 0, s->size * either(s->r, -1, 1) * s->x};
}

static fret_step anywhere(const state *s) { /* contact lost and regained */
    fret_step step = by_depth(s, either(s->r, -0.1, 1), either(s->r, -1.5, 1.5));
    if (hard_choice(s->r, 4) == 0)
        step.normal_by = FRET_KEEP_NORMAL;
    if (hard_choice(s->r, 6) == 0)
        step.tangential_by = FRET_KEEP_DX;
    return step;
}

static fret_step nearby(const state *s) {
    const double dz = (double)s->now.dz / s->z + s->size * either(s->r, -0.3, 0.3);
    return by_depth(s, dz > 0 && dz < 1 ? dz : either(s->r, 0, 1),
                    (double)s->now.dx / s->x + s->size * either(s->r, -0.3, 0.3));
}

static fret_step sines(const state *s) {
    const double t = (double)s->i;
    return by_depth(s, 0.6 + 0.3 * wave(t / 203), 0.5 * wave(t / 200 + 0.25));
}

static fret_step few_a_round(const state *s) { /* the same loop again and again */
    static const double turn[4][2] = {{0.9, 0.1}, {0.6, 0.4}, {0.7, -0.2}, {1, -0.5}};
    return by_depth(s, turn[s->i % 4][0], turn[s->i % 4][1]);
}

static fret_step few_forces(const state *s) {
    static const double turn[4][2] = {{0.9, 0.1}, {0.6, 0.4}, {0.7, -0.2}, {1, -0.5}};
    return by_force(s, turn[s->i % 4][0], turn[s->i % 4][1]);
}

static fret_step forces_anywhere(const state *s) {
    fret_step step = by_force(s, either(s->r, 0, 1), either(s->r, -1, 1));
    if (hard_choice(s->r, 4) == 0) {
        step.normal_by = FRET_KEEP_NORMAL;
        step.tangential = s->mu * (double)s->now.FN * either(s->r, -1, 1);
    }
    return step;
}

static fret_step forces_nearby(const state *s) {
    const double FN = (double)s->now.FN / s->F + s->size * either(s->r, -0.3, 0.3);
    const double part = (double)(s->now.Fx / (s->mu * s->F)) / FN + s->size * either(s->r, -0.3, 0.3);
    return by_force(s, FN > 0.01 && FN < 1 ? FN : either(s->r, 0.01, 1),
                    fabs(part) < 1 ? part : either(s->r, -1, 1));
}

static fret_step force_sines(const state *s) {
    const double t = (double)s->i;
    return by_force(s, 0.6 + 0.3 * wave(t / 203), 0.7 * wave(t / 200 + 0.25));
}

static fret_step mixed(const state *s) {
    fret_step step = hard_choice(s->r, 2) ? by_depth(s, either(s->r, -0.02, 1), either(s->r, -1.2, 1.2))
                                          : by_force(s, either(s->r, 0.001, 1), either(s->r, -1, 1));
    if (hard_choice(s->r, 4) == 0 && step.tangential_by == FRET_TO_DX)
        step = (fret_step){FRET_TO_FORCE, FRET_TO_DX, either(s->r, 0, 1) * s->F, step.tangential};
    return step;
}

/* To gross slip less, or more, 1e-9 to 1e-15 of it, with F_N changing or not; from anywhere, but not from
 * another brink, by displacement: there a long double knows no more than a double of what sticks. */
static fret_step brink(const state *s) {
    if (s->i % 3 == 0)
        return by_depth(s, either(s->r, 0.2, 1), (double)s->now.dx / s->x + (s->now.dx < 0 ? 3 : -3));
    if (s->i % 3 == 1)
        return hard_choice(s->r, 2)
                   ? by_force(s, either(s->r, 0.2, 1), either(s->r, -0.9, 0.9))
                   : by_depth(s, either(s->r, 0.2, 1), (double)s->now.dx / s->x + either(s->r, -0.1, 0.1));
    const double off = (hard_choice(s->r, 2) ? 1 : -1) * ldexp(1, -30 - (int)hard_choice(s->r, 20)),
                 side = hard_choice(s->r, 2) ? 1 : -1;
    if (hard_choice(s->r, 2))
        return by_force(s, either(s->r, 0.2, 1), side * (1 - fabs(off)));
    const double dz = hard_choice(s->r, 2) ? (double)s->now.dz / s->z : either(s->r, 0.2, 1);
    return by_depth(s, dz, side * dz * (1 + off));
}

static const struct {
    const char *name;
    fret_step (*next)(const state *);
    unsigned shorter; /* 0: a round of four, run alone after the exact diagram has told what comes of it */
} kinds[] = {
    {"dx at one F_N", kept, 10},
    {"dx, tiny to large", kept_small, 10},
    {"dz, dx anywhere", anywhere, 100},
    {"dz, dx nearby", nearby, 100},
    {"dz, dx sines", sines, 100},
    {"dz, dx, four a round", few_a_round, 0},
    {"FN, Fx, four a round", few_forces, 0},
    {"FN, Fx anywhere", forces_anywhere, 100},
    {"FN, Fx nearby", forces_nearby, 100},
    {"FN, Fx sines", force_sines, 100},
    {"by turns", mixed, 100},
    {"brink of gross slip", brink, 100},
};

enum { FX, DX, NORMAL, STEP, LOSS, STORED, ERRORS };
static const char *const headings[ERRORS] = {"Fx", "dx", "FN, dz", "last dW", "W", "U"};

typedef struct errors {
    double worst[ERRORS];
    size_t slices;
    bool refused;
} errors;

static void keep(errors *e, int which, fret_real difference, fret_real scale) {
    const double x = (double)(fabsl(difference) / scale);
    if (!(x <= e->worst[which]))
        e->worst[which] = x;
}

static void compare(errors *e, const state *s, const fret_contact *exact, const fret_contact *fast,
                    bool all) {
    const double energy = s->mu * s->F * s->x;
    fret_state now;
    fret_contact_forces(fast, &now);
    const fret_real last = fret_contact_last_loss(fast);
    keep(e, FX, s->now.Fx - now.Fx, s->mu * s->F);
    keep(e, DX, s->now.dx - now.dx, s->x);
    keep(e, NORMAL, fmaxl(fabsl(s->now.FN - now.FN) / s->F, fabsl(s->now.dz - now.dz) / s->z), 1);
    keep(e, STEP, fret_contact_last_loss(exact) - last, energy + last);
    keep(e, LOSS, s->now.W - now.W, energy + s->now.W);
    if (all) {
        fret_state ours, theirs;
        fret_contact_state(fast, &ours);
        fret_contact_state(exact, &theirs);
        keep(e, STORED, theirs.U - ours.U, energy);
        e->slices = ours.slices > e->slices ? ours.slices : e->slices;
    }
}

/* Side by side; or the exact one for some rounds of four steps, after which each is as the one before, and
 * the other for all of them. */
static errors run(const fret_normal *normal, double mu, double depth, fret_step (*next)(const state *),
                  unsigned long steps, bool rounds, hard_random *r) {
    enum { STATES = 1000, TWIN = 8 * 4 };
    fret_contact *exact;
    fret_contact *fast;
    fret_press most;
    errors e = {{0}, 0, false};
    if (fret_contact_make(normal, mu, FRET_EXACT, &exact).code ||
        fret_contact_make(normal, mu, FRET_DOUBLE, &fast).code ||
        fret_press_by_depth(normal, depth, &most).code)
        abort();
    state s = {.F = (double)most.F, .z = depth, .mu = mu, .size = 1, .r = r};
    s.x = mu * (double)fret_normal_foundation(normal)->eta * depth;
    fret_real W = 0, loss = 0;
    const fret_step press = {FRET_TO_DEPTH, FRET_KEEP_DX, depth, 0};
    if (fret_contact_step(exact, &press).code || fret_contact_step(fast, &press).code)
        abort();
    for (s.i = 0; s.i < steps; s.i++) {
        if (s.i % 64 == 0)
            s.size = hard_scale(r, -20, 0);
        const fret_step step = next(&s);
        const bool twin = !rounds || s.i < TWIN;
        if (fret_contact_step(fast, &step).code != (twin ? fret_contact_step(exact, &step).code : FRET_OK))
            e.refused = true;
        if (rounds && s.i % 4 == 3) {
            fret_contact_forces(exact, &s.now);
            if (twin) {
                loss = s.now.W - W;
                W = s.now.W;
            }
            s.now.W = W + loss * (fret_real)(s.i / 4 + 1 - TWIN / 4) * !twin;
            compare(&e, &s, exact, fast, s.i < 4 * STATES || s.i + 4 > steps);
        } else if (!rounds) {
            fret_contact_forces(exact, &s.now);
            compare(&e, &s, exact, fast, s.i % (steps / STATES + 1) == 0);
        }
    }
    fret_contact_free(exact);
    fret_contact_free(fast);
    return e;
}

void hard_diagrams(unsigned long steps) {
    enum { LEAST = 200 };
    /* what fret/diagram.h promises */
    static const double promise[ERRORS] = {3e-14, 3e-14, 1e-14, 1e-13, 1e-13, 1e-13};
    printf("diagrams in double, worst error of mu FN, dxmax, FN and dz, and W + mu FN dxmax (U: mu FN "
           "dxmax)\n\n");
    printf("%5s %5s  %-22s %9s", "n", "k", "history", "steps");
    for (int i = 0; i < ERRORS; i++)
        printf(" %8s", headings[i]);
    printf(" %7s\n", "slices");
    for (size_t i = 0; i < sizeof laws / sizeof *laws; i++) {
        fret_material material = {{{210e9, 0.3, false}, {70e9, 0.35, false}}, laws[i].k, 1e-3};
        fret_gap gap = {.kind = FRET_GAP_POWER, .terms = 1, .power = {{laws[i].n, 1e-6, 1e-4}}};
        fret_normal *normal;
        if (fret_normal_make(&material, &gap, NULL, NULL, &normal).code)
            abort();
        for (size_t j = 0; j < sizeof kinds / sizeof *kinds; j++) {
            hard_random r = hard_seed(1 + j);
            const bool rounds = kinds[j].shorter == 0;
            const unsigned long part = steps / laws[i].shorter / (rounds ? 1 : kinds[j].shorter) / 4 * 4,
                                count = part > LEAST ? part : LEAST;
            const errors e = run(normal, 0.4, 1e-6, kinds[j].next, count, rounds, &r);
            const double p = (laws[i].n + laws[i].k + 1) / laws[i].n;
            bool good = !e.refused;
            printf("%5g %5g  %-22s %9lu", laws[i].n, laws[i].k, kinds[j].name, count);
            for (int k = 0; k < ERRORS; k++) {
                printf(" %8.1e", e.worst[k]);
                good = good && e.worst[k] <= promise[k] * (p <= 5 ? 1 : k == DX ? 100 : 10);
            }
            printf(" %7zu%s\n", e.slices, e.refused ? "  REFUSED" : good ? "" : "  WORSE THAN PROMISED");
            char law[40];
            snprintf(law, sizeof law, "diagram n=%g k=%g", laws[i].n, laws[i].k);
            hard_case(law, kinds[j].name, good, !good);
        }
        fret_normal_free(normal);
    }
    printf("\n");
}
