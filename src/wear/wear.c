/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What fretting leaves of a gap: the object, what is asked of it, and the ring that a run cuts. Allocates. */
#include "fret/wear.h"

#include <math.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

#include "fret/cycle.h"
#include "law/check.h"
#include "law/normal.h"
#include "number/integral.h"
#include "number/real.h"
#include "wear/blocks.h"
#include "wear/limit.h"

/* The worn gap, which copies share. */
typedef struct shape {
    atomic_size_t users;
    struct fret_table *table;
    fret_normal *law;
    fret_wear_end end; /* of the limit: it has a field */
} shape;

struct fret_wear {
    const fret_normal *normal; /* borrowed */
    shape *shape;              /* NULL: nothing worn */
    size_t count;
    fret_real *x; /* radii of the ring */
    double *h;    /* depth there, straight in r^2 between them, 0 outside of it; the work of a run */
    double *fit;  /* depth there as a table can follow it; of h */
    double cycles;
    fret_real work, volume;
};

static void drop_shape(shape *s) {
    if (!s || --s->users > 0)
        return;
    fret_normal_free(s->law);
    fret_table_free(s->table);
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
    if (!w)
        return;
    drop_shape(w->shape);
    free(w->x);
    free(w->h);
    free(w);
}

static fret_status give_rows(fret_wear *w, size_t count) {
    w->count = count;
    w->x = calloc(count + 1, sizeof *w->x);
    w->h = calloc(2 * count + 1, sizeof *w->h);
    w->fit = w->h ? w->h + count + 1 : NULL;
    return w->x && w->h ? fret_ok() : fret_fail(FRET_NO_MEMORY, NULL, 0, 0);
}

fret_status fret_wear_copy(const fret_wear *from, fret_wear **out) {
    fret_wear *w;
    fret_status st = fret_wear_make(from->normal, &w);
    if (st.code)
        return st;
    *w = *from;
    st = give_rows(w, from->count);
    if (w->shape)
        w->shape->users++;
    if (st.code) {
        fret_wear_free(w);
        return st;
    }
    if (from->count > 0) {
        memcpy(w->x, from->x, from->count * sizeof *w->x);
        memcpy(w->h, from->h, (2 * from->count + 1) * sizeof *w->h);
    }
    *out = w;
    return st;
}

/* ---- questions --------------------------------------------------------------------------------- */

const fret_normal *fret_wear_law(const fret_wear *w) {
    return w->shape ? w->shape->law : w->normal;
}

static bool is_limit(const fret_wear *w) {
    return w->shape && w->shape->end.field;
}

static fret_real row_depth(const fret_wear *w, fret_real r) {
    size_t lo = 0, hi = w->count - 1;
    if (w->count < 2 || !(r >= w->x[0] && r <= w->x[hi]))
        return 0;
    while (hi - lo > 1) {
        const size_t middle = (lo + hi) / 2;
        *(w->x[middle] <= r ? &lo : &hi) = middle;
    }
    const fret_real *x = w->x, part = (r - x[lo]) * (r + x[lo]) / ((x[hi] - x[lo]) * (x[hi] + x[lo]));
    return w->h[lo] * (1 - part) + w->h[hi] * part;
}

fret_status fret_wear_depth(const fret_wear *w, fret_real r, fret_real *h) {
    const fret_status st = fret_check_not_negative("r", (double)r);
    if (st.code)
        return st;
    if (is_limit(w))
        return fret_wear_end_depth(&w->shape->end, r, h);
    *h = row_depth(w, r);
    return st;
}

void fret_wear_ring(const fret_wear *w, fret_real *inner, fret_real *outer) {
    size_t first = 0, last = w->count;
    while (first < last && w->h[first] == 0)
        first++;
    while (last > first && w->h[last - 1] == 0)
        last--;
    *inner = is_limit(w) ? w->shape->end.c : first < last ? w->x[first > 0 ? first - 1 : 0] : 0;
    *outer = is_limit(w) ? w->shape->end.b : first < last ? w->x[last < w->count ? last : last - 1] : 0;
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

static fret_real volume_of(const fret_wear *w) {
    fret_real sum = 0;
    for (size_t i = 0; i + 1 < w->count; i++)
        sum += FRET_PI / 2 * ((fret_real)w->h[i] + w->h[i + 1]) * (w->x[i + 1] - w->x[i]) *
               (w->x[i + 1] + w->x[i]);
    return sum;
}

/* ---- the worn gap as a table ------------------------------------------------------------------- */

enum { INSIDE = 128, OUTSIDE = 64 };

/* lift: what is added to f outside the inner end in proportion to r^2, of a worn tip to r. */
typedef struct row_list {
    size_t count;
    double *r, *f, *slope;
    fret_real lift;
} row_list;

/* f_0' to ten digits; where it begins what it goes on with. */
static fret_real unworn_slope(const fret_gap *gap, fret_real r) {
    const fret_real start = fret_gap_start(gap), end = fret_gap_end(gap), step = r > 0 ? 1e-5L * r : 1e-12L;
    fret_real lo = 0, hi = 0;
    if (r < start || (r == start && (start > 0 ? !fret_gap_sharp(gap) : fret_gap_tip(gap) > 1)))
        return 0;
    const fret_real below = fminl(step, r - start), above = fminl(step, end - r);
    (void)fret_gap_f(gap, r - below, &lo);
    (void)fret_gap_f(gap, r + above, &hi);
    return below + above > 0 ? (hi - lo) / (below + above) : 0;
}

/* One more row, unless it is where the last is. */
static void add_row(const fret_wear *w, row_list *rows, fret_real r, fret_real f, fret_real slope) {
    const fret_real inner = w->x[0], outer = w->x[w->count - 1];
    const size_t i = rows->count;
    if (i > 0 && !((double)r > rows->r[i - 1]))
        return;
    rows->r[i] = (double)r;
    if (inner > 0) {
        f += r > inner ? rows->lift * (r - inner) * (r + inner) : 0;
        slope += r > inner ? 2 * r * rows->lift : 0;
    } else {
        f += rows->lift * outer * r;
        slope += rows->lift * outer;
    }
    rows->f[i] = (double)f;
    rows->slope[i] = (double)slope;
    if (i > 0) /* a cubic does not fall within the first cells of a steep power */
        rows->slope[i] =
            fmin(rows->slope[i], 3 * (rows->f[i] - rows->f[i - 1]) / (rows->r[i] - rows->r[i - 1]));
    rows->count++;
}

/* With the depth h worn there and its dh/dt. */
static void add_worn(const fret_wear *w, row_list *rows, fret_real r, fret_real h, fret_real dh) {
    const fret_gap *gap = &w->normal->gap;
    fret_real f = 0;
    if (!fret_gap_f(gap, (double)r, &f).code)
        add_row(w, rows, r, f + h, unworn_slope(gap, r) + 2 * r * dh);
}

/* Within the ring in the middle of each cell, with its slope: then dh/dt, t = r^2, is as good as straight
 * from one to the next and nowhere leaves what the cells have, as it would where it leaps. Where the tip
 * wears this goes for f and r, from a summit on, in which the kinks of f_0 are gone. */
static void list_rows(const fret_wear *w, row_list *rows) {
    const fret_gap *gap = &w->normal->gap;
    const fret_real *x = w->x, start = fret_gap_start(gap), outer = x[w->count - 1],
                    before = sqrtl(fmaxl(x[0] * x[0] - (x[1] - x[0]) * (x[1] + x[0]) / 2, 0)),
                    end = fminl(fret_gap_end(gap), 4 * outer);
    const bool tip = w->fit[0] > 0;
    fret_real top = 0;
    rows->count = 0;
    add_row(w, rows, 0, 0, tip ? 0 : unworn_slope(gap, 0));
    for (int i = 0; i <= INSIDE && start < before; i++)
        add_worn(w, rows, start + (before - start) * i / INSIDE, 0, 0);
    for (size_t i = 0; i + 1 < w->count; i++) {
        fret_real f[2] = {0, 0};
        for (int j = 0; j < 2; j++) {
            if (tip)
                (void)fret_gap_f(gap, x[i + (size_t)j], &f[j]);
            f[j] += w->fit[i + (size_t)j];
        }
        const fret_real rise = f[1] - f[0], width = (x[i + 1] - x[i]) * (x[i + 1] + x[i]);
        if (i == 0)
            top = tip ? f[0] + rise / 4 : 0;
        if (tip)
            add_row(w, rows, (x[i] + x[i + 1]) / 2, f[0] + rise / 2 - top, rise / (x[i + 1] - x[i]));
        else
            add_worn(w, rows, sqrtl((x[i] * x[i] + x[i + 1] * x[i + 1]) / 2), f[0] + rise / 2, rise / width);
    }
    for (int i = 0; i <= OUTSIDE; i++)
        add_worn(w, rows, outer + (end - outer) * i / OUTSIDE * i / OUTSIDE, w->fit[w->count - 1] - top, 0);
}

/* The law of rows, which ends where g begins to fall. */
static fret_status law_of(const fret_wear *w, const row_list *rows, shape *s) {
    fret_status st =
        fret_table_sloped(rows->r, rows->f, rows->slope, rows->count, w->normal->stop, &s->table);
    const fret_gap gap = fret_gap_of_table(s->table);
    return st.code ? st : fret_normal_reshape(w->normal, &gap, &s->law);
}

/* Of rows that have changed. Where nothing presses any more g is level, and between rows it may fall, as
 * beside a leap: smoothed ever more, and lifted by ever more of the largest gap, it grows. */
static fret_status give_shape(fret_wear *w, fret_annulus *annulus) {
    enum { PASSES = 256 };
    const size_t room = w->count + INSIDE + 2 * OUTSIDE;
    const fret_real inner = w->x[0], outer = w->x[w->count - 1];
    double *data = calloc(3 * room, sizeof *data);
    shape *s = calloc(1, sizeof *s);
    row_list rows = {.r = data, .f = data + room, .slope = data + 2 * room};
    fret_status st = data && s ? fret_ok() : fret_fail(FRET_NO_MEMORY, NULL, 0, 0);
    for (int passes = 0; !st.code; passes = passes > 0 ? 2 * passes : 1) {
        fret_real most = 0;
        (void)fret_gap_f(&w->normal->gap, outer, &most);
        rows.lift = passes * 5e-6L * most / ((outer - inner) * (outer + inner));
        fret_annulus_fit(annulus, w->h, passes, w->fit);
        list_rows(w, &rows);
        s->users = 1;
        st = law_of(w, &rows, s);
        if (!st.code && fret_normal_end(s->law) >= outer)
            break;
        fret_normal_free(s->law);
        fret_table_free(s->table);
        *s = (shape){.table = NULL};
        if (!st.code)
            st = fret_fail(FRET_NOT_MONOTONE, "r", (double)outer, 0);
        if (st.code == FRET_NOT_MONOTONE && passes < PASSES)
            st = fret_ok();
    }
    free(data);
    if (st.code) {
        free(s);
        return st;
    }
    drop_shape(w->shape);
    w->shape = s;
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
    *outer = fmaxl(*outer, a + 0.01L * (a - *inner));
    if (w->count > 0) {
        *inner = fminl(*inner, w->x[0]);
        *outer = fmaxl(*outer, w->x[w->count - 1]);
    }
    *outer = fminl(*outer, fret_normal_end(n));
    return st;
}

/* Nodes ever closer to the inner end, where the worn profile is steep. */
static fret_status cut_ring(const fret_wear *w, fret_real inner, fret_real outer, size_t count,
                            fret_wear *out) {
    *out = (fret_wear){.normal = w->normal, .cycles = w->cycles, .work = w->work};
    const fret_status st = give_rows(out, count);
    for (size_t i = 0; i < count && !st.code; i++) {
        const fret_real u = (fret_real)i / (fret_real)(count - 1), part = u * u * (2 - u);
        out->x[i] = sqrtl(inner * inner + part * (outer - inner) * (outer + inner));
        out->h[i] = (double)row_depth(w, out->x[i]);
    }
    return st;
}

/* As many as a run and its first cycle take; the edge is blunter where k < 0. */
static size_t nodes_of(const fret_normal *n, double tolerance) {
    const double m = (double)(n->foundation.k + 1) / 2;
    return (size_t)fmin(fmax(260 * pow(1e-3 / tolerance, 2.0 / 3) * fmin(pow(fmax(0.5 / m, 1), 1.5), 2), 40),
                        1000);
}

/* The ring with its nodes, run; full: it does not reach far enough. */
static fret_status run_ring(const fret_wear_held *held, fret_real depth, double cycles, double tolerance,
                            fret_wear_told told, void *user, fret_wear *cut, bool *full) {
    fret_annulus a;
    fret_status st = fret_annulus_make(cut->normal, held, depth, cut->x, cut->count, &a);
    cut->h[cut->count] = 0;
    if (!st.code)
        st = fret_blocks_run(&a, cut->h, cycles, tolerance, cut->normal->stop, told, user, full);
    cut->cycles += cycles;
    cut->work += cut->h[cut->count];
    cut->volume = volume_of(cut);
    if (!st.code && !*full)
        st = give_shape(cut, &a);
    fret_annulus_free(&a);
    return st;
}

fret_status fret_wear_run(fret_wear *w, const fret_wear_held *held, double cycles, double tolerance,
                          fret_wear_told told, void *user) {
    fret_real inner = 0, outer = 0;
    fret_status st = check_held(w->normal, held);
    const fret_real depth = held->press + row_depth(w, 0), end = fret_normal_end(w->normal);
    fret_wear cut = {.normal = NULL};
    bool full = true;
    if (!st.code)
        st = fret_check_not_negative("cycles", cycles);
    if (!st.code && (!(tolerance >= 1e-4 && tolerance <= 0.1) || is_limit(w)))
        st = fret_fail(FRET_OUTSIDE, "tolerance", tolerance, 1e-4);
    if (!st.code)
        st = ring_of(w, held, depth, cycles, &inner, &outer);
    while (!st.code && full) {
        st = cut_ring(w, inner, outer, nodes_of(w->normal, tolerance), &cut);
        if (!st.code)
            st = run_ring(held, depth, cycles, tolerance, told, user, &cut, &full);
        if (!st.code && full) {
            free(cut.x);
            free(cut.h);
            cut.x = NULL;
            cut.h = NULL;
            if (!(outer < end))
                st = fret_fail(FRET_TABLE_SHORT, "r", (double)outer, (double)end);
            outer = fminl(sqrtl(inner * inner + 1.5L * (outer - inner) * (outer + inner)), end);
        }
    }
    if (st.code) {
        free(cut.x);
        free(cut.h);
        return st;
    }
    drop_shape(w->shape);
    free(w->x);
    free(w->h);
    *w = cut;
    return st;
}

fret_status fret_wear_limit(const fret_normal *normal, const fret_wear_held *held, fret_wear **out) {
    fret_wear *w, cut = {.normal = NULL};
    fret_wear_end end = {.normal = NULL};
    fret_annulus a = {.t = NULL};
    fret_status st = check_held(normal, held);
    if (!st.code)
        st = fret_wear_make(normal, &w);
    if (st.code)
        return st;
    st = fret_wear_end_make(normal, held, held->press, &end);
    if (!st.code)
        st = fret_wear_end_volume(&end, &w->volume);
    if (!st.code)
        st = cut_ring(w, end.c, end.b + (end.b - end.c) / 20, 240, &cut);
    for (size_t i = 0; i < cut.count && !st.code; i++) {
        fret_real h;
        st = fret_wear_end_depth(&end, cut.x[i], &h);
        cut.h[i] = (double)h;
    }
    w->x = cut.x;
    w->h = cut.h;
    w->fit = cut.fit;
    w->count = cut.count;
    if (!st.code)
        st = fret_annulus_make(normal, held, held->press, w->x, w->count, &a);
    if (!st.code)
        st = give_shape(w, &a);
    fret_annulus_free(&a);
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
