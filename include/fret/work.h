/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef FRET_WORK_H
#define FRET_WORK_H

#include "fret/contact.h"

FRET_BEGIN

/* The work of friction per area at each place, from a record of slip:
 *   w(r) = int q_x(r,t) ds(r,t) [J/m^2],   q_x = mu p where it slips, s = delta_x - u_x the local slip.
 * When the springs outside a slip front at the radius d slip by mu eta dm, a place r > d slips by
 *   ds = mu eta K(d/r) dm,   K = 1 - (2 cos(pi k/2)/pi) int_0^d x^k (r^2-x^2)^(-(1+k)/2) dx,
 * so that w is a sum over the phases of slip without negative terms; 2 pi int w r dr = W. At constant F_N
 * each phase has a closed form, and a closed cycle gives D(r) = 4 mu p(r) s(r; F_A), plus 4 mu p (delta_A -
 * delta_x,max) beyond gross slip; where F_N changes the phase is integrated, for a swinging load along the
 * sine itself. A wear law V = alpha W [m^3/J] makes it the depth alpha w(r). */
typedef struct fret_work fret_work;

/* Computes the work of the phases numbered first .. end-1, which it copies; take fret_slips_count before the
 * last period as first for the work of that period. Takes as long as fret_field_make at the deepest contact.
 * Borrows the normal contact that was stepped. Errors: FRET_NO_MEMORY (also if the record is incomplete for
 * lack of memory), FRET_INTERRUPTED. */
fret_status fret_work_make(const fret_normal *normal, double mu, const fret_slips *slips, size_t first,
                           size_t end, fret_work **out);
void fret_work_free(fret_work *work);

/* w(r) [J/m^2], >= 0, for r >= 0 [m]; threads may share work. Errors: FRET_NEGATIVE, FRET_NOT_FINITE,
 * FRET_SINGULAR where it slips and pressure is infinite (fret/field.h), FRET_INTERRUPTED. */
fret_status fret_work_at(const fret_work *work, fret_real r, fret_real *w);

/* Radii [m] where w(r) is not smooth: the positions of front and edge at the beginning and end of a phase.
 * Returns how many there are. phase: 0, 1, ...; 0 radii beyond the last phase. */
enum { FRET_WORK_ENDS = 6 };
size_t fret_work_edges(const fret_work *work, size_t phase, fret_real r[FRET_WORK_ENDS]);

FRET_END

#endif
