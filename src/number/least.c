/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Golden-section search. Pure arithmetic. */
#include "number/least.h"

#include <stdbool.h>

fret_real fret_least(fret_function *f, void *context, fret_real lo, fret_real hi, fret_real guess,
                     fret_real part) {
    static const fret_real GOLDEN = 0.38196601125010515L;
    const fret_real enough = part * (hi - lo);
    fret_real slope = 0, best = guess, least = f(best, &slope, context);
    while (hi - lo > enough) {
        const bool up = hi - best > best - lo;
        const fret_real x = best + GOLDEN * ((up ? hi : lo) - best);
        if (x == best) /* no number lies between */
            break;
        const fret_real now = f(x, &slope, context);
        const bool better = now < least;
        *(up == better ? &lo : &hi) = better ? best : x;
        if (better) {
            best = x;
            least = now;
        }
    }
    return best;
}
