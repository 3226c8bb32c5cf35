/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Integrals of the profile against (x^2-r^2)^(m-1) and (r^2-x^2)^-m: in s = x^2 these are powers of a
 * distance, so polynomials in s have closed forms near r, and Taylor's series of the kernel serves for what
 * is far, in blocks. Allocates, and frees what it allocated. */
#include "contact/density.h"

#include <float.h>
#include <stdlib.h>

#include "contact/check.h"
#include "contact/rows.h"
#include "number/array.h"
#include "number/chebyshev.h"
#include "number/double.h"
#include "number/real.h"

/* ---- powers against the kernels ---------------------------------------------------------------- */

enum { MOST = FRET_CHEBYSHEV, SERIES = 120 };

/* y^q times the powers y^j, y in 0..1, with what their integrals need of q and m. */
typedef struct powers {
    fret_real q;
    int of_m, whole;              /* q = of_m m + whole */
    fret_real over[MOST + 1];     /* 1/(q+j+1) */
    fret_real with[MOST + 1];     /* 1/(q+j+1+m) */
    fret_real edge[SERIES];       /* ratios of terms: (n-q)/(m+1+n) */
    fret_real below[SERIES];      /* (1-m+n)/(q+2+n) */
    fret_real top[SERIES];        /* the same with q+MOST for q */
    fret_real span[SERIES];       /* 1/(q+m-n) */
    fret_real twice;              /* 2^(q+m) */
    fret_real from_one, from_nil; /* int_1^2 t^q (t-1)^(m-1) dt, int_0^2 t^q (t+1)^(m-1) dt */
    fret_real whole_beta;         /* int_0^1 t^(q+MOST) (1-t)^-m dt */
} powers;

/* 1 + r0 z + r0 r1 z^2 + ... */
static fret_real series(const fret_real *ratio, fret_real z) {
    fret_real sum = 1, term = 1;
    for (int n = 0; n < SERIES; n++) {
        term *= ratio[n] * z;
        sum += term;
        if (fabsl(term) < LDBL_EPSILON / 8 * sum)
            break;
    }
    return sum;
}

static void make_power(powers *p, int of_m, int whole, fret_real m) {
    const fret_real q = of_m * m + whole;
    *p = (powers){.q = q, .of_m = of_m, .whole = whole};
    for (int j = 0; j <= MOST; j++) {
        p->over[j] = 1 / (q + j + 1);
        p->with[j] = 1 / (q + j + 1 + m);
    }
    for (int n = 0; n < SERIES; n++) {
        p->edge[n] = (n - q) / (m + 1 + n);
        p->below[n] = (1 - m + n) / (q + 2 + n);
        p->top[n] = (1 - m + n) / (q + MOST + 2 + n);
        p->span[n] = 1 / (q + m - n);
    }
    p->twice = fret_pow(2, q + m);
    p->from_one = fret_pow(2, q) / m * series(p->edge, 0.5L);
    p->from_nil = fret_pow(2, q + 1) * fret_pow(3, m - 1) * p->over[0] * series(p->below, 2 / 3.0L);
    p->whole_beta = fret_beta(q + MOST + 1, 1 - m);
}

/* What integrals from d to x, or up to x, have in common, whatever q is: d >= 0 the distance of r, rest that
 * of x from r; what takes time, where it is wanted. */
typedef struct reach {
    fret_real m, d, x, rest;
    fret_real rim, x_m, d_m, span; /* rest^m or rest^(1-m), x^m, d^m, ln(x/2d) */
} reach;

static fret_real to_q(const powers *p, fret_real x, fret_real x_m) {
    const fret_real v = p->of_m ? x_m : 1;
    return p->whole == 0 ? v : p->whole > 0 ? v * x : v / x;
}

/* int_(2d)^x y^q (y-sign d)^(m-1) dy, 2d < x: the kernel in powers of d/y. */
static fret_real far_part(const powers *p, const reach *c, fret_real sign, fret_real d_power) {
    const fret_real t = p->q + c->m, u = c->d / c->x, step = sign * u, half = sign / 2;
    fret_real outer = to_q(p, c->x, c->x_m) * c->x_m, inner = p->twice * d_power, sum = 0, b = 1;
    const fret_real enough = LDBL_EPSILON / 8 * (outer + inner);
    for (int n = 0; n < SERIES && b * (fabsl(outer) + fabsl(inner)) > enough; n++) {
        const fret_real power = t - n;
        sum += b * (fabsl(power) * c->span < 0.5L
                        ? inner * (power != 0 ? fret_expm1(power * c->span) / power : c->span)
                        : (outer - inner) * p->span[n]);
        b *= (1 - c->m + n) / (1 + n);
        outer *= step;
        inner *= half;
    }
    return sum;
}

/* I[j] = int y^(q+j) (y-d)^(m-1) dy from d to x. */
static void above(const powers *p, const reach *c, int count, fret_real *I) {
    fret_real xq = to_q(p, c->x, c->x_m);
    if (2 * c->d < c->x) {
        const fret_real d_power = to_q(p, c->d, c->d_m) * c->d_m;
        I[0] = p->from_one * d_power + far_part(p, c, 1, d_power);
    } else {
        I[0] = c->rim * xq / c->m * series(p->edge, c->rest / c->x);
    }
    for (int j = 0; j + 1 < count; j++) {
        xq *= c->x;
        I[j + 1] = (xq * c->rim + (p->q + (j + 1)) * c->d * I[j]) * p->with[j];
    }
}

/* The same from 0 to x with y+d for y-d. */
static void below(const powers *p, const reach *c, int count, fret_real *I) {
    const fret_real d = c->d, x = c->x;
    fret_real xq = to_q(p, x, c->x_m);
    if (d < x) {
        if (d <= 0) {
            I[0] = xq * c->rim / (p->q + c->m);
        } else if (2 * d < x) {
            const fret_real d_power = to_q(p, d, c->d_m) * c->d_m;
            I[0] = p->from_nil * d_power + far_part(p, c, -1, d_power);
        } else {
            I[0] = x * xq * c->rim / c->rest * p->over[0] * series(p->below, x / c->rest);
        }
        for (int j = 0; j + 1 < count; j++) {
            xq *= x;
            I[j + 1] = (xq * c->rim - (p->q + (j + 1)) * d * I[j]) * p->with[j];
        }
        return;
    }
    /* downwards from the last, which is small */
    fret_real edge[MOST + 1];
    const fret_real down = 1 / d;
    for (int j = 0; j <= MOST; j++) {
        xq *= x;
        edge[j] = xq * c->rim;
    }
    fret_real now = edge[MOST] / c->rest * p->over[MOST] * series(p->top, x / c->rest);
    for (int j = MOST; j-- > 0;) {
        now = (edge[j] - now * (p->q + (j + 1) + c->m)) * p->over[j] * down;
        if (j < count)
            I[j] = now;
    }
}

/* I[j] = int_0^x y^(q+j) (d-y)^-m dy, d >= x. */
static void beyond(const powers *p, const reach *c, int count, fret_real *I) {
    static const fret_real near = 0.4L;
    const fret_real q = p->q + MOST, m = c->m, out = c->rest / c->d, down = 1 / c->d;
    fret_real edge[MOST], xq = to_q(p, c->x, c->x_m), sum = 0, term = 1, now;
    for (int j = 0; j < MOST; j++) {
        xq *= c->x;
        edge[j] = xq * c->rim;
    }
    if (out > near) {
        const fret_real z = c->x / c->d;
        for (int n = 0; n < SERIES && term > LDBL_EPSILON / 8 * (1 - z); n++) {
            sum += term / (q + 1 + n);
            term *= z * (m + n) / (1 + n);
        }
        now = xq * c->x * sum / c->d_m;
    } else {
        for (int n = 0; n < SERIES && fabsl(term) > LDBL_EPSILON / 8; n++) {
            sum += term / (1 - m + n);
            term *= out * (n - q) / (1 + n);
        }
        fret_real whole = p->whole_beta * to_q(p, c->d, c->d_m) * c->d / c->d_m;
        for (int j = 0; j < MOST; j++)
            whole *= c->d;
        /* out^(1-m) d^(q+1-m) = rest^(1-m) d^q */
        fret_real part = c->rim * sum * to_q(p, c->d, c->d_m);
        for (int j = 0; j < MOST; j++)
            part *= c->d;
        now = whole - part;
    }
    for (int j = MOST; j-- > 0;) {
        now = ((p->q + (j + 2) - m) * now + edge[j]) * p->over[j] * down;
        if (j < count)
            I[j] = now;
    }
}

/* ---- rings and blocks ---------------------------------------------------------------------- */

/* s = lo^2 + width y. What varies is smooth + y^q kink, polynomials in y. */
typedef struct curve {
    int smooth, kink; /* terms */
    fret_real c[2][MOST];
} curve;

enum { SLOPE, DEPTH, KINDS };

typedef struct ring {
    fret_real lo, hi, width;
    curve of[KINDS];        /* g' dx/dy, and with q+1 x^k g dx/dy */
    fret_real scale[KINDS]; /* width^(m-1), width^-m */
} ring;

/* Stretches first .. last-1 from afar: the moments of the kernel's series about the middle. A block precedes
 * its two halves, unless it is a leaf. */
enum { TAYLOR = 56 };
typedef struct block {
    size_t first, last, next;
    fret_real lo, hi, half;
    double moment[KINDS][TAYLOR];
} block;

enum { OF_ONE, OF_SLOPE, OF_DEPTH, POWERS };

/* Those of a table are made of its rows, when they are wanted where they are many. */
struct fret_density {
    fret_real m, from, from_depth, unit, error;
    powers power[POWERS]; /* q = 0, that of the slope, and of the depth */
    double far_scale[KINDS];
    size_t count, kept, room, blocks, leaf; /* rings, those kept; how many a leaf has */
    size_t heads;                           /* rings before the rows */
    ring *ring;
    block *block;
    struct fret_rows *rows; /* or NULL */
    fret_chebyshev rule;    /* of y */
    fret_real node_q[MOST]; /* y^q of the slope at its nodes */
};

/* The distance of squares, with all digits. */
static fret_real square_distance(fret_real x, fret_real y) {
    return (x - y) * (x + y);
}

static fret_real sum_of(const curve *c, const fret_real *smooth, const fret_real *kink) {
    fret_real sum = 0;
    for (int j = 0; j < c->smooth; j++)
        sum += c->c[0][j] * smooth[j];
    for (int j = 0; j < c->kink; j++)
        sum += c->c[1][j] * kink[j];
    return sum;
}

/* ---- rings from values and from rows -------------------------------------------------------- */

static fret_real largest(const fret_real *v) {
    fret_real most = 0;
    for (int i = 0; i < MOST; i++)
        most = fmaxl(most, fabsl(v[i]));
    return most;
}

/* Powers of y through values at the nodes. Returns how large the last terms are, of the whole. */
static fret_real fit(const fret_chebyshev *r, const fret_real *value, fret_real whole, fret_real *c,
                     int *count) {
    fret_real term[MOST];
    fret_chebyshev_terms(r, value, term);
    *count = MOST;
    while (*count > 0 && fabsl(term[*count - 1]) <= 1e-20L * whole)
        --*count;
    fret_chebyshev_powers(r, term, *count, c);
    return whole > 0 ? fmaxl(fabsl(term[MOST - 1]), fabsl(term[MOST - 2])) / whole : 0;
}

static fret_real value_of(const fret_real *c, int count, fret_real y) {
    fret_real v = 0;
    while (count-- > 0)
        v = v * y + c[count];
    return v;
}

/* What is left of the last terms of x^k g dx/dy, from rises over y of g, smooth and of the kink. */
static fret_real fit_depth(const struct fret_density *d, ring *p, fret_real depth, const fret_real *smooth,
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
    const fret_real deep = largest(whole);
    return fmaxl(fit(&d->rule, value[0], deep, of->c[0], &of->smooth),
                 fit(&d->rule, value[1], deep, of->c[1], &of->kink));
}

static void scale_ring(const struct fret_density *d, int kind, ring *p) {
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
static bool multiply_depth(const struct fret_density *d, const fret_row_part *row, ring *p) {
    enum { FACTORS = 6 };
    static const fret_real narrow = 1e-3L;
    const fret_real bend = p->width / (p->lo * p->lo);
    const int smooth = row->depths[0] + 1, bent = row->depths[1];
    curve *of = &p->of[DEPTH];
    if (!(bend <= narrow) || smooth + FACTORS > MOST + 1 || bent + FACTORS > MOST + 1)
        return false;
    fret_real factor = p->width / 2 * fret_pow(p->lo, 2 * (d->m - 1));
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
    if (multiply_depth(d, row, p))
        return;
    fret_real smooth[MOST], sharp[MOST];
    for (int j = 0; j < MOST; j++) {
        const fret_real y = d->rule.node[j];
        smooth[j] = value_of(row->P, row->depths[0], y);
        sharp[j] = value_of(row->Q, row->depths[1], y);
    }
    (void)fit_depth(d, p, row->depth, smooth, sharp);
}

static void take_row(const struct fret_density *d, size_t i, int kind, ring *out) {
    const fret_row_part row = fret_rows_part(d->rows, i - d->heads);
    out->lo = row.inner;
    out->hi = row.outer;
    out->width = row.width;
    if (kind == SLOPE)
        take_slope(&row, out);
    else
        take_depth(d, &row, out);
    scale_ring(d, kind, out);
}

static const ring *ring_at(const struct fret_density *d, size_t i, int kind, ring *room) {
    if (i < d->kept)
        return &d->ring[i];
    take_row(d, i, kind, room);
    return room;
}

/* ---- integrals --------------------------------------------------------------------------------- */

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
    void (*integrals)(const powers *, const reach *, int, fret_real *) = kind == DEPTH ? beyond
                                                                         : at > 0      ? above
                                                                                       : below;
    if (c.x != 1)
        c.x_m = fret_pow(c.x, d->m);
    if (rest != 0)
        c.rim = fret_pow(c.rest, kind == DEPTH ? 1 - d->m : d->m);
    if (c.d > 0 && (kind == DEPTH || 2 * c.d < c.x)) {
        c.d_m = fret_pow(c.d, d->m);
        c.span = kind == DEPTH ? 0 : fret_log(c.x / (2 * c.d));
    }
    fret_real I[2][MOST];
    if (of->smooth)
        integrals(&d->power[OF_ONE], &c, of->smooth, I[0]);
    if (of->kink)
        integrals(kink, &c, of->kink, I[1]);
    return p->scale[kind] * sum_of(of, I[0], I[1]);
}

/* What terms fall to 2^-56 by such a ratio. */
static int terms_of(double ratio) {
    int count = 4;
    for (double left = 0x1p56 * ratio * ratio * ratio * ratio; left > 1 && count < TAYLOR; left *= ratio)
        count++;
    return count;
}

/* Is the block far enough? Its integral. */
static bool far_integral(const struct fret_density *d, const block *b, int kind, fret_real r,
                         fret_real *sum) {
    const fret_real away =
        kind == SLOPE ? square_distance(b->lo, r) + b->half : square_distance(r, b->hi) + b->half;
    if (!(away >= 2 * b->half))
        return false;
    const double ratio = (double)(b->half / away), x2 = ratio * ratio, *c = b->moment[kind];
    const int count = terms_of(ratio) & ~1;
    double even = 0, odd = 0;
    for (int n = count - 2; n >= 0; n -= 2) {
        even = even * x2 + c[n];
        odd = odd * x2 + c[n + 1];
    }
    const double power = kind == SLOPE ? (double)d->m - 1 : -(double)d->m;
    *sum = d->far_scale[kind] * fret_double_exp(power * fret_double_log((double)(away / d->unit))) *
           (even + ratio * odd);
    return true;
}

/* Of one ring by the cuts from `now` on. */
static fret_real near_by_cuts(const struct fret_density *d, size_t i, int kind, const fret_cut *cut,
                              size_t count, size_t now, fret_real r) {
    ring made;
    const ring *p = ring_at(d, i, kind, &made);
    fret_real sum = 0;
    bool more = true;
    if (kind == SLOPE && p->hi <= r)
        return 0;
    for (size_t j = now; j < count && more; j++) {
        more = cut[j].a < p->hi;
        const fret_real weight = cut[j].weight - (more && j + 1 < count ? cut[j + 1].weight : 0);
        if (weight != 0 && cut[j].a > p->lo)
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
                sum += near_by_cuts(d, j, kind, cut, count, now, r);
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

fret_real fret_density_error(const struct fret_density *d) {
    return d->error;
}

fret_real fret_density_from(const struct fret_density *d) {
    return d->from;
}

fret_real fret_density_from_depth(const struct fret_density *d) {
    return d->from_depth;
}

/* ---- making ------------------------------------------------------------------------------------ */

typedef struct maker {
    struct fret_density *d;
    const fret_normal *normal;
    fret_real start, depth;                 /* depth: g at the end of the last ring */
    fret_real moment[POWERS][MOST][TAYLOR]; /* int_0^1 y^(q+j) (2y-1)^n dy */
    double small[POWERS][MOST][TAYLOR];     /* the same */
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
                m->small[p][j][n] = (double)m->moment[p][j][n];
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
    const fret_real got = value_of(of->c[0], of->smooth, look) +
                          (of->kink ? fret_pow(look, q) * value_of(of->c[1], of->kink, look) : 0);
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
    if (!(fit(&d->rule, slope, largest(slope), of->c[sharp], count) <= TOLERANCE))
        return false;
    for (int j = 0; j < MOST; j++)
        rise[0][j] = risen(q, of->c[sharp], *count, d->rule.node[j]);
    if (!(fit_depth(d, p, m->depth, sharp ? none : rise[0], sharp ? rise[0] : none) <= TOLERANCE))
        return false;
    const fret_real error = error_of(m, p, most);
    if (!(error <= FOUND))
        return false;
    d->error = fmaxl(d->error, error);
    scale_ring(d, SLOPE, p);
    scale_ring(d, DEPTH, p);
    m->depth += risen(q, of->c[sharp], *count, 1);
    return true;
}

static bool reserve(maker *m, size_t count) {
    struct fret_density *d = m->d;
    ring *grown = fret_array_for(d->ring, &d->room, count, sizeof *grown);
    if (grown)
        d->ring = grown;
    else
        m->failed = fret_fail(FRET_NO_MEMORY, NULL, 0, 0);
    return grown;
}

/* From the radius lo to hi, in halves where one ring does not do; sharp: from the start of the gap. */
static bool cover(maker *m, fret_real lo, fret_real hi, bool sharp, int halvings) {
    struct fret_density *d = m->d;
    ring p = {.lo = lo, .hi = hi, .width = square_distance(hi, lo)};
    if (fret_stopped(m->normal))
        return false;
    if (make_ring(m, &p, sharp)) {
        if (!reserve(m, d->count + 1))
            return false;
        d->ring[d->count++] = p;
        return true;
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
    m->d->kept = m->d->count;
    return true;
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
    if (count <= KEPT && !reserve(m, d->count + 1))
        return false;
    for (size_t i = d->heads; i < d->count && count <= KEPT; i++) {
        take_row(d, i, SLOPE, &d->ring[i]);
        take_row(d, i, DEPTH, &d->ring[i]);
    }
    d->kept = count <= KEPT ? d->count : d->heads;
    for (size_t i = 0; i < LOOKS; i++) {
        ring made;
        const ring *p =
            ring_at(d, d->heads + (size_t)((double)count * ((double)i + 0.5) / LOOKS), SLOPE, &made);
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
                part[n] += (double)c->c[0][j] * m->small[OF_ONE][j][n];
        for (int j = 0; j < c->kink; j++)
            for (int n = 0; n < SMALL; n++)
                part[n] += (double)c->c[1][j] * m->small[kink][j][n];
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
    const ring *p = ring_at(d, i, SLOPE, room);
    return p == room ? ring_at(d, i, DEPTH, room) : p;
}

static void make_block(maker *m, size_t first, size_t last, fret_real moment[KINDS][TAYLOR]) {
    struct fret_density *d = m->d;
    block *b = &d->block[d->blocks++];
    ring made;
    fret_real part[KINDS][TAYLOR];
    *b = (block){.first = first, .last = last};
    b->lo = ring_at(d, first, SLOPE, &made)->lo;
    b->hi = ring_at(d, last - 1, SLOPE, &made)->hi;
    b->half = square_distance(b->hi, b->lo) / 2;
    for (int n = 0; n < TAYLOR; n++)
        moment[SLOPE][n] = moment[DEPTH][n] = 0;
    if (fret_stopped(m->normal))
        return;
    if (last - first > d->leaf) {
        const size_t middle = first + (last - first) / 2;
        const fret_real between = ring_at(d, middle, SLOPE, &made)->lo;
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

fret_status fret_density_make(const fret_normal *n, fret_real a, struct fret_density **out) {
    struct fret_density *d = calloc(1, sizeof *d);
    maker *m = calloc(1, sizeof *m);
    const bool rows = fret_gap_sampled(&n->gap);
    const fret_real half = (n->foundation.k + 1) / 2;
    fret_status st = fret_ok();
    bool ok = d && m;
    *out = NULL;
    if (!ok)
        st = fret_fail(FRET_NO_MEMORY, NULL, 0, 0);
    if (ok) {
        *d = (struct fret_density){.m = half, .from = fret_gap_start(&n->gap), .unit = a * a};
        *m = (maker){.d = d, .normal = n, .start = d->from};
        const int sharp = fret_gap_sharp(&n->gap);
        make_power(&d->power[OF_ONE], 0, 0, half);
        make_power(&d->power[OF_SLOPE], 1, -sharp, half);
        make_power(&d->power[OF_DEPTH], 1, 1 - sharp, half);
        d->far_scale[SLOPE] = (double)fret_pow(d->unit, half - 1);
        d->far_scale[DEPTH] = (double)fret_pow(d->unit, -half);
        make_rule(m);
        ok = (rows ? cover_rows : cover_smooth)(m, a);
        st = fret_unless_stopped(n, m->failed);
    }
    if (ok && !st.code) {
        fret_real moment[KINDS][TAYLOR];
        d->block = malloc((d->leaf > 1 ? 4 * d->count / d->leaf + 1 : 2 * d->count - 1) * sizeof *d->block);
        if (d->block)
            make_block(m, 0, d->count, moment);
        else
            st = fret_fail(FRET_NO_MEMORY, NULL, 0, 0);
        st = fret_unless_stopped(n, st);
    }
    free(m);
    if (ok && !st.code)
        *out = d;
    else
        fret_density_free(d);
    return st;
}

void fret_density_free(struct fret_density *d) {
    if (d) {
        fret_rows_free(d->rows);
        free(d->block);
        free(d->ring);
    }
    free(d);
}
