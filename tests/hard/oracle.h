/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a contact of power-law gap ought to give, in 256 bits by MPFR, from the formulas as printed: (A1)-(A3)
 * with Gamma functions, kappa by the beta function, b(t) term by term. Shares no code with the library.
 * Digits that the printed forms lose to cancellation are had in reserve: at least 150 bits remain in every
 * result. */
#ifndef ORACLE_H
#define ORACLE_H

#include <mpfr.h>
#include <stdbool.h>

/* X(name, text): every scalar, in the order of tests/reference/corners.csv. */
#define ORACLE_SCALARS(X)                                                                                    \
    X(HN_1, "hN_1")                                                                                          \
    X(HT_1, "hT_1")                                                                                          \
    X(BETA_1, "beta_1")                                                                                      \
    X(HN_2, "hN_2")                                                                                          \
    X(HT_2, "hT_2")                                                                                          \
    X(BETA_2, "beta_2")                                                                                      \
    X(CN0, "cN0")                                                                                            \
    X(CT0, "cT0")                                                                                            \
    X(ETA, "eta")                                                                                            \
    X(KAPPA, "kappa")                                                                                        \
    X(A_OF_F, "a(F)") /* by normal force */                                                                  \
    X(DZ_OF_F, "dz(F)")                                                                                      \
    X(KN, "kn(F)")                                                                                           \
    X(A_OF_DZ, "a(dz)") /* by depth */                                                                       \
    X(F_OF_DZ, "F(dz)")                                                                                      \
    X(DZ_OF_A, "dz(a)") /* by radius */                                                                      \
    X(F_OF_A, "F(a)")                                                                                        \
    X(DX_MAX, "dxmax")    /* at F_N, as all below */                                                         \
    X(DX_OF_FX, "dx(Fx)") /* first loading by force */                                                       \
    X(C_OF_FX, "c(Fx)")                                                                                      \
    X(YC_OF_FX, "yc(Fx)")                                                                                    \
    X(DW_OF_FX, "dW(FA)") /* cycle of that amplitude */                                                      \
    X(FX_OF_DX, "Fx(dx)") /* first loading by displacement */                                                \
    X(C_OF_DX, "c(dx)")                                                                                      \
    X(YC_OF_DX, "yc(dx)")                                                                                    \
    X(DW_OF_DX, "dW(dxA)")

typedef enum oracle_scalar {
#define X(name, text) ORACLE_##name,
    ORACLE_SCALARS(X)
#undef X
        ORACLE_COUNT
} oracle_scalar;

extern const char *const oracle_names[ORACLE_COUNT];

typedef struct oracle_contact {
    double E0[2], nu[2];
    bool rigid[2];
    double k, c0;
    double n, h, r0; /* gap h (r/r0)^n */
} oracle_contact;

typedef struct oracle oracle;

oracle *oracle_new(void);
void oracle_free(oracle *o);

/* The contact that the functions below are about; Gamma functions of the last one are kept where k, nu and n
 * are the same. */
void oracle_set_contact(oracle *o, const oracle_contact *contact);

/* Presses: fill A_OF_F, DZ_OF_F, KN; A_OF_DZ, F_OF_DZ; DZ_OF_A, F_OF_A. */
void oracle_press_force(oracle *o, double F);
void oracle_press_depth(oracle *o, double dz);
void oracle_press_radius(oracle *o, double a);

/* Tangential loads > 0 at the force pressed with; mu F_N is the exact product. A force within 2^-52 mu F_N of
 * it is gross slip, as the library promises; by displacement whatever is beyond dxmax. */
void oracle_friction(oracle *o, double mu);          /* fills DX_MAX */
void oracle_load_force(oracle *o, double Fx);        /* DX_OF_FX .. DW_OF_FX */
void oracle_load_displacement(oracle *o, double dx); /* FX_OF_DX .. DW_OF_DX */

mpfr_srcptr oracle_value(const oracle *o, oracle_scalar which);

/* t = F_x/mu F_N of the last load by force; x = dx/dxmax of the last by displacement. */
double oracle_t(const oracle *o);
double oracle_x(const oracle *o);

/* |got - exact| in units in the last place of a double of that size; rounding correctly is at most 0.5. */
double oracle_ulps(double got, mpfr_srcptr exact);

#endif
