/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Taylor's series of phi for the blocks of a table, for rows near the edge, and for parts of these that are
 * the narrower the nearer they are to it; the powers that phi begins with where both the edge and r are
 * close. Touches nothing else. */
#include "contact/outside.h"

#include <math.h>

#include "number/real.h"

enum { TERMS = FRET_TABLE_MOMENTS, LEADING = 7 }; /* LEADING: those in long double */

void fret_outside_make(fret_outside *o, fret_real k) {
    const fret_real m = (k + 1) / 2;
    fret_kernel_flat_make(&o->flat, m);
    for (int n = 0; n < TERMS + 2; n++)
        o->over[n] = 1 / (fret_real)(n + 1);
    for (int n = 0; n < TERMS + 4; n++)
        o->with[n] = 1 / (n + m);
}

/* A contact and a place: e is the radius from the start of the table, D the difference of the squares. */
typedef struct place {
    const fret_outside *of;
    const struct fret_table *table;
    fret_real a, e, r, beyond, D, m;
} place;

/* About the middle c, `away` from the edge, against moments of f' over x = (s-c)/d: with p = (a^2-s^2)^(m-1)
 * and q = p/(r^2-s^2), of which all terms are positive, phi' is -s q. */
static fret_real by_moments(const place *at, fret_real away, fret_real d, const fret_real *moment,
                            int terms) {
    const fret_real c = at->a - away, m = at->m, v = away * (at->a + c),
                    w = (away + at->beyond) * (at->r + c), x1 = 2 * c * d / v, x2 = d * d / v,
                    y1 = 2 * c * d / w, y2 = d * d / w, *over = at->of->over;
    fret_real p = 1, last_p = 0, q = 1, last_q = 0, sum = 0;
    const int leading = terms < LEADING ? terms : LEADING;
    for (int n = 0; n + 1 < leading; n++) {
        sum += (c * q + d * last_q) * over[n] * moment[n + 1];
        const fret_real next = (x1 * (n + 1 - m) * p + x2 * (n + 1 - 2 * m) * last_p) * over[n],
                        next_q = next + y1 * q + y2 * last_q;
        last_p = p;
        p = next;
        last_q = q;
        q = next_q;
    }
    /* of the rest a double keeps all digits that count */
    const double X1 = (double)x1, X2 = (double)x2, Y1 = (double)y1, Y2 = (double)y2, M = (double)m,
                 ratio = (double)(d / c);
    double P = (double)p, last_P = (double)last_p, Q = (double)q, last_Q = (double)last_q, rest = 0;
    for (int n = LEADING - 1; n + 1 < terms; n++) {
        const double by = (double)over[n];
        rest += (Q + ratio * last_Q) * by * (double)moment[n + 1];
        const double next = (X1 * (n + 1 - M) * P + X2 * (n + 1 - 2 * M) * last_P) * by,
                     next_Q = next + Y1 * Q + Y2 * last_Q;
        last_P = P;
        P = next;
        last_Q = Q;
        Q = next_Q;
    }
    return moment[0] * fret_kernel_flat_of(&at->of->flat, v / w, at->D / w) -
           (sum + c * rest) * d / w * fret_pow(at->D / v, 1 - m);
}

/* A row, so far from the edge: f' = c[0] + c[1] t + c[2] t^2, `begin` where t = 0, from `far` to `near`. */
typedef struct row {
    fret_real c[3], begin, far, near;
} row;

static fret_real by_middle(const place *at, const row *b, fret_real far, fret_real near) {
    const fret_real d = (far - near) / 2, away = near + d, t = b->begin - away, *over = at->of->over,
                    c0 = 2 * d * (b->c[0] + t * (b->c[1] + t * b->c[2])),
                    c1 = 2 * d * d * (b->c[1] + 2 * t * b->c[2]), c2 = 2 * d * d * d * b->c[2];
    const int terms = fret_table_terms(d, away);
    fret_real moment[TERMS];
    for (int n = 0; n < terms; n++)
        moment[n] = n % 2 ? c1 * over[n + 1] : c0 * over[n] + c2 * over[n + 2];
    return by_moments(at, away, d, moment, terms);
}

/* From the edge on, no farther than E: phi = (2a z/(r^2-a^2))^m sum y[n] (z/E)^n at the distance z. */
static fret_real from_edge(const place *at, const row *b, const fret_real *y, fret_real E, fret_real z) {
    const fret_real x = z / E, *with = at->of->with + 1;
    const fret_real c0 = b->c[0] + b->begin * (b->c[1] + b->begin * b->c[2]),
                    c1 = -z * (b->c[1] + 2 * b->begin * b->c[2]), c2 = z * z * b->c[2];
    fret_real sum = 0;
    for (int n = TERMS; n-- > 0;)
        sum = sum * x + y[n] * (c0 * with[n] + c1 * with[n + 1] + c2 * with[n + 2]);
    return z > 0 ? z * fret_pow(2 * at->a * z / at->D, at->m) * sum : 0;
}

static fret_real by_edge(const place *at, const row *b, fret_real E) {
    const fret_real x = E / (2 * at->a), y1 = 2 * at->a * E / at->D, y2 = E * E / at->D;
    fret_real p = 1, q = 0, last = 0, y[TERMS];
    for (int n = 0; n < TERMS; n++) {
        const fret_real next = p - y1 * q + y2 * last;
        y[n] = (next / 2 - x * q) * at->of->with[n];
        last = q;
        q = next;
        p *= x * (n + 1 - at->m) * at->of->over[n];
    }
    return from_edge(at, b, y, E, fminl(b->far, E)) - from_edge(at, b, y, E, b->near);
}

static fret_real by_row(const place *at, size_t i) {
    static const fret_real wider = 1.6L; /* than it is far: fret_table_terms' limit is 5/3 */
    const fret_real E = fminl(at->beyond, at->a) / 4, far = at->e - fret_table_distance(at->table, i),
                    near = fmaxl(at->e - fret_table_distance(at->table, i + 1), 0);
    row b = {.begin = far, .far = far, .near = near};
    fret_table_slope(at->table, i, b.c);
    if (fret_table_terms((far - near) / 2, near + (far - near) / 2) > 0)
        return by_middle(at, &b, far, near);
    fret_real sum = near < E ? by_edge(at, &b, E) : 0;
    for (fret_real from = fmaxl(near, E), to; from < far; from = to) {
        to = fminl(from * wider, far);
        sum += by_middle(at, &b, to, from);
    }
    return sum;
}

fret_real fret_outside_surface(const fret_outside *o, const struct fret_table *t, fret_real dz, fret_real a,
                               fret_real r) {
    const fret_real start = fret_table_start(t), e = a - start;
    const place at = {o, t, a, e, r, r - a, (r - a) * (r + a), o->flat.m};
    fret_table_stretch b;
    fret_real sum = 0;
    for (size_t i = 0; fret_table_block(t, i, &b);) {
        const fret_real away = (start - b.c) + e;
        const int terms = fret_table_terms(b.d, away);
        if (terms > 0)
            sum += by_moments(&at, away, b.d, b.slope, terms);
        else if (b.next == i + 1)
            for (size_t j = b.first; j < b.last && fret_table_distance(t, j) < e; j++)
                sum += by_row(&at, j);
        i = terms > 0 || away <= -b.d ? b.next : i + 1;
    }
    return dz * fret_kernel_flat(&o->flat, a, r) - sum;
}
