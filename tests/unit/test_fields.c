/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Fields at many places against slow twins: the definitions, integrated from kink to kink, and the quadrature
 * of one place after the other. Random contacts, histories and places, with corners. FRET_FIELDS=N asks N
 * times as much and prints the worst errors. */
#include "contact/density.h"
#include "contact/field.h"
#include "contact/table.h"
#include "fret/field.h"
#include "number/quadrature.h"
#include "number/real.h"
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

/* Of a contact that reaches to the distance a. */
static fret_real pressure_of(const fret_normal *n, fret_real a, fret_real r) {
    const fret_gap *gap = &n->gap;
    const fret_real inner = fmaxl(r - fret_gap_start(gap), 0);
    fret_real sum = 0;
    for (fret_real hi = a, lo; hi > inner; hi = lo) {
        const fret_real kink = fret_gap_kink(gap, hi);
        lo = fmaxl(kink, inner);
        const fret_real beyond = fmaxl(lo - (r - fret_gap_start(gap)), 0);
        const fret_real scale = lo > kink ? lo - kink : beyond > 0 ? beyond : hi - lo;
        const fret_real part = fminl(hi - lo, scale) / 64;
        stretch c = {n, r, 0, lo, beyond, part, 2 / (1 + n->foundation.k)};
        sum += fret_integrate(near_rate, &c);
        for (fret_real way = part; way < hi - lo; way *= 16) {
            c.width = fminl(16 * way, hi - lo);
            c.power = c.width / way;
            sum += fret_integrate(other_rate, &c);
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
        const fret_real lo = hi > start ? start + fret_gap_kink(&n->gap, hi - start) : 0;
        stretch c = {.normal = n, .r = r, .dz = dz, .lo = lo, .width = hi - lo};
        sum += fret_integrate(surface_rate, &c);
        hi = lo;
    }
    return 2 * cosl(FRET_PI * k / 2) / FRET_PI * sum;
}

/* ---- questions --------------------------------------------------------------------------------- */

typedef struct asking {
    shape which;
    const fret_normal *normal;
    fret_fields *fields;
    const fret_memory *memory;
    fret_state now;
} asking;

static fret_real slow_pressure(const asking *q, fret_real a, fret_real r) {
    return a > r ? pressure_of(q->normal, a - fret_gap_start(&q->normal->gap), r) : 0;
}

/* Of the contact y deep, whose radius, rounded, may be that of a flat end, or which may be but a flat punch.
 */
static fret_real pressure_of_depth(const asking *q, fret_real a, fret_real y, fret_real r) {
    if (q->which >= ROUND_TABLE || !fret_field_light(q->normal, a))
        return slow_pressure(q, a, r);
    const fret_foundation *f = &q->normal->foundation;
    const fret_real e = fret_search_radius(q->normal, false, y), b = fret_gap_start(&q->normal->gap);
    if (e > 0)
        return pressure_of(q->normal, e, r);
    return r < b ? f->cN0 * fret_pow(f->c0, -f->k) / FRET_PI * y * fret_pow((b - r) * (b + r), (f->k - 1) / 2)
                 : 0;
}

/* Of a smooth gap the quadrature does. */
static fret_real slow_surface(const asking *q, fret_real a, fret_real dz, fret_real r) {
    fret_real w = 0, f = 0;
    if (r <= a) { /* the depth tells the edge to more digits than the radius of a flat end */
        CHECK_OK(fret_gap_f(&q->normal->gap, r, &f));
        return dz - f;
    }
    if (q->which >= ROUND_TABLE)
        return surface_of(q->normal, a, dz, r);
    CHECK_OK(fret_surface(q->normal, a, r, &w));
    return w;
}

static void ask_inside(const asking *q, fret_real r) {
    const fret_press press = {.F = q->now.FN, .dz = q->now.dz, .a = q->now.a};
    const fret_real scale = pressure_of_depth(q, press.a, press.dz, r), mu = fret_memory_friction(q->memory);
    fret_real got = 0, want = 0, inner = 0;
    fret_segment s;
    CHECK_OK(fret_fields_pressure_of(q->fields, &press, r, &got));
    compare(q->which, PRESSURE, got, scale, scale);
    for (size_t i = 0; fret_memory_segment(q->memory, i, &s); i++) {
        const fret_real a = fret_law_radius(q->normal, s.outer), outer = pressure_of_depth(q, a, s.outer, r);
        want += mu * s.sigma * (outer - inner);
        inner = outer;
    }
    CHECK_OK(fret_fields_traction(q->fields, q->memory, r, &got));
    compare(q->which, TRACTION, got, want, mu * scale);
}

static void ask_anywhere(const asking *q, fret_real r) {
    const fret_real factor = fret_memory_friction(q->memory) * q->normal->foundation.eta, dz = q->now.dz;
    fret_real got = 0, want = 0, inner = 0;
    fret_segment s;
    CHECK_OK(fret_fields_surface(q->fields, q->now.a, r, &got));
    compare(q->which, SURFACE, got, slow_surface(q, q->now.a, dz, r), dz);
    if (q->which < ROUND_TABLE)
        CHECK_OK(fret_surface_x(q->memory, r, &want));
    for (size_t i = 0; q->which >= ROUND_TABLE && fret_memory_segment(q->memory, i, &s); i++) {
        const fret_real outer = slow_surface(q, fret_law_radius(q->normal, s.outer), s.outer, r);
        want += factor * s.sigma * (outer - inner);
        inner = outer;
    }
    CHECK_OK(fret_fields_surface_x(q->fields, q->memory, r, &got));
    compare(q->which, SURFACE_X, got, want, factor * dz);
}

/* Near the centre, the flat end, rows, the edges of slices, the edge of the contact, and anywhere. */
static fret_real place_of(const asking *q, bool inside) {
    const fret_real a = q->now.a, start = fret_gap_start(&q->normal->gap);
    const fret_real off = small(q->which >= ROUND_TABLE ? 2 : 10) * (uniform(0, 1) < 0.5 ? -1 : 1);
    fret_segment s;
    size_t count = 0;
    while (fret_memory_segment(q->memory, count, &s))
        count++;
    (void)fret_memory_segment(q->memory, (size_t)uniform(0, (double)count * 0.999), &s);
    switch ((int)uniform(0, 6)) {
    case 0:
        return a * small(5);
    case 1:
        return start > 0 ? start * (1 + off) : a * uniform(0, 1);
    case 2: /* at a row, or beside one: not where the definitions do not resolve that */
        if (q->which >= ROUND_TABLE && grading_now < -0.5)
            return a * uniform(0, 1);
        return start + fret_gap_kink(&q->normal->gap, a - start) + (uniform(0, 1) < 0.5 ? 0 : a * off / 100);
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
    fret_memory *m = NULL;
    fret_press top;
    asking q = {.which = which};
    grading_now = k;
    if (fret_normal_make(&material, &gap, &normal).code) { /* too rough for this k */
        fret_table_free((struct fret_table *)gap.table);
        return;
    }
    CHECK_OK(fret_memory_make(normal, mu, &m));
    CHECK_OK(fret_fields_make(normal, &q.fields));
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
        CHECK_OK(fret_memory_step(m, &s));
    }
    fret_memory_state(m, &q.now);
    for (int i = 0; i < places; i++) {
        const fret_real r = place_of(&q, true), far = fabsl(place_of(&q, false));
        const bool weak = which >= ROUND_TABLE && fabs(k) > 0.7; /* the definitions are, outside */
        if (r < q.now.a && r > 0 && !(r == start && which <= FLAT_PARABOLOID))
            ask_inside(&q, r);
        if (!weak && q.now.a > start) /* else the radius does not tell the contact */
            ask_anywhere(&q, far);
    }
    CHECK(which >= ROUND_TABLE || fret_fields_error(q.fields) < 2e-15 || fret_field_light(normal, q.now.a));
    fret_fields_free(q.fields);
    fret_memory_free(m);
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
        fret_fields *f = NULL;
        fret_real p = 0;
        s.gap.kind = (fret_gap_kind)atoi(t.cell[0]);
        s.gap.b = unit_input(&t, 1);
        s.gap.R = unit_input(&t, 2);
        s.gap.slope = unit_input(&t, 3);
        CHECK_OK(fret_fields_make(unit_make_normal(&s), &f));
        CHECK_OK(fret_fields_pressure(f, unit_input(&t, 5), unit_input(&t, 6), &p));
        CHECK_REL(p, unit_result(&t, 7), UNIT_TOL(1e-15L, 1e-9L));
        fret_fields_free(f);
    }
}

/* What has a formula, or is infinite, or is nowhere, is answered as for one place; and what was asked before
 * leaves no trace. */
static void alike(void) {
    const fret_material material = {{{210e9, 0.3, false}, {70e9, 0.35, false}}, -0.3, 1e-3};
    const fret_gap power = {.kind = FRET_GAP_POWER, .terms = 1, .power = {{2, 0.005, 0.01}}};
    const fret_gap flat = gap_of(FLAT_CONE);
    const fret_normal *normal = unit_keep_normal(&material, &power);
    fret_fields *f = NULL, *g = NULL;
    fret_memory *m = NULL;
    fret_real one = 0, many = -1;
    CHECK_OK(fret_fields_make(normal, &f));
    CHECK_OK(fret_pressure(normal, 1e-4L, 3e-5L, &one));
    CHECK_OK(fret_fields_pressure(f, 1e-4L, 3e-5L, &many));
    CHECK(one == many && isnan(fret_fields_error(f)));
    fret_fields_free(f);
    normal = unit_keep_normal(&material, &flat);
    CHECK_OK(fret_memory_make(normal, 0.3, &m));
    CHECK_OK(fret_fields_make(normal, &f));
    CHECK_OK(fret_fields_make(normal, &g));
    CHECK_OK(fret_fields_traction(f, m, 1e-4L, &many));
    CHECK(many == 0);
    CHECK_OK(fret_fields_surface_x(f, m, 1e-4L, &many));
    CHECK(many == 0);
    CHECK_ERROR(fret_fields_pressure(f, 1e-3L, -1, &many), FRET_NEGATIVE, "r");
    CHECK_ERROR(fret_fields_surface(f, 1e-3L, -1, &many), FRET_NEGATIVE, "r");
    CHECK_ERROR(fret_fields_pressure(f, 1e-3L, 4e-4, &many), FRET_SINGULAR, "r");
    CHECK_OK(fret_fields_pressure(f, 1e-3L, 1e-3L, &many));
    CHECK(many == 0);
    CHECK_OK(fret_fields_pressure(f, 4e-4L, 1e-4L, &many));
    CHECK(many == 0);
    CHECK_OK(fret_fields_pressure(f, 5e-3L, 1e-4L, &many));
    CHECK_OK(fret_fields_pressure(f, 6e-4L, 1e-4L, &many));
    CHECK_OK(fret_fields_pressure(g, 6e-4L, 1e-4L, &one));
    CHECK(one == many && fret_fields_error(f) == fret_fields_error(g));
    CHECK_OK(fret_memory_step(m, &(fret_step){FRET_TO_FORCE, FRET_KEEP_DX, 100, 0}));
    CHECK_OK(fret_fields_traction(f, m, 2e-3L, &many));
    CHECK(many == 0);
    CHECK_ERROR(fret_fields_traction(f, m, -1, &many), FRET_NEGATIVE, "r");
    CHECK_ERROR(fret_fields_surface_x(f, m, -1, &many), FRET_NEGATIVE, "r");
    fret_fields_free(f);
    fret_fields_free(g);
    fret_fields_free(NULL);
    fret_memory_free(m);
}

/* Between two distances, in fourth roots of that from the lower one, in which kinks are smooth where k is a
 * multiple of 1/2. */
static fret_real rows_between(const fret_normal *n, fret_real r, fret_real dz, fret_real kink, fret_real hi) {
    const fret_real k = n->foundation.k, width = hi - kink;
    fret_real sum = 0;
    for (int i = 0; i < 16; i++) {
        const fret_real s = ((fret_real)(i / 8) + fret_gauss_node[i % 8]) / 2, way = width * s * s * s * s;
        const fret_real x = kink + way, weight = 2 * width * s * s * s * fret_gauss_weight[i % 8];
        const fret_profile p = fret_gap_profile(&n->gap, &n->rule, x);
        sum += weight * (dz > 0 ? fret_pow(x, k) * (dz - p.g) * fret_pow((r - x) * (r + x), -(k + 1) / 2)
                                : p.slope * fret_pow((x - r) * (x + r), (k - 1) / 2));
    }
    return sum;
}

/* The definitions again, with so few points where a row is farther from r than it is wide. */
static fret_real many_pressure(const fret_normal *n, fret_real a, fret_real r) {
    const fret_foundation *f = &n->foundation;
    fret_real sum = 0, hi = a;
    for (fret_real lo; hi > r; hi = lo) {
        lo = fret_gap_kink(&n->gap, hi);
        if (lo - r < 2 * (hi - lo))
            break;
        sum += rows_between(n, r, 0, lo, hi);
    }
    return f->cN0 * fret_pow(f->c0, -f->k) / FRET_PI * sum + (hi > r ? pressure_of(n, hi, r) : 0);
}

static fret_real many_surface(const fret_normal *n, fret_real a, fret_real dz, fret_real r) {
    const fret_real k = n->foundation.k;
    fret_real sum = 0;
    for (fret_real hi = a, lo; hi > 0; hi = lo) {
        lo = fret_gap_kink(&n->gap, hi);
        sum += rows_between(n, r, dz, lo, hi);
    }
    return 2 * cosl(FRET_PI * k / 2) / FRET_PI * sum;
}

/* So many that they are summed in leaves and blocks, at the radii r; off: how rough, relative. */
enum { ROWS = 2600 };
static struct fret_table *rows_of(shape which, double off, double r[ROWS]) {
    static double f[ROWS];
    const double start = which == FLAT_TABLE ? 1e-3 * 20 / (double)ROWS : 0;
    struct fret_table *t = NULL;
    for (int i = 1; i < ROWS; i++) {
        r[i] = 1e-3 * (i + uniform(-0.2, 0.2)) / (double)ROWS;
        const double x = fmax(r[i] - start, 0);
        f[i] = (which == POINTED_TABLE ? 0.01 * x * (1 + x / 1e-3) : x * x / 0.02) * (1 + uniform(-off, off));
    }
    CHECK_OK(fret_table_make(r, f, ROWS, NULL, &t));
    return t;
}

/* Rows in leaves: of all of a history of two slices, whose ends lie within them. */
static void many_rows(double k, double off, fret_real part) {
    const fret_material material = {{{210e9, 0.3, false}, {70e9, 0.35, false}}, k, 1e-3};
    const double mu = 0.3;
    static double r[ROWS];
    struct fret_table *t = rows_of(ROUND_TABLE, off, r);
    fret_fields *fields = NULL;
    fret_normal *normal = NULL;
    fret_memory *m = NULL;
    fret_press top;
    fret_state now;
    fret_segment s;
    CHECK_OK(fret_normal_make(&material, &(fret_gap){.kind = FRET_GAP_TABLE, .table = t}, &normal));
    CHECK_OK(fret_fields_make(normal, &fields));
    CHECK_OK(fret_memory_make(normal, mu, &m));
    CHECK_OK(fret_press_by_radius(normal, 0.93e-3, &top));
    CHECK_OK(fret_memory_step(m, &(fret_step){FRET_TO_FORCE, FRET_KEEP_DX, (double)top.F, 0}));
    CHECK_OK(fret_memory_step(m, &(fret_step){FRET_KEEP_NORMAL, FRET_TO_FX, 0, 0.4 * mu * (double)top.F}));
    fret_memory_state(m, &now);
    const fret_real in = part * now.a, out = now.a * (1 + 0.01L * part),
                    scale = many_pressure(normal, now.a, in);
    fret_real got = 0, q = 0, u = 0, last_p = 0, last_w = 0;
    grading_now = k;
    CHECK_OK(fret_fields_pressure(fields, now.a, in, &got));
    compare(ROUND_TABLE, PRESSURE, got, scale, scale);
    CHECK_OK(fret_fields_surface(fields, now.a, out, &got));
    compare(ROUND_TABLE, SURFACE, got, many_surface(normal, now.a, now.dz, out), now.dz);
    for (size_t i = 0; fret_memory_segment(m, i, &s); i++) {
        const fret_real a = fret_law_radius(normal, s.outer);
        const fret_real p = a > in ? many_pressure(normal, a, in) : 0,
                        w = many_surface(normal, a, s.outer, out);
        q += mu * s.sigma * (p - last_p);
        u += mu * normal->foundation.eta * s.sigma * (w - last_w);
        last_p = p;
        last_w = w;
    }
    CHECK_OK(fret_fields_traction(fields, m, in, &got));
    compare(ROUND_TABLE, TRACTION, got, q, mu * scale);
    CHECK_OK(fret_fields_surface_x(fields, m, out, &got));
    compare(ROUND_TABLE, SURFACE_X, got, u, mu * normal->foundation.eta * now.dz);
    CHECK(fret_fields_error(fields) < 3e-15);
    CHECK_OK(fret_fields_pressure(fields, 1e-7L, 3e-8L, &q)); /* within the first row there is a formula */
    CHECK_OK(fret_pressure(normal, 1e-7L, 3e-8L, &got));
    CHECK(q == got);
    fret_fields_free(fields);
    fret_memory_free(m);
    fret_normal_free(normal);
    fret_table_free(t);
}

/* So many rows that leaves take their kinks in double: polynomials of them against their sums. */
static void leaves_of_many(double k, double off) {
    enum { LEAVES = 12000 };
    static double r[LEAVES], f[LEAVES];
    const fret_material material = {{{210e9, 0.3, false}, {70e9, 0.35, false}}, k, 1e-3};
    struct fret_table *t = NULL;
    struct fret_density *d = NULL;
    fret_fields *fields = NULL;
    fret_normal *n = NULL;
    for (int i = 1; i < LEAVES; i++) {
        r[i] = 1e-3 * (i + uniform(-0.2, 0.2)) / (double)LEAVES;
        f[i] = r[i] * r[i] / 0.02 * (1 + uniform(-off, off));
    }
    CHECK_OK(fret_table_make(r, f, LEAVES, NULL, &t));
    CHECK_OK(fret_normal_make(&material, &(fret_gap){.kind = FRET_GAP_TABLE, .table = t}, &n));
    CHECK_OK(fret_fields_make(n, &fields));
    const fret_cut whole = {0.93e-3L, 1};
    CHECK_OK(fret_density_make(n, whole.a, &d));
    const fret_real size = n->foundation.cN0 * fret_pow(n->foundation.c0, -k) / FRET_PI;
    for (fret_real part = 0.05L; part < 1; part += 0.1L) {
        fret_real p = 0;
        CHECK_OK(fret_fields_pressure(fields, whole.a, part * whole.a, &p));
        CHECK_REL(size * fret_density_pressure(d, &whole, 1, part * whole.a), p, 3e-15L);
    }
    fret_density_free(d);
    fret_fields_free(fields);
    fret_normal_free(n);
    fret_table_free(t);
}

/* At the tip of a sampled cone, whose rows are exact: the traction of slices around a core without a slope is
 * that of the cone. Of few rows and of many; where the core ends within the first row; and where it has a
 * slope. */
static void sampled_tip(double k, size_t rows, double part, bool gripped) {
    static double r[4000], f[4000];
    const fret_material material = {{{210e9, 0.3, false}, {70e9, 0.35, false}}, k, 1e-3};
    const fret_gap cone = {.kind = FRET_GAP_POWER, .terms = 1, .power = {{1, 0x1p-5, 1}}};
    struct fret_table *t = NULL;
    fret_fields *fields = NULL;
    fret_normal *n[2] = {NULL, NULL};
    fret_real q[2] = {0, 0};
    fret_status st[2];
    for (size_t i = 0; i < rows; i++) {
        r[i] = (double)i * 0x1p-22;
        f[i] = r[i] * 0x1p-5;
    }
    CHECK_OK(fret_table_make(r, f, rows, NULL, &t));
    CHECK_OK(fret_normal_make(&material, &cone, &n[0]));
    CHECK_OK(fret_normal_make(&material, &(fret_gap){.kind = FRET_GAP_TABLE, .table = t}, &n[1]));
    CHECK_OK(fret_fields_make(n[1], &fields));
    for (int i = 0; i < 2; i++) {
        fret_memory *m = NULL;
        fret_press press;
        CHECK_OK(fret_press_by_radius(n[0], r[rows - 1] * 0.97, &press));
        CHECK_OK(fret_memory_make(n[i], 0.5, &m));
        if (gripped)
            CHECK_OK(fret_memory_step(m, &(fret_step){FRET_TO_FORCE, FRET_KEEP_DX, (double)press.F / 64, 0}));
        CHECK_OK(fret_memory_step(
            m, &(fret_step){FRET_TO_FORCE, FRET_TO_FX, (double)press.F, 0.5 * part * (double)press.F}));
        st[i] = i ? fret_fields_traction(fields, m, 0, &q[i]) : fret_traction(m, 0, &q[i]);
        fret_memory_free(m);
    }
    CHECK(st[0].code == st[1].code && st[0].code == (gripped ? FRET_OK : FRET_SINGULAR));
    CHECK_REL(q[1], q[0], 1e-14L);
    fret_fields_free(fields);
    fret_normal_free(n[0]);
    fret_normal_free(n[1]);
    fret_table_free(t);
}

/* Of a contact dz deep. */
static fret_real twin_surface(const struct fret_density *twin, const fret_normal *n, fret_real a,
                              fret_real dz, fret_real r) {
    const fret_real from = fret_density_from(twin), depth = fret_density_from_depth(twin),
                    factor = fret_field_surface_factor(n->foundation.k);
    const fret_cut cut = {a, 1};
    fret_real head = 0, f = 0;
    if (r <= a) {
        CHECK_OK(fret_gap_f(&n->gap, r, &f));
        return dz - f;
    }
    if (fret_gap_start(&n->gap) <= 0) {
        CHECK_OK(fret_field_surface(n, from, depth, r, &head));
        head -= factor * depth * fret_density_flat(twin, from, r);
    }
    return factor * (dz * fret_density_flat(twin, a, r) - fret_density_surface(twin, &cut, 1, r)) + head;
}

/* Many rows: what fields are of them one after the other, the pressure as if g' had no end, against
 * polynomials of all of them. Near the centre and the edge, at rows, within the first ones and inside of all
 * slices; outside of them. */
static void ripples(shape which, double k, double off) {
    const fret_material material = {{{210e9, 0.3, false}, {70e9, 0.35, false}}, k, 1e-3};
    static double r[ROWS];
    struct fret_table *t = rows_of(which, off, r);
    struct fret_density *twin = NULL;
    fret_fields *fields = NULL;
    fret_normal *n = NULL;
    fret_memory *m = NULL;
    fret_press top;
    fret_state now;
    fret_segment s[3] = {{0}};
    CHECK_OK(fret_normal_make(&material, &(fret_gap){.kind = FRET_GAP_TABLE, .table = t}, &n));
    CHECK_OK(fret_fields_make(n, &fields));
    CHECK_OK(fret_memory_make(n, 1, &m));
    CHECK_OK(fret_press_by_radius(n, 0.93e-3, &top));
    CHECK_OK(fret_memory_step(m, &(fret_step){FRET_TO_FORCE, FRET_KEEP_DX, (double)top.F, 0}));
    CHECK_OK(fret_memory_step(m, &(fret_step){FRET_KEEP_NORMAL, FRET_TO_FX, 0, 0.6 * (double)top.F}));
    CHECK_OK(fret_memory_step(m, &(fret_step){FRET_KEEP_NORMAL, FRET_TO_FX, 0, -0.1 * (double)top.F}));
    fret_memory_state(m, &now);
    fret_cut cut[4] = {{0}}, whole = {now.a, 1};
    size_t count = 0;
    for (; count < 3 && fret_memory_segment(m, count, &s[count]); count++)
        cut[count] = (fret_cut){fret_law_radius(n, s[count].outer), s[count].sigma};
    CHECK_OK(fret_density_make(n, r[ROWS - 1], &twin));
    const fret_real from = fret_density_from(twin),
                    size = n->foundation.cN0 * fret_pow(n->foundation.c0, -n->foundation.k) / FRET_PI,
                    place[] = {0,
                               r[1] * 1e-4L,
                               r[1] * 0.3L,
                               r[1],
                               r[1] * 1.3L,
                               r[7],
                               r[20],
                               r[20] * 1.001L,
                               r[130] * (1 + 1e-9L),
                               now.a * 0.35L,
                               cut[0].a,
                               cut[1].a * 0.9999L,
                               now.a * 0.999L,
                               now.a * (1 - 1e-6L)};
    fret_real largest = 0;
    grading_now = k;
    for (size_t i = 0; i < sizeof place / sizeof *place; i++) {
        fret_real p = 0, q = 0, inner = 0, last = 0, outer = 0;
        if (i == 0 && which != FLAT_TABLE && !(k > (fret_table_pointed(t) ? 0 : -1))) {
            CHECK_ERROR(fret_fields_pressure(fields, now.a, 0, &p), FRET_SINGULAR, "r");
            CHECK_OK(fret_fields_traction(fields, m, 0, &p)); /* the innermost slice has no slope */
            CHECK_OK(fret_fields_traction(fields, m, 1e-8L * cut[0].a, &q));
            CHECK_OK(fret_fields_pressure(fields, now.a, 1e-8L * cut[0].a, &outer));
            CHECK_ABS(p, q, outer, 1e-14L);
            continue;
        }
        if (place[i] < from && which != FLAT_TABLE)
            CHECK_OK(fret_pressure(n, from, place[i], &inner));
        const fret_real want = inner + size * fret_density_pressure(twin, &whole, 1, place[i]);
        CHECK_OK(fret_fields_pressure(fields, now.a, place[i], &p));
        const fret_real scale = place[i] > now.a * 0.9999L ? largest : want; /* next to the edge */
        largest = fmaxl(largest, want);
        compare(which, PRESSURE, p, want, scale);
        for (size_t j = 0; j < count; j++) {
            outer = 0;
            const fret_cut one = {cut[j].a, 1};
            if (place[i] < cut[j].a)
                outer = inner + size * fret_density_pressure(twin, &one, 1, place[i]);
            q += cut[j].weight * (outer - last);
            last = outer;
        }
        CHECK_OK(fret_fields_traction(fields, m, place[i], &p));
        compare(which, TRACTION, p, q, scale);
    }
    for (int i = 0; i < 2; i++) { /* a contact that ends on a row, and one that takes all of them */
        const fret_cut end = {i ? r[ROWS - 1] : r[ROWS - 100], 1};
        fret_real p = 0, inner = 0;
        if (r[7] < from && which != FLAT_TABLE)
            CHECK_OK(fret_pressure(n, from, r[7], &inner));
        CHECK_OK(fret_fields_pressure(fields, end.a, r[7], &p));
        const fret_real want = inner + size * fret_density_pressure(twin, &end, 1, r[7]);
        compare(which, PRESSURE, p, want, want);
    }
    const fret_real away[] = {
        cut[0].a * 1.001L, cut[1].a * (1 + 1e-9L), now.a * (1 + 1e-12L), now.a * 1.01L, now.a * 2,
        now.a * 1e3L};
    for (size_t i = 0; i < sizeof away / sizeof *away; i++) {
        fret_real w = 0, u = 0, got = 0, last = 0;
        CHECK_OK(fret_fields_surface(fields, now.a, away[i], &got));
        compare(which, SURFACE, got, twin_surface(twin, n, now.a, now.dz, away[i]), now.dz);
        for (size_t j = 0; j < count; j++) {
            w = twin_surface(twin, n, cut[j].a, s[j].outer, away[i]);
            u += n->foundation.eta * cut[j].weight * (w - last);
            last = w;
        }
        CHECK_OK(fret_fields_surface_x(fields, m, away[i], &got));
        compare(which, SURFACE_X, got, u, n->foundation.eta * now.dz);
    }
    CHECK(fret_fields_error(fields) < 3e-15);
    fret_density_free(twin);
    fret_fields_free(fields);
    fret_memory_free(m);
    fret_normal_free(n);
    fret_table_free(t);
}

/* What many rows leave of a flat punch outside: int f (-phi') ds over the contact, phi' as in outside.h,
 * between the rows and, where these are wide, in parts that are the narrower the nearer they are to the edge.
 */
typedef struct rows_outside {
    const fret_normal *normal;
    fret_real a, r, m, width;
} rows_outside;

static fret_real outside_rate_at(const rows_outside *c, fret_real e) {
    const fret_real D = (c->r - c->a) * (c->r + c->a), v = e * (2 * c->a - e);
    fret_real f = 0;
    (void)fret_gap_f(&c->normal->gap, c->a - e, &f);
    return f * (c->a - e) / (v + D) * fret_pow(D / v, 1 - c->m);
}

/* e = width t^(1/m) */
static fret_real outside_edge(fret_real t, fret_real rest, void *context) {
    const rows_outside *c = context;
    const fret_real e = c->width * fret_pow(t, 1 / c->m);
    (void)rest;
    return e > 0 ? e / (c->m * t) * outside_rate_at(c, e) : 0;
}

/* row: the last one at or below a. */
static fret_real rows_surface(const fret_normal *n, const double *row, size_t i, fret_real a, fret_real dz,
                              fret_real r) {
    const fret_real k = n->foundation.k, end = a - fret_gap_start(&n->gap);
    rows_outside c = {n, a, r, (k + 1) / 2, fminl(a > row[i] ? a - row[i] : a - row[i - 1], r - a) / 16};
    fret_real sum = fret_integrate(outside_edge, &c);
    for (fret_real lo = c.width, to; lo < end; lo = to) {
        while (a - row[i] <= lo)
            i--;
        to = fminl(lo * 1.25L, a - row[i]);
        for (int j = 0; j < 8; j++)
            sum +=
                (to - lo) * fret_gauss_weight[j] * outside_rate_at(&c, lo + (to - lo) * fret_gauss_node[j]);
    }
    return fret_field_surface_factor(k) *
           (dz * fret_field_flat(k, (a / r) * (a / r), (r - a) / r * ((r + a) / r)) - sum);
}

/* Rows that crowd towards the end, that are few where the contact ends, and a flat start. */
typedef enum spread { CROWDED, SPARSE, LATE, SPREADS } spread;

static struct fret_table *spread_rows(spread how, double r[ROWS]) {
    static double f[ROWS];
    struct fret_table *t = NULL;
    const int flat = how == LATE ? ROWS - 300 : 0, dense = ROWS - 40;
    for (int i = 1; i < ROWS; i++) {
        const double x = (i + uniform(-0.2, 0.2)) / (double)ROWS;
        r[i] = how == CROWDED ? 1e-3 * (1 - pow(2, -20 * x))
               : how == LATE  ? 1e-3 * x
               : i < dense    ? 1e-5 * x
                              : 1e-5 * pow(100, (i - dense) / 39.0);
    }
    for (int i = 1; i < ROWS; i++)
        f[i] = i > flat ? (r[i] - r[flat]) * (r[i] - r[flat]) / 0.02 : 0;
    CHECK_OK(fret_table_make(r, f, ROWS, NULL, &t));
    return t;
}

/* Past a row by so much of the next one, everywhere outside. */
static void outside_rows(spread how, double k, double past) {
    static const fret_real off[] = {1e-15L, 1e-9L, 3e-4L, 0.2L, 1e3L, 1e6L};
    const fret_material material = {{{210e9, 0.3, false}, {70e9, 0.35, false}}, k, 1e-3};
    static double r[ROWS];
    struct fret_table *t = spread_rows(how, r);
    fret_fields *fields = NULL;
    fret_normal *n = NULL;
    CHECK_OK(fret_normal_make(&material, &(fret_gap){.kind = FRET_GAP_TABLE, .table = t}, &n));
    CHECK_OK(fret_fields_make(n, &fields));
    CHECK(isnan(fret_fields_error(fields)));
    const fret_real a = r[ROWS - 9] + past * ((fret_real)r[ROWS - 8] - r[ROWS - 9]),
                    dz = fret_normal_profile(n, a);
    for (size_t i = 0; i < sizeof off / sizeof *off; i++) {
        const fret_real place = a * (1 + off[i]), want = rows_surface(n, r, ROWS - 9, a, dz, place);
        fret_real got = 0;
        CHECK_OK(fret_fields_surface(fields, a, place, &got));
        CHECK_ABS(got, want, dz, UNIT_TOL(1e-15L, 1e-9L));
        CHECK_REL(got, want, UNIT_TOL(1e-13L, 1e-7L));
    }
    CHECK(fret_fields_error(fields) < 2e-15);
    fret_fields_free(fields);
    fret_normal_free(n);
    fret_table_free(t);
}

/* Of more slices than rows are asked for one after the other. */
static void many_slices(void) {
    const fret_material material = {{{210e9, 0.3, false}, {70e9, 0.35, false}}, 0.3, 1e-3};
    static double r[ROWS];
    struct fret_table *t = rows_of(ROUND_TABLE, 1e-8, r);
    fret_fields *fields = NULL;
    fret_normal *n = NULL;
    fret_memory *m = NULL;
    fret_press top;
    fret_segment s, next;
    CHECK_OK(fret_normal_make(&material, &(fret_gap){.kind = FRET_GAP_TABLE, .table = t}, &n));
    CHECK_OK(fret_fields_make(n, &fields));
    CHECK_OK(fret_memory_make(n, 1, &m));
    CHECK_OK(fret_press_by_radius(n, 0.93e-3, &top));
    CHECK_OK(fret_memory_step(m, &(fret_step){FRET_TO_FORCE, FRET_KEEP_DX, (double)top.F, 0}));
    for (int i = 0; i < 36; i++) {
        const double Fx = (double)top.F * 0.9 * (1 - i / 40.0) * (i % 2 ? -1 : 1);
        CHECK_OK(fret_memory_step(m, &(fret_step){FRET_KEEP_NORMAL, FRET_TO_FX, 0, Fx}));
    }
    fret_real want = 0, got = 0;
    const fret_real place = top.a * 1.1L;
    size_t i = 0;
    for (; fret_memory_segment(m, i, &s); i++) {
        fret_real w = 0;
        CHECK_OK(fret_fields_surface(fields, fret_law_radius(n, s.outer), place, &w));
        next.sigma = 0;
        (void)fret_memory_segment(m, i + 1, &next);
        want += n->foundation.eta * (s.sigma - next.sigma) * w;
    }
    CHECK(i > 32);
    CHECK_OK(fret_fields_surface_x(fields, m, place, &got));
    CHECK_ABS(got, want, n->foundation.eta * top.dz, UNIT_TOL(1e-14L, 1e-8L));
    fret_fields_free(fields);
    fret_memory_free(m);
    fret_normal_free(n);
    fret_table_free(t);
}

/* Of many rows, from the first question on. */
static void many_stop(void) {
    static double r[ROWS], f[ROWS];
    const fret_material material = {{{210e9, 0.3, false}, {70e9, 0.35, false}}, 0.3, 1e-3};
    volatile sig_atomic_t stop = 0;
    struct fret_table *t = NULL;
    fret_normal *n = NULL;
    fret_fields *fields = NULL;
    fret_real p = 0;
    for (int i = 1; i < ROWS; i++) {
        r[i] = 1e-3 * i / (double)ROWS;
        f[i] = r[i] * r[i] / 0.02;
    }
    CHECK_OK(fret_table_make(r, f, ROWS, NULL, &t));
    CHECK_OK(fret_normal_make(&material, &(fret_gap){.kind = FRET_GAP_TABLE, .table = t}, &n));
    fret_normal_stop(n, &stop);
    CHECK_OK(fret_fields_make(n, &fields));
    stop = 1;
    CHECK_CODE(fret_fields_pressure(fields, 9e-4L, 1e-4L, &p), FRET_INTERRUPTED);
    CHECK(isnan(fret_fields_error(fields)));
    stop = 0;
    for (int i = 0; i < 40; i++) { /* of more contacts than are kept */
        fret_real again = 0;
        CHECK_OK(fret_fields_pressure(fields, 9e-4L + 1e-6L * (i % 36), 1e-4L, &again));
        CHECK(i != 36 || again == p);
        p = i == 0 ? again : p;
    }
    CHECK(p > 0 && fret_fields_error(fields) < 2e-15);
    const fret_real bad[] = {1.01e-3L, -1e-4L, (fret_real)NAN, (fret_real)INFINITY};
    const fret_code code[] = {FRET_OUTSIDE, FRET_NEGATIVE, FRET_NOT_FINITE, FRET_NOT_FINITE};
    for (int i = 0; i < 4; i++) { /* no contact of this gap */
        CHECK_ERROR(fret_fields_surface(fields, bad[i], 2e-3L, &p), code[i], "a");
        CHECK_ERROR(fret_surface(n, bad[i], 2e-3L, &p), code[i], "a");
        CHECK_ERROR(fret_fields_pressure(fields, bad[i], 1e-4L, &p), code[i], "a");
        CHECK_ERROR(fret_pressure(n, bad[i], 1e-4L, &p), code[i], "a");
    }
    fret_fields_free(fields);
    fret_normal_free(n);
    fret_table_free(t);
}

/* What only presses has no traction and moves nothing sideways, even where the pressure is infinite; nothing
 * is made to say so. */
static void undisplaced(void) {
    static const fret_real place[] = {0, 1e-4L, 1e-3L};
    const fret_material material = {{{210e9, 0.3, false}, {70e9, 0.35, false}}, 0, 1e-3};
    for (shape which = 0; which < SHAPES; which++) {
        const fret_gap gap = gap_of(which);
        fret_normal *normal = NULL;
        fret_fields *f = NULL;
        fret_memory *m = NULL;
        CHECK_OK(fret_normal_make(&material, &gap, &normal));
        CHECK_OK(fret_memory_make(normal, 0.3, &m));
        CHECK_OK(fret_fields_make(normal, &f));
        CHECK_OK(fret_memory_step(m, &(fret_step){FRET_TO_FORCE, FRET_KEEP_DX, 10, 0}));
        for (int i = 0; i < 3; i++) {
            fret_real q = 1, u = 1, plain[2] = {1, 1};
            CHECK_OK(fret_fields_traction(f, m, place[i], &q));
            CHECK_OK(fret_fields_surface_x(f, m, place[i], &u));
            CHECK_OK(fret_traction(m, place[i], &plain[0]));
            CHECK_OK(fret_surface_x(m, place[i], &plain[1]));
            CHECK(q == 0 && u == 0 && plain[0] == 0 && plain[1] == 0);
        }
        CHECK(isnan(fret_fields_error(f)));
        fret_real out;
        CHECK_CODE(fret_fields_traction(f, m, -1, &out), FRET_NEGATIVE);
        CHECK_CODE(fret_fields_surface_x(f, m, -1, &out), FRET_NEGATIVE);
        fret_fields_free(f);
        fret_memory_free(m);
        fret_normal_free(normal);
        fret_table_free((struct fret_table *)gap.table);
    }
}

static void stops(void) {
    const fret_material material = {{{210e9, 0.3, false}, {70e9, 0.35, false}}, 0.3, 1e-3};
    const fret_gap flat = gap_of(FLAT_ROUNDED);
    volatile sig_atomic_t stop = 0;
    fret_normal *normal = NULL;
    fret_fields *f = NULL;
    fret_memory *m = NULL;
    fret_real out = 0;
    CHECK_OK(fret_normal_make(&material, &flat, &normal));
    fret_normal_stop(normal, &stop);
    CHECK_OK(fret_memory_make(normal, 0.3, &m));
    CHECK_OK(fret_memory_step(m, &(fret_step){FRET_TO_FORCE, FRET_KEEP_DX, 100, 0}));
    CHECK_OK(fret_memory_step(m, &(fret_step){FRET_KEEP_NORMAL, FRET_TO_FX, 0, 10}));
    CHECK_OK(fret_fields_make(normal, &f));
    stop = 1;
    CHECK_CODE(fret_fields_pressure(f, 6e-4L, 1e-4L, &out), FRET_INTERRUPTED);
    CHECK_CODE(fret_fields_surface(f, 6e-4L, 1e-3L, &out), FRET_INTERRUPTED);
    CHECK_CODE(fret_fields_traction(f, m, 1e-4L, &out), FRET_INTERRUPTED);
    CHECK_CODE(fret_fields_surface_x(f, m, 1e-4L, &out), FRET_INTERRUPTED);
    CHECK(isnan(fret_fields_error(f)));
    stop = 0;
    CHECK_OK(fret_fields_traction(f, m, 1e-4L, &out));
    CHECK(out > 0 && fret_fields_error(f) < 2e-15);
    fret_fields_free(f);
    fret_memory_free(m);
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
    CASE(alike());
    for (size_t i = 0; i < 3; i++)
        if (!unit_skips(i + 1))
            CASE(many_rows((double[]){0.5, 0, -0.5}[i], (double[]){0, 2e-6, 1e-7}[i],
                           (fret_real[]){0.97L, 0.4L, 0.02L}[i]));
    CASE(ripples(ROUND_TABLE, 0, 0));
    if (!unit_skips(1)) {
        CASE(ripples(ROUND_TABLE, -0.9, 1e-8));
        CASE(ripples(ROUND_TABLE, 0.9, 1e-7));
        CASE(ripples(ROUND_TABLE, 0.98, 0)); /* without */
        CASE(ripples(POINTED_TABLE, 0.3, 1e-7));
        CASE(ripples(FLAT_TABLE, 1e-7, 0));
        CASE(ripples(FLAT_TABLE, -0.3, 1e-8));
        CASE(leaves_of_many(0.3, 0));
        CASE(leaves_of_many(-0.5, 1e-9));
    }
    CASE(ripples(POINTED_TABLE, -0.04, 1e-8));
    for (int i = 0; i < 3; i++) {
        static const double ks[] = {0, -0.3, -0.9};
        CASE(sampled_tip(ks[i], 100, 0.5, true));
        CASE(sampled_tip(ks[i], 4000, 0.5, true));
        CASE(sampled_tip(ks[i], 40, 0.999999, true));
        CASE(sampled_tip(ks[i], 100, 0.5, false));
        CASE(sampled_tip(ks[i], 4000, 0.5, false));
    }
    for (spread how = 0; how < SPREADS; how++)
        for (size_t i = 0; i < 5; i++)
            if (!unit_skips(i + how))
                CASE(outside_rows(how, (double[]){-0.97, -0.5, 0, 0.3, 0.9}[i],
                                  (double[]){1e-12, 0.5, 0, 1 - 1e-6, 1e-3}[(i + how) % 5]));
    if (!unit_skips(1))
        CASE(many_slices());
    CASE(many_stop());
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
