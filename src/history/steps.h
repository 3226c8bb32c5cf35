/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The check of an imposed force that steps of all kinds share. Not installed. */
#ifndef FRET_HISTORY_STEPS_H
#define FRET_HISTORY_STEPS_H

#include "fret/contact.h"

/* load = F_x/mu at the end of a step under force control, which must not exceed the normal force FN there. */
fret_status fret_step_load(double mu, const fret_step *step, fret_real FN, fret_real *load);

#endif
