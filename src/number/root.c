/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Root finding: see root.h. Pure arithmetic. */
#include "number/root.h"

#include <float.h>
#include <math.h>
#include <stdbool.h>

typedef struct sample {
    fret_real x, f, slope;
} sample;

static sample evaluate(fret_function *f, void *context, fret_real x) {
    sample p = {.x = x};
    p.f = f(x, &p.slope, context);
    return p;
}

fret_real fret_root(fret_function *f, void *context, fret_real lo, fret_real hi, fret_real guess) {
    const sample first = evaluate(f, context, lo), other = evaluate(f, context, hi);
    const bool rises = first.f < 0;
    fret_real step = hi - lo, before = step;
    sample last = other;
    if (first.f == 0 || other.f == 0)
        return first.f == 0 ? lo : hi;
    sample now = first;
    fret_real next = guess > lo && guess < hi ? guess : lo + (hi - lo) / 2;
    for (;;) {
        last = now;
        now = evaluate(f, context, next);
        if (now.f == 0)
            return now.x;
        *((now.f < 0) == rises ? &lo : &hi) = now.x;
        const fret_real slope = now.slope != 0 ? now.slope : (now.f - last.f) / (now.x - last.x),
                        mid = lo + (hi - lo) / 2;
        next = now.x - now.f / slope;
        if (fabsl(next - now.x) <= LDBL_EPSILON * fabsl(now.x))
            return next;
        if (!(next > lo && next < hi && fabsl(next - now.x) <= before / 2))
            next = mid;
        if (!(next > lo && next < hi))
            return mid;
        before = step;
        step = fabsl(next - now.x);
    }
}

typedef struct in_double {
    double (*f)(double x, void *context);
    void *context;
    double at; /* the x evaluated last */
} in_double;

static fret_real value_in_double(fret_real x, fret_real *slope, void *context) {
    in_double *d = context;
    const bool again = (double)x == d->at; /* converged */
    (void)slope;
    d->at = (double)x;
    return again ? 0 : d->f(d->at, d->context);
}

double fret_root_double(double (*f)(double x, void *context), void *context, double lo, double hi) {
    in_double d = {f, context, NAN};
    return (double)fret_root(value_in_double, &d, lo, hi, NAN);
}
