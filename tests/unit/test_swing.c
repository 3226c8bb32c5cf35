/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Harmonic forces event by event: against exact references, and against chords of the same memory. */
#include <pthread.h>

#include "histories.h"
#include "places.h"
#include "unit.h"

static const double half_turn = 3.14159265358979323846;

typedef struct load {
    double n, A, E0, k, mu, FN, FA, FNA, degrees;
    double lead;         /* Fx that is gone to first, in units of mu FN */
    const fret_gap *gap; /* or NULL: n and A */
} load;

static const fret_normal *normal_of(const load *l) {
    const fret_material material = {{{l->E0, 0.3, false}, {l->E0, 0.3, false}}, l->k, 1e-3};
    const fret_gap gap = {.kind = FRET_GAP_POWER, .terms = 1, .power = {{l->n, l->A, 1}}};
    const unit_scene s = {.material = material, .gap = l->gap ? *l->gap : gap, .mu = l->mu};
    return unit_make_normal(&s);
}

/* Of a loss: what is less than the rounding of thin slips is none. A power law has no such. */
static fret_real loss_of(const load *l, const fret_memory *m, fret_real W) {
    const fret_real reach = l->mu * m->normal->foundation.eta * fret_law_depth(m->normal, l->FN);
    return W + (l->gap ? 1e-10L * l->mu * l->FN * reach : 0);
}

/* What numbers are good to: 1e-15 for powers. */
static fret_real known(const load *l) {
    return l->gap ? 1e-13L : 1e-15L;
}

static fret_sine sine_of(const load *l) {
    return (fret_sine){l->FA, l->FNA, l->degrees * half_turn / 180, l->FN};
}

/* Pressed, led somewhere, and taken to where the period begins. */
static fret_memory *begin(const load *l) {
    const fret_sine w = sine_of(l);
    fret_memory *m = NULL;
    if (!CHECK(fret_memory_make(normal_of(l), l->mu, &m).code == FRET_OK))
        exit(unit_finish());
    const fret_step steps[] = {{FRET_TO_FORCE, FRET_KEEP_DX, l->FN, 0},
                               {FRET_KEEP_NORMAL, FRET_TO_FX, 0, l->lead * l->mu * l->FN},
                               {FRET_TO_FORCE, FRET_TO_FX, l->FN + w.FNA * cos(w.phase), l->FA}};
    for (size_t i = 0; i < sizeof steps / sizeof *steps; i++)
        CHECK_OK(fret_memory_step(m, &steps[i]));
    return m;
}

static fret_swing *swing_of(const fret_memory *m) {
    fret_swing *s = NULL;
    if (!CHECK(fret_swing_make(m, &s).code == FRET_OK))
        exit(unit_finish());
    return s;
}

/* A period in chords that end where F_N, Fx, or one plus or minus the other in units of mu turn. */
static fret_real chords(fret_memory *m, const load *l, int count) {
    const fret_sine w = sine_of(l);
    const double x = l->FNA * cos(w.phase), y = -l->FNA * sin(w.phase);
    double node[16];
    int nodes = 0;
    fret_real sum = 0;
    const double turn[] = {0, -w.phase, atan2(y, x - l->FA / l->mu), atan2(y, x + l->FA / l->mu)};
    for (int i = 0; i < 4; i++)
        for (int half = 0; half < 2; half++)
            node[nodes++] = fmod(turn[i] + half * half_turn + 4 * half_turn, 2 * half_turn);
    node[nodes++] = 2 * half_turn;
    for (int i = 1; i < nodes; i++)
        for (int j = i; j > 0 && node[j] < node[j - 1]; j--) {
            const double swap = node[j];
            node[j] = node[j - 1];
            node[j - 1] = swap;
        }
    for (int i = 1; i < nodes; i++)
        for (int j = 1; j <= count && node[i] - node[i - 1] > 1e-9; j++) {
            const double s = node[i - 1] + (node[i] - node[i - 1]) * j / count;
            const fret_step step = {FRET_TO_FORCE, FRET_TO_FX, l->FN + l->FNA * cos(s + w.phase),
                                    l->FA * cos(s)};
            CHECK_OK(fret_memory_step(m, &step));
            sum += m->last_loss;
        }
    return sum;
}

static double number_after(const char *text, const char *word) {
    const char *at = strstr(text, word);
    return CHECK(at != NULL) ? strtod(at + strlen(word), NULL) : (double)NAN;
}

/* Every row of the table, in the words of the language. */
static void references(void) {
    unit_table t;
    if (!unit_open(&t, "swinging.csv"))
        return;
    while (unit_row(&t)) {
        if (t.line < 6) /* the names of the columns */
            continue;
        const char *setup = t.cell[0], *cycle = t.cell[1];
        const bool sphere = strstr(setup, "paraboloid"), cone = strstr(setup, "cone");
        const load l = {.n = sphere ? 2
                             : cone ? 1
                                    : number_after(setup, " n="),
                        .A = sphere ? 50 : number_after(setup, cone ? "slope=" : " A="),
                        .E0 = 1e9 * number_after(setup, "E0="),
                        .k = strstr(setup, " k=") ? number_after(setup, " k=") : 0,
                        .mu = number_after(setup, "friction "),
                        .FN = number_after(setup, "FN="),
                        .FA = number_after(cycle, "FA="),
                        .FNA = number_after(cycle, "FNA="),
                        .degrees = number_after(cycle, "phase=")};
        const fret_sine w = sine_of(&l);
        fret_memory *m = begin(&l);
        fret_swing *s = swing_of(m);
        fret_state now;
        CHECK(fret_swing_fits(s, &w, 0));
        for (int i = 0; i < 3; i++) {
            CHECK_OK(fret_swing_part(s, &w, 0, 1));
            if (i == 0) {
                fret_swing_state(s, &now);
                CHECK_REL(now.W, unit_result(&t, 4), 1e-15L);
                CHECK_ABS(s->last_loss, unit_result(&t, 5), unit_result(&t, 2), 1e-15L);
            }
        }
        fret_swing_state(s, &now);
        CHECK_REL(now.W, unit_result(&t, 2), 1e-15L);
        CHECK_ABS(s->last_loss, unit_result(&t, 3), unit_result(&t, 2), 1e-15L);
        fret_swing_free(s);
        fret_memory_free(m);
    }
}

static double uniform(void) {
    static unsigned long long seed = 1;
    return unit_random(&seed, 0, 1);
}

static double pick(const double *from, size_t count) {
    return from[(size_t)(uniform() * (double)count)];
}

static const fret_gap shapes[] = {
    {.kind = FRET_GAP_EXACT_SPHERE, .R = 10e-3},
    {.kind = FRET_GAP_FLAT_CONE, .b = 0.2e-3, .slope = 0.01},
    {.kind = FRET_GAP_FLAT_PARABOLOID, .b = 0.1e-3, .R = 10e-3},
    {.kind = FRET_GAP_FLAT_ROUNDED, .b = 0.3e-3, .R = 5e-3},
    {.kind = FRET_GAP_SUM, .terms = 2, .power = {{2, 50, 1}, {4, 1e10, 1}}},
    {.kind = FRET_GAP_SUM, .terms = 2, .power = {{2, 50, 1}, {3, 1e-14, 1}}}, /* the sphere, another way */
};

static bool shaped; /* of one of these */

static load random_load(void) {
    static const double n[] = {0.5, 1, 2, 4, 100}, k[] = {-0.99, -0.4, 0, 0.5, 0.99},
                        angle[] = {0, 90, 180, 270};
    load l = {pick(n, 5), 0.05, 210e9, pick(k, 5), 0.4, 100, 0, 0, 0, 1.8 * uniform() - 0.9, NULL};
    l.FNA = 90 * uniform();
    l.FA = 0.95 * uniform() * l.mu * (l.FN - l.FNA);
    l.degrees = uniform() < 0.3 ? pick(angle, 4) : 360 * uniform();
    if (shaped && l.k < -0.9) /* where a flat end takes long */
        l.k = -0.8;
    l.gap = shaped ? &shapes[(size_t)(uniform() * (sizeof shapes / sizeof *shapes))] : NULL;
    return l;
}

/* Two periods of any load: what ever finer chords come near to. */
static void against_chords(int count) {
    for (int i = 0; i < count; i++) {
        const load l = random_load();
        const fret_sine w = sine_of(&l);
        fret_memory *coarse = begin(&l), *fine = begin(&l);
        fret_swing *s = swing_of(coarse);
        fret_state a, b, now;
        fret_real loss[2] = {0, 0};
        CHECK(fret_swing_fits(s, &w, 0));
        for (int j = 0; j < 2; j++) {
            CHECK_OK(fret_swing_part(s, &w, 0, 1));
            loss[0] = chords(coarse, &l, 320);
            loss[1] = chords(fine, &l, 640);
        }
        fret_memory_state(coarse, &a);
        fret_memory_state(fine, &b);
        fret_swing_state(s, &now);
        CHECK_ABS(s->last_loss, loss[1] + (loss[1] - loss[0]) / 3, loss_of(&l, fine, now.W), 1e-8L);
        CHECK_ABS(now.W, b.W + (b.W - a.W) / 3, loss_of(&l, fine, now.W), 1e-8L);
        CHECK_REL(now.U, b.U + (b.U - a.U) / 3, 1e-8L);
        CHECK_REL(now.dx, b.dx + (b.dx - a.dx) / 3, 1e-8L);
        const fret_real rounded = known(&l) * (l.FN + l.FNA) / b.FN; /* of the sum that is FN */
        CHECK_REL(now.FN, b.FN, rounded);
        CHECK_REL(now.dz, b.dz, rounded);
        CHECK_REL(now.a, b.a, l.gap ? 1e-12L : 2e-14L);
        if (fmod(l.degrees, 180) != 0) /* where it ends on the brink of slip, any will do */
            CHECK_REL(now.c, b.c, 1e-3L);
        /* as a memory it carries on from there */
        CHECK_OK(fret_swing_memory(s, coarse));
        fret_memory_state(coarse, &a);
        CHECK_REL(a.dx, now.dx, known(&l));
        CHECK_ABS(a.Fx, now.Fx, l.mu * now.FN, 1e-15L);
        CHECK_REL(a.U, now.U, 1e-5L);
        CHECK(a.W == now.W && a.FN == now.FN);
        fret_swing_free(s);
        fret_memory_free(coarse);
        fret_memory_free(fine);
    }
}

/* Parts of a period come to where one part does, on the sine, and to where chords come near; all of them to
 * where the period ends. */
static void in_parts(int count) {
    enum { CHORDS = 2000 };
    for (int i = 0; i < count; i++) {
        const load l = random_load();
        const fret_sine w = sine_of(&l);
        fret_memory *m = begin(&l);
        fret_swing *whole = swing_of(m), *once = swing_of(m), *parts = swing_of(m);
        fret_state a, b;
        fret_real loss = 0;
        const double middle = i % 4 ? uniform() : 0.25 * (1 + i / 4 % 3);
        double at = 0;
        while (at < 1) {
            double to = at + 0.3 * uniform();
            to = at < middle && to > middle ? middle : to > 1 ? 1 : to;
            CHECK_OK(fret_swing_part(parts, &w, at, to));
            loss += parts->last_loss;
            at = to;
            if (to != middle)
                continue;
            CHECK_OK(fret_swing_part(once, &w, 0, to));
            fret_swing_state(once, &a);
            fret_swing_state(parts, &b);
            const fret_real angle = 2 * acosl(-1) * to, reach = l.mu * m->normal->foundation.eta * a.dz;
            CHECK_ABS(a.Fx, w.FA * cosl(angle), w.FA, 1e-15L);
            CHECK_REL(a.FN, w.FN + w.FNA * cosl(angle + w.phase), 1e-15L);
            CHECK_ABS(b.dx, a.dx, reach, 100 * known(&l));
            CHECK_ABS(b.U, a.U, a.FN * reach, 100 * known(&l));
            CHECK_ABS(b.W, a.W, loss_of(&l, m, a.W), 100 * known(&l));
            CHECK(b.FN == a.FN && b.Fx == a.Fx && b.dz == a.dz && b.a == a.a);
            CHECK_REL(b.c, a.c, 1e-6L);
            for (int j = 1; j <= CHORDS; j++) {
                const fret_real s = angle * j / (fret_real)CHORDS;
                CHECK_OK(fret_memory_step(m, &(fret_step){FRET_TO_FORCE, FRET_TO_FX,
                                                          (double)(w.FN + w.FNA * cosl(s + w.phase)),
                                                          (double)(w.FA * cosl(s))}));
            }
            fret_memory_state(m, &b);
            CHECK_ABS(a.dx, b.dx, reach, 1e-5L);
            CHECK_ABS(a.W, b.W, loss_of(&l, m, a.W), 1e-4L);
        }
        CHECK_OK(fret_swing_part(whole, &w, 0, 1));
        fret_swing_state(whole, &a);
        fret_swing_state(parts, &b);
        CHECK_ABS(b.W, a.W, loss_of(&l, m, a.W), 100 * known(&l));
        CHECK_ABS(loss, whole->last_loss, loss_of(&l, m, a.W), 100 * known(&l));
        CHECK_ABS(b.dx, a.dx, l.mu * m->normal->foundation.eta * a.dz, 100 * known(&l));
        CHECK(b.FN == a.FN && b.Fx == a.Fx && b.dz == a.dz);
        CHECK(b.slices < 40);
        fret_swing_free(whole);
        fret_swing_free(once);
        fret_swing_free(parts);
        fret_memory_free(m);
    }
}

/* Straight steps, as the memory takes them. */
static void against_memory(int count) {
    for (int i = 0; i < count; i++) {
        const load l = random_load();
        fret_memory *m = begin(&l);
        fret_swing *s = swing_of(m), *kept = swing_of(m);
        fret_state a, b;
        for (int j = 0; j < 30; j++) {
            const double FN = 100 * uniform(), part = 2 * uniform() - 1;
            const fret_step step = {j % 3 ? FRET_TO_FORCE : FRET_KEEP_NORMAL, FRET_TO_FX, FN,
                                    j % 3 ? l.mu * FN * part : 0.01 * part};
            const fret_status one = fret_memory_step(m, &step), two = fret_swing_step(s, &step);
            CHECK(one.code == two.code);
            if (one.code)
                continue;
            fret_memory_state(m, &a);
            fret_swing_state(s, &b);
            const fret_real size =
                l.mu * l.mu * m->normal->foundation.eta * 100 * fret_law_depth(m->normal, 100);
            CHECK_ABS(b.W, a.W, a.W + (l.gap ? 1e-4L * size : 0), 100 * known(&l));
            CHECK_ABS(s->last_loss, m->last_loss, size, 10 * known(&l));
            CHECK_ABS(b.U, a.U, size, known(&l));
            CHECK_ABS(b.dx, a.dx, l.mu * m->normal->foundation.eta * a.dz, 10 * known(&l));
            CHECK(b.FN == a.FN && b.dz == fret_memory_pressed(m).dz && b.a == a.a);
            CHECK_REL(b.dz, a.dz, 1e-18L); /* by a power, and pressed */
            CHECK_REL(b.c, a.c, 1e-9L);
            CHECK_REL(b.kt, a.kt, 1e-9L);
            CHECK_OK(fret_swing_copy(kept, s));
        }
        fret_swing_state(s, &a);
        fret_swing_state(kept, &b);
        CHECK(a.W == b.W && a.dx == b.dx && a.U == b.U);
        fret_swing_free(s);
        fret_swing_free(kept);
        fret_memory_free(m);
    }
}

/* In phase the load goes to and fro on a straight line, which the memory takes in two steps: any shape, to
 * the radius of stick on the brink of slip. */
static void in_phase(int count) {
    for (int i = 0; i < count; i++) {
        load l = random_load();
        l.degrees = i % 2 ? 180 : 0;
        const fret_sine w = sine_of(&l);
        const double along = i % 2 ? -l.FNA : l.FNA;
        fret_memory *m = begin(&l);
        fret_swing *s = swing_of(m);
        fret_state a, b;
        for (int period = 0; period < 2; period++) {
            CHECK_OK(fret_swing_part(s, &w, 0, 1));
            CHECK_OK(fret_memory_step(m, &(fret_step){FRET_TO_FORCE, FRET_TO_FX, l.FN - along, -l.FA}));
            CHECK_OK(fret_memory_step(m, &(fret_step){FRET_TO_FORCE, FRET_TO_FX, l.FN + along, l.FA}));
        }
        fret_memory_state(m, &a);
        fret_swing_state(s, &b);
        const fret_real reach = l.mu * m->normal->foundation.eta * a.dz, size = l.mu * 200 * reach;
        CHECK_ABS(b.dx, a.dx, reach, 100 * known(&l));
        CHECK_ABS(b.U, a.U, size, 100 * known(&l));
        CHECK_ABS(b.W, a.W, size, 100 * known(&l));
        if (l.FA < l.mu * l.FNA) { /* it comes back to the slip that was before; else a front meets that */
            CHECK_REL(b.c, a.c, 1e-9L);
            CHECK_REL(b.kt, a.kt, 1e-9L);
        }
        fret_swing_free(s);
        fret_memory_free(m);
    }
}

/* To where a step by force has gone, from the state that two periods and a few steps have left: the same
 * state, but for the rounding of the displacement. */
static void by_displacement(int count) {
    for (int i = 0; i < count; i++) {
        load l = random_load();
        const fret_sine w = sine_of(&l);
        fret_memory *m = begin(&l);
        fret_swing *s = swing_of(m), *t = swing_of(m);
        for (int period = 0; period < 2; period++)
            CHECK_OK(fret_swing_part(s, &w, 0, 1));
        for (int step = 0; step < 4; step++) {
            fret_state before, a, b;
            fret_swing_state(s, &before);
            const double limit = l.mu * (double)before.FN,
                         little = step == 3 ? 1e-7 * limit : 2 * limit, /* a step as small */
                Fx = fmin(0.95 * limit, fmax(-0.95 * limit, (double)before.Fx + little * (uniform() - 0.5)));
            const fret_real reach = l.mu * m->normal->foundation.eta * before.dz, size = limit * reach;
            CHECK_OK(fret_swing_copy(t, s));
            CHECK_OK(fret_swing_step(t, &(fret_step){FRET_KEEP_NORMAL, FRET_TO_FX, 0, Fx}));
            fret_swing_state(t, &a);
            CHECK_OK(fret_swing_step(s, &(fret_step){FRET_KEEP_NORMAL, FRET_TO_DX, 0, (double)a.dx}));
            fret_swing_state(s, &b);
            CHECK(b.dx == (double)a.dx);
            /* what the displacement is rounded by, at most, as a force */
            const fret_real rounded = DBL_EPSILON * fabsl(a.dx) * a.kn / m->normal->foundation.eta;
            CHECK_ABS(b.Fx, a.Fx, limit, 100 * known(&l) + rounded / limit);
            CHECK_ABS(b.U, a.U, size, 100 * known(&l) + 2 * rounded / limit);
            CHECK_ABS(b.W, a.W, size, 100 * known(&l) + 2 * rounded / limit);
            if (fabsl(a.Fx - before.Fx) > 1e-9L * limit)
                CHECK_ABS(b.c, a.c, a.a, 1e-5L);
        }
        fret_swing_free(s);
        fret_swing_free(t);
        fret_memory_free(m);
    }
}

/* By displacement through slip throughout, and back: the memory of the same contact, once all that a swing
 * has left is gone. */
static void through_slip(void) {
    load l = {2, 50, 210e9, 0.3, 0.4, 100, 20, 30, 60, 0.3, NULL};
    const fret_sine w = sine_of(&l);
    fret_memory *m = begin(&l);
    fret_swing *s = swing_of(m);
    fret_state before, a, b;
    CHECK_OK(fret_swing_part(s, &w, 0, 1));
    fret_swing_state(s, &before);
    CHECK_OK(fret_swing_memory(s, m));
    const fret_real reach = l.mu * m->normal->foundation.eta * before.dz, limit = l.mu * before.FN;
    const double to[] = {-2, -2.5, -2.5, -1.7, 0, 3, 2.9, 3};
    for (size_t i = 0; i < sizeof to / sizeof *to; i++) {
        const fret_step step = {FRET_KEEP_NORMAL, FRET_TO_DX, 0, to[i] * (double)reach};
        CHECK_OK(fret_memory_step(m, &step));
        CHECK_OK(fret_swing_step(s, &step));
        fret_memory_state(m, &a);
        fret_swing_state(s, &b);
        CHECK(b.dx == step.tangential && a.dx == step.tangential);
        CHECK_ABS(b.Fx, a.Fx, limit, 1e-15L);
        CHECK_ABS(b.U, a.U, limit * reach, 1e-15L);
        /* the first step goes over what curves, which the memory has in chords */
        CHECK_ABS(b.W, a.W, limit * reach, 1e-6L);
        CHECK_ABS(s->last_loss, m->last_loss, limit * reach, i ? 1e-15L : 1e-6L);
        CHECK_ABS(b.c, a.c, a.a, 1e-9L);
        CHECK_ABS(b.kt, a.kt, a.kn, 1e-9L);
    }
    /* an open contact moves freely */
    CHECK_OK(fret_swing_step(s, &(fret_step){FRET_TO_FORCE, FRET_TO_FX, 0, 0}));
    CHECK_OK(fret_swing_step(s, &(fret_step){FRET_KEEP_NORMAL, FRET_TO_DX, 0, 1e-6}));
    fret_swing_state(s, &a);
    CHECK(a.dx == 1e-6 && a.Fx == 0 && a.FN == 0 && s->last_loss == 0);
    fret_swing_free(s);
    fret_memory_free(m);
}

static void refusals(void) {
    load l = {2, 50, 210e9, 0, 0.4, 100, 20, 30, 90, 0, NULL};
    fret_memory *m = begin(&l);
    fret_swing *s = swing_of(m);
    fret_state before, after;
    fret_swing_state(s, &before);
    const fret_sine slides = {39, 30, 1, 100}, elsewhere = {20, 30, 1, 100}, opens = {0, 100, 0, 100};
    CHECK(!fret_swing_fits(s, &slides, 0) && !fret_swing_fits(s, &elsewhere, 0) &&
          !fret_swing_fits(s, &opens, 0));
    const fret_step by_dx = {FRET_TO_FORCE, FRET_TO_DX, 90, 1e-7},
                    held = {FRET_TO_FORCE, FRET_KEEP_DX, 90, 0},
                    no_dx = {FRET_KEEP_NORMAL, FRET_TO_DX, 0, (double)NAN},
                    too_much = {FRET_KEEP_NORMAL, FRET_TO_FX, 0, 50},
                    nan = {FRET_KEEP_NORMAL, FRET_TO_FX, 0, (double)NAN};
    CHECK(fret_swing_step(s, &by_dx).code == FRET_OUTSIDE);
    CHECK(fret_swing_step(s, &held).code == FRET_OUTSIDE);
    CHECK(fret_swing_step(s, &no_dx).code == FRET_NOT_FINITE);
    CHECK(fret_swing_step(s, &too_much).code == FRET_GROSS_SLIP);
    CHECK(fret_swing_step(s, &nan).code == FRET_NOT_FINITE);
    const fret_step below = {FRET_TO_FORCE, FRET_TO_FX, -1, 0},
                    no_depth = {FRET_TO_DEPTH, FRET_TO_FX, (double)NAN, 0};
    CHECK(fret_swing_step(s, &below).code == FRET_NEGATIVE);
    CHECK(fret_swing_step(s, &no_depth).code == FRET_NOT_FINITE);
    const double times[][2] = {{-0.1, 1},   {0.5, 0.5},       {0.5, 0.4},      {0, 1.1},
                               {-100, 100}, {0, (double)NAN}, {(double)NAN, 1}};
    for (size_t i = 0; i < sizeof times / sizeof *times; i++)
        CHECK(fret_swing_part(s, &(fret_sine){20, 30, half_turn / 2, 100}, times[i][0], times[i][1]).code ==
              FRET_OUTSIDE);
    CHECK_OK(fret_swing_copy(s, s));
    fret_swing_state(s, &after);
    CHECK(before.dx == after.dx && before.W == after.W);
    fret_swing_free(s);
    fret_memory_free(m);
    fret_swing_free(NULL);
    /* rows are kinks of the law */
    const double r[] = {0, 1e-3, 2e-3}, f[] = {0, 5e-5, 2e-4};
    struct fret_table *rows = NULL;
    CHECK_OK(fret_table_make(r, f, 3, NULL, &rows));
    const fret_gap sampled = {.kind = FRET_GAP_TABLE, .table = rows};
    const unit_scene steel = unit_make_scene(2, 0);
    s = NULL;
    CHECK_OK(fret_memory_make(unit_keep_normal(&steel.material, &sampled), 0.4, &m));
    CHECK(!fret_normal_swings(m->normal));
    CHECK_CODE(fret_swing_make(m, &s), FRET_OUTSIDE);
    CHECK(s == NULL);
    fret_memory_free(m);
    fret_table_free(rows);
}

/* A sphere that does not carry the top of a swing; and of no shape but powers are fields had along the curve.
 */
static void too_small(void) {
    const unit_scene steel = unit_make_scene(2, 0);
    const double top = 180;
    fret_normal *n = NULL;
    fret_press p;
    for (double R = 1e-5; R < 1e-2 && !n; R *= 1.1) {
        const fret_gap ball = {.kind = FRET_GAP_EXACT_SPHERE, .R = R};
        n = unit_keep_normal(&steel.material, &ball);
        if (fret_press_by_force(n, 120, &p).code)
            n = NULL;
    }
    CHECK_CODE(fret_press_by_force(n, top, &p), FRET_TABLE_SHORT);
    fret_memory *m = NULL;
    fret_real q;
    CHECK_OK(fret_memory_make(n, 0.4, &m));
    CHECK_OK(fret_memory_step(m, &(fret_step){FRET_TO_FORCE, FRET_TO_FX, 110, 1}));
    fret_swing *s = swing_of(m);
    CHECK(fret_swing_fits(s, &(fret_sine){1, 10, 0, 100}, 0));
    CHECK_OK(fret_memory_step(m, &(fret_step){FRET_TO_FORCE, FRET_TO_FX, 20, 1}));
    fret_swing_free(s);
    s = swing_of(m);
    CHECK(!fret_swing_fits(s, &(fret_sine){1, top - 100, acos(-1), 100}, 0));
    CHECK_OK(place_surface_x(SWUNG(s), 1e-2, &q)); /* beyond the sphere, too */
    CHECK(q > 0);
    fret_swing_free(s);
    fret_memory_free(m);
}

/* A step by depth is the one by the force at that depth; one to no depth opens the contact. */
static void by_depth(void) {
    load l = {2, 50, 210e9, 0.3, 0.4, 100, 20, 30, 90, 0, NULL};
    fret_memory *m = begin(&l);
    fret_swing *s = swing_of(m), *t = swing_of(m);
    fret_state one, two;
    fret_press p;
    CHECK_OK(fret_press_by_force(m->normal, 80, &p));
    CHECK_OK(fret_swing_step(s, &(fret_step){FRET_TO_FORCE, FRET_TO_FX, 80, 5}));
    CHECK_OK(fret_swing_step(t, &(fret_step){FRET_TO_DEPTH, FRET_TO_FX, (double)p.dz, 5}));
    fret_swing_state(s, &one);
    fret_swing_state(t, &two);
    CHECK_REL(two.FN, one.FN, 1e-14L);
    CHECK_REL(two.dx, one.dx, 1e-13L);
    CHECK_REL(two.W, one.W, 1e-13L);
    CHECK_OK(fret_swing_step(t, &(fret_step){FRET_TO_DEPTH, FRET_TO_FX, -1e-6, 0}));
    fret_swing_state(t, &two);
    CHECK(two.FN == 0 && two.Fx == 0 && two.a == 0 && two.c == 0 && two.kt == 0);
    CHECK(two.W > one.W); /* what was stored is lost */
    CHECK_OK(fret_swing_memory(t, m));
    fret_memory_state(m, &one);
    CHECK(one.slices == 0 && one.FN == 0 && one.W == two.W && one.dx == two.dx);
    fret_swing_free(s);
    fret_swing_free(t);
    fret_memory_free(m);
}

/* Steps of all sizes, down to the last digit, and to the brink of gross slip, beside the memory diagram.
 * There a force, known to 512 roundings, moves displacement and loss by its power n/(n+k+1). */
static void tiny_steps(void) {
    enum { RUNS = 40 };
    unsigned long long seed = 0;
    const double mu = 0.4;
    for (int run = 0; run < 2 * RUNS; run++) { /* and the same to the other side */
        if (unit_skips((size_t)run % RUNS))
            continue;
        const double side = run < RUNS ? 1 : -1;
        if (run % RUNS == 0)
            seed = 7;
        const unit_scene s =
            unit_make_scene(run % RUNS % 3 ? 2 : unit_random(&seed, 1, 4), unit_random(&seed, -0.9, 0.9));
        const fret_normal *n = unit_make_normal(&s);
        double F = 10, T = 0;
        fret_memory *m;
        fret_swing *w;
        fret_press p;
        fret_state a, b;
        CHECK_OK(fret_press_by_force(n, F, &p));
        const fret_real slip = mu * n->foundation.eta * p.dz, known = 4 * powl(512 * LDBL_EPSILON, n->q);
        CHECK_OK(fret_memory_make(n, mu, &m));
        CHECK_OK(fret_memory_step(m, &(fret_step){FRET_TO_FORCE, FRET_TO_FX, F, T}));
        CHECK_OK(fret_swing_make(m, &w));
        for (int i = 0; i < 150; i++) {
            const double size = pow(10, unit_random(&seed, -17, -0.5));
            const int kind = (int)unit_random(&seed, 0, 4);
            const double FN = kind ? F * (1 + unit_random(&seed, -size, size)) : F,
                         Fx = kind == 3   ? mu * FN * (unit_random(&seed, 0, 1) < 0.5 ? 1 : -1)
                              : kind == 1 ? T
                                          : T + mu * F * unit_random(&seed, -size, size);
            const fret_step step = {FRET_TO_FORCE, FRET_TO_FX, FN, side * Fx};
            if (fabs(Fx) > mu * FN)
                continue;
            CHECK_OK(fret_memory_step(m, &step));
            CHECK_OK(fret_swing_step(w, &step));
            F = FN;
            T = Fx;
            fret_memory_state(m, &a);
            fret_swing_state(w, &b);
            CHECK_ABS(b.dx, a.dx, slip, known);
            CHECK_ABS(b.U, a.U, mu * 10 * slip, UNIT_TOL(1e-12L, 1e-9L));
            CHECK_ABS(b.W, a.W, mu * 10 * slip, 20 * known); /* of all steps */
        }
        fret_swing_free(w);
        fret_memory_free(m);
    }
}

/* A period and steps with every F_x turned round: the same, with every displacement turned round. */
static void mirrored(int count) {
    for (int i = 0; i < count; i++) {
        load l = random_load();
        l.FA *= i % 8 != 0;
        load turned = l;
        turned.FA = -l.FA;
        turned.lead = -l.lead;
        const fret_sine w = sine_of(&l), v = sine_of(&turned);
        fret_memory *m[2] = {begin(&l), begin(&turned)};
        fret_swing *s[2] = {swing_of(m[0]), swing_of(m[1])};
        fret_state a, b;
        const fret_real reach = l.mu * m[0]->normal->foundation.eta * m[0]->edge.y[DEPTH];
        for (int j = 0; j < 20; j++) {
            if (j % 4 == 0) {
                const fret_real FN = l.FN + w.FNA * cosl(w.phase);
                for (int side = 0; side < 2; side++)
                    CHECK_OK(fret_swing_step(
                        s[side], &(fret_step){FRET_TO_FORCE, FRET_TO_FX, (double)FN, side ? -l.FA : l.FA}));
                CHECK_OK(fret_swing_part(s[0], &w, 0, 1));
                CHECK_OK(fret_swing_part(s[1], &v, 0, 1));
            } else {
                const double FN = 100 * uniform(), Fx = l.mu * FN * (2 * uniform() - 1);
                for (int side = 0; side < 2; side++)
                    CHECK_OK(fret_swing_step(s[side],
                                             &(fret_step){FRET_TO_FORCE, FRET_TO_FX, FN, side ? -Fx : Fx}));
            }
            fret_swing_state(s[0], &a);
            fret_swing_state(s[1], &b);
            CHECK(a.Fx == -b.Fx && a.FN == b.FN && a.dz == b.dz);
            CHECK_REL(b.W, a.W, 1e-15L);
            CHECK_ABS(b.dx, -a.dx, reach, 1e-15L);
            CHECK_ABS(b.U, a.U, a.FN * reach, 1e-15L);
            if (j % 4 || fmod(l.degrees, 180) != 0) { /* on the brink of slip any will do */
                CHECK_REL(b.c, a.c, 1e-9L);
                CHECK_REL(b.kt, a.kt, 1e-9L);
            }
        }
        for (int side = 0; side < 2; side++) {
            fret_swing_free(s[side]);
            fret_memory_free(m[side]);
        }
    }
}

/* F_N in phase with F_x/mu and as large: on a straight line, which just sticks once it has been gone along.
 */
static void one_stays(void) {
    for (int turned = 0; turned < 2; turned++) {
        const load l = {2, 50, 210e9, 0.3, 0.5, 100, turned ? -20 : 20, 40, 0, 0, NULL};
        const fret_sine w = sine_of(&l);
        fret_memory *m = begin(&l);
        fret_swing *s = swing_of(m);
        fret_state now, straight, after;
        for (int half = 0; half < 2; half++) {
            const fret_step step = {FRET_TO_FORCE, FRET_TO_FX, half ? 140 : 60, half ? l.FA : -l.FA};
            CHECK_OK(fret_swing_part(s, &w, 0.5 * half, 0.5 * (half + 1)));
            CHECK_OK(fret_memory_step(m, &step));
            fret_swing_state(s, &now);
            fret_memory_state(m, &straight);
            CHECK(now.FN == straight.FN && now.Fx == straight.Fx && now.W > 0);
            CHECK_REL(now.W, straight.W, 1e-15L);
            CHECK_REL(now.dx, straight.dx, 1e-15L);
            CHECK_REL(now.U, straight.U, 1e-15L);
        }
        CHECK_OK(fret_swing_part(s, &w, 0, 1));
        fret_swing_state(s, &after);
        CHECK(after.W == now.W && after.FN == now.FN && after.Fx == now.Fx);
        CHECK_REL(after.dx, now.dx, 1e-17L);
        CHECK_REL(after.U, now.U, 1e-17L);
        fret_swing_free(s);
        fret_memory_free(m);
    }
}

/* What has been opened is pressed as if new, but for what it has lost. */
static void opened_and_closed(void) {
    const load l = {2, 50, 210e9, 0.3, 0.4, 100, 20, 30, 90, 0.7, NULL};
    fret_memory *m = begin(&l), *fresh;
    fret_swing *s = swing_of(m), *t;
    fret_state open, a, b;
    const fret_step lifted = {FRET_TO_FORCE, FRET_TO_FX, 0, 0}, pressed = {FRET_TO_FORCE, FRET_TO_FX, 80, 10},
                    pushed = {FRET_KEEP_NORMAL, FRET_TO_FX, 0, 25};
    CHECK_OK(fret_swing_step(s, &lifted));
    fret_swing_state(s, &open);
    CHECK(open.FN == 0 && open.slices == 0 && open.W > 0);
    CHECK_OK(fret_swing_step(s, &pressed));
    CHECK_OK(fret_swing_step(s, &pushed));
    CHECK_OK(fret_memory_make(m->normal, l.mu, &fresh));
    CHECK_OK(fret_memory_step(fresh, &pressed));
    t = swing_of(fresh);
    CHECK_OK(fret_swing_step(t, &pushed));
    fret_swing_state(s, &a);
    fret_swing_state(t, &b);
    CHECK_REL(a.W - open.W, b.W, 1e-15L);
    CHECK_REL(a.dx - open.dx, b.dx, 1e-15L);
    CHECK_REL(a.U, b.U, 1e-17L);
    CHECK(a.slices == b.slices && a.c == b.c && a.kt == b.kt);
    fret_swing_free(s);
    fret_swing_free(t);
    fret_memory_free(m);
    fret_memory_free(fresh);
}

/* From one sine to another where they meet and F_N - F_x/mu and F_N + F_x/mu both rise: what follows falls
 * along the one and then along the other. */
static void from_one_way_to_another(void) {
    enum { CHORDS = 4000 };
    const load l = {2, 50, 210e9, 0.3, 0.5, 100, 5, 30, 180, 0, NULL};
    const double lower = half_turn + asin(10 / 24.0); /* by as much as the sine is above its mean there */
    const fret_sine first = sine_of(&l), second[] = {{8, 30, half_turn, 100},
                                                     {8, 24, half_turn, 100}, /* the same F_N - F_x/mu */
                                                     {5, 24, lower, 90}};
    for (size_t i = 0; i < sizeof second / sizeof *second; i++) {
        fret_memory *m = begin(&l);
        fret_swing *s = swing_of(m);
        fret_state a, b;
        for (int quarter = 0; quarter < 4; quarter++) {
            const fret_sine *w = quarter ? &second[i] : &first;
            CHECK_OK(fret_swing_part(s, w, 0.25 * quarter, 0.25 * (quarter + 1)));
            for (int j = 1; j <= CHORDS; j++) {
                const fret_real angle = acosl(-1) / 2 * (quarter + (fret_real)j / (fret_real)CHORDS);
                CHECK_OK(fret_memory_step(m, &(fret_step){FRET_TO_FORCE, FRET_TO_FX,
                                                          (double)(w->FN + w->FNA * cosl(angle + w->phase)),
                                                          (double)(w->FA * cosl(angle))}));
            }
            fret_swing_state(s, &a);
            fret_memory_state(m, &b);
            CHECK_REL(a.FN, b.FN, 1e-15L);
            CHECK_REL(a.dx, b.dx, 1e-6L);
            CHECK_REL(a.U, b.U, 1e-6L);
            CHECK_ABS(a.W, b.W, a.U, 1e-7L);
        }
        CHECK(a.W > 1e-3L * a.U);
        fret_swing_free(s);
        fret_memory_free(m);
    }
}

typedef struct question {
    fret_swing *of;
    fret_state state;
    fret_real q, u;
    bool failed;
    pthread_barrier_t *together;
} question;

static void *ask(void *context) {
    question *a = context;
    pthread_barrier_wait(a->together);
    fret_swing_state(a->of, &a->state);
    a->failed =
        place_traction(SWUNG(a->of), 5e-5L, &a->q).code || place_surface_x(SWUNG(a->of), 5e-4L, &a->u).code;
    return NULL;
}

/* Questions only read: two threads may ask the same curve, also one that nobody has asked yet. */
static void asked_by_two(void) {
    load l = {2, 50, 210e9, 0.3, 0.4, 100, 20, 30, 60, 0, NULL};
    const fret_sine w = sine_of(&l);
    fret_memory *m = begin(&l);
    bool curved = false;
    for (int i = 1; i <= 10; i++) {
        fret_swing *s = swing_of(m);
        CHECK_OK(fret_swing_part(s, &w, 0, i / 10.0));
        for (size_t j = 0; j < s->count; j++)
            curved = curved || s->arcs[j].curved;
        pthread_barrier_t together;
        pthread_t other;
        CHECK(pthread_barrier_init(&together, NULL, 2) == 0);
        question a = {.of = s, .together = &together}, b = a;
        const size_t size = s->count * sizeof *s->arcs;
        char *before = malloc(size);
        if (!before || pthread_create(&other, NULL, ask, &b))
            exit(unit_finish());
        memcpy(before, s->arcs, size);
        ask(&a);
        CHECK(pthread_join(other, NULL) == 0);
        CHECK(!memcmp(before, s->arcs, size));
        CHECK(!a.failed && !b.failed && a.state.dx == b.state.dx && a.state.U == b.state.U && a.q == b.q &&
              a.u == b.u && a.state.U > 0);
        pthread_barrier_destroy(&together);
        free(before);
        fret_swing_free(s);
    }
    CHECK(curved);
    fret_memory_free(m);
}

int main(int argc, char **argv) {
    unit_start("swing", argc, argv);
    CASE(references());
    for (int i = 0; i < 2; i++) {
        shaped = i;
        CASE(against_chords(unit_draws(shaped ? 20 : 100)));
        CASE(in_parts(unit_draws(shaped ? 20 : 100)));
        CASE(against_memory(unit_draws(shaped ? 50 : 200)));
        CASE(in_phase(unit_draws(shaped ? 50 : 100)));
    }
    CASE(refusals());
    CASE(too_small());
    CASE(by_depth());
    CASE(tiny_steps());
    CASE(mirrored(unit_draws(60)));
    CASE(one_stays());
    CASE(opened_and_closed());
    CASE(from_one_way_to_another());
    CASE(through_slip());
    CASE(asked_by_two());
    for (int i = 0; i < 2; i++) {
        shaped = i;
        CASE(by_displacement(unit_draws(shaped ? 50 : 200)));
    }
    return unit_finish();
}
