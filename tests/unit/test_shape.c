/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Every gap but the single power: formulas, engine and tables against each other and the references. */
#include "law/normal.h"
#include "law/table.h"
#include "number/integral.h"
#include "unit.h"

static const char *const kinds[] = {"power",        "sum",          "flat-cone", "flat-paraboloid",
                                    "flat-rounded", "exact-sphere", "table",     "flat"};

/* The worst error of each shape at each k, for FRET_UNIT_VERBOSE. */
enum { SHAPES = 7, GRADINGS = 9 };
static const double gradings[GRADINGS] = {-0.99, -0.9, -0.7, -0.3, 0, 0.3, 0.7, 0.9, 0.99};
static fret_real worst[SHAPES][GRADINGS];

static void note(const unit_scene *s, fret_real value, fret_real expected, fret_real scale) {
    for (int i = 0; i < GRADINGS; i++)
        if (gradings[i] == s->material.k)
            worst[s->gap.kind][i] = fmaxl(worst[s->gap.kind][i], fabsl((value - expected) / scale));
}

static void show_worst(void) {
    if (!getenv("FRET_UNIT_VERBOSE"))
        return;
    printf("%-16s", "worst, k =");
    for (int j = 0; j < GRADINGS; j++)
        printf("%9.2f", gradings[j]);
    for (int i = 1; i < SHAPES; i++) {
        printf("\n%-16s", kinds[i]);
        for (int j = 0; j < GRADINGS; j++)
            printf("%9.1Le", worst[i][j]);
    }
    printf("\n");
}

#define NEAR(value, expected, scale, tolerance)                                                              \
    do {                                                                                                     \
        const fret_real value_ = (value);                                                                    \
        note(&s, value_, (expected), (scale));                                                               \
        CHECK_ABS(value_, (expected), (scale), (tolerance));                                                 \
    } while (0)

/* The table at r = end t (1-bend+bend t), t = i/(count-1), of a cubic in r-flat. */
static struct fret_table *read_table(const unit_table *t) {
    const double end = unit_input(t, 1), flat = unit_input(t, 2), bend = unit_input(t, 3);
    const int count = (int)unit_input(t, 4);
    double r[64], f[64];
    struct fret_table *out = NULL;
    for (int i = 0; i < count && i < 64; i++) {
        double u = (double)i / (count - 1);
        r[i] = end * u * (1 - bend + bend * u);
        double x = r[i] > flat ? r[i] - flat : 0;
        f[i] = x * (unit_input(t, 5) + x * (unit_input(t, 7) + x * unit_input(t, 9)));
    }
    CHECK_OK(fret_table_make(r, f, (size_t)count, NULL, &out));
    return out;
}

static unit_scene read_shape(const unit_table *t, struct fret_table **table) {
    unit_scene s = unit_make_scene(2, unit_input(t, 14));
    memset(&s.gap, 0, sizeof s.gap);
    int kind = atoi(t->cell[0]);
    s.gap.kind = (fret_gap_kind)kind;
    s.gap.b = unit_input(t, 1);
    s.gap.R = unit_input(t, 2);
    s.gap.slope = unit_input(t, 3);
    for (int i = 0; i < 3 && s.gap.kind == FRET_GAP_SUM; i++)
        if (unit_input(t, 5 + 2 * i) != 0)
            s.gap.power[s.gap.terms++] = (fret_power){unit_input(t, 4 + 2 * i), unit_input(t, 5 + 2 * i), 1};
    s.material.body[0] = (fret_body){unit_input(t, 10), unit_input(t, 11), false};
    s.material.body[1] = (fret_body){unit_input(t, 12), unit_input(t, 13), false};
    s.material.c0 = unit_input(t, 15);
    s.mu = unit_input(t, 16);
    if (s.gap.kind == FRET_GAP_TABLE)
        s.gap.table = *table = read_table(t);
    return s;
}

static void reference(void) {
    unit_table t;
    if (!unit_open(&t, "shape.csv"))
        return;
    const fret_real tol = UNIT_TOL(2e-15L, 1e-11L);
    while (unit_row(&t)) {
        struct fret_table *table = NULL;
        unit_scene s = read_shape(&t, &table);
        double a = unit_input(&t, 17), FA = unit_input(&t, 18);
        fret_real dz = unit_result(&t, 19), F = unit_result(&t, 20), kn = unit_result(&t, 21);
        fret_real g1 = unit_result(&t, 22), c = unit_result(&t, 23), dx = unit_result(&t, 24);
        fret_real dW = unit_result(&t, 25);
        const fret_normal *n = unit_make_normal(&s);
        fret_press p = {.F = 0}, q = p;
        CHECK_OK(fret_press_by_radius(n, a, &p));
        CHECK(p.a == a);
        NEAR(p.dz, dz, dz, tol);
        NEAR(p.F, F, F, tol);
        NEAR(fret_normal_stiffness(n, a), kn, kn, tol);
        fret_real g = 0, slope = 0;
        CHECK_OK(fret_gap_g(&s.gap, s.material.k, a, &g, &slope));
        NEAR(g, dz, dz, tol);
        NEAR(slope, g1, g1, tol);

        /* the rounding of the argument is followed to first order */
        double F_ = (double)F, dz_ = (double)dz;
        CHECK_OK(fret_press_by_force(n, F_, &q));
        CHECK(q.F == F_);
        NEAR(q.dz, dz + (F_ - F) / kn, dz, tol);
        NEAR(q.a, a + (F_ - F) / (kn * g1), a, tol);
        CHECK_OK(fret_press_by_depth(n, dz_, &q));
        CHECK(q.dz == dz_);
        NEAR(q.F, F + (dz_ - dz) * kn, F, tol);
        NEAR(q.a, a + (dz_ - dz) / g1, a, tol);
        NEAR(fret_law_radius(n, dz), (fret_real)a, a, tol);
        NEAR(fret_law_force(n, dz), F, F, tol);
        NEAR(fret_law_depth(n, F), dz, dz, tol);

        fret_loading f = {0, 0, 0, 0};
        fret_real loss = -1;
        p = (fret_press){.F = F, .dz = dz, .a = a};
        CHECK_OK(fret_loading_by_force(&(fret_pressed){n, s.mu, p}, FA, &f));
        NEAR(f.c, c, c, tol);
        NEAR(f.dx, dx, dx, tol);
        CHECK_OK(fret_cycle_loss_by_force(&(fret_pressed){n, s.mu, p}, FA, &loss));
        NEAR(loss, dW, dW, tol);
        fret_table_free(table);
    }
}

/* ---- identities -------------------------------------------------------------------------------- */

static unit_scene of_kind(fret_gap_kind kind, double k) {
    unit_scene s = unit_make_scene(2, k);
    memset(&s.gap, 0, sizeof s.gap);
    s.gap.kind = kind;
    s.gap.b = 1e-3;
    s.gap.R = 1e-2;
    s.gap.slope = 0.05;
    if (kind == FRET_GAP_SUM) {
        s.gap.terms = 2;
        s.gap.power[0] = (fret_power){2, 50, 1};
        s.gap.power[1] = (fret_power){4, -2e6, 1};
    }
    return s;
}

/* Samples `gap` at count points to `end`; the last places are drawn at random between the even ones where
 * `uneven`. */
static struct fret_table *sample(const fret_gap *gap, int count, double end, bool uneven) {
    double *r = malloc(2 * (size_t)count * sizeof *r), *f = r + count;
    struct fret_table *t = NULL;
    unsigned long long seed = 11;
    if (!r)
        return NULL;
    for (int i = 0; i < count; i++) {
        double move = uneven && i > 0 && i + 1 < count ? unit_random(&seed, -0.3, 0.3) : 0;
        fret_real y = 0;
        r[i] = end * (i + move) / (count - 1);
        CHECK_OK(fret_gap_f(gap, r[i], &y));
        f[i] = (double)y;
    }
    CHECK_OK(fret_table_make(r, f, (size_t)count, NULL, &t));
    free(r);
    return t;
}

/* With its slopes given, a cubic comes back from two rows, one of which is within. */
static void sloped(void) {
    const double end = 3e-3, r[] = {0, 1.1e-3, end};
    const fret_gap cubic = {.kind = FRET_GAP_SUM, .terms = 2, .power = {{2, 50, 1}, {3, 2e4, 1}}};
    double f[3], slope[3];
    fret_gap table = {.kind = FRET_GAP_TABLE};
    struct fret_table *t = NULL;
    for (int i = 0; i < 3; i++) {
        f[i] = r[i] * r[i] * (50 + 2e4 * r[i]);
        slope[i] = r[i] * (100 + 6e4 * r[i]);
    }
    CHECK_OK(fret_table_sloped(r, f, slope, 3, NULL, &t));
    table.table = t;
    CHECK(fret_gap_tip(&table) == 2);
    for (int j = 0; j < GRADINGS; j++)
        for (int i = 1; i < 30; i++) {
            fret_real want, got, want_slope, got_slope, x = end * i / 30;
            CHECK_OK(fret_gap_g(&cubic, gradings[j], x, &want, &want_slope));
            CHECK_OK(fret_gap_g(&table, gradings[j], x, &got, &got_slope));
            CHECK_REL(got, want, 1e-14L);
            CHECK_REL(got_slope, want_slope, 1e-14L);
        }
    fret_table_free(t);
}

static fret_real lost(fret_contact *m, double tangential) {
    fret_step step = {FRET_KEEP_NORMAL, FRET_TO_FX, 0, tangential};
    CHECK_OK(fret_contact_step(m, &step));
    return fret_contact_last_loss(m);
}

/* The closed forms and the engine share the slices of the law, but not the way to them. */
static void engine(void) {
    static const double parts[] = {1e-3, 0.3, 0.9, 1};
    const unit_scene pad = of_kind(FRET_GAP_FLAT_ROUNDED, 0);
    struct fret_table *table = sample(&pad.gap, 23, 3e-3, true);
    for (int kind = FRET_GAP_SUM; kind <= FRET_GAP_TABLE; kind++)
        for (int j = 0; j < GRADINGS; j++) {
            unit_scene s = of_kind((fret_gap_kind)kind, gradings[j]);
            s.gap.table = table;
            const fret_normal *n = unit_make_normal(&s);
            fret_press p = {.F = 0};
            CHECK_OK(fret_press_by_radius(n, 1.6e-3, &p));
            double FN = (double)p.F;
            CHECK_OK(fret_press_by_force(n, FN, &p));
            for (int i = 0; i < 4; i++) {
                double FA = (double)(parts[i] * (fret_real)s.mu * FN);
                while (FA > s.mu * (fret_real)FN)
                    FA = nextafter(FA, 0);
                fret_contact *m = NULL;
                CHECK_OK(fret_contact_make(n, s.mu, FRET_EXACT, &m));
                if (!m)
                    continue;
                fret_step press = {FRET_TO_FORCE, FRET_TO_DX, FN, 0};
                CHECK_OK(fret_contact_step(m, &press));
                fret_real loss = -1;
                fret_loading f = {0, 0, 0, 0};
                fret_state st;
                CHECK_OK(fret_cycle_loss_by_force(&(fret_pressed){n, s.mu, p}, FA, &loss));
                CHECK_OK(fret_loading_by_force(&(fret_pressed){n, s.mu, p}, FA, &f));
                fret_real first = lost(m, FA);
                fret_contact_state(m, &st);
                CHECK_REL(4 * first, loss, UNIT_TOL(1e-14L, 1e-11L));
                CHECK_REL(st.dx, f.dx, UNIT_TOL(1e-14L, 1e-11L));
                if (i < 3) /* at gross slip c hangs on the last bit of mu F_N */
                    CHECK_REL(st.c, f.c, UNIT_TOL(1e-14L, 1e-11L));
                for (int cycle = 0; cycle < 2; cycle++) {
                    fret_real sum = lost(m, -FA);
                    sum += lost(m, FA);
                    CHECK_REL(sum, loss, UNIT_TOL(1e-14L, 1e-11L));
                }
                fret_contact_free(m);
            }
        }
    fret_table_free(table);
}

/* int F dy = (h (F(y)+F(y-h)) - L)/2 adds up over the parts of a slice, wherever the rows of a table fall. */
static void additive(void) {
    static const int counts[] = {2, 3, 7, 40, 300, 5000};
    for (int i = 0; i < 6; i++)
        for (int j = 0; j < (i < 5 ? GRADINGS : 2 - unit_skips(1)); j++) {
            unit_scene s = of_kind(i % 2 ? FRET_GAP_FLAT_ROUNDED : FRET_GAP_EXACT_SPHERE, gradings[j]);
            struct fret_table *table = sample(&s.gap, counts[i], 3e-3, true);
            s.gap.kind = FRET_GAP_TABLE;
            s.gap.table = table;
            const fret_normal *n = unit_make_normal(&s);
            fret_press p = {.F = 0};
            CHECK_OK(fret_press_by_radius(n, 2.7e-3, &p));
            static const fret_real cuts[] = {0, 1e-4L, 0.02L, 0.3L, 0.31L, 0.9L, 1};
            const fret_level edge = {p.dz, p.F};
            fret_real sum = 0;
            for (int c = 0; c < 6; c++) {
                fret_real h = (cuts[c + 1] - cuts[c]) * p.dz, from = (1 - cuts[c]) * p.dz;
                fret_level outer = {from, fret_law_force(n, from)};
                fret_real inner = fret_law_force(n, (1 - cuts[c + 1]) * p.dz);
                sum += h * (outer.F + inner) - fret_law_slice(n, &outer, h).L;
            }
            sum /= p.dz * p.F - fret_law_slice(n, &edge, p.dz).L;
            if (i < 5)
                CHECK_ABS(sum, 1, 1, UNIT_TOL(2e-14L, 1e-11L));
            else /* so many rows are taken some at a time */
                CHECK_ABS(sum, 1, 1, UNIT_TOL(1e-12L, 1e-11L));
            fret_table_free(table);
        }
}

typedef struct answers {
    fret_press p;
    fret_loading f;
    fret_real loss;
} answers;

static answers ask(const unit_scene *s, double FN) {
    answers a = {.loss = -1};
    const fret_normal *n = unit_make_normal(s);
    CHECK_OK(fret_press_by_force(n, FN, &a.p));
    CHECK_OK(fret_loading_by_force(&(fret_pressed){n, s->mu, a.p}, 0.6 * s->mu * FN, &a.f));
    CHECK_OK(fret_cycle_loss_by_force(&(fret_pressed){n, s->mu, a.p}, 0.6 * s->mu * FN, &a.loss));
    return a;
}

/* As b -> 0: cone and rounded pad in proportion to b, the paraboloid to b^2. At k -> -1 the flat end
 * carries nearly all: the constant grows. */
static void vanishing_flat(void) {
    for (int j = 1; j < GRADINGS - 1; j++)
        for (int kind = FRET_GAP_FLAT_CONE; kind <= FRET_GAP_FLAT_ROUNDED; kind++) {
            unit_scene s = of_kind((fret_gap_kind)kind, gradings[j]), full = s;
            full.gap.kind = FRET_GAP_POWER;
            full.gap.terms = 1;
            full.gap.power[0] =
                kind == FRET_GAP_FLAT_CONE ? (fret_power){1, s.gap.slope, 1} : (fret_power){2, 50, 1};
            const fret_normal *n = unit_make_normal(&full);
            fret_press at = {.F = 0};
            CHECK_OK(fret_press_by_radius(n, 1e-3, &at));
            answers want = ask(&full, (double)at.F);
            for (double b = 1e-5; b > 1e-17; b *= 1e-3) {
                s.gap.b = b;
                answers got = ask(&s, (double)at.F);
                fret_real part = b / 1e-3L;
                fret_real bound =
                    8 * (kind == FRET_GAP_FLAT_PARABOLOID ? part * part : part) + UNIT_TOL(1e-14L, 1e-12L);
                CHECK_ABS(got.p.a / want.p.a, 1, 1, bound);
                CHECK_ABS(got.p.dz / want.p.dz, 1, 1, bound);
                CHECK_ABS(got.f.dx / want.f.dx, 1, 1, bound);
                CHECK_ABS(got.f.c / want.f.c, 1, 1, bound);
                CHECK_ABS(got.loss / want.loss, 1, 1, bound);
            }
        }
}

static void one_term(void) {
    static const double ns[] = {0.5, 1, 2, 3.7, 20};
    for (int i = 0; i < 5; i++)
        for (int j = 0; j < GRADINGS; j++) {
            unit_scene s = unit_make_scene(ns[i], gradings[j]), sum = s;
            sum.gap.kind = FRET_GAP_SUM;
            answers a = ask(&s, 30), b = ask(&sum, 30);
            const fret_real tol = UNIT_TOL(1e-14L, 1e-12L);
            CHECK_REL(b.p.a, a.p.a, tol);
            CHECK_REL(b.p.dz, a.p.dz, tol);
            CHECK_REL(b.f.dx, a.f.dx, tol);
            CHECK_REL(b.f.c, a.f.c, tol);
            CHECK_REL(b.loss, a.loss, tol);
        }
}

/* ---- limits of a shape ------------------------------------------------------------------------- */

static void limits(void) {
    for (int j = 0; j < GRADINGS; j++) {
        unit_scene s = of_kind(FRET_GAP_SUM, gradings[j]);
        const fret_normal *n = unit_make_normal(&s);
        const double k = s.material.k;
        const fret_real r = sqrtl(100 * fret_kappa(2, k) / (8e6L * fret_kappa(4, k)));
        CHECK(n->cells->falls);
        CHECK_REL(n->end, r, UNIT_TOL(1e-15L, 1e-13L));
        fret_press at = {.F = 0}, p = {.F = 1, .dz = 2, .a = 3};
        double below = (double)r * (1 - 1e-9), above = (double)r * (1 + 1e-9);
        CHECK_OK(fret_press_by_radius(n, below, &at));
        fret_status st = fret_press_by_radius(n, above, &p);
        CHECK_CODE(st, FRET_NOT_MONOTONE);
        CHECK_REL((fret_real)st.value, r, UNIT_TOL(3e-16L, 1e-13L));
        st = fret_press_by_force(n, (double)at.F * 1.001, &p);
        CHECK_CODE(st, FRET_NOT_MONOTONE);
        CHECK_REL((fret_real)st.value, r, UNIT_TOL(3e-16L, 1e-13L));
        CHECK_CODE(fret_press_by_depth(n, (double)at.dz * 1.001, &p), FRET_NOT_MONOTONE);
        CHECK(p.F == 1 && p.dz == 2 && p.a == 3); /* untouched on failure */

        /* the engine refuses alike, and stays where it was */
        fret_contact *m = NULL;
        CHECK_OK(fret_contact_make(n, s.mu, FRET_EXACT, &m));
        fret_step step = {FRET_TO_FORCE, FRET_TO_DX, (double)at.F * 0.5, 0};
        fret_state old, now;
        CHECK_OK(fret_contact_step(m, &step));
        fret_contact_state(m, &old);
        step.normal = (double)at.F * 1.001;
        CHECK_CODE(fret_contact_step(m, &step), FRET_NOT_MONOTONE);
        fret_contact_state(m, &now);
        CHECK(old.FN == now.FN && old.dz == now.dz && old.a == now.a && old.slices == now.slices);
        fret_contact_free(m);

        /* falls from the tip on: never a disc */
        s.gap.power[0].h = -50;
        fret_normal *none = NULL;
        CHECK_CODE(fret_normal_make(&s.material, &s.gap, NULL, NULL, &none), FRET_NOT_MONOTONE);
        CHECK(none == NULL);

        s = of_kind(FRET_GAP_FLAT_ROUNDED, gradings[j]);
        n = unit_make_normal(&s);
        CHECK_CODE(fret_press_by_radius(n, 0.9e-3, &p), FRET_OUTSIDE);
        s = of_kind(FRET_GAP_EXACT_SPHERE, gradings[j]);
        n = unit_make_normal(&s);
        CHECK(fret_press_by_radius(n, 1.001e-2, &p).code != FRET_OK);
    }
}

/* A contact that reaches the end of its gap answers what it can be pressed by again, rounded up too; a little
 * more is refused. */
static void ends_of(const fret_normal *n) {
    const fret_point p = fret_law_at_radius(n, n->end);
    fret_press at = {.F = 0};
    const double F = (double)p.F, dz = (double)p.y;
    for (int i = -2; i <= 2; i++) {
        CHECK_OK(fret_press_by_force(n, F * (1 + i * DBL_EPSILON), &at));
        CHECK_REL(at.a, n->end, 1e-7L);
        CHECK(at.a <= n->end);
        CHECK_OK(fret_press_by_depth(n, dz * (1 + i * DBL_EPSILON), &at));
        CHECK_REL(at.a, n->end, 1e-7L);
        CHECK(at.a <= n->end);
    }
    CHECK(fret_press_by_force(n, F * (1 + 1e-14), &at).code != FRET_OK);
    CHECK(fret_press_by_depth(n, dz * (1 + 1e-14), &at).code != FRET_OK);
}

static void ends(void) {
    enum { ROWS = 30, FLAT = 9 };
    double r[ROWS], f[ROWS];
    struct fret_table *table[2] = {NULL}; /* the second with a flat end */
    for (int flat = 0; flat < 2; flat++) {
        for (int i = 0; i < ROWS; i++) {
            const double from = flat ? 1e-3 * (double)FLAT / (ROWS - 1) : 0,
                         x = fmax((r[i] = 1e-3 * i / (ROWS - 1)) - from, 0);
            f[i] = x * x / 0.03 + (flat ? 0 : x / 70);
        }
        CHECK_OK(fret_table_make(r, f, ROWS, NULL, &table[flat]));
    }
    for (int j = 0; j < GRADINGS; j++) {
        unit_scene s = of_kind(FRET_GAP_SUM, gradings[j]);
        ends_of(unit_make_normal(&s));
        s = of_kind(FRET_GAP_EXACT_SPHERE, gradings[j]);
        ends_of(unit_make_normal(&s));
        for (int flat = 0; flat < 2; flat++) {
            s.gap = (fret_gap){.kind = FRET_GAP_TABLE, .table = table[flat]};
            fret_normal *n = NULL;
            CHECK_OK(fret_normal_make(&s.material, &s.gap, NULL, NULL, &n));
            ends_of(n);
            fret_normal_free(n);
        }
    }
    fret_table_free(table[0]);
    fret_table_free(table[1]);
}

/* ---- tables ------------------------------------------------------------------------------------ */

static void bad_tables(void) {
    struct fret_table *t = NULL;
    const double r[] = {0, 1e-3, 2e-3}, f[] = {0, 1e-6, 4e-6};
    const double twice[] = {0, 1e-3, 1e-3}, back[] = {0, 2e-3, 1e-3}, late[] = {1e-4, 1e-3, 2e-3};
    const double lifted[] = {1e-7, 1e-6, 4e-6}, nans[] = {0, (double)NAN, 1},
                 inf[] = {0, 1, (double)INFINITY};
    CHECK_ERROR(fret_table_make(twice, f, 3, NULL, &t), FRET_BAD_TABLE, "r");
    CHECK_ERROR(fret_table_make(back, f, 3, NULL, &t), FRET_BAD_TABLE, "r");
    CHECK_ERROR(fret_table_make(late, f, 3, NULL, &t), FRET_BAD_TABLE, "r");
    CHECK_ERROR(fret_table_make(r, lifted, 3, NULL, &t), FRET_BAD_TABLE, "f");
    CHECK_ERROR(fret_table_make(r, f, 1, NULL, &t), FRET_BAD_TABLE, "count");
    CHECK_ERROR(fret_table_make(r, f, 0, NULL, &t), FRET_BAD_TABLE, "count");
    CHECK(fret_table_make(r, lifted, 3, NULL, &t).value == 1e-7 &&
          fret_table_make(r, f, 1, NULL, &t).value == 1);
    CHECK_ERROR(fret_table_make(nans, f, 3, NULL, &t), FRET_NOT_FINITE, "r");
    CHECK_ERROR(fret_table_make(r, inf, 3, NULL, &t), FRET_NOT_FINITE, "f");
    CHECK(fret_table_make(back, f, 3, NULL, &t).value == 1e-3);
    CHECK_ERROR(fret_table_sloped(r, f, inf, 3, NULL, &t), FRET_NOT_FINITE, "slope");
    CHECK_ERROR(fret_table_sloped(back, f, r, 3, NULL, &t), FRET_BAD_TABLE, "r");
    CHECK(t == NULL);
    fret_table_free(NULL);

    /* two points make a cone, up to its end */
    CHECK_OK(fret_table_make(r, f, 2, NULL, &t));
    unit_scene s = unit_make_scene(1, 0.3), cone = s;
    s.gap.kind = FRET_GAP_TABLE;
    s.gap.table = t;
    cone.gap.power[0] = (fret_power){1, 1e-3, 1};
    const fret_normal *n = unit_make_normal(&s), *c = unit_make_normal(&cone);
    fret_press p = {.F = 0}, q = p;
    CHECK_OK(fret_press_by_radius(n, 9e-4, &p));
    CHECK_OK(fret_press_by_radius(c, 9e-4, &q));
    CHECK_REL(p.F, q.F, UNIT_TOL(1e-15L, 1e-13L));
    CHECK_REL(p.dz, q.dz, UNIT_TOL(1e-15L, 1e-13L));
    CHECK_OK(fret_press_by_radius(c, 1.01e-3, &q));
    fret_status st = fret_press_by_radius(n, 1.01e-3, &p);
    CHECK_ERROR(st, FRET_TABLE_SHORT, "a");
    CHECK(st.limit == 1e-3);
    CHECK_ERROR(fret_press_by_force(n, (double)q.F, &p), FRET_TABLE_SHORT, "FN");
    CHECK_ERROR(fret_press_by_depth(n, (double)q.dz, &p), FRET_TABLE_SHORT, "dz");
    fret_table_free(t);

    /* a gap that turns back in the middle is no disc */
    const double hill[] = {0, 4e-6, 1e-6};
    CHECK_OK(fret_table_make(r, hill, 3, NULL, &t));
    s.gap.table = t;
    fret_normal *none = NULL;
    st = fret_normal_make(&s.material, &s.gap, NULL, NULL, &none);
    CHECK_CODE(st, FRET_NOT_MONOTONE);
    CHECK(st.value > 0 && st.value < 2e-3);
    fret_table_free(t);
}

/* Where a table begins to fall, and where it has soon risen again. */
static void falling_tables(void) {
    enum { ROWS = 401 };
    static const double end = 2e-3;
    unit_scene s = unit_make_scene(1, 0.3);
    s.gap.kind = FRET_GAP_TABLE;
    for (int i = 0; i < 4; i++) {
        double r[ROWS], f[ROWS];
        struct fret_table *t = NULL;
        fret_normal *none = NULL;
        for (int j = 0; j < ROWS; j++) {
            r[j] = end * j / (ROWS - 1);
            f[j] = r[j] * r[j] / 0.02 * (i == 0 ? -1 : 1);
        }
        if (i > 0) /* else all of it: a notch in the first, a later or the last row */
            f[i == 1 ? 1 : i == 2 ? ROWS / 2 : ROWS - 1] -= i == 1 ? 2e-8 : 1e-6;
        CHECK_OK(fret_table_make(r, f, ROWS, NULL, &t));
        s.gap.table = t;
        const fret_status st = fret_normal_make(&s.material, &s.gap, NULL, NULL, &none);
        CHECK_CODE(st, FRET_NOT_MONOTONE);
        CHECK(none == NULL);
        CHECK(i == 0   ? st.value == 0
              : i == 1 ? st.value >= 0 && st.value <= end / 200
              : i == 2 ? st.value > 0.49 * end && st.value < 0.51 * end
                       : st.value > 0.99 * end && st.value < end);
        CHECK(i == 0 || i == 3 ? st.limit == 0 : st.limit > st.value && st.limit < st.value + 0.0101 * end);
        fret_table_free(t);
    }
}

/* The interpolation keeps straight lines and parabolas; elsewhere its error falls with a power of the
 * spacing, measured from 50 to 400 points. A flat end between two samples costs one order. */
static void table_order(void) {
    static const struct {
        fret_gap_kind kind;
        double n; /* of a power */
        bool uneven;
        double order; /* at least; 0: exact */
    } cases[] = {
        {FRET_GAP_POWER, 1, true, 0},
        {FRET_GAP_POWER, 2, true, 0},
        {FRET_GAP_FLAT_ROUNDED, 0, false, 1.5},
        {FRET_GAP_POWER, 3, true, 1.5},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        for (int j = 2; j < 7; j += 2) { /* -0.7, 0, 0.7 */
            unit_scene s = of_kind(cases[i].kind, gradings[j]);
            if (cases[i].kind == FRET_GAP_POWER) {
                s.gap.terms = 1;
                s.gap.power[0] = (fret_power){cases[i].n, 1e-4, 3e-3};
            }
            const fret_normal *n = unit_make_normal(&s);
            fret_press at = {.F = 0};
            CHECK_OK(fret_press_by_radius(n, 2.3e-3, &at));
            answers want = ask(&s, (double)at.F);
            fret_real error[4][3] = {{0}};
            for (int level = 0; level < (cases[i].order > 0 ? 4 : 2); level++) {
                unit_scene table = s;
                table.gap.kind = FRET_GAP_TABLE;
                struct fret_table *t = sample(&s.gap, 50 << level, 3.1e-3, cases[i].uneven);
                if (!t)
                    return;
                table.gap.table = t;
                answers got = ask(&table, (double)at.F);
                fret_table_free(t);
                error[level][0] = fabsl(got.p.a / want.p.a - 1);
                error[level][1] = fabsl(got.p.dz / want.p.dz - 1);
                error[level][2] = fabsl(got.loss / want.loss - 1);
                if (cases[i].order <= 0) {
                    CHECK_ABS(error[level][0], 0, 1, 2e-14L);
                    CHECK_ABS(error[level][1], 0, 1, 1e-14L);
                    CHECK_ABS(error[level][2], 0, 1, 1e-14L);
                }
            }
            if (getenv("FRET_UNIT_VERBOSE"))
                for (int q = 0; q < 3; q++)
                    printf("table of %s n=%g%s k=%g: %s %.1Le %.1Le %.1Le %.1Le order %.2Lf\n",
                           kinds[cases[i].kind], cases[i].n, cases[i].uneven ? " uneven" : "", gradings[j],
                           q == 0   ? "a "
                           : q == 1 ? "dz"
                                    : "dW",
                           error[0][q], error[1][q], error[2][q], error[3][q],
                           log2l(error[0][q] / error[3][q]) / 3);
            if (cases[i].order > 0) { /* of the worst: where samples fall matters, and errors change sign */
                fret_real first = 0, last = 0;
                for (int q = 0; q < 3; q++) {
                    first = fmaxl(first, error[0][q]);
                    last = fmaxl(last, error[3][q]);
                }
                CHECK(log2l(first / last) / 3 > cases[i].order);
                CHECK(last < 1e-5L);
            }
        }
}

static void long_table(void) {
    unit_scene s = of_kind(FRET_GAP_FLAT_ROUNDED, 0.7), table = s;
    const fret_normal *n = unit_make_normal(&s);
    fret_press at = {.F = 0};
    CHECK_OK(fret_press_by_radius(n, 1.9e-3, &at));
    struct fret_table *t = sample(&s.gap, 100001, 3.1e-3, false);
    if (!t)
        return;
    table.gap.kind = FRET_GAP_TABLE;
    table.gap.table = t;
    const fret_normal *long_ = unit_make_normal(&table);
    fret_press p = {.F = 0};
    CHECK_OK(fret_press_by_force(long_, (double)at.F, &p));
    CHECK_REL(p.a, at.a, 1e-6L);
    CHECK_REL(p.dz, at.dz, 1e-6L);
    fret_table_free(t);
}

/* As few pieces as the bumps of a gap want, and no further off than is said. */
static void thinned(void) {
    enum { ROWS = 20001 };
    static double r[ROWS], f[ROWS];
    struct fret_table *t = NULL;
    const double bumps = 5e4, end = 1e-3;
    for (int i = 0; i < ROWS; i++) {
        r[i] = end * i / (ROWS - 1);
        f[i] = 50 * r[i] * r[i] * (1 + 1e-3 * cos(bumps * r[i]));
    }
    CHECK_OK(fret_table_make(r, f, ROWS, NULL, &t));
    const double within = fret_table_within(t);
    const size_t pieces = fret_table_count(t);
    CHECK(pieces > 100 && pieces <= 2000 && within <= 1e-9);
    const fret_gap gap = {.kind = FRET_GAP_TABLE, .table = t};
    for (int i = 0; i < ROWS; i += 7) {
        fret_real at;
        CHECK_OK(fret_gap_f(&gap, r[i], &at));
        CHECK_ABS(at, f[i], f[ROWS - 1], within);
    }
    fret_table_free(t);
}

/* W of large steps of both forces over a coarse table: edge and front cross rows, where the profile is not
 * smooth. Small steps see one row at a time. */
static void coarse_steps(void) {
    static const double r[] = {0, 1e-4, 2e-4, 4e-4, 8e-4}, f[] = {0, 6e-7, 2.1e-6, 9e-6, 3.3e-5};
    static const double to[][2] = {{40, 11}, {160, -30}, {70, 5}};
    struct fret_table *t = NULL;
    CHECK_OK(fret_table_make(r, f, 5, NULL, &t));
    for (int j = 0; j < 2; j++) {
        fret_real W[2] = {0, 0};
        for (int fine = 0; fine < 2; fine++) {
            unit_scene s = unit_make_scene(2, j ? -0.7 : 0.3);
            s.gap = (fret_gap){.kind = FRET_GAP_TABLE, .table = t};
            const fret_normal *n = unit_make_normal(&s);
            fret_contact *m = NULL;
            CHECK_OK(fret_contact_make(n, 0.3, FRET_EXACT, &m));
            double FN = 100, Fx = 0;
            fret_step step = {FRET_TO_FORCE, FRET_TO_FX, FN, Fx};
            CHECK_OK(fret_contact_step(m, &step));
            for (int i = 0, parts = fine ? 200 : 1; i < 3; FN = to[i][0], Fx = to[i][1], i++)
                for (int part = 1; part <= parts; part++) {
                    step.normal = FN + (to[i][0] - FN) * part / parts;
                    step.tangential = Fx + (to[i][1] - Fx) * part / parts;
                    CHECK_OK(fret_contact_step(m, &step));
                }
            fret_state state;
            fret_contact_forces(m, &state);
            W[fine] = state.W;
            fret_contact_free(m);
        }
        CHECK_REL(W[0], W[1], UNIT_TOL(1e-14L, 1e-12L));
    }
    fret_table_free(t);
}

int main(int argc, char **argv) {
    unit_start("shape", argc, argv);
    CASE(reference());
    CASE(show_worst());
    CASE(engine());
    CASE(additive());
    CASE(vanishing_flat());
    CASE(one_term());
    CASE(limits());
    CASE(ends());
    CASE(bad_tables());
    CASE(falling_tables());
    CASE(sloped());
    CASE(table_order());
    CASE(long_table());
    CASE(thinned());
    if (!unit_skips(1))
        CASE(coarse_steps());
    return unit_finish();
}
