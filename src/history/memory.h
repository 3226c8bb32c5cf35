/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The exact memory diagram, under any law, for FRET_EXACT contacts that are not curved. Not installed. */
#ifndef FRET_HISTORY_MEMORY_H
#define FRET_HISTORY_MEMORY_H

#include "history/slips.h"
#include "law/normal.h"

typedef struct fret_memory fret_memory;

#define NUMBER fret_real
#define SPOT fret_place
#define DIAGRAM fret_memory
#define PUBLIC(f) fret_memory_##f
#define FUNCTION(f) f##l
#define POWER fret_pow
#include "history/diagram_type.h"
#include "history/steps.h"

fret_status fret_memory_make(const fret_normal *normal, double mu, fret_memory **out);
void fret_memory_free(fret_memory *memory);
fret_status fret_memory_copy(fret_memory *to, const fret_memory *from);
void fret_memory_reset(fret_memory *memory);
fret_status fret_memory_step(fret_memory *memory, const fret_step *step);
void fret_memory_state(const fret_memory *memory, fret_state *out);
void fret_memory_forces(const fret_memory *memory, fret_state *out);
bool fret_memory_segment(const fret_memory *memory, size_t i, fret_segment *out);
fret_real fret_memory_displacement(const fret_memory *memory, fret_real x);
fret_real fret_memory_slip_work(const fret_memory *memory);

/* The normal contact at the edge of the curve. */
fret_press fret_memory_pressed(const fret_memory *memory);

/* Makes room for `count` layers. Error: FRET_NO_MEMORY. */
fret_status fret_memory_reserve(fret_memory *memory, size_t count);

/* For fret_contact_pack and _unpack: the length of the array, writing it, and reading it back. */
size_t fret_memory_packed(const fret_memory *memory);
void fret_memory_pack(const fret_memory *memory, double out[]);
fret_status fret_memory_unpack(fret_memory *memory, const double from[], size_t count);

#endif
