/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "calc/quantity.h"
#include "number/real.h"

#include <math.h>
#include <string.h>

/* ---- results now ------------------------------------------------------------------------------- */

#define STATE(name, member)                                                                                  \
    static bool get_##name(scene *s, long double *out, calc_error *error) {                                  \
        const fret_state *state;                                                                             \
        if (!scene_state(s, &state, error))                                                                  \
            return false;                                                                                    \
        *out = state->member;                                                                                \
        return true;                                                                                         \
    }
STATE(W, W)
STATE(U, U)
STATE(kt, kt)

#define PRESS(name, member)                                                                                  \
    static bool get_##name(scene *s, long double *out, calc_error *error) {                                  \
        const fret_press *press;                                                                             \
        if (!scene_press(s, &press, error))                                                                  \
            return false;                                                                                    \
        *out = press->member;                                                                                \
        return true;                                                                                         \
    }
PRESS(FN, F)
PRESS(dz, dz)
PRESS(a, a)

/* First loading has a closed form, which keeps every digit also close to gross slip. */
#define TANGENTIAL(name, member)                                                                             \
    static bool get_##name(scene *s, long double *out, calc_error *error) {                                  \
        const fret_state *state;                                                                             \
        fret_loading first;                                                                                  \
        if (scene_closed_state(s)) {                                                                         \
            if (!scene_first_loading(s, &first, error))                                                      \
                return false;                                                                                \
            *out = first.member;                                                                             \
            return true;                                                                                     \
        }                                                                                                    \
        if (!scene_state(s, &state, error))                                                                  \
            return false;                                                                                    \
        *out = state->member;                                                                                \
        return true;                                                                                         \
    }
TANGENTIAL(Fx, Fx)
TANGENTIAL(dx, dx)
TANGENTIAL(c, c)

static bool get_dW(scene *s, long double *out, calc_error *error) {
    return scene_cycle_loss(s, out, error);
}

static bool get_kn(scene *s, long double *out, calc_error *error) {
    const fret_press *press;
    const fret_normal *normal;
    if (!scene_press(s, &press, error) || !scene_normal(s, &normal, error))
        return false;
    *out = press->a > 0 ? fret_normal_stiffness(normal, press->a) : 0;
    return true;
}

/* ---- the scene against its k = 0 twin ---------------------------------------------------------- */

static bool k0_press(scene *s, const fret_normal **normal, fret_press *out, calc_error *error) {
    const fret_press *press;
    if (!scene_press(s, &press, error) || !scene_k0(s, normal, error))
        return false;
    scene_used_closed(s);
    fret_status st = fret_press_by_force(*normal, (double)press->F, out);
    return scene_status(s, error, &st);
}

static bool get_a0(scene *s, long double *out, calc_error *error) {
    const fret_normal *normal;
    fret_press press;
    if (!k0_press(s, &normal, &press, error))
        return false;
    *out = press.a;
    return true;
}

static bool get_dz0(scene *s, long double *out, calc_error *error) {
    const fret_normal *normal;
    fret_press press;
    if (!k0_press(s, &normal, &press, error))
        return false;
    *out = press.dz;
    return true;
}

static bool get_dx0max(scene *s, long double *out, calc_error *error) {
    const fret_normal *normal;
    fret_press press;
    double mu;
    if (!k0_press(s, &normal, &press, error) || !scene_friction(s, &mu, error))
        return false;
    *out = fret_gross_slip(&(fret_contact){normal, mu, press});
    return true;
}

static bool get_dxmax(scene *s, long double *out, calc_error *error) {
    const fret_normal *normal;
    const fret_press *press;
    double mu;
    if (!scene_press(s, &press, error) || !scene_normal(s, &normal, error) || !scene_friction(s, &mu, error))
        return false;
    *out = fret_gross_slip(&(fret_contact){normal, mu, *press});
    return true;
}

/* ---- coefficients ------------------------------------------------------------------------------ */

/* Coefficients of the material alone do not wait for a geometry. */
static bool foundation_of(scene *s, fret_foundation *out, calc_error *error) {
    const fret_normal *normal;
    scene probe;
    if (!s->geometry) {
        scene_clone(&probe, s);
        probe.geometry = geometry_find("cone", 4);
        probe.in[IN_SLOPE] = 1;
    }
    bool ok = scene_normal(s->geometry ? s : &probe, &normal, error);
    s->used |= USED_CLOSED;
    if (ok)
        *out = *fret_normal_foundation(normal);
    if (!s->geometry)
        scene_free(&probe);
    return ok;
}

#define MATERIAL(name, member)                                                                               \
    static bool get_##name(scene *s, long double *out, calc_error *error) {                                  \
        fret_foundation foundation;                                                                          \
        if (!foundation_of(s, &foundation, error))                                                           \
            return false;                                                                                    \
        *out = foundation.member;                                                                            \
        return true;                                                                                         \
    }
MATERIAL(eta, eta)
MATERIAL(hN, hN[0])
MATERIAL(hT, hT[0])
MATERIAL(beta_k, beta[0])
MATERIAL(cN, cN0)
MATERIAL(cT, cT0)

static bool get_kappa(scene *s, long double *out, calc_error *error) {
    long double n = 0;
    if (!scene_get(s, IN_N, &n, error))
        return false;
    s->used |= USED_CLOSED;
    *out = fret_kappa((double)n, s->in[IN_K]);
    return true;
}

/* ---- functions of the scene -------------------------------------------------------------------- */

static bool pressed_by(scene *s, value F, fret_press *out, calc_error *error) {
    const fret_normal *normal;
    if (!scene_normal(s, &normal, error))
        return false;
    scene_used_closed(s);
    fret_status st = fret_press_by_force(normal, (double)F.v, out);
    return scene_status(s, error, &st);
}

static bool call_a(scene *s, value F, long double *out, calc_error *error) {
    fret_press press;
    if (!pressed_by(s, F, &press, error))
        return false;
    *out = press.a;
    return true;
}

static bool call_dz(scene *s, value F, long double *out, calc_error *error) {
    fret_press press;
    if (!pressed_by(s, F, &press, error))
        return false;
    *out = press.dz;
    return true;
}

/* What the closed forms of tangential loading start from. */
static bool loaded(scene *s, const fret_normal **normal, const fret_press **press, double *mu,
                   calc_error *error) {
    return scene_normal(s, normal, error) && scene_press(s, press, error) && scene_friction(s, mu, error);
}

static bool load_first(scene *s, value arg, bool by_force, fret_loading *out, calc_error *error) {
    const fret_normal *normal;
    const fret_press *press;
    double mu;
    if (!loaded(s, &normal, &press, &mu, error))
        return false;
    const fret_contact contact = {normal, mu, *press};
    fret_status st = by_force ? fret_loading_by_force(&contact, (double)arg.v, out)
                              : fret_loading_by_displacement(&contact, (double)arg.v, out);
    return scene_status(s, error, &st);
}

static bool call_c(scene *s, value F, long double *out, calc_error *error) {
    fret_loading first;
    if (!load_first(s, F, true, &first, error))
        return false;
    *out = first.c;
    return true;
}

static bool call_dx(scene *s, value F, long double *out, calc_error *error) {
    fret_loading first;
    if (!load_first(s, F, true, &first, error))
        return false;
    *out = first.dx;
    return true;
}

static bool call_Fx(scene *s, value d, long double *out, calc_error *error) {
    fret_loading first;
    if (!load_first(s, d, false, &first, error))
        return false;
    *out = first.Fx;
    return true;
}

static bool call_dW(scene *s, value FA, long double *out, calc_error *error) {
    const fret_normal *normal;
    const fret_press *press;
    double mu;
    if (!loaded(s, &normal, &press, &mu, error))
        return false;
    fret_status st = fret_cycle_loss_by_force(&(fret_contact){normal, mu, *press}, (double)FA.v, out);
    return scene_status(s, error, &st);
}

static bool call_E(scene *s, value z, long double *out, calc_error *error) {
    long double E0 = 0, c0 = 1, k = s->in[IN_K];
    if (!scene_get(s, IN_E0, &E0, error) || (k != 0 && !scene_get(s, IN_C0, &c0, error)))
        return false;
    if (z.v < 0)
        return calc_fail(error, 0, 0, "E(z) is defined for z >= 0");
    s->used |= USED_CLOSED;
    *out = E0 * fret_pow(z.v / c0, k);
    return true;
}

static bool call_f(scene *s, value r, long double *out, calc_error *error) {
    const fret_normal *normal;
    if (!scene_normal(s, &normal, error))
        return false;
    s->used |= USED_CLOSED;
    fret_status st = fret_gap_f(fret_normal_gap(normal), r.v, out);
    return scene_status(s, error, &st);
}

static bool call_g(scene *s, value x, long double *out, calc_error *error) {
    const fret_normal *normal;
    if (!scene_normal(s, &normal, error))
        return false;
    scene_used_closed(s);
    fret_status st = fret_gap_g(fret_normal_gap(normal), s->in[IN_K], x.v, out, NULL);
    return scene_status(s, error, &st);
}

/* ---- local fields, state now ------------------------------------------------------------------- */

static bool normal_field(scene *s, value r,
                         fret_status (*field)(const fret_normal *, fret_real, fret_real, fret_real *),
                         long double *out, calc_error *error) {
    const fret_normal *normal;
    const fret_press *press;
    if (!scene_normal(s, &normal, error) || !scene_press(s, &press, error))
        return false;
    s->used |= USED_QUADRATURE;
    fret_status st = field(normal, press->a, r.v, out);
    return scene_status(s, error, &st);
}

static bool call_p(scene *s, value r, long double *out, calc_error *error) {
    return normal_field(s, r, fret_pressure, out, error);
}

static bool call_uz(scene *s, value r, long double *out, calc_error *error) {
    return normal_field(s, r, fret_surface, out, error);
}

static bool tangential_field(scene *s, value r,
                             fret_status (*field)(const fret_memory *, fret_real, fret_real *),
                             long double *out, calc_error *error) {
    const fret_memory *memory;
    double mu;
    if (!scene_friction(s, &mu, error) || !scene_memory(s, &memory, error))
        return false;
    s->used |= USED_MEMORY | USED_QUADRATURE;
    fret_status st = field(memory, r.v, out);
    return scene_status(s, error, &st);
}

static bool call_qx(scene *s, value r, long double *out, calc_error *error) {
    return tangential_field(s, r, fret_traction, out, error);
}

static bool call_ux(scene *s, value r, long double *out, calc_error *error) {
    return tangential_field(s, r, fret_surface_x, out, error);
}

/* ---- functions at many arguments --------------------------------------------------------------- */

static bool block_press(scene *s, const double F[], double a[], double dz[], size_t count,
                        calc_error *error) {
    const fret_normal *normal;
    if (!scene_normal(s, &normal, error))
        return false;
    fret_status st = fret_batch_press(normal, F, a, dz, count);
    return scene_status(s, error, &st);
}

static bool block_a(scene *s, const double F[], double out[], size_t count, calc_error *error) {
    return block_press(s, F, out, NULL, count, error);
}

static bool block_dz(scene *s, const double F[], double out[], size_t count, calc_error *error) {
    return block_press(s, F, NULL, out, count, error);
}

static bool block_loading(scene *s, const double F[], double c[], double dx[], size_t count,
                          calc_error *error) {
    const fret_normal *normal;
    const fret_press *press;
    double mu;
    if (!loaded(s, &normal, &press, &mu, error))
        return false;
    fret_status st = fret_batch_loading(&(fret_contact){normal, mu, *press}, F, c, dx, count);
    return scene_status(s, error, &st);
}

static bool block_c(scene *s, const double F[], double out[], size_t count, calc_error *error) {
    return block_loading(s, F, out, NULL, count, error);
}

static bool block_dx(scene *s, const double F[], double out[], size_t count, calc_error *error) {
    return block_loading(s, F, NULL, out, count, error);
}

static bool block_dW(scene *s, const double FA[], double out[], size_t count, calc_error *error) {
    const fret_normal *normal;
    const fret_press *press;
    double mu;
    if (!loaded(s, &normal, &press, &mu, error))
        return false;
    fret_status st = fret_batch_loss(&(fret_contact){normal, mu, *press}, FA, out, count);
    return scene_status(s, error, &st);
}

/* ---- the table --------------------------------------------------------------------------------- */

static const quantity quantities[] = {
    {"E0", "characteristic modulus", "E(z) = E0 (z/c0)^k", "(1)", {1, -2}, IN_E0, 0, 0, 0, {0, 0}, 0},
    {"nu", "Poisson's ratio", "-1 < nu <= 1/2", "(1)", {0, 0}, IN_NU, 0, 0, 0, {0, 0}, 0},
    {"k", "exponent of grading", "-1 < k < 1", "(1)", {0, 0}, IN_K, 0, 0, 0, {0, 0}, 0},
    {"c0", "characteristic depth", "E(c0) = E0", "(1)", {0, 1}, IN_C0, 0, 0, 0, {0, 0}, 0},
    {"E0_2",
     "modulus of the second body",
     "as E0; default: same",
     "(4)",
     {1, -2},
     IN_E0_2,
     0,
     0,
     0,
     {0, 0},
     0},
    {"nu_2",
     "Poisson's ratio of the second body",
     "as nu; default: same",
     "(4)",
     {0, 0},
     IN_NU_2,
     0,
     0,
     0,
     {0, 0},
     0},
    {"mu", "coefficient of friction", "|q_x| <= mu p", "(14)", {0, 0}, IN_MU, 0, 0, 0, {0, 0}, 0},
    {"n", "exponent of the gap", "f = A r^n", "(6)", {0, 0}, IN_N, 0, 0, 0, {0, 0}, 0},
    {"A", "coefficient of the gap", "f = A r^n", "(6)", {0, 0}, IN_A, 0, 0, 0, {0, 0}, 0},
    {"h", "gap at r0", "f = h (r/r0)^n", "(6)", {0, 1}, IN_H, 0, 0, 0, {0, 0}, 0},
    {"r0", "reference radius of the gap", "f = h (r/r0)^n", "(6)", {0, 1}, IN_R0, 0, 0, 0, {0, 0}, 0},
    {"R", "radius of curvature", "f = r^2/(2R)", "(6)", {0, 1}, IN_RADIUS, 0, 0, 0, {0, 0}, 0},
    {"b", "radius of the flat end", "f = 0 for r < b", "(3)", {0, 1}, IN_B, 0, 0, 0, {0, 0}, 0},
    {"slope",
     "slope of the flank",
     "f = slope r, slope = tan(angle)",
     "(6)",
     {0, 0},
     IN_SLOPE,
     0,
     0,
     0,
     {0, 0},
     0},
    {"FN",
     "normal force",
     "F_N = 2 int_0^a c_N(x) [g(a)-g(x)] dx",
     "(13)",
     {1, 0},
     IN_FN,
     get_FN,
     0,
     0,
     {0, 0},
     0},
    {"dz", "indentation depth", "delta_z = g(a)", "(11)", {0, 1}, -1, get_dz, call_dz, "F", {1, 0}, block_dz},
    {"a",
     "contact radius",
     "g(a) = delta_z; power law: F_N ~ a^(n+k+1)",
     "(11),(13)",
     {0, 1},
     -1,
     get_a,
     call_a,
     "F",
     {1, 0},
     block_a},
    {"Fx",
     "tangential force",
     "F_x = mu [F_N(a)-F_N(c)] on first loading",
     "(15)",
     {1, 0},
     -1,
     get_Fx,
     call_Fx,
     "d",
     {0, 1},
     0},
    {"dx",
     "tangential displacement",
     "delta_x = mu eta [g(a)-g(c)] on first loading",
     "(18)",
     {0, 1},
     -1,
     get_dx,
     call_dx,
     "F",
     {1, 0},
     block_dx},
    {"c",
     "stick radius",
     "c/a = (1-F_x/(mu F_N))^(1/(n+k+1)) on first loading",
     "(17)",
     {0, 1},
     -1,
     get_c,
     call_c,
     "F",
     {1, 0},
     block_c},
    {"W", "energy dissipated so far", "W = sum of friction work", "(22)", {1, 1}, -1, get_W, 0, 0, {0, 0}, 0},
    {"U", "stored tangential energy", "U = 1/2 int c_T u^2 dx", "(22)", {1, 1}, -1, get_U, 0, 0, {0, 0}, 0},
    {"dW",
     "energy dissipated per cycle",
     "dW = 8 mu^2 eta int_c^a c_N (g(a)-g(x)) (g(x)-g(c)) dx",
     "(27)",
     {1, 1},
     -1,
     get_dW,
     call_dW,
     "FA",
     {1, 0},
     block_dW},
    {"dxmax", "displacement at gross slip", "mu eta delta_z", "(18)", {0, 1}, -1, get_dxmax, 0, 0, {0, 0}, 0},
    {"a0", "reference radius", "a for k = 0, same F_N and E0", "(23)", {0, 1}, -1, get_a0, 0, 0, {0, 0}, 0},
    {"dz0",
     "indentation depth for k = 0",
     "delta_z for k = 0, same F_N and E0",
     "(23)",
     {0, 1},
     -1,
     get_dz0,
     0,
     0,
     {0, 0},
     0},
    {"dx0max",
     "displacement at gross slip for k = 0",
     "mu eta delta_z for k = 0",
     "(18)",
     {0, 1},
     -1,
     get_dx0max,
     0,
     0,
     {0, 0},
     0},
    {"kn",
     "normal stiffness",
     "dF_N/d delta_z = 2 c_N0 c0^-k a^(k+1)/(k+1)",
     "(10)",
     {1, -1},
     -1,
     get_kn,
     0,
     0,
     {0, 0},
     0},
    {"kt",
     "tangential stiffness going on",
     "dF_x/d delta_x = F_N'(y_c)/eta",
     "(15),(18)",
     {1, -1},
     -1,
     get_kt,
     0,
     0,
     {0, 0},
     0},
    {"eta", "stiffness ratio", "c_N/c_T", "(4),(5)", {0, 0}, -1, get_eta, 0, 0, {0, 0}, 0},
    {"hN", "normal coefficient of the first body", "h_N(k,nu)", "(A1)", {0, 0}, -1, get_hN, 0, 0, {0, 0}, 0},
    {"hT",
     "tangential coefficient of the first body",
     "h_T(k,nu)",
     "(A2)",
     {0, 0},
     -1,
     get_hT,
     0,
     0,
     {0, 0},
     0},
    {"beta_k",
     "beta of the first body",
     "beta^2 = (1+k)(1-k nu/(1-nu))",
     "(A3)",
     {0, 0},
     -1,
     get_beta_k,
     0,
     0,
     {0, 0},
     0},
    {"kappa", "shape factor", "(n/2) B(n/2,(k+1)/2)", "(8)", {0, 0}, -1, get_kappa, 0, 0, {0, 0}, 0},
    {"cN",
     "normal foundation modulus at c0",
     "1/c_N = sum (1-nu^2)/(h_N E0)",
     "(4)",
     {1, -2},
     -1,
     get_cN,
     0,
     0,
     {0, 0},
     0},
    {"cT",
     "tangential foundation modulus at c0",
     "1/c_T = sum 1/(h_T E0)",
     "(5)",
     {1, -2},
     -1,
     get_cT,
     0,
     0,
     {0, 0},
     0},
    {"E", "modulus at depth z", "E(z) = E0 (z/c0)^k", "(1)", {1, -2}, -1, 0, call_E, "z", {0, 1}, 0},
    {"f", "gap at radius r", "f(r)", "(3)", {0, 1}, -1, 0, call_f, "r", {0, 1}, 0},
    {"g",
     "equivalent profile",
     "g(x) = x^(1-k) int_0^x f'(r) (x^2-r^2)^((k-1)/2) dr",
     "(3)",
     {0, 1},
     -1,
     0,
     call_g,
     "x",
     {0, 1},
     0},
    {"p",
     "contact pressure",
     "p(r) = (c_N0 c0^-k/pi) int_r^a g'(x) (x^2-r^2)^((k-1)/2) dx",
     "inverse of (3)",
     {1, -2},
     -1,
     0,
     call_p,
     "r",
     {0, 1},
     0},
    {"qx",
     "tangential traction",
     "q_x(r): as p with -u'(x) and c_T0",
     "inverse of (3)",
     {1, -2},
     -1,
     0,
     call_qx,
     "r",
     {0, 1},
     0},
    {"uz",
     "normal surface displacement",
     "(2 cos(pi k/2)/pi) int_0^a x^k (delta_z-g) (r^2-x^2)^(-(1+k)/2) dx",
     "inverse of (3)",
     {0, 1},
     -1,
     0,
     call_uz,
     "r",
     {0, 1},
     0},
    {"ux",
     "tangential surface displacement",
     "u_x(r): as u_z with u(x)",
     "inverse of (3)",
     {0, 1},
     -1,
     0,
     call_ux,
     "r",
     {0, 1},
     0},
};
enum { QUANTITIES = sizeof quantities / sizeof *quantities };

const quantity *quantity_row(size_t i) {
    return i < QUANTITIES ? &quantities[i] : NULL;
}

const char *quantity_name(size_t i) {
    return i < QUANTITIES ? quantities[i].name : NULL;
}

const quantity *quantity_find(const char *name, size_t len) {
    static word_index words = {.name = quantity_name};
    size_t row;
    return word_find(&words, name, len, &row) ? &quantities[row] : NULL;
}

dim quantity_dim(const quantity *q, const scene *s) {
    if (q->in == IN_A)
        return (dim){0, 1 - (s->geometry && s->geometry->n > 0 ? s->geometry->n : s->in[IN_N])};
    return q->d;
}
