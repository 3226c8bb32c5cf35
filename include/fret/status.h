/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef FRET_STATUS_H
#define FRET_STATUS_H

#include <signal.h>
#include <stddef.h>

#include "fret/base.h"

FRET_BEGIN

/* The result of every function that can fail. Codes are stable: append, never renumber; 13 was withdrawn. */
typedef enum fret_code {
    FRET_OK = 0,
    FRET_NOT_FINITE,     /* an argument is NaN or infinite                                  */
    FRET_BAD_K,          /* grading exponent outside -1 < k < 1                             */
    FRET_BAD_NU,         /* Poisson's ratio outside -1 < nu <= 1/2                          */
    FRET_NOT_POSITIVE,   /* a modulus, length, exponent, friction ... that must be > 0      */
    FRET_NEGATIVE,       /* a quantity that must be >= 0                                    */
    FRET_BOTH_RIGID,     /* at least one body must be elastic                               */
    FRET_GROSS_SLIP,     /* tangential force beyond mu F_N                                  */
    FRET_OUTSIDE,        /* a point outside the domain of a function                        */
    FRET_NOT_MONOTONE,   /* g(x) falls: the contact is not a disc; value: radius; limit: the radius where a
                            table has soon risen above it again, or 0 */
    FRET_TABLE_SHORT,    /* the gap ends before the load is carried; limit: largest a       */
    FRET_BAD_TABLE,      /* a sampled gap needs two rows or more, r and f from 0, growing r */
    FRET_OVERFLOW,       /* the result does not fit in a double                             */
    FRET_NO_MEMORY = 14, /* allocation failed; the object is as before                      */
    FRET_INTERRUPTED,    /* the caller's stop flag was set                                  */
    FRET_SINGULAR,       /* the field is infinite there                                     */
    FRET_CODES
} fret_code;

typedef enum fret_category {
    FRET_CAT_NONE,    /* success */
    FRET_CAT_INPUT,   /* an argument is out of range */
    FRET_CAT_STATE,   /* the contact cannot do this now */
    FRET_CAT_NUMERIC, /* overflow */
    FRET_CAT_SYSTEM   /* memory, interrupt */
} fret_category;

/* The result of every function of the library that can fail. */
typedef struct fret_status {
    fret_code code;
    const char *quantity; /* name of the offending argument (static text), or NULL */
    double value;         /* the offending value, SI */
    double limit;         /* the bound that was passed, where there is one, SI */
} fret_status;

/* A flag that a signal handler or another thread sets. Long work that is given it polls it and ends with
 * FRET_INTERRUPTED, usually within some milliseconds. NULL: nothing can stop the work. */
typedef const volatile sig_atomic_t *fret_stop;

fret_category fret_status_category(fret_code code);

/* The rule that was broken, e.g. "must lie in -1 < k < 1"; static text. */
const char *fret_status_rule(fret_code code);

/* Writes "quantity = value rule" into buf, or the rule alone if no argument is to blame, always terminated.
 * Returns the length of the full text. */
int fret_status_text(const fret_status *status, char *buf, size_t size);

FRET_END

#endif
