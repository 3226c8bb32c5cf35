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
fret_real fret_integrate(fret_integrand *f, void *context) {
    enum { LAST = sizeof exponential_rule / sizeof *exponential_rule - 1 };
    fret_sum sum = {0, 0};
    for (int i = LAST; i >= -LAST; i--) {
        const fret_real small = exponential_rule[abs(i)].small, rest = 1 - small,
                        value = i < 0 ? f(small, rest, context) : f(rest, small, context);
        fret_sum_add(&sum, exponential_rule[abs(i)].weight * value);
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

/* How far the halves of a part are from the whole, of the whole, and how often that has not fallen from part
 * to half. */
typedef struct quarrel {
    fret_real most;
    int times;
} quarrel;

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

/* Halves of a smooth integrand agree better than the whole with them; where they do not so often, and that is
 * no more than that, it is noise: rounded rows of a table. */
enum { PATIENCE = 2 };
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
