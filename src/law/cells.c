/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Finds places in the cells and sums over slices that span them, by a tree of sums. Pure arithmetic. */
#include "law/cells.h"

#include <float.h>

#include "number/real.h"

static fret_real begin_of(const fret_cell *c, int by) {
    return by == BY_LOAD ? c->F : c->y;
}

/* The last of the first `count` cells that begins below the value. */
static size_t cell_of(const fret_cells *all, int by, size_t count, fret_real value) {
    size_t lo = 0;
    while (count > 1) {
        const size_t half = count / 2;
        lo += begin_of(&all->cell[lo + half], by) < value ? half : 0;
        count -= half;
    }
    return lo;
}

bool fret_cells_find(const fret_cells *all, int by, fret_real value, fret_place *out) {
    const fret_real most = all->most[by];
    if (!fret_cells_reach(most, value))
        return false;
    if (value > most)
        value = most;
    out->i = cell_of(all, by, all->count, value);
    const fret_cell *c = &all->cell[out->i];
    out->s = fret_cell_find(c, by, value - begin_of(c, by));
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
    return (fret_place){lo, fmaxl(fret_cell_place(&all->cell[lo], x), all->cell[lo].begin)};
}

fret_real fret_cells_level(const fret_cells *all, int by, const fret_place *p) {
    const fret_cell *c = &all->cell[p->i];
    return begin_of(c, by) + fret_cell_rise(c, by, p->s);
}

fret_real fret_cells_stiffness(const fret_cells *all, const fret_place *p) {
    return fret_cell_stiffness(&all->cell[p->i], p->s);
}

fret_real fret_cells_radius(const fret_cells *all, const fret_place *p) {
    return fret_cell_radius(&all->cell[p->i], p->s);
}

fret_real fret_cells_inner(const fret_cells *all, int by, const fret_place *outer, fret_real drop,
                           fret_real left, fret_place *inner) {
    static const fret_real LITTLE = 1e-3L; /* up to this part of the rise differences lose too many digits */
    const bool known = inner->s > 0 && inner->i <= outer->i;
    const fret_real begin = begin_of(&all->cell[outer->i], by);
    fret_real s = outer->s, rise = fminl(drop + left, all->most[by]) - begin;
    if (!known)
        inner->i = drop < rise || outer->i == 0 ? outer->i
                   : left < begin ? cell_of(all, by, outer->i, drop < left ? begin - (drop - rise) : left)
                                  : outer->i - 1;
    const fret_cell *c = &all->cell[inner->i];
    if (inner->i < outer->i) {
        drop = fmaxl(drop - rise - (begin - begin_of(c + 1, by)), 0);
        s = 1;
        rise = c->rise[by];
    }
    const bool little = drop <= (c->powers ? 0.5L : LITTLE) * rise;
    if (!known && !little)
        inner->s = drop < rise ? fret_cell_find(c, by, inner->i == 0 ? left : rise - drop) : c->begin;
    if (!little)
        return s - inner->s;
    const fret_real back = fret_cell_find_back(c, by, s, drop, known ? s - inner->s : 0);
    if (!known)
        inner->s = s - back;
    return back;
}

fret_real fret_cells_fall(const fret_cells *all, int by, const fret_place *outer, const fret_place *inner,
                          fret_real back) {
    static const fret_real NEAR = 0.9L; /* of s: beyond it the difference of rises has more digits */
    const fret_cell *o = &all->cell[outer->i], *i = &all->cell[inner->i];
    const fret_real s = o == i ? outer->s : 1,
                    part = back < NEAR * s ? fret_cell_fall(i, by, s, back)
                                           : fret_cell_rise(i, by, s) - fret_cell_rise(i, by, inner->s);
    return o == i ? part : fret_cell_rise(o, by, outer->s) + (begin_of(o, by) - begin_of(i + 1, by)) + part;
}

/* Adds the sums of the cells from number from-1 down to number `to`, by the longest aligned runs. */
static void add_runs(const fret_cells *all, size_t from, size_t to, fret_stretch *sum) {
    while (from > to) {
        int l = 0;
        while (!(from >> l & 1) && from - to >= (size_t)2 << l)
            l++;
        from -= (size_t)1 << l;
        *sum = fret_stretch_join(sum, &all->run[l][from >> l]);
    }
}

/* For a slice up to this part of s differences lose L, which falls with the cube of the thickness. */
static const fret_real THIN = 0.1L;

/* The sums from s inwards by `back`: by a difference, unless that loses digits. K: at the inner end. */
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
                                fret_real back, fret_real *K) {
    const fret_cell *o = &all->cell[outer->i], *i = &all->cell[inner->i];
    const bool whole = !(inner->s > i->begin);
    if (outer->i == inner->i && !whole && back < THIN * outer->s) {
        *K = fret_cell_stiffness(o, inner->s);
        return fret_cell_part(o, outer->s, back);
    }
    fret_stretch sum = fret_cell_below(o, outer->s);
    *K = i->K;
    if (outer->i == inner->i)
        return whole ? sum : part_of(o, outer->s, &sum, back, inner->s, K);
    add_runs(all, outer->i, inner->i + !whole, &sum);
    if (!whole && back > 0) {
        const fret_stretch rest = part_of(i, 1, &all->run[0][inner->i], back, inner->s, K);
        return fret_stretch_join(&sum, &rest);
    }
    if (!whole)
        *K = i[1].K; /* exactly where the next cell begins */
    return sum;
}
