/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The memory diagram of a power law in double. Allocates its layers. */
#include "history/diagram.h"

#define NUMBER double
#define SPOT char /* a power law needs no places */
#define DIAGRAM fret_diagram
#define PUBLIC(f) fret_diagram_##f
#define FUNCTION(f) f
#define POWER pow
#include "history/diagram_type.h"
#include "history/steps.h"
#include "number/dd.h"

#define LITTLE (4 * DBL_EPSILON)

/* ---- the law ----------------------------------------------------------------------------------- */

FRET_INLINE void law_find(const fret_diagram *d, coordinate by, place *p) {
    if (p->v < 0)
        p->v = power_value(&d->law[by], p->y);
}

FRET_INLINE double law_fall(const fret_diagram *d, coordinate by, place *edge, double thick, place *inner) {
    (void)thick;
    law_find(d, by, inner);
    return edge->v - inner->v;
}

FRET_INLINE bow law_bow(const fret_diagram *d, coordinate by, const place *outer, const place *inner,
                        double w) {
    return power_bow(&d->law[by], outer, inner, w);
}

/* True if depth, load and their product, an energy, are within the range of double. */
static bool law_holds(const fret_diagram *d, coordinate by, double y) {
    const double v = power_value(&d->law[by], y), product = y * v;
    return product > 1e-290 && product < 1e290 && v > 1e-290 && v < 1e290;
}

/* F_N - s F_x/mu with all digits, on which delta_x depends near gross slip. */
FRET_INLINE double law_level(const fret_diagram *d, coordinate by, double s, const place *edge,
                             double level) {
    const dd limit = dd_prod(d->mu, edge->y);
    return by == DEPTH ? level : fmax(((limit.hi - s * d->Fx) + limit.lo) / d->mu, 0);
}

static fret_real law_radius(const fret_diagram *d) {
    return fret_law_radius(d->normal, d->edge.y[DEPTH]);
}

#include "history/diagram_body.h"

/* FRET_DOUBLE does not record slip. */
FRET_INLINE void law_slips(fret_diagram *d, coordinate by, double gain, const slip_front *a,
                           const slip_front *b, double travel) {
    (void)d, (void)by, (void)gain, (void)a, (void)b, (void)travel;
}

FRET_INLINE void law_slips_all(fret_diagram *d, double e, const place *from, const place *to) {
    (void)d, (void)e, (void)from, (void)to;
}

static fret_status law_prepare(fret_diagram *d, coordinate by, double y) {
    const fret_status st = choose_reference(d, by, y);
    return st.code || law_holds(d, by, y) ? st : fret_fail(FRET_OVERFLOW, NULL, y, 1e290);
}

/* ---- the object -------------------------------------------------------------------------------- */

void fret_diagram_count_loss(fret_diagram *d, bool on) {
    d->lossless = !on;
}

fret_status fret_diagram_step(fret_diagram *d, const fret_step *step) {
    return diagram_step(d, step);
}

double fret_diagram_last_loss(const fret_diagram *d) {
    return d->last_loss;
}
