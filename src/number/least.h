/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Where a function of one number is least. Not installed. */
#ifndef FRET_NUMBER_LEAST_H
#define FRET_NUMBER_LEAST_H

#include "number/root.h"

/* The place between lo and hi at which f, whose slope is not asked for, is least, where it falls to one place
 * and rises from there: by the golden section, from `guess` between them, to `part` of hi - lo. It is flat
 * there: half of the digits of the place tell all of f. */
fret_real fret_least(fret_function *f, void *context, fret_real lo, fret_real hi, fret_real guess,
                     fret_real part);

#endif
