/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Series where they converge fast, from there on recurrences in the direction that is stable. Arithmetic
 * alone. */
#include "contact/kernel.h"

#include <float.h>
#include <math.h>

#include "number/real.h"

/* 1 + r0 z + r0 r1 z^2 + ... */
static fret_real series(const fret_real *ratio, fret_real z) {
    fret_real sum = 1, term = 1;
    for (int n = 0; n < SERIES; n++) {
        term *= ratio[n] * z;
        sum += term;
        if (fabsl(term) < LDBL_EPSILON / 8 * sum)
            break;
    }
    return sum;
}

void fret_kernel_power(powers *p, int of_m, int whole, fret_real m) {
    const fret_real q = of_m * m + whole;
    *p = (powers){.q = q, .of_m = of_m, .whole = whole};
    for (int j = 0; j <= MOST; j++) {
        p->over[j] = 1 / (q + j + 1);
        p->with[j] = 1 / (q + j + 1 + m);
    }
    for (int n = 0; n < SERIES; n++) {
        p->edge[n] = (n - q) / (m + 1 + n);
        p->below[n] = (1 - m + n) / (q + 2 + n);
        p->top[n] = (1 - m + n) / (q + MOST + 2 + n);
        p->span[n] = 1 / (q + m - n);
    }
    p->twice = fret_pow(2, q + m);
    p->from_one = fret_pow(2, q) / m * series(p->edge, 0.5L);
    p->from_nil = fret_pow(2, q + 1) * fret_pow(3, m - 1) * p->over[0] * series(p->below, 2 / 3.0L);
    p->whole_beta = fret_beta(q + MOST + 1, 1 - m);
}

static fret_real to_q(const powers *p, fret_real x, fret_real x_m) {
    const fret_real v = p->of_m ? x_m : 1;
    return p->whole == 0 ? v : p->whole > 0 ? v * x : v / x;
}

/* int_(2d)^x y^q (y-sign d)^(m-1) dy, 2d < x: the kernel in powers of d/y. */
static fret_real far_part(const powers *p, const reach *c, fret_real sign, fret_real d_power) {
    const fret_real t = p->q + c->m, u = c->d / c->x, step = sign * u, half = sign / 2;
    fret_real outer = to_q(p, c->x, c->x_m) * c->x_m, inner = p->twice * d_power, sum = 0, b = 1;
    const fret_real enough = LDBL_EPSILON / 8 * (outer + inner);
    for (int n = 0; n < SERIES && b * (fabsl(outer) + fabsl(inner)) > enough; n++) {
        const fret_real power = t - n;
        sum += b * (fabsl(power) * c->span < 0.5L
                        ? inner * (power != 0 ? fret_expm1(power * c->span) / power : c->span)
                        : (outer - inner) * p->span[n]);
        b *= (1 - c->m + n) / (1 + n);
        outer *= step;
        inner *= half;
    }
    return sum;
}

void fret_kernel_above(const powers *p, const reach *c, int count, fret_real *I) {
    fret_real xq = to_q(p, c->x, c->x_m);
    if (2 * c->d < c->x) {
        const fret_real d_power = to_q(p, c->d, c->d_m) * c->d_m;
        I[0] = p->from_one * d_power + far_part(p, c, 1, d_power);
    } else {
        I[0] = c->rim * xq / c->m * series(p->edge, c->rest / c->x);
    }
    for (int j = 0; j + 1 < count; j++) {
        xq *= c->x;
        I[j + 1] = (xq * c->rim + (p->q + (j + 1)) * c->d * I[j]) * p->with[j];
    }
}

void fret_kernel_below(const powers *p, const reach *c, int count, fret_real *I) {
    const fret_real d = c->d, x = c->x;
    fret_real xq = to_q(p, x, c->x_m);
    if (d < x) {
        if (d <= 0) {
            I[0] = xq * c->rim / (p->q + c->m);
        } else if (2 * d < x) {
            const fret_real d_power = to_q(p, d, c->d_m) * c->d_m;
            I[0] = p->from_nil * d_power + far_part(p, c, -1, d_power);
        } else {
            I[0] = x * xq * c->rim / c->rest * p->over[0] * series(p->below, x / c->rest);
        }
        for (int j = 0; j + 1 < count; j++) {
            xq *= x;
            I[j + 1] = (xq * c->rim - (p->q + (j + 1)) * d * I[j]) * p->with[j];
        }
        return;
    }
    /* downwards from the last, which is small */
    fret_real edge[MOST + 1];
    const fret_real down = 1 / d;
    for (int j = 0; j <= MOST; j++) {
        xq *= x;
        edge[j] = xq * c->rim;
    }
    fret_real now = edge[MOST] / c->rest * p->over[MOST] * series(p->top, x / c->rest);
    for (int j = MOST; j-- > 0;) {
        now = (edge[j] - now * (p->q + (j + 1) + c->m)) * p->over[j] * down;
        if (j < count)
            I[j] = now;
    }
}

void fret_kernel_beyond(const powers *p, const reach *c, int count, fret_real *I) {
    static const fret_real near = 0.4L;
    const fret_real q = p->q + MOST, m = c->m, out = c->rest / c->d, down = 1 / c->d;
    fret_real edge[MOST], xq = to_q(p, c->x, c->x_m), sum = 0, term = 1, now;
    for (int j = 0; j < MOST; j++) {
        xq *= c->x;
        edge[j] = xq * c->rim;
    }
    if (out > near) {
        const fret_real z = c->x / c->d;
        for (int n = 0; n < SERIES && term > LDBL_EPSILON / 8 * (1 - z); n++) {
            sum += term / (q + 1 + n);
            term *= z * (m + n) / (1 + n);
        }
        now = xq * c->x * sum / c->d_m;
    } else {
        for (int n = 0; n < SERIES && fabsl(term) > LDBL_EPSILON / 8; n++) {
            sum += term / (1 - m + n);
            term *= out * (n - q) / (1 + n);
        }
        fret_real whole = p->whole_beta * to_q(p, c->d, c->d_m) * c->d / c->d_m;
        for (int j = 0; j < MOST; j++)
            whole *= c->d;
        /* out^(1-m) d^(q+1-m) = rest^(1-m) d^q */
        fret_real part = c->rim * sum * to_q(p, c->d, c->d_m);
        for (int j = 0; j < MOST; j++)
            part *= c->d;
        now = whole - part;
    }
    for (int j = MOST; j-- > 0;) {
        now = ((p->q + (j + 2) - m) * now + edge[j]) * p->over[j] * down;
        if (j < count)
            I[j] = now;
    }
}
