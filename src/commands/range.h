/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Ranges of tables and plots as they have been said: for NAME = LO .. HI, along a load, with NAME = v1, v2,
 * ...; the rows of a file, `at FILE` and `over FILE residuals`, and what they have to compare with. */
#ifndef COMMANDS_RANGE_H
#define COMMANDS_RANGE_H

#include "commands/looks.h"
#include "statement/command.h"
#include "statement/output.h"
#include "study/sweep.h"

/* `a*for FN = ..`: an error, where the range has gone on what stands before it. */
static inline bool range_hides(const lexer *lx, const said *all) {
    return said_hides(lx, all, "for") || said_hides(lx, all, "along");
}

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
/* The rows of a file over a range of one name, which it has a column for. */
bool rows_over(const lexer *lx, const said *all, const heard *file, sweep *over, file_rows *out);
/* What was understood, behind what has been compared. */
void rows_say(shell *sh, const file_rows *r);

/* What an expression is to be compared with, or NULL: the column of its name, else, of an expression that is
 * alone in its dimension, the only one of that which is not used and has not the name of another quantity. */
const csv_values *rows_compared(file_rows *r, const axis_of *expression, bool alone, calc_error *error);

/* What a load along which it goes begins with; NULL after the last. */
const char *load_name(size_t i);
/* What may be said of a range, in one line; NULL after it. */
const char *range_line(size_t i);

/* A sweep and where in the statement its range stands: it is read again for each curve. */
typedef struct range {
    sweep sweep;
    shell *sh;
    lexer own; /* over LO .. HI, a list, or the load */
    bool listed;
} range;

/* LO .. HI of var, and no more; word: what stands between them instead of `..`, or NULL. */
bool range_read_interval(shell *sh, const lexer *lx, const span *part, const knob *var, const char *word,
                         sweep_range *out);
/* As far as the load goes that stands there. */
bool range_read_along(shell *sh, const lexer *lx, const span *load, range *out);
/* The range of the which-th `for`, or `along`. It must stay where it is, and the text of the statement too.
 */
bool range_read(shell *sh, lexer *lx, said *all, size_t which, range *out);
/* The same of a `for` that is there; takes: the scene must have a use for the name. */
bool range_read_name(shell *sh, lexer *lx, said *all, size_t which, bool takes, range *out);
/* The rows of `at FILE` and its `with`, for the first `count` expressions; `from` must stay where it is, too.
 */
bool range_read_rows(shell *sh, lexer *lx, said *all, file_rows *from, size_t count, range *out);
/* `steps`, `log` and `with` of that range, which stand before the next `for`; steps: where none are given. */
bool range_options(shell *sh, lexer *lx, const said *all, size_t which, range *out, size_t steps);
/* What a sweep finds of its expressions, or what their columns ask for. */
typedef struct found {
    dim d[COLUMNS];
    bool known[COLUMNS];
    const char *units[COLUMNS];
} found;

/* The values of s->with: the curves of a sweep. */
bool range_read_values(shell *sh, const lexer *lx, const span *values, sweep *s);

/* A sweep of the expressions in sh->list, which have these columns. */
sweep_job range_job(shell *sh, const column *columns, size_t count, found *f, sweep_row *row, void *context,
                    calc_error *error);
/* Says on standard error why some values of a sweep are missing. */
void note_missing(shell *sh, const sweep_job *job);

#endif
