/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The loops of fret/batch.h for each instruction set, for tests and timings. Not installed. */
#ifndef FRET_CONTACT_BATCH_H
#define FRET_CONTACT_BATCH_H

#include <stdbool.h>

#include "fret/batch.h"

/* (F/Fref)^power for the normal contact. */
typedef struct fret_press_law {
    double inverse[2]; /* 1/m, high and low part, Fref = m 2^exponent */
    double exponent;
    double radius[2], depth[2]; /* 1/(n+k+1) and q, high and low part */
    double r0, dref;            /* [m] */
} fret_press_law;

/* (1 + rho^2 + ... + rho^2j)/(2j+3)!, the coefficients of (sinh(x)/x - sinh(rho x)/(rho x))/((1-rho^2) x^2)
 * in x^2. */
void fret_loss_series(double rho, int terms, double out[]);

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
