/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Inputs and names from measured data: least squares by Levenberg and Marquardt (GSL). */
#ifndef STUDY_FIT_H
#define STUDY_FIT_H

#include "study/residuals.h"

typedef struct fit_answer {
    double value[FIT_NAMES];
    double deviation[FIT_NAMES]; /* standard error, from the scatter of the residuals */
    /* Where the parabola of the sum of squares misleads, where points are asked for: how far down and up the
     * least sum with the name held there grows by one variance. */
    bool uneven[FIT_NAMES];
    double below[FIT_NAMES], above[FIT_NAMES]; /* infinite: it does not, as far as was looked */
    double correlation[FIT_NAMES][FIT_NAMES];
    double rms; /* of all residuals; in units of the noise, where a loop has it in both columns */
    bool noisy; /* it has: distances are across the curve, turning points unknowns */
    size_t turns;
    double noise_dx, noise_Fx;
    double together;      /* correlation of each residual with the next: of noise it is near 0 */
    bool drifts;          /* of a loop: it is not by chance, and the deviations are too small */
    dim d;                /* of them */
    bool twice;           /* a closed loop that does not begin at rest: run twice, the second time compared */
    unsigned evaluations; /* of all rows */
    unsigned iterations;
} fit_answer;

/* Starts from the present values. Errors: a name without one; a row without a value; names that the data do
 * not determine, or cannot tell apart. */
bool fit(const fit_question *question, fit_answer *out, calc_error *error);
void fit_points_free(fit_points *p);

#endif
