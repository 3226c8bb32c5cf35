/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One integrator: eight points of Gauss in halves, at the ends the double-exponential rule. Pure arithmetic.
 */
#include "number/integral.h"

#include <float.h>
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>

#include "number/constants.h"
#include "number/quadrature.h"
#include "number/sum.h"

/* Parts that an integral may be cut into. */
enum { PARTS = 20000 };
/* Halves of a smooth integrand agree better than the whole with them; where they do not so often, and that is
 * no more than that of the part, it is noise: rounded rows of a table. */
enum { PATIENCE = 2 };
static const fret_real NOISE = 1e-9L;
/* Of smooth integrands the error falls to 2^-16 from part to half. Where it falls by far more, a kink next to
 * the middle may lie before the first point: the other rule, whose points crowd there, is to say. */
static const fret_real LUCK = 1e-6L;

typedef struct integral {
    fret_integrand *f;
    void *context;
    fret_real tolerance, size; /* size: int |f|, as far as it is known */
    fret_sum value, error;
    int left; /* parts */
} integral;

typedef struct part {
    fret_real lo, hi;
} part;

/* By a rule: the integral, that of |f|, and how far the rule may be off. */
typedef struct result {
    fret_real value, size, error;
} result;

static fret_real at(const integral *all, part p, fret_real t, fret_real rest) {
    return (p.hi - p.lo) * all->f(p.lo * rest + p.hi * t, (1 - p.lo) * rest + (1 - p.hi) * t, all->context);
}

static result by_gauss(const integral *all, part p) {
    result out = {0, 0, 0};
    for (int i = 0; i < 8; i++) {
        const fret_real v = fret_gauss_weight[i] * at(all, p, fret_gauss_node[i], fret_gauss_node[7 - i]);
        out.value += v;
        out.size += fabsl(v);
    }
    return out;
}

/* t = 1/(1+exp(-pi sinh u)) in steps of 1/8 of u: singularities at the ends do no harm. With every other node
 * left out it is off by `near`, with every fourth by `far`. Each time digits double, so that it is off by
 * near^2, and by far^4 or, next to singularities at the ends, less; more where near is small by chance. */
static result by_doubling(const integral *all, part p) {
    enum { LAST = sizeof doubling_rule / sizeof *doubling_rule - 1 };
    fret_sum every[3] = {{0, 0}, {0, 0}, {0, 0}}; /* fourth, other second, other */
    fret_real size = 0;
    for (int i = LAST; i >= -LAST; i--) {
        const fret_real small = doubling_rule[abs(i)].small, t = i < 0 ? small : 1 - small,
                        v = doubling_rule[abs(i)].weight * at(all, p, t, i < 0 ? 1 - small : small);
        fret_sum_add(&every[i % 2 ? 2 : i % 4 ? 1 : 0], v);
        size += fabsl(v);
    }
    const fret_real fourth = fret_sum_value(&every[0]), other = fourth + fret_sum_value(&every[1]),
                    value = other + fret_sum_value(&every[2]), near = fabsl(value - 2 * other) / size,
                    far = fmaxl(fabsl(2 * other - 4 * fourth) / size, near), q = far > 0 ? near / far : 0;
    const fret_real chance = fmaxl(near * near, far * far * far * far * far);
    return (result){value, size, size * fmaxl(near * q * sqrtl(q), chance)};
}

/* How far the halves of a part are from the whole, and that of their size; how often this has not fallen from
 * part to half. */
typedef struct quarrel {
    fret_real off, most;
    int times;
} quarrel;

static void add(integral *all, part p, fret_real whole, quarrel before) {
    const fret_real mid = (p.lo + p.hi) / 2;
    const part left = {p.lo, mid}, right = {mid, p.hi};
    const bool first = p.hi - p.lo == 1;
    const result a = by_gauss(all, left), b = by_gauss(all, right);
    result best = {a.value + b.value, a.size + b.size, fabsl(a.value + b.value - whole)};
    fret_real off = best.error;
    if (first)
        all->size = best.size;
    const bool good = off <= all->tolerance * all->size, lucky = good && off < LUCK * before.off;
    if (lucky || (!good && (p.lo == 0 || p.hi == 1))) {
        const result other = by_doubling(all, p);
        if (first)
            all->size = fmaxl(all->size, other.size);
        if (lucky || other.error < off)
            best = other;
        off = fmaxl(off, best.error);
    }
    quarrel now = {off, off / best.size, before.times};
    if (!(now.most < before.most))
        now.times++;
    else if (now.most < before.most / 256)
        now.times = 0;
    if (best.error > all->tolerance * all->size && all->left > 0 && p.lo < mid && mid < p.hi &&
        !(now.times >= PATIENCE && now.most < NOISE)) {
        all->left--;
        add(all, left, a.value, now);
        add(all, right, b.value, now);
    } else {
        fret_sum_add(&all->value, best.value);
        fret_sum_add(&all->error, best.error);
    }
}

fret_estimate fret_integral(fret_integrand *f, void *context, fret_real tolerance) {
    const part whole = {0, 1};
    integral all = {.f = f, .context = context, .tolerance = tolerance, .left = PARTS};
    add(&all, whole, by_gauss(&all, whole).value, (quarrel){0, INFINITY, 0});
    return (fret_estimate){fret_sum_value(&all.value), fret_sum_value(&all.error) + LDBL_EPSILON * all.size};
}
