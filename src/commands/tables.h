/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tables of columns in SI: where `to FILE` says or to the screen, of a share of the rows or of all. */
#ifndef COMMANDS_TABLES_H
#define COMMANDS_TABLES_H

#include "statement/answer.h"
#include "statement/target.h"

typedef struct si_table {
    target to;
    answer a; /* rows go to it, once the table has begun */
    column column[COLUMNS];
    size_t count;
    bool begun, lost; /* memory is out */
} si_table;

/* False: no such file; there is nothing to close. */
bool table_open(shell *sh, const lexer *lx, said *all, si_table *t);
void table_column(si_table *t, const char *name, dim d);
/* The head, unless it is in another share; names that stand twice are told apart. */
bool table_begin(shell *sh, si_table *t, const char *event, calc_error *error);
/* The rows end; ok: those that there are stay. False: out of memory. */
bool table_end(si_table *t, bool ok);
/* The same, and all else. False: something was wrong before, or is now. */
bool table_close(shell *sh, lexer *lx, si_table *t, bool ok);

#endif
