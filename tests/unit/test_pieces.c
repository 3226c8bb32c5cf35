/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A prepared contact against its slow twin, which answers by searches and quadrature: random contacts of all
 * shapes, random questions and histories. FRET_PIECES=N asks N times as much and prints the worst errors. */
#include "contact/phase.h"
#include "contact/pieces.h"
#include "unit.h"

static unsigned long long seed = 7;
static double uniform(double lo, double hi) {
    return unit_random(&seed, lo, hi);
}

/* 10^-most .. 1 */
static double small(double most) {
    return pow(10, uniform(-most, 0));
}

/* ---- contacts ---------------------------------------------------------------------------------- */

/* Of a dense table no row has pieces of its own: its law alone is smooth. Prepared for an error, and for
 * none; or each row is off by as much as a file of nine digits rounds it. */
enum { ROWS = 48, DENSE_ROWS = 4000 };
static const double BORNE = 1e-8, ROUNDED = 1e-9;

/* A sphere in rows; each of them off by that part, and at uneven distances. */
static struct fret_table *make_table(double R, double wide, int rows, double off) {
    const bool rough = off > ROUNDED;
    static double r[DENSE_ROWS], f[DENSE_ROWS];
    struct fret_table *table = NULL;
    r[0] = f[0] = 0;
    for (int i = 1; i < rows; i++) {
        r[i] = wide * (i + (rough ? uniform(-0.3, 0.3) : 0)) / rows;
        f[i] = r[i] * r[i] / (R + sqrt(R * R - r[i] * r[i])) * (1 + (off > 0 ? uniform(0, off) : 0));
    }
    CHECK_OK(fret_table_make(r, f, (size_t)rows, NULL, &table));
    return table;
}

typedef enum shape {
    SUM,
    SUM_STEEP,
    FLAT_CONE,
    FLAT_PARABOLOID,
    FLAT_ROUNDED,
    SPHERE,
    TABLE,
    ROUGH_TABLE,
    DENSE_TABLE,
    DENSE_EXACT,
    DENSE_ROUNDED,
    SHAPES
} shape;

static const char *const shape_name[SHAPES] = {
    "sum",   "steep sum",   "flat-cone",       "flat-paraboloid", "flat-rounded",  "exact-sphere",
    "table", "rough table", "dense, for 1e-8", "dense table",     "dense, rounded"};

static bool is_dense(shape which) {
    return which >= DENSE_TABLE;
}

static bool for_an_error(shape which) {
    return is_dense(which) && which != DENSE_EXACT;
}

static fret_gap make_gap(shape which) {
    const double R = 1e-2 * small(1), b = 2e-4 * small(1.5);
    fret_gap g = {.R = R, .b = b, .slope = small(2)};
    switch (which) {
    case SUM:
    case SUM_STEEP:
        g.kind = FRET_GAP_SUM;
        g.terms = 2;
        g.power[0] = (fret_power){which == SUM ? uniform(0.6, 2) : 4, 1e-6 * small(2), 1e-4};
        g.power[1] = (fret_power){which == SUM ? uniform(2, 4) : 12, 1e-6 * small(2), 1e-4};
        break;
    case FLAT_CONE:
        g.kind = FRET_GAP_FLAT_CONE;
        break;
    case FLAT_PARABOLOID:
        g.kind = FRET_GAP_FLAT_PARABOLOID;
        break;
    case FLAT_ROUNDED:
        g.kind = FRET_GAP_FLAT_ROUNDED;
        break;
    case SPHERE:
        g.kind = FRET_GAP_EXACT_SPHERE;
        break;
    default:
        g.kind = FRET_GAP_TABLE;
        g.table = make_table(R, 0.2 * R, is_dense(which) ? DENSE_ROWS : ROWS,
                             which == ROUGH_TABLE     ? 1e-3
                             : which == DENSE_ROUNDED ? ROUNDED
                                                      : 0);
    }
    return g;
}

/* The same contact twice, and a load that it carries. */
typedef struct twins {
    fret_normal *plain, *ready;
    struct fret_table *table;
    double F;
} twins;

static bool make_twins(shape which, double k, twins *out) {
    const fret_material m = {{{210e9, 0.3, false}, {70e9, 0.35, false}}, k, 1e-3};
    const fret_gap gap = make_gap(which);
    const double start = which >= FLAT_CONE && which <= FLAT_ROUNDED ? gap.b : 0;
    const double a = which >= SPHERE ? gap.R * uniform(0.02, 0.19) : start + 2e-4 * small(1.5);
    fret_press p;
    *out = (twins){.table = (struct fret_table *)gap.table};
    CHECK_OK(fret_normal_make(&m, &gap, &out->plain));
    CHECK_OK(fret_normal_make(&m, &gap, &out->ready));
    CHECK_OK(fret_press_by_radius(out->plain, a, &p));
    out->F = (double)p.F;
    CHECK_OK(fret_normal_prepare(out->ready, out->F, for_an_error(which) ? BORNE : 0));
    return !isnan(fret_normal_prepared(out->ready));
}

static void end_twins(twins *t) {
    fret_normal_free(t->plain);
    fret_normal_free(t->ready);
    fret_table_free(t->table);
}

/* ---- worst errors ------------------------------------------------------------------------------ */

typedef enum what { PLACE, LOSS, THIN, PHASE, HISTORY, WHATS } what;
static const char *const what_name[WHATS] = {"places", "dW", "slices", "phases", "histories"};
static fret_real worst[SHAPES][WHATS];
static long asked[SHAPES];

/* What the slow twin promises itself is no better. Slices are asked of the pieces themselves: of a dense
 * table thin ones have few digits. */
static const fret_real promise[WHATS] = {2e-15L, 2e-14L, 1e-13L, 1e-12L, 1e-9L},
                       borne[WHATS] = {1e-8L, 1e-7L, 0, 1e-8L, 1e-8L};

static double grading_now, told_now; /* the error that the pieces tell of themselves */

/* What a thin part t of the contact loses is a third power of it: an error of the law, relative to the whole,
 * is as much more of it. */
static fret_real thin(shape which, fret_real t) {
    return which > DENSE_TABLE ? 1 + 0.05L / (t * t) : 1;
}

static void compare_at(int line, shape which, what w, fret_real got, fret_real want, fret_real scale) {
    const fret_real error = got == want ? 0 : fabsl(got - want) / scale;
    if (unit_count(error <= (for_an_error(which) ? borne : promise)[w] +
                                (which == DENSE_EXACT ? 10 * told_now : 0),
                   __FILE__, line))
        printf("%s, k = %g: %.18Lg, expected %.18Lg, error %.1Le\n", shape_name[which], grading_now, got,
               want, error);
    if (error > worst[which][w])
        worst[which][w] = error;
    asked[which]++;
}

#define compare(...) compare_at(__LINE__, __VA_ARGS__)

static void places(shape which, const twins *t) {
    const double F = t->F * small(6);
    fret_press want, got;
    CHECK_OK(fret_press_by_force(t->plain, F, &want));
    CHECK_OK(fret_press_by_force(t->ready, F, &got));
    compare(which, PLACE, got.dz, want.dz, want.dz);
    compare(which, PLACE, got.a, want.a, want.a);
    CHECK_OK(fret_press_by_depth(t->plain, (double)want.dz, &want));
    CHECK_OK(fret_press_by_depth(t->ready, (double)want.dz, &got));
    compare(which, PLACE, got.F, want.F, want.F);
    const fret_real x = want.a * uniform(0, 1), g = fret_normal_profile(t->plain, x);
    compare(which, PLACE, fret_normal_profile(t->ready, x), g, g > 0 ? g : 1);
}

/* Near k = -1 the slow twin is good to 1e-8 alone where all slips, and at a flat end the quadrature of the
 * definition does not resolve the front: one of both must agree. */
static fret_real nearer(fret_real got, fret_real a, fret_real b) {
    return fabsl(got - a) < fabsl(got - b) ? a : b;
}

/* Up to gross slip within 1e-9, and it itself. */
static void losses(shape which, const twins *t) {
    fret_contact plain = {.normal = t->plain, .mu = 0.3}, ready;
    fret_loading first[2];
    fret_real want = 0, got = 0, reference = 0, agreement = 0;
    CHECK_OK(fret_press_by_force(t->plain, t->F * small(3), &plain.press));
    ready = plain;
    ready.normal = t->ready;
    const double limit = (double)(0.3 * plain.press.F), part = uniform(0, 1) < 0.3   ? 1 - small(9)
                                                               : uniform(0, 1) < 0.1 ? 1
                                                                                     : uniform(0.01, 1);
    CHECK_OK(fret_cycle_loss_by_force(&plain, limit * part, &want));
    if (!is_dense(which))
        CHECK_OK(fret_reference_loss_by_force(&plain, limit * part, &reference, &agreement));
    CHECK_OK(fret_cycle_loss_by_force(&ready, limit * part, &got));
    compare(which, LOSS, got, nearer(got, want, reference), want * thin(which, part));
    CHECK_OK(fret_loading_by_force(&plain, limit * part, &first[0]));
    CHECK_OK(fret_loading_by_force(&ready, limit * part, &first[1]));
    compare(which, LOSS, first[1].dx, first[0].dx, first[0].dx * thin(which, part));
    compare(which, LOSS, first[1].c, first[0].c, plain.press.a);
    const double dx = (double)fret_gross_slip(&plain) * part;
    CHECK_OK(fret_cycle_loss_by_displacement(&plain, dx, &want));
    if (!is_dense(which))
        CHECK_OK(fret_reference_loss_by_displacement(&plain, dx, &reference, &agreement));
    CHECK_OK(fret_cycle_loss_by_displacement(&ready, dx, &got));
    compare(which, LOSS, got, nearer(got, want, reference), want * thin(which, part));
}

static void slices(shape which, const twins *t) {
    const fret_real F = t->F * small(2);
    const fret_level outer = {fret_law_depth(t->plain, F), F};
    const fret_real h = outer.y * small(7);
    const fret_real weak = which >= TABLE ? 1 + 1e-5L * outer.y / h : 1; /* a row within a thin slice */
    const fret_slice want = fret_law_slice(t->plain, &outer, h), got = fret_law_slice(t->ready, &outer, h);
    compare(which, THIN, got.w, want.w, want.w * weak);
    compare(which, THIN, got.J, want.J, want.J * weak);
    compare(which, THIN, got.G, want.G, want.G * weak);
    if (which < TABLE) /* of those the slow twin has 12 digits; losses() holds L against the definition */
        compare(which, THIN, got.L, want.L, want.L);
    compare(which, THIN, fret_law_load(t->ready, &outer, h), want.w, want.w * weak);
    compare(which, THIN, fret_law_thickness(t->ready, &outer, want.w), h, h * weak);
}

/* The quadrature of the slow twin takes the sharp kinks of a table near k = -1 for noise: of parts it is
 * better. */
static fret_real loss_in_parts(const fret_phase *whole, int parts) {
    fret_real sum = 0;
    for (int i = 0; i < parts; i++) {
        const fret_real from = (fret_real)i / parts, to = (fret_real)(i + 1) / parts;
        fret_phase p = *whole;
        p.edge0 = whole->edge0 + from * (whole->edge1 - whole->edge0);
        p.edge1 = whole->edge0 + to * (whole->edge1 - whole->edge0);
        p.front0 = whole->front0 + from * (whole->front1 - whole->front0);
        p.front1 = whole->front0 + to * (whole->front1 - whole->front0);
        sum += fret_phase_loss(&p);
    }
    return sum;
}

/* As chords of a swinging load are, and longer ones: relative to what one of the whole contact loses. */
static void phases(shape which, const twins *t) {
    const coordinate by = uniform(0, 1) < 0.5 ? DEPTH : LOAD;
    const fret_real edge = by == LOAD ? (fret_real)t->F : fret_law_depth(t->plain, t->F);
    fret_phase p = {.normal = t->plain, .by = by, .edge0 = edge * uniform(0.5, 1)};
    p.edge1 = fminl(p.edge0 * (1 + uniform(-1, 1) * small(3)), edge);
    p.front0 = fminl(p.edge0, p.edge1) * (1 - small(3));
    p.front1 = p.front0 * (1 - small(3));
    const fret_real want = loss_in_parts(&p, which >= TABLE && !is_dense(which) ? 256 : 1);
    p.normal = t->ready;
    const fret_real got = fret_phase_loss(&p);
    const fret_real all =
        (by == LOAD ? fret_law_depth(t->plain, p.edge0) : fret_law_force(t->plain, p.edge0)) * p.edge0;
    compare(which, PHASE, got, want, is_dense(which) ? all : want + 1e-6L * all);
    CHECK(got >= 0);
}

/* Both twins along one way: pressed, slid, opened and pressed again. */
static void history(shape which, const twins *t, int steps) {
    const double mu = 0.3;
    fret_memory *plain = NULL, *ready = NULL;
    fret_state a = {0}, b = {0};
    fret_press top;
    CHECK_OK(fret_memory_make(t->plain, mu, &plain));
    CHECK_OK(fret_memory_make(t->ready, mu, &ready));
    CHECK_OK(fret_press_by_force(t->plain, t->F, &top));
    const fret_real slip = fret_gross_slip(&(fret_contact){t->plain, mu, top});
    for (int i = 0; i < steps; i++) {
        const bool opens = uniform(0, 1) < 0.03;
        const double FN = t->F * uniform(0.3, 1);
        fret_step s = {FRET_TO_FORCE, FRET_TO_FX, FN, mu * FN * uniform(-1, 1) * (1 - 1e-12)};
        if (opens)
            s = (fret_step){FRET_TO_DEPTH, FRET_TO_DX, -1e-9, (double)(slip * uniform(-1, 1))};
        else if (uniform(0, 1) < 0.3)
            s = (fret_step){FRET_TO_FORCE, FRET_TO_DX, FN, (double)(a.dx + slip * uniform(-1, 1))};
        CHECK_OK(fret_memory_step(plain, &s));
        CHECK_OK(fret_memory_step(ready, &s));
        fret_memory_state(plain, &a);
        fret_memory_state(ready, &b);
        const fret_real load = mu * t->F, work = load * slip;
        compare(which, HISTORY, b.Fx, a.Fx, load);
        compare(which, HISTORY, b.dx - a.dx, 0, slip);
        compare(which, HISTORY, b.W, a.W, work + a.W);
        compare(which, HISTORY, b.U, a.U, work);
    }
    fret_memory_free(plain);
    fret_memory_free(ready);
}

/* ---- all of it --------------------------------------------------------------------------------- */

static const double grading[] = {-0.99, -0.8, -0.4, 0, 0.3, 0.7, 0.99};
enum { GRADINGS = sizeof grading / sizeof *grading };

/* There, near k = -1, the load hardly tells the radius: the slow twin keeps 1e-6 of the loss of a phase. */
static bool is_flat(shape which) {
    return which >= FLAT_CONE && which <= FLAT_ROUNDED;
}

static void contact(shape which, double k, int times) {
    const bool slow = which >= TABLE, dense = is_dense(which);
    const unsigned long long before = seed;
    grading_now = k;
    twins t;
    if ((which == ROUGH_TABLE && k < -0.5)                 /* the profile falls */
        || (dense && k != -0.99 && k != -0.4 && k != 0.7)) /* the slow twin is */
        return;
    if (make_twins(which, k, &t)) {
        fret_point unused;
        told_now = fret_normal_prepared(t.ready);
        CHECK(fret_pieces_point(t.ready->pieces, true, t.F, &unused));
        for (int i = 0; i < times * (dense ? 1 : slow ? 3 : 24); i++) {
            places(which, &t);
            losses(which, &t);
            if (!dense)
                slices(which, &t);
        }
        const bool moves = which <= DENSE_TABLE && !(is_flat(which) && k < -0.5); /* else the slow twin is */
        for (int i = 0; i < times * (slow ? 1 : 12) && moves; i++)
            phases(which, &t);
        if (fabs(k) < 0.9 && moves)
            history(which, &t, times * (dense ? 1 : slow ? 2 : 8));
    } else {
        if (unit_count(which >= TABLE && k < 0, __FILE__, __LINE__)) /* kinks may be too sharp */
            printf("no pieces: %s, k = %g\n", shape_name[which], k);
    }
    end_twins(&t);
    if (dense) /* the others draw what they drew without it */
        seed = before;
}

/* What comes out does not hang on what was asked before. */
static void prepares_alike(void) {
    unit_scene s = unit_make_scene(2, 0.3);
    s.gap = (fret_gap){.kind = FRET_GAP_EXACT_SPHERE, .R = 1e-2};
    fret_normal *a = unit_make_normal(&s), *b = unit_make_normal(&s);
    fret_press p, q;
    CHECK(isnan(fret_normal_prepared(a)));
    CHECK_OK(fret_normal_prepare(a, 100, 0));
    CHECK_OK(fret_normal_prepare(b, 3000, 0));
    CHECK_OK(fret_normal_prepare(b, 2e-5, 0));
    CHECK_OK(fret_normal_prepare(b, 70, 0));
    CHECK(fret_normal_prepared(a) < 1e-16 && fret_normal_prepared(a) == fret_normal_prepared(b));
    for (double F = 1e-3; F < 1000; F *= 1.7) {
        CHECK_OK(fret_press_by_force(a, F, &p));
        CHECK_OK(fret_press_by_force(b, F, &q));
        CHECK(p.dz == q.dz && p.a == q.a);
    }
    CHECK_ERROR(fret_normal_prepare(a, -1, 0), FRET_NOT_POSITIVE, "FN");
    CHECK_ERROR(fret_normal_prepare(a, 1, -1e-8), FRET_NEGATIVE, "error");
    CHECK_ERROR(fret_normal_prepare(a, 1, (double)NAN), FRET_NOT_FINITE, "error");
    CHECK_OK(fret_normal_prepare(a, 1e300, 0)); /* more than the sphere carries */
    CHECK_OK(fret_press_by_force(a, 100, &p));
    CHECK_OK(fret_press_by_force(b, 100, &q));
    CHECK_REL(p.dz, q.dz, UNIT_TOL(1e-17L, 1e-14L));
    s = unit_make_scene(2, 0.3);
    a = unit_make_normal(&s);
    CHECK_OK(fret_normal_prepare(a, 100, 0));
    CHECK(isnan(fret_normal_prepared(a)));
}

/* The law is as smooth as that of few rows; asked for an error, fewer pieces do, and it is told. The thinnest
 * slice, of no row, goes by the table itself. */
static void bears_an_error(void) {
    const fret_material m = {{{210e9, 0.3, false}, {70e9, 0.35, false}}, 0.3, 1e-3};
    const fret_gap gap = {.kind = FRET_GAP_TABLE, .table = make_table(1e-2, 2e-3, DENSE_ROWS, 0)};
    fret_normal *n = NULL;
    fret_contact c = {.mu = 0.3};
    fret_real loss[2];
    CHECK_OK(fret_normal_make(&m, &gap, &n));
    CHECK_OK(fret_press_by_radius(n, 1.5e-3, &c.press));
    c.normal = n;
    const double F = (double)c.press.F, least = 1e-9 * F;
    CHECK_OK(fret_cycle_loss_by_force(&c, least, &loss[0]));
    CHECK_OK(fret_normal_prepare(n, F, 0));
    CHECK(fret_normal_prepared(n) <= 1e-15); /* row by row where nothing else is as good */
    CHECK_OK(fret_cycle_loss_by_force(&c, least, &loss[1]));
    CHECK_REL(loss[1], loss[0], 1e-8L); /* rounding over the thickness */
    CHECK_OK(fret_normal_prepare(n, F, BORNE));
    CHECK(fret_normal_prepared(n) > 1e-15 && fret_normal_prepared(n) < BORNE);
    CHECK_OK(fret_cycle_loss_by_force(&c, least, &loss[1]));
    CHECK(loss[0] > 0 && loss[0] == loss[1]);
    fret_normal_free(n);
    fret_table_free((struct fret_table *)gap.table);
}

/* Slices too thin for the polynomials of many rows are those of the rows that a single question takes, also
 * across blocks of them, and of a contact that shares them. */
static void thin_slices_of_many(void) {
    fret_material m = {{{210e9, 0.3, false}, {70e9, 0.35, false}}, 0.3, 1e-3};
    const fret_gap gap = {.kind = FRET_GAP_TABLE, .table = make_table(1e-2, 3e-4, DENSE_ROWS, 0)};
    fret_normal *plain = NULL, *ready = NULL, *other = NULL;
    fret_contact a = {.mu = 0.3}, b = a;
    CHECK_OK(fret_normal_make(&m, &gap, &plain));
    CHECK_OK(fret_press_by_radius(plain, 2.8e-4, &a.press));
    CHECK_OK(fret_normal_make(&m, &gap, &ready));
    CHECK_OK(fret_normal_prepare(ready, (double)a.press.F, 0));
    CHECK(!fret_pieces_by_rows(ready->pieces) && fret_pieces_rough(ready->pieces, 0));
    m.body[0].E0 = 100e9;
    CHECK_OK(fret_normal_make(&m, &gap, &other));
    CHECK_OK(fret_normal_share(other, ready));
    const fret_real softer = fret_normal_stiffness(other, 1) / fret_normal_stiffness(ready, 1),
                    give = other->foundation.eta / ready->foundation.eta;
    a.normal = plain;
    b = a;
    const double most = (double)a.press.F;
    for (double F = most; F > 0.3 * most; F *= 0.6)
        for (double t = 1e-3; t < 0.5; t *= 5) {
            const fret_real few = 2e-15L + 5e-18L / t;
            fret_real want, got;
            fret_loading first, same;
            CHECK_OK(fret_press_by_force(plain, F, &a.press));
            CHECK_OK(fret_cycle_loss_by_force(&a, 0.3 * F * t, &want));
            CHECK_OK(fret_loading_by_force(&a, 0.3 * F * t, &first));
            b.press = a.press;
            b.normal = ready;
            CHECK_OK(fret_cycle_loss_by_force(&b, 0.3 * F * t, &got));
            CHECK_REL(got, want, UNIT_TOL(few, 1e-8L));
            CHECK_OK(fret_loading_by_force(&b, 0.3 * F * t, &same));
            CHECK_REL(same.dx, first.dx, UNIT_TOL(few, 1e-9L));
            CHECK_OK(fret_cycle_loss_by_displacement(&b, (double)first.dx, &got));
            CHECK_REL(got, want, UNIT_TOL(few, 1e-8L));
            CHECK_OK(fret_loading_by_displacement(&b, (double)first.dx, &same));
            CHECK_REL(same.Fx, first.Fx, UNIT_TOL(few, 1e-9L));
            b.normal = other;
            b.press.F *= softer;
            CHECK_OK(fret_cycle_loss_by_displacement(&b, (double)(first.dx * give), &got));
            CHECK_REL(got, want * softer * give, UNIT_TOL(1e-14L, 1e-8L));
        }
    fret_normal_free(ready);
    fret_normal_free(other);
    fret_normal_free(plain);
    fret_table_free((struct fret_table *)gap.table);
}

/* Rows too rough for polynomials are made block by block when they are asked for: a slip is what a single
 * question says, its digits do not hang on what was asked before, nor on who stopped it. */
static void rough_rows_on_demand(void) {
    enum { LOADS_ASKED = 7, CONTACTS = 3 };
    const fret_material m = {{{210e9, 0.3, false}, {70e9, 0.35, false}}, 0.3, 1e-3};
    const fret_gap gap = {.kind = FRET_GAP_TABLE, .table = make_table(1e-2, 3e-4, DENSE_ROWS, 1e-6)};
    volatile sig_atomic_t stop = 0;
    fret_contact c[CONTACTS];
    fret_normal *n[CONTACTS], *plain;
    fret_real loss[CONTACTS][LOADS_ASKED], dx[CONTACTS][LOADS_ASKED], single;
    fret_press press;
    CHECK_OK(fret_normal_make(&m, &gap, &plain));
    CHECK_OK(fret_press_by_radius(plain, 2.9e-4, &press));
    for (int i = 0; i < CONTACTS; i++) {
        CHECK_OK(fret_normal_make(&m, &gap, &n[i]));
        CHECK_OK(fret_normal_prepare(n[i], (double)press.F, 0));
        CHECK(fret_pieces_by_rows(n[i]->pieces) && fret_normal_prepared(n[i]) <= 2e-15);
        c[i] = (fret_contact){.normal = n[i], .mu = 0.3};
        CHECK_OK(fret_press_by_force(n[i], (double)press.F, &c[i].press));
    }
    fret_normal_stop(n[2], &stop);
    for (int j = 0; j < LOADS_ASKED; j++)
        for (int i = 0; i < CONTACTS; i++) {
            const int k = i == 1 ? LOADS_ASKED - 1 - j : j;
            const double FA = 0.3 * (double)press.F * (k == 0 ? 1e-4 : 0.16 * k);
            fret_loading first;
            stop = i == 2;
            if (stop)
                CHECK_CODE(fret_cycle_loss_by_force(&c[i], FA, &loss[i][k]), FRET_INTERRUPTED);
            stop = 0;
            CHECK_OK(fret_cycle_loss_by_force(&c[i], FA, &loss[i][k]));
            CHECK_OK(fret_loading_by_force(&c[i], FA, &first));
            dx[i][k] = first.dx;
        }
    for (int j = 0; j < LOADS_ASKED; j++)
        for (int i = 1; i < CONTACTS; i++)
            CHECK(loss[i][j] == loss[0][j] && dx[i][j] == dx[0][j]);
    const fret_contact alone = {.normal = plain, .mu = 0.3, .press = press};
    for (int j = 0; j < LOADS_ASKED; j += 2) {
        CHECK_OK(
            fret_cycle_loss_by_force(&alone, 0.3 * (double)press.F * (j == 0 ? 1e-4 : 0.16 * j), &single));
        CHECK_REL(loss[0][j], single, UNIT_TOL(j ? 2e-15L : 1e-13L, 1e-8L));
    }
    for (int i = 0; i < CONTACTS; i++)
        fret_normal_free(n[i]);
    fret_normal_free(plain);
    fret_table_free((struct fret_table *)gap.table);
}

/* Of the work that it takes to set up nothing is left over when it is stopped. */
static void stops(void) {
    volatile sig_atomic_t stop = 1;
    unit_scene s = unit_make_scene(2, 0.3);
    s.gap = (fret_gap){.kind = FRET_GAP_EXACT_SPHERE, .R = 1e-2};
    fret_normal *n = unit_make_normal(&s);
    fret_normal_stop(n, &stop);
    CHECK_CODE(fret_normal_prepare(n, 100, 0), FRET_INTERRUPTED);
    CHECK(isnan(fret_normal_prepared(n)));
    stop = 0;
    CHECK_OK(fret_normal_prepare(n, 100, 0));
    CHECK(!isnan(fret_normal_prepared(n)));
}

/* A flat end so blunt, and rows so close, that no digit shows what lies beyond: no piece is made, none is
 * asked. */
static void without_pieces(void) {
    const fret_material material = {{{210e9, 0.3, false}, {210e9, 0.3, false}}, -0.328, 0.02};
    const fret_gap blunt = {.kind = FRET_GAP_FLAT_PARABOLOID, .b = 0.21658e-3, .R = 1e-115};
    double r[8], f[8];
    for (int i = 0; i < 8; i++) {
        r[i] = 1e-310 * i / 7;
        f[i] = 50 * r[i] * r[i];
    }
    fret_gap gap = {.kind = FRET_GAP_TABLE};
    CHECK_OK(fret_table_make(r, f, 8, NULL, (struct fret_table **)&gap.table));
    for (int i = 0; i < 2; i++) {
        fret_normal *n = NULL;
        fret_contact c = {.mu = 0.4};
        fret_loading loading;
        fret_real loss;
        CHECK_OK(fret_normal_make(&material, i ? &gap : &blunt, &n));
        CHECK_OK(fret_normal_prepare(n, 75, 0));
        CHECK(isnan(fret_normal_prepared(n)));
        c.normal = n;
        if (!fret_press_by_force(n, 75, &c.press).code) {
            CHECK_OK(fret_loading_by_force(&c, 1, &loading));
            CHECK_OK(fret_cycle_loss_by_force(&c, 1, &loss));
            CHECK(loss >= 0);
        }
        fret_normal_free(n);
    }
    fret_table_free((struct fret_table *)gap.table);
}

static void print_table(int times) {
    printf("# make pieces PIECES=%d: polynomials against searches and quadrature, worst\n", times);
    printf(
        "# relative difference; phases of the loss + 1e-6 of F_N delta_z, histories of their scales\n%-16s",
        "shape");
    for (what w = 0; w < WHATS; w++)
        printf("%10s", what_name[w]);
    printf("%10s\n", "asked");
    for (shape which = 0; which < SHAPES; which++) {
        printf("%-16s", shape_name[which]);
        for (what w = 0; w < WHATS; w++)
            printf("%10.1Le", worst[which][w]);
        printf("%10ld\n", asked[which]);
    }
}

int main(int argc, char **argv) {
    unit_start("pieces", argc, argv);
    const char *many = getenv("FRET_PIECES");
    const int times = many ? atoi(many) : 1;
    for (int i = 0; i < times; i++)
        for (shape which = 0; which < SHAPES; which++)
            for (int j = 0; j < GRADINGS; j++)
                if (many || ((j + (int)which) % 2 && !unit_skips((size_t)j / 2)))
                    CASE(contact(which, grading[j], 1));
    CASE(prepares_alike());
    CASE(bears_an_error());
    CASE(thin_slices_of_many());
    if (!unit_skips(1))
        CASE(rough_rows_on_demand());
    CASE(stops());
    CASE(without_pieces());
    if (many)
        print_table(times);
    return unit_finish();
}
