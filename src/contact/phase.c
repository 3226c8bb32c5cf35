/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The loss of a moving slip front: by moments of the law; of a power law by a rule as short as the phase
 * allows, which takes a sixth of that. Pure. */
#include "contact/phase.h"

#include <float.h>

#include "number/quadrature.h"
#include "number/real.h"

/* ---- any shape --------------------------------------------------------------------------------- */

/* While the front goes inwards at d and the edge is at D, slip dissipates int_d^D (D-z) dmu, z depth or load,
 * dmu = dK or -d(1/K). Over the phase that is int psi(z) dmu, with psi(z) = int (D-z) |dd|   over the times
 * at which d < z < D, a quadratic between any two of the places where front and edge begin and end. */
static fret_real weight_at(const fret_phase *p, fret_real z) {
    const fret_real travel = p->front0 - p->front1, growth = p->edge1 - p->edge0,
                    h[2] = {p->edge0 - p->front0, p->edge1 - p->front1};
    /* the part of the phase that is left when z comes to lie between front and edge; D-z then, and at the end
     */
    fret_real left = 1, ahead = p->edge0 - z, end = p->edge1 - z;
    if (z < p->front0) {
        left = (z - p->front1) / travel;
        ahead = h[1] + (h[0] - h[1]) * left;
    } else if (ahead < 0) {
        left = end / growth;
        ahead = 0;
    }
    if (end < 0) { /* the edge passes z, when front and edge are as far apart as they are then */
        left = z < p->front0 ? (h[1] * (p->edge0 - z) - h[0] * end) / (travel * -growth) : ahead / -growth;
        end = 0;
    }
    return travel * left * (ahead + end) / 2;
}

/* psi between two places, in Bernstein's form: int (h-t)^2 dmu, int t (h-t) dmu and int t^2 dmu, t from the
 * outer one. */
static fret_real loss_between(const fret_phase *p, fret_real inner, fret_real outer) {
    const fret_normal *n = p->normal;
    const fret_real ends[2] = {weight_at(p, outer), weight_at(p, inner)},
                    middle = 2 * weight_at(p, (inner + outer) / 2) - (ends[0] + ends[1]) / 2,
                    width = outer - inner;
    const bool by_load = p->by == LOAD;
    fret_level level = {outer, outer}; /* of cells that which the step goes by is enough */
    if (fret_normal_closed(n) && by_load)
        level.y = fret_law_depth(n, outer);
    else if (fret_normal_closed(n))
        level.F = fret_law_force(n, outer);
    const fret_slice s = fret_law_slice_to(n, &level, by_load, width, inner);
    const fret_real N = (s.h * s.fall - s.G) / (by_load ? s.K + s.fall : 1), G = by_load ? s.G / s.K : s.G;
    fret_real sum = 2 * middle * s.L + ends[0] * (width * N - s.L);
    if (ends[1] > 0)
        sum += ends[1] * (width * G - s.L);
    return sum / (width * width);
}

fret_real fret_phase_loss_by_law(const fret_phase *phase) {
    fret_phase p = *phase;
    p.front0 = fminl(p.front0, p.edge0); /* whatever rounding says */
    p.front1 = fmaxl(fminl(p.front1, p.edge1), 0);
    fret_real place[4] = {p.front1, p.front0, p.edge0, p.edge1}, sum = 0;
    for (int i = 1; i < 4; i++)
        for (int j = i; j > 0 && place[j] < place[j - 1]; j--) {
            const fret_real z = place[j];
            place[j] = place[j - 1];
            place[j - 1] = z;
        }
    for (int i = 0; i < 3 && p.front1 < p.front0; i++)
        if (place[i + 1] > place[i])
            sum += loss_between(&p, place[i], place[i + 1]);
    return sum;
}

/* ---- the power law ----------------------------------------------------------------------------- */

/* Gauss's rule of four points: 1e-19 for a rate that is smooth farther than 60 times the way. */
static fret_real short_rule(fret_integrand *rate, void *context) {
    static const fret_real node[2] = {0.0694318442029737123880267555535953L,
                                      0.330009478207571867598667120448378L},
                           weight[2] = {0.173927422568726928686531974610999L,
                                        0.326072577431273071313468025389001L};
    fret_real sum = 0;
    for (int i = 0; i < 2; i++)
        sum += weight[i] * (rate(node[i], 1 - node[i], context) + rate(1 - node[i], node[i], context));
    return sum;
}

/* Is the rate smooth: a small step, far from the centre? */
static bool is_smooth(const fret_phase *p) {
    return p->front1 > 0.8L * p->front0 && p->edge1 > 0.8L * p->edge0 && p->edge0 > 0.8L * p->edge1;
}

/* Does edge or front come near the centre without reaching it? A rate is singular there, just beyond an end,
 * where no rule expects it: by halves, then. */
static bool comes_near(const fret_phase *p) {
    const fret_real most = fmaxl(p->edge0, p->edge1), least = fminl(p->edge0, p->edge1);
    return (p->front1 > 0 && p->front1 < p->front0 / 4) || (least > 0 && least < most / 4);
}

static fret_real by_halves(const fret_phase *p, fret_real (*loss)(const fret_phase *)) {
    fret_phase first = *p, second = *p;
    first.edge1 = second.edge0 = (p->edge0 + p->edge1) / 2;
    first.front1 = second.front0 = (p->front0 + p->front1) / 2;
    first.edge_v[1] = second.edge_v[0] = first.front_v[1] = second.front_v[0] = -1;
    return loss(&first) + loss(&second);
}

/* Depth by load and load by depth are both powers v = e^s of the coordinate, and the rate is how far the
 * power at the edge lies from its tangent at the front: v(e) |m(x)|, x = (e-f)/e the thickness of the zone,
 *   m(x) = 1 - (1-x)^s - s x (1-x)^(s-1). */
typedef struct power_phase {
    const fret_phase *p;
    fret_real s, sm1; /* the exponent, and s-1 without cancellation */
    fret_real e, v;   /* the larger of both edges, and the power there */
} power_phase;

/* |m| as a series, whose terms fall at least as fast as s x. */
static fret_real thin_bow(const power_phase *c, fret_real x) {
    const fret_real slope = c->sm1 * x;
    fret_real term = c->s * slope * x, sum = 0;
    const fret_real small = LDBL_EPSILON / 4 * fabsl(term);
    for (int i = 1; fabsl(term) > small; i++) {
        sum += term / (fret_real)(i + 1);
        term *= x - slope / (fret_real)i;
    }
    return fabsl(sum);
}

static fret_real bow(const power_phase *c, fret_real x, fret_real inner) {
    if (fmaxl(c->s, 1) * x < 0.2L)
        return thin_bow(c, x);
    const fret_real log = x < 0.5L ? log1pl(-x) : logl(inner), em = expm1l(c->sm1 * log);
    return fabsl(em * (1 + c->sm1 * x) + c->sm1 * x);
}

/* (1+u)^s, -1 < u <= 0 */
static fret_real power_near(const power_phase *c, fret_real u) {
    if (c->s * -u > 0.02L || -u > 0.02L)
        return expl(c->s * log1pl(u));
    fret_real term = c->s * u, sum = 1 + term;
    for (int i = 2; fabsl(term) > LDBL_EPSILON / 4; i++) {
        term *= u * (c->s - (fret_real)(i - 1)) / (fret_real)i;
        sum += term;
    }
    return sum;
}

static fret_real power_rate(fret_real t, fret_real rest, void *context) {
    const power_phase *c = context;
    const fret_phase *p = c->p;
    const fret_real e = p->edge0 * rest + p->edge1 * t, f = p->front0 * rest + p->front1 * t;
    const fret_real d = (p->edge0 - p->front0) * rest + (p->edge1 - p->front1) * t;
    if (d <= 0 || f <= 0) /* the centre has no weight */
        return 0;
    const fret_real below = p->edge0 > p->edge1 ? (p->edge1 - p->edge0) * t : (p->edge0 - p->edge1) * rest;
    return c->v * power_near(c, below / c->e) * bow(c, d / e, f / e);
}

/* Zones that come far: a straight line dissipates nothing, so v less its chord from the centre counts alone,
 *   u = x^s - x, x = y/e,   int_0^x u dx = x (u - (s-1) x/2)/(s+1),
 * and the loss is travel [mean of u(edge) - mean of u(front)] + [thickness (u(front) - mean of u(front))],
 * from one end of the phase to the other. */
static fret_real bent(const power_phase *c, fret_real x) {
    return x > 0 ? x * expm1l(c->sm1 * logl(x)) : 0;
}

static fret_real mean_bent(const power_phase *c, fret_real x0, fret_real u0, fret_real x1, fret_real u1) {
    if (fabsl(x1 - x0) < 0.05L * fmaxl(x0, x1)) /* not of use here */
        return (fret_real)NAN;
    return (x1 * (u1 - c->sm1 * x1 / 2) - x0 * (u0 - c->sm1 * x0 / 2)) / ((c->s + 1) * (x1 - x0));
}

/* NaN where it would lose digits. */
static fret_real closed_loss(const power_phase *c) {
    const fret_phase *p = c->p;
    const fret_real edge[2] = {p->edge0 / c->e, p->edge1 / c->e},
                    front[2] = {p->front0 / c->e, p->front1 / c->e}, travel = (p->front0 - p->front1) / c->e;
    const fret_real u[2] = {bent(c, edge[0]), bent(c, edge[1])},
                    v[2] = {bent(c, front[0]), bent(c, front[1])};
    const fret_real above = p->edge0 == p->edge1 ? u[0] : mean_bent(c, edge[0], u[0], edge[1], u[1]),
                    below = mean_bent(c, front[0], v[0], front[1], v[1]);
    const fret_real loss = fabsl(travel * (above - below) + ((edge[1] - front[1]) * (v[1] - below) -
                                                             (edge[0] - front[0]) * (v[0] - below)));
    return loss > 0.02L * fabsl(c->s * c->sm1) ? c->e * c->v * loss : (fret_real)NAN;
}

/* ---- the same from the series of the law ------------------------------------------------------- */

/* h^2 times the terms 2 to 4 of the divided difference of the law at the edge, the front and the front again,
 * y = c (1+z). h: thickness, w: front. */
FRET_INLINE fret_real leading_terms(const double *b, fret_real h, fret_real w) {
    return h * h * (b[2] + (b[3] * (3 * w + h) + b[4] * (w * (6 * w + 4 * h) + h * h)));
}

/* The other terms, and what is left of those, in double: means over the phase by Gauss's rule. */
static double other_terms(const fret_near_law *law, double h0, double h1, double w0, double w1, double radius,
                          double way) {
    const int terms = radius < 0.0166  ? radius < 0.006 ? 10 : 12
                      : radius < 0.066 ? radius < 0.033 ? 14 : 17
                      : radius < 0.103 ? 20
                                       : FRET_NEAR_TERMS;
    const int pairs = way < 0.006 && way * (double)law->s < 0.006 ? 2 : 4;
    const fret_two *node = pairs == 2 ? fret_gauss_4 : fret_gauss_8,
                   *weight = pairs == 2 ? fret_gauss_4_weight : fret_gauss_8_weight;
    const double a0 = w0, da = w1 - w0, k0 = h0, dk = h1 - h0;
    fret_two sum = {0, 0};
    for (int k = 0; k < pairs; k += 2) {
        const fret_two h_1 = k0 + dk * node[k], h_2 = k0 + dk * node[k + 1];
        const fret_two w_1 = a0 + da * node[k], w_2 = a0 + da * node[k + 1], v_1 = w_1 + h_1, v_2 = w_2 + h_2;
        fret_two x1 = (fret_two){0, 0} + law->rest[terms - 1], y1 = x1, z1 = x1, x2 = x1, y2 = x1, z2 = x1;
        for (int i = terms - 2; i >= 2; i--) {
            x1 = x1 * w_1 + law->rest[i];
            x2 = x2 * w_2 + law->rest[i];
            y1 = y1 * w_1 + x1;
            y2 = y2 * w_2 + x2;
            z1 = z1 * v_1 + y1;
            z2 = z2 * v_2 + y2;
        }
        sum += weight[k] * (h_1 * h_1) * z1 + weight[k + 1] * (h_2 * h_2) * z2;
    }
    return sum[0] + sum[1];
}

/* A thin zone that stays near, about the middle c of all: the leading terms by a rule of three points, which
 * is exact for them. */
static fret_real thin_loss(const fret_phase *p, fret_real least, fret_real most) {
    const fret_near_law *law = &p->near->law[p->by];
    const fret_real c = (least + most) / 2, per = 1 / c;
    const fret_real h0 = (p->edge0 - p->front0) * per, h1 = (p->edge1 - p->front1) * per;
    const fret_real w0 = (p->front0 - c) * per, w1 = (p->front1 - c) * per;
    const double travel = (double)(w0 - w1), move = fabs((double)(h1 - h0) - travel);
    const double others = other_terms(law, (double)h0, (double)h1, (double)w0, (double)w1,
                                      (double)((most - c) * per), travel > move ? travel : move);
    const fret_real part = 0.3872983346207416885179265399782400L; /* sqrt(3/5)/2 */
    const fret_real h = (h0 + h1) / 2, dh = (h1 - h0) * part, w = (w0 + w1) / 2, dw = (w1 - w0) * part;
    const fret_real first =
        (5 * (leading_terms(law->binomial, h - dh, w - dw) + leading_terms(law->binomial, h + dh, w + dw)) +
         8 * leading_terms(law->binomial, h, w)) /
        18;
    return fret_near_value(p->near, p->by, c) * (p->front0 - p->front1) * fabsl(first + others);
}

/* Of the way of edge or front: the mean of the law, that of both ends less it, and half their difference. */
typedef struct span {
    fret_real mean, lift, half;
    bool far;
} span;

/* c[0] + c[1] x + ... */
FRET_INLINE double way_series(const double c[FRET_NEAR_WAY], double x) {
    const double x2 = x * x, x4 = x2 * x2;
    return ((c[0] + x * c[1]) + x2 * (c[2] + x * c[3])) + x4 * ((c[4] + x * c[5]) + x2 * (c[6] + x * c[7]));
}

FRET_INLINE fret_real value_of(const fret_phase *p, fret_real y, fret_real given) {
    return given >= 0 ? given : y > 0 ? fret_near_value(p->near, p->by, y) : 0;
}

/* way: from y0 to y1 */
FRET_INLINE void find_span(const fret_near_law *law, fret_real y0, fret_real y1, fret_real way, fret_real v0,
                           fret_real v1, span *out) {
    const fret_real part = way / (y0 + y1), square = part * part, both = (v0 + v1) / 2;
    const double x = (double)square;
    out->far = x > law->most_square;
    if (out->far) {
        out->mean = (v0 + y1 * ((v1 - v0) / way)) / (law->s + 1);
        out->lift = both - out->mean;
        out->half = (v1 - v0) / 2;
    } else {
        out->lift = both * (square * (law->first_sag + x * way_series(law->sag, x)));
        out->mean = both - out->lift;
        out->half = both * part * (law->s + square * (law->first_lean + x * way_series(law->lean, x)));
    }
}

/* NaN where many points do better. */
static fret_real thick_loss(const fret_phase *p) {
    const fret_near_law *law = &p->near->law[p->by];
    const fret_real travel = p->front0 - p->front1, move = p->edge1 - p->edge0;
    span e, f;
    find_span(law, p->front0, p->front1, -travel, value_of(p, p->front0, p->front_v[0]),
              value_of(p, p->front1, p->front_v[1]), &f);
    const fret_real ends =
        (move + travel) * f.lift + ((p->edge0 - p->front0) + (p->edge1 - p->front1)) * f.half;
    find_span(law, p->edge0, p->edge1, move, value_of(p, p->edge0, p->edge_v[0]),
              value_of(p, p->edge1, p->edge_v[1]), &e);
    const fret_real loss = fabsl(travel * (e.mean - f.mean) + ends), scale = travel * e.mean;
    if (e.far || f.far)
        return loss > 0.03 * scale ? loss : (fret_real)NAN;
    if (loss > 0.02 * scale)
        return loss;
    fret_real low_e, low_f; /* little is left: the difference by all bits */
    const fret_real high = fret_near_parts(p->near, p->by, p->edge0, &low_e) -
                           fret_near_parts(p->near, p->by, p->front0, &low_f);
    const fret_real off = (e.lift - e.half) - (f.lift - f.half);
    const fret_real exact = fabsl(travel * (high + ((low_e - low_f) - off)) + ends);
    return exact > 0.008 * scale ? exact : (fret_real)NAN;
}

/* NaN where many points do better. */
static fret_real near_loss(const fret_phase *p) {
    const fret_real most = fret_greater(p->edge0, p->edge1),
                    least = fret_lesser(fret_lesser(p->edge0, p->edge1), p->front1);
    const fret_real way = fret_greater(p->front0 - p->front1, fabsl(p->edge1 - p->edge0));
    return most - least <= 0.15 * (most + least) && way * fret_greater(p->near->law[p->by].s, 1) < 0.16 * most
               ? thin_loss(p, least, most)
               : thick_loss(p);
}

static fret_real power_loss(const fret_phase *p) {
    const fret_normal *n = p->normal;
    if (p->near && p->front0 > p->front1) {
        const fret_real fast = near_loss(p);
        if (fast >= 0)
            return fast;
    }
    const fret_real e = fret_greater(p->edge0, p->edge1);
    power_phase c = {p, n->p, n->pm1, e, 0};
    if (p->by == LOAD) {
        c.s = n->q;
        c.sm1 = -n->pm1 * n->q;
    }
    if (e <= 0)
        return 0;
    c.v = p->by == DEPTH ? fret_law_force(n, e) : fret_law_depth(n, e);
    const fret_real way =
        fret_greater(p->front0 - p->front1, fabsl(p->edge1 - p->edge0)) * fret_greater(c.s, 1);
    if (way < 0.006L * p->front1)
        return (p->front0 - p->front1) * short_rule(power_rate, &c);
    if (is_smooth(p))
        return (p->front0 - p->front1) * fret_integrate_smooth(power_rate, &c);
    const fret_real closed = closed_loss(&c);
    if (closed >= 0)
        return closed;
    if (comes_near(p))
        return by_halves(p, power_loss);
    return (p->front0 - p->front1) * fret_integrate(power_rate, &c);
}

fret_real fret_phase_rate_by_load(const fret_normal *n, fret_real edge, fret_real front, fret_real zone) {
    const power_phase c = {.s = n->q, .sm1 = -n->pm1 * n->q};
    if (!(zone > 0 && front > 0))
        return 0;
    if (fret_normal_closed(n))
        return fret_law_depth(n, edge) * bow(&c, zone / edge, front / edge);
    const fret_level outer = {fret_law_depth(n, edge), edge};
    const fret_slice s = fret_law_slice_to(n, &outer, true, zone, front);
    return s.K > 0 ? s.G / s.K : 0; /* the centre has no weight */
}

fret_real fret_phase_loss(const fret_phase *phase) {
    return fret_normal_closed(phase->normal) ? power_loss(phase) : fret_phase_loss_by_law(phase);
}

/* The mean of the law is that of its chord, less half of what lies between. */
fret_real fret_phase_force(const fret_phase *phase) {
    const fret_normal *n = phase->normal;
    const fret_real outer = fmaxl(phase->edge0, phase->edge1), inner = fminl(phase->edge0, phase->edge1),
                    F = fret_law_force(n, outer);
    if (!(outer > inner))
        return F;
    const fret_slice s = fret_law_slice(n, &(fret_level){outer, F}, outer - inner);
    return F - s.w / 2 - s.L / (2 * s.h);
}
