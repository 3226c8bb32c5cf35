/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The memory diagram in double: closed forms, the balance of energy, and what its
 * interface promises. Random histories beside the exact one are in tests/hard. */

#include "histories.h"
#include "unit.h"

static const double nan_ = (double)NAN, inf_ = (double)INFINITY;

static fret_diagram *make(const fret_normal *normal, double mu) {
    fret_diagram *d = NULL;
    if (!CHECK(fret_diagram_make(normal, mu, &d).code == FRET_OK))
        exit(unit_finish());
    return d;
}

static fret_state go(fret_diagram *d, fret_normal_target normal_by, double normal,
                     fret_tangential_target tangential_by, double tangential) {
    fret_state now;
    CHECK_OK(fret_diagram_step(d, &(fret_step){normal_by, tangential_by, normal, tangential}));
    fret_diagram_forces(d, &now);
    return now;
}

static fret_state state_of(const fret_diagram *d) {
    fret_state s;
    fret_diagram_state(d, &s);
    return s;
}

/* At constant F_N: first loading and the loss of cycles, by force and by displacement. */
static void cycles(double n, double k) {
    const unit_scene s = unit_make_scene(n, k);
    const fret_pressed c = unit_make_contact(&s, 20);
    const double limit = c.mu * 20, slip = (double)fret_gross_slip(&c);
    fret_diagram *d = make(c.normal, c.mu);
    for (int i = 0; i < 30; i++) {
        const bool by_force = i % 2;
        const double part = i < 20 ? (i + 1) / 21.0 : ldexp(1, 20 - 2 * i);
        const double to = part * (by_force ? limit : slip);
        const fret_tangential_target by = by_force ? FRET_TO_FX : FRET_TO_DX;
        fret_loading f = {0, 0, 0, 0};
        fret_real loss = 0;
        CHECK_OK(by_force ? fret_loading_by_force(&c, to, &f) : fret_loading_by_displacement(&c, to, &f));
        CHECK_OK(by_force ? fret_cycle_loss_by_force(&c, to, &loss)
                          : fret_cycle_loss_by_displacement(&c, to, &loss));
        fret_diagram_reset(d);
        go(d, FRET_TO_FORCE, 20, FRET_KEEP_DX, 0);
        const fret_state first = go(d, FRET_KEEP_NORMAL, 0, by, to);
        CHECK_ABS(first.Fx, f.Fx, limit, 1e-14L);
        CHECK_ABS(first.dx, f.dx, slip, 1e-14L);
        CHECK_REL(4 * first.W, loss, 1e-13L / part);
        const fret_state back = go(d, FRET_KEEP_NORMAL, 0, by, -to),
                         again = go(d, FRET_KEEP_NORMAL, 0, by, to);
        CHECK_ABS(back.Fx, -f.Fx, limit, 1e-14L);
        CHECK_ABS(again.dx, f.dx, slip, 1e-14L);
        CHECK_REL(again.W - first.W, loss, 1e-13L / part);
        CHECK_REL(2 * fret_diagram_last_loss(d), loss, 1e-13L / part);
        CHECK_REL(again.W, first.W + loss, 1e-13L / part);
        CHECK(again.W == state_of(d).W);
    }
    /* beyond gross slip and back */
    fret_diagram_reset(d);
    go(d, FRET_TO_FORCE, 20, FRET_KEEP_DX, 0);
    CHECK_REL(go(d, FRET_KEEP_NORMAL, 0, FRET_TO_DX, 3 * slip).Fx, limit, 1e-15L);
    fret_real loss = 0;
    CHECK_OK(fret_cycle_loss_by_displacement(&c, 3 * slip, &loss));
    double W = 0;
    for (int i = 0; i < 4; i++) {
        go(d, FRET_KEEP_NORMAL, 0, FRET_TO_DX, i % 2 ? 3 * slip : -3 * slip);
        W = fret_diagram_last_loss(d);
    }
    CHECK_REL(2 * W, loss, 1e-14L);
    CHECK(state_of(d).slices == 1 && state_of(d).c == 0);
    fret_diagram_free(d);
}

/* Work done is stored or dissipated: a path in many small steps, its work by Simpson's rule over each. */
static void ledger(double n, double k, bool by_force) {
    enum { STEPS = 4000 };
    const unit_scene s = unit_make_scene(n, k);
    const fret_pressed c = unit_make_contact(&s, 20);
    const double limit = c.mu * 20, slip = (double)fret_gross_slip(&c);
    fret_diagram *d = make(c.normal, c.mu), *half = make(c.normal, c.mu);
    go(d, FRET_TO_FORCE, 20, FRET_KEEP_DX, 0);
    fret_real work = 0;
    for (int i = 1; i <= STEPS; i++) {
        const double b = i * 0.003, f = 0.6 + 0.3 * cos(1.7 * b);
        const fret_state before = state_of(d);
        const fret_step step =
            by_force ? (fret_step){FRET_TO_FORCE, FRET_TO_FX, 20 * f, limit * f * 0.9 * sin(b)}
                     : (fret_step){FRET_TO_DEPTH, FRET_TO_DX, (double)c.press.dz * f, 0.8 * slip * sin(b)};
        fret_step middle = step;
        middle.normal = (step.normal + (double)(by_force ? before.FN : before.dz)) / 2;
        middle.tangential = (step.tangential + (double)(by_force ? before.Fx : before.dx)) / 2;
        CHECK_OK(fret_diagram_copy(half, d));
        CHECK_OK(fret_diagram_step(half, &middle));
        CHECK_OK(fret_diagram_step(d, &step));
        const fret_real F[3] = {before.Fx, state_of(half).Fx, state_of(d).Fx},
                        x[3] = {before.dx, state_of(half).dx, state_of(d).dx};
        /* int F dx, F and x quadratic in the step */
        work += (F[0] * (-3 * x[0] + 4 * x[1] - x[2]) + 4 * F[1] * (x[2] - x[0]) +
                 F[2] * (x[0] - 4 * x[1] + 3 * x[2])) /
                6;
    }
    const fret_state end = state_of(d);
    CHECK_ABS(work, end.U + end.W, limit * slip, 2e-7L);
    fret_diagram_free(d);
    fret_diagram_free(half);
}

/* A depth that is the one there is moves nothing, whatever rounding makes of its load. */
static void kept_depth(double n, double k) {
    const unit_scene s = unit_make_scene(n, k);
    const fret_pressed c = unit_make_contact(&s, 20);
    const double slip = (double)fret_gross_slip(&c);
    fret_diagram *d = make(c.normal, c.mu);
    for (int i = 1; i < 100; i++) {
        fret_diagram_reset(d);
        const fret_state first = go(d, FRET_TO_FORCE, 20.0 * i / 99, FRET_TO_DX, 0);
        const fret_state then = go(d, FRET_TO_DEPTH, (double)first.dz, FRET_TO_DX, slip * i / 300);
        CHECK(then.FN == first.FN);
        CHECK(then.dz == first.dz);
    }
    fret_diagram_free(d);
}

/* Loads that come back to where they have been, but for rounding: stick ends where the exact memory has it.
 */
static void returning(double n, double k, bool by_force) {
    const unit_scene s = unit_make_scene(n, k);
    const fret_pressed c = unit_make_contact(&s, 100);
    const double slip = (double)fret_gross_slip(&c);
    fret_diagram *d = make(c.normal, c.mu);
    fret_memory *m = NULL;
    if (!CHECK(fret_memory_make(c.normal, c.mu, &m).code == FRET_OK))
        exit(unit_finish());
    for (int i = 0; i < 162; i++) {
        const double part = 0.07 + 0.05 * (i / 9), side = i % 2 ? -1 : 1;
        fret_state now;
        fret_state exact;
        if (i % 9 == 0) {
            fret_memory_reset(m);
            fret_diagram_reset(d);
            go(d, FRET_TO_FORCE, 100, FRET_KEEP_DX, 0);
            CHECK_OK(fret_memory_step(m, &(fret_step){FRET_TO_FORCE, FRET_KEEP_DX, 100, 0}));
        }
        const fret_step back = {FRET_TO_FORCE, by_force ? FRET_TO_FX : FRET_TO_DX, 100 * (1 - 0.3 * side),
                                (by_force ? c.mu * 60 : slip) * part * side};
        CHECK_OK(fret_memory_step(m, &back));
        now = go(d, back.normal_by, back.normal, back.tangential_by, back.tangential);
        fret_memory_state(m, &exact);
        CHECK_ABS(now.Fx, exact.Fx, c.mu * 100, 1e-14L);
        CHECK_ABS(state_of(d).c, exact.c, exact.a, 1e-9L);
        CHECK_REL(state_of(d).kt, exact.kt, 1e-9L);
    }
    fret_memory_free(m);
    fret_diagram_free(d);
}

/* Contact lost and regained: open, it has no force and moves freely. */
static void separation(void) {
    const unit_scene s = unit_make_scene(2, 0.3);
    const fret_normal *normal = unit_make_normal(&s);
    fret_diagram *d = make(normal, 0.4);
    go(d, FRET_TO_DEPTH, 1e-6, FRET_TO_DX, 1e-7);
    fret_state now = go(d, FRET_TO_DEPTH, -1e-6, FRET_TO_DX, 3e-7);
    CHECK(now.FN == 0 && now.Fx == 0 && now.dz == -1e-6 && now.dx == 3e-7 && state_of(d).slices == 0);
    now = go(d, FRET_KEEP_NORMAL, 0, FRET_TO_DX, 5e-7);
    CHECK(now.Fx == 0 && now.dx == 5e-7 && fret_diagram_last_loss(d) == 0);
    now = go(d, FRET_TO_DEPTH, 1e-6, FRET_KEEP_DX, 0);
    CHECK(now.FN > 0 && now.Fx == 0 && now.dx == 5e-7);
    now = go(d, FRET_TO_FORCE, 0, FRET_TO_FX, 0);
    CHECK(now.FN == 0 && now.dz == 0 && state_of(d).U == 0);
    CHECK_ERROR(fret_diagram_step(d, &(fret_step){FRET_KEEP_NORMAL, FRET_TO_FX, 0, 1}), FRET_GROSS_SLIP,
                "Fx");
    fret_diagram_free(d);
}

/* The last millionth of a millionth before gross slip, by force: what sticks is told by 1-t. */
static void brink(double n, double k) {
    const unit_scene s = unit_make_scene(n, k);
    for (int i = 0; i < 45; i++) {
        const fret_pressed c = unit_make_contact(&s, 7 + i);
        const double to = c.mu * (7 + i) * (1 - ldexp(1, -i)), side = i % 3 ? 1 : -1;
        fret_diagram *d = make(c.normal, c.mu);
        fret_loading f = {0, 0, 0, 0};
        CHECK_OK(fret_loading_by_force(&c, to, &f));
        go(d, FRET_TO_FORCE, i % 2 ? 5 : 60, FRET_KEEP_DX, 0);
        go(d, FRET_TO_FORCE, 7 + i, FRET_TO_FX, side * to);
        CHECK_REL(state_of(d).dx, side * f.dx, 1e-14L);
        CHECK_REL(state_of(d).c, f.c, 1e-14L);
        CHECK_OK(fret_diagram_step(d, &(fret_step){FRET_KEEP_NORMAL, FRET_TO_FX, 0, side * c.mu * (7 + i)}));
        CHECK(state_of(d).slices == 1);
        fret_diagram_free(d);
    }
}

/* Refused are just the depths at which load, or energy, leave their range, whatever came before. */
static void at_the_ends_of_the_range(const fret_normal *normal) {
    int inside = 0, outside = 0;
    for (int first = -300; first <= 300; first += 6) {
        fret_diagram *d = make(normal, 0.4);
        for (int i = 0; i < 20; i++) {
            const double dz = pow(10, first - i * i / 2.0);
            fret_press p = {0};
            if (dz < 1e-306 || fret_press_by_depth(normal, dz, &p).code)
                continue;
            const fret_real most = fmaxl(fabsl(log10l(p.F)), fabsl(log10l(p.F * dz)));
            const fret_status st = fret_diagram_step(d, &(fret_step){FRET_TO_DEPTH, FRET_TO_DX, dz, 0});
            if (most < 289.9L)
                inside += st.code == FRET_OK;
            else if (most > 290.1L)
                outside += st.code == FRET_OVERFLOW;
            CHECK(st.code == FRET_OK || st.code == FRET_OVERFLOW);
            CHECK(most > 289.9L || st.code == FRET_OK);
            CHECK(most < 290.1L || st.code == FRET_OVERFLOW);
        }
        fret_diagram_free(d);
    }
    CHECK(inside > 300 && outside > 300);
}

static void objects(void) {
    const unit_scene s = unit_make_scene(2, 0.3);
    const fret_normal *normal = unit_make_normal(&s);
    const fret_material material = s.material;
    const fret_gap flat = {.kind = FRET_GAP_FLAT_CONE, .b = 1e-3, .slope = 0.05};
    fret_contact *none = NULL;
    fret_diagram *d = NULL;
    CHECK_ERROR(fret_diagram_make(normal, 0, &d), FRET_NOT_POSITIVE, "mu");
    CHECK_ERROR(fret_diagram_make(normal, nan_, &d), FRET_NOT_FINITE, "mu");
    CHECK_ERROR(fret_contact_make(unit_keep_normal(&material, &flat), 0.4, FRET_DOUBLE, &none), FRET_OUTSIDE,
                "n");
    CHECK(d == NULL && none == NULL);
    d = make(normal, 0.4);
    fret_diagram_free(NULL);
    /* what is refused leaves the contact as it was */
    go(d, FRET_TO_FORCE, 10, FRET_TO_FX, 1);
    const fret_state before = go(d, FRET_TO_FORCE, 12, FRET_TO_FX, 2);
    const struct {
        fret_step step;
        fret_code code;
        const char *quantity; /* NULL: not told */
    } refused[] = {
        {{FRET_TO_FORCE, FRET_TO_FX, 12, 5}, FRET_GROSS_SLIP, "Fx"},
        {{FRET_TO_FORCE, FRET_TO_FX, 12, -5}, FRET_GROSS_SLIP, "Fx"},
        {{FRET_TO_FORCE, FRET_TO_DX, -1, 0}, FRET_NEGATIVE, "FN"},
        {{FRET_TO_FORCE, FRET_TO_DX, nan_, 0}, FRET_NOT_FINITE, "FN"},
        {{FRET_TO_DEPTH, FRET_TO_DX, inf_, 0}, FRET_NOT_FINITE, "dz"},
        {{FRET_KEEP_NORMAL, FRET_TO_DX, 0, nan_}, FRET_NOT_FINITE, "dx"},
        {{FRET_TO_DEPTH, FRET_TO_DX, 1e-6, inf_}, FRET_NOT_FINITE, "dx"},
        {{FRET_KEEP_NORMAL, FRET_TO_FX, 0, inf_}, FRET_NOT_FINITE, "Fx"},
        {{FRET_TO_DEPTH, FRET_TO_DX, 1e300, 0}, FRET_OVERFLOW, NULL},
        {{FRET_TO_DEPTH, FRET_TO_DX, 1e-300, 0}, FRET_OVERFLOW, NULL},
        {{FRET_TO_FORCE, FRET_TO_DX, 1e300, 0}, FRET_OVERFLOW, NULL},
    };
    for (size_t i = 0; i < sizeof refused / sizeof *refused; i++) {
        const fret_status st = fret_diagram_step(d, &refused[i].step);
        CHECK_CODE(st, refused[i].code);
        if (refused[i].quantity)
            CHECK(st.quantity && strcmp(st.quantity, refused[i].quantity) == 0);
        fret_state now;
        fret_diagram_forces(d, &now);
        CHECK(same_state(&now, &before));
    }
    at_the_ends_of_the_range(normal);
    /* nested turning points; a copy goes on alike */
    go(d, FRET_TO_FORCE, 10, FRET_KEEP_DX, 0);
    double at = 0, size = 3;
    for (int i = 0; i < 40; i++, size *= -0.9) {
        at += size;
        go(d, FRET_KEEP_NORMAL, 0, FRET_TO_FX, at);
    }
    CHECK(state_of(d).slices > 20);
    fret_diagram *other = make(normal, 0.4);
    CHECK_OK(fret_diagram_copy(other, d));
    CHECK_OK(fret_diagram_copy(other, other));
    const fret_state one = go(d, FRET_TO_DEPTH, (double)state_of(d).dz / 2, FRET_TO_DX, 0),
                     two = go(other, FRET_TO_DEPTH, (double)state_of(other).dz / 2, FRET_TO_DX, 0);
    CHECK(same_state(&one, &two));
    /* without the loss all else is the same */
    fret_diagram_reset(d);
    fret_diagram_reset(other);
    fret_diagram_count_loss(other, false);
    for (int i = 0; i < 200; i++) {
        const double t = 0.05 * i;
        const fret_state with = go(d, FRET_TO_FORCE, 10 + 4 * cos(t), FRET_TO_DX, 1e-6 * sin(1.3 * t)),
                         without = go(other, FRET_TO_FORCE, 10 + 4 * cos(t), FRET_TO_DX, 1e-6 * sin(1.3 * t));
        CHECK(with.Fx == without.Fx && with.dz == without.dz && without.W == 0);
    }
    fret_diagram_free(other);
    fret_diagram_free(d);
}

/* A ramp in many parts is the ramp: slices do not pile up, and nothing drifts. */
static void parts(void) {
    const unit_scene s = unit_make_scene(2, 0.3);
    const fret_normal *normal = unit_make_normal(&s);
    fret_diagram *d = make(normal, 0.4), *whole = make(normal, 0.4);
    static const double turn[5][2] = {
        {1e-6, 1e-7}, {2e-6, 9e-7}, {1.5e-6, 2e-7}, {5e-7, -3e-7}, {9e-7, 1e-6}};
    double z = 0, x = 0;
    for (int i = 0; i < 5; i++) {
        for (int j = 1; j <= 1000; j++)
            go(d, FRET_TO_DEPTH, z + (turn[i][0] - z) * j / 1000, FRET_TO_DX,
               x + (turn[i][1] - x) * j / 1000);
        z = turn[i][0];
        x = turn[i][1];
        const fret_state end = go(whole, FRET_TO_DEPTH, z, FRET_TO_DX, x),
                         now = go(d, FRET_TO_DEPTH, z, FRET_TO_DX, x);
        CHECK_ABS(now.Fx, end.Fx, 0.4 * end.FN, 1e-13L);
        CHECK_ABS(now.W, end.W, 0.4 * end.FN * 1e-6, 1e-12L);
        CHECK(state_of(d).slices <= state_of(whole).slices + 1);
    }
    fret_diagram_free(d);
    fret_diagram_free(whole);
}

int main(int argc, char **argv) {
    unit_start("diagram", argc, argv);
    static const double n[] = {0.5, 1, 2, 3, 100}, k[] = {-0.99, -0.5, 0, 0.3, 0.99};
    for (size_t i = 0; i < sizeof n / sizeof *n; i++)
        for (size_t j = 0; j < sizeof k / sizeof *k; j++) {
            CASE(cycles(n[i], k[j]));
            CASE(brink(n[i], k[j]));
        }
    CASE(ledger(2, 0.3, false));
    CASE(ledger(2, 0.3, true));
    CASE(ledger(1, -0.5, false));
    CASE(ledger(1, -0.5, true));
    CASE(kept_depth(2, 0));
    CASE(kept_depth(2, 0.3));
    for (int i = 0; i < 8; i++)
        CASE(returning(i & 1 ? 2 : 1, i & 2 ? 0.3 : 0, i & 4));
    CASE(separation());
    CASE(objects());
    CASE(parts());
    return unit_finish();
}
