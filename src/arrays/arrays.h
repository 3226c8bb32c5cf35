/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What fret/arrays.h does, by loops for every processor too: for tests. Not installed. */
#ifndef FRET_ARRAYS_ARRAYS_H
#define FRET_ARRAYS_ARRAYS_H

#include <stdbool.h>

#include "fret/arrays.h"

typedef enum fret_arrays_question { FRET_LOSSES, FRET_LOADINGS, FRET_PRESSES } fret_arrays_question;

/* of: a fret_pressed, for presses a fret_normal. to: as many results as the question has, or NULL. */
fret_status fret_arrays_ask(fret_arrays_question question, const void *of, const double F[],
                            double *const to[2], size_t count, bool anywhere);

#endif
