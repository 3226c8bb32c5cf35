/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "histories.h"
#include "unit.h"

static const double nan_ = (double)NAN, inf_ = (double)INFINITY;

typedef struct contact {
    const fret_normal *normal;
    double mu;
    fret_contact *memory;
    fret_real step_W; /* W after the last step seen by checked_step */
} contact;

static contact make(const unit_scene *s) {
    contact c = {.normal = unit_make_normal(s), .mu = s->mu};
    if (!CHECK(fret_contact_make(c.normal, c.mu, FRET_EXACT, &c.memory).code == FRET_OK))
        exit(unit_finish());
    return c;
}

static contact make_plain(double n, double k) {
    unit_scene s = unit_make_scene(n, k);
    return make(&s);
}

static fret_state state_of(const contact *c) {
    fret_state s;
    fret_contact_state(c->memory, &s);
    return s;
}

static fret_step to_depth(double dz, double dx) {
    return (fret_step){FRET_TO_DEPTH, FRET_TO_DX, dz, dx};
}

static fret_step to_force(double FN, double Fx) {
    return (fret_step){FRET_TO_FORCE, FRET_TO_FX, FN, Fx};
}

static fret_step to_fx(double Fx) {
    return (fret_step){FRET_KEEP_NORMAL, FRET_TO_FX, 0, Fx};
}

static fret_step to_dx(double dx) {
    return (fret_step){FRET_KEEP_NORMAL, FRET_TO_DX, 0, dx};
}

static void go(const contact *c, fret_step step) {
    CHECK_OK(fret_contact_step(c->memory, &step));
}

/* What must hold of every state. */
static void check_state(contact *c) {
    fret_state s = state_of(c), f;
    const fret_real mu_eta = c->mu * c->normal->foundation.eta;
    CHECK(s.W >= c->step_W && s.U >= 0 && fret_contact_last_loss(c->memory) >= 0);
    c->step_W = s.W;
    fret_contact_forces(c->memory, &f);
    CHECK(f.FN == s.FN && f.dz == s.dz && f.Fx == s.Fx && f.dx == s.dx && f.W == s.W && f.slices == s.slices);
    CHECK(fabsl(s.Fx) <= c->mu * s.FN * (1 + UNIT_TOL(1e-17L, 1e-14L)));
    fret_segment seg, last = {0, 0, 0, 0};
    fret_real force = 0;
    size_t count = 0;
    while (fret_contact_segment(c->memory, count, &seg)) {
        CHECK(fabsl(seg.sigma) <= 1 && seg.outer >= seg.inner && seg.inner == last.outer);
        CHECK(fabsl(seg.u) <=
              mu_eta * (s.dz - seg.inner) * (1 + UNIT_TOL(1e-17L, 1e-14L)) + 1e-17L * mu_eta * s.dz);
        if (count) /* continuous */
            CHECK_ABS(seg.u, last.u - mu_eta * last.sigma * (last.outer - last.inner), mu_eta * s.dz,
                      UNIT_TOL(1e-16L, 1e-13L));
        force +=
            c->mu * seg.sigma * (fret_law_force(c->normal, seg.outer) - fret_law_force(c->normal, seg.inner));
        last = seg;
        count++;
    }
    CHECK(count == s.slices);
    if (count) {
        CHECK_ABS(last.outer, s.dz, s.dz, UNIT_TOL(1e-18L, 1e-15L));
        CHECK_ABS(last.u, mu_eta * last.sigma * (s.dz - last.inner), mu_eta * s.dz, UNIT_TOL(1e-17L, 1e-14L));
        CHECK_ABS(force, s.Fx, c->mu * s.FN, UNIT_TOL(1e-16L, 1e-13L));
        CHECK_REL(s.FN, fret_law_force(c->normal, s.dz), UNIT_TOL(2e-17L, 1e-14L));
        CHECK_REL(s.a, fret_law_radius(c->normal, s.dz), UNIT_TOL(2e-17L, 1e-14L));
        CHECK_REL(s.kn, fret_normal_stiffness(c->normal, s.a), UNIT_TOL(2e-17L, 1e-14L));
        CHECK(s.c >= 0 && s.c <= s.a && s.kt >= 0);
        CHECK(s.kt <= s.kn / c->normal->foundation.eta * (1 + UNIT_TOL(1e-17L, 1e-14L)));
    } else {
        CHECK(s.FN == 0 && s.Fx == 0 && s.U == 0 && s.dz <= 0);
    }
}

static void history_reference(const char *name, bool by_force) {
    unit_table t;
    if (!unit_open(&t, name))
        return;
    contact c = {0};
    int id = -1;
    fret_real most = 0, deepest = 0, work = 0;
    const fret_real tol = UNIT_TOL(1e-14L, 1e-12L);
    while (unit_row(&t)) {
        if ((int)unit_input(&t, 0) != id) {
            fret_contact_free(c.memory);
            id = (int)unit_input(&t, 0);
            unit_scene s = unit_read_scene(&t, 1);
            c = make(&s);
            most = deepest = work = 0;
        }
        const int in = 1 + UNIT_SCENE_COLUMNS;
        double first = unit_input(&t, in), second = unit_input(&t, in + 1);
        go(&c, by_force ? to_force(first, second) : to_depth(first, second));
        fret_state s = state_of(&c);
        most = fmaxl(most, s.FN);
        deepest = fmaxl(deepest, s.dz);
        const fret_real Fmax = c.mu * most, dmax = c.mu * c.normal->foundation.eta * deepest;
        if (by_force) {
            CHECK(s.FN == first);
            CHECK_ABS(s.Fx, (fret_real)second, Fmax, UNIT_TOL(1e-17L, 1e-14L));
            CHECK_REL(s.dz, unit_result(&t, in + 2), UNIT_TOL(1e-17L, 1e-14L));
            CHECK_ABS(s.dx, unit_result(&t, in + 3), dmax, tol);
        } else {
            CHECK(s.dz == first);
            CHECK_ABS(s.dx, (fret_real)second, fmaxl(dmax, fabsl((fret_real)second)),
                      UNIT_TOL(1e-17L, 1e-14L));
            CHECK_REL(s.FN, unit_result(&t, in + 2), UNIT_TOL(1e-17L, 1e-14L));
            CHECK_ABS(s.Fx, unit_result(&t, in + 3), Fmax, tol);
        }
        work = fmaxl(work, Fmax * dmax);
        /* of W and U each digit counts; beside the scale of the history only what a rounding there leaves */
        CHECK_ABS(s.W, unit_result(&t, in + 4), fabsl(unit_result(&t, in + 4)) + 1e-4L * work, tol);
        CHECK_ABS(s.U, unit_result(&t, in + 5), fabsl(unit_result(&t, in + 5)) + 1e-4L * work, tol);
        check_state(&c);
    }
    fret_contact_free(c.memory);
}

/* int F_x d(dx) over one step, adaptively, from states along the straight path. These end on doubles,
 * so that 1e-16 of noise bounds the tolerance. */
typedef struct path {
    const contact *c;
    fret_contact *probe;
    bool by_force;
    double normal0, normal1, tangential0, tangential1;
} path;

static fret_real along(const path *p, fret_real t) {
    double normal = (double)(p->normal0 * (1 - t) + p->normal1 * t);
    double tangential = (double)(p->tangential0 * (1 - t) + p->tangential1 * t);
    fret_step step = p->by_force ? to_force(normal, tangential) : to_depth(normal, tangential);
    fret_state s = {0};
    if (fret_contact_copy(p->probe, p->c->memory).code || fret_contact_step(p->probe, &step).code)
        return (fret_real)NAN;
    fret_contact_forces(p->probe, &s);
    return p->by_force ? s.dx : s.Fx;
}

/* Lobatto, six points: the ends are nodes, so that no kink can hide between them and a Gauss point. */
static fret_real lobatto(const path *p, fret_real lo, fret_real hi) {
    const fret_real root = sqrtl(7.0L), mid = (lo + hi) / 2, half = (hi - lo) / 2;
    const fret_real node[3] = {1, sqrtl(1.0L / 3 + 2 * root / 21), sqrtl(1.0L / 3 - 2 * root / 21)};
    const fret_real weight[3] = {1.0L / 15, (14 - root) / 30, (14 + root) / 30};
    fret_real sum = 0;
    for (int i = 0; i < 3; i++)
        sum += weight[i] * (along(p, mid - half * node[i]) + along(p, mid + half * node[i]));
    return sum * half;
}

static fret_real adaptive(const path *p, fret_real lo, fret_real hi, fret_real whole, fret_real tolerance,
                          int depth) {
    fret_real mid = (lo + hi) / 2, left = lobatto(p, lo, mid), right = lobatto(p, mid, hi);
    if (depth == 0 || fabsl(left + right - whole) < tolerance)
        return left + right;
    return adaptive(p, lo, mid, left, tolerance, depth - 1) +
           adaptive(p, mid, hi, right, tolerance, depth - 1);
}

/* U + W = int F_x d(dx), the work summed from the forces alone. */
static void ledger(bool by_force) {
    static const double ns[] = {0.5, 1, 2, 3}, ks[] = {-0.8, -0.3, 0, 0.5, 0.9};
    unsigned long long seed = 17;
    for (int i = 0; i < 7; i++) {
        contact c = make_plain(ns[i % 4], ks[i % 5]);
        fret_contact *probe = NULL;
        CHECK_OK(fret_contact_make(c.normal, c.mu, FRET_EXACT, &probe));
        fret_press base = {.F = 0};
        CHECK_OK(fret_press_by_depth(c.normal, 1e-6, &base));
        const fret_real dmax = fret_gross_slip(&(fret_pressed){c.normal, c.mu, base}),
                        scale = c.mu * base.F * dmax;
        fret_real work = 0;
        /* not from the open state, where dx ~ F^q would be hard on the quadrature */
        double normal = by_force ? 0.7 * (double)base.F : 1e-7, tangential = 0;
        go(&c, by_force ? to_force(normal, 0) : to_depth(normal, 0));
        for (int j = 0; j < 15; j++) {
            double kind = unit_random(&seed, 0, 1), next = normal, goal = tangential;
            if (j == 0 || kind < 0.6)
                next = unit_random(&seed, 0.3, 1.4) * (double)(by_force ? base.F : base.dz);
            if (j == 0 || kind > 0.3)
                goal = by_force ? c.mu * next * unit_random(&seed, -0.9, 0.9)
                                : (double)dmax * unit_random(&seed, -1.3, 1.3);
            if (by_force && fabs(goal) > 0.95 * c.mu * next)
                goal = 0.5 * c.mu * next;
            path p = {&c, probe, by_force, normal, next, tangential, goal};
            fret_state before = state_of(&c);
            fret_real mean =
                adaptive(&p, 0, 1, lobatto(&p, 0, 1), 5e-15L * (by_force ? dmax : c.mu * base.F), 24);
            go(&c, by_force ? to_force(next, goal) : to_depth(next, goal));
            fret_state after = state_of(&c);
            /* by force in parts: F_x dx - int dx dF_x */
            work += by_force
                        ? after.Fx * after.dx - before.Fx * before.dx - ((fret_real)goal - tangential) * mean
                        : ((fret_real)goal - tangential) * mean;
            CHECK_ABS(after.U + after.W, work, scale, 1e-13L);
            normal = next;
            tangential = goal;
        }
        fret_contact_free(probe);
        fret_contact_free(c.memory);
    }
}

/* First loading, reversal and closed cycles at constant F_N against the closed forms. */
static void closed_forms(void) {
    static const double ns[] = {0.5, 1, 2, 4}, ks[] = {-0.9, -0.5, 0, 0.5, 0.9};
    static const double parts[] = {1e-4, 1e-2, 0.3, 0.7, 0.99, 1 - 1e-9};
    for (int i = 0; i < 120; i++) {
        contact c = make_plain(ns[i % 4], ks[i / 4 % 5]);
        const double FN = 20, FA = parts[i / 20] * c.mu * FN;
        fret_press p = {.F = 0};
        fret_loading f = {0, 0, 0, 0}, twice;
        fret_real loss = 0;
        CHECK_OK(fret_press_by_force(c.normal, FN, &p));
        CHECK_OK(fret_loading_by_force(&(fret_pressed){c.normal, c.mu, p}, FA, &f));
        CHECK_OK(fret_cycle_loss_by_force(&(fret_pressed){c.normal, c.mu, p}, FA, &loss));
        go(&c, to_force(FN, 0));
        fret_state s = state_of(&c);
        CHECK(s.Fx == 0 && s.dx == 0 && s.W == 0 && s.U == 0 && s.c == s.a);
        CHECK_REL(s.kt, s.kn / c.normal->foundation.eta, UNIT_TOL(1e-17L, 1e-14L));
        go(&c, to_fx(FA));
        s = state_of(&c);
        CHECK_REL(s.dx, f.dx, UNIT_TOL(1e-17L, 1e-14L));
        CHECK_REL(s.c, f.c, UNIT_TOL(1e-16L, 1e-13L) * (1 + 1e9L * (parts[i / 20] > 0.99) + 1 / c.normal->q));
        CHECK_REL(4 * s.W, loss, UNIT_TOL(1e-15L, 1e-12L));
        check_state(&c);
        /* Masing: half the reversed branch is the first loading */
        for (int j = 1; j <= 4; j++) {
            double back = FA - j * FA / 2;
            CHECK_OK(fret_loading_by_force(&(fret_pressed){c.normal, c.mu, p}, (FA - back) / 2, &twice));
            fret_real dx0 = f.dx;
            go(&c, to_fx(back));
            CHECK_ABS((dx0 - state_of(&c).dx) / 2, twice.dx, fabsl(f.dx), UNIT_TOL(1e-16L, 1e-13L));
        }
        CHECK_REL(state_of(&c).dx, -f.dx, UNIT_TOL(1e-16L, 1e-13L));
        for (int cycle = 0; cycle < 3; cycle++) {
            fret_real W = 0, U = state_of(&c).U;
            go(&c, to_fx(FA));
            W += fret_contact_last_loss(c.memory);
            CHECK_REL(2 * W, loss, UNIT_TOL(1e-15L, 1e-12L));
            CHECK_REL(state_of(&c).U, U, UNIT_TOL(1e-15L, 1e-12L));
            go(&c, to_fx(-FA));
            W += fret_contact_last_loss(c.memory);
            CHECK_REL(W, loss, UNIT_TOL(1e-15L, 1e-12L));
            check_state(&c);
            CHECK(state_of(&c).slices <= 3);
        }
        fret_contact_free(c.memory);
    }
}

static void displacement_cycles(void) {
    for (int i = 0; i < 20; i++) {
        contact c = make_plain(1 + i % 4, -0.8 + 0.4 * (i / 4));
        fret_press p = {.F = 0};
        CHECK_OK(fret_press_by_force(c.normal, 20, &p));
        const fret_real max = fret_gross_slip(&(fret_pressed){c.normal, c.mu, p});
        go(&c, (fret_step){FRET_TO_FORCE, FRET_KEEP_DX, 20, 0});
        for (double part = 0.1; part < 4; part *= 2) {
            double dA = part * (double)max;
            fret_real loss = 0;
            fret_loading f = {0, 0, 0, 0};
            CHECK_OK(fret_cycle_loss_by_displacement(&(fret_pressed){c.normal, c.mu, p}, dA, &loss));
            CHECK_OK(fret_loading_by_displacement(&(fret_pressed){c.normal, c.mu, p}, dA, &f));
            go(&c, to_dx(dA));
            go(&c, to_dx(-dA));
            fret_state s = state_of(&c);
            CHECK_REL(s.Fx, -f.Fx, UNIT_TOL(1e-15L, 1e-12L));
            CHECK_ABS(s.dx, -(fret_real)dA, max, UNIT_TOL(1e-17L, 1e-14L));
            fret_real W = 0;
            go(&c, to_dx(dA));
            W += fret_contact_last_loss(c.memory);
            go(&c, to_dx(-dA));
            W += fret_contact_last_loss(c.memory);
            CHECK_REL(W, loss, UNIT_TOL(1e-13L, 1e-11L));
            CHECK_ABS(state_of(&c).W - s.W, W, s.W + W, UNIT_TOL(1e-17L, 1e-14L));
            check_state(&c);
        }
        fret_contact_free(c.memory);
    }
}

/* An inner loop, once passed, leaves no trace but its heat. */
static void wiping(void) {
    for (int i = 0; i < 12; i++) {
        contact plain = make_plain(1 + i % 3, -0.6 + 0.4 * (i / 3)),
                looped = make_plain(1 + i % 3, -0.6 + 0.4 * (i / 3));
        const double FN = 20, limit = plain.mu * FN;
        contact *const both[] = {&plain, &looped};
        for (int b = 0; b < 2; b++) {
            go(both[b], to_force(FN, 0));
            go(both[b], to_fx(0.9 * limit));
            go(both[b], to_fx(-0.2 * limit));
        }
        const size_t slices = state_of(&looped).slices;
        const fret_real W0 = state_of(&looped).W;
        go(&looped, to_fx(0.4 * limit));
        CHECK(state_of(&looped).slices > slices);
        go(&looped, to_fx(-0.2 * limit)); /* closes the loop */
        fret_real inner = state_of(&looped).W - W0, expected = 0;
        fret_press p = {.F = 0};
        CHECK_OK(fret_press_by_force(plain.normal, FN, &p));
        CHECK_OK(
            fret_cycle_loss_by_force(&(fret_pressed){plain.normal, plain.mu, p}, 0.3 * limit, &expected));
        CHECK_REL(inner, expected, 1e-14L);
        CHECK(state_of(&looped).slices == slices);
        static const double onwards[] = {-0.35, -0.7, 0.5};
        for (int j = 0; j < 3; j++) {
            go(&plain, to_fx(onwards[j] * limit));
            go(&looped, to_fx(onwards[j] * limit));
            fret_state x = state_of(&plain), y = state_of(&looped);
            CHECK_ABS(y.dx, x.dx, fret_gross_slip(&(fret_pressed){plain.normal, plain.mu, p}),
                      UNIT_TOL(1e-17L, 1e-14L));
            CHECK_REL(y.W, x.W + inner, UNIT_TOL(1e-16L, 1e-13L));
            CHECK_REL(y.U, x.U, UNIT_TOL(1e-15L, 1e-13L));
            CHECK(x.slices == y.slices);
        }
        /* full unloading of the normal force wipes everything */
        go(&looped, to_force(0, 0));
        fret_state s = state_of(&looped);
        CHECK(s.FN == 0 && s.Fx == 0 && s.U == 0 && s.slices == 0 && s.W > 0);
        check_state(&looped);
        fret_contact_free(plain.memory);
        fret_contact_free(looped.memory);
    }
}

/* Raising F_N at fixed dx leaves F_x; lowering it lets springs slip. */
static void normal_steps(void) {
    for (int i = 0; i < 12; i++) {
        contact c = make_plain(1 + i % 3, -0.6 + 0.4 * (i / 3));
        go(&c, to_force(20, 0));
        go(&c, to_fx(0.4 * c.mu * 20));
        fret_state before = state_of(&c), s;
        go(&c, (fret_step){FRET_TO_FORCE, FRET_KEEP_DX, 35, 0});
        s = state_of(&c);
        CHECK_REL(s.Fx, before.Fx, UNIT_TOL(1e-18L, 1e-15L));
        CHECK(s.W == before.W && s.dx == before.dx && s.c == s.a); /* the new rim sticks */
        CHECK_REL(s.U, before.U, UNIT_TOL(1e-17L, 1e-14L));
        go(&c, (fret_step){FRET_TO_FORCE, FRET_KEEP_DX, 20, 0}); /* and nothing has happened */
        s = state_of(&c);
        CHECK_REL(s.Fx, before.Fx, UNIT_TOL(1e-17L, 1e-14L));
        CHECK_REL(s.U, before.U, UNIT_TOL(1e-16L, 1e-14L));
        CHECK_ABS(s.W, before.W, before.W, UNIT_TOL(1e-17L, 1e-14L));
        go(&c, (fret_step){FRET_TO_FORCE, FRET_KEEP_DX, 12, 0});
        s = state_of(&c);
        CHECK(s.Fx < before.Fx && s.W > before.W);
        CHECK_REL(s.dx, before.dx, UNIT_TOL(1e-17L, 1e-14L));
        CHECK(s.Fx <= c.mu * 12 && s.c < s.a);
        check_state(&c);
        fret_contact_free(c.memory);
    }
}

/* k_t is the slope of the coming step in the same direction; k_n/eta just after a reversal. */
static void stiffness(void) {
    for (int i = 0; i < 12; i++) {
        contact c = make_plain(1 + i % 3, -0.6 + 0.4 * (i / 3));
        fret_contact *probe = NULL;
        CHECK_OK(fret_contact_make(c.normal, c.mu, FRET_EXACT, &probe));
        go(&c, to_force(20, 0));
        static const double targets[] = {0.5, -0.2, 0.1, -0.4, 0.8};
        for (int j = 0; j < 5; j++) {
            go(&c, to_fx(targets[j] * c.mu * 20));
            fret_state s = state_of(&c), f;
            const double sense = j & 1 ? -1 : 1, d = 1e-6 * c.mu * 20;
            fret_step on = to_fx(targets[j] * c.mu * 20 + sense * d),
                      back = to_fx(targets[j] * c.mu * 20 - sense * d);
            CHECK_OK(fret_contact_copy(probe, c.memory));
            CHECK_OK(fret_contact_step(probe, &on));
            fret_contact_forces(probe, &f);
            CHECK_REL((f.Fx - s.Fx) / (f.dx - s.dx), s.kt, 1e-4L);
            CHECK_REL(s.kt, fret_normal_stiffness(c.normal, s.c) / c.normal->foundation.eta,
                      UNIT_TOL(1e-17L, 1e-14L));
            CHECK_OK(fret_contact_copy(probe, c.memory));
            CHECK_OK(fret_contact_step(probe, &back));
            fret_contact_forces(probe, &f);
            CHECK_REL((f.Fx - s.Fx) / (f.dx - s.dx), s.kn / c.normal->foundation.eta, 1e-4L);
        }
        fret_contact_free(probe);
        fret_contact_free(c.memory);
    }
}

/* The same path named in different ways. */
static void targets(void) {
    for (int i = 0; i < 12; i++) {
        contact a = make_plain(1 + i % 3, -0.6 + 0.4 * (i / 3)),
                b = make_plain(1 + i % 3, -0.6 + 0.4 * (i / 3));
        unsigned long long seed = 5;
        for (int j = 0; j < 30; j++) {
            double dz = unit_random(&seed, 2e-7, 2e-6);
            fret_press p = {.F = 0}, q = {.F = 0};
            CHECK_OK(fret_press_by_depth(a.normal, dz, &p));
            double FN = (double)p.F;
            CHECK_OK(fret_press_by_force(b.normal, FN, &q));
            if (j & 1) { /* straight in (FN, Fx) */
                double Fx = unit_random(&seed, -0.9, 0.9) * a.mu * FN;
                go(&a, (fret_step){FRET_TO_DEPTH, FRET_TO_FX, dz, Fx});
                go(&b, to_force(FN, Fx));
            } else { /* straight in (dz, dx) */
                double dx = unit_random(&seed, -0.9, 0.9) *
                            (double)fret_gross_slip(&(fret_pressed){a.normal, a.mu, p});
                go(&a, to_depth(dz, dx));
                go(&b, (fret_step){FRET_TO_FORCE, FRET_TO_DX, FN, dx});
            }
            fret_state x = state_of(&a), y = state_of(&b);
            /* alike but for the rounding of F_N to double */
            CHECK_ABS(x.Fx, y.Fx, a.mu * FN, 1e-14L);
            CHECK_ABS(x.dx, y.dx, fret_gross_slip(&(fret_pressed){a.normal, a.mu, p}), 1e-13L);
            CHECK_REL(x.W, y.W, 1e-13L);
            CHECK_REL(x.dz, y.dz, 1e-15L);
        }
        /* staying is no step */
        fret_state x = state_of(&a), y;
        static const fret_step still[] = {{FRET_KEEP_NORMAL, FRET_KEEP_DX, 5, 5}};
        go(&a, still[0]);
        y = state_of(&a);
        CHECK(x.FN == y.FN && x.Fx == y.Fx && x.dx == y.dx && x.W == y.W && x.U == y.U &&
              x.slices == y.slices);
        CHECK(fret_contact_last_loss(a.memory) == 0);
        /* KEEP_DX is TO_DX at the present dx */
        go(&a, to_dx(1e-7));
        CHECK_OK(fret_contact_copy(b.memory, a.memory));
        go(&a, (fret_step){FRET_TO_DEPTH, FRET_KEEP_DX, 7e-7, 0});
        go(&b, to_depth(7e-7, 1e-7));
        x = state_of(&a);
        y = state_of(&b);
        CHECK(x.FN == y.FN);
        CHECK_REL(x.dx, (fret_real)1e-7, UNIT_TOL(1e-16L, 1e-13L));
        CHECK_REL(y.dx, x.dx, UNIT_TOL(1e-16L, 1e-13L));
        CHECK_ABS(x.Fx, y.Fx, a.mu * x.FN, UNIT_TOL(1e-17L, 1e-14L));
        fret_contact_free(a.memory);
        fret_contact_free(b.memory);
    }
}

/* Out of contact the bodies move freely; contact begins anew where they touch. */
static void separation(void) {
    contact c = make_plain(2, 0.3), fresh = make_plain(2, 0.3);
    go(&c, to_depth(1e-6, 3e-7));
    go(&c, to_depth(-2e-6, 5e-7));
    fret_state s = state_of(&c);
    CHECK(s.FN == 0 && s.Fx == 0 && s.dz == -2e-6 && s.dx == 5e-7 && s.U == 0 && s.slices == 0);
    const fret_real W = s.W;
    CHECK(W >= 0);
    go(&c, to_dx(-9e-7));
    go(&c, to_depth(-1e-6, 0));
    s = state_of(&c);
    CHECK(s.Fx == 0 && s.W == W && s.dx == 0 && s.dz == -1e-6);
    CHECK(s.a == 0 && s.c == 0);
    /* half the way to dx is spent in the air */
    go(&c, to_depth(1e-6, 4e-7));
    go(&fresh, to_depth(1e-6, 2e-7));
    fret_state f = state_of(&fresh);
    s = state_of(&c);
    CHECK_REL(s.Fx, f.Fx, UNIT_TOL(1e-16L, 1e-14L));
    CHECK_REL(s.U, f.U, UNIT_TOL(1e-16L, 1e-14L));
    CHECK_ABS(s.W, W + f.W, W + f.U, UNIT_TOL(1e-17L, 1e-14L));
    CHECK(s.dx == 4e-7);
    check_state(&c);
    fret_segment seg = {7, 7, 7, 7};
    CHECK(fret_contact_segment(c.memory, s.slices, &seg) == 0 &&
          fret_contact_segment(c.memory, 1000, &seg) == 0);
    fret_contact_free(c.memory);
    fret_contact_free(fresh.memory);
}

static void gross_slip(void) {
    contact c = make_plain(2, -0.4);
    go(&c, to_force(20, 0));
    fret_press p = {.F = 0};
    CHECK_OK(fret_press_by_force(c.normal, 20, &p));
    const double max = (double)fret_gross_slip(&(fret_pressed){c.normal, c.mu, p}), limit = c.mu * 20;
    go(&c, to_dx(3 * max));
    fret_state s = state_of(&c);
    CHECK_REL(s.Fx, (fret_real)c.mu * 20, UNIT_TOL(1e-18L, 1e-15L));
    CHECK(s.c == 0 && s.slices == 1 && s.kt == 0);
    fret_real W = s.W;
    go(&c, to_dx(4 * max));
    s = state_of(&c);
    CHECK_REL(s.W - W, c.mu * 20 * ((fret_real)(4 * max) - 3 * max), UNIT_TOL(1e-16L, 1e-13L));
    go(&c, to_dx(-4 * max));
    s = state_of(&c);
    CHECK_REL(s.Fx, -(fret_real)c.mu * 20, UNIT_TOL(1e-18L, 1e-15L));
    /* out of gross slip by force control: the springs alone give way */
    go(&c, to_fx(0));
    s = state_of(&c);
    CHECK(s.dx > -4 * max && s.dx < -3 * max && s.c > 0);
    check_state(&c);
    fret_step beyond = to_fx(limit * 1.01);
    fret_state before = state_of(&c), after;
    fret_status st = fret_contact_step(c.memory, &beyond);
    CHECK_ERROR(st, FRET_GROSS_SLIP, "Fx");
    CHECK_REL((fret_real)st.limit, (fret_real)limit, 1e-15L);
    after = state_of(&c);
    CHECK(before.FN == after.FN && before.Fx == after.Fx && before.dx == after.dx && before.W == after.W &&
          before.U == after.U && before.slices == after.slices);
    /* falling F_N under a held F_x ends in gross slip as well */
    go(&c, to_fx(0.5 * limit));
    fret_step fall = to_force(5, 0.5 * limit);
    CHECK_CODE(fret_contact_step(c.memory, &fall), FRET_GROSS_SLIP);
    CHECK(state_of(&c).FN == 20);
    fret_contact_free(c.memory);
}

/* A ramp in many small steps is the ramp in one, in slices as well: exactly where corners and steps are
 * dyadic fractions (2048 steps), within the rounding of the targets else (2000 steps). */
/* To go where one is changes nothing: not the stick zone, not what is dissipated. */
static void standing(void) {
    static const double dx[] = {0.4, 0.9, 0.2, -0.3, 0.1, -0.7}, Fx[] = {-25, 20, 3, -11, -10.7};
    contact c = make_plain(2, 0.3);
    fret_press p = {.F = 0};
    CHECK_OK(fret_press_by_force(c.normal, 100, &p));
    const double scale = (double)fret_gross_slip(&(fret_pressed){c.normal, c.mu, p});
    go(&c, (fret_step){FRET_TO_FORCE, FRET_KEEP_DX, 100, 0});
    for (int i = 0; i < 11; i++) {
        fret_step step = i < 6 ? to_dx(dx[i] * scale) : to_fx(Fx[i - 6]);
        go(&c, step);
        fret_state first = state_of(&c);
        for (int again = 0; again < 3; again++) {
            go(&c, step);
            CHECK(fret_contact_last_loss(c.memory) == 0);
        }
        fret_state s = state_of(&c);
        CHECK(s.c == first.c && s.kt == first.kt && s.W == first.W && s.Fx == first.Fx && s.dx == first.dx);
        CHECK(s.c < s.a);
    }
    fret_contact_free(c.memory);
}

/* Within the contact, up to the last digit of its radius, the bound of a spring is never below 0, nor its
 * displacement beyond it. */
static void rim(void) {
    unsigned long long seed = 11;
    int rounded = 0;
    for (int i = 0; i < 1000; i++) {
        contact c = make_plain(unit_random(&seed, 0.5, 5), unit_random(&seed, -0.9, 0.9));
        go(&c, (fret_step){FRET_TO_FORCE, FRET_KEEP_DX, unit_random(&seed, 1, 100), 0});
        fret_state s = state_of(&c);
        go(&c, to_fx(0.5 * c.mu * (double)s.FN));
        const fret_real inside = nextafterl(s.a, 0), bound = fret_contact_bound(c.memory, inside),
                        u = fret_contact_displacement(c.memory, inside);
        CHECK(bound >= 0 && u >= 0 && u <= bound);
        CHECK(bound <= 1e-12L * fret_contact_bound(c.memory, 0));
        rounded += fret_normal_profile(c.normal, inside) > s.dz;
        fret_contact_free(c.memory);
    }
    CHECK(rounded > 0);
}

/* The last millionth before gross slip, in one step and in a thousand: the stick zone, the displacement and
 * what is dissipated are those of the closed forms, which know 1-t exactly. Near the centre K is singular. */
static void brink(double n, double k) {
    const double FN = 100, last = 1e-6;
    for (int steps = 1; steps <= 1000; steps *= 1000) {
        contact c = make_plain(n, k);
        fret_press p = {.F = 0};
        fret_loading f = {0, 0, 0, 0};
        fret_real before = 0, after = 0;
        CHECK_OK(fret_press_by_force(c.normal, FN, &p));
        go(&c, (fret_step){FRET_TO_FORCE, FRET_KEEP_DX, FN, 0});
        const double from = c.mu * FN * (1 - last), to = c.mu * FN * (1 - 4e-15);
        go(&c, (fret_step){FRET_KEEP_NORMAL, FRET_TO_FX, 0, from});
        fret_state start = state_of(&c);
        for (int i = 1; i <= steps; i++)
            go(&c, (fret_step){FRET_KEEP_NORMAL, FRET_TO_FX, 0,
                               i == steps ? to : from + (to - from) * i / steps});
        fret_state end = state_of(&c);
        CHECK_OK(fret_loading_by_force(&(fret_pressed){c.normal, c.mu, p}, to, &f));
        CHECK_REL(end.c, f.c, UNIT_TOL(1e-17L, 1e-3L));
        CHECK_REL(end.dx, f.dx, UNIT_TOL(1e-18L, 1e-8L));
        CHECK_OK(fret_cycle_loss_by_force(&(fret_pressed){c.normal, c.mu, p}, from, &before));
        CHECK_OK(fret_cycle_loss_by_force(&(fret_pressed){c.normal, c.mu, p}, to, &after));
        CHECK_REL(4 * end.W, after, UNIT_TOL(5e-18L, 1e-14L));
        CHECK_REL(4 * (end.W - start.W), after - before, UNIT_TOL(1e-11L, 1e-7L));
        fret_contact_free(c.memory);
    }
}

/* The same with F_N growing or falling on the way: what sticks at the end is as at first loading there. */
static void brink_on_the_way(double n, double k) {
    for (int i = 0; i < 40; i++) {
        contact c = make_plain(n, k);
        const double from = i % 2 ? 100 : 60 + i, FN = i % 2 ? 60 + i : 100, side = i % 4 < 2 ? 1 : -1;
        const double to = side * c.mu * FN * (1 - ldexp(1, -8 - i));
        fret_press p = {.F = 0};
        fret_loading f = {0, 0, 0, 0};
        CHECK_OK(fret_press_by_force(c.normal, FN, &p));
        CHECK_OK(fret_loading_by_force(&(fret_pressed){c.normal, c.mu, p}, to, &f));
        go(&c, (fret_step){FRET_TO_FORCE, FRET_KEEP_DX, from, 0});
        go(&c, (fret_step){FRET_TO_FORCE, FRET_TO_FX, FN, to});
        const fret_state end = state_of(&c);
        CHECK_REL(end.c, f.c, UNIT_TOL(1e-18L, 1e-3L));
        CHECK_REL(end.dx, f.dx, UNIT_TOL(1e-18L, 1e-8L));
        fret_contact_free(c.memory);
    }
}

/* From the brink of gross slip to the other one, with F_N growing, falling or kept: what sticks, F_N -
 * |F_x|/mu at each, tells where the slopes change. */
static void nested_brinks(double n, double k) {
    unit_scene scene = unit_make_scene(n, k);
    scene.mu = 0.5; /* a quotient without rounding */
    for (int i = 0; i < 200; i++) {
        contact c = make(&scene);
        const double FN[2] = {60.1 + i % 41, i % 3 ? 60.7 + i % 37 : 60.1 + i % 41}, side = i % 2 ? 1 : -1;
        const double to[2] = {side * c.mu * FN[0] * (1 - ldexp(1, -12 - i % 31)),
                              -side * c.mu * FN[1] * (1 - ldexp(1, -10 - i % 23))};
        go(&c, (fret_step){FRET_TO_FORCE, FRET_KEEP_DX, 50.3, 0});
        fret_real stuck[2];
        for (int j = 0; j < 2; j++) {
            go(&c, (fret_step){FRET_TO_FORCE, FRET_TO_FX, FN[j], to[j]});
            stuck[j] = FN[j] - fabsl(to[j] / (fret_real)c.mu);
        }
        const bool within = stuck[1] < stuck[0]; /* the second leaves nothing of the first */
        const fret_real front = within ? stuck[1] : (stuck[0] + stuck[1]) / 2;
        const fret_real depth = fret_law_depth(c.normal, front);
        const fret_real back = fret_law_depth(c.normal, FN[1]) - depth,
                        forth = within ? 0 : depth - fret_law_depth(c.normal, stuck[0]);
        const fret_real mu_eta = c.mu * c.normal->foundation.eta;
        const fret_state end = state_of(&c);
        CHECK_ABS(end.dx, side * mu_eta * (forth - back), mu_eta * end.dz, UNIT_TOL(4e-19L, 1e-8L));
        CHECK_REL(end.c, fret_law_radius(c.normal, depth), UNIT_TOL(1e-18L, 1e-3L));
        fret_contact_free(c.memory);
    }
}

static void subdivision(int steps) {
    const fret_real loose = steps == 2048 ? 1 : 1e4L;
    for (int by_force = 0; by_force < 2; by_force++) {
        unit_scene scene = unit_make_scene(2, 0.5);
        scene.mu = 0.5;
        contact one = make(&scene), many = make(&scene);
        static const double corner[5][2] = {
            {0.5, 0.25}, {1, -0.5}, {1.25, -0.4375}, {0.75, 0.25}, {0.5, 0.1875}};
        const double unit_n = by_force ? 16 : 0x1p-20, unit_t = unit_n * (by_force ? 0.5 : 0.25);
        double n0 = 0, t0 = 0;
        for (int i = 0; i < 5; i++) {
            double n1 = corner[i][0] * unit_n, t1 = corner[i][1] * unit_t;
            go(&one, by_force ? to_force(n1, t1) : to_depth(n1, t1));
            for (int j = 1; j <= steps; j++) {
                double n = n0 + (n1 - n0) * j / steps, t = t0 + (t1 - t0) * j / steps;
                go(&many, by_force ? to_force(n, t) : to_depth(n, t));
                if (j % 125 == 0)
                    check_state(&many);
            }
            n0 = n1;
            t0 = t1;
            fret_state x = state_of(&one), y = state_of(&many);
            const fret_real mu_eta = one.mu * one.normal->foundation.eta;
            CHECK_ABS(y.Fx, x.Fx, one.mu * x.FN, loose * UNIT_TOL(1e-15L, 1e-12L));
            CHECK_ABS(y.dx, x.dx, mu_eta * x.dz, loose * UNIT_TOL(1e-15L, 1e-12L));
            CHECK_ABS(y.U, x.U, x.W + x.U, loose * UNIT_TOL(1e-15L, 1e-12L));
            /* by force the chords of small steps dissipate as the arc of the ramp does, to second order */
            CHECK_ABS(y.W, x.W, x.W + x.U, loose * UNIT_TOL(1e-14L, 1e-11L));
            CHECK(x.slices <= 6);
            CHECK(y.slices <= (steps == 2048 ? 6 : 64));
        }
        fret_contact_free(one.memory);
        fret_contact_free(many.memory);
    }
}

static void objects(void) {
    contact a = make_plain(2, 0.2), b = make_plain(1, -0.5);
    fret_state s = state_of(&a), x, y;
    CHECK(s.FN == 0 && s.dz == 0 && s.Fx == 0 && s.dx == 0 && s.W == 0 && s.U == 0 && s.slices == 0 &&
          s.a == 0);
    CHECK(fret_contact_last_loss(a.memory) == 0);
    go(&a, to_force(20, 0));
    /* a shrinking oscillation leaves one slice a reversal */
    for (int i = 0; i < 60; i++)
        go(&a, to_fx(20 * a.mu * 0.9 * pow(-0.93, i)));
    x = state_of(&a);
    CHECK(x.slices > 50);
    CHECK_OK(fret_contact_copy(b.memory, a.memory)); /* another contact becomes this one */
    CHECK_OK(fret_contact_copy(a.memory, a.memory));
    y = state_of(&b);
    CHECK(x.Fx == y.Fx && x.dx == y.dx && x.U == y.U && x.W == y.W && x.slices == y.slices && x.a == y.a &&
          x.kt == y.kt);
    CHECK(fret_contact_last_loss(b.memory) == fret_contact_last_loss(a.memory));
    for (size_t i = 0; i < x.slices; i++) {
        fret_segment p = {0}, q = {0};
        CHECK(fret_contact_segment(a.memory, i, &p) && fret_contact_segment(b.memory, i, &q));
        CHECK(p.inner == q.inner && p.outer == q.outer && p.sigma == q.sigma && p.u == q.u);
    }
    go(&b, to_fx(3)); /* apart again */
    y = state_of(&a);
    CHECK(x.Fx == y.Fx && x.dx == y.dx && x.W == y.W);
    go(&a, to_fx(3));
    x = state_of(&a);
    y = state_of(&b);
    CHECK(x.Fx == y.Fx && x.dx == y.dx && x.U == y.U && x.W == y.W && x.slices == y.slices);
    /* the way back to the last maximum wipes it all */
    go(&a, to_fx(20 * a.mu * 0.95));
    CHECK(state_of(&a).slices <= 2);
    fret_contact_reset(a.memory);
    x = state_of(&a);
    CHECK(x.FN == 0 && x.dz == 0 && x.Fx == 0 && x.dx == 0 && x.W == 0 && x.U == 0 && x.slices == 0);
    CHECK(fret_contact_last_loss(a.memory) == 0);
    contact fresh = make_plain(2, 0.2);
    go(&a, to_force(10, 1));
    go(&fresh, to_force(10, 1));
    x = state_of(&a);
    y = state_of(&fresh);
    CHECK(x.Fx == y.Fx && x.dx == y.dx && x.U == y.U && x.W == y.W);
    /* borrowed, and by a copy too */
    CHECK(fret_contact_normal(fresh.memory) == fresh.normal);
    CHECK_OK(fret_contact_copy(fresh.memory, a.memory));
    CHECK(fret_contact_normal(fresh.memory) == a.normal);
    fret_contact_free(fresh.memory);
    fret_contact_free(a.memory);
    fret_contact_free(b.memory);
    fret_contact_free(NULL);
}

static void errors(void) {
    contact c = make_plain(2, 0.2);
    fret_contact *none = NULL;
    CHECK_ERROR(fret_contact_make(c.normal, 0, FRET_EXACT, &none), FRET_NOT_POSITIVE, "mu");
    CHECK_ERROR(fret_contact_make(c.normal, -0.3, FRET_EXACT, &none), FRET_NOT_POSITIVE, "mu");
    CHECK_ERROR(fret_contact_make(c.normal, nan_, FRET_EXACT, &none), FRET_NOT_FINITE, "mu");
    CHECK_ERROR(fret_contact_make(c.normal, inf_, FRET_EXACT, &none), FRET_NOT_FINITE, "mu");
    CHECK(none == NULL);
    go(&c, to_force(20, 3));
    go(&c, to_fx(-2));
    const fret_state before = state_of(&c);
    const fret_real last = fret_contact_last_loss(c.memory);
    const double wild[] = {nan_, inf_, -inf_};
    struct {
        fret_step step;
        fret_code code;
    } bad[24];
    int count = 0;
    for (int i = 0; i < 3; i++) {
        bad[count].step = to_force(wild[i], 0);
        bad[count++].code = FRET_NOT_FINITE;
        bad[count].step = to_force(20, wild[i]);
        bad[count++].code = FRET_NOT_FINITE;
        bad[count].step = to_depth(wild[i], 0);
        bad[count++].code = FRET_NOT_FINITE;
        bad[count].step = to_depth(1e-6, wild[i]);
        bad[count++].code = FRET_NOT_FINITE;
        bad[count].step = to_fx(wild[i]);
        bad[count++].code = FRET_NOT_FINITE;
        bad[count].step = to_dx(wild[i]);
        bad[count++].code = FRET_NOT_FINITE;
    }
    bad[count].step = to_force(-1, 0);
    bad[count++].code = FRET_NEGATIVE;
    bad[count].step = (fret_step){FRET_TO_FORCE, FRET_KEEP_DX, -1e-300, 0};
    bad[count++].code = FRET_NEGATIVE;
    bad[count].step = to_depth(1e300, 0);
    bad[count++].code = FRET_OVERFLOW;
    bad[count].step = to_fx(9);
    bad[count++].code = FRET_GROSS_SLIP;
    bad[count].step = to_force(0, 1e-9);
    bad[count++].code = FRET_GROSS_SLIP;
    bad[count].step = (fret_step){FRET_TO_DEPTH, FRET_TO_FX, -1e-6, 1e-9};
    bad[count++].code = FRET_GROSS_SLIP;
    for (int i = 0; i < count; i++) {
        CHECK_CODE(fret_contact_step(c.memory, &bad[i].step), bad[i].code);
        const fret_state after = state_of(&c);
        CHECK(after.FN == before.FN && after.dz == before.dz && after.Fx == before.Fx &&
              after.dx == before.dx && after.W == before.W && after.U == before.U &&
              after.slices == before.slices && after.kt == before.kt);
        CHECK(fret_contact_last_loss(c.memory) == last);
    }
    /* an ignored target may hold anything */
    const fret_step ignored = {FRET_KEEP_NORMAL, FRET_KEEP_DX, nan_, nan_};
    CHECK_OK(fret_contact_step(c.memory, &ignored));
    fret_contact_free(c.memory);
}

/* Springs of a foundation cut into N cells, each weighted by the integral of x^k over it: an
 * independent model with an error ~ N^-2. */
enum { SPRINGS = 400, STEPS = 100000 };

typedef struct springs {
    int count;
    double weight[SPRINGS], bound[SPRINGS], u[SPRINGS];
    double dx, W;
} springs;

static springs cut(const contact *c, const fret_press *p, int count) {
    springs s = {.count = count};
    const fret_foundation *f = &c->normal->foundation;
    const double e = 1 + (double)f->k;
    for (int i = 0; i < count; i++) {
        double x0 = (double)i / count, x1 = (double)(i + 1) / count, x = (x0 + x1) / 2;
        s.weight[i] = 2 * (double)(f->cT0 * p->a * powl(p->a / f->c0, f->k)) * (pow(x1, e) - pow(x0, e)) / e;
        s.bound[i] = c->mu * (double)(f->eta * p->dz) * (1 - pow(x, c->normal->gap.power[0].n));
    }
    return s;
}

static double clip(double v, double bound) {
    return v > bound ? bound : v < -bound ? -bound : v;
}

/* Newton on the force, which is piecewise linear in the common displacement, kept in a bracket. */
static void pull(springs *s, double Fx) {
    double move = 0, lo = -3 * s->bound[0], hi = 3 * s->bound[0];
    for (int i = 0; i < 200; i++) {
        double force = 0, slope = 0;
        for (int j = 0; j < s->count; j++) {
            double v = s->u[j] + move;
            force += s->weight[j] * clip(v, s->bound[j]);
            slope += fabs(v) < s->bound[j] ? s->weight[j] : 0;
        }
        if (force < Fx)
            lo = move;
        else
            hi = move;
        double next = slope > 0 ? move + (Fx - force) / slope : hi;
        if (!(next > lo && next < hi))
            next = (lo + hi) / 2;
        double change = fabs(next - move);
        move = next;
        if (change <= 1e-15 * s->bound[0])
            break;
    }
    for (int j = 0; j < s->count; j++) {
        double u = clip(s->u[j] + move, s->bound[j]);
        s->W += s->weight[j] * u * (move - (u - s->u[j]));
        s->u[j] = u;
    }
    s->dx += move;
}

static void spring_model(double n, double k) {
    contact c = make_plain(n, k);
    fret_press p = {.F = 0};
    CHECK_OK(fret_press_by_force(c.normal, 20, &p));
    static springs coarse, fine;
    coarse = cut(&c, &p, SPRINGS / 4);
    fine = cut(&c, &p, SPRINGS);
    unsigned long long seed = 2022;
    fret_real coarse_fine = 0, fine_exact = 0, W = 0, sum = 0;
    size_t slices = 0;
    bool falls = false;
    go(&c, to_force(20, 0));
    for (int i = 0; i < STEPS; i++) {
        double Fx = c.mu * 20 * unit_random(&seed, -0.9, 0.9);
        fret_step step = to_fx(Fx);
        fret_status st = fret_contact_step(c.memory, &step);
        if (st.code) {
            CHECK_OK(st);
            break;
        }
        fret_state s;
        fret_contact_forces(c.memory, &s);
        pull(&coarse, Fx);
        pull(&fine, Fx);
        coarse_fine = fmaxl(coarse_fine, fabsl((fret_real)coarse.dx - fine.dx));
        fine_exact = fmaxl(fine_exact, fabsl(fine.dx - s.dx));
        falls = falls || s.W < W || fret_contact_last_loss(c.memory) < 0;
        sum += fret_contact_last_loss(c.memory);
        W = s.W;
        slices = s.slices > slices ? s.slices : slices;
    }
    const fret_real max = fret_gross_slip(&(fret_pressed){c.normal, c.mu, p});
    CHECK(!falls);
    CHECK(slices < 40); /* records of a random sequence: about ln(steps) a side */
    /* of second order, or of order 1+k where the centre weighs most: the rest is less than the gap */
    CHECK(fine_exact < coarse_fine);
    CHECK(coarse_fine < 0.1L * max);
    CHECK_ABS((fret_real)fine.W, W, fabsl((fret_real)coarse.W - fine.W), 1.0L);
    CHECK_REL((fret_real)fine.W, W, 1e-2L);
    CHECK_REL(sum, W, UNIT_TOL(1e-14L, 1e-11L));
    check_state(&c);
    if (getenv("FRET_UNIT_VERBOSE"))
        printf("springs n=%g k=%g: dx %.1Le -> %.1Le of dx_max, W %.1Le -> %.1Le; at most %zu slices\n", n, k,
               coarse_fine / max, fine_exact / max, fabsl((coarse.W - W) / W), fabsl((fine.W - W) / W),
               slices);
    fret_contact_free(c.memory);
}

/* Places rise from the centre to the edge, slopes are slopes, the curve is as steep as they say. */
static bool in_order(const fret_contact *c) {
    const fret_memory *m = c->memory;
    fret_segment s;
    fret_real last = 0;
    const fret_real slack = 8 * LDBL_EPSILON;
    for (size_t i = 0; fret_contact_segment(c, i, &s); i++, last = s.outer) {
        const layer *l = &m->layers[i];
        const point *outer = outer_of(m, &m->layers[i]);
        for (coordinate by = DEPTH; by <= LOAD; by++) {
            const fret_real thick = layer_thickness(l, outer, by), apart = outer->y[by] - l->inner.y[by];
            if (!(apart >= 0 && fabsl(thick - apart) <= slack * outer->y[by]))
                return false;
        }
        if (!(s.inner >= 0 && s.outer >= s.inner && (i == 0 || s.inner == last) && fabsl(s.sigma) <= 1))
            return false;
    }
    return last <= m->edge.y[DEPTH];
}

/* Loads of any size one after the other: a contact may be pressed by 1e20 of what is left of it then. */
static void unequal(void) {
    unsigned long long seed = 1;
    for (int i = 0; i < unit_draws(1000); i++) {
        unit_scene s =
            unit_make_scene(unit_random(&seed, 0.2, 8), i % 3 ? unit_random(&seed, -0.95, 0.95) : 0);
        contact c = make(&s);
        for (int j = 0; j < 12; j++) {
            const fret_state now = state_of(&c);
            const double size = pow(10, unit_random(&seed, -14, 10)), bound = c.mu * 1e8 * size,
                         part = unit_random(&seed, -1.2, 1.2);
            fret_step step = {(fret_normal_target)unit_random(&seed, 0, 3),
                              (fret_tangential_target)unit_random(&seed, 0, 3), 0, 0};
            step.normal = step.normal_by == FRET_TO_DEPTH ? size : 1e8 * size;
            step.tangential = step.tangential_by == FRET_TO_FX
                                  ? part * (step.normal_by == FRET_TO_FORCE ? bound : c.mu * (double)now.FN)
                                  : part * pow(10, unit_random(&seed, -14, 10));
            if (fret_contact_step(c.memory, &step).code)
                continue;
            CHECK(in_order(c.memory));
        }
        fret_contact_free(c.memory);
        fret_normal_free(unit.normal[--unit.normals]);
    }
}

/* A depth of 6e11 m, and the 4e-8 m that are left of it: the thickness of what slips there was what rounding
 * left of the one before, and grew beyond the contact. */
static void from_far(void) {
    const fret_material material = {{{300999177057.67145, 0.3, false}, {1, 0.3, true}}, 0, 1};
    const fret_gap gap = {.kind = FRET_GAP_POWER,
                          .terms = 1,
                          .power = {{5.8191091357016242, 2.6918748266644205e-05, 0.0051140926825317999}}};
    contact c = {.normal = unit_keep_normal(&material, &gap), .mu = 0.4};
    CHECK_OK(fret_contact_make(c.normal, c.mu, FRET_EXACT, &c.memory));
    const fret_step steps[] = {to_force(31.600412869186258, -4.1945459287254589),
                               {FRET_TO_DEPTH, FRET_KEEP_DX, 631885072763.47363, 0},
                               {FRET_TO_FORCE, FRET_TO_DX, 29.405160495167841, 4.7407009394257462e-08},
                               to_fx(0.14639967359409328),
                               to_dx(-1.3693087783822631e-50)};
    for (size_t i = 0; i < sizeof steps / sizeof *steps; i++) {
        go(&c, steps[i]);
        CHECK(in_order(c.memory));
        check_state(&c);
    }
    fret_contact_free(c.memory);
}

/* Slid under 3.6e29 N, then held by 2e-5 N and a force of half that: where slip comes to is at its depth. */
static void let_off(void) {
    contact c = make_plain(0.42395847364167, 0.69068488512001491);
    const fret_step steps[] = {{FRET_TO_DEPTH, FRET_TO_DX, 3.3049568601537604, -36119.252894103418},
                               to_dx(-364.38482323931157),
                               to_force(2.207026877894602e-05, 2.47816013513621e-06),
                               to_fx(4.5078254090145203e-06)};
    for (size_t i = 0; i < sizeof steps / sizeof *steps; i++) {
        go(&c, steps[i]);
        CHECK(in_order(c.memory));
        check_state(&c);
    }
    const fret_memory *m = c.memory->memory;
    for (size_t i = 0; i < m->count; i++)
        CHECK_REL(m->layers[i].inner.y[DEPTH], fret_law_depth(c.normal, m->layers[i].inner.y[LOAD]), 1e-17L);
    fret_contact_free(c.memory);
}

int main(int argc, char **argv) {
    unit_start("memory", argc, argv);
    CASE(history_reference("history.csv", false));
    CASE(history_reference("history_force.csv", true));
    CASE(ledger(false));
    CASE(ledger(true));
    CASE(closed_forms());
    CASE(displacement_cycles());
    CASE(wiping());
    CASE(normal_steps());
    CASE(stiffness());
    CASE(targets());
    CASE(separation());
    CASE(from_far());
    CASE(let_off());
    CASE(unequal());
    CASE(gross_slip());
    CASE(standing());
    CASE(rim());
    CASE(brink(2, 0));
    CASE(brink_on_the_way(2, 0));
    CASE(brink_on_the_way(0.5, 0.99));
    CASE(brink_on_the_way(50, -0.5));
    CASE(brink(2, -0.95));
    CASE(brink(0.1, 0.5));
    CASE(nested_brinks(2, 0));
    CASE(nested_brinks(0.5, 0.99));
    CASE(nested_brinks(50, -0.5));
    CASE(nested_brinks(0.1, 0.5));
    CASE(brink(50, -0.5));
    CASE(subdivision(2048));
    CASE(subdivision(2000));
    CASE(objects());
    CASE(errors());
    if (!unit_skips(1)) {
        CASE(spring_model(2, 0));
        CASE(spring_model(1, 0.5));
    }
    CASE(spring_model(3, -0.5));
    return unit_finish();
}
