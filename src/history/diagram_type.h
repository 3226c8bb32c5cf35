/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The types of diagram_body.h, for numbers of type NUMBER, places of type SPOT and the struct name DIAGRAM.
 * Included once for each type of number. */
#include <stddef.h>

#include "history/power_law.h"
#include "law/normal.h"

/* Depth or load as coordinate of the curve. A straight step in (delta_z, delta_x) moves edge and slip front
 * linearly in depth, one in (F_N, F_x) in load, by the same rule. */
typedef enum coordinate { DEPTH, LOAD } coordinate;

static inline coordinate other_than(coordinate by) {
    return by == DEPTH ? LOAD : DEPTH;
}

static inline fret_status press_by(const fret_normal *n, coordinate by, double y, fret_press *out) {
    return by == LOAD ? fret_press_by_force(n, y, out) : fret_press_by_depth(n, y, out);
}

/* A point of the curve: y, its depth and load; t, int sigma dy over depth and over load; at: its place in the
 * law. */
typedef struct point {
    NUMBER y[2], t[2];
    SPOT at;
} point;

/* A layer from the point `inner` outwards to the next layer or the edge, with the slope sigma = dt/dy. */
typedef struct layer {
    point inner;
    NUMBER sigma;
} layer;

struct DIAGRAM {
    const fret_normal *normal; /* borrowed */
    double mu;
    NUMBER mu_eta, per_mu_eta, loss_scale;
    power_law law[2];       /* from each coordinate to the other; unused without a power law */
    NUMBER high[2], low[2]; /* values outside low .. high need law_prepare */
    point edge;
    coordinate imposed; /* by the last step, at the edge: its value is exact */
    NUMBER dz;          /* depth of the edge, or < 0: minus the gap of the open bodies */
    NUMBER slid;        /* delta_x - mu eta t: the part of delta_x due to gross slip */
    NUMBER dx, Fx;      /* as imposed, or else from t */
    int direction;      /* of the last tangential motion */
    NUMBER W, W_rest, last_loss;
    size_t count, room;
    bool lossless;
    fret_slips *slips; /* borrowed, or NULL */
    layer *layers;     /* innermost first */
};

FRET_INLINE const point *outer_of(const DIAGRAM *d, const layer *l) {
    return l + 1 < d->layers + d->count ? &l[1].inner : &d->edge;
}

/* The thickness of a layer, in depth or load, up to its outer end. Where |sigma| = 1 it is the difference of
 * t, which keeps digits of thin layers, since t is small where forces are small. */
FRET_INLINE NUMBER layer_thickness(const layer *l, const point *outer, coordinate by) {
    return l->sigma == 1    ? outer->t[by] - l->inner.t[by]
           : l->sigma == -1 ? l->inner.t[by] - outer->t[by]
                            : outer->y[by] - l->inner.y[by];
}
