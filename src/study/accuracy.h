/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Error against time of every model that can answer for the loss per cycle of a scene. Runs the models on
 * contacts of their own; the scene stays as it is. Prints nothing. */
#ifndef STUDY_ACCURACY_H
#define STUDY_ACCURACY_H

#include "scene/scene.h"

typedef enum model_family {
    FAMILY_CLOSED,
    FAMILY_MEMORY,
    FAMILY_QUADRATURE,
    FAMILY_LOOP,
    FAMILY_SPRINGS,
    FAMILY_MIDPOINT,
    FAMILIES
} model_family;

typedef struct family_row {
    const char *name;
    const char *size; /* what its number is called; empty: it has none */
    model_id model;
} family_row;

extern const family_row families[FAMILIES];

typedef struct accuracy_row {
    model_family family;
    unsigned long size; /* points, load steps of a branch, or springs; 0: the model has none */
    long double value;  /* dW [J] */
    long double error;  /* relative to the reference, at least what that can tell */
    bool below;         /* the error is smaller than what the reference can tell */
    double seconds;     /* of the processor, for one cycle; without setting up */
} accuracy_row;

enum { ACCURACY_ROWS = 32, ACCURACY_TEXT = 400 };

/* Where the amplitude comes from. */
typedef enum accuracy_from {
    FROM_USER,
    FROM_CYCLE,
    FROM_STEP,
    FROM_LIMIT /* half of mu F_N */
} accuracy_from;

typedef struct accuracy_study {
    bool by_force;
    double amplitude; /* of F_x [N], else of delta_x [m] */
    accuracy_from from;
    bool program;                  /* F_N varies: the load program is run as it is */
    long double FN;                /* [N] now */
    char reference[ACCURACY_TEXT]; /* what the errors refer to */
    long double value, agreement;  /* of the reference [J], and how far it can be trusted */
    const char *automatic, *why;   /* what `set model auto` picks */
    accuracy_row row[ACCURACY_ROWS];
    size_t count;
} accuracy_study;

typedef struct accuracy_load {
    bool given; /* the amplitude; else that of the load program */
    bool by_force;
    double amplitude;
    double seconds; /* of the processor, that the larger models may take */
} accuracy_load;

/* Is told of each row before it is measured: family and size. */
typedef void accuracy_progress(void *context, const accuracy_row *row);

/* Errors: what the scene has not got; FRET_GROSS_SLIP, FRET_NOT_POSITIVE naming FA,
 * dxA; interrupted. */
bool accuracy_measure(scene *s, const accuracy_load *load, accuracy_progress *progress, void *context,
                      accuracy_study *out, calc_error *error);

#endif
