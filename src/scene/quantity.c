/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The table of quantities, and how its rows are evaluated. Uses the library and `text`. */
#include "scene/quantity.h"

#include <string.h>

#include "scene/functions.h"

#define INPUT(which) .of = OF_INPUT, .in = 1 + (which), .reads = INPUT_BIT(which)
#define PRESS(member) .of = OF_PRESS, .at = offsetof(fret_press, member), .load = true
#define LOADING(member)                                                                                      \
    .of = OF_LOADING, .at = offsetof(fret_loading, member), .at_state = offsetof(fret_state, member),        \
    .closed = scene_closed_state, .load = true
#define STATE(member) .of = OF_STATE, .at_state = offsetof(fret_state, member), .load = true
#define FOUNDATION(member)                                                                                   \
    .of = OF_FOUNDATION, .at = offsetof(fret_foundation, member), .reads = READS_MATERIAL
#define IMPOSED(which) .in = 1 + (which), .imposed = "press"
#define TWIN(member) .of = OF_TWIN, .at = offsetof(fret_press, member)
#define GETTER(function) .of = OF_GETTER, .get = function
#define CALLED(what, name, ...) .calls = what, .argument = #name, .argument_d = __VA_ARGS__
#define CALL(function, name, ...) .call = call_##function, CALLED(CALL_OWN, name, __VA_ARGS__)
#define FIELD(function) .field = fret_field_##function, CALLED(CALL_FIELD, r, LENGTH)
#define STRESS                                                                                               \
    .d = PRESSURE, .of = OF_FUNCTION, .calls = CALL_STRESS, .argument = "x, y, z", .argument_d = LENGTH,     \
    .by = MODEL_MEMORY, .reads = READS_TANGENTIAL | INPUT_BIT(IN_SB), .load = true
#define FORCE                                                                                                \
    { 1, 0, 0, 0 }
#define LENGTH                                                                                               \
    { 0, 1, 0, 0 }
#define PRESSURE                                                                                             \
    { 1, -2, 0, 0 }
#define ENERGY                                                                                               \
    { 1, 1, 0, 0 }
#define STIFFNESS                                                                                            \
    { 1, -1, 0, 0 }
#define VOLUME                                                                                               \
    { 0, 3, 0, 0 }
#define ANGLE                                                                                                \
    { 0, 0, 1, 0 }

/* clang-format off */
static const quantity quantities[] = {
    /* ---- inputs ---- */
    {.name = "E0", .title = "characteristic modulus", .keywords = "Young stiffness", .d = PRESSURE, INPUT(IN_E0),
     .formulas = {{"E(z) = E0 (z/c0)^k", "(1)", 0}}},
    {.name = "nu", .title = "Poisson's ratio", .keywords = "poisson", INPUT(IN_NU),
     .formulas = {{"-1 < nu <= 1/2", "(4),(5),(A1),(A2),(A3)", 0}}},
    {.name = "k", .title = "exponent of grading", .keywords = "gradient graded inhomogeneity", INPUT(IN_K),
     .formulas = {{"-1 < k < 1", "(1)", 0}}},
    {.name = "c0", .title = "characteristic depth", .keywords = "grading", .d = LENGTH, INPUT(IN_C0),
     .formulas = {{"E(c0) = E0", "(1)", 0}}},
    {.name = "E0_2", .title = "modulus of the second body", .d = PRESSURE, INPUT(IN_E0_2),
     .formulas = {{"as E0; default: same", "(4),(5)", 0}}},
    {.name = "nu_2", .title = "Poisson's ratio of the second body", INPUT(IN_NU_2),
     .formulas = {{"as nu; default: same", "(4),(5)", 0}}},
    {.name = "G0", .title = "shear modulus", .keywords = "Young shear stiffness rigidity", .d = PRESSURE, INPUT(IN_G0),
     .formulas = {{"G0 = E0/(2(1+nu)), in place of E0", "(28)", 0}}},
    {.name = "G0_2", .title = "shear modulus of the second body", .d = PRESSURE, INPUT(IN_G0_2),
     .formulas = {{"as G0; default: same", "(28)", 0}}},
    {.name = "Estar", .title = "effective modulus E* of both bodies, k = 0", .keywords = "E* reduced contact composite plane strain Hertz E'", .d = PRESSURE,
     INPUT(IN_ESTAR), .formulas = {{"1/E* = sum (1-nu^2)/E0, in place of E0 (Johnson, Contact Mechanics, 4.2; E' of other books is 2 E*)", "(4)", 0}}},
    {.name = "mu", .title = "coefficient of friction", .keywords = "Coulomb Amontons", INPUT(IN_MU),
     .formulas = {{"|q_x| <= mu p", "(14)", 0}}},
    {.name = "n", .title = "exponent of the gap", INPUT(IN_N), .formulas = {{"f = A r^n", "(6)", 0}}},
    {.name = "A", .title = "coefficient of the gap", INPUT(IN_A), .formulas = {{"f = A r^n", "(6)", 0}}},
    {.name = "h", .title = "gap at r0", .d = LENGTH, INPUT(IN_H), .formulas = {{"f = h (r/r0)^n", "(6)", 0}}},
    {.name = "r0", .title = "reference radius of the gap", .d = LENGTH, INPUT(IN_R0),
     .formulas = {{"f = h (r/r0)^n", "(6)", 0}}},
    {.name = "R", .title = "radius of curvature", .d = LENGTH, INPUT(IN_RADIUS),
     .formulas = {{"f = r^2/(2R); from a flat end (r-b)^2/(2R) or (r^2-b^2)/(2R); of an exact sphere R-sqrt(R^2-r^2)", "(6)", 0}}},
    {.name = "b", .title = "radius of the flat end", .d = LENGTH, INPUT(IN_B),
     .formulas = {{"f = 0 for r < b", "(3)", 0}}},
    {.name = "slope", .title = "slope of the flank", .keywords = "angle", INPUT(IN_SLOPE),
     .formulas = {{"f = slope r, from a flat end slope (r-b); slope = tan(angle)", "(6)", 0}}},
    {.name = "FA", .title = "force amplitude of the last cycle", .keywords = "oscillation", .d = FORCE, INPUT(IN_FA),
     .formulas = {{"F_x = FA sin(2 pi t)", NULL, 0}}},
    {.name = "dxA", .title = "displacement amplitude of the last cycle", .d = LENGTH, INPUT(IN_DXA),
     .formulas = {{"delta_x = dxA sin(2 pi t)", NULL, 0}}},
    {.name = "drigA", .title = "displacement amplitude at the rig of the last cycle", .keywords = "stroke machine", .d = LENGTH, INPUT(IN_DRIGA),
     .formulas = {{"drig = drigA sin(2 pi t)", NULL, 0}}},
    {.name = "FNA", .title = "amplitude of the normal force in the last cycle", .d = FORCE, INPUT(IN_FNA),
     .formulas = {{"F_N + FNA sin(2 pi t + phase)", NULL, 0}}},
    {.name = "phase", .title = "phase of the normal force in the last cycle", .d = ANGLE, INPUT(IN_PHASE),
     .formulas = {{"F_N + FNA sin(2 pi t + phase)", NULL, 0}}},
    {.name = "K_rig", .title = "stiffness of the rig", .keywords = "compliance machine series frame", .d = STIFFNESS, INPUT(IN_K_RIG),
     .formulas = {{"drig = dx + Fx/K_rig", NULL, 0}}},
    {.name = "d0", .title = "offset of the rig's displacements", .keywords = "zero machine reading", .d = LENGTH, INPUT(IN_D0),
     .formulas = {{"reading = drig + d0", NULL, 0}}},
    {.name = "F0", .title = "offset of the rig's forces", .keywords = "zero machine reading", .d = FORCE, INPUT(IN_F0),
     .formulas = {{"reading = Fx + F0", NULL, 0}}},
    {.name = "yield", .title = "yield stress", .keywords = "plasticity yields strength mises", .d = PRESSURE, INPUT(IN_YIELD),
     .formulas = {{"a note says where mises exceeds it", NULL, 0}}},
    {.name = "yield_2", .title = "yield stress of the second body", .keywords = "plasticity yields strength mises", .d = PRESSURE, INPUT(IN_YIELD_2),
     .formulas = {{"as yield, of the second body", NULL, 0}}},
    {.name = "sB", .title = "bulk stress along x of the first body", .keywords = "fatigue tension fretting", .d = PRESSURE, INPUT(IN_SB),
     .formulas = {{"added to sxx", NULL, 0}}},
    {.name = "alpha_w", .title = "wear coefficient: worn volume per energy dissipated", .keywords = "wear coefficient energy law Archard Fouvry", .d = {-1, 2, 0, 0},
     .unit = "um^3/J", INPUT(IN_ALPHA_W),
     .formulas = {{"V = alpha_w W (Fouvry et al., Wear 255, 2003); of Archard's V = K F_N s/H it is K/(mu H)", NULL, 0}}},
    {.name = "Nw", .title = "number of cycles of wear", .keywords = "number worn", INPUT(IN_NW),
     .formulas = {{"the gap is that after Nw cycles like the last one", NULL, 0}}},
    {.name = "FN", .title = "normal force", .keywords = "load preload", .d = FORCE, .in = 1 + IN_FN, GETTER(scene_FN), .at = offsetof(fret_press, F), CALLED(CALL_PRESS, d, LENGTH),
     .reads = READS_NORMAL, .load = true,
     .formulas = {{"F_N = 2 c_N0 c0^-k kappa A n a^(n+k+1)/((k+1)(n+k+1))", "(13)", WHEN_POWER},
                  {"F_N = 2 int_0^a c_N(x) [g(a)-g(x)] dx", "(12)", 0}}},

    /* ---- state now ---- */
    {.name = "dz", IMPOSED(IN_DZ), .title = "indentation depth", .keywords = "approach penetration", .d = LENGTH, PRESS(dz), CALLED(CALL_PRESS, F, FORCE),
     .reads = READS_NORMAL,
     .formulas = {{"delta_z = kappa A a^n", "(10)", WHEN_POWER}, {"delta_z = g(a)", "(10)", 0}}},
    {.name = "a", IMPOSED(IN_CONTACT), .title = "contact radius", .keywords = "Hertz size area", .d = LENGTH, PRESS(a), CALLED(CALL_PRESS, F, FORCE),
     .reads = READS_NORMAL,
     .formulas = {{"F_N = 2 c_N0 c0^-k kappa A n a^(n+k+1)/((k+1)(n+k+1))", "(10),(13)", WHEN_POWER},
                  {"F_N = 2 int_0^a c_N(x) [g(a)-g(x)] dx", "(10),(12)", 0}}},
    {.name = "p0", .by = MODEL_QUADRATURE, IMPOSED(IN_P0), .title = "largest contact pressure", .keywords = "peak maximum pressure stress Hertz", .d = PRESSURE,
     GETTER(get_p0), CALL(p0, F, FORCE), .reads = READS_NORMAL, .load = true,
     .formulas = {{"p_0 = max p(r); of Hertz 3 F_N/(2 pi a^2) at r = 0 (Johnson, Contact Mechanics, 4.2)", "inverse of (3)", 0}}},
    {.name = "pmean", IMPOSED(IN_PMEAN), .title = "mean contact pressure", .keywords = "average pressure stress hardness", .d = PRESSURE,
     GETTER(get_pmean), .reads = READS_NORMAL, .load = true, .formulas = {{"F_N/(pi a^2)", NULL, 0}}},
    {.name = "Un", .title = "elastic energy of the normal contact", .keywords = "strain stored work impact", .d = ENERGY, GETTER(get_Un),
     .reads = READS_NORMAL, .load = true,
     .formulas = {{"U_n = int F_N d(delta_z) = n/(2n+k+1) F_N delta_z", "(10),(13)", WHEN_POWER}, {"U_n = int F_N d(delta_z)", "(10),(12)", 0}}},
    {.name = "Fx", .imposed = "step", .title = "tangential force", .keywords = "shear Mindlin Cattaneo", .d = FORCE, LOADING(Fx),
     CALLED(CALL_LOADING, d, LENGTH), .reads = READS_TANGENTIAL,
     .formulas = {{"|F_x| = mu F_N [1-(c/a)^(n+k+1)]", "(16),(18)", WHEN_FIRST | WHEN_POWER},
                  {"|F_x| = mu [F_N(a)-F_N(c)]", "(16)", WHEN_FIRST},
                  {"F_x = mu int sigma dF_N, sigma = -u'(y)/(mu eta) along depths y = g(x)", NULL, 0}}},
    {.name = "dx", .imposed = "step", .title = "tangential displacement", .keywords = "shear", .d = LENGTH, LOADING(dx), CALLED(CALL_LOADING, F, FORCE),
     .reads = READS_TANGENTIAL,
     .formulas = {{"|delta_x| = mu eta delta_z [1-(c/a)^n]; gross slip goes on from there", "(15),(17)", WHEN_FIRST | WHEN_POWER},
                  {"|delta_x| = mu eta [g(a)-g(c)]; gross slip goes on from there", "(15)", WHEN_FIRST},
                  {"Masing: (delta_1-delta_x)/2 = delta_first((F_1-F_x)/2), from the turning point (F_1, delta_1); gross slip goes on from there", NULL, WHEN_LATER},
                  {"delta_x = mu eta int sigma dy, sigma = -u'(y)/(mu eta) along depths y = g(x); gross slip goes on from there", NULL, 0}}},
    {.name = "drig", .imposed = "step", .title = "tangential displacement at the rig", .keywords = "machine compliance", .d = LENGTH,
     GETTER(get_drig), .closed = scene_closed_state, .reads = READS_TANGENTIAL, .load = true, .formulas = {{"drig = dx + Fx/K_rig", NULL, 0}}},
    {.name = "c", .title = "stick radius", .keywords = "slip annulus Cattaneo", .d = LENGTH, LOADING(c), CALLED(CALL_LOADING, F, FORCE),
     .reads = READS_TANGENTIAL,
     .formulas = {{"c/a = (1-|F_x|/(mu F_N))^(1/(n+k+1))", "(18)", WHEN_FIRST | WHEN_POWER},
                  {"|F_x| = mu [F_N(a)-F_N(c)]", "(16)", WHEN_FIRST},
                  {"Masing: |F_1-F_x| = 2 mu [F_N(a)-F_N(c)], from the turning point F_1", NULL, WHEN_LATER},
                  {"c = inner edge of the outermost springs with |u| = mu eta (delta_z-g)", NULL, 0}}},
    {.name = "W", .title = "energy dissipated so far", .keywords = "hysteresis dissipation loss work heat", .d = ENERGY,
     STATE(W), .reads = READS_TANGENTIAL,
     .formulas = {{"W = int |c_T u| |d(delta_x)-du| dx, the friction work of all springs", NULL, 0}}},
    {.name = "U", .title = "stored tangential energy", .keywords = "elastic", .d = ENERGY, STATE(U),
     .reads = READS_TANGENTIAL, .formulas = {{"U = 1/2 int c_T u^2 dx", NULL, 0}}},
    {.name = "dW", .title = "energy dissipated per cycle", .keywords = "hysteresis loop dissipation loss damping Mindlin",
     .d = ENERGY, GETTER(scene_cycle_loss), .closed = scene_closed_loss, CALLED(CALL_LOSS, FA, FORCE), .reads = READS_TANGENTIAL, .load = true,
     .formulas = {{"dW = [8 mu^2 (1+k) (n+k+1)^2 c0^k F_N^2/(n (2n+k+1) 2 c_T0 a^(k+1))] "
                   "[1-(1-t)^(1+q)-(1+q)/2 t (1+(1-t)^q)], t = FA/(mu F_N), q = n/(n+k+1); gross slip adds 4 mu F_N (dxA-dxmax)", "(27)", WHEN_STEADY | WHEN_POWER},
                  {"dW = 8 mu^2 eta int_c^a c_N (g(a)-g(x)) (g(x)-g(c)) dx; gross slip adds 4 mu F_N (dxA-dxmax)", "(26)", WHEN_STEADY},
                  {"dW = [W at the end of the last period]-[W at its beginning]", NULL, 0}}},
    {.name = "Vwear", .by = MODEL_BLOCKS, .title = "worn volume so far", .keywords = "wear Archard", .d = VOLUME, .unit = "um^3",
     GETTER(get_Vwear), .reads = READS_WORN, .load = true, .formulas = {{"2 pi int hwear r dr = alpha_w times the work of Nw cycles", NULL, 0}}},
    {.name = "dVwear", .title = "volume worn by the last closed cycle", .keywords = "wear rate Archard", .d = VOLUME, .unit = "um^3",
     GETTER(get_dVwear), .closed = scene_closed_loss, .reads = READS_WORN, .load = true, .formulas = {{"alpha_w dW", NULL, 0}}},
    {.name = "dWd", .title = "energy dissipated per cycle at a displacement amplitude", .keywords = "hysteresis dissipation gross slip", .d = ENERGY,
     .of = OF_FUNCTION, CALLED(CALL_LOSS, dxA, LENGTH), .reads = READS_TANGENTIAL, .load = true,
     .formulas = {{"dW(FA(dxA)); beyond dxmax gross slip adds 4 mu F_N (dxA-dxmax)", "(26)", 0}}},
    {.name = "Ksec", .title = "secant stiffness of the loop", .keywords = "damper amplitude", .d = STIFFNESS, .of = OF_FUNCTION,
     CALL(Ksec, FA, FORCE), .argument_or = LENGTH, .reads = READS_TANGENTIAL, .load = true,
     .formulas = {{"FA/dx(FA); Fx(dxA)/dxA", NULL, 0}}},
    {.name = "Kp", .by = MODEL_QUADRATURE, .title = "first-harmonic stiffness at dx = dxA cos(theta)",
     .keywords = "damper storage equivalent harmonic balance", .d = STIFFNESS, .of = OF_FUNCTION, CALL(Kp, dxA, LENGTH),
     .reads = READS_TANGENTIAL, .load = true,
     .formulas = {{"K' = 2/(pi dxA) int_0^pi F cos(theta) d theta, F = FA-2 F_1((dxA-dx)/2), F_1 first loading", NULL, 0}}},
    {.name = "Kpp", .title = "first-harmonic loss stiffness", .keywords = "damper damping equivalent viscous harmonic balance",
     .d = STIFFNESS, .of = OF_FUNCTION, CALL(Kpp, dxA, LENGTH), .reads = READS_TANGENTIAL, .load = true,
     .formulas = {{"K'' = dWd(dxA)/(pi dxA^2); viscous damping K''/omega", NULL, 0}}},
    {.name = "loss_factor", .by = MODEL_QUADRATURE, .title = "loss factor of the loop", .keywords = "damper damping tan delta",
     .of = OF_FUNCTION, CALL(loss_factor, FA, FORCE), .argument_or = LENGTH, .reads = READS_TANGENTIAL, .load = true,
     .formulas = {{"K''/K' at dxA = dx(FA), or at dxA", NULL, 0}}},
    {.name = "dxmax", .title = "tangential displacement where gross slip begins", .keywords = "sliding", .d = LENGTH, GETTER(get_dxmax),
     .reads = READS_TANGENTIAL, .load = true,
     .formulas = {{"delta_x,max = mu eta delta_z", "(17) with c = 0", WHEN_POWER}, {"delta_x,max = mu eta delta_z", "(15) with c = 0", 0}}},
    {.name = "a0", .title = "reference radius", .d = LENGTH, TWIN(a), .reads = READS_NORMAL, .load = true,
     .formulas = {{"a for k = 0, same F_N and E0", "(23)", 0}}},
    {.name = "dz0", .title = "indentation depth for k = 0", .d = LENGTH, TWIN(dz), .reads = READS_NORMAL, .load = true,
     .formulas = {{"delta_z for k = 0, same F_N and E0", "(10)", 0}}},
    {.name = "dx0max", .title = "tangential displacement where gross slip begins, for k = 0", .d = LENGTH, GETTER(get_dx0max),
     .reads = READS_TANGENTIAL, .load = true,
     .formulas = {{"mu eta delta_z for k = 0", "(17) with c = 0", WHEN_POWER}, {"mu eta delta_z for k = 0", "(15) with c = 0", 0}}},
    {.name = "kn", .title = "normal stiffness", .keywords = "compliance", .d = STIFFNESS, GETTER(get_kn), .reads = READS_NORMAL,
     .load = true,
     .formulas = {{"dF_N/d(delta_z) = 2 c_N0 c0^-k a^(k+1)/(k+1)", "(10),(13)", WHEN_POWER},
                  {"dF_N/d(delta_z) = 2 c_N0 c0^-k a^(k+1)/(k+1)", "(10),(12)", 0}}},
    {.name = "kt", .title = "tangential stiffness in the direction of the last step", .keywords = "compliance", .d = STIFFNESS, STATE(kt),
     .reads = READS_TANGENTIAL,
     .formulas = {{"dF_x/d(delta_x) = F_N'(y_c)/eta, y_c = g(c), or delta_z where the step draws springs off their bound", "(17),(18)", WHEN_FIRST | WHEN_POWER},
                  {"dF_x/d(delta_x) = F_N'(y_c)/eta, y_c = g(c), or delta_z where the step draws springs off their bound", "(15),(16)", WHEN_FIRST},
                  {"dF_x/d(delta_x) = F_N'(y_c)/eta, y_c = g(c), or delta_z where the step draws springs off their bound", NULL, 0}}},
    {.name = "W1D", .title = "force of the springs times their present slip", .keywords = "dissipation", .d = ENERGY, GETTER(get_W1D),
     .reads = READS_TANGENTIAL, .load = true,
     .formulas = {{"W1D = -2 int_0^a c_T |u| |delta_x-u| dx", "(22)", 0}}},
    {.name = "time", .title = "time along the load", .keywords = "phase instant", GETTER(get_time), .load = true,
     .formulas = {{"0 at the press, 1 more each step, 1/4 to the first peak of a cycle, 1 more each period", NULL, 0}}},

    /* ---- coefficients ---- */
    {.name = "eta", .title = "ratio of normal to tangential stiffness", .keywords = "Mindlin ratio", FOUNDATION(eta), .formulas = {{"eta = c_N/c_T", "(4),(5)", 0}}},
    {.name = "hN", .title = "normal coefficient of the first body", FOUNDATION(hN),
     .formulas = {{"h_N = (1+k) (1-nu) cos(pi k/2)/(Q S P), Q = 1-(1+k) nu, S = sin(pi beta/2)/beta, "
                   "P = Gamma((3+k+beta)/2) Gamma((3+k-beta)/2)/Gamma(1+k/2)^2", "(A1)", 0}}},
    {.name = "hT", .title = "tangential coefficient of the first body", FOUNDATION(hT),
     .formulas = {{"h_T = 2 cos(pi k/2)/((1+nu) [1+(1-nu) S P]), S = sin(pi beta/2)/beta, "
                   "P = Gamma((3+k+beta)/2) Gamma((3+k-beta)/2)/Gamma(1+k/2)^2", "(A2)", 0}}},
    {.name = "beta_k", .title = "beta of the first body", FOUNDATION(beta),
     .formulas = {{"beta^2 = (1+k)(1-k nu/(1-nu))", "(A3)", 0}}},
    {.name = "kappa", .title = "shape factor", GETTER(get_kappa), .reads = INPUT_BIT(IN_K) | INPUT_BIT(IN_N),
     .formulas = {{"kappa = (n/2) B(n/2,(k+1)/2)", "(8)", 0}}},
    {.name = "cN", .title = "normal foundation modulus, at c0 or at x", .keywords = "stiffness Winkler", .d = PRESSURE, FOUNDATION(cN0),
     CALLED(CALL_MODULUS, x, LENGTH), .formulas = {{"c_N(x) = c_N0 (x/c0)^k", "(4)", WHEN_CALL}, {"1/c_N0 = sum (1-nu^2)/(h_N E0)", "(4)", 0}}},
    {.name = "cT", .title = "tangential foundation modulus, at c0 or at x", .keywords = "stiffness Winkler", .d = PRESSURE, FOUNDATION(cT0),
     CALLED(CALL_MODULUS, x, LENGTH), .formulas = {{"c_T(x) = c_T0 (x/c0)^k", "(5)", WHEN_CALL}, {"1/c_T0 = sum 1/(h_T E0)", "(5)", 0}}},

    /* ---- at a place ---- */
    {.name = "E", .title = "modulus at depth z", .keywords = "Young grading", .d = PRESSURE, .of = OF_FUNCTION, CALL(E, z, LENGTH),
     .reads = INPUT_MODULUS | INPUT_BIT(IN_NU) | INPUT_BIT(IN_K) | INPUT_BIT(IN_C0), .formulas = {{"E(z) = E0 (z/c0)^k", "(1)", 0}}},
    {.name = "f", .title = "gap at radius r", .keywords = "shape profile", .d = LENGTH, .of = OF_FUNCTION, CALL(f, r, LENGTH),
     .reads = INPUT_BIT(IN_NW) | INPUT_GEOMETRY, .formulas = {{"f(r) = A r^n", "(6)", WHEN_POWER}, {"f(r)", "(3)", 0}}},
    {.name = "g", .title = "equivalent profile", .keywords = "shape", .d = LENGTH, .of = OF_FUNCTION, CALL(g, x, LENGTH),
     .reads = INPUT_BIT(IN_NW) | INPUT_GEOMETRY | INPUT_BIT(IN_K),
     .formulas = {{"g(x) = kappa A x^n", "(7)", WHEN_POWER},
                  {"g(x) = x^(1-k) int_0^x f'(r) (x^2-r^2)^((k-1)/2) dr", "(3)", 0}}},
    {.name = "p", .by = MODEL_QUADRATURE, .title = "contact pressure", .keywords = "stress Hertz", .d = PRESSURE, .of = OF_FUNCTION, FIELD(pressure),
     .reads = READS_NORMAL, .load = true,
     .formulas = {{"p(r) = (c_N0 c0^-k/pi) int_r^a g'(x) (x^2-r^2)^((k-1)/2) dx", "inverse of (3)", 0}}},
    {.name = "qx", .by = MODEL_MEMORY, .title = "tangential traction", .keywords = "stress shear", .d = PRESSURE, .of = OF_FUNCTION, FIELD(traction),
     .reads = READS_TANGENTIAL, .load = true,
     .formulas = {{"q_x(r) = -(c_T0 c0^-k/pi) int_r^a u'(x) (x^2-r^2)^((k-1)/2) dx", "inverse of (3)", 0}}},
    {.name = "uz", .by = MODEL_QUADRATURE, .title = "normal surface displacement, sum of both bodies", .keywords = "deformation", .d = LENGTH, .of = OF_FUNCTION,
     FIELD(surface), .reads = READS_NORMAL, .load = true,
     .formulas = {{"u_z(r) = (2 cos(pi k/2)/pi) int_0^min(r,a) x^k (delta_z-g) (r^2-x^2)^(-(1+k)/2) dx", "inverse of (3)", 0}}},
    {.name = "ux", .by = MODEL_MEMORY, .title = "tangential surface displacement, sum of both bodies, mean over the angle", .keywords = "deformation", .d = LENGTH,
     .of = OF_FUNCTION, FIELD(surface_x), .reads = READS_TANGENTIAL, .load = true,
     .formulas = {{"u_x(r) = (2 cos(pi k/2)/pi) int_0^min(r,a) x^k u(x) (r^2-x^2)^(-(1+k)/2) dx", "inverse of (3)", 0}}},
    {.name = "slip", .by = MODEL_MEMORY, .title = "local slip, mean over the angle", .keywords = "relative displacement fretting annulus", .d = LENGTH,
     .of = OF_FUNCTION, FIELD(slip), .reads = READS_TANGENTIAL, .load = true,
     .formulas = {{"s(r) = delta_x-u_x(r)", "inverse of (3)", 0}}},
    {.name = "WdA", .by = MODEL_MEMORY, .title = "friction's work per area so far", .keywords = "dissipation energy wear fretting density", .d = STIFFNESS,
     .unit = "J/m^2", .of = OF_FUNCTION, CALL(WdA, r, LENGTH), .reads = READS_TANGENTIAL, .load = true,
     .formulas = {{"int q_x(r,t) ds(r,t) over the load program; 2 pi int WdA r dr = W, as far out as contact ever was", NULL, 0}}},
    {.name = "dWdA", .by = MODEL_MEMORY, .title = "friction's work per area in the last closed cycle", .keywords = "dissipation energy wear fretting density",
     .d = STIFFNESS, .unit = "J/m^2", .of = OF_FUNCTION, CALL(dWdA, r, LENGTH), .reads = READS_TANGENTIAL, .load = true,
     .formulas = {{"the integral of q_x ds over a period; at constant F_N 4 mu p(r) s(r), s at the amplitude", NULL, 0}}},
    {.name = "dhwear", .by = MODEL_MEMORY, .title = "depth worn by the last closed cycle", .keywords = "wear rate scar fretting Archard", .d = LENGTH,
     .of = OF_FUNCTION, CALL(dhwear, r, LENGTH), .reads = READS_WORN, .load = true, .formulas = {{"alpha_w dWdA(r)", NULL, 0}}},
    {.name = "hwear", .by = MODEL_BLOCKS, .title = "worn depth so far", .keywords = "wear scar fretting Archard profile", .d = LENGTH,
     .of = OF_FUNCTION, CALL(hwear, r, LENGTH), .reads = READS_WORN, .load = true,
     .formulas = {{"dhwear(r) added up over Nw cycles, each with the gap that those before leave", NULL, 0}}},
    {.name = "w1D", .title = "normal spring displacement", .keywords = "Winkler springs", .d = LENGTH, .of = OF_FUNCTION, CALL(w1D, x, LENGTH),
     .reads = READS_NORMAL, .load = true, .formulas = {{"w_1D(x) = delta_z-g(x)", "(9)", 0}}},
    {.name = "u1D", .by = MODEL_MEMORY, .title = "tangential spring displacement", .keywords = "Winkler springs", .d = LENGTH, .of = OF_FUNCTION,
     CALL(u1D, x, LENGTH), .reads = READS_TANGENTIAL, .load = true,
     .formulas = {{"u_new = clip(u+d(delta_x), -B, B), B = mu eta (delta_z-g(x))", "(19),(20)", 0}}},
    {.name = "s1D", .by = MODEL_MEMORY, .title = "slip of the springs", .keywords = "Winkler springs", .d = LENGTH, .of = OF_FUNCTION, CALL(s1D, x, LENGTH),
     .reads = READS_TANGENTIAL, .load = true, .formulas = {{"s_1D(x) = delta_x-u_1D(x)", "(20)", 0}}},
    {.name = "qz1D", .title = "normal line load", .keywords = "springs", .d = STIFFNESS, .unit = "N/mm", .of = OF_FUNCTION, CALL(qz1D, x, LENGTH),
     .reads = READS_NORMAL, .load = true, .formulas = {{"q_z(x) = c_N(x) w_1D(x)", "(11)", 0}}},
    {.name = "qx1D", .by = MODEL_MEMORY, .title = "tangential line load", .keywords = "springs", .d = STIFFNESS, .unit = "N/mm", .of = OF_FUNCTION, CALL(qx1D, x, LENGTH),
     .reads = READS_TANGENTIAL, .load = true, .formulas = {{"q_x(x) = c_T(x) u_1D(x)", "(14)", 0}}},

    /* ---- in the body ---- */
    {.name = "sxx", .title = "normal stress along x in the body, k = 0, tension positive", .keywords = "subsurface tensor tension bulk surface crack", STRESS, .at = offsetof(fret_stress, xx),
     .formulas = {{"(1/2pi) Re int_-a^a [q_z(t) P_xx + q_x(t) Q_xx] dt at zeta = z+i t (help cracking)", NULL, 0}}},
    {.name = "syy", .title = "normal stress along y in the body, k = 0, tension positive", .keywords = "subsurface tensor ", STRESS, .at = offsetof(fret_stress, yy),
     .formulas = {{"(1/2pi) Re int_-a^a [q_z(t) P_yy + q_x(t) Q_yy] dt at zeta = z+i t (help cracking)", NULL, 0}}},
    {.name = "szz", .title = "normal stress along z in the body, k = 0, tension positive", .keywords = "subsurface tensor ", STRESS, .at = offsetof(fret_stress, zz),
     .formulas = {{"(1/2pi) Re int_-a^a [q_z(t) P_zz + q_x(t) Q_zz] dt at zeta = z+i t (help cracking)", NULL, 0}}},
    {.name = "sxy", .title = "shear stress xy in the body, k = 0", .keywords = "subsurface tensor ", STRESS, .at = offsetof(fret_stress, xy),
     .formulas = {{"(1/2pi) Re int_-a^a [q_z(t) P_xy + q_x(t) Q_xy] dt at zeta = z+i t (help cracking)", NULL, 0}}},
    {.name = "sxz", .title = "shear stress xz in the body, k = 0", .keywords = "subsurface tensor ", STRESS, .at = offsetof(fret_stress, xz),
     .formulas = {{"(1/2pi) Re int_-a^a [q_z(t) P_xz + q_x(t) Q_xz] dt at zeta = z+i t (help cracking)", NULL, 0}}},
    {.name = "syz", .title = "shear stress yz in the body, k = 0", .keywords = "subsurface tensor ", STRESS, .at = offsetof(fret_stress, yz),
     .formulas = {{"(1/2pi) Re int_-a^a [q_z(t) P_yz + q_x(t) Q_yz] dt at zeta = z+i t (help cracking)", NULL, 0}}},
    {.name = "mises", .title = "von Mises equivalent stress in the body, k = 0", .keywords = "yield plastic subsurface", STRESS, .invariant = fret_stress_mises,
     .formulas = {{"sqrt(1/2 [(s1-s2)^2+(s2-s3)^2+(s3-s1)^2]) of the principal stresses", NULL, 0}}},
    {.name = "tresca", .title = "Tresca equivalent stress in the body, k = 0", .keywords = "yield plastic shear subsurface", STRESS, .invariant = fret_stress_tresca,
     .formulas = {{"sigma1-sigma3, twice the largest shear stress", NULL, 0}}},
    {.name = "sigma1", .title = "largest principal stress in the body, k = 0", .keywords = "tension crack principal", STRESS, .invariant = stress_largest,
     .formulas = {{"largest eigenvalue of the stress", NULL, 0}}},
    {.name = "sigma3", .title = "smallest principal stress in the body, k = 0", .keywords = "compression principal", STRESS, .invariant = stress_smallest,
     .formulas = {{"smallest eigenvalue of the stress", NULL, 0}}},
};
/* clang-format on */
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

const quantity *quantity_of_input(input in) {
    size_t i = 0;
    while (quantities[i].in != 1 + (int)in)
        i++;
    return &quantities[i];
}

const quantity *quantity_of_step(load_by by) {
    const char *name = by == BY_FORCE ? "Fx" : by == BY_RIG ? "drig" : "dx";
    return quantity_find(name, strlen(name));
}

static long double member(const void *of, size_t at) {
    long double v;
    memcpy(&v, (const char *)of + at, sizeof v);
    return v;
}

static bool get_state(const quantity *q, scene *s, long double *out, calc_error *error) {
    const fret_state *state;
    if (q->at_state == offsetof(fret_state, kt) && !inputs_know_nu(&s->in))
        return calc_missing(error, IN_NU); /* kt needs c_T, and without friction nothing has checked nu */
    if (!scene_state(s, &state, error))
        return false;
    *out = member(state, q->at_state);
    return true;
}

/* On first loading by the closed form, which keeps every digit also close to gross slip. */
static bool get_loading(const quantity *q, scene *s, long double *out, calc_error *error) {
    fret_loading first;
    if (scene_closed_state(s)) {
        if (!scene_first_loading(s, &first, error))
            return false;
        *out = member(&first, q->at);
        return true;
    }
    return get_state(q, s, out, error);
}

bool quantity_get(const quantity *q, scene *s, long double *out, calc_error *error) {
    const fret_press *press;
    fret_press twin;
    fret_foundation foundation;
    switch (q->of) {
    case OF_INPUT:
        return scene_get(s, quantity_input(q), out, error);
    case OF_PRESS:
        if (!scene_press(s, &press, error))
            return false;
        *out = member(press, q->at);
        return true;
    case OF_TWIN:
        if (!twin_press(s, &twin, error))
            return false;
        *out = member(&twin, q->at);
        return true;
    case OF_LOADING:
        return get_loading(q, s, out, error);
    case OF_STATE:
        return get_state(q, s, out, error);
    case OF_FOUNDATION:
        if (!foundation_of(s, q->at == offsetof(fret_foundation, cN0), &foundation, error))
            return false;
        *out = member(&foundation, q->at);
        return true;
    default:
        return q->get(s, out, error);
    }
}

bool quantity_call(const quantity *q, scene *s, const value arg[], long double *out, calc_error *error) {
    const bool by_force = dim_equal(q->argument_d, DIM_FORCE);
    fret_press press;
    fret_loading first;
    fret_stress stress;
    double component;
    switch (q->calls) {
    case CALL_PRESS:
        if (!pressed_by(s, by_force, arg->v, &press, error))
            return false;
        *out = member(&press, q->at);
        return true;
    case CALL_LOADING:
        if (!scene_loading(s, by_force, (double)arg->v, &first, error))
            return false;
        *out = member(&first, q->at);
        return true;
    case CALL_LOSS:
        return scene_loss(s, by_force, (double)arg->v, out, error);
    case CALL_MODULUS:
        return modulus_at(s, arg->v, q->at == offsetof(fret_foundation, cT0), out, error);
    case CALL_FIELD:
        return field_at(s, q->by == MODEL_MEMORY, q->field, arg->v, out, error);
    case CALL_STRESS:
        if (!stress_at(s, arg, &stress, error))
            return false;
        memcpy(&component, (const char *)&stress + q->at, sizeof component);
        *out = q->invariant ? q->invariant(&stress) : component;
        return true;
    default:
        return q->call(s, *arg, out, error);
    }
}

dim quantity_dim(const quantity *q, const scene *s) {
    if (q->in == 1 + IN_A)
        return (dim){0, 1 - (s->in.geometry && s->in.geometry->n > 0 ? s->in.geometry->n : s->in.v[IN_N]), 0,
                     0};
    return q->d;
}

/* The conditions (WHEN) that are true in the scene. */
static unsigned holds(const quantity *q, scene *s, bool call) {
    const load_reach *reach;
    const unsigned when = scene_is_power(s) ? WHEN_POWER : WHEN_ALWAYS;
    if (call)
        return when | WHEN_CALL | WHEN_FIRST | WHEN_STEADY;
    if (!scene_reach(s, &reach, error_quiet()))
        return when;
    if (reach->normal_varies)
        return when | WHEN_HISTORY;
    if (q->closed == scene_closed_loss ? scene_closed_loss(s) : reach->first)
        return when | WHEN_FIRST | WHEN_STEADY;
    return reach->alike ? when | WHEN_LATER : when;
}

const formula *quantity_formula(const quantity *q, scene *s, bool call) {
    const unsigned when = holds(q, s, call);
    const formula *f = q->formulas;
    while (f->when & ~when) /* the last formula has no condition */
        f++;
    return f;
}

model_id quantity_model(const quantity *q, scene *s, bool call) {
    const model_id closed = scene_is_power(s) ? MODEL_CLOSED : MODEL_PIECES;
    const model_id stepped = s->model != MODEL_AUTO && models[s->model].steps ? s->model : MODEL_MEMORY;
    if (call)
        return q->by ? q->by : closed;
    if (q->closed)
        return q->closed(s) ? closed : stepped;
    switch (q->of) {
    case OF_STATE:
        return stepped;
    case OF_PRESS:
        return holds(q, s, false) & WHEN_HISTORY ? stepped : closed;
    case OF_GETTER:
        return q->get == get_W1D ? MODEL_MEMORY : q->by ? q->by : closed;
    default:
        return closed;
    }
}
