/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What lies far from a few rows as polynomials over them, the kinks near by in closed form. Allocates them,
 * and frees them. */
#include "contact/leaves.h"

#include <float.h>
#include <stdlib.h>

#include "contact/check.h"
#include "contact/table.h"
#include "number/array.h"
#include "number/chebyshev.h"
#include "number/real.h"

/* With alpha = (k-1)/2, u = unit, x the radius, V[i] = int f' ((x^2-r^2)/(x u))^(alpha+i) dr is
 *   g = x^((1-k)/2) u^alpha V[0], F_N = K g - C (u x)^(alpha+1) V[1], K = C x^(1+k);
 * or, where slopes are wanted, V[1] is V[0] of f' + r f'', and g' = x^((1-k)/2) u^alpha V[1]/x.
 * Over a leaf, a few rows, all of f' before `near` counts by a polynomial, since it is at least as far away
 * as the leaf is wide; the quadratic f' of `near` goes on to x, and each kink after that adds what it bends.
 */
enum { WAVES = FRET_CHEBYSHEV, LEAF_ROWS = 4, GOING_ON = 16, SERIES = 64, MANY = 10000, BINOMIALS = 7 };
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
    double bend[2];   /* jumps of the second and the third derivative */
    fret_real little; /* so far doubles do for what it bends */
} kink;

struct fret_leaves {
    const struct fret_table *table;
    const fret_rule *rule;
    fret_real start, unit, unit_alpha, alpha, C;
    fret_real series[2][3][SERIES]; /* of the bends: [i][j] of V[i] by the power t^j of f' */
    double short_series[2][3][SERIES];
    fret_real binomial[BINOMIALS]; /* of (1+z)^-alpha */
    bool many, slopes;
    fret_real near_unit, near_factor[2]; /* of kinks in double */
    size_t from;                         /* the first row whose kink may be near */
    kink *kink;                          /* of every row from there up to the end */
    size_t first, count;                 /* pieces of the table: first, ... */
    size_t leaves, *leaf_of;             /* of each row */
    leaf *leaf;
};

/* ---- the law at a place ------------------------------------------------------------------------ */

/* Adds to V that of f' = c0 + c1 t + c2 t^2 from the distance u before x on. */
static void add_bend(const struct fret_leaves *all, const fret_real c[3], fret_real u, fret_real x,
                     fret_real V[2]) {
    const fret_real q = u / (2 * x), size = 2 * u / all->unit, r = x - u;
    const fret_real power = expl(all->alpha * logl(size)) * u;
    const fret_real rising[3] = {c[0] + r * c[1], 2 * (c[1] + r * c[2]), 3 * c[2]}; /* f' + r f'' */
    int terms = 1;
    for (fret_real left = 1e21L * q; left > 1 && terms < SERIES; left *= q)
        terms++;
    for (int i = 0; i < 2; i++) {
        const fret_real *a0 = all->series[i][0], *a1 = all->series[i][1], *a2 = all->series[i][2],
                        *of = i && all->slopes ? rising : c, c1 = of[1] * u, c2 = 2 * of[2] * u * u;
        fret_real sum = 0;
        for (int n = terms; n-- > 0;)
            sum = sum * q + (of[0] * a0[n] + c1 * a1[n] + c2 * a2[n]);
        V[i] += sum * power * (i && !all->slopes ? size : 1);
    }
}

/* So far it bends so little of the whole, as f/e tells it, that doubles leave it all digits. */
static fret_real little_to(const struct fret_leaves *all, size_t row, const fret_real jump[3]) {
    const fret_real at = fret_table_distance(all->table, row),
                    wide = (fret_real)GOING_ON * (fret_table_distance(all->table, row + 1) -
                                                  fret_table_distance(all->table, row - 1)),
                    part = at > wide ? fret_pow(wide / at, all->alpha + 1) : 1,
                    little = 5e-4L * fret_table_f(all->table, all->start + at) / (at * part);
    return little > 0 ? fminl(little / (fabsl(jump[1]) + sqrtl(fabsl(jump[2]) * little)), wide) : 0;
}

static void make_series(struct fret_leaves *all) {
    for (int i = 0; i < 2; i++) {
        const fret_real p = all->alpha + (i && !all->slopes ? 1 : 0);
        fret_real c = 1;
        for (int n = 0; n < SERIES; n++) { /* (1-q)^p */
            all->series[i][0][n] = c / (p + (fret_real)(n + 1));
            all->series[i][1][n] = all->series[i][0][n] / (p + (fret_real)(n + 2));
            all->series[i][2][n] = all->series[i][1][n] / (p + (fret_real)(n + 3));
            c *= ((fret_real)n - p) / (fret_real)(n + 1);
            for (int j = 0; j < 3; j++)
                all->short_series[i][j][n] = (double)all->series[i][j][n];
        }
        all->near_factor[i] = fret_pow(all->near_unit / all->unit, p);
    }
    fret_real c = 1;
    for (int n = 0; n < BINOMIALS; n++) {
        all->binomial[n] = c;
        c *= (-all->alpha - (fret_real)n) / (fret_real)(n + 1);
    }
}

static void make_kinks(struct fret_leaves *all) {
    for (size_t i = all->from; i < all->first + all->count; i++) {
        kink *k = &all->kink[i - all->from];
        fret_real c[3] = {0, 0, 0};
        if (i > 0)
            fret_table_jump(all->table, i, c);
        *k = (kink){.at = fret_table_distance(all->table, i), .bend = {(double)c[1], (double)(2 * c[2])}};
        if (all->many)
            k->little = INFINITY;
        else if (i > 0 && !all->slopes) /* these it would bend more */
            k->little = little_to(all, i, c);
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
static void add_two(const struct fret_leaves *all, const kink *first, fret_real e, double V[2][2]) {
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
    for (int i = 0; i < 2; i++) {
        const double *a0 = all->short_series[i][0], *a1 = all->short_series[i][1],
                     *a2 = all->short_series[i][2];
        const bool rising = i && all->slopes;
        lanes2_numbers s0 = zero, s1 = zero, s2 = zero;
        for (int n = terms; n-- > 0;) {
            s1 = s1 * q + a1[n];
            s2 = s2 * q + a2[n];
        }
        for (int n = rising ? terms : 0; n-- > 0;)
            s0 = s0 * q + a0[n];
        if (rising) { /* as in add_bend */
            const lanes2_numbers r = (double)(all->start + e) - u;
            s1 = r * c1 * s0 + u * ((2.0 * c1 + r * c2) * s1 + u * (3.0 * c2 * s2));
        } else {
            s1 = u * (c1 * s1 + u * (c2 * s2));
        }
        s1 *= power;
        if (i && !rising)
            s1 *= size;
        V[i][0] += s1[0];
        V[i][1] += s1[1];
    }
}

/* Adds to V what the kinks after row `from` bend, up to row `to`. */
static void add_bends(const struct fret_leaves *all, size_t from, size_t to, fret_real e, fret_real V[2]) {
    double two[2][2] = {{0, 0}, {0, 0}};
    fret_real c[3];
    for (size_t i = from + 1; i <= to && e > all->kink[i - all->from].at; i++) {
        const kink *k = &all->kink[i - all->from];
        if (!(e - k->at <= k->little)) {
            fret_table_jump(all->table, i, c);
            add_bend(all, c, e - k->at, all->start + e, V);
            continue;
        }
        const bool both = i < to && e - k[1].at <= k[1].little;
        const kink last[2] = {*k, {.at = (fret_real)INFINITY}};
        add_two(all, both ? k : last, e, two);
        i += both;
    }
    for (int i = 0; i < 2; i++)
        V[i] += all->near_factor[i] * (two[i][0] + two[i][1]);
}

/* (1+z)^-alpha */
static fret_real near_one(const struct fret_leaves *all, fret_real z) {
    if (fabsl(z) > 1e-3L)
        return expl(-all->alpha * log1pl(z));
    fret_real sum = 0;
    for (int j = BINOMIALS; j-- > 0;)
        sum = sum * z + all->binomial[j];
    return sum;
}

/* From V at the radius x = start + e. */
static fret_level level_of(const struct fret_leaves *all, const leaf *l, fret_real e, const fret_real V[2]) {
    const fret_real x = all->start + e, away = (e - l->middle) / (all->start + l->middle);
    const fret_real root = l->root * near_one(all, away);
    const fret_real g = root * all->unit_alpha * V[0], edge = x / root;
    return (fret_level){g, all->slopes ? root * all->unit_alpha * V[1] / x
                                       : all->C * edge * (edge * g - all->unit_alpha * all->unit * V[1])};
}

static const leaf *leaf_at(const struct fret_leaves *all, size_t row, fret_real e) {
    const leaf *l = &all->leaf[all->leaf_of[row - all->first]];
    while (l->more && e > l->middle + l->half)
        l++;
    return l;
}

fret_level fret_leaves_before(const struct fret_leaves *all, size_t row, fret_real e) {
    const leaf *l = leaf_at(all, row, e);
    const fret_real z = (e - l->middle) / l->half;
    fret_real V[2] = {value_of(l->c[0], z), value_of(l->c[1], z)};
    add_bends(all, l->near, row - 1, e, V);
    return level_of(all, l, e, V);
}

fret_level fret_leaves_bend(const struct fret_leaves *all, size_t row, fret_real e) {
    const leaf *l = leaf_at(all, row, e);
    fret_real V[2] = {0, 0};
    if (l->near < row)
        add_bends(all, row - 1, row, e, V);
    return level_of(all, l, e, V);
}

/* ---- making ------------------------------------------------------------------------------------ */

typedef struct maker {
    struct fret_leaves *all;
    const fret_normal *normal;
    fret_chebyshev rule;
    size_t room;
    fret_status failed;
} maker;

static const fret_real MOST_WIDE = 1.01L; /* of the distance from the start: beyond, waves are too coarse */

/* What is near begins here. */
static size_t near_of(const struct fret_leaves *all, fret_real lo, fret_real hi) {
    return lo - (hi - lo) > -all->start ? fret_table_row(all->table, lo - (hi - lo)) : 0;
}

/* That of as many rows as go on, wherever they begin, and of parts of a row. */
static size_t least_near(const struct fret_leaves *all, size_t first, size_t last) {
    fret_real least = INFINITY;
    for (size_t i = first; i < last; i++) {
        const fret_real lo = fret_table_distance(all->table, i),
                        hi = fret_table_distance(all->table, last - i > GOING_ON ? i + GOING_ON : last);
        least = fminl(least, lo - (hi - lo));
    }
    return near_of(all, least, least);
}

/* Between the distances lo and hi, of `row` and those after it, what is before `near`, of that what is before
 * `above->near` from there. Few rows go on with the quadratic of `near`. */
static void make_field(maker *m, size_t row, fret_real lo, fret_real hi, bool few, const leaf *above,
                       leaf *out) {
    const struct fret_leaves *all = m->all;
    fret_real value[2][WAVES], more[3], c[3];
    *out = (leaf){.middle = (lo + hi) / 2, .half = (hi - lo) / 2, .goes_on = few};
    out->near = near_of(all, lo, hi);
    if (out->near == row) /* a later part of it: its kink stays apart */
        out->near--;
    for (int j = 0; j < WAVES; j++) {
        const fret_real e = out->middle + out->half * m->rule.node[j], z = (e - above->middle) / above->half;
        more[0] = more[1] = 0;
        if (above->goes_on) {
            add_bends(all, above->near, out->near, e, more);
        } else {
            fret_table_part(all->table, all->rule, above->near, out->near, e, all->unit, more);
            more[1] = all->slopes ? more[2] : more[1];
        }
        if (out->goes_on && !above->goes_on) {
            fret_table_slope(all->table, out->near, c);
            add_bend(all, c, e - fret_table_distance(all->table, out->near), all->start + e, more);
        }
        for (int i = 0; i < 2; i++)
            value[i][j] = (above->near || above->goes_on ? value_of(above->c[i], z) : 0) + more[i];
    }
    for (int i = 0; i < 2; i++) {
        fret_real term[WAVES];
        fret_chebyshev_terms(&m->rule, value[i], term);
        fret_chebyshev_powers(&m->rule, term, WAVES, out->c[i]);
    }
}

static bool add_leaf(maker *m, leaf *l) {
    struct fret_leaves *all = m->all;
    leaf *grown = fret_array_for(all->leaf, &m->room, all->leaves + 1, sizeof *grown);
    if (!grown) {
        m->failed = fret_fail(FRET_NO_MEMORY, NULL, 0, 0);
        return false;
    }
    all->leaf = grown;
    l->root = fret_pow(all->start + l->middle, -all->alpha);
    all->leaf[all->leaves++] = *l;
    return true;
}

/* A row that is wider than it is far from the start: in parts that are not. */
static bool add_wide(maker *m, size_t row, fret_real lo, fret_real hi, const leaf *above) {
    leaf here;
    bool ok = true;
    while (ok && lo < hi) {
        const fret_real end = hi < 2 * lo * MOST_WIDE ? hi : 2 * lo;
        make_field(m, row, lo, end, true, above, &here);
        here.more = end < hi;
        ok = add_leaf(m, &here);
        lo = end;
    }
    return ok;
}

static bool descend(maker *m, size_t first, size_t last, const leaf *above) {
    struct fret_leaves *all = m->all;
    const fret_real lo = fret_table_distance(all->table, first), hi = fret_table_distance(all->table, last);
    const bool wide = hi - lo > MOST_WIDE * lo;
    if (fret_stopped(m->normal))
        return false;
    leaf here = *above; /* as long as it is wide, of no use */
    if (!wide)
        make_field(m, first, lo, hi, last - first <= GOING_ON, above, &here);
    if (last - first > 1 && (wide || last - first > LEAF_ROWS)) {
        const size_t middle = first + (last - first) / 2;
        return descend(m, first, middle, &here) && descend(m, middle, last, &here);
    }
    for (size_t i = first; i < last; i++)
        all->leaf_of[i - all->first] = all->leaves;
    return wide ? add_wide(m, first, lo, hi, above) : add_leaf(m, &here);
}

fret_status fret_leaves_make(const fret_normal *n, size_t first, size_t count, fret_real e, bool slopes,
                             struct fret_leaves **out) {
    struct fret_leaves *all = calloc(1, sizeof *all);
    maker *m = calloc(1, sizeof *m);
    const struct fret_table *t = n->gap.table;
    *out = NULL;
    if (all) {
        *all = (struct fret_leaves){.table = t,
                                    .rule = &n->rule,
                                    .start = fret_table_start(t),
                                    .first = first,
                                    .count = count,
                                    .alpha = (n->rule.k - 1) / 2,
                                    .unit = e / sqrtl((fret_real)count),
                                    .near_unit = e / (fret_real)count,
                                    .many = count >= MANY,
                                    .slopes = slopes,
                                    .C = fret_normal_stiffness(n, 1)};
        all->unit_alpha = fret_pow(all->unit, all->alpha);
        all->from = least_near(all, first, first + count);
        all->leaf_of = malloc(count * sizeof *all->leaf_of);
        all->kink = malloc((first + count - all->from) * sizeof *all->kink);
    }
    fret_status st = fret_ok();
    if (m && all && all->leaf_of && all->kink) {
        const leaf none = {.near = 0, .half = 1};
        *m = (maker){.all = all, .normal = n};
        make_series(all);
        make_kinks(all);
        fret_chebyshev_make(&m->rule, WAVES, false);
        (void)descend(m, first, first + count, &none);
        st = fret_unless_stopped(n, m->failed);
    } else {
        st = fret_fail(FRET_NO_MEMORY, NULL, 0, 0);
    }
    free(m);
    if (st.code)
        fret_leaves_free(all);
    else
        *out = all;
    return st;
}

void fret_leaves_free(struct fret_leaves *all) {
    if (all) {
        free(all->kink);
        free(all->leaf_of);
        free(all->leaf);
    }
    free(all);
}
