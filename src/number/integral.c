/* SPDX-License-Identifier: GPL-3.0-or-later */
/* An adaptive integrator: the 8-point Gauss rule by bisection, at the ends the double-exponential rule. */
#include "number/integral.h"

#include <float.h>
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include "number/constants.h"
#include "number/sum.h"

const fret_real fret_gauss_node[8] = {0.0198550717512318841582195657153L, 0.101666761293186630204223031762L,
                                      0.237233795041835507091130475405L,  0.40828267875217509753026192882L,
                                      0.59171732124782490246973807118L,   0.762766204958164492908869524595L,
                                      0.898333238706813369795776968238L,  0.980144928248768115841780434285L};
const fret_real fret_gauss_weight[8] = {0.050614268145188129576265677155L, 0.111190517226687235272177997213L,
                                        0.156853322938943643668981100993L, 0.181341891689180991482575224639L,
                                        0.181341891689180991482575224639L, 0.156853322938943643668981100993L,
                                        0.111190517226687235272177997213L, 0.050614268145188129576265677155L};

/* The most bisections of one integral. */
enum { PARTS = 20000 };
/* Bisection reduces the error of a smooth integrand by 2^-16. A far larger reduction suggests a kink near the
 * middle that no node has seen: the double-exponential rule, whose nodes cluster there, then decides. */
static const fret_real TOO_GOOD = 1e-6L;

typedef struct integral {
    fret_integrand *f;
    void *context;
    fret_real tolerance, size; /* size: int |f|, as known so far */
    fret_sum value, error;
    int left; /* bisections still allowed */
} integral;

typedef struct part {
    fret_real lo, hi;
} part;

/* The result of a rule: int f, int |f|, the error estimate and, for Gauss's rule, its values. */
typedef struct result {
    fret_real value, size, error, at[8];
} result;

static fret_real at(const integral *all, part p, fret_real t, fret_real rest) {
    return (p.hi - p.lo) * all->f(p.lo * rest + p.hi * t, (1 - p.lo) * rest + (1 - p.hi) * t, all->context);
}

static result by_gauss(const integral *all, part p) {
    result out = {.size = 0};
    for (int i = 0; i < 8; i++) {
        out.at[i] = at(all, p, fret_gauss_node[i], fret_gauss_node[7 - i]);
        const fret_real v = fret_gauss_weight[i] * out.at[i];
        out.value += v;
        out.size += fabsl(v);
    }
    return out;
}

/* Double-exponential rule, t = 1/(1+exp(-pi sinh u)), in steps of u of 1/2, 1/4 .. 1/16: resolves
 * singularities at the ends. A halved step doubles the correct digits; the error estimate is the last
 * change. */
static result by_doubling(const integral *all, part p) {
    enum { LAST = sizeof doubling_rule / sizeof *doubling_rule - 1, COARSEST = 8 };
    result out = {.size = 0};
    fret_sum sum = {0, 0}, size = {0, 0};
    for (int step = COARSEST; step > 0; step /= 2) {
        for (int i = LAST; i >= -LAST; i -= step) {
            if (step < COARSEST && i % (2 * step) == 0)
                continue;
            const fret_real small = doubling_rule[abs(i)].small, t = i < 0 ? small : 1 - small,
                            v = doubling_rule[abs(i)].weight * at(all, p, t, i < 0 ? 1 - small : small);
            fret_sum_add(&sum, v);
            fret_sum_add(&size, fabsl(v));
        }
        const fret_real value = step * fret_sum_value(&sum);
        out = (result){value, step * fret_sum_value(&size), fabsl(value - out.value), {0}};
        if (step < COARSEST && out.error <= all->tolerance * fmaxl(all->size, out.size))
            break;
    }
    return out;
}

/* Do the polynomials through the values of both halves extrapolate to values at the ends of the part? If not,
 * a kink lies between an end and the node next to it. */
static bool fits_ends(const integral *all, part p, const result *a, const result *b) {
    static const fret_real next_to = 1e-17L, alike = 1e5L;
    fret_real lo = at(all, p, next_to, 1 - next_to), hi = at(all, p, 1 - next_to, next_to);
    for (int i = 0; i < 8; i++) {
        lo -= 2 * (end_weight[i] * a->at[i] + end_weight[8 + i] * b->at[i]);
        hi -= 2 * (end_weight[i] * b->at[7 - i] + end_weight[8 + i] * a->at[7 - i]);
    }
    return fabsl(lo) + fabsl(hi) <= alike * all->tolerance * all->size;
}

/* Disagreement of a part with the sum of its halves: absolute; and relative to int |f| over the part, for
 * this part and those that contain it, nearest first. */
enum { REMEMBERED = 8 };
typedef struct disagreement {
    fret_real off, own[REMEMBERED];
} disagreement;

/* Rounding noise in f ends the bisection. For a smooth integrand the relative disagreement falls quickly,
 * near kinks slowly but steadily. It is noise, as in tables of rounded numbers, if the last bisection gains
 * less than a factor of 2 and four together (eight, for a disagreement above 1e-11) less than 8. If it grows
 * relative to the part, the cause is a single place near an end of the part, and no noise. */
static bool is_noise(fret_real own, const disagreement *before) {
    const int first = own < 1e-11L ? REMEMBERED / 2 - 1 : REMEMBERED - 1;
    fret_real most = 0;
    for (int i = 0; i <= first; i++)
        most = fmaxl(most, before->own[i]);
    return own < 1e-6L && own > before->own[0] / 2 && own > most / 8 && own < 16 * before->own[first];
}

static void add(integral *all, part p, fret_real whole, disagreement before) {
    const fret_real mid = (p.lo + p.hi) / 2;
    const part left = {p.lo, mid}, right = {mid, p.hi};
    const bool first = p.hi - p.lo == 1;
    const result a = by_gauss(all, left), b = by_gauss(all, right);
    result best = {a.value + b.value, a.size + b.size, fabsl(a.value + b.value - whole), {0}};
    fret_real off = best.error;
    if (first)
        all->size = best.size;
    const bool good = off <= all->tolerance * all->size, ends = p.lo == 0 || p.hi == 1,
               suspicious = good && (off < TOO_GOOD * before.off || (ends && !fits_ends(all, p, &a, &b)));
    if (suspicious || (!good && ends)) {
        const result other = by_doubling(all, p);
        if (first)
            all->size = fmaxl(all->size, other.size);
        if (suspicious || other.error < off)
            best = other;
        off = fmaxl(off, best.error);
    }
    const fret_real own = off / best.size;
    if (best.error > all->tolerance * all->size && all->left > 0 && p.lo < mid && mid < p.hi &&
        !is_noise(own, &before)) {
        disagreement now = {off, {own}};
        memcpy(now.own + 1, before.own, (REMEMBERED - 1) * sizeof *now.own);
        all->left--;
        add(all, left, a.value, now);
        add(all, right, b.value, now);
    } else {
        fret_sum_add(&all->value, best.value);
        fret_sum_add(&all->error, best.error);
    }
}

fret_real fret_integral_ends(fret_integrand *f, void *context, fret_real tolerance) {
    const integral all = {.f = f, .context = context, .tolerance = tolerance};
    const part whole = {0, 1}, left = {0, 0.5L}, right = {0.5L, 1};
    const fret_real rough = by_gauss(&all, whole).value,
                    halves = by_gauss(&all, left).value + by_gauss(&all, right).value;
    return fabsl(halves - rough) <= tolerance * fabsl(halves) ? halves : by_doubling(&all, whole).value;
}

fret_real fret_integral_smooth(fret_integrand *f, void *context) {
    return by_gauss(&(integral){.f = f, .context = context}, (part){0, 1}).value;
}

fret_estimate fret_integral(fret_integrand *f, void *context, fret_real tolerance) {
    const part whole = {0, 1};
    disagreement none = {.off = 0};
    for (int i = 0; i < REMEMBERED; i++)
        none.own[i] = INFINITY;
    integral all = {.f = f, .context = context, .tolerance = tolerance, .left = PARTS};
    add(&all, whole, by_gauss(&all, whole).value, none);
    return (fret_estimate){fret_sum_value(&all.value), fret_sum_value(&all.error) + LDBL_EPSILON * all.size};
}
