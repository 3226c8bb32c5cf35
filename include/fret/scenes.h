/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef FRET_SCENES_H
#define FRET_SCENES_H

#include <stdbool.h>
#include <stddef.h>

#include "fret/base.h"

FRET_BEGIN

/* Many scenes at once, each of two half-spaces, a gap h (r/r0)^n, a load and friction of its own: the closed
 * forms of material.h, normal.h and cycle.h in vectors, twenty times as fast as these one by one. The results
 * have the same bits on every processor and from every compiler, and a relative error below 2e-15 of the
 * arguments as given. */

/* The inputs: an array of `count` values each. */
typedef struct fret_scenes {
    const double *E0[2], *nu[2]; /* [Pa]; E0[1] NULL: as the first body */
    const double *k, *c0;        /* c0 [m] */
    const double *n, *h, *r0;    /* of the gap [m] */
    const double *F, *mu;        /* F_N [N] */
    const double *Fx;            /* tangential force, or the amplitude of a cycle, 0 <= Fx <= mu F_N [N]; NULL
                                    without the last three results */
    bool rigid;                  /* the second body is */
} fret_scenes;

/* The results: arrays as long, or NULL. */
typedef struct fret_scene_values {
    double *hN, *hT, *beta;  /* of the first body, fret_half_space */
    double *cN0, *cT0, *eta; /* [Pa], fret_foundation_make */
    double *kappa;           /* fret_kappa */
    double *a, *dz, *kn;     /* [m], [m], [N/m]: fret_press_by_force, fret_normal_stiffness */
    double *slip;            /* delta_x,max [m], fret_gross_slip */
    double *c, *dx;          /* [m], fret_loading_by_force */
    double *loss;            /* [J], fret_cycle_loss_by_force */
} fret_scene_values;

/* NaN where the functions named are to be asked: inputs out of range, n outside 0.05 .. 1000, n+k+1 < 1/4,
 * moduli, lengths, forces or results outside 1e-60 .. 1e60, Fx below 1e-20 mu F_N. True: there is a NaN. */
bool fret_batch_scenes(const fret_scenes *scenes, const fret_scene_values *out, size_t count);

FRET_END

#endif
