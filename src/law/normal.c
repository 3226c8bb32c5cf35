/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The normal contact: made once, then pressed by force, depth or radius. Allocates the one object. */
#include "law/normal.h"

#include <float.h>
#include <stdlib.h>

#include "law/cells.h"
#include "law/check.h"
#include "number/real.h"

/* Depth and force of the power law at a = r0, in logarithms, which cannot overflow. */
static void make_power(fret_normal *n) {
    const fret_foundation *f = &n->foundation;
    const fret_power *g = &n->gap.power[0];
    const double k = (double)f->k;
    dd k1 = dd_sum(1, k), s = dd_add_d(k1, g->n);
    n->wide.s = s;
    n->wide.p = dd_div(s, dd_of(g->n));
    n->wide.q = dd_div(dd_of(g->n), s);
    n->s = dd_value(s);
    n->p = dd_value(n->wide.p);
    n->q = dd_value(n->wide.q);
    n->pm1 = dd_value(dd_div(k1, dd_of(g->n)));
    dd_scaled kappa = fret_kappa_parts(g->n, k);
    n->rule.k = f->k;
    n->rule.kappa[0] = dd_value(dd_mul(kappa.factor, fret_dd_exp(kappa.log)));
    int e;
    double h = frexp(g->h, &e);
    dd r0 = fret_dd_log(dd_of(g->r0));
    n->wide.ln_r0 = r0;
    n->wide.ln_depth = dd_add(kappa.log, fret_dd_log_scaled(dd_mul_d(kappa.factor, h), e));
    /* 2 cN0 n/((k+1) s) (r0/c0)^k r0 */
    dd force = dd_div(dd_mul_d(n->wide_foundation.cN0, 2 * g->n), dd_mul(k1, s));
    force = fret_dd_log_scaled(force, n->wide_foundation.scale);
    if (k != 0)
        force = dd_add(force, dd_mul_d(dd_sub(r0, fret_dd_log(dd_of((double)f->c0))), k));
    n->wide.ln_force = dd_add(dd_add(force, r0), n->wide.ln_depth);
}

/* Gives a contact whose foundation is known its gap. */
static fret_status give_shape(fret_normal *n, const fret_gap *gap, const fret_normal *like, fret_stop stop) {
    const double k = (double)n->foundation.k;
    fret_status st = fret_gap_check(gap);
    if (st.code)
        return st;
    n->gap = *gap;
    n->end = INFINITY;
    n->stiff = fret_normal_stiffness(n, 1);
    if (fret_gap_closed(gap)) {
        make_power(n); /* p ~ 1/n */
        return n->p <= DBL_MAX ? st : fret_fail(FRET_OVERFLOW, "n", gap->power[0].n, DBL_MAX);
    }
    fret_gap_rule(gap, k, &n->rule);
    st = fret_cells_make(gap, k, like ? like->cells : NULL, stop, &n->cells);
    if (!st.code)
        n->end = n->cells->end;
    return st;
}

static fret_status make(const fret_foundation *foundation, const fret_wide_foundation *wide,
                        const fret_gap *gap, const fret_normal *like, fret_stop stop, fret_normal **out) {
    fret_normal *n = calloc(1, sizeof *n);
    if (!n)
        return fret_fail(FRET_NO_MEMORY, NULL, 0, 0);
    n->foundation = *foundation;
    n->wide_foundation = *wide;
    n->users = 1;
    const fret_status st = give_shape(n, gap, like, stop);
    if (st.code)
        free(n);
    else
        *out = n;
    return st;
}

fret_status fret_normal_make(const fret_material *material, const fret_gap *gap, const fret_normal *like,
                             fret_stop stop, fret_normal **out) {
    fret_foundation foundation;
    fret_wide_foundation wide;
    const fret_status st = fret_foundation_make_wide(material, &foundation, &wide);
    return st.code ? st : make(&foundation, &wide, gap, like, stop, out);
}

fret_status fret_normal_reshape(const fret_normal *from, const fret_gap *gap, fret_normal **out) {
    const fret_status st = make(&from->foundation, &from->wide_foundation, gap, NULL, from->stop, out);
    if (!st.code)
        (*out)->stop = from->stop;
    return st;
}

fret_normal *fret_normal_hold(fret_normal *n) {
    n->users++;
    return n;
}

bool fret_normal_same(const fret_normal *a, const fret_normal *b) {
    const fret_foundation *f = &a->foundation, *g = &b->foundation;
    return f->k == g->k && f->c0 == g->c0 && f->cN0 == g->cN0 && f->cT0 == g->cT0 &&
           fret_gap_same(fret_normal_gap(a), fret_normal_gap(b));
}

void fret_normal_free(fret_normal *n) {
    if (!n || --n->users > 0)
        return;
    fret_cells_free(n->cells);
    free(n);
}

void fret_normal_stop(fret_normal *n, fret_stop stop) {
    n->stop = stop;
}

double fret_normal_error(const fret_normal *n) {
    return n->cells ? (double)n->cells->error : (double)NAN;
}

const fret_foundation *fret_normal_foundation(const fret_normal *n) {
    return &n->foundation;
}

const fret_gap *fret_normal_gap(const fret_normal *n) {
    return &n->gap;
}

bool fret_normal_is_power(const fret_normal *n) {
    return fret_normal_closed(n);
}

bool fret_normal_swings(const fret_normal *normal) {
    return !fret_gap_sampled(&normal->gap);
}

fret_real fret_normal_end(const fret_normal *n) {
    return n->end;
}

fret_real fret_normal_profile(const fret_normal *n, fret_real x) {
    x = fabsl(x);
    if (!(x <= n->end && isfinite(x)))
        return (fret_real)NAN;
    if (!(x > fret_gap_start(&n->gap)))
        return 0;
    if (!n->cells)
        return fret_gap_profile(&n->gap, &n->rule, x).g;
    const fret_place p = fret_cells_at(n->cells, x);
    return fret_cells_level(n->cells, BY_DEPTH, &p);
}

fret_status fret_contact_check(const fret_pressed *contact) {
    fret_status st = fret_check_positive("mu", contact->mu);
    if (!st.code)
        st = fret_check_positive("FN", (double)contact->press.F);
    return st;
}

fret_real fret_normal_stiffness(const fret_normal *n, fret_real a) {
    const fret_foundation *f = &n->foundation;
    return a > 0 ? 2 * f->cN0 * a * fret_pow(a / f->c0, f->k) / (1 + f->k)
                 : 0; /* k < 0: not 0 times infinity */
}

static bool too_large(const fret_press *p) {
    return !(p->F <= DBL_MAX && p->dz <= DBL_MAX && p->a <= DBL_MAX);
}

static bool too_small(const fret_press *p) {
    return !(p->F >= DBL_MIN && p->dz >= DBL_MIN && p->a >= DBL_MIN) && (p->F != 0 || p->dz != 0);
}

/* Refuses a state that doubles cannot hold. */
static fret_status finish(const fret_press *p, fret_press *out) {
    const bool large = too_large(p);
    if (large || too_small(p))
        return fret_fail(FRET_OVERFLOW, NULL, (double)p->F, large ? DBL_MAX : DBL_MIN);
    *out = *p;
    return fret_ok();
}

static fret_status beyond_end(const fret_normal *n, const char *name, double value) {
    const bool falls = n->cells->falls;
    return fret_fail(falls ? FRET_NOT_MONOTONE : FRET_TABLE_SHORT, falls ? "r" : name,
                     falls ? (double)n->end : value, falls ? 0 : (double)n->end);
}

/* The state by force or depth, by cells. */
static fret_status by_cells(const fret_normal *n, bool by_force, double value, fret_press *out) {
    const fret_point p = by_force ? fret_law_at_force(n, value) : fret_law_at_depth(n, value);
    if (isnan(p.a))
        return beyond_end(n, by_force ? "FN" : "dz", value);
    return finish(&(fret_press){.F = p.F, .dz = p.y, .a = p.a}, out);
}

fret_status fret_press_by_force(const fret_normal *n, double F, fret_press *out) {
    fret_status st = fret_check_not_negative("FN", F);
    if (st.code)
        return st;
    fret_press s = {.F = F};
    if (F > 0 && fret_normal_closed(n)) {
        dd l = dd_sub(fret_dd_log(dd_of(F)), n->wide.ln_force);
        dd dz = fret_dd_exp(dd_add(n->wide.ln_depth, dd_mul(n->wide.q, l)));
        s.a = fret_dd_exp_real(dd_add(n->wide.ln_r0, dd_div(l, n->wide.s)));
        s.dz = dd_value(dz);
        s.dz_rest = dd_rest(dz);
        return finish(&s, out);
    }
    return by_cells(n, true, F, out);
}

fret_status fret_press_by_depth(const fret_normal *n, double dz, fret_press *out) {
    fret_status st = fret_check_not_negative("dz", dz);
    if (st.code)
        return st;
    fret_press s = {.dz = dz};
    if (dz > 0 && fret_normal_closed(n)) {
        dd l = dd_sub(fret_dd_log(dd_of(dz)), n->wide.ln_depth);
        dd F = fret_dd_exp(dd_add(n->wide.ln_force, dd_mul(n->wide.p, l)));
        s.a = fret_dd_exp_real(dd_add(n->wide.ln_r0, dd_div(l, dd_of(n->gap.power[0].n))));
        s.F = dd_value(F);
        s.F_rest = dd_rest(F);
        return finish(&s, out);
    }
    return by_cells(n, false, dz, out);
}

fret_status fret_press_by_radius(const fret_normal *n, double a, fret_press *out) {
    fret_status st = fret_check_not_negative("a", a);
    if (st.code)
        return st;
    fret_press s = {.a = a};
    if (a > 0 && fret_normal_closed(n)) {
        dd l = dd_sub(fret_dd_log(dd_of(a)), n->wide.ln_r0);
        dd F = fret_dd_exp(dd_add(n->wide.ln_force, dd_mul(n->wide.s, l)));
        dd dz = fret_dd_exp(dd_add(n->wide.ln_depth, dd_mul_d(l, n->gap.power[0].n)));
        s = (fret_press){dd_value(F), dd_value(dz), a, dd_rest(F), dd_rest(dz)};
        return finish(&s, out);
    }
    const fret_real e = a - fret_gap_start(&n->gap);
    if (e < 0 || (e == 0 && fret_normal_punch(n)))
        return fret_fail(FRET_OUTSIDE, "a", a, (double)fret_gap_start(&n->gap));
    if (a > n->end)
        return beyond_end(n, "a", a);
    if (e > 0) {
        const fret_place p = fret_cells_at(n->cells, a);
        s.F = n->stiff * fret_cells_level(n->cells, BY_LOAD, &p);
        s.dz = fret_cells_level(n->cells, BY_DEPTH, &p);
    }
    return finish(&s, out);
}
