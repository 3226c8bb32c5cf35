/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The annulus that wears, discretised by nodes, and the wear rate of each node. Not installed. */
#ifndef FRET_WEAR_ANNULUS_H
#define FRET_WEAR_ANNULUS_H

#include "fret/wear.h"

/* Nodes i < count lie at t = r^2 - r_inner^2. Between nodes f and g are straight in t, so that f' dr = df and
 * both transforms have the weights ((x^2-t)^m)/m, m = (k+1)/2. Rows count..rows-1 lie beyond the ring:
 * nothing wears there, but the wear inside changes g. Depths count from g at the inner end, inside which
 * nothing wears, and forces from F_N of the contact that ends there. */
typedef struct fret_annulus {
    size_t count, rows;
    fret_real *x; /* radii */
    double *t, *g0;
    double *x1k;                       /* x^(1-k) */
    double *to_g;                      /* row i > 0: factors of df in the cells j < i */
    double *to_p;                      /* row i: factors of dg in the cells j >= i */
    double *weight;                    /* dF_N/dw of each node */
    double inner;                      /* the same of all springs inside the inner end */
    double *g, *w, *slip, *p, *change; /* of the last rate; w: compression of the springs */
    size_t touched;                    /* the last node that has ever been in contact */
    /* what is held, counted as above; amplitude: F_A/mu or delta_A/(mu eta) */
    bool by_depth, by_displacement;
    double press, amplitude, mu, eta, alpha, of_slope; /* p = of_slope int g' (x^2-r^2)^(m-1) dx */
    double depth;                                      /* of the last rate */
    double within;                                     /* F_N of the contact that ends at the inner end */
} fret_annulus;

/* Makes an annulus between two radii within the gap. Nodes are densest at `steep`; the second node lies at
 * `second` at most. Errors: FRET_NO_MEMORY. Free with fret_annulus_free, also after an error. */
fret_status fret_annulus_make(const fret_normal *normal, const fret_wear_held *held, fret_real inner,
                              fret_real steep, fret_real outer, fret_real second, size_t count,
                              fret_annulus *out);
void fret_annulus_free(fret_annulus *annulus);

/* The rate dh/dn [m] for the worn depths h, and in rate[count] the work of friction in a cycle [J]. Error:
 * FRET_GROSS_SLIP. */
fret_status fret_annulus_rate(fret_annulus *annulus, const double *h, double *rate);

/* Marks the nodes in contact at the last rate as touched: their springs stay in the sums from now on. */
void fret_annulus_touch(fret_annulus *annulus);

/* Estimates the fastest decay rate per cycle by power iteration on the map dh -> d(rate) at the slip of the
 * last rate. v: the vector of the iteration, kept between calls. */
double fret_annulus_stiffness(fret_annulus *annulus, double *v);

/* g of the worn gap in all rows, in a buffer that the next call overwrites; depth: of its press. Both count
 * from the tip. */
const double *fret_annulus_profile(fret_annulus *annulus, const double *h, double *depth);

/* The norm of depths, weighted by area; and the volume [m^3]. */
double fret_annulus_norm(const fret_annulus *annulus, const double *h);
fret_real fret_annulus_volume(const fret_annulus *annulus, const double *h);

#endif
