/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the rows of a contact would press beyond its edge, if g' had no end there. Made once, only read
 * afterwards. Not installed. */
#ifndef FRET_CONTACT_BEYOND_H
#define FRET_CONTACT_BEYOND_H

#include "contact/normal.h"

struct fret_beyond;

/* Of the contact of radius a, beyond the start of a table. Errors: FRET_NO_MEMORY, FRET_INTERRUPTED. */
fret_status fret_beyond_make(const fret_normal *normal, fret_real a, struct fret_beyond **out);
void fret_beyond_free(struct fret_beyond *beyond);

/* int_a^oo x^-k H(x) (x^2-r^2)^(m-1) dx, r < a, H = int_0^a (s f')' (x^2-s^2)^(m-1) ds, m = (k+1)/2. */
fret_real fret_beyond_integral(const struct fret_beyond *beyond, fret_real r);

fret_real fret_beyond_radius(const struct fret_beyond *beyond);
/* How far x^-k H is off, relative. */
fret_real fret_beyond_error(const struct fret_beyond *beyond);

#endif
