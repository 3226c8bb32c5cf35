/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One straight step of the memory diagram: growth and retreat of the edge, and the energy that each
 * dissipates; slip at constant load is in memory_slip.c. Touches the slices and sums of its contact, and the
 * places of its law, alone. */
#include <float.h>
#include <stdlib.h>

#include "contact/check.h"
#include "contact/slices.h"

/* After so many moves of the edge there will be more: places of the law are kept. */
enum { MANY_MOVES = 8 };

static fret_near *near_of(const fret_memory *m) {
    return m->moves >= MANY_MOVES ? m->near : NULL;
}

static fret_real law_other(const fret_memory *m, coordinate by, const fret_real *y) {
    return by == DEPTH ? fret_law_force(m->normal, *y) : fret_law_depth(m->normal, *y);
}

/* The other coordinate of a place. */
FRET_INLINE fret_real other_of(const fret_memory *m, coordinate by, fret_real y) {
    const fret_real v = near_of(m) ? fret_near_value(m->near, by, y) : (fret_real)NAN;
    if (v > 0)
        return v;
    const fret_real at = y; /* its address is given away here alone */
    return law_other(m, by, &at);
}

/* Close to gross slip by force: the slice i, in which the front ends, where little is left. The steps of the
 * front are not asked. Returns the load. */
static fret_real keep_core(fret_memory *m, size_t i, fret_real s, double goal, const fret_real *edge) {
    slice *end = &m->slices[i];
    const dd bound = dd_mul_d(dd_from2(*edge, fret_memory_edge_rest(m, LOAD, *edge)), m->mu);
    const dd left = s < 0 ? dd_add_d(bound, goal) : dd_add_d(bound, -goal);
    end->thick[LOAD] = thick_at_brink(m, i, LOAD, s, dd_div(left, dd_of(m->mu)));
    return inner_of(m, i, LOAD) + end->thick[LOAD];
}

/* A place of edge or front; other: in the other coordinate, < 0 where it is not known. */
typedef struct place {
    fret_real at, other;
} place;

/* Not as a whole: that waits for its parts to be written. */
static inline void put(place *p, fret_real at, fret_real other) {
    p->at = at;
    p->other = other;
}

/* Gross slip while the edge moves. */
static fret_real gross_force(const fret_memory *m, coordinate by, fret_real from, fret_real to) {
    return fret_phase_force(&(fret_phase){.normal = m->normal, .by = by, .edge0 = from, .edge1 = to});
}

/* After a phase only the coordinate of the step is up to date in the two outermost slices. inner: the other
 * one of the outermost, < 0 where it is not known. */
FRET_INLINE void convert_top(fret_memory *m, coordinate by, fret_real inner) {
    const coordinate other = by == DEPTH ? LOAD : DEPTH;
    const size_t count = m->count;
    slice *top = &m->slices[count - 1], *next = top - 1;
    fret_real below[2] = {0, 0};
    if (count == 1) {
        inner = 0;
    } else {
        if (!(inner >= 0))
            inner = other_of(m, by, top->inner[by]);
        if (count == 2)
            next->inner[other] = 0;
        const fret_real thick = fret_greater(inner - next->inner[other], 0), sigma = next->sigma;
        next->thick[other] = thick;
        below[other] = sigma * thick;
        below[by] = sigma * next->thick[by];
        if (count > 2) {
            below[DEPTH] += next[-1].sum[DEPTH];
            below[LOAD] += next[-1].sum[LOAD];
        }
        next->sum[DEPTH] = below[DEPTH];
        next->sum[LOAD] = below[LOAD];
    }
    const fret_real thick = fret_greater(m->edge[other] - inner, 0), sigma = top->sigma;
    top->inner[other] = inner;
    top->thick[other] = thick;
    top->sum[other] = below[other] + sigma * thick;
    top->sum[by] = below[by] + sigma * top->thick[by];
}

/* The end of a step: the zone of sign s, whose front is at `front`, goes on inwards by `part` of the slice
 * below it, while the edge comes to its end from where it is. What it dissipates is asked last: a call leaves
 * no number in a register. */
FRET_INLINE fret_real finish(fret_memory *m, coordinate by, fret_real s, fret_real gain, fret_real part,
                             const place *z, const place *front, const fret_real edge[2], double goal) {
    const coordinate other = by == DEPTH ? LOAD : DEPTH;
    slice *zone = &m->slices[m->count - 1], *next = zone - 1;
    fret_real inner = front->at - part;
    if (by == LOAD && 8 * inner <= edge[LOAD])
        inner = keep_core(m, m->count - 2, s, goal, &edge[LOAD]);
    else
        next->thick[by] -= part;
    const fret_real v = other_of(m, by, inner);
    fret_phase p; /* not as a whole: that would write it all, and again */
    p.normal = m->normal;
    p.by = by;
    p.near = near_of(m);
    p.edge0 = z->at;
    p.edge_v[0] = z->other;
    p.front0 = front->at;
    p.front_v[0] = front->other;
    p.edge1 = edge[by];
    p.edge_v[1] = edge[other];
    p.front1 = inner;
    p.front_v[1] = v;
    zone->inner[by] = inner;
    zone->thick[by] = edge[by] - inner;
    m->edge[DEPTH] = edge[DEPTH];
    m->edge[LOAD] = edge[LOAD];
    convert_top(m, by, v);
    return gain * fret_phase_loss(&p);
}

/* Growth with a slip front of sign s: edge and front, and what of the drive is left. */
typedef struct widening {
    coordinate by;
    fret_real s, from, way, surplus, left;
    place z, front;
} widening;

FRET_INLINE bool takes_whole(const widening *g, fret_real cap, fret_real end) {
    return cap - g->left <= 1e-17 * end && cap - g->left <= 1e-6 * cap;
}

/* The front takes in whole slices, until the drive ends within one. */
static fret_real take_whole(fret_memory *m, widening *g, const fret_real edge[2]) {
    const coordinate by = g->by, other = by == DEPTH ? LOAD : DEPTH;
    fret_real loss = 0;
    while (m->count && g->left > 0) {
        const slice *top = &m->slices[m->count - 1];
        const fret_real gain = 1 - g->s * top->sigma, cap = gain * top->thick[by];
        if (!takes_whole(g, cap, edge[by]))
            break;
        fret_phase p = {.normal = m->normal,
                        .by = by,
                        .edge0 = g->z.at,
                        .front0 = g->front.at,
                        .near = near_of(m),
                        .edge_v = {g->z.other},
                        .front_v = {g->front.other}};
        g->left = cap < g->left ? g->left - cap : 0;
        put(&g->front, m->count > 1 ? top->inner[by] : 0, m->count > 1 ? top->inner[other] : 0);
        m->count--;
        if (g->left > 0)
            put(&g->z, g->from + g->way * (g->surplus - g->left) / g->surplus, -1);
        else
            put(&g->z, edge[by], edge[other]);
        p.edge1 = g->z.at;
        p.edge_v[1] = g->z.other;
        p.front1 = g->front.at;
        p.front_v[1] = g->front.other;
        if (gain > 0)
            loss += gain * fret_phase_loss(&p);
    }
    return loss;
}

/* The front has come to the end of a slice, or to the centre. */
static fret_real grow_whole(fret_memory *m, const widening *g, const fret_real edge[2]) {
    const coordinate by = g->by;
    fret_real loss = 0, thick[2] = {0, 0}, inner[2] = {0, 0};
    if (g->left > 0 && by == DEPTH) {
        loss = g->left * gross_force(m, by, g->z.at, edge[by]);
        m->slid += g->s * m->mu_eta * g->left;
    }
    inner[by] = m->count ? g->front.at : 0;
    thick[by] = edge[by] - inner[by];
    m->edge[DEPTH] = edge[DEPTH];
    m->edge[LOAD] = edge[LOAD];
    const size_t count = m->count;
    push(m, thick, inner, g->s, 0);
    convert_top(m, by, m->count > count ? g->front.other : -1);
    return loss;
}

/* The edge grows, and the drive is larger. */
FRET_INLINE fret_real grow_and_slip(fret_memory *m, coordinate by, const fret_real edge[2], fret_real drive,
                                    double goal) {
    const coordinate other = by == DEPTH ? LOAD : DEPTH;
    const fret_real s = drive < 0 ? -1 : 1;
    widening g;
    fret_real loss = 0, gain = 0, cap = 0;
    g.by = by;
    g.s = s;
    g.from = m->edge[by];
    g.way = edge[by] - g.from;
    g.surplus = g.left = fabsl(drive) - g.way;
    put(&g.z, g.from, m->edge[other]);
    put(&g.front, g.from, m->edge[other]);
    if (m->count > 1 && s * m->slices[m->count - 1].sigma == 1) { /* it goes on: that takes no drive */
        m->count--;
        put(&g.front, m->slices[m->count].inner[by], m->slices[m->count].inner[other]);
    }
    if (m->count) {
        const slice *top = &m->slices[m->count - 1];
        gain = 1 - s * top->sigma;
        cap = gain * top->thick[by];
    }
    if (takes_whole(&g, cap, edge[by])) {
        widening slow = g;
        loss = take_whole(m, &slow, edge);
        if (!m->count || slow.left <= 0)
            return loss + grow_whole(m, &slow, edge);
        g = slow;
        gain = 1 - s * m->slices[m->count - 1].sigma;
    }
    slice *zone = &m->slices[m->count++];
    zone->sigma = s;
    zone->edge = 0;
    const fret_real last = finish(m, by, s, gain, g.left / gain, &g.z, &g.front, edge, goal);
    return loss + last;
}

/* Unloading: the edge moves inwards while the drive acts, both linearly. At the edge, a slope sigma means a
 * surplus rate + sigma per unit: it starts a slip zone of that sign s, whose front moves at
 * (s rate + 1)/(1 - s sigma); a front slower than the edge is overtaken, and the next slope decides anew. */
typedef struct retreat {
    coordinate by;
    fret_real rate; /* drive per unit of retreat */
    fret_real left; /* what the edge has to go */
    place z, to;    /* the edge now, and where to */
} retreat;

static void retreat_by(retreat *r, fret_real t) {
    r->left -= t;
    if (r->left > 0)
        put(&r->z, r->z.at - t, -1);
    else
        put(&r->z, r->to.at, r->to.other);
}

/* Nothing slips: the slice at the edge gets thinner. */
static void retreat_in_stick(fret_memory *m, retreat *r) {
    slice *top = &m->slices[m->count - 1];
    const fret_real t = fret_lesser(r->left, top->thick[r->by]);
    const bool gone = t >= top->thick[r->by];
    top->thick[r->by] -= t;
    retreat_by(r, t);
    if (gone)
        m->count--;
}

/* A new slip zone at the edge, of no thickness yet. */
static void begin_zone(fret_memory *m, const retreat *r, fret_real s) {
    slice *zone = &m->slices[m->count++];
    zone->inner[r->by] = r->z.at;
    zone->inner[r->by == DEPTH ? LOAD : DEPTH] = r->z.other;
    zone->thick[DEPTH] = zone->thick[LOAD] = 0;
    zone->sigma = s;
    zone->edge = 0;
}

/* The zone is the whole contact, up to the end of the step. */
static fret_real retreat_in_slip(fret_memory *m, retreat *r, fret_real s) {
    fret_real loss = 0;
    if (r->by == DEPTH) {
        const fret_real e = (s * r->rate + 1) * r->left;
        loss = e * gross_force(m, r->by, r->z.at, r->to.at);
        m->slid += s * m->mu_eta * e;
    }
    m->slices[0].thick[r->by] -= r->left;
    retreat_by(r, r->left);
    return loss;
}

/* The zone has taken in the slice below it, and joins the next one if that is of its own sign. */
static void take_in(fret_memory *m, const retreat *r, fret_real s) {
    slice *next = &m->slices[m->count - 2];
    if (m->count == 2)
        next->inner[DEPTH] = next->inner[LOAD] = 0;
    next->thick[r->by] = r->z.at - next->inner[r->by];
    next->sigma = s;
    next->edge = 0;
    m->count--;
    if (m->count > 1 && next[-1].sigma == s) {
        next[-1].thick[r->by] += next->thick[r->by];
        m->count--;
    }
}

/* The outermost slice is a zone that goes on inwards: its sign, the gain of the slice below, how fast the
 * front is beside the edge. */
typedef struct pursuit {
    fret_real s, gain, speed;
    bool ends; /* with the step: the front comes to no slice, the edge not to the front */
} pursuit;

FRET_INLINE pursuit pursue(const fret_memory *m, coordinate by, fret_real rate, fret_real left) {
    const slice *top = &m->slices[m->count - 1], *next = top - 1;
    pursuit f;
    f.s = top->sigma;
    f.gain = 1 - f.s * next->sigma;
    f.speed = (f.s * rate + 1) / f.gain;
    f.ends = next->thick[by] > f.speed * left && (f.speed >= 1 || top->thick[by] > (1 - f.speed) * left);
    return f;
}

/* Is the outermost slice a zone that the step keeps in motion? */
FRET_INLINE bool goes_on(const fret_memory *m, fret_real rate) {
    if (m->count < 2)
        return false;
    const fret_real sigma = m->slices[m->count - 1].sigma;
    return fabsl(sigma) == 1 && sigma * rate + 1 > 4 * LDBL_EPSILON;
}

/* Until the front has taken in the slice below, or the edge has overtaken it. */
static fret_real retreat_with_zone(fret_memory *m, retreat *r, const pursuit *f) {
    const coordinate by = r->by, other = by == DEPTH ? LOAD : DEPTH;
    slice *top = &m->slices[m->count - 1], *next = top - 1;
    fret_real t = r->left;
    bool overtaken = false;
    if (next->thick[by] <= f->speed * t)
        t = next->thick[by] / f->speed;
    if (f->speed < 1 && top->thick[by] <= (1 - f->speed) * t) {
        t = top->thick[by] / (1 - f->speed);
        overtaken = true;
    }
    const fret_real at = top->inner[by], step = overtaken ? f->speed * t : next->thick[by];
    fret_phase p = {.normal = m->normal,
                    .by = by,
                    .edge0 = r->z.at,
                    .front0 = at,
                    .front1 = at - step,
                    .near = near_of(m),
                    .edge_v = {r->z.other},
                    .front_v = {top->inner[other], overtaken       ? -1
                                                   : m->count <= 2 ? 0
                                                                   : next->inner[other]}};
    retreat_by(r, t);
    p.edge1 = r->z.at;
    p.edge_v[1] = r->z.other;
    const fret_real loss = f->gain * fret_phase_loss(&p);
    if (overtaken) {
        next->thick[by] -= step;
        m->count--;
    } else {
        take_in(m, r, f->s);
    }
    return loss;
}

/* Up to the last part, which a zone ends, or to the end. */
static fret_real retreat_to_last(fret_memory *m, retreat *r) {
    fret_real loss = 0;
    while (r->left > 0 && m->count) {
        const slice *top = &m->slices[m->count - 1];
        const fret_real surplus = r->rate + top->sigma, s = surplus < 0 ? -1 : 1;
        if (fabsl(surplus) <= 4 * LDBL_EPSILON * fabsl(top->sigma) ||
            (top->thick[r->by] <= 0 && m->count > 1 && fabsl(top->sigma) < 1)) {
            retreat_in_stick(m, r);
            continue;
        }
        if (s * top->sigma < 1)
            begin_zone(m, r, s);
        if (m->count == 1) {
            loss += retreat_in_slip(m, r, s);
            continue;
        }
        const pursuit f = pursue(m, r->by, r->rate, r->left);
        if (f.ends)
            break;
        loss += retreat_with_zone(m, r, &f);
    }
    return loss;
}

FRET_INLINE fret_real shrink(fret_memory *m, coordinate by, const fret_real edge[2], fret_real drive,
                             double goal) {
    const coordinate other = by == DEPTH ? LOAD : DEPTH;
    retreat r;
    pursuit f;
    fret_real loss = 0;
    r.by = by;
    r.left = m->edge[by] - edge[by];
    r.rate = drive / r.left;
    put(&r.z, m->edge[by], m->edge[other]);
    put(&r.to, edge[by], edge[other]);
    f.ends = goes_on(m, r.rate);
    if (f.ends)
        f = pursue(m, by, r.rate, r.left);
    if (!f.ends) {
        retreat slow = r;
        loss = retreat_to_last(m, &slow);
        if (!(slow.left > 0 && m->count)) {
            m->edge[DEPTH] = edge[DEPTH];
            m->edge[LOAD] = edge[LOAD];
            if (m->count)
                convert_top(m, by, -1);
            return loss;
        }
        r = slow;
        f = pursue(m, by, r.rate, r.left);
    }
    const slice *top = &m->slices[m->count - 1];
    place front;
    put(&front, top->inner[by], top->inner[other]);
    const fret_real last = finish(m, by, f.s, f.gain, f.speed * r.left, &r.z, &front, edge, goal);
    return loss + last;
}

/* A straight piece with the contact closed at both ends; drive = change of delta_x/(mu eta) or F_x/mu. */
FRET_INLINE fret_real advance(fret_memory *m, coordinate by, const fret_real edge[2], fret_real drive,
                              double goal) {
    fret_real growth = edge[by] - m->edge[by];
    if (growth == 0)
        return drive == 0 ? 0 : fret_memory_slip(m, by, drive, goal);
    m->edge_id++;
    if (growth < 0)
        return shrink(m, by, edge, drive, goal);
    if (fabsl(drive) > growth)
        return grow_and_slip(m, by, edge, drive, goal);
    fret_real thick[2] = {edge[DEPTH] - m->edge[DEPTH], edge[LOAD] - m->edge[LOAD]};
    fret_real inner[2] = {m->edge[DEPTH], m->edge[LOAD]};
    /* targets are rounded to double: so much is uncertain in the slope of a short step */
    push(m, thick, inner, drive / growth, 2 * DBL_EPSILON * edge[by] / growth);
    m->edge[DEPTH] = edge[DEPTH];
    m->edge[LOAD] = edge[LOAD];
    return 0;
}

/* Thicknesses and places are kept apart, and the rounding of a load is felt by what is a 1e19th of it. After
 * a step from far away, order is more than digits that are lost: places rise from the centre to the edge, and
 * what is not as thick as they say, to their rounding, is so again. True: slice i was in order. */
static bool keep_order_of(fret_memory *m, size_t i, coordinate by) {
    slice *sl = &m->slices[i];
    const fret_real outer = i + 1 < m->count ? sl[1].inner[by] : m->edge[by],
                    floor = i ? inner_of(m, i - 1, by) : 0, least = inner_of(m, i, by),
                    inner = fret_lesser(fret_greater(least, floor), outer), thick = outer - inner,
                    have = sl->thick[by];
    if (inner == least && have >= 0 && fabsl(have - thick) <= 8 * LDBL_EPSILON * outer)
        return true;
    sl->inner[by] = inner;
    sl->thick[by] = thick;
    return false;
}

/* A step leaves two slices that are not as before. */
static void keep_order(fret_memory *m) {
    size_t i = m->count, lowest = m->count;
    for (bool kept = true; i > 0 && (!kept || i + 2 > m->count);) {
        i--;
        kept = (int)keep_order_of(m, i, DEPTH) & (int)keep_order_of(m, i, LOAD);
        lowest = kept ? lowest : i;
    }
    for (; lowest < m->count; lowest++)
        resum(&m->slices[lowest], lowest == 0);
}

static void open_contact(fret_memory *m, fret_real dx) {
    m->edge[DEPTH] = m->edge[LOAD] = 0;
    m->edge_id++;
    m->count = 0;
    m->slid = dx;
}

/* The normal state at the end of a step. */
typedef enum moved {
    STAYS,
    PRESSED,
    PRESSED_NEAR /* by places of the law that are kept */
} moved;
typedef struct normal_end {
    moved how;
    fret_real edge[2];
    double gap;   /* between the bodies where they part */
    fret_press p; /* PRESSED: with radius and what does not fit */
} normal_end;

FRET_INLINE void stay(const fret_memory *m, normal_end *to) {
    to->how = STAYS;
    to->edge[DEPTH] = m->edge[DEPTH];
    to->edge[LOAD] = m->edge[LOAD];
}

FRET_INLINE fret_status find_normal_end(const fret_memory *m, const fret_step *step, normal_end *to) {
    const bool by_force = step->normal_by == FRET_TO_FORCE;
    fret_status st = fret_ok();
    if (step->normal_by == FRET_KEEP_NORMAL) {
        to->gap = m->gap;
        stay(m, to);
        return st;
    }
    if (!by_force && !isfinite(step->normal))
        return fret_fail(FRET_NOT_FINITE, "dz", step->normal, 0);
    to->gap = !by_force && step->normal < 0 ? -step->normal : 0;
    if (step->normal == m->edge[by_force ? LOAD : DEPTH]) {
        stay(m, to);
        return st;
    }
    const bool near = near_of(m) && step->normal > 0;
    const fret_real v = near ? fret_near_value(m->near, by_force ? LOAD : DEPTH, step->normal) : 0;
    if (v > 0) {
        to->how = PRESSED_NEAR;
        to->edge[DEPTH] = by_force ? v : step->normal;
        to->edge[LOAD] = by_force ? step->normal : v;
        return st;
    }
    st = by_force ? fret_press_by_force(m->normal, step->normal, &to->p)
                  : fret_press_by_depth(m->normal, fmax(step->normal, 0), &to->p);
    to->how = PRESSED;
    to->edge[DEPTH] = to->p.dz;
    to->edge[LOAD] = to->p.F;
    return st;
}

/* What the edge leaves out, and how it can be told. */
FRET_INLINE void keep_normal_end(fret_memory *m, const fret_step *step, const normal_end *to) {
    if (step->normal_by == FRET_KEEP_NORMAL)
        return;
    if (to->how != STAYS) {
        const bool placed = to->how == PRESSED;
        m->pressed_near = to->how == PRESSED_NEAR;
        m->edge_rest[DEPTH] = placed ? to->p.dz_rest : 0;
        m->edge_rest[LOAD] = placed ? to->p.F_rest : 0;
        if (placed)
            m->radius = to->p.a;
    }
    if (m->pressed_near) {
        m->told_by = step->normal_by;
        m->told = step->normal;
    }
    if (m->moves < MANY_MOVES)
        m->moves++;
}

FRET_INLINE fret_status step_load(double mu, const fret_step *step, fret_real FN, fret_real *load) {
    const bool by_force = step->tangential_by == FRET_TO_FX;
    *load = 0;
    if (step->tangential_by != FRET_KEEP_DX && !isfinite(step->tangential))
        return fret_fail(FRET_NOT_FINITE, by_force ? "Fx" : "dx", step->tangential, 0);
    if (by_force)
        *load = step->tangential / (fret_real)mu;
    if (fabsl(*load) > FN * (1 - (fret_real)DBL_EPSILON)) {
        if (fabsl(*load) > FN * (1 + (fret_real)DBL_EPSILON))
            return fret_fail(FRET_GROSS_SLIP, "Fx", step->tangential, (double)(mu * FN));
        *load = copysignl(FN, *load); /* mu F_N up to its rounding */
    }
    return fret_ok();
}

fret_status fret_step_load(double mu, const fret_step *step, fret_real FN, fret_real *load) {
    return step_load(mu, step, FN, load);
}

/* To where it is already: the rounding of sums must not pass for a reversal. */
static bool stays(const fret_memory *m, const fret_step *step) {
    return m->held == step->tangential_by && m->goal == step->tangential;
}

/* To F_x = mu load, straight in (F_N, F_x). */
static fret_real step_by_force(fret_memory *m, const fret_step *step, const fret_real edge[2],
                               fret_real load) {
    const bool same = stays(m, step);
    const fret_real drive = same && edge[LOAD] == m->edge[LOAD] ? 0 : load - fret_memory_total(m, LOAD);
    if (drive != 0 && !same)
        m->direction = drive < 0 ? -1 : 1;
    const fret_real loss = advance(m, LOAD, edge, drive, step->tangential);
    if (edge[LOAD] <= 0)
        open_contact(m, m->slid); /* no spring is left to be displaced */
    return loss;
}

/* To delta_x, straight in (delta_z, delta_x). While open, the bodies move freely: only the closed part of the
 * path counts. */
static fret_real step_by_displacement(fret_memory *m, const fret_step *step, const fret_real edge[2],
                                      double gap) {
    const fret_real old_dx = fret_memory_dx(m);
    const fret_real target =
        step->tangential_by == FRET_TO_DX && !stays(m, step) ? (fret_real)step->tangential : old_dx;
    const fret_real from = m->gap > 0 ? -m->gap : m->edge[DEPTH], to = gap > 0 ? -gap : edge[DEPTH];
    fret_real start = old_dx, stop = target, loss = 0;
    if (target != old_dx)
        m->direction = target < old_dx ? -1 : 1;
    if (from <= 0 && to > 0) {
        start = old_dx + (target - old_dx) * (-from / (to - from));
        open_contact(m, start);
    } else if (from > 0 && to <= 0) {
        stop = old_dx + (target - old_dx) * (from / (from - to));
    }
    if (from > 0 || to > 0) {
        loss = advance(m, DEPTH, edge, (stop - start) / m->mu_eta, step->tangential);
        if (to > 0 && step->tangential_by == FRET_TO_DX && m->count == 1 && fabsl(m->slices[0].sigma) == 1)
            m->slid = target - m->mu_eta * fret_memory_total(m, DEPTH);
    }
    if (to <= 0)
        open_contact(m, target);
    return loss;
}

/* Of a law of which many values are asked. */
static fret_status keep_places(fret_memory *m, const fret_step *step) {
    if (m->moves < MANY_MOVES || m->near || step->normal_by == FRET_KEEP_NORMAL || !fret_near_fits(m->normal))
        return fret_ok();
    m->near = malloc(sizeof *m->near);
    if (!m->near)
        return fret_fail(FRET_NO_MEMORY, NULL, 0, 0);
    fret_near_make(m->normal, m->near);
    return fret_ok();
}

fret_status fret_memory_step(fret_memory *m, const fret_step *step) {
    normal_end to;
    fret_real load;
    fret_status st = keep_places(m, step);
    if (!st.code)
        st = find_normal_end(m, step, &to);
    if (!st.code)
        st = step_load(m->mu, step, to.edge[LOAD], &load);
    if (!st.code)
        st = fret_memory_reserve(m, m->count + 4);
    if (st.code)
        return st;
    keep_normal_end(m, step, &to);
    const fret_real loss = step->tangential_by == FRET_TO_FX ? step_by_force(m, step, to.edge, load)
                                                             : step_by_displacement(m, step, to.edge, to.gap);
    keep_order(m);
    if (step->tangential_by != FRET_KEEP_DX) {
        m->held = step->tangential_by;
        m->goal = step->tangential;
    } else if (m->held == FRET_TO_FX && step->normal_by != FRET_KEEP_NORMAL) {
        m->held = FRET_KEEP_DX;
    }
    m->gap = to.gap;
    const fret_real lost = loss > 0 ? loss * m->loss_scale : 0;
    m->last_loss = lost;
    fret_sum_add(&m->W, lost);
    return fret_unless_stopped(m->normal, fret_ok());
}
