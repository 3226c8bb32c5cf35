/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The law of one contact for another of the same shape and k: loads in proportion. */
#include <stdlib.h>

#include "contact/check.h"
#include "contact/piece.h"
#include "contact/pieces.h"

static bool same_shape(const fret_normal *a, const fret_normal *b) {
    const fret_gap *f = &a->gap, *g = &b->gap;
    const fret_power *p, *q;
    const int terms = fret_gap_powers(f, &p);
    if (a->foundation.k != b->foundation.k || f->kind != g->kind || terms != fret_gap_powers(g, &q) ||
        f->b != g->b || f->R != g->R || f->slope != g->slope || f->table != g->table)
        return false;
    for (int i = 0; i < terms; i++)
        if (p[i].n != q[i].n || p[i].h != q[i].h || p[i].r0 != q[i].r0)
            return false;
    return true;
}

fret_status fret_normal_share(fret_normal *n, const fret_normal *from) {
    if (n->pieces || !from->pieces || !same_shape(n, from))
        return fret_ok();
    struct fret_pieces *pieces = malloc(sizeof *pieces);
    if (!pieces)
        return fret_fail(FRET_NO_MEMORY, NULL, 0, 0);
    const fret_real by = fret_normal_stiffness(n, 1) / fret_normal_stiffness(from, 1);
    *pieces = (struct fret_pieces){from->pieces->law, from->pieces->scale * by, n->stop};
    atomic_fetch_add(&pieces->law->users, 1);
    n->pieces = pieces;
    n->prepared = (double)(from->prepared * by);
    n->shared = true;
    n->borne = from->borne;
    return fret_ok();
}
