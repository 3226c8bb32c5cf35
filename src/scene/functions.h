/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What rows of the table of quantities call: functions of a scene, and results that take more than a look. */
#ifndef SCENE_FUNCTIONS_H
#define SCENE_FUNCTIONS_H

#include "scene/scene.h"

typedef bool quantity_get_function(scene *s, long double *out, calc_error *error);
typedef bool quantity_call_function(scene *s, value arg, long double *out, calc_error *error);

/* results.c */
quantity_get_function get_FN, get_p0, get_pmean, get_Un, get_dW, get_kn, get_a0, get_dz0, get_dxmax,
    get_dx0max, get_kappa, get_W1D, get_time, get_drig, get_Vwear, get_dVwear;

/* functions.c: of the scene, tangentially unloaded */
quantity_call_function call_a, call_dz, call_FN, call_p0, call_c, call_dx, call_Fx, call_dW, call_dWd;

/* damper.c: over a closed cycle of an amplitude, at constant F_N */
quantity_call_function call_Ksec, call_Kp, call_Kpp, call_loss_factor;

/* fields.c: at a place, state now */
quantity_call_function call_E, call_f, call_g, call_p, call_qx, call_uz, call_ux, call_slip, call_WdA,
    call_dWdA, call_hwear, call_dhwear;
quantity_call_function call_w1D, call_u1D, call_s1D, call_qz1D, call_qx1D, call_cN, call_cT;

/* Stress inside. */
typedef bool quantity_call_at(scene *s, const value place[3], long double *out, calc_error *error);
quantity_call_at call_sxx, call_syy, call_szz, call_sxy, call_sxz, call_syz, call_mises, call_tresca,
    call_sigma1, call_sigma3;

/* The largest mises in the plane of F_x, of the first body (side 1) or the second (-1), where contact has the
 * radius a, and its place x, z; false: there is none. */
bool scene_hardest(scene *s, long double a, int side, long double at[2], long double *most);

/* The foundation of the scene, whether or not it has a geometry; normal: only c_N is wanted. */
bool foundation_of(scene *s, bool normal, fret_foundation *out, calc_error *error);

#endif
