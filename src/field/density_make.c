/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Making a density: rings where polynomials do, halves of them where they do not, all held against the
 * profile itself, and the moments of blocks. Allocates it, and frees it. */
#include "field/density.h"

#include <stdlib.h>

#include "field/ring.h"
#include "law/check.h"
#include "number/array.h"
#include "number/real.h"

typedef struct maker {
    struct fret_density *d;
    const fret_normal *normal;
    fret_real start, depth;                 /* depth: g at the end of the last ring */
    fret_real moment[POWERS][MOST][TAYLOR]; /* int_0^1 y^(q+j) (2y-1)^n dy */
    fret_ring_cover *others;                /* makes all rings */
    void *context;
    fret_status failed;
} maker;

enum { HALVINGS = 12, KEPT = 2000, LEAF = 8, LOOKS = 32 };
static const fret_real TOLERANCE =
                           2e-15L, /* of the last terms, of the whole: less is left between the nodes */
    FOUND = 1e-15L;                /* of g' there */

static void make_rule(maker *m) {
    fret_chebyshev_make(&m->d->rule, MOST, true);
    for (int j = 0; j < MOST; j++)
        m->d->node_q[j] = fret_pow(m->d->rule.node[j], m->d->power[OF_SLOPE].q);
    for (int p = 0; p < POWERS; p++)
        for (int j = 0; j < MOST; j++) {
            const fret_real q = m->d->power[p].q + j + 1;
            m->moment[p][j][0] = 1 / q;
            for (int n = 1; n < TAYLOR; n++)
                m->moment[p][j][n] = (1 - n * m->moment[p][j][n - 1]) / (q + n);
            for (int n = 0; n < TAYLOR; n++)
                m->d->moment[p][j][n] = (double)m->moment[p][j][n];
        }
    fret_real factor[KINDS] = {1, 1};
    for (int n = 0; n < TAYLOR; n++) {
        for (int kind = 0; kind < KINDS; kind++)
            m->d->binomial[kind][n] = (double)factor[kind];
        factor[SLOPE] *= (m->d->m - 1 - n) / (n + 1);
        factor[DEPTH] *= (m->d->m + n) / (n + 1);
    }
}

/* The integral from 0 to y of y^q times a polynomial, over y^q y. */
static fret_real risen(const powers *p, const fret_real *c, int count, fret_real y) {
    fret_real v = 0;
    while (count-- > 0)
        v = v * y + c[count] * p->over[count];
    return v;
}

/* g' dx/dy at y. */
static fret_real slope_at(const maker *m, const ring *p, fret_real y) {
    const fret_normal *n = m->normal;
    const fret_real x = sqrtl(p->lo * p->lo + p->width * y),
                    e = (p->lo - m->start) + p->width * y / (p->lo + x);
    return p->width / (2 * x) * fret_gap_profile(&n->gap, &n->rule, e).slope;
}

/* How far g' is off in its middle, of the largest. */
static fret_real error_of(const maker *m, const ring *p, fret_real largest_slope) {
    static const fret_real look = 0.41L;
    const curve *of = &p->of[SLOPE];
    const fret_real want = slope_at(m, p, look), q = m->d->power[OF_SLOPE].q;
    const fret_real got = fret_ring_value(of->c[0], of->smooth, look) +
                          (of->kink ? fret_pow(look, q) * fret_ring_value(of->c[1], of->kink, look) : 0);
    return fabsl(got - want) / fmaxl(largest_slope, fabsl(want));
}

/* sharp: begins at the start of the gap, and is all a kink there. */
static bool make_ring(maker *m, ring *p, bool sharp) {
    struct fret_density *d = m->d;
    fret_real slope[MOST], rise[2][MOST], none[MOST] = {0}, most = 0;
    const powers *q = &d->power[sharp ? OF_SLOPE : OF_ONE];
    curve *of = &p->of[SLOPE];
    int *count = sharp ? &of->kink : &of->smooth;
    for (int j = 0; j < MOST; j++) {
        slope[j] = slope_at(m, p, d->rule.node[j]);
        most = fmaxl(most, fabsl(slope[j]));
        slope[j] /= sharp ? d->node_q[j] : 1;
    }
    of->smooth = of->kink = 0;
    if (!(fret_ring_fit(&d->rule, slope, fret_ring_largest(slope), of->c[sharp], count) <= TOLERANCE))
        return false;
    for (int j = 0; j < MOST; j++)
        rise[0][j] = risen(q, of->c[sharp], *count, d->rule.node[j]);
    if (!(fret_ring_fit_depth(d, p, m->depth, sharp ? none : rise[0], sharp ? rise[0] : none) <= TOLERANCE))
        return false;
    const fret_real error = error_of(m, p, most);
    if (!(error <= FOUND))
        return false;
    d->error = fmaxl(d->error, error);
    fret_ring_scale(d, SLOPE, p);
    fret_ring_scale(d, DEPTH, p);
    m->depth += risen(q, of->c[sharp], *count, 1);
    return true;
}

static bool reserve(struct fret_density *d, size_t count) {
    ring *grown = fret_array_for(d->ring, &d->room, count, sizeof *grown);
    if (grown)
        d->ring = grown;
    return grown;
}

bool fret_ring_add(struct fret_density *d, const ring *p) {
    if (!reserve(d, d->count + 1))
        return false;
    d->ring[d->count++] = *p;
    d->kept = d->count;
    return true;
}

static fret_status no_memory(void) {
    return fret_fail(FRET_NO_MEMORY, NULL, 0, 0);
}

/* From the radius lo to hi, in halves where one ring does not do; sharp: from the start of the gap. */
static bool cover(maker *m, fret_real lo, fret_real hi, bool sharp, int halvings) {
    struct fret_density *d = m->d;
    ring p = {.lo = lo, .hi = hi, .width = square_distance(hi, lo)};
    if (fret_stopped(m->normal))
        return false;
    if (make_ring(m, &p, sharp)) {
        if (!fret_ring_add(d, &p))
            m->failed = no_memory();
        return !m->failed.code;
    }
    const fret_real middle = sqrtl((lo * lo + hi * hi) / 2);
    return halvings > 0 && !m->failed.code && cover(m, lo, middle, sharp, halvings - 1) &&
           cover(m, middle, hi, false, halvings - 1);
}

/* Beyond a flat end. */
static bool cover_smooth(maker *m, fret_real a) {
    static const fret_real step = 1.3L;
    m->d->leaf = 1;
    for (fret_real lo = m->start; lo < a; lo *= step)
        if (!cover(m, lo, lo * step, lo == m->start, HALVINGS))
            return false;
    return true;
}

static bool cover_otherwise(maker *m, fret_real a) {
    (void)a;
    m->d->leaf = 1;
    if (!m->others(m->d, m->context))
        m->failed = no_memory();
    return !m->failed.code;
}

/* From row to row of a table; within the first one it is told by powers where there is no flat end. */
static bool cover_rows(maker *m, fret_real a) {
    struct fret_density *d = m->d;
    m->failed = fret_rows_make_slopes(m->normal, a - m->start, &d->rows);
    if (m->failed.code || !d->rows)
        return false;
    const fret_row_part first = fret_rows_part(d->rows, 0);
    if (m->start > 0 && !cover(m, m->start, first.inner, true, HALVINGS))
        return false;
    const size_t count = fret_rows_parts(d->rows);
    d->from = m->start > 0 ? m->start : first.inner;
    d->from_depth = first.depth;
    d->heads = d->kept = d->count;
    d->count += count;
    d->leaf = count <= KEPT ? 1 : LEAF;
    if (count <= KEPT && !reserve(d, d->count + 1)) {
        m->failed = no_memory();
        return false;
    }
    for (size_t i = d->heads; i < d->count && count <= KEPT; i++) {
        fret_ring_take(d, i, SLOPE, &d->ring[i]);
        fret_ring_take(d, i, DEPTH, &d->ring[i]);
    }
    d->kept = count <= KEPT ? d->count : d->heads;
    for (size_t i = 0; i < LOOKS; i++) {
        ring made;
        const ring *p = fret_ring_at(
            d, d->heads + (size_t)((double)count * ((double)i + 0.5) / (double)LOOKS), SLOPE, &made);
        d->error = fmaxl(d->error, error_of(m, p, 0));
    }
    return !fret_stopped(m->normal);
}

static void moments_of(const maker *m, const ring *p, fret_real moment[KINDS][TAYLOR]) {
    for (int kind = 0; kind < KINDS; kind++) {
        const curve *c = &p->of[kind];
        for (int n = 0; n < TAYLOR; n++) {
            moment[kind][n] = 0;
            for (int j = 0; j < c->smooth; j++)
                moment[kind][n] += c->c[0][j] * m->moment[OF_ONE][j][n];
            for (int j = 0; j < c->kink; j++)
                moment[kind][n] += c->c[1][j] * m->moment[kind == SLOPE ? OF_SLOPE : OF_DEPTH][j][n];
        }
    }
}

/* Adds the moments of a half, moved to the middle of the whole: shift and ratio in half-widths of that. */
static void add_moved(fret_real whole[KINDS][TAYLOR], fret_real part[KINDS][TAYLOR], fret_real shift,
                      fret_real ratio) {
    for (int kind = 0; kind < KINDS; kind++) {
        fret_real power = 1;
        for (int n = 0; n < TAYLOR; n++) {
            part[kind][n] *= power;
            power *= ratio;
        }
        for (int pass = 1; pass < TAYLOR; pass++) /* binomials */
            for (int n = TAYLOR - 1; n >= pass; n--)
                part[kind][n] += shift * part[kind][n - 1];
        for (int n = 0; n < TAYLOR; n++)
            whole[kind][n] += part[kind][n];
    }
}

/* Adds those of a part from one radius to another. */
static void add_part(const block *b, fret_real lo, fret_real hi, fret_real whole[KINDS][TAYLOR],
                     fret_real part[KINDS][TAYLOR]) {
    add_moved(whole, part, (square_distance(lo, b->lo) - square_distance(b->hi, hi)) / (2 * b->half),
              square_distance(hi, lo) / (2 * b->half));
}

/* The same of a ring that is no more than a fifth of the block: few of its moments count, to those digits
 * that are kept. */
static bool add_small(const maker *m, const block *b, const ring *p, fret_real whole[KINDS][TAYLOR]) {
    enum { SMALL = 24 };
    const double shift = (double)((square_distance(p->lo, b->lo) - square_distance(b->hi, p->hi)) /
                                  (2 * b->half)),
                 ratio = (double)(p->width / (2 * b->half));
    if (ratio > 0.2)
        return false;
    for (int kind = 0; kind < KINDS; kind++) {
        const curve *c = &p->of[kind];
        const int kink = kind == SLOPE ? OF_SLOPE : OF_DEPTH;
        double part[TAYLOR] = {0}, power = 1;
        for (int j = 0; j < c->smooth; j++)
            for (int n = 0; n < SMALL; n++)
                part[n] += (double)c->c[0][j] * m->d->moment[OF_ONE][j][n];
        for (int j = 0; j < c->kink; j++)
            for (int n = 0; n < SMALL; n++)
                part[n] += (double)c->c[1][j] * m->d->moment[kink][j][n];
        for (int n = 0; n < SMALL; n++) {
            part[n] *= power;
            power *= ratio;
        }
        for (int pass = 1; pass < TAYLOR; pass++)
            for (int n = TAYLOR - 1; n >= pass; n--)
                part[n] += shift * part[n - 1];
        for (int n = 0; n < TAYLOR; n++)
            whole[kind][n] += part[n];
    }
    return true;
}

static const ring *both_at(const struct fret_density *d, size_t i, ring *room) {
    const ring *p = fret_ring_at(d, i, SLOPE, room);
    return p == room ? fret_ring_at(d, i, DEPTH, room) : p;
}

static void make_block(maker *m, size_t first, size_t last, fret_real moment[KINDS][TAYLOR]) {
    struct fret_density *d = m->d;
    block *b = &d->block[d->blocks++];
    ring made;
    fret_real part[KINDS][TAYLOR];
    *b = (block){.first = first, .last = last};
    b->lo = fret_ring_at(d, first, SLOPE, &made)->lo;
    b->hi = fret_ring_at(d, last - 1, SLOPE, &made)->hi;
    b->half = square_distance(b->hi, b->lo) / 2;
    b->log_half = log((double)(b->half / d->unit));
    for (int n = 0; n < TAYLOR; n++)
        moment[SLOPE][n] = moment[DEPTH][n] = 0;
    if (fret_stopped(m->normal))
        return;
    if (last - first > d->leaf) {
        const size_t middle = first + (last - first) / 2;
        const fret_real between = fret_ring_at(d, middle, SLOPE, &made)->lo;
        make_block(m, first, middle, part);
        add_part(b, b->lo, between, moment, part);
        make_block(m, middle, last, part);
        add_part(b, between, b->hi, moment, part);
    } else if (last - first == 1) {
        moments_of(m, both_at(d, first, &made), moment);
    } else {
        for (size_t i = first; i < last; i++) {
            const ring *p = both_at(d, i, &made);
            if (add_small(m, b, p, moment))
                continue;
            moments_of(m, p, part);
            add_part(b, p->lo, p->hi, moment, part);
        }
    }
    fret_real factor[KINDS] = {1, 1};
    for (int n = 0; n < TAYLOR; n++) {
        for (int kind = 0; kind < KINDS; kind++)
            b->moment[kind][n] = (double)(factor[kind] * moment[kind][n]);
        factor[SLOPE] *= (d->m - 1 - n) / (n + 1);
        factor[DEPTH] *= (d->m + n) / (n + 1);
    }
    b->next = d->blocks;
}

static fret_status make(const fret_normal *n, fret_real from, fret_real a, bool (*covers)(maker *, fret_real),
                        fret_ring_cover *others, void *context, struct fret_density **out) {
    struct fret_density *d = calloc(1, sizeof *d);
    maker *m = calloc(1, sizeof *m);
    const fret_real half = (n->foundation.k + 1) / 2;
    fret_status st = fret_ok();
    bool ok = d && m;
    *out = NULL;
    if (!ok)
        st = no_memory();
    if (ok) {
        *d = (struct fret_density){.m = half, .from = from, .unit = a * a};
        *m = (maker){.d = d, .normal = n, .start = from, .others = others, .context = context};
        const int sharp = fret_gap_sharp(&n->gap);
        fret_kernel_power(&d->power[OF_ONE], 0, 0, half);
        fret_kernel_power(&d->power[OF_SLOPE], 1, -sharp, half);
        fret_kernel_power(&d->power[OF_DEPTH], 1, 1 - sharp, half);
        d->reach = a;
        d->reach_power = fret_pow(a, 2 * (half - 1));
        d->far_scale[SLOPE] = (double)fret_pow(d->unit, half - 1);
        d->far_scale[DEPTH] = (double)fret_pow(d->unit, -half);
        fret_kernel_flat_make(&d->flat, half);
        make_rule(m);
        ok = covers(m, a);
        st = fret_unless_stopped(n, m->failed);
    }
    if (ok && !st.code) {
        fret_real moment[KINDS][TAYLOR];
        d->block = malloc((d->leaf > 1 ? 4 * d->count / d->leaf + 1 : 2 * d->count - 1) * sizeof *d->block);
        if (d->block)
            make_block(m, 0, d->count, moment);
        else
            st = no_memory();
        st = fret_unless_stopped(n, st);
    }
    free(m);
    if (ok && !st.code)
        *out = d;
    else
        fret_density_free(d);
    return st;
}

fret_status fret_density_make(const fret_normal *n, fret_real a, struct fret_density **out) {
    return make(n, fret_gap_start(&n->gap), a, fret_gap_sampled(&n->gap) ? cover_rows : cover_smooth, NULL,
                NULL, out);
}

fret_status fret_density_of_rings(const fret_normal *n, fret_real from, fret_real to, fret_ring_cover *others,
                                  void *context, struct fret_density **out) {
    return make(n, from, to, cover_otherwise, others, context, out);
}

void fret_density_free(struct fret_density *d) {
    if (d) {
        fret_rows_free(d->rows);
        free(d->block);
        free(d->ring);
    }
    free(d);
}
