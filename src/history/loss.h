/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The loss of a closed cycle of a power law, dimensionless. Pure. */
#ifndef HISTORY_LOSS_H
#define HISTORY_LOSS_H

#include "fret/base.h"

/* w = loss/(mu F_N delta_x,max) as a function of t = 1-s, 0 <= t <= 1; q = n/(n+k+1), r = 1-q. Exact for
 * small t, w ~ t^3. */
fret_real fret_loss_shape(fret_real q, fret_real r, fret_real t, fret_real s);

#endif
