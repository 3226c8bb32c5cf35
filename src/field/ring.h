/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The sums over rings that make a field: each ring is a cell of the law with the slices that end in it.
 * Rings are immutable once made. Not installed. */
#ifndef FRET_FIELD_RING_H
#define FRET_FIELD_RING_H

#include "field/kernel.h"
#include "law/normal.h"

/* The two loads of a sum: PRESSED, all slices of weight 1, and DRAGGED, each weighted by its slope. */
enum { PRESSED, DRAGGED, LOADS };

/* A slice: the depths up to y, at radius a, from the end of the slice before; its weight in each sum. */
typedef struct slice {
    fret_real y, a, weight[LOADS];
} slice;

/* Where a slice ends: v of a ring, linear in x^2. by_v: v is the more exact, right next to a flat end. */
typedef struct slice_end {
    size_t ring;
    fret_real v;
    bool by_v;
} slice_end;

/* The two integrands: g' (x^2-r^2)^(m-1), and x^k g (r^2-x^2)^-m. */
enum { SLOPES, DEPTHS, KINDS };

typedef struct ring {
    const fret_cell *cell;
    fret_cell *own;         /* the same where this sum owns it, else NULL */
    fret_real lo, hi;       /* radii */
    fret_real scale[KINDS]; /* width^(m-1), width^-m/2m */
    size_t first;           /* index of the first slice that ends in the ring or beyond */
    bool cut;               /* does a slice end in it? */
} ring;

/* Block i of level l: the rings i 2^l to (i+1) 2^l - 1 seen from afar, as moments about the middle times
 * the coefficients of the kernel's series. Rings in which a slice ends are left out. */
enum { TAYLOR = 36, LEVELS = 40 };
typedef struct block {
    fret_real lo, hi, half;
    double log_half; /* ln(half / unit of the rings) */
    double of[LOADS][KINDS][TAYLOR];
} block;

enum { OF_ONE, OF_SLOPE, OF_DEPTH, POWERS };

typedef struct rings {
    const fret_normal *normal;
    size_t first_cell;    /* index of the first of the law's cells in use */
    fret_real steep;      /* the exponent of one steep power, else 0 */
    fret_real m, unit;    /* (k+1)/2; the square of the largest radius */
    powers power[POWERS]; /* for q = 0, and for g' and g at a kink */
    int loads;
    size_t slices, count, room;
    const slice *slice; /* borrowed */
    slice_end *ends;
    ring *ring;
    block *block[LEVELS];
} rings;

/* Makes rings of the law's cells from index `first` on or, where `steep` is not NULL, of that power, whose
 * G is its depth at the end of the last slice. count >= 1 slices, the innermost first, are borrowed.
 * Errors: FRET_NO_MEMORY, FRET_INTERRUPTED. */
fret_status fret_rings_make(const fret_normal *normal, size_t first, const fret_term *steep,
                            const slice *slices, size_t count, int loads, rings **out);
void fret_rings_free(rings *all);

/* The position of a slice's end within the rings. */
slice_end fret_rings_end(const rings *all, const slice *s);

/* int g' (x^2-r^2)^(m-1) dx over x > r, each slice by its weight. cut: NULL, or a smaller slice in place of
 * the only one that `all` has. */
fret_real fret_rings_slope(const rings *all, int load, fret_real r, const slice *cut);
/* int x^k g (r^2-x^2)^-m dx over the slices before index `end`, each by its weight less that of slice
 * `end`; r lies in slice `end` or beyond the contact. */
fret_real fret_rings_depth(const rings *all, int load, fret_real r, size_t end, const slice *cut);

/* The integrand over a cell: a polynomial in v, plus (kinked) one times v^q, or v^(q-1) for slopes: the
 * number of their terms, and coefficient j. */
static inline int terms_of(const fret_cell *c, int kind, bool kinked) {
    return c->count[(kind == SLOPES ? RISE : AREA) + kinked];
}
static inline fret_real term_of(const fret_cell *c, int kind, bool kinked, int j) {
    return kind == SLOPES ? ((fret_real)j + (kinked ? c->q : 1)) * c->of[RISE + kinked][j]
                          : c->of[AREA + kinked][j];
}

/* x^2 - y^2 without cancellation. */
static inline fret_real square_distance(fret_real x, fret_real y) {
    return (x - y) * (x + y);
}

/* The weight of slice i; 0 beyond the last. */
static inline fret_real weight_of(const slice *s, size_t count, int load, size_t i) {
    return i < count ? s[i].weight[load] : 0;
}

#endif
