/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Looks of a figure, clauses behind it (title "...", xrange LO .. HI, log y, over FILE, ...), and axes. */
#ifndef COMMANDS_LOOKS_H
#define COMMANDS_LOOKS_H

#include "commands/columns.h"
#include "commands/expressions.h"
#include "plot/plot.h"
#include "text/csv.h"

enum { OVER = 4 }; /* the most files of measured points */

/* LO .. HI of xrange or yrange. */
typedef struct limits {
    bool given;
    value end[2];
    size_t at, len; /* place in the statement */
} limits;

/* Looks that can be applied only when the axes are known. The others are set in the panel at once. */
typedef struct looks {
    limits x, y;
    size_t files;                   /* `over FILE` clauses: */
    const parsed *all;              /* the statement that has them */
    const given_clause *over[OVER]; /* the clauses */
    shell *sh;
    bool residuals;
} looks;

/* The grammar of looks, one clause a line, and the words of AXES; NULL after the last. */
const char *look_line(size_t i);
const char *axes_name(size_t i);
/* Applies all looks of the statement to the panel or to `out`. */
bool looks_read(shell *sh, const lexer *lx, const parsed *all, plot_panel *p, looks *out);

/* The unit of an axis; scale 0: it is not known yet. */
typedef struct axis_unit {
    long double scale;
    char text[COLUMN_UNIT];
} axis_unit;

/* An axis; points on it are in SI. */
typedef struct axis_of {
    const char *name;
    dim d;
    const column *like; /* its expression, which may ask for a unit; or NULL */
    axis_unit *unit;    /* its unit, if known; else the unit chosen is stored here; or NULL */
} axis_of;

/* The column with the name of the axis, read; NULL with an error if it cannot be read or has another
 * dimension. If there is none and `alone`: the only column of the dimension, see column_of_dim; else NULL. */
const csv_values *looks_column(csv *c, const axis_of *axis, bool alone, calc_error *error);
/* Adds the measured points of all files, in SI. */
bool looks_lay_over(lexer *lx, const looks *l, plot_panel *p, const axis_of *x, const axis_of *y);
/* The ends of what is drawn along an axis, and its smallest positive value. lo > hi: nothing is drawn. */
typedef struct axis_extent {
    double lo, hi, least;
} axis_extent;
axis_extent looks_extent(const plot_panel *p, bool x_axis);

/* The unit that the column (may be NULL) asks for, or one with a prefix that fits `size`. */
axis_unit axis_unit_for(const column *c, dim d, double size);
/* Converts all points and limits from SI to the unit of the axis: the known one, the one asked for, or one
 * that suits the values. Sets the label, if none was given. */
bool looks_axis(lexer *lx, const looks *l, plot_panel *p, bool x_axis, const axis_of *axis);

#endif
