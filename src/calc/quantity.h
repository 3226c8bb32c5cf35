/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The one table of quantities: assignment, query, help, completion, labels and JSON derive from it. */
#ifndef CALC_QUANTITY_H
#define CALC_QUANTITY_H

#include "calc/scene.h"

typedef struct quantity {
    const char *name;
    const char *title;                                          /* for labels and help */
    const char *formula;                                        /* in plain text */
    const char *source;                                         /* equation number or reference */
    dim d;                                                      /* of the value; see quantity_dim for A */
    int in;                                                     /* the input it is, or -1 */
    bool (*get)(scene *s, long double *out, calc_error *error); /* NULL: only a function */
    bool (*call)(scene *s, value arg, long double *out, calc_error *error); /* NULL: no function */
    const char *argument; /* name and dimension of the function's argument */
    dim argument_d;
    /* the function at many arguments, to 2e-15; NULL: call does them one by one */
    bool (*block)(scene *s, const double arg[], double out[], size_t count, calc_error *error);
} quantity;

const quantity *quantity_find(const char *name, size_t len);
const quantity *quantity_row(size_t i); /* NULL after the last */
const char *quantity_name(size_t i);    /* for suggest() */
/* The dimension in this scene: that of A depends on n. */
dim quantity_dim(const quantity *q, const scene *s);

#endif
