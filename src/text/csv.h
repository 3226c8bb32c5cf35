/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tables in files, as people, spreadsheets, instruments and programs write them: columns of numbers with
 * names and units. Reads the file that it is given. */
#ifndef TEXT_CSV_H
#define TEXT_CSV_H

#include "text/error.h"
#include "text/file.h"
#include "text/unit.h"

enum { CSV_COLUMNS = 64, CSV_NAME = 128, CSV_MARKS = 2 };

/* One column. What is wrong with it is told when it is asked for: a file may have columns of text beside. */
typedef struct csv_values {
    char name[CSV_NAME];  /* by which it is asked for: its own, without the unit, or one that it was given */
    char title[CSV_NAME]; /* as the file names it, with the unit; empty: it does not */
    bool given;           /* the name is not its own */
    bool twice;           /* another has its name: it cannot be asked for by it */
    bool numbers;         /* stand in it in most rows */
    bool has_unit;
    unit u;
    dim d;
    double *v;     /* SI; rows of them, once it has been asked for; NaN: no value */
    char *trouble; /* the first thing wrong, or NULL */
} csv_values;

typedef struct csv_row {
    size_t line, at, len; /* in the file, and in its text */
} csv_row;

typedef struct csv {
    char *path, *text;
    file_stop stop;
    const char *encoding; /* NULL: one that leaves nothing to tell */
    char separator;       /* ' ': blanks and tabs */
    size_t columns, rows;
    csv_values column[CSV_COLUMNS];
    csv_row *row;
    csv_row header;           /* line 0: there is none */
    bool plain;               /* nothing stands above the header but comments */
    size_t marked[CSV_MARKS]; /* lines where points, and where commas stand in numbers first; 0: none do */
    size_t without;           /* rows left out since they have no value */
    size_t words, first_word; /* lines of words among the rows or below them, and the first of these */
} csv;

/* Finds the table: rows have numbers in the same columns, the header is the last line of names above them,
 * which may stand in a comment. `name [unit]`, `name (unit)`, `name/unit`, `name in unit`, `name_unit`, or
 * all units in a line of their own below the names. What stands above, lines of words, and `#` with what
 * follows it on a line of its own or behind the last number, is no part of it. Columns are parted by
 * semicolons, tabs, commas or blanks, whichever parts the most numbers; where it is no comma, a comma within
 * a number is a decimal one. A number that may have a mark of thousands, as `1.500` in a file with `950,5`,
 * is wrong. Fields may stand in quotation marks. Reading, as that of columns later, stops when `stop` is set.
 * Errors name file and line. Free with csv_free whatever comes. */
bool csv_read(const char *path, file_stop stop, csv *out, calc_error *error);
void csv_free(csv *c);

/* The column of this name, or that the file heads so; NULL: there is none. Values are not read. */
csv_values *csv_find(csv *c, const char *name);
/* Calls a column by another name; one that had this name has none then. */
void csv_rename(csv *c, csv_values *column, const char *name);
/* Its values, but for its trouble. */
bool csv_load(csv *c, csv_values *column, calc_error *error);
/* The one column of this name, whole and of numbers; NULL with an error that tells what to write. */
const csv_values *csv_column(csv *c, const char *name, calc_error *error);
/* Is there one? */
bool csv_has(csv *c, const char *name);
/* Leaves out the rows where a column that has been read has no value, and counts them. An error where none is
 * left. */
bool csv_settle(csv *c, calc_error *error);
/* Their names, "r, f, time"; numbers where they have none. */
void csv_names(const csv *c, char *buf, size_t size);
/* How the file may be told which column is which, behind an error: `; its columns are ..., by line 3, "..."`.
 */
void csv_layout(const csv *c, char *buf, size_t size);

#endif
