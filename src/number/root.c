/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The steps of root.h. Pure arithmetic. */
#include "number/root.h"

#include <float.h>
#include <math.h>
#include <stdbool.h>

typedef struct place {
    fret_real x, f, slope;
} place;

static place ask(fret_function *f, void *context, fret_real x) {
    place p = {.x = x};
    p.f = f(x, &p.slope, context);
    return p;
}

fret_real fret_root(fret_function *f, void *context, fret_real lo, fret_real hi, fret_real guess) {
    const place first = ask(f, context, lo), other = ask(f, context, hi);
    const bool rises = first.f < 0;
    fret_real step = hi - lo, before = step;
    place last = other;
    if (first.f == 0 || other.f == 0)
        return first.f == 0 ? lo : hi;
    place now = first;
    fret_real next = guess > lo && guess < hi ? guess : lo + (hi - lo) / 2;
    for (;;) {
        last = now;
        now = ask(f, context, next);
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
