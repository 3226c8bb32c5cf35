/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The sum at a place: closed forms of rings near it, Taylor's series of the kernel for blocks that are far.
 * Reads rings, and changes nothing. */
#include "field/ring.h"

#include "number/integral.h"
#include "number/real.h"

/* A question. end: slices from there on count as nothing, and those before by how much more they weigh. Of a
 * slice of its own instead of the one that there is, nothing is beyond the ring number `last`. */
typedef struct question {
    const rings *all;
    const slice *slice;
    const rim *rim;
    int kind, load;
    fret_real r, less;
    size_t end, last;
    fret_real unit, scale; /* of far blocks: of squares of lengths, and of the kernel */
    double log_unit;       /* in units of the rings */
} question;

static fret_real weight_at(const question *q, size_t i) {
    return i < q->end ? weight_of(q->slice, q->all->slices, q->load, i) - q->less : 0;
}

/* ---- near -------------------------------------------------------------------------------------- */

/* Of one ring up to x; r lies at `at`, and x beyond it, or before it, by rest. */
static fret_real near_part(const question *q, const ring *p, fret_real at, fret_real x, fret_real rest) {
    const rings *all = q->all;
    const fret_cell *c = p->cell;
    const int kind = q->kind, smooth = terms_of(c, kind, false), kinked = terms_of(c, kind, true);
    distances way = {.m = all->m, .d = fabsl(at), .x = x, .rest = rest, .x_m = 1, .d_m = 1};
    void (*integrals)(const powers *, const distances *, int, fret_real *) = kind == DEPTHS
                                                                                 ? fret_kernel_beyond
                                                                             : at > 0 ? fret_kernel_above
                                                                                      : fret_kernel_below;
    fret_real I[2][MOST];
    if (x != 1)
        way.x_m = fret_pow(x, all->m);
    if (rest > 0)
        way.rim = fret_pow(rest, kind == DEPTHS ? 1 - all->m : all->m);
    if (way.d > 0 && (kind == DEPTHS || 2 * way.d < x)) {
        way.d_m = fret_pow(way.d, all->m);
        way.span = kind == DEPTHS ? 0 : logl(x / (2 * way.d));
    }
    if (smooth)
        integrals(&all->power[OF_ONE], &way, smooth, I[0]);
    if (kinked)
        integrals(&all->power[kind == SLOPES ? OF_SLOPE : OF_DEPTH], &way, kinked, I[1]);
    if (kinked > 1 && kind == SLOPES && c->q < 0.1L) /* where the first would hide the others */
        integrals(&all->power[OF_DEPTH], &way, kinked - 1, I[1] + 1);
    fret_real sum = 0;
    for (int j = 0; j < smooth; j++)
        sum += term_of(c, kind, false, j) * I[0][j];
    for (int j = 0; j < kinked; j++)
        sum += term_of(c, kind, true, j) * I[1][j];
    return p->scale[kind] * sum;
}

/* A part that begins away from a sharp edge, which r is closer to: evenly in the logarithm. */
typedef struct away {
    const question *q;
    const fret_cell *cell;
    fret_real at, lo, hi;
} away;

static fret_real away_rate(fret_real t, fret_real rest, void *context) {
    const away *c = context;
    const fret_real span = logl(c->hi / c->lo), v = c->hi * expl(-span * rest);
    (void)t;
    return span * v * fret_cell_rate(c->cell, BY_DEPTH, v) * fret_pow(v - c->at, c->q->all->m - 1);
}

/* A core without slope spares the sharp edge that it ends next to, where differences would be of infinite
 * terms. */
static bool is_spared(const question *q, const ring *p, fret_real at) {
    const rings *all = q->all;
    const size_t i = p->first;
    return q->kind == SLOPES && i == 0 && p->cell->count[RISE_Q] && p->cell->q < 1 && i < all->slices &&
           &all->ring[q->rim[i].ring] == p && weight_at(q, i) == 0 && 4 * fabsl(at) < q->rim[i].v;
}

/* Where the slices from number i on end in a ring: 1 beyond it. */
static fret_real end_in(const question *q, const ring *p, size_t i) {
    return i < q->all->slices && &q->all->ring[q->rim[i].ring] == p ? q->rim[i].v : 1;
}

static fret_real spared_ring(const question *q, const ring *p, fret_real at) {
    away c = {q, p->cell, at, end_in(q, p, 0), 0};
    fret_real sum = 0;
    for (size_t i = 1; c.lo < 1 && i < q->end; i++) {
        c.hi = end_in(q, p, i);
        if (c.hi > c.lo && weight_at(q, i) != 0)
            sum += weight_at(q, i) * fret_integral(away_rate, &c, 1e-17L).value;
        c.lo = c.hi;
    }
    return p->scale[SLOPES] * sum;
}

/* Of one ring, slice by slice as far as they end in it. */
static fret_real near_ring(const question *q, const ring *p) {
    const rings *all = q->all;
    const fret_real width = p->cell->width, at = square_distance(q->r, p->lo) / width,
                    sign = q->kind == SLOPES ? 1 : -1;
    fret_real sum = 0;
    if (q->kind == SLOPES && p->hi <= q->r)
        return 0;
    if (is_spared(q, p, at))
        return spared_ring(q, p, at);
    bool more = true;
    for (size_t i = p->first; more && i < q->end; i++) {
        more = i < all->slices && &all->ring[q->rim[i].ring] == p;
        const fret_real x = more ? q->rim[i].v : 1,
                        weight = weight_at(q, i) - (more ? weight_at(q, i + 1) : 0);
        const fret_real a = more ? q->slice[i].a : p->hi,
                        rest = sign * (more && q->rim[i].by_v ? x - at : square_distance(a, q->r) / width);
        if (weight != 0 && x > 0 && (q->kind == DEPTHS || rest > 0))
            sum += weight * near_part(q, p, q->kind == DEPTHS ? fmaxl(at, x) : at, x, fmaxl(rest, 0));
    }
    return sum;
}

/* ---- far --------------------------------------------------------------------------------------- */

/* Is the block far enough? Its integral: so many terms that what is left is 2^-56 of it. */
static bool far_sum(const question *q, const block *b, fret_real *sum) {
    const rings *all = q->all;
    const fret_real off =
        b->half + (q->kind == SLOPES ? square_distance(b->lo, q->r) : square_distance(q->r, b->hi));
    if (!(off >= 3 * b->half))
        return false;
    const double ratio = (double)(b->half / off), x2 = ratio * ratio, x4 = x2 * x2, less = (double)q->less;
    const double *c = b->of[q->load][q->kind], *whole = b->of[PRESSED][q->kind];
    const double log_off = log((double)(off / q->unit));
    double s[4] = {0, 0, 0, 0};
    for (int n = (int)fmin(38.8 / (log_off + q->log_unit - b->log_half), TAYLOR - 1) & ~3; n >= 0; n -= 4)
        for (int i = 0; i < 4; i++)
            s[i] = s[i] * x4 + (less != 0 ? c[n + i] - less * whole[n + i] : c[n + i]);
    const double power = q->kind == SLOPES ? (double)all->m - 1 : -(double)all->m;
    *sum = q->scale * exp(power * log_off) * ((s[0] + ratio * s[1]) + x2 * (s[2] + ratio * s[3]));
    return true;
}

static fret_real sum_of(const question *q, int level, size_t i) {
    const rings *all = q->all;
    const block *b = &all->block[level][i];
    fret_real far;
    const bool whole = (i + 1) << level <= q->last;
    if (q->kind == SLOPES ? b->hi <= q->r : all->ring[i << level].first >= q->end)
        return 0;
    if (whole && far_sum(q, b, &far))
        return far;
    if (level == 0)
        return !whole || all->ring[i].cut ? 0 : near_ring(q, &all->ring[i]);
    const size_t next = 2 * i + 1;
    return sum_of(q, level - 1, 2 * i) + (next << (level - 1) < all->count ? sum_of(q, level - 1, next) : 0);
}

static fret_real answer(question q, const slice *cut) {
    const rings *all = q.all;
    const rim end = cut && all->count > 0 ? fret_rings_rim(all, cut) : (rim){all->count, 0, false};
    int level = 0;
    q.slice = cut ? cut : all->slice;
    q.rim = cut ? &end : all->rim;
    q.last = cut ? end.ring : (size_t)-1;
    q.unit = all->unit + q.r * q.r;
    q.scale = fret_pow(q.unit, q.kind == SLOPES ? all->m - 1 : -all->m);
    q.log_unit = (double)logl(q.unit / all->unit);
    while ((size_t)1 << level < all->count)
        level++;
    fret_real sum = all->count > 0 ? sum_of(&q, level, 0) : 0;
    for (size_t i = 0; i < q.end && all->count > 0; i++)
        if (i == 0 || q.rim[i].ring != q.rim[i - 1].ring)
            sum += near_ring(&q, &all->ring[q.rim[i].ring]);
    return sum;
}

fret_real fret_rings_slope(const rings *all, int load, fret_real r, const slice *cut) {
    return answer((question){.all = all, .kind = SLOPES, .load = load, .r = r, .end = all->slices}, cut);
}

fret_real fret_rings_depth(const rings *all, int load, fret_real r, size_t end, const slice *cut) {
    return answer((question){.all = all,
                             .kind = DEPTHS,
                             .load = load,
                             .r = r,
                             .less = weight_of(all->slice, all->slices, load, end),
                             .end = end},
                  cut);
}
