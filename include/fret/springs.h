/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef FRET_SPRINGS_H
#define FRET_SPRINGS_H

#include <stddef.h>

#include "fret/contact.h"

FRET_BEGIN

/* The foundation cut into independent springs: the scheme of Mathematics 2022, 10, 3641, (19)-(22). A
 * cross-check of the memory diagram and the baseline for its cost; use fret_contact for work.
 *
 * [0, radius] is cut into `count` cells of width h; spring i, of both bodies together, is at x_i = (i+1/2) h:
 *   g_i = g(x_i),  w_i = int 2 c_N(x) dx over the cell,  B_i = mu eta (delta_z - g_i)+,
 *   u_i <- clip(u_i + d(delta_x), -B_i, B_i),
 *   F_N = sum w_i (delta_z - g_i)+,  F_x = sum w_i u_i / eta,  U = sum w_i u_i^2/(2 eta),
 *   dW = sum w_i |d(delta_x) - du_i| B_i' / eta, B_i' the mean bound during the slip of that spring.
 * A spring touched during a substep starts unstressed when it touches; one that parts moves until it parts.
 *
 * Accuracy, with N springs inside the contact: order min(2, n+k+1) in 1/N for gaps ~ r^n with
 * FRET_WEIGHT_CELL; order 1+k for k < 0 with FRET_WEIGHT_MIDPOINT. A path straight in (delta_z, delta_x) adds
 * no step error; one straight in (F_N, F_x) adds an error of order 2 in 1/substeps, none at constant F_N. A
 * path to F_N = 0 takes further, ever smaller parts, until a single spring is left.
 *
 * Different threads may use different objects. */
typedef struct fret_springs fret_springs;

typedef enum fret_weight {
    FRET_WEIGHT_CELL,    /* w = 2 cN0 c0^-k (x+^(k+1)-x-^(k+1))/(k+1), between the ends of the cell */
    FRET_WEIGHT_MIDPOINT /* w = 2 cN0 (x_i/c0)^k h, as printed: for demonstration */
} fret_weight;

/* Makes the springs of an open contact (delta_z = 0, F_x = 0). radius [m] > 0: the largest contact radius of
 * the history. Borrows normal, which must outlive it. Errors: FRET_NOT_POSITIVE, FRET_NOT_FINITE (mu,
 * radius), FRET_NOT_POSITIVE (count), FRET_OUTSIDE (rule, or a radius within the flat end), FRET_TABLE_SHORT,
 * FRET_NOT_MONOTONE (radius beyond the gap), FRET_OVERFLOW, FRET_NO_MEMORY, FRET_INTERRUPTED. */
fret_status fret_springs_make(const fret_normal *normal, double mu, size_t count, double radius,
                              fret_weight rule, fret_springs **out);
/* A copy with a state of its own. Error: FRET_NO_MEMORY. */
fret_status fret_springs_clone(const fret_springs *from, fret_springs **out);
void fret_springs_free(fret_springs *springs);

/* One step, with the targets and paths of fret_contact_step, in `substeps` equal parts. F_N is the sum over
 * cells, which at a given depth differs from F_N of the continuum by the error of the cells. With FRET_TO_FX
 * each part solves for delta_x: the least change that reaches F_x to 1e-14 mu F_N. A force between mu F_N of
 * the cells and mu F_N of the continuum makes all springs slide: F_x is then mu F_N of the cells. Allocates
 * nothing. Errors, the springs unchanged: FRET_GROSS_SLIP (|F_x| above both; limit the larger), FRET_OUTSIDE
 * (F_N or dz beyond that at `radius`; limit), FRET_NEGATIVE, FRET_NOT_FINITE, FRET_NOT_POSITIVE (substeps);
 * FRET_INTERRUPTED, after which the springs can only be freed. */
fret_status fret_springs_step(fret_springs *springs, const fret_step *step, unsigned substeps);

/* The present state, as in fret_state, in time ~ count. a is that of the continuum, c a cell boundary (or a),
 * slices the number of springs in contact. For c and kt a spring slips if 1e-12 mu F_N more would make it
 * slip. */
void fret_springs_state(const fret_springs *springs, fret_state *out);

FRET_END

#endif
