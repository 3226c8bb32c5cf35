/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Rings from values at Chebyshev's nodes and from rows of a table. Allocates nothing. */
#include "field/ring.h"

#include "number/real.h"

fret_real fret_ring_largest(const fret_real *v) {
    fret_real most = 0;
    for (int i = 0; i < MOST; i++)
        most = fmaxl(most, fabsl(v[i]));
    return most;
}

fret_real fret_ring_fit(const fret_chebyshev *r, const fret_real *value, fret_real whole, fret_real *c,
                        int *count) {
    fret_real term[MOST];
    fret_chebyshev_terms(r, value, term);
    *count = MOST;
    while (*count > 0 && fabsl(term[*count - 1]) <= 1e-20L * whole)
        --*count;
    fret_chebyshev_powers(r, term, *count, c);
    return fmaxl(fabsl(term[MOST - 1]), fabsl(term[MOST - 2])) / whole;
}

fret_real fret_ring_fit_depth(const struct fret_density *d, ring *p, fret_real depth, const fret_real *smooth,
                              const fret_real *sharp) {
    fret_real value[2][MOST], whole[MOST];
    curve *of = &p->of[DEPTH];
    for (int j = 0; j < MOST; j++) {
        const fret_real y = d->rule.node[j],
                        rate = p->width / 2 * fret_pow(p->lo * p->lo + p->width * y, d->m - 1);
        value[0][j] = rate * (depth + y * smooth[j]);
        value[1][j] = rate * sharp[j];
        whole[j] = value[0][j] + y * d->node_q[j] * value[1][j];
    }
    const fret_real deep = fret_ring_largest(whole);
    return fmaxl(fret_ring_fit(&d->rule, value[0], deep, of->c[0], &of->smooth),
                 fret_ring_fit(&d->rule, value[1], deep, of->c[1], &of->kink));
}

void fret_ring_scale(const struct fret_density *d, int kind, ring *p) {
    p->scale[kind] = fret_pow(p->width, kind == SLOPE ? d->m - 1 : -d->m);
}

static void take_slope(const fret_row_part *row, ring *p) {
    curve *of = &p->of[SLOPE];
    of->smooth = row->slopes[0];
    of->kink = row->slopes[1];
    for (int j = 0; j < of->smooth; j++)
        of->c[0][j] = row->S[j];
    for (int j = 0; j < of->kink; j++)
        of->c[1][j] = row->B[j];
}

/* The same of a narrow row: what it is known by times the few powers of x^(k-1) that count. */
static bool multiply_depth(const struct fret_density *d, const fret_row_part *row, bool about, ring *p) {
    enum { FACTORS = 6 };
    static const fret_real narrow = 1e-3L;
    const fret_real bend = p->width / (p->lo * p->lo);
    const int smooth = row->depths[0] + 1, bent = row->depths[1];
    curve *of = &p->of[DEPTH];
    if (!(bend <= narrow) || smooth + FACTORS > MOST + 1 || bent + FACTORS > MOST + 1)
        return false;
    const fret_real power = about ? exp((double)(2 * (d->m - 1)) * log((double)(p->lo / d->reach)))
                                  : fret_pow(p->lo, 2 * (d->m - 1));
    fret_real factor = p->width / 2 * power * (about ? d->reach_power : 1);
    *of = (curve){.smooth = smooth + FACTORS - 1, .kink = bent > 0 ? bent + FACTORS - 1 : 0};
    for (int n = 0; n < FACTORS; n++) {
        of->c[0][n] += factor * row->depth;
        for (int j = 1; j < smooth; j++)
            of->c[0][n + j] += factor * row->P[j - 1];
        for (int j = 0; j < bent; j++)
            of->c[1][n + j] += factor * row->Q[j];
        factor *= bend * (d->m - 1 - n) / (n + 1);
    }
    return true;
}

static void take_depth(const struct fret_density *d, const fret_row_part *row, ring *p) {
    if (multiply_depth(d, row, false, p))
        return;
    fret_real smooth[MOST], sharp[MOST];
    for (int j = 0; j < MOST; j++) {
        const fret_real y = d->rule.node[j];
        smooth[j] = fret_ring_value(row->P, row->depths[0], y);
        sharp[j] = fret_ring_value(row->Q, row->depths[1], y);
    }
    (void)fret_ring_fit_depth(d, p, row->depth, smooth, sharp);
}

bool fret_ring_take_about(const struct fret_density *d, const fret_row_part *row, int kind, ring *out) {
    out->lo = row->inner;
    out->hi = row->outer;
    out->width = row->width;
    if (kind != SLOPE)
        return multiply_depth(d, row, true, out);
    take_slope(row, out);
    return true;
}

void fret_ring_take(const struct fret_density *d, size_t i, int kind, ring *out) {
    const fret_row_part row = fret_rows_part(d->rows, i - d->heads);
    out->lo = row.inner;
    out->hi = row.outer;
    out->width = row.width;
    if (kind == SLOPE)
        take_slope(&row, out);
    else
        take_depth(d, &row, out);
    fret_ring_scale(d, kind, out);
}
