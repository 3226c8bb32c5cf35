/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef FRET_BATCH_H
#define FRET_BATCH_H

#include <stddef.h>

#include "fret/normal.h"

/* The closed forms in double, for many loads at once or for one after another: ten times as fast as the
 * functions of cycle.h and normal.h, where 15 digits will do. The results have the same bits one by one and
 * in a batch, on every processor and from every compiler. This holds for power laws. For other shapes, and
 * where mu F_N, delta_x,max or their product leaves 1e-270..1e270, the results are those of the functions
 * named, rounded to double. Accuracy is relative, for the arguments as given and results that are not
 * denormal. */

/* All that does not depend on the tangential load. Borrows the contact; not to be read from outside. */
enum { FRET_SWEEP_TERMS = 15 };
typedef struct fret_sweep {
    const fret_normal *normal;
    fret_press press;
    double mu;
    bool fast;                       /* else by the functions of cycle.h */
    double inverse[2];               /* 1/(mu F_N), high and low part */
    double q;                        /* n/(n+k+1) */
    double alpha;                    /* (1+q)/2 */
    double sigma, rho;               /* 2q/(1+q), r/(1+q), r = 1-q */
    double shallow, deep;            /* exponents of the two forms of the loss */
    double scale, gross, cubic;      /* 4 mu F_N delta_x,max; that times rho, and times q r */
    double series[FRET_SWEEP_TERMS]; /* in alpha^2 L^2, L = -log(1-t) */
    double slip;                     /* delta_x,max [m] */
    double a, radius[2];             /* [m]; 1/(n+k+1), high and low part */
} fret_sweep;

/* Errors: FRET_NOT_POSITIVE (mu, FN), FRET_NOT_FINITE. */
fret_status fret_sweep_make(const fret_normal *normal, double mu, const fret_press *press, fret_sweep *out);

/* Energy [J] dissipated in a cycle -FA .. FA, as fret_cycle_loss: 2e-15.
 * Range 0 <= FA <= mu F_N [N]; NaN outside. */
double fret_sweep_loss(const fret_sweep *sweep, double FA);

/* Stick radius [m] and displacement [m] of first loading to Fx [N], as fret_loading_force: 1e-15.
 * Range |Fx| <= mu F_N; NaN outside. */
double fret_sweep_radius(const fret_sweep *sweep, double Fx);
double fret_sweep_displacement(const fret_sweep *sweep, double Fx);

/* The same for arrays of `count` loads; the arrays must not overlap.
 * Errors: those of fret_sweep_make, and of fret_cycle_loss or fret_loading_force for the first load that is
 * out of range: results before it are valid, those from there on are unspecified. */
fret_status fret_batch_loss(const fret_normal *normal, double mu, const fret_press *press, const double FA[],
                            double loss[], size_t count);
/* c or dx may be NULL. */
fret_status fret_batch_loading(const fret_normal *normal, double mu, const fret_press *press,
                               const double Fx[], double c[], double dx[], size_t count);

/* Contact radii [m] and indentation depths [m] of the loads F [N] >= 0, as fret_press_force: 1e-15.
 * a or dz may be NULL and is then not checked either. Errors: those of fret_press_force, as above. */
fret_status fret_batch_press(const fret_normal *normal, const double F[], double a[], double dz[],
                             size_t count);

#endif
