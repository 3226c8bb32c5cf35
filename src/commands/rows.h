/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The rows of a file as a range, `at FILE` and `over FILE residuals`, and what it has to compare with. */
#ifndef COMMANDS_ROWS_H
#define COMMANDS_ROWS_H

#include "commands/looks.h"
#include "study/sweep.h"
#include "text/csv.h"

/* Of `at FILE`; nothing where that has not been said. */
typedef struct file_rows {
    bool given;
    csv data;
    named_columns names;
    sweep_rows at;
} file_rows;

/* Reads the file, and makes its columns known to what is parsed then, until said_drop. To be closed whatever
 * comes. */
bool rows_open(shell *sh, const lexer *lx, said *all, file_rows *out);
void rows_close(file_rows *r);
/* The range of the first `count` expressions in sh->list: the inputs in the file and the names that they use.
 */
bool rows_range(shell *sh, const lexer *lx, said *all, file_rows *r, size_t count, sweep *out);
/* The rows of a file over a range of one name, which it has a column for. */
bool rows_over(const lexer *lx, const said *all, const heard *file, sweep *over, file_rows *out);
/* What was understood, behind what has been compared. */
void rows_say(shell *sh, const file_rows *r);

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
const csv_values *rows_compared(file_rows *r, const axis_of *expression, bool alone, calc_error *error);

#endif
