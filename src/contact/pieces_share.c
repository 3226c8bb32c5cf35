/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Pieces of one contact for another of the same shape and k: the forces in them in proportion. */
#include <stdlib.h>
#include <string.h>

#include "contact/check.h"
#include "contact/piece.h"
#include "contact/pieces.h"

static bool same_shape(const fret_normal *a, const fret_normal *b) {
    const fret_gap *f = &a->gap, *g = &b->gap;
    if (a->foundation.k != b->foundation.k || f->kind != g->kind || f->terms != g->terms || f->b != g->b ||
        f->R != g->R || f->slope != g->slope || f->table != g->table)
        return false;
    for (int i = 0; i < f->terms; i++)
        if (f->power[i].n != g->power[i].n || f->power[i].h != g->power[i].h ||
            f->power[i].r0 != g->power[i].r0)
            return false;
    return true;
}

static void scale_polynomial(polynomial *c, fret_real by) {
    for (int i = 0; i < HEAD; i++)
        c->head[i] *= by;
    for (int i = 0; i < TAIL; i++)
        c->tail[i] = (double)(c->tail[i] * by);
}

static void scale_stretch(stretch *s, fret_real by) {
    s->K *= by;
    s->G *= by;
    s->L *= by;
}

static void scale_piece(piece *p, fret_real by) {
    p->inner.F *= by;
    p->outer.F *= by;
    scale_polynomial(&p->rise[LOADS], by);
    scale_polynomial(&p->from_end[LOADS], by);
    scale_polynomial(&p->K, by);
    scale_polynomial(&p->dK, by);
    scale_polynomial(&p->work, by);
    p->sum[DEPTHS] *= by;
    p->sum[LOADS] *= by;
    p->K_inner *= by;
    scale_stretch(&p->whole, by);
}

/* NULL: out of memory. */
static struct fret_pieces *copy(const struct fret_pieces *from) {
    struct fret_pieces *all = malloc(sizeof *all);
    if (!all)
        return NULL;
    *all = *from;
    all->room = all->count;
    all->piece = malloc(all->count * sizeof *all->piece);
    all->reach = malloc(3 * all->count * sizeof *all->reach);
    bool ok = all->piece && all->reach;
    for (int l = 0; l < RUNS; l++) {
        const size_t count = from->run[l] ? from->count >> l : 0;
        all->run[l] = count && ok ? malloc(count * sizeof *all->run[l]) : NULL;
        ok = ok && (!count || all->run[l]);
        if (ok && count)
            memcpy(all->run[l], from->run[l], count * sizeof *all->run[l]);
    }
    if (!ok) {
        fret_pieces_free(all);
        return NULL;
    }
    memcpy(all->piece, from->piece, all->count * sizeof *all->piece);
    memcpy(all->reach, from->reach, 3 * all->count * sizeof *all->reach);
    return all;
}

static void scale(struct fret_pieces *all, fret_real by) {
    for (size_t i = 0; i < all->count; i++) {
        scale_piece(&all->piece[i], by);
        all->reach[2 * all->count + i] *= by;
    }
    for (int l = 0; l < RUNS; l++)
        for (size_t i = 0; all->run[l] && i < all->count >> l; i++)
            scale_stretch(&all->run[l][i], by);
    all->least.F *= by;
    scale_stretch(&all->core, by);
}

fret_status fret_normal_share(fret_normal *n, const fret_normal *from) {
    if (n->pieces || !from->pieces || !same_shape(n, from))
        return fret_ok();
    struct fret_pieces *all = copy(from->pieces);
    if (!all)
        return fret_fail(FRET_NO_MEMORY, NULL, 0, 0);
    const fret_real by = fret_normal_stiffness(n, 1) / fret_normal_stiffness(from, 1);
    all->normal = n;
    if (by != 1)
        scale(all, by);
    n->pieces = all;
    n->prepared = (double)(from->prepared * by);
    n->shared = true;
    n->borne = from->borne;
    return fret_ok();
}
