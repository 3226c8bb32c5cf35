/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tables with columns in SI, written to the file of `to FILE` or to the session's output. */
#ifndef COMMANDS_TABLES_H
#define COMMANDS_TABLES_H

#include "statement/answer.h"
#include "statement/target.h"

typedef struct si_table {
    target to;
    answer a; /* takes the rows, after table_begin */
    column column[COLUMNS];
    size_t count;
    bool begun; /* table_begin has succeeded */
    bool lost;  /* table_column ran out of memory */
} si_table;

/* Opens the destination. False: the file cannot be written; do not call table_close then. */
bool table_open(shell *sh, const lexer *lx, parsed *all, si_table *t);
/* Adds a column; running out of memory shows in table_begin. */
void table_column(si_table *t, const char *name, dim d);
/* Writes the header, unless another share of the run does. Numbers names that occur more than once. */
bool table_begin(shell *sh, si_table *t, const char *event, calc_error *error);
/* Ends the rows; writes those that are still held, if ok. False: out of memory. */
bool table_end(si_table *t, bool ok);
/* The same; then frees the columns and closes the destination. False: not ok, or writing failed. */
bool table_close(shell *sh, lexer *lx, si_table *t, bool ok);

#endif
