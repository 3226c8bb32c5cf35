/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Fields after a swinging load: the traction against the force that it carries, the surface against the
 * springs that it follows from, both against chords of the same curve. Random loads, with corners.
 * FRET_FIELDS=N asks N times as much and prints the worst errors. */
#include "contact/memory.h"
#include "contact/swing.h"
#include "fret/field.h"
#include "number/quadrature.h"
#include "unit.h"

static const fret_real pi = 3.14159265358979323846264338327950288L;
static unsigned long long seed = 3;
static fret_real worst[4]; /* of the force, the surface, and both against chords */

static double uniform(double lo, double hi) {
    return unit_random(&seed, lo, hi);
}

static double pick(const double *from, size_t count) {
    return from[(size_t)uniform(0, (double)count * 0.999)];
}

static void compare(int which, fret_real got, fret_real want, fret_real scale, fret_real tolerance) {
    const fret_real error = fabsl(got - want) / scale;
    worst[which] = fmaxl(worst[which], error);
    CHECK_ABS(got, want, scale, tolerance);
}

/* Pressed, and swung for a while. */
static fret_swing *swing_of(const unit_scene *scene, double FN, double FA, double FNA, double phase,
                            double to, fret_memory **m) {
    const fret_sine w = {FA, FNA, phase, FN};
    fret_swing *s = NULL;
    fret_normal *n = unit_make_normal(scene);
    if (!fret_normal_is_power(n))
        CHECK_OK(fret_normal_prepare(n, 2 * FN, 0));
    CHECK_OK(fret_memory_make(n, scene->mu, m));
    CHECK_OK(fret_memory_step(*m, &(fret_step){FRET_TO_FORCE, FRET_KEEP_DX, FN, 0}));
    CHECK_OK(fret_memory_step(*m, &(fret_step){FRET_TO_FORCE, FRET_TO_FX, FN + FNA * cos(phase), FA}));
    if (!CHECK(fret_swing_make(*m, &s).code == FRET_OK))
        exit(unit_finish());
    if (to > 1)
        CHECK_OK(fret_swing_period(s, &w));
    CHECK_OK(fret_swing_part(s, &w, 0, to > 1 ? to - 1 : to));
    return s;
}

/* Between the ends of two pieces, where fields have kinks. */
typedef struct part {
    const fret_swing *s;
    fret_real lo, hi, r;
} part;

static fret_real carried(fret_real t, fret_real rest, void *context) {
    const part *p = context;
    const fret_real r = p->lo * rest + p->hi * t;
    fret_real q = 0;
    if (t > 0 && rest > 0 && r != fret_gap_start(&p->s->normal->gap)) /* where it is infinite */
        CHECK_OK(fret_swing_traction(p->s, r, &q));
    return (p->hi - p->lo) * 2 * pi * r * q;
}

/* x^k u (r^2-x^2)^-(k+1)/2; hi - x with a power that takes away what is singular at r. */
static fret_real outwards(fret_real t, fret_real rest, void *context) {
    const part *p = context;
    const fret_real k = p->s->normal->foundation.k, power = 2 / (1 - k), wide = p->hi - p->lo;
    const fret_real off = wide * powl(t, power), away = (p->r - p->hi) + off,
                    x = p->lo + wide * -expm1l(power * (rest < 0.5L ? log1pl(-rest) : logl(t)));
    return t > 0 && x > 0 ? fret_swing_displacement(p->s, x) * powl(x, k) *
                                powl(away * (p->r + x), -(1 + k) / 2) * power * off / t
                          : 0;
}

static size_t kinks_of(const fret_swing *s, fret_real *kink) {
    const fret_real flat = fret_gap_start(&s->normal->gap);
    size_t count = 1;
    kink[0] = 0;
    if (flat > 0)
        kink[count++] = flat;
    for (size_t i = 0; i < s->count; i++) {
        const piece *p = &s->pieces[i];
        const fret_real a =
            fret_law_radius(s->normal, fret_law_depth(s->normal, (p->last[M] + p->last[P]) / 2));
        if (a > kink[count - 1] * (1 + 1e-9L))
            kink[count++] = a;
    }
    return count;
}

static fret_real surface_of(const fret_swing *s, const fret_real *kink, size_t count, fret_real r) {
    enum { PARTS = 12 };
    const fret_real k = s->normal->foundation.k;
    fret_real sum = 0;
    for (size_t i = 1; i < count && kink[i - 1] < r; i++) {
        const fret_real lo = kink[i - 1], wide = (fminl(kink[i], r) - lo) / PARTS;
        for (int j = 0; j < PARTS; j++) /* what is singular at r is close to others, too */
            sum +=
                fret_integrate(outwards, &(part){s, lo + wide * j,
                                                 j < PARTS - 1 ? lo + wide * (j + 1) : fminl(kink[i], r), r});
    }
    return 2 * cosl(pi * k / 2) / pi * sum;
}

static const fret_gap shapes[] = {
    {.kind = FRET_GAP_EXACT_SPHERE, .R = 10e-3},
    {.kind = FRET_GAP_FLAT_CONE, .b = 0.2e-3, .slope = 0.01},
    {.kind = FRET_GAP_FLAT_ROUNDED, .b = 0.1e-3, .R = 5e-3},
    {.kind = FRET_GAP_SUM, .terms = 2, .power = {{2, 5e-5, 1e-3}, {4, 1e10, 1}}},
};

/* far: exponents for which the definitions themselves are not so easy to integrate. */
static void random_load(bool far, const fret_gap *shape) {
    static const double angle[] = {0, 90, 180, 270}, n[2][3] = {{1, 2, 4}, {0.5, 6, 15}},
                        k[2][4] = {{-0.5, 0, 0.3, 0.7}, {-0.99, -0.9, 0.9, 0.99}};
    const double FN = 100, FNA = uniform(0, 90), mu = 0.4, FA = uniform(0.1, 0.95) * mu * (FN - FNA);
    const double power = pick(n[far], 3), grading = pick(k[far], 4);
    const double degrees = uniform(0, 1) < 0.2 ? pick(angle, 4) : uniform(0, 360);
    unit_scene scene = {.material = {{{210e9, 0.3, false}, {210e9, 0.3, false}}, grading, 1e-3},
                        .gap = {.kind = FRET_GAP_POWER, .terms = 1, .power = {{power, 5e-5, 1e-3}}},
                        .mu = mu};
    if (shape)
        scene.gap = *shape;
    const fret_real known = shape ? 1e-12L : 1e-13L;
    fret_memory *m = NULL;
    fret_swing *s = swing_of(&scene, FN, FA, FNA, degrees * (double)pi / 180,
                             uniform(0, 1) < 0.5 ? 2 : uniform(0.2, 2), &m);
    fret_state now;
    fret_real kink[64], force = 0, scale, got;
    const size_t count = kinks_of(s, kink);
    fret_swing_state(s, &now);
    for (size_t i = 1; i < count && !far; i++)
        force += fret_integrate(carried, &(part){s, kink[i - 1], kink[i], 0});
    if (!far)
        compare(0, force, now.Fx, mu * now.FN, known);
    CHECK_OK(fret_swing_memory(s, m));
    for (int i = 0; i < 6; i++) {
        const fret_real r = now.a * (i < 4 ? uniform(0, 1) : uniform(1, 2)),
                        reach = mu * s->normal->foundation.eta * now.dz;
        fret_real chords;
        if (i % 3 == 1) {
            CHECK_OK(fret_swing_surface_x(s, r, &got));
            if (!far)
                compare(1, got, surface_of(s, kink, count, r), reach, known);
            CHECK_OK(fret_surface_x(m, r, &chords));
            compare(3, got, chords, reach, 1e-5L);
        }
        CHECK_OK(fret_pressure(s->normal, now.a, 0.9L * now.a, &scale));
        CHECK_OK(fret_swing_traction(s, r, &got));
        CHECK_OK(fret_traction(m, r, &chords));
        CHECK((r < now.a) == (got != 0));
        compare(2, got, chords, mu * scale, far ? 2e-2L : 1e-3L);
        CHECK_ABS(fret_swing_displacement(s, r), fret_memory_displacement(m, r), reach, 1e-5L);
    }
    CHECK_OK(fret_swing_surface_x(s, 0, &got)); /* the centre goes as far as its spring */
    CHECK_ABS(got, fret_swing_displacement(s, 0), mu * s->normal->foundation.eta * now.dz, 1e-15L);
    fret_real beyond = 0; /* as of a point load, where no number holds the force of a contact so large */
    CHECK_OK(fret_swing_surface_x(s, 1e300L * now.a, &got));
    CHECK_OK(fret_swing_surface_x(s, 1e100L * now.a, &beyond));
    CHECK_REL(got, beyond * powl(1e-200L, 1 + grading), 1e-12L);
    fret_swing_free(s);
    fret_memory_free(m);
}

int main(int argc, char **argv) {
    unit_start("swing_field", argc, argv);
    const char *many = getenv("FRET_FIELDS");
    for (int i = 0; i < 12 * (many ? atoi(many) : 1); i++)
        random_load(i % 3 == 2, NULL);
    for (int i = 0; i < 8 * (many ? atoi(many) : 1); i++)
        random_load(false, &shapes[i % 4]);
    if (many)
        printf("force %.1Le  surface %.1Le  chords: traction %.1Le  surface %.1Le\n", worst[0], worst[1],
               worst[2], worst[3]);
    return unit_finish();
}
