/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the steps of all diagrams share. Not installed. */
#ifndef FRET_HISTORY_STEPS_H
#define FRET_HISTORY_STEPS_H

#include "fret/contact.h"

/* F_x/mu at the end of a step by force, which must not exceed the normal force FN there.
 * Errors: FRET_NOT_FINITE, FRET_GROSS_SLIP. */
fret_status fret_step_load(double mu, const fret_step *step, fret_real FN, fret_real *load);

#endif
