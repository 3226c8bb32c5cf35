/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What fretting leaves of a gap: the object, what is asked of it, and the ring that a run cuts. Allocates. */
#include "fret/wear.h"

#include <math.h>
#include <stdatomic.h>
#include <stdlib.h>

#include "fret/cycle.h"
#include "law/check.h"
#include "law/normal.h"
#include "law/table.h"
#include "number/integral.h"
#include "number/real.h"
#include "wear/blocks.h"
#include "wear/limit.h"

/* The worn gap, which copies share. */
typedef struct shape {
    atomic_size_t users;
    struct fret_worn worn;
    fret_normal *law;
    fret_real outer;    /* where the nodes end */
    fret_real from, to; /* what has worn; 0, 0: nothing */
    fret_wear_end end;  /* of the limit: it has a field */
} shape;

struct fret_wear {
    const fret_normal *normal; /* borrowed */
    shape *shape;              /* NULL: nothing worn */
    double cycles;
    fret_real work, volume;
};

static void drop_shape(shape *s) {
    if (!s || --s->users > 0)
        return;
    fret_normal_free(s->law);
    fret_table_free(s->worn.g);
    fret_table_free(s->worn.h);
    fret_wear_end_free(&s->end);
    free(s);
}

fret_status fret_wear_make(const fret_normal *normal, fret_wear **out) {
    fret_wear *w = calloc(1, sizeof *w);
    if (!w)
        return fret_fail(FRET_NO_MEMORY, NULL, 0, 0);
    w->normal = normal;
    *out = w;
    return fret_ok();
}

void fret_wear_free(fret_wear *w) {
    if (w)
        drop_shape(w->shape);
    free(w);
}

fret_status fret_wear_copy(const fret_wear *from, fret_wear **out) {
    const fret_status st = fret_wear_make(from->normal, out);
    if (st.code)
        return st;
    **out = *from;
    if (from->shape)
        from->shape->users++;
    return st;
}

/* ---- questions --------------------------------------------------------------------------------- */

const fret_normal *fret_wear_law(const fret_wear *w) {
    return w->shape ? w->shape->law : w->normal;
}

static bool is_limit(const fret_wear *w) {
    return w->shape && w->shape->end.field;
}

static fret_real depth_at(const shape *s, fret_real r) {
    return !s || r < s->worn.inner || r > s->outer
               ? 0
               : s->worn.tip + fret_table_f(s->worn.h, (r - s->worn.inner) * (r + s->worn.inner));
}

fret_status fret_wear_depth(const fret_wear *w, fret_real r, fret_real *h) {
    const fret_status st = fret_check_not_negative("r", (double)r);
    if (st.code)
        return st;
    if (is_limit(w))
        return fret_wear_end_depth(&w->shape->end, r, h);
    *h = depth_at(w->shape, r);
    return st;
}

void fret_wear_ring(const fret_wear *w, fret_real *inner, fret_real *outer) {
    *inner = is_limit(w) ? w->shape->end.c : w->shape ? w->shape->from : 0;
    *outer = is_limit(w) ? w->shape->end.b : w->shape ? w->shape->to : 0;
}

fret_real fret_wear_volume(const fret_wear *w) {
    return w->volume;
}

double fret_wear_cycles(const fret_wear *w) {
    return w->cycles;
}

fret_real fret_wear_work(const fret_wear *w) {
    return w->work;
}

/* ---- the worn gap ------------------------------------------------------------------------------ */

enum { OUTSIDE = 64 };

/* Radii of the ring, depths there, straight in r^2 between them, and 0 outside of it; of a run one more, the
 * work. */
typedef struct worn_ring {
    size_t count;
    fret_real *x;
    double *h;
} worn_ring;

static void drop_ring(worn_ring *r) {
    free(r->x);
    free(r->h);
    *r = (worn_ring){.count = 0};
}

static fret_real volume_of(const worn_ring *r) {
    const fret_real *x = r->x;
    fret_real sum = 0;
    for (size_t i = 0; i + 1 < r->count; i++)
        sum += FRET_PI / 2 * ((fret_real)r->h[i] + r->h[i + 1]) * (x[i + 1] - x[i]) * (x[i + 1] + x[i]);
    return sum;
}

/* The rows of a worn gap: of the ring, and beyond it. Where nothing presses any more g is level, and falls by
 * what nodes do not tell: it is lifted to what it has been. least: it is as much at least. */
static fret_status give_rows(const fret_normal *n, const worn_ring *r, fret_real least,
                             struct fret_worn *out) {
    const fret_real inner = r->x[0], outer = r->x[r->count - 1], end = fminl(fret_normal_end(n), 4 * outer);
    const size_t count = r->count + (end > outer ? OUTSIDE : 0);
    double *t = calloc(3 * count, sizeof *t);
    if (!t)
        return fret_fail(FRET_NO_MEMORY, NULL, 0, 0);
    double *const g = t + count, *const h = g + count;
    *out = (struct fret_worn){
        .of = n->gap, .inner = inner, .at_inner = fret_normal_profile(n, inner), .tip = r->h[0]};
    out->lift = 1e-9L * fret_normal_profile(n, outer) / ((end - inner) * (end + inner));
    for (size_t i = 1; i < count; i++) {
        const bool within = i < r->count;
        const fret_real part = within ? 0 : (fret_real)(i + 1 - r->count) / OUTSIDE,
                        x = within ? r->x[i] : outer + (end - outer) * part * part,
                        rise = fret_normal_profile(n, x) - out->at_inner - r->h[0] +
                               fret_annulus_profile(n->foundation.k, r->x, r->h, r->count, x);
        t[i] = (double)((x - inner) * (x + inner));
        g[i] = fmax(g[i - 1], (double)fmaxl(fmaxl(rise, least), out->lift * (fret_real)t[i]));
        h[i] = (within ? r->h[i] : 0) - r->h[0];
    }
    fret_status st = fret_table_make(t, g, count, n->stop, &out->g);
    if (!st.code)
        st = fret_table_make(t, h, count, n->stop, &out->h);
    free(t);
    return st;
}

static fret_status give_shape(fret_wear *w, const worn_ring *r, fret_real least) {
    shape *s = calloc(1, sizeof *s);
    if (!s)
        return fret_fail(FRET_NO_MEMORY, NULL, 0, 0);
    s->users = 1;
    s->outer = r->x[r->count - 1];
    for (size_t i = 0; i + 1 < r->count; i++)
        if (r->h[i] > 0 || r->h[i + 1] > 0) {
            s->from = s->to > 0 ? s->from : r->x[i];
            s->to = r->x[i + 1];
        }
    fret_status st = give_rows(w->normal, r, least, &s->worn);
    const fret_gap gap = fret_gap_of_worn(&s->worn);
    if (!st.code)
        st = fret_normal_reshape(w->normal, &gap, &s->law);
    if (st.code) {
        drop_shape(s);
        return st;
    }
    drop_shape(w->shape);
    w->shape = s;
    w->volume = volume_of(r);
    return st;
}

/* ---- the ring ---------------------------------------------------------------------------------- */

static fret_status check_held(const fret_normal *n, const fret_wear_held *held) {
    fret_status st = fret_check_positive(held->by_depth ? "dz" : "FN", held->press);
    if (!st.code)
        st = fret_check_positive("mu", held->mu);
    if (!st.code)
        st = fret_check_positive("alpha", held->alpha);
    if (!st.code)
        st = fret_check_not_negative(held->by_displacement ? "dA" : "FA", held->amplitude);
    if (!st.code && fret_normal_punch(n))
        st = fret_fail(FRET_SINGULAR, "r", (double)fret_gap_start(&n->gap), 0);
    return st;
}

/* Volume between the gap and a plane that it meets at r. */
static fret_real cap_at(fret_real t, fret_real rest, void *context) {
    const void *const *c = context;
    const fret_real r = *(const fret_real *)c[1] * sqrtl(t);
    fret_real f = 0;
    (void)rest;
    (void)fret_gap_f(c[0], r, &f);
    return f;
}
static fret_real cap(const fret_gap *gap, fret_real r) {
    fret_real f = 0;
    const void *context[2] = {gap, &r};
    (void)fret_gap_f(gap, r, &f);
    return FRET_PI * r * r * (f - fret_integral_smooth(cap_at, (void *)context));
}

/* A ring has some width, where nothing wears too. */
static const fret_real LEAST = 1e-6L;

/* How far the ring reaches that wears: from where the unworn contact or the limit sticks, to where the limit
 * ends; where nothing sticks in the end, to where all is worn that a held F_N can wear, or that a held depth
 * reaches. */
static fret_status ring_of(const fret_wear *w, const fret_wear_held *held, fret_real depth, double cycles,
                           fret_real *inner, fret_real *outer) {
    const fret_normal *n = w->normal;
    fret_pressed contact = {.normal = n, .mu = held->mu};
    fret_loading turn;
    fret_wear_end end;
    fret_status st = held->by_depth ? fret_press_by_depth(n, (double)depth, &contact.press)
                                    : fret_press_by_force(n, held->press, &contact.press);
    if (st.code)
        return st;
    st = held->by_displacement ? fret_loading_by_displacement(&contact, held->amplitude, &turn)
                               : fret_loading_by_force(&contact, held->amplitude, &turn);
    if (st.code)
        return st;
    const fret_real a = contact.press.a, gap_end = fret_gap_end(&n->gap),
                    most = w->volume + 4 * held->alpha * cycles * turn.Fx *
                                           fmaxl(turn.dx, held->by_displacement ? held->amplitude : 0);
    fret_real reach = 0.01L * a;
    while (reach < gap_end && cap(&n->gap, reach) < most)
        reach *= 1.1L;
    *outer = sqrtl(a * a + reach * reach);
    *inner = turn.c;
    st = fret_wear_end_make(n, held, depth, &end);
    if (!st.code) {
        *inner = fminl(*inner, end.c);
        *outer = fminl(*outer, end.b + 0.01L * (end.b - end.c));
        fret_wear_end_free(&end);
    } else if (st.code == FRET_GROSS_SLIP) {
        *inner = 0;
    } else if (st.code != FRET_TABLE_SHORT) {
        return st;
    }
    st = fret_ok();
    *outer = fmaxl(*outer, a + fmaxl(0.01L * (a - *inner), LEAST * a));
    if (w->shape) {
        *inner = fminl(*inner, w->shape->worn.inner);
        *outer = fmaxl(*outer, w->shape->outer);
    }
    *outer = fminl(*outer, fret_normal_end(n));
    return st;
}

/* Nodes ever closer to the inner end, where the worn profile is steep. */
static fret_status cut_ring(const fret_wear *w, fret_real inner, fret_real outer, size_t count,
                            worn_ring *out) {
    *out = (worn_ring){count, calloc(count, sizeof *out->x), calloc(count + 1, sizeof *out->h)};
    if (!out->x || !out->h)
        return fret_fail(FRET_NO_MEMORY, NULL, 0, 0);
    for (size_t i = 0; i < count; i++) {
        const fret_real u = (fret_real)i / (fret_real)(count - 1), part = u * u * (2 - u);
        out->x[i] = sqrtl(inner * inner + part * (outer - inner) * (outer + inner));
        out->h[i] = (double)depth_at(w->shape, out->x[i]);
    }
    return fret_ok();
}

/* As many as a run and its first cycle take; the edge is blunter where k < 0. */
static size_t nodes_of(const fret_normal *n, double tolerance) {
    const double m = (double)(n->foundation.k + 1) / 2;
    return (size_t)fmin(fmax(260 * pow(1e-3 / tolerance, 2.0 / 3) * fmin(pow(fmax(0.5 / m, 1), 1.5), 2), 40),
                        1000);
}

fret_status fret_wear_run(fret_wear *w, const fret_wear_held *held, double cycles, double tolerance,
                          fret_wear_told told, void *user) {
    fret_real inner = 0, outer = 0;
    fret_status st = check_held(w->normal, held);
    const fret_real depth = held->press + depth_at(w->shape, 0), end = fret_normal_end(w->normal);
    worn_ring r = {.count = 0};
    if (!st.code)
        st = fret_check_not_negative("cycles", cycles);
    if (!st.code && (!(tolerance >= 1e-4 && tolerance <= 0.1) || is_limit(w)))
        st = fret_fail(FRET_OUTSIDE, "tolerance", tolerance, 1e-4);
    if (!st.code)
        st = ring_of(w, held, depth, cycles, &inner, &outer);
    for (bool full = true; !st.code && full;) {
        fret_annulus a = {.t = NULL};
        drop_ring(&r);
        st = cut_ring(w, inner, outer, nodes_of(w->normal, tolerance), &r);
        if (!st.code)
            st = fret_annulus_make(w->normal, held, depth, r.x, r.count, &a);
        if (!st.code)
            st = fret_blocks_run(&a, r.h, cycles, tolerance, w->normal->stop, told, user, &full);
        fret_annulus_free(&a);
        if (!st.code && full && !(outer < end))
            st = fret_fail(FRET_TABLE_SHORT, "r", (double)outer, (double)end);
        outer = full ? fminl(sqrtl(inner * inner + 1.5L * (outer - inner) * (outer + inner)), end) : outer;
    }
    if (!st.code)
        st = give_shape(w, &r, 0);
    if (!st.code) {
        w->cycles += cycles;
        w->work += r.h[r.count];
    }
    drop_ring(&r);
    return st;
}

fret_status fret_wear_limit(const fret_normal *normal, const fret_wear_held *held, fret_wear **out) {
    fret_wear *w;
    fret_wear_end end = {.normal = NULL};
    worn_ring r = {.count = 0};
    fret_status st = check_held(normal, held);
    if (!st.code)
        st = fret_wear_make(normal, &w);
    if (st.code)
        return st;
    st = fret_wear_end_make(normal, held, held->press, &end);
    if (!st.code)
        st = cut_ring(w, end.c, fmaxl(end.b + (end.b - end.c) / 20, (1 + LEAST) * end.c), 240, &r);
    if (!st.code)
        r.x[1] = fminl(r.x[1], end.c * (1 + 1e-9L)); /* where g leaps */
    for (size_t i = 0; i < r.count && !st.code; i++) {
        fret_real h;
        st = fret_wear_end_depth(&end, r.x[i], &h);
        r.h[i] = (double)h;
    }
    if (!st.code)
        st = give_shape(w, &r, end.depth - end.y);
    if (!st.code)
        st = fret_wear_end_volume(&end, &w->volume);
    drop_ring(&r);
    if (st.code) {
        fret_wear_end_free(&end);
        fret_wear_free(w);
        return st;
    }
    w->shape->end = end;
    w->cycles = INFINITY;
    w->work = (fret_real)NAN;
    *out = w;
    return st;
}
