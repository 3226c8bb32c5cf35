/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The loss of a zone of slip under a power law, in double: from a polynomial while the zone stays near the
 * edge, in closed form else. Pure. */
#include "fast/zone.h"

#include <float.h>

#include "number/quadrature.h"
#include "number/real.h"

/* Near y = Y the curvature of the law is a polynomial, by interpolation: singular at the centre, it is told
 * to 2e-15 by 14 terms over the outer 0.3 of the way there, or over as much less as a steeper law takes. */
static void make_near(fret_double_law *law) {
    enum { N = FRET_ZONE_TERMS };
    const fret_real radius = law->reach / 2;
    fret_real series[N] = {0}, now[N] = {0}, last[N] = {0}, sum[N] = {0};
    for (int i = 0; i < N; i++) {
        const fret_real angle = FRET_PI * (i + 0.5L) / (fret_real)N,
                        value = fret_pow(1 - radius + radius * cosl(angle), law->sm1 - 1.0L);
        for (int j = 0; j < N; j++)
            series[j] += (j ? 2.0L : 1.0L) / (fret_real)N * value * cosl(j * angle);
    }
    now[0] = 1; /* Chebyshev's polynomials as powers */
    for (int j = 0; j < N; j++) {
        fret_real next[N];
        for (int i = 0; i < N; i++) {
            sum[i] += series[j] * now[i];
            next[i] = (j ? 2 : 1) * (i ? now[i - 1] : 0) - last[i];
        }
        for (int i = 0; i < N; i++) {
            last[i] = now[i];
            now[i] = next[i];
        }
    }
    for (int j = 0; j < N; j++)
        law->near[j] = (double)(sum[j] / (fret_real)((j + 1) * (j + 2)));
}

void fret_double_law_make(double s, double sm1, fret_double_law *law) {
    *law = (fret_double_law){.s = s, .sm1 = sm1, .bend = fabs(s * sm1), .reach = s > 8 ? 0.3 * 8 / s : 0.3};
    law->per_reach = 1 / law->reach;
    const double twice = 2 * s;
    if (twice == floor(twice) && twice <= (double)FRET_ZONE_HALVES)
        law->halves = (int)twice;
    make_near(law);
}

double fret_double_law_power(const fret_double_law *law, double x) {
    if (!law->halves)
        return pow(x, law->s);
    double power = law->halves & 1 ? sqrt(x) : 1;
    for (int i = law->halves; i > 1; i -= 2)
        power *= x;
    return power;
}

/* By Gauss's rule, of eight points for motion over the reach, four for a seventh of it. With v and w the
 * places of edge and front, -1 .. 1 over the reach, the power j of the curvature gives (v-w)^2/((j+1)(j+2))
 * times the divided difference of x^(j+2) at v, w, w: Horner's scheme for w, again for w, and for v, with no
 * difference of large numbers. */
FRET_INLINE double near_rule(const fret_double_law *law, const fret_zone *z, double Y, double V,
                             const int pairs, const fret_two node[], const fret_two weight[]) {
    const double per = 1 / Y, scale = 2 * per * law->per_reach, middle = Y - Y * law->reach / 2;
    const double v0 = (z->edge[0] - middle) * scale, dv = (z->edge[1] - z->edge[0]) * scale,
                 w0 = (z->front[0] - middle) * scale, dw = -z->travel * scale, h0 = z->thick[0] * per,
                 dh = (z->thick[1] - z->thick[0]) * per;
    fret_two all = {0, 0};
    for (int k = 0; k < pairs; k += 2) {
        const fret_two v = v0 + dv * node[k], w = w0 + dw * node[k], h = h0 + dh * node[k];
        const fret_two v2 = v0 + dv * node[k + 1], w2 = w0 + dw * node[k + 1], h2 = h0 + dh * node[k + 1];
        fret_two a = (fret_two){0, 0} + law->near[FRET_ZONE_TERMS - 1], b = a, c = a, a2 = a, b2 = a, c2 = a;
        for (int j = FRET_ZONE_TERMS - 2; j >= 0; j--) {
            a = a * w + law->near[j];
            a2 = a2 * w2 + law->near[j];
            b = b * w + a;
            b2 = b2 * w2 + a2;
            c = c * v + b;
            c2 = c2 * v2 + b2;
        }
        all += weight[k] * (h * h) * c + weight[k + 1] * (h2 * h2) * c2;
    }
    return z->travel * V * law->bend * (all[0] + all[1]);
}

static double near_loss(const fret_double_law *law, const fret_zone *z, double Y, double V) {
    const double small = 0.04 * Y;
    return z->travel < small && fabs(z->edge[1] - z->edge[0]) < small
               ? near_rule(law, z, Y, V, 2, fret_gauss_4, fret_gauss_4_weight)
               : near_rule(law, z, Y, V, 4, fret_gauss_8, fret_gauss_8_weight);
}

/* ---- closed forms ------------------------------------------------------------------------------ */

/* int_0^1 of a function from itself and two derivatives at both ends. */
static double two_ends(const double f[2], const double f1[2], const double f2[2]) {
    return (f[0] + f[1]) / 2 + (f1[0] - f1[1]) / 10 + (f2[0] + f2[1]) / 120;
}

/* Are two places so close that the formula of two ends is exact, and a difference quotient loses digits? */
static bool close_by(const fret_double_law *law, double y0, double y1) {
    return fabs(y1 - y0) * greater(law->s, 1) <= 0.01 * lesser(y0, y1);
}

double fret_double_law_mean(const fret_double_law *law, double y0, double v0, double y1, double v1) {
    const double way = y1 - y0;
    if (!close_by(law, y0, y1))
        return (y1 * v1 - y0 * v0) / ((law->s + 1) * way);
    const double f[2] = {v0, v1}, f1[2] = {law->s * v0 / y0 * way, law->s * v1 / y1 * way},
                 f2[2] = {law->sm1 * f1[0] / y0 * way, law->sm1 * f1[1] / y1 * way};
    return way == 0 ? v0 : two_ends(f, f1, f2);
}

/* A straight line dissipates nothing: what counts is u = x^s - x, x = y/Y, and all that comes of it has the
 * factor s-1. */
typedef struct bent {
    double x, u;
} bent;

static bent bent_of(const fret_double_law *law, double y, double v, double Y, double V) {
    if (y == Y)
        return (bent){1, 0};
    const double x = y / Y;
    if (!(x > 0))
        return (bent){0, 0};
    if (law->bend < FRET_ZONE_STRAIGHT)
        return (bent){x, x * expm1(law->sm1 * log(x))};
    return (bent){x, (v >= 0 ? v : fret_double_law_value(law, y)) / V - x};
}

static double first(const fret_double_law *law, const bent *b) {
    return law->s * b->u / b->x + law->sm1;
}

static double second(const fret_double_law *law, const bent *b) {
    return law->s * law->sm1 * (b->u + b->x) / (b->x * b->x);
}

/* int_0^x u dx */
static double area(const fret_double_law *law, const bent *b) {
    return b->x * (b->u - law->sm1 * b->x / 2) / (law->s + 1);
}

static double mean(const fret_double_law *law, const bent *a, const bent *b) {
    const double way = b->x - a->x;
    if (!close_by(law, a->x, b->x))
        return (area(law, b) - area(law, a)) / way;
    const double f[2] = {a->u, b->u}, f1[2] = {first(law, a) * way, first(law, b) * way},
                 f2[2] = {second(law, a) * way * way, second(law, b) * way * way};
    return way == 0 ? a->u : two_ends(f, f1, f2);
}

/* A thick zone that moves little: from the rate at both ends. */
static double slow_loss(const fret_double_law *law, const bent edge[2], const bent front[2],
                        const double h[2], double travel) {
    const double de = edge[1].x - edge[0].x, df = -travel;
    double f[2], f1[2], f2[2];
    for (int i = 0; i < 2; i++) {
        const double k1 = first(law, &front[i]), k2 = second(law, &front[i]),
                     k3 = (law->s - 2) * k2 / front[i].x;
        f[i] = edge[i].u - front[i].u - h[i] * k1;
        f1[i] = de * (first(law, &edge[i]) - k1) - h[i] * df * k2;
        f2[i] = de * de * second(law, &edge[i]) - df * (2 * de - df) * k2 - h[i] * df * df * k3;
    }
    return travel * two_ends(f, f1, f2);
}

/* Of zones that come far from the edge. Where little is left of large terms, by halves. */
static double part_loss(const fret_double_law *law, const fret_zone *z, double Y, double V, int depth) {
    if (lesser(z->front[0], z->front[1]) >= Y * (1 - law->reach))
        return near_loss(law, z, Y, V);
    bent edge[2], front[2];
    const double h[2] = {z->thick[0] / Y, z->thick[1] / Y}, travel = z->travel / Y;
    for (int i = 0; i < 2; i++) {
        edge[i] = bent_of(law, z->edge[i], z->edge_v[i], Y, V);
        front[i] = bent_of(law, z->front[i], z->front_v[i], Y, V);
    }
    if (close_by(law, edge[0].x, edge[1].x) && close_by(law, front[0].x, front[1].x))
        return Y * V * fabs(slow_loss(law, edge, front, h, travel));
    /* travel [mean of u(D) - mean of u(d)] + [h (u(d) - mean of u(d))] between both ends */
    const double middle = mean(law, &front[0], &front[1]);
    const double loss = fabs(travel * (mean(law, &edge[0], &edge[1]) - middle) +
                             (h[1] * (front[1].u - middle) - h[0] * (front[0].u - middle)));
    if (depth == 0 || loss > 1e-4 * law->bend)
        return Y * V * loss;
    double sum = 0;
    for (int i = 0; i < 2; i++) {
        fret_zone half = *z;
        const int cut = !i;
        half.edge[cut] = (z->edge[0] + z->edge[1]) / 2;
        half.front[cut] = (z->front[0] + z->front[1]) / 2;
        half.thick[cut] = (z->thick[0] + z->thick[1]) / 2;
        half.edge_v[cut] = half.front_v[cut] = -1;
        half.travel = z->travel / 2;
        const double top = greater(half.edge[0], half.edge[1]);
        sum += part_loss(law, &half, top, fret_double_law_value(law, top), depth - 1);
    }
    return sum;
}

/* A place of the zone in roots: of the front, of the edge, and between them. */
typedef struct roots {
    double q, p, e;
} roots;

FRET_INLINE roots roots_of(const fret_double_law *law, const fret_zone *z, int i) {
    const double p = sqrt(z->edge[i] * law->per_y), q = sqrt(z->front[i] * law->per_y);
    return (roots){q, p, p > 0 ? z->thick[i] * law->per_y / (p + q) : 0};
}

/* One end's terms of the sum below: what hangs on e, which comes last, in few operations after it. */
FRET_INLINE double root_terms(const roots *a, const roots *b) {
    const double q = a->q, r = b->q, q2 = q * q, qr = q * r, r2 = r * r,
                 none = q2 * (3 * q2 + (9 * qr + 8 * r2)), own = q * (5 * q2 + (12 * qr + 8 * r2)),
                 other = q * (3 * q2 + 10 * qr) + r * (10 * qr + 2 * r2);
    return (a->e * a->e) * ((none + a->e * own) + b->e * other);
}

/* Under v ~ y^(3/2), in p = sqrt(D) and q = sqrt(d): the rate is (p-q)^2 (p+q/2), and its integral a sum of
 * positive terms in q and e = (D-d)/(p+q), which loses no digits wherever the zone is. */
static double root_loss(const fret_double_law *law, const fret_zone *z) {
    const roots a = roots_of(law, z, 0), b = roots_of(law, z, 1);
    const double c = a.q + b.q, c2 = c * c, qr = a.q * b.q,
                 scale = z->travel * law->v / (5 * c2 * (a.p + b.p)), e2 = a.e * a.e, f2 = b.e * b.e,
                 ef = a.e * b.e;
    const double sum = (root_terms(&a, &b) + root_terms(&b, &a)) +
                       (ef * (4 * qr * (c2 + qr)) + 2 * c2 * ((e2 * e2 + f2 * f2) + ef * (e2 + ef + f2)));
    return scale * sum;
}

double fret_zone_loss(const fret_double_law *law, const fret_zone *zone, double Y, double V) {
    enum { HALVINGS = 5 };
    if (!(zone->travel > 0 && Y > 0))
        return 0;
    return law->halves == 3 ? root_loss(law, zone) : part_loss(law, zone, Y, V, HALVINGS);
}
