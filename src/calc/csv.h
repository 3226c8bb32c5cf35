/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tables from files: two columns of numbers with names and units in the header. */
#ifndef CALC_CSV_H
#define CALC_CSV_H

#include "calc/lex.h"
#include "calc/unit.h"

enum { CSV_NAME = 32 };

typedef struct csv {
    size_t count;
    double *column[2]; /* SI */
    char name[2][CSV_NAME];
    dim d[2];
} csv;

/* Reads `name [unit],name [unit]` and rows of two numbers; `#` begins a comment line. Commas, semicolons,
 * tabs or blanks part the columns. The error names file and line. Free with csv_free. */
bool csv_read(const char *path, csv *out, calc_error *error);
void csv_free(csv *c);

#endif
