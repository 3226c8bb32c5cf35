/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The sums over rings at a radius r: closed forms for near rings, Taylor series of the kernel for far
 * blocks. Reads rings only; uses `number`. */
#include "field/ring.h"

#include "number/integral.h"
#include "number/real.h"

/* One evaluation at r. Slices from index `end` on do not count; `less` is taken from the weight of the
 * others. With a cut, slice and ends are the cut's own, and no ring beyond index `last` counts. */
typedef struct query {
    const rings *all;
    const slice *slice;
    const slice_end *ends;
    int kind, load;
    fret_real r, less;
    size_t end, last;
    fret_real unit, scale; /* units of far blocks: of squares of lengths, and of the kernel */
    double log_unit;       /* ln(unit / unit of the rings) */
} query;

static fret_real weight_at(const query *q, size_t i) {
    return i < q->end ? weight_of(q->slice, q->all->slices, q->load, i) - q->less : 0;
}

/* ---- near -------------------------------------------------------------------------------------- */

/* The integral over one ring up to v = x; at: the coordinate v of r; rest = |x - at|. */
static fret_real near_part(const query *q, const ring *p, fret_real at, fret_real x, fret_real rest) {
    const rings *all = q->all;
    const fret_cell *c = p->cell;
    const int kind = q->kind, smooth = terms_of(c, kind, false), kinked = terms_of(c, kind, true);
    distances dist = {.m = all->m, .d = fabsl(at), .x = x, .rest = rest, .x_m = 1, .d_m = 1};
    void (*integrals)(const powers *, const distances *, int, fret_real *) = kind == DEPTHS
                                                                                 ? fret_kernel_beyond
                                                                             : at > 0 ? fret_kernel_above
                                                                                      : fret_kernel_below;
    fret_real I[2][MOST];
    if (x != 1)
        dist.x_m = fret_pow(x, all->m);
    if (rest > 0)
        dist.rim = fret_pow(rest, kind == DEPTHS ? 1 - all->m : all->m);
    if (dist.d > 0 && (kind == DEPTHS || 2 * dist.d < x)) {
        dist.d_m = fret_pow(dist.d, all->m);
        dist.span = kind == DEPTHS ? 0 : logl(x / (2 * dist.d));
    }
    if (smooth)
        integrals(&all->power[OF_ONE], &dist, smooth, I[0]);
    if (kinked)
        integrals(&all->power[kind == SLOPES ? OF_SLOPE : OF_DEPTH], &dist, kinked, I[1]);
    if (kinked > 1 && kind == SLOPES && c->q < 0.1L) /* the recurrence from a large I[0] loses digits */
        integrals(&all->power[OF_DEPTH], &dist, kinked - 1, I[1] + 1);
    fret_real sum = 0;
    for (int j = 0; j < smooth; j++)
        sum += term_of(c, kind, false, j) * I[0][j];
    for (int j = 0; j < kinked; j++)
        sum += term_of(c, kind, true, j) * I[1][j];
    return p->scale[kind] * sum;
}

/* Context of a quadrature by ln v over lo < v < hi, away from a sharp edge that r is closer to. */
typedef struct edge_integral {
    const query *q;
    const fret_cell *cell;
    fret_real at, lo, hi;
} edge_integral;

static fret_real edge_integrand(fret_real t, fret_real rest, void *context) {
    const edge_integral *c = context;
    const fret_real span = logl(c->hi / c->lo), v = c->hi * expl(-span * rest);
    (void)t;
    return span * v * fret_cell_rate(c->cell, BY_DEPTH, v) * fret_pow(v - c->at, c->q->all->m - 1);
}

/* Does the innermost slice, of weight 0, end close to the sharp edge, with r nearer to the edge? Then
 * differences of whole contacts would subtract infinite terms. */
static bool edge_unweighted(const query *q, const ring *p, fret_real at) {
    const rings *all = q->all;
    const size_t i = p->first;
    return q->kind == SLOPES && i == 0 && p->cell->count[RISE_Q] && p->cell->q < 1 && i < all->slices &&
           &all->ring[q->ends[i].ring] == p && weight_at(q, i) == 0 && 4 * fabsl(at) < q->ends[i].v;
}

/* The v at which slice i ends in the ring; 1 if it ends beyond. */
static fret_real end_in(const query *q, const ring *p, size_t i) {
    return i < q->all->slices && &q->all->ring[q->ends[i].ring] == p ? q->ends[i].v : 1;
}

static fret_real ring_without_edge(const query *q, const ring *p, fret_real at) {
    edge_integral c = {q, p->cell, at, end_in(q, p, 0), 0};
    fret_real sum = 0;
    for (size_t i = 1; c.lo < 1 && i < q->end; i++) {
        c.hi = end_in(q, p, i);
        if (c.hi > c.lo && weight_at(q, i) != 0)
            sum += weight_at(q, i) * fret_integral(edge_integrand, &c, 1e-17L).value;
        c.lo = c.hi;
    }
    return p->scale[SLOPES] * sum;
}

/* The sum over one ring: of the contacts that end in it with a slice, and of the one that covers it. */
static fret_real near_ring(const query *q, const ring *p) {
    const rings *all = q->all;
    const fret_real width = p->cell->width, at = square_distance(q->r, p->lo) / width,
                    sign = q->kind == SLOPES ? 1 : -1;
    fret_real sum = 0;
    if (q->kind == SLOPES && p->hi <= q->r)
        return 0;
    if (edge_unweighted(q, p, at))
        return ring_without_edge(q, p, at);
    bool more = true;
    for (size_t i = p->first; more && i < q->end; i++) {
        more = i < all->slices && &all->ring[q->ends[i].ring] == p;
        const fret_real x = more ? q->ends[i].v : 1,
                        weight = weight_at(q, i) - (more ? weight_at(q, i + 1) : 0);
        const fret_real a = more ? q->slice[i].a : p->hi,
                        rest = sign * (more && q->ends[i].by_v ? x - at : square_distance(a, q->r) / width);
        if (weight != 0 && x > 0 && (q->kind == DEPTHS || rest > 0))
            sum += weight * near_part(q, p, q->kind == DEPTHS ? fmaxl(at, x) : at, x, fmaxl(rest, 0));
    }
    return sum;
}

/* ---- far --------------------------------------------------------------------------------------- */

/* Sums the block if it is far enough. The number of terms leaves a remainder of 2^-56: 38.8 = 56 ln 2. */
static bool far_sum(const query *q, const block *b, fret_real *sum) {
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

static fret_real sum_of(const query *q, int level, size_t i) {
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

static fret_real evaluate(query q, const slice *cut) {
    const rings *all = q.all;
    const slice_end end =
        cut && all->count > 0 ? fret_rings_end(all, cut) : (slice_end){all->count, 0, false};
    int level = 0;
    q.slice = cut ? cut : all->slice;
    q.ends = cut ? &end : all->ends;
    q.last = cut ? end.ring : (size_t)-1;
    q.unit = all->unit + q.r * q.r;
    q.scale = fret_pow(q.unit, q.kind == SLOPES ? all->m - 1 : -all->m);
    q.log_unit = (double)logl(q.unit / all->unit);
    while ((size_t)1 << level < all->count)
        level++;
    fret_real sum = all->count > 0 ? sum_of(&q, level, 0) : 0;
    for (size_t i = 0; i < q.end && all->count > 0; i++)
        if (i == 0 || q.ends[i].ring != q.ends[i - 1].ring)
            sum += near_ring(&q, &all->ring[q.ends[i].ring]);
    return sum;
}

fret_real fret_rings_slope(const rings *all, int load, fret_real r, const slice *cut) {
    return evaluate((query){.all = all, .kind = SLOPES, .load = load, .r = r, .end = all->slices}, cut);
}

fret_real fret_rings_depth(const rings *all, int load, fret_real r, size_t end, const slice *cut) {
    return evaluate((query){.all = all,
                            .kind = DEPTHS,
                            .load = load,
                            .r = r,
                            .less = weight_of(all->slice, all->slices, load, end),
                            .end = end},
                    cut);
}
