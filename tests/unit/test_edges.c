/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Slices and means that begin or end just where a piece of the law does, where rows begin, or at the centre,
 * each against the contact without pieces. */
#include "contact/blocks.h"
#include "contact/piece.h"
#include "contact/pieces.h"
#include "number/quadrature.h"
#include "unit.h"

static unsigned long long seed = 3;
static double uniform(double lo, double hi) {
    return unit_random(&seed, lo, hi);
}

typedef struct twins {
    fret_normal *plain, *ready;
    fret_real exact; /* of the plain one's sums */
} twins;

static fret_level level_of(const twins *t, const fret_level *of) {
    return (fret_level){of->y, of->F * t->ready->pieces->scale};
}

/* From `outer` to `inner`, exactly that. */
static void slice(const twins *t, const fret_level *outer, const fret_level *inner) {
    const struct fret_pieces *pieces = t->ready->pieces;
    const fret_real h = outer->y - inner->y, w = outer->F - inner->F,
                    lost =
                        inner->y > 0 ? 1e-18L * outer->y / inner->y : 0, /* by h, which the plain one has */
        few = t->exact + 1e-17L * outer->y / h + lost; /* depths are known to that of the whole */
    fret_slice got;
    fret_real thick;
    if (h < 1e-3L * outer->y)
        return;
    const fret_slice want = fret_law_slice(t->plain, outer, h);
    if (fret_pieces_slice(pieces, outer, false, true, h, inner->y, &thick, &got)) {
        CHECK_REL(got.w, want.w, few);
        CHECK_REL(got.J, want.J, few);
        CHECK_REL(got.G, want.G, few);
        CHECK_REL(got.L, want.L, few);
    }
    if (fret_pieces_slice(pieces, outer, true, true, w, inner->F, &thick, &got)) {
        CHECK_REL(thick, h, few);
        CHECK_REL(got.J, want.J, few);
    }
    if (fret_pieces_across(pieces, outer, false, true, h, &thick))
        CHECK_REL(thick, want.w, few);
    if (fret_pieces_across(pieces, outer, true, true, w, &thick))
        CHECK_REL(thick, h, few);
}

/* By Gauss's points in parts that grow from the inner end. */
static void mean(const twins *t, fret_real from, fret_real to) {
    enum { PARTS = 40 };
    const fret_real lo = fminl(from, to), way = fmaxl(from, to) - lo;
    fret_real got, sum = 0;
    if (!fret_pieces_mean(t->ready->pieces, from, to, &got))
        return;
    if (way == 0) {
        CHECK_REL(got, fret_law_force(t->plain, lo), 1e-14L);
        return;
    }
    for (int i = 0; i < 8 * PARTS; i++) {
        const fret_real s = (i / 8 + fret_gauss_node[i % 8]) / (fret_real)PARTS;
        sum +=
            fret_law_force(t->plain, lo + way * s * s) * 2 * s * fret_gauss_weight[i % 8] / (fret_real)PARTS;
    }
    CHECK_REL(got, sum, 1e-9L);
}

/* The profile by a piece of the law, where such tell it. */
static void depth(const twins *t, const piece *p) {
    fret_real got, unused;
    for (int i = 0; i < 3; i++) {
        const fret_real e = fret_piece_distance(p, i ? (fret_real)uniform(-1, 1) : -1, &unused);
        if (fret_pieces_depth(t->ready->pieces, e, &got))
            CHECK_REL(got, fret_gap_profile(&t->plain->gap, &t->plain->rule, e).g, t->exact);
    }
}

static void edges(const twins *t, double F) {
    const struct fret_pieces *pieces = t->ready->pieces;
    const law *all = pieces->law;
    const fret_level none = {0, 0};
    const size_t each = all->count / 5 + 1;
    fret_level inner[3], outer[3];
    for (size_t i = 0; i < all->count; i += each) {
        depth(t, &all->piece[i]);
        inner[0] = level_of(t, &all->piece[i].outer);
        inner[1] = level_of(t, &all->piece[i].inner);
        inner[2] = none;
        for (size_t j = i; j < all->count; j += each) {
            outer[0] = level_of(t, &all->piece[j].outer);
            outer[1].y = outer[0].y * uniform(0.7, 1);
            outer[2].y = all->piece[j].inner.y + (outer[0].y - all->piece[j].inner.y) * uniform(0, 0.01);
            outer[1].F = fret_law_force(t->plain, outer[1].y);
            outer[2].F = fret_law_force(t->plain, outer[2].y);
            for (int o = 0; o < 3; o++)
                for (int k = 0; k < 3; k++)
                    slice(t, &outer[o], &inner[k]);
        }
        mean(t, inner[0].y, inner[0].y * 1.3L);
        mean(t, inner[0].y, inner[1].y);
        mean(t, inner[0].y, inner[0].y);
    }
    for (size_t j = 1; j < all->count; j++) { /* thin ones, across an end or to one */
        const fret_real rise = all->piece[j].outer.y - all->piece[j].inner.y;
        outer[0].y = all->piece[j].inner.y + rise * uniform(0, 0.1);
        outer[1].y = all->piece[j].inner.y + rise * uniform(0, 0.001);
        for (int o = 0; o < 2; o++) {
            outer[o].F = fret_law_force(t->plain, outer[o].y);
            for (size_t d = 1; d <= j && d <= 3; d++) {
                inner[0] = level_of(t, &all->piece[j - d].outer);
                inner[1].y = inner[0].y - (inner[0].y - all->piece[j - d].inner.y) * uniform(0, 0.01);
                inner[1].F = fret_law_force(t->plain, inner[1].y);
                slice(t, &outer[o], &inner[0]);
                slice(t, &outer[o], &inner[1]);
            }
            slice(t, &outer[o], &none);
        }
    }
    if (!all->rows)
        return;
    const fret_level begin = {fret_blocks_begin(all->rows, SPOT_DEPTH),
                              fret_blocks_begin(all->rows, SPOT_LOAD)},
                     base = level_of(t, &begin);
    for (int i = 0; i < 4; i++) {
        const fret_real load = base.F + (F - base.F) * (i ? uniform(0, 1) : 1);
        const fret_level top = {fret_law_depth(t->plain, load), load}, low = {base.y * uniform(0.05, 1), 0};
        const fret_level below = {low.y, fret_law_force(t->plain, low.y)};
        slice(t, &top, &base);
        slice(t, &top, &none);
        slice(t, &top, &below);
        slice(t, &base, &below);
        mean(t, top.y, base.y);
        mean(t, below.y, top.y);
        mean(t, top.y, top.y);
    }
}

/* Of a table where `rows`, each off by that part; off < 0: each so many times as far as the one before. */
static void contact(fret_gap gap, int rows, double off, double k, fret_real exact, double borne) {
    static double r[100], f[100];
    const fret_material m = {{{210e9, 0.3, false}, {70e9, 0.35, false}}, k, 1e-3};
    const double wide = 1e-3;
    struct fret_table *table = NULL;
    fret_press p;
    twins t = {.exact = exact};
    for (int i = 0; i < rows; i++) {
        r[i] = off < 0 && i ? wide * pow(-off, i + 1 - rows) : wide * i / (rows - 1);
        f[i] = r[i] * r[i] / 2e-2 * (off > 0 ? 1 + uniform(0, off) : 1);
    }
    if (rows) {
        CHECK_OK(fret_table_make(r, f, (size_t)rows, NULL, &table));
        gap = (fret_gap){.kind = FRET_GAP_TABLE, .table = table};
    }
    CHECK_OK(fret_normal_make(&m, &gap, &t.plain));
    CHECK_OK(fret_normal_make(&m, &gap, &t.ready));
    CHECK_OK(fret_press_by_radius(t.plain, (double)fret_gap_start(&gap) + 0.9 * wide, &p));
    CHECK_OK(fret_normal_prepare(t.ready, (double)p.F, borne));
    const long failed = unit.failed;
    if (CHECK(t.ready->pieces))
        edges(&t, (double)p.F);
    if (unit.failed > failed)
        printf("kind %d, %d rows, k = %g\n", (int)gap.kind, rows, k);
    fret_normal_free(t.plain);
    fret_normal_free(t.ready);
    fret_table_free(table);
}

int main(int argc, char **argv) {
    unit_start("edges", argc, argv);
    static const double grading[] = {-0.8, 0, 0.7};
    for (size_t i = 0; i < sizeof grading / sizeof *grading; i++) {
        const double k = grading[i];
        const bool few = unit_skips(1);
        if (few && k != 0)
            continue;
        CASE(contact((fret_gap){.kind = FRET_GAP_SUM, .terms = 2, .power = {{2, 50, 1}, {4, 2e6, 1}}}, 0, 0,
                     k, 1e-10L, 0));
        /* hardly more than one power: long pieces */
        CASE(contact((fret_gap){.kind = FRET_GAP_SUM, .terms = 2, .power = {{2, 50, 1}, {4, 1e-3, 1}}}, 0, 0,
                     k, 1e-10L, 0));
        CASE(contact((fret_gap){.kind = FRET_GAP_SUM, .terms = 2, .power = {{1, 0.05, 1}, {2, 1e-6, 1}}}, 0,
                     0, k, 1e-10L, 0));
        if (few)
            continue;
        CASE(contact((fret_gap){.kind = FRET_GAP_EXACT_SPHERE, .R = 1e-2}, 0, 0, k, 1e-10L, 0));
        CASE(contact((fret_gap){.kind = FRET_GAP_FLAT_CONE, .b = 1e-4, .slope = 0.02}, 0, 0, k, 1e-10L, 0));
        CASE(contact((fret_gap){0}, 60, 0, k, 1e-9L, 0));
        CASE(contact((fret_gap){0}, 60, 1e-4, k, 1e-9L, 0));
        CASE(contact((fret_gap){0}, 8, -3, k, 1e-9L, 0));
        CASE(contact((fret_gap){0}, 5, -10, k, 1e-9L, 0));
        CASE(contact((fret_gap){0}, 5, 1e-3, k, 1e-9L, 1e-9));
        CASE(contact((fret_gap){0}, 8, -3, k, 1e-9L, 1e-9));
        CASE(contact((fret_gap){0}, 5, -10, k, 1e-9L, 1e-9));
        CASE(contact((fret_gap){0}, 4, -50, k, 1e-9L, 1e-9));
    }
    return unit_finish();
}
