/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Partial-slip (fretting) contact of axisymmetric power-law graded elastic solids.
 * Pure: no output, no globals, never exits. SI units throughout. */
#ifndef FRET_H
#define FRET_H

#include "fret/arrays.h"
#include "fret/cycle.h"
#include "fret/diagram.h"
#include "fret/field.h"
#include "fret/gap.h"
#include "fret/material.h"
#include "fret/memory.h"
#include "fret/normal.h"
#include "fret/springs.h"
#include "fret/status.h"
#include "fret/swing.h"

#endif
