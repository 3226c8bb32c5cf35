/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Places in cells, and what slices across them carry: a tree of sums. Pure. */
#include "law/cells.h"

#include <float.h>

#include "number/real.h"

static fret_real begin_of(const fret_cell *c, int by) {
    return by == BY_LOAD ? c->F : c->y;
}

/* The last cell that begins before the value; among the first `count`. */
static size_t cell_of(const fret_cells *all, int by, size_t count, fret_real value) {
    size_t lo = 0;
    while (count > 1) {
        const size_t half = count / 2;
        lo += begin_of(&all->cell[lo + half], by) < value ? half : 0;
        count -= half;
    }
    return lo;
}

static fret_place place_in(size_t i, fret_real s, fret_real back) {
    return (fret_place){i, s, back, {(fret_real)NAN, (fret_real)NAN}};
}

/* Above the beginning of its cell. */
static fret_real rise_of(const fret_cells *all, int by, const fret_place *p) {
    return isnan(p->rise[by]) ? fret_cell_rise(&all->cell[p->i], by, p->s) : p->rise[by];
}

bool fret_cells_find(const fret_cells *all, int by, fret_real value, fret_place *out) {
    const fret_real most = all->most[by];
    if (!fret_cells_reach(most, value))
        return false;
    if (value > most)
        value = most;
    out->i = cell_of(all, by, all->count, value);
    const fret_cell *c = &all->cell[out->i];
    const fret_real rise = value - begin_of(c, by);
    *out = place_in(out->i, fret_cell_find(c, by, rise), 0);
    out->rise[by] = rise;
    return true;
}

fret_place fret_cells_at(const fret_cells *all, fret_real x) {
    size_t lo = 0, count = all->count;
    while (count > 1) {
        const size_t half = count / 2;
        const fret_cell *c = &all->cell[lo + half];
        lo += fret_cell_radius(c, c->begin) < x ? half : 0;
        count -= half;
    }
    return place_in(lo, fmaxl(fret_cell_place(&all->cell[lo], x), all->cell[lo].begin), 0);
}

fret_real fret_cells_level(const fret_cells *all, int by, const fret_place *p) {
    return begin_of(&all->cell[p->i], by) + rise_of(all, by, p);
}

fret_real fret_cells_stiffness(const fret_cells *all, const fret_place *p) {
    return fret_cell_stiffness(&all->cell[p->i], p->s);
}

fret_real fret_cells_radius(const fret_cells *all, const fret_place *p) {
    return fret_cell_radius(&all->cell[p->i], p->s);
}

fret_place fret_cells_inner(const fret_cells *all, int by, const fret_place *outer, fret_real drop,
                            fret_real left) {
    static const fret_real LITTLE = 1e-3L; /* of which differences would lose too many digits */
    size_t i = outer->i;
    fret_real s = outer->s, rise = rise_of(all, by, outer);
    if (drop >= rise && i > 0) { /* it ends in another cell */
        const fret_real begin = begin_of(&all->cell[i], by), next = begin - (drop - rise);
        i = left < begin ? cell_of(all, by, i, drop < left ? next : left) : i - 1;
        drop = fmaxl(drop - rise - (begin - begin_of(&all->cell[i + 1], by)), 0);
        s = 1;
        rise = all->cell[i].rise[by];
    }
    const fret_cell *c = &all->cell[i];
    const fret_real rest = left - begin_of(c, by);
    if (drop >= rise)
        return place_in(i, c->begin, s - c->begin);
    if (drop > (c->powers ? 0.5L : LITTLE) * rise) {
        const fret_real inner = fret_cell_find(c, by, i == 0 ? fmaxl(rest, 0) : rise - drop);
        return place_in(i, inner, s - inner);
    }
    const fret_real back = fret_cell_find_back(c, by, s, drop);
    return place_in(i, s - back, back);
}

/* Adds the runs of cells below number `from`, down to and with number `to`. */
static void add_runs(const fret_cells *all, size_t from, size_t to, fret_stretch *sum) {
    while (from > to) {
        int l = 0;
        while (!(from >> l & 1) && from - to >= (size_t)2 << l)
            l++;
        from -= (size_t)1 << l;
        *sum = fret_stretch_join(sum, &all->run[l][from >> l]);
    }
}

/* Of a slice that is this part of s, or less, L would be lost in differences: it falls with the cube. */
static const fret_real THIN = 0.1L;

/* From s inwards by `back`: by a difference, unless that would lose digits. K: there. */
static fret_stretch part_of(const fret_cell *c, fret_real s, const fret_stretch *whole, fret_real back,
                            fret_real inner, fret_real *K) {
    static const fret_real WORTH = 2e-3L, NEAR = 0.9L;
    const fret_stretch below = fret_cell_below(c, inner);
    *K = c->K + below.K;
    const fret_stretch part = fret_stretch_less(whole, &below);
    const bool little = part.L < WORTH * whole->L || part.G < WORTH * whole->G;
    return c->powers || (little && back < NEAR * s) ? fret_cell_part(c, s, back) : part;
}

fret_stretch fret_cells_between(const fret_cells *all, const fret_place *outer, const fret_place *inner,
                                fret_real *K) {
    const fret_cell *o = &all->cell[outer->i], *i = &all->cell[inner->i];
    const bool whole = !(inner->s > i->begin);
    if (outer->i == inner->i && !whole && inner->back < THIN * outer->s) {
        *K = fret_cell_stiffness(o, inner->s);
        return fret_cell_part(o, outer->s, inner->back);
    }
    fret_stretch sum = fret_cell_below(o, outer->s);
    *K = i->K;
    if (outer->i == inner->i)
        return whole ? sum : part_of(o, outer->s, &sum, inner->back, inner->s, K);
    add_runs(all, outer->i, inner->i + !whole, &sum);
    if (!whole && inner->back > 0) {
        const fret_stretch rest = part_of(i, 1, &all->run[0][inner->i], inner->back, inner->s, K);
        return fret_stretch_join(&sum, &rest);
    }
    if (!whole)
        *K = i[1].K; /* just where the next one begins */
    return sum;
}
