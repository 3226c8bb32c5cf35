/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Pressure, traction and surface displacements of a state: closed forms within the head of the gap, sums
 * over rings beyond it. Allocates and frees fields; uses `law`, `history` and `number`. */
#include "field/field.h"

#include <float.h>
#include <stdlib.h>

#include "field/powers.h"
#include "law/check.h"
#include "number/real.h"

/* A steep power g = G (x/a)^n matters only in the outer a/n of the contact, and its series in the radius
 * converge slowly: rings sum it instead. */
static const double STEEP = 20; /* the least steep n */

/* The powers of the profile within a contact of radius a, without the steep ones; returns their number. */
static int head_terms(const fret_normal *n, fret_real a, fret_term term[FRET_MOST_TERMS]) {
    const int all = fret_gap_series(&n->gap, &n->rule, a, term);
    int gentle = 0;
    if (fret_gap_powers(&n->gap) == 0)
        return all;
    for (int i = 0; i < all; i++)
        if (term[i].n < STEEP)
            term[gentle++] = term[i];
    return gentle;
}

/* Allocates a field with room for `slices` slices. */
static fret_status begin(const fret_normal *n, double mu, int loads, size_t slices, fret_field **out) {
    fret_field *f = calloc(1, sizeof *f);
    slice *s = f ? calloc(slices + 1, sizeof *s) : NULL;
    *out = s ? f : NULL;
    if (!s) {
        free(f);
        return fret_fail(FRET_NO_MEMORY, NULL, 0, 0);
    }
    const fret_foundation *of = &n->foundation;
    const fret_real away = (1 - fabsl(of->k)) / 2;
    *f = (fret_field){.normal = n, .mu = mu, .loads = loads, .slice = s};
    f->of_slope = of->cN0 * fret_pow(of->c0, -of->k) / FRET_PI;
    f->of_depth = 2 / FRET_PI * (fabsl(of->k) <= 0.5L ? cosl(FRET_PI * of->k / 2) : sinl(FRET_PI * away));
    fret_kernel_flat_make(&f->flat, (of->k + 1) / 2);
    return fret_ok();
}

/* Skips a slice whose radius underflows to 0. */
static void add_slice(fret_field *f, fret_real y, fret_real sigma) {
    const fret_real a = fret_law_radius(f->normal, y);
    if (a > 0)
        f->slice[f->slices++] = (slice){y, a, {1, sigma}};
}

static fret_status add_steep(fret_field *f, const slice *last) {
    fret_term term[FRET_MOST_TERMS];
    const int terms = fret_gap_powers(&f->normal->gap) > 0
                          ? fret_gap_series(&f->normal->gap, &f->normal->rule, last->a, term)
                          : 0;
    fret_status st = fret_ok();
    for (int i = 0; i < terms && !st.code; i++) {
        if (term[i].n < STEEP)
            continue;
        if (terms == 1)
            term[i].G = last->y;
        st = fret_rings_make(f->normal, 0, &term[i], f->slice, f->slices, f->loads, &f->sum[f->sums]);
        f->sums += !st.code;
    }
    return st;
}

static fret_real weight_at(const fret_field *f, int load, size_t i) {
    return weight_of(f->slice, f->slices, load, i);
}

/* The head ends at the law's second cell: it is empty if the end is flat, and all of a power law. */
static void find_head(fret_field *f) {
    const fret_normal *n = f->normal;
    const fret_cells *cells = n->cells;
    const bool flat = fret_gap_start(&n->gap) > 0;
    const bool more = cells && cells->count > 1;
    f->head = flat ? 0 : more ? cells->cell[1].x : (fret_real)INFINITY;
    f->head_depth = !flat && more ? cells->cell[1].y : 0;
    for (size_t i = 0; i < f->slices && flat && !(fret_law_distance(n, f->slice[i].y) > 0); i++)
        for (int load = 0; load < LOADS; load++)
            f->punch[load] += (weight_at(f, load, i) - weight_at(f, load, i + 1)) * f->slice[i].y;
    while (f->heads < f->slices && !flat && (!more || f->slice[f->heads].y <= f->head_depth))
        f->heads++;
}

/* Makes the rings of a field whose slices are complete; frees the field on error. */
static fret_status finish(fret_field *f, fret_status st, fret_field **out) {
    find_head(f);
    const slice *last = f->slices > 0 ? &f->slice[f->slices - 1] : NULL;
    if (!st.code && last)
        st = add_steep(f, last);
    if (!st.code && f->heads < f->slices && !fret_normal_punch(f->normal)) {
        st = fret_rings_make(f->normal, f->head > 0, NULL, f->slice, f->slices, f->loads, &f->sum[f->sums]);
        f->sums += !st.code;
    }
    st = fret_unless_stopped(f->normal, st);
    if (st.code) {
        fret_field_free(f);
        *out = NULL;
    }
    return st;
}

fret_status fret_field_of_press(const fret_normal *n, const fret_press *press, fret_field **out) {
    const fret_real most = n->cells ? n->cells->most[BY_DEPTH] : (fret_real)INFINITY;
    fret_status st = fret_check_not_negative("dz", (double)press->dz);
    *out = NULL;
    if (!st.code)
        st = fret_check_not_negative("a", (double)press->a);
    if (!st.code && !fret_cells_reach(most, press->dz))
        st = fret_fail(FRET_OUTSIDE, "dz", (double)press->dz, (double)most);
    if (!st.code)
        st = begin(n, 0, 1, 1, out);
    if (st.code)
        return st;
    if (press->dz > 0)
        add_slice(*out, press->dz, 0);
    if ((*out)->slices > 0 && press->a > fret_gap_start(&n->gap))
        (*out)->slice->a = press->a;
    return finish(*out, st, out);
}

void fret_field_part(const fret_field *f, slice *end, fret_field *out) {
    *out = *f;
    out->slice = end;
    out->end = end;
}

void fret_field_cut(const fret_field *f, fret_real depth, fret_field *part) {
    part->slices = part->heads = 0;
    part->punch[PRESSED] = 0;
    if (depth > 0)
        add_slice(part, fminl(depth, f->slice->y), 0);
    find_head(part);
}

/* (dP-dM)/(dP+dM) */
static fret_real slope_of(const arc *p) {
    const fret_real m = p->last[M] - p->first[M], up = p->last[P] - p->first[P];
    return m + up > 0 ? (up - m) / (m + up) : 0;
}

/* Straight arcs become slices. Curved arcs are copied, and their slices get slope 0. */
static fret_status make_of_swing(const fret_swing *c, fret_field **out) {
    fret_status st = begin(c->normal, c->mu, LOADS, c->count, out);
    if (st.code)
        return st;
    fret_field *f = *out;
    f->swung = *c;
    f->swung.count = 0;
    f->swung.arcs = calloc(c->count + 1, sizeof *c->arcs);
    if (!f->swung.arcs)
        st = fret_fail(FRET_NO_MEMORY, NULL, 0, 0);
    for (size_t i = 0; i < c->count && !st.code; i++) {
        const arc *p = &c->arcs[i];
        add_slice(f, fret_law_depth(c->normal, (p->last[M] + p->last[P]) / 2), p->curved ? 0 : slope_of(p));
        if (p->curved)
            f->swung.arcs[f->swung.count++] = *p;
    }
    f->slid = c->slid;
    return finish(f, st, out);
}

fret_status fret_field_make(const fret_contact *c, fret_field **out) {
    fret_segment s;
    size_t slices = 0;
    *out = NULL;
    if (c->diagram)
        return fret_fail(FRET_OUTSIDE, "exactness", 0, 0);
    if (c->curved) {
        fret_state now;
        const fret_status st = make_of_swing(c->swing, out);
        fret_contact_forces(c, &now);
        if (!st.code)
            (*out)->dx = now.dx;
        return st;
    }
    while (fret_contact_segment(c, slices, &s))
        slices++;
    fret_status st = begin(c->normal, c->mu, LOADS, slices, out);
    if (!st.code)
        (*out)->slid = c->memory->slid;
    for (size_t i = 0; !st.code && fret_contact_segment(c, i, &s) && !fret_stopped(c->normal); i++)
        add_slice(*out, s.outer, s.sigma);
    return st.code ? st : finish(*out, st, out);
}

void fret_field_free(fret_field *f) {
    if (!f)
        return;
    for (size_t i = 0; i < f->sums; i++)
        fret_rings_free(f->sum[i]);
    free(f->swung.arcs);
    free(f->slice);
    free(f);
}

double fret_field_error(const fret_field *f) {
    static const double rounding = 1e-15;
    return f->heads < f->slices ? (double)f->normal->cells->error + rounding : (double)NAN;
}

/* ---- pressure and traction --------------------------------------------------------------------- */

bool fret_field_infinite(const fret_normal *n, fret_real r) {
    const fret_real start = fret_gap_start(&n->gap), k = n->foundation.k;
    return r == start && (start > 0 ? fret_gap_sharp(&n->gap) && (k <= 0 || fret_normal_punch(n))
                                    : fret_gap_tip(&n->gap) + k <= 1);
}

/* The share of the head, if r lies in it, and of slices that are flat punches (field.h, `punch`). */
static fret_real head_slope(const fret_field *f, int load, fret_real r) {
    const fret_real start = fret_gap_start(&f->normal->gap), k = f->normal->foundation.k;
    fret_term term[FRET_MOST_TERMS];
    fret_real sum = 0;
    if (f->punch[load] != 0 && r < start)
        sum = f->punch[load] * fret_pow((start - r) * (start + r), (k - 1) / 2);
    for (size_t i = 0; i <= f->heads && i < f->slices && r < f->head; i++) {
        const bool within = i < f->heads;
        const fret_real a = within ? f->slice[i].a : f->head,
                        weight = weight_at(f, load, i) - (within ? weight_at(f, load, i + 1) : 0);
        if (weight != 0 && r < a)
            sum += weight * fret_powers_slope(term, head_terms(f->normal, a, term), k, a, r);
    }
    return sum;
}

/* The sum at the tip by slices: finite if the innermost slice has no slope, unlike that of a contact. */
static fret_real tip_slope(const fret_field *f, int load) {
    fret_term term[FRET_MOST_TERMS];
    fret_real sum = 0;
    for (size_t i = 0; i <= f->heads && i < f->slices; i++) {
        const fret_real b = i > 0 ? f->slice[i - 1].a : 0, a = i < f->heads ? f->slice[i].a : f->head;
        if (weight_at(f, load, i) != 0 && a > b)
            sum += weight_at(f, load, i) *
                   fret_powers_ring(term, head_terms(f->normal, a, term), f->normal->foundation.k, a, b);
    }
    return sum;
}

static bool any_weight(const fret_field *f, int load) {
    for (size_t i = 0; i < f->slices; i++)
        if (weight_at(f, load, i) != 0)
            return true;
    return false;
}

/* int sigma g' (x^2-r^2)^((k-1)/2) dx. At a sharp edge this is finite only if the innermost slice has no
 * slope and its radius differs from that of the edge. */
static fret_status slope_sum(const fret_field *f, int load, fret_real r, fret_real *sum) {
    const fret_normal *n = f->normal;
    const bool flat = fret_gap_start(&n->gap) > 0, infinite = fret_field_infinite(n, r);
    fret_status st = fret_check_not_negative("r", (double)r);
    *sum = 0;
    if (st.code || !any_weight(f, load) || (!flat && r >= f->slice[f->slices - 1].a))
        return fret_unless_stopped(n, st);
    if (infinite && (weight_at(f, load, 0) != 0 || (flat && !(fret_law_distance(n, f->slice[0].y) > 0))))
        return fret_fail(FRET_SINGULAR, "r", (double)r, 0);
    *sum = r == 0 && !flat ? tip_slope(f, load) : head_slope(f, load, r);
    for (size_t i = 0; i < f->sums; i++)
        *sum += fret_rings_slope(f->sum[i], load, r, f->end);
    return fret_unless_stopped(n, isfinite(*sum) ? st : fret_fail(FRET_SINGULAR, "r", (double)r, 0));
}

fret_status fret_field_pressure(const fret_field *f, fret_real r, fret_real *p) {
    const fret_status st = slope_sum(f, PRESSED, r, p);
    *p *= f->of_slope;
    return st;
}

fret_status fret_field_traction(const fret_field *f, fret_real r, fret_real *q) {
    fret_status st = slope_sum(f, DRAGGED, r, q);
    if (!st.code && f->swung.count > 0)
        *q += fret_swing_slope(&f->swung, r);
    *q *= f->mu * f->of_slope;
    return fret_unless_stopped(f->normal, st);
}

/* ---- surfaces ---------------------------------------------------------------------------------- */

/* What the head's gap takes from the displacement of a flat punch, the same in all larger contacts. */
static fret_real head_depth(const fret_field *f, fret_real r) {
    fret_term term[FRET_MOST_TERMS];
    const int terms = head_terms(f->normal, f->head, term);
    return f->head_depth * fret_kernel_flat(&f->flat, f->head, r) -
           fret_powers_surface(term, terms, &f->flat, f->head_depth, f->head, r);
}

/* int x^k w (r^2-x^2)^(-(1+k)/2) dx of the contact that ends with slice i, inside r, without its rings.
 * *head caches head_depth; NAN until it is computed. */
static fret_real contact_depth(const fret_field *f, size_t i, fret_real r, fret_real *head) {
    const slice *s = &f->slice[i];
    fret_term term[FRET_MOST_TERMS];
    if (i < f->heads)
        return fret_powers_surface(term, head_terms(f->normal, s->a, term), &f->flat, s->y, s->a, r);
    if (isnan(*head))
        *head = f->head > 0 ? head_depth(f, r) : 0;
    return s->y * fret_kernel_flat(&f->flat, s->a, r) - *head;
}

/* Slices that end beyond r share the gap f(r) there; each slice inside r counts by the difference of its
 * weight from the next. left: sums depth - displacement instead of the displacement. */
static fret_status depth_sum(const fret_field *f, int load, fret_real r, bool left, fret_real *sum) {
    fret_status st = fret_check_not_negative("r", (double)r);
    fret_real head = (fret_real)NAN, gap = 0, outside = 0, depth = 0;
    size_t end = 0;
    *sum = 0;
    if (st.code || !any_weight(f, load))
        return fret_unless_stopped(f->normal, st);
    while (end < f->slices && f->slice[end].a < r)
        end++;
    for (size_t i = 0; i < end; i++) {
        const fret_real weight = weight_at(f, load, i) - weight_at(f, load, i + 1);
        if (weight != 0)
            outside += weight * contact_depth(f, i, r, &head);
        depth += weight * f->slice[i].y;
    }
    for (size_t i = 0; i < f->sums && end > 0; i++)
        outside -= fret_rings_depth(f->sum[i], load, r, end, f->end);
    if (end < f->slices) {
        st = fret_gap_f(&f->normal->gap, r, &gap);
        *sum = weight_at(f, load, end) * (left ? gap : f->slice[end].y - gap);
    }
    for (size_t i = end + 1; i < f->slices && !left; i++)
        *sum += weight_at(f, load, i) * (f->slice[i].y - f->slice[i - 1].y);
    *sum += left ? depth - f->of_depth * outside : f->of_depth * outside;
    return fret_unless_stopped(f->normal, st);
}

fret_status fret_field_surface(const fret_field *f, fret_real r, fret_real *w) {
    return depth_sum(f, PRESSED, r, false, w);
}

fret_status fret_field_left(const fret_field *f, fret_real r, fret_real *left) {
    return depth_sum(f, PRESSED, r, true, left);
}

fret_status fret_field_surface_x(const fret_field *f, fret_real r, fret_real *u) {
    const fret_status st = depth_sum(f, DRAGGED, r, false, u);
    if (!st.code && f->swung.count > 0)
        *u += fret_swing_surface(&f->swung, &f->flat, f->of_depth, r);
    *u *= f->mu * f->normal->foundation.eta;
    return fret_unless_stopped(f->normal, st);
}

/* delta_x - u_x from the depths `left`: a difference would not be exactly 0 where nothing slips. */
fret_status fret_field_slip(const fret_field *f, fret_real r, fret_real *s) {
    fret_status st;
    if (f->swung.count > 0) {
        st = fret_field_surface_x(f, r, s);
        *s = f->dx - *s;
    } else {
        st = depth_sum(f, DRAGGED, r, true, s);
        *s = f->slid + f->mu * f->normal->foundation.eta * *s;
    }
    return st;
}
