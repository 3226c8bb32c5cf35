/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef FRET_WEAR_H
#define FRET_WEAR_H

#include "fret/normal.h"

FRET_BEGIN

/* Wear of a gap by fretting. Each closed cycle removes the depth alpha D(r), in proportion to the work of
 * friction there (energy wear, Fouvry; Archard's law V = K F_N s/H has alpha = K/(mu H)):
 *   df/dn = alpha D(r),   D(r) = 4 mu p(r) [s(r) + (delta_A - delta_x,max)+],   2 pi int D r dr = dW,
 * with the pressure p, and the slip s at the turning point, of the contact that the worn gap f(r) makes under
 * what is held constant: F_N or delta_z, and F_A or delta_A. The stick zone does not wear. The stick radius c
 * stays if delta_A and delta_z, or F_A and F_N, are held; it grows if delta_A and F_N are, and shrinks,
 * possibly to 0, if F_A and delta_z are. As n grows the pressure outside c goes to 0 (fret_wear_limit).
 * fret_wear is a worn gap. */
typedef struct fret_wear fret_wear;

/* What is held constant during wear. */
typedef struct fret_wear_held {
    bool by_depth;        /* press is delta_z [m], else F_N [N] */
    bool by_displacement; /* amplitude is delta_A [m], else F_A [N] */
    double press;         /* > 0 */
    double amplitude;     /* >= 0; delta_A beyond delta_x,max: gross slip */
    double mu;            /* coefficient of friction, > 0 */
    double alpha;         /* volume worn per energy dissipated [m^3/J], > 0 */
} fret_wear_held;

/* A run of wear: the blocks of cycles computed so far under what is held. */
typedef struct fret_wear_run fret_wear_run;
/* Begins a run with an unworn gap. Borrows normal, of any shape, which must outlive it. tolerance: 1e-4 ..
 * 0.1, of volume and work and, except at the steep places beside c, a and edges, of the largest depth; it
 * sets the nodes and the blocks of cycles. Errors: FRET_NOT_FINITE, FRET_NOT_POSITIVE, FRET_NEGATIVE naming
 * what is held; FRET_OUTSIDE (tolerance); FRET_GROSS_SLIP: F_A beyond mu F_N (limit); FRET_SINGULAR (value: r
 * [m]): the edge of a flat punch wears at once; FRET_NO_MEMORY, FRET_INTERRUPTED, those of
 * fret_press_by_force. */
fret_status fret_wear_run_make(const fret_normal *normal, const fret_wear_held *held, double tolerance,
                               fret_wear_run **out);
void fret_wear_run_free(fret_wear_run *run);

/* A callback for progress: the number of cycles done so far. */
typedef void (*fret_wear_told)(double cycles, void *user);

/* The gap after `cycles` >= 0, from the blocks computed so far and as many more as needed: the result does
 * not depend on earlier calls. Between two ends of blocks depths are cubic in the number of cycles. delta_z
 * counts from the tip of the worn gap. told may be NULL. The result borrows normal, not the run. Measured,
 * for spheres, cones and flat ends with F_A/(mu F_N) of 0.4 and 0.9: alpha W and V differ by up to 0.5 of the
 * tolerance 1e-3, and V from that of the limit by up to 1.4; for a cone near gross slip by 0.5 and 2 at k =
 * -0.7, 1.2 and 5 at k = -0.9. With F_N and delta_A held, where worn rings follow c, volumes of cones differ
 * by up to 1.5 from those by other elements, which are good to 0.3 to 6. Depths are those of nodes 1 % of the
 * radius apart, good to 0.15 of the tolerance; beside a and edges they are steeper than the nodes resolve:
 * within 1 % of the radius there they are off by up to 4 % of the largest depth in the first cycles, 0.4 %
 * later, and by up to 9 % where p is infinite at an edge (flat cones, k <= 0). Pressure there is that of the
 * nodes: near the limit its largest value differed by half between the tolerances 1e-3 and 1e-4. The first
 * 10^6 cycles take 0.02 to 0.2 s at k >= 0 (F_N and delta_A held: 0.6 s), up to 0.4 s at k = -0.3, 1 s at k =
 * -0.7 and 2 s at k = -0.9; cycles within the blocks computed before, 2 ms. Errors: FRET_NOT_FINITE,
 * FRET_NEGATIVE (cycles); FRET_OUTSIDE (cycles: more than can be run; limit: how many); FRET_TABLE_SHORT
 * (limit: its end): the worn contact reaches beyond the gap; FRET_GROSS_SLIP: F_A, at a held delta_z;
 * FRET_NO_MEMORY, FRET_INTERRUPTED (fret_normal_stop of normal). */
fret_status fret_wear_after(fret_wear_run *run, double cycles, fret_wear_told told, void *user,
                            fret_wear **out);
void fret_wear_free(fret_wear *wear);

/* The gap after infinitely many cycles (Popov 2014; Willert, Dmitriev, Popov 2019), in closed form, for the
 * same questions: g = g_0 for x < c and delta_z for c < x < b, where f meets the unworn gap at b, and c and
 * delta_z follow from the two quantities that are held and
 *   delta_A = mu eta (delta_z - g_0(c)),   F_N = 2 int_0^c c_N (delta_z - g_0) dx,
 *   F_A = 2 delta_A int_0^c c_T dx.
 * Runs arrive there if F_N and F_A, or delta_z and delta_A, are held, where c stays, and if delta_z and F_A
 * are, where c shrinks. With F_N and delta_A they do not: c grows, and what wore before it stuck is not in
 * this form: a sphere that stuck within 0.6 a at first wears 7 % wider and loses 91 % more. Errors: those of
 * held as above; FRET_GROSS_SLIP: nothing sticks in the end, so that there is no limit (limit: the largest
 * amplitude that has one); FRET_TABLE_SHORT, FRET_NO_MEMORY, FRET_INTERRUPTED. Accuracy 1e-13 of delta_z; of
 * its law 1e-8, since there g rises from g_0(c) to delta_z within 1e-9 c. */
fret_status fret_wear_limit(const fret_normal *normal, const fret_wear_held *held, fret_wear **out);

/* The normal contact of the worn gap, usable as any other, up to 4 times the outer radius of the ring.
 * Without wear it is the one that the run was made of; else g is interpolated between the nodes, cubic in
 * r^2, and unworn within the ring. Where g would be level, or fall by less than the nodes resolve, it grows
 * by 1e-9 of itself over the whole gap. Belongs to wear, and is freed with it; contacts borrow it. */
const fret_normal *fret_wear_law(const fret_wear *wear);

/* Depth worn [m] at r >= 0 [m]; 0 outside the worn ring. Errors: FRET_NEGATIVE, FRET_NOT_FINITE. */
fret_status fret_wear_depth(const fret_wear *wear, fret_real r, fret_real *h);
/* Inner and outer radius [m] of the worn ring; 0, 0 without wear. */
void fret_wear_ring(const fret_wear *wear, fret_real *inner, fret_real *outer);
/* Volume worn [m^3], 2 pi int h r dr. */
fret_real fret_wear_volume(const fret_wear *wear);
/* The number of cycles; infinite for the limit. */
double fret_wear_cycles(const fret_wear *wear);
/* Work of friction in all cycles [J], the sum of dW over the springs of each cycle's contact; alpha times it
 * is the volume, to the tolerance. NaN for the limit. */
fret_real fret_wear_work(const fret_wear *wear);

FRET_END

#endif
