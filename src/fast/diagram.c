/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The memory diagram of a power law in double: a curve that steps append to and cut. Allocates its slices. */
#include "fret/diagram.h"

#include <float.h>
#include <stdlib.h>
#include <string.h>

#include "contact/check.h"
#include "contact/normal.h"
#include "contact/phase.h"
#include "fast/zone.h"
#include "number/array.h"

/* A point of the curve in both coordinates: y is depth and load, t int sigma dy and int sigma dF_N. */
typedef struct point {
    double y[2], t[2];
} point;

/* From inner on outwards, to the next slice or to the edge. */
typedef struct layer {
    point inner;
    double sigma;
} layer;

struct fret_diagram {
    const fret_normal *normal; /* borrowed */
    double mu, mu_eta, per_mu_eta, loss_scale;
    fret_double_law law[2]; /* of the coordinate into the other */
    double limit[2];        /* beyond, the law wants another place to count from */
    double sure[2];         /* from here to there all numbers are within their range */
    point edge;
    double dz;     /* depth of the edge, or < 0: the gap of the open bodies */
    double slid;   /* delta_x - mu eta t: what gross slip has carried along */
    double dx, Fx; /* Fx/mu: t[LOAD], but for rounding */
    int direction; /* of the last tangential motion */
    double W, W_rest, last_loss;
    size_t count, room;
    bool bounded, lossless;
    layer *layers; /* innermost first */
};

static const double little = 4 * DBL_EPSILON; /* what places are known to, of the largest */

fret_status fret_diagram_make(const fret_normal *normal, double mu, size_t slices, fret_diagram **out) {
    const fret_status st = fret_check_positive("mu", mu);
    if (st.code)
        return st;
    if (!fret_normal_closed(normal))
        return fret_fail(FRET_OUTSIDE, "n", 0, 0);
    const size_t room = slices ? slices : 32;
    fret_diagram *d = calloc(1, sizeof *d);
    layer *layers = room <= SIZE_MAX / sizeof *layers ? calloc(room, sizeof *layers) : NULL;
    if (!d || !layers) {
        free(d);
        free(layers);
        return fret_fail(FRET_NO_MEMORY, NULL, 0, 0);
    }
    d->normal = normal;
    d->mu = mu;
    d->mu_eta = (double)(mu * normal->foundation.eta);
    d->per_mu_eta = (double)(1 / (mu * normal->foundation.eta));
    d->loss_scale = (double)(mu * mu * normal->foundation.eta);
    fret_double_law_make((double)normal->p, (double)normal->pm1, &d->law[DEPTH]);
    fret_double_law_make((double)normal->q, -(double)(normal->pm1 * normal->q), &d->law[LOAD]);
    d->layers = layers;
    d->room = room;
    d->bounded = slices > 0;
    fret_diagram_reset(d);
    *out = d;
    return st;
}

void fret_diagram_count_loss(fret_diagram *d, bool on) {
    d->lossless = !on;
}

void fret_diagram_free(fret_diagram *d) {
    if (d)
        free(d->layers);
    free(d);
}

void fret_diagram_reset(fret_diagram *d) {
    d->edge = (point){{0, 0}, {0, 0}};
    d->dz = d->slid = d->dx = d->Fx = d->W = d->W_rest = d->last_loss = 0;
    d->limit[DEPTH] = d->limit[LOAD] = 0;
    d->direction = 1;
    d->count = 0;
}

static fret_status make_room(fret_diagram *d, size_t count) {
    layer *grown = d->bounded ? NULL : fret_array_for(d->layers, &d->room, count, sizeof *grown);
    if (!grown)
        return fret_fail(FRET_NO_MEMORY, NULL, 0, 0);
    d->layers = grown;
    return fret_ok();
}

FRET_INLINE fret_status reserve(fret_diagram *d, size_t count) {
    return count <= d->room ? fret_ok() : make_room(d, count);
}

fret_status fret_diagram_copy(fret_diagram *to, const fret_diagram *from) {
    if (to == from)
        return fret_ok();
    const fret_status st = reserve(to, from->count);
    if (st.code)
        return st;
    layer *layers = to->layers;
    const size_t room = to->room;
    const bool bounded = to->bounded;
    *to = *from;
    to->layers = layers;
    to->room = room;
    to->bounded = bounded;
    memcpy(layers, from->layers, from->count * sizeof *layers);
    return st;
}

void fret_diagram_forces(const fret_diagram *d, fret_diagram_now *out) {
    *out = (fret_diagram_now){.FN = d->edge.y[LOAD],
                              .dz = d->dz,
                              .Fx = d->Fx,
                              .dx = d->dx,
                              .W = d->W + d->W_rest,
                              .last_loss = d->last_loss};
}

static fret_real stored(const fret_diagram *d) {
    fret_real sum = 0;
    for (size_t i = 0; i < d->count; i++) {
        const layer *l = &d->layers[i];
        const point *end = i + 1 < d->count ? &l[1].inner : &d->edge;
        const fret_real h = (fret_real)end->y[DEPTH] - l->inner.y[DEPTH], sigma = l->sigma;
        const fret_level outer = {end->y[DEPTH], end->y[LOAD]};
        const fret_slice part = fret_law_slice(d->normal, &outer, h);
        sum += sigma * h * l->inner.t[LOAD] + sigma * sigma * fret_slice_moment(&part);
    }
    return (fret_real)d->loss_scale * sum;
}

/* Inwards from a layer, past those that are as thin as rounding. */
static const layer *past_rounding(const fret_diagram *d, const layer *from) {
    const layer *top = &d->layers[d->count - 1];
    const double outer = from == top ? d->edge.y[LOAD] : from[1].inner.y[LOAD];
    while (from > d->layers && outer - from->inner.y[LOAD] <= little * d->edge.y[LOAD])
        from--;
    return from;
}

/* The one that tells c, as of the exact memory. */
static const layer *outermost(const fret_diagram *d) {
    const layer *top = &d->layers[d->count - 1], *zone = past_rounding(d, top), *next = zone;
    if (fabs(zone->sigma) < 1)
        return top;
    while (next > d->layers && next->sigma == zone->sigma) {
        zone = next;
        next = past_rounding(d, next - 1);
    }
    return next->sigma == zone->sigma ? next : zone;
}

void fret_diagram_state(const fret_diagram *d, fret_state *out) {
    fret_diagram_now now;
    fret_diagram_forces(d, &now);
    *out =
        (fret_state){.FN = now.FN, .dz = now.dz, .Fx = now.Fx, .dx = now.dx, .W = now.W, .slices = d->count};
    if (!d->count)
        return;
    const layer *top = outermost(d);
    const fret_level front = {top->inner.y[DEPTH], top->inner.y[LOAD]};
    out->U = stored(d);
    out->a = fret_law_radius(d->normal, d->edge.y[DEPTH]);
    out->kn = fret_normal_stiffness(d->normal, out->a);
    out->c = fabs(top->sigma) >= 1 ? fret_law_level_radius(d->normal, &front) : out->a;
    const fret_real inner = top->sigma * d->direction >= 1 ? out->c : out->a;
    out->kt = inner > 0 ? fret_normal_stiffness(d->normal, inner) / d->normal->foundation.eta : 0;
}

/* ---- the law ----------------------------------------------------------------------------------- */

FRET_INLINE double other_of(const fret_diagram *d, coordinate by, double y) {
    return fret_double_law_value(&d->law[by], y);
}

/* Depth and load, or load and depth, whose product is an energy: numbers to go on with? */
FRET_INLINE bool shown(double y, double v) {
    const double product = y * v;
    return product > 1e-290 && product < 1e290 && v > 1e-290 && v < 1e290;
}

/* Powers are taken of the ratio to a place that is never much smaller than the largest so far: there their
 * rounding is least. */
static fret_status count_from(fret_diagram *d, coordinate by, double y) {
    fret_press p;
    const fret_status st =
        by == LOAD ? fret_press_by_force(d->normal, y, &p) : fret_press_by_depth(d->normal, y, &p);
    if (st.code)
        return st;
    const fret_real other = by == DEPTH ? fret_law_force(d->normal, y) : fret_law_depth(d->normal, y);
    const fret_real at[2] = {by == DEPTH ? y : other, by == DEPTH ? other : y};
    const double far = 0.7;
    for (coordinate i = DEPTH; i <= LOAD; i++) {
        const coordinate j = i == DEPTH ? LOAD : DEPTH;
        d->law[i].y = (double)at[i];
        d->law[i].per_y = (double)(1 / at[i]);
        d->law[i].v = (double)at[j];
    }
    d->limit[DEPTH] = (double)at[DEPTH] * (1 + far / d->law[DEPTH].s);
    d->limit[LOAD] = (double)at[LOAD] * (1 + far);
    for (coordinate i = DEPTH; i <= LOAD; i++) {
        const double most = d->limit[i], least = 1e-3 * most;
        const bool both = shown(most, other_of(d, i, most)) && shown(least, other_of(d, i, least));
        d->sure[i] = both ? least : INFINITY;
    }
    return st;
}

/* ---- steps ------------------------------------------------------------------------------------- */

/* One step, straight in (y, t) of the coordinate `by`, with the contact closed at both ends. */
typedef struct path {
    fret_diagram *d;
    const bool counts; /* the loss */
    point to;          /* t[other] is found */
    double grow, turn; /* changes of y and t */
    double Y, V;       /* the larger edge, in both coordinates */
    double loss;       /* per mu^2 eta */
    bool slides;       /* ends in gross slip */
} path;

/* F - Fx/mu with all its digits, which tell a depth near gross slip. */
static double short_of(const fret_diagram *d, double F, double Fx) {
    const dd limit = dd_prod(d->mu, F);
    return ((limit.hi - Fx) + limit.lo) / d->mu;
}

/* The level of slip of sign s at the end. */
FRET_INLINE double end_level(const path *p, coordinate by, double s) {
    const double level = p->to.y[by] - s * p->to.t[by];
    if (by == DEPTH || level > 0.1 * p->to.y[by] || level == 0)
        return level;
    return greater(short_of(p->d, p->to.y[LOAD], s * p->d->Fx), 0);
}

/* The zone where the front is, and the next place of it. */
typedef struct front {
    double edge, at, thick; /* thick: edge - at with its digits */
    double edge_v, at_v;    /* in the other coordinate, < 0 where not known */
} front;

FRET_INLINE void dissipate(path *p, coordinate by, double gain, const front *a, const front *b,
                           double travel) {
    if (!p->counts)
        return;
    const fret_zone z = {{a->edge, b->edge},     {a->at, b->at},    {a->thick, b->thick}, travel,
                         {a->edge_v, b->edge_v}, {a->at_v, b->at_v}};
    p->loss += gain * fret_zone_loss(&p->d->law[by], &z, p->Y, p->V);
}

/* Slip of sign s meets a slice: the drive that a unit of it takes, and how far its inner end is beyond the
 * level of the end. */
typedef struct meeting {
    double gain, rest;
} meeting;

FRET_INLINE meeting meet(const layer *l, coordinate by, double s, double level) {
    return (meeting){1 - s * l->sigma, level - (l->inner.y[by] - s * l->inner.t[by])};
}

/* Ends the step with slip of sign s: cuts the outermost of `count` slices where its level is that of the end,
 * and goes straight to the edge. */
FRET_INLINE void cut(path *p, coordinate by, double s, double level, size_t count, meeting at) {
    const coordinate other = by == DEPTH ? LOAD : DEPTH;
    fret_diagram *d = p->d;
    layer *zone = &d->layers[count];
    double y = 0, v = 0, t = 0, tv = 0;
    if (count) {
        const layer *top = zone - 1;
        const double inner = top->inner.y[by];
        y = inner + at.rest / at.gain;
        if (y > inner) {
            y = lesser(y, p->to.y[by]);
            v = other_of(d, by, y);
            t = s * (y - level);
            tv = top->inner.t[other] + top->sigma * (v - top->inner.y[other]);
        } else { /* all of it */
            zone--;
            count--;
            y = zone->inner.y[by];
            v = zone->inner.y[other];
            t = zone->inner.t[by];
            tv = zone->inner.t[other];
        }
    }
    zone->inner.y[by] = y;
    zone->inner.y[other] = v;
    zone->inner.t[by] = t;
    zone->inner.t[other] = tv;
    zone->sigma = s;
    d->count = count + 1;
    p->to.t[other] = tv + s * (p->to.y[other] - v);
}

FRET_INLINE void cut_here(path *p, coordinate by, double s) {
    const fret_diagram *d = p->d;
    const double level = end_level(p, by, s);
    cut(p, by, s, level, d->count, d->count ? meet(&d->layers[d->count - 1], by, s, level) : (meeting){0, 0});
}

/* No spring sticks: gross slip for `e` of the drive, from the edge at `from` on. */
FRET_INLINE void slide(path *p, coordinate by, double s, double e, double from, double from_v) {
    if (by == DEPTH && e > 0 && p->counts) {
        const double v = from_v >= 0 ? from_v : other_of(p->d, DEPTH, from);
        p->loss += e * fret_double_law_mean(&p->d->law[DEPTH], from, v, p->to.y[DEPTH], p->to.y[LOAD]);
    }
    p->to.t[by] = s * p->to.y[by];
    p->slides = true;
}

/* Slip of sign s from the beginning to the end of the step. */
FRET_INLINE void slip(path *p, coordinate by, double s) {
    fret_diagram *d = p->d;
    const coordinate other = by == DEPTH ? LOAD : DEPTH;
    const double drive = s * p->turn - p->grow, level = end_level(p, by, s);
    double left = drive;
    front now = {d->edge.y[by], d->edge.y[by], 0, d->edge.y[other], d->edge.y[other]};
    size_t count = d->count;
    meeting at = {0, 0};
    for (; count; count--) {
        const layer *top = &d->layers[count - 1];
        const double inner = top->inner.y[by], thick = now.at - inner;
        const double same = count > 1 ? little * p->Y : 0; /* of the core the least bit counts */
        at = meet(top, by, s, level);
        if (at.gain > 0 && at.rest > 0 && !(at.rest <= same && at.rest <= 1e-6 * at.gain * thick))
            break;
        const double after = greater(left - at.gain * thick, 0);
        front next = {p->to.y[by] - p->grow * (after / drive), inner, 0, -1, top->inner.y[other]};
        if (p->grow == 0)
            next.edge_v = now.edge_v;
        next.thick = now.thick + (next.edge - now.edge) + thick;
        if (at.gain > 0)
            dissipate(p, by, at.gain, &now, &next, thick);
        left = after;
        now = next;
    }
    if (!count)
        slide(p, by, s, left, now.edge, now.edge_v);
    cut(p, by, s, level, count, at);
    if (count) {
        const point *corner = &d->layers[d->count - 1].inner;
        const double travel = left / at.gain, grown = p->to.y[by] - now.edge;
        const front end = {p->to.y[by], corner->y[by], now.thick + (grown + travel), p->to.y[other],
                           corner->y[other]};
        dissipate(p, by, at.gain, &now, &end, travel);
    }
}

/* Both levels fall: the edge goes inwards and the drive is smaller. At the edge a slope sigma means a surplus
 * sigma - r over the slope r of the path, and starts a zone of that sign s, whose front moves at
 * (1 - s r)/(1 - s sigma); a front slower than the edge is overtaken, and the next slope decides anew. */
FRET_INLINE void retreat(path *p, coordinate by) {
    fret_diagram *d = p->d;
    const coordinate other = by == DEPTH ? LOAD : DEPTH;
    const double r = p->turn / p->grow, to = p->to.y[by], same = little * p->Y / -p->grow;
    double s = 0;
    front now = {d->edge.y[by], d->edge.y[by], 0, d->edge.y[other], d->edge.y[other]};
    while (now.edge > to && d->count) {
        const layer *top = &d->layers[d->count - 1];
        const double inner = top->inner.y[by], surplus = top->sigma - r;
        if (s == 0 && fabs(surplus) <= same) { /* nothing slips: back along the curve */
            now.edge = now.at = greater(inner, to);
            now.edge_v = now.at_v = -1;
            if (inner >= to)
                d->count--;
            continue;
        }
        if (s == 0)
            s = surplus < 0 ? -1 : 1;
        const double gain = 1 - s * top->sigma, thick = now.at - inner;
        if (gain <= 0) {
            now.at = inner;
            now.at_v = top->inner.y[other];
            now.thick += thick;
            d->count--;
            continue;
        }
        const double speed = (1 - s * r) / gain, widens = s * surplus / gain;
        double way = now.edge - to, travel = speed * way;
        bool reached = false, overtaken = false;
        if (thick <= travel) {
            way = thick / speed;
            travel = thick;
            reached = true;
        }
        if (widens < 0 && now.thick <= -widens * way) {
            way = now.thick / -widens;
            travel = lesser(speed * way, thick);
            reached = false;
            overtaken = true;
        }
        front next = {now.edge - way, now.at - travel, now.thick + widens * way, -1, -1};
        if (reached) {
            next.at = inner;
            next.at_v = top->inner.y[other];
            d->count--;
        } else if (overtaken) {
            next.at = next.edge;
            next.thick = 0;
        } else {
            cut_here(p, by, s);
            const point *corner = &d->layers[d->count - 1].inner;
            next = (front){to, corner->y[by], next.thick, p->to.y[other], corner->y[other]};
        }
        dissipate(p, by, gain, &now, &next, travel);
        now = next;
        if (!reached && !overtaken)
            return;
        if (overtaken)
            s = 0;
    }
    if (s == 0 && d->count) { /* the end lies on the curve */
        const layer *top = &d->layers[d->count - 1];
        p->to.t[other] = top->inner.t[other] + top->sigma * (p->to.y[other] - top->inner.y[other]);
        return;
    }
    if (!d->count)
        slide(p, by, s, (1 - s * r) * (now.edge - to), now.edge, now.edge_v);
    cut_here(p, by, s);
}

/* Nothing slips: the curve grows. Slopes that differ by less than rounding merge, else a ramp in many small
 * steps would pile up slices. */
FRET_INLINE void grow(path *p, coordinate by) {
    fret_diagram *d = p->d;
    const coordinate other = by == DEPTH ? LOAD : DEPTH;
    const double sigma = p->turn / p->grow, rounding = little * p->to.y[by] / p->grow;
    layer *top = d->count ? &d->layers[d->count - 1] : NULL;
    if (top && fabs(top->sigma - sigma) <= rounding && (fabs(sigma) < 1) == (fabs(top->sigma) < 1)) {
        const double both = p->to.y[by] - top->inner.y[by];
        if (fabs(sigma) < 1)
            top->sigma = greater(-1, lesser(1, (p->to.t[by] - top->inner.t[by]) / both));
    } else {
        top = &d->layers[d->count++];
        *top = (layer){d->edge, sigma};
    }
    p->to.t[other] = top->inner.t[other] + top->sigma * (p->to.y[other] - top->inner.y[other]);
}

/* Depth and load at the end, t: of the coordinate `by` there. Returns the loss. */
FRET_INLINE double advance(fret_diagram *d, coordinate by, double depth, double load, double t, bool counts) {
    const double y[2] = {depth, load};
    const coordinate other = by == DEPTH ? LOAD : DEPTH;
    path p = {.d = d, .counts = counts};
    p.grow = y[by] - d->edge.y[by];
    p.turn = t - d->edge.t[by];
    for (coordinate i = DEPTH; i <= LOAD; i++)
        p.to.y[i] = y[i];
    p.to.t[by] = t;
    p.Y = p.grow > 0 ? y[by] : d->edge.y[by];
    p.V = p.grow > 0 ? y[other] : d->edge.y[other];
    const double aside = fabs(p.turn), along = fabs(p.grow);
    if (aside > along || (aside == along && p.grow < 0))
        slip(&p, by, p.turn < 0 ? -1 : 1);
    else if (p.grow < 0)
        retreat(&p, by);
    else if (p.grow > 0)
        grow(&p, by);
    else
        return 0;
    for (coordinate i = DEPTH; i <= LOAD; i++) { /* not as a whole: that waits for its parts to be written */
        d->edge.y[i] = p.to.y[i];
        d->edge.t[i] = p.to.t[i];
    }
    if (p.slides && by == DEPTH)
        d->slid = d->dx - d->mu_eta * d->edge.t[DEPTH];
    return p.loss;
}

/* Each by itself: as parts of one function they would keep in memory what fits into registers. */
#define APART static __attribute__((noinline))
APART double by_load(fret_diagram *d, double depth, double load, double t) {
    return advance(d, LOAD, depth, load, t, false);
}
APART double by_load_with_loss(fret_diagram *d, double depth, double load, double t) {
    return advance(d, LOAD, depth, load, t, true);
}
APART double by_depth(fret_diagram *d, double depth, double load, double t) {
    return advance(d, DEPTH, depth, load, t, false);
}
APART double by_depth_with_loss(fret_diagram *d, double depth, double load, double t) {
    return advance(d, DEPTH, depth, load, t, true);
}

static void open_contact(fret_diagram *d, double dx) {
    d->edge = (point){{0, 0}, {0, 0}};
    d->count = 0;
    d->slid = dx;
}

/* Depth and load at the end of a step; dz: depth, or < 0 the gap between the bodies where they part. */
FRET_INLINE fret_status press_to(fret_diagram *d, coordinate by, double target, double y[2], double *dz) {
    const coordinate other = by == DEPTH ? LOAD : DEPTH;
    const double end = greater(target, 0);
    if (!isfinite(target))
        return fret_fail(FRET_NOT_FINITE, by == LOAD ? "FN" : "dz", target, 0);
    if (by == LOAD && target < 0)
        return fret_fail(FRET_NEGATIVE, "FN", target, 0);
    if (end != y[by]) {
        if (end > d->limit[by]) {
            const fret_status st = count_from(d, by, end);
            if (st.code)
                return st;
        }
        y[by] = end;
        y[other] = other_of(d, by, end);
        if (end < d->sure[by] && end > 0 && !shown(end, y[other]))
            return fret_fail(FRET_OVERFLOW, NULL, target, 1e290);
    }
    *dz = target < 0 ? target : y[DEPTH];
    return fret_ok();
}

FRET_INLINE fret_status normal_end(fret_diagram *d, const fret_step *step, double y[2], double *dz) {
    y[DEPTH] = d->edge.y[DEPTH];
    y[LOAD] = d->edge.y[LOAD];
    *dz = d->dz;
    return step->normal_by == FRET_KEEP_NORMAL ? fret_ok()
           : step->normal_by == FRET_TO_FORCE  ? press_to(d, LOAD, step->normal, y, dz)
                                               : press_to(d, DEPTH, step->normal, y, dz);
}

static void step_by_force(fret_diagram *d, const fret_step *step, const double y[2], double load) {
    d->Fx = step->tangential;
    d->last_loss =
        d->lossless ? by_load(d, y[DEPTH], y[LOAD], load) : by_load_with_loss(d, y[DEPTH], y[LOAD], load);
    if (y[LOAD] <= 0)
        open_contact(d, d->slid); /* no spring is left to be displaced */
    d->dx = d->slid + d->mu_eta * d->edge.t[DEPTH];
}

/* With the contact closed. t: int sigma dy at the end. */
FRET_INLINE void move(fret_diagram *d, const double y[2], double t) {
    d->last_loss =
        d->lossless ? by_depth(d, y[DEPTH], y[LOAD], t) : by_depth_with_loss(d, y[DEPTH], y[LOAD], t);
}

FRET_INLINE double turned(const fret_diagram *d, double to, double from) {
    return to == from ? d->edge.t[DEPTH] : (to - d->slid) * d->per_mu_eta;
}

/* While open, the bodies move freely: only the closed part of the path counts. */
static void step_by_displacement(fret_diagram *d, double target, const double y[2], double to) {
    const double old = d->dx, from = d->dz;
    double stop = target;
    d->dx = target;
    d->last_loss = 0;
    if (from <= 0 && to > 0)
        open_contact(d, old + (target - old) * (-from / (to - from)));
    else if (from > 0 && to <= 0)
        stop = old + (target - old) * (from / (from - to));
    if (from > 0 || to > 0)
        move(d, y, turned(d, stop, old));
    if (to <= 0)
        open_contact(d, target);
    d->Fx = d->mu * d->edge.t[LOAD];
}

/* The end of every step. */
FRET_INLINE void end_step(fret_diagram *d, double dz) {
    d->dz = dz;
    if (d->lossless)
        return;
    const double x = d->last_loss > 0 ? d->last_loss * d->loss_scale : 0, t = d->W + x;
    d->W_rest += d->W >= x ? (d->W - t) + x : (x - t) + d->W;
    d->W = t;
    d->last_loss = x;
}

FRET_INLINE void face(fret_diagram *d, double before, double target) {
    if (target != before)
        d->direction = target < before ? -1 : 1;
}

/* With all that may have to be refused, made or opened. */
APART fret_status any_step(fret_diagram *d, const fret_step *step) {
    double y[2], dz, load = 0;
    if (step->tangential_by != FRET_KEEP_DX && !isfinite(step->tangential))
        return fret_fail(FRET_NOT_FINITE, step->tangential_by == FRET_TO_FX ? "Fx" : "dx", step->tangential,
                         0);
    fret_status st = normal_end(d, step, y, &dz);
    if (!st.code && step->tangential_by == FRET_TO_FX) {
        load = step->tangential / d->mu;
        const double limit = d->mu * y[LOAD];
        if (fabs(load) > 0.9 * y[LOAD]) {
            const double missing = d->mu * short_of(d, y[LOAD], fabs(step->tangential));
            if (missing < -DBL_EPSILON * limit)
                st = fret_fail(FRET_GROSS_SLIP, "Fx", step->tangential, limit);
            if (missing < DBL_EPSILON * limit) /* mu F_N up to its rounding */
                load = copysign(y[LOAD], load);
        }
    }
    if (!st.code)
        st = reserve(d, d->count + 2);
    if (st.code)
        return st;
    const double before = step->tangential_by == FRET_TO_FX ? d->Fx : d->dx;
    const double target = step->tangential_by == FRET_KEEP_DX ? d->dx : step->tangential;
    face(d, before, target);
    if (step->tangential_by == FRET_TO_FX)
        step_by_force(d, step, y, load);
    else
        step_by_displacement(d, target, y, dz);
    end_step(d, dz);
    return st;
}

/* Contact stays closed, and there is nothing to refuse and nothing to make: what most steps are. */
FRET_INLINE bool is_plain(const fret_diagram *d, const fret_step *step) {
    return step->normal_by == FRET_TO_DEPTH && step->tangential_by == FRET_TO_DX && d->dz > 0 &&
           step->normal > 0 && step->normal >= d->sure[DEPTH] && step->normal <= d->limit[DEPTH] &&
           fabs(step->tangential) <= DBL_MAX && d->count + 2 <= d->room;
}

fret_status fret_diagram_step(fret_diagram *d, const fret_step *step) {
    if (!is_plain(d, step))
        return any_step(d, step);
    const double y[2] = {step->normal, step->normal == d->edge.y[DEPTH] ? d->edge.y[LOAD]
                                                                        : other_of(d, DEPTH, step->normal)};
    const double t = turned(d, step->tangential, d->dx);
    face(d, d->dx, step->tangential);
    d->dx = step->tangential;
    move(d, y, t);
    d->Fx = d->mu * d->edge.t[LOAD];
    end_step(d, y[DEPTH]);
    return fret_ok();
}
