/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tables from files, as people and spreadsheets write them: columns of numbers with names and units in the
 * header. Reads the file that it is given. */
#ifndef TEXT_CSV_H
#define TEXT_CSV_H

#include "text/error.h"
#include "text/file.h"
#include "text/unit.h"

enum { CSV_COLUMNS = 64, CSV_NAME = 32 };

/* One column. What is wrong with it is told when it is asked for: a file may have columns of text beside. */
typedef struct csv_values {
    char name[CSV_NAME];
    dim d;
    bool has_unit;
    bool twice;    /* another has its name: it cannot be asked for by it */
    double *v;     /* SI; rows of them */
    char *trouble; /* the first thing wrong, or NULL */
} csv_values;

typedef struct csv {
    char *path;
    size_t rows, columns, room;
    csv_values column[CSV_COLUMNS];
    size_t *line; /* of each row in the file */
} csv;

/* The header is `name [unit]`, `name (unit)`, `name/unit` or a bare name, for each column. Columns are parted
 * by semicolons, tabs, commas or blanks, whichever the header has first in this order; where it is no comma,
 * a comma within a number is a decimal one. A number that may have a mark of thousands, as `1.500` in a file
 * with `950,5`, is wrong. Fields may stand in quotation marks, `#` begins a comment, on a line of its own or
 * behind the last number, and the micro sign may be that of Latin-1. Reading stops when `stop` is set. Errors
 * name file and line. Free with csv_free whatever comes. */
bool csv_read(const char *path, file_stop stop, csv *out, calc_error *error);
void csv_free(csv *c);

/* The one column of this name, whole and of numbers; NULL with an error. */
const csv_values *csv_column(const csv *c, const char *name, calc_error *error);
/* Is there one? */
bool csv_has(const csv *c, const char *name);
/* Their names, "r, f, time". */
void csv_names(const csv *c, char *buf, size_t size);

#endif
