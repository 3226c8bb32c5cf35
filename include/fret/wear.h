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
 * held, it shrinks, maybe until nothing sticks. As n grows pressure outside c goes to 0 (fret_wear_limit). A
 * gap as it is worn: */
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

/* A run of wear: blocks of cycles under what is held, as far as has been asked for. */
typedef struct fret_wear_run fret_wear_run;
/* Of an unworn gap. Borrows normal, of any shape, which must outlive it. tolerance: 1e-4 .. 0.1, of volume
 * and work and, but for the steep places beside c, a and edges, of the largest depth; nodes and blocks of
 * cycles follow from it. Errors: FRET_NOT_FINITE, FRET_NOT_POSITIVE, FRET_NEGATIVE naming what is held;
 * FRET_OUTSIDE (tolerance); FRET_GROSS_SLIP: F_A beyond mu F_N (limit); FRET_SINGULAR (value: r [m]): the
 * edge of a flat punch wears at once; those of fret_press_by_force; FRET_NO_MEMORY, FRET_INTERRUPTED. */
fret_status fret_wear_run_make(const fret_normal *normal, const fret_wear_held *held, double tolerance,
                               fret_wear_run **out);
void fret_wear_run_free(fret_wear_run *run);

/* Told now and then of a run: the cycles that are done of it. */
typedef void (*fret_wear_told)(double cycles, void *user);

/* The gap that so many cycles >= 0 leave, by the blocks that are there and as many more as it takes: the same
 * whatever was asked before; between two ends of blocks depths are cubic in the number of cycles. delta_z
 * counts from the tip as it is. told may be NULL. The object borrows normal, not the run.
 * Measured, of spheres, cones and flat ends with F_A/(mu F_N) of 0.4 and 0.9: alpha W and V differ by up to
 * 0.5 of the tolerance 1e-3, and the volume by up to 1.4 from that of the limit; those of a cone near gross
 * slip by 0.5 and 2 at k = -0.7, 1.2 and 5 at k = -0.9. F_N and delta_A held, where rings follow c, volumes
 * of cones by up to 1.5 from those of other elements, which know them to 0.3 to 6. Depths, to 0.15 of the
 * tolerance within, are those of nodes 1 % of the radius apart, and steeper than these can tell beside a and
 * edges: there, within 1 %, they are off by up to 4 % of the largest in the first cycles, 0.4 % of it later;
 * where p is infinite at an edge (flat cones, k <= 0), by up to 9 %. The first 10^6 cycles take 0.02 to 0.2 s
 * at k >= 0 (F_N and delta_A held: 0.6 s), to 0.4 s at k = -0.3, 1 s at k = -0.7 and 2 s at k = -0.9;
 * any number of cycles that have been passed, 2 ms. Errors: FRET_NOT_FINITE, FRET_NEGATIVE (cycles);
 * FRET_OUTSIDE (cycles: more than can be run, limit: how many); FRET_TABLE_SHORT (limit: its end): the worn
 * contact reaches beyond the gap; FRET_GROSS_SLIP: F_A, at a held delta_z; FRET_NO_MEMORY, FRET_INTERRUPTED
 * (fret_normal_stop of the law that it was made of). */
fret_status fret_wear_after(fret_wear_run *run, double cycles, fret_wear_told told, void *user,
                            fret_wear **out);
void fret_wear_free(fret_wear *wear);

/* What infinitely many cycles leave (Popov 2014; Willert, Dmitriev, Popov 2019), in closed form, as another
 * object of which the same can be asked: g = g_0 for x < c and delta_z for c < x < b, where f ends at that of
 * the unworn gap, from those two that are held of
 *   delta_A = mu eta (delta_z - g_0(c)),   F_N = 2 int_0^c c_N (delta_z - g_0) dx,
 *   F_A = 2 delta_A int_0^c c_T dx.
 * Runs arrive there with F_N and F_A held, or delta_z and delta_A, where c stays; and with delta_z and F_A,
 * where it shrinks. With F_N and delta_A they do not: c grows on the way, and what wore before it stuck is
 * not in this form: a sphere that stuck within 0.6 a at first is worn 7 % wider and by 91 % more. Errors:
 * those of held as above; FRET_GROSS_SLIP: nothing sticks in the end, so that there is none (limit: the
 * largest amplitude that has one); FRET_TABLE_SHORT, FRET_NO_MEMORY, FRET_INTERRUPTED. Accuracy 1e-13 of
 * delta_z; of its law 1e-8, g leaping within 1e-9 c. */
fret_status fret_wear_limit(const fret_normal *normal, const fret_wear_held *held, fret_wear **out);

/* The contact of the worn gap, which is as any other, up to 4 times the ring: of no wear the one it was made
 * of, else of g at the nodes, between which it is cubic in r^2, within the ring as it was. Where g would be
 * level, or fall by what nodes do not tell, it grows by 1e-9 of itself over all of the gap. Belongs to wear,
 * until that is freed; contacts borrow it. */
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
