/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Fields at many places: all slices of a state at once by the profile as polynomials, or by the rows of a
 * table of many, and what lies beyond the edges; made when they are first asked for. Allocates them. */
#include <stdlib.h>

#include "field/density.h"
#include "field/field.h"
#include "fret/field.h"
#include "law/cells.h"
#include "law/check.h"
#include "number/real.h"

struct fret_fields {
    const fret_normal *normal;         /* borrowed */
    fret_real of_pressure, of_surface; /* what fields are of their integrals */
    struct fret_density *density;
    fret_real reach;    /* the radius that was asked for; 0: none was */
    fret_real a, dz;    /* the contact asked last, and its depth */
    size_t count, room; /* slices, those asked last */
    fret_cut *cut;      /* their radii and slopes */
    fret_real *depth;   /* and depths */
};

fret_status fret_fields_make(const fret_normal *n, fret_fields **out) {
    *out = calloc(1, sizeof **out);
    if (!*out)
        return fret_fail(FRET_NO_MEMORY, NULL, 0, 0);
    (*out)->normal = n;
    (*out)->of_pressure = n->foundation.cN0 * fret_pow(n->foundation.c0, -n->foundation.k) / FRET_PI;
    (*out)->of_surface = fret_field_surface_factor(n->foundation.k);
    return fret_ok();
}

void fret_fields_free(fret_fields *f) {
    if (f) {
        fret_density_free(f->density);
        free(f->cut);
        free(f->depth);
    }
    free(f);
}

double fret_fields_error(const fret_fields *f) {
    static const double rounding = 1e-15;
    fret_real worst = f->density ? fret_density_error(f->density) : 0;
    return f->density ? (double)worst + rounding : NAN;
}

/* Are there polynomials for a contact of radius a? Up to the next power of two, so that what comes out does
 * not depend on what was asked before; a gap that is a series wants none. */
static fret_status prepare(fret_fields *f, fret_real a, bool *there) {
    const fret_normal *n = f->normal;
    const fret_real last = (n->cells && n->cells->falls ? 0.99L : 1) * n->end;
    fret_term term[FRET_MOST_TERMS];
    int exponent;
    (void)frexpl(a, &exponent);
    const fret_real end = fminl(ldexpl(1, exponent), last);
    *there = false;
    if (a > end || fret_gap_series(&n->gap, &n->rule, a, term) > 0)
        return fret_ok();
    if (end != f->reach) {
        fret_density_free(f->density);
        f->reach = 0;
        const fret_status st = fret_density_make(n, end, &f->density);
        if (st.code)
            return st;
        f->reach = end;
    }
    *there = f->density != NULL;
    return fret_ok();
}

/* Places where the field is asked for as ever: outside, at a sharp edge, or where it may be infinite. */
static bool is_special(const fret_normal *n, fret_real a, fret_real r) {
    const fret_real start = fret_gap_start(&n->gap);
    return !(r >= 0) || r >= a || a <= start || (r == start && fret_gap_sharp(&n->gap)) ||
           fret_field_infinite(n, r);
}

/* The pressure from where the polynomials begin. */
static fret_real pressure_beyond(const fret_fields *f, const fret_cut *cut, size_t count, fret_real r) {
    return f->of_pressure * fret_density_pressure(f->density, cut, count, r);
}

fret_status fret_fields_pressure(fret_fields *f, fret_real a, fret_real r, fret_real *p) {
    const fret_cut cut = {a, 1};
    bool there = false;
    fret_status st = fret_field_check(f->normal, a, r);
    if (st.code)
        return st;
    *p = 0;
    st = is_special(f->normal, a, r) ? fret_ok() : prepare(f, a, &there);
    if (st.code)
        return st;
    if (!there)
        return fret_pressure(f->normal, a, r, p);
    if (r < fret_density_from(f->density) && fret_gap_start(&f->normal->gap) <= 0)
        st = fret_pressure(f->normal, fret_density_from(f->density), r, p);
    *p += pressure_beyond(f, &cut, 1, r);
    return st;
}

/* Of r > a, the contact y deep, all but what the polynomials give; added to *w. head: what a table has within
 * its first row, the same for all contacts beyond that; NAN: not known yet. */
static fret_status surface_but(const fret_fields *f, fret_real a, fret_real y, fret_real r, fret_real weight,
                               fret_real *head, fret_real *w) {
    const fret_normal *n = f->normal;
    const fret_real from = fret_density_from(f->density), factor = f->of_surface;
    const bool flat = fret_gap_start(&n->gap) > 0;
    fret_status st = fret_ok();
    if (!flat && a <= from) {
        fret_real inner = 0;
        st = fret_surface(n, a, r, &inner);
        *w += weight * inner;
        return st;
    }
    if (flat) {
        *head = 0;
    } else if (isnan(*head)) {
        const fret_real depth = fret_density_from_depth(f->density);
        st = fret_field_surface(n, from, depth, r, head);
        *head -= factor * depth * fret_density_flat(f->density, from, r);
    }
    *w += weight * (factor * y * fret_density_flat(f->density, a, r) + *head);
    return st;
}

/* The depth of a contact, which places have in common. */
static fret_real depth_of(fret_fields *f, fret_real a) {
    if (a != f->a) {
        f->a = a;
        f->dz = fret_normal_profile(f->normal, a);
    }
    return f->dz;
}

fret_status fret_fields_surface(fret_fields *f, fret_real a, fret_real r, fret_real *w) {
    const fret_normal *n = f->normal;
    const fret_cut cut = {a, 1};
    bool there = false;
    fret_status st = fret_field_check(n, a, r);
    if (st.code)
        return st;
    *w = 0;
    if (r <= a && a > fret_gap_start(&n->gap) && fret_gap_sampled(&n->gap))
        return fret_field_surface(n, a, depth_of(f, a), r, w);
    const bool outside = r > a && a > fret_gap_start(&n->gap);
    st = outside ? prepare(f, a, &there) : fret_ok();
    if (st.code)
        return st;
    if (!there)
        return fret_surface(n, a, r, w);
    fret_real head = NAN;
    st = surface_but(f, a, depth_of(f, a), r, 1, &head, w);
    *w -= f->of_surface * fret_density_surface(f->density, &cut, 1, r);
    return st;
}

fret_status fret_fields_pressure_of(fret_fields *f, const fret_press *at, fret_real r, fret_real *p) {
    return fret_field_light(f->normal, at->a) ? fret_pressure_of(f->normal, at, r, p)
                                              : fret_fields_pressure(f, at->a, r, p);
}

fret_status fret_fields_surface_of(fret_fields *f, const fret_press *at, fret_real r, fret_real *w) {
    return fret_field_light(f->normal, at->a) ? fret_surface_of(f->normal, at, r, w)
                                              : fret_fields_surface(f, at->a, r, w);
}

/* The slices of a state: what was known of them is kept where they are the same. */
static fret_status take_slices(fret_fields *f, const fret_contact *c) {
    const fret_normal *law = fret_contact_normal(c);
    fret_segment s;
    size_t i = 0;
    for (; fret_contact_segment(c, i, &s); i++) {
        if (i == f->room) {
            const size_t room = 2 * f->room + 8;
            fret_cut *cut = realloc(f->cut, room * sizeof *cut);
            f->cut = cut ? cut : f->cut;
            fret_real *depth = cut ? realloc(f->depth, room * sizeof *depth) : NULL;
            if (!depth)
                return fret_fail(FRET_NO_MEMORY, NULL, 0, 0);
            f->depth = depth;
            f->room = room;
        }
        if (i >= f->count || f->depth[i] != s.outer) {
            f->depth[i] = s.outer;
            f->cut[i].a = fret_law_radius(law, s.outer);
            f->count = i + 1;
            if (fret_stopped(law)) {
                f->count = i;
                return fret_unless_stopped(law, fret_ok());
            }
        }
        f->cut[i].weight = s.sigma;
    }
    f->count = i;
    return fret_ok();
}

/* A slice that counts ends right next to a flat end, where its depth tells more than its radius. Of a table,
 * where depth begins as a higher power there, such a slice counts where there is nothing else. */
static bool any_light(const fret_fields *f) {
    if (fret_gap_sampled(&f->normal->gap))
        return f->count > 0 && fret_field_light(f->normal, f->cut[f->count - 1].a);
    for (size_t i = 0; i < f->count && fret_field_light(f->normal, f->cut[i].a); i++)
        if (f->cut[i].weight != (i + 1 < f->count ? f->cut[i + 1].weight : 0))
            return true;
    return false;
}

/* No slice has a slope: nothing has been displaced. */
static bool undisplaced(const fret_fields *f) {
    size_t i = 0;
    while (i < f->count && f->cut[i].weight == 0)
        i++;
    return i == f->count;
}

/* Is r a tip that the traction takes no part of: within a core without a slope, which is more than the first
 * row? */
static bool is_spared(const fret_fields *f, fret_real r) {
    const fret_normal *n = f->normal;
    fret_term term[FRET_MOST_TERMS];
    return r == 0 && fret_gap_start(&n->gap) <= 0 && f->count > 0 && f->cut[0].weight == 0 &&
           fret_gap_series(&n->gap, &n->rule, f->cut[0].a, term) == 0;
}

/* Slices: are there polynomials for all of them? */
static fret_status prepare_slices(fret_fields *f, const fret_contact *c, bool *there) {
    *there = false;
    const fret_status st = take_slices(f, c);
    if (st.code || undisplaced(f) || any_light(f))
        return st;
    return prepare(f, f->cut[f->count - 1].a, there);
}

fret_status fret_fields_traction(fret_fields *f, const fret_contact *c, fret_real r, fret_real *q) {
    bool there;
    *q = 0;
    if (c->curved || c->diagram)
        return fret_traction(c, r, q);
    fret_status st = prepare_slices(f, c, &there);
    if (st.code)
        return st;
    const fret_real a = f->count > 0 ? f->cut[f->count - 1].a : 0;
    if (f->count > 0 && r >= a)
        return fret_ok();
    const bool spared = is_spared(f, r);
    if (!there || (!spared && is_special(f->normal, a, r)))
        return fret_traction(c, r, q);
    const fret_real from = fret_density_from(f->density);
    if (!spared && r < from && fret_gap_start(&f->normal->gap) <= 0) {
        fret_real inner = 0, outer = 0;
        for (size_t i = 0; i < f->count && !st.code && (i == 0 || f->cut[i - 1].a < from); i++) {
            st = fret_pressure(f->normal, fminl(f->cut[i].a, from), r, &outer);
            *q += f->cut[i].weight * (outer - inner);
            inner = outer;
        }
    }
    *q = fret_contact_friction(c) * (*q + pressure_beyond(f, f->cut, f->count, r));
    return st;
}

/* Of the slices that end inside of r, from polynomials; rest: the slope beyond them. */
static fret_status surface_x_from_density(const fret_fields *f, size_t outside, fret_real rest, fret_real r,
                                          fret_real *sum) {
    fret_real head = NAN;
    fret_status st = fret_ok();
    for (size_t i = 0; i < outside && !st.code; i++) {
        const fret_real next = i + 1 < f->count ? f->cut[i + 1].weight : 0;
        st = surface_but(f, f->cut[i].a, f->depth[i], r, f->cut[i].weight - next, &head, sum);
    }
    for (size_t i = 0; i < outside; i++)
        f->cut[i].weight -= rest;
    if (outside > 0)
        *sum -= f->of_surface * fret_density_surface(f->density, f->cut, outside, r);
    for (size_t i = 0; i < outside; i++)
        f->cut[i].weight += rest;
    return st;
}

/* Slices that reach beyond r have the gap there, which all of them share. */
fret_status fret_fields_surface_x(fret_fields *f, const fret_contact *c, fret_real r, fret_real *u) {
    bool there;
    *u = 0;
    if (c->curved || c->diagram)
        return fret_surface_x(c, r, u);
    fret_status st = prepare_slices(f, c, &there);
    if (st.code)
        return st;
    if (!there || !(r >= 0))
        return fret_surface_x(c, r, u);
    size_t outside = 0;
    while (outside < f->count && f->cut[outside].a < r)
        outside++;
    fret_real sum = 0, gap = 0, rest = 0;
    if (outside < f->count) {
        rest = f->cut[outside].weight;
        (void)fret_gap_f(&f->normal->gap, r, &gap); /* which there is within the contact */
        sum = rest * (f->depth[outside] - gap);
    }
    for (size_t i = outside + 1; i < f->count; i++)
        sum += f->cut[i].weight * (f->depth[i] - f->depth[i - 1]);
    st = surface_x_from_density(f, outside, rest, r, &sum);
    *u = fret_contact_friction(c) * fret_contact_normal(c)->foundation.eta * sum;
    return st;
}
