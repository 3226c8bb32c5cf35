/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef FRET_CYCLE_H
#define FRET_CYCLE_H

#include "fret/normal.h"

FRET_BEGIN

/* Closed forms at constant F_N: first loading, gross slip and the energy dissipated per cycle. */

/* A state of first loading, from F_x = 0. */
typedef struct fret_loading {
    fret_real Fx; /* tangential force [N] */
    fret_real dx; /* tangential displacement [m] */
    fret_real c;  /* stick radius [m] */
    fret_real yc; /* profile depth at the stick radius, g(c) [m] */
} fret_loading;

/* delta_x,max = mu eta delta_z [m], the displacement at which gross slip begins: (17) with c = 0. */
fret_real fret_gross_slip(const fret_pressed *contact);

/* First loading to a force [N] or a displacement [m]: F_x = mu [F_N(a)-F_N(c)], delta_x = mu eta [g(a)-g(c)]
 * (16), (15); power law (18),(17): c/a = (1-F_x/mu F_N)^(1/(n+k+1)), delta_x = mu eta delta_z [1-(c/a)^n].
 * Odd in its argument. By force: |Fx| <= mu F_N, else FRET_GROSS_SLIP (limit: mu F_N); a force that equals mu
 * F_N to a relative 2.2e-16, the rounding of the product, counts as mu F_N. By displacement: F_x stays at
 * +-mu F_N beyond delta_x,max. Accuracy, power law: within 1 unit in the last place of a double; by
 * displacement down to |1-dx/delta_x,max| = 1e-9, since delta_x,max itself is known to 2^-96. Other errors:
 * FRET_NOT_POSITIVE (mu, FN), FRET_NOT_FINITE. */
fret_status fret_loading_by_force(const fret_pressed *contact, double Fx, fret_loading *out);
fret_status fret_loading_by_displacement(const fret_pressed *contact, double dx, fret_loading *out);

/* Energy [J], >= 0, dissipated in a closed cycle F_x = -FA .. FA at constant F_N:
 *   8 mu^2 eta int_c^a c_N (g(a)-g(x)) (g(x)-g(c)) dx; power law: w(t) mu F_N delta_x,max (27),
 *   t = FA/(mu F_N). Range 0 <= FA <= mu F_N, else FRET_NEGATIVE, FRET_GROSS_SLIP; other errors as above.
 * Accuracy, power law: within 1 unit in the last place of a double; other shapes, and tables of up to 1000
 * rows: 1e-14. The paper prints (26) and (27) with a negative sign. */
fret_status fret_cycle_loss_by_force(const fret_pressed *contact, double FA, fret_real *loss);

/* The same for a displacement amplitude dA >= 0 [m]; gross slip adds 4 mu F_N (dA - delta_x,max). */
fret_status fret_cycle_loss_by_displacement(const fret_pressed *contact, double dA, fret_real *loss);

/* The same by quadrature of the definition, as a check, for a cycle that turns at `peak`, a result of
 * fret_loading_by_force or _by_displacement. error: relative, an estimate that includes the digits of long
 * double lost where the slip annulus is thin or beside a flat end; power laws: 1e-18 + the rounding of FA/(mu
 * F_N). Takes 10 us to 10 ms; tables 0.1 to 20 ms a row. FRET_NOT_POSITIVE, FRET_NOT_FINITE (mu, FN). */
fret_status fret_cycle_loss_by_definition(const fret_pressed *contact, const fret_loading *peak,
                                          fret_real *loss, fret_real *error);

FRET_END

#endif
