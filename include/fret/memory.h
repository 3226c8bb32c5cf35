/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef FRET_MEMORY_H
#define FRET_MEMORY_H

#include <stddef.h>

#include "fret/normal.h"

FRET_BEGIN

/* The memory diagram: tangential contact under any history of (F_N, F_x) or (delta_z, delta_x).
 *
 * With the depth y = g(x) as coordinate the spring at y has normal force ~ delta_z - y, so the
 * friction bound on its displacement is |u(y)| <= B(y) = mu eta (delta_z - y): grading and shape
 * appear only as the weight dF_N. Straight steps leave u(y) a polyline, kept as its slopes
 * sigma = -u'(y)/(mu eta), -1 <= sigma <= 1, on slices from the edge of the contact inwards. Then
 *   F_x = mu int sigma dF_N,   U = 1/(2 eta) int u^2 dK,   K = dF_N/dy,
 * and a step wipes slices at the edge and adds one: amortised constant cost, no discretisation.
 *
 * Thread-compatible: distinct contacts may be used by distinct threads. */
typedef struct fret_memory fret_memory;

/* A contact element, open (delta_z = 0, F_x = 0) at the start. Borrows normal, which must outlive it. Errors:
 * FRET_NOT_POSITIVE (mu), FRET_NO_MEMORY. */
fret_status fret_memory_make(const fret_normal *normal, double mu, fret_memory **out);
void fret_memory_free(fret_memory *memory);

/* Makes `to` equal to `from`, allocating only where `to` has held fewer slices so far. */
fret_status fret_memory_copy(fret_memory *to, const fret_memory *from);

/* What it was made with. */
const fret_normal *fret_memory_normal(const fret_memory *memory);
double fret_memory_friction(const fret_memory *memory);

/* Back to the open state; keeps its storage. */
void fret_memory_reset(fret_memory *memory);

typedef enum fret_normal_target { FRET_KEEP_NORMAL, FRET_TO_FORCE, FRET_TO_DEPTH } fret_normal_target;
typedef enum fret_tangential_target {
    FRET_KEEP_DX, /* the same as FRET_TO_DX with the present delta_x */
    FRET_TO_DX,
    FRET_TO_FX
} fret_tangential_target;

/* Absolute targets of one step [N] or [m].
 * With FRET_TO_FX the path is straight in (F_N, F_x), otherwise in (delta_z, delta_x). */
typedef struct fret_step {
    fret_normal_target normal_by;
    fret_tangential_target tangential_by;
    double normal;     /* F_N >= 0, or delta_z (< 0: out of contact) */
    double tangential; /* delta_x or F_x */
} fret_step;

/* One straight step. Errors, the contact as before it: FRET_GROSS_SLIP (|F_x| > mu F_N by more
 * than 2.2e-16; limit mu F_N), FRET_NEGATIVE, FRET_NOT_FINITE, FRET_OVERFLOW, FRET_TABLE_SHORT,
 * FRET_NOT_MONOTONE, FRET_NO_MEMORY; FRET_INTERRUPTED, of which fret_normal_stop tells. */
fret_status fret_memory_step(fret_memory *memory, const fret_step *step);

/* The state now. */
typedef struct fret_state {
    fret_real FN, dz, a; /* normal force [N], indentation depth [m] (< 0: gap), contact radius [m] */
    fret_real Fx, dx, c; /* tangential force [N], displacement [m], stick radius [m] */
    fret_real W;         /* dissipated since the start [J] */
    fret_real U;         /* stored tangential energy [J] */
    fret_real kn;        /* dF_N/d delta_z [N/m] */
    fret_real kt;        /* dF_x/d delta_x going on in the direction of the last step [N/m] */
    size_t slices;       /* slices held */
} fret_state;

/* All of it; and the cheap part alone: a, c, U, kn, kt are left 0. */
void fret_memory_state(const fret_memory *memory, fret_state *out);
void fret_memory_forces(const fret_memory *memory, fret_state *out);

/* Energy dissipated by the last step alone [J]; of a step far smaller than the load the rounding of the load
 * is felt: W is the better sum. */
fret_real fret_memory_last_loss(const fret_memory *memory);

/* The polyline: slice i, 0 at the innermost, covers depths [inner, outer] with slope sigma; u is
 * the displacement at its inner end [m]. Returns false beyond the last slice. */
typedef struct fret_segment {
    fret_real inner, outer, sigma, u;
} fret_segment;
int fret_memory_segment(const fret_memory *memory, size_t i, fret_segment *out);

/* Displacement u1D(x) [m] of the spring at distance |x| [m] from the centre, relative to where it would rest,
 * both sides together: u at the depth y = g(x), delta_x where it never slipped; 0 outside the contact. */
fret_real fret_memory_displacement(const fret_memory *memory, fret_real x);

/* What friction allows it, B = mu eta (delta_z - g(x)) [m], |u1D| <= B; 0 outside the contact. Accuracy of
 * both: 1e-18 of mu eta delta_z. */
fret_real fret_memory_bound(const fret_memory *memory, fret_real x);

/* The springs' force times their present slip, W1D = -2 int_0^a c_T |u| |delta_x - u| dx [J], <= 0 (22). Its
 * magnitude is the energy dissipated as long as the first branch lasts, a quarter of dW at its end, and has
 * no such meaning after a reversal. Exact over the slices, in time ~ their number. c_T is that of both bodies
 * together. */
fret_real fret_memory_slip_work(const fret_memory *memory);

FRET_END

#endif
