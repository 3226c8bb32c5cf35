/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "special.h"

#include <stdlib.h>

#include "dd.h"
#include "tables.h"

fret_status fret_check_positive(const char *quantity, double value) {
    if (!isfinite(value))
        return fret_fail(FRET_NOT_FINITE, quantity, value, 0);
    if (value <= 0)
        return fret_fail(FRET_NOT_POSITIVE, quantity, value, 0);
    return fret_ok();
}

fret_status fret_check_not_negative(const char *quantity, double value) {
    if (!isfinite(value))
        return fret_fail(FRET_NOT_FINITE, quantity, value, 0);
    if (value < 0)
        return fret_fail(FRET_NEGATIVE, quantity, value, 0);
    return fret_ok();
}

/* The closed forms lose digits like (p x)^-3, within the guard digits down to p x = 0.2; beyond, the
 * series of (1-t)^(p-2) under the integral has terms a falling at least as fast as p x. Integrated twice it
 * is the one of (1-t)^p, of terms -a/((i+1)(i+2)). */
static fret_moments moments_series(fret_real pm1, fret_real x) {
    enum { LEADING = 6 }; /* all further terms together are below 2^-13: double will do */
    static const fret_real inv[LEADING + 2] = {1.0L / 1, 1.0L / 2, 1.0L / 3, 1.0L / 4,
                                               1.0L / 5, 1.0L / 6, 1.0L / 7, 1.0L / 8};
    fret_real p = 1 + pm1, a = p * pm1 * x * x, slope = pm1 * x, w = 0, J = 0, m1 = 0, L = 0;
    const double ratio = (double)x, fall = (double)slope, small = 1e-20 * (double)a;
    for (int i = 0; i < LEADING; i++) {
        fret_real c = a * inv[i + 1];
        w += c * inv[i];
        J += a * inv[i] * inv[i + 2];
        m1 += c;
        L += c * inv[i + 2];
        a *= x - slope * inv[i];
    }
    double term = (double)a, wt = 0, Jt = 0, m1t = 0, Lt = 0;
    double first = 1.0 / (LEADING + 1), second = 1.0 / (LEADING + 2);
    for (int i = LEADING; fabs(term) > small; i++) {
        const double c = term * second, third = 1.0 / (i + 3);
        wt += c * first;
        Jt += term * first * third;
        m1t += c;
        Lt += c * third;
        term *= ratio - fall * first;
        first = second;
        second = third;
    }
    return (fret_moments){p * x - (w + wt), (p * x / 2 - (J + Jt)) * x, m1 + m1t, (L + Lt) * x};
}

fret_moments fret_power_moments(fret_real pm1, fret_real x) {
    fret_real p = 1 + pm1;
    if (x >= 1)
        return (fret_moments){1, 1 / (p + 1), 1, pm1 / (p + 1)};
    if (x <= 0)
        return (fret_moments){0, 0, 0, 0};
    if (p * x < 0.2L)
        return moments_series(pm1, x);
    /* arranged so that m1 = int t dK and m2 = int t^2 dK keep their factor p-1 */
    fret_real em = fret_expm1(pm1 * fret_log1p(-x)), y = 1 + em; /* y = (1-x)^(p-1) */
    fret_real m1 = -em * (1 + pm1 * x) - pm1 * x;
    fret_real m2 = (-2 * em - y * pm1 * x * (2 + p * x)) / (2 + pm1);
    return (fret_moments){x * y - em, (m2 + p * x * x * y) / 2, m1, x * m1 - m2};
}

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

const fret_real fret_gauss_node[8] = {0.0198550717512318841582195657153L, 0.101666761293186630204223031762L,
                                      0.237233795041835507091130475405L,  0.40828267875217509753026192882L,
                                      0.59171732124782490246973807118L,   0.762766204958164492908869524595L,
                                      0.898333238706813369795776968238L,  0.980144928248768115841780434285L};
const fret_real fret_gauss_weight[8] = {0.050614268145188129576265677155L, 0.111190517226687235272177997213L,
                                        0.156853322938943643668981100993L, 0.181341891689180991482575224639L,
                                        0.181341891689180991482575224639L, 0.156853322938943643668981100993L,
                                        0.111190517226687235272177997213L, 0.050614268145188129576265677155L};

fret_real fret_integrate_smooth(fret_integrand *f, void *context) {
    fret_real sum = 0;
    for (int i = 0; i < 8; i++)
        sum += fret_gauss_weight[i] * f(fret_gauss_node[i], fret_gauss_node[7 - i], context);
    return sum;
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
