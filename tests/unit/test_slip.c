/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The springs as the memory diagram has them: displacement, bound, and their force times their slip (22). */
#include "fret/cycle.h"
#include "unit.h"

static unsigned long long state = 1;

static fret_gap gap_of(int i) {
    static const fret_gap gaps[] = {
        {.kind = FRET_GAP_POWER, .terms = 1, .power = {{2, 0.005, 0.01}}},
        {.kind = FRET_GAP_POWER, .terms = 1, .power = {{1, 0.01, 1}}},
        {.kind = FRET_GAP_POWER, .terms = 1, .power = {{7, 1e-6, 2e-4}}},
        {.kind = FRET_GAP_FLAT_ROUNDED, .b = 1e-4, .R = 0.01},
        {.kind = FRET_GAP_FLAT_CONE, .b = 1e-4, .slope = 0.01},
        {.kind = FRET_GAP_EXACT_SPHERE, .R = 0.01},
    };
    return gaps[i];
}
enum { POWERS = 3, GAPS = 6 };

static const double gradings[] = {-0.7, 0, 0.5};
static const fret_material bodies = {{{210e9, 0.3, false}, {70e9, 0.33, false}}, 0, 1e-3};

static const fret_normal *normal_of(int gap, int grading) {
    fret_material material = bodies;
    const fret_gap shape = gap_of(gap);
    material.k = gradings[grading];
    return unit_keep_normal(&material, &shape);
}

static void go(fret_contact *m, fret_step step) {
    CHECK_OK(fret_contact_step(m, &step));
}

static fret_step press_to(double FN) {
    return (fret_step){FRET_TO_FORCE, FRET_KEEP_DX, FN, 0};
}

static fret_contact *pressed(const fret_normal *n, double mu, double FN) {
    fret_contact *m = NULL;
    if (!CHECK(fret_contact_make(n, mu, FRET_EXACT, &m).code == FRET_OK))
        exit(unit_finish());
    go(m, press_to(FN));
    return m;
}

/* First loading: its magnitude is what has been dissipated, a quarter of a cycle's loss. */
static void first_branch(void) {
    static const double parts[] = {1e-6, 0.01, 0.3, 0.9, 0.999, 1};
    const double mu = 0.4, FN = 50;
    for (int i = 0; i < GAPS * 3; i++) {
        const bool power = i % GAPS < POWERS;
        fret_pressed c = {.normal = normal_of(i % GAPS, i / GAPS), .mu = mu};
        CHECK_OK(fret_press_by_force(c.normal, FN, &c.press));
        fret_contact *m = pressed(c.normal, mu, FN);
        CHECK(fret_contact_slip_work(m) == 0);
        for (int j = power ? 0 : 2; j < 6; j++) { /* others lose digits of thin zones */
            const double FA = parts[j] * mu * FN;
            fret_state s;
            fret_real loss = 0;
            go(m, (fret_step){FRET_KEEP_NORMAL, FRET_TO_FX, 0, FA});
            fret_contact_state(m, &s);
            CHECK_OK(fret_cycle_loss_by_force(&c, FA, &loss));
            CHECK_REL(-fret_contact_slip_work(m), s.W, power ? UNIT_TOL(1e-15L, 1e-12L) : 1e-12L);
            CHECK_REL(-4 * fret_contact_slip_work(m), loss, power ? UNIT_TOL(1e-15L, 1e-12L) : 1e-12L);
        }
        fret_contact_free(m);
    }
}

/* At constant F_N against springs that are clipped one by one, as the paper has them. */
static void springs(void) {
    enum { SPRINGS = 4000, STEPS = 40 };
    static double u[SPRINGS];
    for (int i = 0; i < POWERS * 3; i++) {
        if (unit_skips((size_t)i))
            continue;
        const double mu = 0.3;
        fret_pressed c = {.normal = normal_of(i % POWERS, i / POWERS), .mu = mu};
        CHECK_OK(fret_press_by_force(c.normal, 20, &c.press));
        fret_contact *m = pressed(c.normal, mu, 20);
        const fret_real slip = fret_gross_slip(&c), eta = fret_normal_foundation(c.normal)->eta;
        const fret_real cell = c.press.a / (fret_real)SPRINGS;
        const double order = fmin(2, fret_normal_gap(c.normal)->power[0].n + gradings[i / POWERS] + 1);
        const fret_real error = 4 * pow(SPRINGS, -order); /* of the cells */
        double dx = 0;
        memset(u, 0, sizeof u);
        for (int j = 0; j < STEPS; j++) {
            const double next = (double)slip * unit_random(&state, -1.1, 1.1);
            fret_real work = 0, scale = 0;
            go(m, (fret_step){FRET_KEEP_NORMAL, FRET_TO_DX, 0, next});
            for (int k = 0; k < SPRINGS; k++) {
                const fret_real x = (k + 0.5L) * cell, lo = k * cell, hi = (k + 1) * cell;
                const fret_real bound = mu * eta * (c.press.dz - fret_normal_profile(c.normal, x));
                const fret_real w = fret_normal_stiffness(c.normal, hi) - fret_normal_stiffness(c.normal, lo);
                u[k] = (double)fmaxl(fminl(u[k] + (next - dx), bound), -bound);
                if (k % 50 == 0) {
                    CHECK_ABS(fret_contact_displacement(m, x), u[k], slip, 1e-14L);
                    CHECK_ABS(fret_contact_bound(m, -x), bound, slip, 1e-17L);
                }
                work -= w * fabsl(u[k] * ((fret_real)next - u[k])) / eta;
                scale += w * slip * slip / eta;
            }
            dx = next;
            CHECK_ABS(fret_contact_slip_work(m), work, scale, error);
        }
        fret_contact_free(m);
    }
}

/* Any history and shape against the sum over cells of what the two functions of x say. */
static void cells(void) {
    enum { CELLS = 20000 };
    const double mu = 0.5;
    for (int i = 0; i < GAPS * 3; i++) {
        if (unit_skips((size_t)i))
            continue;
        const fret_normal *n = normal_of(i % GAPS, i / GAPS);
        fret_contact *m = pressed(n, mu, 30);
        fret_state s;
        for (int j = 0; j < 8; j++) {
            const double FN = unit_random(&state, 10, 60);
            go(m, (fret_step){FRET_TO_FORCE, FRET_TO_FX, FN, mu * FN * unit_random(&state, -0.98, 0.98)});
        }
        fret_contact_state(m, &s);
        const fret_real eta = fret_normal_foundation(n)->eta, slip = mu * eta * s.dz;
        fret_real work = 0, scale = 0, Fx = 0, last = 0;
        for (int j = 0; j < CELLS; j++) {
            const fret_real x = s.a * (j + 0.5L) / (fret_real)CELLS,
                            K = fret_normal_stiffness(n, s.a * (j + 1) / (fret_real)CELLS);
            const fret_real u = fret_contact_displacement(m, x), bound = fret_contact_bound(m, x);
            CHECK(fabsl(u) <= bound + 1e-17L * slip);
            work -= (K - last) * fabsl(u * (s.dx - u)) / eta;
            Fx += (K - last) * u / eta;
            scale += (K - last) * slip * slip / eta;
            last = K;
        }
        CHECK_ABS(fret_contact_slip_work(m), work, scale, 1e-6L);
        CHECK_ABS(Fx, s.Fx, mu * s.FN, 1e-5L);
        fret_contact_free(m);
    }
}

static void ends(void) {
    const fret_normal *n = normal_of(0, 1);
    fret_contact *m = pressed(n, 0.3, 10);
    fret_state s;
    go(m, (fret_step){FRET_KEEP_NORMAL, FRET_TO_FX, 0, 2});
    fret_contact_state(m, &s);
    CHECK(fret_contact_displacement(m, 0) == s.dx && fret_contact_displacement(m, s.c / 2) == s.dx);
    CHECK(fret_contact_displacement(m, s.a) == 0 && fret_contact_displacement(m, 2 * s.a) == 0);
    CHECK(fret_contact_bound(m, s.a) == 0 && fret_contact_bound(m, -2 * s.a) == 0);
    CHECK(isnan(fret_contact_displacement(m, NAN)) && isnan(fret_contact_bound(m, NAN)));
    const fret_real x = (s.a + s.c) / 2; /* slips */
    CHECK(fret_contact_displacement(m, x) == fret_contact_bound(m, x) && fret_contact_bound(m, x) > 0);
    go(m, press_to(0));
    CHECK(fret_contact_displacement(m, 0) == 0 && fret_contact_bound(m, 0) == 0);
    CHECK(fret_contact_slip_work(m) == 0);
    fret_contact_free(m);
}

int main(int argc, char **argv) {
    unit_start("slip", argc, argv);
    CASE(first_branch());
    CASE(springs());
    CASE(cells());
    CASE(ends());
    return unit_finish();
}
