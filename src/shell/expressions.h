/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Lists of expressions in statements: EXPR [in UNIT] [at NAME=EXPR, ...], ... */
#ifndef SHELL_EXPRESSIONS_H
#define SHELL_EXPRESSIONS_H

#include "shell/answer.h"
#include "shell/args.h"

/* Into sh->list and columns, which are to be freed whatever comes; at most limit. */
bool read_expressions(shell *sh, lexer *lx, column *columns, size_t limit, size_t *count);
/* One of them, at place i of the list. */
bool read_one_expression(shell *sh, lexer *lx, size_t i, column *c);
/* Can the value be shown so? Its dimension goes into the column, which may ask for another one. */
bool column_fits(const expr *e, column *c, value v, calc_error *error);

#endif
