/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef FRET_MASING_H
#define FRET_MASING_H

#include <stddef.h>

#include "fret/normal.h"

FRET_BEGIN

/* Tangential contact at constant normal force, in double, for the inner loop of a dynamics code (friction
 * dampers, joints). The general engine is fret_memory; this is its memory at one F_N.
 *
 * The state is a stack of turning points (d_i, F_i). With delta_x,max = mu eta delta_z, x in units of it and
 *   P(x) = [F_N(delta_z)-F_N(delta_z (1-x))]/F_N,  power law F_N ~ delta_z^p: 1-(1-x)^p,
 *   D(x) = int_0^x [P(t)-t P'(t)] dt, the loss of first loading in mu F_N delta_x,max,
 * first loading is F_x = +-mu F_N P(|d|), and the branch that began at (d_i, F_i) is, by Masing's rule,
 *   F_x = F_i +- 2 mu F_N P(|d-d_i|/2), with the loss 2 D(|d-d_i|/2).
 * A branch that reaches the turning point before its own closes a loop with the loss 4 D and removes both
 * points; beyond gross slip F_x stays at +-mu F_N.
 *
 * A step of a power law costs one logarithm and one exponential at any depth of the stack; other shapes are
 * slow (an integral over the slice that slips). Accuracy for p <= 10, against
 * fret_memory: F_x to 2e-15 of mu F_N, W to 6e-15 of itself, without drift (1e8 steps: 3e-16), as sums are
 * compensated.
 *
 * Thread-compatible: distinct contacts may be used by distinct threads. */
typedef struct fret_masing fret_masing;

/* Begins at delta_x = 0. Borrows the normal contact, which must outlive it.
 * Errors: FRET_NOT_POSITIVE, FRET_NOT_FINITE (mu, FN), FRET_OVERFLOW (of mu F_N delta_x,max), FRET_NO_MEMORY.
 */
fret_status fret_masing_make(const fret_contact *contact, fret_masing **out);
void fret_masing_free(fret_masing *masing);

/* Back to the start; keeps its storage. */
void fret_masing_reset(fret_masing *masing);

/* Makes `to` equal to `from`, allocating only where `to` has held fewer turning points so far. */
fret_status fret_masing_copy(fret_masing *to, const fret_masing *from);

/* Moves to the displacement dx [m]; Fx [N] gets the force. Errors, the contact as before it: FRET_NOT_FINITE,
 * FRET_NO_MEMORY. */
fret_status fret_masing_to_dx(fret_masing *masing, double dx, double *Fx);

/* Moves to the force Fx [N]; dx [m] gets the displacement, the nearest one where several belong to it.
 * Errors, the contact as before it: FRET_NOT_FINITE, FRET_GROSS_SLIP (|Fx| > mu F_N by more than 2.2e-16;
 * limit mu F_N), FRET_NO_MEMORY. */
fret_status fret_masing_to_force(fret_masing *masing, double Fx, double *dx);

/* Energy dissipated since the start [J]. */
double fret_masing_loss(const fret_masing *masing);

typedef struct fret_masing_state {
    double Fx, dx; /* [N], [m] */
    double W;      /* dissipated since the start [J] */
    double kt;     /* dF_x/d delta_x going on in the direction of the last step [N/m] */
    double loop;   /* 4 D of the last loop that closed, gross slip left out [J]; 0 before */
    size_t turns;  /* turning points held */
} fret_masing_state;
void fret_masing_now(const fret_masing *masing, fret_masing_state *out);

FRET_END

#endif
