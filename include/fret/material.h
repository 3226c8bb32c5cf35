/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef FRET_MATERIAL_H
#define FRET_MATERIAL_H

#include <stdbool.h>

#include "fret/status.h"

FRET_BEGIN

/* The elastic bodies and the foundation equivalent to them. Equation numbers here and in the other headers
 * are those of Mathematics 2022, 10, 3641. */

/* One half-space with E(z) = E0 (z/c0)^k; k and c0 are shared by both bodies. */
typedef struct fret_body {
    double E0;  /* characteristic modulus [Pa], > 0 */
    double nu;  /* Poisson's ratio, -1 < nu <= 1/2 */
    bool rigid; /* contributes no compliance; E0 and nu are not read */
} fret_body;

typedef struct fret_material {
    fret_body body[2];
    double k;  /* exponent of elastic inhomogeneity, -1 < k < 1 */
    double c0; /* characteristic depth [m], > 0; without effect at k = 0 */
} fret_material;

/* The equivalent foundation. Coefficients of each body come from forms without cancellation, accurate to
 * 2e-18 relative where long double has 64 bits:
 *   Q = 1-(1+k)nu, beta^2 = (1+k)Q/(1-nu), S = sin(pi beta/2)/beta,
 *   P = Gamma((3+k+beta)/2) Gamma((3+k-beta)/2) / Gamma(1+k/2)^2,
 *   h_N = (1+k)(1-nu) cos(pi k/2)/(Q S P), h_T = 2 cos(pi k/2)/((1+nu)[1+(1-nu)SP]). */
typedef struct fret_foundation {
    fret_real k, c0;
    fret_real cN0, cT0;     /* c_N(x) = cN0 (x/c0)^k, likewise c_T [Pa] (4),(5) */
    fret_real eta;          /* stiffness ratio c_N/c_T */
    fret_real hN[2], hT[2]; /* h_N(k,nu), h_T(k,nu) of each body (A1),(A2); 0 for a rigid one */
    fret_real beta[2];      /* beta(k,nu) (A3); 0 for a rigid one */
    fret_real mismatch;     /* neglected normal-tangential coupling; |Dundurs' second constant| at k = 0 */
    bool similar;           /* uncoupled: equal bodies, or each nu = 1/(2+k), or mismatch 0 at k = 0 */
} fret_foundation;

/* Foundation moduli of two bodies in contact (4),(5):
 *   1/cN0 = sum (1-nu_i^2)/(h_N E0_i), 1/cT0 = sum 1/(h_T E0_i), eta = cN0/cT0.
 * Range: -1 < k < 1, -1 < nu <= 1/2. Errors: FRET_BAD_K, FRET_BAD_NU, FRET_NOT_FINITE, FRET_NOT_POSITIVE
 * (E0, c0), FRET_OVERFLOW, FRET_BOTH_RIGID. */
fret_status fret_foundation_make(const fret_material *material, fret_foundation *out);

FRET_END

#endif
