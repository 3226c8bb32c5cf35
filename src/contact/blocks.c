/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Blocks of rows, on demand. Allocates them, and frees them. */
#include "contact/blocks.h"

#include <stdatomic.h>
#include <stdlib.h>

#include "contact/check.h"
#include "contact/rows.h"
#include "contact/table.h"

enum { BLOCK = 512 };

struct fret_blocks {
    fret_normal normal; /* of its own: who asks may have another stiffness */
    size_t count;
    fret_real *reach[3];               /* where each begins, and the last one ends, as of rows */
    _Atomic(struct fret_rows *) *made; /* or NULL */
};

static const struct fret_rows *block_at(struct fret_blocks *all, size_t i) {
    struct fret_rows *rows = atomic_load(&all->made[i]), *none = NULL;
    const fret_real *e = all->reach[SPOT_DISTANCE] + i;
    if (rows || fret_rows_make(&all->normal, e[0], e[1], &rows, NULL).code)
        return rows;
    if (!atomic_compare_exchange_strong(&all->made[i], &none, rows)) { /* another thread was faster */
        fret_rows_free(rows);
        rows = none;
    }
    return rows;
}

/* The block and the place where a slice begins: at an end of blocks rounding decides. */
static const struct fret_rows *begin(struct fret_blocks *all, fret_spot_by how, fret_real outer, size_t *i,
                                     fret_spot *at) {
    const fret_real *reach = all->reach[how];
    for (*i = all->count; *i > 0 && reach[*i - 1] >= outer;)
        --*i;
    for (int tries = 0; tries < 2 && *i > 0; tries++) {
        const struct fret_rows *rows = block_at(all, --*i);
        if (!rows || fret_rows_find(rows, how, outer, at))
            return rows;
    }
    return NULL;
}

bool fret_blocks_slice(struct fret_blocks *all, bool by_load, fret_real outer, fret_real drop, stretch *sum,
                       fret_real *K, fret_real *other) {
    const fret_spot_by how = by_load ? SPOT_LOAD : SPOT_DEPTH;
    fret_spot from, to;
    size_t i;
    if (!(outer - drop > all->reach[how][0]) || !fret_law_reaches(all->reach[how][all->count], outer))
        return false;
    const struct fret_rows *rows = begin(all, how, outer, &i, &from);
    *sum = (stretch){0, 0, 0, 0};
    *other = 0;
    while (rows) {
        const bool ends = fret_rows_drop(rows, how, &from, drop, &to);
        if (!ends)
            to = fret_rows_inner(rows);
        const stretch part = fret_rows_between(rows, &from, &to);
        *sum = fret_stretch_join(sum, &part);
        *other += fret_rows_fall(rows, by_load ? DEPTHS : LOADS, &from, &to);
        *K = fret_rows_stiffness(rows, &to);
        if (ends)
            return true;
        drop -= fret_rows_fall(rows, by_load ? LOADS : DEPTHS, &from, &to);
        rows = i > 0 ? block_at(all, --i) : NULL;
        if (rows)
            from = fret_rows_outer(rows);
    }
    return false;
}

static bool allocate(struct fret_blocks *all) {
    bool ok = true;
    for (int i = 0; i < 3; i++) {
        all->reach[i] = malloc((all->count + 1) * sizeof *all->reach[i]);
        ok = ok && all->reach[i];
    }
    all->made = malloc(all->count * sizeof *all->made);
    for (size_t i = 0; all->made && i < all->count; i++)
        atomic_init(&all->made[i], NULL);
    return ok && all->made;
}

fret_status fret_blocks_make(const fret_normal *n, fret_real e, struct fret_blocks **out) {
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
        all->normal.stop = NULL; /* one takes but 20 ms */
        all->count = (end - first + BLOCK - 1) / BLOCK;
    }
    if (!all || !allocate(all)) {
        fret_blocks_free(all);
        return fret_fail(FRET_NO_MEMORY, NULL, 0, 0);
    }
    for (size_t i = 0; i <= all->count; i++) {
        const size_t row = first + i * BLOCK;
        const fret_real at = fret_table_distance(t, row < end ? row : end);
        const fret_profile p = fret_table_profile(t, &n->rule, at);
        all->reach[SPOT_DISTANCE][i] = at;
        all->reach[SPOT_DEPTH][i] = p.g;
        all->reach[SPOT_LOAD][i] = fret_force_of(n, &p);
    }
    *out = all;
    return fret_ok();
}

void fret_blocks_free(struct fret_blocks *all) {
    if (!all)
        return;
    for (size_t i = 0; all->made && i < all->count; i++)
        fret_rows_free(atomic_load(&all->made[i]));
    for (int i = 0; i < 3; i++)
        free(all->reach[i]);
    free(all->made);
    free(all);
}
