/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What was prepared for one contact, shared with others of its shape and k, against contacts that are not
 * prepared at all; and what is not shared. */
#include "contact/pieces.h"
#include "unit.h"

enum { SHAPES = 4, MATERIALS = 6, QUESTIONS = 40, ROWS = 60 };

static unsigned long long seed = 11;
static double uniform(double lo, double hi) {
    return unit_random(&seed, lo, hi);
}

static struct fret_table *make_table(void) {
    double r[ROWS], f[ROWS];
    struct fret_table *table = NULL;
    for (int i = 0; i < ROWS; i++) {
        r[i] = 2e-3 * i / (ROWS - 1);
        f[i] = r[i] * r[i] / 0.02 * (1 + 40 * r[i]);
    }
    CHECK_OK(fret_table_make(r, f, ROWS, NULL, &table));
    return table;
}

static fret_normal *make(const fret_gap *gap, double k, double E0, double c0) {
    const fret_material material = {
        .body = {{.E0 = E0, .nu = uniform(0, 0.45)}, {.E0 = E0, .nu = 0.3}}, .k = k, .c0 = c0};
    fret_normal *n = NULL;
    CHECK_OK(fret_normal_make(&material, gap, &n));
    return n;
}

/* Forces within reach; the loss of thin slips is a difference, so amplitudes are not small. */
static void compare(const fret_normal *shared, const fret_normal *plain, double most) {
    fret_contact a = {.normal = shared, .mu = 0.4}, b = {.normal = plain, .mu = 0.4};
    for (int i = 0; i < QUESTIONS; i++) {
        const double F = most * uniform(0.05, 1);
        fret_real loss[2];
        fret_loading first[2];
        fret_press exact;
        CHECK_OK(fret_press_by_force(shared, F, &a.press));
        CHECK_OK(fret_press_by_force(plain, F, &exact));
        b.press = exact;
        CHECK_REL(a.press.dz, exact.dz, 2e-15L);
        CHECK_REL(a.press.a, exact.a, 2e-15L);
        const double FA = 0.4 * F * uniform(0.1, 0.9);
        CHECK_OK(fret_loading_by_force(&a, FA, &first[0]));
        CHECK_OK(fret_loading_by_force(&b, FA, &first[1]));
        CHECK_REL(first[0].dx, first[1].dx, 2e-14L);
        CHECK_OK(fret_cycle_loss_by_force(&a, FA, &loss[0]));
        CHECK_OK(fret_cycle_loss_by_force(&b, FA, &loss[1]));
        CHECK_REL(loss[0], loss[1], 2e-14L);
    }
}

/* What a shape does not read may be anything. */
static void unread(void) {
    fret_gap sphere = {.kind = FRET_GAP_EXACT_SPHERE, .R = 0.01, .terms = 1 << 28};
    fret_normal *from = make(&sphere, 0.2, 210e9, 1e-3), *to = make(&sphere, 0.2, 100e9, 1e-3);
    CHECK_OK(fret_normal_prepare(from, 100, 0));
    CHECK_OK(fret_normal_share(to, from));
    CHECK(!isnan(fret_normal_prepared(to)));
    fret_normal_free(to);
    fret_normal_free(from);
}

int main(int argc, char **argv) {
    unit_start("share", argc, argv);
    struct fret_table *table = make_table();
    const fret_gap shapes[SHAPES] = {{.kind = FRET_GAP_EXACT_SPHERE, .R = 0.01},
                                     {.kind = FRET_GAP_FLAT_ROUNDED, .b = 2e-4, .R = 0.02},
                                     {.kind = FRET_GAP_SUM, .terms = 2, .power = {{2, 50, 1}, {4, 2e6, 1}}},
                                     {.kind = FRET_GAP_TABLE, .table = table}};
    for (int shape = 0; shape < SHAPES; shape++) {
        const double k = uniform(-0.6, 0.6);
        fret_normal *from = make(&shapes[shape], k, 210e9, 1e-3);
        fret_normal *none = make(&shapes[shape], k, 100e9, 1e-3);
        CHECK_OK(fret_normal_share(none, from)); /* nothing is prepared yet */
        CHECK(isnan(fret_normal_prepared(none)));
        CHECK_OK(fret_normal_prepare(from, 100, 0));
        CHECK(fret_normal_prepared(from) < 1e-14);
        for (int i = 0; i < MATERIALS; i++) {
            const double E0 = i ? 210e9 * uniform(0.3, 3) : 210e9, c0 = i ? 1e-3 * uniform(0.5, 2) : 1e-3;
            const unsigned long long before = seed;
            fret_normal *shared = make(&shapes[shape], k, E0, c0);
            seed = before; /* the same nu */
            fret_normal *plain = make(&shapes[shape], k, E0, c0);
            CHECK_OK(fret_normal_share(shared, from));
            CHECK(fret_normal_prepared(shared) == fret_normal_prepared(from));
            const fret_real stiffer =
                fret_normal_stiffness(shared, 1e-4L) / fret_normal_stiffness(from, 1e-4L);
            const struct fret_pieces *pieces = shared->pieces;
            CHECK_OK(fret_normal_prepare(shared, (double)(100 * stiffer), 0)); /* they reach as far */
            CHECK(shared->pieces == pieces);
            CASE(compare(shared, plain, (double)(100 * stiffer)));
            CHECK_OK(fret_normal_prepare(shared, (double)(400 * stiffer), 0)); /* and now others do */
            CHECK(!shared->shared && !isnan(fret_normal_prepared(shared)));
            CASE(compare(shared, plain, (double)(400 * stiffer)));
            fret_normal_free(shared);
            fret_normal_free(plain);
        }
        fret_gap wider = shapes[shape];
        wider.R *= 1.5;
        wider.power[0].h *= 1.5;
        fret_normal *other = make(&wider, k, 210e9, 1e-3),
                    *graded = make(&shapes[shape], k + 0.1, 210e9, 1e-3);
        CHECK_OK(fret_normal_share(graded, from));
        CHECK(isnan(fret_normal_prepared(graded)));
        CHECK_OK(fret_normal_share(other, from));
        CHECK(isnan(fret_normal_prepared(other)) == (wider.kind != FRET_GAP_TABLE));
        fret_normal_free(other);
        fret_normal_free(graded);
        fret_normal_free(none);
        fret_normal_free(from);
    }
    fret_table_free(table);
    unread();
    return unit_finish();
}
