/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Numerics shared by the rooms of the library: stable forms, no physics. Not installed. */
#ifndef FRET_SPECIAL_H
#define FRET_SPECIAL_H

#include <math.h>
#include <stdbool.h>

#include "fret/gap.h"

#define PI_L 3.141592653589793238462643383279502884L

static inline fret_status fret_ok(void) {
    return (fret_status){FRET_OK, NULL, 0, 0};
}

static inline fret_status fret_fail(fret_code code, const char *quantity, double value, double limit) {
    return (fret_status){code, quantity, value, limit};
}

/* NOT_FINITE, NOT_POSITIVE or OK. */
fret_status fret_check_positive(const char *quantity, double value);
/* NOT_FINITE, NEGATIVE or OK. */
fret_status fret_check_not_negative(const char *quantity, double value);

/* Sum with Neumaier's compensation: 1e8 small terms without drift. */
typedef struct fret_sum {
    fret_real sum, rest;
} fret_sum;

static inline void fret_sum_add(fret_sum *s, fret_real x) {
    fret_real t = s->sum + x;
    s->rest += fabsl(s->sum) >= fabsl(x) ? (s->sum - t) + x : (x - t) + s->sum;
    s->sum = t;
}

static inline fret_real fret_sum_value(const fret_sum *s) {
    return s->sum + s->rest;
}

/* int_0^1 f dt by double-exponential quadrature; f gets t and 1-t, each with all its digits, so that
 * algebraic end-point singularities do no harm. */
typedef fret_real fret_integrand(fret_real t, fret_real rest, void *context);
fret_real fret_integrate(fret_integrand *f, void *context);

/* The nodes of that rule, 0 <= i < FRET_EXPONENTIAL, for several integrals at once. */
enum { FRET_EXPONENTIAL = 109 };
typedef struct fret_node {
    fret_real t, rest, weight;
} fret_node;
fret_node fret_exponential_node(int i);

/* The same by eight Gauss-Legendre points: 1e-20 where f is smooth and its argument varies by less than 20 %.
 */
fret_real fret_integrate_smooth(fret_integrand *f, void *context);
extern const fret_real fret_gauss_node[8], fret_gauss_weight[8]; /* on 0..1 */

/* int_0^(node j) f dt from the values of f at the eight nodes. */
void fret_gauss_running(const fret_real f[8], fret_real sum[8]);

/* Moments of the power law F = y^p at y = 1, pm1 = p-1, over distances 0..x from the edge:
 *   w = int K dt, J = int t K dt, m1 = int t dK, L = int m1 dt;  K = p y^(p-1). */
typedef struct fret_moments {
    fret_real w, J, m1, L;
} fret_moments;
fret_moments fret_power_moments(fret_real pm1, fret_real x);

#endif
