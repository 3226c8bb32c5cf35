/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A contact as a friction damper: what its loop of an amplitude is to the first harmonic, at constant F_N. */
#include "scene/functions.h"

#include <math.h>

#include "number/integral.h"
#include "number/real.h"

/* One end of a closed loop. */
typedef struct peak {
    fret_pressed contact;
    double dxA;             /* amplitude, as far as a double goes */
    fret_real Fx, dx, loss; /* there; of the cycle */
} peak;

/* By amplitude of force, or of displacement: then also through gross slip. */
static bool peak_of(scene *s, value amplitude, peak *out, calc_error *error) {
    const bool by_force = dim_equal(amplitude.d, DIM_FORCE);
    const double v = (double)amplitude.v;
    const fret_status sign = {v < 0 ? FRET_NEGATIVE : FRET_OK, by_force ? "FA" : "dxA", v, 0};
    fret_loading first;
    if (!calc_status(error, sign) || !scene_contact(s, &out->contact, error) ||
        !scene_loss(s, by_force, v, &out->loss, error) || !scene_loading(s, by_force, v, &first, error))
        return false;
    out->dxA = (double)first.dx;
    out->Fx = first.Fx;
    out->dx = first.dx;
    return true;
}

/* Without slip the contact is a spring. */
static fret_real stuck(const fret_pressed *contact) {
    return fret_normal_stiffness(contact->normal, contact->press.a) /
           fret_normal_foundation(contact->normal)->eta;
}

/* ---- K' ---------------------------------------------------------------------------------------- */

/* With phi = theta/2 the branch down from the peak is F = FA-2 F_1(dxA sin^2 phi), and K' = -8/(pi dxA)
 * int_0^(pi/2) F_1 cos(2 phi) d phi. */
typedef struct branch {
    const peak *of;
    fret_real end; /* phi of 1; that of 0 is 0 */
    fret_status failed;
} branch;

static fret_real branch_at(fret_real t, fret_real rest, void *context) {
    branch *b = context;
    const fret_real sine = t < rest ? sinl(b->end * t) : cosl((FRET_PI / 2 - b->end) + b->end * rest);
    fret_loading first = {0, 0, 0, 0};
    if (!b->failed.code) /* as far as dxA it does, if it did there, unless it is interrupted */
        b->failed = fret_loading_by_displacement(&b->of->contact, (double)(b->of->dxA * sine * sine), &first);
    return first.Fx * (1 - 2 * sine * sine);
}

/* First loading is singular in its slope where it slides: an end of the interval, for the rule to bear. The
 * law of a gap without a formula may turn sharply within. */
static bool harmonic_stiffness(const peak *at, long double *out, calc_error *error) {
    peak p = *at;
    branch b = {.of = &p, .end = FRET_PI / 2};
    fret_real flat = 0;
    if (p.dxA <= 0) {
        *out = stuck(&p.contact);
        return true;
    }
    const fret_real slides = fret_gross_slip(&p.contact) / p.dxA; /* sin^2 phi there */
    if (slides < 1) {
        const fret_real rest = 1 - slides;
        b.end = atan2l(sqrtl(slides), sqrtl(rest));
        flat = -p.contact.mu * p.contact.press.F * sqrtl(slides * rest);
    }
    const fret_real part = b.end * fret_integral(branch_at, &b, 1e-15L).value;
    *out = -8 / (FRET_PI * p.dxA) * (part + flat);
    return calc_status(error, b.failed);
}

/* ---- functions --------------------------------------------------------------------------------- */

bool call_Ksec(scene *s, value amplitude, long double *out, calc_error *error) {
    peak p;
    if (!peak_of(s, amplitude, &p, error))
        return false;
    *out = p.dx > 0 ? p.Fx / p.dx : stuck(&p.contact);
    return true;
}

bool call_Kp(scene *s, value dxA, long double *out, calc_error *error) {
    peak p;
    return peak_of(s, dxA, &p, error) && harmonic_stiffness(&p, out, error);
}

bool call_Kpp(scene *s, value dxA, long double *out, calc_error *error) {
    peak p;
    if (!peak_of(s, dxA, &p, error))
        return false;
    *out = p.dx > 0 ? p.loss / (FRET_PI * p.dx * p.dx) : 0;
    return true;
}

bool call_loss_factor(scene *s, value amplitude, long double *out, calc_error *error) {
    peak p;
    long double Kp = 1;
    if (!peak_of(s, amplitude, &p, error) || (p.dx > 0 && !harmonic_stiffness(&p, &Kp, error)))
        return false;
    *out = p.dx > 0 ? p.loss / (FRET_PI * p.dx * p.dx) / Kp : 0;
    return true;
}
