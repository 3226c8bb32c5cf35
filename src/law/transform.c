/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The transform (3) of a sampled gap, by moments of blocks of rows. Allocates them, and frees them.
 *
 * With R = r^2, X = x^2 and m = (k+1)/2 it is g = X^(1-m) int f' (X-R)^(m-1) dr. Over a block of rows about
 * R0, of half-width d in R, with D = X-R0 well beyond d, (X-R)^(m-1) = D^(m-1) sum (1-m)_n/n! ((R-R0)/d)^n
 * (d/D)^n, so that a block needs only its moments int f' ((R-R0)/d)^n dr. Rows too near for that, and the row
 * that x lies in, use the moments of the kernel at the edge. */
#include "law/transform.h"

#include <stdlib.h>

#include "law/check.h"
#include "number/integral.h"
#include "number/real.h"

/* NEAR^-MOMENTS is 5e-20; the later moments contribute 2e-5 at most, so that double will do. */
enum { LEADING = 8, LATER = 24, MOMENTS = LEADING + LATER, NEAR = 4 };

/* A block of several rows, stored before its two halves. */
typedef struct block {
    size_t first, last, next;   /* rows; the first block after its parts */
    fret_real begin, end, R, d; /* radii */
    fret_real moment[LEADING];  /* times (1-m)_n/n! */
    double later[LATER];
} block;

struct fret_transform {
    const struct fret_table *table;
    const fret_rule *rule;
    fret_real m, start, factor[MOMENTS];
    size_t count;
    block *block;
};

static fret_real radius_of(const fret_transform *t, size_t row) {
    return t->start + fret_table_distance(t->table, row);
}

/* By the 8-point Gauss rule in parts of each row, at least four a block, which may begin at the centre. */
static void make_moments(const fret_transform *t, block *b) {
    const size_t rows = b->last - b->first;
    const int parts = rows >= 4 ? 1 : rows > 1 ? 2 : 4;
    for (size_t i = b->first; i < b->last; i++) {
        const fret_real r = radius_of(t, i), h = (radius_of(t, i + 1) - r) / (fret_real)parts;
        fret_real c[3];
        fret_table_slope(t->table, i, c);
        for (int j = 0; j < 8 * parts; j++) {
            const fret_real x = h * ((fret_real)(j / 8) + fret_gauss_node[j % 8]),
                            z = ((r + x) * (r + x) - b->R) / b->d;
            fret_real of = h * fret_gauss_weight[j % 8] * (c[0] + x * (c[1] + x * c[2]));
            for (int n = 0; n < LEADING; n++, of *= z)
                b->moment[n] += of;
            double rest = (double)of;
            for (int n = 0; n < LATER; n++, rest *= (double)z)
                b->later[n] += rest;
        }
    }
    for (int n = 0; n < MOMENTS; n++)
        if (n < LEADING)
            b->moment[n] *= t->factor[n];
        else
            b->later[n - LEADING] *= (double)t->factor[n];
}

static void make_block(fret_transform *t, size_t first, size_t last, fret_stop stop) {
    block *b = &t->block[t->count++];
    const fret_real lo = radius_of(t, first), hi = radius_of(t, last);
    *b = (block){.first = first,
                 .last = last,
                 .begin = lo,
                 .end = hi,
                 .R = (lo * lo + hi * hi) / 2,
                 .d = (hi - lo) * (hi + lo) / 2};
    if (stop && *stop)
        return;
    make_moments(t, b);
    if (last - first > 1) {
        make_block(t, first, first + (last - first) / 2, stop);
        make_block(t, first + (last - first) / 2, last, stop);
    }
    b->next = t->count;
}

fret_status fret_transform_make(const struct fret_table *table, const fret_rule *rule, fret_stop stop,
                                fret_transform **out) {
    const size_t first = fret_table_row(table, 0),
                 last = fret_table_row_count(table, fret_table_end(table)) - 1;
    fret_transform *t = calloc(1, sizeof *t);
    block *blocks = t ? malloc(2 * (last - first) * sizeof *blocks) : NULL;
    if (!blocks) {
        free(t);
        return fret_fail(FRET_NO_MEMORY, NULL, 0, 0);
    }
    *t = (fret_transform){.table = table, .rule = rule, .block = blocks};
    t->m = (rule->k + 1) / 2;
    t->start = fret_table_start(table);
    t->factor[0] = 1;
    for (int n = 1; n < MOMENTS; n++)
        t->factor[n] = t->factor[n - 1] * ((fret_real)n - t->m) / (fret_real)n;
    make_block(t, first, last, stop);
    if (stop && *stop) {
        fret_transform_free(t);
        return fret_fail(FRET_INTERRUPTED, NULL, 0, 0);
    }
    *out = t;
    return fret_ok();
}

void fret_transform_free(fret_transform *t) {
    if (t)
        free(t->block);
    free(t);
}

/* The sum over a distant block; D: X less its middle. */
static fret_real far_sum(const fret_transform *t, const block *b, fret_real D, fret_real X) {
    const fret_real ratio = b->d / D;
    const double x = (double)ratio, square = x * x;
    double even = 0, odd = 0; /* two independent sums take half the time */
    for (int n = LATER - 2; n >= 0; n -= 2) {
        odd = odd * square + b->later[n + 1];
        even = even * square + b->later[n];
    }
    fret_real sum = even + x * odd;
    for (int n = LEADING; n-- > 0;)
        sum = sum * ratio + b->moment[n];
    return sum * fret_pow(D / X, t->m - 1);
}

/* The integral for f' = c0 + c1 t + c2 t^2, t from a place at v = (x-r)/x from x, by the kernel's moments. */
static fret_real near_sum(const fret_real c[3], fret_real v, fret_real x, const fret_real moment[3]) {
    const fret_real c1 = c[1] * x, c2 = c[2] * x * x;
    return x * ((c[0] + v * (c1 + v * c2)) * moment[0] - (c1 + 2 * v * c2) * moment[1] + c2 * moment[2]);
}

fret_real fret_transform_at(const fret_transform *t, size_t last, size_t from, fret_real e) {
    const fret_real begin = radius_of(t, from), x = begin + e, X = x * x;
    fret_real sum = 0, c[3], moment[3];
    for (size_t i = 0; i < t->count && t->block[i].first < last;) {
        const block *b = &t->block[i];
        const bool within = b->last <= last, single = b->next == i + 1;
        const fret_real lo = (begin - b->begin) + e, D = lo * (2 * x - lo) - b->d;
        if (within && D >= (fret_real)NEAR * b->d)
            sum += far_sum(t, b, D, X);
        else if (!single) {
            i++;
            continue;
        } else {
            const fret_real v = lo / x;
            const fret_edge all = fret_edge_moments(t->rule, v),
                            beyond = fret_edge_moments(t->rule, ((begin - b->end) + e) / x);
            for (int j = 0; j < 3; j++)
                moment[j] = all.moment[j] - beyond.moment[j];
            fret_table_slope(t->table, b->first, c);
            sum += near_sum(c, v, x, moment);
        }
        i = b->next;
    }
    const fret_real v = ((begin - radius_of(t, last)) + e) / x;
    const fret_edge all = fret_edge_moments(t->rule, v);
    fret_table_slope(t->table, last, c);
    return sum + near_sum(c, v, x, all.moment);
}

fret_real fret_transform_jump(const fret_transform *t, size_t row, fret_real e) {
    const fret_real x = radius_of(t, row) + e, v = e / x;
    fret_real c[3];
    const fret_edge all = fret_edge_moments(t->rule, v);
    if (row > fret_table_row(t->table, 0))
        fret_table_jump(t->table, row, c);
    else
        fret_table_slope(t->table, row, c);
    return near_sum(c, v, x, all.moment);
}
