/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The loss per cycle by quadrature of its definition: shares only the slip front with the closed forms.
 * Pure. */
#include <float.h>

#include "fret/cycle.h"
#include "law/check.h"
#include "law/normal.h"
#include "number/integral.h"
#include "number/real.h"

/* The slip annulus. For a power law in depths relative to delta_z, from yc to 1 with X = 1-yc, where both
 * brackets are distances from the ends and keep every digit. For other shapes in radii, as distances from the
 * start of the gap, since depths may jump there. */
typedef struct annulus {
    const fret_normal *normal;
    fret_real p, pm1; /* F_N ~ delta_z^p, p-1 */
    fret_real yc, X;
    fret_real start, inner, outer, g_inner, g_outer;
} annulus;

/* (1-y) (y-yc) K'(y)/X^2 in units of F_N, K' = p (p-1) y^(p-2) */
static fret_real by_depth(fret_real t, fret_real rest, void *context) {
    const annulus *s = context;
    const fret_real from_edge = s->X * rest, y = s->yc + s->X * t,
                    log = from_edge < 0.5L ? log1pl(-from_edge) : logl(y);
    return s->p * s->pm1 * expl((s->pm1 - 1) * log) * t * rest;
}

static fret_real profile(const annulus *s, fret_real e) {
    return e > 0 ? fret_gap_profile(&s->normal->gap, &s->normal->rule, e).g : 0;
}

/* 2 (x/c0)^k (g(a)-g(x)) (g(x)-g(c)) */
static fret_real by_radius(fret_real t, fret_real rest, void *context) {
    const annulus *s = context;
    const fret_foundation *f = &s->normal->foundation;
    const fret_real e = s->inner * rest + s->outer * t;
    if (e <= 0 || fret_stopped(s->normal))
        return 0;
    const fret_real g = profile(s, e);
    return 2 * fret_pow((s->start + e) / f->c0, f->k) * (s->g_outer - g) * (g - s->g_inner);
}

fret_status fret_cycle_loss_by_definition(const fret_pressed *c, const fret_loading *peak, fret_real *loss,
                                          fret_real *error) {
    const fret_status st = fret_contact_check(c);
    if (st.code)
        return st;
    const fret_normal *normal = c->normal;
    const fret_foundation *f = &normal->foundation;
    const bool power = fret_normal_is_power(normal);
    const fret_real max = fret_gross_slip(c), X = fminl(fabsl(peak->dx) / max, 1);
    annulus s = {.normal = normal, .yc = peak->yc / c->press.dz, .X = X};
    fret_real scale = 4 * c->mu * c->press.F * max * X * X * X, lost = 4 * LDBL_EPSILON;
    if (power) {
        const double n = fret_normal_gap(normal)->power[0].n;
        s.pm1 = (f->k + 1) / n;
        s.p = 1 + s.pm1;
    } else {
        s.start = fret_gap_start(&normal->gap);
        s.outer = c->press.a - s.start;
        s.inner = fmaxl(peak->c - s.start, 0);
        s.g_outer = profile(&s, s.outer);
        /* beside a flat end the radius c does not resolve g(c) */
        s.g_inner = s.inner > s.start / 64 ? profile(&s, s.inner) : s.g_outer * (1 - X);
        scale = 4 * c->mu * c->mu * f->eta * f->cN0 * (s.outer - s.inner);
        lost *= fmaxl(1, s.start / s.outer) / X; /* lost in differences, near a flat end of radii */
    }
    const fret_estimate sum = fret_integral(power ? by_depth : by_radius, &s, power ? 1e-18L : lost);
    *error = sum.value > 0 ? fmaxl(sum.error / sum.value, lost) : 0;
    *loss = scale * sum.value + 4 * c->mu * c->press.F * fmaxl(fabsl(peak->dx) - max, 0);
    return fret_unless_stopped(normal, fret_ok());
}
