/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef FRET_REFERENCE_H
#define FRET_REFERENCE_H

#include "fret/cycle.h"

FRET_BEGIN

/* The energy dissipated in a closed cycle by quadrature of its definition, to tell how far other models err:
 *   8 mu^2 eta int_c^a c_N (g(a)-g(x)) (g(x)-g(c)) dx,
 * power laws over the depth y = g(x), where no difference loses digits, other shapes over the radius.
 * The tanh-sinh rule bears the singularities at x = 0 and at a flat end. Shares the place c of the slip front
 * with the closed form, not the integral. */

/* By `points` nodes, 8 <= points <= 100000 (else FRET_OUTSIDE), equally spaced in the rule's own variable.
 * peak: the end of first loading, from fret_loading_by_force or fret_loading_by_displacement; gross slip
 * beyond delta_x,max is added. Other errors: FRET_NOT_POSITIVE (mu, FN). */
fret_status fret_quadrature_loss(const fret_contact *contact, const fret_loading *peak, unsigned points,
                                 fret_real *loss);

/* The same with the step halved until two results agree to four units of long double, or 2048 nodes
 * (sampled gaps: 512, from row to row of up to 500). agreement: relative difference of the last two, at least
 * those units and what a thin annulus loses of them. Arguments and errors of fret_cycle_loss_by_force and
 * fret_cycle_loss_by_displacement. Accuracy: agreement; power laws 2e-18 + the rounding of FA/(mu F_N). */
fret_status fret_reference_loss_by_force(const fret_contact *contact, double FA, fret_real *loss,
                                         fret_real *agreement);
fret_status fret_reference_loss_by_displacement(const fret_contact *contact, double dA, fret_real *loss,
                                                fret_real *agreement);

FRET_END

#endif
