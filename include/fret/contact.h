/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef FRET_CONTACT_H
#define FRET_CONTACT_H

#include <stddef.h>

#include "fret/normal.h"

FRET_BEGIN

/* A contact with a memory: tangential contact under any history of (F_N, F_x) or (delta_z, delta_x), and
 * under harmonic loads as they are.
 *
 * F_x is the force on the upper body along x and delta_x the displacement of its far points against those of
 * the lower one, so that F_x grows with delta_x; delta_z > 0 is approach, F_N > 0 pressure.
 *
 * With the depth y = g(x) as coordinate the spring at y has normal force ~ delta_z - y, so the friction bound
 * on its displacement is |u(y)| <= B(y) = mu eta (delta_z - y): grading and shape appear only as the weight
 * dF_N. What a contact remembers is one curve from (0, 0) to the present (delta_z, delta_x/(mu eta)), or
 * (F_N, F_x/mu), of slopes sigma = -u'(y)/(mu eta), -1 <= sigma <= 1:
 *   F_x = mu int sigma dF_N,   U = 1/(2 eta) int u^2 dK,   K = dF_N/dy.
 * A straight step cuts it where y - t (slip forward) or y + t (slip backward) has fallen to that of the end,
 * and goes there straight: amortised constant cost, no discretisation, and F_x does not drift, however many
 * steps there are. While the front d of slip moves inwards through slope sigma and the edge D with it,
 *   dW = mu^2 eta (1 -+ sigma) int [F_N(D) - F_N(d) - (D-d) F_N'(d)] |dd|.
 *
 * Distinct contacts may be used by distinct threads, also of one law. */
typedef struct fret_contact fret_contact;

/* FRET_EXACT: long double, every law: all digits of a double. FRET_DOUBLE: power laws, for the inner loop of
 * a dynamics code, five times as fast. It steps, and tells forces and state; against FRET_EXACT, worst of
 * random histories up to gross slip and beyond, p = (n+k+1)/n <= 5 (make hard-diagram): F_x to 3e-14 of mu
 * times the largest F_N so far, delta_x by force to 3e-14 of the largest delta_x,max so far, W to 1e-13 of
 * itself and of mu F_N delta_x,max together; up to p = 10 ten times that, delta_x a hundred times; beyond,
 * nothing is promised. */
typedef enum fret_exactness { FRET_EXACT, FRET_DOUBLE } fret_exactness;

/* A contact, open (delta_z = 0, F_x = 0) at the start. Borrows normal, which must outlive it. Errors:
 * FRET_NOT_POSITIVE, FRET_NOT_FINITE (mu), FRET_OUTSIDE (FRET_DOUBLE of no power law), FRET_NO_MEMORY. */
fret_status fret_contact_make(const fret_normal *normal, double mu, fret_exactness exactness,
                              fret_contact **out);
void fret_contact_free(fret_contact *contact);

/* Makes `to` equal to `from`, of the same exactness (else FRET_OUTSIDE), allocating only where `to` has held
 * less so far. Error: FRET_NO_MEMORY. */
fret_status fret_contact_copy(fret_contact *to, const fret_contact *from);

/* Back to the open state; keeps its storage. */
void fret_contact_reset(fret_contact *contact);

/* What it was made with. */
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

/* One straight step. Errors, the contact as before it: FRET_GROSS_SLIP (|F_x| > mu F_N by more than 2.2e-16;
 * limit mu F_N), FRET_NEGATIVE, FRET_NOT_FINITE, FRET_OVERFLOW (FRET_DOUBLE: where F_N, delta_z or their
 * product leaves 1e-290 .. 1e290), FRET_TABLE_SHORT, FRET_NOT_MONOTONE, FRET_NO_MEMORY; FRET_OUTSIDE: once it
 * has swung, to delta_x along a normal motion (fret_contact_chords first). FRET_INTERRUPTED, of which
 * fret_normal_stop tells. */
fret_status fret_contact_step(fret_contact *contact, const fret_step *step);

/* Whether steps of FRET_DOUBLE from here on count the energy that they dissipate: half of their time. At
 * first they do; FRET_EXACT always does. */
void fret_contact_count_loss(fret_contact *contact, bool on);

/* What slips, phase by phase, as a contact is stepped: what friction does at each place can be told of it
 * (fret/work.h). Some 150 bytes a phase, of a step one for each slice that its slip comes to; 700 of a
 * swinging load, some ten a period. */
typedef struct fret_slips fret_slips;
/* Error: FRET_NO_MEMORY. */
fret_status fret_slips_make(fret_slips **out);
void fret_slips_free(fret_slips *slips);
/* Nothing has slipped; keeps its storage. */
void fret_slips_clear(fret_slips *slips);
/* How many phases there are. */
size_t fret_slips_count(const fret_slips *slips);
/* Those from number `first` on stand for `times` more that are as they are: periods that need not be run. */
void fret_slips_repeat(fret_slips *slips, size_t first, double times);
/* Steps and swings of the contact add to slips from here on, which it borrows; NULL: to none. Copies of a
 * contact are not watched, a copy to it changes nothing in this. Error: FRET_OUTSIDE (FRET_DOUBLE). */
fret_status fret_contact_watch(fret_contact *contact, fret_slips *slips);

/* F_x = FA cos s, F_N = FN + FNA cos(s + phase), s = 0 .. 2 pi. */
typedef struct fret_sine {
    double FA, FNA, phase; /* [N], [N], [rad] */
    fret_real FN;          /* [N] */
} fret_sine;

/* The part of a period from its time `from`, where the load is, to `to`, 0 <= from < to <= 1: the sine
 * itself, event by event, no chords. Parts of a whole end as the whole does, to rounding. W against 64-digit
 * references: 1e-15 of a power law, 1e-13 after steps that end within a thousandth of gross slip and of other
 * shapes.
 * Errors: FRET_OUTSIDE, the contact as before: FRET_DOUBLE, a table (fret_normal_swings), a load that
 * opens the contact, slides or begins elsewhere. FRET_NO_MEMORY, FRET_INTERRUPTED, after which the contact
 * can only be reset, copied to or freed. */
fret_status fret_contact_swing(fret_contact *contact, const fret_sine *sine, double from, double to);

/* Has it swung? */
bool fret_contact_curved(const fret_contact *contact);

/* `to` as `from`, but straight: what swinging has curved goes in 640 chords each. Both exact, else
 * FRET_OUTSIDE. Error: FRET_NO_MEMORY. */
fret_status fret_contact_chords(fret_contact *to, const fret_contact *from);

typedef struct fret_state {
    fret_real FN, dz, a; /* normal force [N], indentation depth [m] (< 0: gap), contact radius [m] */
    fret_real Fx, dx, c; /* tangential force [N], displacement [m], stick radius [m] */
    fret_real W;         /* dissipated since the start [J] */
    fret_real U;         /* stored tangential energy [J] */
    fret_real kn;        /* dF_N/d delta_z [N/m] */
    fret_real kt;        /* dF_x/d delta_x going on in the direction of the last step [N/m] */
    size_t slices;       /* parts of the curve */
} fret_state;

/* All of it; and the cheap part alone: a, c, U, kn, kt are left 0 where they would cost time. */
void fret_contact_state(const fret_contact *contact, fret_state *out);
void fret_contact_forces(const fret_contact *contact, fret_state *out);

/* Energy dissipated by the last step, or part of a period, alone [J]; of a step far smaller than the load the
 * rounding of the load is felt: W is the better sum. */
fret_real fret_contact_last_loss(const fret_contact *contact);

/* Of exact contacts; of FRET_DOUBLE there is no segment, and values are NaN. */

/* The curve where it is straight: slice i, 0 at the innermost, covers depths [inner, outer] with slope sigma;
 * u is the displacement at its inner end [m]. False beyond the last slice, and of a curved one. */
typedef struct fret_segment {
    fret_real inner, outer, sigma, u;
} fret_segment;
bool fret_contact_segment(const fret_contact *contact, size_t i, fret_segment *out);

/* Displacement u1D(x) [m] of the spring at distance |x| [m] from the centre, relative to where it would rest,
 * both sides together: u at the depth y = g(x), delta_x where it never slipped; 0 outside the contact.
 * Accuracy 1e-18 of mu eta delta_z; of a curved one 1e-13. */
fret_real fret_contact_displacement(const fret_contact *contact, fret_real x);

/* What friction allows it, B = mu eta (delta_z - g(x)) [m], |u1D| <= B; 0 outside the contact. */
fret_real fret_contact_bound(const fret_contact *contact, fret_real x);

/* The springs' force times their present slip, W1D = -2 int_0^a c_T |u| |delta_x - u| dx [J], <= 0 (22). Its
 * magnitude is the energy dissipated as long as the first branch lasts, a quarter of dW at its end, and has
 * no such meaning after a reversal. Exact over straight slices, in time ~ their number; NaN of a curved
 * contact. c_T is that of both bodies together. */
fret_real fret_contact_slip_work(const fret_contact *contact);

/* The history as an array of doubles, and back, bit for bit, into a contact of the same law, friction and
 * exactness. Tells in `count` how many there are; writes them where `room` is enough, else FRET_OUTSIDE
 * (limit: how many). unpack: FRET_OUTSIDE where they are no such history, the contact as before;
 * FRET_NO_MEMORY. A curved contact is packed as its chords. Both together take 0.15 us of FRET_DOUBLE, 0.3 us
 * of FRET_EXACT, and more of many slices: one contact can stand for all whose histories a code keeps. */
fret_status fret_contact_pack(const fret_contact *contact, double out[], size_t room, size_t *count);
fret_status fret_contact_unpack(fret_contact *contact, const double from[], size_t count);

FRET_END

#endif
