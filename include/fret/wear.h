/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef FRET_WEAR_H
#define FRET_WEAR_H

#include "fret/normal.h"

FRET_BEGIN

/* What fretting leaves of a gap. Each closed cycle takes away alpha D(r), in proportion to the work of
 * friction there (energy wear, Fouvry; Archard's law V = K F_N s/H has alpha = K/(mu H)):
 *   df/dn = alpha D(r),   D(r) = 4 mu p(r) [s(r) + (delta_A - delta_x,max)+],   2 pi int D r dr = dW,
 * with the pressure p and, at the turning point, the slip s of the contact that the worn gap f(r) then makes
 * under what is held: F_N or delta_z, F_A or delta_A. Where it sticks nothing wears. Amplitude and depth, or
 * F_A and F_N, held, the stick radius c stays where it is; delta_A and F_N held, it grows; F_A and delta_z
 * held, it shrinks, maybe until nothing sticks. As n grows pressure outside c goes to 0 (fret_wear_limit). */
typedef struct fret_wear fret_wear;

/* What a cycle of constant load imposes and wear holds. */
typedef struct fret_wear_held {
    bool by_depth;        /* press is delta_z [m], not F_N [N] */
    bool by_displacement; /* amplitude is delta_A [m], not F_A [N] */
    double press;         /* > 0 */
    double amplitude;     /* >= 0; delta_A may go beyond delta_x,max: gross slip */
    double mu;            /* coefficient of friction, > 0 */
    double alpha;         /* volume worn by the energy dissipated [m^3/J], > 0 */
} fret_wear_held;

/* Nothing worn yet. Borrows normal, of any shape, which must outlive it. Error: FRET_NO_MEMORY. */
fret_status fret_wear_make(const fret_normal *normal, fret_wear **out);
/* A copy, which can be run by itself, in another thread too; borrows what `from` does. Error: FRET_NO_MEMORY.
 */
fret_status fret_wear_copy(const fret_wear *from, fret_wear **out);
void fret_wear_free(fret_wear *wear);

/* Told now and then of a run: the cycles that are done of it. */
typedef void (*fret_wear_told)(double cycles, void *user);

/* `cycles` >= 0 more, under what is held, which may differ from run to run; delta_z counts from the tip as it
 * is. tolerance: 1e-4 .. 0.1, of volume and work and, but for the steep places beside c and a, of the largest
 * depth; nodes and blocks of cycles follow from it. Measured: alpha W and V differ by
 * up to 1.3 of it; by 2 at k = -0.7, by 2.7 where a contact has grown 3.5 times as wide. told may be NULL.
 * Takes, at 1e-3, 0.1 to 2 s, towards the limit at k < 0 3 to 17. The law of the worn gap is made anew.
 * Errors, the object as before: FRET_NOT_FINITE, FRET_NOT_POSITIVE, FRET_NEGATIVE naming what is held;
 * FRET_OUTSIDE (tolerance; a limit; cycles: more than can be run, limit: how many); FRET_GROSS_SLIP: F_A
 * beyond mu F_N (limit) at first or, at a held delta_z, later; FRET_SINGULAR (value: r [m]): the edge of a
 * flat punch wears at once; FRET_TABLE_SHORT (limit: its end): the worn contact reaches beyond the gap; those
 * of fret_press_by_force; FRET_NO_MEMORY, FRET_INTERRUPTED (fret_normal_stop of the law that it was made of).
 */
fret_status fret_wear_run(fret_wear *wear, const fret_wear_held *held, double cycles, double tolerance,
                          fret_wear_told told, void *user);

/* What infinitely many cycles leave (Popov 2014; Willert, Dmitriev, Popov 2019), in closed form, as another
 * object of which the same can be asked: g = g_0 for x < c and delta_z for c < x < b, where f ends at that of
 * the unworn gap, from those two that are held of
 *   delta_A = mu eta (delta_z - g_0(c)),   F_N = 2 int_0^c c_N (delta_z - g_0) dx,
 *   F_A = 2 delta_A int_0^c c_T dx.
 * Runs arrive there with F_N and F_A held, or delta_z and delta_A, where c stays; and with delta_z and F_A,
 * where it shrinks. With F_N and delta_A they do not: c grows on the way, and what wore before it stuck is
 * not in this form: a sphere that stuck within 0.6 a at first is worn 5 % wider and by 74 % more. Errors:
 * those of held as above; FRET_GROSS_SLIP: nothing sticks in the end, so that there is none (limit: the
 * largest amplitude that has one); FRET_TABLE_SHORT, FRET_NO_MEMORY, FRET_INTERRUPTED. Accuracy 1e-13 of
 * delta_z; of its law 1e-8, g leaping within 1e-9 c. */
fret_status fret_wear_limit(const fret_normal *normal, const fret_wear_held *held, fret_wear **out);

/* The contact of the worn gap, which is as any other, up to 4 times the ring: of no wear the one it was made
 * of, else of g at the nodes, between which it is cubic in r^2, within the ring as it was. Where g would be
 * level, or fall by what nodes do not tell, it grows by 1e-9 of itself over all of the gap. Belongs to wear,
 * until that is run again or freed; contacts borrow it. */
const fret_normal *fret_wear_law(const fret_wear *wear);

/* Depth worn so far [m] at r >= 0 [m]; 0 outside the worn ring. Errors: FRET_NEGATIVE, FRET_NOT_FINITE. */
fret_status fret_wear_depth(const fret_wear *wear, fret_real r, fret_real *h);
/* The ring that has worn [m], 0, 0 where none has. */
void fret_wear_ring(const fret_wear *wear, fret_real *inner, fret_real *outer);
/* Volume worn so far [m^3], 2 pi int h r dr. */
fret_real fret_wear_volume(const fret_wear *wear);
/* Cycles run; infinite for the limit. */
double fret_wear_cycles(const fret_wear *wear);
/* Work of friction in all of them [J], the sum of dW by the springs of each cycle's contact, which times
 * alpha is the volume to the tolerance; NaN for the limit. */
fret_real fret_wear_work(const fret_wear *wear);

FRET_END

#endif
