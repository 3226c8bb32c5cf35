/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reads the ranges of tables and plots: for NAME = LO .. HI, along a load, with NAME = v1, v2, ..., and the
 * rows of a file (`at FILE`, `over FILE residuals`) with the columns that results are compared with. */
#ifndef COMMANDS_RANGE_H
#define COMMANDS_RANGE_H

#include "commands/looks.h"
#include "statement/command.h"
#include "statement/output.h"
#include "study/sweep.h"

/* Has an expression swallowed the `for` or `along` of the range, as in `a*for FN = ..`? Then an error. */
static inline bool range_hides(const lexer *lx, const parsed *all) {
    return parsed_swallowed(lx, all, "for") || parsed_swallowed(lx, all, "along");
}

/* The file of `at FILE` or `over FILE residuals`; given: the statement has such a clause. */
typedef struct file_rows {
    bool given;
    csv data;
    named_columns names;
    sweep_rows at; /* the sweep over the rows, see sweep.h */
} file_rows;

/* Reads the file of `at FILE`, if there is one, and makes its columns known to expressions until parsed_drop.
 * Call rows_close afterwards, also after an error. */
bool rows_open(shell *sh, const lexer *lx, parsed *all, file_rows *out);
void rows_close(file_rows *r);
/* Of `over FILE residuals`: turns a sweep over one name into one over the file's values of that name. */
bool rows_over(const lexer *lx, const parsed *all, const given_clause *file, sweep *over, file_rows *out);
/* Notes how the file was understood; called when all columns have been read. */
void rows_say(shell *sh, const file_rows *r);

/* The column that an expression is compared with, or NULL: the one of its name; else, if no other expression
 * has its dimension (alone), the only column of it that is not used and not named after a quantity. */
const csv_values *rows_compared(file_rows *r, const axis_of *expression, bool alone, calc_error *error);

/* First words of a LOAD; NULL after the last. */
const char *load_name(size_t i);
/* The grammar of a range: one line; NULL after it. */
const char *range_line(size_t i);

/* A sweep, and the text of its range, which is evaluated again for each curve. sweep.context points to it. */
typedef struct range {
    sweep sweep;
    shell *sh;
    lexer own;   /* over the text of the interval, the list of values, or the load */
    bool listed; /* it is a list */
} range;

/* Reads LO .. HI for `var` from a part that holds nothing else; word: a word in place of `..`, or NULL. */
bool range_read_interval(shell *sh, const lexer *lx, const span *part, const knob *var, const char *word,
                         sweep_range *out);
/* Reads the load of `along LOAD`. */
bool range_read_along(shell *sh, const lexer *lx, const span *load, range *out);
/* Reads the which-th `for`, or `along`. Do not copy `out`; the text of the statement must outlive it. */
bool range_read(shell *sh, lexer *lx, parsed *all, size_t which, range *out);
/* The same for a `for` that the statement has; takes: it is an error if the scene has no use for the name. */
bool range_read_name(shell *sh, lexer *lx, parsed *all, size_t which, bool takes, range *out);
/* Makes a sweep over the rows of `at FILE`, with its `with`, for the first `count` expressions of sh->list.
 * Neither `out` nor `from` may be copied. */
bool range_read_rows(shell *sh, lexer *lx, parsed *all, file_rows *from, size_t count, range *out);
/* Reads `steps`, `log` and `with` before the next `for`; steps: the number where the statement has none. */
bool range_options(shell *sh, lexer *lx, const parsed *all, size_t which, range *out, size_t steps);
/* Dimensions of the expressions of a sweep: known where the column has a unit, or from the first value on. */
typedef struct found {
    dim d[COLUMNS];
    bool known[COLUMNS];
    const char *units[COLUMNS]; /* the unit asked for, for messages; or NULL */
} found;

/* Reads the list of values of s->with, one for each curve. */
bool range_read_values(shell *sh, const lexer *lx, const span *values, sweep *s);

/* Sets up a sweep of the first `count` expressions in sh->list, whose results go to `row`. */
sweep_job range_job(shell *sh, const column *columns, size_t count, found *f, sweep_row *row, void *context,
                    calc_error *error);
/* Notes why some values of a sweep are missing, if so. */
void note_missing(shell *sh, const sweep_job *job);

#endif
