/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "fret/cycle.h"

#include <float.h>

#include "special.h"

/* t = F/(mu F_N) with s = 1-t to full relative accuracy: near gross slip the rounding of the
 * product mu F_N matters, so it is carried along. */
typedef struct fraction {
    fret_real t, s;
} fraction;

/* 0.3 times 100 N is not 30 N in binary: F equal to mu F_N up to its rounding is gross slip, no more. */

static fraction fraction_of(double mu, fret_real FN, fret_real F) {
    fret_real limit = mu * FN, rest = fmal(mu, FN, -limit);
    fret_real s = ((limit - F) + rest) / limit;
    return fabsl(s) <= DBL_EPSILON ? (fraction){1, 0} : (fraction){F / limit, s};
}

fret_real fret_gross_slip(const fret_normal *normal, double mu, const fret_press *press) {
    return mu * normal->foundation.eta * press->dz;
}

static fret_status check_friction(double mu, const fret_press *press) {
    fret_status st = fret_check_positive("mu", mu);
    if (!st.code)
        st = fret_check_positive("FN", (double)press->F);
    return st;
}

fret_status fret_loading_force(const fret_normal *normal, double mu, const fret_press *press, double Fx,
                               fret_loading *out) {
    fret_status st = check_friction(mu, press);
    if (!st.code && !isfinite(Fx))
        st = fret_fail(FRET_NOT_FINITE, "Fx", Fx, 0);
    if (st.code)
        return st;
    fraction f = fraction_of(mu, press->F, fabsl((fret_real)Fx));
    if (f.s < 0)
        return fret_fail(FRET_GROSS_SLIP, "Fx", Fx, (double)(mu * press->F));
    fret_real x; /* 1 - yc/dz */
    if (normal->p > 0) {
        fret_real l = f.t <= 0.5L ? log1pl(-f.t) : logl(f.s);
        x = f.s > 0 ? -expm1l(normal->q * l) : 1;
        out->c = f.s > 0 ? press->a * expl(l / normal->s) : 0;
        out->yc = f.s > 0 ? press->dz * expl(normal->q * l) : 0;
    } else {
        fret_real w = f.t <= 0.5L ? f.t * press->F : press->F - f.s * press->F;
        x = f.s > 0 ? fret_law_thickness(normal, &(fret_level){press->dz, press->F}, w) / press->dz : 1;
        out->yc = f.s > 0 ? fret_law_depth(normal, f.s * press->F) : 0;
        out->c = f.s > 0 ? fret_law_radius(normal, out->yc) : 0;
    }
    out->Fx = Fx;
    out->dx = copysignl(fret_gross_slip(normal, mu, press) * x, Fx);
    return fret_ok();
}

fret_status fret_loading_displacement(const fret_normal *normal, double mu, const fret_press *press,
                                      double dx, fret_loading *out) {
    fret_status st = check_friction(mu, press);
    if (!st.code && !isfinite(dx))
        st = fret_fail(FRET_NOT_FINITE, "dx", dx, 0);
    if (st.code)
        return st;
    fret_real max = fret_gross_slip(normal, mu, press), x = fabsl((fret_real)dx) / max;
    out->dx = dx;
    if (x >= 1) {
        out->Fx = copysignl(mu * press->F, dx);
        out->c = out->yc = 0;
        return fret_ok();
    }
    out->yc = press->dz * (1 - x);
    out->Fx = copysignl(mu * fret_law_load(normal, &(fret_level){press->dz, press->F}, x * press->dz), dx);
    out->c = normal->p > 0 ? press->a * expl(log1pl(-x) / normal->gap.power[0].n)
                           : fret_law_radius(normal, out->yc);
    return fret_ok();
}

/* Small L: series without cancellation. Otherwise the closed form, arranged for q <= 1/2 and > 1/2. */
fret_real fret_loss_shape(fret_real q, fret_real r, fret_real t, fret_real s) {
    if (t <= 0)
        return 0;
    if (s <= 0)
        return 4 * r / (1 + q);
    fret_real l = t <= 0.5L ? -log1pl(-t) : -logl(s);
    if (l < 3.5L) {
        fret_real alpha = (1 + q) * l / 2, a2 = alpha * alpha, b2 = (r * l / 2) * (r * l / 2);
        fret_real h = 1, power = 1, factorial = 6, sum = h / factorial;
        for (int j = 1; j < 40; j++) {
            power *= b2;
            h = a2 * h + power;
            factorial *= (2 * j + 2) * (2 * j + 3);
            fret_real old = sum;
            sum += h / factorial;
            if (sum == old)
                break;
        }
        return 4 * q * r * l * l * l * expl(-alpha) * sum;
    }
    if (q <= 0.5L) {
        fret_real y = expm1l(-q * l);
        return 4 / (1 + q) * (-(1 + s) * y - q * t * (2 + y));
    }
    fret_real y = expl(-q * l);
    return 4 / (1 + q) * (r * t * (1 + y) - 2 * s * expm1l(r * l));
}

/* The general loop by Masing: 8 times the dissipation of first loading counted from the edge,
 * int_0^d [F(y)-F(y-t)-tK(y-t)] dt = L. */
static fret_real loss_of(const fret_normal *normal, double mu, const fret_press *press, fraction f) {
    fret_real scale = mu * press->F * fret_gross_slip(normal, mu, press);
    if (normal->p > 0)
        return scale * fret_loss_shape(normal->q, normal->pm1 * normal->q, f.t, f.s);
    fret_level edge = {press->dz, press->F};
    fret_real d = fret_law_thickness(normal, &edge, fminl(f.t, 1) * press->F);
    return 4 * mu * (mu * normal->foundation.eta) * fret_law_slice(normal, &edge, d).L;
}

fret_status fret_cycle_loss(const fret_normal *normal, double mu, const fret_press *press, double FA,
                            fret_real *loss) {
    fret_status st = check_friction(mu, press);
    if (!st.code)
        st = fret_check_not_negative("FA", FA);
    if (st.code)
        return st;
    fraction f = fraction_of(mu, press->F, FA);
    if (f.s < 0)
        return fret_fail(FRET_GROSS_SLIP, "FA", FA, (double)(mu * press->F));
    *loss = loss_of(normal, mu, press, f);
    return fret_ok();
}

fret_status fret_cycle_loss_displacement(const fret_normal *normal, double mu, const fret_press *press,
                                         double dA, fret_real *loss) {
    fret_status st = check_friction(mu, press);
    if (!st.code)
        st = fret_check_not_negative("dxA", dA);
    if (st.code)
        return st;
    fret_real max = fret_gross_slip(normal, mu, press), x = dA / max;
    if (x >= 1) {
        *loss = loss_of(normal, mu, press, (fraction){1, 0}) + 4 * mu * press->F * (dA - max);
        return fret_ok();
    }
    fret_real t = fret_law_load(normal, &(fret_level){press->dz, press->F}, x * press->dz) / press->F;
    fret_real s = normal->p > 0 ? expl(normal->p * log1pl(-x)) : 1 - t;
    *loss = loss_of(normal, mu, press, (fraction){t, s});
    return fret_ok();
}
