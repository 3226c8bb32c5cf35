/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Figures: from numbers and texts to a picture in a file or text in the terminal. gnuplot draws them, except
 * for braille dots in a terminal. Depends on text; knows no scene and no quantity.
 *
 *     plot_figure f = {.count = 0};
 *     plot_panel *p = plot_panel_add(&f, error);
 *     p->xlabel = plot_label("dx", "um"), p->ylabel = plot_label("Fx/(mu*FN)", NULL);
 *     plot_series *s = plot_series_add(p, PLOT_CURVE, PLOT_EXPR "k = 0.5" PLOT_END, error);
 *     plot_point(s, x, y);  ...
 *     plot_draw(&f, 1, &(plot_target){.file = "loop.png"}, &report, error);
 *     plot_figure_free(&f);
 */
#ifndef PLOT_PLOT_H
#define PLOT_PLOT_H

#include "text/file.h"

enum {
    PLOT_PANELS = 6,     /* side by side */
    PLOT_CURVES = 64,    /* series of a panel */
    PLOT_KEPT = 300000,  /* points a series holds; with more it thins itself and keeps the extremes */
    PLOT_WRITTEN = 1000, /* points of a curve written to a picture, about */
    PLOT_MARKS = 8000,   /* marks written; more, since no line joins them and thinned marks form clumps */
    PLOT_GRID = 500,     /* points of a map along an axis */
    PLOT_WORDS = 4,      /* annotations within the frame of a panel */
    PLOT_FRAMES = 1000,  /* frames of an animation */
    PLOT_PIXELS = 8000   /* pixels of a picture along an axis */
};

/* ---- texts -------------------------------------------------------------------------------------- */

/* Texts are UTF-8 and are shown as they are: characters special to gnuplot or TeX are escaped. The text
 * between PLOT_EXPR or PLOT_UNIT and PLOT_END is an expression of the language or a unit, and is typeset:
 * Fx/(mu*FN) with subscripts and Greek letters, um with its micro sign. */
#define PLOT_EXPR "\001"
#define PLOT_UNIT "\002"
#define PLOT_END "\003"

/* The text `expression [unit]` with these marks, or the expression alone if unit is NULL or "". "k = 0.5",
 * "mu = 0.3, k = 0" and "FN = 20 N" are expressions too. The caller frees it; NULL: out of memory. */
char *plot_label(const char *expression, const char *unit);

/* Forms of a text. */
typedef enum plot_form {
    PLOT_ASCII,    /* as typed */
    PLOT_UNICODE,  /* Fx/(μ FN), µm */
    PLOT_ENHANCED, /* with gnuplot's enhanced-text markup */
    PLOT_TEX
} plot_form;

/* Converts a text; control characters and invalid UTF-8 become `?`. The caller frees it; NULL: no memory. */
char *plot_text(const char *text, plot_form form);

/* ---- figures ------------------------------------------------------------------------------------ */

typedef enum plot_role {
    PLOT_CURVE,    /* a line through the points; a point that is not finite is a gap */
    PLOT_MEASURED, /* marks without a line */
    PLOT_BAND, /* the area between y and y2; without y2 the area inside a closed curve, in pictures only */
    PLOT_NOW   /* the present point, drawn above all others */
} plot_role;

typedef struct plot_series {
    plot_role role;
    int style;          /* number of the style, from 0; -1: the place of the series among those of its role */
    bool thin;          /* a helping line: half as wide and grey, without a style */
    char *title;        /* text in the key; NULL: no entry */
    double *x, *y, *y2; /* y2: of bands only */
    size_t count, room; /* points held; allocated */
    size_t came, thinned; /* points added in all; the first `thinned` points held are left from thinning */
} plot_series;

/* z over a grid, drawn as contours with their values. */
typedef struct plot_map {
    size_t nx, ny;
    double *x, *y, *z; /* z[j*nx + i] is the value at x[i], y[j]; not finite: no value */
    char *label;       /* of z */
} plot_map;

/* An annotation within the frame; `at` is its centre as parts 0..1 of the frame, from the lower left. */
typedef struct plot_word {
    const char *text;
    double at[2];
} plot_word;

typedef struct plot_panel {
    char *title, *xlabel, *ylabel; /* owned; NULL: none */
    double xlo, xhi, ylo, yhi;     /* limits; NaN: from the points */
    bool logx, logy, flipx, flipy;
    bool key_off;
    bool points; /* mark the points on the lines */
    bool airy;  /* leave room around the points along x too; else curves that are functions of x fill its axis
                 */
    bool below; /* it lies below the panel before it, and is less high; else beside it */
    plot_map map;
    plot_word word[PLOT_WORDS];
    size_t words;
    size_t count;
    plot_series *series[PLOT_CURVES];
} plot_panel;

typedef struct plot_figure {
    size_t count;
    plot_panel *panel[PLOT_PANELS];
} plot_figure;

void plot_figure_free(plot_figure *f);

/* Adds a panel; NULL with the error: too many, or out of memory. */
plot_panel *plot_panel_add(plot_figure *f, calc_error *error);
/* Adds a series, likewise, with a copy of the title, which may be NULL. */
plot_series *plot_series_add(plot_panel *p, plot_role role, const char *title, calc_error *error);
/* Gives a panel a map with all z missing; false with the error. */
bool plot_map_make(plot_panel *p, size_t nx, size_t ny, calc_error *error);

/* Add a point to a series, or to a band. False: out of memory. */
bool plot_point(plot_series *s, double x, double y);
bool plot_band(plot_series *s, double x, double y, double y2);

/* ---- the target --------------------------------------------------------------------------------- */

/* PLOT_SVG_INLINE: SVG to be embedded in an HTML page. */
typedef enum plot_terminal { PLOT_AUTO, PLOT_DUMB, PLOT_BLOCK, PLOT_SIXEL, PLOT_SVG_INLINE } plot_terminal;

typedef struct plot_target {
    const char *caption;    /* lines below a picture, as typed, each with a newline; NULL: none */
    const char *file;       /* .png .svg .pdf .tex .html .gif .gp; NULL: output goes to `out` */
    FILE *out;              /* the terminal */
    plot_terminal terminal; /* the kind of output to `out`; PLOT_AUTO: PLOT_DUMB */
    bool color, unicode;    /* what the terminal can show */
    int moving;             /* frames replace each other in so many rows of `out`; 0: it is no terminal */
    int columns, rows;      /* size of the terminal; 0: 79 x 24 */
    int width, height;      /* size of a picture in pixels; 0: 900 (640 for each of several panels) x 675 */
    double text;            /* factor for texts and lines of a picture; 0: 1 */
    double timeout;         /* seconds for gnuplot; 0: 30 */
    file_stop stop;         /* the stop flag, or NULL */
} plot_target;

/* Can a picture be written to the file? False with the error. To be asked before long work. */
bool plot_check(const char *file, file_stop stop, calc_error *error);

/* Draws a figure, or `frames` figures with the same panels on common axes: to a .gif file, or in the
 * terminal, where only the last one is shown unless they fit in `moving` rows. Thins the series. On failure
 * returns false with the error and leaves no file behind. The report, which may be NULL, is filled in for
 * files only. */
bool plot_draw(plot_figure *frame, size_t frames, const plot_target *target, file_report *report,
               calc_error *error);

/* ---- numbers, for tests ------------------------------------------------------------------------- */

/* Thins to about `goal` points: of each stretch both ends, the extremes of each coordinate, and a gap. */
void plot_thin(plot_series *s, size_t goal);

#endif
