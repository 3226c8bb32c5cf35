/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Places of the law that are kept: values, phases of slip and histories beside those without. */
#include "contact/memory.h"
#include "contact/near.h"
#include "number/real.h"
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

static fret_real slow_value(const fret_normal *n, coordinate by, fret_real y) {
    return by == DEPTH ? fret_law_force(n, y) : fret_law_depth(n, y);
}

static void values(const fret_normal *n, fret_near *near) {
    static fret_near other;
    fret_near_make(n, &other);
    for (int i = 0; i < 2000; i++) {
        const coordinate by = i % 2 ? LOAD : DEPTH;
        const fret_real scale = by == LOAD ? 100 : fret_law_depth(n, 100);
        const fret_real y = scale * 2 * (i % 3 ? uniform() : small(30)) + 1e-60L;
        const fret_real v = fret_near_value(near, by, y), want = slow_value(n, by, y);
        fret_real rest;
        const fret_real high = fret_near_parts(near, by, y, &rest);
        CHECK_REL(v, want, UNIT_TOL(1.2e-19L, 4e-16L));
        CHECK(high + rest == v && fabsl(rest) <= 0.4L * fabsl(high));
        if (i % 7 == 0) /* whatever was asked before */
            CHECK(fret_near_value(&other, by, y) == v);
    }
    CHECK(isnan(fret_near_value(near, LOAD, 1e-295L)) && isnan(fret_near_value(near, DEPTH, 1e291L)));
    CHECK(isnan(fret_near_value(near, LOAD, 0)) && isnan(fret_near_value(near, LOAD, (fret_real)NAN)));
}

static void phases(const fret_normal *n, fret_near *near) {
    for (int i = 0; i < 2000; i++) {
        fret_phase p = {.normal = n, .by = i % 2 ? LOAD : DEPTH};
        const fret_real scale = p.by == LOAD ? 100 : fret_law_depth(n, 100);
        /* steps as those of a swing and far longer ones, zones from none to all of the contact */
        const double zone = i % 11 ? small(i % 3 ? 1.3 : 6) : 0, way = i % 4 ? 0.03 * uniform() : small(3);
        p.edge0 = scale * (1 + uniform());
        p.edge1 = p.edge0 * (1 + (uniform() - 0.5L) * (i % 4 ? 0.05 : small(3)));
        p.front0 = p.edge0 * (1 - zone);
        p.front1 = i % 23 ? p.front0 * (1 - way) : 0;
        if (p.front1 > p.edge1 || p.front0 == 0)
            continue;
        const fret_real slow = fret_phase_loss(&p);
        p.near = near;
        for (int j = 0; j < 2; j++)
            p.edge_v[j] = p.front_v[j] = -1;
        const fret_real fast = fret_phase_loss(&p);
        CHECK_REL(fast, slow, UNIT_TOL(6e-17L, 1e-13L));
        const fret_real edge[2] = {p.edge0, p.edge1}, front[2] = {p.front0, p.front1};
        for (int j = 0; j < 2; j++) {
            p.edge_v[j] = fret_near_value(near, p.by, edge[j]);
            p.front_v[j] = front[j] > 0 ? fret_near_value(near, p.by, front[j]) : 0;
        }
        CHECK(fret_phase_loss(&p) == fast);
    }
}

/* A step to anywhere, to close by, along a straight ramp, or to the brink of gross slip. */
static fret_step random_step(const fret_normal *n, double mu, const fret_state *now, int i) {
    const double dz = (double)fret_law_depth(n, 100), slip = mu * (double)n->foundation.eta * dz;
    const bool by_force = i % 5 < 3;
    fret_step s = {by_force ? FRET_TO_FORCE : FRET_TO_DEPTH, by_force ? FRET_TO_FX : FRET_TO_DX, 0, 0};
    const double there = by_force ? (double)now->FN / 100 : (double)now->dz / dz;
    double normal = i % 7 ? there + 0.04 * (uniform() - 0.5) : 2 * uniform();
    normal = fmin(fmax(normal, i % 97 ? 0.05 : 0), 2);
    const double most = by_force ? mu * 100 * normal : 2 * slip;
    const double here = by_force ? (double)now->Fx : (double)now->dx;
    const double tangential = i % 7 ? here + most * 0.05 * (uniform() - 0.5) : most * (2 * uniform() - 1);
    s.normal = normal * (by_force ? 100 : dz);
    s.tangential = fmin(fmax(tangential, -most), most) * (i % 31 ? 1 : 1 - 1e-13);
    if (i % 13 == 0)
        s.normal_by = FRET_KEEP_NORMAL;
    if (i % 29 == 0)
        s.tangential_by = FRET_KEEP_DX;
    return s;
}

/* The twin forgets how many moves there were, and works without places. */
static void histories(const fret_normal *n, int count) {
    const double mu = 0.3;
    fret_memory *fast, *slow;
    CHECK_OK(fret_memory_make(n, mu, &fast));
    CHECK_OK(fret_memory_make(n, mu, &slow));
    const fret_real dz = fret_law_depth(n, 100), slip = mu * n->foundation.eta * dz;
    fret_state a = {0}, b = {0};
    for (int i = 0; i < count; i++) {
        const fret_step s = random_step(n, mu, &a, i);
        const fret_status one = fret_memory_step(fast, &s);
        slow->moves = 0;
        const fret_status two = fret_memory_step(slow, &s);
        CHECK(one.code == two.code);
        fret_memory_state(fast, &a);
        fret_memory_state(slow, &b);
        CHECK(a.FN == b.FN || s.normal_by != FRET_TO_FORCE);
        CHECK_REL(a.FN, b.FN, UNIT_TOL(1e-18L, 1e-15L));
        CHECK_REL(a.dz, b.dz, UNIT_TOL(1e-18L, 1e-15L));
        CHECK_REL(a.a, b.a, UNIT_TOL(1e-18L, 1e-15L));
        CHECK_ABS(a.Fx, b.Fx, mu * 200, UNIT_TOL(1e-17L, 1e-14L));
        CHECK_ABS(a.dx, b.dx, slip, UNIT_TOL(1e-17L, 1e-14L));
        CHECK_ABS(a.U, b.U, mu * 200 * slip, UNIT_TOL(1e-17L, 1e-14L));
        CHECK_ABS(fret_memory_last_loss(fast), fret_memory_last_loss(slow),
                  fret_memory_last_loss(slow) + 1e-3L * mu * 200 * slip, UNIT_TOL(1e-16L, 1e-13L));
        CHECK_REL(a.W, b.W, UNIT_TOL(1e-17L, 1e-14L));
    }
    CHECK(fast->near && fast->moves >= 8 && (count < 50 || a.W > 0));
    /* a copy goes on as the original */
    fret_memory *copy;
    CHECK_OK(fret_memory_make(n, mu, &copy));
    CHECK_OK(fret_memory_copy(copy, fast));
    for (int i = 1; i < 20; i++) {
        const fret_step s = random_step(n, mu, &a, i);
        CHECK(fret_memory_step(fast, &s).code == fret_memory_step(copy, &s).code);
        fret_memory_state(fast, &a);
        fret_memory_state(copy, &b);
        CHECK(a.Fx == b.Fx && a.dx == b.dx && a.W == b.W && a.FN == b.FN && a.dz == b.dz);
    }
    fret_memory_free(fast);
    fret_memory_free(slow);
    fret_memory_free(copy);
}

/* Places are those of a law: a copy of a contact of another one has its own. */
static void other_law(void) {
    const unit_scene one = unit_make_scene(2, 0), two = unit_make_scene(3, 0.5);
    const fret_normal *n[2] = {unit_make_normal(&one), unit_make_normal(&two)};
    fret_memory *m[3];
    for (int i = 0; i < 3; i++) {
        CHECK_OK(fret_memory_make(n[i % 2], 0.3, &m[i]));
        for (int j = 0; j < 20; j++)
            CHECK_OK(fret_memory_step(m[i], &(fret_step){FRET_TO_FORCE, FRET_KEEP_DX, 50 + j, 0}));
    }
    CHECK_OK(fret_memory_copy(m[0], m[1]));
    CHECK(m[0]->near->normal == n[1]);
    for (int j = 0; j < 20; j++) {
        const fret_step s = {FRET_TO_FORCE, FRET_TO_FX, 60 + j, 0.3 * j};
        CHECK_OK(fret_memory_step(m[0], &s));
        CHECK_OK(fret_memory_step(m[1], &s));
    }
    CHECK(m[0]->edge[DEPTH] == m[1]->edge[DEPTH]);
    CHECK(fret_memory_total(m[0], DEPTH) == fret_memory_total(m[1], DEPTH));
    for (int i = 0; i < 3; i++)
        fret_memory_free(m[i]);
}

/* Where a depth, a load or a radius nears the ends of the range nothing is kept, and none of it is told. */
static void ends_of_range(void) {
    static const struct {
        double n, r0, y; /* y: a depth that is no such end itself */
        bool kept;
    } rows[] = {{2, 1e-3, 1e-6, true},
                {8, 5e-291, 1e-5, false},
                {8, 1e292, 1e-15, false},
                {2, 1e-3, 1e-280, false},
                {2, 1e-3, 1e250, false}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        unit_scene s = unit_make_scene(rows[i].n, 0);
        s.gap.power[0].r0 = rows[i].r0;
        const fret_normal *n = unit_make_normal(&s);
        fret_near near;
        CHECK(fret_near_fits(n));
        fret_near_make(n, &near);
        const fret_real v = fret_near_value(&near, DEPTH, rows[i].y);
        if (rows[i].kept)
            CHECK_REL(v, slow_value(n, DEPTH, rows[i].y), UNIT_TOL(1.2e-19L, 4e-16L));
        else
            CHECK(isnan(v));
    }
}

/* Of the brink of gross slip every digit counts: what the places leave out is found again. */
static void brink(void) {
    const unit_scene scene = unit_make_scene(2, 0.3);
    const fret_normal *n = unit_make_normal(&scene);
    for (int i = 0; i < 40; i++) {
        fret_memory *m[2];
        fret_state s[2];
        const double mu = 0.3, FN = 50 + i,
                     dx = (double)(mu * n->foundation.eta * fret_law_depth(n, FN)) * (1 - small(9));
        for (int j = 0; j < 2; j++) {
            CHECK_OK(fret_memory_make(n, mu, &m[j]));
            for (int k = 0; k < 20; k++) {
                CHECK_OK(fret_memory_step(
                    m[j], &(fret_step){FRET_TO_FORCE, FRET_KEEP_DX, FN * (k < 19 ? 0.5 + k / 50.0 : 1), 0}));
                if (j)
                    m[j]->moves = 0;
            }
            CHECK_OK(fret_memory_step(m[j], &(fret_step){FRET_KEEP_NORMAL, FRET_TO_DX, 0, dx}));
            fret_memory_state(m[j], &s[j]);
        }
        CHECK(m[0]->pressed_near && !m[1]->pressed_near);
        CHECK_REL(s[0].c, s[1].c, UNIT_TOL(1e-18L, 1e-6L));
        CHECK_REL(s[0].Fx, s[1].Fx, UNIT_TOL(1e-18L, 1e-14L));
        for (int j = 0; j < 2; j++)
            fret_memory_free(m[j]);
    }
}

int main(int argc, char **argv) {
    unit_start("near", argc, argv);
    static const double n[] = {0.7, 1, 2, 3, 100}, k[] = {-0.9, -0.5, 0, 0.3, 0.99};
    for (size_t i = 0; i < sizeof n / sizeof *n; i++)
        for (size_t j = 0; j < sizeof k / sizeof *k; j++) {
            const unit_scene s = unit_make_scene(n[i], k[j]);
            const fret_normal *normal = unit_make_normal(&s);
            fret_near near;
            CHECK(fret_near_fits(normal));
            fret_near_make(normal, &near);
            CASE(values(normal, &near));
            CASE(phases(normal, &near));
            CASE(histories(normal, unit_draws(2000)));
        }
    const unit_scene steep = unit_make_scene(0.1, 0.5);
    CHECK(!fret_near_fits(unit_make_normal(&steep)));
    CASE(other_law());
    CASE(brink());
    CASE(ends_of_range());
    return unit_finish();
}
