/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Beyond the edge, in rings each as wide as all before, up to twice the radius; from there on in powers of
 * 1/x^2. Allocates them, and frees them. */
#include "contact/beyond.h"

#include <stdlib.h>

#include "contact/check.h"
#include "contact/density.h"
#include "contact/ring.h"
#include "contact/table.h"
#include "number/real.h"

enum { FAR = 36 }; /* powers of (r/2a)^2 */
struct fret_beyond {
    fret_real a, far_scale, far[FAR];
    struct fret_density *rings; /* up to 2a */
};

/* The contact; row: the last one before its edge. */
typedef struct trail {
    const fret_normal *normal;
    fret_real a, e, unit_alpha;
    size_t row;
} trail;

/* x^-k H, with unit e. */
static fret_real value_of(const trail *t, fret_real x, const fret_real sum[3]) {
    const fret_real alpha = (t->normal->foundation.k - 1) / 2;
    return expl(-(alpha + 1) * logl(x)) * t->unit_alpha * sum[2];
}

/* At the distance e: of the rows as if the last one went on. */
static fret_real going_on(const trail *t, fret_real x, fret_real e) {
    const fret_normal *n = t->normal;
    const struct fret_table *of = n->gap.table;
    fret_real sum[3];
    fret_table_part(of, &n->rule, 0, t->row, e, t->e, sum);
    fret_table_within(of, &n->rule, t->row, e - fret_table_distance(of, t->row), 0, e, t->e, sum);
    return value_of(t, x, sum);
}

/* What is too much in that, `way` beyond the edge. */
static fret_real too_much(const trail *t, fret_real x, fret_real way) {
    const fret_normal *n = t->normal;
    fret_real sum[3] = {0, 0, 0};
    fret_table_within(n->gap.table, &n->rule, t->row, way, 0, t->e + way, t->e, sum);
    return value_of(t, x, sum);
}

/* The same of the contact alone, farther away. */
static fret_real ending(const trail *t, fret_real x, fret_real e) {
    const fret_normal *n = t->normal;
    const struct fret_table *of = n->gap.table;
    fret_real sum[3];
    fret_table_part(of, &n->rule, 0, t->row, e, t->e, sum);
    fret_table_within(of, &n->rule, t->row, e - fret_table_distance(of, t->row), e - t->e, e, t->e, sum);
    return value_of(t, x, sum);
}

/* At y in a ring, times dx/dy. */
static fret_real ring_value(const trail *t, const ring *p, bool first, bool kink, fret_real y) {
    const fret_real x = sqrtl(p->lo * p->lo + p->width * y), way = p->width * y / (p->lo + x),
                    e = (p->lo - t->a) + t->e + way;
    return p->width / (2 * x) * (kink ? -too_much(t, x, way) : first ? going_on(t, x, e) : ending(t, x, e));
}

static bool add_ring(const trail *t, struct fret_density *d, fret_real lo, fret_real hi) {
    static const fret_real
        look = 0.41L,
        narrow = 1e-7L; /* less, next to a row, is as uncertain as the radius, and counts no more */
    ring p = {.lo = lo, .hi = hi, .width = square_distance(hi, lo)};
    curve *of = &p.of[SLOPE];
    const bool first = d->count == 0;
    fret_real value[2][MOST];
    for (int j = 0; j < MOST; j++) {
        value[0][j] = ring_value(t, &p, first, false, d->rule.node[j]);
        value[1][j] = first ? ring_value(t, &p, first, true, d->rule.node[j]) / d->node_q[j] : 0;
    }
    const fret_real largest = fret_ring_largest(value[0]);
    (void)fret_ring_fit(&d->rule, value[0], largest, of->c[0], &of->smooth);
    if (first)
        (void)fret_ring_fit(&d->rule, value[1], largest, of->c[1], &of->kink);
    const fret_real want = ring_value(t, &p, first, false, look) +
                           (first ? ring_value(t, &p, first, true, look) : 0),
                    kink = first ? fret_pow(look, d->power[OF_SLOPE].q) *
                                       fret_ring_value(of->c[1], of->kink, look)
                                 : 0,
                    got = fret_ring_value(of->c[0], of->smooth, look) + kink;
    if (p.width > narrow * t->a * t->a)
        d->error = fmaxl(d->error, fabsl(got - want) / largest);
    fret_ring_scale(d, SLOPE, &p);
    fret_ring_scale(d, DEPTH, &p);
    return fret_ring_add(d, &p);
}

/* The first ring ends half as far from the edge as that is from the row before. */
static bool cover(struct fret_density *d, void *context) {
    const trail *t = context;
    const fret_real before = fret_table_distance(t->normal->gap.table, t->row),
                    start = fret_gap_start(&t->normal->gap), end = 2 * t->a;
    fret_real way = (t->e - before) * (t->a + start + before) / 2, lo = t->a;
    while (lo < end && !fret_stopped(t->normal)) {
        const fret_real hi = fminl(sqrtl(t->a * t->a + way), end);
        if (!add_ring(t, d, lo, hi))
            return false;
        lo = hi;
        way *= 2;
    }
    return true;
}

/* From X = 2a on, with w = (X/x)^2 and x^-k H = P(w)/x:
 * X^(2m-2)/2 int_0^1 w^-m P (1-w (r/X)^2)^(m-1) dw. */
static void make_far(struct fret_beyond *b, const trail *t) {
    const struct fret_density *d = b->rings;
    const fret_real X = 2 * b->a, m = d->m;
    fret_real value[MOST], c[MOST], power = 1;
    int count;
    for (int j = 0; j < MOST; j++) {
        const fret_real x = X / sqrtl(d->rule.node[j]);
        value[j] = x * ending(t, x, (x - t->a) + t->e);
    }
    (void)fret_ring_fit(&d->rule, value, fret_ring_largest(value), c, &count);
    for (int l = 0; l < FAR; l++) {
        for (int i = 0; i < count; i++)
            b->far[l] += power * c[i] / ((fret_real)(i + l) + (1 - m));
        power *= (1 - m + l) / (1 + l);
    }
    b->far_scale = fret_pow(X, 2 * (m - 1)) / 2;
}

fret_status fret_beyond_make(const fret_normal *n, fret_real a, struct fret_beyond **out) {
    struct fret_beyond *b = calloc(1, sizeof *b);
    *out = NULL;
    if (!b)
        return fret_fail(FRET_NO_MEMORY, NULL, 0, 0);
    const fret_real e = a - fret_gap_start(&n->gap);
    trail t = {n, a, e, fret_pow(e, (n->foundation.k - 1) / 2), fret_table_row(n->gap.table, e)};
    t.row -= fret_table_distance(n->gap.table, t.row) >= e;
    b->a = a;
    const fret_status st = fret_density_of_rings(n, a, 2 * a, cover, &t, &b->rings);
    if (st.code) {
        fret_beyond_free(b);
        return st;
    }
    make_far(b, &t);
    *out = b;
    return st;
}

void fret_beyond_free(struct fret_beyond *b) {
    fret_density_free(b->rings);
    free(b);
}

fret_real fret_beyond_integral(const struct fret_beyond *b, fret_real r) {
    const fret_cut whole = {2 * b->a, 1};
    const fret_real z = (r / (2 * b->a)) * (r / (2 * b->a));
    fret_real sum = 0;
    for (int l = FAR; l-- > 0;)
        sum = sum * z + b->far[l];
    return fret_density_pressure(b->rings, &whole, 1, r) + b->far_scale * sum;
}

fret_real fret_beyond_radius(const struct fret_beyond *b) {
    return b->a;
}

fret_real fret_beyond_error(const struct fret_beyond *b) {
    return fret_density_error(b->rings);
}
