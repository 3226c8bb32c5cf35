/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The columns of a file that a command asks for: by name, as `using NAME = COLUMN, ...` tells, or by
 * dimension; and what was understood, in one line. A command reads the file (columns_read), takes its columns
 * (columns_take, or csv_column by name alone), leaves out the rows without a value (csv_settle), and says so
 * (columns_say). */
#ifndef COMMANDS_COLUMNS_H
#define COMMANDS_COLUMNS_H

#include "statement/reader.h"
#include "text/csv.h"

/* What `using` has said. */
enum { CHOICES = 16 };
typedef struct choices {
    span name[CHOICES], column[CHOICES];
    size_t count;
} choices;

/* One more; all of a statement. False: too many. */
bool choices_add(choices *to, const heard *h, calc_error *error);
bool choices_of(said *all, choices *out, calc_error *error);

/* The file that stands in the hole, its columns called as chosen. Errors have their place. Free with csv_free
 * whatever comes. */
bool columns_read(const lexer *lx, const span *file, const choices *chosen, csv *out);

/* Of the same dimension, an angle being none of a number? */
bool same_dim(dim a, dim b);
/* The one column of this dimension that is called after no quantity, not `but` (may be NULL): NULL, names and
 * how many where there are none or several. */
csv_values *column_of_dim(csv *c, dim d, const csv_values *but, char *names, size_t size, size_t *count);
/* The column of this name and dimension, with its values; where none has the name the one of the dimension,
 * which has the name from then on. NULL with an error. */
csv_values *columns_take(csv *c, const char *name, dim d, calc_error *error);
/* A normal force that is negative throughout is compression: turned. */
bool columns_turn_pull(const csv *c, csv_values *FN);
void columns_turn(const csv *c, csv_values *column);
/* Does F_x fall where d_x grows? */
bool columns_opposed(const csv *c, const csv_values *dx, const csv_values *Fx);
/* How these are told. */
#define TURNED_FN "FN is negative throughout, which is compression here: its sign is turned"
#define TURNED_FX "Fx falls where dx grows: its sign is turned"

/* "loop.csv: 800 rows from line 21, dx from "Weg [um]", ...", and what more there is to say (may be empty): a
 * note, unless all is as the header says. */
void columns_say(shell *sh, const csv *c, const char *more);

#endif
