/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The loss of a closed cycle of a power law, without units. Pure. */
#ifndef HISTORY_LOSS_H
#define HISTORY_LOSS_H

#include "fret/base.h"

/* w = loss/(mu F_N delta_x,max) of a power law as a function of t = 1-s; q = n/(n+k+1), r = 1-q.
 * 0 <= t <= 1; w ~ t^3 for small t, every digit kept. */
fret_real fret_loss_shape(fret_real q, fret_real r, fret_real t, fret_real s);

#endif
