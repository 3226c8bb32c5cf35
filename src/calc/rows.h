/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A scene at many values of one input, by the closed forms in vectors: what they can answer of it, to 2e-15.
 */
#ifndef CALC_ROWS_H
#define CALC_ROWS_H

#include "calc/expr.h"

enum { SCENE_ROWS = EXPR_BLOCK };

/* Scenes of the same kind: as pressed, with the push of the last cycle, with that of the first loading, and
 * the twin with k = 0. */
typedef enum rows_kind { ROWS_PRESSED, ROWS_CYCLE, ROWS_PUSHED, ROWS_TWIN, ROWS_KINDS } rows_kind;

typedef struct rows_values {
    bool ready;
    double v[sizeof(fret_scene_values) / sizeof(double *)][SCENE_ROWS];
} rows_values;

typedef struct scene_rows {
    scene *s;
    input in;
    size_t count;
    const long double *x;
    /* the inputs of each row */
    fret_scenes of;
    double E0[2][SCENE_ROWS], nu[2][SCENE_ROWS], k[SCENE_ROWS], c0[SCENE_ROWS], n[SCENE_ROWS], h[SCENE_ROWS],
        r0[SCENE_ROWS], F[SCENE_ROWS], mu[SCENE_ROWS], push[SCENE_ROWS];
    bool pressed, rubs;  /* there are a gap and a load; friction */
    bool cycles, pushed; /* closed forms answer for the loss, and for the state */
    double amplitude, end;
    rows_values values[ROWS_KINDS];
} scene_rows;

/* 1 to SCENE_ROWS values; false: the scene has to be asked row by row. x is borrowed. */
bool rows_begin(scene_rows *r, scene *s, input in, const long double x[], size_t count);
/* Is the quantity, or the function, to be had? */
bool rows_have(const scene_rows *r, const quantity *q, bool call);
/* False: some row is to be asked by itself. */
bool rows_quantity(scene_rows *r, const quantity *q, long double out[]);
/* The argument at each row, or one for all: stride 0. */
bool rows_call(scene_rows *r, const quantity *q, const long double *arg, size_t stride, long double out[]);

#endif
