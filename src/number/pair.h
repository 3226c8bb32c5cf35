/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The type of a double-double, for dd.h and constants.h. Not installed. */
#ifndef FRET_NUMBER_PAIR_H
#define FRET_NUMBER_PAIR_H

/* The unevaluated sum hi + lo. */
typedef struct dd {
    double hi, lo; /* |lo| <= ulp(hi)/2 */
} dd;

#endif
