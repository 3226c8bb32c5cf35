/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Error against time of every model that can compute the loss per cycle of a scene. Depends on scene; runs
 * the models on contacts of their own, leaves the scene as it is and prints nothing. */
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
    const char *size; /* symbol of the size, "M" or "N"; empty: the model has no size */
    model_id model;
} family_row;

extern const family_row families[FAMILIES];

typedef struct accuracy_row {
    model_family family;
    unsigned long size; /* load steps of a branch, or springs; 0: the model has no size */
    long double value;  /* dW [J] */
    long double error;  /* relative to the reference; at least the uncertainty of the reference */
    bool below;         /* the true error is below that uncertainty */
    double seconds;     /* processor time of one cycle, without setting up */
} accuracy_row;

enum { ACCURACY_ROWS = 32, ACCURACY_TEXT = 400 };

/* The source of the amplitude. */
typedef enum accuracy_from {
    FROM_USER,
    FROM_CYCLE, /* of the load program */
    FROM_STEP,  /* |F_x| after the last step */
    FROM_LIMIT  /* mu F_N/2 */
} accuracy_from;

typedef struct accuracy_study {
    bool by_force;
    double amplitude; /* by_force: of F_x [N], else of delta_x [m] */
    accuracy_from from;
    bool program;                  /* F_N varies or there is a rig: the load program is run as it is */
    long double FN;                /* present normal force [N] */
    char reference[ACCURACY_TEXT]; /* description of the reference */
    long double value, agreement;  /* the loss by the reference [J], and its relative uncertainty */
    const char *automatic, *why;   /* the model that `set model auto` chooses, and the reason */
    accuracy_row row[ACCURACY_ROWS];
    size_t count;
} accuracy_study;

typedef struct accuracy_load {
    bool given; /* the user gives the amplitude; else that of the load program is used */
    bool by_force;
    double amplitude;
    double seconds; /* processor time that the larger models may take */
} accuracy_load;

/* Measures the models. Errors: a value is missing; gross slip or FA, dxA not positive; interrupted. */
bool accuracy_measure(scene *s, const accuracy_load *load, accuracy_study *out, calc_error *error);

#endif
