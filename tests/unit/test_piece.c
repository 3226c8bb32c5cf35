/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Places and ways in a polynomial piece from bad guesses: the search ends where it does from the good one. */
#include "contact/piece.h"

#include "contact/pieces.h"
#include "unit.h"

static unsigned long long seed = 3;
static double uniform(double lo, double hi) {
    return unit_random(&seed, lo, hi);
}

/* Guesses z, whatever is asked, and a rate that leads nowhere. */
static piece guessing(const piece *p, double z) {
    piece out = *p;
    for (int by = DEPTHS; by <= LOADS; by++)
        for (int i = 0; i < GUESS; i++) {
            out.guess[by].term[i][0] = i ? 0 : z;
            out.guess[by].term[i][1] = i ? 0 : 1e30;
        }
    return out;
}

static void search(const piece *good, double z) {
    const piece bad = guessing(good, z);
    for (int by = DEPTHS; by <= LOADS; by++)
        for (int i = 0; i < 40; i++) {
            const fret_real at = i == 0 ? -1 : i == 1 ? 1 : i < 10 ? powl(10, -i) - 1 : uniform(-1, 1);
            const fret_real rise = fret_polynomial_at(&good->rise[by], at),
                            found = fret_piece_place(&bad, by, rise);
            /* a place is known as well as what it is told by */
            CHECK_ABS(fret_polynomial_at(&good->rise[by], found), rise,
                      fret_level_by(&good->inner, by) + fret_piece_rise(good, by), UNIT_TOL(1e-18L, 1e-14L));
            polynomial q;
            fret_polynomial_quotient(&good->rise[by], at, &q);
            const fret_real part = i % 4   ? uniform(0, 1)
                                   : i % 8 ? 1
                                           : 0.002L,
                            way = part * (1 + at), drop = way * fret_polynomial_at(&q, at - way);
            if (!(drop > 0) || (good->blunt && at < -0.6L)) /* thin slices there are not for a piece */
                continue;
            const fret_real went = fret_piece_way(&bad, by, &q, at, rise, drop);
            CHECK(went > 0 && went <= 1 + at);
            CHECK_ABS(went * fret_polynomial_at(&q, at - went), drop, rise, UNIT_TOL(2e-16L, 1e-12L));
        }
}

int main(int argc, char **argv) {
    static const double guesses[] = {-0.999999, -0.9, 0, 0.9, 0.999999, 1, 50};
    unit_start("piece", argc, argv);
    double r[20], f[20];
    struct fret_table *t = NULL;
    for (int i = 0; i < 20; i++) {
        r[i] = 1e-3 * i / 19;
        f[i] = r[i] * r[i] / 0.02;
    }
    CHECK_OK(fret_table_make(r, f, 20, NULL, &t));
    const fret_gap gaps[] = {{.kind = FRET_GAP_SUM, .terms = 2, .power = {{2, 50, 1}, {4, 2e6, 1}}},
                             {.kind = FRET_GAP_SUM, .terms = 2, .power = {{1, 0.05, 1}, {12, 1e-6, 1e-4}}},
                             {.kind = FRET_GAP_FLAT_CONE, .b = 1e-3, .slope = 0.05},
                             {.kind = FRET_GAP_TABLE, .table = t}};
    for (size_t i = 0; i < sizeof gaps / sizeof *gaps; i++) {
        const fret_material m = {
            .body = {{.E0 = 210e9, .nu = 0.3}, {.E0 = 210e9, .nu = 0.3}}, .k = 0.3, .c0 = 1e-3};
        fret_normal *n = unit_keep_normal(&m, &gaps[i]);
        CHECK_OK(fret_normal_prepare(n, 10, 0));
        if (!CHECK(n->pieces))
            continue;
        const law *all = n->pieces->law;
        for (size_t j = 0; j < all->count; j += 1 + all->count / 12)
            for (size_t g = 0; g < sizeof guesses / sizeof *guesses; g++)
                if (guesses[g] >= -0.9 || !all->piece[j].blunt) /* it is flat there */
                    CASE(search(&all->piece[j], guesses[g]));
    }
    const int status = unit_finish();
    fret_table_free(t);
    return status;
}
