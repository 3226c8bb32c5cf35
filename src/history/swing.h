/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The memory curve under swinging loads, for this room and fields. Not installed. */
#ifndef FRET_HISTORY_SWING_H
#define FRET_HISTORY_SWING_H

#include "history/memory.h"
#include "law/normal.h"
#include "number/integral.h"
#include "number/real.h"
#include "number/sum.h"

/* The memory diagram under harmonic forces, event by event, without chords. With P = F_N + F_x/mu and M = F_N
 * - F_x/mu the memory is a curve that rises in both from (0, 0) to the present (M, P); at the load N =
 * (M+P)/2 its slope is sigma = (dP-dM)/(dP+dM). If both grow the curve grows. If M falls the curve is cut at
 * that M and goes on straight up (slip forward), if P falls, straight across (slip backward). With D and d
 * the depths of the edge and of the cut, slip forward dissipates
 *   dW = -dM mu^2 eta [F_N(D) - F_N(d) - (D-d) F_N'(d)]/F_N'(d),   slip backward the same with dP.
 * A swinging load leaves arcs of its own path in the curve. */
typedef struct fret_swing fret_swing;

/* Makes a swing from the state of a memory that is in contact. Borrows its law alone. Errors: FRET_OUTSIDE (a
 * table), FRET_NO_MEMORY. */
fret_status fret_swing_make(const fret_memory *memory, fret_swing **out);
void fret_swing_free(fret_swing *swing);
fret_status fret_swing_copy(fret_swing *to, const fret_swing *from);

/* True if the contact stays closed, slips partially throughout, and is now at the load of the time `from`. */
bool fret_swing_fits(const fret_swing *swing, const fret_sine *sine, double from);
/* Follows a part of a period that fits, as fret_contact_swing. */
fret_status fret_swing_part(fret_swing *swing, const fret_sine *sine, double from, double to);
/* A step to F_x, or to delta_x at constant F_N; FRET_OUTSIDE for others. */
fret_status fret_swing_step(fret_swing *swing, const fret_step *step);
void fret_swing_state(const fret_swing *swing, fret_state *out);
fret_real fret_swing_displacement(const fret_swing *swing, fret_real x);
/* Copies the state to a memory, curved arcs as 640 chords each. Error: FRET_NO_MEMORY. */
fret_status fret_swing_memory(const fret_swing *swing, fret_memory *out);

/* The coordinates of a point on the curve or on the path of the load. */
enum { M, P };

/* A path of the load over s: straight over 0..1, or harmonic, each coordinate mean + size cos(s - lag). */
typedef struct load_path {
    bool harmonic;
    fret_real start[2], span[2];
    fret_real mean, size[2], lag[2];
} load_path;

/* A part of the curve between two points: straight, or curved along a path from s = lo to hi. */
typedef struct arc {
    fret_real first[2], last[2];
    bool curved;
    load_path path;
    fret_real lo, hi;
    bool known; /* curved: true once its sums are computed, at the end of a motion */
    fret_real sum[2];
} arc;

/* A phase of slip of a curve with arcs: the coordinate `which` of the path falls from s = lo to hi, and its
 * level crosses the arc `front`. */
typedef struct swung_phase {
    load_path path;
    int which;
    fret_real lo, hi;
    arc front;
} swung_phase;

struct fret_swing {
    const fret_normal *normal;
    double mu;
    fret_real FN, Fx; /* at the end of the curve */
    fret_real dz, a;  /* depth and radius of the edge of contact */
    fret_real slid;   /* delta_x - mu eta int sigma dy */
    bool held;        /* delta_x = goal exactly, since the last motion imposed it */
    double goal;
    int direction;
    fret_sum W;
    fret_real last_loss, scale; /* scale: the largest of M and P so far */
    size_t count, room;
    arc *arcs;         /* innermost first */
    fret_slips *slips; /* borrowed, or NULL */
};

/* The other coordinate where the coordinate `which` of an arc has the level. */
fret_real fret_swing_other(const arc *p, int which, fret_real level);

/* ---- along the curve --------------------------------------------------------------------------- */

/* An integral along the curve, as accurate as the law. */
static inline fret_real fret_swing_integral(const fret_swing *c, fret_integrand *f, void *context) {
    return fret_integral_ends(f, context, fret_normal_closed(c->normal) ? 1e-17L : 1e-13L);
}

/* Computes the sums of changed arcs, so that later queries only read. */
void fret_swing_compute_sums(fret_swing *c);
fret_real fret_swing_dx(const fret_swing *c);
/* The level of `which` that a slip front reaches at constant F_N when delta_x moves by *left mu eta; *left
 * becomes what remains as gross slip. */
fret_real fret_swing_front(const fret_swing *c, int which, fret_real *left);

/* ---- ways -------------------------------------------------------------------------------------- */

static inline fret_real load_path_at(const load_path *w, int which, fret_real s) {
    return w->harmonic ? w->mean + w->size[which] * cosl(s - w->lag[which])
                       : w->start[which] + w->span[which] * s;
}

/* -d/ds of a coordinate. */
static inline fret_real load_path_fall(const load_path *w, int which, fret_real s) {
    return w->harmonic ? w->size[which] * sinl(s - w->lag[which]) : -w->span[which];
}

/* A harmonic path in the coordinates N = (M+P)/2, in the place of M, and T = (P-M)/2, of P. */
void fret_swing_loads(const load_path *w, load_path *out);

/* The angle, moved by whole turns to within pi of `middle`. */
static inline fret_real turned_to(fret_real angle, fret_real middle) {
    const fret_real turn = 2 * FRET_PI;
    return angle - turn * floorl((angle - middle) / turn + 0.5L);
}

/* The s between lo and hi where a coordinate, monotone there, has the level. */
static inline fret_real load_path_when(const load_path *w, int which, fret_real level, fret_real lo,
                                       fret_real hi) {
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
