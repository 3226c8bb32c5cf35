/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Values of polynomials. Not installed. */
#ifndef FRET_NUMBER_POLYNOMIAL_H
#define FRET_NUMBER_POLYNOMIAL_H

#include "fret/base.h"

/* c[0] + c[1] x + ... + c[count-1] x^(count-1), by Horner's scheme. */
static inline fret_real fret_horner(const fret_real *c, int count, fret_real x) {
    fret_real sum = 0;
    for (int i = count; i-- > 0;)
        sum = sum * x + c[i];
    return sum;
}

#endif
