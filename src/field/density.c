/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Integrals of the profile against (x^2-r^2)^(m-1) and (r^2-x^2)^-m: closed forms near r, and Taylor's series
 * of the kernel for what is far, in blocks. Reads a density, and changes nothing. */
#include "field/density.h"

#include "field/ring.h"
#include "number/real.h"

static fret_real sum_of(const curve *c, const fret_real *smooth, const fret_real *kink) {
    fret_real sum = 0;
    for (int j = 0; j < c->smooth; j++)
        sum += c->c[0][j] * smooth[j];
    for (int j = 0; j < c->kink; j++)
        sum += c->c[1][j] * kink[j];
    return sum;
}

/* Of one ring up to the radius a. */
static fret_real near_integral(const struct fret_density *d, const ring *p, int kind, fret_real a,
                               fret_real r) {
    const curve *of = &p->of[kind];
    const powers *kink = &d->power[kind == SLOPE ? OF_SLOPE : OF_DEPTH];
    const fret_real at = square_distance(r, p->lo) / p->width, rest = square_distance(a, r) / p->width;
    reach c = {.m = d->m,
               .d = fabsl(at),
               .x = a >= p->hi ? 1 : square_distance(a, p->lo) / p->width,
               .rest = fabsl(rest),
               .x_m = 1,
               .d_m = 1};
    if (kind == SLOPE && rest <= 0)
        return 0;
    void (*integrals)(const powers *, const reach *, int, fret_real *) = kind == DEPTH ? fret_kernel_beyond
                                                                         : at > 0      ? fret_kernel_above
                                                                                       : fret_kernel_below;
    if (c.x != 1)
        c.x_m = expl(d->m * logl(c.x));
    if (rest != 0)
        c.rim = expl((kind == DEPTH ? 1 - d->m : d->m) * logl(c.rest));
    if (c.d > 0 && (kind == DEPTH || 2 * c.d < c.x)) {
        c.d_m = expl(d->m * logl(c.d));
        c.span = kind == DEPTH ? 0 : logl(c.x / (2 * c.d));
    }
    fret_real I[2][MOST];
    if (of->smooth)
        integrals(&d->power[OF_ONE], &c, of->smooth, I[0]);
    if (of->kink)
        integrals(kink, &c, of->kink, I[1]);
    return p->scale[kind] * sum_of(of, I[0], I[1]);
}

/* Is the block far enough? Its integral: so many terms that what is left is 2^-56 of it. */
static bool far_integral(const struct fret_density *d, const block *b, int kind, fret_real r,
                         fret_real *sum) {
    const fret_real away =
        kind == SLOPE ? square_distance(b->lo, r) + b->half : square_distance(r, b->hi) + b->half;
    if (!(away >= 2 * b->half))
        return false;
    const double ratio = (double)(b->half / away), x2 = ratio * ratio, x4 = x2 * x2, *c = b->moment[kind];
    const double log_away = log((double)(away / d->unit));
    double s0 = 0, s1 = 0, s2 = 0, s3 = 0;
    for (int n = (int)(38.8 / (log_away - b->log_half)) & ~3; n >= 0; n -= 4) {
        s0 = s0 * x4 + c[n];
        s1 = s1 * x4 + c[n + 1];
        s2 = s2 * x4 + c[n + 2];
        s3 = s3 * x4 + c[n + 3];
    }
    const double power = kind == SLOPE ? (double)d->m - 1 : -(double)d->m;
    *sum = d->far_scale[kind] * exp(power * log_away) * ((s0 + ratio * s1) + x2 * (s2 + ratio * s3));
    return true;
}

/* The same of one row that is far from r, if it is; its moments are found here. */
static bool far_row(const struct fret_density *d, const fret_row_part *row, int kind, fret_real r,
                    fret_real *sum) {
    const fret_real half = row->width / 2,
                    away = (kind == SLOPE ? square_distance(row->inner, r) : square_distance(r, row->outer)) +
                           half;
    ring made;
    if (!(away >= 2 * half) || !fret_ring_take_about(d, row, kind, &made))
        return false;
    const curve *c = &made.of[kind];
    const double(*kinks)[TAYLOR] = d->moment[kind == SLOPE ? OF_SLOPE : OF_DEPTH],
          ratio = (double)(half / away);
    const double log_away = log((double)(away / d->unit));
    const int terms = (int)(38.8 / -log(ratio)) + 1;
    double of[TAYLOR] = {0}, all = 0;
    for (int j = 0; j < c->smooth; j++)
        for (int n = 0; n < terms; n++)
            of[n] += (double)c->c[0][j] * d->moment[OF_ONE][j][n];
    for (int j = 0; j < c->kink; j++)
        for (int n = 0; n < terms; n++)
            of[n] += (double)c->c[1][j] * kinks[j][n];
    for (int n = terms; n-- > 0;)
        all = all * ratio + of[n] * d->binomial[kind][n];
    const double power = kind == SLOPE ? (double)d->m - 1 : -(double)d->m;
    *sum = d->far_scale[kind] * exp(power * log_away) * all;
    return true;
}

/* Of one row by the cuts from `now` on: within one of them, and far from r? */
static bool far_by_cuts(const struct fret_density *d, size_t i, int kind, const fret_cut *cut, size_t count,
                        size_t now, fret_real r, fret_real *sum) {
    const fret_row_part row = fret_rows_part(d->rows, i - d->heads);
    *sum = 0;
    if (kind == SLOPE && row.outer <= r)
        return true;
    while (now < count && cut[now].a <= row.inner)
        now++;
    if (now < count && (cut[now].a < row.outer || !far_row(d, &row, kind, r, sum)))
        return false;
    *sum *= now < count ? cut[now].weight : 0;
    return true;
}

/* Of one ring by the cuts from `now` on. */
static fret_real near_by_cuts(const struct fret_density *d, const block *b, size_t i, int kind,
                              const fret_cut *cut, size_t count, size_t now, fret_real r) {
    ring made;
    fret_real whole;
    if (i >= d->kept && far_by_cuts(d, i, kind, cut, count, now, r, &whole))
        return whole;
    const ring *p = fret_ring_at(d, i, kind, &made);
    fret_real sum = 0, far;
    bool more = true;
    if (kind == SLOPE && p->hi <= r)
        return 0;
    for (size_t j = now; j < count && more; j++) {
        more = cut[j].a < p->hi;
        const fret_real weight = cut[j].weight - (more && j + 1 < count ? cut[j + 1].weight : 0);
        if (weight == 0 || cut[j].a <= p->lo)
            continue;
        if (!more && b->last - b->first == 1 && far_integral(d, b, kind, r, &far))
            sum += weight * far;
        else
            sum += weight * near_integral(d, p, kind, fminl(cut[j].a, p->hi), r);
    }
    return sum;
}

static fret_real integral(const struct fret_density *d, int kind, const fret_cut *cut, size_t count,
                          fret_real r) {
    fret_real sum = 0, far;
    size_t now = 0; /* the cut that ends the part which holds the start of a block */
    for (size_t i = 0; i < d->blocks;) {
        const block *b = &d->block[i];
        if (kind == SLOPE && b->hi <= r) {
            i = b->next;
            continue;
        }
        while (now < count && cut[now].a <= b->lo)
            now++;
        if (now == count)
            break;
        if (b->hi <= cut[now].a && far_integral(d, b, kind, r, &far)) {
            sum += cut[now].weight * far;
            i = b->next;
            continue;
        }
        if (b->next == ++i)
            for (size_t j = b->first; j < b->last; j++)
                sum += near_by_cuts(d, b, j, kind, cut, count, now, r);
    }
    return sum;
}

fret_real fret_density_pressure(const struct fret_density *d, const fret_cut *cut, size_t count,
                                fret_real r) {
    return integral(d, SLOPE, cut, count, r);
}

fret_real fret_density_surface(const struct fret_density *d, const fret_cut *cut, size_t count, fret_real r) {
    return integral(d, DEPTH, cut, count, r);
}

fret_real fret_density_flat(const struct fret_density *d, fret_real a, fret_real r) {
    return fret_kernel_flat(&d->flat, a, r);
}

fret_real fret_density_error(const struct fret_density *d) {
    return d->error;
}

fret_real fret_density_from(const struct fret_density *d) {
    return d->from;
}

fret_real fret_density_from_depth(const struct fret_density *d) {
    return d->from_depth;
}
