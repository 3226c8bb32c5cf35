/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef FRET_WORK_H
#define FRET_WORK_H

#include "fret/contact.h"

FRET_BEGIN

/* The work of friction at each place, of what has slipped while a contact was watched:
 *   w(r) = int q_x(r,t) ds(r,t) [J/m^2],   q_x = mu p where it slips, s = delta_x - u_x the local slip.
 * Outside a front of slip at the radius d all springs slip by mu eta dm, and a place r > d by
 *   ds = mu eta K(d/r) dm,   K = 1 - (2 cos(pi k/2)/pi) int_0^d x^k (r^2-x^2)^(-(1+k)/2) dx,
 * so that w is a sum over the phases of slip, none of them negative; 2 pi int w r dr = W. At constant F_N
 * each has a closed form, of a closed cycle together D(r) = 4 mu p(r) s(r; F_A), and beyond gross slip
 * 4 mu p (delta_A - delta_x,max) more; where F_N changes it is integrated, of a swinging load the sine
 * itself. A wear law V = alpha W [m^3/J] makes a depth alpha w(r) of it. */
typedef struct fret_work fret_work;

/* Of the phases from number `first` on to those before `end`, which it copies: what had slipped before the
 * last period, say, was fret_slips_count then. Takes as long as a field of the deepest contact. Borrows the
 * normal contact that was stepped. Errors: FRET_NO_MEMORY (also where slips could not be kept),
 * FRET_INTERRUPTED. */
fret_status fret_work_make(const fret_normal *normal, double mu, const fret_slips *slips, size_t first,
                           size_t end, fret_work **out);
void fret_work_free(fret_work *work);

/* w(r) [J/m^2], >= 0, for r >= 0 [m], else FRET_NEGATIVE, FRET_NOT_FINITE; threads may share it.
 * FRET_SINGULAR where it slips and pressure is infinite (fret/field.h), FRET_INTERRUPTED. */
fret_status fret_work_at(const fret_work *work, fret_real r, fret_real *w);

/* Radii [m] where w(r) is not smooth: those at which the front and the edge of a phase begin and end; how
 * many. phase: 0, 1, ...; none beyond the last. */
enum { FRET_WORK_ENDS = 6 };
size_t fret_work_edges(const fret_work *work, size_t phase, fret_real r[FRET_WORK_ENDS]);

FRET_END

#endif
