/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef FRET_FIELD_H
#define FRET_FIELD_H

#include "fret/contact.h"

FRET_BEGIN

/* Local fields at a radius r of one state of a contact, by inverse transforms. Any state is a superposition
 * of normal contacts: a slice of slope sigma is the difference of the contacts that end at its two ends. */
typedef struct fret_field fret_field;

/* Makes the field of the present state; the contact may be stepped further. Takes a few us for a power law,
 * for other shapes 5 us per cell of the law within the contact (2 ms for 400 rows). Borrows the normal
 * contact alone. Free with fret_field_free. Errors: FRET_OUTSIDE (FRET_DOUBLE), FRET_NO_MEMORY,
 * FRET_INTERRUPTED. */
fret_status fret_field_make(const fret_contact *contact, fret_field **out);
/* Makes the field of a contact that is only pressed, to the depth press->dz; press->a is its radius, or 0 to
 * have it computed. Next to a flat end the depth decides, which a radius cannot resolve. More errors:
 * FRET_NEGATIVE, FRET_NOT_FINITE; FRET_OUTSIDE beyond the end of the gap. */
fret_status fret_field_of_press(const fret_normal *normal, const fret_press *press, fret_field **out);
void fret_field_free(fret_field *field);

/* The functions below only read: threads may share a field. Arguments r >= 0 [m], else FRET_NEGATIVE,
 * FRET_NOT_FINITE. FRET_SINGULAR where the field is infinite: at the sharp edge of a flat-ended gap where k
 * <= 0, at the edge of a flat punch, and at the tip where n + k <= 1; the traction there only if the
 * innermost slice has a slope. FRET_INTERRUPTED.
 *
 * Accuracy 1e-14 relative, for tables 2e-15 of the largest value; 2e-13 nearer than 1e-3 a outside the edge
 * and nearer than 1e-6 a to the centre. Powers up to n = 1e6: 1e-13, for the radii as given. After swinging:
 * 1e-13 of the largest value, 1e-12 for shapes other than powers. A value takes 2 us whatever the shape, and
 * as much again for each slice that ends close by (power laws: for each slice); after swinging up to 1 ms. */

/* p(r) = (cN0 c0^-k/pi) int_r^a g'(x) (x^2-r^2)^((k-1)/2) dx [Pa]; 0 outside. */
fret_status fret_field_pressure(const fret_field *field, fret_real r, fret_real *p);
/* The largest p(r) [Pa], p_0, and its place [m]; r may be NULL. Hertz: p_0 = 3 F_N/(2 pi a^2) at r = 0. For
 * other shapes the best of places ever closer to the edge, and in all cells of the law, is refined by a
 * search: some 300 pressures, tables three more a row. Accuracy: that of p. FRET_SINGULAR: value is the place
 * where p is infinite. */
fret_status fret_field_peak(const fret_field *field, fret_real *r, fret_real *p);
/* The normal contact with the largest pressure p0 [Pa] > 0, or with the mean pressure F_N/(pi a^2), by the
 * root of ln p(ln F_N). Errors: FRET_NOT_POSITIVE, FRET_NOT_FINITE; FRET_OUTSIDE if no load has that
 * pressure, FRET_TABLE_SHORT if the gap ends before; FRET_SINGULAR. If several loads have that mean pressure
 * (over a flat end it rises and falls if k < 0), the least; of several with that p0 any. Accuracy: that of p;
 * F_N rounded to double. */
fret_status fret_press_by_peak(const fret_normal *normal, double p0, fret_press *out);
fret_status fret_press_by_mean(const fret_normal *normal, double pmean, fret_press *out);

/* u_z(r) = (2 cos(pi k/2)/pi) int_0^a x^k (delta_z-g(x)) (r^2-x^2)^(-(1+k)/2) dx for r > a [m], both bodies
 * together; delta_z - f(r) inside. */
fret_status fret_field_surface(const fret_field *field, fret_real r, fret_real *w);
/* q_x(r) [Pa], as p with -u'(x) and c_T for g'(x) and c_N, and u_x(r) [m], as u_z with u(x) for delta_z -
 * g(x); u_x is the mean over the angle. */
fret_status fret_field_traction(const fret_field *field, fret_real r, fret_real *q);
fret_status fret_field_surface_x(const fret_field *field, fret_real r, fret_real *u);
/* Local slip s(r) = delta_x - u_x(r) [m], exactly 0 where all springs within r have stuck since they touched.
 * Friction works on it: 2 pi int mu p s r dr = W for first loading. Outside the contact: how far the surfaces
 * have moved past each other. Accuracy as of u_x, relative to delta_x. */
fret_status fret_field_slip(const fret_field *field, fret_real r, fret_real *s);

/* Error of p, u_z, q_x and u_x, from the law's polynomials and rounding, relative to their largest values;
 * NAN for closed forms. */
double fret_field_error(const fret_field *field);

/* Stress [Pa], tension positive, in homogeneous bodies (k = 0); x along F_x, z > 0 in the body that F_x
 * pushes along x, z < 0 in the other. From the line loads q_z = c_N w(t), q_x = c_T u(t) on the imaginary
 * axis:
 *   sigma_ij(x,y,z) = (1/2 pi) Re int_-a^a [q_z P_ij + q_x Q_ij] dt,   zeta = z + i t,
 * with rho^2 = x^2+y^2+zeta^2, V = 1/rho, L = ln(rho+zeta), chi = zeta L - rho, subscripts for derivatives:
 *   P_xx = 2nu V_zeta - (1-2nu) L_xx - z V_xx,  P_yy alike,  P_zz = V_zeta - z V_zeta,zeta,
 *   P_xy = -(1-2nu) L_xy - z V_xy,  P_xz = -z V_x,zeta,  P_yz = -z V_y,zeta,
 *   Q_xx = 2(1+nu) V_x + 2nu chi_xxx - z L_xxx,  Q_yy = 2nu V_x + 2nu chi_xyy - z L_xyy,
 *   Q_zz = -z V_x,zeta,  Q_xy = V_y + 2nu chi_xxy - z L_xxy,  Q_xz = V_zeta - z V_xx,  Q_yz = -z V_xy,
 * the point loads of Boussinesq and Cerruti. At the surface the limit from z > 0. */
typedef struct fret_stress {
    double xx, yy, zz, xy, xz, yz;
} fret_stress;

/* nu: of the body that (x, y, z) [m] lies in. Accuracy 1e-12 of the largest pressure; less if that is
 * infinite or the contact barely reaches beyond a flat end. Some 5 us for a power law and one slip zone, as
 * much for every two cells of other laws. Errors: FRET_OUTSIDE: k != 0, for which no such form is known, or a
 * curved contact (copy it by fret_contact_chords first: then 1e-6, a thousand times as long); FRET_BAD_NU,
 * FRET_NOT_FINITE; FRET_SINGULAR where p is infinite; FRET_INTERRUPTED. */
fret_status fret_field_stress(const fret_field *field, double nu, double x, double y, double z,
                              fret_stress *out);

/* The equivalent stress of von Mises; the principal stresses, the largest first, to 1e-15 of the largest in
 * magnitude; the equivalent stress of Tresca, the largest principal stress less the smallest. */
double fret_stress_mises(const fret_stress *stress);
void fret_stress_principal(const fret_stress *stress, double out[3]);
double fret_stress_tresca(const fret_stress *stress);

FRET_END

#endif
