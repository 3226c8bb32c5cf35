/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Wear: what cycles leave of a gap, against the work of friction, fields and the closed form of the limit. */
#include "fret/contact.h"
#include "fret/cycle.h"
#include "fret/field.h"
#include "fret/wear.h"

#include "law/gap.h"
#include "law/normal.h"

#include "failing.h"
#include "unit.h"

static const fret_gap shapes[] = {
    {.kind = FRET_GAP_POWER, .terms = 1, .power = {{2, 50, 1}}},
    {.kind = FRET_GAP_POWER, .terms = 1, .power = {{1, 0.02, 1}}},
    {.kind = FRET_GAP_FLAT_ROUNDED, .b = 1e-4, .R = 0.01},
    {.kind = FRET_GAP_SUM, .terms = 2, .power = {{2, 5e-5, 1e-3}, {4, 1e-5, 5e-4}}},
    {.kind = FRET_GAP_FLAT_CONE, .b = 1e-4, .slope = 0.02},
    {.kind = FRET_GAP_TABLE}, /* of the sphere */
};
enum { SPHERE, CONE, ROUNDED, SUM, FLAT_CONE, TABLE, SHAPES };
static struct fret_table *sampled;

static const double depth = 3.5e-6, alpha = 1e-14, mu = 0.4;

static fret_normal *normal_of(int shape, double k) {
    const fret_material material = {{{210e9, 0.3, false}, {210e9, 0.3, false}}, k, 1e-3};
    fret_gap gap = shapes[shape];
    if (shape == TABLE)
        gap.table = sampled;
    return unit_keep_normal(&material, &gap);
}

/* `part`: the root of the depth that sticks at first, by delta_z; or < 0: of delta_x,max. */
static fret_wear_held hold(const fret_normal *n, bool by_depth, bool by_displacement, double part) {
    fret_pressed contact = {.normal = n, .mu = mu};
    fret_press inner;
    fret_wear_held held = {by_depth, by_displacement, depth, 0, mu, alpha};
    CHECK_OK(fret_press_by_depth(n, depth, &contact.press));
    CHECK_OK(fret_press_by_depth(n, part * part * depth, &inner));
    held.press = by_depth ? depth : (double)contact.press.F;
    if (part < 0)
        held.amplitude = -part * (double)fret_gross_slip(&contact);
    else if (by_displacement)
        held.amplitude = mu * (double)(fret_normal_foundation(n)->eta * (contact.press.dz - inner.dz));
    else
        held.amplitude = mu * (double)(contact.press.F - inner.F);
    return held;
}

static fret_wear_run *begin(const fret_normal *n, const fret_wear_held *held, double tolerance) {
    fret_wear_run *r = NULL;
    CHECK_OK(fret_wear_run_make(n, held, tolerance, &r));
    return r;
}

static fret_wear *after(fret_wear_run *r, double cycles) {
    fret_wear *w = NULL;
    CHECK_OK(fret_wear_after(r, cycles, NULL, NULL, &w));
    return w;
}

static fret_wear *run(const fret_normal *n, const fret_wear_held *held, double cycles, double tolerance) {
    fret_wear_run *r = begin(n, held, tolerance);
    fret_wear *w = after(r, cycles);
    fret_wear_run_free(r);
    return w;
}

static fret_pressed press(const fret_normal *n, const fret_wear_held *held) {
    fret_pressed c = {.normal = n, .mu = mu};
    CHECK_OK(held->by_depth ? fret_press_by_depth(c.normal, held->press, &c.press)
                            : fret_press_by_force(c.normal, held->press, &c.press));
    return c;
}

static fret_pressed press_worn(const fret_wear *w, const fret_wear_held *held) {
    return press(fret_wear_law(w), held);
}

static fret_real loss_of(const fret_pressed *contact, const fret_wear_held *held) {
    fret_real loss = 0;
    CHECK_OK(held->by_displacement ? fret_cycle_loss_by_displacement(contact, held->amplitude, &loss)
                                   : fret_cycle_loss_by_force(contact, held->amplitude, &loss));
    return loss;
}

/* ---- the limit --------------------------------------------------------------------------------- */

/* References of 25 digits. */
static void limits_of_spheres(void) {
    static const double k[] = {0, 0.3, -0.3}, a[] = {0.187082869339e-3, 0.213307290077e-3, 0.156524758425e-3},
                        b[] = {1.1872319986, 1.12436316892, 1.25781980528},
                        V[] = {5.625306806e-14, 8.480688083e-14, 3.111286034e-14};
    for (int i = 0; i < 3; i++) {
        const fret_normal *n = normal_of(SPHERE, k[i]);
        const fret_wear_held held = hold(n, true, true, 0.6);
        fret_wear *w = NULL;
        fret_press press;
        fret_real inner, outer;
        CHECK_OK(fret_press_by_depth(n, depth, &press));
        CHECK_REL(press.a, a[i], 1e-11L);
        CHECK_OK(fret_wear_limit(n, &held, &w));
        fret_wear_ring(w, &inner, &outer);
        CHECK_REL(inner, 0.6L * press.a, 1e-14L);
        CHECK_REL(outer, b[i] * press.a, 1e-10L);
        CHECK_REL(fret_wear_volume(w), V[i], 1e-9L);
        CHECK(isinf(fret_wear_cycles(w)) && isnan(fret_wear_work(w)));
        fret_wear_free(w);
    }
}

/* k = 0: the surface of a contact that ends at c, pressed on as a flat punch, and what is held. */
static void limits_by_surfaces(void) {
    for (int shape = 0; shape < SHAPES; shape++)
        for (int by = 0; by < 4; by++) {
            const fret_normal *n = normal_of(shape, 0);
            const fret_wear_held held = hold(n, by & 1, by & 2, 0.9);
            fret_wear *w = NULL;
            fret_field *field = NULL;
            fret_press stuck;
            fret_real inner, outer, h;
            CHECK_OK(fret_wear_limit(n, &held, &w));
            if (!w)
                continue;
            fret_wear_ring(w, &inner, &outer);
            CHECK_OK(fret_press_by_radius(n, (double)inner, &stuck));
            const fret_real stiff = fret_normal_stiffness(n, inner), eta = fret_normal_foundation(n)->eta,
                            more = by & 2 ? held.amplitude / (mu * eta) : held.amplitude / (mu * stiff);
            if (by & 1)
                CHECK_REL(stuck.dz + more, held.press, 1e-13L);
            else
                CHECK_REL(stuck.F + stiff * more, held.press, 1e-13L);
            CHECK_OK(fret_field_of_press(n, &stuck, &field));
            for (int i = 1; i < 8; i++) {
                const fret_real r = inner + (outer - inner) * i / 8;
                fret_real surface, gap;
                CHECK_OK(fret_field_surface(field, r, &surface));
                CHECK_OK(fret_gap_f(fret_normal_gap(n), r, &gap));
                CHECK_OK(fret_wear_depth(w, r, &h));
                CHECK_ABS(h, stuck.dz + more - surface - more * 2 / acosl(-1) * asinl(inner / r) - gap, depth,
                          1e-13L);
            }
            CHECK_OK(fret_wear_depth(w, inner * 0.99L, &h));
            CHECK(h == 0);
            CHECK_OK(fret_wear_depth(w, outer * 1.01L, &h));
            CHECK(h == 0);
            fret_field_free(field);
            fret_wear_free(w);
        }
}

/* The contact of the limit ends at c, whatever k: it carries what is held, and loses nothing any more. */
static void limits_press(void) {
    static const double ks[] = {0, 0.6, -0.4, -0.7};
    for (int shape = 0; shape < SHAPES; shape++)
        for (int by = 0; by < 8; by++) {
            const fret_normal *n = normal_of(shape, ks[by / 2]);
            const fret_wear_held held = hold(n, by & 1, by & 1, 0.8);
            fret_wear *w = NULL;
            fret_press stuck;
            fret_real inner, outer;
            CHECK_OK(fret_wear_limit(n, &held, &w));
            if (!w)
                continue;
            fret_wear_ring(w, &inner, &outer);
            CHECK_OK(fret_press_by_radius(n, (double)inner, &stuck));
            const fret_pressed c = press_worn(w, &held);
            const fret_foundation *of = fret_normal_foundation(n);
            const fret_real more = c.press.dz - stuck.dz, r = inner * 0.7L;
            fret_pressed unworn = {n, mu, {.F = 0}};
            fret_field *field = NULL, *flat = NULL;
            fret_real p = 0, of_stuck = 0;
            CHECK_OK(by & 1 ? fret_press_by_depth(n, held.press, &unworn.press)
                            : fret_press_by_force(n, held.press, &unworn.press));
            CHECK_REL(c.press.F, stuck.F + fret_normal_stiffness(n, inner) * more, 1e-8L);
            CHECK_REL(c.press.a, inner, 1e-8L);
            CHECK(loss_of(&c, &held) < 1e-6L * loss_of(&unworn, &held));
            CHECK_OK(fret_field_of_press(c.normal, &c.press, &field));
            CHECK_OK(fret_field_of_press(n, &stuck, &flat));
            CHECK_OK(fret_field_pressure(field, r, &p));
            CHECK_OK(fret_field_pressure(flat, r, &of_stuck));
            CHECK_REL(p,
                      of_stuck + of->cN0 * powl(of->c0, -of->k) / acosl(-1) * more *
                                     powl((inner - r) * (inner + r), (of->k - 1) / 2),
                      1e-8L);
            fret_field_free(flat);
            fret_field_free(field);
            fret_wear_free(w);
        }
}

/* What is run arrives there, and presses there as the limit does. */
static void arrivals(void) {
    for (int shape = 0; shape < SHAPES; shape++)
        for (int by = 0; by < 3; by++) { /* F_N and F_A, depth and delta_A, depth and F_A */
            if (unit_skips((size_t)shape))
                continue;
            const fret_normal *n = normal_of(shape, shape == CONE ? 0.1 : shape == FLAT_CONE ? -0.2 : 0);
            const fret_wear_held held = hold(n, by > 0, by == 1, by == 2 ? 0.95 : 0.7);
            fret_wear *w = run(n, &held, 1e9, 3e-3), *limit = NULL;
            fret_real c, b, inner, outer;
            CHECK_OK(fret_wear_limit(n, &held, &limit));
            fret_wear_ring(w, &c, &b);
            fret_wear_ring(limit, &inner, &outer);
            CHECK_REL(c, inner, 1e-6L);
            CHECK_REL(b, outer, 0.01L);
            CHECK_REL(press_worn(w, &held).press.a, outer, 0.01L);
            CHECK_REL(fret_wear_volume(w), fret_wear_volume(limit), 4e-3L);
            fret_wear_free(w);
            fret_wear_free(limit);
        }
}

/* ---- cycles ------------------------------------------------------------------------------------ */

/* One cycle: alpha 4 mu p s at each place, alpha dW in all. */
static void single_cycles(void) {
    static const double ks[] = {0, 0.3, -0.3}, parts[] = {0.3, 0.9, -1.4};
    for (int shape = 0; shape < SHAPES; shape++)
        for (int i = 0; i < 3; i++)
            for (int j = 0; j < 3; j++) {
                const fret_normal *n = normal_of(shape, ks[i]);
                const fret_wear_held held = hold(n, false, true, parts[j]);
                fret_contact *contact = NULL;
                fret_field *field = NULL;
                fret_state at;
                fret_wear *w = run(n, &held, 1, 1e-3);
                fret_real inner, outer;
                const fret_pressed c = {n, mu, press_worn(w, &held).press};
                fret_real most = 0;
                CHECK_REL(fret_wear_volume(w), alpha * loss_of(&c, &held), 1e-3L);
                CHECK_REL(alpha * fret_wear_work(w), alpha * loss_of(&c, &held), 1e-3L);
                CHECK_OK(fret_contact_make(n, mu, FRET_EXACT, &contact));
                CHECK_OK(fret_contact_step(contact,
                                           &(fret_step){.normal_by = FRET_TO_FORCE, .normal = held.press}));
                CHECK_OK(fret_contact_step(
                    contact, &(fret_step){.tangential_by = FRET_TO_DX, .tangential = held.amplitude}));
                CHECK_OK(fret_field_make(contact, &field));
                fret_contact_state(contact, &at);
                fret_wear_ring(w, &inner, &outer);
                CHECK_ABS(inner, at.c, at.a, 0.01L);
                CHECK_REL(outer, at.a, 0.02L);
                for (int m = 19; m > 0; m--) { /* where neither begins nor ends steeply, nor has an edge */
                    const fret_real r = at.c + (at.a - at.c) * m / 20, b = shapes[shape].b;
                    fret_real p, s, h;
                    CHECK_OK(fret_field_pressure(field, r, &p));
                    CHECK_OK(fret_field_slip(field, r, &s));
                    CHECK_OK(fret_wear_depth(w, r, &h));
                    most = fmaxl(most, alpha * 4 * mu * p * s);
                    if (m > 3 && m < 16 && !(shape == FLAT_CONE && fabsl(r - b) < 0.03L * b))
                        CHECK_ABS(h, alpha * 4 * mu * p * s, most, 0.01L);
                }
                fret_field_free(field);
                fret_contact_free(contact);
                fret_wear_free(w);
            }
}

/* The volume is alpha times the work, that of the closed cycles of the worn gap on the way, by Simpson; so is
 * that of a part of the way. */
static void volumes_and_work(void) {
    for (int shape = 0; shape < SHAPES; shape++)
        for (int by = 0; by < 4; by++) {
            enum { PARTS = 8 };
            if (unit_skips((size_t)shape))
                continue;
            const fret_normal *n = normal_of(shape, shape == SUM ? 0.2 : 0);
            /* both forces, both ways, or gross slip */
            const fret_wear_held held = hold(n, by & 1, by > 0, by > 1 ? -1.3 : 0.6);
            const double cycles = by > 1 ? 2e3 : 2e4;
            fret_wear_run *r = begin(n, &held, 1e-3);
            const fret_pressed unworn = press(n, &held);
            fret_real sum = loss_of(&unworn, &held);
            for (int i = 1; i <= PARTS; i++) {
                fret_wear *w = after(r, cycles * i / (double)PARTS);
                const fret_pressed c = press_worn(w, &held);
                CHECK(fret_wear_cycles(w) == cycles * i / (double)PARTS);
                CHECK_REL(fret_wear_volume(w), alpha * fret_wear_work(w), 1.3e-3L);
                if (i % 2 == 0)
                    CHECK_REL(fret_wear_work(w), (sum + loss_of(&c, &held)) * cycles / (3 * PARTS), 2e-3L);
                sum += (i % 2 ? 4 : 2) * loss_of(&c, &held);
                fret_wear_free(w);
            }
            fret_wear_run_free(r);
        }
}

/* g' beside differences of g, of a place that is none of its nodes. */
static void check_slope(const fret_normal *law, fret_real x) {
    const fret_real h = 1e-8L * x, up = fret_normal_profile(law, x + h),
                    down = fret_normal_profile(law, x - h), e = x - fret_gap_start(&law->gap);
    if (e > h)
        CHECK_ABS(fret_gap_profile(&law->gap, &law->rule, e).slope, (up - down) / (2 * h), depth / x, 1e-6L);
}

/* The law is that of the gap: g as the transform of f by a table of many rows; the field carries F_N; and
 * what is worn on, of the gap that was worn before, is as much as at once. */
static void worn_gaps(void) {
    enum { ROWS = 1501 };
    static double r[ROWS], f[ROWS];
    for (int shape = 0; shape < TABLE; shape++)
        for (int gross = 0; gross < 2; gross++) {
            if (unit_skips((size_t)(shape + 3 * gross)))
                continue;
            const double k = gross ? -0.3 : shape == CONE ? 0.3 : 0;
            const fret_normal *n = normal_of(shape, k);
            const fret_wear_held held = hold(n, false, true, gross ? -1.3 : 0.6);
            const double cycles = gross ? 5e3 : 5e4;
            fret_wear *w = run(n, &held, cycles, 1e-3), *more = run(fret_wear_law(w), &held, 1e4, 1e-3),
                      *whole = run(n, &held, cycles + 1e4, 1e-3);
            const fret_normal *law = fret_wear_law(w);
            struct fret_table *table = NULL;
            fret_real inner, outer, at, p, load = 0, depth_at, unworn;
            fret_wear_ring(w, &inner, &outer);
            for (int i = 0; i < ROWS; i++) { /* closest where h begins */
                const double first = inner > 0 ? 300 : 0, within = i < first ? i / first : 1,
                             beyond = i < first ? 0 : (i - first) / (ROWS - 1 - first);
                r[i] = (double)(within * inner + beyond * beyond * (1.5L * outer - inner));
                CHECK_OK(fret_gap_f(fret_normal_gap(law), r[i], &at));
                f[i] = (double)at;
            }
            CHECK_OK(fret_gap_f(fret_normal_gap(n), outer / 2, &unworn));
            CHECK_OK(fret_gap_f(fret_normal_gap(law), outer / 2, &at));
            CHECK_OK(fret_wear_depth(w, outer / 2, &depth_at));
            at -= unworn + depth_at;
            CHECK_OK(fret_wear_depth(w, 0, &depth_at));
            CHECK_ABS(at, -depth_at, depth, 1e-14L);
            CHECK_OK(fret_table_make(r, f, ROWS, NULL, &table));
            const fret_gap gap = {.kind = FRET_GAP_TABLE, .table = table};
            for (int i = 1; i < 14; i++) {
                const fret_real x = outer * i / 10;
                fret_real g;
                CHECK_OK(fret_gap_g(&gap, k, x, &g, NULL));
                if (i != 10) /* where what has worn ends, between two nodes */
                    CHECK_ABS(fret_normal_profile(law, x), g, depth, shape == FLAT_CONE ? 5e-3L : 2e-3L);
                CHECK_OK(fret_gap_g(fret_normal_gap(law), k, x, &g, NULL));
                CHECK_ABS(fret_normal_profile(law, x), g, depth, 1e-14L);
                check_slope(law, x + 1e-3L * outer);
            }
            const fret_pressed c = press_worn(w, &held);
            fret_field *field = NULL;
            CHECK_OK(fret_field_of_press(law, &c.press, &field));
            for (int i = 0; i < 4000; i++) {
                CHECK_OK(fret_field_pressure(field, c.press.a * sqrtl((i + 0.5L) / 4000), &p));
                load += p * acosl(-1) * c.press.a * c.press.a / 4000;
            }
            CHECK_REL(load, c.press.F, shape == FLAT_CONE ? 1e-2L : 1e-4L);
            CHECK_REL(fret_wear_volume(w) + fret_wear_volume(more), fret_wear_volume(whole), 1e-3L);
            fret_field_free(field);
            fret_table_free(table);
            fret_wear_free(more); /* borrows the law of w */
            fret_wear_free(whole);
            fret_wear_free(w);
        }
}

/* A tip that has slipped and worn away: its contact loses what the run goes on with. */
static void worn_tips(void) {
    for (int by = 0; by < 6; by++) {
        if (unit_skips((size_t)by))
            continue;
        const fret_normal *n = normal_of(by < 3 ? CONE : FLAT_CONE, by % 3 * 0.3 - 0.3);
        const fret_wear_held held = hold(n, by & 1, true, -1.3);
        fret_wear_run *r = begin(n, &held, 2e-3);
        fret_wear *w = after(r, 1e5), *on = after(r, 1e5 + 1);
        const fret_pressed c = press_worn(w, &held);
        fret_real h;
        CHECK_OK(fret_wear_depth(w, 0, &h));
        CHECK(h > 0.2L * depth);
        CHECK_REL(fret_wear_volume(w), alpha * fret_wear_work(w), 1.3L * 2e-3L);
        CHECK_REL(loss_of(&c, &held), fret_wear_work(on) - fret_wear_work(w), 1e-3L);
        fret_wear_free(on);
        fret_wear_free(w);
        fret_wear_run_free(r);
    }
}

/* Errors are a small part of the tolerance, whichever it is. */
static void tolerances(void) {
    for (int by = 0; by < 4; by++) {
        if (unit_skips((size_t)by))
            continue;
        const fret_normal *n = normal_of(SPHERE, 0);
        const fret_wear_held held = hold(n, by & 1, by & 2, 0.6);
        fret_real V[3], off[2];
        static const double tolerance[] = {1.6e-2, 2e-3, 2.5e-4};
        for (int i = 0; i < 3; i++) {
            fret_wear *w = run(n, &held, 5e4, tolerance[i]);
            V[i] = fret_wear_volume(w);
            CHECK_ABS(alpha * fret_wear_work(w), V[i], V[i], 1.2L * tolerance[i]);
            fret_wear_free(w);
        }
        off[0] = fabsl(V[0] - V[2]) / V[2];
        off[1] = fabsl(V[1] - V[2]) / V[2];
        CHECK(off[0] < tolerance[0] / 25 && off[1] < tolerance[1] / 25);
    }
}

/* The radius that sticks: held by both forces or both ways it stays, else it grows or shrinks. */
static void stick_radii(void) {
    for (int by = 0; by < 4; by++) {
        const fret_normal *n = normal_of(SPHERE, 0.2);
        const fret_wear_held held = hold(n, by & 1, by & 2, 0.8);
        fret_wear *w = run(n, &held, 2e5, 1e-3);
        const fret_pressed c[] = {press(n, &held), press_worn(w, &held)};
        fret_loading turn[2];
        for (int i = 0; i < 2; i++)
            CHECK_OK(held.by_displacement ? fret_loading_by_displacement(&c[i], held.amplitude, &turn[i])
                                          : fret_loading_by_force(&c[i], held.amplitude, &turn[i]));
        if (by == 0 || by == 3)
            CHECK_REL(turn[1].c, turn[0].c, 1e-3L);
        else
            CHECK(by == 2 ? turn[1].c > 1.005L * turn[0].c : turn[1].c < 0.995L * turn[0].c);
        fret_wear_free(w);
    }
}

/* F_N and delta_A held, what sticks grows into what has worn and leaves it as it is. References by other
 * elements: of 0.6, quadratic in r^2 and with quadratures of both transforms, in implicit steps, extrapolated
 * from 137 and 205 nodes, to 3e-4; of 0.95 delta_x,max, straight in r and with edges a and c between nodes,
 * in steps of Heun, extrapolated from 100 to 800 nodes, to 1e-3, later to 3e-3 and 6e-3. */
static void growing_stick(void) {
    static const struct {
        double part, cycles, V, c, off;
    } rows[] = {{0.6, 1e5, 1.2148e-14, 4.3701e-5, 1},   {0.6, 1e6, 1.1044e-13, 4.4021e-5, 1},
                {0.6, 1e7, 1.6355e-13, 4.4021e-5, 1},   {-0.95, 1e5, 4.3777e-14, 1.1530e-5, 1},
                {-0.95, 1e6, 6.0900e-13, 1.1540e-5, 3}, {-0.95, 1e7, 4.5000e-12, 1.1550e-5, 5}};
    const fret_normal *n = normal_of(CONE, 0);
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        const fret_wear_held held = hold(n, false, true, rows[i].part);
        fret_wear *w = run(n, &held, rows[i].cycles, 1e-3);
        const fret_pressed worn = press_worn(w, &held);
        fret_loading turn;
        CHECK_REL(fret_wear_volume(w), rows[i].V, rows[i].off * 2e-3L);
        CHECK_OK(fret_loading_by_displacement(&worn, held.amplitude, &turn));
        CHECK_REL(turn.c, rows[i].c, rows[i].off * 1e-3L);
        CHECK(worn.press.a > (rows[i].cycles > 1e5 ? 1.8L : 1.2L) * press(n, &held).press.a);
        fret_wear_free(w);
    }
}

/* The same to the last bit whatever has been asked before, within a block, at the end of one or beyond; and
 * smooth from block to block, and from ring to ring. */
static void orders(void) {
    for (int gross = 0; gross < 2; gross++) {
        if (unit_skips((size_t)gross))
            continue;
        const fret_normal *n = normal_of(SPHERE, gross ? -0.2 : 0);
        const fret_wear_held held = hold(n, false, true, gross ? -1.2 : 0.6);
        static const double cycles[] = {3e3, 4e4, 10, 3e3, 4e4, 1e3, 0};
        fret_wear_run *all = begin(n, &held, 1e-3);
        fret_real before = 0;
        for (int i = 0; i < 7; i++) {
            fret_wear *w = after(all, cycles[i]), *alone = run(n, &held, cycles[i], 1e-3);
            fret_real h, other;
            CHECK(fret_wear_volume(w) == fret_wear_volume(alone) &&
                  fret_wear_work(w) == fret_wear_work(alone));
            for (int j = 0; j < 30; j++) {
                CHECK_OK(fret_wear_depth(w, 1e-5L * j, &h));
                CHECK_OK(fret_wear_depth(alone, 1e-5L * j, &other));
                CHECK(h == other);
            }
            fret_wear_free(alone);
            fret_wear_free(w);
        }
        for (double at = 1e2; at < 4e4; at *= 1.02) {
            fret_wear *w = after(all, at);
            const fret_pressed c = press_worn(w, &held);
            const fret_real loss = loss_of(&c, &held);
            if (before > 0)
                CHECK_REL(loss, before, 0.02L);
            before = loss;
            fret_wear_free(w);
        }
        fret_wear_run_free(all);
    }
}

/* An amplitude of nothing wears nothing, in no cycles and in the end. */
static void nothing_worn(void) {
    for (int by = 0; by < 8; by++) {
        const fret_normal *n = normal_of(by < 4 ? SPHERE : FLAT_CONE, 0);
        fret_wear_held held = hold(n, by & 1, by & 2, 0.9);
        fret_real inner, outer;
        held.amplitude = 0;
        fret_wear *w = run(n, &held, 1e5, 1e-3), *limit = NULL;
        CHECK_OK(fret_wear_limit(n, &held, &limit));
        CHECK(fret_wear_volume(w) == 0 && fret_wear_work(w) == 0 && fret_wear_cycles(w) == 1e5);
        CHECK(fret_wear_volume(limit) == 0);
        fret_wear_ring(w, &inner, &outer);
        CHECK(inner == 0 && outer == 0);
        CHECK_REL(press_worn(w, &held).press.dz, depth, 1e-9L);
        CHECK_REL(press_worn(limit, &held).press.dz, depth, 1e-9L);
        fret_wear_free(limit);
        fret_wear_free(w);
    }
}

/* ---- what cannot be ---------------------------------------------------------------------------- */

static void refusals(void) {
    const fret_normal *n = normal_of(SPHERE, 0);
    const fret_gap flat = {.kind = FRET_GAP_FLAT, .b = 1e-4};
    const fret_material material = {{{210e9, 0.3, false}, {210e9, 0.3, true}}, 0, 1e-3};
    const fret_wear_held held = hold(n, false, false, 0.6);
    fret_wear_held bad = held;
    fret_wear_run *r = begin(n, &held, 1e-2), *none = NULL;
    fret_wear *w = NULL, *limit = NULL;
    fret_real h;
    CHECK_ERROR(fret_wear_after(r, -1, NULL, NULL, &w), FRET_NEGATIVE, "cycles");
    CHECK_ERROR(fret_wear_after(r, (double)NAN, NULL, NULL, &w), FRET_NOT_FINITE, "cycles");
    CHECK_ERROR(fret_wear_run_make(n, &held, 1e-9, &none), FRET_OUTSIDE, "tolerance");
    CHECK_ERROR(fret_wear_run_make(unit_keep_normal(&material, &flat), &held, 1e-3, &none), FRET_SINGULAR,
                "r");
    bad.press = 0;
    CHECK_ERROR(fret_wear_run_make(n, &bad, 1e-3, &none), FRET_NOT_POSITIVE, "FN");
    bad.by_depth = true;
    CHECK_ERROR(fret_wear_limit(n, &bad, &limit), FRET_NOT_POSITIVE, "dz");
    bad = held;
    bad.mu = -1;
    CHECK_ERROR(fret_wear_run_make(n, &bad, 1e-3, &none), FRET_NOT_POSITIVE, "mu");
    bad = held;
    bad.alpha = 0;
    CHECK_ERROR(fret_wear_run_make(n, &bad, 1e-3, &none), FRET_NOT_POSITIVE, "alpha");
    bad = held;
    bad.amplitude = 1.01 * mu * held.press;
    CHECK_CODE(fret_wear_run_make(n, &bad, 1e-3, &none), FRET_GROSS_SLIP);
    CHECK_CODE(fret_wear_limit(n, &bad, &limit), FRET_GROSS_SLIP);
    for (int by = 0; by < 2; by++) {
        bad = hold(n, by, true, -1.2);
        CHECK_CODE(fret_wear_limit(n, &bad, &limit), FRET_GROSS_SLIP);
    }
    fret_wear_run_free(r);
    bad = hold(n, true, false, 0.2); /* F_N falls until nothing sticks: up to there the run stands */
    r = begin(n, &bad, 1e-2);
    CHECK_CODE(fret_wear_after(r, 1e8, NULL, NULL, &w), FRET_GROSS_SLIP);
    CHECK_CODE(fret_wear_after(r, 1e8, NULL, NULL, &w), FRET_GROSS_SLIP);
    CHECK(none == NULL && limit == NULL && w == NULL);
    w = after(r, 100);
    CHECK(fret_wear_volume(w) > 0);
    CHECK_ERROR(fret_wear_depth(w, -1, &h), FRET_NEGATIVE, "r");
    fret_wear_free(w);
    fret_wear_run_free(r);
}

/* The gap ends before the wear does. */
static void short_tables(void) {
    const fret_normal *n = normal_of(TABLE, 0);
    const fret_wear_held held = hold(n, false, true, -1.5);
    fret_wear_run *r = begin(n, &held, 1e-2);
    fret_wear *w = NULL;
    CHECK_CODE(fret_wear_after(r, 1e8, NULL, NULL, &w), FRET_TABLE_SHORT);
    CHECK_CODE(fret_wear_after(r, 1e8, NULL, NULL, &w), FRET_TABLE_SHORT);
    fret_wear_free(after(r, 1e3));
    fret_wear_run_free(r);
}

static volatile sig_atomic_t stopping;
static int times;
static void stop_soon(double cycles, void *user) {
    CHECK(cycles >= 0 && user == &times);
    stopping = ++times == 5;
}

static void interruptions(void) {
    fret_normal *n = normal_of(SPHERE, 0);
    const fret_wear_held held = hold(n, false, false, 0.6);
    fret_wear_run *r = begin(n, &held, 1e-2);
    fret_wear *w = NULL, *whole = run(n, &held, 1e6, 1e-2);
    fret_normal_stop(n, &stopping);
    CHECK_CODE(fret_wear_after(r, 1e6, stop_soon, &times, &w), FRET_INTERRUPTED);
    CHECK(times == 5 && w == NULL);
    stopping = 0;
    fret_normal_stop(n, NULL);
    w = after(r, 1e6); /* goes on from there */
    CHECK(fret_wear_volume(w) == fret_wear_volume(whole));
    fret_wear_free(whole);
    fret_wear_free(w);
    fret_wear_run_free(r);
}

static fret_status last;
static bool fine(fret_status st) {
    last = st;
    return !st.code;
}

static void allocations(void) {
    const fret_normal *n = normal_of(SPHERE, 0);
    const fret_wear_held held = hold(n, false, false, 0.6);
    fret_wear_run *r = NULL;
    fret_wear *w = NULL, *limit = NULL;
    EACH_FAILS(4, fine(fret_wear_run_make(n, &held, 0.1, &r)), last.code == FRET_NO_MEMORY && r == NULL);
    EACH_FAILS(4, fine(fret_wear_after(r, 10, NULL, NULL, &w)), last.code == FRET_NO_MEMORY && w == NULL);
    EACH_FAILS(8, fine(fret_wear_limit(n, &held, &limit)), last.code == FRET_NO_MEMORY && limit == NULL);
    fret_wear_free(limit);
    fret_wear_free(w);
    fret_wear_run_free(r);
}

/* ---- time -------------------------------------------------------------------------------------- */

static void a_million_cycles(void) {
    const fret_normal *n = normal_of(SPHERE, 0);
    const fret_wear_held held = hold(n, false, false, 0.6);
    clock_t start = clock();
    fret_wear_run *r = begin(n, &held, 1e-3);
    fret_wear_free(after(r, 1e6));
    printf("  10^6 cycles to 1e-3: %.2f s", (double)(clock() - start) / CLOCKS_PER_SEC);
    start = clock();
    for (int i = 0; i < 100; i++)
        fret_wear_free(after(r, 1e4 * i));
    printf(", any fewer then %.1f ms\n", (double)(clock() - start) / CLOCKS_PER_SEC * 10);
    fret_wear_run_free(r);
}

int main(int argc, char **argv) {
    enum { ROWS = 200 };
    double r[ROWS], f[ROWS];
    unit_start("wear", argc, argv);
    for (int i = 0; i < ROWS; i++) {
        r[i] = 1e-3 * i / (ROWS - 1);
        f[i] = 50 * r[i] * r[i];
    }
    CHECK_OK(fret_table_make(r, f, ROWS, NULL, &sampled));
    CASE(limits_of_spheres());
    CASE(limits_by_surfaces());
    CASE(limits_press());
    CASE(arrivals());
    CASE(single_cycles());
    CASE(volumes_and_work());
    CASE(worn_gaps());
    CASE(worn_tips());
    CASE(tolerances());
    CASE(stick_radii());
    CASE(growing_stick());
    CASE(orders());
    CASE(nothing_worn());
    CASE(refusals());
    CASE(short_tables());
    CASE(interruptions());
    CASE(allocations());
    CASE(a_million_cycles());
    const int result = unit_finish();
    fret_table_free(sampled);
    return result;
}
