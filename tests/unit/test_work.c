/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Slip, and the work of friction at a place: its integral is the energy dissipated, and it is what traction
 * and slip of the states on the way tell. */
#include "fret/cycle.h"
#include "fret/work.h"
#include "histories.h"
#include "law/normal.h"
#include "number/integral.h"
#include "unit.h"

static unsigned long long state = 36;

static const fret_gap shapes[] = {
    {.kind = FRET_GAP_POWER, .terms = 1, .power = {{2, 0.005, 0.01}}},
    {.kind = FRET_GAP_POWER, .terms = 1, .power = {{1, 0.01, 1}}},
    {.kind = FRET_GAP_POWER, .terms = 1, .power = {{3.5, 1e-6, 2e-4}}},
    {.kind = FRET_GAP_POWER, .terms = 1, .power = {{40, 1e-6, 2e-4}}},
    {.kind = FRET_GAP_FLAT_ROUNDED, .b = 1e-4, .R = 0.01},
    {.kind = FRET_GAP_EXACT_SPHERE, .R = 0.01},
    {.kind = FRET_GAP_FLAT_CONE, .b = 1e-4, .slope = 0.01},
    {.kind = FRET_GAP_SUM, .terms = 2, .power = {{2, 5e-6, 1e-3}, {4, 1e-6, 5e-4}}},
};
enum { SHAPES = sizeof shapes / sizeof *shapes };

static const fret_normal *normal_of(int shape, double k) {
    const fret_material material = {{{210e9, 0.3, false}, {70e9, 0.33, false}}, k, 1e-3};
    return unit_keep_normal(&material, &shapes[shape]);
}

/* ---- integrals --------------------------------------------------------------------------------- */

typedef struct part {
    const fret_work *work;
    fret_real lo, hi;
} part;

static fret_real rate(fret_real t, fret_real rest, void *context) {
    const part *p = context;
    const fret_real r = p->lo * rest + p->hi * t;
    fret_real w = -1;
    if (!(r > p->lo && r < p->hi))
        return 0;
    CHECK_OK(fret_work_at(p->work, r, &w));
    CHECK(w >= 0);
    return 2 * FRET_PI * r * w * (p->hi - p->lo);
}

static int by_size(const void *a, const void *b) {
    const fret_real x = *(const fret_real *)a, y = *(const fret_real *)b;
    return (x > y) - (x < y);
}

static fret_real whole_work(const fret_normal *n, double mu, const fret_slips *s, size_t first) {
    enum { MOST = 400 };
    fret_real node[MOST], sum = 0;
    fret_work *work = NULL;
    CHECK_OK(fret_work_make(n, mu, s, first, fret_slips_count(s), &work));
    int count = 0;
    for (size_t i = 0, ends = 1; ends && count + FRET_WORK_ENDS + 2 < MOST; i++)
        count += (int)(ends = fret_work_edges(work, i, node + count));
    node[count++] = 0;
    node[count++] = fret_gap_start(&n->gap);
    qsort(node, (size_t)count, sizeof *node, by_size);
    for (int i = 1; i < count; i++) {
        part p = {work, node[i - 1], node[i]};
        if (p.hi - p.lo > 1e-14L * node[count - 1])
            sum += fret_integral_ends(rate, &p, 1e-11L);
    }
    fret_work_free(work);
    return sum;
}

/* ---- random scenes ----------------------------------------------------------------------------- */

static fret_step random_step(double mu, double *FN, const fret_state *now, fret_real most) {
    const double next = unit_random(&state, 20, 80), push = unit_random(&state, -0.95, 0.95);
    const int kind = (int)unit_random(&state, 0, 5);
    const bool moves = unit_random(&state, 0, 1) < 0.6;
    if (moves && kind != 3)
        *FN = next;
    if (kind == 3)
        return (fret_step){FRET_TO_DEPTH, FRET_TO_DX, (double)now->dz * unit_random(&state, 0.6, 1.1),
                           (double)most * unit_random(&state, -1.3, 1.3)};
    return kind == 4
               ? (fret_step){FRET_TO_FORCE, FRET_TO_DX, *FN, (double)most * unit_random(&state, -1.5, 1.5)}
               : (fret_step){FRET_TO_FORCE, FRET_TO_FX, *FN, mu * *FN * push};
}

static void random_scene(int i) {
    static const double ks[] = {0, -0.5, 0.4, 0.8, -0.2};
    const double mu = 0.4, k = ks[i % 5];
    const fret_normal *n = normal_of(i % SHAPES, k);
    fret_contact *c = NULL;
    fret_slips *s = NULL;
    fret_state now;
    double FN = 50;
    CHECK_OK(fret_contact_make(n, mu, FRET_EXACT, &c));
    CHECK_OK(fret_slips_make(&s));
    CHECK_OK(fret_contact_watch(c, s));
    CHECK_OK(fret_contact_step(c, &(fret_step){FRET_TO_FORCE, FRET_TO_FX, FN, 0}));
    fret_contact_state(c, &now);
    const fret_real most = mu * n->foundation.eta * now.dz;
    const int steps = 1 + i % 6;
    for (int j = 0; j < steps; j++) {
        const fret_step step = random_step(mu, &FN, &now, most);
        const fret_status st = fret_contact_step(c, &step);
        CHECK(st.code == FRET_OK || st.code == FRET_GROSS_SLIP);
        fret_contact_state(c, &now);
        FN = (double)now.FN;
    }
    if (now.W > 0) {
        const fret_real W = whole_work(n, mu, s, 0);
        /* next to a sharp edge, where p ~ e^k, radii are no closer to it than their rounding */
        const bool sharp = fret_gap_start(&n->gap) > 0 && fret_gap_sharp(&n->gap) && k < 0;
        CHECK_REL(W, now.W, 1e-11L + (sharp ? 4 * powl(LDBL_EPSILON, 1 + k) : 0));
    }
    fret_slips_free(s);
    fret_contact_free(c);
}

/* ---- swinging loads ---------------------------------------------------------------------------- */

static void swinging(int i) {
    static const double ks[] = {0, -0.4, 0.5};
    const double mu = 0.4, FN = 60;
    const fret_normal *n = normal_of(i % SHAPES, ks[i % 3]);
    const fret_sine sine = {unit_random(&state, 3, 12), unit_random(&state, -20, 20),
                            unit_random(&state, -3, 3), FN};
    fret_contact *c = NULL;
    fret_slips *s = NULL;
    fret_state now;
    CHECK_OK(fret_contact_make(n, mu, FRET_EXACT, &c));
    CHECK_OK(fret_slips_make(&s));
    CHECK_OK(fret_contact_watch(c, s));
    CHECK_OK(fret_contact_step(
        c, &(fret_step){FRET_TO_FORCE, FRET_TO_FX, FN + sine.FNA * cos(sine.phase), sine.FA}));
    CHECK_OK(fret_contact_swing(c, &sine, 0, 0.4));
    CHECK_OK(fret_contact_swing(c, &sine, 0.4, 1));
    fret_contact_state(c, &now);
    CHECK_REL(whole_work(n, mu, s, 0), now.W, 1e-11L);
    const size_t first = fret_slips_count(s);
    CHECK_OK(fret_contact_swing(c, &sine, 0, 1));
    CHECK_REL(whole_work(n, mu, s, first), fret_contact_last_loss(c), 1e-11L);
    CHECK_OK(fret_contact_step(c, &(fret_step){FRET_KEEP_NORMAL, FRET_TO_DX, 0, 3e-6}));
    fret_contact_state(c, &now);
    CHECK_REL(whole_work(n, mu, s, 0), now.W, 1e-11L);
    fret_slips_free(s);
    fret_contact_free(c);
}

/* ---- what states on the way tell --------------------------------------------------------------- */

/* The mean of traction times the slip between two states. */
static fret_real between(const fret_field *a, const fret_field *b, fret_real r) {
    fret_real q[2] = {0, 0}, s[2] = {0, 0};
    CHECK_OK(fret_field_traction(a, r, &q[0]));
    CHECK_OK(fret_field_traction(b, r, &q[1]));
    CHECK_OK(fret_field_slip(a, r, &s[0]));
    CHECK_OK(fret_field_slip(b, r, &s[1]));
    return (q[0] + q[1]) / 2 * (s[1] - s[0]);
}

/* Many small parts of a motion against the whole: second order, but where slip sets in, so that the worst
 * place goes from 3e-4 at 400 parts to 2.3e-4, 9e-5, 3e-5 at 800, 1600, 3200. */
static void small_parts(int i, bool swings) {
    enum { PARTS = 800, PLACES = 7 };
    const double mu = 0.4;
    const fret_normal *n = normal_of(i % SHAPES, i % 3 * 0.3 - 0.3);
    const fret_sine sine = {10, 18, 1.1, 60};
    fret_contact *c = NULL;
    fret_slips *s = NULL;
    fret_work *work = NULL;
    fret_field *field[2] = {NULL, NULL};
    fret_real sum[PLACES] = {0}, largest = 0;
    CHECK_OK(fret_contact_make(n, mu, FRET_EXACT, &c));
    CHECK_OK(fret_contact_step(c, &(fret_step){FRET_TO_FORCE, FRET_TO_FX, 60 + 18 * cos(1.1), 10}));
    CHECK_OK(fret_slips_make(&s));
    CHECK_OK(fret_contact_watch(c, s));
    fret_state from;
    fret_contact_state(c, &from);
    const fret_real a = from.a;
    const double dx = (double)(mu * n->foundation.eta * from.dz) * (i % 2 ? -1.7 : -0.6),
                 dz = (double)from.dz * (i % 4 < 2 ? -0.3 : 0.25);
    CHECK_OK(fret_field_make(c, &field[0]));
    for (int j = 1; j <= PARTS; j++) {
        const double t = (double)j / (double)PARTS;
        CHECK_OK(swings
                     ? fret_contact_swing(c, &sine, (j - 1) / (double)PARTS, t)
                     : fret_contact_step(c, &(fret_step){FRET_TO_DEPTH, FRET_TO_DX, (double)from.dz + dz * t,
                                                         (double)from.dx + dx * t}));
        CHECK_OK(fret_field_make(c, &field[j % 2]));
        for (int l = 0; l < PLACES; l++)
            sum[l] += between(field[1 - j % 2], field[j % 2], a * (l + 0.5L) / (double)PLACES);
        fret_field_free(field[1 - j % 2]);
    }
    fret_field_free(field[0]);
    CHECK_OK(fret_work_make(n, mu, s, 0, fret_slips_count(s), &work));
    for (int l = PLACES - 1; l >= 0; l--) {
        fret_real w = 0;
        CHECK_OK(fret_work_at(work, a * (l + 0.5L) / (double)PLACES, &w));
        largest = fmaxl(largest, w);
        CHECK_ABS(sum[l], w, largest, 3e-4L);
    }
    CHECK(largest > 0);
    fret_work_free(work);
    fret_slips_free(s);
    fret_contact_free(c);
}

/* ---- constant F_N ------------------------------------------------------------------------------ */

/* A closed cycle: D = 4 mu p s of first loading; beyond gross slip 4 mu p times the rest more. */
static void closed_cycle(int i, bool gross) {
    const double mu = 0.3;
    const fret_normal *n = normal_of(i, i % 2 ? 0.3 : -0.3);
    fret_pressed pressed = {.normal = n, .mu = mu};
    fret_contact *c = NULL;
    fret_slips *s = NULL;
    fret_work *work = NULL;
    fret_field *field = NULL;
    fret_state now;
    CHECK_OK(fret_press_by_force(n, 50, &pressed.press));
    const double most = (double)fret_gross_slip(&pressed), dA = most * (gross ? 1.4 : 0.7);
    CHECK_OK(fret_contact_make(n, mu, FRET_EXACT, &c));
    CHECK_OK(fret_slips_make(&s));
    CHECK_OK(fret_contact_watch(c, s));
    CHECK_OK(fret_contact_step(c, &(fret_step){FRET_TO_FORCE, FRET_TO_DX, 50, 0}));
    CHECK_OK(fret_contact_step(c, &(fret_step){FRET_KEEP_NORMAL, FRET_TO_DX, 0, gross ? most : dA}));
    CHECK_OK(fret_field_make(c, &field));
    fret_contact_state(c, &now);
    CHECK_OK(fret_contact_step(c, &(fret_step){FRET_KEEP_NORMAL, FRET_TO_DX, 0, dA}));
    const size_t first = fret_slips_count(s);
    for (int j = 0; j < 2; j++)
        CHECK_OK(fret_contact_step(c, &(fret_step){FRET_KEEP_NORMAL, FRET_TO_DX, 0, j ? dA : -dA}));
    CHECK_OK(fret_work_make(n, mu, s, first, fret_slips_count(s), &work));
    for (double l = 0.05; l < 1.2; l += 0.05) {
        const fret_real r = l * now.a;
        fret_real D = -1, p = 0, slip = -1;
        CHECK_OK(fret_work_at(work, r, &D));
        CHECK_OK(fret_field_slip(field, r, &slip));
        CHECK_OK(fret_field_pressure(field, r, &p));
        CHECK_ABS(D, 4 * mu * p * (slip + (gross ? dA - (fret_real)most : 0)), mu * p * most + 1e-300L,
                  1e-13L);
        CHECK(r > now.c ? slip > 0 : slip == 0 && (gross || D == 0));
        CHECK(r < now.a || D == 0);
    }
    fret_real once = 0, more = 0;
    fret_slips_repeat(s, first, 3);
    CHECK_OK(fret_work_at(work, (now.c + now.a) / 2, &once));
    fret_work_free(work);
    CHECK_OK(fret_work_make(n, mu, s, first, SIZE_MAX, &work));
    CHECK_OK(fret_work_at(work, (now.c + now.a) / 2, &more));
    CHECK_REL(more, 4 * once, 1e-15L);
    fret_work_free(work);
    CHECK_OK(fret_work_make(n, mu, s, first, first, &work));
    CHECK_OK(fret_work_at(work, (now.c + now.a) / 2, &more));
    CHECK((once > 0 || now.c == now.a) && more == 0); /* all of a flat punch sticks */
    fret_field_free(field);
    fret_work_free(work);
    fret_slips_free(s);
    fret_contact_free(c);
}

/* Right beyond where cells of the law meet, of which the last digit of a radius is a large part. */
static void beyond_joints(int shape, double k) {
    const double mu = 0.5;
    const fret_normal *n = normal_of(shape, k);
    fret_contact *c = NULL;
    fret_slips *s = NULL;
    fret_work *work = NULL;
    fret_field *field = NULL;
    fret_press press;
    CHECK_OK(fret_press_by_radius(n, shape == 5 ? 0.0094 : 4e-4, &press));
    CHECK_OK(fret_slips_make(&s));
    CHECK_OK(fret_contact_make(n, mu, FRET_EXACT, &c));
    CHECK_OK(fret_contact_watch(c, s));
    CHECK_OK(fret_contact_step(c, &(fret_step){FRET_TO_FORCE, FRET_KEEP_DX, (double)press.F, 0}));
    CHECK_OK(
        fret_contact_step(c, &(fret_step){FRET_KEEP_NORMAL, FRET_TO_FX, 0, 0.999 * mu * (double)press.F}));
    CHECK_OK(fret_work_make(n, mu, s, 0, fret_slips_count(s), &work));
    CHECK_OK(fret_field_make(c, &field));
    for (size_t i = 1; i < n->cells->count && n->cells->cell[i].x < press.a; i++)
        for (int j = 1; j < 200; j++) {
            const fret_real r = n->cells->cell[i].x * (1 + (fret_real)j * 0x1p-54L);
            fret_real w = -1, p = 0, slip = -1;
            CHECK_OK(fret_work_at(work, r, &w));
            CHECK_OK(fret_field_slip(field, r, &slip));
            CHECK_OK(fret_field_pressure(field, r, &p));
            CHECK_REL(w, mu * p * slip, 1e-13L);
        }
    fret_field_free(field);
    fret_work_free(work);
    fret_slips_free(s);
    fret_contact_free(c);
}

/* ---- refusals ---------------------------------------------------------------------------------- */

static void ends(void) {
    const fret_normal *n = normal_of(1, -0.5); /* a tip that presses infinitely */
    fret_contact *c = NULL, *quick = NULL;
    fret_slips *s = NULL;
    fret_work *work = NULL;
    fret_field *field = NULL;
    fret_real w = -1;
    CHECK_OK(fret_slips_make(&s));
    CHECK_OK(fret_work_make(n, 0.3, s, 0, fret_slips_count(s), &work));
    CHECK_OK(fret_work_at(work, 1e-5L, &w));
    CHECK(w == 0);
    fret_work_free(work);
    CHECK_OK(fret_contact_make(n, 0.3, FRET_DOUBLE, &quick));
    CHECK_ERROR(fret_contact_watch(quick, s), FRET_OUTSIDE, "exactness");
    CHECK_OK(fret_contact_make(n, 0.3, FRET_EXACT, &c));
    CHECK_OK(fret_contact_watch(c, s));
    CHECK_OK(fret_contact_step(c, &(fret_step){FRET_TO_FORCE, FRET_TO_FX, 50, 10}));
    CHECK_OK(fret_contact_step(c, &(fret_step){FRET_KEEP_NORMAL, FRET_TO_FX, 0, 14}));
    CHECK_OK(fret_work_make(n, 0.3, s, 0, fret_slips_count(s), &work));
    CHECK_OK(fret_work_at(work, 0, &w));
    CHECK(w == 0); /* it sticks */
    CHECK_ERROR(fret_work_at(work, -1e-6L, &w), FRET_NEGATIVE, "r");
    CHECK_ERROR(fret_work_at(work, (fret_real)NAN, &w), FRET_NOT_FINITE, "r");
    fret_work_free(work);
    const size_t before = fret_slips_count(s);
    CHECK_OK(fret_contact_step(c, &(fret_step){FRET_KEEP_NORMAL, FRET_TO_DX, 0, 1}));
    CHECK(fret_slips_count(s) > before);
    CHECK_OK(fret_work_make(n, 0.3, s, before, fret_slips_count(s), &work));
    CHECK_ERROR(fret_work_at(work, 0, &w), FRET_SINGULAR, "r");
    fret_work_free(work);
    CHECK_OK(fret_field_make(c, &field));
    CHECK_OK(fret_field_slip(field, 1e-6L, &w)); /* sliding carries all of it along */
    CHECK(w > 0.9L && w < 1);
    CHECK_ERROR(fret_field_slip(field, -1e-6L, &w), FRET_NEGATIVE, "r");
    fret_field_free(field);
    CHECK_OK(fret_contact_watch(c, NULL));
    fret_slips_clear(s);
    CHECK_OK(fret_contact_step(c, &(fret_step){FRET_KEEP_NORMAL, FRET_TO_DX, 0, -1}));
    CHECK(fret_slips_count(s) == 0);
    fret_slips_free(s);
    fret_contact_free(c);
    fret_contact_free(quick);
}

int main(int argc, char **argv) {
    const char *scenes = getenv("FRET_SCENES"); /* FRET_SCENES=300 takes some minutes */
    unit_start("work", argc, argv);
    for (int i = 0; i < SHAPES; i++) {
        CASE(closed_cycle(i, false));
        CASE(closed_cycle(i, true));
    }
    CASE(ends());
    for (int i = 0; i < 6; i++)
        CASE(beyond_joints(4 + i % 2, i / 2 * 0.3 - 0.2));
    for (int i = 0; i < SHAPES; i++) {
        CASE(small_parts(i, false));
        if (i < 3)
            CASE(small_parts(i, true));
    }
    for (int i = 0; i < unit_draws(4); i++)
        CASE(swinging(i));
    for (int i = 0; i < (scenes ? atoi(scenes) : unit_skips(1) ? 12 : 30); i++)
        CASE(random_scene(i));
    return unit_finish();
}
