/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A test program: cases of checks that count and go on, tables of references, a line a case and one for all
 * at the end. FRET_UNIT_VERBOSE=1 prints the worst error of every CHECK_REL and CHECK_ABS. */
#ifndef UNIT_H
#define UNIT_H

#include <float.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "fret/fret.h"

/* Where long double carries guard digits the references test them; else what a double can hold. */
#define UNIT_TOL(guarded, plain) (LDBL_MANT_DIG >= 64 ? (guarded) : (plain))

enum { UNIT_COLUMNS = 32, UNIT_LINE = 4096, UNIT_SHOWN = 40, UNIT_CASES = 100 };

/* What has a name of its own; a loop that draws a million scenes is one. */
typedef struct unit_case {
    const char *name;
    long checks, failed;
    clock_t time;
} unit_case;

typedef struct unit_site {
    const char *what, *file;
    int line;
    bool known;
    fret_real worst, tolerance;
    char row[64];
    struct unit_site *next;
} unit_site;

typedef struct unit_table {
    FILE *file;
    const char *name;
    int line, columns;
    char text[UNIT_LINE];
    const char *cell[UNIT_COLUMNS];
} unit_table;

static struct {
    const char *name, *reference;
    long failed; /* checks, of all cases */
    unit_case all[UNIT_CASES], *now;
    int cases;
    unit_site *sites;
    const unit_table *table; /* the row at hand, for messages */
    fret_normal **normal;    /* to be freed */
    size_t normals, normal_room;
} unit;

/* A case with this name begins, or goes on. */
static inline unit_case *unit_enter(const char *name) {
    const size_t n = strcspn(name, "(");
    for (int i = 0; i < unit.cases; i++)
        if (strcspn(unit.all[i].name, "(") == n && !strncmp(unit.all[i].name, name, n))
            return &unit.all[i];
    if (unit.cases == UNIT_CASES) {
        printf("%s: more than %d cases\n", unit.name, UNIT_CASES);
        exit(EXIT_FAILURE);
    }
    unit.all[unit.cases].name = name;
    return &unit.all[unit.cases++];
}

static inline void unit_start(const char *name, int argc, char **argv) {
    unit.name = name;
    unit.reference = argc > 1 ? argv[1] : getenv("FRET_REFERENCE");
    if (!unit.reference)
        unit.reference = "tests/reference";
    unit.now = unit_enter("main");
}

/* `CASE(call(arguments))` is the case `call`; what is checked outside of all belongs to `main`. */
#define CASE(call)                                                                                           \
    do {                                                                                                     \
        unit_case *const outer_ = unit.now;                                                                  \
        const clock_t start_ = clock();                                                                      \
        unit.now = unit_enter(#call);                                                                        \
        call;                                                                                                \
        unit.now->time += clock() - start_;                                                                  \
        unit.now = outer_;                                                                                   \
    } while (0)

/* A few of many like cases, where there is no time for all: is number i left out? */
static inline bool unit_skips(size_t i) {
    const char *few = getenv("FRET_FEW");
    return few && *few && i % 4 > 0;
}

/* The number to try after n: each, or ever fewer. */
static inline int unit_next(int n) {
    return n + 1 + unit_skips(1) * n / 4;
}

/* How many of `many` random things are drawn. */
static inline int unit_draws(int many) {
    return unit_skips(1) ? (many + 7) / 8 : many;
}

static inline int unit_finish(void) {
    int passed = 0, failed = 0;
    while (unit.normals)
        fret_normal_free(unit.normal[--unit.normals]);
    free(unit.normal);
    if (getenv("FRET_UNIT_VERBOSE"))
        for (const unit_site *s = unit.sites; s; s = s->next)
            printf("%s:%d: worst %.2Le of %.2Le%s%s: %s\n", s->file, s->line, s->worst, s->tolerance,
                   *s->row ? " at " : "", s->row, s->what);
    for (const unit_case *c = unit.all; c < unit.all + unit.cases; c++) {
        if (!c->checks)
            continue;
        printf("  %.*s: %s, %ld checked, %.2f s\n", (int)strcspn(c->name, "("), c->name,
               c->failed ? "FAILED" : "ok", c->checks, (double)c->time / CLOCKS_PER_SEC);
        ++*(c->failed ? &failed : &passed);
    }
    printf("%s: %d passed, %d failed\n", unit.name, passed, failed);
    return failed ? EXIT_FAILURE : EXIT_SUCCESS;
}

/* Counts; true when the failure is to be described. */
static inline bool unit_count(bool ok, const char *file, int line) {
    unit.now->checks++;
    if (ok)
        return false;
    unit.now->failed++;
    if (unit.failed++ >= UNIT_SHOWN)
        return false;
    printf("%s:%d: ", file, line);
    if (unit.table)
        printf("[%s:%d] ", unit.table->name, unit.table->line);
    return true;
}

static inline bool unit_true(bool ok, const char *what, const char *file, int line) {
    if (unit_count(ok, file, line))
        printf("failed: %s\n", what);
    return ok;
}

static inline void unit_near(unit_site *s, fret_real value, fret_real expected, fret_real scale,
                             fret_real tolerance) {
    if (!s->known) {
        s->known = true;
        s->tolerance = tolerance;
        s->next = unit.sites;
        unit.sites = s;
    }
    fret_real error = value == expected ? 0 : fabsl(value - expected) / scale;
    bool ok = error <= tolerance; /* false for NaN */
    if (!ok || error > s->worst) {
        s->worst = error;
        s->tolerance = tolerance;
        if (unit.table)
            snprintf(s->row, sizeof s->row, "%s:%d", unit.table->name, unit.table->line);
    }
    if (unit_count(ok, s->file, s->line))
        printf("%s = %.21Lg, expected %.21Lg, error %.2Le > %.2Le\n", s->what, value, expected, error,
               tolerance);
}

static inline void unit_code(fret_status got, fret_code expected, const char *what, const char *file,
                             int line) {
    if (unit_count(got.code == expected, file, line))
        printf("%s: code %d (%s, %.6g), expected %d\n", what, (int)got.code,
               got.quantity ? got.quantity : "-", got.value, (int)expected);
}

/* An error that names its argument. */
static inline void unit_error(fret_status got, fret_code expected, const char *quantity, const char *what,
                              const char *file, int line) {
    bool ok = got.code == expected && got.quantity && strcmp(got.quantity, quantity) == 0;
    if (unit_count(ok, file, line))
        printf("%s: code %d (%s, %.6g), expected %d (%s)\n", what, (int)got.code,
               got.quantity ? got.quantity : "-", got.value, (int)expected, quantity);
}

#define CHECK(condition) unit_true((condition), #condition, __FILE__, __LINE__)
#define CHECK_OK(status) unit_code((status), FRET_OK, #status, __FILE__, __LINE__)
#define CHECK_CODE(status, code) unit_code((status), (code), #status, __FILE__, __LINE__)
#define CHECK_ERROR(status, code, quantity)                                                                  \
    unit_error((status), (code), (quantity), #status, __FILE__, __LINE__)

/* |value-expected| <= tolerance * scale. */
#define CHECK_ABS(value, expected, scale, tolerance)                                                         \
    do {                                                                                                     \
        static unit_site site_ = {.what = #value, .file = __FILE__, .line = __LINE__};                       \
        unit_near(&site_, (value), (expected), (scale), (tolerance));                                        \
    } while (0)

#define CHECK_REL(value, expected, tolerance)                                                                \
    do {                                                                                                     \
        const fret_real expected_ = (expected);                                                              \
        CHECK_ABS(value, expected_, fabsl(expected_), tolerance);                                            \
    } while (0)

static inline bool unit_open(unit_table *t, const char *name) {
    char path[UNIT_LINE];
    *t = (unit_table){.name = name};
    snprintf(path, sizeof path, "%s/%s", unit.reference, name);
    t->file = fopen(path, "r");
    if (!t->file && unit_count(false, __FILE__, __LINE__))
        printf("cannot open %s\n", path);
    return t->file != NULL;
}

/* The next row; closes the table after the last one, which must have been preceded by some. */
static inline bool unit_row(unit_table *t) {
    unit.table = t;
    while (fgets(t->text, sizeof t->text, t->file)) {
        t->line++;
        if (*t->text == '#')
            continue;
        t->columns = 0;
        for (char *p = t->text; p && t->columns < UNIT_COLUMNS;) {
            t->cell[t->columns++] = p;
            p = strchr(p, ',');
            if (p)
                *p++ = 0;
        }
        return true;
    }
    fclose(t->file);
    CHECK(t->columns > 0);
    unit.table = NULL;
    return false;
}

/* Inputs are doubles, results have more digits. */
static inline double unit_input(const unit_table *t, int i) {
    return i < t->columns ? strtod(t->cell[i], NULL) : (double)NAN;
}

static inline fret_real unit_result(const unit_table *t, int i) {
    return i < t->columns ? strtold(t->cell[i], NULL) : (fret_real)NAN;
}

/* A contact of a table: 12 columns from `i` on. */
typedef struct unit_scene {
    fret_material material;
    fret_gap gap;
    double mu;
} unit_scene;

enum { UNIT_SCENE_COLUMNS = 12 };

static inline unit_scene unit_read_scene(const unit_table *t, int i) {
    unit_scene s = {.mu = unit_input(t, i + 11)};
    for (int b = 0; b < 2; b++)
        s.material.body[b] = (fret_body){unit_input(t, i + 3 * b), unit_input(t, i + 3 * b + 1),
                                         unit_input(t, i + 3 * b + 2) != 0};
    s.material.k = unit_input(t, i + 6);
    s.material.c0 = unit_input(t, i + 7);
    s.gap.kind = FRET_GAP_POWER;
    s.gap.terms = 1;
    s.gap.power[0] = (fret_power){unit_input(t, i + 8), unit_input(t, i + 9), unit_input(t, i + 10)};
    return s;
}

/* A plain steel contact, graded by k, with gap ~ r^n. */
static inline unit_scene unit_make_scene(double n, double k) {
    unit_scene s = {.material = {{{210e9, 0.3, false}, {70e9, 0.35, false}}, k, 1e-3}, .mu = 0.4};
    s.gap.kind = FRET_GAP_POWER;
    s.gap.terms = 1;
    s.gap.power[0] = (fret_power){n, 1e-5, 1e-3};
    return s;
}

/* Normal contacts live until the end of the test. NULL and a failed check where there is none. */
static inline fret_normal *unit_keep_normal(const fret_material *material, const fret_gap *gap) {
    fret_normal *n = NULL;
    CHECK_OK(fret_normal_make(material, gap, NULL, NULL, &n));
    if (n && unit.normals == unit.normal_room) {
        unit.normal_room = unit.normal_room ? 2 * unit.normal_room : 64;
        unit.normal = realloc(unit.normal, unit.normal_room * sizeof *unit.normal);
    }
    if (n)
        unit.normal[unit.normals++] = n;
    return n;
}

/* The normal contact of a scene, and pressed. */
static inline fret_normal *unit_make_normal(const unit_scene *s) {
    return unit_keep_normal(&s->material, &s->gap);
}

static inline fret_pressed unit_make_contact(const unit_scene *s, double FN) {
    fret_pressed c = {.normal = unit_make_normal(s), .mu = s->mu};
    CHECK_OK(fret_press_by_force(c.normal, FN, &c.press));
    return c;
}

/* Deterministic uniform numbers (splitmix64). */
static inline double unit_random(unsigned long long *state, double lo, double hi) {
    unsigned long long z = *state += 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    z ^= z >> 31;
    return lo + (hi - lo) * ((double)(z >> 11) * 0x1p-53);
}

/* int_a^b f by the tanh-sinh rule, end-point singularities welcome: f(x, x-a, b-x). */
typedef fret_real unit_integrand(fret_real x, fret_real from_a, fret_real to_b, const void *context);

static inline fret_real unit_integrate(unit_integrand *f, const void *context, fret_real a, fret_real b) {
    fret_real half_pi = 1.57079632679489661923132169163975144L, sum = 0, step = 1.0L / 64;
    for (int i = -512; i <= 512; i++) {
        fret_real t = i * step,
                  e = expl(-2 * half_pi * sinhl(fabsl(t))); /* small: distance to the near end */
        fret_real near = (b - a) * e / (1 + e), far = (b - a) / (1 + e);
        fret_real weight = half_pi * coshl(t) * 2 * e / ((1 + e) * (1 + e));
        if (weight < 1e-4000L || near <= 0)
            continue;
        sum += weight * (t < 0 ? f(a + near, near, far, context) : f(b - near, far, near, context));
    }
    return (b - a) * step * sum;
}

#endif
