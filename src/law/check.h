/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Making a status, and checks of arguments. Not installed. */
#ifndef FRET_LAW_CHECK_H
#define FRET_LAW_CHECK_H

#include <math.h>

#include "fret/status.h"

static inline fret_status fret_ok(void) {
    return (fret_status){FRET_OK, NULL, 0, 0};
}

static inline fret_status fret_fail(fret_code code, const char *quantity, double value, double limit) {
    return (fret_status){code, quantity, value, limit};
}

/* Return FRET_OK, FRET_NOT_FINITE or the code that the name suggests. */
fret_status fret_check_positive(const char *quantity, double value);
fret_status fret_check_k(double k);
fret_status fret_check_not_negative(const char *quantity, double value);

#endif
