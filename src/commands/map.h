/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Grids over two names: the contours of `map EXPR for A = ... for B = ...`, and the matrices of `table`. */
#ifndef COMMANDS_MAP_H
#define COMMANDS_MAP_H

#include "commands/looks.h"
#include "commands/range.h"
#include "study/sweep.h"

/* Both ranges of a grid. They refer to each other: do not copy. */
typedef struct grid_range {
    range a, b; /* a.sweep runs over the first name, for each value of the second, b */
} grid_range;

/* Reads two `for` clauses; steps_a, steps_b: their steps where the statement has none. */
bool grid_range_read(shell *sh, lexer *lx, parsed *all, grid_range *out, size_t steps_a, size_t steps_b);

/* Is the cursor on `map EXPR`? */
bool map_at(const lexer *lx);
bool map_draw(shell *sh, lexer *lx, parsed *all, plot_panel *p, const looks *l);
/* Reads the expression and the ranges of a map. Free the column, also after an error. */
bool map_read(shell *sh, lexer *lx, parsed *all, column *c, grid_range *r);
/* Writes the values of a map as a table, of which a share can be run. In view_commands.c. */
bool table_map(shell *sh, lexer *lx, parsed *all);

#endif
