/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "fret/memory.h"

#include <float.h>
#include <stdlib.h>
#include <string.h>

#include "dd.h"
#include "special.h"

/* Positions and thicknesses are kept in two measures. A straight step in (delta_z, delta_x) moves
 * edge and slip front linearly in depth; a straight step in (F_N, F_x) moves them linearly in load,
 * by the same rule: delta_x/(mu eta) = int sigma dy + const and F_x/mu = int sigma dF_N. */
typedef enum measure { DEPTH, LOAD } measure;

typedef struct slice {
    fret_real thick[2]; /* kept apart from the positions: a thin slice at the edge keeps its digits */
    fret_real inner[2]; /* depth and load of the inner end */
    fret_real sigma;    /* -u'/(mu eta) */
    fret_real sum[2];   /* int sigma dy and int sigma dF_N from the centre to the outer end */
    fret_real L;        /* int_0^d G dt at the inner end, as long as the edge is */
    unsigned long edge; /* this one */
} slice;

struct fret_memory {
    fret_normal normal;
    double mu;
    fret_real mu_eta, loss_scale; /* mu eta; mu^2 eta */
    fret_real edge[2];            /* delta_z and F_N; 0, 0 when open */
    double edge_rest[2];          /* what does not fit in them */
    fret_real radius;             /* of the edge */
    fret_real gap;                /* distance of the open bodies, >= 0 */
    unsigned long edge_id;        /* changes with the edge */
    fret_real slid;               /* delta_x - mu eta int sigma dy: what gross slip has carried along */
    int direction;                /* of the last tangential motion */
    fret_tangential_target held;  /* where it ended: goal is F_x or delta_x exactly; FRET_KEEP_DX: neither */
    double goal;
    fret_sum W;
    fret_real last_loss;
    size_t count, room;
    slice *slices; /* innermost first */
};

fret_status fret_memory_make(const fret_normal *normal, double mu, fret_memory **out) {
    fret_status st = fret_check_positive("mu", mu);
    if (st.code)
        return st;
    fret_memory *m = calloc(1, sizeof *m);
    slice *slices = calloc(8, sizeof *slices);
    if (!m || !slices) {
        free(m);
        free(slices);
        return fret_fail(FRET_NO_MEMORY, NULL, 0, 0);
    }
    m->normal = *normal;
    m->mu = mu;
    m->mu_eta = mu * normal->foundation.eta;
    m->loss_scale = mu * m->mu_eta;
    m->slices = slices;
    m->room = 8;
    fret_memory_reset(m);
    *out = m;
    return fret_ok();
}

void fret_memory_free(fret_memory *m) {
    if (m)
        free(m->slices);
    free(m);
}

void fret_memory_reset(fret_memory *m) {
    m->edge[DEPTH] = m->edge[LOAD] = m->gap = m->slid = m->last_loss = 0;
    m->W = (fret_sum){0, 0};
    m->count = 0;
    m->direction = 1;
    m->held = FRET_KEEP_DX;
    m->edge_id = 1; /* 0: never computed */
}

static fret_status reserve(fret_memory *m, size_t count) {
    if (count <= m->room)
        return fret_ok();
    size_t room = count + count / 2;
    slice *grown = realloc(m->slices, room * sizeof *grown);
    if (!grown)
        return fret_fail(FRET_NO_MEMORY, NULL, 0, 0);
    m->slices = grown;
    m->room = room;
    return fret_ok();
}

fret_status fret_memory_copy(fret_memory *to, const fret_memory *from) {
    if (to == from)
        return fret_ok();
    fret_status st = reserve(to, from->count);
    if (st.code)
        return st;
    slice *slices = to->slices;
    size_t room = to->room;
    *to = *from;
    to->slices = slices;
    to->room = room;
    memcpy(slices, from->slices, from->count * sizeof *slices);
    return fret_ok();
}

static fret_real total(const fret_memory *m, measure by) {
    return m->count ? m->slices[m->count - 1].sum[by] : 0;
}

static fret_real displacement(const fret_memory *m) {
    return m->slid + m->mu_eta * total(m, DEPTH);
}

static void resum_top(fret_memory *m) {
    slice *top = &m->slices[m->count - 1];
    for (measure by = DEPTH; by <= LOAD; by++)
        top->sum[by] = (m->count > 1 ? top[-1].sum[by] : 0) + top->sigma * top->thick[by];
}

/* Slopes that differ by less than `rounding` merge, else a ramp in many small steps would pile up slices;
 * the mean keeps F_x. */
static void push(fret_memory *m, const fret_real thick[2], const fret_real inner[2], fret_real sigma,
                 fret_real rounding) {
    slice *top = m->count ? &m->slices[m->count - 1] : NULL;
    if (top && fabsl(top->sigma - sigma) <= rounding && (fabsl(sigma) < 1) == (fabsl(top->sigma) < 1)) {
        fret_real both = top->thick[LOAD] + thick[LOAD];
        if (both > 0 && fabsl(sigma) < 1)
            top->sigma = (top->sigma * top->thick[LOAD] + sigma * thick[LOAD]) / both;
        top->thick[DEPTH] += thick[DEPTH];
        top->thick[LOAD] = both;
    } else {
        m->slices[m->count++] = (slice){
            .thick = {thick[DEPTH], thick[LOAD]}, .inner = {inner[DEPTH], inner[LOAD]}, .sigma = sigma};
    }
    resum_top(m);
}

/* int over distances 0..d from the edge of [F(y)-F(y-t)-tK(y-t)] dt: what a front that has reached d has
 * dissipated, per mu^2 eta and gain. */
static fret_slice edge_slice(const fret_memory *m, fret_real d) {
    const fret_level edge = {m->edge[DEPTH], m->edge[LOAD]};
    return fret_law_slice(&m->normal, &edge, d);
}

typedef struct rise {
    const fret_memory *m;
    fret_real d, h;
} rise;

static fret_real rise_rate(fret_real t, fret_real rest, void *context) {
    const rise *r = context;
    (void)rest;
    return edge_slice(r->m, r->d + r->h * t).G;
}

/* L2-L1, also where the two levels are too close for a difference: by quadrature of G, which is singular at
 * the centre and the smoother the farther that is. */
static fret_real level_rise(const fret_memory *m, fret_real d1, fret_real L1, fret_real d2, fret_real L2) {
    const fret_real h = d2 - d1, inside = m->edge[DEPTH] - d2;
    if (h > 1e-5L * d2)
        return L2 - L1;
    rise r = {m, d1, h};
    if (inside < h)
        return h * fret_integrate(rise_rate, &r);
    if (inside < 1e4L * h)
        return h * fret_integrate_smooth(rise_rate, &r);
    const fret_real mid = (d1 + d2) / 2, offset = h / 2 * 0.5773502691896257645091487805019574556L;
    return h / 2 * (edge_slice(m, mid - offset).G + edge_slice(m, mid + offset).G);
}

static fret_real inner_level(const fret_memory *m, slice *sl, fret_real d) {
    if (sl->edge != m->edge_id) {
        sl->L = edge_slice(m, d).L;
        sl->edge = m->edge_id;
    }
    return sl->L;
}

/* Close to gross slip of sense s the part that sticks is far smaller than the contact. Its one measure is the
 * distance of F_x from mu F_N, or of delta_x from delta_x,max, taken with all digits; the other follows. */
static void keep_inner(fret_memory *m, measure by, fret_real s, double goal, fret_real eaten[2]) {
    const fret_level edge = {m->edge[DEPTH], m->edge[LOAD]};
    slice *only = &m->slices[0];
    const dd scale = by == LOAD ? dd_of(m->mu) : dd_mul_d(m->normal.foundation.wide.eta, m->mu);
    const dd bound = dd_mul(scale, dd_from2(m->edge[by], m->edge_rest[by]));
    const dd at = by == LOAD ? dd_of(goal) : dd_sub(dd_of(goal), dd_from(m->slid));
    const dd left = dd_div(s < 0 ? dd_add(bound, at) : dd_sub(bound, at), scale);
    const fret_real inner = fmaxl(dd_value(left) / (1 - s * only->sigma), 0);
    only->thick[by] = inner;
    eaten[by] = m->edge[by] - inner;
    if (by == DEPTH) {
        only->thick[LOAD] = fret_law_force(&m->normal, inner);
        eaten[LOAD] = fret_law_load_outside(&m->normal, &edge, inner);
    } else {
        only->thick[DEPTH] = fret_law_depth(&m->normal, inner);
        eaten[DEPTH] = fret_law_thickness_outside(&m->normal, &edge, inner);
    }
}

/* Tangential step at constant normal load, to F_x or delta_x = goal: the slip zone of sign s eats inwards
 * until its drive is used up. Drive left at the centre is gross slip. */
static fret_real slide(fret_memory *m, measure by, fret_real drive, double goal) {
    const fret_real snap = 1e-17L * m->edge[by]; /* a turning point is reached up to rounding */
    fret_real s = drive < 0 ? -1 : 1, e = fabsl(drive), loss = 0, level = 0;
    fret_real eaten[2] = {0, 0}, front[2] = {m->edge[DEPTH], m->edge[LOAD]};
    while (m->count && e > 0) {
        slice *top = &m->slices[m->count - 1];
        fret_real gain = 1 - s * top->sigma, cap = gain * top->thick[by], d = eaten[DEPTH], next;
        if (cap - e <= snap && cap - e <= 1e-6L * cap) {
            e = cap < e ? e - cap : 0;
            for (measure i = DEPTH; i <= LOAD; i++) {
                eaten[i] += top->thick[i];
                front[i] = top->inner[i];
            }
            next = inner_level(m, top, eaten[DEPTH]);
            m->count--;
        } else if (m->count == 1 && 8 * (cap - e) < gain * m->edge[by]) {
            keep_inner(m, by, s, goal, eaten);
            next = edge_slice(m, eaten[DEPTH]).L;
            for (measure i = DEPTH; i <= LOAD; i++)
                front[i] = top->thick[i];
            resum_top(m);
            e = 0;
        } else {
            const fret_level outer = {front[DEPTH], front[LOAD]};
            fret_real part[2] = {e / gain, e / gain};
            fret_slice whole = {0, 0, 0, 0};
            if (by == LOAD)
                part[DEPTH] = fret_law_thickness(&m->normal, &outer, part[LOAD]);
            whole = edge_slice(m, d + part[DEPTH]);
            if (by == DEPTH) /* a difference of loads from the edge does unless the part is thin */
                part[LOAD] = part[DEPTH] > 1e-4L * d ? whole.w - eaten[LOAD]
                                                     : fret_law_load(&m->normal, &outer, part[DEPTH]);
            next = whole.L;
            for (measure i = DEPTH; i <= LOAD; i++) {
                eaten[i] += part[i];
                front[i] -= part[i];
                top->thick[i] -= part[i];
            }
            resum_top(m);
            e = 0;
        }
        if (gain > 0)
            loss += gain * (d > 0 ? level_rise(m, d, level, eaten[DEPTH], next) : next);
        level = next;
    }
    if (!m->count) {
        front[DEPTH] = front[LOAD] = 0;
        if (by == DEPTH) {
            loss += e * m->edge[LOAD];
            m->slid += s * m->mu_eta * e;
        }
    }
    if (eaten[LOAD] > 0) {
        push(m, eaten, front, s, 0);
        slice *top = &m->slices[m->count - 1];
        if (top->inner[by] == front[by]) { /* not merged into the slice below */
            top->L = level;
            top->edge = m->edge_id;
        }
    }
    return loss;
}

/* One phase of slip during which edge and front both move, linearly in the measure. */
typedef struct phase {
    const fret_memory *m;
    measure by;
    fret_real edge0, edge1, front0, front1;
} phase;

static fret_real phase_rate(fret_real t, fret_real rest, void *context) {
    const phase *p = context;
    const fret_normal *n = &p->m->normal;
    fret_real z = p->edge0 * rest + p->edge1 * t, y = p->front0 * rest + p->front1 * t;
    fret_real d = (p->edge0 - p->front0) * rest + (p->edge1 - p->front1) * t;
    if (d <= 0 || z <= 0)
        return 0;
    fret_point edge = p->by == DEPTH ? fret_law_at_depth(n, z) : fret_law_at_force(n, z),
               front = {0, 0, 0, 0};
    const fret_level outer = {edge.y, edge.F};
    if (p->by == LOAD || !(n->p > 0))
        front = p->by == DEPTH ? fret_law_at_depth(n, y) : fret_law_at_force(n, y);
    if (p->by == LOAD) /* of a thin zone the depths would differ by too few digits */
        d = d < 1e-3L * z ? fret_law_thickness(n, &outer, d) : edge.y - front.y;
    fret_real G =
        n->p > 0 || d < 1e-3L * edge.y ? fret_law_slice(n, &outer, d).G : edge.F - front.F - d * front.K;
    if (p->by == DEPTH)
        return G;
    return front.K > 0 ? G / front.K : 0; /* dy = dF/K; the end point itself has no weight */
}

/* A part of 0..1. */
typedef struct part {
    fret_integrand *f;
    void *context;
    fret_real lo, hi;
} part;

static fret_real part_rate(fret_real t, fret_real rest, void *context) {
    const part *p = context;
    return p->f(p->lo * rest + p->hi * t, (1 - p->lo) * rest + (1 - p->hi) * t, p->context);
}

/* int_lo^hi f by halves until they add up to the whole: edge or front may cross rows of a table, where the
 * rate is not smooth. tolerance: of the integral. */
static fret_real bisect(fret_integrand *f, void *context, fret_real lo, fret_real hi, fret_real whole,
                        fret_real tolerance, int depth) {
    const fret_real mid = (lo + hi) / 2;
    part left = {f, context, lo, mid}, right = {f, context, mid, hi};
    fret_real a = (mid - lo) * fret_integrate_smooth(part_rate, &left),
              b = (hi - mid) * fret_integrate_smooth(part_rate, &right);
    if (depth == 0 || fabsl(a + b - whole) <= tolerance * (a + b))
        return a + b;
    tolerance *= (a + b) / fmaxl(fmaxl(a, b), LDBL_MIN); /* the smaller half may err by more of itself */
    return bisect(f, context, lo, mid, a, tolerance, depth - 1) +
           bisect(f, context, mid, hi, b, tolerance, depth - 1);
}

static fret_real phase_loss(const fret_memory *m, measure by, fret_real gain, fret_real edge0,
                            fret_real edge1, fret_real front0, fret_real front1) {
    phase p = {m, by, edge0, edge1, front0, front1};
    fret_real rate;
    /* small steps, far from the centre: the rate is smooth */
    bool smooth = front1 > 0.8L * front0 && edge1 > 0.8L * edge0 && edge0 > 0.8L * edge1;
    if (m->normal.gap.kind == FRET_GAP_TABLE)
        rate = bisect(phase_rate, &p, 0, 1, fret_integrate_smooth(phase_rate, &p), 1e-15L, 24);
    else
        rate = smooth ? fret_integrate_smooth(phase_rate, &p) : fret_integrate(phase_rate, &p);
    return gain * (front0 - front1) * rate;
}

/* Gross slip while the normal load changes: int F_N de. */
static fret_real gross_rate(fret_real t, fret_real rest, void *context) {
    const phase *p = context;
    return fret_law_force(&p->m->normal, p->edge0 * rest + p->edge1 * t);
}

/* After a phase only the measure of the step is up to date in the two outermost slices. */
static void convert_top(fret_memory *m, measure by) {
    const measure other = by == DEPTH ? LOAD : DEPTH;
    fret_real outer = m->edge[other];
    size_t first = m->count > 2 ? m->count - 2 : 0;
    for (size_t i = m->count; i-- > first;) {
        slice *sl = &m->slices[i];
        if (i == 0)
            sl->inner[other] = 0;
        else if (i == m->count - 1)
            sl->inner[other] = by == DEPTH ? fret_law_force(&m->normal, sl->inner[by])
                                           : fret_law_depth(&m->normal, sl->inner[by]);
        sl->thick[other] = fmaxl(outer - sl->inner[other], 0);
        outer = sl->inner[other];
    }
    size_t count = m->count;
    for (size_t i = first; i < count; i++) {
        m->count = i + 1;
        resum_top(m);
    }
}

/* Slip front of sign s moving inwards over `reach` units of drive surplus while the edge grows. */
static fret_real grow_and_slide(fret_memory *m, measure by, const fret_real edge[2], fret_real drive) {
    fret_real s = drive < 0 ? -1 : 1, growth = edge[by] - m->edge[by];
    fret_real e = fabsl(drive) - growth, surplus = e, old = m->edge[by], loss = 0;
    fret_real front = old, snap = 1e-17L * edge[by];
    while (m->count && e > 0) {
        slice *top = &m->slices[m->count - 1];
        fret_real gain = 1 - s * top->sigma, cap = gain * top->thick[by], before = front, e0 = e;
        if (cap - e <= snap && cap - e <= 1e-6L * cap) {
            e = cap < e ? e - cap : 0;
            front = m->count > 1 ? top->inner[by] : 0;
            m->count--;
        } else {
            front -= e / gain;
            top->thick[by] -= e / gain;
            e = 0;
        }
        if (gain > 0)
            loss += phase_loss(m, by, gain, old + growth * (surplus - e0) / surplus,
                               old + growth * (surplus - e) / surplus, before, front);
    }
    if (e > 0 && by == DEPTH) {
        phase p = {m, by, old + growth * (surplus - e) / surplus, edge[by], 0, 0};
        loss += e * fret_integrate(gross_rate, &p);
        m->slid += s * m->mu_eta * e;
    }
    if (!m->count)
        front = 0;
    m->edge[DEPTH] = edge[DEPTH];
    m->edge[LOAD] = edge[LOAD];
    fret_real thick[2] = {0, 0}, inner[2] = {0, 0};
    thick[by] = edge[by] - front;
    inner[by] = front;
    push(m, thick, inner, s, 0);
    convert_top(m, by);
    return loss;
}

/* Unloading: the edge moves inwards by r while the drive D acts, both linearly. At the edge, a slope
 * sigma means a surplus D + sigma r per unit: it starts a slip zone of that sign, whose front moves at
 * (sD+r)/(1-s sigma); a front slower than the edge is overtaken, and the next slope decides anew. */
static fret_real shrink(fret_memory *m, measure by, const fret_real edge[2], fret_real drive) {
    fret_real r = m->edge[by] - edge[by], left = r, rate = drive / r, loss = 0, z = m->edge[by];
    while (left > 0 && m->count) {
        slice *top = &m->slices[m->count - 1];
        fret_real surplus = rate + top->sigma, s = surplus < 0 ? -1 : 1;
        if (fabsl(surplus) <= 4 * LDBL_EPSILON * fabsl(top->sigma) ||
            (top->thick[by] <= 0 && m->count > 1 && fabsl(top->sigma) < 1)) {
            fret_real t = fminl(left, top->thick[by]);
            bool gone = t >= top->thick[by];
            top->thick[by] -= t;
            left -= t;
            z -= t;
            if (gone)
                m->count--;
            continue;
        }
        if (s * top->sigma < 1) { /* a new zone, of no thickness yet */
            slice zone = {.inner = {top->inner[0] + top->thick[0], top->inner[1] + top->thick[1]},
                          .sigma = s};
            zone.inner[by] = z;
            m->slices[m->count++] = zone;
            top = &m->slices[m->count - 1];
        }
        if (m->count == 1) { /* the zone is the whole contact */
            if (by == DEPTH) {
                phase p = {m, by, z, edge[by], 0, 0};
                fret_real e = (s * rate + 1) * left;
                loss += e * fret_integrate(gross_rate, &p);
                m->slid += s * m->mu_eta * e;
            }
            top->thick[by] -= left;
            z = edge[by];
            left = 0;
            break;
        }
        slice *next = top - 1;
        fret_real gain = 1 - s * next->sigma, speed = (s * rate + 1) / gain, t = left;
        bool reached = false, overtaken = false;
        if (next->thick[by] <= speed * t) {
            t = next->thick[by] / speed;
            reached = true;
        }
        if (speed < 1 && top->thick[by] <= (1 - speed) * t) {
            t = top->thick[by] / (1 - speed);
            reached = false;
            overtaken = true;
        }
        fret_real front = top->inner[by], step = reached ? next->thick[by] : speed * t;
        loss += phase_loss(m, by, gain, z, z - t, front, front - step);
        z -= t;
        left -= t;
        if (reached) {
            top->inner[by] = m->count > 2 ? next->inner[by] : 0;
            top->thick[by] = z - top->inner[by];
            next[0] = *top;
            m->count--;
            if (m->count > 1 && next[-1].sigma == s) { /* the zone joins one of its own sign */
                next[-1].thick[by] += next->thick[by];
                m->count--;
            }
        } else {
            next->thick[by] -= step;
            if (overtaken) {
                m->count--;
            } else {
                top->inner[by] = front - step;
                top->thick[by] = z - top->inner[by];
            }
        }
    }
    m->edge[DEPTH] = edge[DEPTH];
    m->edge[LOAD] = edge[LOAD];
    if (m->count)
        convert_top(m, by);
    return loss;
}

/* A straight piece with the contact closed at both ends; drive = change of delta_x/(mu eta) or F_x/mu. */
static fret_real advance(fret_memory *m, measure by, const fret_real edge[2], fret_real drive, double goal) {
    fret_real growth = edge[by] - m->edge[by];
    if (growth == 0)
        return drive == 0 ? 0 : slide(m, by, drive, goal);
    m->edge_id++;
    if (growth < 0)
        return shrink(m, by, edge, drive);
    if (fabsl(drive) > growth)
        return grow_and_slide(m, by, edge, drive);
    fret_real thick[2] = {edge[DEPTH] - m->edge[DEPTH], edge[LOAD] - m->edge[LOAD]};
    fret_real inner[2] = {m->edge[DEPTH], m->edge[LOAD]};
    /* targets are rounded to double: so much is uncertain in the slope of a short step */
    push(m, thick, inner, drive / growth, 2 * DBL_EPSILON * edge[by] / growth);
    m->edge[DEPTH] = edge[DEPTH];
    m->edge[LOAD] = edge[LOAD];
    return 0;
}

static void open_contact(fret_memory *m, fret_real dx) {
    m->edge[DEPTH] = m->edge[LOAD] = 0;
    m->edge_id++;
    m->count = 0;
    m->slid = dx;
}

fret_status fret_memory_step(fret_memory *m, const fret_step *step) {
    const fret_real old_dx = displacement(m);
    fret_real edge[2] = {m->edge[DEPTH], m->edge[LOAD]}, gap = m->gap;
    fret_press p = {
        .F = edge[LOAD], .dz = edge[DEPTH], .a = m->radius, m->edge_rest[LOAD], m->edge_rest[DEPTH]};
    const fret_press old = p;
    fret_status st = fret_ok();
    if (step->normal_by == FRET_TO_FORCE) {
        st = fret_press_force(&m->normal, step->normal, &p);
        if (!st.code && p.F == old.F)
            p = old;
        gap = 0;
    } else if (step->normal_by == FRET_TO_DEPTH) {
        if (!isfinite(step->normal))
            return fret_fail(FRET_NOT_FINITE, "dz", step->normal, 0);
        gap = step->normal < 0 ? -step->normal : 0;
        st = fret_press_depth(&m->normal, fmax(step->normal, 0), &p);
        if (!st.code && p.dz == old.dz)
            p = old;
    }
    if (st.code)
        return st;
    edge[DEPTH] = p.dz;
    edge[LOAD] = p.F;
    const char *name = step->tangential_by == FRET_TO_FX ? "Fx" : "dx";
    if (step->tangential_by != FRET_KEEP_DX && !isfinite(step->tangential))
        return fret_fail(FRET_NOT_FINITE, name, step->tangential, 0);
    measure by = step->tangential_by == FRET_TO_FX ? LOAD : DEPTH;
    /* to where it is already: the rounding of sums must not pass for a reversal */
    const bool stays = m->held == step->tangential_by && m->goal == step->tangential;
    fret_real load = by == LOAD ? step->tangential / (fret_real)m->mu : 0; /* F_x/mu */
    if (fabsl(load) > edge[LOAD] * (1 - (fret_real)DBL_EPSILON)) {
        if (fabsl(load) > edge[LOAD] * (1 + (fret_real)DBL_EPSILON))
            return fret_fail(FRET_GROSS_SLIP, "Fx", step->tangential, (double)(m->mu * edge[LOAD]));
        load = copysignl(edge[LOAD], load); /* mu F_N up to its rounding */
    }
    st = reserve(m, m->count + 4);
    if (st.code)
        return st;

    fret_real loss = 0;
    if (by == LOAD) {
        fret_real drive = stays && edge[LOAD] == m->edge[LOAD] ? 0 : load - total(m, LOAD);
        if (drive != 0)
            m->direction = drive < 0 ? -1 : 1;
        loss = advance(m, LOAD, edge, drive, step->tangential);
        if (edge[LOAD] <= 0)
            open_contact(m, m->slid); /* no spring is left to be displaced */
    } else {
        fret_real target = step->tangential_by == FRET_TO_DX && !stays ? (fret_real)step->tangential : old_dx;
        fret_real from = m->gap > 0 ? -m->gap : m->edge[DEPTH], to = gap > 0 ? -gap : edge[DEPTH];
        if (target != old_dx)
            m->direction = target < old_dx ? -1 : 1;
        /* while open, the bodies move freely: only the closed part of the path counts */
        fret_real start = old_dx, stop = target;
        if (from <= 0 && to > 0) {
            start = old_dx + (target - old_dx) * (-from / (to - from));
            open_contact(m, start);
        } else if (from > 0 && to <= 0) {
            stop = old_dx + (target - old_dx) * (from / (from - to));
        }
        if (from > 0 || to > 0) {
            loss = advance(m, DEPTH, edge, (stop - start) / m->mu_eta, step->tangential);
            if (to > 0 && step->tangential_by == FRET_TO_DX && m->count == 1 &&
                fabsl(m->slices[0].sigma) == 1)
                m->slid = target - m->mu_eta * total(m, DEPTH);
        }
        if (to <= 0)
            open_contact(m, target);
    }
    if (step->tangential_by != FRET_KEEP_DX) {
        m->held = step->tangential_by;
        m->goal = step->tangential;
    } else if (m->held == FRET_TO_FX && step->normal_by != FRET_KEEP_NORMAL) {
        m->held = FRET_KEEP_DX;
    }
    m->gap = gap;
    m->radius = p.a;
    m->edge_rest[DEPTH] = p.dz_rest;
    m->edge_rest[LOAD] = p.F_rest;
    m->last_loss = loss > 0 ? loss * m->loss_scale : 0;
    fret_sum_add(&m->W, m->last_loss);
    return fret_ok();
}

void fret_memory_forces(const fret_memory *m, fret_state *out) {
    *out = (fret_state){
        .FN = m->edge[LOAD],
        .dz = m->gap > 0 ? -m->gap : m->edge[DEPTH],
        .Fx = m->mu * total(m, LOAD),
        .dx = displacement(m),
        .W = fret_sum_value(&m->W),
        .slices = m->count,
    };
}

/* U = mu^2 eta/2 int v^2 dK with v the sum of sigma from the edge: from the centre outwards, a slice of
 * thickness h adds sigma h T + sigma^2 J to the half integral, T the sum of sigma dF_N inside it. */
static fret_real stored(const fret_memory *m) {
    fret_real sum = 0, T = 0;
    for (size_t i = 0; i < m->count; i++) {
        const slice *sl = &m->slices[i];
        const fret_real *end = i + 1 < m->count ? sl[1].inner : m->edge, h = sl->thick[DEPTH];
        const fret_level outer = {end[DEPTH], end[LOAD]};
        if (sl->sigma != 0 && h > 0)
            sum += sl->sigma * h * T + sl->sigma * sl->sigma * fret_law_slice(&m->normal, &outer, h).J;
        T = sl->sum[LOAD];
    }
    return m->loss_scale * sum;
}

void fret_memory_state(const fret_memory *m, fret_state *out) {
    fret_memory_forces(m, out);
    if (!m->count)
        return;
    const slice *top = &m->slices[m->count - 1];
    out->U = stored(m);
    out->a = m->radius;
    out->kn = fret_normal_stiffness(&m->normal, out->a);
    out->c = out->a;
    if (fabsl(top->sigma) >= 1)
        out->c = m->count == 1
                     ? 0
                     : fret_law_level_radius(&m->normal, &(fret_level){top->inner[DEPTH], top->inner[LOAD]});
    bool goes_on = top->sigma * m->direction >= 1;
    fret_real inner = goes_on ? out->c : out->a;
    out->kt = inner > 0 ? fret_normal_stiffness(&m->normal, inner) / m->normal.foundation.eta : 0;
}

const fret_normal *fret_memory_normal(const fret_memory *m) {
    return &m->normal;
}

double fret_memory_friction(const fret_memory *m) {
    return m->mu;
}

fret_real fret_memory_last_loss(const fret_memory *m) {
    return m->last_loss;
}

int fret_memory_segment(const fret_memory *m, size_t i, fret_segment *out) {
    if (i >= m->count)
        return 0;
    const slice *sl = &m->slices[i];
    fret_real outer = i + 1 < m->count ? sl[1].inner[DEPTH] : m->edge[DEPTH];
    fret_real inside = i ? sl[-1].sum[DEPTH] : 0;
    *out = (fret_segment){sl->inner[DEPTH], outer, sl->sigma, m->mu_eta * (total(m, DEPTH) - inside)};
    return 1;
}
