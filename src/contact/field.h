/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Parts of fields that one place and many places share. Not installed. */
#ifndef FRET_CONTACT_FIELD_H
#define FRET_CONTACT_FIELD_H

#include "contact/normal.h"

/* As fret_surface where a > start and no power is steep; the contact is dz deep. */
fret_status fret_field_surface(const fret_normal *normal, fret_real a, fret_real dz, fret_real r,
                               fret_real *w);

/* What becomes of such integrals by 2 cos(pi k/2)/pi: a surface. */
fret_real fret_field_surface_factor(fret_real k);

#endif
