/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Local fields: their integrals are the forces, they agree with the gap inside, and with closed forms. */
#include "law/normal.h"
#include "number/integral.h"
#include "number/real.h"
#include "places.h"
#include "unit.h"

/* Power laws, from the tip to far outside, and flat ends on both sides of their rim. The nearest places to
 * the edge are 1e-9 inside, 1e-4 outside. */
static void reference(void) {
    unit_table t;
    if (!unit_open(&t, "field.csv"))
        return;
    while (unit_row(&t)) {
        unit_scene s = unit_make_scene(unit_input(&t, 4), unit_input(&t, 5));
        const double a = unit_input(&t, 6), r = unit_input(&t, 7);
        s.gap.kind = (fret_gap_kind)atoi(t.cell[0]);
        s.gap.b = unit_input(&t, 1);
        s.gap.R = unit_input(&t, 2);
        s.gap.slope = unit_input(&t, 3);
        fret_real p = -1, w = -1;
        const fret_normal *normal = unit_make_normal(&s);
        CHECK_OK(place_pressure(normal, a, r, &p));
        CHECK_OK(place_surface(normal, a, r, &w));
        if (r < a)
            CHECK_REL(p, unit_result(&t, 8), 5e-14L);
        else
            CHECK(p == 0);
        CHECK_REL(w, unit_result(&t, 9), 5e-14L);
    }
}

/* Do all contacts that hold r press infinitely there? */
static bool is_infinite(const fret_normal *n, fret_real r) {
    const fret_real start = fret_gap_start(&n->gap), k = n->foundation.k;
    return r == start && (start > 0 ? fret_gap_sharp(&n->gap) && k <= 0 : fret_gap_tip(&n->gap) + k <= 1);
}

/* What a ring presses: the traction of one that is pushed while it is pressed on, by half of what it may
 * carry.
 */
static fret_status ring_pressure(const fret_normal *n, double inner, double outer, fret_real r,
                                 fret_real *p) {
    const double within = (double)fret_law_at_radius(n, inner).F,
                 all = (double)fret_law_at_radius(n, outer).F;
    fret_contact *m = NULL;
    CHECK_OK(fret_contact_make(n, 0.5, FRET_EXACT, &m));
    CHECK_OK(fret_contact_step(m, &(fret_step){FRET_TO_FORCE, FRET_KEEP_DX, within, 0}));
    CHECK_OK(fret_contact_step(m, &(fret_step){FRET_TO_FORCE, FRET_TO_FX, all, 0.25 * (all - within)}));
    const fret_status st = place_traction(m, r, p);
    fret_segment core = {.outer = 0}, ring = core;
    CHECK(fret_contact_segment(m, 0, &core) && fret_contact_segment(m, 1, &ring));
    *p *= 2 / ring.sigma * (fret_normal_profile(n, outer) - fret_normal_profile(n, inner)) /
          (ring.outer - core.outer); /* doubles hold these loads, about */
    fret_contact_free(m);
    return st;
}

/* Sharp edges and tips: contacts whose pressure is finite there, and rings of those whose is not. */
static void sharp(void) {
    unit_table t;
    if (!unit_open(&t, "sharp.csv"))
        return;
    while (unit_row(&t)) {
        unit_scene s = unit_make_scene(unit_input(&t, 4), unit_input(&t, 5));
        const double inner = unit_input(&t, 6), a = unit_input(&t, 7), r = unit_input(&t, 8);
        s.gap.kind = (fret_gap_kind)atoi(t.cell[0]);
        s.gap.b = unit_input(&t, 1);
        s.gap.R = unit_input(&t, 2);
        s.gap.slope = unit_input(&t, 3);
        fret_real p = -1;
        const fret_normal *normal = unit_make_normal(&s);
        if (is_infinite(normal, r))
            CHECK(inner > 0 && place_pressure(normal, a, r, &p).code == FRET_SINGULAR && p == 0);
        if (inner > 0)
            CHECK_OK(ring_pressure(normal, inner, a, r, &p));
        else
            CHECK_OK(place_pressure(normal, a, r, &p));
        CHECK_REL(p, unit_result(&t, 9), 5e-14L);
    }
}

/* Large exponents: at given contact radius, and in a history. */
static void steep(void) {
    unit_table t;
    if (!unit_open(&t, "steep.csv"))
        return;
    while (unit_row(&t)) {
        const unit_scene s = unit_make_scene(unit_input(&t, 1), unit_input(&t, 2));
        const fret_normal *normal = unit_make_normal(&s);
        const double load = unit_input(&t, 3), r = unit_input(&t, 5);
        fret_real normally = -1, tangentially = -1;
        if (atoi(t.cell[0]) == 0) {
            CHECK_OK(place_pressure(normal, load, r, &normally));
            CHECK_OK(place_surface(normal, load, r, &tangentially));
        } else {
            const fret_step press = {FRET_TO_FORCE, FRET_KEEP_DX, load, 0},
                            push = {FRET_KEEP_NORMAL, FRET_TO_FX, 0, unit_input(&t, 4)};
            fret_contact *m = NULL;
            CHECK_OK(fret_contact_make(normal, s.mu, FRET_EXACT, &m));
            CHECK_OK(fret_contact_step(m, &press));
            CHECK_OK(fret_contact_step(m, &push));
            CHECK_OK(place_traction(m, r, &normally));
            CHECK_OK(place_surface_x(m, r, &tangentially));
            fret_contact_free(m);
        }
        CHECK_REL(normally, unit_result(&t, 6), UNIT_TOL(1e-13L, 1e-9L));
        CHECK_REL(tangentially, unit_result(&t, 7), UNIT_TOL(1e-13L, 1e-9L));
    }
}

/* The fields of a sum are the sums of those of its powers, steep ones and others, at one contact radius. */
static void sums(void) {
    static const double ks[] = {-0.7, 0, 0.5}, parts[] = {0.3, 0.9, 0.999, 1.001, 3};
    static const fret_power powers[] = {{2, 1e-5, 1e-3}, {50, 2e-6, 1e-3}, {1e5, 1e-6, 1e-3}};
    for (int i = 0; i < 3; i++) {
        const fret_material material = {{{210e9, 0.3, false}, {70e9, 0.35, false}}, ks[i], 1e-3};
        fret_gap all = {.kind = FRET_GAP_SUM, .terms = 3, .power = {powers[0], powers[1], powers[2]}};
        const fret_normal *whole = unit_keep_normal(&material, &all);
        for (int j = 0; j < 5; j++) {
            const fret_real a = 1e-3L, r = parts[j] * a;
            fret_real p = -1, w = -1, p_sum = 0, w_sum = 0;
            CHECK_OK(place_pressure(whole, a, r, &p));
            CHECK_OK(place_surface(whole, a, r, &w));
            for (int l = 0; l < 3; l++) {
                const fret_gap one = {.kind = FRET_GAP_POWER, .terms = 1, .power = {powers[l]}};
                const fret_normal *n = unit_keep_normal(&material, &one);
                fret_real p_one = 0, w_one = 0;
                CHECK_OK(place_pressure(n, a, r, &p_one));
                CHECK_OK(place_surface(n, a, r, &w_one));
                p_sum += p_one;
                w_sum += w_one;
            }
            CHECK_ABS(p, p_sum, fabsl(p_sum) + 1e-300L, UNIT_TOL(1e-13L, 1e-9L));
            CHECK_REL(w, w_sum, UNIT_TOL(1e-13L, 1e-9L));
        }
    }
}

typedef fret_status field(const void *what, fret_real r, fret_real *out);

typedef struct pressed {
    const fret_normal *normal;
    fret_real a;
} pressed;

static fret_status pressure(const void *what, fret_real r, fret_real *out) {
    const pressed *p = what;
    return place_pressure(p->normal, p->a, r, out);
}

static fret_status traction(const void *what, fret_real r, fret_real *out) {
    return place_traction(what, r, out);
}

/* int 2 pi r f dr over lo..hi, double exponential: the fields are singular in slope at both ends. */
static fret_real force_of(field *f, const void *what, fret_real lo, fret_real hi) {
    fret_real sum = 0;
    for (int i = -44; i <= 44; i++) {
        fret_real u = 0.1L * i, e = expl(-3.14159265358979323846L * sinhl(fabsl(u)));
        fret_real s = e / (1 + e), r = i < 0 ? lo + (hi - lo) * s : hi - (hi - lo) * s, value = 0;
        fret_real weight = 0.1L * 3.14159265358979323846L * coshl(u) * s / (1 + e) * (hi - lo);
        if (r <= lo || r >= hi)
            continue;
        CHECK_OK(f(what, r, &value));
        sum += weight * 2 * 3.14159265358979323846L * r * value;
    }
    return sum;
}

static fret_gap gap_of(int i) {
    if (i == 0)
        return (fret_gap){.kind = FRET_GAP_POWER, .terms = 1, .power = {{2, 0.005, 0.01}}};
    if (i == 1)
        return (fret_gap){.kind = FRET_GAP_POWER, .terms = 1, .power = {{1, 0.01, 1}}};
    if (i == 2)
        return (fret_gap){.kind = FRET_GAP_POWER, .terms = 1, .power = {{3.5, 1e-6, 2e-4}}};
    if (i == 3)
        return (fret_gap){.kind = FRET_GAP_FLAT_ROUNDED, .b = 1e-4, .R = 0.01};
    if (i == 4)
        return (fret_gap){.kind = FRET_GAP_EXACT_SPHERE, .R = 0.01};
    return (fret_gap){.kind = FRET_GAP_FLAT_CONE, .b = 1e-4, .slope = 0.01};
}

static void forces(void) {
    static const double ks[] = {-0.7, -0.3, 0, 0.4, 0.8};
    for (int g = 0; g < 6; g++)
        for (int i = g < 3 ? 0 : 1; i < 5;
             i += g < 3 ? 1 + unit_skips(1) : 2) { /* quadrature within quadrature is slow */
            const fret_material material = {{{210e9, 0.3, false}, {70e9, 0.33, false}}, ks[i], 1e-3};
            const fret_gap gap = gap_of(g);
            fret_contact *m = NULL;
            const fret_normal *normal = unit_keep_normal(&material, &gap);
            CHECK_OK(fret_contact_make(normal, 0.3, FRET_EXACT, &m));
            static const fret_step steps[] = {{FRET_TO_FORCE, FRET_KEEP_DX, 100, 0},
                                              {FRET_KEEP_NORMAL, FRET_TO_FX, 0, 20},
                                              {FRET_KEEP_NORMAL, FRET_TO_FX, 0, -5},
                                              {FRET_TO_FORCE, FRET_TO_FX, 130, 2},
                                              {FRET_TO_FORCE, FRET_TO_FX, 80, 9}};
            for (int j = 0; j < 5; j++)
                CHECK_OK(fret_contact_step(m, &steps[j]));
            fret_state s;
            fret_contact_state(m, &s);
            const pressed now = {normal, s.a};
            /* sharp edges are singular like (b-r)^((k-1)/2) or its logarithm: at most
             * (eps)^((k+1)/2) of the load lies closer to b than a radius can tell */
            const fret_real b = g == 3 || g == 5 ? 1e-4L : 0, tolerance = g == 5 ? 1e-11L : 1e-13L;
            fret_real lo = 0, Fp = 0, Fq = 0;
            if (b > 0) {
                Fp += force_of(pressure, &now, 0, b);
                Fq += force_of(traction, m, 0, b);
                lo = b;
            }
            Fp += force_of(pressure, &now, lo, s.a);
            fret_segment seg;
            for (size_t k = 0; fret_contact_segment(m, k, &seg); k++) {
                fret_real outer = fret_law_radius(normal, seg.outer);
                if (outer > lo)
                    Fq += force_of(traction, m, lo, outer);
                lo = outer > lo ? outer : lo;
            }
            CHECK_REL(Fp, s.FN, tolerance);
            CHECK_REL(Fq, s.Fx, tolerance);
            fret_real w = 0, u = 0, f = 0, out = 0;
            CHECK_OK(place_surface(normal, s.a, 0.9L * s.a, &w));
            CHECK_OK(fret_gap_f(&gap, 0.9L * s.a, &f));
            CHECK_REL(w, s.dz - f, 1e-15L);
            CHECK_OK(place_surface(normal, s.a, s.a, &w));
            CHECK_OK(place_surface(normal, s.a, s.a * (1 + 1e-12L),
                                   &out)); /* continuous, as steeply as (r-a)^((1-k)/2) */
            CHECK_ABS(out, w, s.dz, 3 * powl(1e-12L, (1 - ks[i]) / 2));
            CHECK_OK(place_surface_x(m, 0, &u)); /* the centre sticks and goes with the body */
            CHECK_REL(u, s.dx, 1e-12L);
            CHECK_OK(place_pressure(normal, s.a, 2 * s.a, &out));
            CHECK(out == 0);
            fret_contact_free(m);
        }
}

/* Hertz and Cattaneo-Mindlin at k = 0. */
static void closed(void) {
    const fret_material material = {{{210e9, 0.3, false}, {0, 0, true}}, 0, 1};
    const fret_gap gap = gap_of(0);
    const fret_real pi = 3.14159265358979323846L;
    fret_press p;
    fret_contact *m = NULL;
    fret_state s;
    const fret_normal *normal = unit_keep_normal(&material, &gap);
    CHECK_OK(fret_press_by_force(normal, 100, &p));
    CHECK_OK(fret_contact_make(normal, 0.3, FRET_EXACT, &m));
    CHECK_OK(fret_contact_step(m, &(fret_step){FRET_TO_FORCE, FRET_KEEP_DX, 100, 0}));
    CHECK_OK(fret_contact_step(m, &(fret_step){FRET_KEEP_NORMAL, FRET_TO_FX, 0, 15}));
    fret_contact_state(m, &s);
    for (int i = 0; i < 20; i++) {
        fret_real r = p.a * i / 20, q = 0, out = 0, p0 = 3 * 100 / (2 * pi * p.a * p.a);
        CHECK_OK(place_pressure(normal, p.a, r, &out));
        CHECK_REL(out, p0 * sqrtl(1 - r * r / (p.a * p.a)), 1e-15L);
        fret_real inner = r < s.c ? s.c / p.a * sqrtl(1 - r * r / (s.c * s.c)) : 0;
        CHECK_OK(place_traction(m, r, &q));
        CHECK_REL(q, 0.3 * p0 * (sqrtl(1 - r * r / (p.a * p.a)) - inner), 1e-13L);
        r = p.a * (1.01L + i);
        CHECK_OK(place_surface(normal, p.a, r, &out));
        fret_real hertz =
            ((2 * p.a * p.a - r * r) * asinl(p.a / r) + p.a * sqrtl(r * r - p.a * p.a)) / (pi * 0.01);
        CHECK_REL(out, hertz, 1e-11L);
    }
    fret_contact_free(m);
}

static void errors(void) {
    const fret_material material = {{{210e9, 0.3, false}, {0, 0, true}}, 0, 1};
    fret_gap gap = gap_of(1);
    fret_real out = 0;
    const fret_normal *normal = unit_keep_normal(&material, &gap);
    CHECK(place_pressure(normal, 1e-4L, -1, &out).code == FRET_NEGATIVE);
    CHECK(place_pressure(normal, 1e-4L, 0, &out).code == FRET_SINGULAR);
    CHECK(place_surface(normal, 1e-4L, -1, &out).code == FRET_NEGATIVE);
    gap = gap_of(5);
    normal = unit_keep_normal(&material, &gap);
    CHECK_ERROR(place_pressure(normal, 2e-4L, gap.b, &out), FRET_SINGULAR, "r");
    fret_contact *m = NULL;
    CHECK_OK(fret_contact_make(normal, 0.3, FRET_EXACT, &m));
    CHECK_OK(place_traction(m, 1, &out));
    CHECK(out == 0);
    CHECK(fret_contact_friction(m) == 0.3 && fret_contact_normal(m) == normal);
    fret_contact_free(m);
}

/* The pressure of a power has the shape of the table; its scale from g and c_N at the edge. */
static void power_series(void) {
    unit_table t;
    if (!unit_open(&t, "pressure.csv"))
        return;
    while (unit_row(&t)) {
        const double n = unit_input(&t, 0), k = unit_input(&t, 1);
        const unit_scene s = unit_make_scene(n, k);
        const fret_normal *normal = unit_make_normal(&s);
        const fret_foundation *f = fret_normal_foundation(normal);
        const fret_real scale =
            fret_normal_profile(normal, 1) * n * f->cN0 / FRET_PI * fret_pow(1 / f->c0, f->k);
        fret_real p = 0;
        CHECK_OK(place_pressure(normal, 1, unit_input(&t, 2), &p));
        CHECK_REL(p, scale * unit_result(&t, 3), UNIT_TOL(1e-17L, 1e-13L));
    }
}

/* The definitions by quadrature, whatever the shape: linear in x^(k+1) outside, in (x^2-r^2)^((k+1)/2)
 * inside. */
typedef struct place {
    const fret_normal *normal;
    fret_real a, dz, r, k1;
} place;

static fret_real surface_rate(fret_real t, fret_real rest, void *context) {
    const place *p = context;
    const fret_real l = t < 0.5L ? logl(t) / p->k1 : log1pl(-rest) / p->k1, below = -p->a * expm1l(l),
                    x = l < -1 ? p->a * expl(l) : p->a - below;
    return (p->dz - fret_normal_profile(p->normal, x)) *
           fret_pow((p->r - p->a + below) * (p->r + x), -p->k1 / 2);
}

static fret_real pressure_rate(fret_real t, fret_real rest, void *context) {
    const place *p = context;
    const fret_real x = sqrtl(p->r * p->r + (p->a - p->r) * (p->a + p->r) * fret_pow(t, 2 / p->k1));
    (void)rest;
    return fret_gap_profile(&p->normal->gap, &p->normal->rule, fminl(x, p->a)).slope / x;
}

/* Sums of powers and spheres by their series. */
static void twins(void) {
    static const double grading[] = {-0.95, -0.6, 0, 0.3, 0.8, 0.99};
    unsigned long long seed = 11;
    for (int i = 0; i < 600; i++) {
        const double k = grading[i % 6], a = 1e-4, far = pow(10, unit_random(&seed, -3, 2));
        unit_scene s = unit_make_scene(unit_random(&seed, 0.3, 4), k);
        if (i % 3 == 1)
            s.gap = (fret_gap){.kind = FRET_GAP_EXACT_SPHERE, .R = a / unit_random(&seed, 0.001, 0.6)};
        if (i % 3 == 2) {
            s.gap.kind = FRET_GAP_SUM;
            s.gap.terms = 3;
            for (int j = 0; j < 3; j++)
                s.gap.power[j] =
                    (fret_power){j * 2 + unit_random(&seed, 0.3, 3), unit_random(&seed, 0, 1e-6), a};
        }
        const fret_normal *n = unit_make_normal(&s);
        const fret_foundation *f = fret_normal_foundation(n);
        place p = {n, a, fret_normal_profile(n, a), a * (1 + far), 1 + f->k};
        const fret_real ck = sinl(FRET_PI * (1 - fabsl(f->k)) / 2);
        fret_real got;
        CHECK_OK(place_surface(n, a, p.r, &got));
        CHECK_REL(got,
                  2 * ck / FRET_PI * fret_pow(a, p.k1) / p.k1 * fret_integral(surface_rate, &p, 1e-18L).value,
                  2e-13L);
        if (k < -0.7) /* there the rule is too coarse for the pressure */
            continue;
        p.r = a * unit_random(&seed, 0.3, 1);
        CHECK_OK(place_pressure(n, a, p.r, &got));
        CHECK_REL(got,
                  f->cN0 * fret_pow(f->c0, -f->k) / FRET_PI * fret_pow((p.a - p.r) * (p.a + p.r), p.k1 / 2) /
                      p.k1 * fret_integral(pressure_rate, &p, 1e-18L).value,
                  2e-13L);
    }
}

/* Near k = -1 all of the kernel stands at x = r: p = cN0 c0^-k/pi g'(r)/(2 r m), m = (k+1)/2. And a steep
 * profile just inside the edge, where a radius has no digits left. */
static void near_winkler(void) {
    for (double n = 2; n < 400; n *= 3) {
        const unit_scene s = unit_make_scene(n, -0.99999);
        const fret_pressed c = unit_make_contact(&s, 10);
        const fret_foundation *f = &c.normal->foundation;
        const fret_real m = (f->k + 1) / 2, a = c.press.a;
        for (int i = 0; i < 4; i++) {
            const fret_real r = a * (1 - 0.1L * (i + 0.5L) / (fret_real)n);
            const fret_profile g = fret_gap_profile(&c.normal->gap, &c.normal->rule, r);
            fret_real p = 0;
            CHECK_OK(place_pressure(c.normal, a, r, &p));
            CHECK_REL(p, f->cN0 * fret_pow(f->c0, -f->k) / FRET_PI * g.slope / (2 * r * m), 2e-3L);
        }
        for (int i = 1; i < 40; i++) {
            fret_real p = -1, deeper = 0, r = a;
            for (int j = 0; j < i; j++)
                r = nextafterl(r, 0);
            CHECK_OK(place_pressure(c.normal, a, r, &p));
            CHECK_OK(place_pressure(c.normal, a, r * (1 - 1e-9L), &deeper));
            CHECK(p >= 0 && p <= 1.001L * deeper);
        }
    }
}

/* The tip of a cone that is told by rows: next to k = 0 the pressure there is all but infinite. */
static void tips(void) {
    static const double k[] = {1e-6, 1e-5, 1e-4, 1e-3, 0.1};
    double r[9], f[9];
    struct fret_table *t = NULL;
    for (int i = 0; i < 9; i++) {
        r[i] = 1e-3 * i / 8;
        f[i] = 0.01 * r[i];
    }
    CHECK_OK(fret_table_make(r, f, 9, NULL, &t));
    for (size_t i = 0; i < sizeof k / sizeof *k; i++) {
        unit_scene cone = unit_make_scene(1, k[i]), rows = cone;
        cone.gap.power[0] = (fret_power){1, 0.01, 1};
        rows.gap = (fret_gap){.kind = FRET_GAP_TABLE, .table = t};
        fret_real p = 0, q = 0;
        CHECK_OK(place_pressure(unit_make_normal(&cone), 7e-4L, 0, &p));
        CHECK_OK(place_pressure(unit_make_normal(&rows), 7e-4L, 0, &q));
        CHECK_REL(q, p, UNIT_TOL(1e-13L, 1e-11L));
    }
    fret_table_free(t);
}

/* Where n + k is next to 1 each contact presses almost infinitely at the tip; a core without slope spares the
 * traction there, which is that right next to it. */
static void spared_tip(void) {
    const unit_scene s = unit_make_scene(1, 1e-9);
    fret_contact *c = NULL;
    fret_real at_tip, beside;
    CHECK_OK(fret_contact_make(unit_make_normal(&s), 0.4, FRET_EXACT, &c));
    CHECK_OK(fret_contact_step(c, &(fret_step){FRET_TO_FORCE, FRET_TO_FX, 20, 0}));
    CHECK_OK(fret_contact_step(c, &(fret_step){FRET_TO_FORCE, FRET_TO_FX, 20, 8 * (1 - 1e-9)}));
    CHECK_OK(fret_contact_step(c, &(fret_step){FRET_TO_FORCE, FRET_TO_FX, 20, -1}));
    CHECK_OK(place_traction(c, 0, &at_tip));
    CHECK_OK(place_traction(c, 1e-18L, &beside));
    CHECK_REL(at_tip, beside, 1e-16L);
    fret_contact_free(c);
}

static void pressed_lightly(const fret_normal *normal, double F) {
    const fret_foundation *f = &normal->foundation;
    const fret_real b = fret_gap_start(&normal->gap), k1 = 1 + f->k, mu = 0.3L;
    fret_press at;
    fret_contact *m = NULL;
    CHECK_OK(fret_press_by_force(normal, F, &at));
    CHECK_OK(fret_contact_make(normal, (double)mu, FRET_EXACT, &m));
    CHECK_OK(fret_contact_step(m, &(fret_step){FRET_TO_FORCE, FRET_KEEP_DX, F, 0}));
    CHECK_OK(fret_contact_step(m, &(fret_step){FRET_KEEP_NORMAL, FRET_TO_FX, 0, 0.12 * F}));
    const fret_real wide = (at.a - b) / b + 1e-16L;
    CHECK_REL(at.dz * 2 * f->cN0 * fret_pow(b / f->c0, f->k) * b / k1, F, wide + 1e-16L);
    for (int i = 0; i < 4; i++) {
        static const double part[] = {0, 0.3, 0.8, 0.999};
        const fret_real r = part[i] * b,
                        punch = f->cN0 * fret_pow(f->c0, -f->k) / FRET_PI * at.dz *
                                fret_pow((b - r) * (b + r), (f->k - 1) / 2),
                        away = 5 * wide / (1 - (r / b) * (r / b)) + 2e-14L;
        fret_real p = 0, w = 0, q = 0;
        CHECK_OK(place_of_press(normal, &at, fret_field_pressure, r, &p));
        CHECK_OK(place_of_press(normal, &at, fret_field_surface, r, &w));
        CHECK(p <= punch * (1 + 2e-14L) && p >= punch * (1 - away));
        CHECK_REL(w, at.dz, 1e-15L);
        CHECK_OK(place_traction(m, r, &q));
        CHECK(q > 0 && q <= 0.41L * mu * punch && (wide > 1e-9L || q >= 0.39L * mu * punch));
    }
    const fret_code at_end = is_infinite(normal, b) ? FRET_SINGULAR : FRET_OK;
    fret_segment stuck;
    fret_real p = 0;
    CHECK(
        fret_contact_segment(m, 0, &stuck)); /* beyond which the slip of a ring is finite, if there is one */
    const bool ring = fret_law_distance(normal, stuck.outer) > 0;
    CHECK(place_of_press(normal, &at, fret_field_pressure, b, &p).code == at_end);
    CHECK(place_traction(m, b, &p).code == (ring ? FRET_OK : at_end));
    fret_contact_free(m);
}

/* Next to a flat end a radius hardly tells the contact, or not at all, but its depth does: a flat punch's
 * pressure from below, and at a radius that doubles hold what that radius says. */
static void light(void) {
    static const fret_gap_kind kind[] = {FRET_GAP_FLAT_CONE, FRET_GAP_FLAT_PARABOLOID, FRET_GAP_FLAT_ROUNDED,
                                         FRET_GAP_TABLE};
    static const double k[] = {-0.9, -0.4, 0, 0.5, -0.99, -0.999, -0.9999, -0.999999},
                        row[] = {0, 0x1p-12, 0x1p-11, 0x3p-12, 0x1p-10}, height[] = {0, 0, 0, 1e-6, 4e-6};
    struct fret_table *t = NULL;
    CHECK_OK(fret_table_make(row, height, 5, NULL, &t));
    for (int i = 0; i < 32; i++) {
        if (unit_skips((size_t)(i + i / 8)))
            continue;
        unit_scene s = unit_make_scene(2, k[i % 8]);
        s.gap = (fret_gap){.kind = kind[i / 8], .b = 0x1p-11, .R = 0.01, .slope = 0.05, .table = t};
        const fret_normal *normal = unit_make_normal(&s);
        for (double F = 1; F > 1e-15; F *= 1e-3)
            pressed_lightly(normal, F);
        for (int j = 8; j <= 50; j += 6) {
            const double e = ldexp(1, -11 - j), a = 0x1p-11 + e;
            fret_press at;
            CHECK_OK(fret_press_by_radius(normal, a, &at));
            for (int l = 0; l < 4; l++) {
                static const double part[] = {-0.9, -1, 0.5, 0.96875};
                const fret_real r = 0x1p-11L + (fret_real)part[l] * (l > 0 ? e : 0x1p-11);
                fret_real p = 0, q = 0;
                CHECK_OK(place_pressure(normal, a, r, &q));
                CHECK_OK(place_of_press(normal, &at, fret_field_pressure, r, &p));
                CHECK_REL(p, q, 1e-15L);
            }
        }
    }
    fret_table_free(t);
}

/* int g dkernel over e = x-b within a factor of Euler's number. */
typedef struct by_parts {
    const fret_normal *normal;
    fret_real b, r, e;
} by_parts;

static fret_real part_of(fret_real t, fret_real rest, void *context) {
    (void)t;
    const by_parts *c = context;
    const fret_real k = fret_normal_foundation(c->normal)->k, e = c->e * expl(-rest), x = c->b + e,
                    g = fret_gap_profile(&c->normal->gap, &c->normal->rule, e).g;
    return e * g * (1 - k) * x * fret_pow((c->b - c->r + e) * (x + c->r), (k - 3) / 2);
}

/* Under a flat end the pressure by parts, whose terms are positive and mild: near k = -1 most of it comes
 * from distances of the end that no number holds. */
static void below_flat(void) {
    static const double k[] = {-0.7, -0.95, -0.99, -0.999, -0.9999, -0.999999}, reach[] = {1e-4, 0.1, 1},
                        part[] = {0, 0.3, 0.9, 0.999};
    for (int i = 0; i < 6 * 3 * 3 * 4; i++) {
        unit_scene s = unit_make_scene(2, k[i % 6]);
        s.gap = (fret_gap){.kind = i / 6 % 3 == 0   ? FRET_GAP_FLAT_CONE
                                   : i / 6 % 3 == 1 ? FRET_GAP_FLAT_PARABOLOID
                                                    : FRET_GAP_FLAT_ROUNDED,
                           .b = 5e-4,
                           .R = 0.01,
                           .slope = 0.05};
        const fret_normal *normal = unit_make_normal(&s);
        const fret_foundation *f = &normal->foundation;
        const fret_real b = s.gap.b, r = part[i / 54] * b;
        const double a = s.gap.b * (1 + reach[i / 18 % 3]);
        by_parts c = {normal, b, r, a - b};
        fret_press at;
        fret_real p = 0, sum = 0;
        CHECK_OK(fret_press_by_radius(normal, a, &at));
        for (int j = 0; j < 60; j++, c.e /= expl(1))
            sum += fret_integral(part_of, &c, 1e-18L).value;
        sum += at.dz * fret_pow((a - r) * (a + r), (f->k - 1) / 2);
        CHECK_OK(place_pressure(normal, a, r, &p));
        CHECK_REL(p, f->cN0 * fret_pow(f->c0, -f->k) / FRET_PI * sum, 1e-14L);
    }
}

/* Where cells of the law meet p has no spike, though near k = -1 a last digit of the radius to the power m is
 * much. */
static void joints(void) {
    for (int i = 0; i < 6; i++) {
        unit_scene s = unit_make_scene(2, i / 2 == 0 ? -0.5 : i / 2 == 1 ? -0.75 : -0.95);
        s.gap = (fret_gap){
            .kind = i % 2 ? FRET_GAP_EXACT_SPHERE : FRET_GAP_FLAT_ROUNDED, .b = 9.5934e-4, .R = 1.0637e-3};
        const fret_normal *normal = unit_make_normal(&s);
        const double a = i % 2 ? 0.94 * s.gap.R : 1.9 * s.gap.b;
        int met = 0;
        for (size_t j = 1; j < normal->cells->count && normal->cells->cell[j].x < a; j++, met++) {
            const fret_real x = normal->cells->cell[j].x;
            fret_real p[3];
            for (int side = 0; side < 3; side++)
                CHECK_OK(place_pressure(normal, a, x * (1 + (fret_real)(side - 1) * 1e-15L), &p[side]));
            CHECK_REL(p[0], p[1], 1e-13L);
            CHECK_REL(p[2], p[1], 1e-13L);
        }
        CHECK(met > 0);
    }
}

int main(int argc, char **argv) {
    unit_start("field", argc, argv);
    CASE(reference());
    CASE(sharp());
    CASE(steep());
    CASE(sums());
    CASE(forces());
    CASE(closed());
    CASE(errors());
    CASE(power_series());
    CASE(twins());
    CASE(near_winkler());
    CASE(tips());
    CASE(spared_tip());
    CASE(light());
    CASE(below_flat());
    CASE(joints());
    return unit_finish();
}
