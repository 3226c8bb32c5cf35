/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a slip front dissipates while it moves inwards and the edge of the contact moves too. Not installed.
 */
#ifndef FRET_CONTACT_PHASE_H
#define FRET_CONTACT_PHASE_H

#include "contact/near.h"

/* A time in which edge and front move linearly in the coordinate `by`; edge >= front, and front1 <= front0.
 */
typedef struct fret_phase {
    const fret_normal *normal;
    coordinate by;
    fret_real edge0, edge1, front0, front1;
    fret_near *near;                 /* or NULL: by rules of many points */
    fret_real edge_v[2], front_v[2]; /* with `near`: the other coordinate, < 0 where it is not known */
} fret_phase;

/* With D and d the depths of edge and front, per mu^2 eta and 1 - s sigma:
 *   int [F_N(D)-F_N(d)-(D-d) K(d)] |dd| [J], the same by load and by depth.
 * Accuracy: 1e-17 relative for power laws, of thin zones as well; others that of the slices of the law. */
fret_real fret_phase_loss(const fret_phase *phase);

/* The same by moments of the law, as for shapes without a closed form. */
fret_real fret_phase_loss_by_law(const fret_phase *phase);

/* [F_N(D)-F_N(d)-(D-d) K(d)]/K(d) [m]: D the depth of the load `edge`, d that of `front` >= 0, `zone` the
 * difference of the loads by itself. */
fret_real fret_phase_rate_by_load(const fret_normal *normal, fret_real edge, fret_real front, fret_real zone);

/* Gross slip while the edge moves from edge0 to edge1, by depth: the mean of F_N [N]. */
fret_real fret_phase_force(const fret_phase *phase);

#endif
