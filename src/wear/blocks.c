/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Blocks of cycles: what wears fast where it is pressed decays far faster than the whole, which Runge-Kutta-
 * Chebyshev's explicit steps of second order bear, in as many stages as the root of that ratio. Allocates,
 * and frees what it allocated. */
#include "wear/blocks.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "law/check.h"

enum { STAGES = 250, RATES = 200000 };
static const double LATE = 1e-3;

/* y after a block of `cycles` from y0, whose rate is rate0, in `stages` (Sommeijer, Shampine, Verwer 1997).
 * before, rate: room. */
static fret_status block(fret_annulus *a, size_t n, const double *y0, const double *rate0, double cycles,
                         int stages, double *y, double *before, double *rate) {
    const double w0 = 1 + 2 / 13.0 / stages / stages, root = sqrt(w0 * w0 - 1), arg = stages * log(w0 + root),
                 w1 = sinh(arg) * root * root / (cosh(arg) * stages * root - w0 * sinh(arg));
    double T[3] = {0, w0, 1}, d[3] = {0, 1, 0}, d2[3] = {0, 0, 0}; /* of the stage, the last, that before */
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

/* How far a block is off, as a part of what it has worn, or of little of all: what is worn off is no longer
 * to be told from what it was. */
static double error_of(const fret_annulus *a, const double *y0, const double *rate0, const double *y,
                       const double *rate, double cycles, double *room) {
    static const double little = 0.02;
    for (size_t i = 0; i < a->count; i++)
        room[i] = 0.8 * (y0[i] - y[i]) + 0.4 * cycles * (rate0[i] + rate[i]);
    const double off = fret_annulus_norm(a, room);
    for (size_t i = 0; i < a->count; i++)
        room[i] = y[i] - y0[i];
    return off > 0 ? off / fmax(fret_annulus_norm(a, room), little * fret_annulus_norm(a, y)) : off;
}

fret_status fret_blocks_run(fret_annulus *a, double *h, double cycles, double tolerance, fret_stop stop,
                            fret_wear_told told, void *user, bool *full) {
    const size_t n = a->count + 1;
    double *room = calloc(6 * n, sizeof *room), *rate = room, *next = room + n, *next_rate = room + 2 * n,
           *before = room + 3 * n, *v = room + 4 * n, *spare = room + 5 * n;
    double done = 0, fastest = 0;
    long rates = 0;
    *full = false;
    if (!room)
        return fret_fail(FRET_NO_MEMORY, NULL, 0, 0);
    fret_status st = fret_annulus_rate(a, h, rate);
    const double size = st.code ? 0 : fret_annulus_norm(a, rate);
    double step = size > 0 ? 0.01 * fret_annulus_norm(a, a->w) / size : cycles;
    fret_annulus_touch(a);
    for (int blocks = 0; !st.code && done < cycles; blocks++) {
        *full = a->touched + 1 >= a->count;
        /* a thousand times as many would wear next to nothing: it has arrived */
        if (*full || (done > LATE * cycles &&
                      done * fret_annulus_norm(a, rate) < LATE * tolerance * fret_annulus_norm(a, h)))
            break;
        if (blocks % 8 == 0)
            fastest = fret_annulus_stiffness(a, v);
        step = fmin(fmin(step, 0.65 * (STAGES * STAGES - 1) / fastest), cycles - done);
        const int stages = (int)fmax(2, ceil(sqrt(1 + step * fastest / 0.65)));
        const fret_status tried = block(a, n, h, rate, step, stages, next, before, next_rate);
        const double off =
            tried.code ? INFINITY : error_of(a, h, rate, next, next_rate, step, spare) / tolerance;
        rates += stages;
        if (off <= 1) {
            done = step < cycles - done ? done + step : cycles;
            memcpy(h, next, n * sizeof *h);
            memcpy(rate, next_rate, n * sizeof *rate);
            fret_annulus_touch(a);
            if (told)
                told(done, user);
        } else if (tried.code && !(step > 1e-6 * done)) {
            st = tried;
        }
        if (stop && *stop)
            st = fret_fail(FRET_INTERRUPTED, NULL, 0, 0);
        else if (!st.code && (rates > RATES || !(off >= 0)))
            st = fret_fail(FRET_OUTSIDE, "cycles", cycles, done);
        step *= fmin(3, fmax(0.2, 0.8 / sqrt(fmax(off, 1e-9))));
    }
    free(room);
    return st;
}
