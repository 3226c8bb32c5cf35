/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Pressure, traction and surface displacements by inverse transforms. */
#include "fret/field.h"

#include "contact/check.h"
#include "contact/normal.h"
#include "number/quadrature.h"
#include "number/real.h"

/* The pressure as one or two integrals over a variable t in 0..1 that takes the singular factor of the kernel
 * away. Distances e = x-b from the flat end or the centre. */
typedef struct inside {
    const fret_normal *normal;
    fret_real b, r, from, to, power; /* e from .. to */
} inside;

static fret_real slope_at(const inside *c, fret_real e) {
    return e > 0 ? fret_gap_profile(&c->normal->gap, &c->normal->rule, e).slope : 0;
}

/* (x^2-r^2)^((k-1)/2) */
static fret_real singular(const inside *c, fret_real e) {
    return fret_pow(((c->b - c->r) + e) * (c->b + e + c->r), (c->normal->rule.k - 1) / 2);
}

/* r beyond the flat end: x^2 = r^2 + (to^2-r^2) t^(2/(k+1)). */
static fret_real pressure_inside(fret_real t, fret_real rest, void *context) {
    (void)rest;
    const inside *c = context;
    fret_real last = c->b + c->to, span = (last - c->r) * (last + c->r);
    fret_real x = sqrtl(c->r * c->r + span * fret_pow(t, c->power));
    return slope_at(c, fminl(x - c->b, c->to)) / x;
}

/* r not beyond the flat end: e = to t^(2/(k+1)), where g' may be as singular as the kernel. */
static fret_real pressure_below(fret_real t, fret_real rest, void *context) {
    (void)rest;
    const inside *c = context;
    fret_real e = c->to * fret_pow(t, c->power);
    return e > 0 ? slope_at(c, e) * singular(c, e) * e / t : 0;
}

/* Away from the singularity: linear in ln e, since near a tip the field is a power; of a steep one only the
 * outer end counts: linear in the power itself. */
static fret_real pressure_beyond(fret_real t, fret_real rest, void *context) {
    const inside *c = context;
    fret_real span = fret_log(c->to / c->from), l = span * t, weight = span;
    if (c->power * span > 150) {
        fret_real u = rest + t * fret_exp(c->power * span);
        l = fret_log(u) / c->power;
        weight = fret_expm1(c->power * span) / (c->power * u);
    }
    fret_real e = fminl(c->from * fret_exp(l), c->to);
    return weight * e * slope_at(c, e) * singular(c, e);
}

/* At the tip: x = a t^(1/(n+k-1)), n the leading power of the gap. */
static fret_real pressure_tip(fret_real t, fret_real rest, void *context) {
    (void)rest;
    const inside *c = context;
    fret_real x = c->to * fret_pow(t, c->power);
    return x > 0 ? slope_at(c, x) * fret_pow(x, c->normal->rule.k) / t : 0;
}

fret_status fret_pressure(const fret_normal *n, fret_real a, fret_real r, fret_real *p) {
    fret_status st = fret_check_not_negative("r", (double)r);
    if (st.code)
        return st;
    *p = 0;
    fret_real start = fret_gap_start(&n->gap), k1 = 1 + n->foundation.k;
    if (r >= a || a <= start)
        return fret_ok();
    /* the leading power of the gap decides what the tip is like */
    const fret_real rise = fret_gap_tip(&n->gap) + n->foundation.k - 1;
    const bool tip = r == 0 && start == 0;
    const bool sharp = r == start && fret_gap_sharp(&n->gap);
    if ((tip && rise <= 0) || sharp)
        return fret_fail(FRET_SINGULAR, "r", (double)r, 0);
    inside c = {n, start, r, 0, a - start, 2 / k1};
    fret_real scale = n->foundation.cN0 * fret_pow(n->foundation.c0, -n->foundation.k) / FRET_PI;
    if (tip) {
        c.power = 1 / rise;
        *p = scale / rise * fret_integrate(pressure_tip, &c);
        return fret_ok();
    }
    /* the first part reaches no farther than what is singular on the other side: x = b, -r, or r below b */
    inside beyond = {n, start, r, c.to, c.to, rise};
    if (r > start)
        beyond.from = fminl(c.to, sqrtl(r * r + (r - start) * (r + start)) - start);
    else if (r < start)
        beyond.from = fminl(c.to, start - r);
    c.to = beyond.from;
    fret_real last = start + c.to;
    *p = r > start ? fret_pow((last - r) * (last + r), k1 / 2) * fret_integrate(pressure_inside, &c)
                   : 2 * fret_integrate(pressure_below, &c);
    *p *= scale / k1;
    if (c.to < beyond.to)
        *p += scale * fret_integrate(pressure_beyond, &beyond);
    return isfinite(*p) ? fret_ok() : fret_fail(FRET_SINGULAR, "r", (double)r, 0);
}

/* Linear in x^(k+1), which takes x^k away, from x = lo to hi; g has a kink at the flat end. */
typedef struct outside {
    const fret_normal *normal;
    fret_real r, dz, lo, hi, span; /* span: 1-(lo/hi)^(k+1) */
    bool flat;
} outside;

static fret_real outside_part(fret_real t, fret_real rest, void *context) {
    (void)t;
    const outside *c = context;
    fret_real k1 = 1 + c->normal->rule.k, l = fret_log1p(-c->span * rest) / k1;
    fret_real below = -c->hi * fret_expm1(l), x = l < -1 ? c->hi * fret_exp(l) : c->hi - below,
              g = 0; /* hi-x keeps its digits near the edge, x near the centre */
    if (!c->flat && x > c->lo)
        g = fret_gap_profile(&c->normal->gap, &c->normal->rule, x - c->lo).g;
    return (c->dz - g) * fret_pow((c->r - c->hi + below) * (c->r + x), -k1 / 2);
}

static fret_real outside_integral(const fret_normal *n, fret_real r, fret_real dz, fret_real lo, fret_real hi,
                                  bool flat) {
    fret_real k1 = 1 + n->foundation.k, span = lo > 0 ? -fret_expm1(k1 * fret_log(lo / hi)) : 1;
    outside c = {n, r, dz, lo, hi, span, flat};
    return fret_pow(hi, k1) * span / k1 * fret_integrate(outside_part, &c);
}

fret_status fret_surface(const fret_normal *n, fret_real a, fret_real r, fret_real *w) {
    fret_status st = fret_check_not_negative("r", (double)r);
    if (st.code)
        return st;
    fret_real dz = 0, f = 0, k = n->foundation.k, start = fret_gap_start(&n->gap);
    *w = 0;
    if (a <= start)
        return fret_ok();
    dz = fret_gap_profile(&n->gap, &n->rule, a - start).g;
    if (r <= a) {
        st = fret_gap_f(&n->gap, r, &f);
        *w = dz - f;
        return st;
    }
    fret_real ck = fabsl(k) <= 0.5L ? fret_cos(FRET_PI * k / 2) : fret_sin(FRET_PI * (1 - fabsl(k)) / 2);
    fret_real sum = outside_integral(n, r, dz, start, a, false);
    if (start > 0)
        sum += outside_integral(n, r, dz, 0, start, true);
    *w = 2 * ck / FRET_PI * sum;
    return fret_ok();
}

/* Sum over the slices of weight sigma times the difference of the field at their two ends. */
static fret_status superpose(const fret_memory *m, fret_real r, bool traction, fret_real *out) {
    const fret_normal *n = fret_memory_normal(m);
    fret_segment s;
    fret_real inner = 0, sum = 0;
    *out = 0;
    for (size_t i = 0; fret_memory_segment(m, i, &s); i++) {
        fret_real a = fret_law_radius(n, s.outer), outer;
        fret_status st = traction ? fret_pressure(n, a, r, &outer) : fret_surface(n, a, r, &outer);
        if (st.code)
            return st;
        sum += s.sigma * (outer - inner);
        inner = outer;
    }
    *out = sum;
    return fret_ok();
}

/* A field at r counts only what is below it: slices that end inside r contribute their outside part. */
fret_status fret_traction(const fret_memory *m, fret_real r, fret_real *q) {
    fret_status st = superpose(m, r, true, q);
    *q *= fret_memory_friction(m);
    return st;
}

fret_status fret_surface_x(const fret_memory *m, fret_real r, fret_real *u) {
    fret_status st = superpose(m, r, false, u);
    *u *= fret_memory_friction(m) * fret_memory_normal(m)->foundation.eta;
    return st;
}
