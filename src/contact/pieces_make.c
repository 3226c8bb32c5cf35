/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Making the pieces: polynomials through Chebyshev's nodes, shorter pieces where one does not do, all held
 * against the profile itself. Allocates them. */
#include "contact/pieces.h"

#include <stdlib.h>
#include <string.h>

#include "contact/blocks.h"
#include "contact/check.h"
#include "contact/leaves.h"
#include "contact/piece.h"
#include "contact/table.h"
#include "number/array.h"
#include "number/chebyshev.h"
#include "number/real.h"

/* ---- polynomials through values ---------------------------------------------------------------- */

enum { FEWER = 14 };   /* of what is smooth across a row of a table */
enum { HALVINGS = 8 }; /* of a row */
enum { NOISE = 3 };    /* terms that tell it */

/* Returns how large the last terms are, relative to the largest; infinite where doubles would not do for
 * those that a polynomial keeps in them, smooth as it is asked to be. */
static fret_real fit(const fret_chebyshev *r, bool smooth, const fret_real *value, fret_real *c) {
    const int count = r->count;
    fret_real term[NODES], most = 0;
    fret_chebyshev_terms(r, value, term);
    fret_chebyshev_powers(r, term, count, c);
    for (int i = 0; i < count; i++)
        most = fmaxl(most, fabsl(term[i]));
    for (int j = HEAD; smooth && j < count; j++)
        if (fabsl(c[j]) > 2e-3L * most)
            return INFINITY;
    return fmaxl(fabsl(term[count - 2]), fabsl(term[count - 1])) / most;
}

/* Without the terms that are no larger than noise: than the last ones. */
static void fit_calmly(const fret_chebyshev *r, const fret_real *value, fret_real *c) {
    fret_real term[NODES], noise = 0;
    int count = NODES;
    fret_chebyshev_terms(r, value, term);
    for (int i = NODES - NOISE; i < NODES; i++)
        noise = fmaxl(noise, fabsl(term[i]));
    while (count > 2 && fabsl(term[count - 1]) <= 3 * noise)
        count--;
    fret_chebyshev_powers(r, term, count, c);
}

/* The integral of a polynomial of NODES terms, 0 at z = -1. */
static polynomial integral(const fret_real *c) {
    fret_real out[TERMS] = {0};
    for (int i = 0; i < NODES; i++)
        out[i + 1] = c[i] / (fret_real)(i + 1);
    for (int i = 1; i < TERMS; i++)
        out[0] -= i % 2 ? -out[i] : out[i];
    return fret_polynomial_of(out);
}

typedef struct maker {
    law *all;
    const fret_normal *normal;
    fret_real start, tolerance;
    fret_real borne, at_worst; /* errors of the law, relative, that may be left: as asked for, and where rows
                                * are too many and too rough for less */
    size_t each;               /* as many rows may be taken one by one */
    fret_chebyshev rule, row_rule;
    size_t spent, most; /* profiles asked for */
    fret_level edge;    /* outer end of the last piece */
    /* from one row of a table to the next: g' less its bend at the first, a polynomial in -1..1 of a part */
    bool by_row;
    struct fret_leaves *slopes;        /* of the rows that are covered one by one; or NULL: they are few */
    size_t index;                      /* in the table */
    unsigned char vain[2 << HALVINGS]; /* for how many rows not to try a part that was too long */
    fret_real row, middle, half, smooth[NODES]; /* FEWER terms */
    fret_status failed;
} maker;

enum { MOST_PROFILES = 140000, AGAIN = 8, MOST_ROWS = 2000, FEW_PROFILES = 12000 };
static const fret_real CALM = 1e-3L;    /* of what is borne: not worth a shorter piece */
static const fret_real FOUND = 1e-15L;  /* of the law, at the most, where nothing else is borne */
static const fret_real ENOUGH = 2e-15L; /* what CSV and JSON want */
static const fret_real ROUGH = 1e-8L;   /* the same of many rows, where they leave no less */

static fret_profile profile(maker *m, fret_real e) {
    m->spent++;
    return fret_gap_profile(&m->normal->gap, &m->normal->rule, e);
}

/* Of g' at e in a row what the kink at that row bends, and the others. */
static fret_real bend_at(const maker *m, fret_real e) {
    return m->slopes ? fret_leaves_bend(m->slopes, m->index, e).F
                     : fret_gap_bend(&m->normal->gap, &m->normal->rule, m->row, e);
}

static fret_real smooth_at(maker *m, fret_real e) {
    if (!m->slopes)
        return profile(m, e).slope - bend_at(m, e);
    m->spent++;
    return fret_leaves_before(m->slopes, m->index, e).F;
}

static fret_real slope_at(maker *m, fret_real e) {
    if (!m->by_row)
        return profile(m, e).slope;
    const fret_real z = ((e - m->row) - m->middle) / m->half;
    fret_real v = m->smooth[FEWER - 1];
    for (int i = FEWER - 1; i-- > 0;)
        v = v * z + m->smooth[i];
    return v + bend_at(m, e);
}

static fret_level level_at(maker *m, fret_real e) {
    const fret_profile p = profile(m, e);
    return (fret_level){p.g, fret_force_of(m->normal, &p)};
}

static fret_level level_in(const piece *p, fret_real z) {
    return (fret_level){p->inner.y + fret_polynomial_at(&p->rise[DEPTHS], z),
                        p->inner.F + fret_polynomial_at(&p->rise[LOADS], z)};
}

/* How far the law is off there, of F_N or of what it lacks to a straight line, of which all losses come; and
 * how far the depth alone. */
static fret_real missed_by(maker *m, fret_level found, fret_real e, bool of_bend, fret_real *deep) {
    const fret_level at = level_at(m, e);
    const fret_real K = fret_normal_stiffness(m->normal, m->start + e);
    *deep = fmaxl(*deep, fabsl(found.y / at.y - 1));
    return fabsl(found.F - at.F - K * (found.y - at.y)) / (of_bend ? fminl(K * at.y - at.F, at.F) : at.F);
}

/* dg/dz at the nodes. */
static void slopes_of(maker *m, const piece *p, fret_real *slope) {
    fret_real rate;
    for (int j = 0; j < NODES; j++) {
        const fret_real e = fret_piece_distance(p, m->rule.node[j], &rate);
        slope[j] = slope_at(m, e) * rate;
    }
}

/* F = K y + G, above the inner end. */
static polynomial load_of(const piece *p) {
    const polynomial *y = &p->rise[DEPTHS];
    polynomial F;
    for (int i = 0; i < HEAD; i++)
        F.head[i] = p->K_inner * y->head[i] + p->G.head[i];
    for (int i = 0; i < TAIL; i++)
        F.tail[i] = (double)p->K_inner * y->tail[i] + p->G.tail[i];
    return F;
}

/* Where a piece is held against the profile. */
enum { LOOKS = 5 };
static const fret_real looks[LOOKS] = {-0.91L, -0.5L, 0.29L, 0.83L, 1};

/* slope: dg/dz at the nodes; tolerance: of the last terms; borne: of the law. */
static bool make_piece(maker *m, piece *p, const fret_real *slope, fret_real tolerance, fret_real borne) {
    const fret_normal *n = m->normal;
    fret_real rise[NODES], bow[NODES], moment[NODES], c[TERMS] = {0}, rate, worst;
    for (int j = 0; j < NODES; j++) {
        const fret_real e = fret_piece_distance(p, m->rule.node[j], &rate), x = m->start + e;
        const fret_real K = fret_normal_stiffness(n, x);
        rise[j] = (1 + n->foundation.k) * K / x * rate;
        if (!(slope[j] > 0))
            return false;
    }
    worst = fit(&m->rule, !m->by_row, rise, c);
    p->dK = fret_polynomial_of(c);
    p->K = integral(c);
    worst = fmaxl(worst, fit(&m->rule, !m->by_row, slope, c));
    p->rise[DEPTHS] = integral(c);
    for (int j = 0; j < NODES; j++)
        bow[j] = slope[j] * fret_polynomial_at(&p->K, m->rule.node[j]);
    worst = fmaxl(worst, fit(&m->rule, !m->by_row, bow, c));
    p->G = integral(c);
    for (int j = 0; j < NODES; j++) {
        const fret_real z = m->rule.node[j];
        moment[j] = slope[j] * (fret_polynomial_at(&p->rise[DEPTHS], z) * fret_polynomial_at(&p->K, z) -
                                fret_polynomial_at(&p->G, z));
    }
    if (!(fit(&m->rule, !m->by_row, moment, c) <= tolerance / 10))
        return false;
    p->L = integral(c);
    if (!(worst <= tolerance))
        return false;
    fret_real deep = 0;
    worst = 0;
    p->inner = m->edge;
    p->K_inner = fret_normal_stiffness(n, m->start + fret_piece_distance(p, -1, &rate));
    /* from end to end without a jump: differences of sums stay exact; what adds up is held against the
     * profile */
    p->rise[LOADS] = load_of(p);
    p->outer = level_in(p, 1);
    for (int i = 0; i < LOOKS && !m->by_row; i++) {
        const fret_real e = fret_piece_distance(p, looks[i], &rate);
        worst = fmaxl(worst, missed_by(m, level_in(p, looks[i]), e, isinf(tolerance), &deep));
    }
    if (!fret_gap_sampled(&n->gap)) /* else the law is what counts */
        worst = fmaxl(worst, deep);
    const fret_real rough = fret_piece_make_whole(p);
    if (!(worst <= borne && rough <= fmaxl(1e-12L, 100 * borne))) /* in halves 2^-16 of it is left */
        return false;
    p->coarse = rough > 1e-17L;
    fret_real z[GUESS];
    for (int i = 0; i < GUESS; i++)
        z[i] = m->rule.node[(2 * i + 1) * NODES / (2 * GUESS)];
    for (int i = DEPTHS; i <= LOADS; i++)
        fret_piece_make_guess(p, i, z);
    m->all->error = fmaxl(m->all->error, worst);
    m->all->deep = fmaxl(m->all->deep, deep);
    return true;
}

static bool add(maker *m, const piece *p) {
    law *all = m->all;
    piece *grown = fret_array_for(all->piece, &all->room, all->count + 1, sizeof *grown);
    if (!grown) {
        m->failed = fret_fail(FRET_NO_MEMORY, NULL, 0, 0);
        return false;
    }
    all->piece = grown;
    all->piece[all->count++] = *p;
    m->edge = p->outer;
    return true;
}

/* From s = lo to hi of a map, in halves where one piece does not do; part 1 has halves 2 and 3, and so on. */
static bool cover(maker *m, fret_real origin, fret_real width, fret_real lo, fret_real hi, int halvings,
                  size_t part) {
    piece p = {.origin = origin,
               .width = width,
               .middle = (lo + hi) / 2,
               .half = (hi - lo) / 2,
               .blunt = width > 0 && lo == 0};
    if (fret_stopped(m->normal) || m->spent > m->most)
        return false;
    if (halvings == 0 || m->vain[part] == 0) {
        fret_real slope[NODES];
        slopes_of(m, &p, slope);
        if (make_piece(m, &p, slope, m->tolerance, FOUND))
            return add(m, &p);
        m->vain[part] = AGAIN;
    }
    m->vain[part]--;
    return halvings > 0 && cover(m, origin, width, lo, p.middle, halvings - 1, 2 * part) &&
           cover(m, origin, width, p.middle, hi, halvings - 1, 2 * part + 1);
}

/* Each piece twice as long as the last, as far as that does. */
static bool cover_smooth(maker *m, fret_real from, fret_real to) {
    fret_real lo = logl(from), length = 0.4L, most = 2;
    const fret_real hi = logl(to);
    while (lo < hi) {
        const fret_real end = hi - lo < 1.3L * length ? hi : lo + length;
        if (cover(m, 0, 0, lo, end, 0, 1)) {
            lo = end;
            length = fminl(2 * length, most);
        } else if (length > 0.01L) {
            length /= 2;
            most = length;
        } else {
            return false;
        }
    }
    return true;
}

/* From the kink at `row` on, lo to hi of the way to the next, which is `way`. */
static bool cover_row(maker *m, fret_real row, fret_real way, fret_real lo, fret_real hi, int halvings) {
    fret_real value[FEWER];
    m->row = row;
    m->middle = way * (lo + hi) / 2;
    m->half = way * (hi - lo) / 2;
    for (int j = 0; j < FEWER; j++) {
        const fret_real e = row + (m->middle + m->half * m->row_rule.node[j]);
        value[j] = smooth_at(m, e);
    }
    const fret_real last = fit(&m->row_rule, false, value, m->smooth);
    if (last <= 20 * m->tolerance) { /* of thin slices; of y less by the way to e */
        m->by_row = true;
        bool ok = cover(m, row, way, sqrtl(sqrtl(lo)), sqrtl(sqrtl(hi)), HALVINGS, 1);
        m->by_row = false;
        if (!ok)
            return false;
        const fret_real error = missed_by(m, m->edge, row + way * hi, false, &m->all->deep);
        m->all->error = fmaxl(m->all->error, error);
        return error <= 2 * FOUND;
    }
    return halvings > 0 && cover_row(m, row, way, lo, (lo + hi) / 2, halvings - 1) &&
           cover_row(m, row, way, (lo + hi) / 2, hi, halvings - 1);
}

/* Rows first .. last of a table as they look together. What rounding or a reading leaves of a row is noise
 * that a shorter stretch is not rid of. The law F_N(delta) of a gap hangs on M = int g dK alone, M = K g -
 * F_N, to first order, and of M noise leaves far less than of g: so a polynomial M it is, and g what follows.
 */
typedef struct span {
    size_t first, last;
    piece p;                      /* the stretch alone */
    fret_real slope[NODES], rest; /* dg/dz at the nodes; how large the last terms are of their polynomial */
    fret_real deficit[NODES], error; /* the polynomial of M, and how far it is off between nodes */
} span;

/* K g - F_N, and F_N */
static fret_real deficit(maker *m, fret_real e, fret_profile *at, fret_real *F) {
    *at = profile(m, e);
    *F = fret_force_of(m->normal, at);
    return fret_normal_stiffness(m->normal, m->start + e) * at->g - *F;
}

static fret_real value_of(const fret_real *c, fret_real z) {
    fret_real v = 0;
    for (int i = NODES; i-- > 0;)
        v = v * z + c[i];
    return v;
}

static fret_real rate_of(const fret_real *c, fret_real z) {
    fret_real v = 0;
    for (int i = NODES - 1; i > 0; i--)
        v = v * z + c[i] * (fret_real)i;
    return v;
}

static span look(maker *m, const fret_real *row, size_t first, size_t last) {
    const fret_real lo = logl(row[first]), hi = logl(row[last]);
    span s = {.first = first, .last = last, .p = {.middle = (lo + hi) / 2, .half = (hi - lo) / 2}};
    fret_real value[NODES], rate, F;
    fret_profile at;
    for (int j = 0; j < NODES; j++) {
        value[j] = deficit(m, fret_piece_distance(&s.p, m->rule.node[j], &rate), &at, &F);
        s.slope[j] = at.slope * rate;
    }
    s.rest = fit(&m->rule, true, s.slope, s.deficit);
    fit_calmly(&m->rule, value, s.deficit);
    for (int i = 5; i < NODES; i += 5) {
        const fret_real z = m->rule.wave[2 * i], M = deficit(m, fret_piece_distance(&s.p, z, &rate), &at, &F);
        s.error = fmaxl(s.error, fabsl(value_of(s.deficit, z) - M) / fminl(M, F));
    }
    return s;
}

/* As exact as pieces are. */
static bool add_exact(maker *m, span *s) {
    return s->rest <= m->tolerance && make_piece(m, &s->p, s->slope, m->tolerance, FOUND) && add(m, &s->p);
}

/* dK/dz */
static fret_real stiffening(maker *m, const piece *p, fret_real z) {
    fret_real rate;
    const fret_real x = m->start + fret_piece_distance(p, z, &rate);
    return (1 + m->normal->foundation.k) * fret_normal_stiffness(m->normal, x) / x * rate;
}

/* By the polynomial M, led on from the last piece without a jump of g and F_N: by what is 1 at z = -1, or
 * rises with 1 there, and next to nothing elsewhere. */
static bool add_calm(maker *m, span *s, fret_real borne) {
    enum { WAVES = NODES / 4 };
    static const fret_real fall = (4 * WAVES * WAVES - 1) / 3.0L;
    if (!(s->error <= borne))
        return false;
    fret_real M[NODES], g[NODES], slope[NODES], c[NODES], unused;
    const fret_real e = fret_piece_distance(&s->p, -1, &unused),
                    K = fret_normal_stiffness(m->normal, m->start + e);
    const fret_real jump = K * m->edge.y - m->edge.F - value_of(s->deficit, -1),
                    bend = stiffening(m, &s->p, -1) * m->edge.y - rate_of(s->deficit, -1);
    for (int j = 0; j < NODES; j++) {
        const fret_real z = m->rule.node[j], from = 1 + z,
                        wave = m->rule.wave[(WAVES * (2 * j + 1) + 3 * NODES) % (4 * NODES)] / (2 * WAVES),
                        near = 2 * wave * wave / from;
        M[j] = value_of(s->deficit, z) + near * near * (jump * (1 + fall * from) + bend * from);
    }
    (void)fit(&m->rule, false, M, c);
    for (int j = 0; j < NODES; j++)
        g[j] = rate_of(c, m->rule.node[j]) / stiffening(m, &s->p, m->rule.node[j]);
    (void)fit(&m->rule, false, g, c);
    for (int j = 0; j < NODES; j++)
        slope[j] = rate_of(c, m->rule.node[j]);
    return make_piece(m, &s->p, slope, INFINITY, borne) && add(m, &s->p);
}

/* One by one. */
static bool cover_each(maker *m, const fret_real *row, size_t first, size_t last) {
    enum { FEW = 4 };
    if (m->spent + (last - first) * FEWER > m->most)
        return false;
    const struct fret_table *t = m->normal->gap.table;
    const size_t index = fret_table_row(t, row[first]), end = fret_table_row(t, row[last]);
    if (last - first >= FEW)
        m->failed =
            fret_leaves_make(m->normal, index, end - index + (fret_table_distance(t, end) < row[last]),
                             row[last], true, &m->slopes);
    bool ok = !m->failed.code;
    memset(m->vain, 0, sizeof m->vain);
    for (size_t i = first; ok && i < last; i++) {
        m->index = index + (i - first);
        ok = cover_row(m, row[i], row[i + 1] - row[i], 0, 1, 6);
    }
    fret_leaves_free(m->slopes);
    m->slopes = NULL;
    return ok;
}

/* Row by row, or not at all. */
static bool add_each(maker *m, const fret_real *row, size_t first, size_t last) {
    const size_t count = m->all->count;
    const fret_real error = m->all->error, deep = m->all->deep;
    const fret_level edge = m->edge;
    if (last - first <= m->each && cover_each(m, row, first, last))
        return true;
    m->all->count = count;
    m->all->error = error;
    m->all->deep = deep;
    m->edge = edge;
    return false;
}

/* In one piece, in halves where these are smoother, or row by row. */
static bool cover_span(maker *m, const fret_real *row, span *s) {
    enum { FEW = 8 };
    const size_t first = s->first, last = s->last, middle = first + (last - first) / 2;
    if (fret_stopped(m->normal) || m->spent > m->most)
        return false;
    if (add_exact(m, s) || (s->error <= CALM * m->borne && add_calm(m, s, m->borne)))
        return true;
    if (last - first >= 2 * FEW) {
        span inner = look(m, row, first, middle), outer = look(m, row, middle, last);
        if (fminl(inner.error, outer.error) <= s->error / 8)
            return cover_span(m, row, &inner) && cover_span(m, row, &outer);
    }
    return add_calm(m, s, m->borne) || add_each(m, row, first, last) || add_calm(m, s, m->at_worst);
}

/* From one row of a table to another. row: distances. */
static bool cover_rows(maker *m, const fret_real *row, size_t first, size_t last) {
    enum { FEW = 8 };
    const fret_real wide = 4;
    const size_t middle = first + (last - first) / 2;
    if (last - first < FEW && add_each(m, row, first, last))
        return true;
    if (last - first >= FEW && row[last] >= wide * row[first])
        return cover_rows(m, row, first, middle) && cover_rows(m, row, middle, last);
    span s = look(m, row, first, last);
    return last - first < FEW ? add_calm(m, &s, m->at_worst) : cover_span(m, row, &s);
}

/* Row by row, beyond the pieces there are; false: not good enough. */
static bool by_rows(maker *m, fret_real to, bool at_once) {
    law *all = m->all;
    fret_real off = 0;
    m->failed = fret_blocks_make(m->normal, to, at_once, ENOUGH, &all->rows, &off);
    if (!m->failed.code && all->rows && off <= ENOUGH) {
        all->error = fmaxl(all->error, off);
        return true;
    }
    fret_blocks_free(all->rows);
    all->rows = NULL;
    return false;
}

/* From the first row of a table on: exactly row by row where they are not too many for that, else by
 * polynomials, or where these do not do. */
static bool cover_beyond(maker *m, const fret_real *row, size_t count, fret_real to) {
    law *all = m->all;
    const size_t base = all->count;
    const fret_level edge = m->edge;
    const fret_real error = all->error, deep = all->deep;
    const fret_real at_worst = m->at_worst;
    const bool exact = m->borne <= ENOUGH, at_once = exact && count <= MOST_ROWS;
    if (at_once && by_rows(m, to, true))
        return true;
    if (m->failed.code)
        return false;
    if (!at_once) /* where more would be left, rows are better */
        m->at_worst = fminl(at_worst, fmaxl(m->borne, ENOUGH));
    const bool ok = cover_rows(m, row, 0, count - 1);
    m->at_worst = at_worst;
    if (m->failed.code || fret_stopped(m->normal) || at_once || ok)
        return ok;
    all->count = base;
    all->error = error;
    all->deep = deep;
    m->edge = edge;
    return by_rows(m, to, false) || (!m->failed.code && cover_rows(m, row, 0, count - 1));
}

/* Rows between two distances, both ends too. */
static bool cover_table(maker *m, fret_real from, fret_real to) {
    const struct fret_table *t = m->normal->gap.table;
    const size_t first = fret_table_row(t, from) + 1, last = fret_table_row(t, to),
                 count = last - first + 1 + (fret_table_distance(t, last) < to);
    fret_real *row = malloc((count + 1) * sizeof *row);
    if (!row) {
        m->failed = fret_fail(FRET_NO_MEMORY, NULL, 0, 0);
        return false;
    }
    row[0] = from;
    for (size_t i = 1; i < count; i++)
        row[i] = fret_table_distance(t, first + i - 1);
    row[count] = to;
    m->each = count > MOST_PROFILES / FEWER ? 64 : count;
    m->most = m->borne <= ENOUGH && count > MOST_ROWS ? FEW_PROFILES : MOST_PROFILES;
    m->at_worst = count > 1000 ? fmaxl(m->borne, ROUGH) : m->borne;
    const bool ok = cover_smooth(m, from, row[1]) && (count == 1 || cover_beyond(m, row + 1, count, to));
    free(row);
    return ok;
}

/* ---- making ------------------------------------------------------------------------------------ */

static bool make_runs(maker *m) {
    law *all = m->all;
    all->reach = malloc(3 * all->count * sizeof *all->reach);
    bool ok = all->reach != NULL;
    for (int l = 0; ok && all->count >> l; l++) {
        const size_t count = all->count >> l;
        all->run[l] = malloc(count * sizeof *all->run[l]);
        ok = all->run[l] != NULL;
        for (size_t i = 0; ok && i < count; i++)
            if (l > 0)
                all->run[l][i] = fret_stretch_join(&all->run[l - 1][2 * i + 1], &all->run[l - 1][2 * i]);
            else
                all->run[0][i] = all->piece[i].whole;
    }
    if (!ok)
        m->failed = fret_fail(FRET_NO_MEMORY, NULL, 0, 0);
    for (size_t i = 0; ok && i < all->count; i++) {
        fret_real unused;
        all->reach[i] = fret_piece_distance(&all->piece[i], 1, &unused);
        all->reach[all->count + i] = all->piece[i].outer.y;
        all->reach[2 * all->count + i] = all->piece[i].outer.F;
    }
    return ok;
}

static bool make_core(maker *m) {
    law *all = m->all;
    const fret_normal *n = m->normal;
    const fret_slice core = fret_law_slice(n, &all->least, all->least.y);
    fret_real K = fret_normal_stiffness(n, m->start + all->from);
    if (m->start > 0) /* it grows from that of the flat end by little */
        K = fret_normal_stiffness(n, m->start) * expm1l((1 + n->foundation.k) * log1pl(all->from / m->start));
    all->start = m->start;
    all->K_start = fret_normal_stiffness(n, m->start);
    all->core = (stretch){all->least.y, K, core.G, core.L};
    fret_real sum[2] = {all->least.y * all->least.F - core.J, core.J};
    for (size_t i = 0; i < all->count; i++) {
        piece *p = &all->piece[i];
        for (int by = DEPTHS; by <= LOADS; by++)
            p->sum[by] = sum[by];
        fret_real work[2];
        const fret_level rise = fret_piece_work(p, 1, work);
        sum[DEPTHS] += p->inner.y * rise.F + work[DEPTHS];
        sum[LOADS] += p->inner.F * rise.y + work[LOADS];
    }
    return isfinite(core.L);
}

static void free_law(law *all) {
    for (int l = 0; l < RUNS; l++)
        free(all->run[l]);
    fret_blocks_free(all->rows);
    fret_blocks_free(all->thin);
    free(all->reach);
    free(all->piece);
    free(all);
}

/* An error of the law of the whole is as much more of a slice as the square of its part. */
static bool make_thin(maker *m, fret_real e) {
    static const fret_real THIN = 5e-3L; /* as text thicker ones have digits enough */
    law *all = m->all;
    const bool exact = m->borne <= ENOUGH;
    if (!fret_gap_sampled(&m->normal->gap) || all->rows || all->deep <= FOUND)
        return true;
    all->enough = exact ? sqrtl(all->error / ENOUGH) : fminl(THIN, sqrtl(all->error / (10 * m->borne)));
    m->failed = fret_blocks_make(m->normal, e, false, 0, &all->thin, NULL);
    return !m->failed.code;
}

static fret_status make_pieces(const fret_normal *n, fret_real e, fret_real borne, struct fret_pieces **out) {
    const bool rows = fret_gap_sampled(&n->gap);
    struct fret_pieces *pieces = malloc(sizeof *pieces);
    law *all = calloc(1, sizeof *all);
    maker *m = calloc(1, sizeof *m);
    *out = NULL;
    if (!pieces || !all || !m) {
        free(pieces);
        free(all);
        free(m);
        return fret_fail(FRET_NO_MEMORY, NULL, 0, 0);
    }
    atomic_init(&all->users, 1);
    *pieces = (struct fret_pieces){all, 1, n->stop};
    *m = (maker){.all = all,
                 .normal = n,
                 .start = fret_gap_start(&n->gap),
                 .tolerance = rows ? 1e-15L : 2e-17L,
                 .most = MOST_PROFILES,
                 .borne = fmaxl(borne, FOUND)};
    fret_chebyshev_make(&m->rule, NODES, false);
    fret_chebyshev_make(&m->row_rule, FEWER, false);
    all->from = (m->start > 0 ? 1e-12L : 1e-5L) * e;
    m->edge = all->least = level_at(m, all->from);
    const bool ok = (rows ? cover_table : cover_smooth)(m, all->from, e) && make_core(m) && make_runs(m) &&
                    make_thin(m, e);
    fret_status st = m->failed;
    if (!st.code)
        st = fret_unless_stopped(n, st);
    free(m);
    if (ok && !st.code)
        *out = pieces;
    else
        fret_pieces_free(pieces);
    return st;
}

void fret_pieces_stop(struct fret_pieces *pieces, fret_stop stop) {
    pieces->stop = stop;
}

void fret_pieces_free(struct fret_pieces *pieces) {
    if (pieces && atomic_fetch_sub(&pieces->law->users, 1) == 1)
        free_law(pieces->law);
    free(pieces);
}

/* Up to the next power of two, so that what comes out does not depend on what was asked before; where that is
 * more than the gap carries, up to its end. */
fret_status fret_normal_prepare(fret_normal *n, double F, double error) {
    fret_status st = fret_check_positive("FN", F);
    if (!st.code)
        st = fret_check_not_negative("error", error);
    int exponent;
    (void)frexp(F, &exponent);
    const double most = ldexp(1, exponent);
    const bool reach = most == n->prepared || (n->shared && F <= n->prepared);
    if (st.code || fret_normal_closed(n) || (reach && error == n->borne))
        return st;
    struct fret_pieces *made = NULL;
    fret_pieces_free(n->pieces);
    n->pieces = NULL;
    n->prepared = 0;
    n->shared = false;
    n->borne = error;
    fret_real e = fret_search_radius(n, true, most);
    if (!isfinite(e) && isfinite(n->end)) /* not where g begins to fall: there it is no inverse */
        e = (n->falls ? 0.99L : 1) * (n->end - fret_gap_start(&n->gap));
    if (isfinite(e) &&
        1e-12L * e > 0) /* not where it does not reach beyond a flat end: no piece begins there */
        st = make_pieces(n, e, n->borne, &made);
    n->pieces = made;
    if (!st.code)
        n->prepared = most;
    return st;
}

bool fret_pieces_rough(const struct fret_pieces *pieces, double borne) {
    return pieces->law->deep > fmaxl(FOUND, borne);
}

double fret_normal_prepared(const fret_normal *n) {
    return n->pieces ? (double)n->pieces->law->error : NAN;
}
