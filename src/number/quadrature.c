/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The rules of quadrature.h. Pure arithmetic. */
#include "number/quadrature.h"

#include <float.h>
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>

#include "number/constants.h"
#include "number/sum.h"

/* step 1/12: 1e-15 with a singularity half a unit off the axis */
fret_node fret_exponential_node(int i) {
    int j = i - FRET_EXPONENTIAL / 2;
    fret_real small = exponential_rule[abs(j)].small, weight = exponential_rule[abs(j)].weight;
    return j < 0 ? (fret_node){small, 1 - small, weight} : (fret_node){1 - small, small, weight};
}

fret_real fret_integrate(fret_integrand *f, void *context) {
    fret_sum sum = {0, 0};
    for (int i = FRET_EXPONENTIAL; i-- > 0;) {
        fret_node node = fret_exponential_node(i);
        fret_sum_add(&sum, node.weight * f(node.t, node.rest, context));
    }
    return fret_sum_value(&sum);
}

/* A part of 0..1. */
typedef struct part {
    fret_integrand *f;
    void *context;
    fret_real lo, hi;
} part;

static fret_real part_at(const part *p, fret_real t, fret_real rest) {
    return p->f(p->lo * rest + p->hi * t, (1 - p->lo) * rest + (1 - p->hi) * t, p->context);
}

static fret_real part_rate(fret_real t, fret_real rest, void *context) {
    return part_at(context, t, rest);
}

/* By the rule; how far it may be off; with |f| for f. */
typedef struct estimate {
    fret_real sum, error, size;
} estimate;

/* Every other node is off by d/q where all are by d, and every fourth by d/q^(3/2) (q < 1), as digits double.
 * A singularity that is close, but touches little, makes q larger. */
static fret_real error_of(fret_real all, fret_real other, fret_real fourth) {
    const fret_real near = fabsl(all - other), far = fmaxl(fabsl(other - fourth), near);
    const fret_real q = far > 0 ? near / far : 0;
    return near * q * sqrtl(q); /* not q^2: both may be small by chance */
}

static estimate by_rule(const part *p) {
    enum { MIDDLE = FRET_EXPONENTIAL / 2 };
    fret_sum every[3] = {{0, 0}, {0, 0}, {0, 0}}, size = {0, 0}; /* fourth, other second, other */
    const fret_real width = p->hi - p->lo;
    for (int i = FRET_EXPONENTIAL; i-- > 0;) {
        const fret_node node = fret_exponential_node(i);
        const fret_real v = width * node.weight * part_at(p, node.t, node.rest);
        const int from = abs(i - MIDDLE) % 4;
        fret_sum_add(&every[from == 0 ? 0 : from == 2 ? 1 : 2], v);
        fret_sum_add(&size, fabsl(v));
    }
    const fret_real fourth = fret_sum_value(&every[0]), other = fourth + fret_sum_value(&every[1]),
                    all = other + fret_sum_value(&every[2]);
    return (estimate){all, error_of(all, 2 * other, 4 * fourth), fret_sum_value(&size)};
}

enum { PATIENCE = 2 };
static const fret_real NOISY = 1e-10L;

/* How far the halves of a part are from the whole, of the whole, and how often that has not fallen from part
 * to half. */
typedef struct quarrel {
    fret_real most;
    int times;
} quarrel;

/* In halves until these add up to the whole, to 1e-15 of the size of all. */
static fret_real in_halves(const part *p, const estimate *whole, fret_real size, quarrel before, int *parts) {
    const fret_real mid = (p->lo + p->hi) / 2;
    const part left = {p->f, p->context, p->lo, mid}, right = {p->f, p->context, mid, p->hi};
    *parts -= 2;
    const estimate a = by_rule(&left), b = by_rule(&right);
    const fret_real error = fabsl(a.sum + b.sum - whole->sum), off = error / whole->size;
    const quarrel now = {off, off < before.most ? 0 : before.times + 1};
    if (*parts <= 0 || !(error > 1e-15L * size) || (now.times >= PATIENCE && off < NOISY))
        return a.sum + b.sum;
    return in_halves(&left, &a, size, now, parts) + in_halves(&right, &b, size, now, parts);
}

fret_real fret_integrate_closely(fret_integrand *f, void *context) {
    const part all = {f, context, 0, 1};
    const estimate whole = by_rule(&all);
    int parts = 200;
    return whole.error > 1e-15L * whole.size
               ? in_halves(&all, &whole, whole.size, (quarrel){INFINITY, 0}, &parts)
               : whole.sum;
}

const fret_two fret_gauss_4[2] = {{0x1.1c6490c2719ecp-4, 0x1.dc736de7b1cc3p-1},
                                  {0x1.51ee013116102p-2, 0x1.5708ff6774f7fp-1}};
const fret_two fret_gauss_4_weight[2] = {{0x1.64340f7e7b66bp-3, 0x1.64340f7e7b66bp-3},
                                         {0x1.4de5f840c24cap-2, 0x1.4de5f840c24cap-2}};
const fret_two fret_gauss_8[4] = {{0x1.454e34f533998p-6, 0x1.f5d58e5856633p-1},
                                  {0x1.a06d536d82f88p-4, 0x1.cbf255924fa0fp-1},
                                  {0x1.e5dad4f9af698p-3, 0x1.86894ac19425ap-1},
                                  {0x1.a214dac30e32fp-2, 0x1.2ef5929e78e69p-1}};
const fret_two fret_gauss_8_weight[4] = {{0x1.9ea1d04ca0374p-5, 0x1.9ea1d04ca0374p-5},
                                         {0x1.c76fb531d2b96p-4, 0x1.c76fb531d2b96p-4},
                                         {0x1.413c50a255615p-3, 0x1.413c50a255615p-3},
                                         {0x1.736360b199343p-3, 0x1.736360b199343p-3}};

fret_real fret_integrate_smooth(fret_integrand *f, void *context) {
    fret_real sum = 0;
    for (int i = 0; i < 8; i++)
        sum += fret_gauss_weight[i] * f(fret_gauss_node[i], fret_gauss_node[7 - i], context);
    return sum;
}

/* By eight points, if their halves agree. */
static bool by_few(fret_integrand *f, void *context, fret_real agree, fret_real *sum) {
    part left = {f, context, 0, 0.5L}, right = {f, context, 0.5L, 1};
    const fret_real whole = fret_integrate_smooth(f, context);
    const fret_real halves =
        (fret_integrate_smooth(part_rate, &left) + fret_integrate_smooth(part_rate, &right)) / 2;
    *sum = halves;
    return fabsl(halves - whole) <= agree * fabsl(halves);
}

fret_real fret_integrate_short(fret_integrand *f, void *context, fret_real agree) {
    fret_real sum;
    return by_few(f, context, agree, &sum) ? sum : fret_integrate(f, context);
}

fret_real fret_integrate_short_closely(fret_integrand *f, void *context, fret_real agree) {
    fret_real sum;
    return by_few(f, context, agree, &sum) ? sum : fret_integrate_closely(f, context);
}

/* Halves of a smooth integrand agree better than the whole with them; where they do not so often, and that is
 * no more than that, it is noise: rounded rows of a table. */
static const fret_real NOISE = 1e-9L;

/* int_lo^hi f by halves until they add up to the whole, or differ by noise. tolerance: of the integral. */
static fret_real bisect(fret_integrand *f, void *context, fret_real lo, fret_real hi, fret_real whole,
                        fret_real tolerance, quarrel before, int depth) {
    const fret_real mid = (lo + hi) / 2;
    part left = {f, context, lo, mid}, right = {f, context, mid, hi};
    fret_real a = (mid - lo) * fret_integrate_smooth(part_rate, &left),
              b = (hi - mid) * fret_integrate_smooth(part_rate, &right);
    const fret_real off = fabsl(a + b - whole) / (a + b);
    const quarrel now = {off, off < before.most ? 0 : before.times + 1};
    if (depth == 0 || off <= tolerance || !(a + b > 0) ||
        (now.times >= PATIENCE && off <= fmaxl(NOISE, 100 * tolerance)))
        return a + b;
    tolerance *= (a + b) / fmaxl(fmaxl(a, b), LDBL_MIN); /* the smaller half may err by more of itself */
    return bisect(f, context, lo, mid, a, tolerance, now, depth - 1) +
           bisect(f, context, mid, hi, b, tolerance, now, depth - 1);
}

fret_real fret_integrate_pieces(fret_integrand *f, void *context, fret_real tolerance) {
    return bisect(f, context, 0, 1, fret_integrate_smooth(f, context), tolerance, (quarrel){INFINITY, 0}, 24);
}

/* By Legendre polynomials: the integral of P_n over -1..z is (P_(n+1)(z)-P_(n-1)(z))/(2n+1). */
void fret_gauss_running(const fret_real f[8], fret_real sum[8]) {
    fret_real p[8][9], c[8];
    for (int j = 0; j < 8; j++) {
        fret_real z = 2 * fret_gauss_node[j] - 1;
        p[j][0] = 1;
        p[j][1] = z;
        for (int n = 1; n < 8; n++)
            p[j][n + 1] = ((2 * n + 1) * z * p[j][n] - n * p[j][n - 1]) / (n + 1);
    }
    for (int n = 0; n < 8; n++) {
        c[n] = 0;
        for (int j = 0; j < 8; j++)
            c[n] += fret_gauss_weight[j] * f[j] * p[j][n];
    }
    for (int j = 0; j < 8; j++) {
        sum[j] = c[0] * fret_gauss_node[j];
        for (int n = 1; n < 8; n++)
            sum[j] += c[n] * (p[j][n + 1] - p[j][n - 1]) / 2;
    }
}
