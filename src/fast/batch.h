/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The loops of fret/batch.h for each instruction set. Not installed. */
#ifndef FRET_FAST_BATCH_H
#define FRET_FAST_BATCH_H

#include <stdbool.h>
#include <stddef.h>

#include "fret/batch.h"

enum { FRET_SWEEP_TERMS = 15 };

/* All that does not depend on the tangential load. */
typedef struct fret_sweep {
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
fret_status fret_sweep_make(const fret_contact *contact, fret_sweep *out);

/* (F/Fref)^power for the normal contact. */
typedef struct fret_press_law {
    double inverse[2]; /* 1/m, high and low part, Fref = m 2^exponent */
    double exponent;
    double radius[2], depth[2]; /* 1/(n+k+1) and q, high and low part */
    double r0, dref;            /* [m] */
} fret_press_law;

/* Each loop returns whether some result is NaN. */
typedef struct fret_variant {
    const char *name;
    bool (*runs)(void); /* on this processor */
    bool (*loss)(const fret_sweep *w, const double *F, double *out, size_t count);
    bool (*displacement)(const fret_sweep *w, const double *F, double *out, size_t count);
    bool (*radius)(const fret_sweep *w, const double *F, double *out, size_t count);
    bool (*press_radius)(const fret_press_law *w, const double *F, double *out, size_t count);
    bool (*press_depth)(const fret_press_law *w, const double *F, double *out, size_t count);
} fret_variant;

/* The best first; the last one runs everywhere. */
extern const fret_variant fret_variants[];
extern const size_t fret_variant_count;

void fret_press_law_make(const fret_normal *normal, fret_press_law *out);

#endif
