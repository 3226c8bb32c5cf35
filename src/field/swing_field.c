/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Fields of the curved arcs of a memory: the field of what each contact adds to the one within it, which
 * has a formula, along the way itself. Allocates nothing. */
#include "field/field.h"
#include "number/integral.h"

/* What a place asks of a curved arc: int weight sigma dy along it. The normal and the tangential load are
 * the coordinates M and P of `of`; instants count from `from`, where the load is `beyond` more than N. */
typedef enum weight { ALONG, OUTSIDE, INSIDE } weight;
typedef struct bend {
    const fret_normal *normal;
    const flat_field *flat;
    way of;
    fret_real r, N; /* the place, and the load of a contact that ends there */
    fret_real steep,
        bent; /* but of powers: its radius grows by steep x (1 + bent x) with so much more load x */
    fret_real from, beyond;
    weight weight;
    fret_real lo, hi, near, side, power, sign; /* sign: of the slope */
} bend;

/* How far the load at the time w is above N, with all digits where that is little. */
static fret_real rise_at(const bend *b, fret_real w) {
    return b->beyond - 2 * b->of.size[M] * sinl(b->from + w / 2 - b->of.lag[M]) * sinl(w / 2);
}

/* Below so much of N a radius is told by its growth. */
static const fret_real NEAR = 1e-6L;

/* a^2/r^2 - 1 of the contact that has so much more load; its radius is a. */
static fret_real square_rise(const bend *b, fret_real rise, fret_real a) {
    const fret_real ratio = rise / b->N;
    const bool known = b->N > 0 && isfinite(ratio);
    if (known && fret_normal_closed(b->normal))
        return expm1l(2 / b->normal->s * log1pl(ratio));
    const fret_real e = known && fabsl(ratio) <= NEAR ? b->steep * rise * (1 + b->bent * rise) : a - b->r;
    return e / b->r * (2 + e / b->r);
}

/* sigma dy/dt, y and its stiffness those of N */
static fret_real depth_rate(const bend *b, fret_real w, const fret_point *at) {
    const fret_real turn = -way_fall(&b->of, P, b->from + w);
    return fret_normal_closed(b->normal) ? turn * b->normal->q * at->y / at->F : turn / at->K;
}

/* At the time w; a kernel that is singular at w = 0 but for |w|^(1-power). */
static fret_real rate_at(const bend *b, fret_real w, bool but) {
    if (fret_stopped(b->normal))
        return 0;
    const fret_point at = fret_law_at_force(b->normal, way_at(&b->of, M, b->from + w));
    const fret_real sum = depth_rate(b, w, &at);
    if (b->weight == INSIDE)
        return sum;
    const fret_real a = at.a, rise = rise_at(b, w);
    if (b->weight == ALONG) {
        const fret_real way2 = b->r > 0 ? b->r * b->r * square_rise(b, rise, a) : a * a;
        return way2 > 0 ? sum * fret_pow(but ? way2 / w : way2, (b->normal->foundation.k - 1) / 2) : 0;
    }
    const fret_real away = fminl(fmaxl(-square_rise(b, rise, a), 0), 1);
    return sum * fret_kernel_flat_of(b->flat, 1 - away, away);
}

/* From `from` on, t to the power of what takes the singularity away. */
static fret_real touching_rate(fret_real t, fret_real rest, void *context) {
    static const fret_real deep = 1e-100L;
    const bend *b = context;
    const fret_real w = b->hi * fmaxl(fret_pow(t, b->power), deep);
    (void)rest;
    return rate_at(b, w, b->weight == ALONG);
}

/* Between lo and hi, evenly in the logarithm of the time to what is singular, `near` before the time 0. */
static fret_real other_rate(fret_real t, fret_real rest, void *context) {
    const bend *b = context;
    const fret_real off = b->near + b->lo, span = log1pl((b->hi - b->lo) / off),
                    w = b->lo + off * expm1l(span * t);
    (void)rest;
    return b->sign * span * (b->near + w) * rate_at(b, b->side * w, false);
}

/* From lo to hi, both times after 0 or, on the other side, before it. */
static fret_real sum_between(bend *b, fret_real lo, fret_real hi) {
    static const fret_real little = 1e-16L;
    const fret_real turned = b->side * (b->of.lag[P] - b->from);
    fret_real sum = 0;
    for (fret_real end; hi - lo > little; lo = end) { /* where it does, the sign changes */
        fret_real turn = turned_to(turned, lo);
        while (turn <= lo + little)
            turn += FRET_PI;
        end = fminl(turn, hi);
        b->lo = lo;
        b->hi = end;
        b->sign = way_fall(&b->of, P, b->from + b->side * (lo + end) / 2) > 0 ? -1 : 1;
        sum += b->sign * fret_integral(other_rate, b, 1e-14L).value;
    }
    return sum;
}

/* How far from the time 0 the load is nothing, or was N before it turned: in the plane of complex times what
 * is singular but there. */
static fret_real alone(const bend *b) {
    const fret_real angle = turned_to(b->from - b->of.lag[M], -FRET_PI / 2);
    return fminl(sqrtl(2 * b->N / b->of.size[M]), 2 * (angle + FRET_PI));
}

/* The same where the load at the time 0 is more than N, or less; far is a turn. */
static fret_real near_to(const bend *b) {
    static const fret_real least = 1e-15L, most = 2 * FRET_PI;
    const fret_real off = fabsl(b->beyond) / b->of.size[M],
                    near = fminl(sqrtl(off), off / fabsl(sinl(b->from - b->of.lag[M])));
    return b->weight == INSIDE ? most : fminl(fmaxl(near, least), most);
}

/* The same by a rule for each doubling, however far down: what is little there need not agree. */
static fret_real sum_doubling(bend *b, fret_real lo, fret_real hi) {
    fret_real sum = 0;
    b->sign = 1;
    for (b->lo = lo; b->lo < hi; b->lo = b->hi) {
        b->hi = fminl(2 * b->lo + b->near, hi);
        sum += fret_integral_smooth(other_rate, b);
    }
    return sum;
}

/* From the time 0 to `end`, before it or after it. */
static fret_real integral(bend *b, fret_real end) {
    static const fret_real least = 1e-15L;
    const fret_real whole = fabsl(end), m = (b->normal->foundation.k + 1) / 2;
    fret_real sum = 0, from = 0, clear = whole / 8;
    b->side = end < 0 ? -1 : 1;
    b->near = near_to(b);
    if (b->weight != INSIDE && b->beyond == 0) {
        from = fminl(whole, fmaxl(alone(b), least));
        b->near = 0;
        b->power = b->weight == ALONG ? 1 / m : 1;
        b->hi = b->side * from;
        sum = (b->weight == ALONG ? fret_pow(from, m) / m : from) *
              fret_integral_ends(touching_rate, b, 1e-17L);
    }
    if (from + b->near < clear) {
        sum += sum_doubling(b, from, clear);
        from = clear;
    }
    return sum + sum_between(b, from, whole);
}

/* The parts of a curved arc within and beyond the load N. */
static fret_real sum_of(bend *b, const arc *p, weight outside, weight inside, fret_real factor) {
    fret_real sum = 0;
    fret_swing_loads(&p->way, &b->of);
    const fret_real first = way_at(&b->of, M, p->lo) - b->N, last = way_at(&b->of, M, p->hi) - b->N;
    b->from = first >= 0 ? p->lo : last <= 0 ? p->hi : way_when(&b->of, M, b->N, p->lo, p->hi);
    b->beyond = first >= 0 ? first : last <= 0 ? last : 0;
    b->weight = outside;
    if (outside != ALONG && b->from > p->lo)
        sum += factor * integral(b, p->lo - b->from);
    b->weight = inside;
    if (b->from < p->hi)
        sum += integral(b, p->hi - b->from);
    return sum;
}

static bend begin(const fret_swing *c, fret_real r) {
    const fret_normal *n = c->normal;
    const fret_real e = r - fret_gap_start(&n->gap);
    bend b = {.normal = n, .r = r};
    if (!(r < n->end))
        b.N = (fret_real)INFINITY;
    else if (e > 0) {
        const fret_profile p = fret_gap_profile(&n->gap, &n->rule, e);
        b.N = fret_law_at_radius(n, r).F;
        if (!fret_normal_closed(n)) {
            const fret_real less = 1e-4L * b.N, inner = fret_law_at_force(n, b.N - less).a;
            b.steep = 1 / (p.slope * fret_normal_stiffness(n, r));
            b.bent = (1 - (r - inner) / (b.steep * less)) / less;
        }
    }
    return b;
}

fret_real fret_swing_slope(const fret_swing *c, fret_real r) {
    bend b = begin(c, r);
    fret_real sum = 0;
    for (size_t i = 0; i < c->count && r < c->a; i++)
        sum += sum_of(&b, &c->arcs[i], ALONG, ALONG, 0);
    return sum;
}

fret_real fret_swing_surface(const fret_swing *c, const flat_field *flat, fret_real factor, fret_real r) {
    bend b = begin(c, r);
    fret_real sum = 0;
    b.flat = flat;
    for (size_t i = 0; i < c->count; i++)
        sum += sum_of(&b, &c->arcs[i], OUTSIDE, INSIDE, factor);
    return sum;
}
