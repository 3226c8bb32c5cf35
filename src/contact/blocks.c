/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Blocks of rows, on demand. Allocates them, and frees them. */
#include "contact/blocks.h"

#include <stdatomic.h>
#include <stdlib.h>

#include "contact/check.h"
#include "contact/table.h"

enum { BLOCK = 512 };

struct fret_blocks {
    fret_normal normal; /* of its own: who asks may have another stiffness */
    size_t count;
    bool checked;
    fret_real enough;
    fret_real *reach[3];               /* where each begins, and the last one ends, as of rows */
    _Atomic(struct fret_rows *) *made; /* or NULL */
    _Atomic(stretch *) *run[RUNS];     /* as those of pieces, or NULL */
};

static fret_status make_block(struct fret_blocks *all, fret_stop stop, size_t i, fret_real *error) {
    struct fret_rows *rows, *none = NULL;
    const fret_real *e = all->reach[SPOT_DISTANCE] + i;
    fret_normal n = all->normal;
    n.stop = stop;
    const fret_status st = fret_rows_make(&n, e[0], e[1], &rows, error);
    if (st.code)
        return st;
    const bool good = rows && !(error && *error > all->enough);
    if (!good || !atomic_compare_exchange_strong(&all->made[i], &none, rows))
        fret_rows_free(rows); /* also where another thread was faster */
    return st;
}

static const struct fret_rows *block_at(struct fret_blocks *all, fret_stop stop, size_t i) {
    const struct fret_rows *rows = atomic_load(&all->made[i]);
    fret_real error = 0;
    if (rows || make_block(all, stop, i, all->checked ? &error : NULL).code)
        return rows;
    return atomic_load(&all->made[i]);
}

/* ---- places ------------------------------------------------------------------------------------ */

static bool place_in(struct fret_blocks *all, fret_stop stop, size_t i, fret_spot_by by, fret_real value,
                     fret_place *out) {
    out->block = i;
    out->rows = block_at(all, stop, i);
    return out->rows && fret_rows_find(out->rows, by, value, &out->spot);
}

/* The block of a value, and its rows: at an end of blocks rounding decides. */
bool fret_blocks_find(struct fret_blocks *all, fret_stop stop, fret_spot_by by, fret_real value,
                      fret_place *out) {
    const fret_real *reach = all->reach[by];
    if (!(value > reach[0] && fret_law_reaches(reach[all->count], value)))
        return false;
    size_t i = 0;
    for (size_t count = all->count; count > 1;) { /* the last that begins before the value */
        const size_t half = count / 2;
        i += reach[i + half] < value ? half : 0;
        count -= half;
    }
    return place_in(all, stop, i, by, value, out) || (i > 0 && place_in(all, stop, i - 1, by, value, out));
}

fret_real fret_blocks_begin(const struct fret_blocks *all, fret_spot_by by) {
    return all->reach[by][0];
}

bool fret_blocks_inner(struct fret_blocks *all, fret_stop stop, fret_place *out) {
    out->block = 0;
    out->rows = block_at(all, stop, 0);
    if (out->rows)
        out->spot = fret_rows_inner();
    return out->rows;
}

bool fret_blocks_drop(struct fret_blocks *all, fret_stop stop, fret_spot_by by, const fret_place *outer,
                      fret_real drop, fret_place *out) {
    const fret_real *reach = all->reach[by];
    fret_place from = *outer;
    while (!fret_rows_drop(from.rows, by, &from.spot, drop, &out->spot)) {
        const fret_spot end = fret_rows_inner();
        drop -= fret_rows_fall(from.rows, by == SPOT_LOAD ? LOADS : DEPTHS, &from.spot, &end);
        for (; from.block > 1 && drop > reach[from.block] - reach[from.block - 1]; from.block--)
            drop -= reach[from.block] - reach[from.block - 1]; /* none of these is asked for */
        from.rows = from.block > 0 ? block_at(all, stop, --from.block) : NULL;
        if (!from.rows)
            return false;
        from.spot = fret_rows_outer(from.rows);
        drop = fmaxl(drop, 0);
    }
    out->block = from.block;
    out->rows = from.rows;
    return true;
}

/* ---- from place to place ----------------------------------------------------------------------- */

fret_real fret_blocks_fall(const struct fret_blocks *all, int by, const fret_place *outer,
                           const fret_place *inner) {
    if (outer->rows == inner->rows)
        return fret_rows_fall(outer->rows, by, &outer->spot, &inner->spot);
    const fret_real *reach = all->reach[by == LOADS ? SPOT_LOAD : SPOT_DEPTH];
    const fret_spot end = fret_rows_inner(), begin = fret_rows_outer(inner->rows);
    return fret_rows_fall(outer->rows, by, &outer->spot, &end) +
           (reach[outer->block] - reach[inner->block + 1]) +
           fret_rows_fall(inner->rows, by, &begin, &inner->spot);
}

/* The 2^l blocks from i 2^l on; each run is the sum of both its halves, whether it has been kept or not. */
static bool find_run(struct fret_blocks *all, fret_stop stop, int l, size_t i, stretch *sum) {
    stretch *kept = atomic_load(&all->run[l][i]), *none = NULL, half[2];
    if (kept) {
        *sum = *kept;
        return true;
    }
    if (l > 0) {
        for (size_t j = 0; j < 2; j++)
            if (!find_run(all, stop, l - 1, 2 * i + j, &half[j]))
                return false;
        *sum = fret_stretch_join(&half[1], &half[0]);
    } else {
        const struct fret_rows *rows = block_at(all, stop, i);
        if (!rows)
            return false;
        const fret_spot outer = fret_rows_outer(rows), inner = fret_rows_inner();
        *sum = fret_rows_between(rows, &outer, &inner);
    }
    kept = malloc(sizeof *kept);
    if (kept) {
        *kept = *sum;
        if (!atomic_compare_exchange_strong(&all->run[l][i], &none, kept))
            free(kept); /* unreached: another thread must be faster */
    }
    return true;
}

/* As fret_stretch_add_runs. */
static bool add_runs(struct fret_blocks *all, fret_stop stop, size_t from, size_t to, stretch *sum) {
    while (from > to) {
        int l = 0;
        stretch run;
        while (from % ((size_t)2 << l) == 0 && from - to >= (size_t)2 << l)
            l++;
        if (!find_run(all, stop, l, (from >> l) - 1, &run))
            return false;
        *sum = fret_stretch_join(sum, &run);
        from -= (size_t)1 << l;
    }
    return true;
}

bool fret_blocks_between(struct fret_blocks *all, fret_stop stop, const fret_place *outer,
                         const fret_place *inner, stretch *sum) {
    if (outer->rows == inner->rows) {
        *sum = fret_rows_between(outer->rows, &outer->spot, &inner->spot);
        return true;
    }
    const fret_spot end = fret_rows_inner(), begin = fret_rows_outer(inner->rows);
    *sum = fret_rows_between(outer->rows, &outer->spot, &end);
    if (!add_runs(all, stop, outer->block, inner->block + 1, sum))
        return false;
    const stretch rest = fret_rows_between(inner->rows, &begin, &inner->spot);
    *sum = fret_stretch_join(sum, &rest);
    return true;
}

/* ---- making ------------------------------------------------------------------------------------ */

static bool allocate(struct fret_blocks *all) {
    bool ok = true;
    for (int i = 0; i < 3; i++) {
        all->reach[i] = malloc((all->count + 1) * sizeof *all->reach[i]);
        ok = ok && all->reach[i];
    }
    all->made = malloc(all->count * sizeof *all->made);
    for (size_t i = 0; all->made && i < all->count; i++)
        atomic_init(&all->made[i], NULL);
    for (int l = 0; all->count >> l; l++) {
        all->run[l] = malloc((all->count >> l) * sizeof *all->run[l]);
        for (size_t i = 0; all->run[l] && i < all->count >> l; i++)
            atomic_init(&all->run[l][i], NULL);
        ok = ok && all->run[l];
    }
    return ok && all->made;
}

/* The ends of blocks by the profile; of a single block by its own rows. */
static fret_status set_reach(struct fret_blocks *all, const fret_normal *n, size_t first, size_t end) {
    const struct fret_table *t = n->gap.table;
    for (size_t i = 0; i <= all->count && !fret_stopped(n); i++) {
        const size_t row = first + i * BLOCK;
        const fret_real at = fret_table_distance(t, i < all->count ? row : end);
        const fret_profile p = fret_table_profile(t, &n->rule, at);
        all->reach[SPOT_DISTANCE][i] = at;
        all->reach[SPOT_DEPTH][i] = p.g;
        all->reach[SPOT_LOAD][i] = fret_force_of(n, &p);
    }
    return fret_unless_stopped(n, fret_ok());
}

static void take_reach(struct fret_blocks *all) {
    const struct fret_rows *rows = atomic_load(&all->made[0]);
    for (size_t i = 0; i < 2 && rows; i++) {
        const fret_spot at = i ? fret_rows_outer(rows) : fret_rows_inner();
        all->reach[SPOT_DISTANCE][i] = fret_rows_distance(rows, &at);
        all->reach[SPOT_DEPTH][i] = fret_rows_level(rows, DEPTHS, &at);
        all->reach[SPOT_LOAD][i] = fret_rows_level(rows, LOADS, &at);
    }
}

fret_status fret_blocks_make(const fret_normal *n, fret_real e, bool at_once, fret_real enough,
                             struct fret_blocks **out, fret_real *error) {
    const struct fret_table *t = n->gap.table;
    const size_t first = fret_table_row(t, 0) + 1;
    size_t end = fret_table_row(t, e);
    end += fret_table_distance(t, end) < e;
    *out = NULL;
    if (end <= first)
        return fret_ok();
    struct fret_blocks *all = calloc(1, sizeof *all);
    if (all) {
        all->normal = *n;
        all->normal.pieces = NULL;
        all->count = at_once ? 1 : (end - first + BLOCK - 1) / BLOCK;
        all->checked = error;
        all->enough = enough;
    }
    fret_status st = fret_fail(FRET_NO_MEMORY, NULL, 0, 0);
    if (all && allocate(all))
        st = set_reach(all, n, first, end);
    if (!st.code && error)
        st = make_block(all, n->stop, all->count / 2, error);
    if (st.code) {
        fret_blocks_free(all);
        return st;
    }
    if (at_once)
        take_reach(all);
    *out = all;
    return st;
}

void fret_blocks_free(struct fret_blocks *all) {
    if (!all)
        return;
    for (size_t i = 0; all->made && i < all->count; i++)
        fret_rows_free(atomic_load(&all->made[i]));
    for (int l = 0; l < RUNS; l++) {
        for (size_t i = 0; all->run[l] && i < all->count >> l; i++)
            free(atomic_load(&all->run[l][i]));
        free(all->run[l]);
    }
    for (int i = 0; i < 3; i++)
        free(all->reach[i]);
    free(all->made);
    free(all);
}
