/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The springs of the printed scheme against the memory diagram: two ways to the same state. */
#include "fret/springs.h"
#include "unit.h"

typedef struct pair {
    const fret_normal *normal;
    double mu, FN, radius, slip; /* slip: delta_x,max at F_N */
    fret_contact *memory;
    fret_springs *springs;
    size_t count;
    double reach; /* radius that the springs are cut for */
} pair;

static void springs_of(pair *p, size_t count, double radius, fret_weight rule) {
    fret_springs_free(p->springs);
    p->springs = NULL;
    if (!CHECK(fret_springs_make(p->normal, p->mu, count, radius, rule, &p->springs).code == FRET_OK))
        exit(unit_finish());
    p->count = count;
    p->reach = radius;
}

static pair make(double n, double k) {
    const unit_scene s = unit_make_scene(n, k);
    pair p = {.normal = unit_make_normal(&s), .mu = s.mu, .FN = 100};
    fret_press press;
    CHECK_OK(fret_press_by_force(p.normal, p.FN, &press));
    p.radius = (double)press.a;
    p.slip = (double)fret_gross_slip(&(fret_pressed){p.normal, p.mu, press});
    if (!CHECK(fret_contact_make(p.normal, p.mu, FRET_EXACT, &p.memory).code == FRET_OK))
        exit(unit_finish());
    return p;
}

static void drop(pair *p) {
    fret_springs_free(p->springs);
    fret_contact_free(p->memory);
}

static fret_step to_depth(double dz, double dx) {
    return (fret_step){FRET_TO_DEPTH, FRET_TO_DX, dz, dx};
}

static fret_step to_force(double FN, double Fx) {
    return (fret_step){FRET_TO_FORCE, FRET_TO_FX, FN, Fx};
}

static fret_step press_only(double FN) {
    return (fret_step){FRET_TO_FORCE, FRET_KEEP_DX, FN, 0};
}

static fret_step to_dx(double dx) {
    return (fret_step){FRET_KEEP_NORMAL, FRET_TO_DX, 0, dx};
}

static fret_step to_fx(double Fx) {
    return (fret_step){FRET_KEEP_NORMAL, FRET_TO_FX, 0, Fx};
}

static void go(pair *p, fret_step step, unsigned substeps) {
    fret_state before, after;
    fret_springs_state(p->springs, &before);
    CHECK_OK(fret_contact_step(p->memory, &step));
    CHECK_OK(fret_springs_step(p->springs, &step, substeps));
    fret_springs_state(p->springs, &after);
    CHECK(after.W >= before.W && after.U >= 0);
    CHECK(fabsl(after.Fx) <= p->mu * after.FN * (1 + 1e-13L));
}

/* How far the springs are from the diagram; loads to mu F_N, displacements to delta_x,max. */
static fret_real distance(const pair *p) {
    fret_state m, s;
    fret_contact_state(p->memory, &m);
    fret_springs_state(p->springs, &s);
    const fret_real force = (m.Fx - s.Fx) / (p->mu * p->FN), shift = (m.dx - s.dx) / p->slip;
    const fret_real energy = p->mu * p->FN * p->slip, W = (m.W - s.W) / energy, U = (m.U - s.U) / energy;
    return sqrtl(force * force + shift * shift + W * W + U * U);
}

static void restart(pair *p) {
    fret_contact_reset(p->memory);
    springs_of(p, p->count, p->reach, FRET_WEIGHT_CELL);
}

/* Root mean square over cuts that put the edge of the contact anywhere within its cell: for one cut alone
 * the error depends on where it falls. */
static fret_real constant_load_error(pair *p, size_t count, fret_weight rule, bool by_force) {
    static const double turns[] = {0.7, -0.5, 0.35, -0.6, 0.8, 0.1};
    enum { CUTS = 16 };
    fret_real sum = 0;
    for (int cut = 0; cut < CUTS; cut++) {
        springs_of(p, count, p->radius * (1 + (cut + 0.5) / (double)CUTS / (double)count), rule);
        fret_contact_reset(p->memory);
        go(p, press_only(p->FN), 1);
        for (size_t i = 0; i < sizeof turns / sizeof *turns; i++) {
            go(p, by_force ? to_fx(turns[i] * p->mu * p->FN) : to_dx(turns[i] * p->slip), 1);
            fret_real d = distance(p);
            sum += d * d;
        }
    }
    return sqrtl(sum / (fret_real)CUTS);
}

static double order_in_count(double n, double k, fret_weight rule, bool by_force) {
    pair p = make(n, k);
    const size_t coarse = 128, fine = 2048;
    fret_real e0 = constant_load_error(&p, coarse, rule, by_force),
              e1 = constant_load_error(&p, fine, rule, by_force);
    double order = (double)(logl(e0 / e1) / logl((fret_real)fine / coarse));
    if (getenv("FRET_UNIT_VERBOSE"))
        printf("n=%g k=%g %s weights by %s: error %.2Le -> %.2Le from %zu to %zu springs, order %.2f\n", n, k,
               rule == FRET_WEIGHT_CELL ? "cell" : "midpoint", by_force ? "force" : "displacement", e0, e1,
               coarse, fine, order);
    drop(&p);
    return order;
}

static void test_order_in_count(void) {
    static const double ks[] = {-0.9, -0.7, -0.5, -0.2, 0, 0.3, 0.6, 0.9};
    for (size_t i = 0; i < sizeof ks / sizeof *ks; i++)
        for (int by_force = 0; by_force < 2 && !unit_skips(i); by_force++) {
            CHECK_ABS(order_in_count(2, ks[i], FRET_WEIGHT_CELL, by_force), 2, 1, 0.15L);
            CHECK_ABS(order_in_count(3, ks[i], FRET_WEIGHT_CELL, by_force), 2, 1, 0.15L);
            /* a cone is not smooth at its tip, where k < 0 puts much of the stiffness */
            CHECK_ABS(order_in_count(1, ks[i], FRET_WEIGHT_CELL, by_force), fmin(2, 2 + ks[i]), 1, 0.15L);
            if (ks[i] < 0)
                CHECK_ABS(order_in_count(2, ks[i], FRET_WEIGHT_MIDPOINT, by_force), 1 + ks[i], 1, 0.15L);
        }
}

static fret_real oblique_error(pair *p, unsigned substeps) {
    unsigned long long seed = 7;
    fret_real sum = 0;
    enum { STEPS = 24 };
    restart(p);
    go(p, to_force(p->FN / 2, 0), substeps);
    for (int i = 0; i < STEPS; i++) {
        double FN = unit_random(&seed, 0.2, 1) * p->FN, Fx = unit_random(&seed, -0.9, 0.9) * p->mu * FN;
        go(p, to_force(FN, Fx), substeps);
        fret_real d = distance(p);
        sum += d * d;
    }
    return sqrtl(sum / (fret_real)STEPS);
}

static void test_order_in_substeps(void) {
    static const double cases[][2] = {{2, 0}, {1, 0.5}, {3, -0.5}, {2, -0.7}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        pair p = make(cases[i][0], cases[i][1]);
        springs_of(&p, 8192, p.radius, FRET_WEIGHT_CELL);
        fret_real e0 = oblique_error(&p, 4), e1 = oblique_error(&p, 32);
        double order = (double)(logl(e0 / e1) / logl(8));
        if (getenv("FRET_UNIT_VERBOSE"))
            printf("n=%g k=%g: error %.2Le -> %.2Le from 4 to 32 substeps, order %.2f\n", cases[i][0],
                   cases[i][1], e0, e1, order);
        CHECK_ABS(order, 2, 1, 0.25L);
        drop(&p);
    }
}

/* Straight in (delta_z, delta_x): whole or in parts, touching, parting and open in between, it is the same,
 * and what the force does is stored or dissipated. */
static void test_straight_steps(void) {
    pair p = make(2, 0.3);
    unsigned long long seed = 11;
    fret_press press;
    fret_springs *parts;
    springs_of(&p, 1000, p.radius, FRET_WEIGHT_CELL);
    CHECK_OK(fret_springs_make(p.normal, p.mu, 1000, p.radius, FRET_WEIGHT_CELL, &parts));
    CHECK_OK(fret_press_by_force(p.normal, p.FN, &press));
    for (int i = 0; i < 200; i++) {
        fret_state a, b;
        const double dz = unit_random(&seed, -0.3, 1) * (double)press.dz;
        const fret_step step = to_depth(dz, unit_random(&seed, -1.5, 1.5) * p.slip);
        go(&p, step, 1);
        CHECK_OK(fret_springs_step(parts, &step, 7));
        fret_springs_state(p.springs, &a);
        fret_springs_state(parts, &b);
        CHECK(a.FN == b.FN && a.dz == b.dz && a.slices == b.slices);
        CHECK_ABS(a.Fx, b.Fx, p.mu * p.FN, 1e-13L);
        CHECK_ABS(a.dx, b.dx, p.slip, 1e-13L);
        CHECK_REL(a.W, b.W, 1e-12L);
        CHECK_ABS(a.U, b.U, p.mu * p.FN * p.slip, 1e-13L);
        CHECK_ABS(distance(&p), 0, 1, 1e-4L * (i + 1));
    }
    fret_springs_free(parts);
    drop(&p);
}

/* At constant F_N substeps change nothing, and F_x reaches its target. */
static void test_force_control(void) {
    pair p = make(2, -0.4);
    springs_of(&p, 500, p.radius, FRET_WEIGHT_CELL);
    fret_springs *parts;
    CHECK_OK(fret_springs_make(p.normal, p.mu, 500, p.radius, FRET_WEIGHT_CELL, &parts));
    const double limit = p.mu * p.FN, targets[] = {0.5, -0.3, 0.99, -1, 1, 0.2, 0, 1e-9, -1e-9};
    const fret_step press = press_only(p.FN);
    go(&p, press, 1);
    CHECK_OK(fret_springs_step(parts, &press, 5));
    for (size_t i = 0; i < sizeof targets / sizeof *targets; i++) {
        fret_state a, b;
        const fret_step step = to_fx(targets[i] * limit);
        go(&p, step, 1);
        CHECK_OK(fret_springs_step(parts, &step, 9));
        fret_springs_state(p.springs, &a);
        fret_springs_state(parts, &b);
        CHECK_ABS(a.Fx, step.tangential, limit, 2e-14L);
        CHECK_ABS(a.dx, b.dx, p.slip, 1e-9L); /* flat near gross slip */
        CHECK_REL(a.W, b.W, 1e-9L);
    }
    fret_springs_free(parts);
    drop(&p);
}

/* A hundred thousand of them make the force that is asked for, as 500 do. */
static void test_many(void) {
    pair p = make(2, 0.3);
    springs_of(&p, 100000, p.radius, FRET_WEIGHT_CELL);
    unsigned long long seed = 3;
    for (int i = 0; i < 60; i++) {
        const double FN = unit_random(&seed, 5, p.FN), part = i % 5 ? unit_random(&seed, -1, 1) : 1 - 1e-6;
        fret_state now;
        CHECK_OK(
            fret_springs_step(p.springs, &(fret_step){FRET_TO_FORCE, FRET_TO_FX, FN, part * p.mu * FN}, 1));
        fret_springs_state(p.springs, &now);
        CHECK_ABS(now.Fx, part * p.mu * FN, p.mu * FN, 1e-14L);
    }
    drop(&p);
}

/* By force with F_N changing: a twin that goes to the same displacement comes to the same force. */
static void front_on_the_way(double n, double k, size_t count) {
    pair p = make(n, k);
    fret_springs *twin = NULL;
    unsigned long long seed = 5;
    springs_of(&p, count, p.radius, FRET_WEIGHT_CELL);
    CHECK_OK(fret_springs_make(p.normal, p.mu, count, p.radius, FRET_WEIGHT_CELL, &twin));
    for (int i = 0; i < 120; i++) {
        fret_state now, end, other;
        fret_springs_state(p.springs, &now);
        const double near = unit_random(&seed, 0, 1) < 0.5 ? 0.02 : 1;
        double FN = (double)now.FN + near * p.FN * unit_random(&seed, -1, 1);
        if (!(FN > 0.01 * p.FN && FN < p.FN))
            FN = p.FN * unit_random(&seed, 0.01, 1);
        const double Fx =
            p.mu * FN * (i % 7 ? unit_random(&seed, -1, 1) : copysign(1 - 1e-9, unit_random(&seed, -1, 1)));
        const fret_step step = to_force(FN, Fx);
        CHECK_OK(fret_springs_step(p.springs, &step, 1));
        fret_springs_state(p.springs, &end);
        CHECK_ABS(end.Fx, Fx, p.mu * FN, 2e-14L);
        CHECK_OK(fret_springs_step(twin, &(fret_step){FRET_TO_FORCE, FRET_TO_DX, FN, (double)end.dx}, 1));
        fret_springs_state(twin, &other);
        CHECK_ABS(other.Fx, Fx, p.mu * FN, 1e-13L);
        CHECK_REL(other.W, end.W, 1e-11L);
        CHECK_ABS(other.U, end.U, p.mu * p.FN * p.slip, 1e-13L);
    }
    fret_springs_free(twin);
    drop(&p);
}

static void test_front_on_the_way(void) {
    front_on_the_way(2, 0, 100);
    front_on_the_way(2, 0.5, 1000);
    front_on_the_way(1, -0.5, 333);
    front_on_the_way(8, 0.3, 64);
}

/* Weights add up to the stiffness of the continuum; F_N and its inverse agree. */
static void test_weights(void) {
    static const double ks[] = {-0.95, -0.5, 0, 0.5, 0.95};
    for (size_t i = 0; i < sizeof ks / sizeof *ks; i++) {
        pair p = make(2, ks[i]);
        fret_press press;
        CHECK_OK(fret_press_by_force(p.normal, p.FN, &press));
        const double FN = p.FN;
        for (size_t count = 1; count <= 100000; count = 10 * count + 1) {
            fret_state s, t;
            springs_of(&p, count, p.radius, FRET_WEIGHT_CELL);
            const fret_step deep = to_depth((double)press.dz, 0), force = press_only(FN);
            CHECK_OK(fret_springs_step(p.springs, &deep, 1));
            fret_springs_state(p.springs, &s);
            CHECK(s.slices == count);
            CHECK_REL(s.kn, fret_normal_stiffness(p.normal, p.radius), 4e-16L);
            CHECK_REL(s.kt, s.kn / fret_normal_foundation(p.normal)->eta, 1e-18L * (fret_real)count + 1e-18L);
            CHECK_REL(s.a, p.radius, 1e-15L);
            CHECK(s.c == s.a);
            CHECK_OK(fret_springs_step(p.springs, &force, 1));
            fret_springs_state(p.springs, &t);
            CHECK(t.FN == FN);
            const fret_step again = to_depth((double)t.dz, 0);
            springs_of(&p, count, p.radius, FRET_WEIGHT_CELL);
            if (t.dz <= press.dz) {
                CHECK_OK(fret_springs_step(p.springs, &again, 1));
                fret_springs_state(p.springs, &t);
                CHECK_REL(t.FN, FN, 1e-14L);
            }
        }
        drop(&p);
    }
}

/* Stick radius and stiffness, to within a cell. */
static void test_stick(void) {
    pair p = make(2, 0.2);
    fret_state m, s;
    springs_of(&p, 4000, p.radius, FRET_WEIGHT_CELL);
    go(&p, press_only(p.FN), 1);
    for (int i = 1; i < 6; i++) {
        go(&p, to_fx((i % 2 ? 1 : -1) * (0.9 - 0.1 * i) * p.mu * p.FN), 1);
        fret_contact_state(p.memory, &m);
        fret_springs_state(p.springs, &s);
        CHECK_ABS(s.c, m.c, p.radius, 1.5L / 4000);
        CHECK_REL(s.kt, m.kt, 2e-3L);
        CHECK_REL(s.U, m.U, 1e-5L);
    }
    go(&p, to_dx(2 * p.slip), 1);
    fret_springs_state(p.springs, &s);
    CHECK(s.c == 0 && s.kt == 0);
    CHECK_REL(s.Fx, p.mu * p.FN, 1e-14L);
    drop(&p);
}

/* Loads that come back to where they were close the loop that they opened, whatever rounding does to springs
 * on the way: stick radius and stiffness of the diagram, to within two cells. */
static void loops_close(double n, double k, size_t count, bool oblique) {
    enum { PLACES = 5, STEPS = 60 };
    pair p = make(n, k);
    unsigned long long seed = 23;
    double place[PLACES][2];
    springs_of(&p, count, p.radius, FRET_WEIGHT_CELL);
    go(&p, press_only(p.FN), 1);
    for (int i = 0; i < PLACES; i++) {
        place[i][0] = oblique ? p.FN * unit_random(&seed, 0.3, 1) : p.FN;
        place[i][1] = p.mu * place[i][0] * unit_random(&seed, -0.95, 0.95);
    }
    for (int i = 0; i < STEPS; i++) {
        const double *at = place[(int)unit_random(&seed, 0, PLACES)];
        fret_state m, s;
        go(&p, oblique ? to_force(at[0], at[1]) : to_fx(at[1]), oblique ? 64 : 1);
        fret_contact_state(p.memory, &m);
        fret_springs_state(p.springs, &s);
        const fret_real cell = (fret_real)p.radius / (fret_real)count;
        CHECK_ABS(s.c, m.c, cell, 2);
        CHECK_ABS(s.kt, m.kt, fret_normal_stiffness(p.normal, p.radius), 0.02L);
    }
    drop(&p);
}

static void test_loops_close(void) {
    for (int oblique = 0; oblique < 2; oblique++) {
        loops_close(2, 0, 500, oblique);
        loops_close(1, 0.7, 300, oblique);
        loops_close(8, -0.4, 500, oblique);
    }
    loops_close(0.5, 0, 20000, false);
}

/* Let go by force, they are left where the diagram is. */
static void test_let_go(void) {
    static const double exponents[] = {1, 2, 3};
    for (size_t i = 0; i < sizeof exponents / sizeof *exponents; i++)
        for (unsigned substeps = 1; substeps <= 64; substeps *= 64) {
            pair p = make(exponents[i], 0.2);
            springs_of(&p, 2000, p.radius, FRET_WEIGHT_CELL);
            for (int side = -1; side <= 1; side += 2) {
                restart(&p);
                go(&p, press_only(p.FN), 1);
                go(&p, to_fx(0.7 * side * p.mu * p.FN), 1);
                go(&p, to_fx(0.3 * side * p.mu * p.FN), 1);
                go(&p, to_force(0, 0), substeps);
                CHECK_ABS(distance(&p), 0, 1, substeps == 1 ? 1e-1L : 1e-3L);
                go(&p, to_force(p.FN, 0.2 * p.mu * p.FN), substeps);
                CHECK_ABS(distance(&p), 0, 1, substeps == 1 ? 1e-1L : 1e-3L);
            }
            drop(&p);
        }
}

/* A spring that sticks lets go where its force ends, and has dissipated nothing. */
static void test_last_spring(void) {
    pair p = make(2, 0.2);
    springs_of(&p, 1, p.radius, FRET_WEIGHT_CELL);
    fret_state pushed, free;
    go(&p, press_only(p.FN), 1);
    go(&p, to_fx(0.3 * p.mu * p.FN), 1);
    fret_springs_state(p.springs, &pushed);
    go(&p, to_force(0, 0), 1);
    fret_springs_state(p.springs, &free);
    CHECK(pushed.U > 0 && pushed.W == 0 && free.Fx == 0);
    CHECK_ABS(free.W, 0, pushed.U, 1e-15L);
    drop(&p);
}

/* To the F_x that there is: no reversal. */
static void test_no_reversal(void) {
    pair p = make(2, 0.3);
    unsigned long long seed = 29;
    springs_of(&p, 1000, p.radius, FRET_WEIGHT_CELL);
    for (int i = 0; i < 50; i++) {
        const double Fx = 0.8 * p.mu * p.FN * unit_random(&seed, -1, 1);
        fret_state before, after;
        restart(&p);
        go(&p, press_only(p.FN), 1);
        go(&p, to_fx(Fx), 1);
        fret_springs_state(p.springs, &before);
        go(&p, to_fx(Fx), 1);
        fret_springs_state(p.springs, &after);
        CHECK(after.kt == before.kt && after.c == before.c && after.kt < after.kn);
    }
    drop(&p);
}

/* A flat-ended pad, where springs under the flat touch together. */
static void test_pad(void) {
    const unit_scene steel = unit_make_scene(2, 0.1);
    const fret_gap gap = {.kind = FRET_GAP_FLAT_ROUNDED, .b = 1e-4, .R = 1e-2};
    pair p = {.mu = 0.4, .FN = 100};
    fret_press press;
    fret_springs *none = NULL;
    p.normal = unit_keep_normal(&steel.material, &gap);
    CHECK_OK(fret_press_by_force(p.normal, p.FN, &press));
    p.slip = (double)fret_gross_slip(&(fret_pressed){p.normal, p.mu, press});
    p.radius = (double)press.a;
    CHECK_OK(fret_contact_make(p.normal, p.mu, FRET_EXACT, &p.memory));
    springs_of(&p, 2000, p.radius * 1.001, FRET_WEIGHT_CELL);
    go(&p, to_force(p.FN, 0), 1);
    go(&p, to_fx(0.6 * p.mu * p.FN), 1);
    CHECK_ABS(distance(&p), 0, 1, 1e-5L);
    go(&p, to_force(p.FN / 2, -0.3 * p.mu * p.FN), 100);
    CHECK_ABS(distance(&p), 0, 1, 1e-3L);
    go(&p, to_force(0, 0), 100);
    fret_state s;
    fret_springs_state(p.springs, &s);
    CHECK(s.FN == 0 && s.Fx == 0 && s.U == 0 && s.slices == 0);
    CHECK_ERROR(fret_springs_make(p.normal, p.mu, 10, 5e-5, FRET_WEIGHT_CELL, &none), FRET_OUTSIDE, "a");
    drop(&p);
}

/* Springs slide under what is mu F_N to the continuum, and to the springs, whichever is less: at a depth
 * their F_N misses it by the error of the cells. In between only one side or the other is beyond it. */
static void test_gross_slip(void) {
    static const double cases[][2] = {{2, 0}, {2, -0.5}, {1, -0.5}, {4, 0.3}, {0.5, 0.7}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        for (int sign = -1; sign <= 1; sign += 2) {
            pair p = make(cases[i][0], cases[i][1]);
            fret_press deep;
            fret_state s, again;
            CHECK_OK(fret_press_by_force(p.normal, 0.6 * p.FN, &deep));
            springs_of(&p, 300, p.radius, FRET_WEIGHT_CELL);
            const fret_step down = {FRET_TO_DEPTH, FRET_KEEP_DX, (double)deep.dz, 0};
            CHECK_OK(fret_springs_step(p.springs, &down, 1));
            fret_springs_state(p.springs, &s);
            CHECK(s.FN != deep.F);
            const double own = p.mu * (double)s.FN, limit = p.mu * (double)deep.F, most = fmax(own, limit);
            const double slides[] = {limit, limit * (1 - 4e-16), limit * (1 + 4e-16), fmin(limit, own), most};
            for (size_t j = 0; j < sizeof slides / sizeof *slides; j++) {
                const fret_step there = to_fx(sign * slides[j]), back = to_fx(-0.5 * sign * own);
                CHECK_OK(fret_springs_step(p.springs, &there, 1));
                fret_springs_state(p.springs, &s);
                CHECK(s.c == 0 && s.kt == 0);
                CHECK_ABS(s.Fx, sign * own, own, 1e-14L);
                CHECK_OK(fret_springs_step(p.springs, &there, 1)); /* there it is: no step */
                fret_springs_state(p.springs, &again);
                CHECK(again.c == 0 && again.kt == 0 && again.W - s.W <= 1e-12L * s.W);
                CHECK_OK(fret_springs_step(p.springs, &back, 1));
                fret_springs_state(p.springs, &s);
                CHECK(s.c > 0 && s.kt > 0);
            }
            const fret_step beyond = to_fx(sign * most * (1 + 1e-12));
            CHECK_ERROR(fret_springs_step(p.springs, &beyond, 1), FRET_GROSS_SLIP, "Fx");
            CHECK_REL(fret_springs_step(p.springs, &beyond, 1).limit, most, 1e-15L);
            drop(&p);
        }
}

static void refuses(pair *p, fret_step step, unsigned substeps, fret_code code, const char *quantity) {
    fret_state a, b;
    fret_springs_state(p->springs, &a);
    CHECK_ERROR(fret_springs_step(p->springs, &step, substeps), code, quantity);
    fret_springs_state(p->springs, &b);
    CHECK(a.FN == b.FN && a.dz == b.dz && a.Fx == b.Fx && a.dx == b.dx && a.W == b.W && a.U == b.U);
}

/* At constant depth it is the same as where the depth changes by one unit in the last place, and as springs
 * with constant bounds. */
static void test_constant_depth(void) {
    enum { COUNT = 777 };
    pair p = make(2, -0.3);
    unsigned long long seed = 3;
    fret_press press;
    fret_state a, b;
    fret_springs *oblique;
    springs_of(&p, COUNT, p.radius * (1 + 1e-9), FRET_WEIGHT_CELL);
    CHECK_OK(fret_springs_make(p.normal, p.mu, COUNT, p.radius * (1 + 1e-9), FRET_WEIGHT_CELL, &oblique));
    CHECK_OK(fret_press_by_force(p.normal, p.FN, &press));
    const double dz = (double)press.dz, next = nextafter(dz, 0);
    const fret_step press_down = to_depth(dz, 0);
    CHECK_OK(fret_springs_step(p.springs, &press_down, 1));
    CHECK_OK(fret_springs_step(oblique, &press_down, 1));
    const fret_foundation *f = fret_normal_foundation(p.normal);
    const double cell = p.radius * (1 + 1e-9) / (double)COUNT, eta = (double)f->eta, k1 = 1 + (double)f->k,
                 scale = (double)(2 * f->cN0 * powl(f->c0, -f->k)) * pow(cell, k1) / k1;
    static double u[COUNT];
    double W = 0, old = 0;
    for (int i = 0; i < 300; i++) {
        const fret_step step = to_dx(unit_random(&seed, -1.2, 1.2) * p.slip),
                        to_next = to_depth(i % 2 ? dz : next, step.tangential);
        CHECK_OK(fret_springs_step(p.springs, &step, 1));
        CHECK_OK(fret_springs_step(oblique, &to_next, 1));
        fret_springs_state(p.springs, &a);
        fret_springs_state(oblique, &b);
        CHECK_ABS(a.Fx, b.Fx, p.mu * p.FN, 1e-14L);
        CHECK_ABS(a.W, b.W, p.mu * p.FN * p.slip, 1e-14L * (i + 1));
        CHECK_ABS(a.U, b.U, p.mu * p.FN * p.slip, 1e-14L);

        double force = 0, x = step.tangential, d = x - old;
        old = x;
        for (int j = 0; j < COUNT; j++) {
            const double w = scale * (pow(j + 1, k1) - pow(j, k1)), mid = (j + 0.5) * cell / p.radius,
                         bound = fmax(p.slip * (1 - mid * mid), 0), trial = u[j] + d;
            u[j] = trial > bound ? bound : trial < -bound ? -bound : trial;
            force += w * u[j] / eta;
            W += w * bound * fabs(trial - u[j]) / eta;
        }
        CHECK_ABS(a.Fx, force, p.mu * p.FN, 1e-12L);
        CHECK_REL(a.W, W, 1e-12L);
    }
    fret_springs_free(oblique);
    drop(&p);
}

static void test_errors(void) {
    const double nan_ = (double)NAN, inf_ = (double)INFINITY;
    pair p = make(2, 0);
    const fret_normal *n = p.normal;
    fret_springs *none = NULL;
    const fret_weight cell = FRET_WEIGHT_CELL;
    CHECK_ERROR(fret_springs_make(n, 0, 10, 1e-3, cell, &none), FRET_NOT_POSITIVE, "mu");
    CHECK_ERROR(fret_springs_make(n, nan_, 10, 1e-3, cell, &none), FRET_NOT_FINITE, "mu");
    CHECK_ERROR(fret_springs_make(n, 0.3, 0, 1e-3, cell, &none), FRET_NOT_POSITIVE, "count");
    CHECK_ERROR(fret_springs_make(n, 0.3, 10, 0, cell, &none), FRET_NOT_POSITIVE, "radius");
    CHECK_ERROR(fret_springs_make(n, 0.3, 10, inf_, cell, &none), FRET_NOT_FINITE, "radius");
    CHECK_ERROR(fret_springs_make(n, 0.3, 10, 1e-3, (fret_weight)7, &none), FRET_OUTSIDE, "rule");
    CHECK_CODE(fret_springs_make(n, 0.3, 10, 1e300, cell, &none), FRET_OVERFLOW);
    CHECK_CODE(fret_springs_make(n, 0.3, (size_t)-1, 1e-3, cell, &none), FRET_NO_MEMORY);
    CHECK(none == NULL);

    const double r[] = {0, 1e-4, 2e-4}, f[] = {0, 1e-6, 4e-6};
    const unit_scene steel = unit_make_scene(2, 0);
    struct fret_table *table;
    CHECK_OK(fret_table_make(r, f, 3, NULL, &table));
    const fret_gap gap = {.kind = FRET_GAP_TABLE, .table = table};
    const fret_normal *tabled = unit_keep_normal(&steel.material, &gap);
    CHECK_CODE(fret_springs_make(tabled, 0.3, 10, 3e-4, cell, &none), FRET_TABLE_SHORT);
    fret_table_free(table);

    springs_of(&p, 100, p.radius, cell);
    const fret_step start = to_force(80, 10);
    CHECK_OK(fret_springs_step(p.springs, &start, 4));
    refuses(&p, start, 0, FRET_NOT_POSITIVE, "substeps");
    refuses(&p, to_force(-1, 0), 1, FRET_NEGATIVE, "FN");
    refuses(&p, to_force(nan_, 0), 1, FRET_NOT_FINITE, "FN");
    refuses(&p, to_force(101, 0), 1, FRET_OUTSIDE, "FN");
    refuses(&p, to_depth(inf_, 0), 1, FRET_NOT_FINITE, "dz");
    refuses(&p, to_depth(1, 0), 1, FRET_OUTSIDE, "dz");
    refuses(&p, to_fx(nan_), 1, FRET_NOT_FINITE, "Fx");
    refuses(&p, to_dx(inf_), 1, FRET_NOT_FINITE, "dx");
    refuses(&p, to_fx(p.mu * 81), 1, FRET_GROSS_SLIP, "Fx");
    refuses(&p, to_force(20, -p.mu * 21), 1, FRET_GROSS_SLIP, "Fx");
    const fret_step beyond = to_fx(-p.mu * 90);
    CHECK_REL(fret_springs_step(p.springs, &beyond, 1).limit, p.mu * 80, 1e-15L);
    drop(&p);
}

/* A copy goes on as the original would have, which stays. */
static void test_clone(void) {
    pair p = make(2, 0.3);
    fret_springs *other = NULL;
    fret_state before, stayed, gone, after;
    springs_of(&p, 200, p.radius * 1.01, FRET_WEIGHT_CELL);
    go(&p, press_only(80), 1);
    go(&p, to_fx(0.6 * p.mu * 80), 1);
    if (!CHECK(fret_springs_clone(p.springs, &other).code == FRET_OK))
        exit(unit_finish());
    const fret_step on = to_dx(-0.3 * p.slip);
    fret_springs_state(p.springs, &before);
    CHECK_OK(fret_springs_step(other, &on, 1));
    fret_springs_state(p.springs, &stayed);
    CHECK(before.Fx == stayed.Fx && before.W == stayed.W && before.U == stayed.U);
    CHECK_OK(fret_springs_step(p.springs, &on, 1));
    fret_springs_state(other, &gone);
    fret_springs_state(p.springs, &after);
    CHECK(gone.Fx == after.Fx && gone.W == after.W && gone.U == after.U && gone.Fx != before.Fx);
    fret_springs_free(other);
    drop(&p);
}

int main(int argc, char **argv) {
    unit_start("springs", argc, argv);
    CASE(test_order_in_count());
    CASE(test_order_in_substeps());
    CASE(test_straight_steps());
    CASE(test_force_control());
    CASE(test_front_on_the_way());
    CASE(test_many());
    CASE(test_weights());
    CASE(test_stick());
    CASE(test_loops_close());
    CASE(test_no_reversal());
    CASE(test_let_go());
    CASE(test_last_spring());
    CASE(test_pad());
    CASE(test_gross_slip());
    CASE(test_constant_depth());
    CASE(test_clone());
    CASE(test_errors());
    return unit_finish();
}
