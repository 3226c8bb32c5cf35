/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Contacts near the ends of what numbers hold, arguments that few will give, and what pieces of a law do at
 * their ends; beside the law itself, twins without pieces, and results that are known. */
#include "arrays/arrays.h"
#include "histories.h"
#include "law/normal.h"
#include "number/dd.h"
#include "number/real.h"
#include "places.h"
#include "unit.h"

static unsigned long long seed = 5;
static double uniform(double lo, double hi) {
    return unit_random(&seed, lo, hi);
}

static const fret_material steel = {.body = {{.E0 = 210e9, .nu = 0.3}, {.E0 = 210e9, .nu = 0.3}}, .c0 = 1e-3};

/* A homogeneous power gap h (r/r0)^n under bodies of this modulus. */
static fret_normal *power(double E0, double n, double h, double r0) {
    const fret_material m = {.body = {{.E0 = E0, .nu = 0.3}, {.E0 = E0, .nu = 0.3}}, .c0 = 1};
    const fret_gap gap = {.kind = FRET_GAP_POWER, .terms = 1, .power = {{n, h, r0}}};
    return unit_keep_normal(&m, &gap);
}

static struct fret_table *rows(const double *r, const double *f, size_t count) {
    struct fret_table *t = NULL;
    CHECK_OK(fret_table_make(r, f, count, NULL, &t));
    return t;
}

/* A sphere in rows up to 1 mm. */
static struct fret_table *sphere_rows(size_t count) {
    static double r[4000], f[4000];
    for (size_t i = 0; i < count; i++) {
        r[i] = 1e-3 * (double)i / (double)(count - 1);
        f[i] = r[i] * r[i] / 0.02;
    }
    return rows(r, f, count);
}

/* ---- shapes and bodies -------------------------------------------------------------------------- */

static void shapes(void) {
    fret_gap sum = {.kind = FRET_GAP_SUM, .terms = 2, .power = {{2, 50, 1}, {4, 0, 1}}}, wrong = sum;
    const fret_gap one = {.kind = FRET_GAP_POWER, .terms = 1, .power = {{2, 50, 1}}};
    const fret_normal *n = unit_keep_normal(&steel, &sum), *same = unit_keep_normal(&steel, &one);
    fret_press a, b;
    CHECK_OK(fret_press_by_force(n, 10, &a)); /* a term that is none */
    CHECK_OK(fret_press_by_force(same, 10, &b));
    CHECK_REL(a.a, b.a, UNIT_TOL(1e-17L, 1e-14L));
    CHECK_REL(a.dz, b.dz, UNIT_TOL(1e-17L, 1e-14L));
    CHECK(fret_gap_tip(&sum) == 2);
    const fret_gap ball = {.kind = FRET_GAP_EXACT_SPHERE, .R = 0.01};
    fret_rule rule;
    fret_gap_rule(&ball, 0, &rule); /* at its centre its series has no terms */
    CHECK(fret_gap_profile(&ball, &rule, 0).g == 0 && fret_gap_profile(&ball, &rule, 0).slope == 0);
    wrong.power[0].n = -1; /* the first of two is told */
    wrong.power[1].h = INFINITY;
    CHECK_ERROR(fret_gap_check(&wrong), FRET_NOT_POSITIVE, "n");
    wrong.power[0].n = 2;
    CHECK_ERROR(fret_gap_check(&wrong), FRET_NOT_FINITE, "A");
    sum.power[1] = (fret_power){4, 60, 1};
    sum.power[0].h = -50; /* falls from the beginning */
    fret_normal *none = NULL;
    CHECK_ERROR(fret_normal_make(&steel, &sum, NULL, NULL, &none), FRET_NOT_MONOTONE, "r");
    CHECK(!none);
}

static void tables(void) {
    static const double r[] = {0, 1e-4, 2e-4, 3e-4, 4e-4}, flat[] = {0, 0, 1e-6, 4e-6, 9e-6},
                        cone[] = {0, 1e-6, 2e-6, 3e-6, 4e-6};
    struct fret_table *t[] = {rows(r, flat, 5), rows(r, cone, 5)};
    fret_real g = -1, slope = -1;
    for (int i = 0; i < 2; i++) {
        const fret_gap gap = {.kind = FRET_GAP_TABLE, .table = t[i]};
        CHECK(fret_gap_tip(&gap) == (i ? 1 : 2));
        CHECK_ERROR(fret_gap_g(&gap, 0, 5e-4L, &g, &slope), FRET_OUTSIDE, "x");
        CHECK_ERROR(fret_gap_g(&gap, 0, -5e-4L, &g, NULL), FRET_OUTSIDE, "x");
        CHECK(g == -1 && slope == -1);
    }
    /* g of a cone of slope s is pi s x/2 */
    const fret_gap gap = {.kind = FRET_GAP_TABLE, .table = t[1]};
    CHECK_OK(fret_gap_g(&gap, 0, 3e-4L, &g, &slope));
    CHECK_REL(g, FRET_PI / 2 * 3e-6L, 1e-15L);
    CHECK_REL(slope, FRET_PI / 2 * 1e-2L, 4e-15L);
    fret_table_free(t[0]);
    fret_table_free(t[1]);
}

static void bodies(void) {
    /* one so much softer that the other is as rigid, told instead of lost */
    fret_material m = {.body = {{.E0 = 1e300, .nu = 0.3}, {.E0 = 1e-300, .nu = 0.3}}, .c0 = 1};
    fret_foundation f;
    CHECK_ERROR(fret_foundation_make(&m, &f), FRET_OVERFLOW, "E0");
    m.body[1].E0 = 1e10;
    CHECK_OK(fret_foundation_make(&m, &f));
    m.body[0].rigid = true;
    fret_foundation rigid;
    CHECK_OK(fret_foundation_make(&m, &rigid));
    CHECK_REL(f.cN0, rigid.cN0, 1e-15L);
}

/* ---- the law ------------------------------------------------------------------------------------ */

/* Where a step of the search would leave all numbers, or what is known of the place. */
static void searches(void) {
    const fret_gap steep = {.kind = FRET_GAP_SUM, .terms = 2, .power = {{0.01, 1e-6, 1e-3}, {50, 1e-6, 1}}},
                   plateau = {
                       .kind = FRET_GAP_SUM, .terms = 2, .power = {{0.005, 1e-6, 1}, {0.01, -0.5e-6, 1}}};
    const fret_normal *n[] = {unit_keep_normal(&steel, &steep), unit_keep_normal(&steel, &plateau)};
    const double depth[2][3] = {{1e54, 1e30, 2e-6}, {1e-7, 1.2e-7, 4e-7}};
    for (int i = 0; i < 2; i++)
        for (int j = 0; j < 3; j++) {
            fret_press p;
            fret_real g, slope;
            CHECK_OK(fret_press_by_depth(n[i], depth[i][j], &p));
            CHECK_OK(fret_gap_g(fret_normal_gap(n[i]), 0, p.a, &g, &slope));
            CHECK_REL(g, (fret_real)depth[i][j], 1e-15L);
        }
}

/* What a double does not hold is refused whichever result it is. */
static void ranges(void) {
    fret_press p = {0};
    CHECK_CODE(fret_press_by_force(power(1e-290, 2, 1, 1), 1e300, &p), FRET_OVERFLOW);
    CHECK_CODE(fret_press_by_force(power(1e290, 2, 1, 1), 1e-300, &p), FRET_OVERFLOW);
    CHECK_CODE(fret_press_by_depth(power(1e300, 2, 1, 1), 1e10, &p), FRET_OVERFLOW);
    CHECK_CODE(fret_press_by_depth(power(1e-300, 2, 1, 1), 1e-20, &p), FRET_OVERFLOW);
    CHECK(p.F == 0 && p.dz == 0 && p.a == 0);
    const fret_gap blunt = {.kind = FRET_GAP_POWER, .terms = 1, .power = {{DBL_TRUE_MIN, 1, 1}}};
    fret_normal *n = NULL;
    CHECK_ERROR(fret_normal_make(&steel, &blunt, NULL, NULL, &n), FRET_OVERFLOW, "n");
    CHECK(!n);
    CHECK_OK(fret_press_by_depth(power(1e300, 2, 1, 1), 1e-20, &p));
    CHECK_REL(p.a, 1e-10L * sqrtl(0.5L), 1e-15L);
}

/* ---- places that are kept ------------------------------------------------------------------------ */

/* ---- pieces -------------------------------------------------------------------------------------- */

/* Rows that are closer than leaves a trace are taken together. */
static void close_rows(void) {
    double r[104], f[104];
    size_t count[2] = {0, 0};
    struct fret_table *t[2];
    const fret_normal *n[2];
    for (int which = 0; which < 2; which++) {
        for (int i = 0; i <= 100; i++) {
            const double at = 1e-5 * i;
            for (int j = 0; j < (which && i == 10 ? 4 : 1); j++, count[which]++) {
                r[count[which]] = at + 1e-10 * j;
                f[count[which]] = r[count[which]] * r[count[which]] / 0.02;
            }
        }
        t[which] = rows(r, f, count[which]);
        n[which] = unit_keep_normal(&steel, &(fret_gap){.kind = FRET_GAP_TABLE, .table = t[which]});
    }
    const fret_level outer = {fret_law_depth(n[0], 100), 100};
    for (int i = 1; i <= 10; i++) {
        const fret_slice a = fret_law_slice(n[0], &outer, outer.y * i / 10),
                         b = fret_law_slice(n[1], &outer, outer.y * i / 10);
        CHECK_REL(b.w, a.w, 1e-5L);
        CHECK_REL(b.G, a.G, 1e-4L);
        CHECK_REL(fret_slice_moment(&b), fret_slice_moment(&a), 1e-4L);
        CHECK_REL(b.L, a.L, 1e-3L);
    }
    const fret_slice none = fret_law_slice(n[0], &outer, 0);
    CHECK(none.w == 0 && fret_slice_moment(&none) == 0 && none.G == 0 && none.L == 0);
    CHECK(fret_law_load(n[0], &outer, 0) == 0 && fret_law_thickness(n[0], &outer, 0) == 0);
    while (unit.normals)
        fret_normal_free(unit.normal[--unit.normals]);
    for (int i = 0; i < 2; i++)
        fret_table_free(t[i]);
}

/* ---- fields -------------------------------------------------------------------------------------- */

/* u_z outside as it is defined, of g = dz (x/a)^n. */
typedef struct outside {
    fret_real n, k, a, r, dz;
} outside;

static fret_real surface_rate(fret_real x, fret_real from_a, fret_real to_b, const void *context) {
    const outside *o = context;
    (void)from_a;
    return fret_pow(x, o->k) * o->dz * -expm1l(o->n * log1pl(-to_b / o->a)) *
           fret_pow((o->r - o->a + to_b) * (o->r + x), -(1 + o->k) / 2);
}

static void fields(void) {
    static const struct {
        double n, k, r;
    } all[] = {{0.009, 0.2, 1.1}, {0.009, 0.2, 3}, {2, 0.9995, 1.05}, {2, 0.9995, 4}, {15, 0.5, 1.01}};
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) {
        fret_material m = steel;
        m.k = all[i].k;
        const fret_gap gap = {.kind = FRET_GAP_POWER, .terms = 1, .power = {{all[i].n, 1e-5, 1e-3}}};
        const fret_normal *n = unit_keep_normal(&m, &gap);
        const fret_real a = 1e-3L, r = a * all[i].r, k = all[i].k;
        fret_real dz, slope, got = 0;
        CHECK_OK(fret_gap_g(&gap, m.k, a, &dz, &slope));
        CHECK_OK(place_surface(n, a, r, &got));
        const outside o = {all[i].n, k, a, r, dz};
        const fret_real factor = 2 * sinl(FRET_PI * (1 - fabsl(k)) / 2) / FRET_PI;
        CHECK_REL(got, factor * unit_integrate(surface_rate, &o, 0, a), 1e-12L);
    }
    /* next to the centre of a sphere, whose series of powers is too long: as at the centre */
    fret_material graded = steel;
    graded.k = 0.9;
    const fret_gap sphere = {.kind = FRET_GAP_EXACT_SPHERE, .R = 1e-3};
    const fret_normal *n = unit_keep_normal(&graded, &sphere);
    fret_real p[3];
    CHECK_OK(place_pressure(n, 0.9e-3L, 0, &p[0]));
    CHECK_OK(place_pressure(n, 0.9e-3L, 1e-60L, &p[1]));
    CHECK_OK(place_pressure(n, 0.9e-3L, 1e-12L, &p[2]));
    CHECK_REL(p[1], p[0], 1e-12L);
    CHECK_REL(p[2], p[0], 1e-7L);
    /* a pointed term beside a steep one is singular in the middle */
    const fret_gap mixed = {.kind = FRET_GAP_SUM, .terms = 2, .power = {{0.5, 1e-5, 1e-3}, {30, 1e-5, 1e-3}}};
    n = unit_keep_normal(&steel, &mixed);
    CHECK_ERROR(place_pressure(n, 1e-3L, 0, &p[0]), FRET_SINGULAR, "r");
    CHECK_OK(place_pressure(n, 1e-3L, 5e-4L, &p[0]));
    /* a steep one alone: at the rim, and where a double can tell the two no more */
    const fret_gap steep = {.kind = FRET_GAP_POWER, .terms = 1, .power = {{40, 1e-5, 1e-3}}};
    n = unit_keep_normal(&steel, &steep);
    for (int i = 0; i < 4; i++) {
        const fret_real r = (fret_real[]){1e-3L, nextafterl(1e-3L, 0), 1e-3L * (1 - 1e-18L), 2e-3L}[i];
        CHECK_OK(place_pressure(n, 1e-3L, r, &p[0]));
        CHECK(p[0] >= 0 && p[0] < 1e3);
    }
    /* not pressed beyond its flat end */
    const fret_gap flat = {.kind = FRET_GAP_FLAT_CONE, .b = 1e-3, .slope = 0.01};
    n = unit_keep_normal(&steel, &flat);
    for (int i = 0; i < 3; i++) {
        const fret_real r = (fret_real[]){0, 5e-4L, 2e-3L}[i];
        CHECK_OK(place_pressure(n, 1e-3L, r, &p[0]));
        CHECK_OK(place_surface(n, 1e-3L, r, &p[1]));
        CHECK(p[0] == 0 && p[1] == 0);
    }
    fret_memory *m = NULL;
    CHECK_OK(fret_memory_make(n, 0.4, &m));
    CHECK_OK(fret_memory_step(m, &(fret_step){FRET_TO_FORCE, FRET_TO_FX, 10, 1}));
    CHECK_ERROR(place_traction(CONTACT_OF(m), -1, &p[0]), FRET_NEGATIVE, "r");
    CHECK_ERROR(place_surface_x(CONTACT_OF(m), -1, &p[0]), FRET_NEGATIVE, "r");
    fret_memory_free(m);
}

/* ---- swings -------------------------------------------------------------------------------------- */

/* A period that is smaller by rounding alone leaves next to nothing of the one before; loads in phase, of
 * which one part does not move. */
static void short_pieces(void) {
    const fret_normal *n = power(210e9, 2, 1e-5, 1e-3);
    for (int i = 0; i < 12; i++) {
        const double phase = i % 6 * 0.5, mu = 0.4, FNA = i < 6 ? 6 : 5, FA = i == 6 ? mu * FNA : 2;
        fret_memory *m, *shown;
        fret_swing *w = NULL;
        fret_state now, then;
        CHECK_OK(fret_memory_make(n, mu, &m));
        CHECK_OK(fret_memory_make(n, mu, &shown));
        CHECK_OK(fret_memory_step(m, &(fret_step){FRET_TO_FORCE, FRET_KEEP_DX, 20, 0}));
        CHECK_OK(fret_swing_make(m, &w));
        fret_sine sine = {.FN = 20, .FNA = FNA, .FA = FA, .phase = phase};
        for (int j = 0; j < 4; j++) {
            const double top = (double)(20 + (fret_real)sine.FNA * cosl(sine.phase));
            CHECK_OK(fret_swing_step(w, &(fret_step){FRET_TO_FORCE, FRET_TO_FX, top, sine.FA}));
            if (!CHECK(fret_swing_fits(w, &sine, 0)))
                break;
            CHECK_OK(fret_swing_part(w, &sine, 0, 1));
            fret_swing_state(w, &now);
            CHECK_OK(fret_swing_memory(w, shown));
            fret_memory_state(shown, &then);
            CHECK_REL(then.FN, now.FN, 1e-16L);
            CHECK_ABS(then.Fx, now.Fx, mu * 20, 1e-15L);
            CHECK_ABS(then.dx, now.dx, fret_law_depth(n, 20), 1e-15L);
            CHECK_ABS(then.U, now.U, mu * 20 * fret_law_depth(n, 20), 1e-5L);
            sine.FNA = nextafter(sine.FNA, 0);
            sine.FA = nextafter(sine.FA, 0);
        }
        fret_swing_free(w);
        fret_memory_free(m);
        fret_memory_free(shown);
    }
}

/* ---- the loss by its definition ------------------------------------------------------------------ */

/* Of many rows, beyond gross slip; and a flag that stops. */
static void definitions(void) {
    static volatile sig_atomic_t stop;
    struct fret_table *t = sphere_rows(3000);
    const fret_gap gap = {.kind = FRET_GAP_TABLE, .table = t};
    fret_pressed c = {.normal = unit_keep_normal(&steel, &gap), .mu = 0.4};
    fret_loading peak;
    fret_real loss, want, error;
    CHECK_OK(fret_press_by_force(c.normal, 300, &c.press));
    const double dxA = (double)(1.5L * fret_gross_slip(&c));
    CHECK_OK(fret_loading_by_displacement(&c, dxA, &peak));
    CHECK_OK(fret_cycle_loss_by_definition(&c, &peak, &loss, &error));
    CHECK_OK(fret_cycle_loss_by_displacement(&c, dxA, &want));
    CHECK_REL(loss, want, 1e-12L);
    c.mu = -1;
    CHECK_ERROR(fret_cycle_loss_by_definition(&c, &peak, &loss, &error), FRET_NOT_POSITIVE, "mu");
    fret_normal *plain = power(210e9, 2, 1e-5, 1e-3);
    c = (fret_pressed){.normal = plain, .mu = 0.4};
    CHECK_OK(fret_press_by_force(c.normal, 300, &c.press));
    CHECK_OK(fret_loading_by_force(&c, 50, &peak));
    fret_normal_stop(plain, &stop);
    CHECK_OK(fret_cycle_loss_by_definition(&c, &peak, &loss, &error));
    stop = 1;
    CHECK_CODE(fret_cycle_loss_by_definition(&c, &peak, &loss, &error), FRET_INTERRUPTED);
    stop = 0;
    while (unit.normals)
        fret_normal_free(unit.normal[--unit.normals]);
    fret_table_free(t);
}

/* ---- arrays -------------------------------------------------------------------------------------- */

enum { MANY = 70 };

/* The same as the functions, one by one; the first that fails tells. */
static void check_arrays(const fret_pressed *c, double least, double most) {
    double F[MANY], loss[MANY], a[MANY], b[MANY];
    const double nan_ = (double)NAN;
    fret_code code = FRET_OK;
    fret_loading first;
    fret_press press;
    fret_real want;
    for (int i = 0; i < MANY; i++)
        F[i] = least * pow(most / least, i / ((double)MANY - 1.0));
    for (int i = 0; i < MANY && !code; i++)
        code = fret_cycle_loss_by_force(c, F[i], &want).code;
    CHECK_CODE(fret_arrays_loss(c, F, loss, MANY), code);
    for (int i = 0; i < MANY && !code; i++) {
        CHECK_OK(fret_cycle_loss_by_force(c, F[i], &want));
        CHECK(loss[i] == (double)want || fabsl(loss[i] - want) <= 3e-15L * want + DBL_MIN);
    }
    for (int which = 1; which < 4; which++) { /* radii, displacements, both */
        for (int i = 0; i < MANY; i++)
            a[i] = b[i] = nan_;
        code = FRET_OK;
        for (int i = 0; i < MANY && !code; i++)
            code = fret_loading_by_force(c, F[i], &first).code;
        CHECK_CODE(fret_arrays_loading(c, F, which & 1 ? a : NULL, which & 2 ? b : NULL, MANY), code);
        for (int i = 0; i < MANY && !code; i++) {
            CHECK_OK(fret_loading_by_force(c, F[i], &first));
            CHECK(which & 1 ? fabsl(a[i] - first.c) <= 2e-15L * first.c + DBL_MIN : isnan(a[i]));
            CHECK(which & 2 ? fabsl(b[i] - first.dx) <= 2e-15L * fabsl(first.dx) + DBL_MIN : isnan(b[i]));
            a[i] = b[i] = nan_;
        }
        code = FRET_OK;
        for (int i = 0; i < MANY && !code; i++)
            code = fret_press_by_force(c->normal, F[i], &press).code;
        CHECK_CODE(fret_arrays_press(c->normal, F, which & 1 ? a : NULL, which & 2 ? b : NULL, MANY), code);
        for (int i = 0; i < MANY && !code; i++) {
            CHECK_OK(fret_press_by_force(c->normal, F[i], &press));
            CHECK(which & 1 ? fabsl(a[i] - press.a) <= 2e-15L * press.a : isnan(a[i]));
            CHECK(which & 2 ? fabsl(b[i] - press.dz) <= 2e-15L * press.dz : isnan(b[i]));
        }
    }
}

static void arrays(void) {
    static const struct {
        double E0, n, h, r0, FN;
    } all[] = {{210e9, 2, 1e-5, 1e-3, 100}, {1e270, 2, 1, 1, 1e275},     {1e-270, 2, 1, 1, 1e-275},
               {1e250, 2, 1, 1, 1e-30},     {1e-250, 2, 1, 1, 1e30},     {1e130, 2, 1e-150, 1e-30, 1e-150},
               {1, 2, 1e-280, 1e-3, 1},     {1, 2, 1e280, 1e-3, 1e200},  {1e-10, 1, 1e-275, 1, 1e-280},
               {1e300, 2, 1e-5, 1e-3, 1},   {1e100, 2, 1e-290, 1e-3, 1}, {1e-300, 2, 1e290, 1, 1}};
    int used = 0;
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) {
        fret_pressed c = {.normal = power(all[i].E0, all[i].n, all[i].h, all[i].r0), .mu = 0.4};
        if (fret_press_by_force(c.normal, all[i].FN, &c.press).code)
            continue;
        used++;
        check_arrays(&c, 1e-6 * all[i].FN, 0.39 * all[i].FN);
        check_arrays(&c, 1e-3 * all[i].FN, 0.5 * all[i].FN); /* beyond gross slip */
    }
    CHECK(used > 6);
}

/* ---- double precision ---------------------------------------------------------------------------- */

/* By depth over all the range: a step is what the law says, or is refused where it leaves the range. */
static void diagrams(void) {
    for (int e = -300; e <= 300; e += 20)
        for (int d = -300; d <= 300; d += 12) {
            const fret_normal *n = power(pow(10, e), 2, 1, 1);
            const double dz = pow(10, d);
            fret_diagram *g;
            fret_press p;
            fret_state now;
            CHECK_OK(fret_diagram_make(n, 0.4, &g));
            const fret_status want = fret_press_by_depth(n, dz, &p),
                              st = fret_diagram_step(g, &(fret_step){FRET_TO_DEPTH, FRET_KEEP_DX, dz, 0});
            fret_diagram_forces(g, &now);
            if (st.code) {
                CHECK_CODE(st, FRET_OVERFLOW);
                CHECK(now.FN == 0 && now.dz == 0);
                CHECK(want.code ||
                      !(p.F > 1e-289L && p.F < 1e289L && p.F * dz > 1e-289L && p.F * dz < 1e289L));
            } else if (CHECK(!want.code)) {
                CHECK_REL(now.FN, p.F, 2e-15L);
            }
            fret_diagram_free(g);
        }
}

/* Of what does not count its losses the forces are the same. */
static void lossless(void) {
    const fret_normal *n = power(210e9, 2, 1e-5, 1e-3);
    fret_diagram *d[2];
    fret_state now[2];
    for (int i = 0; i < 2; i++) {
        CHECK_OK(fret_diagram_make(n, 0.4, &d[i]));
        fret_diagram_count_loss(d[i], i == 0);
    }
    for (int j = 0; j < 200; j++) {
        const double FN = 100 + uniform(-20, 20), part = uniform(-0.99, 0.99);
        for (int i = 0; i < 2; i++) {
            CHECK_OK(
                fret_diagram_step(d[i], j % 3 ? &(fret_step){FRET_TO_FORCE, FRET_TO_FX, FN, 0.4 * FN * part}
                                              : &(fret_step){FRET_TO_FORCE, FRET_TO_DX, FN, 2e-6 * part}));
            fret_diagram_forces(d[i], &now[i]);
        }
        CHECK(now[0].Fx == now[1].Fx && now[0].dx == now[1].dx && now[0].FN == now[1].FN);
    }
    CHECK(now[0].W > 0 && now[1].W == 0);
    for (int i = 0; i < 2; i++)
        fret_diagram_free(d[i]);
}

/* To gross slip by displacement, to the last bit, beside the exact diagram. */
static void at_gross_slip(void) {
    const fret_normal *n = power(210e9, 2, 1e-5, 1e-3);
    const double per = (double)n->foundation.eta;
    for (int i = 0; i < 400; i++) {
        const double mu = uniform(0.1, 0.9), dz = 1e-6 * uniform(0.5, 2);
        double dx = mu * per * dz;
        for (int j = 0; j < i % 5; j++)
            dx = nextafter(dx, i % 2 ? 1 : 0);
        fret_diagram *d;
        fret_memory *m;
        fret_state now;
        fret_state want;
        CHECK_OK(fret_diagram_make(n, mu, &d));
        CHECK_OK(fret_memory_make(n, mu, &m));
        const fret_step steps[] = {{FRET_TO_DEPTH, FRET_KEEP_DX, dz, 0}, {FRET_TO_DEPTH, FRET_TO_DX, dz, dx}};
        for (int j = 0; j < 2; j++) {
            CHECK_OK(fret_diagram_step(d, &steps[j]));
            CHECK_OK(fret_memory_step(m, &steps[j]));
        }
        fret_diagram_forces(d, &now);
        fret_memory_state(m, &want);
        CHECK_REL(now.Fx, want.Fx, 1e-15L);
        CHECK_REL(now.W, want.W, 3e-14L);
        fret_diagram_free(d);
        fret_memory_free(m);
    }
}

/* ---- springs ------------------------------------------------------------------------------------- */

static fret_state state_of(fret_springs *s) {
    fret_state out;
    fret_springs_state(s, &out);
    return out;
}

/* Parts of a step that goes straight change nothing; an open contact closes without load. */
static void springs(void) {
    const fret_normal *n = power(210e9, 2, 1e-5, 1e-3);
    fret_press p;
    fret_springs *s[2];
    CHECK_OK(fret_press_by_force(n, 200, &p));
    for (int i = 0; i < 2; i++)
        CHECK_OK(fret_springs_make(n, 0.4, 1000, (double)p.a, FRET_WEIGHT_CELL, &s[i]));
    const fret_step steps[] = {{FRET_TO_DEPTH, FRET_KEEP_DX, 2e-6, 0},
                               {FRET_TO_DEPTH, FRET_TO_DX, 2e-6, 1e-7}, /* the depth that it has */
                               {FRET_KEEP_NORMAL, FRET_TO_DX, 0, 3e-7},
                               {FRET_KEEP_NORMAL, FRET_TO_DX, 0, -2e-7},
                               {FRET_TO_DEPTH, FRET_KEEP_DX, -1e-6, 0},
                               {FRET_TO_FORCE, FRET_KEEP_DX, 0, 0},
                               {FRET_TO_FORCE, FRET_KEEP_DX, 50, 0}};
    for (size_t j = 0; j < sizeof steps / sizeof *steps; j++) {
        CHECK_OK(fret_springs_step(s[0], &steps[j], 1));
        CHECK_OK(fret_springs_step(s[1], &steps[j], 8));
        const fret_state one = state_of(s[0]), many = state_of(s[1]);
        CHECK_ABS(one.Fx, many.Fx, 100, 1e-14L);
        CHECK(one.FN == many.FN && one.dz == many.dz && one.dx == many.dx);
        CHECK(j != 4 || (one.dz == -1e-6 && one.FN == 0));
        CHECK(j != 5 || (one.dz == 0 && one.FN == 0 && one.Fx == 0));
    }
    for (int i = 0; i < 2; i++)
        fret_springs_free(s[i]);
}

/* The force that was asked for, of so many springs that rounding adds up. */
static void many_springs(void) {
    const fret_normal *n = power(210e9, 2, 1e-5, 1e-3);
    fret_press p;
    fret_springs *s;
    CHECK_OK(fret_press_by_force(n, 200, &p));
    CHECK_OK(fret_springs_make(n, 0.4, 10000, (double)p.a, FRET_WEIGHT_CELL, &s));
    CHECK_OK(fret_springs_step(s, &(fret_step){FRET_TO_FORCE, FRET_KEEP_DX, 100, 0}, 1));
    for (int i = 0; i < 400; i++) {
        const double FN = i % 3 ? 100 + 90 * uniform(-1, 1) * (i % 5 ? 0.01 : 1) : 100,
                     part = i % 7 ? uniform(-1, 1) : copysign(1 - 1e-13, uniform(-1, 1));
        CHECK_OK(fret_springs_step(s, &(fret_step){FRET_TO_FORCE, FRET_TO_FX, FN, 0.4 * FN * part},
                                   i % 3 ? 1 : 16));
        CHECK_ABS(state_of(s).Fx, 0.4L * FN * part, 0.4L * FN, 2e-14L);
    }
    fret_springs_free(s);
}

/* ---- arithmetic ---------------------------------------------------------------------------------- */

static void quotients(void) {
    /* 4!/(1! 2!), 4!/(2! 2!), and a pair that differs in its low parts alone */
    const dd five = dd_of(5), under[][2] = {{dd_of(2), dd_of(3)}, {dd_of(3), dd_of(3)}, {{3, 0}, {3, 1e-20}}};
    const fret_real want[] = {12, 6, 6};
    for (int i = 0; i < 3; i++) {
        const dd_scaled q = fret_dd_gamma_quotient(&five, 1, under[i], 2);
        CHECK_REL(fret_dd_exp_real(q.log) * dd_value(q.factor), want[i], UNIT_TOL(1e-18L, 1e-15L));
    }
    /* Gamma(-1/2) = -2 sqrt(pi), Gamma(-3/2) = 4/3 sqrt(pi), Gamma(-5/2) = -8/15 sqrt(pi) */
    CHECK_REL(tgammal(-0.5L), -2 * sqrtl(FRET_PI), 1e-18L);
    CHECK_REL(tgammal(-1.5L), 4 * sqrtl(FRET_PI) / 3, 1e-18L);
    CHECK_REL(tgammal(-2.5L), -8 * sqrtl(FRET_PI) / 15, 1e-18L);
    CHECK(isnan(tgammal(-2)) && isnan(tgammal(-3)));
}

int main(int argc, char **argv) {
    unit_start("extremes", argc, argv);
    CASE(shapes());
    CASE(tables());
    CASE(bodies());
    CASE(searches());
    CASE(ranges());
    CASE(close_rows());
    CASE(fields());
    CASE(short_pieces());
    CASE(definitions());
    CASE(arrays());
    CASE(diagrams());
    CASE(lossless());
    CASE(at_gross_slip());
    CASE(springs());
    CASE(many_springs());
    CASE(quotients());
    return unit_finish();
}
