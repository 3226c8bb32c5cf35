/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Error against time of every model that can answer for the loss per cycle of the scene. */
#ifndef SHELL_ACCURACY_H
#define SHELL_ACCURACY_H

#include "shell/shell.h"

typedef enum model_family {
    FAMILY_CLOSED,
    FAMILY_MEMORY,
    FAMILY_QUADRATURE,
    FAMILY_LOOP,
    FAMILY_SPRINGS,
    FAMILY_MIDPOINT,
    FAMILIES
} model_family;

extern const char *const family_names[FAMILIES];

typedef struct accuracy_row {
    model_family family;
    unsigned long size; /* points, load steps or springs; 0: the model has none */
    long double value;  /* dW [J] */
    long double error;  /* relative to the reference, at least what that can tell */
    bool below;         /* the error is smaller than what the reference can tell */
    double seconds;     /* of the processor, for one cycle; without setting up */
} accuracy_row;

enum { ACCURACY_ROWS = 32, ACCURACY_TEXT = 400 };

typedef struct accuracy_study {
    char load[ACCURACY_TEXT];      /* what the cycle is */
    char reference[ACCURACY_TEXT]; /* what the errors refer to */
    long double value, agreement;  /* of the reference [J], and how far it can be trusted */
    const char *automatic, *why;   /* what `set model auto` picks */
    accuracy_row row[ACCURACY_ROWS];
    size_t count;
} accuracy_study;

/* The amplitude asked for; len 0: none, that of the load program. */
typedef struct accuracy_load {
    bool by_force;
    double amplitude;
    size_t at, len; /* of its value in the statement */
    double seconds; /* of the processor, that the larger models may take */
} accuracy_load;

/* Reads [FA=... | dxA=...] [within SECONDS] at the cursor. */
bool accuracy_read(shell *sh, lexer *lx, accuracy_load *out);
bool accuracy_measure(shell *sh, const accuracy_load *load, accuracy_study *out, calc_error *error);

#endif
