/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Fields of sums of powers, by series of positive terms or quadrature. Pure functions on `number`. */
#include "field/powers.h"

#include <float.h>

#include "number/integral.h"
#include "number/real.h"

/* ---- within ------------------------------------------------------------------------------------ */

/* Powers, by series of positive terms: int_r^b x^(n-1) (x^2-r^2)^(m-1) dx with w = 1-(r/b)^2, m = (k+1)/2 and
 * e = (n-2)/2 is b^(n+k-1) w^m/(2m) times
 *   sum (-e)_j/(m+1)_j w^j = (1-w)^(m+e) sum (m+1+e)_j/j! m/(m+j) w^j:
 * the first sum for n <= 2, the second else. */
static fret_real near_edge(fret_real n, fret_real m, fret_real v, fret_real w) {
    const fret_real e = n / 2 - 1, enough = LDBL_EPSILON / 4 * (1 - w);
    const bool gentle = e <= 0;
    fret_real sum = 0, term = 1, ratio = 0;
    for (int i = 0; ratio >= 1 || term > enough * sum; i++) {
        const fret_real j = i;
        sum += gentle ? term : term * m / (m + j);
        ratio = gentle ? (j - e) / (m + 1 + j) * w : (m + 1 + e + j) / (1 + j) * w;
        term *= ratio;
    }
    return fret_pow(w, m) / (2 * m) * (gentle ? sum : sum * fret_pow(v, m + e));
}

/* From b to 1, with v = (r/b)^2 well below 1: the kernel as a series in (r/x)^2. */
static fret_real far_from_edge(fret_real n, fret_real m, fret_real r, fret_real b, fret_real v) {
    const fret_real rise = n + 2 * m - 2, span = -logl(b);
    fret_real sum = 0, c = 1, outer = 1, inner = fret_pow(b, rise);
    for (int j = 0; c * (inner + outer) > LDBL_EPSILON / 8 * sum; j++) { /* of r^2 < 0.7, v < 0.3 */
        const fret_real power = rise - 2 * j;
        sum += c * (fabsl(power) * span < 0.5L ? inner * (power != 0 ? expm1l(power * span) / power : span)
                                               : (outer - inner) / power);
        c *= (1 - m + j) / (1 + j);
        outer *= r * r;
        inner *= v;
    }
    return sum;
}

/* int_r^1 x^(n-1) (x^2-r^2)^(m-1) dx */
static fret_real power_integral(fret_real n, fret_real m, fret_real r, fret_real w) {
    static const fret_real most = 0.7L; /* a longer series is slower than two */
    if (w <= most)
        return near_edge(n, m, r * r, w);
    const fret_real b = r / sqrtl(1 - most);
    return fret_pow(b, n + 2 * m - 2) * near_edge(n, m, 1 - most, most) + far_from_edge(n, m, r, b, 1 - most);
}

/* Where exponents grow by 2, integration by parts gives each integral from the last; w = 1-(r/a)^2. */
fret_real fret_powers_slope(const fret_term *term, int terms, fret_real k, fret_real a, fret_real r) {
    const fret_real part = r / a, w = (a - r) / a * ((a + r) / a), m = (k + 1) / 2, outer = fret_pow(w, m);
    fret_real sum = 0, last = 0, before = 0;
    for (int i = 0; i < terms; i++) {
        const fret_real power = term[i].n;
        last = r <= 0                         ? 1 / (power + 2 * (m - 1))
               : i > 0 && power == before + 2 ? (outer + before * part * part * last) / (2 * m + before)
                                              : power_integral(power, m, part, w);
        sum += term[i].G * power * last;
        before = power;
    }
    return fret_pow(a, k - 1) * sum;
}

fret_real fret_powers_ring(const fret_term *term, int terms, fret_real k, fret_real a, fret_real b) {
    const fret_real l = logl(b / a);
    fret_real sum = 0;
    for (int i = 0; i < terms; i++) {
        const fret_real by = term[i].n + k - 1;
        sum -= term[i].G * term[i].n * (by != 0 ? expm1l(by * l) / by : l);
    }
    return fret_pow(a, k - 1) * sum;
}

/* ---- outside ----------------------------------------------------------------------------------- */

/* By the series of the kernel from the centre, whose terms are positive; q = (a/r)^2. */
static fret_real surface_far(fret_real m, const fret_term *term, int terms, fret_real dz, fret_real q) {
    fret_real sum = 0, rest = dz, c = 1, part;
    int j = 0;
    for (int i = 0; i < terms; i++)
        rest -= term[i].G;
    do { /* q is at most 0.7 */
        const fret_real b = m + j;
        part = rest;
        for (int i = 0; i < terms; i++)
            part += term[i].G * term[i].n / (2 * b + term[i].n);
        part *= c / b;
        sum += part;
        j++;
        c *= q * b / j;
    } while (fabsl(part) > 1e-20L * fabsl(sum));
    return sum * fret_pow(q, m) / 2;
}

/* Near the edge: the integral over x < r, whose g gives the gap, less that over a < x < r. */
static fret_real surface_near(const fret_term *term, int terms, const flat_field *flat, fret_real dz,
                              fret_real a, fret_real r, fret_real away) {
    const fret_real m = flat->m, whole = flat->whole, edge = fret_pow(away, 1 - m);
    fret_real sum = dz * fret_kernel_flat(flat, a, r);
    for (int i = 0; i < terms; i++) {
        const fret_real b = term[i].n / 2 + m;
        fret_real beyond = 0, c = 1;
        for (int j = 0; fabsl(c) > 1e-21L * fabsl(beyond); j++) { /* away is less than 0.3 */
            beyond += c / (1 - m + j);
            c *= away * (1 - b + j) / (j + 1);
        }
        sum -= term[i].G / 2 * fret_pow(r / a, term[i].n) * (whole / term[i].kappa - edge * beyond);
    }
    return sum;
}

/* Context of the quadrature in t = (x/a)^(k+1), which absorbs the factor x^k. */
typedef struct outside {
    const fret_term *term;
    int terms;
    fret_real m, dz, a, r;
} outside;

static fret_real outside_rate(fret_real t, fret_real rest, void *context) {
    const outside *c = context;
    const fret_real l = (rest < 0.5L ? log1pl(-rest) : logl(t)) / (2 * c->m), below = -c->a * expm1l(l);
    fret_real depth = c->dz;
    for (int i = 0; i < c->terms; i++)
        depth -= c->term[i].G * expl(c->term[i].n * l);
    return depth * fret_pow((c->r - c->a + below) * (c->r + c->a * expl(l)), -c->m);
}

/* Quadrature replaces both series where an exponent n, or m or 1-m near the edge, is close to 0. */
fret_real fret_powers_surface(const fret_term *term, int terms, const flat_field *flat, fret_real dz,
                              fret_real a, fret_real r) {
    static const fret_real NEAR = 0.3L, LITTLE = 1e-3L;
    const fret_real m = flat->m, away = (r - a) / r * ((r + a) / r);
    bool hard = away < NEAR && fminl(m, 1 - m) < LITTLE / 2;
    for (int i = 0; i < terms; i++)
        hard |= term[i].n < 0.01L;
    if (terms == 0)
        return dz * fret_kernel_flat(flat, a, r);
    if (!hard)
        return away < NEAR ? surface_near(term, terms, flat, dz, a, r, away)
                           : surface_far(m, term, terms, dz, (a / r) * (a / r));
    outside c = {term, terms, m, dz, a, r};
    return fret_pow(a, 2 * m) / (2 * m) * fret_integral_ends(outside_rate, &c, 1e-17L);
}
