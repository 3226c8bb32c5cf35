/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef FRET_FIELD_H
#define FRET_FIELD_H

#include "fret/contact.h"

FRET_BEGIN

/* Local fields, by inverse transforms. A state of any history is a superposition of normal contacts: slices
 * of slope sigma are differences of contacts that end at their two ends. The local slip is delta_x - u_x(r),
 * u_x the mean over the angle: what friction works on within this theory, 2 pi int mu p s r dr = W of first
 * loading.
 *
 * Arguments r >= 0 [m] else FRET_NEGATIVE, FRET_NOT_FINITE. FRET_SINGULAR where the field is infinite: at the
 * sharp edge of a flat-ended gap where k <= 0, and at the tip where n + k <= 1; the traction there only where
 * the innermost slice has a slope. Accuracy 1e-14 relative; 2e-13 nearer than 1e-3 a outside the edge and
 * nearer than 1e-6 a to the centre, 1e-8 next to a flat end where k nears -1. The pressure of a table has a
 * kink at every row: 1e-6 for 400 smooth rows, 1e-2 for rough ones; fret_fields resolve them. Powers up to n
 * = 1e6: 1e-13, for the radii as given. */

/* p(r) = (cN0 c0^-k/pi) int_r^a g'(x) (x^2-r^2)^((k-1)/2) dx [Pa]; 0 outside. The contact radius is a [m],
 * here and below: a >= 0 else FRET_NEGATIVE, a <= fret_normal_end else FRET_OUTSIDE. */
fret_status fret_pressure(const fret_normal *normal, fret_real a, fret_real r, fret_real *p);

/* w(r) = (2 cos(pi k/2)/pi) int_0^a x^k (delta_z-g(x)) (r^2-x^2)^(-(1+k)/2) dx for r > a [m], both bodies
 * together; delta_z - f(r) inside. */
fret_status fret_surface(const fret_normal *normal, fret_real a, fret_real r, fret_real *w);

/* The same of a contact as fret_press_by_... tell it: right next to a flat end a radius that is rounded
 * hardly knows how far the contact reaches beyond that, but its depth does. */
fret_status fret_pressure_of(const fret_normal *normal, const fret_press *press, fret_real r, fret_real *p);
fret_status fret_surface_of(const fret_normal *normal, const fret_press *press, fret_real r, fret_real *w);

/* q_x(r) [Pa] and u_x(r) [m] in the present state of a history: the same with -u'(x) and c_T, and u(x). One
 * that has swung: 1e-13 of the largest value, of other shapes than powers 1e-12. FRET_OUTSIDE: FRET_DOUBLE.
 */
fret_status fret_traction(const fret_contact *contact, fret_real r, fret_real *q);
fret_status fret_surface_x(const fret_contact *contact, fret_real r, fret_real *u);

/* The same at many places: what a gap without a formula needs for them is worked out when it is first asked
 * for, again where the contact grows or shrinks by a factor of 2, and kept: 0.3 ms for a flat-ended gap, 0.1
 * ms for each row of a table, and then some 5 us a value, 20 of more than 2000 rows. Of these and up to 31
 * slices, p and q_x want 10 ms for each contact or slice instead (k < 0.97), w and u_x nothing, and then it
 * is 30 to 110 us a value, of u_x outside for each slice. Where all that is of no use, they answer as above.
 * Agrees to 1e-15 with the definition, of tables to 1e-15 of the largest value. The memory is one of the same
 * contact, though it may have a normal of its own. FRET_NO_MEMORY; FRET_INTERRUPTED. Free with
 * fret_fields_free before the normal. */
typedef struct fret_fields fret_fields;
fret_status fret_fields_make(const fret_normal *normal, fret_fields **fields);
void fret_fields_free(fret_fields *fields);
fret_status fret_fields_pressure(fret_fields *fields, fret_real a, fret_real r, fret_real *p);
fret_status fret_fields_surface(fret_fields *fields, fret_real a, fret_real r, fret_real *w);
fret_status fret_fields_pressure_of(fret_fields *fields, const fret_press *press, fret_real r, fret_real *p);
fret_status fret_fields_surface_of(fret_fields *fields, const fret_press *press, fret_real r, fret_real *w);
fret_status fret_fields_traction(fret_fields *fields, const fret_contact *contact, fret_real r, fret_real *q);
fret_status fret_fields_surface_x(fret_fields *fields, const fret_contact *contact, fret_real r,
                                  fret_real *u);

/* How far the fields are off, of their largest values [1]; NAN where all were answered as above. */
double fret_fields_error(const fret_fields *fields);

FRET_END

#endif
