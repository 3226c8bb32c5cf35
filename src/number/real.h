/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Elementary functions of long double over its whole range, within 1 in the last of 64 bits. They stand in
 * for libm, whose digits differ from place to place. Not installed. */
#ifndef FRET_NUMBER_REAL_H
#define FRET_NUMBER_REAL_H

#include "fret/base.h"

#define FRET_PI 3.141592653589793238462643383279502884L

fret_real fret_exp(fret_real x);
fret_real fret_expm1(fret_real x);
fret_real fret_log(fret_real x);
fret_real fret_log10(fret_real x);
fret_real fret_log1p(fret_real x);
fret_real fret_pow(fret_real x, fret_real y);                     /* x >= 0, or y whole */
fret_real fret_ratio_pow(fret_real x, fret_real x0, fret_real y); /* (x/x0)^y for large y too; x, x0 > 0 */
fret_real fret_sin(fret_real x);
fret_real fret_cos(fret_real x);
fret_real fret_atan2(fret_real y, fret_real x);
fret_real fret_gamma(fret_real x);
fret_real fret_beta(fret_real x, fret_real y); /* x, y > 0 */

#endif
