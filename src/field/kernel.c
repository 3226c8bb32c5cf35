/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Integrals of powers against the kernels: series where they converge fast, and from there recurrences in
 * their stable direction. Pure functions; uses `number`. */
#include "field/kernel.h"

#include <float.h>
#include <math.h>

#include "number/real.h"

/* c0 + c1 z + c2 z^2 + ..., four terms at a time; |z| <= 2/3. */
static fret_real series(const fret_real *c, fret_real z) {
    const fret_real z2 = z * z, z4 = z2 * z2;
    fret_real sum = 0, power = 1;
    int n = 0;
    do {
        sum += power * ((c[n] + c[n + 1] * z) + (c[n + 2] + c[n + 3] * z) * z2);
        power *= z4;
        n += 4;
    } while (n < SERIES && fabsl(c[n] * power) > LDBL_EPSILON / 8 * fabsl(sum));
    return sum;
}

/* Coefficient n of (1-z)^-b, divided by c + n. */
static void make_series(fret_real b, fret_real c, fret_real *out) {
    fret_real term = 1;
    for (int n = 0; n < SERIES; n++) {
        out[n] = term / (c + n);
        term *= (b + n) / (1 + n);
    }
}

/* Coefficients of Gauss's hypergeometric series F(b, 1; c; z). */
static void make_gauss(fret_real b, fret_real c, fret_real *out) {
    fret_real term = 1;
    for (int n = 0; n < SERIES; n++) {
        out[n] = term;
        term *= (b + n) / (c + n);
    }
}

/* Leaves out of `far` the term that may be infinite; far_part adds it as a logarithm, or nearly one. */
static void make_far(powers *p, fret_real m) {
    const fret_real t = p->q + m;
    make_series(1 - m, -t, p->far);
    p->nearest = t > 0.5L ? (int)(t + 0.5L) : 0;
    p->away = t - p->nearest;
    p->nearest_b = 1;
    for (int n = 0; n < p->nearest; n++)
        p->nearest_b *= (1 - m + n) / (1 + n);
    p->far[p->nearest] = 0;
    p->nearest_two = fret_pow(2, p->away);
    const fret_real two = fret_pow(2, t);
    p->above_nil = fret_pow(2, p->q) / m * series(p->edge, 0.5L) + two * series(p->far, 0.5L);
    p->below_nil = fret_pow(2, p->q + 1) * fret_pow(3, m - 1) * p->over[0] * series(p->below, 2 / 3.0L) +
                   two * series(p->far, -0.5L);
}

void fret_kernel_power(powers *p, int of_m, int whole, fret_real m) {
    const fret_real q = of_m * m + whole, Q = q + (fret_real)MOST;
    *p = (powers){.q = q, .of_m = of_m, .whole = whole, .last = 1 / (Q + 1)};
    for (int j = 0; j < MOST; j++) {
        p->over[j] = 1 / (q + j + 1);
        p->with[j] = 1 / (q + j + 1 + m);
        p->rise[j] = (q + j + 1) * p->with[j];
        p->fall[j] = (q + j + 1 + m) * p->over[j];
        p->lapse[j] = (q + j + 2 - m) * p->over[j];
    }
    make_gauss(-q, m + 1, p->edge);
    make_gauss(1 - m, q + 2, p->below);
    make_gauss(1 - m, Q + 2, p->top);
    make_series(m, Q + 1, p->within);
    make_series(-Q, 1 - m, p->rim);
    make_far(p, m);
    p->whole_beta = fret_beta(Q + 1, 1 - m);
}

void fret_kernel_flat_make(flat_field *f, fret_real m) {
    *f = (flat_field){.m = m, .whole = FRET_PI / sinl(FRET_PI * fminl(m, 1 - m))};
    make_series(m, m, f->centre);
    make_series(1 - m, 1 - m, f->edge);
}

fret_real fret_kernel_flat_of(const flat_field *f, fret_real q, fret_real away) {
    if (away < 0.5L)
        return (f->whole - series(f->edge, away) * fret_pow(away, 1 - f->m)) / 2;
    return series(f->centre, q) * fret_pow(q, f->m) / 2;
}

fret_real fret_kernel_flat(const flat_field *f, fret_real a, fret_real r) {
    return fret_kernel_flat_of(f, (a / r) * (a / r), (r - a) / r * ((r + a) / r));
}

static fret_real to_q(const powers *p, fret_real x, fret_real x_m) {
    const fret_real v = p->of_m ? x_m : 1;
    return p->whole == 0 ? v : p->whole > 0 ? v * x : v / x;
}

/* The integral for 2d < x by the kernel in powers of d/y; nil: the coefficient of d^(q+m). The nearest term
 * is (x^away - (2d)^away)/away, a logarithm where away = 0. */
static fret_real far_part(const powers *p, const distances *c, fret_real sign, fret_real nil) {
    const fret_real u = c->d / c->x, d_power = to_q(p, c->d, c->d_m) * c->d_m;
    fret_real outer = to_q(p, c->x, c->x_m) * c->x_m, b = p->nearest_b;
    fret_real sum = nil * d_power - outer * series(p->far, sign * u);
    for (int n = 0; n < p->nearest; n++) {
        outer *= u;
        b *= sign;
    }
    const fret_real inner = p->nearest_two * d_power, span = p->away * c->span;
    if (fabsl(span) >= 0.5L)
        return sum + b * (outer - inner) / p->away;
    return sum + b * inner * (p->away != 0 ? expm1l(span) / p->away : c->span);
}

void fret_kernel_above(const powers *p, const distances *c, int count, fret_real *I) {
    fret_real edge = c->rim * to_q(p, c->x, c->x_m);
    I[0] = 2 * c->d < c->x ? far_part(p, c, 1, p->above_nil) : edge / c->m * series(p->edge, c->rest / c->x);
    for (int j = 0; j + 1 < count; j++) {
        edge *= c->x;
        I[j + 1] = edge * p->with[j] + c->d * p->rise[j] * I[j];
    }
}

void fret_kernel_below(const powers *p, const distances *c, int count, fret_real *I) {
    const fret_real d = c->d, x = c->x;
    fret_real edge = c->rim * to_q(p, x, c->x_m);
    if (d < x) {
        if (d <= 0)
            I[0] = edge / (p->q + c->m);
        else if (2 * d < x)
            I[0] = far_part(p, c, -1, p->below_nil);
        else
            I[0] = x * edge / c->rest * p->over[0] * series(p->below, x / c->rest);
        for (int j = 0; j + 1 < count; j++) {
            edge *= x;
            I[j + 1] = edge * p->with[j] - d * p->rise[j] * I[j];
        }
        return;
    }
    /* downward recurrence from j = MOST, whose integral is small */
    fret_real step[MOST];
    const fret_real down = 1 / d;
    for (int j = 0; j < MOST; j++) {
        edge *= x;
        step[j] = edge * down * p->over[j];
    }
    fret_real now = edge * x / c->rest * p->last * series(p->top, x / c->rest);
    for (int j = MOST; j-- > 0;) {
        now = step[j] - down * p->fall[j] * now;
        if (j < count)
            I[j] = now;
    }
}

void fret_kernel_beyond(const powers *p, const distances *c, int count, fret_real *I) {
    static const fret_real near = 0.4L;
    const fret_real down = 1 / c->d, out = c->rest * down;
    fret_real step[MOST], xq = to_q(p, c->x, c->x_m), now;
    for (int j = 0; j < MOST; j++) {
        xq *= c->x;
        step[j] = xq * c->rim * down * p->over[j];
    }
    if (out > near) {
        now = xq * c->x * series(p->within, c->x * down) / c->d_m;
    } else {
        /* out^(1-m) d^(q+1-m) = rest^(1-m) d^q */
        now = (p->whole_beta * c->d / c->d_m - c->rim * series(p->rim, out)) * to_q(p, c->d, c->d_m);
        for (int j = 0; j < MOST; j++)
            now *= c->d;
    }
    for (int j = MOST; j-- > 0;) {
        now = down * p->lapse[j] * now + step[j];
        if (j < count)
            I[j] = now;
    }
}
