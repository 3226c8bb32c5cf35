/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The memory diagram: a curve that steps append to and cut. Included once for each type of number, after
 * history/diagram_type.h and these functions of the law:
 *   law_find         v, the other coordinate of a place, if it is < 0, and the place in the law
 *   law_fall         the fall of v from the edge to a place at the distance `thick`, which is then found
 *   law_bow          the bending of a slice of the law (history/power_law.h)
 *   law_holds        true if numbers hold a value and its v
 *   law_prepare      extends the range, or chooses a new reference, for a value outside it
 *   law_level        y - s t at the edge near gross slip, where every digit counts
 *   law_radius       the contact radius
 *   law_slips        records a phase of slip that dissipates
 * PUBLIC(f): the name of f in the header; LITTLE: the relative accuracy of positions on the curve. Allocates
 * the layers of its contact. */
#include <float.h>
#include <stdlib.h>
#include <string.h>

#include "law/check.h"
#include "number/array.h"

/* fmin and fmax without a call; the second argument if one is NaN. */
FRET_INLINE NUMBER lesser(NUMBER a, NUMBER b) {
    return a < b ? a : b;
}

FRET_INLINE NUMBER greater(NUMBER a, NUMBER b) {
    return a > b ? a : b;
}

FRET_INLINE NUMBER size_of(NUMBER x) {
    return FUNCTION(fabs)(x);
}

/* Not inlined: within a larger function their variables would be spilled to memory. */
#define NOINLINE static __attribute__((noinline))

/* ---- life -------------------------------------------------------------------------------------- */

NOINLINE fret_status make_room(DIAGRAM *d, size_t count) {
    return fret_array_room(&d->layers, &d->room, count, sizeof *d->layers)
               ? fret_ok()
               : fret_fail(FRET_NO_MEMORY, NULL, 0, 0);
}

FRET_INLINE fret_status reserve(DIAGRAM *d, size_t count) {
    return count <= d->room ? fret_ok() : make_room(d, count);
}

void PUBLIC(reset)(DIAGRAM *d) {
    d->edge = (point){.y = {0, 0}};
    d->dz = d->slid = d->dx = d->Fx = d->W = d->W_rest = d->last_loss = 0;
    d->high[DEPTH] = d->high[LOAD] = 0;
    d->low[DEPTH] = d->low[LOAD] = (NUMBER)INFINITY;
    d->imposed = DEPTH;
    d->direction = 1;
    d->count = 0;
}

fret_status PUBLIC(make)(const fret_normal *normal, double mu, DIAGRAM **out) {
    const fret_status st = fret_check_positive("mu", mu);
    if (st.code)
        return st;
    DIAGRAM *d = calloc(1, sizeof *d);
    if (!d || make_room(d, 1).code) {
        free(d);
        return fret_fail(FRET_NO_MEMORY, NULL, 0, 0);
    }
    d->normal = normal;
    d->mu = mu;
    d->mu_eta = (NUMBER)(mu * normal->foundation.eta);
    d->per_mu_eta = (NUMBER)(1 / (mu * normal->foundation.eta));
    d->loss_scale = (NUMBER)(mu * (mu * normal->foundation.eta));
    if (fret_normal_closed(normal)) {
        power_make(normal->p, normal->pm1, &d->law[DEPTH]);
        power_make(normal->q, -normal->pm1 * normal->q, &d->law[LOAD]);
    }
    PUBLIC(reset)(d);
    *out = d;
    return st;
}

void PUBLIC(free)(DIAGRAM *d) {
    if (d)
        free(d->layers);
    free(d);
}

fret_status PUBLIC(copy)(DIAGRAM *to, const DIAGRAM *from) {
    if (to == from)
        return fret_ok();
    const fret_status st = reserve(to, from->count);
    if (st.code)
        return st;
    layer *layers = to->layers;
    const size_t room = to->room;
    fret_slips *slips = to->slips;
    *to = *from;
    to->slips = slips;
    to->layers = layers;
    to->room = room;
    memcpy(layers, from->layers, from->count * sizeof *layers);
    return st;
}

/* ---- the power law ----------------------------------------------------------------------------- */

static fret_status law_prepare(DIAGRAM *d, coordinate by, double y);

/* Sets the reference point of the power law near y, where rounding of powers of the ratio is least: the
 * middle of the 2^16-fold range of loads that contains y, so that it does not depend on the history. */
NOINLINE fret_status choose_reference(DIAGRAM *d, coordinate by, double y) {
    fret_press p, middle;
    const fret_status st = press_by(d->normal, by, y, &p);
    if (st.code)
        return st;
    int exponent;
    frexpl(p.F, &exponent);
    if (fret_press_by_force(d->normal, ldexp(1, (exponent & ~15) + 8), &middle).code)
        middle = p; /* next to the ends of the range of numbers */
    const fret_real at[2] = {middle.dz, middle.F}, wide[2] = {exp2l(8 / d->normal->p), 256};
    for (coordinate i = DEPTH; i <= LOAD; i++) {
        d->law[i].per_y = (NUMBER)(1 / at[i]);
        d->law[i].v = (NUMBER)at[other_than(i)];
    }
    for (coordinate i = DEPTH; i <= LOAD; i++) {
        const NUMBER least = (NUMBER)(at[i] / wide[i]);
        d->high[i] = (NUMBER)(at[i] * wide[i]);
        d->low[i] = law_holds(d, i, d->high[i]) && law_holds(d, i, least) ? least : (NUMBER)INFINITY;
    }
    return st;
}

/* ---- what slip dissipates ---------------------------------------------------------------------- */

/* While the slip front is at d and the edge at D, a move of the front dissipates int_d^D (D-z) dm, dm = |v''|
 * dz. Over a phase that is int psi(z) dm, psi(z) = int (D-z) |dd| over the times at which d < z < D: a
 * quadratic between any two of the places where front and edge begin and end, here inner (1-x)^2 + 2 middle x
 * (1-x) + outer x^2, x = 0 .. 1 from the inner place to the outer. All terms are positive. */
FRET_INLINE NUMBER product_or_0(NUMBER weight, NUMBER bend) {
    return weight > 0 ? weight * bend : 0; /* bend may be infinite at the centre */
}

FRET_INLINE NUMBER weighted_bow(const DIAGRAM *d, coordinate by, const place *from, const place *to, NUMBER w,
                                NUMBER inner, NUMBER middle, NUMBER outer) {
    if (!(w > 0))
        return 0;
    const bow b = law_bow(d, by, to, from, w);
    return product_or_0(middle, b.middle) + product_or_0(outer, b.outer) + product_or_0(inner, b.inner);
}

/* A slip zone, from the slip front to the edge. */
typedef struct slip_front {
    place edge, at;
    NUMBER thick; /* edge - at, with the digits of a small difference */
} slip_front;

static void law_slips(DIAGRAM *d, coordinate by, NUMBER gain, const slip_front *a, const slip_front *b,
                      NUMBER travel);
static void law_slips_all(DIAGRAM *d, NUMBER e, const place *from, const place *to);

/* The loss of a phase of slip: edge and front move linearly from a to b, the front by `travel`. at: their
 * places at both ends, outwards; w: the distances between these; start, end: psi at the two in the middle;
 * middle: its coefficients between places. */
NOINLINE NUMBER phase_loss(const DIAGRAM *d, coordinate by, slip_front *a, slip_front *b, NUMBER travel) {
    const NUMBER h0 = lesser(a->thick, a->edge.y), h1 = lesser(b->thick, b->edge.y), /* against rounding */
        growth = b->edge.y - a->edge.y, size = size_of(growth);
    const place *at[4] = {&b->at, &a->at, &a->edge, &b->edge};
    NUMBER w[3] = {travel, h0, size}, start = travel * (h0 + (h1 - travel)) / 2, end = travel * size / 2,
           middle[2] = {travel * h1 / 2, (start + end) / 2};
    if (!(travel > 0))
        return 0;
    law_find(d, by, &a->edge);
    law_find(d, by, &a->at);
    law_find(d, by, &b->edge);
    law_find(d, by, &b->at);
    if (growth < 0 && h1 >= travel) {
        at[2] = &b->edge;
        at[3] = &a->edge;
        w[1] = h1 - travel;
    } else if (growth < 0) { /* the edge reaches places that the front has passed */
        at[1] = &b->edge;
        at[2] = &a->at;
        at[3] = &a->edge;
        w[0] = h1;
        w[1] = travel - h1;
        w[2] = h0;
        start = size * h1 * h1 / (2 * travel);
        end = travel * h0 * h0 / (2 * size);
        middle[0] = h1 * h1 / 2;
        middle[1] = h0 * h1 / 2;
    }
    return weighted_bow(d, by, at[2], at[3], w[2], end, 0, 0) +
           weighted_bow(d, by, at[1], at[2], w[1], start, middle[1], end) +
           weighted_bow(d, by, at[0], at[1], w[0], 0, middle[0], start);
}

/* The mean force between two depths: that of the chord, less the bending. */
NOINLINE NUMBER mean_force(const DIAGRAM *d, const place *a, const place *b) {
    const NUMBER h = size_of(b->y - a->y);
    const bool rises = a->y < b->y;
    return h > 0 ? (a->v + b->v) / 2 - law_bow(d, DEPTH, rises ? b : a, rises ? a : b, h).middle * h / 4
                 : b->v;
}

/* ---- steps ------------------------------------------------------------------------------------- */

/* The normal state at the end of a step. */
typedef struct normal_end {
    NUMBER y[2];
    SPOT at;
    NUMBER dz; /* depth, or < 0: minus the gap of the open bodies */
    coordinate imposed;
} normal_end;

/* One step, straight in (y, t) of the coordinate `by`, with the contact closed at both ends. */
typedef struct path {
    DIAGRAM *d;
    bool counts;       /* whether to compute the loss */
    point to;          /* its t in the other coordinate is found by the step */
    NUMBER grow, turn; /* changes of y and t */
    NUMBER Y;          /* the larger edge */
    NUMBER felt;       /* the drive has the rounding errors of numbers of this size */
    NUMBER loss;       /* divided by mu^2 eta */
    bool slides;       /* ends in gross slip */
} path;

FRET_INLINE place place_of(const point *p, coordinate by) {
    return (place){p->y[by], p->y[other_than(by)], p->at};
}

/* Member by member: copying the struct would wait for its members to be written. */
FRET_INLINE void put_place(place *to, const place *from) {
    to->y = from->y;
    to->v = from->v;
    to->at = from->at;
}

FRET_INLINE void put_point(place *to, const point *p, coordinate by) {
    to->y = p->y[by];
    to->v = p->y[other_than(by)];
    to->at = p->at;
}

/* A place that is not yet found. */
FRET_INLINE void put_at(place *to, NUMBER y) {
    to->y = y;
    to->v = -1;
    to->at = (SPOT){0};
}

/* The level y - s t at the end of the step, for slip of sign s. Below a tenth of y the difference loses
 * digits: law_level uses imposed values, better near gross slip but useless if delta_x is far larger than mu
 * eta t. */
FRET_INLINE NUMBER end_level(const path *p, coordinate by, NUMBER s) {
    const NUMBER y = p->to.y[by], level = y - s * p->to.t[by];
    if (size_of(level) > (NUMBER)0.1 * y || level == 0)
        return level;
    const place edge = place_of(&p->to, by);
    const NUMBER left = law_level(p->d, by, s, &edge, level);
    return size_of(left - level) <= LITTLE * y ? left : level;
}

FRET_INLINE void dissipate(path *p, coordinate by, NUMBER gain, slip_front *a, slip_front *b, NUMBER travel) {
    if (!p->counts)
        return;
    law_slips(p->d, by, gain, a, b, travel);
    p->loss += gain * phase_loss(p->d, by, a, b, travel);
}

/* How far a front has moved: by the drive, or near the centre by its places, which have more digits there. */
FRET_INLINE NUMBER travelled(const path *p, const slip_front *a, const slip_front *b, NUMBER travel) {
    return a->at.y < p->felt ? a->at.y - b->at.y : travel;
}

/* Slip of sign s in a layer. gain: the drive per distance of the front; rest: the drive from its end to the
 * inner end. */
typedef struct meeting {
    NUMBER gain, rest;
} meeting;

FRET_INLINE meeting meet(const layer *l, coordinate by, NUMBER s, NUMBER level) {
    return (meeting){1 - s * l->sigma, level - (l->inner.y[by] - s * l->inner.t[by])};
}

/* Ends the step with slip of sign s in a zone of thickness `thick`: cuts the outermost of `count` layers
 * where its level is that of the end of the step, `part` from its inner end, and adds a straight line to the
 * edge; count = 0: gross slip. outer: NULL, or the outer end of a layer so thin that its t is more exact than
 * its y, from which the front has moved `travel`. */
FRET_INLINE void cut(path *p, coordinate by, NUMBER s, size_t count, NUMBER part, NUMBER thick,
                     const point *outer, NUMBER travel) {
    const coordinate aside = other_than(by);
    place edge = place_of(&p->to, by), front = {0};
    DIAGRAM *d = p->d;
    layer *zone = &d->layers[count];
    NUMBER fall = edge.v, t = 0, ty = 0, tv = 0;
    if (count) {
        const layer *top = zone - 1;
        const NUMBER inner = top->inner.y[by], v = top->inner.y[aside];
        ty = top->inner.t[by];
        tv = top->inner.t[aside];
        put_at(&front, lesser(inner + part, edge.y));
        if (front.y > inner) {
            fall = law_fall(d, by, &edge, thick, &front);
            front.v = lesser(greater(front.v, v), edge.v);
            t = front.v - v;
            if (outer) {
                place end = place_of(outer, by);
                t = layer_thickness(top, outer, aside) -
                    (outer == &d->edge ? fall : law_fall(d, by, &end, travel, &front));
            }
            ty += top->sigma * part;
            tv += top->sigma * t;
        } else { /* the whole layer slips */
            put_point(&front, &top->inner, by);
            fall = law_fall(d, by, &edge, thick, &front);
            zone--;
            count--;
        }
    } else {
        p->to.t[by] = s * edge.y;
        p->slides = true;
    }
    zone->inner.y[by] = front.y;
    zone->inner.y[aside] = front.v;
    zone->inner.at = front.at;
    zone->inner.t[by] = ty;
    zone->inner.t[aside] = tv;
    zone->sigma = s;
    d->count = count + 1;
    p->to.t[aside] = tv + s * fall;
}

/* The slip zone after a cut. */
FRET_INLINE void put_end(slip_front *end, const path *p, coordinate by, NUMBER thick) {
    put_point(&end->edge, &p->to, by);
    put_point(&end->at, &p->d->layers[p->d->count - 1].inner, by);
    end->thick = thick;
}

FRET_INLINE void put_front(slip_front *to, const slip_front *from) {
    put_place(&to->edge, &from->edge);
    put_place(&to->at, &from->at);
    to->thick = from->thick;
}

FRET_INLINE void begin_at(slip_front *begin, const point *edge, coordinate by) {
    put_point(&begin->edge, edge, by);
    put_point(&begin->at, edge, by);
    begin->thick = 0;
}

/* The loss of gross slip over the part `e` of the drive, while the edge moves on from `from`; by load 0. */
FRET_INLINE void dissipate_all(path *p, coordinate by, NUMBER e, place *from) {
    if (by == DEPTH && e > 0 && p->counts) {
        const place b = place_of(&p->to, DEPTH);
        law_find(p->d, DEPTH, from);
        law_slips_all(p->d, e, from, &b);
        p->loss += e * mean_force(p->d, from, &b);
    }
}

/* A step with slip of one sign s from its beginning to its end. */
FRET_INLINE void slip(path *p, coordinate by, NUMBER s) {
    DIAGRAM *d = p->d;
    const NUMBER drive = s * p->turn - p->grow, level = end_level(p, by, s), edge = p->to.y[by];
    const point *outer = &d->edge;
    NUMBER left = drive;
    slip_front now, next;
    size_t count = d->count;
    meeting at = {0, 0};
    bool thin = false;
    begin_at(&now, &d->edge, by);
    for (; count; count--) {
        const layer *top = &d->layers[count - 1];
        const NUMBER thick = layer_thickness(top, outer, by),
                     same = count > 1 ? LITTLE * p->Y : 0; /* in the innermost layer every bit counts */
        at = meet(top, by, s, level);
        thin = size_of(top->sigma) == 1 && p->felt < top->inner.y[by];
        if (thin) /* the same from the drive */
            at.rest = at.gain * thick - left;
        /* stop here, unless the rest is rounding and a trace of the layer */
        if (at.gain > 0 && at.rest > 0 && !(at.rest <= same && at.rest <= (NUMBER)1e-6 * at.gain * thick))
            break;
        outer = &top->inner;
        if (!(at.gain > 0)) { /* it slips already */
            put_point(&now.at, outer, by);
            now.thick += thick;
            continue;
        }
        left = greater(left - at.gain * thick, 0);
        if (p->grow != 0)
            put_at(&next.edge, edge - p->grow * (left / drive));
        else
            put_place(&next.edge, &now.edge);
        put_point(&next.at, outer, by);
        next.thick = now.thick + thick + (next.edge.y - now.edge.y);
        dissipate(p, by, at.gain, &now, &next, thick);
        put_front(&now, &next);
    }
    if (!count) {
        dissipate_all(p, by, left, &now.edge);
        cut(p, by, s, 0, 0, edge, NULL, 0);
        return;
    }
    /* if the edge moves far the drive has lost digits */
    const NUMBER travel = left / at.gain, part = at.rest / at.gain,
                 thick = -p->grow > edge ? edge - (d->layers[count - 1].inner.y[by] + part)
                                         : now.thick + (edge - now.edge.y) + travel;
    cut(p, by, s, count, part, thick, thin && p->grow == 0 ? outer : NULL, travel);
    put_end(&next, p, by, thick);
    dissipate(p, by, at.gain, &now, &next, travelled(p, &now, &next, travel));
}

/* The last phase of a step in which the edge retreats: up to its end a front of slip of sign s moves in the
 * outermost of `count` layers; s = 0: there is none. */
typedef struct last_phase {
    slip_front zone[2], *begin, *end;
    NUMBER s, gain, travel;
    size_t count;
} last_phase;

/* The losses while the edge moves inwards by more than the drive. With r the slope of the path, a layer of
 * slope sigma at the edge starts a slip zone of the sign of sigma - r, the surplus. Its front is faster than
 * the edge by the surplus over 1 - s sigma. The edge overtakes a slower front; then the next layer
 * decides. */
FRET_INLINE void phases_back(path *p, coordinate by, last_phase *last) {
    const DIAGRAM *d = p->d;
    const NUMBER r = p->turn / p->grow, to = p->to.y[by];
    slip_front *now = &last->zone[0], *next = &last->zone[1];
    size_t count = d->count;
    begin_at(now, &d->edge, by);
    last->s = 0;
    while (count && now->edge.y > to) {
        const layer *top = &d->layers[count - 1];
        const NUMBER surplus = top->sigma - r, thick = now->at.y - top->inner.y[by],
                     s = last->s != 0  ? last->s
                         : surplus < 0 ? -1
                                       : 1,
                     gain = 1 - s * top->sigma;
        last->s = s;
        if (gain <= 0) {
            put_point(&now->at, &top->inner, by);
            now->thick += thick;
            count--;
            continue;
        }
        const NUMBER widens = s * surplus / gain, speed = 1 + widens;
        NUMBER moved = now->edge.y - to, travel = speed * moved;
        const bool reaches = thick <= travel;
        if (reaches) {
            moved = thick > 0 ? thick / speed : 0;
            travel = thick;
        }
        const bool overtaken = widens < 0 && now->thick <= -widens * moved, reached = reaches && !overtaken;
        if (overtaken) {
            moved = now->thick / -widens;
            travel = lesser(speed * moved, thick);
        }
        put_at(&next->edge, greater(now->edge.y - moved, to));
        if (reached)
            put_point(&next->at, &top->inner, by);
        else
            put_at(&next->at, overtaken ? next->edge.y : now->at.y - travel);
        next->thick = overtaken ? 0 : now->thick + widens * moved;
        if (!reached && !overtaken) {
            put_point(&next->edge, &p->to, by);
            last->begin = now;
            last->end = next;
            last->gain = gain;
            last->travel = travel;
            last->count = count;
            return;
        }
        dissipate(p, by, gain, now, next, travel);
        slip_front *const before = now;
        now = next;
        next = before;
        if (reached)
            count--;
        else
            last->s = 0;
    }
    if (!count)
        dissipate_all(p, by, (1 - last->s * r) * (now->edge.y - to), &now->edge);
    last->s = 0;
}

/* A step in which both levels fall: cuts the curve where the first of them has its value at the end. */
FRET_INLINE void retreat(path *p, coordinate by) {
    DIAGRAM *d = p->d;
    const coordinate aside = other_than(by);
    const NUMBER to = p->to.y[by], forward = end_level(p, by, 1), backward = end_level(p, by, -1);
    last_phase last; /* initialising all of it would double the time */
    last.s = 0;
    last.end = NULL;
    last.count = 0;
    NUMBER s = 0, part = 0, thick = to;
    if (p->counts)
        phases_back(p, by, &last);
    size_t count = d->count;
    for (; count; count--) {
        const layer *top = &d->layers[count - 1];
        const meeting f = meet(top, by, 1, forward), b = meet(top, by, -1, backward);
        s = f.rest <= 0 || f.rest * b.gain < b.rest * f.gain ? 1 : -1;
        if (f.rest > 0 && b.rest > 0) {
            part = s > 0 ? f.rest / f.gain : b.rest / b.gain;
            thick = to - (top->inner.y[by] + part);
            break;
        }
    }
    if (count && thick <= LITTLE * to) { /* the end of the step lies on the curve */
        const layer *top = &d->layers[count - 1];
        d->count = count;
        p->to.t[aside] = top->inner.t[aside] + top->sigma * (p->to.y[aside] - top->inner.y[aside]);
    } else {
        cut(p, by, s, count, part, thick, NULL, 0);
        if (last.s == s && last.count == count)
            put_end(last.end, p, by, thick);
    }
    if (last.s != 0)
        dissipate(p, by, last.gain, last.begin, last.end, travelled(p, last.begin, last.end, last.travel));
}

/* A step without slip: the curve grows. Slopes that differ by less than the rounding of targets merge, else a
 * ramp in many small steps would pile up layers. */
FRET_INLINE void grow(path *p, coordinate by) {
    DIAGRAM *d = p->d;
    const coordinate aside = other_than(by);
    const NUMBER sigma = p->turn / p->grow, rounding = 4 * (NUMBER)DBL_EPSILON * p->to.y[by] / p->grow;
    layer *top = d->count ? &d->layers[d->count - 1] : NULL;
    if (top && size_of(top->sigma - sigma) <= rounding && (size_of(sigma) < 1) == (size_of(top->sigma) < 1)) {
        const NUMBER both = p->to.y[by] - top->inner.y[by];
        if (size_of(sigma) < 1)
            top->sigma = greater(-1, lesser(1, (p->to.t[by] - top->inner.t[by]) / both));
    } else {
        top = &d->layers[d->count++];
        *top = (layer){d->edge, sigma};
    }
    p->to.t[aside] = top->inner.t[aside] + top->sigma * (p->to.y[aside] - top->inner.y[aside]);
}

/* Moves the edge to y, with t in the coordinate `by`. Returns the loss. */
FRET_INLINE NUMBER advance(DIAGRAM *d, coordinate by, const normal_end *end, NUMBER t, bool counts) {
    const NUMBER *y = end->y;
    path p; /* member by member, as in put_place */
    p.d = d;
    p.counts = counts;
    p.loss = 0;
    p.slides = false;
    p.grow = y[by] - d->edge.y[by];
    p.turn = t - d->edge.t[by];
    for (coordinate i = DEPTH; i <= LOAD; i++)
        p.to.y[i] = y[i];
    p.to.t[by] = t;
    p.to.at = end->at;
    p.felt = size_of(t) + size_of(d->edge.t[by]);
    p.Y = p.grow > 0 ? y[by] : d->edge.y[by];
    const NUMBER aside = size_of(p.turn), along = size_of(p.grow);
    if (aside > along || (aside == along && p.grow < 0))
        slip(&p, by, p.turn < 0 ? -1 : 1);
    else if (p.grow < 0)
        retreat(&p, by);
    else if (p.grow > 0)
        grow(&p, by);
    else
        return 0;
    for (coordinate i = DEPTH; i <= LOAD; i++) { /* member by member, as in put_place */
        d->edge.y[i] = p.to.y[i];
        d->edge.t[i] = p.to.t[i];
    }
    d->edge.at = p.to.at;
    for (size_t i = d->count; i > 0 && d->layers[i - 1].inner.y[other_than(by)] > y[other_than(by)]; i--)
        d->layers[i - 1].inner.y[other_than(by)] = y[other_than(by)]; /* against rounding */
    if (p.slides && by == DEPTH)
        d->slid = d->dx - d->mu_eta * d->edge.t[DEPTH];
    return p.loss;
}

NOINLINE NUMBER by_load(DIAGRAM *d, const normal_end *end, NUMBER t) {
    return advance(d, LOAD, end, t, false);
}
NOINLINE NUMBER by_load_with_loss(DIAGRAM *d, const normal_end *end, NUMBER t) {
    return advance(d, LOAD, end, t, true);
}
NOINLINE NUMBER by_depth(DIAGRAM *d, const normal_end *end, NUMBER t) {
    return advance(d, DEPTH, end, t, false);
}
NOINLINE NUMBER by_depth_with_loss(DIAGRAM *d, const normal_end *end, NUMBER t) {
    return advance(d, DEPTH, end, t, true);
}

static void open_contact(DIAGRAM *d, NUMBER dx) {
    d->edge = (point){.y = {0, 0}};
    d->count = 0;
    d->slid = dx;
}

FRET_INLINE fret_status press_to(DIAGRAM *d, coordinate by, double target, normal_end *to) {
    const double end = target > 0 ? target : 0;
    if (!isfinite(target))
        return fret_fail(FRET_NOT_FINITE, by == LOAD ? "FN" : "dz", target, 0);
    if (by == LOAD && target < 0)
        return fret_fail(FRET_NEGATIVE, "FN", target, 0);
    if (end != to->y[by]) {
        place edge;
        put_at(&edge, end);
        if (end > 0 && (end < d->low[by] || end > d->high[by])) {
            const fret_status st = law_prepare(d, by, end);
            if (st.code)
                return st;
        }
        law_find(d, by, &edge);
        to->y[by] = end;
        to->y[other_than(by)] = edge.v;
        to->at = edge.at;
        to->imposed = by;
    }
    to->dz = target < 0 ? (NUMBER)target : to->y[DEPTH];
    return fret_ok();
}

FRET_INLINE fret_status find_normal_end(DIAGRAM *d, const fret_step *step, normal_end *to) {
    to->y[DEPTH] = d->edge.y[DEPTH]; /* member by member, as in put_place */
    to->y[LOAD] = d->edge.y[LOAD];
    to->at = d->edge.at;
    to->dz = d->dz;
    to->imposed = d->imposed;
    return step->normal_by == FRET_KEEP_NORMAL ? fret_ok()
           : step->normal_by == FRET_TO_FORCE  ? press_to(d, LOAD, step->normal, to)
                                               : press_to(d, DEPTH, step->normal, to);
}

/* F_x/mu at the end of the step. */
FRET_INLINE fret_status find_load(const DIAGRAM *d, const fret_step *step, NUMBER FN, NUMBER *load) {
    fret_real to = 0;
    *load = (NUMBER)step->tangential / (NUMBER)d->mu;
    if (size_of(*load) < (NUMBER)0.9 * FN) /* no check needed far from gross slip */
        return fret_ok();
    const fret_status st = fret_step_load(d->mu, step, FN, &to);
    *load = (NUMBER)to;
    return st;
}

static void step_by_force(DIAGRAM *d, double Fx, const normal_end *end, NUMBER load) {
    if (Fx == d->Fx && size_of(d->edge.t[LOAD]) <= end->y[LOAD])
        load = d->edge.t[LOAD]; /* else the rounding of the quotient would be a reversal */
    d->Fx = Fx;
    d->last_loss = d->lossless ? by_load(d, end, load) : by_load_with_loss(d, end, load);
    if (end->y[LOAD] <= 0)
        open_contact(d, d->slid); /* no spring is in contact */
    d->dx = d->slid + d->mu_eta * d->edge.t[DEPTH];
}

/* A step by displacement with the contact closed; t: int sigma dy at its end. */
FRET_INLINE void step_closed(DIAGRAM *d, const normal_end *end, NUMBER t) {
    d->last_loss = d->lossless ? by_depth(d, end, t) : by_depth_with_loss(d, end, t);
}

FRET_INLINE NUMBER t_of_dx(const DIAGRAM *d, NUMBER to, NUMBER from) {
    return to == from ? d->edge.t[DEPTH] : (to - d->slid) * d->per_mu_eta;
}

/* The open bodies move freely: only the closed part of the path counts. */
static void step_by_displacement(DIAGRAM *d, NUMBER target, const normal_end *end) {
    const NUMBER old = d->dx, from = d->dz, to = end->dz;
    NUMBER stop = target;
    d->dx = target;
    d->last_loss = 0;
    if (from <= 0 && to > 0)
        open_contact(d, old + (target - old) * (-from / (to - from)));
    else if (from > 0 && to <= 0)
        stop = old + (target - old) * (from / (from - to));
    if (from > 0 || to > 0)
        step_closed(d, end, t_of_dx(d, stop, old));
    if (to <= 0)
        open_contact(d, target);
    d->Fx = d->mu * d->edge.t[LOAD];
}

/* The last part of every step: the sum of losses, compensated. */
FRET_INLINE void end_step(DIAGRAM *d, NUMBER dz) {
    d->dz = dz;
    if (d->lossless)
        return;
    const NUMBER x = d->last_loss > 0 ? d->last_loss * d->loss_scale : 0, t = d->W + x;
    d->W_rest += d->W >= x ? (d->W - t) + x : (x - t) + d->W;
    d->W = t;
    d->last_loss = x;
}

FRET_INLINE void set_direction(DIAGRAM *d, NUMBER before, NUMBER target) {
    if (target != before)
        d->direction = target < before ? -1 : 1;
}

/* Any step, with its checks, allocation, opening and closing. */
NOINLINE fret_status any_step(DIAGRAM *d, const fret_step *step) {
    const bool by_force = step->tangential_by == FRET_TO_FX;
    normal_end to;
    NUMBER load = 0;
    if (step->tangential_by != FRET_KEEP_DX && !isfinite(step->tangential))
        return fret_fail(FRET_NOT_FINITE, by_force ? "Fx" : "dx", step->tangential, 0);
    fret_status st = find_normal_end(d, step, &to);
    if (!st.code && by_force)
        st = find_load(d, step, to.y[LOAD], &load);
    if (!st.code)
        st = reserve(d, d->count + 2);
    if (st.code)
        return st;
    const NUMBER target = step->tangential_by == FRET_KEEP_DX ? d->dx : (NUMBER)step->tangential;
    set_direction(d, by_force ? d->Fx : d->dx, target);
    d->imposed = to.imposed;
    if (by_force)
        step_by_force(d, step->tangential, &to, load);
    else
        step_by_displacement(d, target, &to);
    end_step(d, to.dz);
    return st;
}

/* True for the common step, in which the contact stays closed, needing neither checks nor allocation. */
FRET_INLINE bool is_plain(const DIAGRAM *d, const fret_step *step) {
    return step->normal_by == FRET_TO_DEPTH && step->tangential_by == FRET_TO_DX && d->dz > 0 &&
           step->normal > 0 && step->normal >= d->low[DEPTH] && step->normal <= d->high[DEPTH] &&
           fabs(step->tangential) <= DBL_MAX && d->count + 2 <= d->room;
}

FRET_INLINE fret_status diagram_step(DIAGRAM *d, const fret_step *step) {
    if (!is_plain(d, step))
        return any_step(d, step);
    const bool stays = step->normal == d->edge.y[DEPTH];
    place edge;
    normal_end to;
    put_at(&edge, step->normal);
    if (stays)
        put_point(&edge, &d->edge, DEPTH);
    else
        law_find(d, DEPTH, &edge);
    to.y[DEPTH] = edge.y;
    to.y[LOAD] = edge.v;
    to.at = edge.at;
    const NUMBER t = t_of_dx(d, step->tangential, d->dx);
    set_direction(d, d->dx, step->tangential);
    d->dx = step->tangential;
    d->imposed = stays ? d->imposed : DEPTH;
    step_closed(d, &to, t);
    d->Fx = d->mu * d->edge.t[LOAD];
    end_step(d, to.y[DEPTH]);
    return fret_ok();
}

/* ---- state ------------------------------------------------------------------------------------- */

/* U = mu^2 eta/2 int v^2 dK, v = int sigma dy from the edge. From the centre outwards, a layer of thickness h
 * adds sigma h T + sigma^2 int t K dt to int v^2 dK/2, T = int sigma dF_N inside it. */
static fret_real stored(const DIAGRAM *d) {
    fret_real sum = 0;
    for (const layer *l = d->layers; l < d->layers + d->count && !fret_stopped(d->normal); l++) {
        const point *end = outer_of(d, l);
        const fret_real h = layer_thickness(l, end, DEPTH), sigma = l->sigma;
        if (sigma == 0 || !(h > 0))
            continue;
        const fret_slice part = fret_law_slice(d->normal, &(fret_level){end->y[DEPTH], end->y[LOAD]}, h);
        sum += sigma * h * l->inner.t[LOAD] + sigma * sigma * fret_slice_moment(&part);
    }
    return d->mu * (d->mu * d->normal->foundation.eta) * sum;
}

/* Skips layers, inwards, that are thinner than the rounding of loads. */
static const layer *past_rounding(const DIAGRAM *d, const layer *from) {
    const NUMBER rounding = 4 * (NUMBER)DBL_EPSILON * d->edge.y[LOAD];
    while (from > d->layers && layer_thickness(from, outer_of(d, from), LOAD) <= rounding)
        from--;
    return from;
}

/* The layer that determines the stick radius c. Thin layers that rounding leaves at the edge, or where the
 * present slip meets earlier slip of the same sign, do not hide a slip zone. */
static const layer *outermost(const DIAGRAM *d) {
    const layer *top = &d->layers[d->count - 1], *zone = past_rounding(d, top), *next = zone;
    if (size_of(zone->sigma) < 1)
        return top;
    while (next > d->layers && next->sigma == zone->sigma) {
        zone = next;
        next = past_rounding(d, next - 1);
    }
    return next->sigma == zone->sigma ? next : zone;
}

void PUBLIC(forces)(const DIAGRAM *d, fret_state *out) {
    static const fret_state nothing;
    *out = nothing; /* gcc clears a literal in a loop, which takes as long as a step */
    out->FN = d->edge.y[LOAD];
    out->dz = d->dz;
    out->Fx = d->Fx;
    out->dx = d->dx;
    out->W = (fret_real)d->W + d->W_rest;
    out->slices = d->count;
}

void PUBLIC(state)(const DIAGRAM *d, fret_state *out) {
    PUBLIC(forces)(d, out);
    if (!d->count)
        return;
    const layer *top = outermost(d);
    out->U = stored(d);
    out->a = law_radius(d);
    out->kn = fret_normal_stiffness(d->normal, out->a);
    out->c = out->a;
    if (size_of(top->sigma) >= 1)
        out->c =
            top == d->layers
                ? 0
                : fret_law_level_radius(d->normal, &(fret_level){top->inner.y[DEPTH], top->inner.y[LOAD]});
    const fret_real inner = top->sigma * d->direction >= 1 ? out->c : out->a;
    out->kt = inner > 0 ? fret_normal_stiffness(d->normal, inner) / d->normal->foundation.eta : 0;
}

/* ---- as doubles -------------------------------------------------------------------------------- */

enum { PACKED_KIND, PACKED_IMPOSED, PACKED_DIRECTION, PACKED_LOSSLESS, PACKED_NUMBERS }; /* the header */
enum { NUMBERS_EDGE = 4, NUMBERS_REST = 7, NUMBERS_LAYER = 5 };

/* A number is packed as two doubles: long double has no more digits. */
static double *pack_number(double *out, NUMBER x) {
    const double high = (double)x;
    *out++ = high;
    *out++ = isfinite(high) ? (double)(x - high) : 0;
    return out;
}

static const double *unpack_number(const double *from, NUMBER *x) {
    *x = (NUMBER)from[0] + (NUMBER)from[1];
    return from + 2;
}

static double *pack_point(double *out, const point *p) {
    for (coordinate by = DEPTH; by <= LOAD; by++)
        out = pack_number(pack_number(out, p->y[by]), p->t[by]);
    return out;
}

static const double *unpack_point(const double *from, point *p) {
    for (coordinate by = DEPTH; by <= LOAD; by++)
        from = unpack_number(unpack_number(from, &p->y[by]), &p->t[by]);
    return from;
}

size_t PUBLIC(packed)(const DIAGRAM *d) {
    return PACKED_NUMBERS + 2 * (NUMBERS_EDGE + NUMBERS_REST + NUMBERS_LAYER * d->count);
}

void PUBLIC(pack)(const DIAGRAM *d, double out[]) {
    const NUMBER rest[NUMBERS_REST] = {d->dz, d->slid, d->dx, d->Fx, d->W, d->W_rest, d->last_loss};
    out[PACKED_KIND] = sizeof(NUMBER);
    out[PACKED_IMPOSED] = d->imposed;
    out[PACKED_DIRECTION] = d->direction;
    out[PACKED_LOSSLESS] = d->lossless;
    double *next = pack_point(out + PACKED_NUMBERS, &d->edge);
    for (int i = 0; i < NUMBERS_REST; i++)
        next = pack_number(next, rest[i]);
    for (size_t i = 0; i < d->count; i++)
        next = pack_number(pack_point(next, &d->layers[i].inner), d->layers[i].sigma);
}

/* True for a possible history: a curve that rises outwards with |sigma| <= 1, forces and displacements within
 * their bounds, and positive energies. */
static bool is_history(const DIAGRAM *d) {
    bool ok = d->W >= 0 && size_of(d->W_rest) <= d->W && d->last_loss >= 0 &&
              d->W + d->last_loss <= DBL_MAX && size_of(d->Fx) <= 2 * d->mu * d->edge.y[LOAD] &&
              size_of(d->dx - d->slid) <= 2 * d->mu_eta * d->edge.y[DEPTH] + LITTLE * size_of(d->slid) &&
              (d->count ? d->dz == d->edge.y[DEPTH] && d->dz > 0 && d->edge.y[LOAD] > 0
                        : d->dz <= 0 && d->edge.y[DEPTH] == 0 && d->edge.y[LOAD] == 0);
    for (size_t i = 0; i < d->count && ok; i++) {
        const point *outer = i + 1 < d->count ? &d->layers[i + 1].inner : &d->edge,
                    *inner = &d->layers[i].inner;
        ok = size_of(d->layers[i].sigma) <= 1;
        for (coordinate by = DEPTH; by <= LOAD; by++)
            ok = ok && inner->y[by] >= 0 && inner->y[by] <= outer->y[by] &&
                 size_of(inner->t[by]) <= 2 * d->edge.y[by] && size_of(outer->t[by]) <= 2 * d->edge.y[by];
    }
    return ok;
}

fret_status PUBLIC(unpack)(DIAGRAM *d, const double from[], size_t count) {
    const size_t least = PACKED_NUMBERS + 2 * (NUMBERS_EDGE + NUMBERS_REST);
    const fret_status wrong = fret_fail(FRET_OUTSIDE, "history", (double)count, 0);
    if (count < least || (count - least) % (2 * NUMBERS_LAYER) || from[PACKED_KIND] != sizeof(NUMBER))
        return wrong;
    for (size_t i = 0; i < count; i++)
        if (!isfinite(from[i]))
            return wrong;
    DIAGRAM own = *d, *made = &own; /* keeps the series of the law, which take long to make */
    fret_status st = fret_ok();
    made->layers = malloc(((count - least) / (2 * NUMBERS_LAYER) + 1) * sizeof *made->layers);
    if (!made->layers)
        return fret_fail(FRET_NO_MEMORY, NULL, 0, 0);
    NUMBER rest[NUMBERS_REST];
    made->count = (count - least) / (2 * NUMBERS_LAYER);
    made->imposed = from[PACKED_IMPOSED] == (double)LOAD ? LOAD : DEPTH;
    made->direction = from[PACKED_DIRECTION] < 0 ? -1 : 1;
    made->lossless = from[PACKED_LOSSLESS] != 0;
    const double *next = unpack_point(from + PACKED_NUMBERS, &made->edge);
    for (int i = 0; i < NUMBERS_REST; i++)
        next = unpack_number(next, &rest[i]);
    for (size_t i = 0; i < made->count; i++)
        next = unpack_number(unpack_point(next, &made->layers[i].inner), &made->layers[i].sigma);
    made->dz = rest[0], made->slid = rest[1], made->dx = rest[2], made->Fx = rest[3];
    made->W = rest[4], made->W_rest = rest[5], made->last_loss = rest[6];
    const coordinate by = made->imposed;
    const NUMBER end = made->edge.y[by];
    if (!is_history(made))
        st = wrong;
    else if (made->count && (end < made->low[by] || end > made->high[by])) /* already in range otherwise */
        st = law_prepare(made, by, (double)end);
    if (!st.code)
        st = PUBLIC(copy)(d, made);
    free(made->layers);
    return st;
}
