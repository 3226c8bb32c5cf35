/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Polynomials of a piece: their values, places, and integrals over parts. Pure arithmetic. */
#include "contact/piece.h"

#include "number/quadrature.h"
#include "number/real.h"

/* Two numbers at a time, on every processor. */
typedef double pair __attribute__((vector_size(16)));

stretch fret_stretch_join(const stretch *a, const stretch *b) {
    return (stretch){a->h + b->h, a->K + b->K, a->G + b->G + a->h * b->K,
                     a->L + b->L + b->h * a->G + a->h * (b->h * b->K - b->G)};
}

stretch fret_stretch_less(const stretch *whole, const stretch *inner) {
    const fret_real h = whole->h - inner->h, G = whole->G - inner->G - h * inner->K;
    return (stretch){h, whole->K - inner->K, G,
                     whole->L - inner->L - inner->h * G - h * (inner->h * inner->K - inner->G)};
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
static inline fret_real with_tail(const polynomial *c, fret_real z, fret_real z2, double tail) {
    const fret_real *h = c->head;
    return (h[0] + z2 * (h[2] + z2 * (h[4] + z2 * h[6]))) +
           z * (h[1] + z2 * (h[3] + z2 * (h[5] + z2 * tail)));
}

fret_real fret_polynomial_at(const polynomial *c, fret_real z) {
    const double x = (double)z, x2 = x * x;
    double even = c->tail[TAIL - 2], odd = c->tail[TAIL - 1];
    for (int i = TAIL - 4; i >= 0; i -= 2) {
        even = even * x2 + c->tail[i];
        odd = odd * x2 + c->tail[i + 1];
    }
    return with_tail(c, z, z * z, even + x * odd);
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
    const fret_real e = expl(s);
    *rate = e * p->half;
    return e;
}

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

stretch fret_piece_within(const piece *p, fret_real z) {
    const polynomial *y = &p->rise[DEPTHS], *K = &p->K, *G = &p->G, *L = &p->L;
    const double x = (double)z, x2 = x * x;
    pair even[2] = {{y->tail[TAIL - 2], K->tail[TAIL - 2]}, {G->tail[TAIL - 2], L->tail[TAIL - 2]}},
         odd[2] = {{y->tail[TAIL - 1], K->tail[TAIL - 1]}, {G->tail[TAIL - 1], L->tail[TAIL - 1]}};
    for (int i = TAIL - 4; i >= 0; i -= 2) {
        even[0] = even[0] * x2 + (pair){y->tail[i], K->tail[i]};
        odd[0] = odd[0] * x2 + (pair){y->tail[i + 1], K->tail[i + 1]};
        even[1] = even[1] * x2 + (pair){G->tail[i], L->tail[i]};
        odd[1] = odd[1] * x2 + (pair){G->tail[i + 1], L->tail[i + 1]};
    }
    for (int i = 0; i < 2; i++)
        even[i] += x * odd[i];
    const fret_real z2 = z * z;
    return (stretch){with_tail(y, z, z2, even[0][0]), with_tail(K, z, z2, even[0][1]),
                     with_tail(G, z, z2, even[1][0]), with_tail(L, z, z2, even[1][1])};
}

fret_real fret_piece_make_whole(piece *p) {
    polynomial q;
    fret_polynomial_quotient(&p->rise[DEPTHS], 1, &q);
    const stretch once = by_rule(p, &q, 1, 2);
    p->whole = fret_piece_within(p, 1);
    return fabsl(once.L / p->whole.L - 1);
}

/* ---- from values to places --------------------------------------------------------------------- */

/* What a guess is a polynomial of: nearly linear in the place where depth and load are nearly powers, or,
 * beyond a row, linear; and its derivative by the rise. */
static double bent_rise(const piece *p, int by, fret_real rise, double *rate) {
    const double up = rise > 0 ? (double)rise : 0;
    if (p->width > 0) {
        const double least = (double)(p->middle - p->half) / (double)(p->middle + p->half),
                     square = least * least, inner = square * square,
                     per = (1 - inner) / (double)fret_piece_rise(p, by), root = sqrt(inner + per * up),
                     u = sqrt(root);
        *rate = per / (4 * root * u);
        return u;
    }
    const double inner = (double)fret_level_by(&p->inner, by);
    *rate = 1 / (inner + up);
    return log1p(up / inner);
}

static double guess_of(const piece *p, int by, fret_real rise, double *rate) {
    const guide *g = &p->guess[by];
    const double v = (bent_rise(p, by, rise, rate) - g->middle) * g->scale, v2 = v * v;
    pair even = {g->term[GUESS - 2][0], g->term[GUESS - 2][1]},
         odd = {g->term[GUESS - 1][0], g->term[GUESS - 1][1]};
    for (int i = GUESS - 4; i >= 0; i -= 2) {
        even = even * v2 + (pair){g->term[i][0], g->term[i][1]};
        odd = odd * v2 + (pair){g->term[i + 1][0], g->term[i + 1][1]};
    }
    even += v * odd;
    *rate *= g->scale * even[1];
    return even[0];
}

/* A step of third order; what is left of an error of 1e-7 is below 1e-20. */
static fret_real correction(fret_real missing, double slope, double bend) {
    const double first = (double)missing / slope;
    return missing / (slope + first * bend);
}
static const fret_real close_enough = 1e-7L;

static const double close_guess = 1e-9;

fret_real fret_piece_place(const piece *p, int by, fret_real rise) {
    const polynomial *c = &p->rise[by];
    double rate;
    fret_real lo = -1, hi = 1, z = fmin(fmax(guess_of(p, by, rise, &rate), -1), 1);
    const fret_real off = rise - fret_polynomial_at(c, z), near = z + off * rate;
    if (fabsl(off) <= close_guess * fret_piece_rise(p, by) && fabsl(near - z) <= close_guess)
        return near > 1 ? 1 : near > -1 ? near : -1;
    for (int i = 0; i < 60; i++) {
        double bend;
        const fret_real missing = rise - fret_polynomial_at(c, z);
        const double slope = slope_of(c, (double)z, &bend);
        fret_real next = z + correction(missing, slope, bend);
        if (fabsl(next - z) <= close_enough)
            return fminl(fmaxl(next, -1), 1);
        *(missing > 0 ? &lo : &hi) = z;
        if (!(next > lo && next < hi))
            next = (lo + hi) / 2;
        z = next;
    }
    return z;
}

fret_real fret_piece_way(const piece *p, int by, const polynomial *q, fret_real z0, fret_real have,
                         fret_real drop) {
    const fret_real most = 1 + z0;
    double unused;
    fret_real lo = 0, hi = most,
              way = drop < 1e-3L * have ? drop / fret_polynomial_at(q, z0)
                                        : z0 - guess_of(p, by, have - drop, &unused);
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
            next = (lo + hi) / 2;
        way = next;
    }
    return way;
}

/* By the divided differences of the inverse. */
void fret_piece_make_guess(piece *p, int by, const fret_real z[GUESS]) {
    double v[GUESS], c[GUESS], unused;
    guide *g = &p->guess[by];
    const double lo = bent_rise(p, by, 0, &unused), hi = bent_rise(p, by, fret_piece_rise(p, by), &unused);
    g->middle = (lo + hi) / 2;
    g->scale = 2 / (hi - lo);
    for (int i = 0; i < GUESS; i++) {
        v[i] = (bent_rise(p, by, fret_polynomial_at(&p->rise[by], z[i]), &unused) - g->middle) * g->scale;
        c[i] = (double)z[i];
    }
    for (int i = 1; i < GUESS; i++) /* divided differences */
        for (int j = GUESS - 1; j >= i; j--)
            c[j] = (c[j] - c[j - 1]) / (v[j] - v[j - i]);
    for (int i = GUESS - 2; i >= 0; i--) /* to powers */
        for (int j = i; j < GUESS - 1; j++)
            c[j] -= v[i] * c[j + 1];
    for (int i = 0; i < GUESS; i++) {
        g->term[i][0] = c[i];
        g->term[i][1] = i < GUESS - 1 ? (i + 1) * c[i + 1] : 0;
    }
}

/* Half of what G and L tell, beside that of a straight line. */
fret_level fret_piece_work(const piece *p, fret_real z, fret_real work[2]) {
    const stretch s = fret_piece_within(p, z);
    const fret_level rise = {s.h, p->K_inner * s.h + s.G};
    work[DEPTHS] = (p->K_inner * s.h * s.h + (s.L + s.h * s.G)) / 2;
    work[LOADS] = rise.y * rise.F - work[DEPTHS];
    return rise;
}
