/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Places in rows, and sums between them. Pure. */
#include "contact/rows.h"

#include <float.h>

#include "contact/row_parts.h"
#include "number/quadrature.h"
#include "number/real.h"

/* ---- within a part ----------------------------------------------------------------------------- */

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
    return y > 0 ? fret_pow(y, all->m) : 0;
}

/* (1+z)^(m-1) */
static fret_real near_one(const struct fret_rows *all, fret_real z) {
    if (fabsl(z) > 0.02L)
        return expl((all->m - 1) * log1pl(z));
    return sum_of(all->binomial, fabsl(z) < 1e-3L ? 7 : ROW_BINOMIALS, z);
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
    const fret_real s0 = far ? from : expl(logl(from) / 3), way = (far ? to : expl(logl(to) / 3)) - s0,
                    bend = p->width / (p->x * p->x), edge = rise_of(all, i, DEPTHS, from, power);
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

stretch fret_rows_whole(const struct fret_rows *all, size_t i) {
    return part_below(all, i, 1, 1, rise_of(all, i, DEPTHS, 1, 1));
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
