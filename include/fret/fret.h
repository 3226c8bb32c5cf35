/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Partial-slip (fretting) contact of axisymmetric power-law graded elastic solids.
 * Pure: no output, no globals, never exits. SI units throughout.
 *
 *   which header        when
 *   fret/material.h     moduli of the bodies and their grading E(z) = E0 (z/c0)^k -> a foundation
 *   fret/gap.h          the shape: f(r), a table of it, its transform g(x)
 *   fret/normal.h       the law F_N(delta_z): pressed by force, by depth, to a radius
 *   fret/cycle.h        constant F_N: first loading, gross slip, energy of a cycle, in closed form
 *   fret/contact.h      any history of both directions: steps, swinging loads, state
 *   fret/field.h        pressure, traction, surface displacement and slip at a radius
 *   fret/work.h         the work of friction at a radius
 *   fret/wear.h         the gap that cycles of fretting leave
 *   fret/arrays.h       closed forms for many loads at once
 *   fret/springs.h      springs of a cut foundation, to check by
 *   fret/status.h       what went wrong
 *
 * A steel ball of R = 10 mm on a steel flat, 100 N, rubbed by 20 N to and fro:
 *
 *   #include <fret/fret.h>
 *   #include <stdio.h>
 *
 *   int main(void) {
 *       const fret_body steel = {.E0 = 210e9, .nu = 0.3};
 *       const fret_material both = {.body = {steel, steel}, .c0 = 1e-3};
 *       const fret_gap ball = {FRET_GAP_POWER, .terms = 1, .power = {{2, 50e-6, 1e-3}}};
 *       fret_normal *law;
 *       fret_contact *contact;
 *       fret_state now;
 *       if (fret_normal_make(&both, &ball, NULL, NULL, &law).code ||
 *           fret_contact_make(law, 0.4, FRET_EXACT, &contact).code)
 *           return 1;
 *       fret_contact_step(contact, &(fret_step){FRET_TO_FORCE, FRET_TO_FX, 100, 0});
 *       for (int i = 0; i < 3; i++)
 *           fret_contact_step(contact, &(fret_step){.tangential_by = FRET_TO_FX,
 *                                                   .tangential = i % 2 ? -20 : 20});
 *       fret_contact_state(contact, &now);
 *       printf("dx = %.6g m\nc = %.6g m\n", (double)now.dx, (double)now.c);
 *       printf("W = %.6g J\n", (double)now.W);
 *   }
 */
#ifndef FRET_H
#define FRET_H

#include "fret/arrays.h"
#include "fret/contact.h"
#include "fret/cycle.h"
#include "fret/field.h"
#include "fret/gap.h"
#include "fret/material.h"
#include "fret/normal.h"
#include "fret/springs.h"
#include "fret/status.h"
#include "fret/wear.h"
#include "fret/work.h"

/* Version of the headers: declarations stay compatible until the major number grows. */
#define FRET_VERSION_MAJOR 1
#define FRET_VERSION_MINOR 0
#define FRET_VERSION_PATCH 0

#endif
