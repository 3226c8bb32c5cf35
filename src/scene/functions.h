/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Functions that rows of the table of quantities call: getters and functions of a scene. */
#ifndef SCENE_FUNCTIONS_H
#define SCENE_FUNCTIONS_H

#include "scene/scene.h"

typedef bool quantity_get_function(scene *s, long double *out, calc_error *error);
typedef bool quantity_call_function(scene *s, value arg, long double *out, calc_error *error);

/* results.c */
quantity_get_function get_p0, get_pmean, get_Un, get_kn, get_dxmax, get_dx0max, get_kappa, get_W1D, get_time,
    get_drig, get_Vwear, get_dVwear;
quantity_call_function call_p0;
/* The press by a force or to a depth. */
bool pressed_by(scene *s, bool by_force, long double v, fret_press *out, calc_error *error);
/* The press of the same bodies with k = 0 under the present F_N. */
bool twin_press(scene *s, fret_press *out, calc_error *error);

/* damper.c: functions of the amplitude of a closed cycle at constant F_N */
quantity_call_function call_Ksec, call_Kp, call_Kpp, call_loss_factor;

/* fields.c: functions of a place in the present state */
quantity_call_function call_E, call_f, call_g, call_WdA, call_dWdA, call_hwear, call_dhwear, call_w1D,
    call_u1D, call_s1D, call_qz1D, call_qx1D;
/* c_N(x), or c_T(x) [Pa] */
bool modulus_at(scene *s, long double x, bool tangential, long double *out, calc_error *error);
/* Evaluates a field at r: that of the history (dragged) or of the press. */
typedef fret_status field_of_place(const fret_field *of, fret_real r, fret_real *out);
bool field_at(scene *s, bool dragged, field_of_place *ask, long double r, long double *out,
              calc_error *error);
bool stress_at(scene *s, const value place[3], fret_stress *out, calc_error *error);
double stress_largest(const fret_stress *of);
double stress_smallest(const fret_stress *of);

/* The largest von Mises stress in the plane of F_x, in the first body (side 1) or the second (-1), at contact
 * radius a, and its place x, z. False: there is none. */
bool scene_hardest(scene *s, long double a, int side, long double at[2], long double *most);

/* The foundation, whether or not there is a geometry. normal: only c_N is needed, which Estar alone gives. */
bool foundation_of(scene *s, bool normal, fret_foundation *out, calc_error *error);

#endif
