/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Pressure, traction and surface displacements by inverse transforms. */
#include "fret/field.h"

#include <float.h>

#include "field/field.h"
#include "law/check.h"
#include "law/normal.h"
#include "number/quadrature.h"
#include "number/real.h"

/* A contact: of radius a, by e beyond the flat end, dz deep; the logarithm of a to 100 bits, where a power
 * makes much of it. */
typedef struct rim {
    fret_real a, e, dz;
    dd ln_a;
} rim;

/* The pressure as one or two integrals over a variable t in 0..1 that takes the singular factor of the kernel
 * away. Distances e = x-b from the flat end or the centre. */
typedef struct inside {
    const fret_normal *normal;
    fret_real b, r, from, to, power; /* e from .. to */
    fret_real (*part)(const struct inside *, fret_real s, fret_real t);
    fret_real least; /* that part at s = 0 */
} inside;

/* e > 0: at 0 none of the integrands asks. */
static fret_real slope_at(const inside *c, fret_real e) {
    return fret_stopped(c->normal) ? 0 : fret_gap_profile(&c->normal->gap, &c->normal->rule, e).slope;
}

/* (x^2-r^2)^((k-1)/2) */
static fret_real singular(const inside *c, fret_real e) {
    return fret_pow(((c->b - c->r) + e) * (c->b + e + c->r), (c->normal->rule.k - 1) / 2);
}

/* Up to the singularity, of s = t^power: r beyond the flat end, x^2 = r^2 + (to^2-r^2) s. */
static fret_real pressure_inside(const inside *c, fret_real s, fret_real t) {
    (void)t;
    const fret_real to = c->to - (c->r - c->b), way = to * (c->b + c->to + c->r) * s;
    fret_real x = sqrtl(c->r * c->r + way);
    return slope_at(c, fminl((c->r - c->b) + way / (c->r + x), c->to)) / x;
}

/* The same at the flat end or below it, and at the tip: e = to s, where g' may be as singular as the kernel.
 */
static fret_real pressure_below(const inside *c, fret_real s, fret_real t) {
    const fret_real e = c->to * s;
    return slope_at(c, e) * singular(c, e) * e / t;
}

static fret_real near_part(fret_real t, fret_real rest, void *context) {
    (void)rest;
    const inside *c = context;
    return c->part(c, fret_pow(t, c->power), t);
}

/* A large power makes a step at t = 1 of all that varies with s, and s would underflow: by s itself, what the
 * part has more than at s = 0. */
static fret_real near_change(fret_real s, fret_real rest, void *context) {
    (void)rest;
    const inside *c = context;
    const fret_real t = fret_pow(s, 1 / c->power);
    return (c->part(c, s, t) - c->least) * t / s;
}

static fret_real near_integral(inside *c) {
    static const fret_real wide = 16, zero = 1e-100L;
    if (c->power <= wide)
        return fret_integrate(near_part, c);
    c->least = c->part(c, zero, fret_pow(zero, 1 / c->power));
    return c->least + fret_integrate(near_change, c) / c->power;
}

/* Away from the singularity: linear in ln e, since near a tip the field is a power; of a steep one only the
 * outer end counts: linear in the power itself. */
static fret_real pressure_beyond(fret_real t, fret_real rest, void *context) {
    const inside *c = context;
    fret_real span = logl(c->to / c->from), l = span * t, weight = span;
    if (c->power * span > 150) {
        fret_real u = rest + t * expl(c->power * span);
        l = logl(u) / c->power;
        weight = expm1l(c->power * span) / (c->power * u);
    }
    fret_real e = fminl(c->from * expl(l), c->to);
    return weight * e * slope_at(c, e) * singular(c, e);
}

/* Of a steep power g = G (x/a)^n only the last a/n of the contact counts, where nodes in the radius would be
 * few. Its integrals are linear in y = g/G. */
static const double STEEP = 20; /* the least such n */

/* Powers, by series of positive terms: int_r^b x^(n-1) (x^2-r^2)^(m-1) dx with w = 1-(r/b)^2, m = (k+1)/2 and
 * e = (n-2)/2 is b^(n+k-1) w^m/(2m) times
 *   sum (-e)_j/(m+1)_j w^j = (1-w)^(m+e) sum (m+1+e)_j/j! m/(m+j) w^j:
 * the first sum for n <= 2, the second else. */
static fret_real near_edge(fret_real n, fret_real m, fret_real v, fret_real w) {
    const fret_real e = n / 2 - 1, enough = LDBL_EPSILON / 4 * (1 - w);
    const bool gentle = e <= 0;
    fret_real sum = 0, term = 1, ratio = 0;
    for (int i = 0; ratio >= 1 || term > enough * sum; i++) {
        const fret_real j = i;
        sum += gentle ? term : term * m / (m + j);
        ratio = gentle ? (j - e) / (m + 1 + j) * w : (m + 1 + e + j) / (1 + j) * w;
        term *= ratio;
    }
    return fret_pow(w, m) / (2 * m) * (gentle ? sum : sum * fret_pow(v, m + e));
}

/* From b to 1, with v = (r/b)^2 well below 1: the kernel as a series in (r/x)^2. */
static fret_real far_from_edge(fret_real n, fret_real m, fret_real r, fret_real b, fret_real v) {
    const fret_real rise = n + 2 * m - 2, span = -logl(b);
    fret_real sum = 0, c = 1, outer = 1, inner = fret_pow(b, rise);
    for (int j = 0; c * (inner + outer) > LDBL_EPSILON / 8 * sum; j++) { /* of r^2 < 0.7, v < 0.3 */
        const fret_real power = rise - 2 * j;
        sum += c * (fabsl(power) * span < 0.5L ? inner * (power != 0 ? expm1l(power * span) / power : span)
                                               : (outer - inner) / power);
        c *= (1 - m + j) / (1 + j);
        outer *= r * r;
        inner *= v;
    }
    return sum;
}

/* int_r^1 x^(n-1) (x^2-r^2)^(m-1) dx */
static fret_real power_integral(fret_real n, fret_real m, fret_real r, fret_real w) {
    static const fret_real most = 0.7L; /* a longer series is slower than two */
    if (w <= most)
        return near_edge(n, m, r * r, w);
    const fret_real b = r / sqrtl(1 - most);
    return fret_pow(b, n + 2 * m - 2) * near_edge(n, m, 1 - most, most) + far_from_edge(n, m, r, b, 1 - most);
}

/* From one to the next where powers grow by 2: with w = 1-r^2, by parts. */
static fret_real pressure_powers(const fret_normal *n, const fret_term *term, int terms, fret_real a,
                                 fret_real r) {
    const fret_foundation *f = &n->foundation;
    const fret_real part = r / a, w = (a - r) / a * ((a + r) / a), m = (f->k + 1) / 2, outer = fret_pow(w, m);
    fret_real sum = 0, last = 0, before = 0;
    for (int i = 0; i < terms; i++) {
        const fret_real power = term[i].n;
        last = r <= 0                         ? 1 / (power + 2 * (m - 1))
               : i > 0 && power == before + 2 ? (outer + before * part * part * last) / (2 * m + before)
                                              : power_integral(power, m, part, w);
        sum += term[i].G * power * last;
        before = power;
    }
    return f->cN0 / FRET_PI * fret_pow(a / f->c0, f->k) * sum / a;
}

/* As which power of the radius, or of the distance from the flat end, the pressure falls inwards: the least
 * power of g' times the kernel, and 1; NAN: r is elsewhere. */
static fret_real rise_at(const fret_normal *n, fret_real r) {
    const fret_real start = fret_gap_start(&n->gap), k = n->foundation.k;
    if (r == 0 && start == 0)
        return fret_gap_tip(&n->gap) + k - 1;
    return r != start ? NAN : fret_gap_sharp(&n->gap) ? k : 1 + k;
}

bool fret_field_infinite(const fret_normal *n, fret_real r) {
    return rise_at(n, r) <= 0;
}

static fret_real in_pascal(const fret_normal *n, fret_real p) {
    return n->foundation.cN0 * fret_pow(n->foundation.c0, -n->foundation.k) / FRET_PI * p;
}

/* Of a gap without steep powers, r < a, which lies beyond the flat end. */
static fret_status pressure_gentle(const fret_normal *n, const rim *at, fret_real r, fret_real *p) {
    *p = 0;
    const fret_real start = fret_gap_start(&n->gap), k1 = 1 + n->foundation.k, at_tip = rise_at(n, r);
    const bool tip = !isnan(at_tip);
    const fret_real rise = tip ? at_tip : k1 / 2;
    if (rise <= 0)
        return fret_fail(FRET_SINGULAR, "r", (double)r, 0);
    fret_term term[FRET_MOST_TERMS];
    const int terms = fret_gap_series(&n->gap, &n->rule, at->a, term);
    if (terms > 0) {
        *p = pressure_powers(n, term, terms, at->a, r);
        return fret_ok();
    }
    inside c = {n, start, r, 0, at->e, 1 / rise, r > start ? pressure_inside : pressure_below, 0}, beyond = c;
    beyond.power = fret_gap_tip(&n->gap) + n->foundation.k - 1;
    if (c.to <= 0) { /* a flat punch */
        *p = in_pascal(n, at->dz * singular(&c, 0));
        return fret_ok();
    }
    /* the first part reaches no farther than what is singular on the other side: x = b, -r, or r below b */
    if (r > start) {
        const fret_real way = (r - start) * (r + start);
        c.to = fminl(c.to, (r - start) + way / (r + sqrtl(r * r + way)));
    } else if (r < start)
        c.to = fminl(c.to, start - r);
    else if (tip && start > 0)
        c.to = fminl(c.to, start);
    beyond.from = c.to;
    const fret_real part = near_integral(&c);
    *p = r > start ? fret_pow((c.to - (r - start)) * (start + c.to + r), rise) * part / k1 : part / rise;
    if (beyond.from < beyond.to)
        *p += fret_integrate(pressure_beyond, &beyond);
    *p = in_pascal(n, *p);
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
    fret_real k1 = 1 + c->normal->rule.k, l = log1pl(-c->span * rest) / k1;
    fret_real below = -c->hi * expm1l(l), x = l < -1 ? c->hi * expl(l) : c->hi - below,
              g = 0; /* hi-x keeps its digits near the edge, x near the centre */
    if (!c->flat && x > c->lo && !fret_stopped(c->normal))
        g = fret_gap_profile(&c->normal->gap, &c->normal->rule, x - c->lo).g;
    return (c->dz - g) * fret_pow((c->r - c->hi + below) * (c->r + x), -k1 / 2);
}

static fret_real outside_integral(const fret_normal *n, fret_real r, fret_real dz, fret_real lo, fret_real hi,
                                  bool flat) {
    fret_real k1 = 1 + n->foundation.k, span = lo > 0 ? -expm1l(k1 * logl(lo / hi)) : 1;
    outside c = {n, r, dz, lo, hi, span, flat};
    return fret_pow(hi, k1) * span / k1 * fret_integrate(outside_part, &c);
}

fret_real fret_field_flat(fret_real k, fret_real q, fret_real away) {
    const fret_real m = (k + 1) / 2;
    const bool near = away < 0.5L;
    const fret_real b = near ? (1 - k) / 2 : m, x = near ? away : q;
    fret_real sum = 0, term = 1;
    for (int j = 0; term > 1e-22L; j++) { /* x is at most a half */
        sum += term / (b + j);
        term *= x * (b + j) / (j + 1);
    }
    sum *= fret_pow(x, b);
    return (near ? FRET_PI / sinl(FRET_PI * fminl(m, 1 - m)) - sum : sum) / 2;
}

static fret_real flat_outside(fret_real k, fret_real a, fret_real r) {
    return fret_field_flat(k, (a / r) * (a / r), (r - a) / r * ((r + a) / r));
}

/* What powers leave of that, int_0^a x^k (dz-g) (r^2-x^2)^-m dx, by the same series of the kernel from the
 * centre, whose terms are positive. */
static fret_real surface_far(fret_real k, const fret_term *term, int terms, fret_real dz, fret_real q) {
    const fret_real m = (k + 1) / 2;
    fret_real sum = 0, rest = dz, c = 1, part;
    int j = 0;
    for (int i = 0; i < terms; i++)
        rest -= term[i].G;
    do { /* q is at most 0.7 */
        const fret_real b = m + j;
        part = rest;
        for (int i = 0; i < terms; i++)
            part += term[i].G * term[i].n / (2 * b + term[i].n);
        part *= c / b;
        sum += part;
        j++;
        c *= q * b / j;
    } while (fabsl(part) > 1e-20L * fabsl(sum));
    return sum * fret_pow(q, m) / 2;
}

/* From the edge: the whole, which makes the gap itself, less what is beyond x = a. away: 1-(a/r)^2. */
static fret_real surface_near(fret_real k, const fret_term *term, int terms, fret_real dz, fret_real a,
                              fret_real r, fret_real away) {
    const fret_real m = (k + 1) / 2, whole = FRET_PI / sinl(FRET_PI * fminl(m, 1 - m)),
                    edge = fret_pow(away, 1 - m);
    fret_real sum = dz * flat_outside(k, a, r);
    for (int i = 0; i < terms; i++) {
        const fret_real b = term[i].n / 2 + m;
        fret_real beyond = 0, c = 1;
        for (int j = 0; fabsl(c) > 1e-21L * fabsl(beyond); j++) { /* away is less than 0.3 */
            beyond += c / (1 - m + j);
            c *= away * (1 - b + j) / (j + 1);
        }
        sum -= term[i].G / 2 * fret_pow(r / a, term[i].n) * (whole / term[i].kappa - edge * beyond);
    }
    return sum;
}

/* Neither series serves where the exponents or what is left of the kernel are next to nothing. */
static bool surface_powers(const fret_normal *n, fret_real a, fret_real dz, fret_real r, fret_real *sum) {
    static const fret_real NEAR = 0.3L;
    fret_term term[FRET_MOST_TERMS];
    const fret_real k = n->foundation.k, away = (r - a) / r * ((r + a) / r);
    const int terms = fret_gap_series(&n->gap, &n->rule, a, term);
    for (int i = 0; i < terms; i++)
        if (term[i].n < 0.01L)
            return false;
    if (terms == 0 || (away < NEAR && (1 - fabsl(k) < 1e-3L || term[terms - 1].n > STEEP)))
        return false;
    *sum = away < NEAR ? surface_near(k, term, terms, dz, a, r, away)
                       : surface_far(k, term, terms, dz, (a / r) * (a / r));
    return true;
}

/* Of a gap without steep powers, r > a: the integral; the contact is dz deep. */
static fret_real surface_gentle(const fret_normal *n, fret_real a, fret_real dz, fret_real r) {
    fret_real sum;
    if (surface_powers(n, a, dz, r, &sum))
        return sum;
    const fret_real start = fret_gap_start(&n->gap);
    sum = outside_integral(n, r, dz, start, a, false);
    return start > 0 ? sum + outside_integral(n, r, dz, 0, start, true) : sum;
}

typedef struct power_field {
    const fret_normal *normal;
    fret_real a, r, n, m; /* m = (k+1)/2 */
    fret_real wide;       /* n ln(a/r): y = e^(z-wide), x = r e^(z/n), 0 <= z <= wide */
    fret_real z;          /* where the part near r ends */
} power_field;

/* (x^2-r^2)^(m-1) */
static fret_real steep_kernel(const power_field *c, fret_real z) {
    return fret_pow(c->r * c->r * expm1l(2 * z / c->n), c->m - 1);
}

/* Near r, where the kernel is singular: z = c->z t^(1/m), which takes z^m = c->z^m t of it away. */
static fret_real steep_near(fret_real t, fret_real rest, void *context) {
    const power_field *c = context;
    (void)rest;
    const fret_real z = c->z * expl(logl(t) / c->m), u = 2 * z / c->n, bend = u > 0 ? expm1l(u) / u : 1;
    return expl(z - c->wide) * fret_pow(c->z, c->m) * fret_pow(2 * c->r * c->r / c->n * bend, c->m - 1) /
           c->m;
}

/* The rest, from there to the edge: z = c->z .. wide. */
static fret_real steep_far(fret_real t, fret_real rest, void *context) {
    const power_field *c = context;
    const fret_real span = c->wide - c->z;
    return fret_stopped(c->normal) ? 0 : span * expl(-span * rest) * steep_kernel(c, c->z + span * t);
}

/* The whole where r lies so deep that what is near it has no weight: linear in y = 0 .. 1. */
static fret_real steep_deep(fret_real t, fret_real rest, void *context) {
    const power_field *c = context;
    const fret_real ln_y = rest < 0.5L ? log1pl(-rest) : logl(t);
    return ln_y > -c->wide ? steep_kernel(c, c->wide + ln_y) : 0;
}

/* x^(2m) (r^2-x^2)^-m, x = a e^l = a y^(1/n). */
static fret_real steep_outside(const power_field *c, fret_real l) {
    const fret_real gap = (c->r - c->a) * (c->r + c->a) - c->a * c->a * expm1l(2 * l);
    return fret_pow(c->a * c->a * expl(2 * l) / gap, c->m);
}

/* y = t/2 */
static fret_real steep_centre(fret_real t, fret_real rest, void *context) {
    const power_field *c = context;
    (void)rest;
    return steep_outside(c, logl(t / 2) / c->n) / 2;
}

/* y = 1 - t^(1/(1-m))/2, which takes the singularity at the edge away from an r that is near it. */
static fret_real steep_rim(fret_real t, fret_real rest, void *context) {
    const power_field *c = context;
    const fret_real power = 1 / (1 - c->m), away = fret_pow(t, power) / 2;
    (void)rest;
    return fret_stopped(c->normal) ? 0 : steep_outside(c, log1pl(-away) / c->n) * power * away / t;
}

/* int_r^a g' (x^2-r^2)^(m-1) dx of a power of depth G at the edge. */
static fret_real pressure_steep(const fret_normal *n, const fret_power *g, const rim *at, fret_real G,
                                fret_real r) {
    const fret_real m = (n->foundation.k + 1) / 2;
    if (r <= 0)
        return G * g->n / (g->n + 2 * (m - 1)) * fret_pow(at->a, 2 * (m - 1));
    const fret_real wide = dd_value(dd_mul_d(dd_sub(at->ln_a, fret_dd_log_real(r)), g->n));
    power_field c = {n, at->a, r, g->n, m, wide, fminl(wide, 1)};
    if (wide <= 0)
        return 0;
    if (wide > 60)
        return G * fret_integrate(steep_deep, &c);
    const fret_real near = fret_integrate(steep_near, &c);
    return G * (wide > 1 ? near + fret_integrate_pieces(steep_far, &c, 1e-17L) : near);
}

/* Calls `steep` for each steep power of the gap and adds up. The rest of the gap goes to `gentle`; returns
 * whether there is one. */
typedef fret_real steep_field(const fret_normal *, const fret_power *, const rim *, fret_real G, fret_real r);

static bool part(const fret_normal *n, const rim *at, fret_real r, steep_field *steep, fret_normal *gentle,
                 fret_real *sum) {
    const fret_power *power;
    const int terms = fret_gap_powers(&n->gap, &power);
    *gentle = *n;
    gentle->gap.terms = 0;
    *sum = 0;
    for (int i = 0; i < terms; i++) {
        const fret_power *g = &power[i];
        if (g->n < STEEP) {
            gentle->rule.kappa[gentle->gap.terms] = n->rule.kappa[i];
            gentle->gap.power[gentle->gap.terms++] = *g;
        } else {
            const fret_real G =
                terms == 1 ? at->dz : n->rule.kappa[i] * g->h * fret_ratio_pow(at->a, g->r0, g->n);
            *sum += steep(n, g, at, G, r);
        }
    }
    return gentle->gap.terms > 0;
}

static bool is_steep(const fret_normal *n) {
    const fret_power *power;
    for (int i = fret_gap_powers(&n->gap, &power); i-- > 0;)
        if (power[i].n >= STEEP)
            return true;
    return false;
}

/* Depth and logarithm of a contact given by its radius, beyond the flat end. */
static rim rim_at(const fret_normal *n, fret_real a) {
    const fret_real e = a - fret_gap_start(&n->gap);
    return (rim){a, e, fret_gap_profile(&n->gap, &n->rule, e).g, fret_dd_log_real(a)};
}

static fret_status pressure_of(const fret_normal *n, const rim *at, fret_real r, fret_real *p) {
    fret_normal gentle;
    fret_real sum = 0, rest = 0;
    if (!is_steep(n))
        return fret_unless_stopped(n, pressure_gentle(n, at, r, p));
    *p = 0;
    if (r >= at->a)
        return fret_ok();
    if (part(n, at, r, pressure_steep, &gentle, &sum)) {
        const fret_status st = pressure_gentle(&gentle, at, r, &rest);
        if (st.code)
            return st;
    }
    *p = in_pascal(n, sum) + rest;
    return fret_unless_stopped(n, fret_ok());
}

fret_status fret_field_check(const fret_normal *n, fret_real a, fret_real r) {
    fret_status st = fret_check_not_negative("r", (double)r);
    if (!st.code)
        st = fret_check_not_negative("a", (double)a);
    return st.code || a <= n->end ? st : fret_fail(FRET_OUTSIDE, "a", (double)a, (double)n->end);
}

static fret_status pressure_at(const fret_normal *n, fret_real a, fret_real r, fret_real *p) {
    *p = 0;
    if (r >= a || a <= fret_gap_start(&n->gap))
        return fret_ok();
    const rim at = rim_at(n, a);
    return pressure_of(n, &at, r, p);
}

fret_status fret_pressure(const fret_normal *n, fret_real a, fret_real r, fret_real *p) {
    const fret_status st = fret_field_check(n, a, r);
    return st.code ? st : pressure_at(n, a, r, p);
}

bool fret_field_light(const fret_normal *n, fret_real a) {
    static const fret_real part = 0x1p-14L; /* an edge further away keeps 50 bits */
    const fret_real start = fret_gap_start(&n->gap);
    return a - start < part * start &&
           (!fret_gap_sampled(&n->gap) || fret_gap_rows(&n->gap, a) <= fret_gap_rows(&n->gap, start) + 1);
}

/* How far the contact of radius a, which is y deep, reaches beyond the flat end. */
static fret_real reach_of(const fret_normal *n, fret_real a, fret_real y) {
    return fret_field_light(n, a) ? fret_law_distance(n, y) : a - fret_gap_start(&n->gap);
}

fret_status fret_pressure_of(const fret_normal *n, const fret_press *at, fret_real r, fret_real *p) {
    if (!fret_field_light(n, at->a))
        return fret_pressure(n, at->a, r, p);
    const fret_status st = fret_field_check(n, at->a, r);
    *p = 0;
    return st.code ? st : fret_field_of(n, at->dz, r, true, p);
}

/* What a steep power takes from the surface of a flat punch: int_0^a x^k g (r^2-x^2)^-m dx. */
static fret_real surface_steep(const fret_normal *n, const fret_power *g, const rim *at, fret_real G,
                               fret_real r) {
    power_field c = {.normal = n, .a = at->a, .r = r, .n = g->n, .m = (n->foundation.k + 1) / 2};
    return G / g->n * (fret_integrate(steep_centre, &c) + fret_integrate_pieces(steep_rim, &c, 1e-16L));
}

fret_real fret_field_surface_factor(fret_real k) {
    const fret_real away = (1 - fabsl(k)) / 2;
    return 2 / FRET_PI * (fabsl(k) <= 0.5L ? cosl(FRET_PI * k / 2) : sinl(FRET_PI * away));
}

static fret_status surface_of(const fret_normal *n, const rim *at, fret_real r, fret_real *w) {
    if (r <= at->a) {
        fret_real f = 0;
        const fret_status st = fret_gap_f(&n->gap, r, &f);
        *w = at->dz - f;
        return st;
    }
    fret_normal gentle;
    fret_real sum, steep = 0;
    if (!is_steep(n))
        sum = surface_gentle(n, at->a, at->dz, r);
    else if (part(n, at, r, surface_steep, &gentle, &steep))
        sum = surface_gentle(&gentle, at->a, at->dz, r) - steep;
    else
        sum = at->dz * flat_outside(n->foundation.k, at->a, r) - steep;
    *w = fret_field_surface_factor(n->foundation.k) * sum;
    return fret_unless_stopped(n, fret_ok());
}

fret_status fret_field_surface(const fret_normal *n, fret_real a, fret_real dz, fret_real r, fret_real *w) {
    const rim at = {a, a - fret_gap_start(&n->gap), dz, {0, 0}};
    return surface_of(n, &at, r, w);
}

fret_status fret_surface(const fret_normal *n, fret_real a, fret_real r, fret_real *w) {
    const fret_status st = fret_field_check(n, a, r);
    if (st.code)
        return st;
    *w = 0;
    if (a <= fret_gap_start(&n->gap))
        return fret_ok();
    const rim at = rim_at(n, a);
    return surface_of(n, &at, r, w);
}

fret_status fret_surface_of(const fret_normal *n, const fret_press *at, fret_real r, fret_real *w) {
    if (!fret_field_light(n, at->a))
        return fret_surface(n, at->a, r, w);
    const fret_status st = fret_field_check(n, at->a, r);
    *w = 0;
    return st.code ? st : fret_field_of(n, at->dz, r, false, w);
}

fret_status fret_field_of(const fret_normal *n, fret_real y, fret_real r, bool traction, fret_real *out) {
    const bool steep = fret_normal_closed(n) && is_steep(n);
    const fret_real a = fret_law_radius(n, y);
    *out = 0;
    if (!(y > 0))
        return fret_ok();
    if (!traction) {
        /* the depth tells the edge to more digits than its radius, of steep powers and near flat ends */
        const rim at = {a, a - fret_gap_start(&n->gap), y, steep ? fret_law_log_radius(n, y) : (dd){0, 0}};
        return surface_of(n, &at, r, out);
    }
    if (!steep && !fret_field_light(n, a))
        return pressure_at(n, a, r, out);
    const rim at = {a, reach_of(n, a, y), y, steep ? fret_law_log_radius(n, y) : (dd){0, 0}};
    const bool within = r - fret_gap_start(&n->gap) < at.e || fret_field_infinite(n, r);
    return steep || within ? pressure_of(n, &at, r, out) : fret_ok();
}

bool fret_field_deep(const fret_normal *n, fret_real y, fret_real r) {
    const fret_real start = fret_gap_start(&n->gap);
    return y > 0 &&
           (fret_field_infinite(n, r) ||
            (fret_gap_sharp(&n->gap) && 4 * fabsl(r - start) < reach_of(n, fret_law_radius(n, y), y)));
}

/* What a ring between two depths presses deep within it. */
static fret_real ring_pressure(const fret_normal *n, fret_real inner, fret_real outer, fret_real r) {
    const fret_real k = n->foundation.k;
    const fret_real b = fret_law_radius(n, inner), a = fret_law_radius(n, outer);
    inside c = {n, fret_gap_start(&n->gap), r, reach_of(n, b, inner), reach_of(n, a, outer), 0, NULL, 0};
    fret_term term[FRET_MOST_TERMS];
    const int terms = fret_gap_series(&n->gap, &n->rule, a, term);
    fret_real sum = 0;
    for (int i = 0; i < terms; i++) {
        const fret_real by = term[i].n + k - 1, l = logl(b / a);
        sum -= term[i].G * term[i].n * (by != 0 ? expm1l(by * l) / by : l);
    }
    sum *= fret_pow(a, k - 1);
    if (terms == 0 && c.from <= 0)
        return (fret_real)INFINITY;
    if (terms == 0 && c.from < c.to)
        sum = fret_integrate_pieces(pressure_beyond, &c, 1e-17L);
    return in_pascal(n, sum);
}

fret_status fret_field_between(const fret_normal *n, fret_real inner, fret_real outer, fret_real r,
                               bool traction, fret_real *out) {
    fret_real within = 0;
    *out = 0;
    if (traction && fret_field_deep(n, inner, r)) {
        *out = ring_pressure(n, inner, outer, r);
        return isfinite(*out) ? fret_ok() : fret_fail(FRET_SINGULAR, "r", (double)r, 0);
    }
    fret_status st = fret_field_of(n, inner, r, traction, &within);
    if (!st.code)
        st = fret_field_of(n, outer, r, traction, out);
    *out -= within;
    return st;
}
