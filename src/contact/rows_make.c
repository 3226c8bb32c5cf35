/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Makes rows: depth and load above the beginning of a row as polynomials, and what its kink adds; of every
 * row its integrals, and of runs of rows. Allocates them, and frees them. */
#include <stdlib.h>

#include "contact/check.h"
#include "contact/leaves.h"
#include "contact/row_parts.h"
#include "contact/rows.h"
#include "contact/table.h"
#include "number/array.h"
#include "number/chebyshev.h"
#include "number/real.h"

enum { WAVES = FRET_CHEBYSHEV, RULES = 4 };
static const int nodes_of[RULES] = {8, 12, 16, WAVES};

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
    for (int j = 0; j < ROW_BINOMIALS; j++) {
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
        return expm1l(all->m * log1pl(z)) / (all->m * z);
    fret_real sum = 0;
    for (int j = ROW_BINOMIALS; j-- > 0;)
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
        all->run[0][i] = fret_rows_whole(all, i);
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
        const size_t j = (size_t)((double)all->count * (i + 0.5) / (double)LOOKS);
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
