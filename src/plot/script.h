/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Between the files of this room: limits, scripts for gnuplot, and running it. */
#ifndef PLOT_SCRIPT_H
#define PLOT_SCRIPT_H

#include "plot/cells.h"
#include "plot/plot.h"

/* ---- axis.c: limits and tics -------------------------------------------------------------------- */

/* From lo to hi, lo < hi; a logarithmic axis has lo > 0. */
typedef struct plot_axis {
    double lo, hi;
    bool log, flip;
    bool fixed_lo, fixed_hi; /* by the reader */
} plot_axis;

/* What the points of a panel span. */
typedef struct plot_extent {
    double lo, hi; /* lo > hi: nothing to see */
    bool graph;    /* along x: every line goes one way only */
} plot_extent;

typedef struct plot_extents {
    plot_extent x, y;
} plot_extents;

/* Thins its series to what is drawn of them. */
plot_extents plot_settle(plot_panel *p);
/* Of both together, as for the frames of an animation. */
plot_extents plot_extent_join(plot_extents a, plot_extents b);

/* Axes, `airy` with room around the points. False with the error when nothing can be shown. */
bool plot_axes(const plot_panel *p, const plot_extents *e, bool airy, plot_axis *x, plot_axis *y,
               calc_error *error);

/* Where a value lies along the axis, from 0 at lo to 1 at hi. */
double plot_part(const plot_axis *a, double v);
/* The step 1, 2 or 5 times a power of ten next to `least` or above. */
double plot_step(double least);
/* The tics of a logarithmic axis over less than two decades: at 1, 2, 5, or a step apart where these are few.
 * How many. */
enum { PLOT_TICS = 12 };
size_t plot_log_tics(const plot_axis *a, double at[PLOT_TICS]);

/* At most `room` levels for contours of z, in rising order. */
size_t plot_levels(const plot_map *m, double *level, size_t room);

/* Panels beside each other, those below others left out. */
size_t plot_columns(const plot_figure *f);

/* ---- script.c: pictures ------------------------------------------------------------------------- */

/* A kind of picture. */
typedef struct plot_kind {
    const char *ending;
    plot_form form;
    const char *terminal;    /* for printf: width, height, font size; NULL: the script itself */
    double per_pixel;        /* of the terminal's unit of length */
    double font;             /* at the usual size, in its own unit */
    double line;             /* width of a curve */
    const char *begin;       /* of what is wanted of gnuplot's output; NULL: all is */
    const char *head, *foot; /* around it; NULL: nothing */
} plot_kind;

/* The kind by a file's ending; NULL with the error. */
const plot_kind *plot_kind_of(const char *file, calc_error *error);

/* The text as a string of gnuplot in which nothing but its characters is left. */
void plot_quote(FILE *to, const char *text);

/* The style of a series: its own, or its place among those of its role. */
size_t plot_style_of(const plot_panel *p, size_t at);

/* From the lowest: bands, thin lines, crowds, curves, measured points, the present one. */
enum { PLOT_LAYERS = 6 };
int plot_layer(const plot_series *s);

/* Frames that share axes. */
typedef struct plot_reel {
    const plot_figure *frame;
    size_t count;
    const plot_extents *extent; /* of a panel over all frames */
    double seconds;             /* a frame */
} plot_reel;

/* The whole script for a picture. False with the error when there is nothing to show, or it is stopped.
 * Writing is checked by the caller. */
bool plot_write_picture(FILE *to, const plot_reel *reel, const plot_kind *kind, const plot_target *target,
                        calc_error *error);
bool plot_stopped(const plot_target *target);

/* ---- text: page.c, dumb.c, sheet.c --------------------------------------------------------------- */

/* Panels on pages of text. */
typedef struct plot_pages {
    int columns, rows; /* of a panel */
    bool beside;       /* panels side by side, else one below the other */
    bool braille;
} plot_pages;

plot_pages plot_pages_for(const plot_target *target, const plot_figure *f, bool one_screen);
/* A page of gnuplot for each panel of each frame; not of braille. */
bool plot_write_pages(FILE *to, const plot_reel *reel, const plot_target *target, const plot_pages *pages,
                      calc_error *error);
/* Draws frame n and prints it, each line with the end given: of braille. The number of lines; 0 with the
 * error. */
size_t plot_print_frame(const plot_reel *reel, size_t n, const plot_target *target, const plot_pages *pages,
                        const char *end, calc_error *error);

/* ---- gnuplot.c: running it ---------------------------------------------------------------------- */

/* Files of our own for a run: gnuplot reads `script`, and leaves its output and its words in the others. */
typedef struct plot_run {
    FILE *script, *out, *err;
} plot_run;

bool plot_run_open(plot_run *r, calc_error *error);
/* Runs gnuplot on the script; its output is then read from the beginning. */
bool plot_run_gnuplot(const plot_run *r, const plot_target *target, calc_error *error);
void plot_run_close(plot_run *r);

#endif
