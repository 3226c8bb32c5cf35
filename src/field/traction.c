/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Traction and tangential displacement of a history, as a sum of normal contacts. Pure. */
#include "field/field.h"
#include "fret/field.h"
#include "law/check.h"

/* Sum over the slices of weight sigma times the difference of the field at their two ends: the field where
 * the slope changes, which is what nothing displaced has nowhere. */
static fret_status superpose(const fret_contact *c, fret_real r, bool traction, fret_real *out) {
    const fret_normal *n = fret_contact_normal(c);
    fret_segment s;
    fret_real sum = 0;
    fret_status st =
        c->diagram ? fret_fail(FRET_OUTSIDE, "exactness", 0, 0) : fret_check_not_negative("r", (double)r);
    const bool rings =
        traction && fret_contact_segment(c, 0, &s) && s.sigma == 0 && fret_field_deep(n, s.outer, r);
    *out = 0;
    for (size_t i = 0; !st.code && fret_contact_segment(c, i, &s); i++) {
        fret_segment next = {.sigma = 0};
        fret_real part = 0;
        (void)fret_contact_segment(c, i + 1, &next); /* beyond the last there is no slope */
        const fret_real weight = rings ? s.sigma : s.sigma - next.sigma;
        if (weight != 0)
            st = fret_unless_stopped(n, rings ? fret_field_between(n, s.inner, s.outer, r, true, &part)
                                              : fret_field_of(n, s.outer, r, traction, &part));
        sum += weight * part;
    }
    if (!st.code)
        *out = sum;
    return st;
}

/* A field at r counts only what is below it: slices that end inside r contribute their outside part. */
fret_status fret_traction(const fret_contact *c, fret_real r, fret_real *q) {
    if (c->curved)
        return fret_swing_traction(c->swing, r, q);
    fret_status st = superpose(c, r, true, q);
    *q *= fret_contact_friction(c);
    return st;
}

fret_status fret_surface_x(const fret_contact *c, fret_real r, fret_real *u) {
    if (c->curved)
        return fret_swing_surface_x(c->swing, r, u);
    fret_status st = superpose(c, r, false, u);
    *u *= fret_contact_friction(c) * fret_contact_normal(c)->foundation.eta;
    return st;
}
