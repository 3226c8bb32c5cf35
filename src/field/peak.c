/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The largest pressure, and the press that reaches a given pressure, by values of p. Uses `number`. */
#include <float.h>

#include "field/field.h"
#include "law/check.h"
#include "number/least.h"
#include "number/real.h"
#include "number/root.h"

/* The best place so far and its neighbours, as distances from the edge. */
typedef struct peak {
    const fret_field *field;
    fret_real a, inner, best, outer, p;
    fret_status st;
} peak;

static fret_real pressure_at(peak *k, fret_real e) {
    fret_real p = 0;
    const fret_status st = fret_field_pressure(k->field, fmaxl(k->a - e, 0), &p);
    if (st.code)
        k->st = st;
    return p;
}

/* Evaluates p at the distance e, whose neighbours are `inner` and `outer`. */
static void try_place(peak *k, fret_real inner, fret_real e, fret_real outer) {
    const fret_real p = pressure_at(k, e);
    if (p > k->p) {
        k->p = p;
        k->inner = inner;
        k->best = e;
        k->outer = outer;
    }
}

/* Places ever closer to the edge, where steep gaps and flat ends have their peak. */
static void try_all(peak *k) {
    static const fret_real CLOSER = 0.75L, CLOSE = 1e-16L;
    for (fret_real e = k->a, inner = k->a; e > CLOSE * k->a && !k->st.code; inner = e, e *= CLOSER)
        try_place(k, inner, e, CLOSER * e);
}

/* Places in every cell of the law, since any row of a table may be a bump. */
static void try_cells(peak *k) {
    enum { PARTS = 3 };
    const fret_cells *cells = k->field->normal->cells;
    for (size_t i = 0; cells && i < cells->count && cells->cell[i].x < k->a && !k->st.code; i++) {
        const fret_real from = k->a - cells->cell[i].x,
                        to = i + 1 < cells->count ? fmaxl(k->a - cells->cell[i + 1].x, 0) : 0,
                        part = (from - to) / (double)PARTS;
        for (int j = 0; j < PARTS; j++) {
            const fret_real e = from - part * (fret_real)j;
            try_place(k, fminl(e + part, k->a), e, e - part);
        }
    }
}

static fret_real less_pressure(fret_real e, fret_real *slope, void *context) {
    (void)slope;
    return 0 - pressure_at(context, e);
}

fret_status fret_field_peak(const fret_field *f, fret_real *r, fret_real *p) {
    peak k = {.field = f, .a = f->slices > 0 ? f->slice[f->slices - 1].a : 0, .st = fret_ok()};
    const fret_real start = fret_gap_start(&f->normal->gap);
    k.st = fret_field_pressure(f, start, p); /* the tip or a sharp edge, where p may have a cusp */
    try_all(&k);
    try_cells(&k);
    k.best = fret_least(less_pressure, &k, k.outer, k.inner, k.best, 1e-9L);
    k.p = pressure_at(&k, k.best);
    const bool cusp = *p > k.p;
    *p = cusp ? *p : k.p;
    if (r)
        *r = cusp ? start : k.a - k.best;
    return k.st;
}

/* ---- presses ----------------------------------------------------------------------------------- */

typedef fret_status pressure_of(const fret_normal *, const fret_press *, fret_real *p);

static fret_status mean_of(const fret_normal *n, const fret_press *press, fret_real *p) {
    (void)n;
    *p = press->F / (FRET_PI * press->a * press->a);
    return fret_ok();
}

static fret_status peak_of(const fret_normal *n, const fret_press *press, fret_real *p) {
    fret_field *f;
    fret_status st = fret_field_of_press(n, press, &f);
    if (!st.code)
        st = fret_field_peak(f, NULL, p);
    fret_field_free(f);
    return st;
}

typedef struct search {
    const fret_normal *normal;
    pressure_of *of;
    fret_real target;
    fret_press press;
    fret_status st;
} search;

/* ln(pressure/target) at ln F; 0 within the rounding of a double. */
static fret_real miss_at(fret_real load, fret_real *slope, void *context) {
    search *s = context;
    fret_real p = 0;
    (void)slope;
    s->st = fret_press_by_force(s->normal, (double)expl(load), &s->press);
    if (!s->st.code)
        s->st = s->of(s->normal, &s->press, &p);
    const fret_real miss = logl(p / s->target);
    return s->st.code ? (fret_real)NAN : fabsl(miss) < DBL_EPSILON ? 0 : miss;
}

/* ln F at the end of the gap; infinite if the gap has no end. */
static fret_real most_load(const fret_normal *n) {
    fret_press end;
    const bool ends = isfinite(n->end) && !fret_press_by_radius(n, (double)n->end, &end).code;
    return ends && end.F > 0 ? logl(end.F) : (fret_real)INFINITY;
}

/* The least ln F <= `at`, a root, that reaches the target too: over flat ends, or where a cone's tip goes
 * over into another shape, the pressure may fall and rise. */
static fret_real least_load(search *s, fret_real at, fret_real far) {
    static const fret_real STEP = 2, NEAR = 1e-6L;
    fret_real from = at - NEAR, f = miss_at(from, NULL, s);
    for (fret_real next = at - STEP; !s->st.code && next > -far; next -= STEP) {
        const fret_real there = miss_at(next, NULL, s);
        if (!s->st.code && (there < 0) != (f < 0)) {
            at = fret_root(miss_at, s, next, from, (next + from) / 2);
            f = there;
        }
        from = next;
    }
    s->st = fret_ok(); /* forces too small to press by end the search */
    return at;
}

/* Steps from F = 1 N (or below the end of the gap) by factors e until the target is passed, then a root.
 * The first slope gives the direction: over a flat end the mean pressure may rise and fall. */
static fret_status press_to(search *s, const char *name, fret_press *out) {
    static const fret_real STEP = 1, FLAT = 1e-12L, FAR = 700; /* of ln F; e^700 is still a double */
    const double target = (double)s->target;
    fret_status st = fret_check_positive(name, target);
    if (st.code)
        return st;
    const fret_real most = most_load(s->normal), begin = fminl(0, most - STEP);
    fret_real at = begin, f = miss_at(at, NULL, s);
    if (s->st.code)
        return s->st;
    const fret_real rise = miss_at(begin + STEP / 2, NULL, s) - f;
    if (s->st.code || !(fabsl(rise) > FLAT))
        return s->st.code ? s->st : fret_fail(FRET_OUTSIDE, name, target, (double)(s->target * expl(f)));
    const fret_real step = copysignl(STEP, -f * rise);
    while (f != 0) {
        const fret_real next = fminl(at + step, most), there = miss_at(next, NULL, s);
        if (s->st.code || (there < 0) != (f < 0) || there == 0) {
            if (!s->st.code)
                at = fret_root(miss_at, s, fminl(at, next), fmaxl(at, next), (at + next) / 2);
            break;
        }
        if (fabsl(next) > FAR)
            return fret_fail(FRET_OUTSIDE, name, target, (double)(s->target * expl(f)));
        if (next == most)
            return fret_fail(FRET_TABLE_SHORT, name, target, (double)s->normal->end);
        at = next;
        f = there;
    }
    if (s->st.code == FRET_OVERFLOW) /* the pressure tends to a limit short of the target */
        return fret_fail(FRET_OUTSIDE, name, target, (double)(s->target * expl(f)));
    if (!s->st.code && s->of == mean_of) /* p_0 would take a field at each load */
        at = least_load(s, at, FAR);
    return s->st.code ? s->st : fret_press_by_force(s->normal, (double)expl(at), out);
}

fret_status fret_press_by_mean(const fret_normal *n, double pmean, fret_press *out) {
    search s = {.normal = n, .of = mean_of, .target = pmean};
    return press_to(&s, "pmean", out);
}

fret_status fret_press_by_peak(const fret_normal *n, double p0, fret_press *out) {
    search s = {.normal = n, .of = peak_of, .target = p0};
    return press_to(&s, "p0", out);
}
