/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A contact as a friction damper: stiffnesses of its loop at constant F_N. Uses the library, `number`. */
#include "scene/functions.h"

#include <math.h>

#include "number/integral.h"
#include "number/real.h"

/* The turning point of a closed loop. */
typedef struct peak {
    fret_pressed contact;
    double dxA;             /* amplitude dx, rounded to double */
    fret_real Fx, dx, loss; /* F_x and dx there; loss of the cycle */
} peak;

/* The loop of a force amplitude, or of a displacement amplitude, which may reach gross slip. */
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

/* The stiffness of the contact without slip. */
static fret_real stuck(const fret_pressed *contact) {
    return fret_normal_stiffness(contact->normal, contact->press.a) /
           fret_normal_foundation(contact->normal)->eta;
}

/* ---- K' ---------------------------------------------------------------------------------------- */

/* With phi = theta/2 the branch down from the peak is F = FA-2 F_1(dxA sin^2 phi), F_1 first loading, and K'
 * = -8/(pi dxA) int_0^(pi/2) F_1 cos(2 phi) d phi. */
typedef struct branch {
    const peak *of;
    fret_real end; /* phi at t = 1; phi = 0 at t = 0 */
    fret_status failed;
} branch;

static fret_real branch_at(fret_real t, fret_real rest, void *context) {
    branch *b = context;
    const fret_real sine = t < rest ? sinl(b->end * t) : cosl((FRET_PI / 2 - b->end) + b->end * rest);
    fret_loading first = {0, 0, 0, 0};
    if (!b->failed.code) /* after success at dxA only an interruption fails */
        b->failed = fret_loading_by_displacement(&b->of->contact, (double)(b->of->dxA * sine * sine), &first);
    return first.Fx * (1 - 2 * sine * sine);
}

/* K' by quadrature over phi up to gross slip, where the slope of first loading is singular, plus the flat
 * part in closed form. Within, the law of a table may turn sharply. */
static bool harmonic_stiffness(const peak *at, long double *out, calc_error *error) {
    branch b = {.of = at, .end = FRET_PI / 2};
    fret_real flat = 0;
    if (at->dxA <= 0) {
        *out = stuck(&at->contact);
        return true;
    }
    const fret_real slides = fret_gross_slip(&at->contact) / at->dxA; /* sin^2 phi there */
    if (slides < 1) {
        const fret_real rest = 1 - slides;
        b.end = atan2l(sqrtl(slides), sqrtl(rest));
        flat = -at->contact.mu * at->contact.press.F * sqrtl(slides * rest);
    }
    const fret_real part = b.end * fret_integral(branch_at, &b, 1e-15L).value;
    *out = -8 / (FRET_PI * at->dxA) * (part + flat);
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
