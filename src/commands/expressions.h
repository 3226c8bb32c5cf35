/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Lists of expressions in statements: EXPR [in UNIT] [at NAME=EXPR, ...], ... */
#ifndef COMMANDS_EXPRESSIONS_H
#define COMMANDS_EXPRESSIONS_H

#include "statement/answer.h"
#include "statement/reader.h"

/* Behind the first *count of sh->list and columns, which are to be freed whatever comes; at most limit in
 * all. */
bool read_expressions(shell *sh, lexer *lx, column *columns, size_t limit, size_t *count);
/* The same of a part of the statement, and nothing else may stand there. */
bool read_expressions_in(shell *sh, const lexer *lx, const span *part, column *columns, size_t limit,
                         size_t *count);
/* One of them, at place i of the list; at the first, and nothing else. */
bool read_expression(shell *sh, lexer *lx, size_t i, column *c);
bool read_one_expression(shell *sh, lexer *lx, column *c);
/* One more name at the cursor, none twice, with a value where it is to be known; at most so many. */
bool read_name(shell *sh, lexer *lx, bool known, size_t most, knob *names, size_t *count);
/* EXPR = EXPR, the first two of the list. */
bool read_sides(shell *sh, const lexer *lx, const heard *equation);
/* Can the value be shown so? Its dimension goes into the column, which may ask for another one. */
bool column_fits(const expr *e, column *c, value v, calc_error *error);

#endif
