/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reads expressions in statements: EXPR [in UNIT] [at NAME=EXPR, ...], ... They go to sh->list. */
#ifndef COMMANDS_EXPRESSIONS_H
#define COMMANDS_EXPRESSIONS_H

#include "statement/answer.h"
#include "statement/reader.h"

/* Reads a list at the cursor into sh->list and `columns` from index *count on, at most `limit` in all. Free
 * *count columns, also after an error. */
bool read_expressions(shell *sh, lexer *lx, column *columns, size_t limit, size_t *count);
/* The same from index 0, of a part of the statement that holds the list alone. */
bool read_expressions_in(shell *sh, const lexer *lx, const span *part, column *columns, size_t limit,
                         size_t *count);
/* Reads one expression of a list into sh->list[i]; or a single one into sh->list[0], up to the end. */
bool read_expression(shell *sh, lexer *lx, size_t i, column *c);
bool read_one_expression(shell *sh, lexer *lx, column *c);
/* Appends the name at the cursor to `names`, at most `most`, none twice. known: it must have a value. */
bool read_name(shell *sh, lexer *lx, bool known, size_t most, knob *names, size_t *count);
/* Reads the two sides of EXPR = EXPR into sh->list[0] and [1]. */
bool read_sides(shell *sh, const lexer *lx, const given_clause *equation);
/* Sets the column's dimension to that of v. False: the unit asked for has another one, or v is too large. */
bool column_fits(const expr *e, column *c, value v, calc_error *error);

#endif
