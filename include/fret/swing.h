/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef FRET_SWING_H
#define FRET_SWING_H

#include "fret/memory.h"

FRET_BEGIN

/* The memory diagram under harmonic forces, event by event: no chords, no step error. By force, or to
 * delta_x at constant F_N; of any gap but a table, whose rows are kinks of the law.
 *
 * With P = F_N + F_x/mu and M = F_N - F_x/mu the memory of a contact is a curve that rises in both from (0,
 * 0) to the present (M, P); its slice at the load N = (M+P)/2 has the slope sigma = (dP-dM)/(dP+dM). When
 * both grow the curve grows; when M falls below it, it is cut at M and goes straight up (slip forward), when
 * P does, straight across (slip backward). With D and d the depths of the edge and of the cut, forward slip
 * dissipates
 *   dW = -dM mu^2 eta [F_N(D) - F_N(d) - (D-d) F_N'(d)]/F_N'(d),   backward slip the same with dP.
 * A swinging load keeps pieces of its own way as pieces of the curve.
 *
 * Accuracy of a power law, against 64-digit references: W and the loss of a period 1e-15 of W; 1e-13 after
 * steps that end within a thousandth of gross slip. Of other shapes, prepared, 1e-13.
 *
 * Thread-compatible: distinct objects may be used by distinct threads. */
typedef struct fret_swing fret_swing;

/* One period of F_x = FA cos s, F_N = FN + FNA cos(s + phase), s = 0 .. 2 pi. */
typedef struct fret_sine {
    double FA, FNA, phase; /* [N], [N], [rad] */
    fret_real FN;          /* [N] */
} fret_sine;

/* Is it a contact that the sine can be taken of? Not one of a table. */
int fret_swing_takes(const fret_normal *normal);

/* Goes on from the state of a memory, closed. Borrows its normal contact, not the memory.
 * Errors: FRET_OUTSIDE (a table), FRET_NO_MEMORY. */
fret_status fret_swing_make(const fret_memory *memory, fret_swing **out);
void fret_swing_free(fret_swing *swing);

/* Makes `to` equal to `from`. Error: FRET_NO_MEMORY. */
fret_status fret_swing_copy(fret_swing *to, const fret_swing *from);

/* Can it run this: the contact stays closed and slips partially throughout, and begins where the period does?
 */
int fret_swing_fits(const fret_swing *swing, const fret_sine *sine);

/* One period that fits. Errors: FRET_NO_MEMORY, FRET_INTERRUPTED (fret_normal_stop), the contact unusable but
 * for fret_swing_copy and _free. */
fret_status fret_swing_period(fret_swing *swing, const fret_sine *sine);

/* The part from `from`, where it is, to `to` of a period that fits: 0 <= from < to <= 1 of its time, else
 * FRET_OUTSIDE. Parts of a whole end as the period does, to rounding. Other errors: those of a period. */
fret_status fret_swing_part(fret_swing *swing, const fret_sine *sine, double from, double to);

/* A step by force, by depth with F_x, or to delta_x at constant F_N; one to delta_x, or that keeps it, along
 * a normal motion is no such step: FRET_OUTSIDE. Errors otherwise those of fret_memory_step; the contact as
 * before it, but for FRET_NO_MEMORY and FRET_INTERRUPTED as above. */
fret_status fret_swing_step(fret_swing *swing, const fret_step *step);

/* As of a memory. */
void fret_swing_state(const fret_swing *swing, fret_state *out);
fret_real fret_swing_last_loss(const fret_swing *swing); /* of the last period, part or step [J] */

/* Traction [Pa] and surface displacement [m], as of a memory (fret/field.h), and the displacement u(x) [m] of
 * the spring at x: along the curves themselves. Accuracy 1e-13 of the largest value, of other shapes 1e-12.
 */
fret_status fret_swing_traction(const fret_swing *swing, fret_real r, fret_real *q);
fret_status fret_swing_surface_x(const fret_swing *swing, fret_real r, fret_real *u);
fret_real fret_swing_displacement(const fret_swing *swing, fret_real x);

/* The state as a memory: curved pieces in 640 straight ones each. Error: FRET_NO_MEMORY. */
fret_status fret_swing_memory(const fret_swing *swing, fret_memory *out);

FRET_END

#endif
