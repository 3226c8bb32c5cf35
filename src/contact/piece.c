/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Polynomials of a piece: their values, places, and integrals over parts. Pure arithmetic. */
#include "contact/piece.h"

#include "number/double.h"
#include "number/quadrature.h"
#include "number/real.h"

stretch fret_stretch_join(const stretch *a, const stretch *b) {
    return (stretch){a->h + b->h, a->K + b->K, a->G + b->G + a->h * b->K,
                     a->L + b->L + b->h * a->G + a->h * (b->h * b->K - b->G)};
}

void fret_stretch_add_runs(stretch *const run[RUNS], size_t from, size_t to, stretch *sum) {
    while (from > to) {
        int l = 0;
        while (from % ((size_t)2 << l) == 0 && from - ((size_t)2 << l) >= to && from >= (size_t)2 << l)
            l++;
        *sum = fret_stretch_join(sum, &run[l][(from >> l) - 1]);
        from -= (size_t)1 << l;
    }
}

/* ---- polynomials ------------------------------------------------------------------------------- */

polynomial fret_polynomial_of(const fret_real *c) {
    polynomial p;
    for (int i = 0; i < TERMS; i++)
        if (i < HEAD)
            p.head[i] = c[i];
        else
            p.tail[i - HEAD] = (double)c[i];
    return p;
}

/* Even and odd powers apart: half as long a chain of operations that wait for each other. */
fret_real fret_polynomial_at(const polynomial *c, fret_real z) {
    const double x = (double)z, x2 = x * x;
    double even = c->tail[TAIL - 2], odd = c->tail[TAIL - 1];
    for (int i = TAIL - 4; i >= 0; i -= 2) {
        even = even * x2 + c->tail[i];
        odd = odd * x2 + c->tail[i + 1];
    }
    const fret_real z2 = z * z, *h = c->head;
    return (h[0] + z2 * (h[2] + z2 * (h[4] + z2 * h[6]))) +
           z * (h[1] + z2 * (h[3] + z2 * (h[5] + z2 * (even + x * odd))));
}

/* First and half of the second derivative, for corrections. */
static double slope_of(const polynomial *c, double x, double *bend) {
    double v = 0, d = 0, d2 = 0;
    for (int i = TERMS - 1; i >= 0; i--) {
        d2 = d2 * x + d;
        d = d * x + v;
        v = v * x + (i < HEAD ? (double)c->head[i] : c->tail[i - HEAD]);
    }
    *bend = d2;
    return d;
}

void fret_polynomial_quotient(const polynomial *c, fret_real z0, polynomial *q) {
    const double x = (double)z0;
    double v = 0;
    for (int i = TAIL - 1; i >= 0; i--) {
        q->tail[i] = v;
        v = v * x + c->tail[i];
    }
    fret_real h = v;
    for (int i = HEAD - 1; i >= 0; i--) {
        q->head[i] = h;
        h = h * z0 + c->head[i];
    }
}

/* ---- one piece --------------------------------------------------------------------------------- */

fret_real fret_piece_distance(const piece *p, fret_real z, fret_real *rate) {
    const fret_real s = p->middle + p->half * z;
    if (p->width > 0) {
        const fret_real s2 = s * s;
        *rate = 4 * p->width * s2 * s * p->half;
        return p->origin + p->width * (s2 * s2);
    }
    const fret_real e = fret_exp(s);
    *rate = e * p->half;
    return e;
}

/* Two numbers at a time, on every processor. */
typedef double pair __attribute__((vector_size(16)));
enum { PAIRS = 4 };

/* The part from z to z-way of one piece by one rule; q: quotient of the depth at z. */
static stretch by_rule(const piece *p, const polynomial *q, fret_real z, fret_real way) {
    fret_real K = 0, G = 0, L = 0, d[8];
    const fret_real h = way * fret_polynomial_at(q, z - way);
    pair x[PAIRS], v[PAIRS], rate[PAIRS];
    for (int j = 0; j < 8; j++)
        d[j] = way * fret_gauss_node[j];
    for (int j = 0; j < PAIRS; j++) {
        x[j] = (pair){(double)(z - d[2 * j]), (double)(z - d[2 * j + 1])};
        v[j] = (pair){q->tail[TAIL - 1], q->tail[TAIL - 1]};
        rate[j] = (pair){p->dK.tail[TAIL - 1], p->dK.tail[TAIL - 1]};
    }
    for (int i = TAIL - 2; i >= 0; i--)
        for (int j = 0; j < PAIRS; j++) {
            v[j] = v[j] * x[j] + q->tail[i];
            rate[j] = rate[j] * x[j] + p->dK.tail[i];
        }
    for (int j = 0; j < 8; j++) {
        const fret_real at = z - d[j];
        fret_real t = v[j / 2][j % 2], w = rate[j / 2][j % 2];
        for (int i = HEAD - 1; i >= 0; i--) {
            t = t * at + q->head[i];
            w = w * at + p->dK.head[i];
        }
        t *= d[j];
        w *= fret_gauss_weight[j] * way;
        const fret_real m = w * t;
        K += w;
        G += m;
        L += m * (h - t);
    }
    return (stretch){h, K, G, L};
}

static stretch in_halves(const piece *p, const polynomial *q, fret_real z, fret_real way) {
    polynomial half;
    fret_polynomial_quotient(&p->rise[DEPTHS], z - way / 2, &half);
    const stretch outer = by_rule(p, q, z, way / 2), inner = by_rule(p, &half, z - way / 2, way / 2);
    return fret_stretch_join(&outer, &inner);
}

stretch fret_piece_part(const piece *p, const polynomial *q, fret_real z, fret_real way) {
    return p->coarse && way > 0.4L ? in_halves(p, q, z, way) : by_rule(p, q, z, way);
}

fret_real fret_piece_make_whole(piece *p) {
    const stretch once = by_rule(p, &p->from_end[DEPTHS], 1, 2);
    p->whole = in_halves(p, &p->from_end[DEPTHS], 1, 2);
    return fabsl(once.L / p->whole.L - 1);
}

/* ---- from values to places --------------------------------------------------------------------- */

/* What a guess is a polynomial of: nearly linear in the place where depth and load are nearly powers, or,
 * beyond a row, linear. */
static double part_of_rise(const piece *p, int by, fret_real part) {
    const double u = part > 0 ? (double)part : 0;
    if (p->width > 0) {
        const double least = (double)(p->middle - p->half) / (double)(p->middle + p->half),
                     square = least * least, inner = square * square;
        return sqrt(sqrt(inner + (1 - inner) * u));
    }
    return fret_double_log1p(u * (double)(fret_piece_rise(p, by) / fret_level_by(&p->inner, by)));
}

static double guess_of(const piece *p, int by, fret_real rise) {
    const double u = part_of_rise(p, by, rise / fret_piece_rise(p, by)), *c = p->guess[by];
    double z = c[GUESS - 1];
    for (int i = GUESS - 2; i >= 0; i--)
        z = z * u + c[i];
    return z;
}

/* A step of third order; what is left of an error of 1e-7 is below 1e-20. */
static fret_real correction(fret_real missing, double slope, double bend) {
    const double first = (double)missing / slope;
    return missing / (slope + first * bend);
}
static const fret_real close_enough = 1e-7L;

fret_real fret_piece_place(const piece *p, int by, fret_real value) {
    const fret_real rise = value - fret_level_by(&p->inner, by);
    const polynomial *c = &p->rise[by];
    fret_real lo = -1, hi = 1, z = fmin(fmax(guess_of(p, by, rise), -1), 1);
    for (int i = 0; i < 60; i++) {
        double bend;
        const fret_real missing = rise - fret_polynomial_at(c, z);
        const double slope = slope_of(c, (double)z, &bend);
        fret_real next = z + correction(missing, slope, bend);
        if (fabsl(next - z) <= close_enough)
            return fminl(fmaxl(next, -1), 1);
        *(missing > 0 ? &lo : &hi) = z;
        if (!(next > lo && next < hi))
            next = next >= hi && hi == 1 && z < 1 ? 1 : next <= lo && lo == -1 && z > -1 ? -1 : (lo + hi) / 2;
        z = next;
    }
    return z;
}

fret_real fret_piece_way(const piece *p, int by, const polynomial *q, fret_real z0, fret_real have,
                         fret_real drop) {
    const fret_real most = 1 + z0;
    fret_real lo = 0, hi = most,
              way =
                  drop < 1e-3L * have ? drop / fret_polynomial_at(q, z0) : z0 - guess_of(p, by, have - drop);
    way = way > 0 && way < most ? way : most / 2;
    for (int i = 0; i < 60; i++) {
        double bend;
        const fret_real v = fret_polynomial_at(q, z0 - way), missing = drop - way * v;
        const double slope = slope_of(q, (double)(z0 - way), &bend);
        const fret_real step =
            correction(missing, (double)v - (double)way * slope, (double)way * bend - slope);
        fret_real next = way + step;
        if (fabsl(step) <= close_enough * way)
            return fminl(next, most);
        *(missing > 0 ? &lo : &hi) = way;
        if (!(next > lo && next < hi))
            next = next >= hi && hi == most && way < most ? most : (lo + hi) / 2;
        way = next;
    }
    return way;
}

/* By the divided differences of the inverse. */
void fret_piece_make_guess(piece *p, int by, const fret_real z[GUESS]) {
    double u[GUESS], c[GUESS];
    const fret_real whole = fret_polynomial_at(&p->rise[by], 1);
    for (int i = 0; i < GUESS; i++) {
        u[i] = part_of_rise(p, by, fret_polynomial_at(&p->rise[by], z[i]) / whole);
        c[i] = (double)z[i];
    }
    for (int i = 1; i < GUESS; i++) /* divided differences */
        for (int j = GUESS - 1; j >= i; j--)
            c[j] = (c[j] - c[j - 1]) / (u[j] - u[j - i]);
    for (int i = GUESS - 2; i >= 0; i--) /* to powers */
        for (int j = i; j < GUESS - 1; j++)
            c[j] -= u[i] * c[j + 1];
    for (int i = 0; i < GUESS; i++)
        p->guess[by][i] = c[i];
}

void fret_piece_add_work(const piece *p, fret_real z, fret_real sum[2]) {
    const fret_real y = fret_polynomial_at(&p->rise[DEPTHS], z), F = fret_polynomial_at(&p->rise[LOADS], z),
                    work = fret_polynomial_at(&p->work, z);
    sum[DEPTHS] += p->inner.y * F + work;
    sum[LOADS] += p->inner.F * y + (y * F - work);
}
