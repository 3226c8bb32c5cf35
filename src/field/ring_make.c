/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Makes rings: the law's polynomial cells as they are, powers in fitted cells of their own; and moments of
 * blocks. Allocates and frees rings; uses `law` and `number`. */
#include <stdlib.h>

#include "field/ring.h"
#include "law/check.h"
#include "number/array.h"
#include "number/real.h"

typedef struct maker {
    rings *all;
    fret_chebyshev nodes;                /* Chebyshev nodes for own cells; count 0 until needed */
    double moment[POWERS][MOST][TAYLOR]; /* int_0^1 v^(q+j) (2v-1)^n dv */
    double binomial[KINDS][TAYLOR];      /* coefficients of the kernel's Taylor series */
    bool failed;
} maker;

/* ---- rings ------------------------------------------------------------------------------------- */

static bool add_ring(maker *mk, const fret_cell *c, fret_cell *own) {
    rings *all = mk->all;
    mk->failed |= !fret_array_room(&all->ring, &all->room, all->count + 1, sizeof *all->ring);
    if (mk->failed)
        return false;
    if (all->count > 0) /* to the last digit: where m is small it tells */
        all->ring[all->count - 1].hi = c->x;
    all->ring[all->count++] =
        (ring){.cell = c,
               .own = own,
               .lo = c->x,
               .hi = fret_cell_radius(c, 1),
               .scale = {fret_pow(c->width, all->m - 1), fret_pow(c->width, -all->m) / (2 * all->m)}};
    return true;
}

/* The rise of g in a cell of powers over v in x^2, by logarithms so that large exponents lose no digits. */
static fret_real rise_of_powers(const fret_cell *c, fret_real x, fret_real v) {
    const fret_real l = log1pl((x - c->x) / c->x), grown = log1pl(v / (x * x)) / 2;
    fret_real sum = 0;
    for (int i = 0; i < c->count[RISE]; i++)
        sum += c->of[RISE][i] * expl(c->of[RISE_Q][i] * l) * expm1l(c->of[RISE_Q][i] * grown);
    return sum;
}

/* Adds a ring from the radius lo, where g = y, with its own cell fitted to the cell of powers `of`. */
static bool add_own(maker *mk, const fret_cell *of, fret_real lo, fret_real width, fret_real y) {
    static const fret_real LITTLE = 1e-20L;
    fret_real value[FRET_CELL_TERMS], terms[FRET_CELL_TERMS], tail;
    fret_cell *c = calloc(1, sizeof *c);
    mk->failed |= !c;
    if (!c)
        return false;
    if (mk->nodes.count == 0)
        fret_chebyshev_make(&mk->nodes, FRET_CELL_TERMS, true);
    *c = (fret_cell){.x = lo, .width = width, .y = y, .m = mk->all->m, .mu = 1};
    c->K = fret_pow(lo, 2 * c->m);
    for (int j = 0; j < mk->nodes.count; j++)
        value[j] = rise_of_powers(of, lo, c->width * mk->nodes.node[j]);
    const int count = fret_cell_fit(&mk->nodes, value, LITTLE * fabsl(value[0]), terms, &tail);
    c->count[RISE] = (unsigned char)(count > 1 ? count - 1 : 0);
    for (int j = 1; j < count; j++)
        c->of[RISE][j - 1] = terms[j];
    (void)fret_cell_complete(c, &mk->nodes);
    if (add_ring(mk, c, c))
        return !fret_stopped(mk->all->normal);
    free(c);
    return false;
}

/* Adds rings of a cell of powers up to the radius a. So that polynomials converge, x^2 at most doubles. */
static bool add_powers(maker *mk, const fret_cell *of, fret_real a) {
    fret_real y = of->y;
    for (fret_real lo = of->x, hi; lo < a; lo = hi) {
        hi = fminl(lo * sqrtl(2), a);
        if (!add_own(mk, of, lo, square_distance(hi, lo), y))
            return false;
        y += mk->all->ring[mk->all->count - 1].cell->rise[BY_DEPTH];
    }
    return true;
}

/* Adds the law's cells from index `first` up to the one in which the last slice ends. */
static bool add_cells(maker *mk, size_t first, const slice *last) {
    const fret_cells *all = mk->all->normal->cells;
    fret_place end;
    if (!fret_cells_find(all, BY_DEPTH, fminl(last->y, all->most[BY_DEPTH]), &end))
        return true;
    for (size_t i = first; i <= end.i; i++)
        if (fret_stopped(mk->all->normal) || !(all->cell[i].powers ? add_powers(mk, &all->cell[i], last->a)
                                                                   : add_ring(mk, &all->cell[i], NULL)))
            return false;
    return true;
}

/* Rings of a steep power are cut by ln g, which falls by this much over each. */
static const fret_real PART = 4;

/* ln g at the end of the last slice less ln g at the end of slice s. */
static fret_real fall_of(const rings *all, fret_real n, const slice *s) {
    const slice *last = &all->slice[all->slices - 1];
    return fret_normal_closed(all->normal) ? logl(last->y / s->y) : -n * log1pl((s->a - last->a) / last->a);
}

/* Adds rings from the last slice inwards, until even within the first slice g is negligible (e^-48). */
static bool add_steep(maker *mk, const fret_term *term) {
    static const fret_real NOTHING = 48;
    const rings *all = mk->all;
    const fret_real a = all->slice[all->slices - 1].a, n = term->n, bend = expm1l(2 * PART / n);
    const int parts = (int)fminl(ceill((fall_of(all, n, all->slice) + NOTHING) / PART), 4096);
    fret_cell power = {.powers = true, .count = {[RISE] = 1}};
    power.of[RISE_Q][0] = n;
    for (int i = parts; i > 0; i--) {
        power.x = a * expl(-PART * (fret_real)i / n);
        power.of[RISE][0] = term->G * expl(-PART * (fret_real)i);
        if (!add_own(mk, &power, power.x, power.x * power.x * bend, power.of[RISE][0]))
            return false;
    }
    return true;
}

/* ---- slices ------------------------------------------------------------------------------------ */

static slice_end end_by_radius(const rings *all, fret_real a) {
    size_t i = all->count - 1;
    while (i > 0 && all->ring[i].lo >= a)
        i--;
    const ring *p = &all->ring[i];
    return (slice_end){i, fminl(fmaxl(square_distance(a, p->lo) / p->cell->width, 0), 1), false};
}

/* By depth, more exact than the radius next to a flat end; first: index of the first cell in use. */
static slice_end end_by_depth(const rings *all, size_t first, const slice *s) {
    const fret_cells *cells = all->normal->cells;
    fret_place at;
    if (!fret_cells_find(cells, BY_DEPTH, fminl(s->y, cells->most[BY_DEPTH]), &at) || at.i < first)
        return (slice_end){0, 0, false};
    const fret_cell *c = &cells->cell[at.i];
    const fret_real v = at.i > 0 ? fmaxl(fret_cell_place(c, s->a), 0) : at.s; /* by what `a` has of digits */
    return c->powers ? end_by_radius(all, s->a) : (slice_end){at.i - first, v, false};
}

static slice_end end_in_steep(const rings *all, fret_real n, const slice *s) {
    const fret_real fall = fall_of(all, n, s), i = fminl(floorl(fall / PART) + 1, (fret_real)all->count);
    return (slice_end){all->count - (size_t)i,
                       fmaxl(expm1l(2 / n * (PART * i - fall)) / expm1l(2 / n * PART), 0), false};
}

slice_end fret_rings_end(const rings *all, const slice *s) {
    static const fret_real NEAR = 0x1p-14L; /* relative; a radius farther out keeps 50 bits of its distance */
    const fret_real start = fret_gap_start(&all->normal->gap);
    slice_end at = all->steep > 0 ? end_in_steep(all, all->steep, s) : end_by_depth(all, all->first_cell, s);
    at.by_v = s->a - start < NEAR * start;
    return at;
}

static void place_slices(rings *all) {
    size_t next = 0;
    for (size_t i = 0; i < all->slices; i++)
        all->ends[i] = fret_rings_end(all, &all->slice[i]);
    for (size_t i = 0; i < all->count; i++) {
        while (next < all->slices && all->ends[next].ring < i)
            next++;
        all->ring[i].first = next;
        all->ring[i].cut = next < all->slices && all->ends[next].ring == i;
    }
}

/* ---- moments ----------------------------------------------------------------------------------- */

static void make_tables(maker *mk) {
    rings *all = mk->all;
    const int sharp = fret_gap_sharp(&all->normal->gap);
    double factor[KINDS] = {1, 1 / (2 * (double)all->m)};
    fret_kernel_power(&all->power[OF_ONE], 0, 0, all->m);
    fret_kernel_power(&all->power[OF_SLOPE], 1, -sharp, all->m);
    fret_kernel_power(&all->power[OF_DEPTH], 1, 1 - sharp, all->m);
    for (int p = 0; p < POWERS; p++)
        for (int j = 0; j < MOST; j++) {
            const fret_real q = all->power[p].q + j + 1;
            fret_real now = 1 / q;
            for (int n = 0; n < TAYLOR; n++) {
                mk->moment[p][j][n] = (double)now;
                now = (1 - (fret_real)(n + 1) * now) / (q + (fret_real)(n + 1));
            }
        }
    for (int n = 0; n < TAYLOR; n++) {
        mk->binomial[SLOPES][n] = factor[SLOPES];
        mk->binomial[DEPTHS][n] = factor[DEPTHS];
        factor[SLOPES] *= ((double)all->m - 1 - n) / (n + 1);
        factor[DEPTHS] *= ((double)all->m + n) / (n + 1);
    }
}

/* Adds the moments of a part, shifted to the middle of the whole. shift and ratio: distance of the middles
 * and half-width of the part, in half-widths of the whole. */
static void add_moved(double *whole, const double *part, double shift, double ratio) {
    double moved[TAYLOR], power = 1;
    for (int n = 0; n < TAYLOR; n++) {
        moved[n] = part[n] * power;
        power *= ratio;
    }
    for (int pass = 1; pass < TAYLOR; pass++) /* binomial expansion */
        for (int n = TAYLOR - 1; n >= pass; n--)
            moved[n] += shift * moved[n - 1];
    for (int n = 0; n < TAYLOR; n++)
        whole[n] += moved[n];
}

/* Moments of one ring. A ring in which a slice ends is always summed as a near one, so its moments stay 0. */
static void make_leaf(const maker *mk, const ring *p, block *b) {
    const rings *all = mk->all;
    for (int kind = 0; kind < KINDS && p->first < all->slices && !p->cut; kind++) {
        double whole[TAYLOR] = {0};
        for (int kinked = 0; kinked < 2; kinked++)
            for (int j = 0; j < terms_of(p->cell, kind, kinked); j++) {
                const double factor = (double)term_of(p->cell, kind, kinked, j);
                const double *moment = mk->moment[!kinked ? OF_ONE : kind == SLOPES ? OF_SLOPE : OF_DEPTH][j];
                for (int n = 0; n < TAYLOR; n++)
                    whole[n] += factor * moment[n];
            }
        for (int load = 0; load < all->loads; load++)
            for (int n = 0; n < TAYLOR; n++)
                b->of[load][kind][n] = (double)all->slice[p->first].weight[load] * whole[n];
    }
}

static void add_half(block *b, const block *half, int loads) {
    const double shift = (double)((square_distance(half->lo, b->lo) - square_distance(b->hi, half->hi)) /
                                  (2 * b->half)),
                 ratio = (double)(half->half / b->half);
    for (int load = 0; load < loads; load++)
        for (int kind = 0; kind < KINDS; kind++)
            add_moved(b->of[load][kind], half->of[load][kind], shift, ratio);
}

static size_t blocks_of(const rings *all, int level) {
    return (all->count + ((size_t)1 << level) - 1) >> level;
}

static void make_block(const maker *mk, int level, size_t i) {
    const rings *all = mk->all;
    const size_t end = (i + 1) << level;
    block *b = &all->block[level][i];
    b->lo = all->ring[i << level].lo;
    b->hi = all->ring[(end < all->count ? end : all->count) - 1].hi;
    b->half = square_distance(b->hi, b->lo) / 2;
    b->log_half = log((double)(b->half / all->unit));
    if (level == 0)
        make_leaf(mk, &all->ring[i], b);
    for (size_t j = 2 * i; level > 0 && j < 2 * i + 2 && j < blocks_of(all, level - 1); j++)
        add_half(b, &all->block[level - 1][j], all->loads);
}

/* Multiplies in the kernel's coefficients, after all shifts. */
static void finish_block(const maker *mk, block *b) {
    for (int load = 0; load < LOADS; load++)
        for (int kind = 0; kind < KINDS; kind++)
            for (int n = 0; n < TAYLOR; n++)
                b->of[load][kind][n] *= mk->binomial[kind][n];
}

static void make_blocks(maker *mk) {
    rings *all = mk->all;
    for (int level = 0; level == 0 || blocks_of(all, level - 1) > 1; level++) {
        all->block[level] = calloc(blocks_of(all, level), sizeof *all->block[level]);
        mk->failed |= !all->block[level];
        for (size_t i = 0; i < blocks_of(all, level); i++) {
            if (mk->failed || fret_stopped(all->normal))
                return;
            make_block(mk, level, i);
        }
    }
    for (int level = 0; level < LEVELS && all->block[level]; level++)
        for (size_t i = 0; i < blocks_of(all, level); i++)
            finish_block(mk, &all->block[level][i]);
}

fret_status fret_rings_make(const fret_normal *n, size_t first, const fret_term *steep, const slice *slices,
                            size_t count, int loads, rings **out) {
    maker *mk = calloc(1, sizeof *mk);
    rings *all = calloc(1, sizeof *all);
    slice_end *ends = calloc(count, sizeof *ends);
    const bool room = mk && all && ends;
    *out = all;
    if (room) {
        const fret_real a = slices[count - 1].a;
        *all = (rings){.normal = n, .m = (n->foundation.k + 1) / 2, .unit = a * a, .loads = loads};
        all->first_cell = first;
        all->steep = steep ? steep->n : 0;
        all->slices = count;
        all->slice = slices;
        all->ends = ends;
        mk->all = all;
        make_tables(mk);
        if ((steep ? add_steep(mk, steep) : add_cells(mk, first, &slices[count - 1])) && all->count > 0) {
            place_slices(all);
            make_blocks(mk);
        }
    } else {
        free(ends);
    }
    const fret_status st =
        fret_unless_stopped(n, room && !mk->failed ? fret_ok() : fret_fail(FRET_NO_MEMORY, NULL, 0, 0));
    free(mk);
    if (st.code) {
        fret_rings_free(all);
        *out = NULL;
    }
    return st;
}

void fret_rings_free(rings *all) {
    if (!all)
        return;
    for (size_t i = 0; i < all->count; i++)
        free(all->ring[i].own);
    for (int level = 0; level < LEVELS; level++)
        free(all->block[level]);
    free(all->ring);
    free(all->ends);
    free(all);
}
