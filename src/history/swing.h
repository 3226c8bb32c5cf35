/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A memory curve from inside: for what follows it, and what integrates along it. Not installed. */
#ifndef FRET_HISTORY_SWING_H
#define FRET_HISTORY_SWING_H

#include "fret/swing.h"
#include "law/normal.h"
#include "number/quadrature.h"
#include "number/real.h"
#include "number/sum.h"

/* Two coordinates of a place on the curve or on the way of the load. */
enum { M, P };

/* A way of the load over s: straight over 0..1, or harmonic, each coordinate mean + size cos(s - lag). */
typedef struct way {
    bool harmonic;
    fret_real start[2], span[2];
    fret_real mean, size[2], lag[2];
} way;

/* A part of the curve from the place first to the place last: straight, or the way itself between two
 * instants. */
typedef struct piece {
    fret_real first[2], last[2];
    bool curved;
    way way;
    fret_real lo, hi;
    bool known; /* of one that is curved: its sums, from the end of the motion that has changed it on */
    fret_real sum[2];
} piece;

struct fret_swing {
    const fret_normal *normal;
    double mu;
    fret_real FN, Fx; /* now; the end of the curve is their M, P */
    fret_real dz, a;  /* the edge */
    fret_real slid;   /* delta_x - mu eta int sigma dy */
    bool held;        /* the last motion ended at delta_x = goal exactly */
    double goal;
    int direction;
    fret_sum W;
    fret_real last_loss, scale; /* scale: the largest of M and P so far */
    size_t count, room;
    piece *pieces; /* innermost first */
};

/* ---- along the curve --------------------------------------------------------------------------- */

/* Rules of few points are to agree to what the law is good to. */
static inline fret_real fret_swing_integral(const fret_swing *c, fret_integrand *f, void *context) {
    return fret_integrate_short(f, context, fret_normal_closed(c->normal) ? 1e-17L : 1e-13L);
}

/* The sums of pieces that have changed: a question only reads. */
void fret_swing_know(fret_swing *c);
fret_real fret_swing_dx(const fret_swing *c);
/* Where a front of slip that goes inwards along `which` at constant F_N comes to, for so much of delta_x per
 * mu eta; what is left of it all slides. */
fret_real fret_swing_front(const fret_swing *c, int which, fret_real *left);

/* ---- ways -------------------------------------------------------------------------------------- */

static inline fret_real way_at(const way *w, int which, fret_real s) {
    return w->harmonic ? w->mean + w->size[which] * cosl(s - w->lag[which])
                       : w->start[which] + w->span[which] * s;
}

/* -d/ds of a coordinate */
static inline fret_real way_fall(const way *w, int which, fret_real s) {
    return w->harmonic ? w->size[which] * sinl(s - w->lag[which]) : -w->span[which];
}

/* The angle less whole turns, within pi of `middle`. */
static inline fret_real turned_to(fret_real angle, fret_real middle) {
    const fret_real turn = 2 * FRET_PI;
    return angle - turn * floorl((angle - middle) / turn + 0.5L);
}

/* When a coordinate, monotone between lo and hi, has the level. */
static inline fret_real way_when(const way *w, int which, fret_real level, fret_real lo, fret_real hi) {
    fret_real s;
    if (w->harmonic) {
        const fret_real c = fmaxl(-1, fminl(1, (level - w->mean) / w->size[which]));
        const fret_real angle = acosl(c), middle = (lo + hi) / 2;
        const fret_real one = turned_to(w->lag[which] + angle, middle),
                        two = turned_to(w->lag[which] - angle, middle);
        s = fabsl(one - middle) < fabsl(two - middle) ? one : two;
    } else {
        s = (level - w->start[which]) / w->span[which];
    }
    return fminl(fmaxl(s, lo), hi);
}

#endif
