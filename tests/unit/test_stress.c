/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Stress inside: against point loads, known values, equilibrium, what the fields of the surface say, and the
 * forces that a depth has to carry. */
#include "fret/field.h"
#include "law/normal.h"
#include "number/integral.h"
#include "number/real.h"
#include "unit.h"

static unsigned long long state = 12;

static const fret_gap shapes[] = {
    {.kind = FRET_GAP_POWER, .terms = 1, .power = {{2, 0.005, 0.01}}},
    {.kind = FRET_GAP_POWER, .terms = 1, .power = {{3.5, 1e-6, 2e-4}}},
    {.kind = FRET_GAP_POWER, .terms = 1, .power = {{40, 1e-6, 2e-4}}},
    {.kind = FRET_GAP_FLAT_ROUNDED, .b = 1e-4, .R = 0.01},
    {.kind = FRET_GAP_EXACT_SPHERE, .R = 0.01},
    {.kind = FRET_GAP_FLAT_CONE, .b = 1e-4, .slope = 0.01},
    {.kind = FRET_GAP_SUM, .terms = 2, .power = {{2, 5e-6, 1e-3}, {4, 1e-6, 5e-4}}},
    {.kind = FRET_GAP_POWER, .terms = 1, .power = {{1.3, 0.005, 0.01}}},
    {.kind = FRET_GAP_POWER, .terms = 1, .power = {{1, 0.005, 0.01}}},
    {.kind = FRET_GAP_FLAT, .b = 1e-4},
};
enum { SHAPES = sizeof shapes / sizeof *shapes };

static void part_of(const fret_stress *s, double out[6]) {
    const double all[6] = {s->xx, s->yy, s->zz, s->xy, s->xz, s->yz};
    memcpy(out, all, sizeof all);
}

/* Pressed by 100 N, pushed by F1, then by F2. */
static fret_field *field_of(const fret_normal *n, double mu, double F1, double F2, fret_state *now) {
    fret_contact *c = NULL;
    fret_field *f = NULL;
    CHECK_OK(fret_contact_make(n, mu, FRET_EXACT, &c));
    CHECK_OK(fret_contact_step(c, &(fret_step){FRET_TO_FORCE, FRET_TO_FX, 100, 0}));
    CHECK_OK(fret_contact_step(c, &(fret_step){FRET_KEEP_NORMAL, FRET_TO_FX, 0, F1}));
    CHECK_OK(fret_contact_step(c, &(fret_step){FRET_KEEP_NORMAL, FRET_TO_FX, 0, F2}));
    fret_contact_state(c, now);
    CHECK_OK(fret_field_make(c, &f));
    fret_contact_free(c);
    return f;
}

static fret_field *field_of_shape(int shape, double mu, double F1, double F2, fret_state *now) {
    const fret_material steel = {{{210e9, 0.3, false}, {210e9, 0.3, false}}, 0, 1e-3};
    return field_of(unit_keep_normal(&steel, &shapes[shape]), mu, F1, F2, now);
}

/* ---- known ------------------------------------------------------------------------------------- */

static void point_loads(void) {
    unit_table t;
    if (!unit_open(&t, "stress.csv"))
        return;
    while (unit_row(&t)) {
        const unit_scene s = unit_make_scene(unit_input(&t, 0), 0);
        fret_state now;
        fret_stress got;
        double of[6];
        fret_field *f = field_of(unit_make_normal(&s), s.mu, unit_input(&t, 2), unit_input(&t, 3), &now);
        CHECK_OK(fret_field_stress(f, unit_input(&t, 4), unit_input(&t, 5), unit_input(&t, 6),
                                   unit_input(&t, 7), &got));
        const double mean = (double)(now.FN / (FRET_PI * now.a * now.a));
        part_of(&got, of);
        for (int i = 0; i < 6; i++)
            CHECK_ABS(of[i], unit_result(&t, 8 + i), mean, 1e-12L);
        fret_field_free(f);
    }
}

/* A sphere: the limits at the edge (Hertz; Hamilton of one that slides, 1983), the largest shear below. */
static void sphere(void) {
    static const double nu = 0.3, mu = 0.4;
    fret_state now;
    fret_stress s;
    fret_real p0 = 0;
    fret_field *f = field_of_shape(0, mu, 0, 0, &now);
    const double a = (double)now.a;
    CHECK_OK(fret_field_pressure(f, 0, &p0));
    CHECK_OK(fret_field_stress(f, nu, a, 0, 0, &s));
    CHECK_REL(s.xx, (1 - 2 * nu) / 3 * p0, 1e-13L);
    CHECK_ABS(s.zz, 0, p0, 1e-15L);
    CHECK_OK(fret_field_stress(f, nu, 0, 0, 0, &s));
    CHECK_REL(s.zz, -p0, 1e-14L);
    CHECK_REL(s.xx, -(1 + 2 * nu) / 2 * p0, 1e-14L);
    for (double z = 0.05; z < 3; z *= 1.3) { /* on the axis, Johnson (3.45) */
        const double arc = 1 - z * atan(1 / z), below = 1 / (2 * (1 + z * z));
        CHECK_OK(fret_field_stress(f, nu, 0, 0, z * a, &s));
        CHECK_ABS(s.xx, -p0 * ((1 + nu) * arc - below), p0, 1e-13L);
        CHECK_ABS(s.zz, -p0 / (1 + z * z), p0, 1e-13L);
        CHECK_ABS(s.xy, 0, p0, 1e-300L);
    }
    double best = 0, at = 0;
    for (double z = 0.47; z < 0.49; z += 1e-4) {
        CHECK_OK(fret_field_stress(f, nu, 0, 0, z * a, &s));
        const double shear = fret_stress_tresca(&s) / 2;
        at = shear > best ? z : at;
        best = fmax(best, shear);
    }
    CHECK_REL(best, 0.310 * p0, 1e-3L);
    CHECK_REL(at, 0.481, 1e-3L);
    fret_field_free(f);
    f = field_of_shape(0, mu, 40, 40, &now);
    CHECK_OK(fret_field_stress(f, nu, -a, 0, 0, &s));
    CHECK_REL(s.xx, p0 * ((1 - 2 * nu) / 3 + (4 + nu) * FRET_PI * mu / 8), 1e-13L);
    fret_field_free(f);
}

/* On the axis of a rigid punch, Sneddon: -F_N/(2 pi b^2) (1+3z^2)/(1+z^2)^2; of any flat end where it is
 * hardly pressed. */
static void punch(void) {
    static const fret_gap flat[] = {{.kind = FRET_GAP_FLAT, .b = 1e-4},
                                    {.kind = FRET_GAP_FLAT_CONE, .b = 1e-4, .slope = 0.01},
                                    {.kind = FRET_GAP_FLAT_PARABOLOID, .b = 1e-4, .R = 0.01},
                                    {.kind = FRET_GAP_FLAT_ROUNDED, .b = 1e-4, .R = 0.01}};
    static const double light[] = {100, 1e-3, 1e-6, 1e-9, 1e-18, 1e-30};
    const fret_material steel = {{{210e9, 0.3, false}, {210e9, 0.3, false}}, 0, 1e-3};
    for (size_t i = 0; i < sizeof flat / sizeof *flat; i++) {
        const fret_normal *n = unit_keep_normal(&steel, &flat[i]);
        for (size_t j = i > 0; j < sizeof light / sizeof *light; j++) {
            fret_press press;
            fret_field *f = NULL;
            CHECK_OK(fret_press_by_force(n, light[j], &press));
            CHECK_OK(fret_field_of_press(n, &press, &f));
            const double b = flat[i].b, beyond = (double)(press.a / b - 1);
            for (double z = 0.01; z < 10; z *= 3) {
                const double whole = 1 + z * z, expected = -light[j] / (2 * (double)FRET_PI * b * b) *
                                                           (1 + 3 * z * z) / (whole * whole);
                fret_stress s;
                CHECK_OK(fret_field_stress(f, 0.3, 0, 0, z * b, &s));
                CHECK_REL(s.zz, expected, 1e-14L + 3 * beyond);
                CHECK_ABS(s.xz, 0, -expected, 0);
            }
            fret_field_free(f);
        }
    }
}

/* ---- whatever the shape and the history -------------------------------------------------------- */

/* At the surface pressure and traction, in both bodies alike; the limit from within. */
static void surface(int i) {
    fret_state now;
    fret_field *f = field_of_shape(i, 0.4, 25, -5, &now);
    const double a = (double)now.a, mean = (double)(now.FN / (FRET_PI * now.a * now.a));
    for (int j = 0; j < 20; j++) {
        const double r = a * unit_random(&state, 0.02, 1.6), angle = unit_random(&state, 0, 6.2832),
                     x = r * cos(angle), y = r * sin(angle), z = 2e-15 * a;
        const fret_real radius = hypotl(x, y);
        fret_real p = 0, q = 0;
        fret_stress s, near, other;
        CHECK_OK(fret_field_pressure(f, radius, &p));
        CHECK_OK(fret_field_traction(f, radius, &q));
        CHECK_OK(fret_field_stress(f, 0.3, x, y, 0, &s));
        CHECK_OK(fret_field_stress(f, 0.3, x, y, z, &near));
        CHECK_OK(fret_field_stress(f, 0.1, x, y, -z, &other));
        const fret_real size = mean + p;
        CHECK_ABS(s.zz, -p, size, 4e-12L);
        CHECK_ABS(s.xz, -q, size, 2e-12L);
        CHECK_ABS(s.yz, 0, size, 1e-12L);
        CHECK_ABS(near.xx, s.xx, size, 1e-9L);
        CHECK_ABS(near.xy, s.xy, size, 1e-9L);
        CHECK_ABS(other.zz, -p, size, 1e-9L);
        CHECK_ABS(other.xz, -q, size, 1e-9L);
    }
    fret_field_free(f);
}

/* The divergence, by differences of fourth order. */
static void equilibrium(int i) {
    static const int row[3][3] = {{0, 3, 4}, {3, 1, 5}, {4, 5, 2}};
    fret_state now;
    fret_field *f = field_of_shape(i, 0.4, 30, 10, &now);
    const double a = (double)now.a, mean = (double)(now.FN / (FRET_PI * now.a * now.a)), h = 2e-3;
    for (int j = 0; j < 8; j++) {
        const double at[3] = {unit_random(&state, -1.5, 1.5), unit_random(&state, -1.5, 1.5),
                              unit_random(&state, 0.25, 1.5) * (j % 2 ? -1 : 1)};
        double sum[3] = {0, 0, 0};
        for (int axis = 0; axis < 3; axis++)
            for (int l = -2; l <= 2; l++) {
                static const double weight[] = {1.0 / 12, -8.0 / 12, 0, 8.0 / 12, -1.0 / 12};
                double x[3] = {at[0], at[1], at[2]}, of[6];
                fret_stress s;
                x[axis] += l * h;
                CHECK_OK(fret_field_stress(f, 0.25, x[0] * a, x[1] * a, x[2] * a, &s));
                part_of(&s, of);
                for (int c = 0; c < 3; c++)
                    sum[c] += weight[l + 2] * of[row[c][axis]] / h;
            }
        for (int c = 0; c < 3; c++)
            CHECK_ABS(sum[c], 0, mean, 1e-7L);
    }
    fret_field_free(f);
}

/* The loads on a plane at a depth, over the angle evenly: F_N and F_x, with those of a point beyond SPAN
 * contact radii. */
enum { SPAN = 60 };
typedef struct plane {
    const fret_field *field;
    double a, z;
    bool shear;
} plane;

static fret_real plane_rate(fret_real t, fret_real rest, void *context) {
    enum { TURNS = 8 };
    const plane *p = context;
    const double r = p->a * (double)SPAN * (double)t;
    double sum = 0;
    for (int i = 0; i < TURNS; i++) {
        const double angle = 6.283185307179586 * (i + 0.3) / (double)TURNS;
        fret_stress s;
        CHECK_OK(fret_field_stress(p->field, 0.3, r * cos(angle), r * sin(angle), p->z, &s));
        sum += p->shear ? s.xz : s.zz;
    }
    (void)rest;
    return 2 * FRET_PI * r * sum / (double)TURNS * p->a * (double)SPAN;
}

static void resultants(int i) {
    fret_state now;
    fret_field *f = field_of_shape(i, 0.4, 30, 10, &now);
    for (int j = 0; j < 4; j++) {
        plane p = {f, (double)now.a, (double)now.a * (j < 2 ? 0.3 : -1.1), j % 2};
        const double z = fabs(p.z) / p.a, whole = SPAN * SPAN + z * z, cube = whole * sqrt(whole),
                     beyond =
                         j % 2 ? z * (1.5 * (double)SPAN * (double)SPAN + z * z) / cube : z * z * z / cube;
        const fret_real load = j % 2 ? now.Fx : now.FN;
        CHECK_ABS(fret_integral(plane_rate, &p, 1e-8L).value, -load * (1 - beyond), now.FN,
                  j % 2 ? 1e-5L : 1e-8L);
    }
    fret_field_free(f);
}

/* ---- refusals, and of a state ------------------------------------------------------------------ */

static void refusals(void) {
    fret_state now;
    fret_stress s;
    fret_field *f = field_of_shape(8, 0.4, 25, -5, &now);
    CHECK_ERROR(fret_field_stress(f, 0.3, 0, 0, 0, &s), FRET_SINGULAR, "r");
    CHECK_ERROR(fret_field_stress(f, 0.6, 0, 0, 1e-5, &s), FRET_BAD_NU, "nu");
    CHECK_ERROR(fret_field_stress(f, 0.3, 0, INFINITY, 1e-5, &s), FRET_NOT_FINITE, "y");
    fret_field_free(f);
    const unit_scene graded = unit_make_scene(2, 0.3), even = unit_make_scene(2, 0);
    f = field_of(unit_make_normal(&graded), 0.4, 25, -5, &now);
    CHECK_ERROR(fret_field_stress(f, 0.3, 0, 0, 1e-5, &s), FRET_OUTSIDE, "k");
    fret_field_free(f);
    /* swung, and its chords */
    const fret_normal *n = unit_make_normal(&even);
    fret_contact *c = NULL, *chords = NULL;
    CHECK_OK(fret_contact_make(n, 0.4, FRET_EXACT, &c));
    CHECK_OK(fret_contact_make(n, 0.4, FRET_EXACT, &chords));
    CHECK_OK(fret_contact_step(c, &(fret_step){FRET_TO_FORCE, FRET_TO_FX, 100 + 30 * cos(1), 6}));
    CHECK_OK(fret_contact_swing(c, &(fret_sine){6, 30, 1, 100}, 0, 0.75));
    CHECK_OK(fret_field_make(c, &f));
    CHECK_ERROR(fret_field_stress(f, 0.3, 0, 0, 1e-5, &s), FRET_OUTSIDE, "contact");
    fret_real q = 0;
    fret_contact_state(c, &now);
    CHECK_OK(fret_field_traction(f, now.a / 2, &q));
    fret_field_free(f);
    CHECK_OK(fret_contact_chords(chords, c));
    CHECK_OK(fret_field_make(chords, &f));
    CHECK_OK(fret_field_stress(f, 0.3, (double)now.a / 2, 0, 0, &s));
    CHECK_REL(s.xz, -q, 1e-5L);
    fret_field_free(f);
    fret_contact_free(c);
    fret_contact_free(chords);
}

static void principal(void) {
    for (int i = 0; i < 200; i++) {
        fret_stress s = {unit_random(&state, -1, 1), unit_random(&state, -1, 1), unit_random(&state, -1, 1),
                         unit_random(&state, -1, 1), unit_random(&state, -1, 1), unit_random(&state, -1, 1)};
        double p[3];
        fret_stress_principal(&s, p);
        CHECK(p[0] >= p[1] && p[1] >= p[2]);
        const double second =
            s.xx * s.yy + s.yy * s.zz + s.zz * s.xx - s.xy * s.xy - s.xz * s.xz - s.yz * s.yz;
        CHECK_ABS(p[0] * p[1] + p[1] * p[2] + p[2] * p[0], second, 1, 1e-13L);
        const double third = s.xx * (s.yy * s.zz - s.yz * s.yz) - s.xy * (s.xy * s.zz - s.yz * s.xz) +
                             s.xz * (s.xy * s.yz - s.yy * s.xz);
        CHECK_ABS(p[0] * p[1] * p[2], third, 1, 1e-13L);
        const double a = p[0] - p[1], b = p[1] - p[2], c = p[2] - p[0];
        CHECK_ABS(fret_stress_mises(&s), sqrt((a * a + b * b + c * c) / 2), 1, 1e-13L);
        CHECK_ABS(fret_stress_tresca(&s), p[0] - p[2], 1, 1e-15L);
    }
    for (int i = 0; i < 100; i++) { /* 1, 1 - apart and -3 along turned axes */
        const double apart = i % 4 ? pow(10, unit_random(&state, -16, -2)) : 0;
        const long double a = (long double)unit_random(&state, -3, 3),
                          b = (long double)unit_random(&state, -3, 3);
        const long double u[3] = {cosl(a) * cosl(b), sinl(a) * cosl(b), -sinl(b)},
                          v[3] = {-sinl(a), cosl(a), 0},
                          w[3] = {cosl(a) * sinl(b), sinl(a) * sinl(b), cosl(b)};
        long double t[3][3];
        for (int j = 0; j < 3; j++)
            for (int k = 0; k < 3; k++)
                t[j][k] = u[j] * u[k] + (1 - (long double)apart) * v[j] * v[k] - 3 * w[j] * w[k];
        const fret_stress s = {(double)t[0][0], (double)t[1][1], (double)t[2][2],
                               (double)t[0][1], (double)t[0][2], (double)t[1][2]};
        double p[3];
        fret_stress_principal(&s, p);
        CHECK_ABS(p[0], 1, 3, 1e-15L);
        CHECK_ABS(p[1], 1 - apart, 3, 1e-15L);
        CHECK_ABS(p[2], -3, 3, 1e-15L);
    }
    const fret_stress even = {-2, -2, -2, 0, 0, 0};
    double p[3];
    fret_stress_principal(&even, p);
    CHECK(p[0] == -2 && p[1] == -2 && p[2] == -2);
}

int main(int argc, char **argv) {
    unit_start("stress", argc, argv);
    CASE(point_loads());
    CASE(sphere());
    CASE(punch());
    for (int i = 0; i < SHAPES; i++) {
        CASE(surface(i));
        CASE(equilibrium(i));
        if (!unit_skips((size_t)i))
            CASE(resultants(i));
    }
    CASE(refusals());
    CASE(principal());
    return unit_finish();
}
