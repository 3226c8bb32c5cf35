/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The limit of wear in closed form (fret_wear_limit): a contact that ends at the stick radius c, and outside
 * of c surfaces that touch without pressure. Allocates its field; uses `field`, `law` and `number`. */
#include "wear/limit.h"

#include <math.h>

#include "law/check.h"
#include "law/normal.h"
#include "number/integral.h"
#include "number/least.h"
#include "number/real.h"

/* ---- what sticks ------------------------------------------------------------------------------- */

typedef struct search {
    const fret_normal *normal;
    fret_real held, other; /* F_N and delta_A/(mu eta), or delta_z and F_A/mu */
} search;

/* F_N less the force of a contact of depth y that is pressed deeper by `other` without growing. */
static fret_real short_of_load(fret_real y, fret_real *slope, void *context) {
    const search *s = context;
    const fret_point at = fret_law_at_depth(s->normal, y);
    (void)slope;
    return s->held - at.F - at.K * s->other;
}

/* (F_A - F_x)/mu of a contact that sticks up to the depth y and is dragged by mu eta (delta_z - y). */
static fret_real short_of_drag(fret_real y, fret_real *slope, void *context) {
    const search *s = context;
    (void)slope;
    return s->other - fret_law_at_depth(s->normal, y).K * (s->held - y);
}

static fret_status gross(const fret_wear_held *held, fret_real most) {
    return fret_fail(FRET_GROSS_SLIP, held->by_displacement ? "dA" : "FA", held->amplitude, (double)most);
}

/* Finds the depth y at the stick radius, and delta_z. */
static fret_status find_stuck(const fret_wear_held *held, fret_wear_end *e) {
    const fret_normal *n = e->normal;
    const fret_real eta = fret_normal_foundation(n)->eta, mu = held->mu,
                    drag = held->amplitude / (held->by_displacement ? mu * eta : mu);
    search s = {n, held->by_depth ? e->depth : held->press, drag};
    if (held->by_displacement && held->by_depth) {
        e->y = e->depth - drag;
        if (!(e->y > 0))
            return gross(held, mu * eta * e->depth);
    } else if (held->by_displacement) {
        const fret_real most = fret_law_depth(n, s.held);
        /* K grows with the depth, so that without gross slip the load is short at first. With it the tip
         * wears as well. */
        if (!(drag < most && short_of_load(most * 1e-18L, NULL, &s) > 0))
            return gross(held, mu * eta * most);
        e->y = fret_root(short_of_load, &s, most * 1e-18L, most, most / 2);
        e->depth = e->y + drag;
    } else if (held->by_depth) {
        const fret_real best = fret_least(short_of_drag, &s, 0, s.held, s.held / 2, 1e-9L);
        if (!(short_of_drag(best, NULL, &s) < 0))
            return gross(held, mu * (s.other - short_of_drag(best, NULL, &s)));
        e->y = fret_root(short_of_drag, &s, best, s.held, s.held);
    } else {
        e->y = s.held > drag ? fret_law_depth(n, s.held - drag) : 0;
        if (!(e->y > 0))
            return gross(held, mu * s.held);
        e->depth = e->y + drag / fret_law_at_depth(n, e->y).K;
    }
    return fret_ok();
}

/* ---- the profile ------------------------------------------------------------------------------- */

/* f - f_0 at r > c: the gap outside a contact that ends at c, pressed deeper like a flat punch. */
static fret_status worn(const fret_wear_end *e, fret_real r, fret_real *h) {
    const fret_field *f = e->field;
    fret_real left, gap;
    fret_status st = fret_field_left(f, r, &left);
    if (!st.code)
        st = fret_gap_f(&e->normal->gap, r, &gap);
    if (!st.code)
        *h = left - gap + (e->depth - e->y) * (1 - f->of_depth * fret_kernel_flat(&f->flat, e->c, r));
    return st;
}

fret_status fret_wear_end_depth(const fret_wear_end *e, fret_real r, fret_real *h) {
    *h = 0;
    const fret_status st = r > e->c && r < e->b ? worn(e, r, h) : fret_ok();
    *h = fmaxl(*h, 0);
    return st;
}

static fret_real depth_at(fret_real r, fret_real *slope, void *context) {
    fret_real h = 0;
    (void)slope;
    (void)worn(context, r, &h); /* succeeds within the gap */
    return h;
}

static fret_real volume_at(fret_real t, fret_real rest, void *context) {
    const fret_wear_end *e = context;
    const fret_real span = (e->b - e->c) * (e->b + e->c), r = sqrtl(e->c * e->c * rest + e->b * e->b * t);
    return r > e->c && r < e->b ? FRET_PI * span * depth_at(r, NULL, context) : 0;
}

fret_status fret_wear_end_volume(const fret_wear_end *e, fret_real *volume) {
    *volume = e->b > e->c ? fret_integral(volume_at, (void *)e, 1e-16L).value : 0;
    return fret_unless_stopped(e->normal, fret_ok());
}

/* Where the worn surface meets the unworn one. */
static fret_status find_rim(fret_wear_end *e) {
    const fret_real end = fret_gap_end(&e->normal->gap);
    fret_real lo = fminl(fret_law_radius(e->normal, e->depth), end), hi = lo;
    if (!(e->depth > e->y)) {
        e->b = e->c;
        return fret_ok();
    }
    while (hi < end && depth_at(hi, NULL, e) > 0 && isfinite(hi)) {
        lo = hi;
        hi = fminl(e->c + 2 * (hi - e->c), end);
    }
    if (depth_at(hi, NULL, e) > 0)
        return fret_fail(FRET_TABLE_SHORT, "r", (double)hi, (double)end);
    e->b = hi > lo ? fret_root(depth_at, e, lo, hi, lo) : hi;
    return fret_ok();
}

fret_status fret_wear_end_make(const fret_normal *normal, const fret_wear_held *held, fret_wear_end *out) {
    *out = (fret_wear_end){.normal = normal, .depth = held->press};
    fret_status st = find_stuck(held, out);
    const fret_press press = {.dz = out->y};
    if (st.code)
        return st;
    out->c = fret_law_radius(normal, out->y);
    out->F = fret_law_force(normal, out->y);
    st = fret_field_of_press(normal, &press, &out->field);
    if (!st.code)
        st = find_rim(out);
    if (!st.code)
        st = fret_unless_stopped(normal, st);
    if (st.code)
        fret_wear_end_free(out);
    return st;
}

void fret_wear_end_free(fret_wear_end *e) {
    fret_field_free(e->field);
    e->field = NULL;
}
