/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The memory diagram in numbers of the kind NUMBER, as struct DIAGRAM: see diagram_body.h. Included once for
 * each kind. */
#include <stddef.h>

#include "history/power_law.h"
#include "law/normal.h"

/* Both coordinates of the curve come in depths and in loads. A straight step in (delta_z, delta_x) moves edge
 * and slip front evenly in depth; a straight step in (F_N, F_x) moves them evenly in load, by the same rule.
 */
typedef enum coordinate { DEPTH, LOAD } coordinate;

static inline coordinate other_than(coordinate by) {
    return by == DEPTH ? LOAD : DEPTH;
}

/* A point of the curve: y is depth and load, t int sigma dy and int sigma dF_N; at: where the law has it. */
typedef struct point {
    NUMBER y[2], t[2];
    SPOT at;
} point;

/* From inner on outwards, to the next layer or to the edge, with the slope sigma = dt/dy. */
typedef struct layer {
    point inner;
    NUMBER sigma;
} layer;

struct DIAGRAM {
    const fret_normal *normal; /* borrowed */
    double mu;
    NUMBER mu_eta, per_mu_eta, loss_scale;
    power_law law[2]; /* of the coordinate into the other; of no use where the law is no power */
    NUMBER limit[2];  /* beyond, and below sure, the law counts from another place */
    NUMBER sure[2];   /* from here to there all numbers are within their range */
    point edge;
    coordinate told; /* of the two at the edge the one that was asked for: it is exact */
    NUMBER dz;       /* depth of the edge, or < 0: the gap of the open bodies */
    NUMBER slid;     /* delta_x - mu eta t: what gross slip has carried along */
    NUMBER dx, Fx;   /* as told; else from t, as far as rounding lets them */
    int direction;   /* of the last tangential motion */
    NUMBER W, W_rest, last_loss;
    size_t count, room;
    bool bounded, lossless;
    fret_slips *slips; /* borrowed, or NULL */
    layer *layers;     /* innermost first */
};

FRET_INLINE const point *outer_of(const DIAGRAM *d, const layer *l) {
    return l + 1 < d->layers + d->count ? &l[1].inner : &d->edge;
}

/* How thick a layer is up to its outer end, in depth or load. Where all slips t tells it: that is small where
 * forces are, and has the digits of what is thin. */
FRET_INLINE NUMBER layer_thickness(const layer *l, const point *outer, coordinate by) {
    return l->sigma == 1    ? outer->t[by] - l->inner.t[by]
           : l->sigma == -1 ? l->inner.t[by] - outer->t[by]
                            : outer->y[by] - l->inner.y[by];
}
