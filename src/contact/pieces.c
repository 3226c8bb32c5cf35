/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reading the law from its pieces. Pure. */
#include "contact/pieces.h"

#include <float.h>

#include "contact/blocks.h"
#include "number/real.h"

enum { BY_DISTANCE, BY_DEPTH, BY_LOAD };

/* The piece that holds a value; false: none does. */
static bool find(const law *all, int by, fret_real value, size_t *found) {
    const fret_real *reach = all->reach + (size_t)by * all->count;
    const fret_real least = by == BY_DISTANCE ? all->from : by == BY_DEPTH ? all->least.y : all->least.F;
    if (!(value > least && fret_law_reaches(reach[all->count - 1], value)))
        return false;
    size_t lo = 0, count = all->count; /* the first whose end is not before the value */
    while (count > 1) {
        const size_t half = count / 2;
        lo += reach[lo + half - 1] < value ? half : 0;
        count -= half;
    }
    *found = lo;
    return true;
}

static fret_real place_of(const piece *p, int by, fret_real value) {
    return fret_piece_place(p, by, value - fret_level_by(&p->inner, by));
}

/* All but K. */
static bool point_of(const struct fret_pieces *of, int by, fret_real value, fret_point *out) {
    const law *all = of->law;
    const fret_spot_by how = by == BY_LOAD ? SPOT_LOAD : SPOT_DEPTH;
    size_t i;
    fret_real rate;
    fret_place at;
    if (all->rows && fret_blocks_find(all->rows, of->stop, how, value, &at)) {
        *out = (fret_point){.y = by == BY_LOAD ? fret_rows_level(at.rows, DEPTHS, &at.spot) : value,
                            .F = by == BY_LOAD ? value : fret_rows_level(at.rows, LOADS, &at.spot),
                            .a = all->start + fret_rows_distance(at.rows, &at.spot)};
        return true;
    }
    if (!find(all, by, value, &i))
        return false;
    const piece *p = &all->piece[i];
    const fret_real z = place_of(p, by == BY_LOAD ? LOADS : DEPTHS, value);
    out->y = by == BY_LOAD ? p->inner.y + fret_polynomial_at(&p->rise[DEPTHS], z) : value;
    out->F = by == BY_LOAD ? value : p->inner.F + fret_polynomial_at(&p->rise[LOADS], z);
    out->a = all->start + fret_piece_distance(p, z, &rate);
    return true;
}

bool fret_pieces_by_rows(const struct fret_pieces *pieces) {
    return pieces->law->rows;
}

bool fret_pieces_point(const struct fret_pieces *pieces, bool by_force, fret_real value, fret_point *out) {
    if (!point_of(pieces, by_force ? BY_LOAD : BY_DEPTH, by_force ? value / pieces->scale : value, out))
        return false;
    out->F = by_force ? value : out->F * pieces->scale;
    return true;
}

bool fret_pieces_depth(const struct fret_pieces *pieces, fret_real e, fret_real *depth) {
    const law *all = pieces->law;
    size_t i;
    fret_place at_e;
    if (all->rows && fret_blocks_find(all->rows, pieces->stop, SPOT_DISTANCE, e, &at_e)) {
        *depth = fret_rows_level(at_e.rows, DEPTHS, &at_e.spot);
        return true;
    }
    if (!find(all, BY_DISTANCE, e, &i))
        return false;
    const piece *p = &all->piece[i];
    const fret_real at = p->width > 0 ? sqrtl(sqrtl((e - p->origin) / p->width)) : logl(e);
    *depth = p->inner.y + fret_polynomial_at(&p->rise[DEPTHS], (at - p->middle) / p->half);
    return true;
}

/* Where a slice begins and ends: in piece `outer` at z, inwards in piece `inner`, so much of depth or load,
 * `drop`, below z or the outer end of that piece where it is another; inner = count: at the centre.
 * far: at z = `place`, where the slice is thick enough for differences of whole pieces; else `way` before z
 * or the outer end. */
typedef struct ends {
    size_t outer, inner;
    bool far;
    fret_real z, have, drop, place, way;
} ends;

/* Of a piece: a slice is thick, in depth or load or as an integral, where it has no less of it. */
static const fret_real THICK = 0.2L, WORTH = 0.02L;

static fret_real way_from_end(const piece *p, int by, fret_real drop) {
    polynomial q;
    if (!(drop > 0))
        return 0;
    fret_polynomial_quotient(&p->rise[by], 1, &q);
    return fret_piece_way(p, by, &q, 1, fret_piece_rise(p, by), drop);
}

static void find_way(const law *all, int by, ends *c) {
    const piece *p = &all->piece[c->outer];
    polynomial q;
    c->far = false;
    if (c->inner != c->outer) {
        c->way = way_from_end(&all->piece[c->inner], by, c->drop);
        return;
    }
    fret_polynomial_quotient(&p->rise[by], c->z, &q);
    c->way = fret_piece_way(p, by, &q, c->z, c->have, c->drop);
}

/* by: that in which whole, of the place, and target are told. */
static bool find_ends(const law *all, int by, fret_real whole, fret_real target, fret_real left, ends *c) {
    const int table = by == LOADS ? BY_LOAD : BY_DEPTH;
    if (!(target > 0) || !find(all, table, whole, &c->outer))
        return false;
    const piece *p = &all->piece[c->outer], *next = p;
    const fret_real rise = fret_piece_rise(p, by);
    c->have = whole - fret_level_by(&p->inner, by);
    c->z = fret_piece_place(p, by, c->have);
    c->inner = c->outer;
    /* close to a kink a piece is as steep as a third power: thin slices there are not for it */
    if (p->blunt && c->z < -0.6L && target < rise)
        return false;
    c->drop = target;
    if (target > c->have) {
        c->far = true;
        if (left <= 0) {
            c->inner = all->count;
            return true;
        }
        if (c->outer == 0)
            return false;
        c->drop = target - c->have;
        next = &all->piece[--c->inner];
        if (c->drop > fret_piece_rise(next, by)) {
            if (!find(all, table, left, &c->inner))
                return false;
            next = &all->piece[c->inner];
            c->drop = fret_level_by(&next->outer, by) - left;
        }
    }
    const fret_real rest = next == p ? c->have : fret_piece_rise(next, by);
    c->far = target >= THICK * rise && target >= THICK * fret_piece_rise(next, by);
    if (c->far)
        c->place = fret_piece_place(next, by, rest - c->drop);
    else
        find_way(all, by, c);
    return true;
}

/* The fall of depth or load over a slice that does not reach the centre. */
static fret_real fall_of(const law *all, int by, const ends *c) {
    const piece *p = &all->piece[c->outer], *last = &all->piece[c->inner];
    polynomial q;
    const fret_real have = fret_polynomial_at(&p->rise[by], c->z);
    if (c->far)
        return (have - fret_polynomial_at(&last->rise[by], c->place)) +
               (fret_level_by(&p->inner, by) - fret_level_by(&last->inner, by));
    fret_polynomial_quotient(&last->rise[by], c->inner == c->outer ? c->z : 1, &q);
    if (c->inner == c->outer)
        return c->way * fret_polynomial_at(&q, c->z - c->way);
    return have + (fret_level_by(&p->inner, by) - fret_level_by(&last->outer, by)) +
           c->way * fret_polynomial_at(&q, 1 - c->way);
}

/* The integrals of a thick slice, and K at the inner end; false: it is not thick enough for that. */
static bool far_integrals(const law *all, const ends *c, stretch *sum, fret_real *K) {
    const piece *p = &all->piece[c->outer], *last = &all->piece[c->inner];
    *sum = fret_piece_within(p, c->z);
    if (c->inner == all->count) {
        *K = all->K_start;
        fret_stretch_add_runs(all->run, c->outer, 0, sum);
        *sum = fret_stretch_join(sum, &all->core);
        return sum->L >= WORTH * p->whole.L;
    }
    const stretch rest = fret_piece_within(last, c->place);
    *K = last->K_inner + rest.K;
    if (c->inner == c->outer) {
        *sum = fret_stretch_less(sum, &rest);
    } else {
        const stretch part = fret_stretch_less(&last->whole, &rest);
        fret_stretch_add_runs(all->run, c->outer, c->inner + 1, sum);
        *sum = fret_stretch_join(sum, &part);
    }
    return sum->L >= WORTH * (p->whole.L + last->whole.L);
}

/* The integrals, and K at the inner end. */
static stretch integrals_of(const law *all, int by, ends *c, fret_real *K) {
    const piece *p = &all->piece[c->outer], *last = &all->piece[c->inner];
    polynomial q;
    stretch sum;
    if (c->far && far_integrals(all, c, &sum, K))
        return sum;
    if (c->far && c->inner != all->count)
        find_way(all, by, c);
    fret_polynomial_quotient(&p->rise[DEPTHS], c->z, &q);
    sum = fret_piece_part(p, &q, c->z, c->inner == c->outer ? c->way : 1 + c->z);
    if (c->inner == all->count) {
        *K = all->K_start;
        fret_stretch_add_runs(all->run, c->outer, 0, &sum);
        return fret_stretch_join(&sum, &all->core);
    }
    *K = last->K_inner + fret_polynomial_at(&last->K, (c->inner == c->outer ? c->z : 1) - c->way);
    if (c->inner == c->outer)
        return sum;
    fret_stretch_add_runs(all->run, c->outer, c->inner + 1, &sum);
    if (!(c->way > 0))
        return sum;
    fret_polynomial_quotient(&last->rise[DEPTHS], 1, &q);
    const stretch rest = fret_piece_part(last, &q, 1, c->way);
    return fret_stretch_join(&sum, &rest);
}

/* Where a slice ends that begins among rows: `target` below `outer`, where `left` is left. */
typedef enum ending { WITHIN, FURTHER_IN, NOT_KNOWN } ending;
static ending end_among_rows(const struct fret_pieces *of, struct fret_blocks *rows, fret_spot_by how,
                             const fret_place *outer, fret_real target, fret_real left, fret_place *inner) {
    if (left < target ? fret_blocks_find(rows, of->stop, how, left, inner)
                      : fret_blocks_drop(rows, of->stop, how, outer, target, inner))
        return WITHIN;
    const fret_real rounding = 16 * LDBL_EPSILON * (left + target);
    return left - fret_blocks_begin(rows, how) > rounding ? NOT_KNOWN : FURTHER_IN;
}

/* A slice that begins among the rows: its integrals, K at its inner end, which may lie further in, and the
 * other level at both ends where it is asked for, NaN at an inner one that does. */
static bool by_rows(const struct fret_pieces *of, int by, fret_real whole, fret_real target, fret_real left,
                    stretch *sum, fret_real *K, fret_real other[2]) {
    const law *all = of->law;
    const fret_spot_by how = by == LOADS ? SPOT_LOAD : SPOT_DEPTH;
    fret_place outer, inner;
    ends c;
    if (!all->rows || !fret_blocks_find(all->rows, of->stop, how, whole, &outer))
        return false;
    const ending ends_in = end_among_rows(of, all->rows, how, &outer, target, left, &inner);
    if (ends_in == NOT_KNOWN || (ends_in == FURTHER_IN && !fret_blocks_inner(all->rows, of->stop, &inner)) ||
        !fret_blocks_between(all->rows, of->stop, &outer, &inner, sum))
        return false;
    if (other) {
        const int wanted = by == LOADS ? DEPTHS : LOADS;
        other[0] = fret_rows_level(outer.rows, wanted, &outer.spot);
        other[1] = ends_in == WITHIN ? fret_rows_level(inner.rows, wanted, &inner.spot) : (fret_real)NAN;
    }
    *K = fret_rows_stiffness(inner.rows, &inner.spot);
    const fret_real base = fret_level_by(&all->piece[all->count - 1].outer, by);
    if (ends_in == WITHIN || left >= base)
        return true;
    if (!find_ends(all, by, base, base - left, left, &c))
        return false;
    const stretch rest = integrals_of(all, by, &c, K);
    *sum = fret_stretch_join(sum, &rest);
    return true;
}

/* A slice too thin for polynomials of many rows together; the thinnest ones are for the table itself. */
static const fret_real THINNEST = 1e-6L;
static bool find_thin(const struct fret_pieces *of, int by, fret_real whole, fret_real target,
                      fret_place *outer, fret_place *inner) {
    const fret_spot_by how = by == LOADS ? SPOT_LOAD : SPOT_DEPTH;
    struct fret_blocks *rows = of->law->thin;
    return rows && target < of->law->enough * whole && fret_blocks_find(rows, of->stop, how, whole, outer) &&
           fret_blocks_drop(rows, of->stop, how, outer, target, inner);
}

/* Is it one that its rows were for, which could not be made? Then it is for the table itself, too. */
static bool wants_rows(const law *all, int by, fret_real whole, fret_real target) {
    const fret_spot_by how = by == LOADS ? SPOT_LOAD : SPOT_DEPTH;
    return all->thin && target < all->enough * whole && whole - target > fret_blocks_begin(all->thin, how);
}

static bool by_blocks(const struct fret_pieces *of, int by, fret_real whole, fret_real target, stretch *sum,
                      fret_real *K) {
    fret_place outer, inner;
    if (!find_thin(of, by, whole, target, &outer, &inner) ||
        !fret_blocks_between(of->law->thin, of->stop, &outer, &inner, sum))
        return false;
    *K = fret_rows_stiffness(inner.rows, &inner.spot);
    return true;
}

static bool slice_of(const struct fret_pieces *of, int by, bool thin, fret_real whole, fret_real target,
                     fret_real left, fret_real *h, fret_slice *out) {
    const law *all = of->law;
    ends c;
    fret_real K;
    stretch s;
    if (thin && all->thin && target < THINNEST * whole)
        return false;
    if (!by_rows(of, by, whole, target, left, &s, &K, NULL) &&
        !(thin && by_blocks(of, by, whole, target, &s, &K))) {
        if ((thin && wants_rows(all, by, whole, target)) || !find_ends(all, by, whole, target, left, &c))
            return false;
        s = integrals_of(all, by, &c, &K);
    }
    *h = by == LOADS ? s.h : fminl(target, whole);
    *out = (fret_slice){.w = by == LOADS ? fminl(target, whole) : s.G + *h * K,
                        .J = (*h * *h * K + (*h * s.G - s.L)) / 2,
                        .G = s.G,
                        .L = s.L};
    return true;
}

bool fret_pieces_slice(const struct fret_pieces *pieces, const fret_level *outer, bool by_load, bool thin,
                       fret_real target, fret_real left, fret_real *h, fret_slice *out) {
    const fret_real scale = pieces->scale, per = by_load ? 1 / scale : 1;
    if (!slice_of(pieces, by_load ? LOADS : DEPTHS, thin, (by_load ? outer->F : outer->y) * per, target * per,
                  left * per, h, out))
        return false;
    out->w = by_load ? fminl(target, outer->F) : out->w * scale;
    out->J *= scale;
    out->G *= scale;
    out->L *= scale;
    return true;
}

/* Of the whole slice where nothing is left: `of_whole`. */
static bool across_of(const struct fret_pieces *of, int by, bool thin, fret_real whole, fret_real target,
                      fret_real of_whole, fret_real *other) {
    const law *all = of->law;
    const int table = by == LOADS ? BY_LOAD : BY_DEPTH, wanted = by == LOADS ? DEPTHS : LOADS;
    const fret_spot_by how = by == LOADS ? SPOT_LOAD : SPOT_DEPTH;
    fret_point at;
    fret_place outer, inner;
    ends c;
    if (all->rows && fret_blocks_find(all->rows, of->stop, how, whole, &outer)) {
        const ending ends_in = end_among_rows(of, all->rows, how, &outer, target, whole - target, &inner);
        if (ends_in == WITHIN)
            *other = fret_blocks_fall(all->rows, wanted, &outer, &inner);
        else if (ends_in == FURTHER_IN && point_of(of, table, whole - target, &at))
            *other = fret_rows_level(outer.rows, wanted, &outer.spot) - (by == LOADS ? at.y : at.F);
        else
            return false;
        return true;
    }
    if (thin && all->thin && target < THINNEST * whole)
        return false;
    if (thin && find_thin(of, by, whole, target, &outer, &inner)) {
        *other = fret_blocks_fall(all->thin, wanted, &outer, &inner);
        return true;
    }
    if ((thin && wants_rows(all, by, whole, target)) ||
        !find_ends(all, by, whole, target, whole - target, &c))
        return false;
    *other = c.inner == all->count ? of_whole : fall_of(all, wanted, &c);
    return true;
}

bool fret_pieces_across(const struct fret_pieces *pieces, const fret_level *outer, bool by_load, bool thin,
                        fret_real target, fret_real *other) {
    const fret_real scale = pieces->scale, per = by_load ? 1 / scale : 1;
    if (!across_of(pieces, by_load ? LOADS : DEPTHS, thin, (by_load ? outer->F : outer->y) * per,
                   target * per, by_load ? outer->y : outer->F / scale, other))
        return false;
    *other *= by_load ? 1 : scale;
    return true;
}

/* The mean where the outer end lies among the rows. */
static bool mean_by_rows(const struct fret_pieces *of, int by, fret_real from, fret_real to, fret_real end[2],
                         fret_real *mean) {
    const fret_real most = fmaxl(from, to), least = fminl(from, to);
    fret_point p;
    fret_real at[2];
    stretch s;
    fret_real K;
    if (!by_rows(of, by, most, most - least, least, &s, &K, at))
        return false;
    if (isnan(at[1])) {
        if (!point_of(of, by == LOADS ? BY_LOAD : BY_DEPTH, least, &p))
            return false;
        at[1] = by == LOADS ? p.y : p.F;
    }
    for (int i = 0; i < 2; i++)
        end[i] = at[(i ? to : from) < most];
    const fret_real w = s.G + s.h * K, J = (s.h * s.h * K + (s.h * s.G - s.L)) / 2;
    *mean = most == least ? end[0]
            : by == LOADS ? fmaxl(end[0], end[1]) - J / w
                          : fminl(end[0], end[1]) + J / s.h;
    return true;
}

/* Depth by load, or load by depth, at both ends of a way, and its mean between them. */
static bool mean_of(const struct fret_pieces *of, int by, fret_real from, fret_real to, fret_real end[2],
                    fret_real *mean) {
    const law *all = of->law;
    const int other = by == LOADS ? DEPTHS : LOADS;
    fret_real sum[2], base = 0;
    size_t at[2];
    if (mean_by_rows(of, by, from, to, end, mean))
        return true;
    for (int i = 0; i < 2; i++)
        if (!find(all, by == LOADS ? BY_LOAD : BY_DEPTH, i ? to : from, &at[i]))
            return false;
    for (int i = 0; i < 2; i++) {
        const piece *p = &all->piece[at[i]];
        fret_real work[2];
        const fret_level rise = fret_piece_work(p, place_of(p, by, i ? to : from), work);
        const fret_real inner = fret_level_by(&p->inner, other);
        end[i] = inner + fret_level_by(&rise, other);
        sum[i] = work[other];
        if (at[0] == at[1])
            base = inner;
        else
            sum[i] += p->sum[other] + inner * fret_level_by(&rise, by);
    }
    *mean = from == to ? end[0] : base + (sum[0] - sum[1]) / (from - to);
    return true;
}

bool fret_pieces_mean(const struct fret_pieces *pieces, fret_real from, fret_real to, fret_real *mean) {
    fret_real end[2];
    if (!(from == to || fabsl(from - to) > 1e-3L * fmaxl(from, to)) ||
        !mean_of(pieces, DEPTHS, from, to, end, mean))
        return false;
    *mean *= pieces->scale;
    return true;
}

/* ---- phases ------------------------------------------------------------------------------------ */

/* With v(e) what the law makes of the coordinate e: the loss is the integral of the distance of v at the edge
 * from its tangent at the front, int [v(E)-v(f)-(E-f) v'(f)] df, in parts: less a straight line, which counts
 * for nothing, of v at the front's ends and of the means of v over both ways. moved: of the edge. */
static fret_real bow_of(const fret_real edge[2], const fret_real front[2], const fret_real v[2],
                        fret_real mean, fret_real mean_edge) {
    const fret_real went = front[0] - front[1], moved = edge[0] - edge[1];
    return fabsl((edge[0] - front[0]) * v[0] - (edge[1] - front[1]) * v[1] - (moved - 2 * went) * mean -
                 went * mean_edge);
}

static bool bow_of_whole(const struct fret_pieces *of, int by, const fret_real edge[2],
                         const fret_real front[2], fret_real *out, fret_real *bound) {
    const fret_real went = front[0] - front[1], moved = edge[0] - edge[1];
    fret_real v[2], at_edge[2], mean, mean_edge;
    if (!mean_of(of, by, front[0], front[1], v, &mean) ||
        !mean_of(of, by, edge[0], edge[1], at_edge, &mean_edge))
        return false;
    *out = bow_of(edge, front, v, mean, mean_edge);
    *bound = 1e-19L * fmaxl(edge[0] * at_edge[0], edge[1] * at_edge[1]) *
             (1 + fabsl(moved) / went + (moved != 0 ? went / fabsl(moved) : 0));
    return true;
}

/* From each of four places inwards to the one before, and K at the first; those next to each other may be
 * one.
 */
typedef struct ways {
    stretch part[3];
    fret_real K;
} ways;

static bool ways_by_rows(const struct fret_pieces *of, int by, const fret_real place[4], ways *out) {
    const fret_spot_by how = by == LOADS ? SPOT_LOAD : SPOT_DEPTH;
    struct fret_blocks *rows = of->law->rows;
    fret_place at[4];
    for (int i = 0; i < 4; i++)
        if (i > 0 && place[i] == place[i - 1])
            at[i] = at[i - 1];
        else if (!fret_blocks_find(rows, of->stop, how, place[i], &at[i]))
            return false;
    for (int i = 0; i < 3; i++)
        if (!fret_blocks_between(rows, of->stop, &at[i + 1], &at[i], &out->part[i]))
            return false;
    out->K = fret_rows_stiffness(at[0].rows, &at[0].spot);
    return true;
}

static bool find_ways(const struct fret_pieces *of, int by, const fret_real place[4], ways *out) {
    const law *all = of->law;
    if (all->rows && ways_by_rows(of, by, place, out))
        return true;
    fret_real K;
    out->K = (fret_real)NAN;
    for (int i = 0; i < 3; i++) {
        const fret_real outer = place[i + 1], inner = place[i];
        ends c;
        out->part[i] = (stretch){0, 0, 0, 0};
        if (outer == inner)
            continue;
        if (!by_rows(of, by, outer, outer - inner, inner, &out->part[i], &K, NULL)) {
            if (!find_ends(all, by, outer, outer - inner, inner, &c))
                return false;
            out->part[i] = integrals_of(all, by, &c, &K);
        }
        if (isnan(out->K))
            out->K = K;
    }
    return true;
}

/* q, the distance of v from its tangent at a place where dF/dy is K, from there over the stretches `below`
 * and s: its integral over s. All of it is positive. */
static fret_real area_of(int by, const stretch *below, const stretch *s, fret_real K) {
    const fret_real rise = below->K * s->h + s->G,
                    area = (below->G + below->K * s->h / 2) * s->h + (s->h * s->G - s->L) / 2;
    return by == LOADS ? area + rise * (below->G + rise / 2) / K : area;
}

/* The same with v less its tangent where the front ends: what lies within that has no part in it. */
static bool bow_beyond(const struct fret_pieces *of, int by, const fret_real edge[2],
                       const fret_real front[2], fret_real *out, fret_real *bound) {
    static const stretch nothing;
    const fret_real lo = fminl(edge[0], edge[1]), hi = fmaxl(edge[0], edge[1]),
                    place[4] = {front[1], fminl(front[0], lo), fmaxl(front[0], lo), hi};
    stretch whole[3];
    ways w;
    if (!(front[1] > 0) || !find_ways(of, by, place, &w))
        return false;
    for (int i = 0; i < 3; i++)
        whole[i] = i ? fret_stretch_join(&w.part[i], &whole[i - 1]) : w.part[0];
    const bool passed = lo < front[0]; /* the edge comes to where the front was */
    const stretch *to_front = &whole[passed], *to_edge = &whole[!passed],
                  way = passed ? fret_stretch_join(&w.part[2], &w.part[1]) : w.part[2];
    const fret_real moved = edge[0] - edge[1], K = w.K, per = by == LOADS ? 1 / K : 1,
                    v[2] = {to_front->G * per, 0},
                    mean = area_of(by, &nothing, to_front, K) / (front[0] - front[1]),
                    /* over the way as it is known: of a short one hi - lo has other digits */
        over = by == LOADS ? (K + to_edge->K) * way.h + way.G : way.h,
                    mean_edge = over > 0 ? area_of(by, to_edge, &way, K) / over : whole[2].G * per;
    *out = bow_of(edge, front, v, mean, mean_edge);
    *bound = 1e-17L * ((edge[0] - front[0]) * v[0] + (fabsl(moved) + 2 * (front[0] - front[1])) * mean +
                       (front[0] - front[1]) * mean_edge);
    return true;
}

bool fret_pieces_phase(const struct fret_pieces *pieces, bool by_load, const fret_real edges[2],
                       const fret_real fronts[2], fret_real enough, fret_real *out, fret_real *bound) {
    typedef bool how(const struct fret_pieces *, int, const fret_real *, const fret_real *, fret_real *,
                     fret_real *);
    const law *all = pieces->law;
    const fret_real scale = pieces->scale, per = by_load ? 1 / scale : 1,
                    edge[2] = {edges[0] * per, edges[1] * per}, front[2] = {fronts[0] * per, fronts[1] * per};
    how *const by[2] = {all->rows ? bow_beyond : bow_of_whole, all->rows ? bow_of_whole : bow_beyond};
    fret_real parts = 0, off = (fret_real)INFINITY, other[2];
    for (int i = 0; i < 2 && front[0] > front[1] && !(off <= enough * parts); i++)
        if (by[i](pieces, by_load ? LOADS : DEPTHS, edge, front, &other[0], &other[1]) && other[1] < off) {
            parts = other[0];
            off = other[1];
        }
    if (isinf(off))
        return false;
    *out = parts * scale;
    *bound = off * scale;
    return true;
}
