/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Inputs as a value, and the table of geometries. Touches no scene. */
#include "scene/inputs.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "number/real.h"

/* ---- geometries -------------------------------------------------------------------------------- */

static const geometry geometries[] = {
    {.name = "cone",
     .kind = FRET_GAP_POWER,
     .n = 1,
     .required = INPUT_BIT(IN_SLOPE),
     .takes = "slope:=0.05 | angle=3 deg | half_angle=87 deg",
     .meaning = "f = slope r; half_angle is that from the axis (Sneddon 1965)",
     .keywords = "angle apex Berkovich Sneddon indenter",
     .example = "    fret> material steel; geometry cone angle=3 deg; press FN=100 N\n"
                "    fret> slope, a, dz\n"
                "    slope = 0.0524078\n"
                "    a = 102.605 um\n"
                "    dz = 8.44664 um\n"},
    {.name = "paraboloid",
     .kind = FRET_GAP_POWER,
     .n = 2,
     .required = INPUT_BIT(IN_RADIUS),
     .takes = "R:=10 mm | R1=20 mm R2=20 mm",
     .meaning = "f = r^2/(2R)",
     .keywords = "Hertz Mindlin",
     .example = "    fret> material steel; geometry paraboloid R=10 mm; press FN=100 N\n"
                "    fret> f(1 mm), a, dz\n"
                "    f(1 mm) = 50 um\n"
                "    a = 186.626 um\n"
                "    dz = 3.48291 um\n"},
    {.name = "sphere",
     .kind = FRET_GAP_POWER,
     .n = 2,
     .required = INPUT_BIT(IN_RADIUS),
     .takes = "R:=10 mm | R1=20 mm R2=20 mm | D=20 mm",
     .meaning = "Hertz: the paraboloid; R2=inf is a plane",
     .keywords = "Mindlin",
     .example = "    fret> material steel; geometry sphere R1=20 mm R2=30 mm; press FN=100 N\n"
                "    fret> R, a, dz\n"
                "    R = 12 mm\n"
                "    a = 198.319 um\n"
                "    dz = 3.27754 um\n"},
    {.name = "power",
     .kind = FRET_GAP_POWER,
     .required = INPUT_BIT(IN_N),
     .optional = INPUT_BIT(IN_A) | INPUT_BIT(IN_H) | INPUT_BIT(IN_R0),
     .takes = "n:=3 [A:=50 m^-2 | h:=1 um r0:=1 mm]",
     .meaning = "f = A r^n = h (r/r0)^n",
     .keywords = "exponent",
     .example = "    fret> material steel; geometry power n=4 h=1 um r0=1 mm; press FN=100 N\n"
                "    fret> A, f(0.5 mm), a\n"
                "    A = 1e+06 m^-3\n"
                "    f(0.5 mm) = 62.5 nm\n"
                "    a = 727.031 um\n"},
    {.name = "sum",
     .kind = FRET_GAP_SUM,
     .takes = "TERM, ...",
     .meaning = "f = sum of A r^n, each n:A",
     .keywords = "powers polynomial",
     .example = "    fret> material steel; geometry sum 2:50 m^-1, 4:2e6 m^-3; press FN=100 N\n"
                "    fret> f(1 mm), a\n"
                "    f(1 mm) = 52 um\n"
                "    a = 186.487 um\n"},
    {.name = "flat-cone",
     .kind = FRET_GAP_FLAT_CONE,
     .required = INPUT_BIT(IN_B) | INPUT_BIT(IN_SLOPE),
     .takes = "b:=1 mm slope:=0.05",
     .meaning = "f = slope (r-b), r > b",
     .keywords = "punch",
     .example = "    fret> material steel; geometry flat-cone b=0.2 mm slope=0.05; press FN=100 N\n"
                "    fret> a, p(0.1 mm)\n"
                "    a = 204.506 um\n"
                "    p(0.1 mm) = 451.461 MPa\n"},
    {.name = "flat-paraboloid",
     .kind = FRET_GAP_FLAT_PARABOLOID,
     .required = INPUT_BIT(IN_B) | INPUT_BIT(IN_RADIUS),
     .takes = "b:=1 mm R:=10 mm",
     .meaning = "f = (r^2-b^2)/(2R), r > b",
     .keywords = "worn punch",
     .example = "    fret> material steel; geometry flat-paraboloid b=0.2 mm R=10 mm; press FN=100 N\n"
                "    fret> a, dz\n"
                "    a = 221.133 um\n"
                "    dz = 2.08616 um\n"},
    {.name = "flat-rounded",
     .kind = FRET_GAP_FLAT_ROUNDED,
     .required = INPUT_BIT(IN_B) | INPUT_BIT(IN_RADIUS),
     .takes = "b:=1 mm R:=10 mm",
     .meaning = "f = (r-b)^2/(2R), r > b",
     .keywords = "pad punch fretting",
     .example = "    fret> material steel; geometry flat-rounded b=0.2 mm R=10 mm; press FN=100 N\n"
                "    fret> a, dz\n"
                "    a = 299.728 um\n"
                "    dz = 1.65421 um\n"},
    {.name = "flat",
     .kind = FRET_GAP_FLAT,
     .required = INPUT_BIT(IN_B),
     .takes = "b:=1 mm",
     .meaning = "f = 0, r < b: a rigid punch (Sneddon 1965; Johnson, Contact Mechanics, ch. 3)",
     .keywords = "punch cylinder Boussinesq Sneddon",
     .example = "    fret> material steel; second rigid; geometry flat b=1 mm; press FN=1 kN\n"
                "    fret> a, dz, p(0 m), FN/(2*Estar*b)\n"
                "    a = 1 mm\n"
                "    dz = 2.16667 um\n"
                "    p(0 m) = 159.155 MPa\n"
                "    FN/(2*Estar*b) = 2.16667 um\n"},
    {.name = "exact-sphere",
     .kind = FRET_GAP_EXACT_SPHERE,
     .required = INPUT_BIT(IN_RADIUS),
     .takes = "R:=10 mm",
     .meaning = "f = R - sqrt(R^2-r^2)",
     .keywords = "ball",
     .example = "    fret> material steel; geometry exact-sphere R=10 mm; press FN=100 N\n"
                "    fret> f(1 mm), a\n"
                "    f(1 mm) = 50.1256 um\n"
                "    a = 186.617 um\n"},
    {.name = "file",
     .kind = FRET_GAP_TABLE,
     .takes = "FILE.csv [smooth HOW] [height] [using NAME = COLUMN, ...]",
     .meaning = "rows of r, f with units in the header; smooth, height: see help files",
     .keywords = "csv table sampled measured profile noisy noise spline smooth roughness",
     .example = "    $ cat gap.csv\n"
                "    r [mm],f [um]\n"
                "    0,0\n"
                "    0.5,12.5\n"
                "    1,50\n"
                "    fret> material steel; geometry file gap.csv; press FN=100 N\n"
                "    fret> f(0.25 mm), a\n"
                "    f(0.25 mm) = 3.125 um\n"
                "    a = 186.626 um\n"},
};
enum { GEOMETRIES = sizeof geometries / sizeof *geometries };

const geometry *geometry_row(size_t i) {
    return i < GEOMETRIES ? &geometries[i] : NULL;
}

const char *geometry_name(size_t i) {
    return i < GEOMETRIES ? geometries[i].name : NULL;
}

static void table_end(counted *self) {
    shared_table *t = (shared_table *)self;
    fret_table_free(t->table);
    free(t);
}

shared_table *shared_table_make(struct fret_table *table, const char *name, smoothing how) {
    shared_table *t = malloc(sizeof *t + strlen(name) + 1);
    if (!t) {
        fret_table_free(table);
        return NULL;
    }
    t->base = (counted){1, table_end};
    t->table = table;
    t->smoothing = how;
    memcpy(t->name, name, strlen(name) + 1);
    return t;
}

/* ---- the value --------------------------------------------------------------------------------- */

static void hold_all(const inputs *in) {
    for (input i = 0; in->bindings >> i; i++)
        counted_hold(in->bound[i]);
    counted_hold(in->table);
}

void inputs_copy(inputs *to, const inputs *from) {
    *to = *from;
    hold_all(to);
}

void inputs_drop(inputs *in) {
    for (input i = 0; in->bindings >> i; i++)
        counted_drop(in->bound[i]);
    counted_drop(in->table);
    *in = (inputs){.geometry = NULL};
}

bool inputs_same(const inputs *a, const inputs *b, input_set which) {
    if ((a->bindings | b->bindings) & which || a->geometry != b->geometry || a->table != b->table ||
        a->second != b->second || a->sum.terms != b->sum.terms)
        return false;
    for (int i = 0; i < a->sum.terms; i++)
        if (memcmp(&a->sum.power[i], &b->sum.power[i], sizeof a->sum.power[i]))
            return false;
    for (input in = 0; in < INPUTS; in++)
        if (which & INPUT_BIT(in) && (a->set[in] != b->set[in] || a->v[in] != b->v[in]))
            return false;
    return true;
}

void input_range(input in, double *lo, double *hi) {
    const bool nu = in == IN_NU || in == IN_NU_2;
    *lo = in == IN_K || nu                                              ? -1
          : in == IN_PHASE || in == IN_D0 || in == IN_F0 || in == IN_SB ? -(double)INFINITY
                                                                        : 0;
    *hi = in == IN_K ? 1 : nu ? 0.5 : (double)INFINITY;
}

fret_status input_status(input in, double v) {
    const bool nu = in == IN_NU || in == IN_NU_2, from_0 = in == IN_FNA || in == IN_MU || in == IN_NW;
    double lo, hi;
    fret_code code = FRET_OK;
    input_range(in, &lo, &hi);
    if (!isfinite(v))
        code = FRET_NOT_FINITE;
    else if (!(v > lo || (from_0 && v == lo)) || !(v < hi || (nu && v == hi)))
        code = in == IN_K ? FRET_BAD_K : nu ? FRET_BAD_NU : from_0 ? FRET_NEGATIVE : FRET_NOT_POSITIVE;
    return (fret_status){code, NULL, v, 0};
}

bool input_check(input in, double v, calc_error *error) {
    return calc_input_status(error, (int)in, input_status(in, v));
}

void inputs_unset(inputs *in, input_set set) {
    for (input i = 0; i < INPUTS; i++)
        if (set & INPUT_BIT(i)) {
            inputs_bind(in, i, NULL);
            in->set[i] = false;
            in->v[i] = 0;
        }
}

input_set inputs_replaced(input by) {
    const input_set bit = INPUT_BIT(by), power = INPUT_BIT(IN_H) | INPUT_BIT(IN_R0);
    return bit & INPUT_MODULUS     ? INPUT_MODULUS & ~bit
           : bit & INPUT_MODULUS_2 ? INPUT_MODULUS_2 & ~bit
           : bit & power           ? INPUT_BIT(IN_A)
           : by == IN_A            ? power
                                   : 0;
}

/* Unsets the inputs that `which` replaces; an input of the second body makes it a separate body. */
static void unset_replaced(inputs *in, input which) {
    const input_set bit = INPUT_BIT(which), second = INPUT_MODULUS_2 | INPUT_BIT(IN_NU_2);
    if (bit & second && in->second != SECOND_GIVEN) {
        inputs_unset(in, second & ~bit);
        in->second = SECOND_GIVEN;
    }
    inputs_unset(in, inputs_replaced(which));
}

void inputs_bind(inputs *in, input which, counted *to) {
    counted_drop(in->bound[which]);
    in->bound[which] = to;
    in->bindings = to ? in->bindings | INPUT_BIT(which) : in->bindings & ~INPUT_BIT(which);
    if (which == IN_RADIUS)
        in->radii[0] = in->radii[1] = 0;
    if (to)
        unset_replaced(in, which);
}

void inputs_put(inputs *in, input which, double v) {
    inputs_bind(in, which, NULL);
    in->v[which] = v;
    in->set[which] = true;
    unset_replaced(in, which);
}

void inputs_geometry(inputs *in, const geometry *g, const fret_gap *terms, shared_table *table) {
    inputs_unset(in, INPUT_GEOMETRY);
    counted_drop(in->table);
    in->table = table;
    in->geometry = g;
    if (terms)
        in->sum = *terms;
}

bool inputs_any(const inputs *in, input_set set) {
    for (input i = 0; i < INPUTS; i++)
        if (set & INPUT_BIT(i) && (in->set[i] || in->bound[i]))
            return true;
    return false;
}

bool inputs_know_nu(const inputs *in) {
    return inputs_any(in, INPUT_BIT(IN_NU));
}

bool inputs_take(const inputs *in, input which) {
    const geometry *g = in->geometry;
    if (!g || !geometry_takes(g, which))
        return false;
    return (which != IN_H && which != IN_R0) || in->set[IN_H];
}

static bool get_ratio(const inputs *in, bool second, long double *nu, calc_error *error) {
    return inputs_get(in, second ? IN_NU_2 : IN_NU, nu, error);
}

/* E0 of a body, from E0, G0 or, for the first body, 1/Estar = sum (1-nu^2)/E0. A second body without a
 * modulus has that of the first. */
static bool get_modulus(const inputs *in, bool second, long double *E0, calc_error *error) {
    const input E = second ? IN_E0_2 : IN_E0, G = second ? IN_G0_2 : IN_G0;
    long double nu = 0, nu_2 = 0, E_2 = INFINITY;
    if (in->set[E]) {
        *E0 = in->v[E];
        return true;
    }
    if (second && !in->set[G])
        return get_modulus(in, false, E0, error);
    if (!inputs_any(in, INPUT_MODULI))
        return calc_missing(error, (int)E);
    const bool of_both = !second && !in->set[G] && in->set[IN_ESTAR];
    if (of_both && in->v[IN_K] != 0)
        return calc_fail(error, 0, 0, "Estar is for homogeneous bodies, k = 0: for graded ones give E0");
    if (!get_ratio(in, second, &nu, error))
        return false;
    if (!of_both) {
        *E0 = 2 * (1 + nu) * in->v[G];
        return in->set[G] || calc_missing(error, (int)E);
    }
    const bool own = in->second == SECOND_GIVEN && inputs_any(in, INPUT_MODULUS_2);
    if (in->second != SECOND_RIGID && !get_ratio(in, true, &nu_2, error))
        return false;
    if (own && !get_modulus(in, true, &E_2, error))
        return false;
    const long double left = 1 / (long double)in->v[IN_ESTAR] - (1 - nu_2 * nu_2) / E_2;
    *E0 = (1 - nu * nu + (own || in->second == SECOND_RIGID ? 0 : 1 - nu_2 * nu_2)) / left;
    return left > 0 ||
           calc_fail(error, 0, 0, "Estar must be below E0_2/(1-nu_2^2), that of the second body alone");
}

/* Estar of both bodies. */
static bool get_Estar(const inputs *in, long double *out, calc_error *error) {
    long double E0 = 0, nu = 0, sum = 0;
    if (in->v[IN_K] != 0)
        return calc_fail(error, 0, 0,
                         "Estar is for homogeneous bodies, k = 0; cN is the modulus for graded ones");
    for (int i = 0; i < (in->second == SECOND_RIGID ? 1 : 2); i++) {
        if (!get_modulus(in, i, &E0, error) || !get_ratio(in, i, &nu, error))
            return false;
        sum += (1 - nu * nu) / E0;
    }
    *out = 1 / sum;
    return true;
}

static fret_power power_of(const inputs *in) {
    const double n = in->geometry->n;
    /* R and slope enter as h and r0 without rounding: r^2/(2R) = (R/2) (r/R)^2 */
    return n == 1          ? (fret_power){1, in->v[IN_SLOPE], 1}
           : n == 2        ? (fret_power){2, in->v[IN_RADIUS] / 2, in->v[IN_RADIUS]}
           : in->set[IN_A] ? (fret_power){in->v[IN_N], in->v[IN_A], 1}
                           : (fret_power){in->v[IN_N], in->v[IN_H], in->v[IN_R0]};
}

/* The gap of the geometry in use. */
static fret_gap gap_of(const inputs *in) {
    const geometry *g = in->geometry;
    if (g->kind == FRET_GAP_SUM)
        return in->sum;
    fret_gap gap = {.kind = g->kind, .b = in->v[IN_B], .R = in->v[IN_RADIUS], .slope = in->v[IN_SLOPE]};
    if (g->kind == FRET_GAP_TABLE)
        gap.table = in->table->table;
    if (geometry_is_power(g)) {
        gap.terms = 1;
        gap.power[0] = power_of(in);
    }
    return gap;
}

bool inputs_get(const inputs *in, input which, long double *out, calc_error *error) {
    long double nu = 0;
    bool here = in->set[which];
    switch (which) {
    case IN_K:
    case IN_FNA:
    case IN_PHASE:
    case IN_NW:
        here = here || which == IN_K || inputs_any(in, INPUT_AMPLITUDE);
        break;
    case IN_SB:
        here = true;
        break;
    case IN_D0:
    case IN_F0:
        here = here || inputs_any(in, INPUT_BIT(IN_K_RIG));
        break;
    case IN_NU_2:
        if (in->second == SECOND_RIGID)
            return calc_missing(error, (int)which);
        if (in->second == SECOND_SAME || !here)
            return inputs_get(in, IN_NU, out, error);
        break;
    case IN_E0:
    case IN_E0_2:
    case IN_G0:
    case IN_G0_2: {
        const bool second = INPUT_BIT(which) & INPUT_MODULUS_2, shear = which == IN_G0 || which == IN_G0_2;
        if (second && in->second == SECOND_RIGID)
            return calc_missing(error, (int)which);
        if (here)
            break;
        if (!get_modulus(in, second, out, error) || (shear && !get_ratio(in, second, &nu, error)))
            return false;
        *out /= shear ? 2 * (1 + nu) : 1;
        return true;
    }
    case IN_ESTAR:
        if (here && in->v[IN_K] == 0)
            break;
        return get_Estar(in, out, error);
    case IN_N:
        if (in->geometry && in->geometry->n > 0) {
            *out = (long double)in->geometry->n;
            return true;
        }
        break;
    case IN_A:
        if (!here && in->geometry && geometry_is_power(in->geometry)) {
            const fret_power p = power_of(in);
            *out = p.h * fret_ratio_pow(1, p.r0, p.n);
            return true;
        }
        break;
    default:
        break;
    }
    if (!here)
        return calc_missing(error, (int)which);
    *out = in->v[which];
    return true;
}

static bool get_double(const inputs *in, input which, double *out, calc_error *error) {
    long double v = 0;
    if (!inputs_get(in, which, &v, error))
        return false;
    *out = (double)v;
    return true;
}

bool inputs_material(const inputs *in, double k, fret_material *m, calc_error *error) {
    *m = (fret_material){.k = k, .c0 = 1};
    if (in->set[IN_ESTAR] && !inputs_know_nu(in) && in->v[IN_K] == 0) { /* as two bodies of nu = 0 */
        m->body[0] = m->body[1] = (fret_body){2 * in->v[IN_ESTAR], 0, false};
        return true;
    }
    if (!get_double(in, IN_E0, &m->body[0].E0, error) || !get_double(in, IN_NU, &m->body[0].nu, error))
        return false;
    m->body[1] = m->body[0];
    m->body[1].rigid = in->second == SECOND_RIGID;
    if (in->second == SECOND_GIVEN &&
        (!get_double(in, IN_E0_2, &m->body[1].E0, error) || !get_double(in, IN_NU_2, &m->body[1].nu, error)))
        return false;
    return k == 0 || get_double(in, IN_C0, &m->c0, error);
}

bool inputs_gap(const inputs *in, fret_gap *out, calc_error *error) {
    if (!in->geometry)
        return calc_fail(error, 0, 0, "there is no geometry yet: give one first (geometry sphere R=10 mm)");
    *out = gap_of(in);
    return true;
}
