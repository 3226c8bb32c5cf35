/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Two names at once: `map EXPR for A = ... for B = ...` as contours, and matrices of `table`. */
#ifndef COMMANDS_MAP_H
#define COMMANDS_MAP_H

#include "commands/looks.h"
#include "commands/range.h"
#include "study/sweep.h"

/* Both ranges of a grid; it must stay where it is. */
typedef struct grid_range {
    range a, b; /* a: the sweep, across that of b */
} grid_range;

/* Of two `for`; steps: where none are given. */
bool grid_range_read(shell *sh, lexer *lx, said *all, grid_range *out, size_t steps_a, size_t steps_b);

/* Is the cursor on `map EXPR`? */
bool map_at(const lexer *lx);
bool map_draw(shell *sh, lexer *lx, said *all, plot_panel *p, const looks *l);
/* The expression and the ranges of a map; the column is to be freed, also after an error. */
bool map_read(shell *sh, lexer *lx, said *all, column *c, grid_range *r);
/* view_commands.c: its values as rows of a table, of which a share can be run. */
bool table_map(shell *sh, lexer *lx, said *all);

#endif
