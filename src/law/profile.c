/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Moments of the kernel (1-s^2)^((k-1)/2) of (3) near the edge s = 1. Pure arithmetic. */
#include "law/profile.h"

#include "number/real.h"

/* The highest moment by its series, the others by downward recurrence, whose terms are all positive. */
fret_edge fret_edge_moments(const fret_rule *rule, fret_real v) {
    if (v <= 0)
        return (fret_edge){{0}, 0};
    fret_real m = (rule->k + 1) / 2, power = fret_pow(v, m), sum = 0, vn = 1, v3 = v * v * v;
    fret_edge out = {.rim = power * fret_pow(2 - v, m)};
    for (int n = 0; n < FRET_SERIES; n++) {
        fret_real term = rule->series[n] * vn;
        sum += term;
        if (term < 1e-21L * sum)
            break;
        vn *= v;
    }
    out.moment[FRET_EDGE - 1] = power * v3 * v * sum;
    fret_real boundary = out.rim * v3; /* v^(j-1) rim */
    for (int j = FRET_EDGE - 1; j > 0; j--) {
        out.moment[j - 1] = (boundary + (2 * m + (j - 1)) * out.moment[j]) / (2 * (m + (j - 1)));
        boundary /= v;
    }
    return out;
}

void fret_rule_series(fret_rule *rule, fret_real k) {
    fret_real beta = (1 - k) / 2, m = (k + 1) / 2, c = fret_pow(2, -beta);
    for (int n = 0; n < FRET_SERIES; n++) {
        rule->series[n] = c / (m + (FRET_EDGE - 1) + n);
        c *= (beta + n) / (2 * (fret_real)(n + 1));
    }
}
