/* SPDX-License-Identifier: GPL-3.0-or-later */
/* F_N(delta) and its inverse at any depth: in logarithms for the power law, by a search for other shapes. */
#include "contact/pieces.h"

#include <float.h>

#include "number/real.h"

/* Radii are handled as their distance e from the start of the gap. */
static fret_profile profile(const fret_normal *n, fret_real e) {
    return fret_gap_profile(&n->gap, &n->rule, e);
}

fret_real fret_force_of(const fret_normal *n, const fret_profile *p) {
    return 2 * n->foundation.cN0 * fret_pow(n->foundation.c0, -n->foundation.k) * p->I;
}

/* A contact that reaches less than this part of a flat end beyond it is a flat punch's to every digit, and
 * what it loses is less than doubles hold. Near k = -1, where depth begins as the power (k+1)/2 of the reach,
 * the reach of most contacts would underflow. */
static const fret_real least_reach = 0x1p-1100L;

/* Newton in ln e, from e on, where depth and force are nearly powers, kept in a bracket. */
static fret_real search_from(const fret_normal *n, bool by_force, fret_real target, fret_real e) {
    fret_real start = fret_gap_start(&n->gap), end = n->end;
    fret_real lo = 0, hi = isfinite(end) ? end - start : (fret_real)INFINITY;
    const fret_real least = least_reach * start;
    for (int i = 0; i < 400 && !fret_stopped(n); i++) {
        fret_profile p = profile(n, e);
        fret_real value = by_force ? fret_force_of(n, &p) : p.g;
        if (value < target)
            lo = e;
        else
            hi = e;
        fret_real slope = e * p.slope * (by_force ? fret_normal_stiffness(n, start + e) : 1) / value;
        fret_real next = e * expl(logl(target / value) / slope);
        if (hi <= least)
            return 0;
        if (fabsl(next - e) <= 1e-11L * e) /* quadratic: the next step would be 1e-22 */
            return next;
        if (next < least && lo < least)
            next = least;
        if (!(next > lo && next < hi)) {
            if (!isfinite(hi))
                next = 4 * e;
            else
                next = lo > 0 ? sqrtl(lo) * sqrtl(hi) : hi / 16;
        }
        if (isfinite(hi) && hi - lo <= 2 * LDBL_EPSILON * hi)
            return next;
        e = next;
    }
    return e;
}

/* Returns e; 0 below the least reach, infinity where the gap ends before the target is reached. */
fret_real fret_search_radius(const fret_normal *n, bool by_force, fret_real target) {
    fret_real start = fret_gap_start(&n->gap), end = n->end;
    if (target <= 0)
        return 0;
    if (isfinite(end)) {
        fret_profile p = profile(n, end - start);
        const fret_real most = by_force ? fret_force_of(n, &p) : p.g;
        if (most < target)
            return fret_law_reaches(most, target) ? end - start : (fret_real)INFINITY;
    }
    return search_from(n, by_force, target, isfinite(end) ? end / 16 : start > 0 ? start / 16 : 1e-4L);
}

fret_real fret_law_other(const fret_normal *n, bool by_force, fret_real value, fret_real e) {
    if (e > 0) {
        const fret_profile there = profile(n, e);
        return by_force ? there.g : fret_force_of(n, &there);
    }
    const fret_real K = fret_normal_stiffness(n, fret_gap_start(&n->gap));
    return !by_force ? K * value : K > 0 ? value / K : 0;
}

/* The power law in logarithms. */
static dd force_of_depth(const fret_normal *n, dd y) {
    return dd_add(n->wide.ln_force, dd_mul(n->wide.p, dd_sub(y, n->wide.ln_depth)));
}
static dd depth_of_force(const fret_normal *n, dd F) {
    return dd_add(n->wide.ln_depth, dd_mul(n->wide.q, dd_sub(F, n->wide.ln_force)));
}
static dd radius_of_depth(const fret_normal *n, dd y) {
    return dd_add(n->wide.ln_r0, dd_div(dd_sub(y, n->wide.ln_depth), dd_of(n->gap.power[0].n)));
}

dd fret_law_log_radius(const fret_normal *n, fret_real y) {
    return radius_of_depth(n, fret_dd_log_real(y));
}

static fret_point point_at(const fret_normal *n, bool by_force, fret_real value);

fret_real fret_law_radius(const fret_normal *n, fret_real y) {
    if (fret_normal_closed(n))
        return y > 0 ? fret_dd_exp_real(radius_of_depth(n, fret_dd_log_real(y))) : 0;
    return fret_law_at_depth(n, y).a;
}

fret_real fret_law_force(const fret_normal *n, fret_real y) {
    if (y <= 0)
        return 0;
    if (fret_normal_closed(n))
        return fret_dd_exp_real(force_of_depth(n, fret_dd_log_real(y)));
    return point_at(n, false, y).F;
}

fret_real fret_law_depth(const fret_normal *n, fret_real F) {
    if (F <= 0)
        return 0;
    if (fret_normal_closed(n))
        return fret_dd_exp_real(depth_of_force(n, fret_dd_log_real(F)));
    return point_at(n, true, F).y;
}

/* Pieces leave out K. */
static fret_point point_at(const fret_normal *n, bool by_force, fret_real value) {
    fret_point p = {0, 0, fret_gap_start(&n->gap), 0};
    if (value <= 0)
        return p;
    if (fret_normal_closed(n)) {
        p.y = by_force ? fret_law_depth(n, value) : value;
        p.F = by_force ? value : fret_law_force(n, value);
        p.K = n->p * p.F / p.y;
        p.a = fret_law_radius(n, p.y);
        return p;
    }
    if (n->pieces && fret_pieces_point(n->pieces, by_force, value, &p))
        return p;
    const fret_real e = fret_search_radius(n, by_force, value), other = fret_law_other(n, by_force, value, e);
    p.y = by_force ? other : value;
    p.F = by_force ? value : other;
    p.a += e;
    p.K = fret_normal_stiffness(n, p.a);
    return p;
}

/* The radius that the profile has there, where pieces know it but about. */
static void settle(const fret_normal *n, bool by_force, fret_real value, fret_point *p) {
    const fret_real start = fret_gap_start(&n->gap);
    if (value > 0 && n->pieces && fret_pieces_rough(n->pieces, n->borne))
        p->a = start + search_from(n, by_force, value, p->a - start);
}

bool fret_law_prepared(const fret_normal *n, bool by_force, fret_real value, fret_point *out) {
    if (!n->pieces || !fret_pieces_point(n->pieces, by_force, value, out))
        return false;
    settle(n, by_force, value, out);
    return true;
}

bool fret_law_unplaced(const fret_normal *n, bool by_force, fret_real value, fret_real *other) {
    fret_point p;
    if (!n->pieces || !fret_pieces_rough(n->pieces, n->borne) ||
        !fret_pieces_point(n->pieces, by_force, value, &p))
        return false;
    *other = by_force ? p.y : p.F;
    return fret_press_held(&(fret_press){.F = p.F, .dz = p.y, .a = p.a});
}

bool fret_law_prepared_depth(const fret_normal *n, fret_real e, fret_real *depth) {
    return n->pieces && !fret_pieces_rough(n->pieces, n->borne) && fret_pieces_depth(n->pieces, e, depth);
}

static fret_point whole_point_at(const fret_normal *n, bool by_force, fret_real value) {
    fret_point p = point_at(n, by_force, value);
    if (value > 0 && n->pieces)
        p.K = fret_normal_stiffness(n, p.a);
    settle(n, by_force, value, &p);
    return p;
}

fret_point fret_law_at_depth(const fret_normal *n, fret_real y) {
    return whole_point_at(n, false, y);
}

fret_point fret_law_at_force(const fret_normal *n, fret_real F) {
    return whole_point_at(n, true, F);
}

fret_real fret_law_load_outside(const fret_normal *n, const fret_level *outer, fret_real inner_depth) {
    if (fret_normal_closed(n))
        return -outer->F * expm1l(n->p * logl(inner_depth / outer->y));
    return outer->F - fret_law_force(n, inner_depth);
}

fret_real fret_law_thickness_outside(const fret_normal *n, const fret_level *outer, fret_real inner_load) {
    if (fret_normal_closed(n))
        return -outer->y * expm1l(n->q * logl(inner_load / outer->F));
    return outer->y - fret_law_depth(n, inner_load);
}

fret_real fret_law_level_radius(const fret_normal *n, const fret_level *level) {
    if (!fret_normal_closed(n))
        return fret_law_radius(n, level->y);
    if (level->F <= 0)
        return 0;
    dd l = dd_sub(fret_dd_log_real(level->F), n->wide.ln_force);
    return fret_dd_exp_real(dd_add(n->wide.ln_r0, dd_div(l, n->wide.s)));
}
