/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Powers of long double by logarithms, and the beta function by double-doubles. Uses libm. */
#include "number/real.h"

#include <math.h>

#include "number/dd.h"

/* powl takes ten times as long. */
fret_real fret_pow(fret_real x, fret_real y) {
    if (!(x > 0 && isfinite(x) && isfinite(y)))
        return powl(x, y);
    return expl(y * logl(x));
}

fret_real fret_ratio_pow(fret_real x, fret_real x0, fret_real y) {
    return fret_dd_exp_real(dd_mul(dd_sub(fret_dd_log_real(x), fret_dd_log_real(x0)), dd_from(y)));
}

/* By Gamma(x) = Gamma(1+x)/x small arguments stay away from the pole. */
fret_real fret_beta(fret_real x, fret_real y) {
    dd a = dd_from(x), b = dd_from(y), c = dd_add(a, b);
    const dd over[] = {dd_add_d(a, 1), dd_add_d(b, 1)}, under[] = {dd_add_d(c, 1)};
    dd_scaled q = fret_dd_gamma_quotient(over, 2, under, 1);
    return fret_dd_exp_real(q.log) * dd_value(q.factor) * (x + y) / x / y;
}
