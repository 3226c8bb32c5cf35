/* SPDX-License-Identifier: GPL-3.0-or-later */
/* First loading, gross slip and the loss per cycle at constant F_N, as functions of the fraction t of gross
 * slip: closed forms for power laws, the law of normal.h for other shapes. */
#include "fret/cycle.h"

#include <float.h>

#include "law/check.h"
#include "law/normal.h"
#include "number/real.h"

/* t; s = 1-t to full relative accuracy, for which the rounding of mu F_N matters near gross slip; l = ln s,
 * finite if s is too small for a double. */
typedef struct fraction {
    dd t, s, l;
    fret_real t_wide; /* t, in the range of long double */
} fraction;

/* Below this ln(1-t) = -t, and products of these numbers may underflow in double. */
static const double tiny = 1e-40;

static fraction fraction_from(dd t, dd s) {
    fraction f = {t, s, {-INFINITY, 0}, dd_value(t)};
    if (s.hi > 0)
        f.l = t.hi < tiny ? dd_neg(t) : t.hi <= 0.5 ? fret_dd_log1p(dd_neg(t)) : fret_dd_log(s);
    return f;
}

/* t = F/limit; the logarithm for a power law alone. */
static fraction fraction_of(const fret_pressed *c, double F, dd limit) {
    const dd t = dd_div(dd_of(F), limit), s = dd_div(dd_add_d(limit, -F), limit);
    fraction f = fret_normal_closed(c->normal) ? fraction_from(t, s) : (fraction){t, s, s, dd_value(t)};
    if (f.t.hi < tiny)
        f.t_wide = F / dd_value(limit);
    return f;
}

/* 0.3 times 100 N is not 30 N in binary: F equal to mu F_N up to rounding counts as gross slip. */
static fraction force_fraction(const fret_pressed *c, double F) {
    fraction f = fraction_of(c, F, dd_mul_d(dd_from2(c->press.F, c->press.F_rest), c->mu));
    return fabs(f.s.hi) <= DBL_EPSILON ? fraction_from(dd_of(1), dd_of(0)) : f;
}

static bool gross(const fraction *f) {
    return isinf(f->l.hi);
}

/* 1-s^power, and s^power */
static fret_real lost(const fraction *f, dd power) {
    if (gross(f))
        return 1;
    if (f->t.hi < tiny)
        return dd_value(power) * f->t_wide;
    return -dd_value(fret_dd_expm1(dd_mul(power, f->l)));
}
static fret_real kept(const fraction *f, dd power) {
    return gross(f) ? 0 : fret_dd_exp_real(dd_mul(power, f->l));
}

fret_real fret_gross_slip(const fret_pressed *c) {
    return c->mu * c->normal->foundation.eta * c->press.dz;
}

fret_status fret_loading_by_force(const fret_pressed *c, double Fx, fret_loading *out) {
    fret_status st = fret_contact_check(c);
    if (!st.code && !isfinite(Fx))
        st = fret_fail(FRET_NOT_FINITE, "Fx", Fx, 0);
    if (st.code)
        return st;
    fraction f = force_fraction(c, fabs(Fx));
    if (f.s.hi < 0)
        return fret_fail(FRET_GROSS_SLIP, "Fx", Fx, (double)(c->mu * c->press.F));
    fret_real x; /* 1 - yc/dz */
    if (fret_normal_closed(c->normal)) {
        x = lost(&f, c->normal->wide.q);
        out->c = c->press.a * kept(&f, dd_div(dd_of(1), c->normal->wide.s));
        out->yc = c->press.dz * kept(&f, c->normal->wide.q);
    } else {
        const fret_real s = dd_value(f.s);
        fret_real w = f.t.hi <= 0.5 ? dd_value(f.t) * c->press.F : c->press.F - s * c->press.F;
        x = s > 0 ? fret_law_thickness(c->normal, &(fret_level){c->press.dz, c->press.F}, w) / c->press.dz
                  : 1;
        const fret_point inner = fret_law_at_force(c->normal, s * c->press.F);
        out->yc = inner.y;
        out->c = s > 0 ? inner.a : 0;
    }
    out->Fx = Fx;
    out->dx = copysignl(fret_gross_slip(c) * x, Fx);
    return fret_unless_stopped(c->normal, fret_ok());
}

/* For a displacement: t = dx/delta_x,max. */
static fraction depth_fraction(const fret_pressed *c, double dx) {
    dd max = dd_mul(dd_mul_d(c->normal->wide_foundation.eta, c->mu), dd_from2(c->press.dz, c->press.dz_rest));
    return fraction_of(c, dx, max);
}

fret_status fret_loading_by_displacement(const fret_pressed *c, double dx, fret_loading *out) {
    fret_status st = fret_contact_check(c);
    if (!st.code && !isfinite(dx))
        st = fret_fail(FRET_NOT_FINITE, "dx", dx, 0);
    if (st.code)
        return st;
    fraction f = depth_fraction(c, fabs(dx));
    out->dx = dx;
    if (f.s.hi <= 0) {
        out->Fx = copysignl(c->mu * c->press.F, dx);
        out->c = out->yc = 0;
        return fret_ok();
    }
    const fret_real x = f.t_wide;
    out->yc = c->press.dz * dd_value(f.s);
    if (fret_normal_closed(c->normal)) {
        out->Fx = copysignl(c->mu * c->press.F * lost(&f, c->normal->wide.p), dx);
        out->c = c->press.a * kept(&f, dd_div(dd_of(1), dd_of(c->normal->gap.power[0].n)));
    } else {
        out->Fx = copysignl(
            c->mu * fret_law_load(c->normal, &(fret_level){c->press.dz, c->press.F}, x * c->press.dz), dx);
        out->c = fret_law_radius(c->normal, out->yc);
    }
    return fret_unless_stopped(c->normal, fret_ok());
}

/* The loss w(t) of a power law, with q = n/(n+k+1), r = 1-q: for -ln s < 3.5 a series of positive terms, else
 * (27), arranged for either size of q. */
static fret_real loss_of_power(const fret_normal *n, const fraction *f) {
    const dd q_wide = n->wide.q, r_wide = dd_div(dd_sum(1, (double)n->foundation.k), n->wide.s);
    const fret_real q = dd_value(q_wide), r = dd_value(r_wide), t = f->t_wide, s = dd_value(f->s);
    if (t <= 0)
        return 0;
    if (gross(f))
        return 4 * r / (1 + q);
    fret_real l = f->t.hi < tiny ? t : -dd_value(f->l);
    if (l < 3.5L) {
        fret_real alpha = (1 + q) * l / 2, a2 = alpha * alpha, b2 = (r * l / 2) * (r * l / 2);
        fret_real h = 1, power = 1, factorial = 6, sum = h / factorial, old;
        int j = 1;
        do { /* positive terms, which fall ever faster */
            power *= b2;
            h = a2 * h + power;
            factorial *= (2 * j + 2) * (2 * j + 3);
            old = sum;
            sum += h / factorial;
            j++;
        } while (sum > old);
        return 4 * q * r * l * l * l * expl(-alpha) * sum;
    }
    if (q <= 0.5L) {
        fret_real y = -lost(f, q_wide);
        return 4 / (1 + q) * (-(1 + s) * y - q * t * (2 + y));
    }
    fret_real y = kept(f, q_wide);
    return 4 / (1 + q) * (r * t * (1 + y) - 2 * s * dd_value(fret_dd_expm1(dd_neg(dd_mul(r_wide, f->l)))));
}

/* The loss for any shape, by Masing's rule 4 times that of first loading: with t the depth below the edge it
 * is int_0^d [F(y)-F(y-t)-tK(y-t)] dt = L. f: a fraction of load or of depth. */
static fret_real general_loss(const fret_pressed *c, bool by_load, const fraction *f) {
    const fret_level edge = {c->press.dz, c->press.F};
    const fret_real whole = by_load ? edge.F : edge.y, s = dd_value(f->s), t = fminl(f->t_wide, 1);
    fret_place at[2] = {fret_law_place(c->normal, c->press.a), {0, 0}};
    return 4 * c->mu * (c->mu * c->normal->foundation.eta) *
           fret_law_slice_to(c->normal, &edge, by_load, t * whole, s * whole, at).L;
}

static fret_real loss_of(const fret_pressed *c, const fraction *f) {
    fret_real scale = c->mu * c->press.F * fret_gross_slip(c);
    if (fret_normal_closed(c->normal))
        return scale * loss_of_power(c->normal, f);
    return general_loss(c, true, f);
}

fret_status fret_cycle_loss_by_force(const fret_pressed *c, double FA, fret_real *loss) {
    fret_status st = fret_contact_check(c);
    if (!st.code)
        st = fret_check_not_negative("FA", FA);
    if (st.code)
        return st;
    fraction f = force_fraction(c, FA);
    if (f.s.hi < 0)
        return fret_fail(FRET_GROSS_SLIP, "FA", FA, (double)(c->mu * c->press.F));
    *loss = loss_of(c, &f);
    return fret_unless_stopped(c->normal, fret_ok());
}

fret_status fret_cycle_loss_by_displacement(const fret_pressed *c, double dA, fret_real *loss) {
    fret_status st = fret_contact_check(c);
    if (!st.code)
        st = fret_check_not_negative("dxA", dA);
    if (st.code)
        return st;
    fraction f = depth_fraction(c, dA);
    if (f.s.hi <= 0) {
        const fret_real slid = -dd_value(f.s) * fret_gross_slip(c);
        f = fraction_from(dd_of(1), dd_of(0));
        *loss = loss_of(c, &f) + 4 * c->mu * c->press.F * slid;
        return fret_ok();
    }
    if (!fret_normal_closed(c->normal)) {
        *loss = general_loss(c, false, &f);
        return fret_unless_stopped(c->normal, fret_ok());
    }
    const fret_real t = lost(&f, c->normal->wide.p), s = kept(&f, c->normal->wide.p); /* s^p, of load */
    f = (fraction){dd_from(t), dd_from(s), dd_mul(c->normal->wide.p, f.l), t};
    *loss = loss_of(c, &f);
    return fret_unless_stopped(c->normal, fret_ok());
}
