/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The loss of a moving slip front: short rules against quadrature of the law at many points. */
#include "contact/phase.h"
#include "number/integral.h"
#include "unit.h"

static double uniform(void) {
    static unsigned long long seed = 1;
    return unit_random(&seed, 0, 1);
}

/* 10^-most .. 1 */
static double small(double most) {
    return pow(10, -most * uniform());
}

static fret_phase phase_of(const fret_normal *normal, coordinate by, fret_real edge0, fret_real edge1,
                           fret_real front0, fret_real front1) {
    return (fret_phase){
        .normal = normal, .by = by, .edge0 = edge0, .edge1 = edge1, .front0 = front0, .front1 = front1};
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

/* In parts of which none comes near the centre without reaching it: see near_centre. */
static fret_real by_slices(const fret_phase *p) {
    const fret_real most = fmaxl(p->edge0, p->edge1), least = fminl(p->edge0, p->edge1);
    if (least > most / 3 && (p->front1 == 0 || p->front1 > p->front0 / 3)) {
        fret_phase part = *p;
        return (p->front0 - p->front1) * fret_integral(rate, &part, 1e-18L).value;
    }
    fret_phase first = *p, second = *p;
    first.edge1 = second.edge0 = (p->edge0 + p->edge1) / 2;
    first.front1 = second.front0 = (p->front0 + p->front1) / 2;
    return by_slices(&first) + by_slices(&second);
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
        const fret_real want = by_slices(&p);
        /* of a law that is nearly linear the slices have fewer digits at the centre: see thick_zones; the
         * quadrature of a steep one by load ends short of it, and halves of a short way are known to its
         * rounding */
        const fret_real rounding = 1e-19L * p.front0 / (p.front0 - p.front1);
        const bool steep = p.by == LOAD && normal->q < 0.3L && p.front1 == 0;
        CHECK_REL(fret_phase_loss(&p), want,
                  steep                 ? 1e-12L
                  : normal->pm1 < 1e-3L ? 1e-14L
                                        : UNIT_TOL(1e-15L + rounding, 1e-12L));
        CHECK(fret_phase_loss(&p) >= 0);
    }
}

/* By depth and to the centre, zones so thick that differences of the primitive P = F y/(p+1) will do:
 *   int [F(D)-F(d)-(D-d) K(d)] dd = [P(D)]/r + (r-2) [P(d)] - [(D-d) F(d)], r = dD/dd. */
static void thick_zones(double n, double k) {
    const unit_scene s = unit_make_scene(n, k);
    const fret_normal *normal = unit_make_normal(&s);
    const fret_phase by_load = phase_of(normal, LOAD, 100, 100, 100, 0); /* the same zone by both */
    const fret_real depth = fret_law_depth(normal, 100);
    const fret_phase by_depth = phase_of(normal, DEPTH, depth, depth, depth, 0);
    CHECK_REL(fret_phase_loss(&by_load), fret_phase_loss(&by_depth), UNIT_TOL(2e-17L, 1e-13L));
    for (int i = 1; i < 40; i++) {
        const fret_real D0 = 1, D1 = 0.5L + i / 16.0L, d0 = 0.5L + i / 100.0L, r = (D1 - D0) / -d0;
        const fret_real F0 = fret_law_force(normal, D0), F1 = fret_law_force(normal, D1),
                        f0 = fret_law_force(normal, d0), p1 = normal->p + 1;
        const fret_real parts[] = {(F1 * D1 - F0 * D0) / (p1 * r), -(r - 2) * f0 * d0 / p1, (D0 - d0) * f0};
        const fret_phase p = phase_of(normal, DEPTH, D0, D1, d0, 0);
        if (D1 != D0)
            CHECK_ABS(fret_phase_loss(&p), -(parts[0] + parts[1] + parts[2]),
                      fabsl(parts[0]) + fabsl(parts[1]) + parts[2], UNIT_TOL(1e-18L, 1e-15L));
    }
}

/* The front stops short of the centre, by whatever little: short parts, of which each is smooth, add up to
 * the whole.
 */
static void near_centre(double n, double k) {
    const unit_scene s = unit_make_scene(n, k);
    const fret_normal *normal = unit_make_normal(&s);
    for (int i = 0; i < unit_draws(40); i++) {
        const coordinate by = i % 2 ? LOAD : DEPTH;
        const fret_real scale = by == LOAD ? 100 : fret_law_depth(normal, 100), left = small(12);
        fret_phase whole = phase_of(normal, by, scale, scale * 2 * uniform(), scale, 0), part;
        if (i % 3 == 0) /* thin all the way: its places tell a thickness to 1e-16 */
            whole.edge1 = scale * fmaxl(left, 1e-3L) * (1 + uniform());
        whole.front1 = fminl(scale * left, whole.edge1 / 2);
        const fret_real edges = whole.edge1 - whole.edge0, fronts = whole.front0 - whole.front1;
        fret_real sum = 0, at = 0;
        part = whole;
        while (at < 1) {
            const fret_real nearest =
                fminl(part.front0 / fronts, part.edge0 / (fabsl(edges) + scale * 1e-9L));
            at = fminl(at + nearest / 16, 1);
            part.edge1 = at < 1 ? whole.edge0 + edges * at : whole.edge1;
            part.front1 = at < 1 ? whole.front0 - fronts * at : whole.front1;
            sum += fret_phase_loss(&part);
            part.edge0 = part.edge1;
            part.front0 = part.front1;
        }
        CHECK_REL(fret_phase_loss(&whole), sum, UNIT_TOL(1e-15L, 1e-12L));
        if (i < 8)
            CHECK_REL(fret_phase_loss_by_law(&whole), sum, UNIT_TOL(1e-14L, 1e-12L));
    }
}

/* Laws with a turn that is sharp, or close to the centre, as where one power of a sum takes over from another
 * or where the slope beyond a flat end tells: short parts add up to the whole. */
static void sharp_turns(void) {
    static const fret_gap gaps[] = {
        {.kind = FRET_GAP_SUM, .terms = 2, .power = {{0.5, 1e-6, 1e-3}, {30, 3e-6, 1e-3}}},
        {.kind = FRET_GAP_SUM, .terms = 2, .power = {{0.5, 1e-6, 1e-3}, {5, 4.22e-4, 1e-3}}},
        {.kind = FRET_GAP_SUM, .terms = 2, .power = {{1, 1e-6, 1e-3}, {100, 1e-5, 1e-3}}},
        {.kind = FRET_GAP_SUM, .terms = 2, .power = {{2, 1e-6, 1e-3}, {6, 1e-6, 1e-3}}},
        {.kind = FRET_GAP_FLAT_CONE, .b = 1e-4, .slope = 2e-4},
        {.kind = FRET_GAP_FLAT_PARABOLOID, .b = 1e-6, .R = 0.2},
        {.kind = FRET_GAP_FLAT_ROUNDED, .b = 1e-4, .R = 0.2}};
    static const double gradings[] = {0, -0.5, -0.99, 0.9};
    enum { PARTS = 16 };
    for (size_t i = 0; i < sizeof gaps / sizeof *gaps * 4; i++) {
        if (unit_skips(i) || unit_skips(i / 4 + 1))
            continue;
        const fret_material material = {{{100e9, 0.3, false}, {100e9, 0.3, false}}, gradings[i % 4], 1e-3};
        const fret_normal *normal = unit_keep_normal(&material, &gaps[i / 4]);
        fret_press press;
        CHECK_OK(fret_press_by_radius(normal, 1e-3, &press));
        for (int j = 0; j < 4; j++) {
            const coordinate by = j == 3 ? LOAD : DEPTH;
            const fret_real full = by == LOAD ? press.F : press.dz, edge = full * (0.3L + uniform());
            const fret_phase whole =
                phase_of(normal, by, full, edge, full, j % 2 ? fminl(full, edge) * uniform() : 0);
            fret_real sum = 0, gross = 0;
            for (int m = 0; m < PARTS; m++) {
                const fret_real t = (fret_real)m / (fret_real)PARTS,
                                u = (fret_real)(m + 1) / (fret_real)PARTS;
                const fret_phase part =
                    phase_of(normal, by, full + (edge - full) * t, full + (edge - full) * u,
                             full + (whole.front1 - full) * t, full + (whole.front1 - full) * u);
                sum += fret_phase_loss(&part);
                gross += by == DEPTH ? fret_phase_force(&part) / (fret_real)PARTS : 0;
            }
            CHECK_REL(fret_phase_loss(&whole), sum, 1e-12L);
            if (by == DEPTH)
                CHECK_REL(fret_phase_force(&whole), gross, 1e-14L);
        }
    }
}

/* 1/((t-m)^2+d^2), which a rule of few nodes cannot see, close to an end or not. */
static fret_real peak(fret_real t, fret_real rest, void *context) {
    const fret_real *at = context;
    (void)rest;
    return at[1] / ((t - at[0]) * (t - at[0]) + at[1] * at[1]);
}

static void peaks(void) {
    for (int i = 0; i < 200; i++) {
        fret_real at[2] = {i % 2 ? small(5) : uniform(), small(4)};
        const fret_real want = atan2l(1 - at[0], at[1]) + atan2l(at[0], at[1]);
        CHECK_REL(fret_integral(peak, at, 1e-15L).value, want, 1e-13L);
    }
}

static void limits(void) {
    const unit_scene s = unit_make_scene(2, 0);
    const fret_normal *normal = unit_make_normal(&s);
    for (int by = 0; by < 2; by++) {
        const fret_phase nowhere = phase_of(normal, by ? LOAD : DEPTH, 1, 2, 0.5L, 0.5L),
                         open = phase_of(normal, by ? LOAD : DEPTH, 0, 0, 0, 0);
        CHECK(fret_phase_loss(&nowhere) == 0);
        CHECK(fret_phase_loss(&open) == 0);
    }
    /* gross slip: F_N ~ y^(3/2) */
    for (int i = 0; i < 40; i++) {
        const fret_real D0 = i % 2 ? 1e-6L : 1e-6L * small(12),
                        D1 = i % 3 ? 1e-6L * small(12) : D0 * (1 + 0.1L * small(6));
        const fret_phase p = phase_of(normal, DEPTH, D0, D1, 0, 0);
        const fret_real a = sqrtl(D0), b = sqrtl(D1), /* (b^5-a^5)/(b^2-a^2) */
            mean = (b * b * b * b + b * b * b * a + b * b * a * a + b * a * a * a + a * a * a * a) / (a + b);
        CHECK_REL(fret_phase_force(&p), 0.4L * mean * fret_law_force(normal, 1), UNIT_TOL(1e-17L, 1e-14L));
    }
    /* two parts of a phase add up to it, whatever rule each takes */
    for (int i = 1; i < 100; i++) {
        const fret_real x = i / 100.0L;
        const fret_phase whole = phase_of(normal, LOAD, 100, 101, 90, 88),
                         first = phase_of(normal, LOAD, 100, 100 + x, 90, 90 - 2 * x),
                         second = phase_of(normal, LOAD, 100 + x, 101, 90 - 2 * x, 88);
        CHECK_REL(fret_phase_loss(&first) + fret_phase_loss(&second), fret_phase_loss(&whole),
                  UNIT_TOL(1e-16L, 1e-13L));
    }
}

int main(int argc, char **argv) {
    unit_start("phase", argc, argv);
    static const double n[] = {0.5, 1, 2, 3, 8, 100}, k[] = {-0.99, -0.5, 0, 0.3, 0.99};
    for (size_t i = 0; i < sizeof n / sizeof *n; i++)
        for (size_t j = 0; j < sizeof k / sizeof *k; j++) {
            CASE(random_phases(n[i], k[j], unit_draws(200)));
            CASE(thick_zones(n[i], k[j]));
            CASE(near_centre(n[i], k[j]));
        }
    CASE(sharp_turns());
    CASE(peaks());
    CASE(limits());
    return unit_finish();
}
