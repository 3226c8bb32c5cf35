/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The loss per cycle by quadrature of its definition, independent of the closed forms but for the place of
 * the slip front. */
#include "fret/reference.h"

#include <float.h>

#include "contact/check.h"
#include "contact/normal.h"
#include "number/real.h"
#include "number/sum.h"

/* The annulus that slips. Power laws take depths relative to delta_z, where both brackets are distances from
 * the ends and keep every digit: from yc to 1, of width X = 1-yc. Other shapes take radii, as distances from
 * the start of the gap: depths there may jump. */
typedef struct slip_zone {
    const fret_normal *normal;
    fret_real scale; /* of the integral, to J */
    fret_real yc, X;
    fret_real start, inner, outer, g_inner, g_outer;
    bool by_rows; /* of a table */
} slip_zone;

/* int (1-y) (y-yc) K'(y) dy in units of F_N, K' = p (p-1) y^(p-2) */
static fret_real by_depth(const slip_zone *s, fret_real t, fret_real rest) {
    const fret_normal *n = s->normal;
    fret_real from_edge = s->X * rest, y = s->yc + s->X * t;
    fret_real l = from_edge < 0.5L ? log1pl(-from_edge) : logl(y);
    return n->p * n->pm1 * expl((n->pm1 - 1) * l) * t * rest;
}

/* int 2 (x/c0)^k (g(a)-g(x)) (g(x)-g(c)) dx */
static fret_real by_radius(const slip_zone *s, fret_real t, fret_real rest) {
    const fret_normal *n = s->normal;
    fret_real e = s->inner * rest + s->outer * t;
    if (e <= 0)
        return 0;
    fret_real g = fret_gap_profile(&n->gap, &n->rule, e).g;
    return 2 * fret_pow((s->start + e) / n->foundation.c0, n->foundation.k) * (s->g_outer - g) *
           (g - s->g_inner) * (s->outer - s->inner);
}

/* Nodes u = first, first + step, ... within +-END of t = 1/(1 + exp(-pi sinh u)). */
static const fret_real END = 4; /* t = 1e-37 */

static fret_real piece_sum(const slip_zone *s, fret_real first, fret_real step) {
    fret_real (*f)(const slip_zone *, fret_real, fret_real) =
        fret_normal_closed(s->normal) ? by_depth : by_radius;
    fret_sum sum = {0, 0};
    unsigned count = (unsigned)floorl((END - first) / step + 0.5L);
    for (unsigned i = 0; i <= count && !fret_stopped(s->normal); i++) {
        fret_real u = first + step * i, grown = expl(fabsl(u));
        fret_real e = expl(-FRET_PI * (grown - 1 / grown) / 2), near = e / (1 + e), far = 1 / (1 + e);
        fret_real weight = FRET_PI * (grown + 1 / grown) / 2 * near * far; /* dt/du */
        fret_sum_add(&sum, weight * (u < 0 ? f(s, near, far) : f(s, far, near)));
    }
    return fret_sum_value(&sum);
}

/* Over a table row by row: a rule across rows, where the profile is not smooth, converges slowly. */
static fret_real nodes_sum(const slip_zone *s, fret_real first, fret_real step) {
    if (!s->by_rows)
        return piece_sum(s, first, step);
    slip_zone piece = *s;
    fret_real sum = 0;
    for (; piece.outer > s->inner && !fret_stopped(s->normal); piece.outer = piece.inner) {
        piece.inner = fmaxl(fret_gap_kink(&s->normal->gap, piece.outer), s->inner);
        sum += piece_sum(&piece, first, step);
    }
    return sum;
}

/* Are there rows within, and few enough to take one by one? */
static bool has_rows(const slip_zone *s) {
    int rows = 0;
    for (fret_real e = s->outer; e > s->inner && rows <= 500; rows++)
        e = fret_gap_kink(&s->normal->gap, e);
    return rows > 1 && rows <= 500;
}

static slip_zone slip_zone_of(const fret_contact *c, const fret_loading *peak) {
    const fret_normal *normal = c->normal;
    const fret_press *press = &c->press;
    const double mu = c->mu;
    fret_real max = fret_gross_slip(c), x = fminl(fabsl(peak->dx) / max, 1);
    slip_zone s = {.normal = normal, .yc = peak->yc / press->dz, .X = x};
    s.scale = 4 * mu * press->F * max * x * x * x;
    if (!fret_normal_closed(normal)) {
        s.scale = 4 * mu * mu * normal->foundation.eta * normal->foundation.cN0;
        s.start = fret_gap_start(&normal->gap);
        s.outer = fret_law_distance(normal, press->dz);
        s.inner = fret_law_distance(normal, peak->yc);
        s.g_outer = fret_gap_profile(&normal->gap, &normal->rule, s.outer).g;
        /* beside a flat end g grows within less than the last digit of the radius */
        s.g_inner = s.inner > s.start / 64 ? fret_gap_profile(&normal->gap, &normal->rule, s.inner).g
                                           : s.g_outer * (1 - x);
        s.by_rows = fret_gap_sampled(&normal->gap) && has_rows(&s);
    }
    return s;
}

/* What gross slip adds. */
static fret_real sliding(const fret_contact *c, const fret_loading *peak) {
    return 4 * c->mu * c->press.F * fmaxl(fabsl(peak->dx) - fret_gross_slip(c), 0);
}

fret_status fret_quadrature_loss(const fret_contact *c, const fret_loading *peak, unsigned points,
                                 fret_real *loss) {
    fret_status st = fret_contact_check(c);
    if (!st.code && (points < 8 || points > 100000))
        st = fret_fail(FRET_OUTSIDE, "points", points, points < 8 ? 8 : 100000);
    if (st.code)
        return st;
    const slip_zone s = slip_zone_of(c, peak);
    fret_real step = 2 * END / (points - 1);
    *loss = s.scale * step * nodes_sum(&s, -END, step) + sliding(c, peak);
    return fret_unless_stopped(c->normal, fret_ok());
}

static fret_status refine(const fret_contact *c, const fret_loading *peak, fret_real *loss,
                          fret_real *agreement) {
    const fret_real unit = 4 * LDBL_EPSILON,
                    finest = fret_gap_sampled(&c->normal->gap) ? 1 / 64.0L : 1 / 256.0L;
    const slip_zone s = slip_zone_of(c, peak);
    fret_real step = 0.25L, sum = nodes_sum(&s, -END, step), change;
    do {
        fret_real old = step * sum;
        sum += nodes_sum(&s, -END + step / 2, step);
        step /= 2;
        change = fabsl(step * sum - old);
    } while (change > unit * step * sum && step > finest && !fret_stopped(c->normal));
    *loss = s.scale * step * sum + sliding(c, peak);
    /* differences of depths, and of radii near a flat end, keep fewer digits */
    fret_real lost = fret_normal_closed(c->normal) ? 1 : fmaxl(1, s.start / s.outer) / s.X;
    *agreement = sum > 0 ? fmaxl(change / (step * sum), unit * lost) : 0;
    return fret_unless_stopped(c->normal, fret_ok());
}

fret_status fret_reference_loss_by_force(const fret_contact *c, double FA, fret_real *loss,
                                         fret_real *agreement) {
    fret_loading peak;
    fret_status st = fret_check_not_negative("FA", FA);
    if (!st.code)
        st = fret_loading_by_force(c, FA, &peak);
    if (st.code == FRET_GROSS_SLIP)
        st.quantity = "FA";
    return st.code ? st : refine(c, &peak, loss, agreement);
}

fret_status fret_reference_loss_by_displacement(const fret_contact *c, double dA, fret_real *loss,
                                                fret_real *agreement) {
    fret_loading peak;
    fret_status st = fret_check_not_negative("dxA", dA);
    if (!st.code)
        st = fret_loading_by_displacement(c, dA, &peak);
    return st.code ? st : refine(c, &peak, loss, agreement);
}
