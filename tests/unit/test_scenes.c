/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Scenes in vectors against the exact functions, over the whole range and at its corners; and the same bits
 * from every width. `test_scenes --worst N` prints the worst errors of N blocks. */
#include "unit.h"

#include "fast/scenes.h"

enum { ALIKE, RIGID, TWO };
enum { ROWS = 96 }; /* a block and a half */

static unsigned long long state = 7;

static double uniform(double lo, double hi) {
    return unit_random(&state, lo, hi);
}

static double spread(double lo, double hi) {
    return exp(uniform(log(lo), log(hi)));
}

static double pick(const double *from, int count) {
    return from[(int)uniform(0, count - 1e-9)];
}

/* One block of inputs and its results. */
typedef struct scenes {
    double E0[2][ROWS], nu[2][ROWS], k[ROWS], c0[ROWS], n[ROWS], h[ROWS], r0[ROWS], F[ROWS], mu[ROWS],
        Fx[ROWS];
    int second; /* ALIKE, RIGID or TWO */
    double out[SCENE_OUTPUTS][ROWS];
} scenes;

static const double corner_k[] = {-0.99, -0.999999, 0.99, 0.999999, 0, -0.5, 0.5, 1e-9};
static const double corner_nu[] = {0, 0.5, 0.25, 0.4999999, 0.3, -0.9};
static const double corner_n[] = {0.5, 100, 1, 2, 30, 28, 0.05, 1000};
static const double corner_t[] = {1e-9, 1 - 1e-9, 1 - 1e-15, 0.97, 0.5, 1e-19, 1};
#define PICK(from) pick(from, sizeof from / sizeof *from)

static void draw(scenes *s) {
    s->second = (int)uniform(0, 2.999);
    for (int i = 0; i < ROWS; i++) {
        const bool corner = uniform(0, 1) < 0.3;
        s->k[i] = corner ? PICK(corner_k) : uniform(-1, 1);
        s->n[i] = uniform(0, 1) < 0.3 ? PICK(corner_n) : spread(0.3, 30);
        for (int j = 0; j < 2; j++) {
            s->E0[j][i] = spread(1e3, 1e12);
            s->nu[j][i] = uniform(0, 1) < 0.3 ? PICK(corner_nu) : uniform(j ? -1 : 0, 0.5);
        }
        s->c0[i] = spread(1e-6, 1);
        s->h[i] = spread(1e-9, 1e3);
        s->r0[i] = spread(1e-9, 1e3);
        s->F[i] = spread(1e-6, 1e6);
        s->mu[i] = spread(0.01, 3);
        const double t = uniform(0, 1) < 0.4   ? PICK(corner_t)
                         : uniform(0, 1) < 0.5 ? uniform(0, 1)
                                               : spread(1e-6, 1);
        s->Fx[i] = (double)(t * ((long double)s->mu[i] * s->F[i]));
    }
}

static fret_scenes inputs_of(const scenes *s) {
    return (fret_scenes){.E0 = {s->E0[0], s->second == TWO ? s->E0[1] : NULL},
                         .nu = {s->nu[0], s->nu[1]},
                         .k = s->k,
                         .c0 = s->c0,
                         .n = s->n,
                         .h = s->h,
                         .r0 = s->r0,
                         .F = s->F,
                         .mu = s->mu,
                         .Fx = s->Fx,
                         .rigid = s->second == RIGID};
}

static bool run(scenes *s) {
    const fret_scenes in = inputs_of(s);
    const fret_scene_values out = {
        s->out[SCENE_HN],   s->out[SCENE_HT],    s->out[SCENE_BETA], s->out[SCENE_CN0], s->out[SCENE_CT0],
        s->out[SCENE_ETA],  s->out[SCENE_KAPPA], s->out[SCENE_A],    s->out[SCENE_DZ],  s->out[SCENE_KN],
        s->out[SCENE_SLIP], s->out[SCENE_C],     s->out[SCENE_DX],   s->out[SCENE_LOSS]};
    return fret_batch_scenes(&in, &out, ROWS);
}

/* The same by the exact functions; NaN: they refuse. */
static void exact(const scenes *s, int i, fret_real want[SCENE_OUTPUTS]) {
    const fret_material m = {{{s->E0[0][i], s->nu[0][i], false},
                              {s->E0[s->second == TWO][i], s->nu[s->second == TWO][i], s->second == RIGID}},
                             s->k[i],
                             s->c0[i]};
    const fret_gap gap = {.kind = FRET_GAP_POWER, .terms = 1, .power = {{s->n[i], s->h[i], s->r0[i]}}};
    fret_normal *normal = NULL;
    fret_contact c = {.mu = s->mu[i]};
    fret_loading l = {0, (fret_real)NAN, (fret_real)NAN, 0};
    for (int j = 0; j < SCENE_OUTPUTS; j++)
        want[j] = (fret_real)NAN;
    if (fret_normal_make(&m, &gap, &normal).code)
        return;
    const fret_foundation *f = fret_normal_foundation(normal);
    want[SCENE_HN] = f->hN[0];
    want[SCENE_HT] = f->hT[0];
    want[SCENE_BETA] = f->beta[0];
    want[SCENE_CN0] = f->cN0;
    want[SCENE_CT0] = f->cT0;
    want[SCENE_ETA] = f->eta;
    want[SCENE_KAPPA] = fret_kappa(s->n[i], s->k[i]);
    c.normal = normal;
    if (!fret_press_by_force(normal, s->F[i], &c.press).code) {
        want[SCENE_A] = c.press.a;
        want[SCENE_DZ] = c.press.dz;
        want[SCENE_KN] = fret_normal_stiffness(normal, c.press.a);
        want[SCENE_SLIP] = fret_gross_slip(&c);
        fret_loading_by_force(&c, s->Fx[i], &l);
        fret_cycle_loss_by_force(&c, s->Fx[i], &want[SCENE_LOSS]);
        want[SCENE_C] = l.c;
        want[SCENE_DX] = l.dx;
    }
    fret_normal_free(normal);
}

static const char *const names[SCENE_OUTPUTS] = {"hN", "hT", "beta", "cN0",  "cT0", "eta", "kappa",
                                                 "a",  "dz", "kn",   "slip", "c",   "dx",  "loss"};

/* A little more than tests/hard/scenes.txt tells of, in 1e-16. */
static const fret_real bounds[SCENE_OUTPUTS] = {2.4L, 2.0L, 1.2L, 2.4L, 2.1L, 2.3L, 3.5L,
                                                5.5L, 2.8L, 5,    5,    7,    8,    16};

typedef struct worst {
    fret_real error;
    double k, nu, n, t;
} worst;

static void compare(const scenes *s, worst found[SCENE_OUTPUTS], long *missing) {
    fret_real want[SCENE_OUTPUTS];
    for (int i = 0; i < ROWS; i++) {
        exact(s, i, want);
        for (int j = 0; j < SCENE_OUTPUTS; j++) {
            if (isnan(s->out[j][i])) {
                ++*missing;
                continue;
            }
            if (!unit_true(!isnan(want[j]), "a result where there is none", __FILE__, __LINE__))
                continue;
            const fret_real e =
                want[j] != 0 ? fabsl(s->out[j][i] / want[j] - 1) : fabsl((fret_real)s->out[j][i]);
            unit_true(e <= UNIT_TOL(1e-16L * bounds[j], 2e-13L), names[j], __FILE__, __LINE__);
            if (e > found[j].error)
                found[j] = (worst){e, s->k[i], s->nu[0][i], s->n[i], s->Fx[i] / (s->mu[i] * s->F[i])};
        }
    }
}

static void accuracy(long blocks, bool shown) {
    static scenes s;
    worst found[SCENE_OUTPUTS] = {{.error = 0}};
    long missing = 0;
    for (long b = 0; b < blocks; b++) {
        draw(&s);
        run(&s);
        compare(&s, found, &missing);
    }
    CHECK(missing < blocks * ROWS); /* of results: a fourteenth at most */
    for (int j = 0; shown && j < SCENE_OUTPUTS; j++)
        printf("%-6s %8.1Le  at k = %.10g, nu = %.7g, n = %.4g, t = %.9g\n", names[j], found[j].error,
               found[j].k, found[j].nu, found[j].n, found[j].t);
    if (shown)
        printf("%ld scenes, %ld of %ld results left to the exact functions\n", blocks * ROWS, missing,
               blocks * ROWS * SCENE_OUTPUTS);
}

/* Every width that runs here. */
static void bits(void) {
    static fret_scene_block block[8];
    const size_t columns = sizeof block[0].in / sizeof *block[0].in[0];
    for (int round = 0; round < 60; round++) {
        static scenes s;
        draw(&s);
        fret_scene_block *b = &block[0];
        *b = (fret_scene_block){
            .count = FRET_SCENE_BLOCK, .alike = round % 3 == 0, .rigid = round % 3 == 1, .pushed = true};
        for (int i = 0; i < FRET_SCENE_BLOCK; i++) {
            const double row[SCENE_INPUTS] = {s.E0[0][i], s.nu[0][i], s.E0[1][i], s.nu[1][i],
                                              s.k[i],     s.c0[i],    s.n[i],     s.h[i],
                                              s.r0[i],    s.F[i],     s.mu[i],    s.Fx[i]};
            for (int j = 0; j < SCENE_INPUTS; j++)
                b->in[j][i] = row[j];
        }
        CHECK(columns == SCENE_INPUTS * FRET_SCENE_BLOCK);
        for (size_t v = 1; v < fret_scene_variant_count; v++)
            block[v] = *b;
        for (size_t v = 0; v < fret_scene_variant_count; v++)
            if (fret_scene_variants[v].runs())
                fret_scene_variants[v].run(&block[v]);
        for (size_t v = 0; v + 1 < fret_scene_variant_count; v++)
            if (fret_scene_variants[v].runs())
                for (int j = 0; j < SCENE_OUTPUTS; j++)
                    for (int i = 0; i < FRET_SCENE_BLOCK; i++) {
                        const double x = block[v].out[j][i],
                                     y = block[fret_scene_variant_count - 1].out[j][i];
                        CHECK((isnan(x) && isnan(y)) || memcmp(&x, &y, sizeof x) == 0);
                    }
    }
}

/* What is out of range is left to others, whatever the neighbours are. */
static void refused(void) {
    static scenes s;
    static const double bad[] = {(double)NAN, (double)INFINITY, -1, 0, 1e300};
    for (int which = 0; which < 9; which++)
        for (int i = 0; i < 5; i++) {
            draw(&s);
            s.second = ALIKE;
            for (int j = 0; j < ROWS; j++) {
                s.k[j] = 0.3;
                s.n[j] = 2;
                s.Fx[j] = 0.5 * s.mu[j] * s.F[j];
            }
            CHECK(!run(&s));
            double *const columns[] = {s.E0[0], s.k, s.n, s.h, s.r0, s.F, s.mu, s.nu[0], s.c0};
            const bool fine = (which == 1 && bad[i] == 0) || (which == 7 && bad[i] == 0);
            columns[which][70] = bad[i];
            if (fine)
                continue;
            CHECK(run(&s));
            CHECK(isnan(s.out[SCENE_LOSS][70]) && isnan(s.out[SCENE_A][70]));
            CHECK(!isnan(s.out[SCENE_LOSS][69]) && !isnan(s.out[SCENE_A][71]));
        }
    draw(&s);
    s.Fx[3] = 1.001 * s.mu[3] * s.F[3];
    run(&s);
    CHECK(isnan(s.out[SCENE_LOSS][3]) && isnan(s.out[SCENE_C][3]));
    for (int body = 0; body < 2; body++) { /* what is less than a tenth of a per cent too much */
        draw(&s);
        s.second = TWO;
        for (int j = 0; j < ROWS; j++)
            s.k[j] = 0.3;
        s.nu[body][5] = 0.5004;
        s.nu[body][6] = 0.5;
        s.nu[body][7] = -1;
        run(&s);
        CHECK(isnan(s.out[SCENE_A][5]) && !isnan(s.out[SCENE_A][6]) && isnan(s.out[SCENE_A][7]));
    }
}

int main(int argc, char **argv) {
    if (argc > 2 && !strcmp(argv[1], "--worst")) {
        CASE(accuracy(atol(argv[2]), true));
        return unit.failed ? EXIT_FAILURE : EXIT_SUCCESS;
    }
    unit_start("scenes", argc, argv);
    CASE(accuracy(60, false));
    CASE(bits());
    CASE(refused());
    return unit_finish();
}
