/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Fields at many places against slow twins: the definitions, integrated from kink to kink, and the quadrature
 * of one place after the other. Random contacts, histories and places, with corners. FRET_FIELDS=N asks N
 * times as much and prints the worst errors. */
#include "law/normal.h"
#include "law/table.h"
#include "number/integral.h"
#include "number/real.h"
#include "places.h"
#include "unit.h"

static unsigned long long seed = 5;
static double uniform(double lo, double hi) {
    return unit_random(&seed, lo, hi);
}

/* 10^-most .. 1 */
static double small(double most) {
    return pow(10, uniform(-most, 0));
}

typedef enum shape {
    FLAT_CONE,
    FLAT_PARABOLOID,
    FLAT_ROUNDED,
    ROUND_TABLE,
    POINTED_TABLE,
    FLAT_TABLE,
    SHAPES
} shape;
typedef enum what { PRESSURE, SURFACE, TRACTION, SURFACE_X, WHATS } what;
static const char *const shape_name[] = {"flat-cone", "flat-paraboloid", "flat-rounded",
                                         "table",     "pointed table",   "flat table"};
static const char *const what_name[] = {"p", "uz", "qx", "ux"};
static fret_real worst[SHAPES][WHATS];
static long asked[SHAPES];
static double grading_now;

static void compare(shape which, what w, fret_real got, fret_real want, fret_real scale) {
    const fret_real error = got == want ? 0 : fabsl(got - want) / scale;
    asked[which]++;
    worst[which][w] = fmaxl(worst[which][w], error);
    if (unit_count(error <= UNIT_TOL(1e-13L, 1e-9L), __FILE__, __LINE__))
        printf("%s, %s, k = %g: %.21Lg, expected %.21Lg, error %.2Le\n", shape_name[which], what_name[w],
               grading_now, got, want, error);
}

/* Rows of uneven width, rough in the last two digits that count. */
static struct fret_table *make_table(shape which, int rows) {
    double r[64], f[64];
    struct fret_table *t = NULL;
    for (int i = 0; i < rows; i++) {
        r[i] = i ? r[i - 1] + 2e-3 / rows * uniform(0.3, 1.7) : 0;
        const double x = which == FLAT_TABLE ? fmax(r[i] - 4e-4, 0) : r[i];
        f[i] = (which == POINTED_TABLE ? 0.01 * x : x * x / 0.02) * uniform(0.999, 1.001);
    }
    CHECK_OK(fret_table_make(r, f, (size_t)rows, NULL, &t));
    return t;
}

/* ---- the definitions, for distances e from the start of the gap --------------------------------- */

typedef struct stretch {
    const fret_normal *normal;
    fret_real r, dz, lo, beyond, width, power; /* beyond: from r to lo */
} stretch;

static fret_real start_of(const stretch *c) {
    return fret_gap_start(&c->normal->gap);
}

/* g' (x^2-r^2)^((k-1)/2) at e = lo + way */
static fret_real pressure_rate(const stretch *c, fret_real way) {
    const fret_real away = c->beyond + way, e = c->lo + way, k = c->normal->foundation.k;
    return e > 0 && away > 0 ? fret_gap_profile(&c->normal->gap, &c->normal->rule, e).slope *
                                   fret_pow(away * (start_of(c) + e + c->r), (k - 1) / 2)
                             : 0;
}

/* The near part: e = lo + width t^power. */
static fret_real near_rate(fret_real t, fret_real rest, void *context) {
    const stretch *c = context;
    const fret_real way = c->width * fret_pow(t, c->power);
    (void)rest;
    return c->power * way / t * pressure_rate(c, way);
}

/* Farther: e = lo + width power^(t-1). */
static fret_real other_rate(fret_real t, fret_real rest, void *context) {
    const stretch *c = context;
    const fret_real span = logl(c->power), way = c->width * expl(-span * rest);
    (void)t;
    return span * way * pressure_rate(c, way);
}

/* Distance from the start of the last place below e > 0 where the profile is not smooth: the start itself or
 * a row of a table. */
static fret_real kink_below(const fret_gap *gap, fret_real e) {
    if (!fret_gap_sampled(gap))
        return 0;
    size_t row = fret_table_row(gap->table, e);
    while (row > 0 && fret_table_distance(gap->table, row) >= e)
        row--;
    return fmaxl(fret_table_distance(gap->table, row), 0);
}

/* Of a contact that reaches to the distance a. */
static fret_real pressure_of(const fret_normal *n, fret_real a, fret_real r) {
    const fret_gap *gap = &n->gap;
    const fret_real inner = fmaxl(r - fret_gap_start(gap), 0);
    fret_real sum = 0;
    for (fret_real hi = a, lo; hi > inner; hi = lo) {
        const fret_real kink = kink_below(gap, hi);
        lo = fmaxl(kink, inner);
        const fret_real beyond = fmaxl(lo - (r - fret_gap_start(gap)), 0);
        const fret_real scale = lo > kink ? lo - kink : beyond > 0 ? beyond : hi - lo;
        const fret_real part = fminl(hi - lo, scale) / 64;
        stretch c = {n, r, 0, lo, beyond, part, 2 / (1 + n->foundation.k)};
        sum += fret_integral(near_rate, &c, 1e-18L).value;
        for (fret_real way = part; way < hi - lo; way *= 16) {
            c.width = fminl(16 * way, hi - lo);
            c.power = c.width / way;
            sum += fret_integral(other_rate, &c, 1e-18L).value;
        }
    }
    return n->foundation.cN0 * fret_pow(n->foundation.c0, -n->foundation.k) / FRET_PI * sum;
}

/* x^k (dz-g) (r^2-x^2)^-((k+1)/2), x = lo + width t from the centre on. */
static fret_real surface_rate(fret_real t, fret_real rest, void *context) {
    const stretch *c = context;
    const fret_real x = c->lo + c->width * t, e = (c->lo - start_of(c)) + c->width * t;
    const fret_real away = (c->r - (c->lo + c->width)) + c->width * rest, k = c->normal->foundation.k;
    const fret_real g = e > 0 ? fret_gap_profile(&c->normal->gap, &c->normal->rule, e).g : 0;
    return x > 0 ? c->width * fret_pow(x, k) * (c->dz - g) * fret_pow(away * (c->r + x), -(k + 1) / 2) : 0;
}

static fret_real surface_of(const fret_normal *n, fret_real a, fret_real dz, fret_real r) {
    const fret_real start = fret_gap_start(&n->gap), k = n->foundation.k;
    fret_real sum = 0;
    for (fret_real hi = a; hi > 0;) {
        const fret_real lo = hi > start ? start + kink_below(&n->gap, hi - start) : 0;
        stretch c = {.normal = n, .r = r, .dz = dz, .lo = lo, .width = hi - lo};
        sum += fret_integral(surface_rate, &c, 1e-18L).value;
        hi = lo;
    }
    return 2 * cosl(FRET_PI * k / 2) / FRET_PI * sum;
}

/* The same of a smooth gap with a flat end, linear in x^(k+1) from lo to hi. */
typedef struct smooth {
    const fret_normal *normal;
    fret_real r, dz, lo, hi, span; /* span: 1-(lo/hi)^(k+1) */
} smooth;

static fret_real smooth_rate(fret_real t, fret_real rest, void *context) {
    const smooth *c = context;
    const fret_real k1 = 1 + c->normal->foundation.k, l = log1pl(-c->span * rest) / k1,
                    below = -c->hi * expm1l(l), x = l < -1 ? c->hi * expl(l) : c->hi - below;
    const fret_real g =
        c->lo > 0 && x > c->lo ? fret_gap_profile(&c->normal->gap, &c->normal->rule, x - c->lo).g : 0;
    (void)t;
    return (c->dz - g) * fret_pow((c->r - c->hi + below) * (c->r + x), -k1 / 2);
}

static fret_real smooth_part(const fret_normal *n, fret_real dz, fret_real r, fret_real lo, fret_real hi) {
    const fret_real k1 = 1 + n->foundation.k, span = lo > 0 ? -expm1l(k1 * logl(lo / hi)) : 1;
    smooth c = {n, r, dz, lo, hi, span};
    return fret_pow(hi, k1) * span / k1 * fret_integral(smooth_rate, &c, 1e-18L).value;
}

static fret_real smooth_surface(const fret_normal *n, fret_real a, fret_real dz, fret_real r) {
    const fret_real start = fret_gap_start(&n->gap), ck = sinl(FRET_PI * (1 - fabsl(n->foundation.k)) / 2);
    return 2 * ck / FRET_PI * (smooth_part(n, dz, r, 0, start) + smooth_part(n, dz, r, start, a));
}

/* ---- questions --------------------------------------------------------------------------------- */

typedef struct asking {
    shape which;
    const fret_normal *normal;
    const fret_field *field;
    const fret_contact *memory;
    fret_state now;
} asking;

/* Does a contact end so near to a flat end that its depth tells its edge better? */
static bool is_light(const fret_normal *n, fret_real a) {
    const fret_real start = fret_gap_start(&n->gap);
    return a - start < 0x1p-14L * start;
}

static fret_real slow_pressure(const asking *q, fret_real a, fret_real r) {
    return a > r ? pressure_of(q->normal, a - fret_gap_start(&q->normal->gap), r) : 0;
}

/* Of the contact y deep, whose radius, rounded, may be that of a flat end, or which may be but a flat punch.
 */
static fret_real pressure_of_depth(const asking *q, fret_real a, fret_real y, fret_real r) {
    if (q->which >= ROUND_TABLE || !is_light(q->normal, a))
        return slow_pressure(q, a, r);
    const fret_foundation *f = &q->normal->foundation;
    const fret_real e = fret_law_distance(q->normal, y), b = fret_gap_start(&q->normal->gap);
    if (e > 0)
        return pressure_of(q->normal, e, r);
    return r < b ? f->cN0 * fret_pow(f->c0, -f->k) / FRET_PI * y * fret_pow((b - r) * (b + r), (f->k - 1) / 2)
                 : 0;
}

static fret_real slow_surface(const asking *q, fret_real a, fret_real dz, fret_real r) {
    fret_real f = 0;
    if (r <= a) { /* the depth tells the edge to more digits than the radius of a flat end */
        CHECK_OK(fret_gap_f(&q->normal->gap, r, &f));
        return dz - f;
    }
    return q->which >= ROUND_TABLE ? surface_of(q->normal, a, dz, r) : smooth_surface(q->normal, a, dz, r);
}

static void ask_inside(const asking *q, fret_real r) {
    const fret_real edge = fret_law_radius(q->normal, q->now.dz), mu = fret_contact_friction(q->memory),
                    scale = pressure_of_depth(q, edge, q->now.dz, r);
    fret_real got = 0, want = 0, inner = 0;
    fret_segment s;
    CHECK_OK(fret_field_pressure(q->field, r, &got));
    compare(q->which, PRESSURE, got, scale, scale);
    for (size_t i = 0; fret_contact_segment(q->memory, i, &s); i++) {
        const fret_real a = fret_law_radius(q->normal, s.outer), outer = pressure_of_depth(q, a, s.outer, r);
        want += mu * s.sigma * (outer - inner);
        inner = outer;
    }
    CHECK_OK(fret_field_traction(q->field, r, &got));
    compare(q->which, TRACTION, got, want, mu * scale);
}

static void ask_anywhere(const asking *q, fret_real r) {
    const fret_real factor = fret_contact_friction(q->memory) * q->normal->foundation.eta, dz = q->now.dz;
    fret_real got = 0, want = 0, inner = 0;
    fret_segment s;
    CHECK_OK(fret_field_surface(q->field, r, &got));
    compare(q->which, SURFACE, got, slow_surface(q, fret_law_radius(q->normal, dz), dz, r), dz);
    for (size_t i = 0; fret_contact_segment(q->memory, i, &s); i++) {
        const fret_real outer = slow_surface(q, fret_law_radius(q->normal, s.outer), s.outer, r);
        want += factor * s.sigma * (outer - inner);
        inner = outer;
    }
    CHECK_OK(fret_field_surface_x(q->field, r, &got));
    compare(q->which, SURFACE_X, got, want, factor * dz);
}

/* Near the centre, the flat end, rows, the edges of slices, the edge of the contact, and anywhere. */
static fret_real place_of(const asking *q, bool inside) {
    const fret_real a = q->now.a, start = fret_gap_start(&q->normal->gap);
    const fret_real off = small(q->which >= ROUND_TABLE ? 2 : 10) * (uniform(0, 1) < 0.5 ? -1 : 1);
    fret_segment s;
    size_t count = 0;
    while (fret_contact_segment(q->memory, count, &s))
        count++;
    (void)fret_contact_segment(q->memory, (size_t)uniform(0, (double)count * 0.999), &s);
    switch ((int)uniform(0, 6)) {
    case 0:
        return a * small(5);
    case 1:
        return start > 0 ? start * (1 + off) : a * uniform(0, 1);
    case 2: /* at a row, or beside one: not where the definitions do not resolve that */
        if (q->which >= ROUND_TABLE && grading_now < -0.5)
            return a * uniform(0, 1);
        return start + kink_below(&q->normal->gap, a - start) + (uniform(0, 1) < 0.5 ? 0 : a * off / 100);
    case 3:
        return fret_law_radius(q->normal, s.outer) * (1 + off);
    case 4:
        return inside ? a * (1 - fabsl(off) / 2) : a * (1 + fabsl(off));
    default:
        return inside ? a * uniform(0, 1) : a / small(3);
    }
}

static fret_gap gap_of(shape which) {
    static const fret_gap_kind kinds[] = {FRET_GAP_FLAT_CONE, FRET_GAP_FLAT_PARABOLOID,
                                          FRET_GAP_FLAT_ROUNDED};
    fret_gap gap = {.kind = FRET_GAP_TABLE, .b = 4e-4, .R = 0.01, .slope = 0.01};
    if (which < ROUND_TABLE)
        gap.kind = kinds[which];
    else
        gap.table = make_table(which, (int)uniform(5, 12));
    return gap;
}

static void history(shape which, double k, int places) {
    const fret_material material = {{{210e9, 0.3, false}, {70e9, 0.35, false}}, k, 1e-3};
    const fret_gap gap = gap_of(which);
    const double mu = 0.3;
    fret_normal *normal = NULL;
    fret_contact *m = NULL;
    fret_press top;
    asking q = {.which = which};
    grading_now = k;
    if (fret_normal_make(&material, &gap, NULL, NULL, &normal).code) { /* too rough for this k */
        fret_table_free((struct fret_table *)gap.table);
        return;
    }
    CHECK_OK(fret_contact_make(normal, mu, FRET_EXACT, &m));
    q.normal = normal;
    q.memory = m;
    const fret_real end = fminl(fret_normal_end(normal), 1.8e-3L), start = fret_gap_start(&gap);
    CHECK_OK(fret_press_by_radius(normal, (double)(start + (end - start) * uniform(0.02, 0.95)), &top));
    const int steps = 1 + (int)uniform(0, 5);
    for (int i = 0; i <= steps; i++) {
        const double FN = (double)top.F * (i ? uniform(0.3, 1) : 1);
        const double part = uniform(0, 1) < 0.3 ? 1 - small(9) : uniform(0, 1);
        const fret_step s = {FRET_TO_FORCE, FRET_TO_FX, FN,
                             i ? mu * FN * part * (uniform(0, 1) < 0.5 ? -1 : 1) : 0};
        CHECK_OK(fret_contact_step(m, &s));
    }
    fret_contact_state(m, &q.now);
    fret_field *field = NULL;
    CHECK_OK(fret_field_make(m, &field));
    q.field = field;
    for (int i = 0; i < places; i++) {
        const fret_real r = place_of(&q, true), far = fabsl(place_of(&q, false));
        const bool weak = which >= ROUND_TABLE && fabs(k) > 0.7; /* the definitions are, outside */
        if (r < q.now.a && r > 0 && !(r == start && which <= FLAT_PARABOLOID))
            ask_inside(&q, r);
        if (!weak && q.now.a > start) /* else the radius does not tell the contact */
            ask_anywhere(&q, far);
    }
    CHECK(which >= ROUND_TABLE || fret_field_error(field) < 2e-15);
    fret_field_free(field);
    fret_contact_free(m);
    fret_normal_free(normal);
    fret_table_free((struct fret_table *)gap.table);
}

/* Next to a flat end, against the reference. */
static void rim(void) {
    unit_table t;
    if (!unit_open(&t, "rim.csv"))
        return;
    while (unit_row(&t)) {
        unit_scene s = unit_make_scene(2, unit_input(&t, 4));
        fret_real p = 0;
        s.gap.kind = (fret_gap_kind)atoi(t.cell[0]);
        s.gap.b = unit_input(&t, 1);
        s.gap.R = unit_input(&t, 2);
        s.gap.slope = unit_input(&t, 3);
        CHECK_OK(place_pressure(unit_make_normal(&s), unit_input(&t, 5), unit_input(&t, 6), &p));
        CHECK_REL(p, unit_result(&t, 7), UNIT_TOL(1e-15L, 1e-9L));
    }
}

/* What is infinite, or nowhere, or no radius; and a field is of the state in which it was made. */
static void places(void) {
    const fret_material material = {{{210e9, 0.3, false}, {70e9, 0.35, false}}, -0.3, 1e-3};
    const fret_gap flat = gap_of(FLAT_CONE),
                   power = {.kind = FRET_GAP_POWER, .terms = 1, .power = {{2, 0.005, 0.01}}};
    const fret_normal *normal = unit_keep_normal(&material, &flat),
                      *ball = unit_keep_normal(&material, &power);
    const fret_step press = {FRET_TO_FORCE, FRET_KEEP_DX, 100, 0},
                    push = {FRET_KEEP_NORMAL, FRET_TO_FX, 0, 10};
    fret_field *f = NULL;
    fret_contact *m = NULL;
    fret_real q = -1, again = -1, out = -1;
    CHECK_OK(fret_contact_make(normal, 0.3, FRET_EXACT, &m));
    CHECK_OK(fret_field_make(m, &f));
    CHECK_OK(fret_field_traction(f, 1e-4L, &out));
    CHECK(out == 0);
    CHECK_OK(fret_field_surface(f, 1e-4L, &out));
    CHECK(out == 0 && isnan(fret_field_error(f)));
    fret_field_free(f);
    CHECK_OK(fret_contact_step(m, &press));
    CHECK_OK(fret_contact_step(m, &push));
    CHECK_OK(fret_field_make(m, &f));
    CHECK_OK(fret_field_traction(f, 1e-4L, &q));
    CHECK_OK(fret_contact_step(m, &press));
    CHECK_OK(fret_contact_step(m, &(fret_step){FRET_TO_FORCE, FRET_TO_FX, 70, -5}));
    CHECK_OK(fret_field_traction(f, 1e-4L, &again));
    CHECK(q > 0 && q == again);
    CHECK_ERROR(fret_field_pressure(f, -1, &out), FRET_NEGATIVE, "r");
    CHECK_ERROR(fret_field_surface(f, -1, &out), FRET_NEGATIVE, "r");
    CHECK_ERROR(fret_field_traction(f, -1, &out), FRET_NEGATIVE, "r");
    CHECK_ERROR(fret_field_surface_x(f, (fret_real)NAN, &out), FRET_NOT_FINITE, "r");
    CHECK_ERROR(fret_field_pressure(f, 4e-4, &out), FRET_SINGULAR, "r");
    CHECK_OK(fret_field_pressure(f, 2e-3L, &out));
    CHECK(out == 0);
    CHECK_OK(fret_field_traction(f, 2e-3L, &out));
    CHECK(out == 0);
    fret_field_free(f);
    fret_field_free(NULL);
    CHECK_ERROR(fret_field_of_press(normal, &(fret_press){.dz = -1}, &f), FRET_NEGATIVE, "dz");
    CHECK_ERROR(fret_field_of_press(normal, &(fret_press){.dz = (fret_real)NAN}, &f), FRET_NOT_FINITE, "dz");
    CHECK_OK(fret_field_of_press(ball, &(fret_press){.a = 1e-4L, .dz = 1e-6L}, &f));
    CHECK(isnan(fret_field_error(f)));
    CHECK_OK(fret_field_traction(f, 1e-5L, &out));
    CHECK(out == 0);
    fret_field_free(f);
    const fret_gap blunt = {.kind = FRET_GAP_POWER, .terms = 1, .power = {{0.05, 1e-5, 1e-3}}};
    CHECK_OK(fret_field_of_press(unit_keep_normal(&material, &blunt), &(fret_press){.dz = 1e-300L}, &f));
    CHECK_OK(fret_field_surface(f, 1e-5L, &out)); /* no number holds its radius */
    CHECK(out == 0);
    fret_field_free(f);
    fret_contact_free(m);
}

/* At the tip of a sampled cone, whose rows are exact: the traction of slices around a core without a slope is
 * that of the cone. Of few rows and of many; where the core ends within the first row; and where it has a
 * slope. */
static void sampled_tip(double k, size_t rows, double part, bool gripped) {
    static double r[4000], f[4000];
    const fret_material material = {{{210e9, 0.3, false}, {70e9, 0.35, false}}, k, 1e-3};
    const fret_gap cone = {.kind = FRET_GAP_POWER, .terms = 1, .power = {{1, 0x1p-5, 1}}};
    struct fret_table *t = NULL;
    fret_normal *n[2] = {NULL, NULL};
    fret_real q[2] = {0, 0};
    fret_status st[2];
    for (size_t i = 0; i < rows; i++) {
        r[i] = (double)i * 0x1p-22;
        f[i] = r[i] * 0x1p-5;
    }
    CHECK_OK(fret_table_make(r, f, rows, NULL, &t));
    CHECK_OK(fret_normal_make(&material, &cone, NULL, NULL, &n[0]));
    CHECK_OK(fret_normal_make(&material, &(fret_gap){.kind = FRET_GAP_TABLE, .table = t}, NULL, NULL, &n[1]));
    for (int i = 0; i < 2; i++) {
        fret_contact *m = NULL;
        fret_press press;
        CHECK_OK(fret_press_by_radius(n[0], r[rows - 1] * 0.97, &press));
        CHECK_OK(fret_contact_make(n[i], 0.5, FRET_EXACT, &m));
        if (gripped)
            CHECK_OK(
                fret_contact_step(m, &(fret_step){FRET_TO_FORCE, FRET_KEEP_DX, (double)press.F / 64, 0}));
        CHECK_OK(fret_contact_step(
            m, &(fret_step){FRET_TO_FORCE, FRET_TO_FX, (double)press.F, 0.5 * part * (double)press.F}));
        st[i] = place_traction(m, 0, &q[i]);
        fret_contact_free(m);
    }
    CHECK(st[0].code == st[1].code && st[0].code == (gripped ? FRET_OK : FRET_SINGULAR));
    CHECK_REL(q[1], q[0], 1e-14L);
    fret_normal_free(n[0]);
    fret_normal_free(n[1]);
    fret_table_free(t);
}

/* What only presses has no traction and moves nothing sideways, even where the pressure is infinite. */
static void undisplaced(void) {
    static const fret_real at[] = {0, 1e-4L, 1e-3L};
    const fret_material material = {{{210e9, 0.3, false}, {70e9, 0.35, false}}, 0, 1e-3};
    for (shape which = 0; which < SHAPES; which++) {
        const fret_gap gap = gap_of(which);
        fret_normal *normal = NULL;
        fret_field *f = NULL;
        fret_contact *m = NULL;
        CHECK_OK(fret_normal_make(&material, &gap, NULL, NULL, &normal));
        CHECK_OK(fret_contact_make(normal, 0.3, FRET_EXACT, &m));
        CHECK_OK(fret_contact_step(m, &(fret_step){FRET_TO_FORCE, FRET_KEEP_DX, 10, 0}));
        CHECK_OK(fret_field_make(m, &f));
        for (int i = 0; i < 3; i++) {
            fret_real q = 1, u = 1;
            CHECK_OK(fret_field_traction(f, at[i], &q));
            CHECK_OK(fret_field_surface_x(f, at[i], &u));
            CHECK(q == 0 && u == 0);
        }
        fret_field_free(f);
        fret_contact_free(m);
        fret_normal_free(normal);
        fret_table_free((struct fret_table *)gap.table);
    }
}

static void stops(void) {
    const fret_material material = {{{210e9, 0.3, false}, {70e9, 0.35, false}}, 0.3, 1e-3};
    const fret_gap flat = gap_of(FLAT_ROUNDED);
    volatile sig_atomic_t stop = 0;
    fret_normal *normal = NULL;
    fret_field *f = NULL, *whole = NULL;
    fret_contact *m = NULL;
    fret_real out = 0;
    CHECK_OK(fret_normal_make(&material, &flat, NULL, NULL, &normal));
    fret_normal_stop(normal, &stop);
    CHECK_OK(fret_contact_make(normal, 0.3, FRET_EXACT, &m));
    CHECK_OK(fret_contact_step(m, &(fret_step){FRET_TO_FORCE, FRET_KEEP_DX, 100, 0}));
    CHECK_OK(fret_contact_step(m, &(fret_step){FRET_KEEP_NORMAL, FRET_TO_FX, 0, 10}));
    CHECK_OK(fret_field_make(m, &whole));
    stop = 1;
    CHECK_CODE(fret_field_make(m, &f), FRET_INTERRUPTED);
    CHECK(f == NULL);
    CHECK_CODE(fret_field_pressure(whole, 1e-4L, &out), FRET_INTERRUPTED);
    CHECK_CODE(fret_field_surface(whole, 1e-3L, &out), FRET_INTERRUPTED);
    CHECK_CODE(fret_field_traction(whole, 1e-4L, &out), FRET_INTERRUPTED);
    CHECK_CODE(fret_field_surface_x(whole, 1e-4L, &out), FRET_INTERRUPTED);
    stop = 0;
    CHECK_OK(fret_field_traction(whole, 1e-4L, &out));
    CHECK(out > 0 && fret_field_error(whole) < 2e-15);
    fret_field_free(whole);
    fret_contact_free(m);
    fret_normal_free(normal);
}

int main(int argc, char **argv) {
    static const double grading[] = {-0.99, -0.7, -0.3, 0, 0.3, 0.7, 0.99};
    unit_start("fields", argc, argv);
    const char *many = getenv("FRET_FIELDS");
    const int times = many ? atoi(many) : 1;
    for (int i = 0; i < times; i++)
        for (shape which = 0; which < SHAPES; which++)
            for (size_t j = 0; j < sizeof grading / sizeof *grading; j++)
                if (!unit_skips(j + (size_t)which))
                    CASE(history(which, grading[j], which >= ROUND_TABLE ? 2 : 10));
    CASE(rim());
    CASE(places());
    for (int i = 0; i < 3; i++) {
        static const double ks[] = {0, -0.3, -0.9};
        CASE(sampled_tip(ks[i], 100, 0.5, true));
        CASE(sampled_tip(ks[i], 4000, 0.5, true));
        CASE(sampled_tip(ks[i], 40, 0.999999, true));
        CASE(sampled_tip(ks[i], 100, 0.5, false));
        CASE(sampled_tip(ks[i], 4000, 0.5, false));
    }
    CASE(undisplaced());
    CASE(stops());
    if (many) {
        for (shape which = 0; which < SHAPES; which++) {
            printf("%-16s", shape_name[which]);
            for (what w = 0; w < WHATS; w++)
                printf("%4s %8.1Le", what_name[w], worst[which][w]);
            printf("%10ld\n", asked[which]);
        }
    }
    return unit_finish();
}
