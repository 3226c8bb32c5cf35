/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Row by row: depth and load above the beginning of a row as polynomials, and what its kink adds; of every
 * row its integrals, and of runs of rows. Allocates them, and frees them. */
#include "contact/rows.h"

#include <float.h>
#include <stdlib.h>

#include "contact/check.h"
#include "contact/leaves.h"
#include "contact/table.h"
#include "number/quadrature.h"
#include "number/real.h"

/* Within a row y = 0..1 is linear in the square of the radius x. Depth and load are smooth there but for the
 * kink where the row begins: they rise by y (P(y) + y^m Q(y)), m = (k+1)/2, with polynomials P and Q. A part
 * is a row, or as much of it as is no longer than it is far from the kink before: there 20 nodes do. */
enum { WAVES = 20, FEWER = 8, BINOMIALS = 12, MOST_POINTS = 32 };

typedef struct part {
    fret_real x, width, rate;  /* radius of its inner end; its length in x^2; dK/dy at the inner end */
    size_t term;               /* P and Q of the depth, then of the load */
    unsigned char count[2][2]; /* how many */
} part;

struct fret_rows {
    fret_real start, m, C;
    size_t count, room, terms, most_terms;
    part *part;
    fret_real *term;
    fret_real *reach[3];           /* where each part begins, and the last one ends: distance, depth, load */
    stretch *run[RUNS];            /* as those of pieces */
    fret_real binomial[BINOMIALS]; /* of (1+z)^(m-1) */
    fret_real node[2][MOST_POINTS], weight[2][MOST_POINTS], power[2][MOST_POINTS]; /* y, dy, y^m */
};

/* ---- within a part ----------------------------------------------------------------------------- */

static fret_real sum_of(const fret_real *c, size_t count, fret_real y) {
    fret_real sum = 0;
    while (count-- > 0)
        sum = sum * y + c[count];
    return sum;
}

/* The rise from the beginning of the part to y, ym = y^m; at its end what is kept, so that what parts add up
 * to is exact. */
static fret_real rise_of(const struct fret_rows *all, size_t i, int by, fret_real y, fret_real ym) {
    const part *p = &all->part[i];
    const fret_real *reach = all->reach[by == LOADS ? SPOT_LOAD : SPOT_DEPTH] + i;
    if (y >= 1)
        return reach[1] - reach[0];
    const fret_real *c = all->term + p->term + (by == LOADS ? p->count[DEPTHS][0] + p->count[DEPTHS][1] : 0);
    const size_t smooth = p->count[by][0], bent = p->count[by][1];
    return y * (sum_of(c, smooth, y) + ym * sum_of(c + smooth, bent, y));
}

static fret_real to_m(const struct fret_rows *all, fret_real y) {
    return y > 0 ? fret_exp(all->m * fret_log(y)) : 0;
}

/* (1+z)^(m-1) */
static fret_real near_one(const struct fret_rows *all, fret_real z) {
    if (z > 0.02L)
        return fret_exp((all->m - 1) * fret_log1p(z));
    return sum_of(all->binomial, z < 1e-3L ? 7 : BINOMIALS, z);
}

/* Is the part as wide as it is far from the centre? Then it wants more nodes. */
static bool is_wide(const part *p) {
    return p->width > 0.2L * p->x * p->x;
}

static void add_node(stretch *sum, fret_real t, fret_real dK) {
    sum->K += dK;
    sum->G += t * dK;
    sum->L += t * (sum->h - t) * dK;
}

/* From y inwards to the beginning of the part: in third roots, in which the kink is smooth enough. */
static stretch part_below(const struct fret_rows *all, size_t i, fret_real from) {
    const part *p = &all->part[i];
    const int wide = is_wide(p), nodes = MOST_POINTS / (wide ? 1 : 2);
    const fret_real from_m = from < 1 ? to_m(all, from) : 1, bend = p->width / (p->x * p->x),
                    edge = rise_of(all, i, DEPTHS, from, from_m);
    stretch out = {edge, 0, 0, 0};
    for (int j = 0; j < nodes; j++) {
        const fret_real y = from * all->node[wide][j],
                        t = edge - rise_of(all, i, DEPTHS, y, from_m * all->power[wide][j]);
        add_node(&out, t, p->rate * near_one(all, bend * y) * from * all->weight[wide][j]);
    }
    return out;
}

/* From y inwards to another one. */
static stretch part_of(const struct fret_rows *all, size_t i, fret_real from, fret_real to) {
    if (to <= 0)
        return part_below(all, i, from);
    const part *p = &all->part[i];
    const int parts = is_wide(p) ? 4 : 2;
    const fret_real s0 = fret_exp(fret_log(from) / 3), way = fret_exp(fret_log(to) / 3) - s0,
                    bend = p->width / (p->x * p->x), edge = rise_of(all, i, DEPTHS, from, to_m(all, from));
    stretch out = {edge - rise_of(all, i, DEPTHS, to, to_m(all, to)), 0, 0, 0};
    for (int j = 0; j < 8 * parts; j++) {
        const fret_real s = s0 + way * ((fret_real)(j / 8) + fret_gauss_node[j % 8]) / (fret_real)parts,
                        y = s * s * s, t = edge - rise_of(all, i, DEPTHS, y, to_m(all, y));
        add_node(&out, t,
                 p->rate * near_one(all, bend * y) * 3 * s * s * -way * fret_gauss_weight[j % 8] /
                     (fret_real)parts);
    }
    return out;
}

/* From the end of the part to y, by what there is below. */
static stretch part_above(const struct fret_rows *all, size_t i, fret_real to) {
    const stretch whole = all->run[0][i], below = part_below(all, i, to);
    const fret_real h = whole.h - below.h, K = whole.K - below.K, G = whole.G - below.G - h * below.K;
    return (stretch){h, K, G, whole.L - below.L - below.h * G - h * (below.h * below.K - below.G)};
}

/* ---- places ------------------------------------------------------------------------------------ */

static fret_real distance_at(const struct fret_rows *all, size_t i, fret_real y) {
    const part *p = &all->part[i];
    return all->reach[SPOT_DISTANCE][i] + p->width * y / (p->x + sqrtl(p->x * p->x + p->width * y));
}

/* y where a level is so far above the beginning of the part: by chords, each within what the ones before have
 * left. */
static fret_real search(const struct fret_rows *all, size_t i, int by, fret_real value) {
    const fret_real *reach = all->reach[by == LOADS ? SPOT_LOAD : SPOT_DEPTH] + i, target = value - reach[0];
    fret_real lo = 0, hi = 1, below = -target, above = reach[1] - value, y = 1;
    for (int j = 0, side = 0; j < 40; j++) {
        const fret_real next = hi - above / (above - below) * (hi - lo);
        y = next > lo && next < hi ? next : (lo + hi) / 2;
        const fret_real miss = rise_of(all, i, by, y, to_m(all, y)) - target;
        if (fabsl(miss) <= LDBL_EPSILON * value || !(hi - lo > LDBL_EPSILON * hi))
            break;
        if (miss < 0) { /* an end that stays counts half */
            lo = y;
            below = miss;
            above /= side == -1 ? 2 : 1;
            side = -1;
        } else {
            hi = y;
            above = miss;
            below /= side == 1 ? 2 : 1;
            side = 1;
        }
    }
    return y;
}

bool fret_rows_find(const struct fret_rows *all, fret_spot_by by, fret_real value, fret_spot *out) {
    const fret_real *reach = all->reach[by];
    if (!(value > reach[0] && value <= reach[all->count]))
        return false;
    size_t lo = 0, count = all->count; /* the first whose end is not before the value */
    while (count > 1) {
        const size_t half = count / 2;
        lo += reach[lo + half] < value ? half : 0;
        count -= half;
    }
    const part *p = &all->part[lo];
    const fret_real beyond = value - reach[lo],
                    y = value >= reach[lo + 1] ? 1
                        : by == SPOT_DISTANCE  ? fminl(beyond * (2 * p->x + beyond) / p->width, 1)
                                               : search(all, lo, by == SPOT_LOAD ? LOADS : DEPTHS, value);
    const fret_real ym = to_m(all, y);
    *out = (fret_spot){.part = lo, .along = y, .e = by == SPOT_DISTANCE ? value : distance_at(all, lo, y)};
    out->at.y = by == SPOT_DEPTH ? value : all->reach[SPOT_DEPTH][lo] + rise_of(all, lo, DEPTHS, y, ym);
    out->at.F = by == SPOT_LOAD ? value : all->reach[SPOT_LOAD][lo] + rise_of(all, lo, LOADS, y, ym);
    return true;
}

static fret_spot beginning(const struct fret_rows *all, size_t i) {
    return (fret_spot){
        i, 0, all->reach[SPOT_DISTANCE][i], {all->reach[SPOT_DEPTH][i], all->reach[SPOT_LOAD][i]}};
}

fret_spot fret_rows_inner(const struct fret_rows *all) {
    return beginning(all, 0);
}

fret_spot fret_rows_outer(const struct fret_rows *all) {
    return beginning(all, all->count);
}

fret_real fret_rows_stiffness(const struct fret_rows *all, const fret_spot *s) {
    return all->C * fret_pow(all->start + s->e, 2 * all->m);
}

size_t fret_rows_parts(const struct fret_rows *all) {
    return all->count;
}

fret_row_part fret_rows_part(const struct fret_rows *all, size_t i) {
    const part *p = &all->part[i];
    const fret_real *P = all->term + p->term;
    return (fret_row_part){.inner = p->x,
                           .outer = all->start + all->reach[SPOT_DISTANCE][i + 1],
                           .width = p->width,
                           .depth = all->reach[SPOT_DEPTH][i],
                           .P = P,
                           .Q = P + p->count[DEPTHS][0],
                           .S = P + p->count[DEPTHS][0] + p->count[DEPTHS][1],
                           .B = P + p->count[DEPTHS][0] + p->count[DEPTHS][1] + p->count[LOADS][0],
                           .depths = {p->count[DEPTHS][0], p->count[DEPTHS][1]},
                           .slopes = {p->count[LOADS][0], p->count[LOADS][1]}};
}

stretch fret_rows_between(const struct fret_rows *all, const fret_spot *outer, const fret_spot *inner) {
    enum { MANY = 4 }; /* of which a part that is a difference keeps its digits */
    if (outer->part == inner->part && outer->along > inner->along)
        return part_of(all, outer->part, outer->along, inner->along);
    stretch sum = {0, 0, 0, 0};
    if (outer->e <= inner->e)
        return sum;
    if (outer->along > 0)
        sum = part_below(all, outer->part, outer->along);
    const size_t next = inner->part + (inner->along > 0);
    fret_stretch_add_runs(all->run, outer->part, next, &sum);
    if (inner->along > 0) {
        const stretch rest = outer->part - next >= MANY ? part_above(all, inner->part, inner->along)
                                                        : part_of(all, inner->part, 1, inner->along);
        sum = fret_stretch_join(&sum, &rest);
    }
    return sum;
}

/* ---- making ------------------------------------------------------------------------------------ */

/* Chebyshev's polynomials of 2y-1 and their nodes. */
typedef struct rule {
    int nodes;
    fret_real y[WAVES], ym[WAVES], wave[4 * WAVES], power[WAVES][WAVES];
} rule;

typedef struct maker {
    struct fret_rows *all;
    const fret_normal *normal;
    struct fret_leaves *leaves;
    rule many, few;
    struct beginning {
        fret_real e;
        fret_level at;
    } * begin; /* of each part, and the end of the last one */
    size_t room;
    bool slopes; /* g' dx/dy in place of loads */
    fret_status failed;
} maker;

static void make_rule(rule *r, int nodes, fret_real m) {
    r->nodes = nodes;
    for (int i = 0; i < 4 * nodes; i++)
        r->wave[i] = fret_cos(FRET_PI * (fret_real)i / (fret_real)(2 * nodes));
    for (int j = 0; j < nodes; j++) {
        r->y[j] = (1 + r->wave[2 * j + 1]) / 2;
        r->ym[j] = fret_pow(r->y[j], m);
    }
    for (int i = 0; i < nodes; i++)
        for (int j = 0; j < nodes; j++)
            r->power[i][j] =
                i == 0   ? (fret_real)(j == 0)
                : i == 1 ? (fret_real)(j == 0   ? -1
                                       : j == 1 ? 2
                                                : 0)
                         : (j ? 4 * r->power[i - 1][j - 1] : 0) - 2 * r->power[i - 1][j] - r->power[i - 2][j];
}

/* Powers of y, as many as there is something of. */
static int fit(const rule *r, const fret_real *value, fret_real little, fret_real *c) {
    fret_real term[WAVES];
    const int n = r->nodes;
    int count = n;
    for (int i = 0; i < n; i++) {
        term[i] = 0;
        for (int j = 0; j < n; j++)
            term[i] += r->wave[i * (2 * j + 1) % (4 * n)] * value[j];
        term[i] *= (i ? 2 : 1) / (fret_real)n;
    }
    while (count > 0 && fabsl(term[count - 1]) <= little)
        count--;
    for (int j = 0; j < count; j++) {
        c[j] = 0;
        for (int i = j; i < count; i++)
            c[j] += term[i] * r->power[i][j];
    }
    return count;
}

static void make_nodes(struct fret_rows *all) {
    for (int wide = 0; wide < 2; wide++)
        for (int j = 0; j < MOST_POINTS / (wide ? 1 : 2); j++) {
            const fret_real parts = 2 << wide, s = ((fret_real)(j / 8) + fret_gauss_node[j % 8]) / parts;
            all->node[wide][j] = s * s * s;
            all->weight[wide][j] = 3 * s * s * fret_gauss_weight[j % 8] / parts;
            all->power[wide][j] = to_m(all, s * s * s);
        }
    fret_real c = 1;
    for (int j = 0; j < BINOMIALS; j++) {
        all->binomial[j] = c;
        c *= (all->m - 1 - (fret_real)j) / (fret_real)(j + 1);
    }
}

/* Twice as much, where there is no room for one more of `size`. */
static bool grow(maker *m, void **data, size_t count, size_t more, size_t *room, size_t size) {
    if (count + more <= *room)
        return true;
    const size_t wanted = 2 * *room + more + 64;
    void *grown = realloc(*data, wanted * size);
    if (!grown) {
        m->failed = fret_fail(FRET_NO_MEMORY, NULL, 0, 0);
        return false;
    }
    *data = grown;
    *room = wanted;
    return true;
}

static void take(fret_real into[2], const fret_level *l) {
    into[DEPTHS] = l->y;
    into[LOADS] = l->F;
}

static fret_level level_at(const maker *m, size_t row, fret_real e) {
    const fret_level before = fret_leaves_before(m->leaves, row, e),
                     more = fret_leaves_bend(m->leaves, row, e);
    return (fret_level){before.y + more.y, before.F + more.F};
}

/* From the distance e on, so far in the square of the radius. */
static bool add_part(maker *m, size_t row, fret_real e, fret_real width, bool kink) {
    static const fret_real LITTLE = 2e-19L;
    struct fret_rows *all = m->all;
    fret_real smooth[2][WAVES], bent[2][WAVES], base[2], c[WAVES], top[2], v[2];
    void *parts = all->part, *terms = all->term, *begin = m->begin;
    const bool room = grow(m, &parts, all->count, 1, &all->room, sizeof *all->part) &&
                      grow(m, &terms, all->terms, 4 * WAVES, &all->most_terms, sizeof *all->term) &&
                      grow(m, &begin, all->count, 2, &m->room, sizeof *m->begin);
    all->part = parts;
    all->term = terms;
    m->begin = begin;
    if (!room)
        return false;
    const fret_real x = all->start + e, bend = width / (x * x);
    const fret_level at_e = level_at(m, row, e);
    m->begin[all->count] = (struct beginning){e, at_e};
    const rule *few = bend < 0.01L ? &m->few : &m->many;
    const bool slopes = m->slopes;
    part *p = &all->part[all->count++];
    *p = (part){.x = x, .width = width, .term = all->terms};
    p->rate = all->C * all->m * width * fret_pow(x, 2 * (all->m - 1));
    take(base, &at_e);
    base[LOADS] = slopes ? 0 : base[LOADS];
    for (int j = 0; j < WAVES; j++) {
        const fret_real to = sqrtl(x * x + width * m->many.y[j]), at = e + width * m->many.y[j] / (x + to);
        const fret_level l = kink ? fret_leaves_before(m->leaves, row, at) : level_at(m, row, at);
        take(v, &l);
        v[LOADS] *= slopes ? width / (2 * to) : 1;
        for (int by = 0; by < 2; by++)
            smooth[by][j] = v[by] - base[by];
        if (j == 0) /* the outermost */
            take(top, &(fret_level){v[DEPTHS], v[LOADS]});
    }
    for (int j = 0; kink && j < few->nodes; j++) {
        const fret_real y = few->y[j], to = sqrtl(x * x + width * y), at = e + width * y / (x + to);
        const fret_level l = fret_leaves_bend(m->leaves, row, at);
        bent[DEPTHS][j] = l.y / (y * few->ym[j]);
        bent[LOADS][j] = l.F / few->ym[j] * (slopes ? width / (2 * to) : 1 / y);
    }
    for (int by = 0; by < 2; by++) {
        const int nothing = by == DEPTHS || !slopes; /* is the first, of a rise */
        int count = fit(&m->many, smooth[by], LITTLE * top[by], c) - nothing;
        for (int j = 0; j < count; j++)
            all->term[all->terms++] = c[j + nothing];
        p->count[by][0] = (unsigned char)(count > 0 ? count : 0);
        count = kink ? fit(few, bent[by], LITTLE * top[by], c) : 0;
        for (int j = 0; j < count; j++)
            all->term[all->terms++] = c[j];
        p->count[by][1] = (unsigned char)count;
    }
    return true;
}

/* A row in parts, the first as long as the kink before is away. */
static bool add_row(maker *m, size_t row) {
    const struct fret_table *t = m->normal->gap.table;
    const fret_real start = m->all->start, from = fret_table_distance(t, row),
                    end = fret_table_distance(t, row + 1), before = fret_table_distance(t, row - 1),
                    x = start + from, whole = (end - from) * (start + end + x),
                    away = (from - before) * (start + before + x);
    const fret_real enough =
        !m->slopes && whole < 1e-3L * from * (start + x) ? 1.6L : 1.1L; /* where it rises by little */
    if (fret_stopped(m->normal))
        return false;
    for (fret_real at = 0, width = away; at < whole; at += width, width = at) {
        if (whole - at < enough * width)
            width = whole - at;
        if (!add_part(m, row, from + at / (x + sqrtl(x * x + at)), width, at <= 0))
            return false;
    }
    return true;
}

static bool allocate(struct fret_rows *all, bool runs) {
    const size_t n = all->count;
    bool ok = true;
    for (int i = 0; i < 3; i++) {
        all->reach[i] = malloc((n + 1) * sizeof *all->reach[i]);
        ok = ok && all->reach[i];
    }
    for (int l = 0; runs && n >> l; l++) {
        all->run[l] = malloc((n >> l) * sizeof *all->run[l]);
        ok = ok && all->run[l];
    }
    return ok;
}

/* Beginnings and integrals of the parts. */
static void make_runs(maker *m) {
    struct fret_rows *all = m->all;
    for (size_t i = 0; i <= all->count; i++) {
        all->reach[SPOT_DISTANCE][i] = m->begin[i].e;
        all->reach[SPOT_DEPTH][i] = m->begin[i].at.y;
        all->reach[SPOT_LOAD][i] = m->begin[i].at.F;
    }
    for (size_t i = 0; i < all->count && !m->slopes && !fret_stopped(m->normal); i++)
        all->run[0][i] = part_below(all, i, 1);
    for (int l = 1; all->count >> l && !m->slopes; l++)
        for (size_t i = 0; i < all->count >> l; i++)
            all->run[l][i] = fret_stretch_join(&all->run[l - 1][2 * i + 1], &all->run[l - 1][2 * i]);
}

/* Against the profile here and there, and the load of all against the sum of what the parts carry. */
static fret_real error_of(const maker *m) {
    enum { LOOKS = 32 };
    const struct fret_rows *all = m->all;
    const fret_normal *n = m->normal;
    const fret_spot outer = fret_rows_outer(all), inner = fret_rows_inner(all);
    const stretch sum = fret_rows_between(all, &outer, &inner);
    fret_real worst =
        fabsl(inner.at.F + sum.G + sum.h * fret_rows_stiffness(all, &inner) - outer.at.F) / outer.at.F;
    for (int i = 0; i < LOOKS; i++) {
        const size_t j = (size_t)((double)all->count * (i + 0.5) / LOOKS);
        const fret_real *e = all->reach[SPOT_DISTANCE] + j, place = e[0] + (e[1] - e[0]) * (i % 5 + 1) / 6;
        const fret_profile p = fret_table_profile(n->gap.table, &n->rule, place);
        fret_spot at;
        (void)fret_rows_find(all, SPOT_DISTANCE, place, &at);
        worst = fmaxl(worst, fabsl(at.at.y / p.g - 1));
        worst = fmaxl(worst, fabsl(at.at.F / fret_force_of(n, &p) - 1));
    }
    return worst;
}

/* The rows, first .. first+count-1. */
static bool add_rows(maker *m, size_t first, size_t count, fret_real e) {
    struct fret_rows *all = m->all;
    const struct fret_table *t = m->normal->gap.table;
    m->failed = fret_leaves_make(m->normal, first, count, e, m->slopes, &m->leaves);
    if (m->failed.code)
        return false;
    make_rule(&m->many, WAVES, all->m);
    make_rule(&m->few, FEWER, all->m);
    make_nodes(all);
    for (size_t i = first; i < first + count; i++)
        if (!add_row(m, i))
            return false;
    const fret_real end = fret_table_distance(t, first + count);
    m->begin[all->count] = (struct beginning){end, level_at(m, first + count - 1, end)};
    if (!allocate(all, !m->slopes)) {
        m->failed = fret_fail(FRET_NO_MEMORY, NULL, 0, 0);
        return false;
    }
    make_runs(m);
    return true;
}

static fret_status make_rows(const fret_normal *n, fret_real e, bool slopes, struct fret_rows **out,
                             fret_real *error) {
    const struct fret_table *t = n->gap.table;
    const size_t first = fret_table_row(t, 0) + 1;
    size_t last = fret_table_row(t, e) + 1;
    last -= last > first && fret_table_distance(t, last - 1) >= e;
    *out = NULL;
    if (last <= first)
        return fret_ok();
    struct fret_rows *all = calloc(1, sizeof *all);
    maker *m = calloc(1, sizeof *m);
    fret_status st = fret_fail(FRET_NO_MEMORY, NULL, 0, 0);
    if (all && m) {
        *all = (struct fret_rows){
            .start = fret_table_start(t), .m = (n->rule.k + 1) / 2, .C = fret_normal_stiffness(n, 1)};
        *m = (maker){.all = all, .normal = n, .slopes = slopes};
        const bool ok = add_rows(m, first, last - first, e);
        st = fret_unless_stopped(n, m->failed);
        if (ok && !st.code && !slopes)
            *error = error_of(m);
        fret_leaves_free(m->leaves);
        free(m->begin);
    }
    free(m);
    if (st.code)
        fret_rows_free(all);
    else
        *out = all;
    return st;
}

fret_status fret_rows_make(const fret_normal *n, fret_real e, struct fret_rows **out, fret_real *error) {
    return make_rows(n, e, false, out, error);
}

fret_status fret_rows_make_slopes(const fret_normal *n, fret_real e, struct fret_rows **out) {
    return make_rows(n, e, true, out, NULL);
}

void fret_rows_free(struct fret_rows *all) {
    if (!all)
        return;
    for (int l = 0; l < RUNS; l++)
        free(all->run[l]);
    for (int i = 0; i < 3; i++)
        free(all->reach[i]);
    free(all->part);
    free(all->term);
    free(all);
}
