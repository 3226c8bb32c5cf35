/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Blocks of cycles, by explicit Runge-Kutta-Chebyshev steps of second order: uneven wear decays far faster
 * than the whole, and the number of stages grows with the root of that ratio only. Each block follows from
 * the last alone, so that results do not depend on earlier calls. Allocates; uses `law` and `number`. */
#include "wear/blocks.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "law/check.h"
#include "law/normal.h"
#include "law/table.h"
#include "number/array.h"
#include "number/real.h"

enum { STAGES = 250, RATES = 1000000 };
static const double LATE = 1e-3,
                    FOLLOW = 0.5; /* of the tolerance; FOLLOW: node spacing at c, by ring width */

/* y after a block of `cycles` from y0 with the rate rate0, in `stages` (Sommeijer, Shampine, Verwer 1997);
 * rate: its rate there. before: a work vector. */
static fret_status run_block(fret_annulus *a, size_t n, const double *y0, const double *rate0, double cycles,
                             int stages, double *y, double *before, double *rate) {
    const double w0 = 1 + 2 / 13.0 / stages / stages, root = sqrt(w0 * w0 - 1), arg = stages * log(w0 + root),
                 w1 = sinh(arg) * root * root / (cosh(arg) * stages * root - w0 * sinh(arg));
    double T[3] = {0, w0, 1}, d[3] = {0, 1, 0}, d2[3] = {0, 0, 0}; /* this stage, the last, the one before */
    double b[3] = {0, 1 / (4 * w0 * w0), 1 / (4 * w0 * w0)};
    memcpy(before, y0, n * sizeof *y);
    for (size_t i = 0; i < n; i++)
        y[i] = y0[i] + b[1] * w1 * cycles * rate0[i];
    for (int j = 2; j <= stages; j++) {
        T[0] = 2 * w0 * T[1] - T[2];
        d[0] = 2 * T[1] + 2 * w0 * d[1] - d[2];
        d2[0] = 4 * d[1] + 2 * w0 * d2[1] - d2[2];
        b[0] = d2[0] / (d[0] * d[0]);
        const double mu = 2 * w0 * b[0] / b[1], nu = -b[0] / b[2], step = 2 * b[0] * w1 / b[1] * cycles,
                     first = -(1 - b[1] * T[1]) * step;
        const fret_status st = fret_annulus_rate(a, y, rate);
        if (st.code)
            return st;
        for (size_t i = 0; i < n; i++) {
            const double next =
                (1 - mu - nu) * y0[i] + mu * y[i] + nu * before[i] + step * rate[i] + first * rate0[i];
            before[i] = y[i];
            y[i] = next;
        }
        for (int i = 2; i > 0; i--) {
            T[i] = T[i - 1];
            d[i] = d[i - 1];
            d2[i] = d2[i - 1];
            b[i] = b[i - 1];
        }
    }
    return fret_annulus_rate(a, y, rate);
}

/* The relative error of a block: of the depth that it wears, or of 2 % of the whole depth if that is more. */
static double error_of(const fret_annulus *a, const double *y0, const double *rate0, const double *y,
                       const double *rate, double cycles, double *scratch) {
    static const double little = 0.02;
    for (size_t i = 0; i < a->count; i++)
        scratch[i] = 0.8 * (y0[i] - y[i]) + 0.4 * cycles * (rate0[i] + rate[i]);
    const double off = fret_annulus_norm(a, scratch);
    for (size_t i = 0; i < a->count; i++)
        scratch[i] = y[i] - y0[i];
    return off > 0 ? off / fmax(fret_annulus_norm(a, scratch), little * fret_annulus_norm(a, y)) : off;
}

static double *depths(const fret_blocks *b, size_t i) {
    return b->row + i * (1 + 2 * (b->ring.count + 1)) + 1;
}
static double *rates(const fret_blocks *b, size_t i) {
    return depths(b, i) + b->ring.count + 1;
}
static double *cycles(const fret_blocks *b, size_t i) {
    return depths(b, i) - 1;
}

static const fret_blocks *last_of(const fret_wear_run *run) {
    return &run->blocks[run->count - 1];
}

static fret_status make_room(fret_blocks *b) {
    return fret_array_room(&b->row, &b->room, b->count + 1, (1 + 2 * (b->ring.count + 1)) * sizeof *b->row)
               ? fret_ok()
               : fret_fail(FRET_NO_MEMORY, NULL, 0, 0);
}

void fret_blocks_free(fret_blocks *b) {
    fret_annulus_free(&b->ring);
    free(b->row);
}

double fret_blocks_reached(const fret_wear_run *run) {
    return *cycles(last_of(run), last_of(run)->count - 1);
}

/* ---- rings ------------------------------------------------------------------------------------- */

/* Copies the last depths, by cubic interpolation, and the touched springs to the nodes of another ring. */
static fret_status take_over(fret_blocks *to, const fret_blocks *from, fret_stop stop) {
    const fret_annulus *old = &from->ring;
    const double *h = depths(from, from->count - 1);
    double *more = rates(to, 0);
    struct fret_table *table;
    for (size_t i = 0; i < old->count; i++)
        more[i] = h[i] - h[0];
    const fret_status st = fret_table_make(old->t, more, old->count, stop, &table);
    for (size_t i = 0; !st.code && i < to->ring.count && to->ring.t[i] <= old->t[old->count - 1]; i++) {
        depths(to, 0)[i] = h[0] + (double)fret_table_f(table, to->ring.t[i]);
        if (to->ring.t[i] <= old->t[old->touched])
            to->ring.touched = i;
    }
    depths(to, 0)[to->ring.count] = h[old->count];
    *cycles(to, 0) = *cycles(from, from->count - 1);
    if (!st.code)
        fret_table_free(table);
    return st;
}

fret_status fret_blocks_begin(fret_wear_run *run, fret_real inner, fret_real steep, fret_real outer) {
    if (!fret_array_room(&run->blocks, &run->room, run->count + 1, sizeof *run->blocks))
        return fret_fail(FRET_NO_MEMORY, NULL, 0, 0);
    fret_blocks *b = &run->blocks[run->count];
    *b = (fret_blocks){.count = 0};
    fret_status st =
        fret_annulus_make(run->normal, &run->held, inner, steep, outer, outer, run->nodes, &b->ring);
    if (!st.code)
        st = make_room(b);
    if (!st.code) {
        memset(cycles(b, 0), 0, (run->nodes + 2) * sizeof *b->row);
        if (run->count)
            st = take_over(b, b - 1, run->normal->stop);
    }
    if (!st.code)
        st = fret_annulus_rate(&b->ring, depths(b, 0), rates(b, 0));
    st = fret_unless_stopped(run->normal, st);
    if (st.code) {
        fret_blocks_free(b);
        return st;
    }
    fret_annulus_touch(&b->ring);
    b->count = 1;
    if (!run->count++)
        run->step = 0.01 * fret_annulus_norm(&b->ring, b->ring.w) / fret_annulus_norm(&b->ring, rates(b, 0));
    run->tried = 0;
    return st;
}

/* The last node that sticks if c grows (F_N and delta_A held), else 0. */
static size_t stick_end(const fret_wear_run *run) {
    const fret_annulus *a = &last_of(run)->ring;
    size_t i = 0;
    while (run->held.by_displacement && !run->held.by_depth && i + 2 < a->count && !(a->slip[i + 1] > 0))
        i++;
    return i;
}

static fret_status widen(fret_wear_run *run) {
    const fret_annulus *a = &last_of(run)->ring;
    const fret_real inner = a->x[0], outer = a->x[a->count - 1], end = fret_normal_end(run->normal);
    if (!(outer < end))
        return fret_fail(FRET_TABLE_SHORT, "r", (double)outer, (double)end);
    return fret_blocks_begin(run, inner, a->x[stick_end(run)],
                             fminl(sqrtl(inner * inner + 1.5L * (outer - inner) * (outer + inner)), end));
}

/* ---- running ----------------------------------------------------------------------------------- */

fret_status fret_blocks_go_on(fret_wear_run *run) {
    fret_blocks *b = &run->blocks[run->count - 1];
    fret_annulus *a = &b->ring;
    const fret_status room = make_room(b);
    if (room.code)
        return room;
    const double *h = depths(b, b->count - 1), *rate = rates(b, b->count - 1),
                 done = fret_blocks_reached(run), size = fret_annulus_norm(a, rate);
    double *next = depths(b, b->count), *next_rate = rates(b, b->count);
    /* even a thousand times as many cycles would wear less than the tolerance */
    run->arrived = !(size > 0) || done * size < LATE * run->tolerance * fret_annulus_norm(a, h);
    if (run->arrived)
        return fret_ok();
    if (run->tried % 8 == 0)
        run->fastest = fret_annulus_stiffness(a, run->stiff);
    const double step = fmin(run->step, 0.65 * (STAGES * STAGES - 1) / run->fastest);
    const int stages = (int)fmax(2, ceil(sqrt(1 + step * run->fastest / 0.65)));
    const fret_status tried =
        run_block(a, run->nodes + 1, h, rate, step, stages, next, run->before, next_rate);
    const double off =
        tried.code ? INFINITY : error_of(a, h, rate, next, next_rate, step, run->before) / run->tolerance;
    if (tried.code && !(step > 1e-6 * done))
        return tried;
    if (run->rates + stages > RATES || !(off >= 0))
        return fret_fail(FRET_OUTSIDE, "cycles", done + step, done);
    if (off <= 1 && a->w[a->count - 1] > 0)
        return widen(run);
    run->rates += stages;
    run->tried++;
    run->step = step * fmin(1.5, fmax(0.2, 0.8 / sqrt(fmax(off, 1e-9))));
    if (off <= 1) {
        *cycles(b, b->count++) = done + step;
        fret_annulus_touch(a);
        const size_t i = stick_end(run);
        if (i > 0 && a->x[i + 1] - a->x[i] > FOLLOW * run->tolerance * (a->x[a->count - 1] - a->x[0]))
            return fret_blocks_begin(run, a->x[0], a->x[i], a->x[a->count - 1]);
    }
    return fret_ok();
}

fret_annulus *fret_blocks_at(const fret_wear_run *run, double n, double *h) {
    fret_blocks *b = &run->blocks[run->count - 1];
    while (b > run->blocks && *cycles(b, 0) > n)
        b--;
    size_t i = b->count - 1;
    while (i > 0 && *cycles(b, i) > n)
        i--;
    const size_t end = i + 1 < b->count ? i + 1 : i;
    const double *from = depths(b, i), *to = depths(b, end), *rate = rates(b, i), *next = rates(b, end),
                 step = *cycles(b, end) - *cycles(b, i), t = step > 0 ? (n - *cycles(b, i)) / step : 0,
                 rest = 1 - t;
    for (size_t j = 0; j <= b->ring.count; j++) { /* the clamp keeps depths monotone */
        const double at = rest * rest * ((1 + 2 * t) * from[j] + t * step * rate[j]) +
                          t * t * ((1 + 2 * rest) * to[j] - rest * step * next[j]);
        h[j] = fmin(fmax(at, from[j]), fmax(to[j], from[j]));
    }
    return &b->ring;
}
