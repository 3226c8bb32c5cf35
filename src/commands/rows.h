/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tables from files: their columns as names of expressions, and their rows as a range, `at FILE`. */
#ifndef COMMANDS_ROWS_H
#define COMMANDS_ROWS_H

#include "commands/looks.h"
#include "study/sweep.h"
#include "text/csv.h"

/* Column `name` of this dimension; NULL: there is none, or with an error it is not of it. */
const double *columns_find(const csv *data, const char *name, dim d, calc_error *error);
/* All columns that can be names, of inputs that the scene takes or free ones, which are known then: until
 * names_forget(sh, names). There is room for CSV_COLUMNS. */
bool columns_wake(shell *sh, const csv *data, size_t names, column_knob *out, size_t *count,
                  calc_error *error);
bool columns_used(const shell *sh, const column_knob *of_file, const expr *e);

/* Says more of a name that is unknown because something is wrong in its column, or there is none; false. */
bool columns_missed(const shell *sh, const lexer *lx, const csv *data);

/* Of `at FILE`; nothing where that has not been said. */
typedef struct file_rows {
    bool given;
    csv data;
    sweep_rows at;
    size_t count; /* columns that can be names */
    column_knob column[CSV_COLUMNS];
} file_rows;

/* Reads the file, and makes its columns known to what is parsed then, until said_drop. To be closed whatever
 * comes. */
bool rows_open(shell *sh, const lexer *lx, said *all, file_rows *out);
void rows_close(file_rows *r);
/* The range of the first `count` expressions in sh->list: the inputs in the file and the names that they use.
 */
bool rows_range(shell *sh, const lexer *lx, said *all, file_rows *r, size_t count, sweep *out);
/* The rows of a file over a range of one name, which it has a column for. */
bool rows_over(const lexer *lx, const span *file, sweep *over, file_rows *out);
/* An expression against a column of the file. */
typedef struct comparison {
    const csv_values *with; /* NULL: there is nothing to compare */
    size_t of;              /* the expression */
    size_t rows, worst_row;
    long double squares, worst, largest; /* of differences; the largest value of the column */
} comparison;

/* What the file has in that row more than `ours`. */
long double rows_differ(comparison *c, size_t row, long double ours);
/* The root mean square; NaN: there is no difference. */
long double rows_rms(const comparison *c);
/* What an expression is to be compared with, or NULL: the column of its name, else, of an expression that is
 * alone in its dimension, the only one of that which is not used and has not the name of another quantity. */
const csv_values *rows_compared(const file_rows *r, const axis_of *expression, bool alone, calc_error *error);

#endif
