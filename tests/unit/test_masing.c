/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The memory at constant normal force, in double, against the memory diagram. */
#include "fret/masing.h"
#include "unit.h"

static const double nan_ = (double)NAN, inf_ = (double)INFINITY;

typedef struct pair {
    fret_contact contact;
    double limit, slip, energy; /* mu F_N, delta_x,max, their product */
    fret_memory *memory;
    fret_masing *masing;
} pair;

static pair make_of(const unit_scene *s, double FN) {
    pair p = {.contact = unit_make_contact(s, FN)};
    p.limit = p.contact.mu * FN;
    p.slip = (double)fret_gross_slip(&p.contact);
    p.energy = p.limit * p.slip;
    if (!CHECK(fret_memory_make(p.contact.normal, p.contact.mu, &p.memory).code == FRET_OK) ||
        !CHECK(fret_masing_make(&p.contact, &p.masing).code == FRET_OK))
        exit(unit_finish());
    return p;
}

static pair make(double n, double k) {
    const unit_scene s = unit_make_scene(n, k);
    return make_of(&s, 20);
}

static void drop(pair *p) {
    fret_memory_free(p->memory);
    fret_masing_free(p->masing);
}

static void restart(pair *p) {
    const fret_step press = {FRET_TO_FORCE, FRET_KEEP_DX, (double)p->contact.press.F, 0};
    fret_memory_reset(p->memory);
    fret_masing_reset(p->masing);
    CHECK_OK(fret_memory_step(p->memory, &press));
}

static fret_masing_state now(const pair *p) {
    fret_masing_state s;
    fret_masing_now(p->masing, &s);
    return s;
}

static fret_state diagram(const pair *p) {
    fret_state s;
    fret_memory_state(p->memory, &s);
    return s;
}

static void to_dx(pair *p, double dx) {
    const fret_step step = {FRET_KEEP_NORMAL, FRET_TO_DX, 0, dx};
    double Fx;
    CHECK_OK(fret_memory_step(p->memory, &step));
    CHECK_OK(fret_masing_to_dx(p->masing, dx, &Fx));
    CHECK(Fx == now(p).Fx && now(p).dx == dx && fabs(Fx) <= p->limit);
}

static void to_force(pair *p, double Fx) {
    const fret_step step = {FRET_KEEP_NORMAL, FRET_TO_FX, 0, Fx};
    double dx;
    CHECK_OK(fret_memory_step(p->memory, &step));
    CHECK_OK(fret_masing_to_force(p->masing, Fx, &dx));
    CHECK(dx == now(p).dx && fabs(now(p).Fx - Fx) <= 2.3e-16 * p->limit);
}

/* Random targets: anywhere, with gross slip or not, tiny cycles on large ones, spirals inwards. */
static double target(unsigned long long *seed, double last, int i) {
    const double size = pow(10, unit_random(seed, -6, 0));
    switch (i / 50 % 4) {
    case 0:
        return unit_random(seed, -1.4, 1.4);
    case 1:
        return unit_random(seed, -0.999, 0.999);
    case 2:
        return last + size * unit_random(seed, -0.3, 0.3);
    default:
        return pow(-0.93, i % 50);
    }
}

enum { STEPS = 2000 };

static const double ns[] = {0.2, 0.5, 1, 2, 4, 40}, ks[] = {-0.95, -0.5, 0, 0.5, 0.95};

static void random_displacements(void) {
    for (int i = 0; i < 30; i++) {
        pair p = make(ns[i % 6], ks[i / 6]);
        unsigned long long seed = 100 + (unsigned)i;
        double last = 0, W = 0;
        restart(&p);
        for (int j = 0; j < STEPS; j++) {
            last = target(&seed, last, j);
            to_dx(&p, last * p.slip);
            const fret_state m = diagram(&p);
            const fret_masing_state s = now(&p);
            CHECK_ABS(s.Fx, m.Fx, p.limit, 1e-14L);
            CHECK_REL(s.W, m.W, 1e-14L);
            CHECK(s.W >= W && s.W == fret_masing_loss(p.masing));
            W = s.W;
            CHECK_ABS(s.kt, m.kt, m.kn / fret_normal_foundation(p.contact.normal)->eta, 1e-12L);
        }
        drop(&p);
    }
}

/* By force, now and then by displacement; short of gross slip, where delta_x is as steep as
 * (1-F_x/mu F_N)^(q-1) and the errors of both grow with it. */
static void random_forces(void) {
    for (int i = 0; i < 30; i++) {
        pair p = make(ns[i % 6], ks[i / 6]);
        unsigned long long seed = 200 + (unsigned)i;
        double last = 0;
        restart(&p);
        for (int j = 0; j < STEPS; j++) {
            last = fmax(fmin(target(&seed, last, j), 0.9), -0.9);
            if (unit_random(&seed, 0, 1) > 0.9) {
                fret_loading f;
                CHECK_OK(fret_loading_by_force(&p.contact, last * p.limit, &f));
                to_dx(&p, (double)f.dx);
                last = now(&p).Fx / p.limit;
            } else {
                to_force(&p, last * p.limit);
            }
            const fret_state m = diagram(&p);
            const fret_masing_state s = now(&p);
            CHECK_ABS(s.Fx, m.Fx, p.limit, 1e-14L);
            CHECK_ABS(s.dx, m.dx, p.slip, 1e-14L);
            CHECK_REL(s.W, m.W, 1e-14L);
        }
        drop(&p);
    }
}

/* Up to gross slip by force: every digit of mu F_N - F_x counts. */
static void force_to_gross_slip(void) {
    static const double parts[] = {1e-9, 0.3, 0.6, 1 - 1e-6, 1 - 1e-12, 1 - 1e-15, 1};
    for (int i = 0; i < 210; i++) {
        pair p = make(ns[i % 6], ks[i / 6 % 5]);
        const double FA = parts[i / 30] * p.limit;
        fret_loading f;
        fret_real loss;
        restart(&p);
        CHECK_OK(fret_loading_by_force(&p.contact, FA, &f));
        CHECK_OK(fret_cycle_loss_by_force(&p.contact, FA, &loss));
        for (int j = 0; j < 4; j++) {
            const double sign = j % 2 ? -1 : 1;
            double dx;
            CHECK_OK(fret_masing_to_force(p.masing, sign * FA, &dx));
            CHECK_REL(dx, sign * f.dx, 1e-14L);
            CHECK_REL(now(&p).W, (1 + 2 * j) * loss / 4, 1e-14L);
            CHECK(now(&p).turns == 0 && (parts[i / 30] < 1 || now(&p).kt == 0));
        }
        for (int sign = -1; sign <= 1; sign += 2) { /* what differs from mu F_N in the last bit is it */
            double dx;
            restart(&p);
            CHECK_OK(fret_masing_to_force(p.masing, sign * nextafter(p.limit, i % 2 ? 0 : inf_), &dx));
            CHECK(now(&p).Fx == sign * p.limit && now(&p).kt == 0);
            CHECK_REL(dx, sign * p.slip, 1e-15L);
        }
        drop(&p);
    }
}

/* Loops of any size, on their own or within a large one, against the closed form. */
static void loops(void) {
    for (int i = 0; i < 30; i++) {
        pair p = make(ns[i % 6], ks[i / 6]);
        for (double size = 1; size > 1e-7; size /= 7) {
            fret_real loss;
            CHECK_OK(fret_cycle_loss_by_displacement(&p.contact, size * p.slip, &loss));
            restart(&p);
            to_dx(&p, size * p.slip);
            CHECK_REL(4 * now(&p).W, loss, 1e-14L);
            to_dx(&p, -size * p.slip);
            const double W = now(&p).W;
            for (int j = 0; j < 3; j++) {
                to_dx(&p, size * p.slip);
                CHECK_REL(now(&p).loop, loss, 1e-14L);
                to_dx(&p, -size * p.slip);
                CHECK_REL((fret_real)now(&p).W - W, (j + 1) * loss, 1e-14L);
                CHECK(now(&p).turns == 0 && now(&p).Fx == -fabs(now(&p).Fx));
            }
            to_dx(&p, 0);
            const double Fx = now(&p).Fx;
            const size_t turns = now(&p).turns;
            to_dx(&p, -size * p.slip / 8);
            to_dx(&p, 0);
            CHECK(now(&p).Fx == Fx && now(&p).turns == turns);
            CHECK_OK(fret_cycle_loss_by_displacement(&p.contact, size * p.slip / 16, &loss));
            CHECK_REL(now(&p).loop, loss, 1e-14L);
        }
        drop(&p);
    }
}

/* At and beyond gross slip, near the origin and after sliding far from it. */
static void gross_slip(void) {
    static const double sizes[] = {1 - 1e-12, 1 - 1e-15, 1, 1 + 4e-16, 1 + 1e-12, 1.5, 40},
                        offsets[] = {0, 3, 1e6};
    for (int i = 0; i < 21; i++) {
        pair p = make(ns[i % 6], ks[i % 5]);
        const double size = sizes[i % 7] * p.slip, offset = offsets[i / 7] * p.slip;
        restart(&p);
        for (int j = 0; j < 20; j++) {
            to_dx(&p, j % 2 ? offset - size : offset + size);
            const fret_state m = diagram(&p);
            const fret_masing_state s = now(&p);
            CHECK_ABS(s.Fx, m.Fx, p.limit, 1e-14L);
            CHECK_REL(s.W, m.W, 1e-14L);
        }
        to_dx(&p, offset + 3 * size);
        to_dx(&p, offset + 2.2 * size);
        to_dx(&p, offset + 2.6 * size);
        CHECK_ABS(now(&p).Fx, diagram(&p).Fx, p.limit, 1e-14L);
        CHECK_REL(now(&p).W, diagram(&p).W, 1e-14L);
        /* by force only as far as it begins */
        to_dx(&p, offset - 9 * size);
        to_force(&p, p.limit);
        CHECK(now(&p).kt == 0);
        CHECK_ABS(now(&p).dx, diagram(&p).dx, fabs(offset) + 10 * size, 1e-15L);
        drop(&p);
    }
}

/* A spiral inwards keeps all its turning points, and passing them wipes all. */
static void deep(void) {
    enum { DEPTH = 10000 };
    pair p = make(2, 0.3);
    restart(&p);
    for (int i = 0; i < DEPTH; i++) {
        to_dx(&p, (i % 2 ? -0.9 : 0.9) * p.slip * pow(0.9995, i));
        CHECK(now(&p).turns == (size_t)i);
    }
    CHECK_ABS(now(&p).Fx, diagram(&p).Fx, p.limit, 1e-14L);
    CHECK_REL(now(&p).W, diagram(&p).W, 1e-14L);
    to_dx(&p, -0.95 * p.slip);
    CHECK(now(&p).turns == 0);
    CHECK_ABS(now(&p).Fx, diagram(&p).Fx, p.limit, 1e-14L);
    CHECK_REL(now(&p).W, diagram(&p).W, 1e-14L);
    drop(&p);
}

/* The same two loops again and again: after each round the same force, and W grows by the same amount. */
static void drift(void) {
    enum { ROUNDS = 200000 };
    pair p = make(2, -0.3);
    const double path[] = {0.8, -0.3, 0.2, 0.1, 0.15, -0.8};
    double Fx = 0, first = 0;
    fret_real round = 0, start;
    for (int i = 0; i < 2; i++)
        for (int j = 0; j < 6; j++)
            CHECK_OK(fret_masing_to_dx(p.masing, path[j] * p.slip, &first));
    /* 4 D of the large loop and of the two small ones */
    for (int i = 0; i < 3; i++) {
        const double half[] = {0.8, 0.25, 0.025};
        fret_real loss;
        CHECK_OK(fret_cycle_loss_by_displacement(&p.contact, half[i] * p.slip, &loss));
        round += loss;
    }
    start = fret_masing_loss(p.masing);
    for (int i = 0; i < ROUNDS; i++)
        for (int j = 0; j < 6; j++)
            fret_masing_to_dx(p.masing, path[j] * p.slip, &Fx);
    CHECK(Fx == first);
    CHECK_REL(fret_masing_loss(p.masing) - start, (fret_real)ROUNDS * round, 2e-15L);
    drop(&p);
}

static void other_shapes(void) {
    unit_scene s = unit_make_scene(2, 0.3);
    const fret_gap gaps[] = {
        {.kind = FRET_GAP_SUM, .terms = 2, .power = {{2, 1e-5, 1e-3}, {4, 1e-4, 1e-3}}},
        {.kind = FRET_GAP_FLAT_ROUNDED, .R = 0.02, .b = 1e-4},
    };
    for (int i = 0; i < 2; i++) {
        unsigned long long seed = 300 + (unsigned)i;
        double last = 0;
        s.gap = gaps[i];
        pair p = make_of(&s, 2);
        restart(&p);
        for (int j = 0; j < 120; j++) {
            last = target(&seed, last, 5 * j);
            if (j % 3)
                to_dx(&p, last * p.slip);
            else
                to_force(&p, fmax(fmin(last, 1), -1) * p.limit);
            const fret_state m = diagram(&p);
            const fret_masing_state now_ = now(&p);

            CHECK_ABS(now_.Fx, m.Fx, p.limit, 1e-12L);
            CHECK_REL(now_.W, m.W, 1e-12L);
            CHECK_ABS(now_.kt, m.kt, m.kn / fret_normal_foundation(p.contact.normal)->eta, 1e-9L);
            last = now_.dx / p.slip;
        }
        drop(&p);
    }
}

static bool same(const fret_masing *a, const fret_masing *b) {
    fret_masing_state x, y;
    fret_masing_now(a, &x);
    fret_masing_now(b, &y);
    return x.Fx == y.Fx && x.dx == y.dx && x.W == y.W && x.kt == y.kt && x.loop == y.loop &&
           x.turns == y.turns;
}

static void objects(void) {
    pair p = make(2, 0);
    unsigned long long seed = 9;
    fret_masing *copy, *fresh;
    double a, b;
    CHECK_OK(fret_masing_make(&p.contact, &copy));
    CHECK_OK(fret_masing_make(&p.contact, &fresh));
    for (int i = 0; i < 100; i++)
        CHECK_OK(fret_masing_to_dx(p.masing, pow(-0.95, i) * p.slip, &a));
    CHECK_OK(fret_masing_copy(copy, p.masing));
    CHECK_OK(fret_masing_copy(copy, copy));
    CHECK(same(copy, p.masing));
    for (int i = 0; i < 100; i++) {
        const double dx = unit_random(&seed, -1.1, 1.1) * p.slip;
        CHECK_OK(fret_masing_to_dx(p.masing, dx, &a));
        CHECK_OK(fret_masing_to_dx(copy, dx, &b));
        CHECK(a == b && same(copy, p.masing));
    }
    CHECK_OK(fret_masing_to_dx(p.masing, now(&p).dx, &b)); /* no motion */
    CHECK(a == b && same(copy, p.masing));
    fret_masing_reset(copy);
    CHECK(same(copy, fresh) && now(&p).W > 0);
    fret_masing_free(copy);
    fret_masing_free(fresh);
    fret_masing_free(NULL);

    const fret_masing_state before = now(&p);
    fret_masing *none = NULL;
    const fret_press open = {.F = 0};
    CHECK_ERROR(fret_masing_make(&(fret_contact){p.contact.normal, 0, p.contact.press}, &none),
                FRET_NOT_POSITIVE, "mu");
    CHECK_ERROR(fret_masing_make(&(fret_contact){p.contact.normal, nan_, p.contact.press}, &none),
                FRET_NOT_FINITE, "mu");
    CHECK_ERROR(fret_masing_make(&(fret_contact){p.contact.normal, 0.3, open}, &none), FRET_NOT_POSITIVE,
                "FN");
    CHECK_CODE(fret_masing_make(&(fret_contact){p.contact.normal, 1e300, p.contact.press}, &none),
               FRET_OVERFLOW);
    CHECK(none == NULL);
    CHECK_ERROR(fret_masing_to_dx(p.masing, nan_, &a), FRET_NOT_FINITE, "dx");
    CHECK_ERROR(fret_masing_to_dx(p.masing, inf_, &a), FRET_NOT_FINITE, "dx");
    CHECK_ERROR(fret_masing_to_force(p.masing, nan_, &a), FRET_NOT_FINITE, "Fx");
    CHECK_ERROR(fret_masing_to_force(p.masing, -p.limit * (1 + 1e-15), &a), FRET_GROSS_SLIP, "Fx");
    CHECK(fret_masing_to_force(p.masing, 2 * p.limit, &a).limit == p.limit);
    const fret_masing_state after = now(&p);
    CHECK(memcmp(&before, &after, sizeof after) == 0);
    drop(&p);
}

int main(int argc, char **argv) {
    unit_start("masing", argc, argv);
    CASE(random_displacements());
    CASE(random_forces());
    CASE(force_to_gross_slip());
    CASE(loops());
    CASE(gross_slip());
    CASE(deep());
    CASE(drift());
    CASE(other_shapes());
    CASE(objects());
    return unit_finish();
}
