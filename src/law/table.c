/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Sampled gaps: rows to a smooth monotone gap, and its profile in the logarithm of their number. Allocates,
 * and frees what it allocated. */
#include "law/table.h"

#include <stdlib.h>
#include <string.h>

#include "law/check.h"
#include "number/integral.h"
#include "number/real.h"

/* Two numbers in one register. */
typedef double two_numbers __attribute__((vector_size(16)));

/* Cubic Hermite pieces, with Steffen's slopes where none are given: monotone data give a monotone gap, f' is
 * continuous, and the error falls with the third power of the spacing. Per piece f' = d0 + d1 t + d2 t^2, t =
 * r - r_i. */
struct fret_table {
    size_t count, blocks;
    double *r, *f, *d0, *d1, *d2;
    double start; /* it may begin flat */
    bool grows;
    double within;  /* of the largest f: what many rows were thinned by */
    fret_stop stop; /* while it is made */
    struct block *block;
};

/* Pieces far from the edge are summed in blocks, by Taylor's series of the kernel about the middle c of the
 * block: f' and r f'' count through their moments over x = (r-c)/d. A block precedes its two halves. */
enum { TAYLOR = 32, MOMENTS = TAYLOR + 2, EXACT = 9, LEAF = 8 };
typedef struct block {
    size_t first, last, next;               /* pieces; the first block that is no part of this one */
    fret_real c, d;                         /* middle and half-width */
    fret_real slope[MOMENTS], rf2[MOMENTS]; /* int f' x^n dr, int r f'' x^n dr */
} block;

static fret_real f1_of(const struct fret_table *t, size_t i, fret_real x) {
    return t->d0[i] + x * (t->d1[i] + x * t->d2[i]);
}
static fret_real f2_of(const struct fret_table *t, size_t i, fret_real x) {
    return t->d1[i] + 2 * x * t->d2[i];
}

static const fret_real inverse[TAYLOR + 4] = {
    1.0L / 1,  1.0L / 2,  1.0L / 3,  1.0L / 4,  1.0L / 5,  1.0L / 6,  1.0L / 7,  1.0L / 8,  1.0L / 9,
    1.0L / 10, 1.0L / 11, 1.0L / 12, 1.0L / 13, 1.0L / 14, 1.0L / 15, 1.0L / 16, 1.0L / 17, 1.0L / 18,
    1.0L / 19, 1.0L / 20, 1.0L / 21, 1.0L / 22, 1.0L / 23, 1.0L / 24, 1.0L / 25, 1.0L / 26, 1.0L / 27,
    1.0L / 28, 1.0L / 29, 1.0L / 30, 1.0L / 31, 1.0L / 32, 1.0L / 33, 1.0L / 34, 1.0L / 35, 1.0L / 36};

/* The first moments of one piece about its own middle. */
static void piece_moments(const struct fret_table *t, size_t i, int count, block *b) {
    fret_real d = ((fret_real)t->r[i + 1] - t->r[i]) / 2, c = t->r[i] + d;
    fret_real p[3] = {f1_of(t, i, d), d * f2_of(t, i, d), d * d * t->d2[i]}, q1 = 2 * d * t->d2[i];
    fret_real q[3] = {c * f2_of(t, i, d), c * q1 + d * f2_of(t, i, d), d * q1};
    b->c = c;
    b->d = d;
    for (int n = 0; n < count + 2; n++) {
        fret_real even = 2 * d * inverse[n], odd = 2 * d * inverse[n + 1], second = 2 * d * inverse[n + 2];
        b->slope[n] = n % 2 ? p[1] * odd : p[0] * even + p[2] * second;
        if (n < count)
            b->rf2[n] = n % 2 ? q[1] * odd : q[0] * even + q[2] * second;
    }
}

/* What f' and r f'' weigh at places x of a leaf. */
enum { PLACES = LEAF * 2 * 8 };
typedef struct weights {
    int count;
    fret_real x[PLACES], of[2][PLACES];
} weights;

/* A part of a leaf, no wider than half of it, by Gauss's rule: the series of the kernel converges fast. */
static void add_places(weights *w, const block *b, const struct fret_table *t, size_t i, fret_real lo,
                       fret_real h) {
    for (int j = 0; j < 8; j++, w->count++) {
        const fret_real x = lo + h * fret_gauss_node[j], r = t->r[i] + x, width = h * fret_gauss_weight[j];
        w->x[w->count] = (r - b->c) / b->d;
        w->of[0][w->count] = width * f1_of(t, i, x);
        w->of[1][w->count] = width * r * f2_of(t, i, x);
    }
}

/* The first moments; three at a time stay in registers. Leaves the weights of the next ones. */
static void first_moments(weights *w, int which, fret_real *moment) {
    fret_real *of = w->of[which];
    for (int n = 0; n < EXACT; n += 3) {
        fret_real sum[3] = {0, 0, 0};
        for (int j = 0; j < w->count; j++) {
            const fret_real once = of[j] * w->x[j], twice = once * w->x[j];
            sum[0] += of[j];
            sum[1] += once;
            sum[2] += twice;
            of[j] = twice * w->x[j];
        }
        for (int i = 0; i < 3; i++)
            moment[n + i] = sum[i];
    }
}

/* The others, to a double's digits. */
static void last_moments(const weights *w, block *b) {
    two_numbers x[PLACES], of[PLACES];
    for (int j = 0; j < w->count; j++) {
        const double at = (double)w->x[j];
        x[j] = (two_numbers){at, at};
        of[j] = (two_numbers){(double)w->of[0][j], (double)w->of[1][j]};
    }
    for (int n = EXACT; n < MOMENTS; n++) {
        two_numbers even = {0, 0}, odd = {0, 0};
        for (int j = 0; j < w->count; j += 2) {
            even += of[j];
            odd += of[j + 1];
            of[j] *= x[j];
            of[j + 1] *= x[j + 1];
        }
        even += odd;
        b->slope[n] = even[0];
        b->rf2[n] = even[1];
    }
}

static void leaf_moments(const struct fret_table *t, block *b) {
    weights w;
    w.count = 0; /* the rest need not be set */
    for (size_t i = b->first; i < b->last; i++) {
        const fret_real h = (fret_real)t->r[i + 1] - t->r[i];
        const int parts = h > b->d ? 2 : 1;
        for (int j = 0; j < parts; j++)
            add_places(&w, b, t, i, h * j / parts, h / parts);
    }
    first_moments(&w, 0, b->slope);
    first_moments(&w, 1, b->rf2);
    last_moments(&w, b);
}

/* Adds the moments of a half, moved to the middle of the whole: by binomials. */
static void add_moved(block *whole, const block *part) {
    const fret_real shift = (part->c - whole->c) / whole->d, ratio = part->d / whole->d;
    const double step = (double)shift;
    fret_real power = 1, first[2][EXACT];
    two_numbers all[MOMENTS];
    for (int n = 0; n < MOMENTS; n++) {
        const fret_real slope = part->slope[n] * power, rf2 = part->rf2[n] * power;
        if (n < EXACT) {
            first[0][n] = slope;
            first[1][n] = rf2;
        }
        all[n] = (two_numbers){(double)slope, (double)rf2};
        power *= ratio;
    }
    for (int pass = 1; pass < EXACT; pass++)
        for (int n = EXACT - 1; n >= pass; n--)
            for (int i = 0; i < 2; i++)
                first[i][n] += shift * first[i][n - 1];
    for (int pass = 1; pass < MOMENTS; pass++)
        for (int n = MOMENTS - 1; n >= pass; n--)
            all[n] += step * all[n - 1];
    for (int n = 0; n < MOMENTS; n++) {
        whole->slope[n] += n < EXACT ? first[0][n] : all[n][0];
        whole->rf2[n] += n < EXACT ? first[1][n] : all[n][1];
    }
}

static size_t block_count(size_t pieces) {
    return pieces <= LEAF ? 1 : 1 + block_count(pieces / 2) + block_count(pieces - pieces / 2);
}

static bool stopped(const struct fret_table *t) {
    return t->stop && *t->stop;
}

/* Unfinished where it is stopped. */
static const block *make_block(struct fret_table *t, size_t first, size_t last) {
    block *b = &t->block[t->blocks++];
    fret_real lo = t->r[first], hi = t->r[last];
    *b = (block){.first = first, .last = last, .c = (lo + hi) / 2, .d = (hi - lo) / 2};
    if (stopped(t))
        return b;
    if (last - first > LEAF) {
        size_t middle = first + (last - first) / 2;
        add_moved(b, make_block(t, first, middle));
        add_moved(b, make_block(t, middle, last));
    } else {
        leaf_moments(t, b);
    }
    b->next = t->blocks;
    return b;
}

static fret_real sign_of(fret_real x) {
    return x > 0 ? 1 : x < 0 ? -1 : 0;
}

static void steffen_slopes(struct fret_table *t) {
    size_t n = t->count;
    for (size_t i = 0; i < n && !stopped(t); i++) {
        fret_real h1, s1, h2, s2, p;
        if (i > 0 && i + 1 < n) {
            h1 = (fret_real)t->r[i] - t->r[i - 1];
            h2 = (fret_real)t->r[i + 1] - t->r[i];
            s1 = ((fret_real)t->f[i] - t->f[i - 1]) / h1;
            s2 = ((fret_real)t->f[i + 1] - t->f[i]) / h2;
            p = (s1 * h2 + s2 * h1) / (h1 + h2);
            t->d0[i] =
                (double)((sign_of(s1) + sign_of(s2)) * fminl(fminl(fabsl(s1), fabsl(s2)), fabsl(p) / 2));
            continue;
        }
        /* ends: the parabola through the three nearest points, limited to keep the sense of the data */
        size_t a = i ? n - 2 : 0, b = n > 2 ? (i ? n - 3 : 1) : a;
        h1 = (fret_real)t->r[a + 1] - t->r[a];
        h2 = (fret_real)t->r[b + 1] - t->r[b];
        s1 = ((fret_real)t->f[a + 1] - t->f[a]) / h1;
        s2 = ((fret_real)t->f[b + 1] - t->f[b]) / h2;
        p = n > 2 ? s1 + (s1 - s2) * h1 / (h1 + h2) : s1;
        if (p * s1 <= 0)
            p = 0;
        else if (fabsl(p) > 2 * fabsl(s1))
            p = 2 * s1;
        t->d0[i] = (double)p;
    }
}

static void hermite_pieces(struct fret_table *t) {
    for (size_t i = 0; i + 1 < t->count && !stopped(t); i++) {
        fret_real h = (fret_real)t->r[i + 1] - t->r[i], s = ((fret_real)t->f[i + 1] - t->f[i]) / h;
        t->d1[i] = (double)(2 * (3 * s - 2 * (fret_real)t->d0[i] - t->d0[i + 1]) / h);
        t->d2[i] = (double)(3 * ((fret_real)t->d0[i] + t->d0[i + 1] - 2 * s) / (h * h));
    }
}

/* f' + r f'' >= 0 everywhere makes g grow. */
static bool grows(const struct fret_table *t) {
    for (size_t i = 0; i + 1 < t->count && !stopped(t); i++)
        for (int j = 0; j <= 4; j++) {
            double h = t->r[i + 1] - t->r[i], x = h * j / 4;
            if (t->d0[i] + x * (t->d1[i] + x * t->d2[i]) + (t->r[i] + x) * (t->d1[i] + 2 * x * t->d2[i]) < 0)
                return false;
        }
    return true;
}

/* ---- many rows --------------------------------------------------------------------------------- */

enum { MANY = 2000 };

/* Is the cubic between two rows, with their slopes, as close to those between, as a part of the gap there, or
 * of little of the largest? Halfway from row to row, too. */
static bool spans(const struct fret_table *t, size_t i, size_t j, double within, double most) {
    static const double little = 1e-3;
    const fret_real h = (fret_real)t->r[j] - t->r[i], s = ((fret_real)t->f[j] - t->f[i]) / h;
    const double c1 = (double)((3 * s - 2 * (fret_real)t->d0[i] - t->d0[j]) / h),
                 c2 = (double)(((fret_real)t->d0[i] + t->d0[j] - 2 * s) / (h * h));
    for (size_t k = i; k < j; k++)
        for (int half = 0; half < 2; half++) {
            const double x = half * (t->r[k + 1] - t->r[k]) / 2, u = t->r[k] - t->r[i] + x,
                         f = t->f[k] + x * (t->d0[k] + x * (t->d1[k] / 2 + x * t->d2[k] / 3)),
                         cubic = t->f[i] + u * (t->d0[i] + u * (c1 + u * c2));
            if (!(fabs(cubic - f) <= within * fmax(fabs(f), little * most)))
                return false;
        }
    return true;
}

/* The last row that a piece from row i reaches, not beyond `last`: twice as far as long as that does, then by
 * halves. */
static size_t reach_of(const struct fret_table *t, size_t i, size_t last, double within, double most) {
    size_t step = 1;
    while (i + 2 * step <= last && spans(t, i, i + 2 * step, within, most))
        step *= 2;
    size_t near = i + step, far = i + 2 * step < last ? i + 2 * step : last + 1;
    while (far - near > 1) {
        const size_t middle = near + (far - near) / 2;
        *(spans(t, i, middle, within, most) ? &near : &far) = middle;
    }
    return near;
}

/* How many rows are left, which come first: `keep` false leaves all as it is. The flat end stays where it is.
 */
static size_t thin_out(struct fret_table *t, double within, double most, bool keep) {
    size_t left = 1;
    for (size_t i = 0; i + 1 < t->count && !stopped(t); left++) {
        i = reach_of(t, i, t->r[i] < t->start ? fret_table_row(t, 0) : t->count - 1, within, most);
        if (keep) {
            t->r[left] = t->r[i];
            t->f[left] = t->f[i];
            t->d0[left] = t->d0[i];
        }
    }
    return left;
}

/* Fewer rows, within as little of the largest gap as leaves not too many, at most the last of these parts. */
static void thin(struct fret_table *t) {
    static const double parts[] = {1e-14, 1e-13, 1e-12, 1e-11, 1e-10, 1e-9, 1e-8, 1e-7, 1e-6};
    double most = 0;
    int i = 0;
    for (size_t j = 0; j < t->count; j++)
        most = fmax(most, fabs(t->f[j]));
    while (i < 8 && thin_out(t, parts[i], most, false) > MANY)
        i++;
    const size_t left = thin_out(t, parts[i], most, true);
    if (stopped(t))
        return;
    t->count = left;
    t->within = parts[i];
    hermite_pieces(t);
}

fret_status fret_table_make(const double *r, const double *f, size_t count, fret_stop stop,
                            struct fret_table **out) {
    return fret_table_sloped(r, f, NULL, count, stop, out);
}

/* slope NULL: Steffen's. */
fret_status fret_table_sloped(const double *r, const double *f, const double *slope, size_t count,
                              fret_stop stop, struct fret_table **out) {
    for (size_t i = 0; i < count; i++) {
        if (slope && !isfinite(slope[i]))
            return fret_fail(FRET_NOT_FINITE, "slope", slope[i], 0);
        if (!isfinite(r[i]) || !isfinite(f[i]))
            return fret_fail(FRET_NOT_FINITE, isfinite(r[i]) ? "f" : "r", isfinite(r[i]) ? f[i] : r[i], 0);
        if (i == 0 ? r[0] != 0 || f[0] != 0 : r[i] <= r[i - 1])
            return fret_fail(FRET_BAD_TABLE, "r", r[i], i ? r[i - 1] : 0);
    }
    if (count < 2)
        return fret_fail(FRET_BAD_TABLE, "r", count ? r[0] : 0, 0);
    struct fret_table *t = calloc(1, sizeof *t);
    double *data = t ? malloc(5 * count * sizeof *data) : NULL;
    block *blocks = data ? malloc(block_count(count - 1) * sizeof *blocks) : NULL;
    if (!blocks) {
        free(data);
        free(t);
        return fret_fail(FRET_NO_MEMORY, NULL, 0, 0);
    }
    *t = (struct fret_table){.count = count,
                             .r = data,
                             .f = data + count,
                             .d0 = data + 2 * count,
                             .d1 = data + 3 * count,
                             .d2 = data + 4 * count,
                             .block = blocks,
                             .stop = stop};
    memcpy(t->r, r, count * sizeof *r);
    memcpy(t->f, f, count * sizeof *f);
    if (slope)
        memcpy(t->d0, slope, count * sizeof *slope);
    else
        steffen_slopes(t);
    for (size_t i = 1; i + 1 < count && f[i] == 0; i++)
        t->start = r[i];
    hermite_pieces(t);
    if (count > MANY + 1)
        thin(t);
    make_block(t, 0, t->count - 1);
    t->grows = grows(t);
    if (stopped(t)) {
        fret_table_free(t);
        return fret_fail(FRET_INTERRUPTED, NULL, 0, 0);
    }
    t->stop = NULL;
    *out = t;
    return fret_ok();
}

void fret_table_free(struct fret_table *t) {
    if (t) {
        free(t->block);
        free(t->r);
    }
    free(t);
}

/* The piece that holds r. */
static size_t table_piece(const struct fret_table *t, fret_real r) {
    size_t lo = 0, hi = t->count - 1;
    while (hi - lo > 1) {
        size_t mid = (lo + hi) / 2;
        if (t->r[mid] <= r)
            lo = mid;
        else
            hi = mid;
    }
    return lo;
}

fret_real fret_table_f(const struct fret_table *t, fret_real r) {
    size_t i = table_piece(t, r);
    fret_real x = r - t->r[i];
    return t->f[i] + x * (t->d0[i] + x * (t->d1[i] / 2 + x * t->d2[i] / 3));
}

double fret_table_within(const struct fret_table *t) {
    return t->within;
}

size_t fret_table_count(const struct fret_table *t) {
    return t->count;
}

fret_real fret_table_start(const struct fret_table *t) {
    return t->start;
}

fret_real fret_table_end(const struct fret_table *t) {
    return t->r[t->count - 1];
}

size_t fret_table_rows(const struct fret_table *t, fret_real r) {
    return r < fret_table_end(t) ? table_piece(t, r) + 1 : t->count;
}

bool fret_table_pointed(const struct fret_table *t) {
    return t->d0[0] > 0;
}

bool fret_table_tip(const struct fret_table *t, fret_real r, fret_real factor[3]) {
    if (t->start > 0 || r > t->r[1])
        return false;
    factor[0] = t->d0[0];
    factor[1] = t->d1[0] / 2;
    factor[2] = t->d2[0] / 3;
    return true;
}

bool fret_table_grows(const struct fret_table *t) {
    return t->grows;
}

/* int f' K, int r^2 f' K and int r f'' K over a part of the contact, in units of its radius. */
typedef struct sums {
    fret_real g, I, s;
} sums;

static int terms_of(fret_real half, fret_real away) {
    if (!(4 * half <= away))
        return 0;
    const double ratio = (double)(half / away);
    int count = 1;
    for (double left = 1e21 * ratio; left > 1 && count < TAYLOR; left *= ratio)
        count++;
    return count;
}

/* Moments of f' z^j, j = 0..2, times the kernel ((a-r)(a+r)/D)^alpha over a block, D its value at the middle,
 * and of r f''. Terms fall at least by 4: of those after the first few a double keeps all digits that count.
 */
typedef struct far_sums {
    fret_real slope[3], rf2;
} far_sums;

static far_sums sum_far(const block *b, int count, fret_real alpha, fret_real D) {
    enum { LEADING = 7 };
    const fret_real per = b->d / D, x1 = 2 * b->c * per, x2 = b->d * per;
    const int leading = count < LEADING ? count : LEADING;
    fret_real q = 1, old = 0;
    far_sums out = {{0, 0, 0}, 0};
    for (int n = 0; n < leading; n++) {
        for (int j = 0; j < 3; j++)
            out.slope[j] += q * b->slope[n + j];
        out.rf2 += q * b->rf2[n];
        const fret_real next =
            x1 * ((n - alpha) * inverse[n]) * q + x2 * ((n - 1 - 2 * alpha) * inverse[n]) * old;
        old = q;
        q = next;
    }
    if (count > leading) {
        const double y1 = (double)x1, y2 = (double)x2, z1 = (double)alpha, z2 = 2 * z1 + 1;
        double p = (double)q, last = (double)old, s0 = 0, s1 = 0, s2 = 0, r = 0;
        double m0 = (double)b->slope[LEADING], m1 = (double)b->slope[LEADING + 1];
        for (int n = LEADING; n < count; n++) {
            const double m2 = (double)b->slope[n + 2], part = (double)inverse[n];
            s0 += p * m0;
            s1 += p * m1;
            s2 += p * m2;
            r += p * (double)b->rf2[n];
            const double next = y1 * ((n - z1) * part) * p + y2 * ((n - z2) * part) * last;
            last = p;
            p = next;
            m0 = m1;
            m1 = m2;
        }
        out.slope[0] += s0;
        out.slope[1] += s1;
        out.slope[2] += s2;
        out.rf2 += r;
    }
    return out;
}

/* u: distance of the middle from the edge. */
static void add_far(sums *all, const block *b, int count, fret_real alpha, fret_real a, fret_real u) {
    const fret_real D = u * (a + b->c);
    const far_sums of = sum_far(b, count, alpha, D);
    fret_real K = fret_pow(D / (a * a), alpha) / a, c = b->c / a, d = b->d / a;
    all->g += K * of.slope[0];
    all->I += K * (c * c * of.slope[0] + 2 * c * d * of.slope[1] + d * d * of.slope[2]);
    all->s += K * of.rf2;
}

/* A piece near the edge or at it: the kernel's moments between its ends, lo and hi. */
static void add_near(sums *all, const struct fret_table *t, size_t i, fret_real a, fret_real v,
                     const fret_edge *lo, const fret_edge *hi) {
    fret_real d1 = t->d1[i] * a, d2 = t->d2[i] * a * a, m[FRET_EDGE];
    for (int j = 0; j < FRET_EDGE; j++)
        m[j] = lo->moment[j] - hi->moment[j];
    /* f' and r f'' in powers of the distance from the edge; v: that of the piece's start */
    fret_real p[3] = {t->d0[i] + v * (d1 + v * d2), -(d1 + 2 * v * d2), d2};
    for (int j = 0; j < 3; j++) {
        all->g += p[j] * m[j];
        all->I += p[j] * (m[j] - 2 * m[j + 1] + m[j + 2]);
    }
    all->s += -p[1] * (m[0] - m[1]) - 2 * p[2] * (m[1] - m[2]);
}

fret_profile fret_table_profile(const struct fret_table *t, const fret_rule *rule, fret_real e) {
    fret_real k = rule->k, alpha = (k - 1) / 2, start = t->start, a = start + e;
    sums all = {0, 0, 0};
    for (size_t i = 0; i < t->blocks;) {
        const block *b = &t->block[i];
        fret_real middle = (start - b->c) + e;
        bool leaf = b->next == i + 1;
        int terms = terms_of(b->d, middle);
        i = leaf || terms || middle <= -b->d ? b->next : i + 1;
        if (terms)
            add_far(&all, b, terms, alpha, a, middle);
        if (terms || !leaf)
            continue;
        fret_edge lo, hi = {{0}, 0};
        bool known = false; /* hi, at the start of this piece */
        for (size_t j = b->first; j < b->last && (start - t->r[j]) + e > 0; j++) {
            block piece;
            piece.d = ((fret_real)t->r[j + 1] - t->r[j]) / 2;
            middle = (start - (t->r[j] + piece.d)) + e;
            terms = terms_of(piece.d, middle);
            if (terms) {
                piece_moments(t, j, terms, &piece);
                add_far(&all, &piece, terms, alpha, a, middle);
                known = false;
                continue;
            }
            fret_real v = ((start - t->r[j]) + e) / a;
            lo = known ? hi : fret_edge_moments(rule, v);
            hi = fret_edge_moments(rule, ((start - t->r[j + 1]) + e) / a);
            known = true;
            add_near(&all, t, j, a, v, &lo, &hi);
        }
    }
    return fret_profile_of(k, a, all.g, all.g + all.s, all.I);
}

fret_real fret_table_distance(const struct fret_table *t, size_t row) {
    return (fret_real)t->r[row] - t->start;
}

size_t fret_table_row(const struct fret_table *t, fret_real e) {
    size_t i = table_piece(t, fmaxl(t->start + e, 0));
    while (i > 0 && fret_table_distance(t, i) > e)
        i--;
    return i;
}

void fret_table_slope(const struct fret_table *t, size_t row, fret_real c[3]) {
    c[0] = t->d0[row];
    c[1] = t->d1[row];
    c[2] = t->d2[row];
}

void fret_table_jump(const struct fret_table *t, size_t row, fret_real c[3]) {
    const fret_real h = (fret_real)t->r[row] - t->r[row - 1];
    c[0] = 0;
    c[1] = t->d1[row] - (t->d1[row - 1] + 2 * h * t->d2[row - 1]);
    c[2] = (fret_real)t->d2[row] - t->d2[row - 1];
}
