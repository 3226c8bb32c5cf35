/* SPDX-License-Identifier: GPL-3.0-or-later */
/* An interrupt at any moment of what takes long: the call says so, leaves nothing half done behind, and gives
 * afterwards what it gives where nothing interrupts. The Makefile links this program so that functions of
 * numbers, which everything asks again and again, pass through here: each call is a moment. */
#include "law/normal.h"
#include "law/table.h"
#include "number/real.h"
#include "unit.h"

#include <limits.h>

static volatile sig_atomic_t stop;
static long left = -1; /* moments until there is an interrupt; -1: none comes */

static void moment(void) {
    if (left >= 0 && left-- == 0)
        stop = 1;
}

#define WRAPPED(type, name, parameters, arguments)                                                           \
    type __real_##name parameters;                                                                           \
    type __wrap_##name parameters;                                                                           \
    type __wrap_##name parameters {                                                                          \
        moment();                                                                                            \
        return __real_##name arguments;                                                                      \
    }
WRAPPED(fret_real, expl, (fret_real x), (x))
WRAPPED(fret_real, logl, (fret_real x), (x))
WRAPPED(fret_real, fret_pow, (fret_real x, fret_real y), (x, y))
WRAPPED(fret_real, fret_table_distance, (const struct fret_table *t, size_t row), (t, row))
WRAPPED(fret_profile, fret_gap_profile, (const fret_gap *gap, const fret_rule *rule, fret_real e),
        (gap, rule, e))

/* A call whose result is `good` to the last digit, interrupted at so many of its moments, spread over all of
 * them, the first ones too. What is not there after an interrupt is to be `gone`. */
#define EACH_MOMENT(tries, least, call, gone, good)                                                          \
    do {                                                                                                     \
        left = LONG_MAX;                                                                                     \
        CHECK_OK(call);                                                                                      \
        const long all_ = LONG_MAX - left;                                                                   \
        long ended_ = 0;                                                                                     \
        left = -1;                                                                                           \
        CHECK(all_ > 0 && (good));                                                                           \
        for (long n_ = 0; n_ < (tries); n_++) {                                                              \
            left = n_ < 8 ? n_ : all_ * (n_ - 7) / ((tries)-7);                                              \
            const fret_status st_ = (call);                                                                  \
            left = -1;                                                                                       \
            stop = 0;                                                                                        \
            CHECK(st_.code == FRET_INTERRUPTED ? (gone) : !st_.code && (good));                              \
            ended_ += st_.code != FRET_OK;                                                                   \
            CHECK_OK(call);                                                                                  \
            CHECK(good);                                                                                     \
        }                                                                                                    \
        CHECK(ended_ > (least));                                                                             \
    } while (0)

static unsigned long long seed = 11;

/* A ball, or one with a flat end, sampled: even, or of uneven and noisy rows. */
static struct fret_table *sampled(int rows, double flat, double noise) {
    double *r = malloc((size_t)rows * sizeof *r), *f = malloc((size_t)rows * sizeof *f);
    struct fret_table *t = NULL;
    for (int i = 0; i < rows; i++) {
        r[i] = 1e-3 * (i + (i && noise > 0 ? unit_random(&seed, -0.3, 0.3) : 0)) / (rows - 1);
        const double x = fmax(r[i] - flat, 0);
        f[i] = x * x / 0.02 * (1 + unit_random(&seed, -noise, noise));
    }
    CHECK_OK(fret_table_make(r, f, (size_t)rows, NULL, &t));
    free(r);
    free(f);
    return t;
}

static fret_normal *normal_of(double k, const fret_gap *gap) {
    const fret_material m = {
        .body = {{.E0 = 210e9, .nu = 0.3}, {.E0 = 210e9, .nu = 0.3}}, .k = k, .c0 = 1e-3};
    fret_normal *n = unit_keep_normal(&m, gap);
    fret_normal_stop(n, &stop);
    return n;
}

/* Oblique loading, then ever smaller turns: slices of all kinds. */
static void begin(fret_contact *m) {
    static const fret_step steps[] = {
        {FRET_TO_FORCE, FRET_TO_FX, 5, 1},    {FRET_TO_FORCE, FRET_TO_FX, 8, -1},
        {FRET_KEEP_NORMAL, FRET_TO_FX, 0, 2}, {FRET_TO_FORCE, FRET_TO_FX, 6, 1.5},
        {FRET_KEEP_NORMAL, FRET_TO_FX, 0, 1}, {FRET_KEEP_NORMAL, FRET_TO_FX, 0, 1.2}};
    fret_contact_reset(m);
    for (size_t i = 0; i < sizeof steps / sizeof *steps; i++)
        CHECK_OK(fret_contact_step(m, &steps[i]));
}

static void laws(const fret_gap *gap, double k, long tries) {
    const fret_material m = {
        .body = {{.E0 = 210e9, .nu = 0.3}, {.E0 = 210e9, .nu = 0.3}}, .k = k, .c0 = 1e-3};
    fret_normal *n = NULL;
    fret_press p = {0};
    CHECK_OK(fret_normal_make(&m, gap, NULL, &stop, &n));
    CHECK_OK(fret_press_by_force(n, 7, &p));
    const fret_real dz = p.dz;
    fret_normal_free(n);
    EACH_MOMENT(tries, tries / 2, fret_normal_make(&m, gap, NULL, &stop, &n), true,
                (CHECK_OK(fret_press_by_force(n, 7, &p)), fret_normal_free(n), p.dz == dz));
}

typedef enum what { PRESSURE, SURFACE, TRACTION, SURFACE_X } what;

static fret_status ask(const fret_contact *m, what w, fret_real r, fret_real *v) {
    fret_field *f = NULL;
    fret_status st = fret_field_make(m, &f);
    if (!st.code)
        st = w == PRESSURE   ? fret_field_pressure(f, r, v)
             : w == SURFACE  ? fret_field_surface(f, r, v)
             : w == TRACTION ? fret_field_traction(f, r, v)
                             : fret_field_surface_x(f, r, v);
    fret_field_free(f);
    return st;
}

/* Fields of a history. Its steps take microseconds: nothing stops them. */
static void memories(const fret_gap *gap, double k) {
    static const struct {
        what w;
        fret_real r;
    } places[] = {{PRESSURE, 1.2e-4L}, {SURFACE, 3.2e-4L},   {TRACTION, 0.4e-4L},
                  {TRACTION, 1.2e-4L}, {SURFACE_X, 0.4e-4L}, {SURFACE_X, 3.2e-4L}};
    fret_normal *n = normal_of(k, gap);
    fret_contact *m;
    CHECK_OK(fret_contact_make(n, 0.4, FRET_EXACT, &m));
    begin(m);
    for (size_t i = 0; i < sizeof places / sizeof *places; i++) {
        const what w = places[i].w;
        const fret_real r = places[i].r;
        fret_real v = 0;
        CHECK_OK(ask(m, w, r, &v));
        const fret_real want = v;
        EACH_MOMENT(12, 5, ask(m, w, r, &v), true, v == want);
    }
    fret_contact_free(m);
}

static void losses(const fret_gap *gap, double k) {
    fret_pressed c = {.normal = normal_of(k, gap), .mu = 0.4};
    fret_real loss = 0, error = 0;
    fret_loading peak;
    CHECK_OK(fret_press_by_force(c.normal, 8, &c.press));
    CHECK_OK(fret_loading_by_force(&c, 2, &peak));
    CHECK_OK(fret_cycle_loss_by_definition(&c, &peak, &loss, &error));
    const fret_real want = loss;
    EACH_MOMENT(20, 10, fret_cycle_loss_by_definition(&c, &peak, &loss, &error), true, loss == want);
}

int main(int argc, char **argv) {
    unit_start("moments", argc, argv);
    const fret_gap sum = {.kind = FRET_GAP_SUM, .terms = 2, .power = {{2, 50, 1}, {4, 2e6, 1}}};
    struct fret_table *few = sampled(16, 0, 0), *rough = sampled(100, 0, 5e-5), *flat = sampled(20, 2e-4, 0);
    const fret_gap of_few = {.kind = FRET_GAP_TABLE, .table = few},
                   of_rough = {.kind = FRET_GAP_TABLE, .table = rough},
                   of_flat = {.kind = FRET_GAP_TABLE, .table = flat};
    CASE(laws(&of_few, -0.99, 20));
    CASE(laws(&of_rough, 0.3, 20));
    CASE(laws(&of_flat, 0.2, 20));
    if (!unit_skips(1)) {
        CASE(memories(&of_few, 0.3));
    }
    CASE(memories(&of_flat, -0.5));
    CASE(losses(&sum, 0.3));
    CASE(losses(&of_few, -0.2));
    const int status = unit_finish();
    fret_table_free(few);
    fret_table_free(rough);
    fret_table_free(flat);
    return status;
}
