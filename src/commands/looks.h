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

/* The unit of an axis; scale 0: it is not known yet. */
typedef struct axis_unit {
    long double scale;
    char text[COLUMN_UNIT];
} axis_unit;

/* An axis as the points on it stand, in SI. */
typedef struct axis_of {
    const char *name;
    dim d;
    const column *like; /* asks for a unit, or not; or NULL */
    axis_unit *unit;    /* to be kept, or as it has been; or NULL */
} axis_of;

/* The column of that name, read, or with an error not whole or not of that dimension; else, if alone, the
 * only one of that dimension that has not been read and is not called after another quantity; else NULL. */
const csv_values *looks_column(csv *c, const axis_of *axis, bool alone, calc_error *error);
/* Adds the measured points, in SI. */
bool looks_lay_over(lexer *lx, const looks *l, plot_panel *p, const axis_of *x, const axis_of *y);
/* What is drawn along an axis: the ends, and the least above 0. Of nothing lo is above hi. */
typedef struct axis_extent {
    double lo, hi, least;
} axis_extent;
axis_extent looks_extent(const plot_panel *p, bool x_axis);

/* The unit that the column asks for (c may be NULL), or with a prefix that fits the size. */
axis_unit axis_unit_for(const column *c, dim d, double size);
/* All that is drawn, and the limits, into the unit of the axis: one that suits them, unless it is known or
 * asked for. The label, where none was given. */
bool looks_axis(lexer *lx, const looks *l, plot_panel *p, bool x_axis, const axis_of *axis);

#endif
