/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The loss of a moving slip front: short rules against quadrature of the law at many points. */
#include "contact/phase.h"
#include "number/quadrature.h"
#include "unit.h"

static unsigned long long seed = 88172645463325252ull;
static double uniform(void) {
    seed ^= seed << 13;
    seed ^= seed >> 7;
    seed ^= seed << 17;
    return (double)(seed >> 11) * 0x1p-53;
}

/* 10^-most .. 1 */
static double small(double most) {
    return pow(10, -most * uniform());
}

/* The rate at a part of the phase by the slices of the law, which keep the digits of thin zones. */
static fret_real rate(fret_real t, fret_real rest, void *context) {
    const fret_phase *p = context;
    const fret_normal *n = p->normal;
    const fret_real e = p->edge0 * rest + p->edge1 * t;
    fret_real d = (p->edge0 - p->front0) * rest + (p->edge1 - p->front1) * t;
    if (d <= 0 || e <= 0)
        return 0;
    const fret_point edge = p->by == DEPTH ? fret_law_at_depth(n, e) : fret_law_at_force(n, e);
    const fret_level outer = {edge.y, edge.F};
    const fret_real front = p->front0 * rest + p->front1 * t;
    if (p->by == DEPTH)
        return fret_law_slice(n, &outer, d).G;
    d = fret_law_thickness(n, &outer, d);
    const fret_real K = fret_law_at_force(n, front).K;
    return K > 0 ? fret_law_slice(n, &outer, d).G / K : 0;
}

static void random_phases(double n, double k, int count) {
    const unit_scene s = unit_make_scene(n, k);
    const fret_normal *normal = unit_make_normal(&s);
    for (int i = 0; i < count; i++) {
        fret_phase p = {.normal = normal, .by = i % 2 ? LOAD : DEPTH};
        const fret_real scale = p.by == LOAD ? 100 : fret_law_depth(normal, 100);
        /* steps from far shorter than the zone to the whole contact, zones from thin to all of it */
        const fret_real zone = small(8), way = small(6) * (1 - zone);
        p.edge0 = scale;
        p.edge1 = scale * (1 + (uniform() - 0.5L) * small(6));
        if (i % 5 == 0)
            p.edge1 = scale * (uniform() * 3 + 0.01L);
        p.front0 = scale * (1 - zone);
        p.front1 = p.front0 - way * fminl(p.front0, p.edge1);
        if (p.front1 < 0 || p.front1 > p.edge1 || i % 7 == 0)
            p.front1 = 0;
        const fret_real want = (p.front0 - p.front1) * fret_integrate(rate, &p);
        /* of a law that is nearly linear the slices have fewer digits at the centre: see thick_zones */
        CHECK_REL(fret_phase_loss(&p), want, normal->pm1 < 1e-3L ? 1e-14L : UNIT_TOL(1e-15L, 1e-12L));
        CHECK(fret_phase_loss(&p) >= 0);
    }
}

/* By depth and to the centre, zones so thick that differences of the primitive P = F y/(p+1) will do:
 *   int [F(D)-F(d)-(D-d) K(d)] dd = [P(D)]/r + (r-2) [P(d)] - [(D-d) F(d)], r = dD/dd. */
static void thick_zones(double n, double k) {
    const unit_scene s = unit_make_scene(n, k);
    const fret_normal *normal = unit_make_normal(&s);
    for (int i = 1; i < 40; i++) {
        const fret_real D0 = 1, D1 = 0.5L + i / 16.0L, d0 = 0.5L + i / 100.0L, r = (D1 - D0) / -d0;
        const fret_real F0 = fret_law_force(normal, D0), F1 = fret_law_force(normal, D1),
                        f0 = fret_law_force(normal, d0), p1 = normal->p + 1;
        const fret_real parts[] = {(F1 * D1 - F0 * D0) / (p1 * r), -(r - 2) * f0 * d0 / p1, (D0 - d0) * f0};
        const fret_phase p = {normal, DEPTH, D0, D1, d0, 0};
        if (D1 != D0)
            CHECK_ABS(fret_phase_loss(&p), -(parts[0] + parts[1] + parts[2]),
                      fabsl(parts[0]) + fabsl(parts[1]) + parts[2], UNIT_TOL(1e-18L, 1e-15L));
    }
}

static void limits(void) {
    const unit_scene s = unit_make_scene(2, 0);
    const fret_normal *normal = unit_make_normal(&s);
    for (int by = 0; by < 2; by++) {
        const fret_phase nowhere = {normal, by ? LOAD : DEPTH, 1, 2, 0.5L, 0.5L},
                         open = {normal, by ? LOAD : DEPTH, 0, 0, 0, 0};
        CHECK(fret_phase_loss(&nowhere) == 0);
        CHECK(fret_phase_loss(&open) == 0);
    }
    /* two parts of a phase add up to it, whatever rule each takes */
    for (int i = 1; i < 100; i++) {
        const fret_real x = i / 100.0L;
        const fret_phase whole = {normal, LOAD, 100, 101, 90, 88},
                         first = {normal, LOAD, 100, 100 + x, 90, 90 - 2 * x},
                         second = {normal, LOAD, 100 + x, 101, 90 - 2 * x, 88};
        CHECK_REL(fret_phase_loss(&first) + fret_phase_loss(&second), fret_phase_loss(&whole),
                  UNIT_TOL(1e-16L, 1e-13L));
    }
}

int main(int argc, char **argv) {
    unit_start("phase", argc, argv);
    static const double n[] = {0.5, 1, 2, 3, 8, 100}, k[] = {-0.99, -0.5, 0, 0.3, 0.99};
    for (size_t i = 0; i < sizeof n / sizeof *n; i++)
        for (size_t j = 0; j < sizeof k / sizeof *k; j++) {
            random_phases(n[i], k[j], 200);
            thick_zones(n[i], k[j]);
        }
    limits();
    return unit_finish();
}
