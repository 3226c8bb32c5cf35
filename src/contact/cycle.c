/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "fret/cycle.h"

#include <float.h>

#include "dd.h"
#include "special.h"

/* t, its complement s = 1-t to full relative accuracy (near gross slip the rounding of the product mu F_N
 * matters), and ln s, which stays finite where s itself is too small for a double. */
typedef struct fraction {
    dd t, s, l;
    fret_real t_wide; /* t in the range of long double */
} fraction;

/* Below this ln(1-t) is -t, and products of such numbers may leave the range of double. */
static const double tiny = 1e-40;

static fraction fraction_from(dd t, dd s) {
    fraction f = {t, s, {-INFINITY, 0}, dd_value(t)};
    if (s.hi > 0)
        f.l = t.hi < tiny ? dd_neg(t) : t.hi <= 0.5 ? dd_log1p(dd_neg(t)) : dd_log(s);
    return f;
}

/* F of limit */
static fraction fraction_of(double F, dd limit) {
    fraction f = fraction_from(dd_div(dd_of(F), limit), dd_div(dd_add_d(limit, -F), limit));
    if (f.t.hi < tiny)
        f.t_wide = F / dd_value(limit);
    return f;
}

/* 0.3 times 100 N is not 30 N in binary: F equal to mu F_N up to its rounding is gross slip, no more. */
static fraction force_fraction(double mu, const fret_press *press, double F) {
    fraction f = fraction_of(F, dd_mul_d(dd_from2(press->F, press->F_rest), mu));
    return fabs(f.s.hi) <= DBL_EPSILON ? fraction_from(dd_of(1), dd_of(0)) : f;
}

static bool gross(const fraction *f) {
    return isinf(f->l.hi);
}

/* 1-exp(power ln s), and exp(power ln s) */
static fret_real lost(const fraction *f, dd power) {
    if (gross(f))
        return 1;
    if (f->t.hi < tiny)
        return dd_value(power) * f->t_wide;
    return -dd_value(dd_expm1(dd_mul(power, f->l)));
}
static fret_real kept(const fraction *f, dd power) {
    return gross(f) ? 0 : dd_exp_real(dd_mul(power, f->l));
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
    fraction f = force_fraction(mu, press, fabs(Fx));
    if (f.s.hi < 0)
        return fret_fail(FRET_GROSS_SLIP, "Fx", Fx, (double)(mu * press->F));
    fret_real x; /* 1 - yc/dz */
    if (normal->p > 0) {
        x = lost(&f, normal->wide.q);
        out->c = press->a * kept(&f, dd_div(dd_of(1), normal->wide.s));
        out->yc = press->dz * kept(&f, normal->wide.q);
    } else {
        const fret_real s = dd_value(f.s);
        fret_real w = f.t.hi <= 0.5 ? dd_value(f.t) * press->F : press->F - s * press->F;
        x = s > 0 ? fret_law_thickness(normal, &(fret_level){press->dz, press->F}, w) / press->dz : 1;
        out->yc = s > 0 ? fret_law_depth(normal, s * press->F) : 0;
        out->c = s > 0 ? fret_law_radius(normal, out->yc) : 0;
    }
    out->Fx = Fx;
    out->dx = copysignl(fret_gross_slip(normal, mu, press) * x, Fx);
    return fret_ok();
}

/* The same by displacement: t = dx/delta_x,max, s = 1-t. */
static fraction depth_fraction(const fret_normal *normal, double mu, const fret_press *press, double dx) {
    dd max = dd_mul(dd_mul_d(normal->foundation.wide.eta, mu), dd_from2(press->dz, press->dz_rest));
    return fraction_of(dx, max);
}

fret_status fret_loading_displacement(const fret_normal *normal, double mu, const fret_press *press,
                                      double dx, fret_loading *out) {
    fret_status st = check_friction(mu, press);
    if (!st.code && !isfinite(dx))
        st = fret_fail(FRET_NOT_FINITE, "dx", dx, 0);
    if (st.code)
        return st;
    fraction f = depth_fraction(normal, mu, press, fabs(dx));
    out->dx = dx;
    if (f.s.hi <= 0) {
        out->Fx = copysignl(mu * press->F, dx);
        out->c = out->yc = 0;
        return fret_ok();
    }
    const fret_real x = f.t_wide;
    out->yc = press->dz * dd_value(f.s);
    if (normal->p > 0) {
        out->Fx = copysignl(mu * press->F * lost(&f, normal->wide.p), dx);
        out->c = press->a * kept(&f, dd_div(dd_of(1), dd_of(normal->gap.power[0].n)));
    } else {
        out->Fx =
            copysignl(mu * fret_law_load(normal, &(fret_level){press->dz, press->F}, x * press->dz), dx);
        out->c = fret_law_radius(normal, out->yc);
    }
    return fret_ok();
}

/* Small L: series without cancellation. Otherwise the closed form, arranged for q <= 1/2 and > 1/2. */
static fret_real loss_shape(dd q_wide, dd r_wide, const fraction *f) {
    const fret_real q = dd_value(q_wide), r = dd_value(r_wide), t = f->t_wide, s = dd_value(f->s);
    if (t <= 0)
        return 0;
    if (gross(f))
        return 4 * r / (1 + q);
    fret_real l = f->t.hi < tiny ? t : -dd_value(f->l);
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
        return 4 * q * r * l * l * l * fret_exp(-alpha) * sum;
    }
    if (q <= 0.5L) {
        fret_real y = -lost(f, q_wide);
        return 4 / (1 + q) * (-(1 + s) * y - q * t * (2 + y));
    }
    fret_real y = kept(f, q_wide);
    return 4 / (1 + q) * (r * t * (1 + y) - 2 * s * dd_value(dd_expm1(dd_neg(dd_mul(r_wide, f->l)))));
}

fret_real fret_loss_shape(fret_real q, fret_real r, fret_real t, fret_real s) {
    fraction f = fraction_from(dd_from(t), dd_from(s));
    return loss_shape(dd_from(q), dd_from(r), &f);
}

/* What of a power law the loss depends on: r = 1-q. */
static fret_real loss_of_power(const fret_normal *normal, const fraction *f) {
    dd r = dd_div(dd_sum(1, (double)normal->foundation.k), normal->wide.s);
    return loss_shape(normal->wide.q, r, f);
}

/* The general loop by Masing: 4 times the dissipation of first loading, counted from the edge:
 * int_0^d [F(y)-F(y-t)-tK(y-t)] dt = L. */
static fret_real loss_of(const fret_normal *normal, double mu, const fret_press *press, const fraction *f) {
    fret_real scale = mu * press->F * fret_gross_slip(normal, mu, press);
    if (normal->p > 0)
        return scale * loss_of_power(normal, f);
    fret_level edge = {press->dz, press->F};
    fret_real d = fret_law_thickness(normal, &edge, fminl(dd_value(f->t), 1) * press->F);
    return 4 * mu * (mu * normal->foundation.eta) * fret_law_slice(normal, &edge, d).L;
}

fret_status fret_cycle_loss(const fret_normal *normal, double mu, const fret_press *press, double FA,
                            fret_real *loss) {
    fret_status st = check_friction(mu, press);
    if (!st.code)
        st = fret_check_not_negative("FA", FA);
    if (st.code)
        return st;
    fraction f = force_fraction(mu, press, FA);
    if (f.s.hi < 0)
        return fret_fail(FRET_GROSS_SLIP, "FA", FA, (double)(mu * press->F));
    *loss = loss_of(normal, mu, press, &f);
    return fret_ok();
}

fret_status fret_cycle_loss_displacement(const fret_normal *normal, double mu, const fret_press *press,
                                         double dA, fret_real *loss) {
    fret_status st = check_friction(mu, press);
    if (!st.code)
        st = fret_check_not_negative("dxA", dA);
    if (st.code)
        return st;
    fraction f = depth_fraction(normal, mu, press, dA);
    if (f.s.hi <= 0) {
        const fret_real slid = -dd_value(f.s) * fret_gross_slip(normal, mu, press);
        f = fraction_from(dd_of(1), dd_of(0));
        *loss = loss_of(normal, mu, press, &f) + 4 * mu * press->F * slid;
        return fret_ok();
    }
    if (normal->p > 0) { /* s^p in place of s */
        const fret_real t = lost(&f, normal->wide.p), s = kept(&f, normal->wide.p);
        f = (fraction){dd_from(t), dd_from(s), dd_mul(normal->wide.p, f.l), t};
    } else {
        const fret_real x = f.t_wide, F = press->F;
        f = (fraction){.t = dd_from(fret_law_load(normal, &(fret_level){press->dz, F}, x * press->dz) / F)};
        f.s = dd_sub(dd_of(1), f.t);
    }
    *loss = loss_of(normal, mu, press, &f);
    return fret_ok();
}
