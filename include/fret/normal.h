/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef FRET_NORMAL_H
#define FRET_NORMAL_H

#include "fret/gap.h"
#include "fret/material.h"

FRET_BEGIN

/* The frictionless normal contact: F_N, indentation depth delta_z and contact radius a, each from
 * each. As a function of depth, F_N(delta) is all that the tangential problem needs to know of
 * shape and grading. */
typedef struct fret_normal fret_normal;

/* One state of the normal contact, each member from the same load. */
typedef struct fret_press {
    fret_real F;            /* F_N [N] */
    fret_real dz;           /* delta_z [m] */
    fret_real a;            /* [m] */
    double F_rest, dz_rest; /* what does not fit in F and dz: near gross slip it shows */
} fret_press;

/* Free with fret_normal_free, after all that borrows it. Keeps its own copy of gap; a gap table is borrowed
 * and must outlive it. Once made it is only read: threads may share it.
 *
 * The law of a shape other than a power becomes polynomials, cell by cell: 0.2 to 1.5 ms, of a table 0.1 to
 * 0.2 ms a row; then F_N(delta_z), its inverse and what is asked of slices take some 1 us whatever the shape.
 * like: NULL, or a contact whose polynomials are taken where k and the kind of shape, or the table, are the
 * same, whatever E0, nu, b, R and slope are: within 10 us, and bit for bit what it would be without. stop,
 * which may be NULL, ends the making; it is not kept. Errors: those of fret_foundation_make and
 * fret_gap_check; FRET_NOT_MONOTONE, FRET_NO_MEMORY, FRET_INTERRUPTED. */
fret_status fret_normal_make(const fret_material *material, const fret_gap *gap, const fret_normal *like,
                             fret_stop stop, fret_normal **out);
/* One more user, who frees it too. */
fret_normal *fret_normal_hold(fret_normal *normal);
/* Are they of the same foundation and the same gap, a table by its address? */
bool fret_normal_same(const fret_normal *a, const fret_normal *b);
void fret_normal_free(fret_normal *normal);

/* Long work on this contact, and on all that borrows it, ends when the flag is set. Functions with a status
 * then return FRET_INTERRUPTED, with results that are not to be used; the results of others, asked while it
 * is set, are not either. A memory diagram or springs whose step was interrupted can only be reset, copied to
 * or freed. The flag must outlive the contact; NULL, as at first: nothing stops. */
void fret_normal_stop(fret_normal *normal, fret_stop stop);

/* What the polynomials leave of depth, relative, as their last terms tell; NaN: a power law has none. */
double fret_normal_error(const fret_normal *normal);

/* What it was made of. */
const fret_foundation *fret_normal_foundation(const fret_normal *normal);
const fret_gap *fret_normal_gap(const fret_normal *normal);

/* Is F_N ~ delta_z^((n+k+1)/n), a single power? Closed forms serve it; other shapes are solved for
 * numerically. */
bool fret_normal_is_power(const fret_normal *normal);

/* Is the law smooth enough to follow a swinging load by itself? Not that of a table, whose rows are kinks. */
bool fret_normal_swings(const fret_normal *normal);

/* Largest contact radius [m]: where the gap ends, or g begins to fall; infinite for a power. */
fret_real fret_normal_end(const fret_normal *normal);

/* g(x) [m] for |x| [m] up to fret_normal_end: as fret_gap_g, without computing anew what depends on k alone;
 * NaN beyond. */
fret_real fret_normal_profile(const fret_normal *normal, fret_real x);

/* delta_z = g(a), F_N = 2 int_0^a c_N(x) [g(a)-g(x)] dx (10)-(13); power law:
 *   F_N = 2 cN0 c0^-k kappa A n a^(n+k+1)/((k+1)(n+k+1)).
 * Arguments >= 0. Errors: FRET_NEGATIVE, FRET_NOT_FINITE, FRET_OVERFLOW; FRET_OUTSIDE where a is that of a
 * flat end or less; beyond fret_normal_end FRET_TABLE_SHORT, or FRET_NOT_MONOTONE where g begins to fall
 * there. Accuracy: 1e-19 relative for power laws with n 1e-6..1e6, 1e-17 for other shapes, 2e-16 for tables.
 */
fret_status fret_press_by_force(const fret_normal *normal, double F, fret_press *out);
fret_status fret_press_by_depth(const fret_normal *normal, double dz, fret_press *out);
fret_status fret_press_by_radius(const fret_normal *normal, double a, fret_press *out);

/* Normal stiffness k_n = dF_N/d delta_z = 2 cN0 c0^-k a^(k+1)/(k+1) [N/m], a > 0 [m]. */
fret_real fret_normal_stiffness(const fret_normal *normal, fret_real a);

/* Elastic energy U_n = int_0^delta_z F_N d(delta_z) [J] of a contact that is pressed so: of a power law F_N
 * delta_z n/(2n+k+1). Accuracy: 1e-17 relative, tables 2e-16. */
fret_real fret_normal_energy(const fret_normal *normal, const fret_press *press);

/* A contact pressed and not yet loaded tangentially, at constant F_N from here on. Borrows normal. */
typedef struct fret_pressed {
    const fret_normal *normal;
    double mu;        /* coefficient of friction, > 0 */
    fret_press press; /* F_N > 0 */
} fret_pressed;

FRET_END

#endif
