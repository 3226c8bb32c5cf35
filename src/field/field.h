/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Parts of fields that one place and many places share. Not installed. */
#ifndef FRET_FIELD_FIELD_H
#define FRET_FIELD_FIELD_H

#include "history/contact.h"
#include "law/normal.h"

/* Of a contact of radius a, at r: FRET_NEGATIVE, FRET_NOT_FINITE, FRET_OUTSIDE (a beyond the gap) or FRET_OK.
 */
fret_status fret_field_check(const fret_normal *normal, fret_real a, fret_real r);

/* Does a contact of radius a end so near to a flat end that its depth tells its edge better? */
bool fret_field_light(const fret_normal *normal, fret_real a);

/* As fret_surface where a > start and no power is steep; the contact is dz deep. */
fret_status fret_field_surface(const fret_normal *normal, fret_real a, fret_real dz, fret_real r,
                               fret_real *w);

/* p or w at r of the contact that is y deep; and how much more that is than of one `inner` deep, with its
 * digits also where p is infinite, or goes there. */
fret_status fret_field_of(const fret_normal *normal, fret_real y, fret_real r, bool traction, fret_real *out);
fret_status fret_field_between(const fret_normal *normal, fret_real inner, fret_real outer, fret_real r,
                               bool traction, fret_real *out);

/* Does every contact that holds r press infinitely there? */
bool fret_field_infinite(const fret_normal *normal, fret_real r);
/* Is r there, or next to a sharp edge, but far from the edge of a contact that is y deep? */
bool fret_field_deep(const fret_normal *normal, fret_real y, fret_real r);

/* A flat punch's surface but for its depth and factor, int_0^a x^k (r^2-x^2)^-m dx, r > a, m = (k+1)/2: half
 * the incomplete beta function B_q(m,1-m), q = (a/r)^2, by its series in q, or in away = 1-q from the edge
 * on.
 */
fret_real fret_field_flat(fret_real k, fret_real q, fret_real away);

/* What becomes of such integrals by 2 cos(pi k/2)/pi: a surface. */
fret_real fret_field_surface_factor(fret_real k);

/* fret_traction and fret_surface_x of a curve. */
fret_status fret_swing_traction(const fret_swing *swing, fret_real r, fret_real *q);
fret_status fret_swing_surface_x(const fret_swing *swing, fret_real r, fret_real *u);

#endif
