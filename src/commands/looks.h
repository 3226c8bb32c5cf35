/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How a figure looks, as it is written behind it: title "...", xrange LO .. HI, log y, over FILE.csv, ... */
#ifndef COMMANDS_LOOKS_H
#define COMMANDS_LOOKS_H

#include "commands/columns.h"
#include "commands/expressions.h"
#include "plot/plot.h"
#include "text/csv.h"

enum { OVER = 4 }; /* files of measured points */

typedef struct limits {
    bool given;
    value end[2];
    size_t at, len;
} limits;

/* What must wait until the axes are known. */
typedef struct looks {
    limits x, y;
    size_t files;
    const said *all; /* where they are said: */
    const heard *over[OVER];
    shell *sh;
    bool residuals;
} looks;

/* The table of looks, a clause a line, and what an axis of theirs may be; NULL after the last. */
const char *look_line(size_t i);
const char *axes_name(size_t i);
/* All that have been said. */
bool looks_read(shell *sh, const lexer *lx, const said *all, plot_panel *p, looks *out);

/* An axis as the points on it stand, in SI. */
typedef struct axis_of {
    const char *name;
    dim d;
} axis_of;

/* The column of that name, read, or with an error not whole or not of that dimension; else, if alone, the
 * only one of that dimension that has not been read and is not called after another quantity; else NULL. */
const csv_values *looks_column(csv *c, const axis_of *axis, bool alone, calc_error *error);
/* Adds the measured points, in SI. */
bool looks_lay_over(lexer *lx, const looks *l, plot_panel *p, const axis_of *x, const axis_of *y);
/* The unit of an axis. */
typedef struct axis_unit {
    long double scale;
    char text[COLUMN_UNIT];
} axis_unit;

/* The one that its column asks for (c may be NULL), or with a prefix that fits the size. */
axis_unit axis_unit_for(const column *c, dim d, double size);
/* All points into that unit. */
void looks_divide(plot_panel *p, bool x_axis, long double scale);
/* The label, where none was given, and the limits in that unit. */
bool looks_axis(lexer *lx, const looks *l, plot_panel *p, bool x_axis, const axis_of *axis,
                const axis_unit *u);

#endif
