/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The memory of turning points at constant F_N, in double. Allocates its stack. */
#include "fret/masing.h"

#include <float.h>
#include <stdlib.h>
#include <string.h>

#include "contact/check.h"
#include "contact/normal.h"
#include "fast/batch.h"
#include "number/array.h"
#include "number/double.h"

/* The elementary functions of a step, in one place. */
static inline double log_of_rest(double t) { /* log(1-t) */
    return fret_double_log1p(-t);
}

static inline double log_of(double s) {
    return fret_double_log(s);
}

static inline double exp_drop(double t) { /* 1-exp(-t) */
    return -fret_double_expm1(-t);
}

typedef struct sum {
    double value, rest;
} sum;

static inline void add(sum *s, double x) {
    const double t = s->value + x;
    s->rest += fabs(s->value) >= fabs(x) ? (s->value - t) + x : (x - t) + s->value;
    s->value = t;
}

/* First loading at the fraction x of delta_x,max. */
typedef struct point {
    double x;
    double l; /* power law: -log(1-x) */
    double P; /* F_x/(mu F_N) */
} point;

/* Where the motion turned back, and the branch that ended there. */
typedef struct turn {
    double d, F;
    double reach; /* length of first loading, half length of any other branch [m] */
    double loss;  /* on it; losses are in mu F_N delta_x,max */
    sum held;     /* on all branches up to here */
} turn;

enum { SERIES = 11 };
struct fret_masing {
    const fret_normal *normal; /* borrowed */
    fret_level edge;
    double mu;
    double p, pm1, q;         /* power law, else p = 0 */
    double limit, limit_rest; /* mu F_N */
    double slip, per_slip;    /* delta_x,max and its inverse */
    double energy;            /* mu F_N delta_x,max */
    double series[SERIES];    /* of D in ((p+1) l/2)^2 */
    double dx, Fx, reach;
    int sign; /* of the last motion */
    point at; /* on the branch */
    /* First loading to d has the length |d-origin| + start towards `side`, - start the other way: 0 and 0 at
     * first, then counted from where gross slip ended, so that it ends at delta_x,max exactly. */
    double origin, start;
    int side;
    sum closed; /* losses of closed loops and of gross slip */
    double loop;
    size_t count, room;
    turn *turns;
};

fret_status fret_masing_make(const fret_contact *contact, fret_masing **out) {
    fret_status st = fret_contact_check(contact);
    if (st.code)
        return st;
    const fret_normal *normal = contact->normal;
    const fret_press *press = &contact->press;
    const double mu = contact->mu;
    const fret_real limit = mu * press->F, slip = mu * normal->foundation.eta * press->dz;
    if (!(limit * slip <= DBL_MAX && limit * slip >= DBL_MIN && limit / slip <= DBL_MAX))
        return fret_fail(FRET_OVERFLOW, NULL, (double)(limit * slip), DBL_MAX);
    fret_masing *m = calloc(1, sizeof *m);
    turn *turns = calloc(16, sizeof *turns);
    if (!m || !turns) {
        free(m);
        free(turns);
        return fret_fail(FRET_NO_MEMORY, NULL, 0, 0);
    }
    m->normal = normal;
    m->edge = (fret_level){press->dz, press->F};
    m->mu = mu;
    m->p = (double)normal->p;
    m->pm1 = (double)normal->pm1;
    m->q = (double)normal->q;
    m->limit = (double)limit;
    m->limit_rest = (double)(limit - m->limit);
    m->slip = (double)slip;
    m->per_slip = (double)(1 / slip);
    m->energy = (double)(limit * slip);
    fret_loss_series(m->pm1 / (m->p + 1), SERIES, m->series);
    m->turns = turns;
    m->room = 16;
    fret_masing_reset(m);
    *out = m;
    return fret_ok();
}

void fret_masing_free(fret_masing *m) {
    if (m)
        free(m->turns);
    free(m);
}

void fret_masing_reset(fret_masing *m) {
    m->dx = m->Fx = m->reach = m->origin = m->start = m->loop = 0;
    m->sign = m->side = 1;
    m->at = (point){0, 0, 0};
    m->closed = (sum){0, 0};
    m->count = 0;
}

static fret_status reserve(fret_masing *m, size_t count) {
    if (count <= m->room)
        return fret_ok();
    turn *grown = fret_array_for(m->turns, &m->room, count, sizeof *grown);
    if (!grown)
        return fret_fail(FRET_NO_MEMORY, NULL, 0, 0);
    m->turns = grown;
    return fret_ok();
}

fret_status fret_masing_copy(fret_masing *to, const fret_masing *from) {
    if (to == from)
        return fret_ok();
    fret_status st = reserve(to, from->count);
    if (st.code)
        return st;
    turn *turns = to->turns;
    const size_t room = to->room;
    *to = *from;
    to->turns = turns;
    to->room = room;
    memcpy(turns, from->turns, from->count * sizeof *turns);
    return fret_ok();
}

static point point_at(const fret_masing *m, double x) {
    if (x >= 1)
        return (point){1, INFINITY, 1};
    if (m->p > 0) {
        const double l = -log_of_rest(x);
        return (point){x, l, exp_drop(m->p * l)};
    }
    return (point){x, 0, (double)(fret_law_load(m->normal, &m->edge, x * m->edge.y) / m->edge.F)};
}

/* From P = F_x/(mu F_N) and 1-P, each with all its digits. */
static point point_of_force(const fret_masing *m, double P, double rest) {
    if (rest <= 0)
        return (point){1, INFINITY, 1};
    if (m->p > 0) {
        const double l = -m->q * (P <= 0.5 ? log_of_rest(P) : log_of(rest));
        return (point){exp_drop(l), l, P};
    }
    const fret_real F = m->edge.F, w = P <= 0.5 ? P * F : F - rest * F;
    return (point){(double)(fret_law_thickness(m->normal, &m->edge, w) / m->edge.y), 0, P};
}

/* Power law: 1-(1-x)^(p-1); a step does without. */
static double drop(const fret_masing *m, const point *at) {
    return exp_drop(m->pm1 * at->l);
}

/* D(x). With L = p l and s = 1-P it is L^3 exp(-(1+q)L/2) times a series of positive terms, see
 * fret_loss_shape; or, at larger L, closed forms that keep every digit for p < 2 and for p >= 2. */
static double first_loss(const fret_masing *m, const point *at) {
    if (m->p == 0)
        return (double)(fret_law_slice(m->normal, &m->edge, at->x * m->edge.y).L / (m->edge.F * m->edge.y));
    const double x = at->x, q = m->q, l = at->l;
    if (m->p * l >= 1.75)
        return m->p < 2 ? (m->pm1 * q * at->P * (2 - x) - 2 * (1 - x) * drop(m, at)) / (1 + q)
                        : ((2 - at->P) * x - q * at->P * (2 - x)) / (1 + q);
    const double *c = m->series, a = (m->p + 1) * l / 2, u = a * a, u2 = u * u, u4 = u2 * u2;
    const double series =
        (((c[0] + u * c[1]) + u2 * (c[2] + u * c[3])) + u4 * ((c[4] + u * c[5]) + u2 * (c[6] + u * c[7]))) +
        u4 * u4 * ((c[8] + u * c[9]) + u2 * c[10]);
    return m->p * m->pm1 * l * l * l * sqrt((1 - x) * (1 - at->P)) * series; /* (1-x)^((p+1)/2) */
}

static double branch_loss(const fret_masing *m) {
    return (m->count ? 2 : 1) * first_loss(m, &m->at);
}

/* Turns back here, if the motion to come does. */
static fret_status head(fret_masing *m, int sign) {
    if (sign == m->sign)
        return fret_ok();
    fret_status st = reserve(m, m->count + 1);
    if (st.code)
        return st;
    turn t = {m->dx, m->Fx, m->reach, branch_loss(m), {0, 0}};
    if (m->count)
        t.held = m->turns[m->count - 1].held;
    add(&t.held, t.loss);
    m->turns[m->count++] = t;
    m->sign = sign;
    return st;
}

/* The branch has come back to where the one before its own began; first loading has no turning point at its
 * beginning, but goes on at the opposite end. */
static void close_loop(fret_masing *m) {
    const turn *last = &m->turns[m->count - 1];
    add(&m->closed, 2 * last->loss);
    m->loop = (m->count > 1 ? 2 : 4) * last->loss;
    m->count -= m->count > 1 ? 2 : 1;
}

fret_status fret_masing_to_dx(fret_masing *m, double dx, double *Fx) {
    if (!isfinite(dx))
        return fret_fail(FRET_NOT_FINITE, "dx", dx, 0);
    if (dx != m->dx) {
        fret_status st = head(m, dx > m->dx ? 1 : -1);
        if (st.code)
            return st;
        while (m->count && fabs(dx - m->turns[m->count - 1].d) >= 2 * m->turns[m->count - 1].reach)
            close_loop(m);
        double from = 0, twice = 1;
        if (m->count) {
            const turn *last = &m->turns[m->count - 1];
            m->reach = fabs(dx - last->d) / 2;
            from = last->F;
            twice = 2;
        } else {
            const double moved = m->sign * (dx - m->origin),
                         start = m->sign == m->side ? m->start : -m->start;
            m->reach = start + moved;
            if (m->reach >= m->slip) {
                add(&m->closed, (moved + (start - m->slip)) / m->slip);
                m->origin = dx;
                m->start = m->reach = m->slip;
                m->side = m->sign;
            }
        }
        m->at = point_at(m, m->reach >= m->slip ? 1 : m->reach * m->per_slip);
        const double force = from + m->sign * twice * m->limit * m->at.P;
        m->Fx = fabs(force) > m->limit ? copysign(m->limit, force) : force;
        m->dx = dx;
    }
    *Fx = m->Fx;
    return fret_ok();
}

/* mu F_N - sign F with the rounding of mu F_N; what a double calls equal is. */
static double to_gross_slip(const fret_masing *m, double F, int sign) {
    const double left = m->limit - sign * F;
    return left > 0 ? left + m->limit_rest : 0;
}

/* How far a branch from the last turning point goes before it closes a loop, as a force. */
static double span(const fret_masing *m) {
    const double F = m->turns[m->count - 1].F;
    return m->count > 1 ? fabs(F - m->turns[m->count - 2].F) : 2 * fabs(F);
}

fret_status fret_masing_to_force(fret_masing *m, double Fx, double *dx) {
    if (!isfinite(Fx))
        return fret_fail(FRET_NOT_FINITE, "Fx", Fx, 0);
    if (fabs(Fx) > m->limit * (1 + DBL_EPSILON))
        return fret_fail(FRET_GROSS_SLIP, "Fx", Fx, m->limit);
    if (fabs(Fx) >= m->limit * (1 - DBL_EPSILON))
        Fx = copysign(m->limit, Fx);
    if (Fx != m->Fx) {
        fret_status st = head(m, Fx > m->Fx ? 1 : -1);
        if (st.code)
            return st;
        while (m->count && fabs(Fx - m->turns[m->count - 1].F) >= span(m))
            close_loop(m);
        const double ahead = to_gross_slip(m, Fx, m->sign);
        if (m->count) {
            const turn *last = &m->turns[m->count - 1];
            const double rest = ahead + to_gross_slip(m, last->F, -m->sign);
            m->at = point_of_force(m, fabs(Fx - last->F) / (2 * m->limit), rest / (2 * m->limit));
            m->reach = m->at.x * m->slip;
            m->dx = last->d + m->sign * 2 * m->reach;
        } else {
            const double start = m->sign == m->side ? m->start : -m->start;
            m->at = point_of_force(m, fabs(Fx) / m->limit, ahead / m->limit);
            m->reach = m->at.x * m->slip;
            m->dx = m->origin + m->sign * (m->reach - start);
        }
        m->Fx = Fx;
    }
    *dx = m->dx;
    return fret_ok();
}

double fret_masing_loss(const fret_masing *m) {
    sum all = m->closed;
    if (m->count) {
        add(&all, m->turns[m->count - 1].held.value);
        all.rest += m->turns[m->count - 1].held.rest;
    }
    add(&all, branch_loss(m));
    return m->energy * (all.value + all.rest);
}

void fret_masing_now(const fret_masing *m, fret_masing_state *out) {
    *out = (fret_masing_state){
        .Fx = m->Fx, .dx = m->dx, .W = fret_masing_loss(m), .loop = m->energy * m->loop, .turns = m->count};
    if (m->p > 0) {
        out->kt = m->p * (1 - drop(m, &m->at)) * (m->limit / m->slip);
    } else if (m->at.x < 1) {
        const fret_real a = fret_law_radius(m->normal, m->edge.y * (1 - (fret_real)m->at.x));
        out->kt = (double)(fret_normal_stiffness(m->normal, a) / m->normal->foundation.eta);
    }
}
