/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef FRET_FIELD_H
#define FRET_FIELD_H

#include "fret/contact.h"

FRET_BEGIN

/* Local fields at a radius r of one state of a contact, by inverse transforms. Whatever its history, a state
 * is a superposition of normal contacts: slices of slope sigma are differences of contacts that end at their
 * two ends. */
typedef struct fret_field fret_field;

/* Of the present state, which it keeps: the contact may go on. Of a power law a few us; of other shapes 5 us
 * for each cell of the law within the contact, some 2 ms of 400 rows. Borrows the law alone. Errors:
 * FRET_OUTSIDE (FRET_DOUBLE), FRET_NO_MEMORY, FRET_INTERRUPTED. Free with fret_field_free. */
fret_status fret_field_make(const fret_contact *contact, fret_field **out);
/* Of a contact that is only pressed, dz deep and of radius a, 0: what that depth makes it; next to a flat
 * end, where a radius cannot tell an edge, the depth does. Errors also: FRET_NEGATIVE, FRET_NOT_FINITE;
 * FRET_OUTSIDE beyond the end of the gap. */
fret_status fret_field_of_press(const fret_normal *normal, const fret_press *press, fret_field **out);
void fret_field_free(fret_field *field);

/* Questions only read: threads may share a field. Arguments r >= 0 [m] else FRET_NEGATIVE, FRET_NOT_FINITE.
 * FRET_SINGULAR where the field is infinite: at the sharp edge of a flat-ended gap where k <= 0, at the edge
 * of a flat punch, and at the tip where n + k <= 1; the traction there only where the innermost slice has a
 * slope. FRET_INTERRUPTED.
 *
 * Accuracy 1e-14 relative, of tables 2e-15 of the largest value; 2e-13 nearer than 1e-3 a outside the edge
 * and nearer than 1e-6 a to the centre. Powers up to n = 1e6: 1e-13, for the radii as given. After swinging:
 * 1e-13 of the largest value, of other shapes than powers 1e-12. Some 2 us a value whatever the shape, and as
 * much again for each slice that ends close by; of a power law for each slice; after swinging up to 1 ms. */

/* p(r) = (cN0 c0^-k/pi) int_r^a g'(x) (x^2-r^2)^((k-1)/2) dx [Pa]; 0 outside. */
fret_status fret_field_pressure(const fret_field *field, fret_real r, fret_real *p);
/* The largest p(r) [Pa], p_0, and its place [m]; r may be NULL. Of Hertz p_0 = 3 F_N/(2 pi a^2) at r = 0;
 * other shapes press hardest elsewhere: the best of places that are ever closer to the edge, and of all cells
 * of the law, is followed uphill. Some 300 pressures, of tables three more a row. Errors: FRET_SINGULAR, its
 * value the place where p is infinite. Accuracy: that of p. */
fret_status fret_field_peak(const fret_field *field, fret_real *r, fret_real *p);
/* Pressed to the largest pressure p0 [Pa] > 0, or to the mean pressure F_N/(pi a^2): by the root of ln p(ln
 * F_N). Errors: FRET_NOT_POSITIVE, FRET_NOT_FINITE; FRET_OUTSIDE where no load has that pressure,
 * FRET_TABLE_SHORT where the gap ends before; FRET_SINGULAR. Accuracy: that of p, and the rounding of F_N to
 * double. */
fret_status fret_press_by_peak(const fret_normal *normal, double p0, fret_press *out);
fret_status fret_press_by_mean(const fret_normal *normal, double pmean, fret_press *out);

/* u_z(r) = (2 cos(pi k/2)/pi) int_0^a x^k (delta_z-g(x)) (r^2-x^2)^(-(1+k)/2) dx for r > a [m], both bodies
 * together; delta_z - f(r) inside. */
fret_status fret_field_surface(const fret_field *field, fret_real r, fret_real *w);
/* q_x(r) [Pa] and u_x(r) [m], the mean over the angle: the same with -u'(x) and c_T, and u(x). */
fret_status fret_field_traction(const fret_field *field, fret_real r, fret_real *q);
fret_status fret_field_surface_x(const fret_field *field, fret_real r, fret_real *u);
/* Local slip s(r) = delta_x - u_x(r) [m], exactly 0 where all springs within r stick since they touched; what
 * friction works on within this theory: of first loading 2 pi int mu p s r dr = W. Outside the contact it is
 * how far the surfaces there have moved past each other. Accuracy as of u_x, of delta_x. */
fret_status fret_field_slip(const fret_field *field, fret_real r, fret_real *s);

/* How far p, u_z, q_x and u_x are off by the law's polynomials and rounding, of their largest values [1]; NAN
 * where the law has a formula. */
double fret_field_error(const fret_field *field);

/* Stress [Pa], tension positive, in homogeneous bodies (k = 0), x along F_x, z > 0 into the one that F_x
 * pushes along x, z < 0 into the other. Of the line loads q_z = c_N w(t), q_x = c_T u(t) on the imaginary
 * axis, sigma_ij(x,y,z) = (1/2 pi) Re int_-a^a [q_z P_ij + q_x Q_ij] dt,   zeta = z + i t, rho^2 =
 * x^2+y^2+zeta^2, with V = 1/rho, L = ln(rho+zeta), chi = zeta L - rho, subscripts derivatives: P_xx = 2nu
 * V_zeta - (1-2nu) L_xx - z V_xx, P_yy alike, P_zz = V_zeta - z V_zeta,zeta, P_xy = -(1-2nu) L_xy - z V_xy,
 * P_xz = -z V_x,zeta, P_yz = -z V_y,zeta; Q_xx = 2(1+nu) V_x + 2nu chi_xxx - z L_xxx, Q_yy = 2nu V_x + 2nu
 * chi_xyy - z L_xyy, Q_zz = -z V_x,zeta, Q_xy = V_y + 2nu chi_xxy - z L_xxy, Q_xz = V_zeta - z V_xx, Q_yz =
 * -z V_xy (Boussinesq's and Cerruti's points). At the surface the limit from z > 0. */
typedef struct fret_stress {
    double xx, yy, zz, xy, xz, yz;
} fret_stress;

/* nu: of the body that (x, y, z) [m] lies in. Accuracy 1e-12 of the largest pressure; less where that is
 * infinite, or the contact reaches but little beyond a flat end. Some 5 us of a power law and one slip zone,
 * as much for every two cells of other laws. Errors: FRET_OUTSIDE: k != 0, for which no such form is known,
 * and a contact that has swung (fret_contact_chords first: then 1e-6, and a thousand times as long);
 * FRET_BAD_NU, FRET_NOT_FINITE; FRET_SINGULAR where p is infinite; FRET_INTERRUPTED. */
fret_status fret_field_stress(const fret_field *field, double nu, double x, double y, double z,
                              fret_stress *out);

/* Of von Mises; principal stresses, the largest first, to 1e-8 of it where two are equal; of Tresca: the
 * largest less the smallest. */
double fret_stress_mises(const fret_stress *stress);
void fret_stress_principal(const fret_stress *stress, double out[3]);
double fret_stress_tresca(const fret_stress *stress);

FRET_END

#endif
