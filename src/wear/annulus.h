/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The ring that wears, cut into nodes: how fast each of them wears. Not installed. */
#ifndef FRET_WEAR_ANNULUS_H
#define FRET_WEAR_ANNULUS_H

#include "fret/wear.h"

/* Nodes i < count at t = r^2, between which f, g and what is made of them are straight in t: then f' dr = df
 * and both transforms have the weights ((x^2-t)^m)/m, m = (k+1)/2. Depths count from g at the inner end,
 * within which nothing wears, loads from that of the contact up to there. */
typedef struct fret_annulus {
    size_t count;
    const fret_real *x; /* radii, borrowed */
    double m, of_slope; /* p = of_slope int g' (x^2-r^2)^(m-1) dx */
    double *t, *g0;
    double *x1k;                       /* x^(1-k) */
    double *to_g;                      /* row i > 0: of df of the cells j < i */
    double *to_p;                      /* row i: of dg of the cells j >= i */
    double *weight;                    /* dF_N/dw of each node */
    double inner;                      /* the same of all springs within */
    double *g, *w, *slip, *p, *change; /* of the last rate; w: how far springs are pressed */
    size_t touched;                    /* the last node that has been in contact */
    /* what is held, counted so */
    bool by_depth, by_displacement;
    double press, amplitude, mu, eta, alpha;
    double depth, force; /* of the last rate; force: of all springs, from 0 */
    double within;       /* load of the contact up to the inner end */
} fret_annulus;

/* Of radii x[0] < x[1] < ... within the gap. held: press by depth in so far as the tip had been there when
 * nothing had worn. Errors: FRET_NO_MEMORY. Free with fret_annulus_free, also after an error. */
fret_status fret_annulus_make(const fret_normal *normal, const fret_wear_held *held, fret_real depth,
                              const fret_real *x, size_t count, fret_annulus *out);
void fret_annulus_free(fret_annulus *annulus);

/* dh/dn of the depths h, and at [count] the work of one cycle. Error: FRET_GROSS_SLIP. */
fret_status fret_annulus_rate(fret_annulus *annulus, const double *h, double *rate);

/* The ring as far as it is in contact after the last rate stays so. */
void fret_annulus_touch(fret_annulus *annulus);

/* An estimate of the fastest decay per cycle, by powers of dh -> d rate at the slip of the last rate; v holds
 * a vector from one time to the next. */
double fret_annulus_stiffness(fret_annulus *annulus, double *v);

/* What depths h at the radii x add to g anywhere, from the inner end on. */
fret_real fret_annulus_profile(fret_real k, const fret_real *x, const double *h, size_t count, fret_real at);

/* The size of depths: the root of the sum of squares by area. */
double fret_annulus_norm(const fret_annulus *annulus, const double *h);

#endif
