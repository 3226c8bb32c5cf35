/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The sum that every field is: rings, each a cell of the law, with the slopes of the slices that end in them.
 * Made once, only read afterwards. Not installed. */
#ifndef FRET_FIELD_RING_H
#define FRET_FIELD_RING_H

#include "field/kernel.h"
#include "law/normal.h"

/* Two sums are taken at once: of the contact as it is pressed, and of its slices by their slopes. */
enum { PRESSED, DRAGGED, LOADS };

/* What reaches from the end of the slice before to the radius a, y deep, with its slope. */
typedef struct slice {
    fret_real y, a, weight[LOADS];
} slice;

/* The end of a slice: v of a ring, linear in the square of the radius, which right next to a flat end tells
 * it better than the radius. */
typedef struct rim {
    size_t ring;
    fret_real v;
    bool by_v;
} rim;

/* g' against (x^2-r^2)^(m-1), and x^k g against (r^2-x^2)^-m. */
enum { SLOPES, DEPTHS, KINDS };

typedef struct ring {
    const fret_cell *cell;
    fret_cell *own;         /* the same where it is made for this sum alone */
    fret_real lo, hi;       /* radii */
    fret_real scale[KINDS]; /* width^(m-1), width^-m/2m */
    size_t first;           /* the first slice that ends in it or beyond */
    bool cut;               /* in it */
} ring;

/* Rings i 2^l .. (i+1) 2^l from afar: moments about the middle, times those of the kernel's series, of those
 * that no slice ends in. */
enum { TAYLOR = 36, LEVELS = 40 };
typedef struct block {
    fret_real lo, hi, half;
    double log_half; /* of half in units */
    double of[LOADS][KINDS][TAYLOR];
} block;

enum { OF_ONE, OF_SLOPE, OF_DEPTH, POWERS };

typedef struct rings {
    const fret_normal *normal;
    size_t first_cell;    /* of the law; */
    fret_real steep;      /* or the power that it is of, else 0 */
    fret_real m, unit;    /* (k+1)/2; the square of the largest radius */
    powers power[POWERS]; /* q = 0, that of the slope at a kink, and of the depth */
    int loads;
    size_t slices, count, room;
    const slice *slice; /* borrowed */
    rim *rim;
    ring *ring;
    block *block[LEVELS];
} rings;

/* Of the law's cells from number `first` on, or of one steep power, told at the end of the last slice. Slices
 * from the inner to the outer, there is one. Errors: FRET_NO_MEMORY, FRET_INTERRUPTED. */
fret_status fret_rings_make(const fret_normal *normal, size_t first, const fret_term *steep,
                            const slice *slices, size_t count, int loads, rings **out);
void fret_rings_free(rings *all);

/* Where a slice ends, which lies within. */
rim fret_rings_rim(const rings *all, const slice *s);

/* The sums at r: int g' (x^2-r^2)^(m-1) dx over x > r, each slice by its weight; of rings that have one slice
 * alone, as if that were `cut`, which lies within it; else NULL. */
fret_real fret_rings_slope(const rings *all, int load, fret_real r, const slice *cut);
/* int x^k g (r^2-x^2)^-m dx over the slices before number `end`, which r lies in or beyond, by how much more
 * they weigh than that one. */
fret_real fret_rings_depth(const rings *all, int load, fret_real r, size_t end, const slice *cut);

/* What is integrated over a cell, by v: a polynomial, and one times v^q, or for slopes v^(q-1). */
static inline int terms_of(const fret_cell *c, int kind, bool kinked) {
    return c->count[(kind == SLOPES ? RISE : AREA) + kinked];
}
static inline fret_real term_of(const fret_cell *c, int kind, bool kinked, int j) {
    return kind == SLOPES ? ((fret_real)j + (kinked ? c->q : 1)) * c->of[RISE + kinked][j]
                          : c->of[AREA + kinked][j];
}

/* The distance of squares, with all digits. */
static inline fret_real square_distance(fret_real x, fret_real y) {
    return (x - y) * (x + y);
}

/* How much a slice weighs; beyond the last there is nothing. */
static inline fret_real weight_of(const slice *s, size_t count, int load, size_t i) {
    return i < count ? s[i].weight[load] : 0;
}

#endif
