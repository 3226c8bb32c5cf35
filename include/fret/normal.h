/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef FRET_NORMAL_H
#define FRET_NORMAL_H

#include "fret/gap.h"
#include "fret/material.h"

FRET_BEGIN

/* The frictionless normal contact: force F_N, indentation depth delta_z and contact radius a, each from any
 * other. F_N as a function of depth is all that the tangential problem needs to know of shape and grading. */
typedef struct fret_normal fret_normal;

/* One state of the normal contact; all members belong to the same load. */
typedef struct fret_press {
    fret_real F;            /* F_N [N] */
    fret_real dz;           /* delta_z [m] */
    fret_real a;            /* [m] */
    double F_rest, dz_rest; /* low-order parts of F and dz, needed near gross slip */
} fret_press;

/* Makes a normal contact; free it with fret_normal_free, after all that borrows it. Copies gap, but borrows
 * the table of one, which must outlive it. The contact is then only read: threads may share it.
 *
 * For a shape other than a power the law becomes polynomials, cell by cell, in 0.2 to 1.5 ms, for a table in
 * 0.1 to 0.2 ms a row; then F_N(delta_z), its inverse and sums over slices take some 1 us whatever the shape.
 * like: NULL, or a contact whose polynomials are reused if k and the kind of shape, or the table, are the
 * same, whatever E0, nu, b, R and slope are: in 10 us, with the same bits as without. stop: ends the making
 * when set; may be NULL, is not kept. Errors: those of fret_foundation_make and fret_gap_check;
 * FRET_NOT_MONOTONE, FRET_OVERFLOW (n: 1/n overflows), FRET_NO_MEMORY, FRET_INTERRUPTED. */
fret_status fret_normal_make(const fret_material *material, const fret_gap *gap, const fret_normal *like,
                             fret_stop stop, fret_normal **out);
/* Adds a reference, which fret_normal_free releases. */
fret_normal *fret_normal_hold(fret_normal *normal);
/* True if foundation and gap are the same; tables are compared by address. */
bool fret_normal_same(const fret_normal *a, const fret_normal *b);
void fret_normal_free(fret_normal *normal);

/* Long work on this contact, and on all that borrows it, ends when the flag is set: functions with a status
 * return FRET_INTERRUPTED. Results computed while it is set, by those or by functions without a status, must
 * not be used. After an interrupted step a fret_contact can only be reset, copied to or freed, springs can
 * only be freed. The flag must outlive the contact; NULL, the default: nothing stops. */
void fret_normal_stop(fret_normal *normal, fret_stop stop);

/* Relative error of depth that the polynomials leave, estimated from their last terms; NaN: a power law. */
double fret_normal_error(const fret_normal *normal);

/* The foundation and the gap that it was made of. */
const fret_foundation *fret_normal_foundation(const fret_normal *normal);
const fret_gap *fret_normal_gap(const fret_normal *normal);

/* True for a single power, F_N ~ delta_z^((n+k+1)/n), which has closed forms; others are solved
 * numerically. */
bool fret_normal_is_power(const fret_normal *normal);

/* True if the law is smooth enough for fret_contact_swing; false for tables, whose rows are kinks. */
bool fret_normal_swings(const fret_normal *normal);

/* Largest contact radius [m]: where the gap ends, or g begins to fall; infinite for a power. */
fret_real fret_normal_end(const fret_normal *normal);

/* g(x) [m] for |x| [m] up to fret_normal_end, NaN beyond: as fret_gap_g, but faster. */
fret_real fret_normal_profile(const fret_normal *normal, fret_real x);

/* The state at a given force [N], depth [m] or radius [m], all >= 0 (10)-(13):
 *   delta_z = g(a), F_N = 2 int_0^a c_N(x) [g(a)-g(x)] dx; power law:
 *   F_N = 2 cN0 c0^-k kappa A n a^(n+k+1)/((k+1)(n+k+1)).
 * Errors: FRET_NEGATIVE, FRET_NOT_FINITE, FRET_OVERFLOW; FRET_OUTSIDE if a lies within a flat end, or on the
 * edge of a flat punch; beyond fret_normal_end FRET_TABLE_SHORT, or FRET_NOT_MONOTONE where g begins to fall
 * there. Accuracy, relative: 1e-19 for power laws with n 1e-6..1e6, 1e-17 for other shapes, 2e-16 for
 * tables. */
fret_status fret_press_by_force(const fret_normal *normal, double F, fret_press *out);
fret_status fret_press_by_depth(const fret_normal *normal, double dz, fret_press *out);
fret_status fret_press_by_radius(const fret_normal *normal, double a, fret_press *out);

/* Normal stiffness k_n = dF_N/d delta_z = 2 cN0 c0^-k a^(k+1)/(k+1) [N/m], a > 0 [m]. */
fret_real fret_normal_stiffness(const fret_normal *normal, fret_real a);

/* Elastic energy U_n = int_0^delta_z F_N d(delta_z) [J] of a pressed contact; power law: F_N delta_z
 * n/(2n+k+1). Accuracy: 1e-17 relative, tables 2e-16. */
fret_real fret_normal_energy(const fret_normal *normal, const fret_press *press);

/* A contact pressed but not yet loaded tangentially; F_N is constant from here on. Borrows normal. */
typedef struct fret_pressed {
    const fret_normal *normal;
    double mu;        /* coefficient of friction, > 0 */
    fret_press press; /* F_N > 0 */
} fret_pressed;

FRET_END

#endif
