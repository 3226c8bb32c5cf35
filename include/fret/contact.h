/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef FRET_CONTACT_H
#define FRET_CONTACT_H

#include <stddef.h>

#include "fret/normal.h"

FRET_BEGIN

/* A contact with a memory: tangential contact under any history of (F_N, F_x) or (delta_z, delta_x),
 * including harmonic loads without discretisation.
 *
 * F_x is the force on the upper body along x, delta_x the displacement of its far points relative to those of
 * the lower one, so that F_x grows with delta_x. delta_z > 0 is approach, F_N > 0 compression.
 *
 * With the depth y = g(x) as coordinate the spring at y carries a normal force ~ delta_z - y, so friction
 * bounds its displacement by |u(y)| <= B(y) = mu eta (delta_z - y): grading and shape enter only through the
 * weight dF_N. A contact remembers one curve of slope sigma = -u'(y)/(mu eta), -1 <= sigma <= 1, from (0, 0)
 * to the present (y, t) = (delta_z, delta_x/(mu eta)) or, over load, (F_N, F_x/mu):
 *   F_x = mu int sigma dF_N,   U = 1/(2 eta) int u^2 dK,   K = dF_N/dy.
 * A straight step cuts the curve where y - t (forward slip) or y + t (backward slip) has its value at the end
 * of the step, and joins the cut to the end by a straight line: constant cost per step on average, no
 * discretisation, no drift of F_x. While the slip front, at the depth d, moves inwards through slope sigma
 * and the edge of contact is at the depth D, slip forward (-) or backward (+) dissipates
 *   dW = mu^2 eta (1 -+ sigma) int [F_N(D) - F_N(d) - (D-d) F_N'(d)] |dd|.
 *
 * Different threads may use different contacts, also of one fret_normal. */
typedef struct fret_contact fret_contact;

/* FRET_EXACT: long double, every shape, all digits of a double. FRET_DOUBLE: power laws only, five times as
 * fast, for the inner loop of a dynamics code; it offers steps, forces and state. Its largest deviations from
 * FRET_EXACT in random histories up to and beyond gross slip (make hard-diagram), for p = (n+k+1)/n <= 5: F_x
 * 3e-14 of mu times the largest F_N so far, delta_x under force control 3e-14 of the largest delta_x,max so
 * far, W 1e-13 of W + mu F_N delta_x,max; for p <= 10 ten times that, delta_x a hundred times; for larger p
 * no promise. */
typedef enum fret_exactness { FRET_EXACT, FRET_DOUBLE } fret_exactness;

/* Makes an open contact (delta_z = 0, F_x = 0). Borrows normal, which must outlive it. Errors:
 * FRET_NOT_POSITIVE, FRET_NOT_FINITE (mu), FRET_OUTSIDE (FRET_DOUBLE without a power law), FRET_NO_MEMORY. */
fret_status fret_contact_make(const fret_normal *normal, double mu, fret_exactness exactness,
                              fret_contact **out);
void fret_contact_free(fret_contact *contact);

/* Makes `to` equal to `from`, which has the same exactness (else FRET_OUTSIDE). Allocates only if `to` has
 * never held as much. Error: FRET_NO_MEMORY. */
fret_status fret_contact_copy(fret_contact *to, const fret_contact *from);

/* Returns the contact to the open state; keeps its storage. */
void fret_contact_reset(fret_contact *contact);

/* The arguments of fret_contact_make. */
const fret_normal *fret_contact_normal(const fret_contact *contact);
double fret_contact_friction(const fret_contact *contact);

typedef enum fret_normal_target { FRET_KEEP_NORMAL, FRET_TO_FORCE, FRET_TO_DEPTH } fret_normal_target;
typedef enum fret_tangential_target {
    FRET_KEEP_DX, /* the same as FRET_TO_DX with the present delta_x */
    FRET_TO_DX,
    FRET_TO_FX
} fret_tangential_target;

/* Absolute targets of one step [N] or [m].
 * With FRET_TO_FX the path is straight in (F_N, F_x), otherwise in (delta_z, delta_x). */
typedef struct fret_step {
    fret_normal_target normal_by;
    fret_tangential_target tangential_by;
    double normal;     /* F_N >= 0, or delta_z (< 0: out of contact) */
    double tangential; /* delta_x or F_x */
} fret_step;

/* Performs one straight step. On an error the contact is unchanged, except by FRET_INTERRUPTED
 * (fret_normal_stop). Errors: FRET_GROSS_SLIP (|F_x| above mu F_N by a relative 2.2e-16; limit mu F_N),
 * FRET_NEGATIVE, FRET_NOT_FINITE, FRET_OVERFLOW (FRET_DOUBLE: F_N, delta_z or their product leaves 1e-290 ..
 * 1e290), FRET_TABLE_SHORT, FRET_NOT_MONOTONE, FRET_NO_MEMORY, FRET_OUTSIDE (a curved contact cannot step to
 * delta_x while F_N or delta_z changes: call fret_contact_chords first). */
fret_status fret_contact_step(fret_contact *contact, const fret_step *step);

/* Switches the computation of dissipated energy, half of the time of a step, on (as at first) or off for the
 * following steps of a FRET_DOUBLE contact. FRET_EXACT always computes it. */
void fret_contact_count_loss(fret_contact *contact, bool on);

/* A record of slip, phase by phase, from which fret/work.h computes the work of friction at each place. A
 * step adds one phase of 150 bytes for each slice that its slip front enters; a period of a swinging load
 * adds some ten phases of 700 bytes. */
typedef struct fret_slips fret_slips;
/* Error: FRET_NO_MEMORY. */
fret_status fret_slips_make(fret_slips **out);
void fret_slips_free(fret_slips *slips);
/* Empties the record; keeps its storage. */
void fret_slips_clear(fret_slips *slips);
/* The number of phases. */
size_t fret_slips_count(const fret_slips *slips);
/* Counts the phases from number `first` on `times` more times, for periods that repeat. */
void fret_slips_repeat(fret_slips *slips, size_t first, double times);
/* Records the following steps and swings of the contact in slips, which it borrows; NULL: no longer. Copies
 * of the contact are not recorded, and a copy into it keeps its record. Error: FRET_OUTSIDE (FRET_DOUBLE). */
fret_status fret_contact_watch(fret_contact *contact, fret_slips *slips);

/* A swinging load: F_x = FA cos s, F_N = FN + FNA cos(s + phase), s = 0 .. 2 pi. */
typedef struct fret_sine {
    double FA, FNA, phase; /* [N], [N], [rad] */
    fret_real FN;          /* [N] */
} fret_sine;

/* Follows the part of a period between the times `from`, which must be the present load, and `to` (0 <= from
 * < to <= 1), along the sine itself, event by event, without chords. Successive parts end in the state of the
 * whole, to rounding. W agrees with 64-digit references to 1e-15 for a power law, to 1e-13 for other shapes
 * and after steps that end within a thousandth of gross slip. Errors: FRET_OUTSIDE, the contact unchanged:
 * FRET_DOUBLE, a table (fret_normal_swings), a load that opens the contact, reaches gross slip or starts
 * elsewhere. FRET_NO_MEMORY, FRET_INTERRUPTED: the contact can then only be reset, copied to or freed. */
fret_status fret_contact_swing(fret_contact *contact, const fret_sine *sine, double from, double to);

/* True if the memory curve has arcs, which swinging loads leave (a curved contact). */
bool fret_contact_curved(const fret_contact *contact);

/* Makes `to` a copy of `from` with each arc of the memory curve replaced by 640 chords. Both must be
 * FRET_EXACT, else FRET_OUTSIDE. Error: FRET_NO_MEMORY. */
fret_status fret_contact_chords(fret_contact *to, const fret_contact *from);

typedef struct fret_state {
    fret_real FN, dz, a; /* normal force [N], indentation depth [m] (< 0: gap), contact radius [m] */
    fret_real Fx, dx, c; /* tangential force [N], displacement [m], stick radius [m] */
    fret_real W;         /* energy dissipated since the start [J] */
    fret_real U;         /* stored tangential energy [J] */
    fret_real kn;        /* dF_N/d delta_z [N/m] */
    fret_real kt;        /* dF_x/d delta_x, continuing the last motion [N/m] */
    size_t slices;       /* slices of the memory curve */
} fret_state;

/* The whole state; and only its cheap part, which leaves a, c, U, kn, kt 0 where they would take time. */
void fret_contact_state(const fret_contact *contact, fret_state *out);
void fret_contact_forces(const fret_contact *contact, fret_state *out);

/* Energy dissipated by the last step, or the last part of a period, alone [J]. For a step far smaller than
 * the load the rounding of the load shows in it: for totals take W. */
fret_real fret_contact_last_loss(const fret_contact *contact);

/* The next four functions need FRET_EXACT: for FRET_DOUBLE the first returns false, the others NaN. */

/* Slice i of the memory curve, 0 the innermost: it covers the depths [inner, outer] with slope sigma; u is
 * the displacement at its inner end [m]. False beyond the last slice and for curved contacts. */
typedef struct fret_segment {
    fret_real inner, outer, sigma, u;
} fret_segment;
bool fret_contact_segment(const fret_contact *contact, size_t i, fret_segment *out);

/* Displacement u1D(x) [m] of the spring at distance |x| [m] from the centre, from its unstressed position,
 * both bodies together: delta_x where it has stuck since delta_x was 0; 0 outside the contact. Accuracy 1e-18
 * of mu eta delta_z; if curved, 1e-13. */
fret_real fret_contact_displacement(const fret_contact *contact, fret_real x);

/* The friction bound on |u1D(x)|, B = mu eta (delta_z - g(x)) [m]; 0 outside the contact. */
fret_real fret_contact_bound(const fret_contact *contact, fret_real x);

/* Force of the springs times their present slip, W1D = -2 int_0^a c_T |u| |delta_x - u| dx [J], <= 0 (22),
 * c_T that of both bodies together. During first loading its magnitude is the energy dissipated, at its end
 * dW/4; after a reversal it has no such meaning. Exact, in time ~ the number of slices; NaN for a curved
 * contact. */
fret_real fret_contact_slip_work(const fret_contact *contact);

/* Stores the history as an array of doubles, and restores it, bit for bit, into a contact of the same law,
 * friction and exactness. pack sets `count` to the length needed and fails with FRET_OUTSIDE (limit: that
 * length) if `room` is smaller; a curved contact is packed as its chords. unpack fails with FRET_OUTSIDE, the
 * contact unchanged, if the array is no such history. FRET_NO_MEMORY. Both together take 0.15 us for
 * FRET_DOUBLE, 0.3 us for FRET_EXACT, more with many slices: one contact can serve all histories. */
fret_status fret_contact_pack(const fret_contact *contact, double out[], size_t room, size_t *count);
fret_status fret_contact_unpack(fret_contact *contact, const double from[], size_t count);

FRET_END

#endif
