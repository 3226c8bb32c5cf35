/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Fits inputs and names to data: least squares by Levenberg and Marquardt. Depends on residuals.h and GSL. */
#ifndef STUDY_FIT_H
#define STUDY_FIT_H

#include "study/residuals.h"

typedef struct fit_answer {
    double value[FIT_NAMES];
    double deviation[FIT_NAMES]; /* standard error, from the scatter of the residuals */
    /* uneven: the interval value - below .. value + above, at whose ends the least sum of squares with the
     * name held has grown by one variance, is not symmetric. Found only if points are asked for. */
    bool uneven[FIT_NAMES];
    double below[FIT_NAMES], above[FIT_NAMES]; /* infinite: not within 64 standard errors */
    double correlation[FIT_NAMES][FIT_NAMES];
    double rms;   /* of all residuals; if `noisy`, in units of the noise */
    bool noisy;   /* a loop with noise in both columns: distances across the curve, turning points unknown */
    size_t turns; /* turning points that are unknowns */
    double noise_dx, noise_Fx;
    double together;      /* correlation of successive residuals; near 0 for white noise */
    bool drifts;          /* `together` is significant: the standard errors are too small */
    dim d;                /* dimension of the residuals */
    bool twice;           /* begun within a steady cycle, not at rest: run twice, the second pass compared */
    unsigned evaluations; /* of all rows */
    unsigned iterations;
} fit_answer;

/* Fits from the present values. Errors: a name or a row has no value; the data do not determine a name, or
 * cannot tell names apart; the fit does not settle. */
bool fit(const fit_question *question, fit_answer *out, calc_error *error);
void fit_points_free(fit_points *p);

#endif
