/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Smooths a noisy profile by a cubic least-squares spline. Depends on GSL, scene/inputs and text. */
#ifndef STUDY_SMOOTH_H
#define STUDY_SMOOTH_H

#include "scene/inputs.h"
#include "text/file.h"

enum { SMOOTH_PIECES_MOST = 200, SMOOTH_PIECES_TRIED = 100 };

/* The spline and its deviation from the rows. */
typedef struct smooth_answer {
    size_t pieces;
    double *r, *f, *slope; /* at the ends of the pieces, pieces + 1 values each; f and slope begin with 0 */
    double rms, worst;     /* deviations [m] */
    double at;             /* r of the worst deviation [m] */
    double offset;         /* height of the rows at r = 0 [m], subtracted */
} smooth_answer;

/* Smooths rows r, f [m] in any order; r < 0 is the other side. The gap is f(|r|) - f(0) with f'(0) = 0 and
 * continuous f''; all pieces hold the same number of rows. If noise makes the MDR profile g(x) fall, the
 * nearest convex gap is taken. SMOOTH_FREELY: the number of pieces, up to SMOOTH_PIECES_TRIED, with the least
 * generalised cross-validation error; SMOOTH_WITHIN: the fewest with this rms. Errors: too few rows; a
 * profile that falls by more than noise; none within the rms; interrupted. Free with smooth_free, also after
 * a failure. */
bool smooth(const double *r, const double *f, size_t rows, smoothing how, file_stop stop, smooth_answer *out,
            calc_error *error);
void smooth_free(smooth_answer *a);

#endif
