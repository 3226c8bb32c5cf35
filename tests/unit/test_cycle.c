/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "law/normal.h"
#include "unit.h"

static const double nan_ = (double)NAN, inf_ = (double)INFINITY;

static void reference(void) {
    unit_table t;
    if (!unit_open(&t, "scene.csv"))
        return;
    const fret_real tol = UNIT_TOL(2e-17L, 1e-14L);
    while (unit_row(&t)) {
        unit_scene s = unit_read_scene(&t, 0);
        double FN = unit_input(&t, UNIT_SCENE_COLUMNS), FA = unit_input(&t, UNIT_SCENE_COLUMNS + 1);
        const int out = UNIT_SCENE_COLUMNS + 2;
        fret_real c = unit_result(&t, out + 2), dx = unit_result(&t, out + 3), max = unit_result(&t, out + 4);
        fret_real dW = unit_result(&t, out + 5), U = unit_result(&t, out + 8), W = unit_result(&t, out + 9);
        fret_pressed k = unit_make_contact(&s, FN);
        fret_loading f, g;
        CHECK_OK(fret_loading_by_force(&k, FA, &f));
        CHECK(f.Fx == FA);
        CHECK_REL(f.c, c, tol);
        CHECK_REL(f.dx, dx, tol);
        CHECK_REL(fret_gross_slip(&k), max, tol);
        fret_real loss = -1, same = -1;
        CHECK_OK(fret_cycle_loss_by_force(&k, FA, &loss));
        CHECK_REL(loss, dW, tol);
        CHECK_REL(4 * W, dW, 1e-30L + UNIT_TOL(1e-18L, 1e-15L)); /* Masing, in the table itself */
        CHECK(U > 0);

        /* odd in the load */
        CHECK_OK(fret_loading_by_force(&k, -FA, &g));
        CHECK(g.Fx == -f.Fx && g.dx == -f.dx && g.c == f.c && g.yc == f.yc);
        CHECK_REL(fret_law_radius(k.normal, f.yc), f.c, tol * (1 + 1 / s.gap.power[0].n));

        /* and back by displacement; rounding dx to double moves F_x by k_n(c)/eta times as much */
        double dx_ = (double)f.dx;
        CHECK_OK(fret_loading_by_displacement(&k, dx_, &g));
        fret_real kt = fret_normal_stiffness(k.normal, f.c) / k.normal->foundation.eta;
        CHECK(g.dx == dx_);
        CHECK_REL(g.Fx, FA + kt * (dx_ - f.dx), UNIT_TOL(1e-15L, 1e-13L));
        /* c = 0 at gross slip: its error is that of delta_x,max-delta_x */
        fret_real left = 1 - f.dx / max;
        CHECK_REL(g.c, f.c, 1e-15L + (UNIT_TOL(1e-18L, 1e-15L) + 2.3e-16L) / (left * s.gap.power[0].n));
        CHECK_OK(fret_loading_by_displacement(&k, -dx_, &f));
        CHECK(f.Fx == -g.Fx && f.dx == -g.dx && f.c == g.c && f.yc == g.yc);
        /* loss by displacement: d ln(loss)/d ln(dx) is 3 at small dx, (p+1)/(p-1) at gross slip */
        CHECK_OK(fret_cycle_loss_by_displacement(&k, dx_, &same));
        CHECK_REL(same, dW, (3 + (k.normal->p + 1) / k.normal->pm1) * 1.2e-16L + tol);
    }
}

/* w(t) = loss/(mu F_N delta_x,max), with mu F_N = 1 N so that t is exact. */
static fret_real loss_shape(const fret_pressed *c, double t) {
    fret_real loss = -1;
    CHECK_OK(fret_cycle_loss_by_force(c, t, &loss));
    return loss / fret_gross_slip(c);
}

static fret_pressed contact_of(double n, double k) {
    unit_scene s = unit_make_scene(n, k);
    s.mu = 1;
    return unit_make_contact(&s, 1);
}

static void loss_shapes(void) {
    unit_table t;
    if (!unit_open(&t, "loss.csv"))
        return;
    while (unit_row(&t)) {
        const fret_pressed c = contact_of(unit_input(&t, 0), unit_input(&t, 1));
        CHECK_REL(loss_shape(&c, unit_input(&t, 2)), unit_result(&t, 3), UNIT_TOL(3e-18L, 3e-15L));
    }
    for (int i = 1; i < 40; i++) {
        const double n = i / (40.0 - i);
        const fret_pressed c = contact_of(n, 0);
        const fret_real r = 1 / (n + 1.0L), q = 1 - r;
        fret_real last = 0;
        CHECK(loss_shape(&c, 0) == 0);
        CHECK_REL(loss_shape(&c, 1), 4 * r / (1 + q), UNIT_TOL(1e-18L, 1e-15L));
        CHECK_REL(loss_shape(&c, 1e-9), 4 * q * r * 1e-27L / 6, 1e-8L);
        for (double x = 1.0 / 64; x <= 1; x += 1.0 / 64) { /* grows, also across the branches */
            fret_real w = loss_shape(&c, x);
            CHECK(w > last);
            last = w;
        }
    }
}

/* The definition: 8 mu^2 eta int_c^a c_N (g(a)-g(x)) (g(x)-g(c)) dx. */
typedef struct loop {
    const fret_pressed *k;
    fret_real c, yc;
} loop;

static fret_real loop_density(fret_real x, fret_real from, fret_real to, const void *context) {
    const loop *l = context;
    const fret_foundation *f = &l->k->normal->foundation;
    fret_real g = -1;
    (void)from, (void)to;
    fret_status st = fret_gap_g(&l->k->normal->gap, (double)f->k, x, &g, NULL);
    return st.code ? (fret_real)NAN : f->cN0 * powl(x / f->c0, f->k) * (l->k->press.dz - g) * (g - l->yc);
}

static void definition(void) {
    static const double ns[] = {0.7, 1, 2, 4}, ks[] = {-0.5, 0, 0.6};
    for (int i = 0; i < 12; i++) {
        unit_scene s = unit_make_scene(ns[i % 4], ks[i / 4]);
        fret_pressed k = unit_make_contact(&s, 25);
        for (double part = 0.2; part < 1; part += 0.25) {
            double FA = part * s.mu * 25;
            fret_loading f = {0, 0, 0, 0};
            fret_real loss = -1;
            CHECK_OK(fret_loading_by_force(&k, FA, &f));
            CHECK_OK(fret_cycle_loss_by_force(&k, FA, &loss));
            const loop l = {&k, f.c, f.yc};
            fret_real mu = k.mu, integral = unit_integrate(loop_density, &l, f.c, k.press.a);
            CHECK_REL(8 * mu * mu * k.normal->foundation.eta * integral, loss, UNIT_TOL(1e-14L, 1e-11L));
        }
    }
}

/* Two equal spheres, and one on a flat, homogeneous and graded: digits published apart from this code. */
static void published(void) {
    unit_scene s = unit_make_scene(2, 0);
    s.material.body[0] = s.material.body[1] = (fret_body){210e9, 0.3, false};
    s.mu = 0.3;
    s.gap.power[0] = (fret_power){2, 100, 1};
    fret_pressed k = unit_make_contact(&s, 100);
    fret_loading f = {0, 0, 0, 0};
    fret_real loss = -1;
    CHECK_OK(fret_loading_by_force(&k, 15, &f));
    CHECK_OK(fret_cycle_loss_by_force(&k, 15, &loss));
    CHECK_REL(f.c / k.press.a, 0.79370L, 1e-5L);
    CHECK_REL(f.dx, 0.591529e-6L, 1e-6L);
    CHECK_REL(loss, 1.35112e-6L, 3e-6L);
    static const fret_real want[2][5] = {
        {1.8662555784086241e-4L, 3.4829098839413082e-6L, 1.4812480342036853e-4L, 6.2599544191009847e-7L,
         1.9064562410875217e-6L},
        {3.0092451732927952e-4L, 6.0370376753239901e-6L, 2.4685902105474113e-4L, 1.6644632276036456e-6L,
         6.5235001018033792e-6L}};
    for (int i = 0; i < 2; i++) {
        s.mu = 0.4;
        s.material.k = i * 0.5;
        s.gap.power[0].h = 50;
        k = unit_make_contact(&s, 100);
        CHECK_OK(fret_loading_by_force(&k, 20, &f));
        CHECK_OK(fret_cycle_loss_by_force(&k, 20, &loss));
        /* 0.3 and 0.4 there are decimal, here double */
        CHECK_REL(k.press.a, want[i][0], 1e-15L);
        CHECK_REL(k.press.dz, want[i][1], 1e-15L);
        CHECK_REL(f.c, want[i][2], 1e-15L);
        CHECK_REL(f.dx, want[i][3], 1e-15L);
        CHECK_REL(loss, want[i][4], 1e-15L);
    }
}

static void gross_slip(void) {
    unit_scene s = unit_make_scene(2, 0.4);
    s.mu = 0.5; /* mu F_N exact */
    fret_pressed k = unit_make_contact(&s, 64);
    fret_real max = fret_gross_slip(&k), loss = -1, more = -1;
    fret_loading f = {0, 0, 0, 0};
    CHECK_OK(fret_loading_by_force(&k, 32, &f));
    CHECK(f.c == 0 && f.yc == 0);
    CHECK_REL(f.dx, max, UNIT_TOL(1e-18L, 1e-15L));
    CHECK_OK(fret_loading_by_force(&k, -32, &f));
    CHECK(f.c == 0 && f.dx < 0);
    fret_status st = fret_loading_by_force(&k, 32 * (1 + 5e-16), &f);
    CHECK_ERROR(st, FRET_GROSS_SLIP, "Fx");
    CHECK(st.limit == 32 && st.value > 32);
    unit_scene sum = unit_make_scene(2, 0.4); /* where no closed form holds */
    sum.gap.kind = FRET_GAP_SUM;
    sum.gap.terms = 2;
    sum.gap.power[1] = (fret_power){4, 1e-5, 1e-3};
    sum.mu = 0.5;
    const fret_pressed of_sum = unit_make_contact(&sum, 64);
    CHECK(!fret_normal_closed(of_sum.normal));
    for (int sign = -1; sign <= 1; sign += 2) {
        CHECK_OK(fret_loading_by_force(&of_sum, sign * 32, &f));
        CHECK(f.c == 0 && f.yc == 0);
        CHECK_REL(f.dx, sign * fret_gross_slip(&of_sum), UNIT_TOL(1e-18L, 1e-15L));
    }
    CHECK_CODE(fret_loading_by_force(&k, -32.5, &f), FRET_GROSS_SLIP);
    CHECK_OK(fret_loading_by_displacement(&k, 3 * (double)max, &f));
    CHECK(f.Fx == 32 && f.c == 0 && f.dx == 3 * (double)max);
    CHECK_OK(fret_loading_by_displacement(&k, -3 * (double)max, &f));
    CHECK(f.Fx == -32 && f.c == 0);

    CHECK_OK(fret_cycle_loss_by_force(&k, 32, &loss));
    CHECK_REL(loss, 4 * k.normal->pm1 * k.normal->q / (1 + k.normal->q) * 32 * max, UNIT_TOL(2e-18L, 3e-15L));
    CHECK_CODE(fret_cycle_loss_by_force(&k, 32.5, &more), FRET_GROSS_SLIP);
    double dA = 2.5 * (double)max;
    CHECK_OK(fret_cycle_loss_by_displacement(&k, dA, &more));
    CHECK_REL(more, loss + 4 * 32 * (dA - max), UNIT_TOL(2e-18L, 3e-15L));
    /* continuous at the onset */
    CHECK_OK(fret_cycle_loss_by_displacement(&k, (double)max * (1 - 1e-9), &more));
    CHECK_REL(more, loss, 1e-8L);
    CHECK_OK(fret_cycle_loss_by_displacement(&k, (double)max * (1 + 1e-9), &more));
    CHECK_REL(more, loss, 1e-8L);
    /* a limit that is no double: 0.1 * 0.3 carries a rounding that must not shut out the last force */
    s.mu = 0.1;
    k = unit_make_contact(&s, 0.3);
    fret_real limit = (fret_real)0.1 * 0.3;
    double inside = (double)limit;
    while (inside > limit)
        inside = nextafter(inside, 0);
    CHECK_OK(fret_loading_by_force(&k, inside, &f));
    CHECK_CODE(fret_loading_by_force(&k, inside * (1 + 5e-16), &f), FRET_GROSS_SLIP);
    CHECK_OK(fret_loading_by_force(&k, 0, &f));
    CHECK(f.dx == 0 && f.Fx == 0 && f.c == k.press.a && f.yc == k.press.dz);
    CHECK_OK(fret_cycle_loss_by_force(&k, 0, &loss));
    CHECK(loss == 0);
    CHECK_OK(fret_cycle_loss_by_displacement(&k, 0, &loss));
    CHECK(loss == 0);
}

static void errors(void) {
    unit_scene s = unit_make_scene(2, 0.4);
    fret_pressed k = unit_make_contact(&s, 10);
    const double wild[] = {nan_, inf_, -inf_};
    fret_loading f = {7, 7, 7, 7};
    fret_real loss = 7;
    for (int i = 0; i < 3; i++) {
        CHECK_ERROR(fret_loading_by_force(&k, wild[i], &f), FRET_NOT_FINITE, "Fx");
        CHECK_ERROR(fret_loading_by_displacement(&k, wild[i], &f), FRET_NOT_FINITE, "dx");
        CHECK_CODE(fret_cycle_loss_by_force(&k, wild[i], &loss), FRET_NOT_FINITE);
        CHECK_CODE(fret_cycle_loss_by_displacement(&k, wild[i], &loss), FRET_NOT_FINITE);
    }
    const double bad[] = {nan_, inf_, -inf_, 0, -1};
    for (int i = 0; i < 5; i++) {
        const fret_pressed rough = {k.normal, bad[i], k.press};
        const fret_code code = i < 3 ? FRET_NOT_FINITE : FRET_NOT_POSITIVE;
        CHECK_ERROR(fret_loading_by_force(&rough, 1, &f), code, "mu");
        CHECK_ERROR(fret_loading_by_displacement(&rough, 1e-6, &f), code, "mu");
        CHECK_ERROR(fret_cycle_loss_by_force(&rough, 1, &loss), code, "mu");
        CHECK_ERROR(fret_cycle_loss_by_displacement(&rough, 1e-6, &loss), code, "mu");
    }
    CHECK_CODE(fret_cycle_loss_by_force(&k, -1, &loss), FRET_NEGATIVE);
    CHECK_CODE(fret_cycle_loss_by_displacement(&k, -1e-6, &loss), FRET_NEGATIVE);
    CHECK(f.Fx == 7 && f.dx == 7 && f.c == 7 && f.yc == 7 && loss == 7); /* untouched */
    /* an open contact carries no tangential load */
    fret_press open = {.F = 0};
    CHECK(fret_gross_slip(&(fret_pressed){k.normal, k.mu, open}) == 0);
    CHECK(fret_loading_by_force(&(fret_pressed){k.normal, k.mu, open}, 1, &f).code != FRET_OK);
}

int main(int argc, char **argv) {
    unit_start("cycle", argc, argv);
    CASE(reference());
    CASE(loss_shapes());
    CASE(definition());
    CASE(published());
    CASE(gross_slip());
    CASE(errors());
    return unit_finish();
}
