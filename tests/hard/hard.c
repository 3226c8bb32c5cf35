/* SPDX-License-Identifier: GPL-3.0-or-later */
/* hard --diagrams STEPS: the memory diagram in double beside the exact one.
 * hard [--scenes N] [--steps N] [--jobs N] [--table FILE]: prints the worst errors by region and scalar.
 * hard --scene INDEX | --corner LINE: inputs, ours and exact of one random scene or one row of the table. */
#include "hard.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

enum { FIELDS = 5 /* F, Fx, dz, a, dx */, CONTACT_FIELDS = 12, SHOWN = 40 };

enum { CASES = 400 };

static struct {
    char name[80];
    unsigned long checked;
    bool failed;
} cases[CASES];
static int case_count;

void hard_case(const char *kind, const char *name, unsigned long passed, unsigned long failed) {
    if (case_count == CASES)
        abort();
    snprintf(cases[case_count].name, sizeof cases->name, "%s, %s", kind, name);
    cases[case_count].checked = passed + failed;
    cases[case_count++].failed = failed > 0 || !passed;
}

hard_random hard_seed(uint64_t seed) {
    return (hard_random){seed};
}

double hard_uniform(hard_random *r) {
    uint64_t z = r->state += 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    z ^= z >> 31;
    return (double)(z >> 11) * 0x1p-53;
}

unsigned hard_choice(hard_random *r, unsigned count) {
    return (unsigned)(hard_uniform(r) * count);
}

double hard_scale(hard_random *r, int least, int most) {
    return ldexp(1 + hard_uniform(r), least + (int)(hard_uniform(r) * (most - least)));
}

void hard_contact(const oracle_contact *c, fret_material *material, fret_gap *gap) {
    *material = (fret_material){.k = c->k, .c0 = c->c0};
    for (int i = 0; i < 2; i++)
        material->body[i] = (fret_body){c->E0[i], c->nu[i], c->rigid[i]};
    *gap = (fret_gap){.kind = FRET_GAP_POWER, .terms = 1, .power[0] = {c->n, c->h, c->r0}};
}

/* --- random scenes --- */

#define PICK(r, list) ((list)[hard_choice((r), sizeof(list) / sizeof *(list))])

static double draw_k(hard_random *r) {
    static const double edges[] = {1 - 1e-15, -(1 - 1e-15), 0, 0.5, -0.5, 0.25, -0.25, 1 - 1e-9, -(1 - 1e-9)};
    switch (hard_choice(r, 10)) {
    case 0:
        return PICK(r, edges);
    case 1:
        return (hard_choice(r, 2) ? 1 : -1) * hard_scale(r, -1000, -1);
    case 2:
    case 3:
    case 4:
        return 1 - hard_scale(r, -49, -1);
    case 5:
    case 6:
    case 7:
        return hard_scale(r, -49, -1) - 1;
    default:
        return 2 * hard_uniform(r) - 1;
    }
}

static double draw_nu(hard_random *r) {
    static const double edges[] = {0.5, 0.25, 0, 0.3, -0.3, 0.5 - 1e-15, -1 + 1e-15};
    switch (hard_choice(r, 8)) {
    case 0:
        return PICK(r, edges);
    case 1:
        return 0.5;
    case 2:
    case 3:
        return 0.5 - hard_scale(r, -52, -2);
    case 4:
        return hard_scale(r, -51, -1) - 1;
    case 5:
        return (hard_choice(r, 2) ? 1 : -1) * hard_scale(r, -1000, -3);
    default:
        return 1.5 * hard_uniform(r) - 1 + 0x1p-53;
    }
}

static double draw_n(hard_random *r) {
    static const double usual[] = {1e-6, 1e6, 0.5, 1, 2, 2, 3, 4, 340, 1000};
    return hard_choice(r, 4) ? fmin(1e6, fmax(1e-6, hard_scale(r, -20, 20))) : PICK(r, usual);
}

static double draw_size(hard_random *r) {
    return hard_scale(r, -39, 19); /* 1.8e-12 .. 5.2e5 m */
}

static oracle_contact draw_contact(hard_random *r) {
    oracle_contact c = {.k = draw_k(r), .n = draw_n(r)};
    c.E0[0] = hard_scale(r, 0, 50);
    c.nu[0] = draw_nu(r);
    c.E0[1] = c.E0[0];
    c.nu[1] = c.nu[0];
    switch (hard_choice(r, 4)) {
    case 0:
        break; /* equal bodies */
    case 1:
        c.rigid[1] = true;
        break;
    default:
        c.E0[1] *= hard_scale(r, -40, 40);
        c.nu[1] = draw_nu(r);
    }
    c.c0 = draw_size(r);
    c.h = draw_size(r);
    c.r0 = draw_size(r);
    return c;
}

/* Of the way to gross slip, in 0 .. most, most <= 1: near both ends at every scale. */
static double draw_fraction(hard_random *r, double most) {
    switch (hard_choice(r, 6)) {
    case 0:
        return most * hard_scale(r, -996, -1);
    case 1:
        return most * hard_scale(r, -45, -1);
    case 2:
    case 3:
        return most * (1 - hard_scale(r, -50, -1));
    default:
        return most * hard_uniform(r);
    }
}

static bool usable(mpfr_srcptr x) {
    return mpfr_regular_p(x) && labs((long)mpfr_get_exp(x)) < 1000;
}

static bool all_usable(const oracle *o, oracle_scalar from, oracle_scalar to) {
    for (oracle_scalar i = from; i <= to; i++)
        if (!usable(oracle_value(o, i)))
            return false;
    return true;
}

static double value(const oracle *o, oracle_scalar which) {
    return mpfr_get_d(oracle_value(o, which), MPFR_RNDN);
}

static bool press(oracle *o, hard_random *r, hard_scene *s) {
    const oracle_contact *c = &s->contact;
    double power = c->n + c->k + 1;
    int range = (int)fmin(20, 400 / power); /* F_N ~ a^power must not overflow */
    s->a = range > 0 ? c->r0 * hard_scale(r, -range, range)
                     : c->r0 * (1 + (2 * hard_uniform(r) - 1) * 256 / power);
    if (s->a < 1e-12 || s->a > 1e6)
        return false;
    oracle_press_radius(o, s->a);
    if (!all_usable(o, ORACLE_DZ_OF_A, ORACLE_F_OF_A))
        return false;
    s->F = value(o, ORACLE_F_OF_A);
    s->dz = value(o, ORACLE_DZ_OF_A);
    oracle_press_force(o, s->F);
    oracle_press_depth(o, s->dz);
    oracle_friction(o, s->mu);
    return all_usable(o, ORACLE_A_OF_F, ORACLE_DX_MAX);
}

static bool push(oracle *o, hard_random *r, hard_scene *s) {
    double power = s->contact.n + s->contact.k + 1;
    s->Fx = draw_fraction(r, fmin(1, 256 * power)) * (s->mu * s->F); /* c = a (1-t)^(1/power) */
    if (!isnormal(s->Fx))
        return false;
    oracle_load_force(o, s->Fx);
    return oracle_t(o) < 1 && all_usable(o, ORACLE_C_OF_FX, ORACLE_YC_OF_FX);
}

static bool shift(oracle *o, hard_random *r, hard_scene *s) {
    bool slides = hard_choice(r, 8) == 0;
    double x = slides ? 1 + hard_scale(r, -50, 20) : draw_fraction(r, fmin(1, 256 * s->contact.n));
    s->dx = x * value(o, ORACLE_DX_MAX);
    if (!isnormal(s->dx))
        return false;
    oracle_load_displacement(o, s->dx);
    return usable(oracle_value(o, ORACLE_FX_OF_DX)) && oracle_x(o) != 1 &&
           (slides || all_usable(o, ORACLE_C_OF_DX, ORACLE_YC_OF_DX));
}

/* Scenes with indices 4 i .. 4 i + 3 have the same bodies and n. Leaves the results in the oracle. */
static hard_scene draw_scene(oracle *o, unsigned long index) {
    enum { SHARE = 4, TRIES = 1000 };
    hard_random r = hard_seed(2 * (uint64_t)(index / SHARE)), rest = hard_seed(2 * (uint64_t)index + 1);
    hard_scene s = {.contact = draw_contact(&r)};
    for (int i = 0; i < TRIES; i++) {
        if (index % SHARE) {
            s.contact.c0 = draw_size(&rest);
            s.contact.h = draw_size(&rest);
            s.contact.r0 = draw_size(&rest);
        }
        s.mu = hard_scale(&rest, -10, 3);
        oracle_set_contact(o, &s.contact);
        bool (*const stage[])(oracle *, hard_random *, hard_scene *) = {press, push, shift};
        int done = 0;
        for (int tries = 0; done < 3 && tries < TRIES; tries++)
            done += stage[done](o, &rest, &s);
        if (done == 3)
            return s;
    }
    fprintf(stderr, "hard: no usable scene %lu\n", index);
    exit(EXIT_FAILURE);
}

static void solve(oracle *o, const hard_scene *s) {
    oracle_set_contact(o, &s->contact);
    oracle_press_radius(o, s->a);
    oracle_press_force(o, s->F);
    oracle_press_depth(o, s->dz);
    oracle_friction(o, s->mu);
    oracle_load_force(o, s->Fx);
    oracle_load_displacement(o, s->dx);
}

/* --- the library's answers --- */

/* At the load F of the normal contact. NAN for what was refused. */
static void ask_loaded(const hard_scene *s, const fret_normal *normal, fret_real got[ORACLE_COUNT]) {
    fret_pressed c = {.normal = normal, .mu = s->mu};
    fret_loading loading;
    if (fret_press_by_force(normal, s->F, &c.press).code)
        return;
    got[ORACLE_A_OF_F] = c.press.a;
    got[ORACLE_DZ_OF_F] = c.press.dz;
    got[ORACLE_KN] = fret_normal_stiffness(normal, c.press.a);
    got[ORACLE_DX_MAX] = fret_gross_slip(&c);
    if (fret_loading_by_force(&c, s->Fx, &loading).code == FRET_OK) {
        got[ORACLE_DX_OF_FX] = loading.dx;
        got[ORACLE_C_OF_FX] = loading.c;
        got[ORACLE_YC_OF_FX] = loading.yc;
    }
    if (fret_cycle_loss_by_force(&c, s->Fx, &got[ORACLE_DW_OF_FX]).code)
        got[ORACLE_DW_OF_FX] = NAN;
    if (fret_loading_by_displacement(&c, s->dx, &loading).code == FRET_OK) {
        got[ORACLE_FX_OF_DX] = loading.Fx;
        got[ORACLE_C_OF_DX] = loading.c;
        got[ORACLE_YC_OF_DX] = loading.yc;
    }
    if (fret_cycle_loss_by_displacement(&c, s->dx, &got[ORACLE_DW_OF_DX]).code)
        got[ORACLE_DW_OF_DX] = NAN;
}

static void ask(const hard_scene *s, fret_real got[ORACLE_COUNT]) {
    fret_material material;
    fret_gap gap;
    fret_normal *normal;
    fret_press by;
    for (int i = 0; i < ORACLE_COUNT; i++)
        got[i] = NAN;
    hard_contact(&s->contact, &material, &gap);
    if (fret_normal_make(&material, &gap, NULL, NULL, &normal).code)
        return;
    const fret_foundation *foundation = fret_normal_foundation(normal);
    for (int i = 0; i < 2; i++) {
        const fret_real h[] = {foundation->hN[i], foundation->hT[i], foundation->beta[i]};
        memcpy(got + (i ? ORACLE_HN_2 : ORACLE_HN_1), h, sizeof h);
    }
    got[ORACLE_CN0] = foundation->cN0;
    got[ORACLE_CT0] = foundation->cT0;
    got[ORACLE_ETA] = foundation->eta;
    got[ORACLE_KAPPA] = fret_kappa(s->contact.n, s->contact.k);
    if (fret_press_by_depth(normal, s->dz, &by).code == FRET_OK) {
        got[ORACLE_A_OF_DZ] = by.a;
        got[ORACLE_F_OF_DZ] = by.F;
    }
    if (fret_press_by_radius(normal, s->a, &by).code == FRET_OK) {
        got[ORACLE_DZ_OF_A] = by.dz;
        got[ORACLE_F_OF_A] = by.F;
    }
    ask_loaded(s, normal, got);
    fret_normal_free(normal);
}

/* --- judging --- */

static unsigned bit(hard_region r) {
    return 1u << r;
}

static unsigned contact_regions(const oracle_contact *c) {
    unsigned in = 0;
    for (int i = 0; i < 2; i++) {
        if (c->rigid[i])
            continue;
        in |= c->nu[i] + 1 < 1e-3 ? bit(HARD_NU_LOW) : 0;
        in |= 1 - 2 * c->nu[i] < 1e-3 ? bit(HARD_NU_HIGH) : 0;
    }
    in |= c->k + 1 < 1e-3 ? bit(HARD_K_LOW) : 0;
    in |= 1 - c->k < 1e-3 ? bit(HARD_K_HIGH) : 0;
    in |= c->n < 1e-3 ? bit(HARD_N_LOW) : 0;
    in |= c->n > 1e3 ? bit(HARD_N_HIGH) : 0;
    in |= in & bit(HARD_K_HIGH) && in & bit(HARD_NU_HIGH) ? bit(HARD_K_NU_HIGH) : 0;
    in |= in & bit(HARD_N_LOW) && in & bit(HARD_K_LOW) ? bit(HARD_S_LOW) : 0;
    in |= fmin(c->r0, fmin(c->h, c->c0)) < 1e-9 ? bit(HARD_SMALL) : 0;
    in |= fmax(c->r0, fmax(c->h, c->c0)) > 1e3 ? bit(HARD_LARGE) : 0;
    return in;
}

static unsigned fraction_regions(double t) {
    return t > 1 ? bit(HARD_SLIDES) : t < 1e-6 ? bit(HARD_T_LOW) : 1 - t < 1e-6 ? bit(HARD_T_HIGH) : 0;
}

/* Of equals the first, so that the table does not depend on the number of jobs. */
static void keep_worse(hard_worst *worst, hard_worst other) {
    if (other.seen && (!worst->seen || other.ulps > worst->ulps ||
                       (other.ulps == worst->ulps && other.index < worst->index)))
        *worst = other;
}

static void judge(hard_tally *tally, const oracle *o, const hard_scene *s, unsigned long index) {
    fret_real got[ORACLE_COUNT];
    ask(s, got);
    const oracle_contact *c = &s->contact;
    unsigned contact = contact_regions(c);
    bool two = !c->rigid[0] && !c->rigid[1] && (c->E0[0] != c->E0[1] || c->nu[0] != c->nu[1]);
    unsigned touched = 0;
    tally->seen++;
    for (oracle_scalar i = 0; i < ORACLE_COUNT; i++) {
        unsigned in = contact;
        if (i >= ORACLE_DX_OF_FX)
            in |= fraction_regions(i >= ORACLE_FX_OF_DX ? oracle_x(o) : oracle_t(o));
        if (!in)
            in = bit(HARD_INSIDE);
        in |= bit(HARD_ALL) | (two ? bit(HARD_TWO) : 0);
        double ulps = oracle_ulps((double)got[i], oracle_value(o, i));
        if (isnan(ulps))
            ulps = INFINITY;
        if (i >= ORACLE_FX_OF_DX && fabs(1 - oracle_x(o)) < 1e-9)
            in = bit(HARD_BRINK); /* the 2^-96 to which delta_x,max is known are felt */
        else if (ulps <= HARD_ULPS)
            tally->passed++;
        else
            tally->failed++;
        touched |= in;
        for (hard_region region = 0; region < HARD_REGION_COUNT; region++)
            if (in & bit(region))
                keep_worse(&tally->worst[i][region], (hard_worst){ulps, index, true});
    }
    for (hard_region region = 0; region < HARD_REGION_COUNT; region++)
        tally->scenes[region] += (touched & bit(region)) != 0;
}

static void merge(hard_tally *into, const hard_tally *from) {
    into->passed += from->passed;
    into->failed += from->failed;
    into->seen += from->seen;
    for (int region = 0; region < HARD_REGION_COUNT; region++)
        into->scenes[region] += from->scenes[region];
    for (int i = 0; i < ORACLE_COUNT; i++)
        for (int region = 0; region < HARD_REGION_COUNT; region++)
            keep_worse(&into->worst[i][region], from->worst[i][region]);
}

static const char *const headings[] = {
#define X(name, heading, what) heading,
    HARD_REGIONS(X)
#undef X
};
static const char *const meanings[] = {
#define X(name, heading, what) what,
    HARD_REGIONS(X)
#undef X
};

static void head(const char *title) {
    printf("%-8s", title);
    for (int region = 0; region < HARD_REGION_COUNT; region++)
        printf(" %8s", headings[region]);
    printf("\n");
}

static void report(const hard_tally *tally, const char *what) {
    printf("%lu %s: %lu scalars within %g ulp, %lu not\n\n", tally->seen, what, tally->passed, HARD_ULPS,
           tally->failed);
    head("");
    printf("%-8s", "scenes");
    for (int region = 0; region < HARD_REGION_COUNT; region++)
        printf(" %8lu", tally->scenes[region]);
    printf("\n\n");
    head("ulp");
    for (int i = 0; i < ORACLE_COUNT; i++) {
        printf("%-8s", oracle_names[i]);
        for (int region = 0; region < HARD_REGION_COUNT; region++)
            if (tally->worst[i][region].seen)
                printf(tally->worst[i][region].ulps < 100 ? " %8.3f" : " %8.1e",
                       tally->worst[i][region].ulps);
            else
                printf(" %8s", "-");
        printf("\n");
    }
    printf("\n");
    head("where");
    for (int i = 0; i < ORACLE_COUNT; i++) {
        printf("%-8s", oracle_names[i]);
        for (int region = 0; region < HARD_REGION_COUNT; region++)
            if (tally->worst[i][region].seen)
                printf(" %8lu", tally->worst[i][region].index);
            else
                printf(" %8s", "-");
        printf("\n");
    }
    printf("\n");
}

/* --- what is run --- */

static void run_scenes(hard_tally *tally, unsigned long count, unsigned long job, unsigned long jobs) {
    enum { BLOCK = 64 };
    oracle *o = oracle_new();
    for (unsigned long index = 0; index < count; index++) {
        if (index / BLOCK % jobs != job)
            continue;
        hard_scene s = draw_scene(o, index);
        judge(tally, o, &s, index);
    }
    oracle_free(o);
}

/* Each job is a process that leaves its tally in shared memory. */
static hard_tally *start_jobs(unsigned long count, unsigned long jobs) {
    hard_tally *parts =
        mmap(NULL, jobs * sizeof *parts, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (parts == MAP_FAILED)
        abort();
    fflush(stdout);
    for (unsigned long job = 0; job < jobs; job++) {
        pid_t child = fork();
        if (child < 0)
            abort();
        if (child == 0) {
            run_scenes(&parts[job], count, job, jobs);
            exit(EXIT_SUCCESS);
        }
    }
    return parts;
}

static hard_tally finish_jobs(hard_tally *parts, unsigned long jobs) {
    hard_tally sum = {0};
    for (unsigned long job = 0; job < jobs; job++) {
        int status;
        if (wait(&status) < 0 || status != 0) {
            fprintf(stderr, "hard: a job died\n");
            exit(EXIT_FAILURE);
        }
    }
    for (unsigned long job = 0; job < jobs; job++)
        merge(&sum, &parts[job]);
    munmap(parts, jobs * sizeof *parts);
    return sum;
}

static bool read_row(char *line, hard_scene *s, char *results[ORACLE_COUNT]) {
    char *cell[CONTACT_FIELDS + FIELDS + ORACLE_COUNT];
    double x[CONTACT_FIELDS + FIELDS];
    int columns = 0;
    for (char *p = strtok(line, ",\n"); p; p = strtok(NULL, ",\n")) {
        if (columns == CONTACT_FIELDS + FIELDS + ORACLE_COUNT)
            return false;
        cell[columns++] = p;
    }
    if (columns != CONTACT_FIELDS + FIELDS + ORACLE_COUNT)
        return false;
    for (int i = 0; i < CONTACT_FIELDS + FIELDS; i++)
        x[i] = strtod(cell[i], NULL);
    memcpy(results, cell + CONTACT_FIELDS + FIELDS, ORACLE_COUNT * sizeof *results);
    *s = (hard_scene){.contact = {.E0 = {x[0], x[3]},
                                  .nu = {x[1], x[4]},
                                  .rigid = {x[2] != 0, x[5] != 0},
                                  .k = x[6],
                                  .c0 = x[7],
                                  .n = x[8],
                                  .h = x[9],
                                  .r0 = x[10]},
                      .mu = x[11],
                      .F = x[12],
                      .Fx = x[13],
                      .dz = x[14],
                      .a = x[15],
                      .dx = x[16]};
    return true;
}

/* The oracle against the table, which has 36 digits of an independent computation, and the library. */
static void run_table(const char *path) {
    static const double agreed = 1e-33;
    FILE *file = fopen(path, "r");
    unsigned long passed = 0, failed = 0;
    if (!file) {
        printf("hard: cannot open %s\n", path);
        hard_case("oracle", "against the table", 0, 1);
        return;
    }
    oracle *o = oracle_new();
    hard_tally tally = {0};
    char *line = NULL, *results[ORACLE_COUNT];
    size_t size = 0;
    mpfr_t want, error;
    mpfr_inits2(256, want, error, (mpfr_ptr)0);
    double worst = 0;
    for (unsigned long number = 1; getline(&line, &size, file) > 0; number++) {
        hard_scene s;
        if (*line == '#')
            continue;
        if (!read_row(line, &s, results)) {
            printf("%s:%lu: not a row\n", path, number);
            failed++;
            continue;
        }
        solve(o, &s);
        for (oracle_scalar i = 0; i < ORACLE_COUNT; i++) {
            mpfr_set_str(want, results[i], 10, MPFR_RNDN);
            mpfr_sub(error, oracle_value(o, i), want, MPFR_RNDN);
            if (!mpfr_zero_p(error))
                mpfr_div(error, error, want, MPFR_RNDN);
            double relative = fabs(mpfr_get_d(error, MPFR_RNDN));
            if (relative <= agreed) {
                passed++;
            } else if (++failed <= SHOWN) {
                mpfr_printf("%s:%lu: %s: oracle %.36Rg, table %s: %.1e\n", path, number, oracle_names[i],
                            oracle_value(o, i), results[i], relative);
            }
            worst = relative <= worst ? worst : relative;
        }
        judge(&tally, o, &s, number);
    }
    mpfr_clears(want, error, (mpfr_ptr)0);
    free(line);
    fclose(file);
    oracle_free(o);
    printf("oracle against %s: %.1e\n\n", path, worst);
    report(&tally, "corners");
    hard_case("oracle", "against the table", passed, failed);
    hard_case("scenes", "corners", tally.passed, tally.failed);
}

/* Inputs, ours and exact; the results are in the oracle. */
static void show(const oracle *o, const hard_scene *scene) {
    const hard_scene s = *scene;
    fret_real got[ORACLE_COUNT];
    const oracle_contact *c = &s.contact;
    ask(&s, got);
    for (int i = 0; i < 2; i++)
        printf("E0 = %.17g, nu = %.17g%s\n", c->E0[i], c->nu[i], c->rigid[i] ? " (rigid)" : "");
    printf("k = %.17g, c0 = %.17g, n = %.17g, h = %.17g, r0 = %.17g, mu = %.17g\n", c->k, c->c0, c->n, c->h,
           c->r0, s.mu);
    printf("FN = %.17g, Fx = %.17g, dz = %.17g, a = %.17g, dx = %.17g\n", s.F, s.Fx, s.dz, s.a, s.dx);
    printf("1-|k| = %.6g, t = %.17g, dx/dxmax = %.17g\n", 1 - fabs(c->k), oracle_t(o), oracle_x(o));
    for (oracle_scalar i = 0; i < ORACLE_COUNT; i++)
        mpfr_printf("%-8s ours %.21Lg exact %.30Rg: %.3g ulp\n", oracle_names[i], got[i], oracle_value(o, i),
                    oracle_ulps((double)got[i], oracle_value(o, i)));
}

static void show_random(unsigned long index) {
    oracle *o = oracle_new();
    hard_scene s = draw_scene(o, index);
    show(o, &s);
    oracle_free(o);
}

static void show_corner(const char *path, unsigned long number) {
    FILE *file = fopen(path, "r");
    char *line = NULL, *results[ORACLE_COUNT];
    size_t size = 0;
    hard_scene s;
    unsigned long i = 0;
    while (file && i < number && getline(&line, &size, file) > 0)
        i++;
    if (i == number && number > 0 && read_row(line, &s, results)) {
        oracle *o = oracle_new();
        solve(o, &s);
        show(o, &s);
        oracle_free(o);
    } else {
        printf("%s:%lu: not a row\n", path, number);
    }
    free(line);
    if (file)
        fclose(file);
}

static int finish(void) {
    int failed = 0;
    for (int i = 0; i < case_count; i++) {
        printf("  %s: %s, %lu checked\n", cases[i].name, cases[i].failed ? "FAILED" : "ok", cases[i].checked);
        failed += cases[i].failed;
    }
    printf("hard: %d passed, %d failed\n", case_count - failed, failed);
    return failed ? EXIT_FAILURE : EXIT_SUCCESS;
}

int main(int argc, char **argv) {
    unsigned long scenes = 2000, steps = 20000, jobs = 1;
    const char *table = "tests/reference/corners.csv";
    for (int i = 1; i + 1 < argc; i += 2) {
        unsigned long number = strtoul(argv[i + 1], NULL, 10);
        if (strcmp(argv[i], "--scene") == 0) {
            show_random(number);
            return EXIT_SUCCESS;
        }
        if (strcmp(argv[i], "--corner") == 0) {
            show_corner(table, number);
            return EXIT_SUCCESS;
        }
        if (strcmp(argv[i], "--diagrams") == 0) {
            hard_diagrams(number);
            return finish();
        }
        if (strcmp(argv[i], "--scenes") == 0)
            scenes = number;
        else if (strcmp(argv[i], "--steps") == 0)
            steps = number;
        else if (strcmp(argv[i], "--jobs") == 0 && number > 0)
            jobs = number;
        else if (strcmp(argv[i], "--table") == 0)
            table = argv[i + 1];
        else
            argc = 0;
    }
    if (argc % 2 == 0) {
        fprintf(stderr, "usage: hard [--scenes N] [--steps N] [--jobs N] [--table FILE] | --diagrams STEPS | "
                        "--scene INDEX | --corner LINE\n");
        return 2;
    }
    for (int region = 0; region < HARD_REGION_COUNT; region++)
        printf("%-8s %s\n", headings[region], meanings[region]);
    printf("\n");
    run_table(table);
    hard_tally *parts = start_jobs(scenes, jobs);
    hard_histories(steps);
    hard_tally sum = finish_jobs(parts, jobs);
    report(&sum, "random scenes");
    hard_case("scenes", "random", sum.passed, sum.failed);
    return finish();
}
