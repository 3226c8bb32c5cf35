/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Stress inside homogeneous bodies (k = 0), from the line loads of the one-dimensional model placed on the
 * imaginary axis. Reads fields only; uses `law` and `number`. */
#include <complex.h>
#include <math.h>
#undef I /* `I` names integrals in this room */

#include "field/field.h"
#include "law/check.h"
#include "number/integral.h"

/* With zeta = z + i t, rho^2 = r^2 + zeta^2, V = 1/rho, L = ln(rho+zeta), chi = zeta L - rho, psi the
 * integral of chi over zeta, and line loads q(t) with -q' = cN0 sigma g' (sigma = 1 for the pressure),
 * integration by parts of the formula in fret/field.h gives
 *   stress = cN0/pi Im int_0^a g'(t) [P + mu sigma Q] dt,
 *   P_xx = 2 nu V - (1-2nu) chi_xx - z L_xx      Q_xx = 2(1+nu) L_x + 2nu psi_xxx - z chi_xxx
 *   P_yy alike                                   Q_yy = 2nu L_x + 2nu psi_xyy - z chi_xyy
 *   P_zz = V - z V_zeta                          Q_zz = -z V_x
 *   P_xy = -(1-2nu) chi_xy - z L_xy              Q_xy = L_y + 2nu psi_xxy - z chi_xxy
 *   P_xz = -z V_x, P_yz = -z V_y                 Q_xz = V - z L_xx, Q_yz = -z L_xy.
 * In lambda = rho + zeta, with dt = rho d lambda/(i lambda), the brackets are rational: they have no
 * singularity at the surface, and pieces of the path may be straight lines in lambda, along which g' is
 * continued off the real axis. */
enum { XX, YY, ZZ, XY, XZ, YZ };

typedef struct place_inside {
    double x, y, z, r, nu; /* in units of the contact radius; z >= 0 */
    double mu_sigma;
} place_inside;

/* g' between two radii in units of the contact radius: a sum of powers, or a cell of the law. */
typedef struct profile_part {
    double lo, hi, unit; /* unit: the contact radius [m] */
    const fret_cell *cell;
    int terms;
    double of[FRET_MOST_TERMS], n[FRET_MOST_TERMS]; /* g' = sum of[i] x^(n[i]-1) */
    double steep;                                   /* the largest n */
    bool kinked, branches;                          /* half-integer powers at lo; others at the centre */
} profile_part;

static double complex slope_at(const profile_part *p, double complex t) {
    double complex sum = 0, kink = 0;
    if (p->terms == 1 && p->n[0] == 2)
        return p->of[0] * t;
    for (int i = 0; i < p->terms; i++)
        sum += p->of[i] * (p->n[i] == 1 ? 1 : cexp((p->n[i] - 1) * clog(t)));
    if (p->terms)
        return sum;
    const fret_cell *c = p->cell;
    const double scale = (double)(c->width / p->unit / p->unit), lo = (double)(c->x / p->unit);
    const double complex v = (t - lo) * (t + lo) / scale;
    for (int j = terms_of(c, SLOPES, false) - 1; j >= 0; j--)
        sum = sum * v + (double)term_of(c, SLOPES, false, j);
    for (int j = terms_of(c, SLOPES, true) - 1; j >= 0; j--)
        kink = kink * v + (double)term_of(c, SLOPES, true, j);
    if (kink != 0)
        sum += kink * cexp(((double)c->q - 1) * clog(v));
    return 2 * t / (scale * p->unit) * sum;
}

/* rho + zeta */
static double complex lambda_at(const place_inside *a, double t) {
    const double complex zeta = a->z + _Complex_I * t;
    return csqrt((a->r - t) * (a->r + t) + a->z * a->z + _Complex_I * (2 * a->z * t)) + zeta;
}

/* Adds Re(factor rho (P + mu sigma Q)) to the six sums. */
static void add_node(const place_inside *a, double complex lambda, double complex factor, double sum[6]) {
    const double x = a->x, y = a->y, z = a->z, nu = a->nu, xx = x * x, yy = y * y, xy = x * y,
                 s = a->mu_sigma;
    const double complex l = 1 / lambda, rho = (lambda + a->r * a->r * l) / 2, v = z / rho, l2 = l * l,
                         b = (lambda + rho) * l2 * v / rho, /* z (lambda + rho)/(rho lambda)^2 */
        chi = (1 - 2 * nu), zeta = lambda - rho;
    double complex c[6] = {2 * nu + chi * (rho * l - xx * l2) - z * l + xx * b,
                           2 * nu + chi * (rho * l - yy * l2) - z * l + yy * b,
                           1 + zeta * v / rho,
                           -chi * xy * l2 + xy * b,
                           x * v / rho,
                           y * v / rho};
    if (s != 0) {
        const double complex d = (lambda + 2 * rho) * l2 * l * v / rho, psi = -rho * l2 / 2, l3 = l2 * l,
                             e = l2 * z;
        c[XX] += s * (x * (2 * (1 + nu) * l + 2 * nu * (3 * psi + xx * l3) - 3 * e + xx * d));
        c[YY] += s * (x * (2 * nu * l + 2 * nu * (psi + yy * l3) - e + yy * d));
        c[ZZ] += s * (x * v / rho);
        c[XY] += s * (y * (l + 2 * nu * (psi + xx * l3) - e + xx * d));
        c[XZ] += s * (1 - z * l + xx * b);
        c[YZ] += s * (xy * b);
    }
    for (int i = 0; i < 6; i++)
        sum[i] += creal(factor * c[i]);
}

/* Gauss's eight points along a straight line in lambda. rooted: nodes are even in the square root of the
 * distance from `from`, for a kink there. */
static void add_straight(const place_inside *a, const profile_part *p, double complex from, double complex to,
                         bool rooted, double sum[6]) {
    for (int i = 0; i < 8; i++) {
        const double node = (double)fret_gauss_node[i], w = (double)fret_gauss_weight[i];
        const double complex lambda = from + (to - from) * (rooted ? node * node : node),
                             t = (lambda - a->r * a->r / lambda) / (2 * _Complex_I) - a->z / _Complex_I;
        add_node(a, lambda, (rooted ? 2 * node : 1) * w * slope_at(p, t) * (to - from) / lambda, sum);
    }
}

/* The kink of g' is singular at two places of lambda: lambda itself, on the path, and -r^2/lambda. */
static double complex mirrored(const place_inside *a, double complex lambda) {
    return lambda != 0 ? -a->r * a->r / lambda : 0;
}

/* Does the piece begin at the kink, with the two singularities apart? Then its nodes are rooted. */
static bool is_rooted(const place_inside *a, const profile_part *p, double t0, double complex from) {
    static const double ONE = 1e-7;
    return p->kinked && t0 == p->lo && !(cabs(from - mirrored(a, from)) < ONE);
}

/* Is the piece short enough for eight points, compared with its distance from the singularities lambda = 0,
 * rho = 0 (none at the surface) and kinks? */
static bool is_short(const place_inside *a, const profile_part *p, double t0, double t1, double complex from,
                     double complex to) {
    static const double NEAR = 0.5, STEEP = 2, TIP = 1e-6;
    const double complex middle = (from + to) / 2;
    double off = cabs(middle);
    if (a->z > 0)
        off = fmin(off, cabs(middle - _Complex_I * a->r));
    if (p->kinked) {
        const double complex kink = lambda_at(a, p->lo);
        if (t0 > p->lo)
            off = fmin(off, cabs(middle - kink));
        if (t0 > p->lo || is_rooted(a, p, t0, from))
            off = fmin(off, cabs(middle - mirrored(a, kink)));
        if (is_rooted(a, p, t0, from)) /* the substitution doubles the degree */
            off /= 3;
    }
    return !(cabs(to - from) > NEAR * off) && (p->steep < 8 || (t1 - t0) * p->steep <= STEEP * t1) &&
           !(p->branches && t0 == 0 && pow(t1 / p->hi, p->n[0]) > TIP);
}

static void add_between(const place_inside *a, const profile_part *p, double t0, double t1,
                        double complex from, double complex to, double sum[6]) {
    static const double LEAST = 1e-40;
    const double mid = t0 < a->r && a->r < t1 ? a->r : t0 + (t1 - t0) / 2;
    if (t1 < LEAST)
        return;
    if (is_short(a, p, t0, t1, from, to) || !(mid > t0 && mid < t1)) {
        add_straight(a, p, from, to, is_rooted(a, p, t0, from), sum);
        return;
    }
    const double complex between = lambda_at(a, mid);
    add_between(a, p, t0, mid, from, between, sum);
    add_between(a, p, mid, t1, between, to, sum);
}

/* Adds a part between lo and hi; the inner region of a steep power is negligible (below e^-45). */
static void add_part(const place_inside *a, const profile_part *p, double lo, double hi, double sum[6]) {
    static const double NOTHING = 45;
    double from = fmax(lo, p->lo), to = fmin(hi, p->hi);
    if (p->terms == 1 && p->steep > 8)
        from = fmax(from, exp(-NOTHING / p->steep));
    if (to > from)
        add_between(a, p, from, to, lambda_at(a, from), lambda_at(a, to), sum);
}

static void put_powers(profile_part *p, double n, double of) {
    p->n[p->terms] = n;
    p->of[p->terms++] = of;
    p->steep = fmax(p->steep, n);
    p->branches |= p->lo == 0 && 2 * n != floor(2 * n);
    p->kinked |= p->lo == 0 && n != floor(n);
}

static void part_of_law(const fret_normal *n, fret_real a, profile_part *p) {
    fret_term term[FRET_MOST_TERMS];
    const int terms = fret_gap_series(&n->gap, &n->rule, a, term);
    *p = (profile_part){.hi = 1, .unit = (double)a};
    for (int i = 0; i < terms; i++)
        put_powers(p, (double)term[i].n, (double)(term[i].G * term[i].n / a));
}

static void part_of_cell(const fret_cell *c, fret_real a, profile_part *p) {
    const fret_real last = fret_cell_radius(c, c->powers ? fminl(c->width, a / c->x) : 1);
    *p = (profile_part){.lo = (double)((c->powers ? fret_cell_radius(c, c->begin) : c->x) / a),
                        .hi = (double)(last / a),
                        .unit = (double)a,
                        .cell = c,
                        .kinked = !c->powers && c->count[RISE_Q] > 0};
    for (int i = 0; c->powers && i < c->count[RISE]; i++) {
        const double m = (double)c->of[RISE_Q][i];
        put_powers(p, m, (double)(c->of[RISE][i] * m / c->x) * pow((double)(a / c->x), m - 1));
    }
}

/* At the edge of a flat punch g jumps by the whole depth. */
static void add_edge(const place_inside *a, double edge, double depth, double sum[6]) {
    const double complex lambda = lambda_at(a, edge), rho = (lambda + a->r * a->r / lambda) / 2;
    add_node(a, lambda, _Complex_I * depth / rho, sum);
}

static void add_all(const fret_field *f, place_inside *a, double sum[6]) {
    static const fret_real NEAR = 1e-7L; /* of the distance to the edge: slices closer to it are punches */
    const fret_real unit = f->slice[f->slices - 1].a, start = fret_gap_start(&f->normal->gap),
                    near = NEAR * hypotl(a->r * unit - start, a->z * unit);
    const fret_cells *cells = f->normal->cells;
    const size_t parts = cells ? cells->count : 1;
    size_t next = 0; /* the first part that reaches beyond the previous slice */
    profile_part p;
    for (size_t i = 0; i < f->slices; i++) {
        const double lo = i > 0 ? (double)(f->slice[i - 1].a / unit) : 0, hi = (double)(f->slice[i].a / unit);
        a->mu_sigma = f->loads > DRAGGED ? f->mu * (double)f->slice[i].weight[DRAGGED] : 0;
        if (start > 0 && f->slice[i].a - start <= near) {
            add_edge(a, hi, (double)((f->slice[i].y - (i > 0 ? f->slice[i - 1].y : 0)) / unit), sum);
            continue;
        }
        for (size_t j = next; j < parts; j++) {
            if (cells)
                part_of_cell(&cells->cell[j], unit, &p);
            else
                part_of_law(f->normal, unit, &p);
            if (p.lo >= hi)
                break;
            add_part(a, &p, lo, hi, sum);
            if (p.hi > hi)
                break;
            next = j + 1;
        }
    }
}

/* In contact radii: stresses farther away are below the promised accuracy, and given as 0. */
static const double FAR = 1e6;
/* In contact radii: depths below this are taken as the surface, since r as a double is no more exact. */
static const double SURFACE = 1e-15;

static fret_status check(const fret_field *f, double nu, const double at[3]) {
    static const char *const names[] = {"x", "y", "z"};
    const fret_foundation *of = &f->normal->foundation;
    if (of->k != 0)
        return fret_fail(FRET_OUTSIDE, "k", (double)of->k, 0);
    if (!(nu > -1 && nu <= 0.5))
        return fret_fail(FRET_BAD_NU, "nu", nu, 0.5);
    for (int i = 0; i < 3; i++)
        if (!isfinite(at[i]))
            return fret_fail(FRET_NOT_FINITE, names[i], at[i], 0);
    return f->swung.count > 0 ? fret_fail(FRET_OUTSIDE, "contact", 0, 0) : fret_ok();
}

fret_status fret_field_stress(const fret_field *f, double nu, double x, double y, double z,
                              fret_stress *out) {
    const double at[3] = {x, y, z}, r = hypot(x, y);
    const fret_status st = check(f, nu, at);
    double sum[6] = {0};
    *out = (fret_stress){.xx = 0};
    if (st.code || f->slices == 0)
        return st;
    if (z == 0 && fret_field_infinite(f->normal, r))
        return fret_fail(FRET_SINGULAR, "r", r, 0);
    const double unit = (double)f->slice[f->slices - 1].a, side = z < 0 ? -1 : 1;
    /* the other body is pushed the other way: x and y are reversed, and z counts from its own surface */
    place_inside a = {
        .x = side * x / unit, .y = side * y / unit, .z = fabs(z) / unit, .r = r / unit, .nu = nu};
    if (a.z < SURFACE)
        a.z = 0;
    if (a.r < FAR && a.z < FAR)
        add_all(f, &a, sum);
    const double scale = -(double)(f->normal->foundation.cN0 / FRET_PI);
    for (int i = XX; i <= YZ; i++)
        sum[i] = scale * sum[i] + 0.0; /* + 0.0 turns -0 into 0 */
    *out = (fret_stress){sum[XX], sum[YY], sum[ZZ], sum[XY], sum[XZ], sum[YZ]};
    return fret_unless_stopped(f->normal, st);
}

/* ---- of a state -------------------------------------------------------------------------------- */

double fret_stress_mises(const fret_stress *s) {
    const double a = s->xx - s->yy, b = s->yy - s->zz, c = s->zz - s->xx;
    return sqrt((a * a + b * b + c * c) / 2 + 3 * (s->xy * s->xy + s->xz * s->xz + s->yz * s->yz));
}

/* A rotation in the plane of p and q that makes s[p][q] zero: t = tan of its angle, the smaller root of
 * t^2 + 2 t (s[q][q]-s[p][p])/(2 s[p][q]) - 1 = 0 (Jacobi 1846; Golub, Van Loan, Matrix computations, 8.5).
 */
static void rotate(double s[3][3], int p, int q) {
    const int r = 3 - p - q;
    if (s[p][q] == 0)
        return;
    const double half = (s[q][q] - s[p][p]) / (2 * s[p][q]),
                 t = copysign(1, half) / (fabs(half) + hypot(1, half)), cosine = 1 / hypot(1, t),
                 sine = t * cosine, pr = s[p][r], qr = s[q][r];
    s[p][p] -= t * s[p][q];
    s[q][q] += t * s[p][q];
    s[p][q] = s[q][p] = 0;
    s[p][r] = s[r][p] = cosine * pr - sine * qr;
    s[q][r] = s[r][q] = sine * pr + cosine * qr;
}

/* By rotations: the roots of the deviator's cubic would lose half of the digits where two are equal, as on
 * the axis. They converge quadratically; four sweeps suffice. */
void fret_stress_principal(const fret_stress *of, double out[3]) {
    enum { SWEEPS = 6 };
    double s[3][3] = {{of->xx, of->xy, of->xz}, {of->xy, of->yy, of->yz}, {of->xz, of->yz, of->zz}};
    for (int i = 0; i < SWEEPS; i++) {
        rotate(s, 0, 1);
        rotate(s, 0, 2);
        rotate(s, 1, 2);
    }
    const double low = fmin(s[0][0], s[1][1]), high = fmax(s[0][0], s[1][1]), last = s[2][2];
    out[0] = fmax(high, last);
    out[1] = fmax(low, fmin(high, last));
    out[2] = fmin(low, last);
}

double fret_stress_tresca(const fret_stress *s) {
    double principal[3];
    fret_stress_principal(s, principal);
    return principal[0] - principal[2];
}
