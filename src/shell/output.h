/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Values and tables as text, CSV or JSON. */
#ifndef SHELL_OUTPUT_H
#define SHELL_OUTPUT_H

#include <stdio.h>

#include "calc/file.h"
#include "calc/scene.h"
#include "shell/settings.h"

enum { COLUMNS = 42, COLUMN_UNIT = 100, NUMBER_TEXT = 32 };

typedef struct column {
    char *name;             /* its own */
    char unit[COLUMN_UNIT]; /* as the user asked, else SI */
    long double scale;      /* of that unit */
    bool chosen;            /* the user named the unit */
    dim d;
} column;

/* A copy of a text as the name of a column, on one line; NULL: out of memory. */
char *column_name(const char *text, size_t len);
/* In SI. False: out of memory. */
bool column_si(column *c, const char *name, dim d);
/* In text: a unit that suits `count` values, each `stride` after the last; the one asked for stays. */
void column_suit(column *c, const long double *v, size_t count, size_t stride, int digits);
/* Names that stand twice are told apart, as `x` and `x (2)`. False: out of memory. */
bool columns_distinct(column *c, size_t count);
void columns_free(column *c, size_t count);

/* A table on its way out. A value that is not finite is a gap. */
typedef struct table {
    const settings *set;
    FILE *to;
    int format;
    size_t count;
    const column *columns;
    /* of text: the first rows wait until units that suit them are chosen */
    bool headed;
    long double *held; /* rows of count values, and 1 where a blank line comes before */
    size_t rows;
    bool gap;
    int width[COLUMNS];
    long double scale[COLUMNS];
} table;

/* False: out of memory; there is nothing to end then. */
bool table_begin(table *t);
void table_row(table *t, const long double *si);
/* Will the next row be written, not held? */
bool table_shows_next(const table *t);
/* A blank line before the next row, in text. */
void table_gap(table *t);
/* What still waits goes out; ok: else it is dropped. */
void table_end(table *t, bool ok);

/* A line `name = value unit`, or its CSV or JSON form. One statement prints count of them. */
void print_values(const settings *set, FILE *to, const column *columns, const long double *si, size_t count);
void print_json_value(FILE *to, const char *name, long double v, dim d);
/* %.*g, faster. */
size_t number_text(char text[NUMBER_TEXT], int digits, double v);
/* A value with a unit chosen for it, as text. */
void format_value(const settings *set, value v, char *buf, size_t size);
/* The same with as many digits as reading it back takes. */
void format_exact(value v, char *buf, size_t size);
/* A text on one line, what does not show escaped: see calc/characters.h. Line ends become blanks. */
void print_safe(FILE *to, const char *text, size_t len);
/* The text as a JSON string, quotation marks included; bytes that are no UTF-8 become U+FFFD. */
void print_json_string(FILE *to, const char *text);

#endif
