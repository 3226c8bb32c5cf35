/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The law of a table row by row against its slow twin: g at each radius as the table tells it, and sums of it
 * over every row. Tables are as rough as a profile that grows allows. */
#include "contact/rows.h"

#include "contact/pieces.h"
#include "contact/table.h"
#include "number/quadrature.h"
#include "number/real.h"
#include "unit.h"

enum { MOST_ROWS = 12000 };

static unsigned long long seed = 5;
static double uniform(double lo, double hi) {
    return unit_random(&seed, lo, hi);
}

typedef struct rough {
    const char *what;
    int rows;
    double k, off, uneven, flat; /* noise of f, relative; of the spacing; radius of the flat end */
    int row;                     /* where slices begin */
} rough;

static const rough tables[] = {
    {"even", 60, 0.3, 0, 0, 0, 40},
    {"k near -1", 60, -0.99, 0, 0, 0, 40},
    {"k near 1", 60, 0.99, 0, 0.3, 0, 40},
    {"noise", 60, 0, 1e-3, 0.3, 0, 40},
    {"noise, k < 0", 100, -0.5, 1e-4, 0.3, 0, 17},
    {"flat end", 80, 0.2, 1e-4, 0.1, 2e-4, 61},
    {"flat end, k near -1", 80, -0.97, 0, 0.1, 2e-4, 30},
    {"many", MOST_ROWS, 0.3, 5e-7, 0.2, 0, 5000},
    {"many, k < 0", MOST_ROWS, -0.8, 1e-9, 0.2, 0, 300},
    {"many, flat end", MOST_ROWS, 0.8, 1e-6, 0.2, 1e-3, 11000},
};
enum { TABLES = sizeof tables / sizeof *tables };
static const double wide = 2e-3, R = 1e-2;

static struct fret_table *make_table(const rough *t) {
    static double r[MOST_ROWS], f[MOST_ROWS];
    struct fret_table *table = NULL;
    for (int i = 0; i < t->rows; i++) {
        r[i] = i ? wide * (i + uniform(-t->uneven, t->uneven)) / t->rows : 0;
        const double beyond = r[i] > t->flat ? r[i] - t->flat : 0;
        f[i] = beyond * beyond / (2 * R) * (1 + uniform(-t->off, t->off));
    }
    CHECK_OK(fret_table_make(r, f, (size_t)t->rows, NULL, &table));
    return table;
}

static fret_level twin_at(const fret_normal *n, fret_real e) {
    const fret_profile p = fret_table_profile(n->gap.table, &n->rule, e);
    return (fret_level){p.g, fret_force_of(n, &p)};
}

/* By eight points in each of a few parts of each row, in fourth roots of the distance from it: exact to 1e-13
 * of a row. */
static stretch twin_between(const fret_normal *n, fret_real outer, fret_real inner) {
    enum { PARTS = 6 };
    const fret_real k = n->foundation.k, start = fret_gap_start(&n->gap), edge = twin_at(n, outer).y;
    stretch sum = {edge - twin_at(n, inner).y, 0, 0, 0};
    for (fret_real hi = outer; hi > inner;) {
        const fret_real kink = fret_gap_kink(&n->gap, hi), lo = fmaxl(kink, inner);
        const fret_real from = sqrtl(sqrtl(lo - kink)), way = sqrtl(sqrtl(hi - kink)) - from;
        for (int i = 0; i < 8 * PARTS; i++) {
            const fret_real s = from + way * (i / 8 + fret_gauss_node[i % 8]) / (fret_real)PARTS,
                            e = kink + s * s * s * s, t = edge - twin_at(n, e).y;
            const fret_real dK = (1 + k) * fret_normal_stiffness(n, start + e) / (start + e) * 4 * s * s * s *
                                 way * fret_gauss_weight[i % 8] / (fret_real)PARTS;
            sum.K += dK;
            sum.G += t * dK;
            sum.L += t * (sum.h - t) * dK;
        }
        hi = lo;
    }
    return sum;
}

static fret_real depth_of(const struct fret_rows *rows, fret_spot s) {
    return fret_rows_level(rows, DEPTHS, &s);
}

static fret_real load_of(const struct fret_rows *rows, fret_spot s) {
    return fret_rows_level(rows, LOADS, &s);
}

static fret_real distance_of(const struct fret_rows *rows, fret_spot s) {
    return fret_rows_distance(rows, &s);
}

static void check_places(const fret_normal *n, const struct fret_rows *rows) {
    const fret_spot inner = fret_rows_inner(), outer = fret_rows_outer(rows);
    const fret_real begin = distance_of(rows, inner), end = distance_of(rows, outer);
    fret_spot s;
    for (int i = 0; i < 200; i++) {
        const fret_real e = begin + (end - begin) * uniform(0, 1);
        CHECK(fret_rows_find(rows, SPOT_DISTANCE, e, &s));
        CHECK_REL(distance_of(rows, s), e, UNIT_TOL(1e-18L, 1e-14L));
        const fret_level want = twin_at(n, e);
        CHECK_REL(depth_of(rows, s), want.y, UNIT_TOL(2e-16L, 1e-13L));
        CHECK_REL(load_of(rows, s), want.F, UNIT_TOL(2e-16L, 1e-13L));
        for (int by = DEPTHS; by <= LOADS; by++) {
            CHECK(fret_rows_find(rows, by == LOADS ? SPOT_LOAD : SPOT_DEPTH, by == LOADS ? want.F : want.y,
                                 &s));
            const fret_real y = depth_of(rows, s), F = load_of(rows, s);
            CHECK_REL(y, want.y, UNIT_TOL(by == LOADS ? 1e-15L : 2e-19L, 1e-13L));
            CHECK_REL(F, want.F, UNIT_TOL(by == LOADS ? 2e-19L : 1e-15L, 1e-13L));
            s.rise[DEPTHS] = s.rise[LOADS] = (fret_real)NAN; /* as its place tells */
            CHECK_REL(depth_of(rows, s), y, UNIT_TOL(2e-18L, 1e-15L));
            CHECK_REL(load_of(rows, s), F, UNIT_TOL(2e-18L, 1e-15L));
        }
    }
    CHECK(!fret_rows_find(rows, SPOT_LOAD, load_of(rows, inner), &s) &&
          !fret_rows_find(rows, SPOT_DEPTH, 0, &s));
    CHECK(!fret_rows_find(rows, SPOT_DISTANCE, end * 1.001L, &s));
    CHECK(fret_rows_find(rows, SPOT_DISTANCE, end, &s) && depth_of(rows, s) == depth_of(rows, outer));
}

/* A slice that begins within a row and ends there, in the next one, or many rows further in. */
static void check_slices(const rough *t, const fret_normal *n, const struct fret_rows *rows) {
    const size_t first = fret_table_row(n->gap.table, distance_of(rows, fret_rows_inner()));
    for (int i = 0; i < 8; i++) {
        const struct fret_table *table = n->gap.table;
        const int begin = t->row, end = begin - (i < 2 ? 0 : i < 4 ? 1 : 12);
        const fret_real e0 = fret_table_distance(table, (size_t)begin),
                        wide_row = fret_table_distance(table, (size_t)begin + 1) - e0;
        fret_spot outer, inner;
        CHECK(end > (int)first);
        CHECK(fret_rows_find(rows, SPOT_DISTANCE, e0 + (i % 2 ? 1 : uniform(0.6, 1)) * wide_row, &outer));
        CHECK(fret_rows_find(
            rows, SPOT_DISTANCE,
            fret_table_distance(table, (size_t)end) + (i % 2 ? 0 : uniform(0, 0.4)) * wide_row, &inner));
        const stretch got = fret_rows_between(rows, &outer, &inner),
                      want = twin_between(n, distance_of(rows, outer), distance_of(rows, inner));
        const fret_real few = (t->rows < MOST_ROWS ? 1e-18L : 1e-17L) * depth_of(rows, outer) /
                              want.h; /* depths are known to that of the whole */
        CHECK_REL(got.h, want.h, UNIT_TOL(1e-13L + few, 1e-9L));
        CHECK_REL(got.K, want.K, UNIT_TOL(1e-13L, 1e-11L));
        CHECK_REL(got.G, want.G, UNIT_TOL(1e-12L, 1e-9L));
        CHECK_REL(got.L, want.L, UNIT_TOL(1e-12L, 1e-9L));
        CHECK_REL(load_of(rows, inner) + got.G + got.h * fret_rows_stiffness(rows, &inner),
                  load_of(rows, outer), UNIT_TOL(1e-16L, 1e-12L));
    }
    const fret_spot inner = fret_rows_inner(), outer = fret_rows_outer(rows);
    const stretch none = fret_rows_between(rows, &inner, &inner),
                  all = fret_rows_between(rows, &outer, &inner);
    CHECK(none.h == 0 && none.L == 0);
    CHECK_REL(all.h, depth_of(rows, outer) - depth_of(rows, inner), UNIT_TOL(1e-17L, 1e-13L));
}

/* A single question has the rows of its slip alone. */
static void check_single(const fret_contact *c, double FA, fret_real loss, const fret_loading *first) {
    const fret_real few = 1e-18L * c->press.dz / (c->press.dz - first->yc); /* depths are known to that */
    fret_loading got;
    fret_real single;
    CHECK_OK(fret_cycle_loss_by_force(c, FA, &single));
    CHECK_REL(single, loss, UNIT_TOL(2e-15L + few, 1e-8L));
    CHECK_OK(fret_cycle_loss_by_displacement(c, (double)first->dx, &single));
    CHECK_REL(single, loss, UNIT_TOL(2e-15L + few, 1e-8L));
    CHECK_OK(fret_loading_by_force(c, FA, &got));
    CHECK_REL(got.dx, first->dx, UNIT_TOL(1e-15L, 1e-10L));
    CHECK_REL(got.c, first->c, UNIT_TOL(1e-15L, 1e-10L));
    CHECK_OK(fret_loading_by_displacement(c, (double)first->dx, &got));
    CHECK_REL(got.Fx, FA, UNIT_TOL(1e-15L, 1e-10L));
}

/* From inside out, as a contact asks: loss and displacement of many rows, against the sums of the twin. */
static void check_contact(const rough *t, const fret_normal *plain, double F) {
    fret_contact c = {.mu = 0.3};
    fret_normal *ready = NULL, *other = NULL, *alone = NULL;
    fret_material m = {{{210e9, 0.3, false}, {0, 0, true}}, t->k, 1e-3};
    const fret_gap *gap = fret_normal_gap(plain);
    CHECK_OK(fret_normal_make(&m, gap, &alone));
    CHECK_OK(fret_normal_make(&m, gap, &ready));
    CHECK_OK(fret_normal_prepare(ready, F, 0));
    CHECK(fret_normal_prepared(ready) <= 2e-15);
    m.body[0].E0 = 70e9;
    CHECK_OK(fret_normal_make(&m, gap, &other));
    CHECK_OK(fret_normal_share(other, ready));
    c.normal = ready;
    CHECK_OK(fret_press_by_force(ready, F, &c.press));
    const fret_foundation *f = fret_normal_foundation(ready);
    const fret_real start = fret_gap_start(gap);
    for (int i = 0; i < 3; i++) {
        const double FA = 0.3 * F * (t->rows > 1000 ? 0.004 * (i + 1) : 0.3 * (i + 0.5));
        fret_loading first;
        fret_real loss, scaled;
        CHECK_OK(fret_loading_by_force(&c, FA, &first));
        CHECK_OK(fret_cycle_loss_by_force(&c, FA, &loss));
        const stretch want = twin_between(ready, c.press.a - start, first.c - start);
        CHECK_REL(loss, 4 * 0.3L * 0.3L * f->eta * want.L, UNIT_TOL(1e-12L, 1e-8L));
        CHECK_REL(first.dx, 0.3L * f->eta * want.h, UNIT_TOL(1e-14L, 1e-10L));
        check_single(&(fret_contact){.normal = alone, .press = c.press, .mu = 0.3}, FA, loss, &first);
        fret_contact softer = {.normal = other, .mu = 0.3};
        CHECK_OK(fret_press_by_force(other, F / 3, &softer.press));
        CHECK_REL(softer.press.a, c.press.a, UNIT_TOL(1e-15L, 1e-13L));
        CHECK_REL(softer.press.dz, c.press.dz, UNIT_TOL(1e-15L, 1e-13L));
        CHECK_OK(fret_cycle_loss_by_force(&softer, FA / 3, &scaled));
        CHECK_REL(3 * scaled, loss, UNIT_TOL(1e-12L, 1e-9L));
        const fret_real half = c.press.dz - want.h / 2, mean = fret_law_force(ready, half);
        CHECK_REL(fret_law_force(other, half) * 3, mean, UNIT_TOL(1e-15L, 1e-13L));
        CHECK_REL(fret_law_thickness(ready, &(fret_level){c.press.dz, c.press.F}, FA / 0.3), want.h,
                  UNIT_TOL(1e-14L, 1e-10L));
        CHECK_REL(fret_law_load(ready, &(fret_level){c.press.dz, c.press.F}, want.h), FA / 0.3,
                  UNIT_TOL(1e-14L, 1e-10L));
    }
    fret_normal_free(alone);
    fret_normal_free(ready); /* the other one still has what they share */
    CHECK_OK(fret_press_by_force(other, F / 3, &c.press));
    fret_normal_free(other);
}

/* A row holds what is as far as it or farther, to the last digit of the distance. */
static void check_numbers(const struct fret_table *table, int rows) {
    for (size_t i = fret_table_row(table, 0) + 1; i + 1 < (size_t)rows; i++) {
        const fret_real e = fret_table_distance(table, i);
        CHECK(fret_table_row(table, e) == i && fret_table_row(table, nextafterl(e, 1)) == i);
        CHECK(fret_table_row(table, nextafterl(e, 0)) == i - 1);
    }
}

static void check_table(const rough *t) {
    const fret_material m = {{{210e9, 0.3, false}, {70e9, 0.35, false}}, t->k, 1e-3};
    const fret_gap gap = {.kind = FRET_GAP_TABLE, .table = make_table(t)};
    fret_normal *n = NULL;
    struct fret_rows *rows = NULL;
    fret_real error = 1;
    const long failed = unit.failed;
    CHECK_OK(fret_normal_make(&m, &gap, &n));
    const fret_real reach = 0.9L * (fret_gap_end(&gap) - fret_gap_start(&gap));
    CHECK_OK(fret_rows_make(n, 0, reach, &rows, &error));
    CHECK(rows && error < 2e-16L);
    CHECK(distance_of(rows, fret_rows_outer(rows)) >= reach && distance_of(rows, fret_rows_inner()) < reach);
    check_numbers(gap.table, t->rows);
    check_places(n, rows);
    check_slices(t, n, rows);
    if (t->off > 0 || fabs(t->k) > 0.9)
        check_contact(t, n, (double)load_of(rows, fret_rows_outer(rows)) * 0.7);
    if (unit.failed > failed)
        printf("%s\n", t->what);
    fret_rows_free(rows);
    fret_normal_free(n);
    fret_table_free((struct fret_table *)gap.table);
}

/* Each row three times as far as the one before, and a row much wider than all before it. */
static void uneven(void) {
    double r[12] = {0}, f[12] = {0};
    struct fret_rows *rows = NULL;
    struct fret_table *table = NULL;
    fret_normal *n = NULL;
    fret_real error = 1;
    const fret_material m = {{{210e9, 0.3, false}, {70e9, 0.35, false}}, 0.3, 1e-3};
    for (int i = 1; i < 12; i++) {
        r[i] = 1e-6 * pow(3, i);
        f[i] = r[i] * r[i];
    }
    CHECK_OK(fret_table_make(r, f, 12, NULL, &table));
    CHECK_OK(fret_normal_make(&m, &(fret_gap){.kind = FRET_GAP_TABLE, .table = table}, &n));
    CHECK_OK(fret_rows_make(n, 0, r[10], &rows, &error));
    CHECK(rows && error < 2e-16L);
    check_places(n, rows);
    fret_rows_free(rows);
    CHECK_OK(fret_rows_make(n, 0, r[1] / 2, &rows, &error)); /* within the first row */
    CHECK(rows == NULL);
    fret_normal_free(n);
    fret_table_free(table);
}

/* A flag ends it. */
static void stops(void) {
    volatile sig_atomic_t stop = 1;
    struct fret_rows *rows = NULL;
    fret_real error;
    const fret_material m = {{{210e9, 0.3, false}, {70e9, 0.35, false}}, 0.3, 1e-3};
    const fret_gap gap = {.kind = FRET_GAP_TABLE, .table = make_table(&tables[0])};
    fret_normal *n = NULL;
    CHECK_OK(fret_normal_make(&m, &gap, &n));
    fret_normal_stop(n, &stop);
    CHECK_CODE(fret_rows_make(n, 0, 1e-3L, &rows, &error), FRET_INTERRUPTED);
    CHECK(rows == NULL);
    fret_normal_free(n);
    fret_table_free((struct fret_table *)gap.table);
}

/* g' dx/dy of each part, in the first rows. */
static void check_parts(const fret_normal *n, const struct fret_rows *rows) {
    const fret_real start = fret_gap_start(&n->gap), m = (n->foundation.k + 1) / 2;
    for (size_t i = 0; i < fret_rows_parts(rows); i++) {
        const fret_row_part p = fret_rows_part(rows, i);
        fret_real largest = 0, worst = 0;
        for (int j = 1; j < 20; j++) { /* at its end the next row may begin by rounding */
            const fret_real y = j / 20.0L, x = sqrtl(p.inner * p.inner + p.width * y),
                            e = (p.inner - start) + p.width * y / (p.inner + x),
                            want = p.width / (2 * x) * fret_table_profile(n->gap.table, &n->rule, e).slope;
            fret_real smooth = 0, bent = 0;
            for (int c = p.slopes[0]; c-- > 0;)
                smooth = smooth * y + p.S[c];
            for (int c = p.slopes[1]; c-- > 0;)
                bent = bent * y + p.B[c];
            largest = fmaxl(largest, fabsl(want));
            worst = fmaxl(worst, fabsl(smooth + fret_pow(y, m) * bent - want));
        }
        CHECK_ABS(worst, 0, largest, UNIT_TOL(1e-15L, 1e-12L));
    }
}

/* The second row in all widths beside the first one, with a bend between them that outweighs all before. */
static void second_row(double flat, double k) {
    static const double widths[] = {0.3, 0.95, 1.005, 1.02, 1.05, 1.08, 1.12, 1.55, 1.7, 2.05, 3, 4.2, 30};
    const fret_material steel = {{{210e9, 0.3, false}, {70e9, 0.35, false}}, k, 1e-3};
    for (size_t i = 0; i < sizeof widths / sizeof *widths; i++) {
        enum { FEW = 9 };
        const double d = 1e-5;
        const size_t skip = flat > 0 ? 0 : 1;
        double r[FEW] = {0, flat}, f[FEW] = {0}, slope[FEW] = {0};
        struct fret_table *table = NULL;
        struct fret_rows *rows = NULL;
        fret_normal *n = NULL;
        for (int j = 2; j < FEW; j++) { /* parabolas */
            const double e = d * (j == 2 ? 1 : 1 + widths[i] * (j - 2));
            r[j] = flat + e;
            slope[j] = 2 * e * (j == 2 ? 1e-3 : 1);
            f[j] = f[j - 1] + (r[j] - r[j - 1]) * (slope[j] + slope[j - 1]) / 2;
        }
        CHECK_OK(fret_table_sloped(r + skip, f + skip, slope + skip, FEW - skip, NULL, &table));
        const fret_gap gap = {.kind = FRET_GAP_TABLE, .table = table};
        CHECK_OK(fret_normal_make(&steel, &gap, &n));
        CHECK_OK(fret_rows_make(n, 0, fret_table_distance(table, FEW - 1 - skip), &rows, NULL));
        check_places(n, rows);
        fret_rows_free(rows);
        CHECK_OK(fret_rows_make_slopes(n, fret_table_distance(table, FEW - 1 - skip), &rows));
        check_parts(n, rows);
        fret_rows_free(rows);
        fret_normal_free(n);
        fret_table_free(table);
    }
}

int main(int argc, char **argv) {
    unit_start("rows", argc, argv);
    for (int i = 0; i < TABLES; i++)
        if (!unit_skips((size_t)i))
            CASE(check_table(&tables[i]));
    CASE(uneven());
    for (int i = 0; i < 9; i++)
        CASE(second_row((double[]){0, 3e-5, 4e-4}[i % 3], (double[]){-0.9, -0.3, 0.5}[i / 3]));
    CASE(stops());
    return unit_finish();
}
