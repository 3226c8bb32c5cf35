/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tables in text files, as people, spreadsheets, instruments and programs write them: columns of numbers with
 * names and units. Reads the given file and writes none. */
#ifndef TEXT_CSV_H
#define TEXT_CSV_H

#include "text/error.h"
#include "text/file.h"
#include "text/unit.h"

enum { CSV_COLUMNS = 64, CSV_NAME = 128, CSV_MARKS = 2 };

/* One column. Its values are read, and its errors reported, only on request: other columns may hold text. */
typedef struct csv_values {
    char own[CSV_NAME];   /* the name in the header, without the unit; empty: none */
    char name[CSV_NAME];  /* the same, or the one given by csv_rename; empty: none */
    char title[CSV_NAME]; /* the text of the header, with the unit; empty: none */
    bool given;           /* csv_rename has changed the name */
    bool twice;           /* another column has the same name: the name does not select this one */
    bool numbers;         /* most rows have a number here */
    bool has_unit;
    unit u;
    dim d;
    double *v;     /* a value in SI units per row, NaN where it is missing; NULL until csv_load */
    char *trouble; /* the message of the first error in this column, or NULL */
} csv_values;

typedef struct csv_row {
    size_t line, at, len; /* line number in the file, from 1; index into csv.text, and bytes */
} csv_row;

typedef struct csv {
    char *path, *text; /* the name of the file, and its content in UTF-8 */
    file_in in;        /* open until csv_free or file_in_close: no output may replace the file */
    file_stop stop;
    const char *encoding; /* the encoding for a notice to the user, or NULL */
    char separator;       /* ' ': blanks and tabs */
    size_t columns, rows;
    csv_values column[CSV_COLUMNS];
    csv_row *row;
    csv_row header;           /* line 0: the table has no header */
    bool plain;               /* above the header there are only comments */
    size_t marked[CSV_MARKS]; /* first lines with a point, and with a comma, within a number; 0: none */
    size_t without;           /* rows that csv_settle has left out for want of a value */
    size_t words, first_word; /* how many lines of words stand among or below the rows; number of the first */
} csv;

/* Reads a file and finds its table. Rows have numbers in the same columns; the header is the last line of
 * names above them and may be a comment. A title is `name [unit]`, `name (unit)`, `name/unit`, `name in unit`
 * or `name_unit`, or all units stand in a line of their own below the names. Ignored are the text above the
 * header, lines of words, and `#` with what follows on a line of its own or behind the last number. The
 * separator (semicolon, tab, comma, blanks) is the one between the most numbers; unless it is a comma, a
 * comma within a number is a decimal one. A number that may have a thousands separator (`1.500` beside
 * `950,5`) is an error. Fields may be quoted. Setting `stop` ends this reading, and csv_load later, with an
 * error. A table that was written as FILE.json is read, too. Errors name the file and the line, if any. Free
 * with csv_free, also after a failure. */
bool csv_read(const char *path, file_stop stop, csv *out, calc_error *error);
void csv_free(csv *c);

/* The first column with this name or else this title; NULL: there is none. Its values are not read. */
csv_values *csv_find(csv *c, const char *name);
/* The same by the header alone, whatever csv_rename has done. */
csv_values *csv_in_header(csv *c, const char *name);
/* Gives a column another name; a column that had this name before has no name then. */
void csv_rename(csv *c, csv_values *column, const char *name);
/* Reads the values of a column unless that is done. False with the error if a cell is not a number. */
bool csv_load(csv *c, csv_values *column, calc_error *error);
/* The only column of this name, loaded; NULL with an error that says what to write instead. */
const csv_values *csv_column(csv *c, const char *name, calc_error *error);
/* Drops the rows where a loaded column has no value, and counts them. False with an error if none is left. */
bool csv_settle(csv *c, calc_error *error);
/* The names of the columns, "r, f, time"; the column's number where it has no name. */
void csv_names(const csv *c, char *buf, size_t size);
/* A clause for error messages on the columns found: `its columns are ..., by line 3, "..."`. */
void csv_layout(const csv *c, char *buf, size_t size);

#endif
