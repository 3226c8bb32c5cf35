/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Contacts that are prepared for many questions beside those that search for each answer: random tables, also
 * such as no polynomials and no rows are exact enough for. */
#include "contact/normal.h"
#include "unit.h"

static unsigned long long seed = 7;
static double uniform(double lo, double hi) {
    return unit_random(&seed, lo, hi);
}

/* x^power beyond a flat end, in uneven rows, with noise of which most tables bear some; NULL: it falls. */
static struct fret_table *random_table(void) {
    enum { MOST = 250 };
    static double r[MOST], f[MOST];
    const int rows = (int)pow(10, uniform(0.5, 2.4));
    const double flat = uniform(0, 1) < 0.5 ? 0 : uniform(0, 9e-4), uneven = uniform(0, 0.4),
                 noise = uniform(0, 1) < 0.4 ? 0 : pow(10, uniform(-9, -2)) / rows / rows,
                 power = uniform(1, 4);
    struct fret_table *t = NULL;
    for (int i = 0; i < rows; i++) {
        r[i] = i ? 1e-3 * (i + uniform(-uneven, uneven)) / rows : 0;
        f[i] = 1e-6 * pow(fmax(r[i] - flat, 0) / 1e-3, power) * (1 + uniform(-noise, noise));
    }
    CHECK_OK(fret_table_make(r, f, (size_t)rows, NULL, &t));
    return t;
}

static int unplaced;

/* A memory that is pressed to a depth finds the load and the radius, asked for at last, as a search does;
 * so does one that is pressed by a force the depth. */
static void press_memory(const fret_normal *plain, const fret_normal *ready, double dz, fret_real error) {
    fret_memory *m = NULL;
    fret_state now;
    fret_press want = {0};
    CHECK_OK(fret_memory_make(ready, 0.3, &m));
    CHECK_OK(fret_memory_step(m, &(fret_step){FRET_TO_DEPTH, FRET_KEEP_DX, dz, 0}));
    fret_memory_state(m, &now);
    CHECK_OK(fret_press_by_depth(plain, dz, &want));
    CHECK(now.dz == dz);
    CHECK_REL(now.FN, want.F, error);
    CHECK_REL(now.a, want.a, error + 1e-9L);
    const double half = (double)want.F / 2;
    CHECK_OK(fret_memory_step(m, &(fret_step){FRET_TO_FORCE, FRET_KEEP_DX, half, 0}));
    fret_memory_state(m, &now);
    CHECK(now.FN == half);
    CHECK_REL(now.dz, fret_law_depth(plain, half), error);
    fret_memory_free(m);
}

/* What is had without a radius is had as a search has it, and never beyond what numbers hold. */
static void compare_unplaced(const fret_normal *plain, const fret_normal *ready, double dz, fret_real F,
                             fret_real error) {
    static const double none[] = {1e-307, 1e-250, 1e300};
    fret_real other = 0;
    if (fret_law_unplaced(ready, false, dz, &other)) {
        CHECK_REL(other, fret_law_force(plain, dz), error);
        unplaced++;
    }
    if (fret_law_unplaced(ready, true, F, &other)) {
        CHECK_REL(other, fret_law_depth(plain, F), error);
        unplaced++;
    }
    for (size_t i = 0; i < sizeof none / sizeof *none; i++)
        for (int by_force = 0; by_force < 2; by_force++)
            CHECK(!fret_law_unplaced(ready, by_force, none[i], &other) ||
                  (other >= DBL_MIN && other <= DBL_MAX));
}

static void compare(const fret_normal *plain, const fret_normal *ready, const fret_press *p, double borne) {
    const double off = fret_normal_prepared(ready),
                 error = isnan(off) ? 1e-15 : 1e-13 + 2 * fmax(borne, off); /* of the law */
    const fret_level whole = {p->dz, p->F};
    fret_press at = {0};
    for (int i = 0; i < 6; i++) {
        const double dz = (double)p->dz * (i ? uniform(0.01, 1) : 1);
        CHECK_OK(fret_press_by_depth(ready, dz, &at));
        CHECK_REL(at.F, fret_law_force(plain, dz), UNIT_TOL((fret_real)error, 1e-8L));
        CHECK_OK(fret_press_by_force(ready, (double)p->F * (dz / (double)p->dz), &at));
        CHECK_REL(at.dz, fret_law_depth(plain, at.F), UNIT_TOL((fret_real)error, 1e-8L));
        compare_unplaced(plain, ready, dz, at.F, UNIT_TOL((fret_real)error, 1e-8L));
        press_memory(plain, ready, dz, UNIT_TOL((fret_real)error, 1e-8L));
        /* nearly all of the contact, and a part */
        const fret_real h = p->dz * (i < 3 ? 1 - powl(10, -4 * (i + 1)) : uniform(0.1, 0.9));
        CHECK_REL(fret_law_load(ready, &whole, h), fret_law_load(plain, &whole, h),
                  UNIT_TOL(10 * (fret_real)error, 1e-8L));
        const fret_real w = p->F * (i < 3 ? 1 - powl(10, -4 * (i + 1)) : uniform(0.1, 0.9));
        CHECK_REL(fret_law_thickness(ready, &whole, w), fret_law_thickness(plain, &whole, w),
                  UNIT_TOL(10 * (fret_real)error, 1e-8L));
    }
}

int main(int argc, char **argv) {
    unit_start("prepared", argc, argv);
    int compared = 0, without = 0;
    for (int i = 0; i < 150; i++) {
        const double end = uniform(0, 1);
        const fret_material m = {.body = {{.E0 = 210e9, .nu = 0.3}, {.E0 = 210e9, .nu = 0.3}},
                                 .k = end < 0.3   ? uniform(-0.999, -0.6)
                                      : end < 0.4 ? uniform(0.9, 0.999)
                                                  : uniform(-0.9, 0.9),
                                 .c0 = 1e-3};
        struct fret_table *t = random_table();
        const fret_gap gap = {.kind = FRET_GAP_TABLE, .table = t};
        fret_normal *plain = NULL, *ready = NULL;
        fret_press p = {0};
        const double borne = i % 2 ? 1e-9 : 0;
        if (!fret_normal_make(&m, &gap, &plain).code) {
            CHECK_OK(fret_normal_make(&m, &gap, &ready));
            if (!fret_press_by_radius(plain, 9e-4 * uniform(0.3, 1), &p).code && p.F > 0) {
                CHECK_OK(fret_normal_prepare(ready, (double)p.F, borne));
                const long failed = unit.failed;
                CASE(compare(plain, ready, &p, borne));
                if (unit.failed > failed)
                    printf("table %d, k = %g, prepared to %g\n", i, m.k, fret_normal_prepared(ready));
                compared++;
                without += isnan(fret_normal_prepared(ready));
            }
        }
        fret_normal_free(plain);
        fret_normal_free(ready);
        fret_table_free(t);
    }
    CHECK(compared > 80 && without < compared / 2 && unplaced > 10);
    return unit_finish();
}
