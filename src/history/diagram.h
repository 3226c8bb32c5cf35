/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The memory diagram of a power law in double, for FRET_DOUBLE of fret/contact.h. Not installed. */
#ifndef FRET_HISTORY_DIAGRAM_H
#define FRET_HISTORY_DIAGRAM_H

#include "fret/contact.h"

typedef struct fret_diagram fret_diagram;

/* normal: of a power law. */
fret_status fret_diagram_make(const fret_normal *normal, double mu, fret_diagram **out);
void fret_diagram_free(fret_diagram *diagram);
void fret_diagram_count_loss(fret_diagram *diagram, bool on);
void fret_diagram_reset(fret_diagram *diagram);
fret_status fret_diagram_copy(fret_diagram *to, const fret_diagram *from);
fret_status fret_diagram_step(fret_diagram *diagram, const fret_step *step);
void fret_diagram_state(const fret_diagram *diagram, fret_state *out);
void fret_diagram_forces(const fret_diagram *diagram, fret_state *out);
double fret_diagram_last_loss(const fret_diagram *diagram);

/* For fret_contact_pack and _unpack: the length of the array, writing it, and reading it back. */
size_t fret_diagram_packed(const fret_diagram *diagram);
void fret_diagram_pack(const fret_diagram *diagram, double out[]);
fret_status fret_diagram_unpack(fret_diagram *diagram, const double from[], size_t count);

#endif
