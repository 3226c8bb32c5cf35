/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Internal to this room: limits of axes, scripts for gnuplot, and running it. Depends on cells.h, plot.h. */
#ifndef PLOT_SCRIPT_H
#define PLOT_SCRIPT_H

#include "plot/cells.h"
#include "plot/plot.h"

/* ---- axis.c: limits and tics -------------------------------------------------------------------- */

/* An axis from lo to hi, lo < hi; if logarithmic, lo > 0. */
typedef struct plot_axis {
    double lo, hi;
    bool log, flip;          /* flip: from right to left, or from the top */
    bool fixed_lo, fixed_hi; /* the user has given the limit */
} plot_axis;

/* The range of the points of a panel along one axis. */
typedef struct plot_extent {
    double lo, hi; /* lo > hi: no points */
    bool graph;    /* no room around them: curves that are functions of x, along x; a map, along y */
} plot_extent;

typedef struct plot_extents {
    plot_extent x, y;
} plot_extents;

/* Returns the ranges of a panel, and thins its series to what is drawn. */
plot_extents plot_settle(plot_panel *p);
/* The union of two ranges, as for the frames of an animation. */
plot_extents plot_extent_join(plot_extents a, plot_extents b);

/* The axes of a panel, `airy` with room around the points. False with the error: nothing to show. */
bool plot_axes(const plot_panel *p, const plot_extents *e, bool airy, plot_axis *x, plot_axis *y,
               calc_error *error);

/* The position of a value along the axis, from 0 at lo to 1 at hi. */
double plot_part(const plot_axis *a, double v);
/* The smallest step of 1, 2 or 5 times a power of ten that is not below `least`. */
double plot_step(double least);
/* Tics of a logarithmic axis over less than two decades, at 1, 2, 5 or equal steps; returns how many. */
enum { PLOT_TICS = 12 };
/* Factor of the first tic of a logarithmic axis: gnuplot loses one of 10 or 100 at the lower limit. */
#define PLOT_HAIR (1 + 1e-9)
size_t plot_log_tics(const plot_axis *a, double at[PLOT_TICS]);

/* Chooses at most `room` levels for contours of z, ascending, and returns their number. */
size_t plot_levels(const plot_map *m, double *level, size_t room);

/* The number of panels side by side, without those below others. */
size_t plot_columns(const plot_figure *f);

/* ---- script.c: pictures ------------------------------------------------------------------------- */

/* A kind of picture. */
typedef struct plot_kind {
    const char *ending; /* of the file's name */
    plot_form form;
    const char *terminal;    /* printf format for width, height, font size; NULL: the script is the picture */
    double per_pixel;        /* units of length of gnuplot's terminal per pixel */
    double font;             /* font size at the usual size of a picture, in the terminal's unit */
    double line;             /* width of a curve */
    const char *begin;       /* the wanted part of gnuplot's output begins with this; NULL: all is wanted */
    const char *head, *foot; /* texts written before and after it; NULL: none */
} plot_kind;

/* The kind of picture by the ending of the file's name; NULL with the error. */
const plot_kind *plot_kind_of(const char *file, calc_error *error);

/* Writes a text as a gnuplot string, with all special characters escaped. */
void plot_quote(FILE *to, const char *text);

/* The number of the style of series `at`: its own, or its place among those of its role. */
size_t plot_style_of(const plot_panel *p, size_t at);

/* The layer of a series, lowest first: bands, thin lines, many marks, curves, few marks, present point. */
enum { PLOT_LAYERS = 6 };
int plot_layer(const plot_series *s);

/* The frames of an animation, or one figure. */
typedef struct plot_reel {
    const plot_figure *frame;
    size_t count;
    const plot_extents *extent; /* of each panel over all frames */
    double seconds;             /* that a frame lasts */
} plot_reel;

/* Writes the script of a picture. False: nothing to show, or stopped; the caller checks for write errors. */
bool plot_write_picture(FILE *to, const plot_reel *reel, const plot_kind *kind, const plot_target *target,
                        calc_error *error);
/* Is the stop flag set? */
bool plot_stopped(const plot_target *target);

/* ---- text: page.c, dumb.c, sheet.c --------------------------------------------------------------- */

/* How panels are laid out as pages of text. */
typedef struct plot_pages {
    int columns, rows; /* of the page of a panel */
    bool beside;       /* panels side by side, else one below the other */
    bool braille;
} plot_pages;

/* Chooses the layout; one_screen: all panels must fit on the screen at once. */
plot_pages plot_pages_for(const plot_target *target, const plot_figure *f, bool one_screen);
/* Writes a script that draws the pages of all frames, not in braille. Errors as plot_write_picture. */
bool plot_write_pages(FILE *to, const plot_reel *reel, const plot_target *target, const plot_pages *pages,
                      calc_error *error);
/* Prints frame n in braille, with `end` behind each line. Returns the number of lines; 0 with the error. */
size_t plot_print_frame(const plot_reel *reel, size_t n, const plot_target *target, const plot_pages *pages,
                        const char *end, calc_error *error);

/* ---- gnuplot.c: running it ---------------------------------------------------------------------- */

/* Unnamed temporary files that are gnuplot's standard input, output and error. */
typedef struct plot_run {
    FILE *script, *out, *err;
} plot_run;

bool plot_run_open(plot_run *r, calc_error *error);
/* Runs gnuplot and rewinds its output. False with the error: its message, the time-out, or stopped. */
bool plot_run_gnuplot(const plot_run *r, const plot_target *target, calc_error *error);
void plot_run_close(plot_run *r);

#endif
