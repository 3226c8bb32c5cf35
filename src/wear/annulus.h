/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The ring that wears, cut into nodes: how fast each of them wears. Not installed. */
#ifndef FRET_WEAR_ANNULUS_H
#define FRET_WEAR_ANNULUS_H

#include "fret/wear.h"

/* Nodes i < count at t = r^2 less that of the inner end, between which f, g and what is made of them are
 * straight in t: then f' dr = df and both transforms have the weights ((x^2-t)^m)/m, m = (k+1)/2; and beyond
 * the ring, up to `rows`, places where nothing wears, for what is worn within changes g there too. Depths
 * count from g at the inner end, within which nothing wears, loads from that of the contact up to there. */
typedef struct fret_annulus {
    size_t count, rows;
    fret_real *x; /* radii */
    double *t, *g0;
    double *x1k;                       /* x^(1-k) */
    double *to_g;                      /* row i > 0: of df of the cells j < i */
    double *to_p;                      /* row i: of dg of the cells j >= i */
    double *weight;                    /* dF_N/dw of each node */
    double inner;                      /* the same of all springs within */
    double *g, *w, *slip, *p, *change; /* of the last rate; w: how far springs are pressed */
    size_t touched;                    /* the last node that has been in contact */
    /* what is held, counted so; of_slope: p = of_slope int g' (x^2-r^2)^(m-1) dx */
    bool by_depth, by_displacement;
    double press, amplitude, mu, eta, alpha, of_slope;
    double depth;  /* of the last rate */
    double within; /* load of the contact up to the inner end */
} fret_annulus;

/* Between two radii within the gap, nodes closest at `steep`, the node next to the inner one at `second` at
 * most. Errors: FRET_NO_MEMORY. Free with fret_annulus_free, also after an error. */
fret_status fret_annulus_make(const fret_normal *normal, const fret_wear_held *held, fret_real inner,
                              fret_real steep, fret_real outer, fret_real second, size_t count,
                              fret_annulus *out);
void fret_annulus_free(fret_annulus *annulus);

/* dh/dn of the depths h, and at [count] the work of one cycle. Error: FRET_GROSS_SLIP. */
fret_status fret_annulus_rate(fret_annulus *annulus, const double *h, double *rate);

/* The ring as far as it is in contact after the last rate stays so. */
void fret_annulus_touch(fret_annulus *annulus);

/* An estimate of the fastest decay per cycle, by powers of dh -> d rate at the slip of the last rate; v holds
 * a vector from one time to the next. */
double fret_annulus_stiffness(fret_annulus *annulus, double *v);

/* g of the worn gap in all rows, which it keeps: they change with the next question; and how deep it is
 * pressed, from its tip. */
const double *fret_annulus_profile(fret_annulus *annulus, const double *h, double *depth);

/* The size of depths: the root of the sum of squares by area; and the volume. */
double fret_annulus_norm(const fret_annulus *annulus, const double *h);
fret_real fret_annulus_volume(const fret_annulus *annulus, const double *h);

#endif
