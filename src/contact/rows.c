/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Row by row: what lies far from a few rows as polynomials over them, the kinks near by in closed form; of
 * every row its integrals, and of runs of rows. Allocates them, and frees them. */
#include "contact/rows.h"

#include <float.h>
#include <stdlib.h>

#include "contact/check.h"
#include "contact/table.h"
#include "number/quadrature.h"
#include "number/real.h"

/* With alpha = (k-1)/2, u = unit, x the radius, V[i] = int f' ((x^2-r^2)/(x u))^(alpha+i) dr is
 *   g = x^((1-k)/2) u^alpha V[0], F_N = K g - C (u x)^(alpha+1) V[1], K = C x^(1+k).
 * Over a leaf, a few rows, all of f' before `near` counts by a polynomial, since it is at least as far away
 * as the leaf is wide; the quadratic f' of `near` goes on to x, and each kink after that adds what it bends.
 */
enum { WAVES = 20, LEAF_ROWS = 4, GOING_ON = 16, SERIES = 64, MANY = 10000 };
#define LANES 2
#include "number/lanes.h"

typedef struct leaf {
    size_t near;
    bool goes_on, more;     /* the next leaf covers more of the same row */
    fret_real middle, half; /* distances from the start */
    fret_real root;         /* x^((1-k)/2) in the middle */
    fret_real c[2][WAVES];
} leaf;

typedef struct kink {
    fret_real at;
    double bend[2]; /* jumps of the second and the third derivative */
} kink;

struct fret_rows {
    const struct fret_table *table;
    const fret_rule *rule;
    fret_real start, unit, unit_alpha, alpha, C;
    fret_real series[2][3][SERIES]; /* of the bends: [i][j] of V[i] by the power t^j of f' */
    double short_series[2][2][SERIES];
    bool many;
    fret_real near_unit, near_factor[2]; /* of kinks in double */
    kink *kink;                          /* of every row of the table up to the end */
    size_t first, count;                 /* pieces of the table: first, ... */
    size_t leaves, *leaf_of;             /* of each row */
    leaf *leaf;
    fret_real *reach[3]; /* where each row begins, and the last one ends: distance, depth, load */
    stretch *run[RUNS];  /* as those of pieces */
};

/* ---- the law at a place ------------------------------------------------------------------------ */

/* Of V the first `count` of f' = c0 + c1 t + c2 t^2 from the distance u before x on. */
static void add_bend(const struct fret_rows *all, const fret_real c[3], fret_real u, fret_real x, int count,
                     fret_real *V) {
    const fret_real q = u / (2 * x), size = 2 * u / all->unit;
    const fret_real power = fret_exp(all->alpha * fret_log(size)) * u;
    const fret_real c0 = c[0], c1 = c[1] * u, c2 = 2 * c[2] * u * u;
    int terms = 1;
    for (fret_real left = 1e21L * q; left > 1 && terms < SERIES; left *= q)
        terms++;
    for (int i = 0; i < count; i++) {
        const fret_real *a0 = all->series[i][0], *a1 = all->series[i][1], *a2 = all->series[i][2];
        fret_real sum = 0;
        for (int n = terms; n-- > 0;)
            sum = sum * q + (c0 * a0[n] + c1 * a1[n] + c2 * a2[n]);
        V[i] += sum * power * (i ? size : 1);
    }
}

static void make_series(struct fret_rows *all) {
    for (int i = 0; i < 2; i++) {
        const fret_real p = all->alpha + (fret_real)i;
        fret_real c = 1;
        for (int n = 0; n < SERIES; n++) { /* (1-q)^p */
            all->series[i][0][n] = c / (p + (fret_real)(n + 1));
            all->series[i][1][n] = all->series[i][0][n] / (p + (fret_real)(n + 2));
            all->series[i][2][n] = all->series[i][1][n] / (p + (fret_real)(n + 3));
            c *= ((fret_real)n - p) / (fret_real)(n + 1);
            all->short_series[i][0][n] = (double)all->series[i][1][n];
            all->short_series[i][1][n] = (double)all->series[i][2][n];
        }
        all->near_factor[i] = fret_pow(all->near_unit / all->unit, p);
    }
    for (size_t i = 0; i < all->first + all->count; i++) {
        fret_real c[3] = {0, 0, 0};
        if (i > 0)
            fret_table_jump(all->table, i, c);
        all->kink[i] = (kink){fret_table_distance(all->table, i), {(double)c[1], (double)(2 * c[2])}};
    }
}

static fret_real value_of(const fret_real *c, fret_real z) {
    const fret_real z2 = z * z;
    fret_real even = c[WAVES - 2], odd = c[WAVES - 1];
    for (int i = WAVES - 4; i >= 0; i -= 2) {
        even = even * z2 + c[i];
        odd = odd * z2 + c[i + 1];
    }
    return even + z * odd;
}

/* Two kinks in double: of many rows each bends little. */
static void add_two(const struct fret_rows *all, const kink *first, fret_real e, int count, double V[2][2]) {
    const fret_real u0 = e - first[0].at, u1 = e - first[1].at;
    const double half = (double)(0.5L / (all->start + e)), per = (double)(2 / all->near_unit);
    const lanes2_numbers u = {(double)u0, u1 > 0 ? (double)u1 : 1e-300}, size = u * per, q = u * half;
    const lanes2_numbers c1 = {first[0].bend[0], u1 > 0 ? first[1].bend[0] : 0},
                         c2 = {first[0].bend[1], u1 > 0 ? first[1].bend[1] : 0}, zero = {0, 0};
    lanes2_numbers m, power, exponent, factor, log;
    lanes2_reduce(&size, &m, &exponent, &factor);
    m -= 1.0;
    lanes2_log_of(&m, &zero, &exponent, &log);
    log *= (double)all->alpha;
    lanes2_exp_times(&u, &log, &zero, &power);
    int terms = 1;
    for (double left = 1e17 * q[0]; left > 1 && terms < SERIES; left *= q[0])
        terms++;
    for (int i = 0; i < count; i++) {
        const double *a1 = all->short_series[i][0], *a2 = all->short_series[i][1];
        lanes2_numbers s1 = zero, s2 = zero;
        for (int n = terms; n-- > 0;) {
            s1 = s1 * q + a1[n];
            s2 = s2 * q + a2[n];
        }
        s1 = u * (c1 * s1 + u * (c2 * s2)) * power;
        if (i > 0)
            s1 *= size;
        V[i][0] += s1[0];
        V[i][1] += s1[1];
    }
}

/* Adds to the first `count` of V what the kinks after row `from` bend, up to row `to`. */
static void add_bends(const struct fret_rows *all, size_t from, size_t to, fret_real e, int count,
                      fret_real V[2]) {
    fret_real c[3];
    if (!all->many) {
        for (size_t i = from + 1; i <= to && e > all->kink[i].at; i++) {
            fret_table_jump(all->table, i, c);
            add_bend(all, c, e - all->kink[i].at, all->start + e, count, V);
        }
        return;
    }
    double two[2][2] = {{0, 0}, {0, 0}};
    for (size_t i = from + 1; i <= to && e > all->kink[i].at; i += 2) {
        const kink last[2] = {all->kink[i], {(fret_real)INFINITY, {0, 0}}};
        add_two(all, i < to ? &all->kink[i] : last, e, count, two);
    }
    for (int i = 0; i < count; i++)
        V[i] += all->near_factor[i] * (two[i][0] + two[i][1]);
}

/* At the distance e in a row, on demand the load too. */
static fret_level value_at(const struct fret_rows *all, size_t row, fret_real e, bool load) {
    const leaf *l = &all->leaf[all->leaf_of[row - all->first]];
    while (l->more && e > l->middle + l->half)
        l++;
    const fret_real z = (e - l->middle) / l->half, x = all->start + e;
    fret_real V[2] = {value_of(l->c[0], z), load ? value_of(l->c[1], z) : 0};
    add_bends(all, l->near, row, e, load ? 2 : 1, V);
    const fret_real root =
        l->root * fret_exp(-all->alpha * fret_log1p((e - l->middle) / (all->start + l->middle)));
    const fret_real g = root * all->unit_alpha * V[0], edge = x / root;
    return (fret_level){g, load ? all->C * edge * (edge * g - all->unit_alpha * all->unit * V[1]) : 0};
}

static fret_level level_at(const struct fret_rows *all, size_t row, fret_real e) {
    return value_at(all, row, e, true);
}

/* So far beyond the row; at both ends what is kept, so that what rows add up to is exact. */
static fret_real depth_at(const struct fret_rows *all, size_t row, fret_real beyond) {
    const fret_real *e = all->reach[SPOT_DISTANCE] + (row - all->first),
                    *y = all->reach[SPOT_DEPTH] + (row - all->first);
    return beyond <= 0 ? y[0] : beyond >= e[1] - e[0] ? y[1] : value_at(all, row, e[0] + beyond, false).y;
}

static fret_real stiffness_at(const struct fret_rows *all, fret_real x) {
    return all->C * fret_pow(x, 2 * (all->alpha + 1));
}

/* ---- one row ----------------------------------------------------------------------------------- */

/* Within a row from the distance `from` beyond it inwards to `to`, in parts of the third root of that, in
 * which the kinks are smooth enough. */
static stretch part_of(const struct fret_rows *all, size_t row, fret_real from, fret_real to) {
    const fret_real begin = fret_table_distance(all->table, row), x0 = all->start + begin,
                    k = 2 * all->alpha + 1;
    const fret_real away = begin / (fret_table_distance(all->table, row + 1) - begin);
    const int parts = away < 0.1L ? 16 : away < 1 ? 8 : away < 4 ? 4 : 2;
    const fret_real s0 = fret_exp(fret_log(from) / 3), way = (to > 0 ? fret_exp(fret_log(to) / 3) : 0) - s0;
    const fret_real edge = depth_at(all, row, from), rate = (1 + k) * stiffness_at(all, x0) / x0;
    stretch out = {edge - depth_at(all, row, to), 0, 0, 0};
    for (int j = 0; j < 8 * parts; j++) {
        const fret_real s = s0 + way * ((fret_real)(j / 8) + fret_gauss_node[j % 8]) / (fret_real)parts,
                        u = s * s * s, t = edge - depth_at(all, row, u);
        const fret_real dK = rate * fret_exp(k * fret_log1p(u / x0)) * 3 * s * s * -way *
                             fret_gauss_weight[j % 8] / (fret_real)parts;
        out.K += dK;
        out.G += t * dK;
        out.L += t * (out.h - t) * dK;
    }
    return out;
}

/* ---- places ------------------------------------------------------------------------------------ */

static fret_real by_of(fret_spot_by by, const fret_spot *s) {
    return by == SPOT_DISTANCE ? s->e : by == SPOT_DEPTH ? s->at.y : s->at.F;
}

static fret_spot spot_in(const struct fret_rows *all, size_t row, fret_real beyond) {
    fret_spot s = {row, beyond, fret_table_distance(all->table, row) + beyond, {0, 0}};
    s.at = level_at(all, row, s.e);
    return s;
}

/* By chords, each within what the ones before have left. */
static fret_spot search(const struct fret_rows *all, size_t row, fret_spot_by by, fret_real value) {
    const fret_real *reach = all->reach[by] + (row - all->first),
                    *e = all->reach[SPOT_DISTANCE] + (row - all->first);
    fret_real lo = 0, hi = e[1] - e[0], below = reach[0] - value, above = reach[1] - value;
    fret_spot s = {0};
    for (int i = 0, side = 0; i < 40; i++) {
        const fret_real way = above / (above - below) * (hi - lo), next = hi - way;
        s = spot_in(all, row, next > lo && next < hi ? next : (lo + hi) / 2);
        const fret_real miss = by_of(by, &s) - value;
        if (fabsl(miss) <= 3 * LDBL_EPSILON * value || !(hi - lo > LDBL_EPSILON * s.e))
            break;
        if (miss < 0) { /* an end that stays counts half */
            lo = s.beyond;
            below = miss;
            above /= side == -1 ? 2 : 1;
            side = -1;
        } else {
            hi = s.beyond;
            above = miss;
            below /= side == 1 ? 2 : 1;
            side = 1;
        }
    }
    return s;
}

bool fret_rows_find(const struct fret_rows *all, fret_spot_by by, fret_real value, fret_spot *out) {
    const fret_real *reach = all->reach[by];
    if (!(value > reach[0] && value <= reach[all->count]))
        return false;
    size_t lo = 0, hi = all->count; /* reach[lo] < value <= reach[hi] */
    while (hi - lo > 1) {
        const size_t middle = lo + (hi - lo) / 2;
        *(reach[middle] < value ? &lo : &hi) = middle;
    }
    const size_t row = all->first + lo;
    *out = by == SPOT_DISTANCE ? spot_in(all, row, value - reach[lo]) : search(all, row, by, value);
    out->at = by == SPOT_DEPTH  ? (fret_level){value, out->at.F}
              : by == SPOT_LOAD ? (fret_level){out->at.y, value}
                                : out->at;
    return true;
}

static fret_spot beginning(const struct fret_rows *all, size_t i) {
    return (fret_spot){all->first + i,
                       0,
                       all->reach[SPOT_DISTANCE][i],
                       {all->reach[SPOT_DEPTH][i], all->reach[SPOT_LOAD][i]}};
}

fret_spot fret_rows_inner(const struct fret_rows *all) {
    return beginning(all, 0);
}

fret_spot fret_rows_outer(const struct fret_rows *all) {
    return beginning(all, all->count);
}

fret_real fret_rows_stiffness(const struct fret_rows *all, const fret_spot *s) {
    return stiffness_at(all, all->start + s->e);
}

stretch fret_rows_between(const struct fret_rows *all, const fret_spot *outer, const fret_spot *inner) {
    if (outer->row == inner->row && outer->beyond > inner->beyond)
        return part_of(all, outer->row, outer->beyond, inner->beyond);
    stretch sum = {0, 0, 0, 0};
    if (outer->e <= inner->e)
        return sum;
    if (outer->beyond > 0)
        sum = part_of(all, outer->row, outer->beyond, 0);
    const size_t next = inner->row - all->first + (inner->beyond > 0);
    fret_stretch_add_runs(all->run, outer->row - all->first, next, &sum);
    if (inner->beyond > 0) {
        const fret_real end = all->reach[SPOT_DISTANCE][next] - all->reach[SPOT_DISTANCE][next - 1];
        const stretch rest = part_of(all, inner->row, end, inner->beyond);
        sum = fret_stretch_join(&sum, &rest);
    }
    return sum;
}

/* ---- making ------------------------------------------------------------------------------------ */

typedef struct maker {
    struct fret_rows *all;
    const fret_normal *normal;
    fret_real wave[WAVES], at[WAVES][WAVES], power[WAVES][WAVES]; /* T_i at node j, and in powers */
    size_t room;
    fret_status failed;
} maker;

static const fret_real MOST_WIDE = 1.01L; /* of the distance from the start: beyond, waves are too coarse */

static void make_waves(maker *m) {
    for (int j = 0; j < WAVES; j++)
        m->wave[j] = fret_cos(FRET_PI * (fret_real)(2 * j + 1) / (2 * WAVES));
    for (int i = 0; i < WAVES; i++)
        for (int j = 0; j < WAVES; j++) {
            m->at[i][j] = i == 0   ? 1
                          : i == 1 ? m->wave[j]
                                   : 2 * m->wave[j] * m->at[i - 1][j] - m->at[i - 2][j];
            m->power[i][j] = i < 2    ? (fret_real)(i == j)
                             : j == 0 ? -m->power[i - 2][0]
                                      : 2 * m->power[i - 1][j - 1] - m->power[i - 2][j];
        }
}

static void fit(const maker *m, const fret_real *value, fret_real *c) {
    for (int j = 0; j < WAVES; j++)
        c[j] = 0;
    for (int i = 0; i < WAVES; i++) {
        fret_real term = 0;
        for (int j = 0; j < WAVES; j++)
            term += m->at[i][j] * value[j];
        term *= (i ? 2 : 1) / (fret_real)WAVES;
        for (int j = i & 1; j <= i; j += 2)
            c[j] += term * m->power[i][j];
    }
}

/* Between the distances lo and hi what is before `near`, of that what is before `above->near` from there. Few
 * rows go on with the quadratic of `near`. */
static void make_field(maker *m, fret_real lo, fret_real hi, bool few, const leaf *above, leaf *out) {
    const struct fret_rows *all = m->all;
    fret_real value[2][WAVES], more[2], c[3];
    *out = (leaf){.middle = (lo + hi) / 2, .half = (hi - lo) / 2, .goes_on = few};
    out->near = lo - (hi - lo) > -all->start ? fret_table_row(all->table, lo - (hi - lo)) : 0;
    for (int j = 0; j < WAVES; j++) {
        const fret_real e = out->middle + out->half * m->wave[j], z = (e - above->middle) / above->half;
        more[0] = more[1] = 0;
        if (above->goes_on)
            add_bends(all, above->near, out->near, e, 2, more);
        else
            fret_table_part(all->table, all->rule, above->near, out->near, e, all->unit, more);
        if (out->goes_on && !above->goes_on) {
            fret_table_slope(all->table, out->near, c);
            add_bend(all, c, e - fret_table_distance(all->table, out->near), all->start + e, 2, more);
        }
        for (int i = 0; i < 2; i++)
            value[i][j] = (above->near || above->goes_on ? value_of(above->c[i], z) : 0) + more[i];
    }
    for (int i = 0; i < 2; i++)
        fit(m, value[i], out->c[i]);
}

static bool add_leaf(maker *m, leaf *l) {
    struct fret_rows *all = m->all;
    if (all->leaves == m->room) {
        const size_t room = 2 * m->room + 64;
        leaf *grown = realloc(all->leaf, room * sizeof *grown);
        if (!grown) {
            m->failed = fret_fail(FRET_NO_MEMORY, NULL, 0, 0);
            return false;
        }
        all->leaf = grown;
        m->room = room;
    }
    l->root = fret_pow(all->start + l->middle, -all->alpha);
    all->leaf[all->leaves++] = *l;
    return true;
}

/* A row that is wider than it is far from the start: in parts that are not. */
static bool add_wide(maker *m, fret_real lo, fret_real hi, const leaf *above) {
    leaf here;
    bool ok = true;
    while (ok && lo < hi) {
        const fret_real end = hi < 2 * lo * MOST_WIDE ? hi : 2 * lo;
        make_field(m, lo, end, true, above, &here);
        here.more = end < hi;
        ok = add_leaf(m, &here);
        lo = end;
    }
    return ok;
}

static bool descend(maker *m, size_t first, size_t last, const leaf *above) {
    struct fret_rows *all = m->all;
    const fret_real lo = fret_table_distance(all->table, first), hi = fret_table_distance(all->table, last);
    const bool wide = hi - lo > MOST_WIDE * lo;
    if (fret_stopped(m->normal))
        return false;
    leaf here = *above; /* as long as it is wide, of no use */
    if (!wide)
        make_field(m, lo, hi, last - first <= GOING_ON, above, &here);
    if (last - first > 1 && (wide || last - first > LEAF_ROWS)) {
        const size_t middle = first + (last - first) / 2;
        return descend(m, first, middle, &here) && descend(m, middle, last, &here);
    }
    for (size_t i = first; i < last; i++)
        all->leaf_of[i - all->first] = all->leaves;
    return wide ? add_wide(m, lo, hi, above) : add_leaf(m, &here);
}

static bool allocate(struct fret_rows *all) {
    const size_t n = all->count;
    all->leaf_of = malloc(n * sizeof *all->leaf_of);
    all->kink = malloc((all->first + n) * sizeof *all->kink);
    bool ok = all->leaf_of && all->kink;
    for (int i = 0; i < 3; i++) {
        all->reach[i] = malloc((n + 1) * sizeof *all->reach[i]);
        ok = ok && all->reach[i];
    }
    for (int l = 0; n >> l; l++) {
        all->run[l] = malloc((n >> l) * sizeof *all->run[l]);
        ok = ok && all->run[l];
    }
    return ok;
}

/* Beginnings and integrals of the rows. */
static void make_rows(maker *m) {
    struct fret_rows *all = m->all;
    for (size_t i = 0; i <= all->count && !fret_stopped(m->normal); i++) {
        const size_t row = all->first + i - (i == all->count);
        const fret_real e = fret_table_distance(all->table, all->first + i);
        const fret_level at = level_at(all, row, e);
        all->reach[SPOT_DISTANCE][i] = e;
        all->reach[SPOT_DEPTH][i] = at.y;
        all->reach[SPOT_LOAD][i] = at.F;
    }
    for (size_t i = 0; i < all->count && !fret_stopped(m->normal); i++)
        all->run[0][i] =
            part_of(all, all->first + i, all->reach[SPOT_DISTANCE][i + 1] - all->reach[SPOT_DISTANCE][i], 0);
    for (int l = 1; all->count >> l; l++)
        for (size_t i = 0; i < all->count >> l; i++)
            all->run[l][i] = fret_stretch_join(&all->run[l - 1][2 * i + 1], &all->run[l - 1][2 * i]);
}

/* Against the profile here and there, and the load of all against the sum of what the rows carry. */
static fret_real error_of(maker *m) {
    enum { LOOKS = 32 };
    const struct fret_rows *all = m->all;
    const fret_spot outer = fret_rows_outer(all), inner = fret_rows_inner(all);
    const stretch sum = fret_rows_between(all, &outer, &inner);
    fret_real worst =
        fabsl(inner.at.F + sum.G + sum.h * fret_rows_stiffness(all, &inner) - outer.at.F) / outer.at.F;
    for (int i = 0; i < LOOKS; i++) {
        const size_t row = (size_t)((double)all->count * (i + 0.5) / LOOKS);
        const fret_real *e = all->reach[SPOT_DISTANCE] + row, place = e[0] + (e[1] - e[0]) * (i % 5 + 1) / 6;
        const fret_profile p = fret_table_profile(all->table, all->rule, place);
        const fret_level at = level_at(all, all->first + row, place);
        worst = fmaxl(worst, fabsl(at.y / p.g - 1));
        worst = fmaxl(worst, fabsl(at.F / fret_force_of(m->normal, &p) - 1));
    }
    return worst;
}

fret_status fret_rows_make(const fret_normal *n, fret_real e, struct fret_rows **out, fret_real *error) {
    struct fret_rows *all = calloc(1, sizeof *all);
    maker *m = calloc(1, sizeof *m);
    *out = NULL;
    fret_status st = all && m ? fret_ok() : fret_fail(FRET_NO_MEMORY, NULL, 0, 0);
    bool ok = !st.code;
    if (ok) {
        const struct fret_table *t = n->gap.table;
        *m = (maker){.all = all, .normal = n};
        all->table = t;
        all->rule = &n->rule;
        all->start = fret_table_start(t);
        all->first = fret_table_row(t, 0) + 1;
        all->count = fret_table_row(t, e) + 1;
        all->count -= all->count > all->first && fret_table_distance(t, all->count - 1) >= e;
        ok = all->count > all->first;
        all->count -= all->first;
    }
    if (ok && !allocate(all))
        st = fret_fail(FRET_NO_MEMORY, NULL, 0, 0);
    ok = ok && !st.code;
    if (ok) {
        all->alpha = (n->rule.k - 1) / 2;
        all->unit = e / sqrtl((fret_real)all->count);
        all->near_unit = e / (fret_real)all->count;
        all->many = all->count >= MANY;
        all->unit_alpha = fret_pow(all->unit, all->alpha);
        all->C = fret_normal_stiffness(n, 1);
        make_series(all);
        make_waves(m);
        const leaf none = {.near = 0, .half = 1};
        ok = descend(m, all->first, all->first + all->count, &none);
        st = m->failed;
    }
    if (ok) {
        make_rows(m);
        *error = fret_stopped(n) ? 0 : error_of(m);
    }
    st = fret_unless_stopped(n, st);
    free(m);
    if (ok && !st.code)
        *out = all;
    else
        fret_rows_free(all);
    return st;
}

void fret_rows_free(struct fret_rows *all) {
    if (!all)
        return;
    for (int l = 0; l < RUNS; l++)
        free(all->run[l]);
    for (int i = 0; i < 3; i++)
        free(all->reach[i]);
    free(all->kink);
    free(all->leaf_of);
    free(all->leaf);
    free(all);
}
