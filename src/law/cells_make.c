/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Makes and scales the cells: one for a sum of powers, as many as polynomials need for other shapes, at least
 * one a row for a sampled gap. Allocates them, and frees them. */
#include <float.h>
#include <stdlib.h>
#include <string.h>

#include "law/cells.h"
#include "law/check.h"
#include "law/transform.h"
#include "number/array.h"
#include "number/real.h"
#include "number/root.h"

typedef struct maker {
    fret_cells *all;
    const fret_gap *gap;
    fret_real m, start, end;     /* where the cells of this gap begin and end */
    fret_real summit, at_summit; /* the largest depth so far, and its radius */
    fret_transform *rows;        /* sampled gap: its transform */
    size_t row, last;            /* the row of the cell; the row whose smooth continuation it adds to */
    fret_chebyshev nodes;
    fret_stop stop;
    fret_status failed;
} maker;

static fret_cell *last_of(const maker *m) {
    return &m->all->cell[m->all->count - 1];
}

/* Appends a cell, which begins where the last one ends. */
static fret_cell *new_cell(maker *mk, fret_real x) {
    fret_cells *all = mk->all;
    if (!fret_array_room(&all->cell, &all->room, all->count + 1, sizeof *all->cell)) {
        mk->failed = fret_fail(FRET_NO_MEMORY, NULL, 0, 0);
        return NULL;
    }
    fret_cell *c = &all->cell[all->count++];
    *c = (fret_cell){.x = x, .m = mk->m, .mu = 1, .K = x > 0 ? fret_pow(x, 2 * mk->m) : 0};
    if (all->count > 1) {
        c->y = c[-1].y + c[-1].rise[BY_DEPTH];
        c->F = c[-1].F + c[-1].rise[BY_LOAD];
    }
    return c;
}

/* g at the distance e beyond x0, where the row begins, without the kink at x0. */
static fret_real smooth_at(const maker *mk, fret_real x0, fret_real e) {
    if (mk->rows)
        return fret_transform_at(mk->rows, mk->last, mk->row, e);
    return fret_gap_profile(mk->gap, &mk->all->rule, (x0 - mk->start) + e).g;
}

/* The part of g that the kink adds. */
static fret_real kink_at(const maker *mk, fret_real e) {
    return mk->rows ? fret_transform_jump(mk->rows, mk->row, e)
                    : fret_gap_profile(mk->gap, &mk->all->rule, e).g;
}

/* The beginning of a cell, `at` in x^2 beyond the radius x0; kink: at a kink, first: with nothing else. */
typedef struct beginning {
    fret_real x0, at;
    bool kink, first;
} beginning;

static fret_real distance_of(const beginning *p, fret_real v) {
    const fret_real more = p->at + v;
    return more / (p->x0 + sqrtl(p->x0 * p->x0 + more));
}

/* Fits the depth. error: the last terms, relative to depth. */
static bool fit_cell(maker *mk, const beginning *p, fret_cell *c, fret_real width, fret_real *error) {
    enum { N = FRET_CELL_TERMS };
    static const fret_real LITTLE = 2e-19L, ENOUGH = 1e-18L;
    const fret_chebyshev *nodes = &mk->nodes;
    fret_real value[N], terms[N], tail[2] = {0, 0}, top = c->y;
    c->width = width;
    if (!p->first) {
        for (int j = 0; j < nodes->count; j++) {
            value[j] = smooth_at(mk, p->x0, distance_of(p, width * nodes->node[j])) - c->y;
            top = fmaxl(top, c->y + value[j]);
        }
        const int count = fret_cell_fit(nodes, value, LITTLE * top, terms, &tail[0]);
        c->count[RISE] = (unsigned char)(count > 1 ? count - 1 : 0);
        memcpy(c->of[RISE], terms + 1, c->count[RISE] * sizeof *terms);
    }
    if (p->kink) {
        c->q = mk->m + (fret_gap_sharp(mk->gap) ? 0 : 1);
        for (int j = 0; j < nodes->count; j++) {
            value[j] = kink_at(mk, distance_of(p, width * nodes->node[j])) / fret_pow(nodes->node[j], c->q);
            top = fmaxl(top, fabsl(value[j]));
        }
        c->count[RISE_Q] = (unsigned char)fret_cell_fit(nodes, value, LITTLE * top, c->of[RISE_Q], &tail[1]);
    }
    *error = fmaxl(tail[0], tail[1]) / top;
    return *error <= ENOUGH;
}

/* The radius after x, within 1 % of the table, where g exceeds g(x); 0 if it stays below. */
static fret_real risen(const maker *mk, fret_real x) {
    const fret_gap *gap = mk->gap;
    const fret_real whole = fret_gap_end(gap) - mk->start, e = x - mk->start,
                    g = fret_gap_profile(gap, &mk->all->rule, e).g;
    for (int i = 1; i <= 4; i++) {
        const fret_real next = e + whole * (fret_real)i / 400;
        if (next <= whole && fret_gap_profile(gap, &mk->all->rule, next).g > g)
            return mk->start + next;
    }
    return 0;
}

/* True if depth grows over the cell; a fall by the noise of rows is ignored. */
static bool grows(maker *mk, const fret_cell *c) {
    static const fret_real NOISE = 1e-8L;
    enum { LOOKS = 8 };
    for (int i = 1; i <= LOOKS && mk->rows; i++) {
        const fret_real s = (fret_real)i / (fret_real)LOOKS, y = c->y + fret_cell_rise(c, BY_DEPTH, s);
        if (y < mk->summit * (1 - NOISE)) {
            mk->failed =
                fret_fail(FRET_NOT_MONOTONE, "r", (double)mk->at_summit, (double)risen(mk, mk->at_summit));
            return false;
        }
        if (y > mk->summit) {
            mk->summit = y;
            mk->at_summit = fret_cell_radius(c, s);
        }
    }
    return true;
}

/* Makes cells from x0 on, over `whole` in x^2, at first `width` wide: halved until the polynomials fit. */
static bool add_cells(maker *mk, fret_real x0, fret_real whole, fret_real width, bool kink, bool first) {
    static const fret_real NARROW = 1.0L / 64, WHOLE = 1.2L;
    const fret_real least = NARROW * fminl(width, whole);
    for (fret_real at = 0; at < whole;) {
        const beginning p = {x0, at, kink && at == 0, first && at == 0};
        fret_cell *c = new_cell(mk, at > 0 ? sqrtl(x0 * x0 + at) : x0);
        fret_real error, wide = WHOLE * width > whole - at ? whole - at : width;
        if (!c || (mk->stop && *mk->stop))
            return false;
        for (bool fits = false; !fits;) {
            fits = fit_cell(mk, &p, c, wide, &error);
            fits = (int)fret_cell_complete(c, &mk->nodes) & (int)fits;
            if (fits || wide <= 2 * least)
                break;
            wide /= 2;
        }
        mk->all->error = fmaxl(mk->all->error, error);
        if (!grows(mk, c))
            return false;
        at += wide;
        width = wide * (at < 2 * wide ? 1 : 2);
        mk->last = mk->row;
    }
    return true;
}

/* A cell of powers of x/x0, from x0 on or from the centre. */
static bool add_powers(maker *mk, const fret_term *term, int count, fret_real x0, bool from_centre) {
    fret_cell *c = new_cell(mk, x0);
    if (!c)
        return false;
    c->powers = true;
    c->K_at_1 = c->K;
    c->begin = from_centre ? 0 : 1;
    c->K = from_centre ? 0 : c->K_at_1;
    c->width = c->rise[BY_DEPTH] = c->rise[BY_LOAD] = (fret_real)INFINITY;
    c->count[RISE] = (unsigned char)count;
    for (int i = 0; i < count; i++) {
        c->of[RISE][i] = term[i].G;
        c->of[RISE_Q][i] = term[i].n;
    }
    if (isfinite(mk->end)) { /* at x0 */
        c->width = 1;
        for (int by = BY_DEPTH; by <= BY_LOAD; by++)
            c->rise[by] = fret_cell_rise(c, by, 1);
    }
    return true;
}

/* The cell at the centre, of integer powers of the radius: x^2i becomes s^i, odd powers s^(i+1/2). */
static bool add_centre(maker *mk, const fret_term *term, int count, fret_real x) {
    fret_cell *c = new_cell(mk, 0);
    if (!c)
        return false;
    c->width = x * x;
    c->q = 0.5L;
    c->mu = mk->m;
    for (int i = 0; i < count; i++) {
        const int n = (int)term[i].n, series = n % 2 ? RISE_Q : RISE, j = (n - 1) / 2;
        c->of[series][j] += term[i].G;
        c->count[series] = (unsigned char)(j + 1 > c->count[series] ? j + 1 : c->count[series]);
    }
    (void)fret_cell_complete(c, &mk->nodes);
    return true;
}

/* ---- shapes ------------------------------------------------------------------------------------ */

static fret_real rate_there(fret_real s, fret_real *slope, void *context) {
    (void)slope;
    return fret_cell_rate(context, BY_DEPTH, s);
}

/* Finds where a sum of powers with a negative term begins to fall, in logarithmic steps of the radius. */
static bool find_fall(maker *mk) {
    static const fret_real FIRST = 1e-12L, SPAN = 1e18L;
    enum { LOOKS = 400 };
    fret_cell *c = last_of(mk);
    fret_real lo = 0;
    for (int i = 1; i <= LOOKS; i++) {
        fret_real hi = FIRST * fret_pow(SPAN, (fret_real)i / (fret_real)LOOKS) / c->x;
        if (fret_cell_rate(c, BY_DEPTH, hi) >= 0) {
            lo = hi;
            continue;
        }
        if (i == 1) {
            mk->failed = fret_fail(FRET_NOT_MONOTONE, "r", 0, 0);
            return false;
        }
        c->width = fret_root(rate_there, c, lo, hi, lo);
        mk->all->end = c->width * c->x;
        mk->all->falls = true;
        return true;
    }
    return true;
}

static bool make_sum(maker *mk) {
    const fret_power *power = mk->gap->power;
    fret_term term[FRET_MOST_TERMS];
    const bool ends = isfinite(mk->end);
    bool may_fall = false;
    for (int i = 0; i < fret_gap_powers(mk->gap); i++)
        may_fall |= power[i].h < 0;
    const fret_real x0 = ends ? mk->end : power[0].r0;
    const int count = fret_gap_series(mk->gap, &mk->all->rule, x0, term);
    return add_powers(mk, term, count, x0, true) && (ends || !may_fall || find_fall(mk));
}

/* A flat punch: g jumps at its edge, the place of every depth. The cell has no width. */
static bool make_punch(maker *mk) {
    fret_cell *c = new_cell(mk, mk->start);
    if (c)
        c->rise[BY_DEPTH] = c->rise[BY_LOAD] = (fret_real)INFINITY;
    return c;
}

/* From this many radii of the flat end on its series of powers has converged. */
static const fret_real FAR = 8;

static bool make_flat(maker *mk) {
    const bool ends = isfinite(mk->end);
    const fret_real b = mk->start, far = ends ? mk->end : FAR * b;
    fret_term term[FRET_MOST_TERMS];
    return add_cells(mk, b, (far - b) * (far + b), b * b / 2, true, true) &&
           (ends || add_powers(mk, term, fret_gap_far(mk->gap, &mk->all->rule, far, term), far, false));
}

/* Up to this part of the largest radius the series of a sphere, in (r/R)^2, has converged. */
static bool make_sphere(maker *mk) {
    static const fret_real NEAR = 0.3L;
    const fret_real end = mk->end, x = fminl(NEAR * fret_gap_end(mk->gap), end);
    fret_term term[FRET_MOST_TERMS];
    const int count = fret_gap_series(mk->gap, &mk->all->rule, x, term);
    return add_centre(mk, term, count < FRET_CELL_TERMS ? count : FRET_CELL_TERMS, x) &&
           add_cells(mk, x, (end - x) * (end + x), x * x, false, false);
}

static bool make_rows(maker *mk) {
    const struct fret_table *t = mk->gap->table;
    fret_term term[FRET_MOST_TERMS];
    const size_t first = fret_table_row(t, 0), last = fret_table_row_count(t, fret_table_end(t)) - 1;
    fret_real before = 0; /* radius where the last row begins */
    mk->failed = fret_transform_make(t, &mk->all->rule, mk->stop, &mk->rows);
    for (size_t i = first; i < last && mk->start + fret_table_distance(t, i) < mk->end && !mk->failed.code;
         i++) {
        const fret_real x = mk->start + fret_table_distance(t, i),
                        end = fminl(mk->start + fret_table_distance(t, i + 1), mk->end),
                        whole = (end - x) * (end + x), away = i > first ? (x - before) * (x + before) : x * x;
        before = x;
        mk->row = i;
        mk->last = i > first ? i - 1 : i;
        if (x > 0) {
            if (!add_cells(mk, x, whole, i > first ? away : away / 2, true, i == first))
                return false;
        } else if (!add_centre(mk, term, fret_gap_series(mk->gap, &mk->all->rule, end, term), end)) {
            return false;
        } else if (!grows(mk, last_of(mk))) {
            return false;
        }
    }
    return !mk->failed.code;
}

/* From the radius x on, by the rows of g, which are cubics already, in parts over which K is a polynomial. */
static bool make_worn(maker *mk, const struct fret_worn *w, fret_real x) {
    const fret_real last = fminl((mk->end - w->inner) * (mk->end + w->inner), fret_table_end(w->g));
    fret_real at = (x - w->inner) * (x + w->inner), slope[3];
    for (size_t i = fret_table_row_count(w->g, at) - 1; at < last;) {
        const fret_real d = at - fret_table_distance(w->g, i),
                        end = fminl(fret_table_distance(w->g, i + 1), last);
        const bool part = x > 0 && x * x / 2 < end - at;
        const fret_real width = part ? x * x / 2 : end - at;
        if (mk->stop && *mk->stop)
            return false;
        if (x > 0) {
            fret_cell *c = new_cell(mk, x);
            if (!c)
                return false;
            fret_table_slope(w->g, i, slope);
            c->width = width;
            c->count[RISE] = 3;
            c->of[RISE][0] = width * (slope[0] + d * (slope[1] + d * slope[2]) + w->lift);
            c->of[RISE][1] = width * width * (slope[1] / 2 + d * slope[2]);
            c->of[RISE][2] = width * width * width * slope[2] / 3;
            (void)fret_cell_complete(c, &mk->nodes);
        } else {
            fret_term term[FRET_MOST_TERMS];
            const fret_real next = sqrtl(end);
            if (!add_centre(mk, term, fret_gap_series(mk->gap, &mk->all->rule, next, term), next))
                return false;
        }
        at = part ? at + width : end;
        i += !part;
        x = sqrtl(w->inner * w->inner + at);
    }
    return true;
}

/* ---- all --------------------------------------------------------------------------------------- */

/* From the centre outwards; inside the worn region by the gap before that wear. */
static bool make_all(maker *mk) {
    const fret_gap *whole = mk->gap;
    bool ok = true;
    for (fret_real x = 0; ok && x < mk->all->end; x = mk->end) {
        const struct fret_worn *w;
        mk->end = mk->all->end;
        mk->gap = whole;
        for (; (w = fret_gap_worn(mk->gap)) && x < w->inner; mk->gap = &w->of)
            mk->end = fminl(mk->end, w->inner);
        ok = w                              ? make_worn(mk, w, x)
             : fret_gap_powers(mk->gap) > 0 ? make_sum(mk)
             : fret_gap_sampled(mk->gap)    ? make_rows(mk)
             : mk->start >= mk->all->end    ? make_punch(mk)
             : mk->start > 0                ? make_flat(mk)
                                            : make_sphere(mk);
        fret_transform_free(mk->rows);
        mk->rows = NULL;
    }
    return ok;
}

static bool make_runs(maker *mk) {
    fret_cells *all = mk->all;
    for (int l = 0; all->count >> l; l++) {
        all->run[l] = malloc((all->count >> l) * sizeof *all->run[l]);
        if (!all->run[l]) {
            mk->failed = fret_fail(FRET_NO_MEMORY, NULL, 0, 0);
            return false;
        }
        for (size_t i = 0; i < all->count >> l; i++) {
            const fret_cell *c = &all->cell[i];
            if (l > 0)
                all->run[l][i] = fret_stretch_join(&all->run[l - 1][2 * i + 1], &all->run[l - 1][2 * i]);
            else
                all->run[0][i] =
                    isinf(c->rise[BY_DEPTH]) ? (fret_stretch){0, 0, 0, 0} : fret_cell_below(c, 1);
        }
    }
    return true;
}

static void find_most(fret_cells *all) {
    const fret_cell *last = &all->cell[all->count - 1];
    const bool ends = isfinite(all->end) && last->width > 0;
    const fret_place end = {all->count - 1, ends ? fret_cell_place(last, all->end) : 1};
    for (int by = BY_DEPTH; by <= BY_LOAD; by++)
        all->most[by] = ends ? fret_cells_level(all, by, &end) : (fret_real)INFINITY;
}

/* Makes the cells of a gap without scaling. */
static fret_status cut_cells(const fret_gap *gap, double k, fret_stop stop, fret_cells **out) {
    fret_cells *all = calloc(1, sizeof *all);
    if (!all)
        return fret_fail(FRET_NO_MEMORY, NULL, 0, 0);
    all->users = 1;
    all->gap = *gap;
    all->k = k;
    all->end = fret_gap_end(gap);
    all->error = 1e-17L; /* the error of the values that are fitted */
    fret_gap_rule(gap, k, &all->rule);
    maker mk = {
        .all = all, .gap = gap, .m = ((fret_real)k + 1) / 2, .start = fret_gap_start(gap), .stop = stop};
    fret_chebyshev_make(&mk.nodes, FRET_CELL_TERMS, true);
    if (make_all(&mk) && make_runs(&mk))
        find_most(all);
    else if (!mk.failed.code)
        mk.failed = fret_fail(FRET_INTERRUPTED, NULL, 0, 0);
    if (mk.failed.code)
        fret_cells_free(all);
    else
        *out = all;
    return mk.failed;
}

void fret_cells_free(fret_cells *all) {
    if (!all || --all->users > 0)
        return;
    for (int l = 0; l < FRET_RUNS; l++)
        free(all->run[l]);
    free(all->cell);
    fret_cells_free(all->unit);
    free(all);
}

/* ---- of another size --------------------------------------------------------------------------- */

static fret_cells *hold(fret_cells *all) {
    all->users++;
    return all;
}

/* Factors of depth and load, stiffness, L, and radii. */
typedef struct scales {
    fret_real level[2], K, L, radius;
} scales;

static fret_stretch scaled_stretch(const fret_stretch *s, const scales *by) {
    return (fret_stretch){by->level[BY_DEPTH] * s->h, by->K * s->K, by->level[BY_LOAD] * s->G, by->L * s->L};
}

static void scale_cell(fret_cell *c, const scales *by) {
    const fret_real y = by->level[BY_DEPTH], F = by->level[BY_LOAD],
                    series[FRET_CELL_SERIES] = {y, y, by->K, F, F, by->L, by->L, by->L, F, F};
    c->x *= by->radius;
    c->width *= c->powers ? 1 : by->radius * by->radius;
    c->y *= y;
    c->F *= F;
    c->K *= by->K;
    c->K_at_1 *= by->K;
    for (int i = 0; i < FRET_CELL_SERIES; i++)
        for (int j = 0; j < c->count[i]; j++)
            c->of[i][j] *= series[i];
    for (int i = BY_DEPTH; i <= BY_LOAD; i++)
        c->rise[i] *= by->level[i];
}

static bool scale_cells(fret_cells *all, const fret_cells *unit, const scales *by) {
    all->cell = malloc(unit->count * sizeof *all->cell);
    if (!all->cell)
        return false;
    for (size_t i = 0; i < unit->count; i++) {
        all->cell[i] = unit->cell[i];
        scale_cell(&all->cell[i], by);
    }
    for (int l = 0; unit->count >> l; l++) {
        all->run[l] = malloc((unit->count >> l) * sizeof *all->run[l]);
        if (!all->run[l])
            return false;
        for (size_t i = 0; i < unit->count >> l; i++)
            all->run[l][i] = scaled_stretch(&unit->run[l][i], by);
    }
    for (int i = BY_DEPTH; i <= BY_LOAD; i++)
        all->most[i] = by->level[i] * unit->most[i];
    return true;
}

/* Scaled copies of the cells `unit`, whose reference it takes over. */
static fret_cells *scaled(fret_cells *unit, const fret_gap *gap, fret_real radii, fret_real depths) {
    const fret_real K = fret_pow(radii, (fret_real)unit->k + 1), F = K * depths;
    fret_cells *all = calloc(1, sizeof *all);
    if (!all) {
        fret_cells_free(unit);
        return NULL;
    }
    all->users = 1;
    all->unit = unit;
    all->gap = *gap;
    all->k = unit->k;
    all->rule = unit->rule;
    all->count = all->room = unit->count;
    all->end = radii * unit->end;
    all->error = unit->error;
    all->falls = unit->falls;
    if (scale_cells(all, unit, &(scales){{depths, F}, K, F * depths, radii}))
        return all;
    fret_cells_free(all);
    return NULL;
}

fret_status fret_cells_make(const fret_gap *gap, double k, fret_cells *like, fret_stop stop,
                            fret_cells **out) {
    fret_real radii, depths;
    const fret_gap at_1 = fret_gap_unit(gap, &radii, &depths);
    fret_status st = fret_ok();
    if (like && like->k == k && fret_gap_same(&like->gap, gap)) {
        *out = hold(like);
        return st;
    }
    fret_cells *unit = like && like->unit ? like->unit : like;
    if (unit && unit->k == k && fret_gap_same(&unit->gap, &at_1))
        (void)hold(unit);
    else
        st = cut_cells(&at_1, k, stop, &unit);
    if (st.code)
        return st;
    *out = fret_gap_same(&at_1, gap) ? unit : scaled(unit, gap, radii, depths);
    return *out ? st : fret_fail(FRET_NO_MEMORY, NULL, 0, 0);
}
