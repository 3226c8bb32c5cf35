/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The columns of a file that a command asks for: by name, as `using NAME = COLUMN, ...` tells, by dimension,
 * or as names of expressions; and what was understood, in one line. A command reads the file (columns_read),
 * takes its columns (columns_take, or csv_column by name alone), leaves out the rows without a value
 * (csv_settle), and says so (columns_say); as names they become known (columns_wake), and those that are used
 * are taken and their rows settled (columns_load). */
#ifndef COMMANDS_COLUMNS_H
#define COMMANDS_COLUMNS_H

#include <string.h>

#include "language/expr.h"
#include "statement/reader.h"
#include "study/points.h"
#include "text/csv.h"

/* Does every `using` stand behind the file that it tells of, `at FILE` or `over FILE`? */
bool columns_placed(const said *all, calc_error *error);

/* The file of a clause, its columns called as `using` says. Errors have their place. Free with csv_free
 * whatever comes. */
bool columns_read(const lexer *lx, const said *all, const heard *file, csv *out);

/* Without its directories. */
static inline const char *columns_file(const csv *c) {
    const char *slash = strrchr(c->path, '/');
    return slash ? slash + 1 : c->path;
}

/* Of the same dimension, an angle being none of a number? */
bool same_dim(dim a, dim b);
/* The one column of this dimension that is called after no quantity and has not been read: NULL, names and
 * how many where there are none or several. */
csv_values *column_of_dim(csv *c, dim d, char *names, size_t size, size_t *count);
/* The column of this name and dimension, with its values; where none has the name the one of the dimension,
 * which has the name from then on. NULL with an error. */
csv_values *columns_take(csv *c, const char *name, dim d, calc_error *error);
/* A normal force that is negative throughout is compression: turned. */
bool columns_turn_pull(const csv *c, csv_values *FN);
void columns_turn(const csv *c, csv_values *column);
/* Of a loop: is its displacement the reading at a rig? Where the file has drig, or has no dx and the scene a
 * rig. Its name is loop_column then. */
bool columns_at_rig(shell *sh, csv *c);
static inline const char *loop_column(bool rig) {
    return rig ? "drig" : "dx";
}
/* Does F_x fall where d_x grows? */
bool columns_opposed(const csv *c, const csv_values *dx, const csv_values *Fx);
/* How these are told. */
#define TURNED_FN "FN is negative throughout, which is compression here: its sign is turned"
#define TURNED_FX "Fx falls where dx grows: its sign is turned"

/* What is computed against a column of the file. */
typedef struct comparison {
    const csv_values *with; /* NULL: there is nothing to compare */
    size_t of;              /* the expression */
    size_t rows, worst_row;
    long double squares, worst, largest; /* of differences; the largest value of the column */
} comparison;

/* What the file has in that row more than `ours`. */
long double columns_differ(comparison *c, size_t row, long double ours);
/* The root mean square; NaN: there is no difference. */
long double columns_rms(const comparison *c);

/* Columns as names of expressions: of inputs that the scene takes, or free ones. */
typedef struct named_columns {
    size_t count;
    column_knob column[CSV_COLUMNS];
    csv_values *of[CSV_COLUMNS];
    bool used;   /* an expression mentions one */
    bool turned; /* FN */
} named_columns;

/* They are known until what has been said is dropped. */
bool columns_wake(shell *sh, csv *data, said *all, named_columns *out, calc_error *error);
/* Leaves those that have a say, with their values, in rows where each has one: inputs, and what the first
 * expressions in sh->list mention. An input that is not mentioned may be no number. */
bool columns_load(const shell *sh, csv *data, size_t expressions, named_columns *out, calc_error *error);
/* Says more of a name that is unknown because something is wrong in its column, or there is none; false. */
bool columns_missed(const shell *sh, const lexer *lx, csv *data);

/* "loop.csv: 800 rows from line 21, dx from "Weg [um]", ...", and what more there is to say (may be empty): a
 * note, unless all is as the header says. */
void columns_say(shell *sh, const csv *c, const char *more);

#endif
