/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The memory diagram from inside: what a contact keeps between steps. Not installed. */
#ifndef FRET_CONTACT_MEMORY_H
#define FRET_CONTACT_MEMORY_H

#include "contact/phase.h"
#include "fret/memory.h"
#include "number/sum.h"

typedef struct slice {
    fret_real thick[2]; /* kept apart from the positions: a thin slice at the edge keeps its digits */
    fret_real inner[2]; /* depth and load of the inner end */
    fret_real sigma;    /* -u'/(mu eta) */
    fret_real sum[2];   /* int sigma dy and int sigma dF_N from the centre to the outer end */
    fret_real L;        /* int_0^d G dt at the inner end, as long as the edge is */
    unsigned long edge; /* this one */
} slice;

struct fret_memory {
    const fret_normal *normal; /* borrowed */
    double mu;
    fret_real mu_eta, loss_scale; /* mu eta; mu^2 eta */
    fret_real edge[2];            /* delta_z and F_N; 0, 0 when open */
    double edge_rest[2];          /* what does not fit in them */
    fret_real radius;             /* of the edge */
    bool pressed_near;            /* by `near`: rest and radius are not known, */
    fret_normal_target told_by;   /* but follow from what the edge was told by */
    double told;
    unsigned moves;  /* of the edge, so far */
    fret_near *near; /* or NULL; in use after some moves, so that no digit depends on whether it is there */
    double gap;      /* distance of the open bodies, >= 0 */
    unsigned long edge_id;       /* changes with the edge */
    fret_real slid;              /* delta_x - mu eta int sigma dy: what gross slip has carried along */
    int direction;               /* of the last tangential motion */
    fret_tangential_target held; /* where it ended: goal is F_x or delta_x exactly; FRET_KEEP_DX: neither */
    double goal;
    fret_sum W;
    fret_real last_loss;
    size_t count, room;
    slice *slices; /* innermost first */
};

/* The edge with its radius, and all digits. */
fret_press fret_memory_pressed(const fret_memory *memory);

/* What `edge`, the edge in this coordinate, leaves out. */
double fret_memory_edge_rest(const fret_memory *memory, coordinate by, fret_real edge);

/* Room for `count` slices. Error: FRET_NO_MEMORY. */
fret_status fret_memory_reserve(fret_memory *memory, size_t count);

/* F_x/mu at the end of a step by force, which must not exceed the normal force FN there; 0 by displacement.
 * Errors: FRET_NOT_FINITE, FRET_GROSS_SLIP. */
fret_status fret_step_load(double mu, const fret_step *step, fret_real FN, fret_real *load);

/* int sigma dy, or int sigma dF_N, over the whole contact. */
static inline fret_real fret_memory_total(const fret_memory *m, coordinate by) {
    return m->count ? m->slices[m->count - 1].sum[by] : 0;
}

/* delta_x */
static inline fret_real fret_memory_dx(const fret_memory *m) {
    return m->slid + m->mu_eta * fret_memory_total(m, DEPTH);
}

#endif
