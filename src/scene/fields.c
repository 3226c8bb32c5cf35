/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Functions of a place in the present state: material, shape, fields, 1D model. Uses `number` too. */
#include <float.h>
#include <math.h>

#include "number/real.h"
#include "scene/functions.h"

/* ---- material and shape: each without the other ------------------------------------------------ */

bool call_E(scene *s, value z, long double *out, calc_error *error) {
    long double E0 = 0, c0 = 1, k = 0;
    if (!scene_get(s, IN_E0, &E0, error) || !scene_get(s, IN_K, &k, error) ||
        (k != 0 && !scene_get(s, IN_C0, &c0, error)))
        return false;
    if (z.v < 0)
        return calc_fail(error, 0, 0, "E(z) is defined for z >= 0");
    if (z.v == 0 && k < 0)
        return calc_fail(error, 0, 0, "E(z) is infinite at z = 0 where k < 0");
    s->used |= USED(MODEL_CLOSED);
    *out = E0 * fret_pow(z.v / c0, k);
    return true;
}

/* The depth worn by Nw cycles at r; 0 without wear. */
static bool worn_depth(scene *s, long double r, long double *out, calc_error *error) {
    const fret_wear *wear;
    *out = 0;
    if (!scene_worn(s, &wear, error))
        return false;
    return calc_status(error, wear ? fret_wear_depth(wear, r, out) : status_ok);
}

bool call_f(scene *s, value r, long double *out, calc_error *error) {
    fret_gap gap;
    long double depth = 0;
    if (!scene_gap(s, &gap, error) || !worn_depth(s, r.v, &depth, error))
        return false;
    s->used |= USED(MODEL_CLOSED);
    fret_status st = fret_gap_check(&gap);
    if (!st.code)
        st = fret_gap_f(&gap, r.v, out);
    *out += depth;
    return calc_status(error, st);
}

bool call_g(scene *s, value x, long double *out, calc_error *error) {
    const fret_normal *normal;
    if (!scene_normal(s, &normal, error))
        return false;
    scene_used_closed(s);
    *out = fret_normal_profile(normal, x.v);
    if (!isnan(*out))
        return true;
    const double k = (double)fret_normal_foundation(normal)->k;
    return calc_status(error, fret_gap_g(fret_normal_gap(normal), k, x.v, out, NULL)); /* outside the law */
}

/* ---- local fields ------------------------------------------------------------------------------ */

bool field_at(scene *s, bool dragged, field_of_place *ask, long double r, long double *out,
              calc_error *error) {
    const fret_field *field;
    if (!(dragged ? scene_dragged_field : scene_pressed_field)(s, &field, error))
        return false;
    fret_status st = ask(field, r, out);
    const double off = fret_field_error(field);
    if (isnan(off))
        s->used |= USED(MODEL_QUADRATURE);
    else
        scene_also_used(s, (scene_use){USED(MODEL_PIECES), off});
    return calc_status(error, st);
}

bool call_WdA(scene *s, value r, long double *out, calc_error *error) {
    return scene_work(s, false, r.v, out, error);
}

bool call_dWdA(scene *s, value r, long double *out, calc_error *error) {
    return scene_work(s, true, r.v, out, error);
}

bool call_hwear(scene *s, value r, long double *out, calc_error *error) {
    long double alpha = 0;
    s->used |= USED(MODEL_BLOCKS);
    return scene_get(s, IN_ALPHA_W, &alpha, error) && worn_depth(s, r.v, out, error);
}

bool call_dhwear(scene *s, value r, long double *out, calc_error *error) {
    long double alpha = 0;
    if (!scene_get(s, IN_ALPHA_W, &alpha, error) || !scene_work(s, true, r.v, out, error))
        return false;
    *out *= alpha;
    return true;
}

/* The contact after the load, in a scene with friction. */
static bool tangential_state(scene *s, const fret_contact **out, calc_error *error) {
    double mu;
    s->used |= USED(MODEL_MEMORY);
    return scene_friction(s, &mu, error) && scene_history(s, out, error);
}

/* ---- the one-dimensional model ----------------------------------------------------------------- */

/* |x|: the foundation is symmetric. */
static value absolute(value x) {
    return (value){fabsl(x.v), x.d};
}

bool call_w1D(scene *s, value x, long double *out, calc_error *error) {
    const fret_press *press;
    long double g = 0;
    if (!scene_press(s, &press, error))
        return false;
    const long double a = press->a, dz = press->dz;
    *out = 0;
    if (fabsl(x.v) >= a)
        return true;
    const bool ok = call_g(s, absolute(x), &g, error);
    *out = dz - g;
    return ok;
}

bool call_u1D(scene *s, value x, long double *out, calc_error *error) {
    const fret_contact *now;
    if (!tangential_state(s, &now, error))
        return false;
    *out = fret_contact_displacement(now, fabsl(x.v)); /* symmetric */
    return true;
}

bool call_s1D(scene *s, value x, long double *out, calc_error *error) {
    const fret_press *press;
    const fret_contact *at;
    fret_state now;
    if (!tangential_state(s, &at, error) || !scene_press(s, &press, error))
        return false;
    if (fabsl(x.v) >= press->a)
        return calc_fail(error, 0, 0, "s1D(x) is defined within the contact, where |x| < a: try s1D(0.99*a)");
    fret_contact_forces(at, &now);
    *out = now.dx - fret_contact_displacement(at, fabsl(x.v));
    if (fabsl(*out) <= 8 * LDBL_EPSILON * fabsl(now.dx)) /* it sticks: the sums round differently */
        *out = 0;
    return true;
}

/* cN0 (x/c0)^k, or cT0 (x/c0)^k */
bool modulus_at(scene *s, long double x, bool tangential, long double *out, calc_error *error) {
    fret_foundation f;
    if (!foundation_of(s, !tangential, &f, error))
        return false;
    const long double r = fabsl(x);
    if (r == 0 && f.k < 0)
        return calc_fail(error, 0, 0, "the foundation is infinitely stiff at x = 0 where k < 0");
    *out = (tangential ? f.cT0 : f.cN0) * (f.k == 0 ? 1 : fret_pow(r / f.c0, f.k));
    return true;
}

bool call_qz1D(scene *s, value x, long double *out, calc_error *error) {
    long double c, w;
    if (!call_w1D(s, x, &w, error) || !modulus_at(s, x.v, false, &c, error))
        return false;
    *out = c * w;
    return true;
}

bool call_qx1D(scene *s, value x, long double *out, calc_error *error) {
    long double c, u;
    if (!call_u1D(s, x, &u, error) || !modulus_at(s, x.v, true, &c, error))
        return false;
    *out = c * u;
    return true;
}

/* ---- stress inside ----------------------------------------------------------------------------- */

bool stress_at(scene *s, const value place[3], fret_stress *out, calc_error *error) {
    const fret_field *field;
    const bool second = place[2].v < 0;
    long double k = 0, nu = 0, sB = 0;
    if (!scene_get(s, IN_K, &k, error) || !scene_get(s, IN_SB, &sB, error))
        return false;
    if (k != 0)
        return calc_fail(
            error, 0, 0,
            "stress in the body is computed for homogeneous bodies (k = 0) only, not for k = %.6Lg", k);
    if (second && s->in.second == SECOND_RIGID)
        return calc_fail(error, 0, 0, "z < 0 is in the second body, which is rigid: it has no stress");
    if (!scene_get(s, second ? IN_NU_2 : IN_NU, &nu, error) || !scene_stress_field(s, &field, error))
        return false;
    s->used |= USED(MODEL_QUADRATURE);
    fret_status st =
        fret_field_stress(field, (double)nu, (double)place[0].v, (double)place[1].v, (double)place[2].v, out);
    out->xx += second ? 0 : (double)sB;
    return calc_status(error, st);
}

static double principal(const fret_stress *t, int which) {
    double of[3];
    fret_stress_principal(t, of);
    return of[which];
}

double stress_largest(const fret_stress *of) {
    return principal(of, 0);
}

double stress_smallest(const fret_stress *of) {
    return principal(of, 2);
}

static bool mises_at(scene *s, long double x, long double z, long double *out) {
    const value place[3] = {{x, DIM_LENGTH}, {0, DIM_LENGTH}, {z, DIM_LENGTH}};
    fret_stress t;
    if (!stress_at(s, place, &t, error_quiet()))
        return false;
    *out = fret_stress_mises(&t);
    return true;
}

/* The largest von Mises stress in the plane of F_x in one body: infinite where the pressure is, else the best
 * point of a grid, improved by a pattern search. */
bool scene_hardest(scene *s, long double a, int side, long double at[2], long double *most) {
    enum { ACROSS = 12, DEEP = 12 };
    static const long double width = 1.2L;
    const long double top = side < 0 ? -1e-18L * a : 0; /* z = 0 is in the first body */
    long double v;
    *most = -1;
    for (int i = -ACROSS; i <= ACROSS; i++)
        for (int j = 0; j <= DEEP; j++) {
            const long double x = width * a * i / (double)ACROSS, z = top + side * (a * j / (double)DEEP);
            if (!mises_at(s, x, z, &v) || v <= *most)
                continue;
            *most = v;
            at[0] = x;
            at[1] = z;
        }
    const fret_field *field;
    if (!(*most > 0) || !scene_stress_field(s, &field, error_quiet()))
        return false;
    const fret_status peak = fret_field_peak(field, NULL, &v);
    if (peak.code == FRET_SINGULAR) {
        at[0] = peak.value;
        at[1] = 0;
        *most = (long double)INFINITY;
        return true;
    }
    for (long double h = a / (double)DEEP; h > 1e-5L * a;) {
        const long double from = *most, x = at[0], z = at[1];
        for (int i = 0; i < 4; i++) {
            const long double to[2] = {x + (i < 2 ? (2 * i - 1) * h : 0), z + (i < 2 ? 0 : (2 * i - 5) * h)};
            if ((to[1] - top) * side < 0 || !mises_at(s, to[0], to[1], &v) || v <= *most)
                continue;
            *most = v;
            at[0] = to[0];
            at[1] = to[1];
        }
        h = *most > from ? h : h / 2;
    }
    return true;
}
