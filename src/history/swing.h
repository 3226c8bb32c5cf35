/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A memory curve from inside: for what follows it, and what integrates along it. Not installed. */
#ifndef FRET_HISTORY_SWING_H
#define FRET_HISTORY_SWING_H

#include "history/memory.h"
#include "law/normal.h"
#include "number/integral.h"
#include "number/real.h"
#include "number/sum.h"

/* The memory diagram under harmonic forces, event by event, no chords. With P = F_N + F_x/mu and M = F_N -
 * F_x/mu the memory of a contact is a curve that rises in both from (0, 0) to the present (M, P); its slice
 * at the load N = (M+P)/2 has the slope sigma = (dP-dM)/(dP+dM). When both grow the curve grows; when M falls
 * below it, it is cut at M and goes straight up (slip forward), when P does, straight across (slip backward).
 * With D and d the depths of the edge and of the cut, forward slip dissipates
 *   dW = -dM mu^2 eta [F_N(D) - F_N(d) - (D-d) F_N'(d)]/F_N'(d),   backward slip the same with dP.
 * A swinging load keeps arcs of its own way as arcs of the curve. */
typedef struct fret_swing fret_swing;

/* Goes on from the state of a memory, closed. Borrows its law, not the memory. Errors: FRET_OUTSIDE (a
 * table), FRET_NO_MEMORY. */
fret_status fret_swing_make(const fret_memory *memory, fret_swing **out);
void fret_swing_free(fret_swing *swing);
fret_status fret_swing_copy(fret_swing *to, const fret_swing *from);

/* Can it run this: the contact stays closed and slips partially throughout, and is where the period is
 * at the time `from`? */
bool fret_swing_fits(const fret_swing *swing, const fret_sine *sine, double from);
/* A part of a period that fits: as fret_contact_swing. */
fret_status fret_swing_part(fret_swing *swing, const fret_sine *sine, double from, double to);
/* A step by force, by depth with F_x, or to delta_x at constant F_N; others: FRET_OUTSIDE. */
fret_status fret_swing_step(fret_swing *swing, const fret_step *step);
void fret_swing_state(const fret_swing *swing, fret_state *out);
fret_real fret_swing_last_loss(const fret_swing *swing);
fret_real fret_swing_displacement(const fret_swing *swing, fret_real x);
/* The state as a memory: curved arcs in 640 straight ones each. Error: FRET_NO_MEMORY. */
fret_status fret_swing_memory(const fret_swing *swing, fret_memory *out);

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
typedef struct arc {
    fret_real first[2], last[2];
    bool curved;
    way way;
    fret_real lo, hi;
    bool known; /* of one that is curved: its sums, from the end of the motion that has changed it on */
    fret_real sum[2];
} arc;

/* Slip by a swinging load, or a straight one of a curve that is none: the level of `which` falls from the
 * time lo to hi of the way, and crosses the arc `front`. */
typedef struct swung_phase {
    way way;
    int which;
    fret_real lo, hi;
    arc front;
} swung_phase;

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
    arc *arcs;         /* innermost first */
    fret_slips *slips; /* borrowed, or NULL */
};

/* On an arc, where the coordinate `which` has the level, the other one. */
fret_real fret_swing_other(const arc *p, int which, fret_real level);

/* ---- along the curve --------------------------------------------------------------------------- */

/* Rules of few points are to agree to what the law is good to. */
static inline fret_real fret_swing_integral(const fret_swing *c, fret_integrand *f, void *context) {
    return fret_integral_ends(f, context, fret_normal_closed(c->normal) ? 1e-17L : 1e-13L);
}

/* The sums of arcs that have changed: a question only reads. */
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

/* A harmonic way in load N = (M+P)/2, as M, and T = (P-M)/2, as P. */
void fret_swing_loads(const way *w, way *out);

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
