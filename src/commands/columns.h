/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Assigns the columns of a CSV file to quantities: by name, by `using NAME = COLUMN, ...`, or by dimension. A
 * command calls columns_read, columns_take for each column (or csv_column, by name only), csv_settle, which
 * leaves out rows without a value, and columns_say, which notes how the file was understood. If columns are
 * names in expressions, it calls columns_show_names before these are parsed, and columns_load after. */
#ifndef COMMANDS_COLUMNS_H
#define COMMANDS_COLUMNS_H

#include <string.h>

#include "language/expr.h"
#include "statement/reader.h"
#include "study/points.h"
#include "text/csv.h"

/* Does an `at FILE` or `over FILE` precede every `using`? Else an error. */
bool columns_placed(const parsed *all, calc_error *error);

/* Reads the file named in the clause `file`, and renames its columns by `using`. Errors have their place.
 * Free `out` with csv_free, also after an error. */
bool columns_read(const lexer *lx, const parsed *all, const given_clause *file, csv *out);

/* The name of the file, without directories. */
static inline const char *columns_file(const csv *c) {
    const char *slash = strrchr(c->path, '/');
    return slash ? slash + 1 : c->path;
}

/* Are the dimensions equal, an angle being other than a number? */
bool same_dim(dim a, dim b);
/* The column of this dimension that has not been read and is not named after a quantity; NULL if there is not
 * just one. names, *count: all such columns. */
csv_values *column_of_dim(csv *c, dim d, char *names, size_t size, size_t *count);
/* Reads the column of this name and dimension. If none has the name, takes the only one of the dimension, and
 * gives it the name. NULL with an error. */
csv_values *columns_take(csv *c, const char *name, dim d, calc_error *error);
/* If all values of FN (may be NULL) are negative, turns their sign: compression is positive. True: done. */
bool columns_turn_pull(const csv *c, csv_values *FN);
/* Reverses the sign of a column. */
void columns_turn(const csv *c, csv_values *column);
/* Is the displacement of a measured loop read at the rig, including its compliance? It is if the file has a
 * column drig, or if it has no dx and the scene has a rig. loop_column: what the column is called. */
bool columns_at_rig(shell *sh, csv *c);
static inline const char *loop_column(bool rig) {
    return rig ? "drig" : "dx";
}
/* Reads displacement and force of a loop by columns_take. False with the error. */
bool columns_of_loop(csv *c, bool rig, csv_values **dx, csv_values **Fx, calc_error *error);
/* Is F_x negatively correlated with d_x, so that one of them has the opposite sign? */
bool columns_opposed(const csv *c, const csv_values *dx, const csv_values *Fx);
/* Notes on reversed signs. */
#define TURNED_FN "FN is negative throughout, which is compression here: its sign is turned"
#define TURNED_FX "Fx falls where dx grows: its sign is turned"

/* Statistics of the differences between a column of the file and computed values. */
typedef struct comparison {
    const csv_values *with;              /* the column; NULL: there is nothing to compare */
    size_t of;                           /* index of the expression that computes the values */
    size_t rows, worst_row;              /* number of differences; row of the largest */
    long double squares, worst, largest; /* sum of squares; largest difference; largest value of the column */
} comparison;

/* Adds a row to the statistics, and returns the file's value less the computed one. */
long double columns_differ(comparison *c, size_t row, long double computed);
/* The root mean square of the differences; NaN if there are none. */
long double columns_rms(const comparison *c);

/* Columns as names of expressions: of inputs that the scene takes, or of new names. */
typedef struct named_columns {
    size_t count;
    column_knob column[CSV_COLUMNS]; /* name and, after columns_load, values */
    csv_values *of[CSV_COLUMNS];     /* the column of the file */
    bool used;                       /* an expression mentions one of them */
    bool turned;                     /* the sign of FN has been reversed */
} named_columns;

/* Makes the names of columns known to expressions, until parsed_drop(all). */
bool columns_show_names(shell *sh, csv *data, parsed *all, named_columns *out, calc_error *error);
/* Keeps the columns that matter: inputs, and names that the first `expressions` of sh->list mention. Reads
 * them and leaves out rows without a value. A column of an input that is not mentioned may be unreadable. */
bool columns_load(const shell *sh, csv *data, size_t expressions, named_columns *out, calc_error *error);
/* The next quantity of the expression, from the i-th on, that is also a column but does not take its values
 * from it: a result, or an input that the scene does not take. NULL: there is none. */
const quantity *columns_hidden(const shell *sh, csv *data, const expr *e, size_t *i);
/* Explains the error of an unknown name: its column cannot be read, or which columns there are. False. */
bool columns_missed(const shell *sh, const lexer *lx, csv *data);

/* Notes how the file was understood: "loop.csv: 800 rows from line 21, dx from "Weg [um]", ...", then `more`
 * (may be empty). No note if all columns have their own names, all rows were used, and `more` is empty. */
void columns_say(shell *sh, const csv *c, const char *more);

#endif
