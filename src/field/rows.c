/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The cells of a sampled gap as fields want them. Allocates them, and frees them. */
#include "field/rows.h"

#include <stdlib.h>

#include "law/check.h"

typedef struct slopes {
    fret_real of[2][FRET_CELL_TERMS];
} slopes;

struct fret_rows {
    const fret_cells *cells;
    size_t first, count;
    slopes *slopes;
};

fret_status fret_rows_make_slopes(const fret_normal *n, fret_real e, struct fret_rows **out) {
    const fret_cells *all = n->cells;
    const fret_real start = fret_gap_start(&n->gap);
    size_t first = 0, last;
    *out = NULL;
    while (first < all->count &&
           (first == 0 || !all->cell[first].count[RISE_Q] || !all->cell[first].count[RISE]))
        first++;
    for (last = first; last < all->count && all->cell[last].x < start + e; last++)
        ;
    if (last <= first)
        return fret_ok();
    struct fret_rows *r = calloc(1, sizeof *r);
    slopes *s = r ? calloc(last - first, sizeof *s) : NULL;
    if (!s) {
        free(r);
        return fret_fail(FRET_NO_MEMORY, NULL, 0, 0);
    }
    *r = (struct fret_rows){all, first, last - first, s};
    for (size_t i = first; i < last; i++) {
        const fret_cell *c = &all->cell[i];
        for (int j = 0; j < FRET_CELL_TERMS; j++) {
            s[i - first].of[0][j] = (fret_real)(j + 1) * c->of[RISE][j];
            s[i - first].of[1][j] = ((fret_real)j + c->q) * c->of[RISE_Q][j];
        }
    }
    *out = r;
    return fret_ok();
}

void fret_rows_free(struct fret_rows *r) {
    if (r)
        free(r->slopes);
    free(r);
}

size_t fret_rows_parts(const struct fret_rows *r) {
    return r->count;
}

fret_row_part fret_rows_part(const struct fret_rows *r, size_t i) {
    const fret_cell *c = &r->cells->cell[r->first + i];
    const slopes *s = &r->slopes[i];
    return (fret_row_part){.inner = c->x,
                           .outer = fret_cell_radius(c, 1),
                           .width = c->width,
                           .depth = c->y,
                           .P = c->of[RISE],
                           .Q = c->of[RISE_Q],
                           .S = s->of[0],
                           .B = s->of[1],
                           .depths = {c->count[RISE], c->count[RISE_Q]},
                           .slopes = {c->count[RISE], c->count[RISE_Q]}};
}
