/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef FRET_GAP_H
#define FRET_GAP_H

#include <stddef.h>

#include "fret/status.h"

FRET_BEGIN

/* The initial gap f(r) between the bodies, and its equivalent profile g(x) in a graded foundation:
 *   g(x) = x^(1-k) int_0^x f'(r) (x^2-r^2)^((k-1)/2) dr        (3), lengths in m. */
typedef enum fret_gap_kind {
    FRET_GAP_POWER,           /* f = h (r/r0)^n; A r^n is h = A, r0 = 1 m */
    FRET_GAP_SUM,             /* a sum of such powers */
    FRET_GAP_FLAT_CONE,       /* f = slope (r-b), r > b */
    FRET_GAP_FLAT_PARABOLOID, /* f = (r^2-b^2)/(2R), r > b */
    FRET_GAP_FLAT_ROUNDED,    /* f = (r-b)^2/(2R), r > b: the usual fretting pad */
    FRET_GAP_EXACT_SPHERE,    /* f = R - sqrt(R^2-r^2), r <= 0.95 R */
    FRET_GAP_TABLE,           /* sampled gap, monotone piecewise cubic */
    FRET_GAP_FLAT,            /* the flat end of a rigid punch: f = 0 for r < b, and nothing beyond */
    FRET_GAP_WORN             /* what wear has left of another, as fret_wear_law has it: made there alone */
} fret_gap_kind;

enum { FRET_GAP_TERMS = 16 };

typedef struct fret_power {
    double n;  /* exponent, > 0 */
    double h;  /* gap at r0 [m]; > 0 for a single power */
    double r0; /* reference radius [m], > 0 */
} fret_power;

struct fret_table;
struct fret_worn;

typedef struct fret_gap {
    fret_gap_kind kind;
    int terms; /* powers in use: POWER 1, SUM up to FRET_GAP_TERMS */
    fret_power power[FRET_GAP_TERMS];
    double b;                       /* radius of the flat end [m] */
    double R;                       /* radius of curvature [m] */
    double slope;                   /* flank slope, tan of the angle to the base plane */
    const struct fret_table *table; /* TABLE only; borrowed */
    const struct fret_worn *worn;   /* WORN only; borrowed */
} fret_gap;

/* kappa(n,k) = (n/2) B(n/2,(k+1)/2) (6)-(8): the profile of r^n is kappa x^n.
 * Range n > 0, -1 < k < 1, else NaN. Accuracy 1e-19 relative for n <= 1e6; no overflow at large n. */
fret_real fret_kappa(double n, double k);

/* Checks the parameters of a gap. Errors: FRET_NOT_FINITE, FRET_NOT_POSITIVE naming the parameter;
 * FRET_OUTSIDE (no such kind, terms beyond those of the kind, no table, nothing worn). The functions below
 * take one that has passed. */
fret_status fret_gap_check(const fret_gap *gap);

/* f(r) [m], r >= 0 [m]. Errors: FRET_NEGATIVE, FRET_OUTSIDE (beyond a sphere, a table or a flat punch),
 * FRET_NOT_FINITE. */
fret_status fret_gap_f(const fret_gap *gap, fret_real r, fret_real *f);

/* g(x) [m] and, where slope is not NULL, g'(x), for |x| [m], -1 < k < 1. Errors as above, and FRET_BAD_K.
 * Accuracy 1e-17 relative; tables 2e-16, the rounding of their slopes. A table costs 0.5 us a
 * row: fret_normal_profile does not. Of a worn gap g is that of the k that it was worn with. */
fret_status fret_gap_g(const fret_gap *gap, double k, fret_real x, fret_real *g, fret_real *slope);

/* A sampled gap: r[0] = 0 < r[1] < ..., f[0] = 0, lengths in m. Copies the arrays. A million rows take
 * seconds: the stop flag, which may be NULL, is looked at meanwhile and is not kept. Errors: FRET_BAD_TABLE,
 * FRET_NOT_FINITE, FRET_NO_MEMORY, FRET_INTERRUPTED. Free with fret_table_free. */
fret_status fret_table_make(const double *r, const double *f, size_t count, fret_stop stop,
                            struct fret_table **out);
/* What of more than 2000 rows is left, as pieces of a cubic with f' at both ends, and how far these are off,
 * as a part of the largest f: as few as do within 1e-14 to 1e-6 of it, the first that leaves 2000 or fewer; 0
 * where every row is one. */
size_t fret_table_count(const struct fret_table *table);
double fret_table_within(const struct fret_table *table);
/* The same with f' given at each row: f is the cubic Hermite interpolant, so that a cubic spline comes out as
 * it is. Errors also: FRET_NOT_FINITE naming slope. */
fret_status fret_table_sloped(const double *r, const double *f, const double *slope, size_t count,
                              fret_stop stop, struct fret_table **out);
void fret_table_free(struct fret_table *table);

FRET_END

#endif
