/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A field at one place, made for that alone. */
#ifndef PLACES_H
#define PLACES_H

#include "fret/field.h"

typedef fret_status place_question(const fret_field *, fret_real r, fret_real *out);

static inline fret_status place_ask(fret_status made, fret_field *f, place_question *ask, fret_real r,
                                    fret_real *out) {
    *out = 0;
    if (made.code)
        return made;
    made = ask(f, r, out);
    fret_field_free(f);
    return made;
}

static inline fret_status place_of_press(const fret_normal *n, const fret_press *press, place_question *ask,
                                         fret_real r, fret_real *out) {
    fret_field *f = NULL;
    const fret_status st = fret_field_of_press(n, press, &f);
    return place_ask(st, f, ask, r, out);
}

/* Of a contact of radius a. */
static inline fret_status place_pressure(const fret_normal *n, fret_real a, fret_real r, fret_real *p) {
    return place_of_press(n, &(fret_press){.a = a, .dz = fret_normal_profile(n, a)}, fret_field_pressure, r,
                          p);
}

static inline fret_status place_surface(const fret_normal *n, fret_real a, fret_real r, fret_real *w) {
    return place_of_press(n, &(fret_press){.a = a, .dz = fret_normal_profile(n, a)}, fret_field_surface, r,
                          w);
}

static inline fret_status place_of_contact(const fret_contact *c, place_question *ask, fret_real r,
                                           fret_real *out) {
    fret_field *f = NULL;
    const fret_status st = fret_field_make(c, &f);
    return place_ask(st, f, ask, r, out);
}

static inline fret_status place_traction(const fret_contact *c, fret_real r, fret_real *q) {
    return place_of_contact(c, fret_field_traction, r, q);
}

static inline fret_status place_surface_x(const fret_contact *c, fret_real r, fret_real *u) {
    return place_of_contact(c, fret_field_surface_x, r, u);
}

#endif
