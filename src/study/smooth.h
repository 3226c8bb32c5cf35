/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A noisy profile made smooth: the cubic spline nearest to its rows (GSL). Knows numbers alone. */
#ifndef STUDY_SMOOTH_H
#define STUDY_SMOOTH_H

#include "scene/inputs.h"
#include "text/file.h"

enum { SMOOTH_PIECES_MOST = 200, SMOOTH_PIECES_TRIED = 100 };

/* What came out, and how far it is from the rows. */
typedef struct smooth_answer {
    size_t pieces;
    double *r, *f, *slope; /* ends of the pieces: pieces + 1 of each; f and slope begin with 0 */
    double rms, worst;     /* [m] */
    double at;             /* where it is worst [m] */
    double offset;         /* of the rows: their height at r = 0 [m], taken off */
} smooth_answer;

/* Rows r, f in m in any order; r < 0 is the other side. The gap is f(|r|) - f(0) with f'(0) = 0 and a
 * continuous f'', its pieces hold as many rows each. Where noise makes g(x) fall, it is the nearest convex
 * gap. SMOOTH_FREELY: of up to SMOOTH_PIECES_TRIED pieces those with the least error of prediction
 * (generalised cross-validation); SMOOTH_WITHIN: the fewest with this rms. Errors: too few rows; a profile
 * that falls by more than noise, and where; no profile within; interrupted. Free with smooth_free whatever
 * comes. */
bool smooth(const double *r, const double *f, size_t rows, smoothing how, file_stop stop, smooth_answer *out,
            calc_error *error);
void smooth_free(smooth_answer *a);

#endif
