/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Two names at once: `map EXPR for A = ... for B = ...` as contours, and matrices of `table`. */
#ifndef COMMANDS_MAP_H
#define COMMANDS_MAP_H

#include "commands/looks.h"
#include "commands/range.h"
#include "study/sweep.h"

/* Both ranges of a grid; it must stay where it is. */
typedef struct grid_range {
    range a, b;
    grid grid;
} grid_range;

/* Of two `for`; steps: where none are given. */
bool grid_range_read(shell *sh, lexer *lx, said *all, grid_range *out, size_t steps_a, size_t steps_b);

/* Is the cursor on `map EXPR`? */
bool map_at(const lexer *lx);
bool map_draw(shell *sh, lexer *lx, said *all, plot_panel *p, const looks *l);
/* Its values as rows of a table, of which a share can be run. */
bool map_list(shell *sh, lexer *lx, said *all);

/* view_commands.c: a row for each pair of a grid, to where `to` says; takes the names of the columns. */
bool table_grid(shell *sh, lexer *lx, said *all, grid_range *over, column *columns, size_t count);

#endif
