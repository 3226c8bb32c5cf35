/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Parts of fields that one place and many places share. Not installed. */
#ifndef FRET_CONTACT_FIELD_H
#define FRET_CONTACT_FIELD_H

#include "fret/base.h"

/* int_0^a x^k (r^2-x^2)^-(k+1)/2 dx, r > a: a flat punch's surface but for its depth. */
fret_real fret_field_flat(fret_real k, fret_real a, fret_real r);

/* What becomes of such integrals by 2 cos(pi k/2)/pi: a surface. */
fret_real fret_field_surface_factor(fret_real k);

#endif
