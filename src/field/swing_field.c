/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Fields of the curved arcs that a harmonic load leaves: an arc is a superposition of flat punches, whose
 * fields are integrated over the time of the load. Allocates nothing; uses `law`, `history` and `number`. */
#include "field/field.h"
#include "number/integral.h"

/* The integral of weight sigma dy along a curved arc, for one radius r. `of` has the normal and tangential
 * force as coordinates M and P; times w count from `from`, where the normal force exceeds N by `beyond`. */
typedef enum weight { ALONG, OUTSIDE, INSIDE } weight;
typedef struct arc_integral {
    const fret_normal *normal;
    const flat_field *flat;
    load_path of;
    fret_real r, N;              /* the radius, and the normal force of the contact that ends there */
    fret_real growth, curvature; /* a(N+x) - r = growth x (1 + curvature x); not for powers */
    fret_real from, beyond;
    weight weight;
    fret_real lo, hi, near, side, power, sign; /* sign: that of the slope sigma */
} arc_integral;

/* The normal force at time w less N, without cancellation. */
static fret_real rise_at(const arc_integral *b, fret_real w) {
    return b->beyond - 2 * b->of.size[M] * sinl(b->from + w / 2 - b->of.lag[M]) * sinl(w / 2);
}

/* Below this part of N a radius is extrapolated by its growth. */
static const fret_real NEAR = 1e-6L;

/* (a/r)^2 - 1 of the contact of radius a whose normal force is N + rise. */
static fret_real square_rise(const arc_integral *b, fret_real rise, fret_real a) {
    const fret_real ratio = rise / b->N;
    const bool known = b->N > 0 && isfinite(ratio);
    if (known && fret_normal_closed(b->normal))
        return expm1l(2 / b->normal->s * log1pl(ratio));
    const fret_real e =
        known && fabsl(ratio) <= NEAR ? b->growth * rise * (1 + b->curvature * rise) : a - b->r;
    return e / b->r * (2 + e / b->r);
}

/* sigma dy/dt; y and the stiffness are functions of the normal force. */
static fret_real depth_rate(const arc_integral *b, fret_real w, const fret_point *at) {
    const fret_real turn = -load_path_fall(&b->of, P, b->from + w);
    return fret_normal_closed(b->normal) ? turn * b->normal->q * at->y / at->F : turn / at->K;
}

/* The integrand at time w. but: leaves out the kernel's singular factor w^((k-1)/2). */
static fret_real rate_at(const arc_integral *b, fret_real w, bool but) {
    if (fret_stopped(b->normal))
        return 0;
    const fret_point at = fret_law_at_force(b->normal, load_path_at(&b->of, M, b->from + w));
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

/* The integrand near w = 0 in t = (w/hi)^(1/power), which absorbs the singularity. */
static fret_real touching_rate(fret_real t, fret_real rest, void *context) {
    static const fret_real deep = 1e-100L;
    const arc_integral *b = context;
    const fret_real w = b->hi * fmaxl(fret_pow(t, b->power), deep);
    (void)rest;
    return rate_at(b, w, b->weight == ALONG);
}

/* The integrand between lo and hi in the logarithm of the time to the singularity, `near` before w = 0. */
static fret_real other_rate(fret_real t, fret_real rest, void *context) {
    const arc_integral *b = context;
    const fret_real off = b->near + b->lo, span = log1pl((b->hi - b->lo) / off),
                    w = b->lo + off * expm1l(span * t);
    (void)rest;
    return b->sign * span * (b->near + w) * rate_at(b, b->side * w, false);
}

/* The integral over lo < |w| < hi, on the side of w = 0 that `side` names. */
static fret_real sum_between(arc_integral *b, fret_real lo, fret_real hi) {
    static const fret_real little = 1e-16L, small = 1e-10L; /* a smaller piece has no digits to check */
    const fret_real turned = b->side * (b->of.lag[P] - b->from);
    fret_real sum = 0;
    for (fret_real end; hi - lo > little; lo = end) { /* the sign of sigma changes at turns of F_x */
        fret_real turn = turned_to(turned, lo);
        while (turn <= lo + little)
            turn += FRET_PI;
        end = fminl(turn, hi);
        b->lo = lo;
        b->hi = end;
        b->sign = load_path_fall(&b->of, P, b->from + b->side * (lo + end) / 2) > 0 ? -1 : 1;
        sum += b->sign * (end - lo < small ? fret_integral_smooth(other_rate, b)
                                           : fret_integral(other_rate, b, 1e-14L).value);
    }
    return sum;
}

/* The distance from w = 0 to the nearest other singularity in the complex plane of times: where the normal
 * force vanishes, or was N before it turned. */
static fret_real alone(const arc_integral *b) {
    const fret_real angle = turned_to(b->from - b->of.lag[M], -FRET_PI / 2);
    return fminl(sqrtl(2 * b->N / b->of.size[M]), 2 * (angle + FRET_PI));
}

/* The distance from w = 0 to the nearest singularity if the normal force there is not N; at most a period. */
static fret_real near_to(const arc_integral *b) {
    static const fret_real least = 1e-15L, most = 2 * FRET_PI;
    const fret_real off = fabsl(b->beyond) / b->of.size[M],
                    near = fminl(sqrtl(off), off / fabsl(sinl(b->from - b->of.lag[M])));
    return b->weight == INSIDE ? most : fminl(fmaxl(near, least), most);
}

/* The integral over lo < |w| < hi by a Gauss rule per doubling; small pieces need no error check. */
static fret_real sum_doubling(arc_integral *b, fret_real lo, fret_real hi) {
    fret_real sum = 0;
    b->sign = 1;
    for (b->lo = lo; b->lo < hi; b->lo = b->hi) {
        b->hi = fminl(2 * b->lo + b->near, hi);
        sum += fret_integral_smooth(other_rate, b);
    }
    return sum;
}

/* The integral between w = 0 and w = end, of either sign. */
static fret_real integral(arc_integral *b, fret_real end) {
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

/* The sum over one arc: `outside` weights the part whose contacts end inside r, `inside` the other. */
static fret_real sum_of(arc_integral *b, const arc *p, weight outside, weight inside, fret_real factor) {
    fret_real sum = 0;
    fret_swing_loads(&p->path, &b->of);
    const fret_real first = load_path_at(&b->of, M, p->lo) - b->N,
                    last = load_path_at(&b->of, M, p->hi) - b->N;
    b->from = first >= 0 ? p->lo : last <= 0 ? p->hi : load_path_when(&b->of, M, b->N, p->lo, p->hi);
    b->beyond = first >= 0 ? first : last <= 0 ? last : 0;
    b->weight = outside;
    if (outside != ALONG && b->from > p->lo)
        sum += factor * integral(b, p->lo - b->from);
    b->weight = inside;
    if (b->from < p->hi)
        sum += integral(b, p->hi - b->from);
    return sum;
}

static arc_integral begin(const fret_swing *c, fret_real r) {
    const fret_normal *n = c->normal;
    const fret_real e = r - fret_gap_start(&n->gap);
    arc_integral b = {.normal = n, .r = r};
    if (!(r < n->end))
        b.N = (fret_real)INFINITY;
    else if (e > 0) {
        const fret_profile p = fret_gap_profile(&n->gap, &n->rule, e);
        b.N = fret_law_at_radius(n, r).F;
        if (!fret_normal_closed(n)) {
            const fret_real less = 1e-4L * b.N, inner = fret_law_at_force(n, b.N - less).a;
            b.growth = 1 / (p.slope * fret_normal_stiffness(n, r));
            b.curvature = (1 - (r - inner) / (b.growth * less)) / less;
        }
    }
    return b;
}

fret_real fret_swing_slope(const fret_swing *c, fret_real r) {
    arc_integral b = begin(c, r);
    fret_real sum = 0;
    for (size_t i = 0; i < c->count && r < c->a; i++)
        sum += sum_of(&b, &c->arcs[i], ALONG, ALONG, 0);
    return sum;
}

fret_real fret_swing_surface(const fret_swing *c, const flat_field *flat, fret_real factor, fret_real r) {
    arc_integral b = begin(c, r);
    fret_real sum = 0;
    b.flat = flat;
    for (size_t i = 0; i < c->count; i++)
        sum += sum_of(&b, &c->arcs[i], OUTSIDE, INSIDE, factor);
    return sum;
}
