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
    FRET_GAP_WORN             /* another gap after wear; only fret_wear_law makes one */
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

/* kappa(n,k) = (n/2) B(n/2,(k+1)/2) (6)-(8): the profile of r^n is kappa x^n. Range n > 0, -1 < k < 1, else
 * NaN. Accuracy 1e-19 relative for n <= 1e6; no overflow at large n. */
fret_real fret_kappa(double n, double k);

/* Checks the parameters of a gap, as the functions below require. Errors: FRET_NOT_FINITE, FRET_NOT_POSITIVE
 * naming the parameter; FRET_OUTSIDE (unknown kind, too many terms, no table, no worn gap). */
fret_status fret_gap_check(const fret_gap *gap);

/* f(r) [m], r >= 0 [m]. Errors: FRET_NEGATIVE, FRET_OUTSIDE (beyond a sphere, a table or a flat punch),
 * FRET_NOT_FINITE. */
fret_status fret_gap_f(const fret_gap *gap, fret_real r, fret_real *f);

/* g(x) [m] and, if slope is not NULL, g'(x), for |x| [m], -1 < k < 1. Errors as of fret_gap_f, and
 * FRET_BAD_K. Accuracy 1e-17 relative; tables 2e-16, the rounding of their slopes. A table takes 0.5 us a
 * row; fret_normal_profile avoids that. For a worn gap g is that of the k that it was worn with. */
fret_status fret_gap_g(const fret_gap *gap, double k, fret_real x, fret_real *g, fret_real *slope);

/* Makes a sampled gap from r[0] = 0 < r[1] < ..., f[0] = 0, lengths in m. Copies the arrays. A million rows
 * take seconds: the stop flag, which may be NULL, is polled meanwhile and not kept. Errors: FRET_BAD_TABLE
 * naming r, f or count, FRET_NOT_FINITE, FRET_NO_MEMORY, FRET_INTERRUPTED. Free with fret_table_free. */
fret_status fret_table_make(const double *r, const double *f, size_t count, fret_stop stop,
                            struct fret_table **out);
/* A table of more than 2001 rows is thinned to cubic pieces with f' given at both ends. The number of rows
 * kept; and the tolerance of the thinning, as a part of the largest f: the least of 1e-14, 1e-13 .. 1e-6 that
 * keeps at most 2000 rows (else 1e-6); 0 for a table that was not thinned. */
size_t fret_table_count(const struct fret_table *table);
double fret_table_within(const struct fret_table *table);
/* As fret_table_make, with f' given at each row: f is the cubic Hermite interpolant, so that a cubic spline
 * is reproduced. One more error: FRET_NOT_FINITE naming slope. */
fret_status fret_table_sloped(const double *r, const double *f, const double *slope, size_t count,
                              fret_stop stop, struct fret_table **out);
void fret_table_free(struct fret_table *table);

FRET_END

#endif
