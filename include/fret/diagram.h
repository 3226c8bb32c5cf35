/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef FRET_DIAGRAM_H
#define FRET_DIAGRAM_H

#include "fret/memory.h"

FRET_BEGIN

/* The memory diagram in double, for the inner loop of a dynamics code in which normal and tangential motion
 * both change: fret_memory for power laws, eight times as fast, four times where the loss counts.
 *
 * With the depth y, or the load F_N(y) ~ y^p, as first coordinate and t = int_0^y sigma dy, or
 * int_0^y sigma dF_N, as second, the memory of a contact is a curve from (0, 0) to the present
 * (delta_z, delta_x/(mu eta)), or (F_N, F_x/mu), with slopes -1 <= sigma <= 1. A step that is straight in one
 * of the two pairs appends to the curve, or cuts it where y - t (slip forward) or y + t (slip backward) has
 * fallen to that of the end, and goes there straight with sigma = 1 or -1. No place on the curve depends on
 * how many steps there have been: F_x does not drift. While the front d of a zone of slip moves inwards
 * through slope sigma and the edge D moves with it, the step dissipates
 *   dW = mu^2 eta (1 -+ sigma) int [F_N(D) - F_N(d) - (D-d) F_N'(d)] |dd|,
 * in closed form, or by Gauss's rule of a polynomial where that would lose digits (by depth, not of Hertz's
 * law: there it is a sum of positive terms in the roots of D and d).
 *
 * A step costs two powers, or square roots where 2p, or 2/p by force, is a whole number up to 8 (sphere, cone
 * at k = 0).
 *
 * Accuracy for p <= 5 against fret_memory, worst of random histories with contact lost and regained, up to
 * gross slip, within 1e-15 of it and beyond (make hard-diagram, tests/hard/diagram.txt): F_x to 3e-14 of mu
 * times the largest F_N so far, dx by force to 3e-14 of the largest delta_x,max so far, W to 1e-13 of itself
 * and of mu F_N delta_x,max together; no worse after 1e8 steps. Up to p = 10 ten times that, dx a hundred
 * times; beyond, nothing is promised.
 *
 * Thread-compatible: distinct contacts may be used by distinct threads. */
typedef struct fret_diagram fret_diagram;

/* A contact element, open (delta_z = 0, F_x = 0) at the start. Borrows normal, which must outlive it. With
 * slices > 0 there is room for so many slices (and no allocation after this): a history nested deeper is
 * refused; 0: room grows as needed.
 * Errors: FRET_OUTSIDE (no power law), FRET_NOT_POSITIVE, FRET_NOT_FINITE (mu), FRET_NO_MEMORY. */
fret_status fret_diagram_make(const fret_normal *normal, double mu, size_t slices, fret_diagram **out);
void fret_diagram_free(fret_diagram *diagram);

/* Whether steps from here on count the energy that they dissipate: half of their time. At first they do. */
void fret_diagram_count_loss(fret_diagram *diagram, bool on);

/* Back to the open state; keeps its storage. */
void fret_diagram_reset(fret_diagram *diagram);

/* Makes `to` equal to `from`, allocating only where `to` has held fewer slices so far. */
fret_status fret_diagram_copy(fret_diagram *to, const fret_diagram *from);

/* One straight step, with the targets and paths of fret_memory_step. Errors, the contact as before it:
 * FRET_GROSS_SLIP (|F_x| > mu F_N by more than 2.2e-16; limit mu F_N), FRET_NEGATIVE, FRET_NOT_FINITE,
 * FRET_OVERFLOW (F_N, delta_z or their product leaves 1e-290 .. 1e290), FRET_NO_MEMORY. */
fret_status fret_diagram_step(fret_diagram *diagram, const fret_step *step);

/* The cheap part of the state. */
typedef struct fret_diagram_now {
    double FN, dz;    /* [N], [m] (< 0: gap) */
    double Fx, dx;    /* [N], [m] */
    double W;         /* dissipated since the start [J] */
    double last_loss; /* by the last step alone [J] */
} fret_diagram_now;
void fret_diagram_forces(const fret_diagram *diagram, fret_diagram_now *out);

/* All of the state, in long double, with time ~ slices. */
void fret_diagram_state(const fret_diagram *diagram, fret_state *out);

FRET_END

#endif
