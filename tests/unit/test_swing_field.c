/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Fields after a swinging load: the traction against the force that it carries, the surface against the
 * springs that it follows from, both against chords of the same curve. Random loads, with corners.
 * FRET_FIELDS=N asks N times as much and prints the worst errors. */
#include "histories.h"
#include "number/integral.h"
#include "places.h"
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

static fret_status swing_traction(fret_swing *s, fret_real r, fret_real *q) {
    return place_traction(SWUNG(s), r, q);
}

static fret_status swing_surface_x(fret_swing *s, fret_real r, fret_real *u) {
    return place_surface_x(SWUNG(s), r, u);
}

/* Pressed, and swung for a while. */
static fret_swing *swing_of(const unit_scene *scene, double FN, double FA, double FNA, double phase,
                            double to, fret_memory **m) {
    const fret_sine w = {FA, FNA, phase, FN};
    fret_swing *s = NULL;
    fret_normal *n = unit_make_normal(scene);
    CHECK_OK(fret_memory_make(n, scene->mu, m));
    CHECK_OK(fret_memory_step(*m, &(fret_step){FRET_TO_FORCE, FRET_KEEP_DX, FN, 0}));
    CHECK_OK(fret_memory_step(*m, &(fret_step){FRET_TO_FORCE, FRET_TO_FX, FN + FNA * cos(phase), FA}));
    if (!CHECK(fret_swing_make(*m, &s).code == FRET_OK))
        exit(unit_finish());
    if (to > 1)
        CHECK_OK(fret_swing_part(s, &w, 0, 1));
    CHECK_OK(fret_swing_part(s, &w, 0, to > 1 ? to - 1 : to));
    return s;
}

typedef struct hand {
    const fret_swing *s;
    const arc *p;
    fret_real r, from, lo, hi;
} hand;

/* Between the ends of two arcs, where fields have kinks. */
typedef struct part {
    fret_swing *s;
    fret_real lo, hi, r;
} part;

static fret_real carried(fret_real t, fret_real rest, void *context) {
    const part *p = context;
    const fret_real r = p->lo * rest + p->hi * t;
    fret_real q = 0;
    if (t > 0 && rest > 0 && r != fret_gap_start(&p->s->normal->gap)) /* where it is infinite */
        CHECK_OK(swing_traction(p->s, r, &q));
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

static fret_real radius_at(const fret_swing *s, const fret_real at[2]) {
    return fret_law_radius(s->normal, fret_law_depth(s->normal, (at[M] + at[P]) / 2));
}

static size_t kinks_of(const fret_swing *s, fret_real *kink) {
    const fret_real flat = fret_gap_start(&s->normal->gap);
    size_t count = 1;
    kink[0] = 0;
    if (flat > 0)
        kink[count++] = flat;
    for (size_t i = 0; i < s->count; i++) {
        const arc *p = &s->arcs[i];
        const fret_real a = radius_at(s, p->last);
        if (a > kink[count - 1] * (1 + 1e-9L))
            kink[count++] = a;
    }
    return count;
}

static fret_real surface_of(fret_swing *s, const fret_real *kink, size_t count, fret_real r) {
    enum { PARTS = 12 };
    const fret_real k = s->normal->foundation.k;
    fret_real sum = 0;
    for (size_t i = 1; i < count && kink[i - 1] < r; i++) {
        const fret_real lo = kink[i - 1], wide = (fminl(kink[i], r) - lo) / (fret_real)PARTS;
        for (int j = 0; j < PARTS; j++) /* what is singular at r is close to others, too */
            sum += fret_integral(
                       outwards,
                       &(part){s, lo + wide * j, j < PARTS - 1 ? lo + wide * (j + 1) : fminl(kink[i], r), r},
                       1e-10L)
                       .value;
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
        force += fret_integral(carried, &(part){s, kink[i - 1], kink[i], 0}, 1e-13L).value;
    if (!far)
        compare(0, force, now.Fx, mu * now.FN, known);
    CHECK_OK(fret_swing_memory(s, m));
    for (int i = 0; i < 6; i++) {
        const fret_real r = now.a * (i < 4 ? uniform(0, 1) : uniform(1, 2)),
                        reach = mu * s->normal->foundation.eta * now.dz;
        fret_real chords;
        if (i % 3 == 1) {
            CHECK_OK(swing_surface_x(s, r, &got));
            if (!far)
                compare(1, got, surface_of(s, kink, count, r), reach, known);
            CHECK_OK(place_surface_x(CONTACT_OF(m), r, &chords));
            compare(3, got, chords, reach, 1e-5L);
        }
        CHECK_OK(place_pressure(s->normal, now.a, 0.9L * now.a, &scale));
        CHECK_OK(swing_traction(s, r, &got));
        CHECK_OK(place_traction(CONTACT_OF(m), r, &chords));
        CHECK((r < now.a) == (got != 0));
        compare(2, got, chords, mu * scale, far ? 2e-2L : 1e-3L);
        CHECK_ABS(fret_swing_displacement(s, r), fret_memory_displacement(m, r), reach, 1e-5L);
    }
    CHECK_OK(swing_surface_x(s, 0, &got)); /* the centre goes as far as its spring */
    CHECK_ABS(got, fret_swing_displacement(s, 0), mu * s->normal->foundation.eta * now.dz, 1e-15L);
    fret_real beyond = 0; /* as of a point load, where no number holds the force of a contact so large */
    CHECK_OK(swing_surface_x(s, 1e300L * now.a, &got));
    CHECK_OK(swing_surface_x(s, 1e20L * now.a, &beyond));
    CHECK_REL(got, beyond * powl(1e-280L, 1 + grading), 1e-12L);
    fret_swing_free(s);
    fret_memory_free(m);
}

/* What the rounding of a radius makes of a traction that goes with a root of the distance from a kink. */
static fret_real felt(fret_real r, fret_real kink, fret_real k) {
    return 16 * LDBL_EPSILON * powl(fabsl(r / kink - 1) + LDBL_EPSILON, (k - 1) / 2);
}

/* In phase the load goes to and fro on a straight line, which a memory takes in steps: the curve that follows
 * it has the same fields, to the radius where it turned and as close to it as numbers come. */
static void straight_line(const fret_gap *gap, double grading) {
    const double FN = 100, FNA = 40, mu = 0.4, FA = 0.6 * mu * FNA;
    unit_scene scene = {.material = {{{210e9, 0.3, false}, {210e9, 0.3, false}}, grading, 1e-3},
                        .gap = {.kind = FRET_GAP_POWER, .terms = 1, .power = {{2, 5e-5, 1e-3}}},
                        .mu = mu};
    if (gap)
        scene.gap = *gap;
    fret_memory *m = NULL;
    fret_swing *s = swing_of(&scene, FN, FA, FNA, 0, 1, &m);
    const double least = FN - FNA;
    fret_press turned, whole;
    fret_real scale;
    CHECK_OK(fret_memory_step(m, &(fret_step){FRET_TO_FORCE, FRET_TO_FX, least, -FA}));
    CHECK_OK(fret_memory_step(m, &(fret_step){FRET_TO_FORCE, FRET_TO_FX, FN + FNA, FA}));
    CHECK(s->count > 1 && s->arcs[s->count - 1].curved);
    CHECK_OK(fret_press_by_force(s->normal, least, &turned));
    CHECK_OK(fret_press_by_force(s->normal, FN + FNA, &whole));
    CHECK_OK(place_pressure(s->normal, whole.a, 0.9L * whole.a, &scale));
    const fret_real known = fret_normal_is_power(s->normal) ? 1e-13L : 1e-12L;
    for (int i = -30; i <= 30; i++) {
        const fret_real r = turned.a + (i < 0 ? -1 : i > 0) * ldexpl(turned.a / 4, -2 * (30 - abs(i)));
        fret_real got = 0, want = 0;
        CHECK_OK(swing_traction(s, r, &got));
        CHECK_OK(place_traction(CONTACT_OF(m), r, &want));
        compare(0, got, want, mu * scale, known + felt(r / turned.a, 1, grading));
        CHECK_OK(swing_surface_x(s, r, &got));
        CHECK_OK(place_surface_x(CONTACT_OF(m), r, &want));
        compare(1, got, want, mu * s->normal->foundation.eta * whole.dz, known);
        CHECK_ABS(fret_swing_displacement(s, r), fret_memory_displacement(m, r),
                  mu * s->normal->foundation.eta * whole.dz, known);
    }
    fret_swing_free(s);
    fret_memory_free(m);
}

/* The slow twin of the traction of a power law: along each arc in parts that shrink towards where it
 * begins, beyond r. */
static fret_real rate_by_hand(fret_real t, fret_real rest, void *context) {
    const hand *h = context;
    const load_path *w = &h->p->path;
    const fret_real at = h->from + h->lo * rest + h->hi * t;
    const fret_point x =
        fret_law_at_force(h->s->normal, (load_path_at(w, M, at) + load_path_at(w, P, at)) / 2);
    const fret_real rise = (load_path_fall(w, M, at) - load_path_fall(w, P, at)) / 2 / x.K,
                    power = (h->s->normal->foundation.k - 1) / 2;
    return x.a > h->r ? rise * powl((x.a - h->r) * (x.a + h->r), power) : 0;
}

static fret_real traction_by_hand(const fret_swing *s, fret_real r) {
    const fret_normal *n = s->normal;
    const fret_foundation *f = &n->foundation;
    fret_real sum = 0;
    for (size_t i = 0; i < s->count; i++) {
        const arc *p = &s->arcs[i];
        const fret_real m = p->last[M] - p->first[M], up = p->last[P] - p->first[P];
        fret_real inner = 0, outer = 0;
        CHECK_OK(place_pressure(n, radius_at(s, p->first), r, &inner));
        CHECK_OK(place_pressure(n, radius_at(s, p->last), r, &outer));
        if (!p->curved && m + up > 0)
            sum += (up - m) / (up + m) * (outer - inner);
        if (!p->curved || outer == 0)
            continue;
        hand h = {.s = s, .p = p, .r = r, .from = p->lo};
        for (h.hi = p->hi - h.from; h.hi > LDBL_EPSILON; h.hi = h.lo) {
            h.lo = h.hi / 2;
            sum += f->cN0 * powl(f->c0, -f->k) / pi * (h.hi - h.lo) *
                   fret_integral(rate_by_hand, &h, 1e-12L).value;
        }
    }
    return s->mu * sum;
}

/* Close to where an arc begins its contacts all end close to the place. Nothing is said of the last digits
 * of a radius. */
static void near_kinks(double phase, double grading) {
    unit_scene scene = unit_make_scene(2, grading);
    fret_memory *m = NULL;
    fret_swing *s = swing_of(&scene, 100, 10, 40, phase, 1.7, &m);
    fret_real kink[64], scale, q;
    const size_t count = kinks_of(s, kink);
    CHECK_OK(place_pressure(s->normal, s->a, 0.9L * s->a, &scale));
    CHECK(count > 3);
    for (size_t j = 1; j < count; j++)
        for (int i = -12; i <= 12; i++) {
            const fret_real r = kink[j] * (1 + (i < 0 ? -1 : 1) * powl(10, -(fret_real)abs(i)));
            fret_real near = 1; /* how close the closest kink is */
            for (size_t l = 1; l < count; l++)
                near = fminl(near, fabsl(r / kink[l] - 1));
            bool within = i == 0 || r >= s->a;
            for (size_t l = 0; l < s->count; l++)
                within |= s->arcs[l].curved && r > radius_at(s, s->arcs[l].first) &&
                          r < radius_at(s, s->arcs[l].last);
            if (within)
                continue;
            CHECK_OK(swing_traction(s, r, &q));
            compare(0, q, traction_by_hand(s, r), scene.mu * scale, 1e-13L + felt(1 + near, 1, grading));
        }
    fret_swing_free(s);
    fret_memory_free(m);
}

static void agree(fret_status one, fret_status two, fret_real got, fret_real want) {
    CHECK(one.code == two.code);
    CHECK_ABS(got, want, fabsl(want), 1e-13L);
}

/* The centre, where traction comes to what it is next to it; what is no radius; and the edge of a flat end,
 * where it may be infinite, as of a memory. */
static void special_places(void) {
    unit_scene scene = unit_make_scene(2, 0.3);
    fret_memory *m = NULL;
    fret_swing *s = swing_of(&scene, 100, 15, 40, 1, 1.7, &m);
    fret_real centre = 0, close = 0, q = 0, want = 0;
    CHECK_OK(swing_traction(s, 0, &centre));
    CHECK_OK(swing_traction(s, 1e-9L * s->a, &close));
    CHECK(centre != 0);
    CHECK_REL(centre, close, 1e-11L);
    CHECK_OK(fret_swing_memory(s, m));
    CHECK_OK(place_traction(CONTACT_OF(m), 0, &want));
    CHECK_REL(centre, want, 1e-5L);
    CHECK_ERROR(swing_traction(s, -1e-9L, &q), FRET_NEGATIVE, "r");
    CHECK_ERROR(swing_surface_x(s, -1e-9L, &q), FRET_NEGATIVE, "r");
    CHECK_ERROR(swing_traction(s, (fret_real)NAN, &q), FRET_NOT_FINITE, "r");
    CHECK_ERROR(swing_surface_x(s, (fret_real)INFINITY, &q), FRET_NOT_FINITE, "r");
    CHECK(fret_swing_displacement(s, (fret_real)INFINITY) == 0);
    fret_swing_free(s);
    fret_memory_free(m);

    for (int i = 0; i < 4; i++) { /* no slip of the innermost slice, or all along */
        const bool gripped = i % 2, soft = i / 2;
        scene = unit_make_scene(2, soft ? -0.3 : 0.3);
        scene.gap = shapes[1];
        CHECK_OK(fret_memory_make(unit_make_normal(&scene), scene.mu, &m));
        if (gripped)
            CHECK_OK(fret_memory_step(m, &(fret_step){FRET_TO_FORCE, FRET_KEEP_DX, 50, 0}));
        CHECK_OK(fret_memory_step(m, &(fret_step){FRET_TO_FORCE, FRET_TO_FX, 100, 10}));
        if (!CHECK(fret_swing_make(m, &s).code == FRET_OK))
            exit(unit_finish());
        for (double r = 0.5; r < 2; r += 0.5) {
            const fret_real x = r * fret_gap_start(&s->normal->gap);
            q = want = 0;
            const fret_status one = swing_traction(s, x, &q), two = place_traction(CONTACT_OF(m), x, &want);
            CHECK((one.code == FRET_SINGULAR) == (r == 1 && soft && !gripped));
            agree(one, two, q, want);
        }
        fret_swing_free(s);
        fret_memory_free(m);
    }
}

/* A arc of no length, of no slope, has no part in a field. */
static void empty_arc(void) {
    const unit_scene scene = unit_make_scene(2, 0);
    fret_memory *m = NULL;
    fret_swing *s = swing_of(&scene, 100, 15, 40, 1, 0.7, &m);
    fret_real before[3], after[3];
    const fret_real r = 0.6L * s->a;
    for (int i = 0; i < 2; i++) {
        fret_real *out = i ? after : before;
        CHECK_OK(swing_traction(s, r, &out[0]));
        CHECK_OK(swing_surface_x(s, r, &out[1]));
        out[2] = fret_swing_displacement(s, r);
        const arc *top = &s->arcs[s->count - 1];
        const arc none = {.first = {top->last[M], top->last[P]}, .last = {top->last[M], top->last[P]}};
        if (!i && CHECK(s->count < s->room))
            s->arcs[s->count++] = none;
    }
    for (int i = 0; i < 3; i++)
        CHECK(before[i] != 0 && after[i] == before[i]);
    fret_swing_free(s);
    fret_memory_free(m);
}

/* Just inside the present edge a piece of an arc is as short as the rounding of its ends: it has no digits,
 * and refining it would take minutes. */
static void at_the_edge(void) {
    enum { LOADS = 300 };
    for (int i = 0; i < LOADS; i++) {
        const double FN = uniform(1, 100), swung = uniform(0.05, 0.55), mu = uniform(0.1, 1);
        unit_scene scene = unit_make_scene(2, i % 5 * 0.2 - 0.4);
        fret_memory *m = NULL;
        fret_real u, inside, edge;
        scene.gap = (fret_gap){.kind = FRET_GAP_FLAT_CONE, .b = 2e-4, .slope = uniform(1e-3, 1e-2)};
        scene.mu = mu;
        fret_swing *s = swing_of(&scene, FN, mu * FN * (1 - swung) * uniform(0.05, 0.95), FN * swung,
                                 uniform(0, 2 * M_PI), 2, &m);
        CHECK_OK(swing_surface_x(s, s->a / 2, &inside));
        CHECK_OK(swing_surface_x(s, s->a, &edge));
        for (int side = 0; side < 2; side++) {
            CHECK_OK(swing_surface_x(s, nextafter((double)s->a, side), &u));
            CHECK_ABS(u, edge, inside, 1e-6);
        }
        fret_swing_free(s);
        fret_memory_free(m);
        while (unit.normals)
            fret_normal_free(unit.normal[--unit.normals]);
    }
}

int main(int argc, char **argv) {
    unit_start("swing_field", argc, argv);
    CASE(straight_line(NULL, 0));
    CASE(straight_line(NULL, -0.5));
    CASE(straight_line(NULL, 0.7));
    for (size_t i = 0; i < sizeof shapes / sizeof *shapes; i++)
        CASE(straight_line(&shapes[i], 0.3));
    if (!unit_skips(1)) {
        CASE(near_kinks(1.5, 0));
        CASE(near_kinks(1.5, -0.5));
    }
    CASE(near_kinks(0.3, 0.5));
    CASE(special_places());
    CASE(empty_arc());
    CASE(at_the_edge());
    const char *many = getenv("FRET_FIELDS");
    for (int i = 0; i < 12 * (many ? atoi(many) : 1); i++)
        if (!unit_skips((size_t)i))
            CASE(random_load(i % 3 == 2, NULL));
    for (int i = 0; i < 8 * (many ? atoi(many) : 1); i++)
        if (!unit_skips((size_t)(i + i / 4)))
            CASE(random_load(false, &shapes[i % 4]));
    if (many)
        printf("force %.1Le  surface %.1Le  chords: traction %.1Le  surface %.1Le\n", worst[0], worst[1],
               worst[2], worst[3]);
    return unit_finish();
}
