/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Row by row: depth and load above the beginning of a row as polynomials, and what its kink adds; of every
 * row its integrals, and of runs of rows. Allocates them, and frees them. */
#include "contact/rows.h"

#include <float.h>
#include <stdlib.h>

#include "contact/check.h"
#include "contact/leaves.h"
#include "contact/table.h"
#include "number/array.h"
#include "number/chebyshev.h"
#include "number/powers.h"
#include "number/quadrature.h"
#include "number/real.h"

/* Within a row y = 0..1 is linear in the square of the radius x. Depth and load are smooth there but for the
 * kink where the row begins: they rise by y (P(y) + y^m Q(y)), m = (k+1)/2, with polynomials P and Q. A part
 * is a row, or as much of it as is no longer than it is far from the kink before: there 20 nodes do, and
 * fewer where rows bend little. Of what lies below y, G = y^2 (P + y^m Q) and L = y^3 (P + y^m Q + y^2m R),
 * and dF/dy rises by y P. */
enum { WAVES = FRET_CHEBYSHEV, RULES = 4, BINOMIALS = 12 };
static const int nodes_of[RULES] = {8, 12, 16, WAVES};

/* Polynomials of the integrals. */
enum { SUM_K, SUM_G, SUM_L = SUM_G + 2, SUMS = SUM_L + 3 };

typedef struct part {
    fret_real x, width, rate;  /* radius of its inner end; its length in x^2; dK/dy at the inner end */
    size_t term;               /* P and Q of the depth, then of the load, then those of `sum` */
    unsigned char count[2][2]; /* how many */
    unsigned char sum[SUMS];
} part;

struct fret_rows {
    fret_real start, m, C;
    size_t count, room, terms, most_terms;
    part *part;
    fret_real *term;
    fret_real *reach[3];           /* where each part begins, and the last one ends: distance, depth, load */
    stretch *run[RUNS];            /* as those of pieces */
    fret_real binomial[BINOMIALS]; /* of (1+z)^(m-1) */
    fret_powers powers;            /* with m */
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
    return y > 0 ? fret_power_of(&all->powers, y) : 0;
}

/* (1+z)^(m-1) */
static fret_real near_one(const struct fret_rows *all, fret_real z) {
    if (fabsl(z) > 0.02L)
        return fret_exp((all->m - 1) * fret_log1p(z));
    return sum_of(all->binomial, fabsl(z) < 1e-3L ? 7 : BINOMIALS, z);
}

/* y^m from that of a place near by. */
static fret_real to_m_near(const struct fret_rows *all, fret_real at, fret_real power, fret_real y) {
    const fret_real z = (y - at) / at;
    return fabsl(z) > 1e-3L ? to_m(all, y) : power * (1 + z) * near_one(all, z);
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

/* From y inwards to the beginning of the part. */
static stretch part_below(const struct fret_rows *all, size_t i, fret_real y, fret_real ym, fret_real rise) {
    const part *p = &all->part[i];
    const fret_real *c = all->term + p->term;
    fret_real of[SUMS];
    c += p->count[DEPTHS][0] + p->count[DEPTHS][1] + p->count[LOADS][0] + p->count[LOADS][1];
    for (int j = 0; j < SUMS; j++) {
        of[j] = sum_of(c, p->sum[j], y);
        c += p->sum[j];
    }
    const fret_real y2 = y * y;
    return (stretch){rise, y * of[SUM_K], y2 * (of[SUM_G] + ym * of[SUM_G + 1]),
                     y2 * y * (of[SUM_L] + ym * (of[SUM_L + 1] + ym * of[SUM_L + 2]))};
}

/* From y inwards to another one, thin ones too: in third roots, in which the kink is smooth enough, or far
 * from it as it is. */
static stretch part_of(const struct fret_rows *all, size_t i, fret_real from, fret_real power, fret_real to) {
    const part *p = &all->part[i];
    const bool far = to > from / 2;
    const int parts = (far ? 1 : 2) * (is_wide(p) ? 2 : 1);
    const fret_real s0 = far ? from : fret_exp(fret_log(from) / 3),
                    way = (far ? to : fret_exp(fret_log(to) / 3)) - s0, bend = p->width / (p->x * p->x),
                    edge = rise_of(all, i, DEPTHS, from, power);
    stretch out = {edge - rise_of(all, i, DEPTHS, to, to_m_near(all, from, power, to)), 0, 0, 0};
    for (int j = 0; j < 8 * parts; j++) {
        const fret_real s = s0 + way * ((fret_real)(j / 8) + fret_gauss_node[j % 8]) / (fret_real)parts,
                        y = far ? s : s * s * s,
                        t = edge - rise_of(all, i, DEPTHS, y, to_m_near(all, from, power, y));
        add_node(&out, t,
                 p->rate * near_one(all, bend * y) * (far ? 1 : 3 * s * s) * -way * fret_gauss_weight[j % 8] /
                     (fret_real)parts);
    }
    return out;
}

/* ---- places ------------------------------------------------------------------------------------ */

static const fret_real unknown = (fret_real)NAN;

static fret_spot spot_in(size_t i, fret_real y, fret_real ym) {
    return (fret_spot){i, y, ym, {unknown, unknown}};
}

/* Of a rise its derivative by y, and it itself, about. */
static double rate_of(const struct fret_rows *all, size_t i, int by, double y, double ym, double *rise) {
    const part *p = &all->part[i];
    const fret_real *c = all->term + p->term + (by == LOADS ? p->count[DEPTHS][0] + p->count[DEPTHS][1] : 0);
    double P = 0, Q = 0, P1 = 0, Q1 = 0;
    for (int j = p->count[by][0]; j-- > 0;) {
        P1 = P1 * y + P;
        P = P * y + (double)c[j];
    }
    c += p->count[by][0];
    for (int j = p->count[by][1]; j-- > 0;) {
        Q1 = Q1 * y + Q;
        Q = Q * y + (double)c[j];
    }
    *rise = y * (P + ym * Q);
    return P + y * P1 + ym * ((1 + (double)all->m) * Q + y * Q1);
}

/* Within 1e-9 or so: two of Newton's steps in double, from a straight line on. The derivative is the one of
 * the last of them, a step of so much of y before. */
typedef struct guess {
    double y, rate, step;
} guess;

static guess guess_of(const struct fret_rows *all, size_t i, int by, double target, double whole) {
    const double m = (double)all->m, first = target / whole;
    double y = first, z = 0, ym = (double)to_m(all, y), rate = 0, rise;
    for (int j = 0; j < 2 && y > 0 && y < 1 && fabs(z) < 0.02; j++) {
        const double near = 1 + m * z * (1 + (m - 1) / 2 * z * (1 + (m - 2) / 3 * z * (1 + (m - 3) / 4 * z)));
        rate = rate_of(all, i, by, y, ym * near, &rise);
        const double step = (target - rise) / rate;
        z = step / y;
        y += step;
    }
    return y > 0 && y < 1 ? (guess){y, rate, z} : (guess){first, rate, 1};
}

/* y where a level is so far, `target`, above the beginning of the part, to `little` of it: by Newton's steps,
 * within what the ones before have left. */
static fret_real search(const struct fret_rows *all, size_t i, int by, fret_real target, fret_real little,
                        fret_real *power) {
    const fret_real *reach = all->reach[by == LOADS ? SPOT_LOAD : SPOT_DEPTH] + i;
    const guess from = guess_of(all, i, by, (double)target, (double)(reach[1] - reach[0]));
    fret_real lo = 0, hi = 1, y = from.y;
    double rate = from.rate, off = fabs(from.step), rise; /* off: how far the rate may be, of itself */
    for (int j = 0; j < 80; j++) {
        const fret_real ym = to_m(all, y), miss = target - rise_of(all, i, by, y, ym);
        if (!(rate > 0 && off * fabs((double)miss) <= 1e-20 * rate * (double)y))
            rate = rate_of(all, i, by, (double)y, (double)ym, &rise);
        const fret_real step = miss / rate, share = step / y;
        *(miss > 0 ? &lo : &hi) = y;
        const fret_real next = y + step;
        off = INFINITY;
        if (fabsl(share) <= 1e-9L || fabsl(miss) <= little) {
            *power = fabsl(share) <= 1e-9L ? ym * (1 + share * all->m * (1 + share * (all->m - 1) / 2))
                                           : to_m(all, next);
            return fminl(fmaxl(next, 0), 1);
        }
        y = next > lo && next < hi ? next : (lo + hi) / 2;
    }
    *power = to_m(all, y); /* unreached: halves alone are at the last digit by then */
    return y;              /* unreached: the loop has returned */
}

/* The part that begins before the value and ends at it or beyond; among the first `count`. */
static size_t part_at(const fret_real *reach, size_t count, fret_real value) {
    size_t lo = 0;
    while (count > 1) {
        const size_t half = count / 2;
        lo += reach[lo + half] < value ? half : 0;
        count -= half;
    }
    return lo;
}

bool fret_rows_find(const struct fret_rows *all, fret_spot_by by, fret_real value, fret_spot *out) {
    const fret_real *reach = all->reach[by];
    if (!(value > reach[0] && fret_law_reaches(reach[all->count], value)))
        return false;
    const size_t i = part_at(reach, all->count, value);
    const part *p = &all->part[i];
    const fret_real beyond = value - reach[i],
                    direct = value >= reach[i + 1] ? 1 : fminl(beyond * (2 * p->x + beyond) / p->width, 1);
    const bool known = by == SPOT_DISTANCE || value >= reach[i + 1];
    fret_real ym = 1,
              y = known ? direct
                        : search(all, i, by == SPOT_LOAD ? LOADS : DEPTHS, beyond, LDBL_EPSILON * value, &ym);
    if (known)
        ym = y < 1 ? to_m(all, y) : 1;
    *out = spot_in(i, y, ym);
    if (!known)
        out->rise[by == SPOT_LOAD ? LOADS : DEPTHS] = beyond;
    return true;
}

static fret_spot beginning(size_t i) {
    return (fret_spot){i, 0, 0, {0, 0}};
}

fret_spot fret_rows_inner(void) {
    return beginning(0);
}

fret_spot fret_rows_outer(const struct fret_rows *all) {
    return beginning(all->count);
}

/* Above the beginning of its part. */
static fret_real rise_at(const struct fret_rows *all, int by, const fret_spot *s) {
    return isnan(s->rise[by]) ? rise_of(all, s->part, by, s->along, s->power) : s->rise[by];
}

fret_real fret_rows_level(const struct fret_rows *all, int by, const fret_spot *s) {
    return all->reach[by == LOADS ? SPOT_LOAD : SPOT_DEPTH][s->part] + rise_at(all, by, s);
}

fret_real fret_rows_distance(const struct fret_rows *all, const fret_spot *s) {
    const fret_real inner = all->reach[SPOT_DISTANCE][s->part];
    if (!(s->along > 0))
        return inner;
    const part *p = &all->part[s->part];
    return inner + p->width * s->along / (p->x + sqrtl(p->x * p->x + p->width * s->along));
}

/* Within a part levels are told from its beginning: what is little of the whole is much of it. */
bool fret_rows_drop(const struct fret_rows *all, fret_spot_by by, const fret_spot *outer, fret_real drop,
                    fret_spot *out) {
    const int of = by == SPOT_LOAD ? LOADS : DEPTHS;
    const fret_real *reach = all->reach[by];
    size_t i = outer->part;
    fret_real rise = rise_at(all, of, outer), ym;
    if (drop > rise) {
        drop -= rise;
        if (i == 0 || !(reach[i] - drop >= reach[0]))
            return false;
        const size_t end = i;
        i = part_at(reach, i, reach[i] - drop);
        drop = fmaxl(drop - (reach[end] - reach[i + 1]), 0);
        rise = reach[i + 1] - reach[i];
    }
    if (!(drop < rise)) {
        *out = beginning(i);
        return true;
    }
    const fret_real left = rise - drop, y = search(all, i, of, left, LDBL_EPSILON * left, &ym);
    *out = spot_in(i, y, ym);
    out->rise[of] = left;
    return true;
}

fret_real fret_rows_fall(const struct fret_rows *all, int by, const fret_spot *outer,
                         const fret_spot *inner) {
    const fret_real *reach = all->reach[by == LOADS ? SPOT_LOAD : SPOT_DEPTH];
    return rise_at(all, by, outer) - rise_at(all, by, inner) + (reach[outer->part] - reach[inner->part]);
}

fret_real fret_rows_stiffness(const struct fret_rows *all, const fret_spot *s) {
    if (!(s->along > 0))
        return all->C * fret_pow(all->start + all->reach[SPOT_DISTANCE][s->part], 2 * all->m);
    const part *p = &all->part[s->part];
    return all->C * fret_pow(p->x * p->x + p->width * s->along, all->m);
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

static stretch below_spot(const struct fret_rows *all, const fret_spot *s) {
    return part_below(all, s->part, s->along, s->power, rise_at(all, DEPTHS, s));
}

stretch fret_rows_between(const struct fret_rows *all, const fret_spot *outer, const fret_spot *inner) {
    static const fret_real WORTH = 0.01L; /* of a part, where a difference keeps its digits */
    const size_t next = inner->part + (inner->along > 0);
    stretch sum = {0, 0, 0, 0}, below = sum, rest = sum;
    if (outer->part < inner->part || (outer->part == inner->part && outer->along <= inner->along))
        return sum;
    if (inner->along > 0)
        below = below_spot(all, inner);
    if (outer->along > 0)
        sum = below_spot(all, outer);
    if (outer->part == inner->part && inner->along > 0) {
        const fret_real whole = sum.L;
        sum = fret_stretch_less(&sum, &below);
        return sum.L >= WORTH * whole ? sum
                                      : part_of(all, outer->part, outer->along, outer->power, inner->along);
    }
    fret_stretch_add_runs(all->run, outer->part, next, &sum);
    if (inner->along > 0) {
        const stretch *whole = &all->run[0][inner->part];
        rest = fret_stretch_less(whole, &below);
        if (!(fmaxl(rest.L, sum.L) >= WORTH * whole->L))
            rest = part_of(all, inner->part, 1, 1, inner->along);
        sum = fret_stretch_join(&sum, &rest);
    }
    return sum;
}

/* ---- making ------------------------------------------------------------------------------------ */

/* Nodes in 0..1 and their powers with m. */
typedef struct rule {
    fret_chebyshev of;
    fret_real ym[WAVES];
} rule;

typedef struct maker {
    struct fret_rows *all;
    const fret_normal *normal;
    struct fret_leaves *leaves;
    rule rule[RULES];
    int likely, calm, vain; /* which of them parts want; since a shorter one was tried; wanted more */
    struct beginning {
        fret_real e;
        fret_level at;
    } * begin; /* of each part, and the end of the last one */
    size_t room;
    bool slopes; /* g' dx/dy in place of loads */
    fret_status failed;
} maker;

static void make_rule(rule *r, int nodes, fret_real m) {
    fret_chebyshev_make(&r->of, nodes, true);
    for (int j = 0; j < nodes; j++)
        r->ym[j] = fret_pow(r->of.node[j], m);
}

/* Powers of y, as many as there is something of; *more: the last terms tell that there is more of them. */
static int fit(const rule *r, const fret_real *value, fret_real little, bool *more, fret_real *c) {
    fret_real term[WAVES];
    int count = r->of.count;
    fret_chebyshev_terms(&r->of, value, term);
    *more = *more || fmaxl(fabsl(term[count - 2]), fabsl(term[count - 1])) > 3 * little; /* beyond noise */
    while (count > 0 && fabsl(term[count - 1]) <= little)
        count--;
    fret_chebyshev_powers(&r->of, term, count, c);
    return count;
}

static void make_binomials(struct fret_rows *all) {
    fret_real c = 1;
    for (int j = 0; j < BINOMIALS; j++) {
        all->binomial[j] = c;
        c *= (all->m - 1 - (fret_real)j) / (fret_real)(j + 1);
    }
}

/* For one more part, with what it may have of terms. */
static bool make_room(maker *m) {
    struct fret_rows *all = m->all;
    part *parts = fret_array_for(all->part, &all->room, all->count + 1, sizeof *parts);
    all->part = parts ? parts : all->part;
    fret_real *terms =
        parts ? fret_array_for(all->term, &all->most_terms, all->terms + (4 + SUMS) * WAVES, sizeof *terms)
              : NULL;
    all->term = terms ? terms : all->term;
    struct beginning *begin =
        terms ? fret_array_for(m->begin, &m->room, all->count + 2, sizeof *begin) : NULL;
    m->begin = begin ? begin : m->begin;
    if (!begin)
        m->failed = fret_fail(FRET_NO_MEMORY, NULL, 0, 0);
    return begin;
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

/* ((1+z)^m-1)/(m z), the mean of (1+z)^(m-1) */
static fret_real mean_near_one(const struct fret_rows *all, fret_real z) {
    if (z > 0.02L)
        return fret_expm1(all->m * fret_log1p(z)) / (all->m * z);
    fret_real sum = 0;
    for (int j = BINOMIALS; j-- > 0;)
        sum = sum * z + all->binomial[j] / (fret_real)(j + 1);
    return sum;
}

/* The derivative of y^(1+by) times a polynomial, over y^by. */
static fret_real rate_at(const fret_real *c, int count, fret_real by, fret_real y) {
    fret_real sum = 0;
    for (int j = count; j-- > 0;)
        sum = sum * y + ((fret_real)(j + 1) + by) * c[j];
    return sum;
}

/* Of a product of polynomials, by its values at the nodes, its integral over y^(power-1); power 0: itself. */
static void add_product(maker *m, const rule *r, int which, const fret_real *value, fret_real little,
                        fret_real power, bool *more) {
    part *p = &m->all->part[m->all->count];
    fret_real *c = m->all->term + m->all->terms;
    const int count = fit(r, value, little, more, c);
    for (int j = 0; j < count && power > 0; j++)
        c[j] /= (fret_real)j + power;
    p->sum[which] = (unsigned char)count;
    m->all->terms += (size_t)count;
}

/* The integrals of a part: dF/dy = y K, G = int y K dh and L = int (h y K - G) dh of its rise h. */
static void add_sums(maker *m, const rule *r, fret_real little, bool *more) {
    const struct fret_rows *all = m->all;
    const part *p = &all->part[all->count];
    const fret_real *c = all->term + p->term, *sum = all->term + all->terms, bend = p->width / (p->x * p->x);
    const int count[2] = {p->count[DEPTHS][0], p->count[DEPTHS][1]}, nodes = r->of.count;
    fret_real K[WAVES], rise[2][WAVES], rate[2][WAVES], M[2][WAVES], value[WAVES];
    for (int j = 0; j < nodes; j++) {
        const fret_real y = r->of.node[j];
        K[j] = p->rate * mean_near_one(all, bend * y);
        for (int i = 0; i < 2; i++) {
            rise[i][j] = sum_of(c + (i ? count[0] : 0), (size_t)count[i], y);
            rate[i][j] = rate_at(c + (i ? count[0] : 0), count[i], i ? all->m : 0, y);
        }
    }
    const fret_real size = K[0] * rise[0][0];
    add_product(m, r, SUM_K, K, little * K[0], 0, more);
    sum += p->sum[SUM_K];
    for (int i = 0; i < 2; i++) {
        for (int j = 0; j < nodes; j++)
            value[j] = K[j] * rate[i][j];
        add_product(m, r, SUM_G + i, value, little * size, i ? 2 + all->m : 2, more);
        for (int j = 0; j < nodes; j++)
            M[i][j] = rise[i][j] * K[j] - sum_of(sum, p->sum[SUM_G + i], r->of.node[j]);
        sum += p->sum[SUM_G + i];
    }
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < nodes; j++)
            value[j] = i == 0   ? rate[0][j] * M[0][j]
                       : i == 1 ? rate[0][j] * M[1][j] + rate[1][j] * M[0][j]
                                : rate[1][j] * M[1][j];
        add_product(m, r, SUM_L + i, value, little * size * rise[0][0], 3 + (fret_real)i * all->m, more);
    }
}

/* From the distance e on, so far in the square of the radius, by one rule; false: it is too short. */
static bool set_part(maker *m, const rule *r, size_t row, fret_real e, fret_real width, bool kink) {
    static const fret_real LITTLE = 2e-19L;
    struct fret_rows *all = m->all;
    fret_real smooth[2][WAVES], bent[2][WAVES], base[2], c[WAVES], top[2], v[2];
    const fret_real x = all->start + e, bend = width / (x * x);
    const fret_level at_e = level_at(m, row, e);
    m->begin[all->count] = (struct beginning){e, at_e};
    const rule *few = &m->rule[bend < 0.01L ? 0 : RULES - 1];
    const bool slopes = m->slopes;
    part *p = &all->part[all->count];
    *p = (part){.x = x, .width = width, .term = all->terms};
    p->rate = all->C * all->m * width * fret_pow(x, 2 * (all->m - 1));
    take(base, &at_e);
    base[LOADS] = slopes ? 0 : base[LOADS];
    for (int j = 0; j < r->of.count; j++) {
        const fret_real to = sqrtl(x * x + width * r->of.node[j]), at = e + width * r->of.node[j] / (x + to);
        const fret_level l = kink ? fret_leaves_before(m->leaves, row, at) : level_at(m, row, at);
        take(v, &l);
        v[LOADS] *= slopes ? width / (2 * to) : 1;
        for (int by = 0; by < 2; by++)
            smooth[by][j] = v[by] - base[by];
        if (j == 0) /* the outermost */
            take(top, &(fret_level){v[DEPTHS], v[LOADS]});
    }
    for (int j = 0; kink && j < few->of.count; j++) {
        const fret_real y = few->of.node[j], to = sqrtl(x * x + width * y), at = e + width * y / (x + to);
        const fret_level l = fret_leaves_bend(m->leaves, row, at);
        bent[DEPTHS][j] = l.y / (y * few->ym[j]);
        bent[LOADS][j] = l.F / few->ym[j] * (slopes ? width / (2 * to) : 1 / y);
    }
    bool more = false, unused = false;
    for (int by = 0; by < 2; by++) {
        const int nothing = by == DEPTHS || !slopes; /* is the first, of a rise */
        int count = fit(r, smooth[by], LITTLE * top[by], &more, c) - nothing;
        for (int j = 0; j < count; j++)
            all->term[all->terms++] = c[j + nothing];
        p->count[by][0] = (unsigned char)(count > 0 ? count : 0);
        count = kink ? fit(few, bent[by], LITTLE * top[by], &unused, c) : 0;
        for (int j = 0; j < count; j++)
            all->term[all->terms++] = c[j];
        p->count[by][1] = (unsigned char)count;
    }
    if (!slopes)
        add_sums(m, r, LITTLE, &more);
    return !more;
}

/* By the shortest rule that does: most often that of the parts before. */
static bool add_part(maker *m, size_t row, fret_real e, fret_real width, bool kink) {
    enum { AGAIN = 16, TWICE = 2 };
    if (!make_room(m))
        return false;
    const size_t terms = m->all->terms;
    const bool shorter = m->likely > 0 && ++m->calm >= AGAIN;
    int i = m->likely - shorter;
    while (!set_part(m, &m->rule[i], row, e, width, kink) && i + 1 < RULES) {
        m->all->terms = terms;
        i++;
    }
    if (shorter)
        m->calm = 0;
    m->vain = i > m->likely ? m->vain + 1 : 0;
    if (i < m->likely || m->vain == TWICE) {
        m->likely = i;
        m->calm = m->vain = 0;
    }
    m->all->count++;
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
        all->run[0][i] = part_below(all, i, 1, 1, rise_of(all, i, DEPTHS, 1, 1));
    for (int l = 1; all->count >> l && !m->slopes; l++)
        for (size_t i = 0; i < all->count >> l; i++)
            all->run[l][i] = fret_stretch_join(&all->run[l - 1][2 * i + 1], &all->run[l - 1][2 * i]);
}

/* Against the profile here and there, and the load of all against the sum of what the parts carry. */
static fret_real error_of(const maker *m) {
    enum { LOOKS = 32 };
    const struct fret_rows *all = m->all;
    const fret_normal *n = m->normal;
    const fret_spot outer = fret_rows_outer(all), inner = fret_rows_inner();
    const stretch sum = fret_rows_between(all, &outer, &inner);
    const fret_real most = fret_rows_level(all, LOADS, &outer),
                    carried = sum.G + sum.h * fret_rows_stiffness(all, &inner);
    fret_real worst = fabsl(fret_rows_level(all, LOADS, &inner) + carried - most) / most;
    for (int i = 0; i < LOOKS; i++) {
        const size_t j = (size_t)((double)all->count * (i + 0.5) / LOOKS);
        const fret_real *e = all->reach[SPOT_DISTANCE] + j, place = e[0] + (e[1] - e[0]) * (i % 5 + 1) / 6;
        const fret_profile p = fret_table_profile(n->gap.table, &n->rule, place);
        fret_spot at;
        (void)fret_rows_find(all, SPOT_DISTANCE, place, &at);
        worst = fmaxl(worst, fabsl(fret_rows_level(all, DEPTHS, &at) / p.g - 1));
        worst = fmaxl(worst, fabsl(fret_rows_level(all, LOADS, &at) / fret_force_of(n, &p) - 1));
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
    for (int i = 0; i < RULES; i++)
        make_rule(&m->rule[i], nodes_of[i], all->m);
    make_binomials(all);
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

static fret_status make_rows(const fret_normal *n, fret_real from, fret_real e, bool slopes,
                             struct fret_rows **out, fret_real *error) {
    const struct fret_table *t = n->gap.table;
    const size_t least = fret_table_row(t, 0) + 1, row = fret_table_row(t, from),
                 first = row > least ? row : least;
    size_t last = fret_table_row(t, e) + 1;
    last -= last > first && fret_table_distance(t, last - 1) >= e;
    *out = NULL;
    if (last <= first || fret_stopped(n))
        return fret_unless_stopped(n, fret_ok());
    struct fret_rows *all = calloc(1, sizeof *all);
    maker *m = calloc(1, sizeof *m);
    fret_status st = fret_fail(FRET_NO_MEMORY, NULL, 0, 0);
    if (all && m) {
        *all = (struct fret_rows){
            .start = fret_table_start(t), .m = (n->rule.k + 1) / 2, .C = fret_normal_stiffness(n, 1)};
        fret_powers_make(all->m, &all->powers);
        *m = (maker){.all = all, .normal = n, .slopes = slopes};
        const bool ok = add_rows(m, first, last - first, e);
        st = fret_unless_stopped(n, m->failed);
        if (ok && !st.code && error)
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

fret_status fret_rows_make(const fret_normal *n, fret_real from, fret_real e, struct fret_rows **out,
                           fret_real *error) {
    return make_rows(n, from, e, false, out, error);
}

fret_status fret_rows_make_slopes(const fret_normal *n, fret_real e, struct fret_rows **out) {
    return make_rows(n, 0, e, true, out, NULL);
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
