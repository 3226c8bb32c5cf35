/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One piece of the law of a contact as polynomials, and the object of all of them, which contacts share. Not
 * installed. */
#ifndef FRET_CONTACT_PIECE_H
#define FRET_CONTACT_PIECE_H

#include <stdatomic.h>

#include "contact/normal.h"

/* A piece maps z = -1..1 to distances e from the start of the gap through s = middle + half z, in which the
 * profile is smooth: e = exp(s), or beyond a row of a table e = origin + width s^4, which makes the kink
 * there, a power (k+3)/2 of the distance, smooth enough. What varies is a polynomial in z. */
enum { NODES = 20, TERMS = NODES + 1 };

/* The terms fall fast: of the later ones a double keeps all digits that count. head: powers 0..6. */
enum { HEAD = 7, TAIL = TERMS - HEAD };
typedef struct polynomial {
    fret_real head[HEAD];
    double tail[TAIL];
} polynomial;

/* A stretch of the law from its outer end inwards, t the distance in depth from that end: thickness, and
 * int dK, int t dK, int t (h-t) dK. All are positive and add up without a difference. */
typedef struct stretch {
    fret_real h, K, G, L;
} stretch;

/* The place of a rise, about: z, and dz/dv, by powers of v, -1..1. */
enum { GUESS = 12 };
typedef struct guide {
    double middle, scale; /* of what v is linear in */
    double term[GUESS][2];
} guide;

enum { DEPTHS, LOADS };
typedef struct piece {
    fret_real origin, width, middle, half; /* width 0: e = exp(s) */
    fret_level inner, outer;               /* depth and load at the ends */
    fret_real K_inner;                     /* dF/dy */
    guide guess[2];
    polynomial rise[2]; /* depth and load above the inner end */
    polynomial K, G, L; /* of the stretch from there to the inner end */
    polynomial dK;      /* the derivative of K */
    bool blunt, coarse; /* begins at a kink; wants its integrals in halves */
    stretch whole;
    fret_real sum[2]; /* int y dF, int F dy from the centre to the inner end */
} piece;
/* Lengths of runs: powers of two. */
enum { RUNS = 40 };
struct fret_blocks;
typedef struct law {
    atomic_size_t users;
    size_t count, room;
    piece *piece;             /* from the centre outwards */
    fret_real *reach;         /* the outer ends: distance, then depth, then load, `count` each */
    stretch *run[RUNS];       /* run[l][i]: the 2^l pieces from i 2^l on */
    struct fret_blocks *rows; /* beyond the pieces; or NULL */
    struct fret_blocks *thin; /* the same for slices of a smaller part than `enough` alone; or NULL */
    fret_real enough;
    fret_level least;         /* inner end of the first */
    stretch core;             /* within */
    fret_real start, K_start; /* of the gap, and K there */
    fret_real from, error, deep;
} law;

/* Loads are those of the law times `scale`. stop: that of the contact. */
struct fret_pieces {
    law *law;
    fret_real scale;
    fret_stop stop;
};

/* Outer part first. */
stretch fret_stretch_join(const stretch *outer, const stretch *inner);
/* The outer part of a stretch, which loses digits where that is small. */
stretch fret_stretch_less(const stretch *whole, const stretch *inner);
/* Adds to `sum` the runs below number `from`, down to and with number `to`. */
void fret_stretch_add_runs(stretch *const run[RUNS], size_t from, size_t to, stretch *sum);

/* From TERMS powers of z. */
polynomial fret_polynomial_of(const fret_real *c);
fret_real fret_polynomial_at(const polynomial *c, fret_real z);
/* c(z) = c(z0) + (z-z0) q(z) */
void fret_polynomial_quotient(const polynomial *c, fret_real z0, polynomial *q);

/* e at z, and de/dz. */
fret_real fret_piece_distance(const piece *p, fret_real z, fret_real *rate);
/* Of depths or loads: at a level; from the inner end to the outer. */
static inline fret_real fret_level_by(const fret_level *l, int by) {
    return by == LOADS ? l->F : l->y;
}
static inline fret_real fret_piece_rise(const piece *p, int by) {
    return fret_level_by(&p->outer, by) - fret_level_by(&p->inner, by);
}
/* The part from z to z-way; q: quotient of the depth at z. */
stretch fret_piece_part(const piece *p, const polynomial *q, fret_real z, fret_real way);
/* The part from z to the inner end: to a part of the whole, not of itself. */
stretch fret_piece_within(const piece *p, fret_real z);
/* z where the depth, or the load, is so far above that of the inner end. */
fret_real fret_piece_place(const piece *p, int by, fret_real rise);
/* The way inwards from z0 in which the depth, or the load, falls by `drop`, with all digits; q: the quotient
 * at z0, have: the rise from the inner end to there. */
fret_real fret_piece_way(const piece *p, int by, const polynomial *q, fret_real z0, fret_real have,
                         fret_real drop);
/* int (y-y_inner) dF and int (F-F_inner) dy from the inner end to z, and how far depth and load rise. */
fret_level fret_piece_work(const piece *p, fret_real z, fret_real work[2]);

/* While it is made: guesses of places, through those of z; the whole, and how far one rule for it is off. */
void fret_piece_make_guess(piece *p, int by, const fret_real z[GUESS]);
fret_real fret_piece_make_whole(piece *p);

#endif
