/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a density consists of: rings, in each of which the profile is two polynomials, and blocks of rings as
 * they look from afar. For those who make one or integrate over it. Not installed. */
#ifndef FRET_FIELD_RING_H
#define FRET_FIELD_RING_H

#include "field/kernel.h"
#include "field/rows.h"
#include "number/chebyshev.h"

/* s = lo^2 + width y. What varies is smooth + y^q kink, polynomials in y. */
typedef struct curve {
    int smooth, kink; /* terms */
    fret_real c[2][MOST];
} curve;

enum { SLOPE, DEPTH, KINDS };

typedef struct ring {
    fret_real lo, hi, width;
    curve of[KINDS];        /* g' dx/dy, and with q+1 x^k g dx/dy */
    fret_real scale[KINDS]; /* width^(m-1), width^-m */
} ring;

/* Stretches first .. last-1 from afar: the moments of the kernel's series about the middle. A block precedes
 * its two halves, unless it is a leaf. */
enum { TAYLOR = 56 };
typedef struct block {
    size_t first, last, next;
    fret_real lo, hi, half;
    double log_half; /* of half in units */
    double moment[KINDS][TAYLOR];
} block;

enum { OF_ONE, OF_SLOPE, OF_DEPTH, POWERS };

/* Those of a table are made of its rows, when they are wanted where they are many. */
struct fret_density {
    fret_real m, from, from_depth, unit, error;
    powers power[POWERS]; /* q = 0, that of the slope, and of the depth */
    flat_field flat;
    double far_scale[KINDS];
    fret_real reach, reach_power;           /* the radius up to which it goes, that to the power of 2(m-1) */
    double moment[POWERS][MOST][TAYLOR];    /* int_0^1 y^(q+j) (2y-1)^n dy */
    double binomial[KINDS][TAYLOR];         /* of the kernel's series */
    size_t count, kept, room, blocks, leaf; /* rings, those kept; how many a leaf has */
    size_t heads;                           /* rings before the rows */
    ring *ring;
    block *block;
    struct fret_rows *rows; /* or NULL */
    fret_chebyshev rule;    /* of y */
    fret_real node_q[MOST]; /* y^q of the slope at its nodes */
};

/* The distance of squares, with all digits. */
static inline fret_real square_distance(fret_real x, fret_real y) {
    return (x - y) * (x + y);
}

/* c[0] + c[1] y + ... */
static inline fret_real fret_ring_value(const fret_real *c, int count, fret_real y) {
    fret_real v = 0;
    while (count-- > 0)
        v = v * y + c[count];
    return v;
}

/* The largest of values at the nodes. */
fret_real fret_ring_largest(const fret_real *value);
/* Powers of y through values at the nodes. Returns how large the last terms are, of the whole. */
fret_real fret_ring_fit(const fret_chebyshev *rule, const fret_real *value, fret_real whole, fret_real *c,
                        int *count);
/* What is left of the last terms of x^k g dx/dy, from rises over y of g, smooth and of the kink. */
fret_real fret_ring_fit_depth(const struct fret_density *d, ring *p, fret_real depth, const fret_real *smooth,
                              const fret_real *sharp);
void fret_ring_scale(const struct fret_density *d, int kind, ring *p);

/* A density of the rings that `cover` adds from one radius to another, of which g' alone counts. cover: false
 * where it is stopped or there is no memory. */
typedef bool fret_ring_cover(struct fret_density *d, void *context);
fret_status fret_density_of_rings(const fret_normal *normal, fret_real from, fret_real to,
                                  fret_ring_cover *cover, void *context, struct fret_density **out);
bool fret_ring_add(struct fret_density *d, const ring *p);

/* Ring i from its row. */
void fret_ring_take(const struct fret_density *d, size_t i, int kind, ring *out);
/* The same of a row to a double's digits, for one that is far; false: the row is wide. */
bool fret_ring_take_about(const struct fret_density *d, const fret_row_part *row, int kind, ring *out);
/* Ring i, or the one that is kept. */
static inline const ring *fret_ring_at(const struct fret_density *d, size_t i, int kind, ring *room) {
    if (i < d->kept)
        return &d->ring[i];
    fret_ring_take(d, i, kind, room);
    return room;
}

#endif
