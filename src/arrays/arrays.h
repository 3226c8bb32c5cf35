/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The functions of fret/arrays.h as one, which can also force the plain loops, for tests. Not installed. */
#ifndef FRET_ARRAYS_ARRAYS_H
#define FRET_ARRAYS_ARRAYS_H

#include <stdbool.h>

#include "fret/arrays.h"

typedef enum fret_arrays_question { FRET_LOSSES, FRET_LOADINGS, FRET_PRESSES } fret_arrays_question;

/* Answers `question` for `count` loads F. of: a fret_pressed, or a fret_normal for FRET_PRESSES. to: one or
 * two arrays of results, or NULL. anywhere: use the loops that run on any processor. */
fret_status fret_arrays_ask(fret_arrays_question question, const void *of, const double F[],
                            double *const to[2], size_t count, bool anywhere);

#endif
