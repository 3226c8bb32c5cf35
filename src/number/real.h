/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Functions of long double that libm lacks or computes slowly. Not installed. */
#ifndef FRET_NUMBER_REAL_H
#define FRET_NUMBER_REAL_H

#include <math.h>

#include "fret/base.h"

#define FRET_PI 3.141592653589793238462643383279502884L

fret_real fret_pow(fret_real x, fret_real y);                     /* to (1 + |y log x|) 2^-63 */
fret_real fret_ratio_pow(fret_real x, fret_real x0, fret_real y); /* (x/x0)^y for large y too; x, x0 > 0 */
fret_real fret_beta(fret_real x, fret_real y);                    /* x, y > 0 */

#endif
