/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The law by cells against the transform it is made of, slices against the law, parts against their whole. */
#include <stdlib.h>

#include "law/cells.h"
#include "law/normal.h"
#include "law/table.h"
#include "number/integral.h"
#include "number/real.h"
#include "unit.h"

static const fret_gap shapes[] = {
    {.kind = FRET_GAP_FLAT_CONE, .b = 1e-3, .slope = 0.01},
    {.kind = FRET_GAP_FLAT_PARABOLOID, .b = 1e-3, .R = 0.01},
    {.kind = FRET_GAP_FLAT_ROUNDED, .b = 1e-3, .R = 0.01},
    {.kind = FRET_GAP_EXACT_SPHERE, .R = 0.01},
    {.kind = FRET_GAP_SUM, .terms = 3, .power = {{0.3, 1e-6, 1e-3}, {2, 1e-5, 1e-3}, {60, 1e-6, 1e-3}}}};
static const double gradings[] = {-0.99, -0.9, -0.5, 0, 5e-4, 0.5, 0.9, 0.99};
static unsigned long long seed = 7;

static fret_real uniform(fret_real lo, fret_real hi) {
    return lo + (hi - lo) * unit_random(&seed, 0, 1);
}

typedef enum rough { SMOOTH, ROUGH, FLAT, WIDER, CONE } rough;

static struct fret_table *table_of(rough how, int rows) {
    double *r = calloc((size_t)rows, sizeof *r), *f = calloc((size_t)rows, sizeof *f);
    struct fret_table *t = NULL;
    for (int i = 1; i < rows; i++) {
        r[i] = how == WIDER ? 5e-3 * pow(1.3, i - rows + 1) : 5e-3 * i / (rows - 1);
        const double x = how == FLAT ? fmax(r[i] - 1e-3, 0) : r[i];
        f[i] = how == CONE ? x / 20 : x * x / 0.02 + (how == ROUGH ? 1e-9 * (i % 7) * r[i] / 5e-3 : 0);
    }
    CHECK_OK(fret_table_make(r, f, (size_t)rows, NULL, &t));
    free(r);
    free(f);
    return t;
}

/* The load of a unit stiffness, (k+1) int x^k (g(a)-g(x)) dx, at the distance e from the start. */
typedef struct load {
    const fret_gap *gap;
    const fret_rule *rule;
    fret_real start, e, g;
} load;

static fret_real load_rate(fret_real t, fret_real rest, void *context) {
    const load *l = context;
    const fret_real k1 = l->rule->k + 1, ln = rest < 0.5L ? log1pl(-rest) : logl(t),
                    e = l->start > 0 ? l->e * t : l->e * expl(ln / k1); /* linear in x^(k+1) from a centre */
    const fret_real g = e > 0 ? fret_gap_profile(l->gap, l->rule, e).g : 0;
    return (l->g - g) * (l->start > 0 ? k1 * l->e * fret_pow(l->start + e, k1 - 1) : fret_pow(l->e, k1));
}

/* The same of rows, a^(k+2) int s^2 f' (1-s^2)^((k-1)/2) ds with s = r/a: far from the edge by Gauss's rule,
 * near it by moments of the kernel. */
static fret_real load_of_rows(const struct fret_table *t, const fret_rule *rule, fret_real e) {
    const fret_real start = fret_table_start(t), a = start + e;
    fret_real sum = 0, c[3], m[FRET_EDGE];
    for (size_t i = fret_table_row(t, 0); i + 1 < fret_table_count(t) && fret_table_distance(t, i) < e; i++) {
        const fret_real begin = fret_table_distance(t, i), next = fret_table_distance(t, i + 1),
                        h = next - begin, away = e - begin, v = away / a;
        fret_table_slope(t, i, c);
        for (int j = 0; j < 8 && away > 5 * h; j++) {
            const fret_real x = h * fret_gauss_node[j], r = start + begin + x;
            sum += h / a * fret_gauss_weight[j] * (r / a) * (r / a) * (c[0] + x * (c[1] + x * c[2])) *
                   fret_pow((away - x) / a * ((a + r) / a), (rule->k - 1) / 2);
        }
        if (away > 5 * h)
            continue;
        const fret_edge lo = fret_edge_moments(rule, v), hi = fret_edge_moments(rule, (e - next) / a);
        const fret_real d1 = c[1] * a, d2 = c[2] * a * a,
                        p[3] = {c[0] + v * (d1 + v * d2), -(d1 + 2 * v * d2), d2};
        for (int j = 0; j < FRET_EDGE; j++)
            m[j] = lo.moment[j] - hi.moment[j];
        for (int j = 0; j < 3; j++)
            sum += p[j] * (m[j] - 2 * m[j + 1] + m[j + 2]);
    }
    return fret_pow(a, rule->k + 2) * sum;
}

static fret_real load_of_powers(const fret_gap *gap, const fret_rule *rule, fret_real a) {
    fret_term term[FRET_MOST_TERMS];
    fret_real sum = 0;
    for (int i = fret_gap_series(gap, rule, a, term); i-- > 0;)
        sum += term[i].G * term[i].n / (term[i].n + rule->k + 1);
    return fret_pow(a, rule->k + 1) * sum;
}

static fret_real load_of(const fret_gap *gap, const fret_rule *rule, fret_real e, fret_real g) {
    load l = {gap, rule, fret_gap_start(gap), e, g};
    const fret_real within = l.start > 0 ? fret_pow(l.start, rule->k + 1) * g : 0;
    return gap->table                  ? load_of_rows(gap->table, rule, e)
           : gap->kind == FRET_GAP_SUM ? load_of_powers(gap, rule, e)
                                       : within + fret_integral(load_rate, &l, 1e-18L).value;
}

/* Depth and load of a unit stiffness, as the transform tells them, and back. */
static void places(const fret_gap *gap, double k, fret_real exact) {
    fret_cells *c = NULL;
    fret_rule rule;
    fret_gap_rule(gap, k, &rule);
    CHECK_OK(fret_cells_make(gap, k, NULL, NULL, &c));
    if (!c)
        return;
    const fret_real start = fret_gap_start(gap), whole = (isfinite(c->end) ? c->end : 0.05L) - start;
    for (int i = 0; i < (unit_skips(1) ? 60 : 300); i++) {
        /* of a radius next to a flat end its distance has lost its digits */
        const fret_real e = whole * (i % 2 ? uniform(0, 1) : fret_pow(10, -uniform(0, start > 0 ? 3 : 10)));
        const fret_profile want = fret_gap_profile(gap, &rule, e);
        const fret_place at = fret_cells_at(c, start + e);
        const fret_real F = fret_cells_level(c, BY_LOAD, &at), few = exact * (1 + start / e * 1e-2L);
        fret_place by;
        CHECK_REL(fret_cells_level(c, BY_DEPTH, &at), want.g, few);
        if (gap->table || gap->kind == FRET_GAP_SUM || i % 20 == 1)
            CHECK_REL(F, load_of(gap, &rule, e, want.g), few);
        CHECK(fret_cells_find(c, BY_DEPTH, want.g, &by));
        CHECK_REL(fret_cells_radius(c, &by), start + e, exact);
        CHECK(fret_cells_find(c, BY_LOAD, F, &by));
        CHECK_REL(fret_cells_radius(c, &by), start + e, exact);
    }
    CHECK(c->error <= 1e-17L);
    fret_cells_free(c);
}

static void same_stretch(const fret_stretch *a, const fret_stretch *b, fret_real few) {
    CHECK_REL(a->h, b->h, few);
    CHECK_REL(a->K, b->K, few);
    CHECK_REL(a->G, b->G, few);
    CHECK_REL(a->L, b->L, few);
}

/* From a place inwards; the inner end is found, or known. */
static fret_stretch slice(const fret_cells *c, int by, const fret_place *outer, fret_real drop,
                          fret_real left, fret_place *inner, fret_real *K) {
    const fret_real back = fret_cells_inner(c, by, outer, drop, left, inner);
    return fret_cells_between(c, outer, inner, back, K);
}

/* A slice, from thin to nearly all, is what its two halves carry together; its load and thickness lead to
 * each other. */
static void slices(const fret_gap *gap, double k, fret_real few) {
    fret_cells *c = NULL;
    fret_real K, unused;
    CHECK_OK(fret_cells_make(gap, k, NULL, NULL, &c));
    if (!c)
        return;
    const fret_place end = fret_cells_at(c, isfinite(c->end) ? c->end : 0.05L);
    const fret_real most = fret_cells_level(c, BY_DEPTH, &end);
    for (int i = 0; i < (unit_skips(1) ? 100 : 1000); i++) {
        const fret_real y = most * (i % 3 ? uniform(0.05L, 1) : fret_pow(10, -uniform(0, 4))),
                        h = 0.9L * y * fret_pow(10, -uniform(0, 9)), part = h * uniform(0.2L, 0.8L);
        fret_place outer, middle = {0, 0}, inner = {0, 0}, below = {0, 0}, same = {0, 0};
        CHECK(fret_cells_find(c, BY_DEPTH, y, &outer));
        const fret_stretch whole = slice(c, BY_DEPTH, &outer, h, y - h, &inner, &K),
                           known = slice(c, BY_DEPTH, &outer, h, y - h, &inner, &unused);
        same_stretch(&whole, &known, few);
        fret_stretch sum = slice(c, BY_DEPTH, &outer, part, y - part, &middle, &unused);
        const fret_stretch rest = slice(c, BY_DEPTH, &middle, h - part, y - h, &below, &unused);
        CHECK_REL(whole.h, h, few);
        CHECK(whole.K > 0 && whole.G > 0 && whole.L > 0);
        sum = fret_stretch_join(&sum, &rest);
        /* the halves meet to the rounding of the place */
        same_stretch(&whole, &sum, few + 4e-19L * y / h);
        CHECK_REL(K, fret_cells_stiffness(c, &inner), few);
        const fret_real w = whole.G + whole.h * K, F = fret_cells_level(c, BY_LOAD, &outer);
        CHECK_REL(slice(c, BY_LOAD, &outer, w, F - w, &same, &unused).h, h, few + 4e-19L * y / h);
        const fret_real back = fret_cells_inner(c, BY_LOAD, &outer, w, F - w, &same);
        CHECK_REL(fret_cells_fall(c, BY_DEPTH, &outer, &same, back), h, few + 4e-19L * y / h);
        CHECK_REL(fret_cells_fall(c, BY_LOAD, &outer, &same, back), w, few + 4e-19L * y / h);
    }
    fret_cells_free(c);
}

/* L = h (F(y)+F(y-h)) - 2 int F dy: against the mean of the load by quadrature. */
static fret_real load_at(fret_real t, fret_real rest, void *context) {
    const fret_cells *c = context;
    fret_place at;
    (void)rest;
    (void)fret_cells_find(c, BY_DEPTH, t * 1e-5L, &at);
    return fret_cells_level(c, BY_LOAD, &at);
}

static void areas(const fret_gap *gap, double k) {
    fret_cells *c = NULL;
    fret_place outer;
    CHECK_OK(fret_cells_make(gap, k, NULL, NULL, &c));
    CHECK(fret_cells_find(c, BY_DEPTH, 1e-5L, &outer));
    const fret_place centre = {0, c->cell[0].begin};
    fret_real K;
    const fret_stretch whole = fret_cells_between(c, &outer, &centre, outer.s, &K);
    CHECK(K == c->cell[0].K);
    const fret_real F = fret_cells_level(c, BY_LOAD, &outer), mean = fret_integral(load_at, c, 1e-15L).value;
    CHECK_ABS(whole.L, 1e-5L * F - 2e-5L * mean, 1e-5L * F, 1e-16L);
    fret_cells_free(c);
}

/* Of another material the cells are shared; of another exponent they are not. */
static void shared(void) {
    fret_material m = unit_make_scene(2, 0.3).material;
    const fret_gap *gap = &shapes[2];
    fret_normal *n, *other, *last;
    CHECK_OK(fret_normal_make(&m, gap, NULL, NULL, &n));
    m.body[0].E0 *= 2;
    m.body[1].E0 *= 2;
    CHECK_OK(fret_normal_make(&m, gap, n, NULL, &other));
    CHECK(other->cells == n->cells);
    CHECK_REL(fret_law_force(other, 1e-6L), 2 * fret_law_force(n, 1e-6L), 1e-18L);
    fret_normal_free(n);
    CHECK(fret_law_force(other, 1e-6L) > 0);
    m.k = 0.2;
    CHECK_OK(fret_normal_make(&m, gap, other, NULL, &last));
    CHECK(last->cells != other->cells && last->cells->unit != other->cells->unit);
    fret_normal_free(last);
    fret_normal_free(other);
}

static void same_cells(const fret_cells *a, const fret_cells *b) {
    const fret_real most = isfinite(a->end) ? a->most[BY_DEPTH] : 10 * a->cell[a->count - 1].y;
    CHECK(a->count == b->count && a->end == b->end && a->error == b->error);
    for (int i = 0; i < 100; i++) {
        const fret_real y = most * uniform(0, 1);
        fret_place at, also, inner[2] = {{0, 0}, {0, 0}};
        fret_real K[2];
        CHECK(fret_cells_find(a, BY_DEPTH, y, &at) && fret_cells_find(b, BY_DEPTH, y, &also));
        CHECK(at.i == also.i && at.s == also.s);
        CHECK(fret_cells_radius(a, &at) == fret_cells_radius(b, &at));
        CHECK(fret_cells_level(a, BY_LOAD, &at) == fret_cells_level(b, BY_LOAD, &at));
        const fret_stretch own = slice(a, BY_DEPTH, &at, y / 2, y / 2, &inner[0], &K[0]),
                           other = slice(b, BY_DEPTH, &at, y / 2, y / 2, &inner[1], &K[1]);
        CHECK(own.G == other.G && own.L == other.L && K[0] == K[1]);
    }
}

/* Of another size they are scaled, and bit for bit what they are alone, whatever they are scaled from. */
static void sizes(const fret_gap *gap, double k) {
    fret_gap large = *gap, larger = *gap;
    fret_cells *first = NULL, *alone = NULL, *like = NULL, *last = NULL, *other = NULL;
    large.b *= 3;
    large.R *= 0.7;
    large.slope *= 1.1;
    larger.R *= 1e9;
    CHECK_OK(fret_cells_make(gap, k, NULL, NULL, &first));
    CHECK_OK(fret_cells_make(&large, k, NULL, NULL, &alone));
    CHECK_OK(fret_cells_make(&larger, k, first, NULL, &last));
    fret_cells_free(first);
    CHECK_OK(fret_cells_make(&large, k, last, NULL, &like));
    CHECK(like->unit && like->unit == last->unit && like->unit != alone->unit);
    fret_cells_free(last);
    same_cells(like, alone);
    /* a shape of another kind has its own */
    CHECK_OK(fret_cells_make(gap == shapes ? shapes + 1 : shapes, k, like, NULL, &other));
    CHECK(other->unit && other->unit != like->unit);
    fret_cells_free(other);
    fret_cells_free(like);
    fret_cells_free(alone);
}

int main(int argc, char **argv) {
    unit_start("cells", argc, argv);
    for (size_t i = 0; i < sizeof shapes / sizeof *shapes; i++)
        for (size_t j = 0; j < sizeof gradings / sizeof *gradings; j++) {
            CASE(places(&shapes[i], gradings[j], UNIT_TOL(2e-16L, 1e-13L)));
            CASE(slices(&shapes[i], gradings[j], UNIT_TOL(2e-14L, 1e-11L)));
            CASE(areas(&shapes[i], gradings[j]));
            if (shapes[i].kind != FRET_GAP_SUM)
                CASE(sizes(&shapes[i], gradings[j]));
        }
    for (rough how = SMOOTH; how <= CONE; how++) {
        struct fret_table *t = table_of(how, how == WIDER ? 40 : 100);
        const fret_gap gap = {.kind = FRET_GAP_TABLE, .table = t};
        for (size_t j = 0; j < sizeof gradings / sizeof *gradings; j += 1 + unit_skips(1)) {
            CASE(places(&gap, gradings[j], UNIT_TOL(3e-16L, 1e-13L)));
            CASE(slices(&gap, gradings[j], UNIT_TOL(2e-14L, 1e-11L)));
        }
        fret_table_free(t);
    }
    CASE(shared());
    return unit_finish();
}
