/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Wear by fretting: runs, the worn gap, and getters. Allocates and frees; uses `law` and `number`. */
#include "fret/wear.h"

#include <math.h>
#include <stdlib.h>

#include "fret/cycle.h"
#include "law/check.h"
#include "law/normal.h"
#include "law/table.h"
#include "number/real.h"
#include "wear/blocks.h"
#include "wear/limit.h"

struct fret_wear {
    const fret_normal *normal; /* borrowed */
    fret_normal *law;          /* law of the worn gap; NULL: nothing has worn */
    struct fret_worn worn;     /* the worn gap, of which `law` is */
    fret_real from, to, outer; /* radii of the worn ring, and of the last node */
    fret_wear_end end;         /* of the limit only: then it has a field */
    double cycles;
    fret_real work, volume;
};

void fret_wear_free(fret_wear *w) {
    if (!w)
        return;
    fret_normal_free(w->law);
    fret_table_free(w->worn.g);
    fret_table_free(w->worn.h);
    fret_wear_end_free(&w->end);
    free(w);
}

/* ---- questions --------------------------------------------------------------------------------- */

const fret_normal *fret_wear_law(const fret_wear *w) {
    return w->law ? w->law : w->normal;
}

fret_status fret_wear_depth(const fret_wear *w, fret_real r, fret_real *h) {
    const fret_status st = fret_check_not_negative("r", (double)r);
    if (st.code)
        return st;
    if (w->end.field)
        return fret_wear_end_depth(&w->end, r, h);
    *h = !w->law || r < w->worn.inner || r > w->outer
             ? 0
             : w->worn.tip + fret_table_f(w->worn.h, (r - w->worn.inner) * (r + w->worn.inner));
    return st;
}

void fret_wear_ring(const fret_wear *w, fret_real *inner, fret_real *outer) {
    *inner = w->from;
    *outer = w->to;
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

static const fret_real G_ERROR = 1e-4L; /* error of g, relative to the depth */

/* The rows of a worn gap, in the ring and beyond. Where pressure has vanished g is level, and errors of the
 * nodes may make it fall: it never falls below its last value. Whether such a place is above or below the
 * depth is within the errors too: it counts as touching. least: a lower bound of g. */
static fret_status give_rows(const fret_normal *n, fret_annulus *a, const double *depth, fret_real least,
                             struct fret_worn *out) {
    double pressed;
    const double *profile = fret_annulus_profile(a, depth, &pressed);
    const fret_real inner = a->x[0], at_inner = fret_normal_profile(n, inner),
                    rise = fret_normal_profile(n, a->x[a->count - 1]),
                    touching = (1 - G_ERROR / 10) * pressed - 2e-9L * rise;
    double *g = calloc(2 * a->rows, sizeof *g);
    if (!g)
        return fret_fail(FRET_NO_MEMORY, NULL, 0, 0);
    double *h = g + a->rows;
    *out = (struct fret_worn){.of = n->gap,
                              .inner = inner,
                              .at_inner = at_inner,
                              .lift = 1e-9L * rise / (fret_real)a->t[a->rows - 1],
                              .tip = depth[0]};
    for (size_t i = 1; i < a->rows; i++) {
        const fret_real up = profile[i] - (fret_real)depth[0],
                        told = up > touching && up < (1 + G_ERROR) * pressed ? touching : up;
        g[i] = fmax(g[i - 1], (double)fmaxl(fmaxl(told, least), out->lift * (fret_real)a->t[i]));
        h[i] = (i < a->count ? depth[i] : 0) - depth[0];
    }
    fret_status st = fret_table_make(a->t, g, a->rows, n->stop, &out->g);
    if (!st.code)
        st = fret_table_make(a->t, h, a->rows, n->stop, &out->h);
    free(g);
    return st;
}

/* Makes the result from the depths h at the nodes of a ring. */
static fret_status make_worn(const fret_normal *n, fret_annulus *a, const double *h, fret_real least,
                             fret_wear **out) {
    fret_wear *w = calloc(1, sizeof *w);
    if (!w)
        return fret_fail(FRET_NO_MEMORY, NULL, 0, 0);
    w->normal = n;
    w->outer = a->x[a->count - 1];
    w->volume = fret_annulus_volume(a, h);
    for (size_t i = 0; i + 1 < a->count; i++)
        if (h[i] > 0 || h[i + 1] > 0) {
            w->from = w->to > 0 ? w->from : a->x[i];
            w->to = a->x[i + 1];
        }
    fret_status st = w->to > 0 ? give_rows(n, a, h, least, &w->worn) : fret_ok();
    const fret_gap gap = fret_gap_of_worn(&w->worn);
    if (!st.code && w->to > 0)
        st = fret_normal_reshape(n, &gap, &w->law);
    if (st.code)
        fret_wear_free(w);
    else
        *out = w;
    return st;
}

/* ---- runs -------------------------------------------------------------------------------------- */

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

/* Least relative width of a ring, even where nothing wears. */
static const fret_real LEAST = 1e-6L;

/* The first ring: inside, from the stick radius of the unworn contact or of the limit; outside, to the rim of
 * the limit or a quarter of the slip annulus (in r^2) beyond a; each the smaller. */
static fret_status first_ring(const fret_normal *n, const fret_wear_held *held, fret_real *inner,
                              fret_real *outer) {
    fret_pressed contact = {.normal = n, .mu = held->mu};
    fret_loading turn;
    fret_wear_end end;
    fret_status st =
        (held->by_depth ? fret_press_by_depth : fret_press_by_force)(n, held->press, &contact.press);
    if (!st.code)
        st = (held->by_displacement ? fret_loading_by_displacement
                                    : fret_loading_by_force)(&contact, held->amplitude, &turn);
    if (st.code)
        return st;
    const fret_real a = contact.press.a;
    st = fret_wear_end_make(n, held, &end);
    fret_wear_end_free(&end);
    if (st.code && st.code != FRET_GROSS_SLIP && st.code != FRET_TABLE_SHORT)
        return st;
    *inner = st.code == FRET_GROSS_SLIP ? 0 : fminl(turn.c, end.c);
    *outer = sqrtl(a * a + 0.25L * (a - *inner) * (a + *inner));
    if (!st.code)
        *outer = fminl(*outer, end.b + 0.01L * (end.b - end.c));
    *outer = fminl(fmaxl(*outer, a + fmaxl(0.01L * (a - *inner), LEAST * a)), fret_normal_end(n));
    return fret_ok();
}

/* The number of nodes for a tolerance: errors are of second order. */
static size_t nodes_of(double tolerance) {
    return (size_t)fmin(fmax(180 * sqrt(1e-3 / tolerance), 40), 1000);
}

fret_status fret_wear_run_make(const fret_normal *n, const fret_wear_held *held, double tolerance,
                               fret_wear_run **out) {
    fret_real inner = 0, outer = 0;
    fret_status st = check_held(n, held);
    if (!st.code && !(tolerance >= 1e-4 && tolerance <= 0.1))
        st = fret_fail(FRET_OUTSIDE, "tolerance", tolerance, 1e-4);
    if (!st.code)
        st = first_ring(n, held, &inner, &outer);
    if (st.code)
        return st;
    fret_wear_run *run = calloc(1, sizeof *run);
    if (!run)
        return fret_fail(FRET_NO_MEMORY, NULL, 0, 0);
    *run = (fret_wear_run){.normal = n, .held = *held, .tolerance = tolerance, .nodes = nodes_of(tolerance)};
    run->before = calloc(2 * (run->nodes + 1), sizeof *run->before);
    if (run->before) {
        run->stiff = run->before + run->nodes + 1;
        st = fret_blocks_begin(run, inner, inner, outer);
    } else
        st = fret_fail(FRET_NO_MEMORY, NULL, 0, 0);
    if (st.code)
        fret_wear_run_free(run);
    else
        *out = run;
    return st;
}

void fret_wear_run_free(fret_wear_run *run) {
    if (!run)
        return;
    for (size_t i = 0; i < run->count; i++)
        fret_blocks_free(&run->blocks[i]);
    free(run->blocks);
    free(run->before);
    free(run);
}

fret_status fret_wear_after(fret_wear_run *run, double cycles, fret_wear_told told, void *user,
                            fret_wear **out) {
    fret_status st = fret_check_not_negative("cycles", cycles);
    while (!st.code && !run->arrived && fret_blocks_reached(run) < cycles) {
        st = fret_blocks_go_on(run);
        if (told)
            told(fret_blocks_reached(run), user);
        st = fret_unless_stopped(run->normal, st);
    }
    if (st.code)
        return st;
    double *h = calloc(run->nodes + 1, sizeof *h);
    st = h ? make_worn(run->normal, fret_blocks_at(run, cycles, h), h, 0, out)
           : fret_fail(FRET_NO_MEMORY, NULL, 0, 0);
    if (!st.code) {
        (*out)->cycles = cycles;
        (*out)->work = h[run->nodes];
    }
    free(h);
    return st;
}

/* ---- the limit --------------------------------------------------------------------------------- */

fret_status fret_wear_limit(const fret_normal *n, const fret_wear_held *held, fret_wear **out) {
    enum { NODES = 240 };
    static const fret_real LEAP = 1e-9L; /* relative: g jumps within this distance of c */
    fret_wear_end e = {.normal = NULL};
    fret_annulus a = {.t = NULL};
    double h[NODES] = {0};
    fret_wear *w = NULL;
    fret_status st = check_held(n, held);
    if (!st.code)
        st = fret_wear_end_make(n, held, &e);
    if (!st.code)
        st = fret_annulus_make(n, held, e.c, e.c, fmaxl(e.b + (e.b - e.c) / 20, (1 + LEAST) * e.c),
                               (1 + LEAP) * e.c, NODES, &a);
    for (size_t i = 0; i < a.count && !st.code; i++) {
        fret_real depth;
        st = fret_wear_end_depth(&e, a.x[i], &depth);
        h[i] = (double)depth;
    }
    if (!st.code)
        st = make_worn(n, &a, h, e.depth - e.y, &w);
    if (!st.code)
        st = fret_wear_end_volume(&e, &w->volume);
    fret_annulus_free(&a);
    if (st.code) {
        fret_wear_end_free(&e);
        fret_wear_free(w);
        return st;
    }
    w->end = e;
    w->from = e.c;
    w->to = e.b;
    w->cycles = INFINITY;
    w->work = (fret_real)NAN;
    *out = w;
    return st;
}
