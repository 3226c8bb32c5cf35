/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Powers against the kernels, by quadrature in variables that take the singular ends away, and the field of a
 * flat punch. */
#include "field/kernel.h"

#include <math.h>

#include "number/integral.h"
#include "number/real.h"
#include "unit.h"

/* y^p times the kernel with d. */
typedef struct integral {
    fret_real p, m, d, lo, hi;
} integral;

/* From d to hi, which is no more than 2d: linear in (y-d)^m. */
static fret_real above_near(fret_real t, fret_real rest, void *context) {
    const integral *c = context;
    (void)rest;
    return fret_pow(c->d + (c->hi - c->d) * fret_pow(t, 1 / c->m), c->p) * fret_pow(c->hi - c->d, c->m) /
           c->m;
}

/* From lo to hi: linear in ln y. */
static fret_real above_far(fret_real t, fret_real rest, void *context) {
    const integral *c = context;
    (void)rest;
    const fret_real y = c->lo * fret_pow(c->hi / c->lo, t);
    return logl(c->hi / c->lo) * fret_pow(y, c->p + 1) * fret_pow(y - c->d, c->m - 1);
}

/* From nil to hi: linear in y^(p+1). */
static fret_real below_near(fret_real t, fret_real rest, void *context) {
    const integral *c = context;
    (void)rest;
    const fret_real y = c->hi * fret_pow(t, 1 / (c->p + 1));
    return fret_pow(c->hi, c->p + 1) / (c->p + 1) * fret_pow(y + c->d, c->m - 1);
}

static fret_real below_far(fret_real t, fret_real rest, void *context) {
    const integral *c = context;
    (void)rest;
    const fret_real y = c->lo * fret_pow(c->hi / c->lo, t);
    return logl(c->hi / c->lo) * fret_pow(y, c->p + 1) * fret_pow(y + c->d, c->m - 1);
}

static fret_real beyond_inner(fret_real t, fret_real rest, void *context) {
    const integral *c = context;
    (void)rest;
    const fret_real y = c->hi * fret_pow(t, 1 / (c->p + 1));
    return fret_pow(c->hi, c->p + 1) / (c->p + 1) * fret_pow(c->d - y, -c->m);
}

/* Of distances w = d-y, from lo to hi: linear in w^(1-m). */
static fret_real beyond_outer(fret_real t, fret_real rest, void *context) {
    const integral *c = context;
    (void)rest;
    const fret_real b = 1 - c->m, from = fret_pow(c->lo, b), span = fret_pow(c->hi, b) - from;
    return span / b * fret_pow(c->d - fret_pow(from + span * t, 1 / b), c->p);
}

static fret_real of(fret_integrand *f, integral c) {
    return c.hi > c.lo ? fret_integral(f, &c, 1e-18L).value : 0;
}

typedef enum side { ABOVE, BELOW, BEYOND, SIDES } side;

static fret_real slow(side which, fret_real p, fret_real m, fret_real d, fret_real x) {
    integral c = {p, m, d, 0, x};
    if (which == ABOVE) {
        c.hi = fminl(x, 2 * d);
        return fret_integral(above_near, &c, 1e-18L).value + of(above_far, (integral){p, m, d, 2 * d, x});
    }
    if (which == BELOW) {
        c.hi = fminl(x, d > 0 ? d : x);
        return fret_integral(below_near, &c, 1e-18L).value +
               of(below_far, (integral){p, m, d, d, d > 0 ? x : 0});
    }
    c.hi = fminl(x, d / 2);
    return fret_integral(beyond_inner, &c, 1e-18L).value +
           of(beyond_outer, (integral){p, m, d, d - x, d / 2});
}

static void compare(side which, int of_m, int whole, fret_real m, fret_real d, fret_real x) {
    static const int some[] = {0, 1, 2, 7, MOST - 1};
    static powers p;
    fret_real I[MOST];
    distances c = {.m = m, .d = d, .x = x, .rest = which == BELOW ? x + d : fabsl(x - d)};
    fret_kernel_power(&p, of_m, whole, m);
    c.x_m = fret_pow(x, m);
    c.d_m = fret_pow(d, m);
    c.rim = fret_pow(c.rest, which == BEYOND ? 1 - m : m);
    c.span = d > 0 ? logl(x / (2 * d)) : 0;
    (which == ABOVE   ? fret_kernel_above
     : which == BELOW ? fret_kernel_below
                      : fret_kernel_beyond)(&p, &c, MOST, I);
    for (size_t i = 0; i < sizeof some / sizeof *some; i++) {
        const fret_real want = slow(which, p.q + some[i], m, d, x);
        CHECK_ABS(I[some[i]], want, I[0], 5e-16L);
    }
}

static void powers_of(fret_real k) {
    static const fret_real part[] = {1e-9L, 0.03L, 0.3L, 0.4999L, 0.5L, 0.51L, 0.8L, 0.999L};
    static const struct { int of_m, whole; } q[] = {{0, 0}, {1, -1}, {1, 0}, {1, 1}};
    const fret_real m = (k + 1) / 2;
    for (size_t i = 0; i < sizeof part / sizeof *part; i++)
        for (size_t j = 0; j < sizeof q / sizeof *q; j++) {
            const fret_real x = (i + j) % 2 ? 0.37L : 1;
            compare(ABOVE, q[j].of_m, q[j].whole, m, part[i] * x, x);
            compare(BELOW, q[j].of_m, q[j].whole, m, part[i] * x, x);
            compare(BELOW, q[j].of_m, q[j].whole, m, x / part[i], x);
            compare(BEYOND, q[j].of_m, q[j].whole, m, x / part[i], x);
        }
}

int main(int argc, char **argv) {
    static const fret_real grading[] = {-0.8L, -0.5L, -1e-9L, 0, 0.02L, 1 / 3.0L, 0.5L, 0.8L};
    unit_start("kernel", argc, argv);
    for (size_t i = 0; i < sizeof grading / sizeof *grading; i++)
        if (!unit_skips(i))
            CASE(powers_of(grading[i]));
    return unit_finish();
}
