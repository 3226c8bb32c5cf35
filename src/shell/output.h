/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Values and tables as text, CSV or JSON. */
#ifndef SHELL_OUTPUT_H
#define SHELL_OUTPUT_H

#include "shell/shell.h"

enum { COLUMNS = 40, COLUMN_NAME = 200, COLUMN_UNIT = 100 };

struct column {
    char name[COLUMN_NAME];
    char unit[COLUMN_UNIT]; /* as the user asked, else SI */
    long double scale;      /* of that unit */
    bool chosen;            /* the user named the unit */
    dim d;
};

/* A table on its way out. */
typedef struct table {
    shell *sh;
    FILE *to;
    size_t count;
    column columns[COLUMNS];
    int width[COLUMNS]; /* of text */
} table;

void table_begin(table *t);
void table_row(table *t, const long double *si);

/* A line `name = value unit`, or its CSV or JSON form. One statement prints count of them. */
void print_values(shell *sh, const column *columns, const long double *si, size_t count);
/* A value with a unit chosen for it, as text. */
void format_value(const shell *sh, value v, char *buf, size_t size);
/* The same with as many more digits as reading it back takes. */
void format_exact(const shell *sh, value v, char *buf, size_t size);
/* The text as a JSON string, quotation marks included. */
void print_json_string(FILE *to, const char *text);

#endif
