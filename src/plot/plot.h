/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Figures: numbers, texts and looks in; a picture in a file or text in the terminal out. gnuplot draws them,
 * but for dots in a terminal.
 * Nothing here knows a scene or a quantity.
 *
 *     plot_figure f;
 *     plot_figure_init(&f);
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
    PLOT_KEPT = 300000,  /* points a series holds; beyond, it thins itself and keeps the extremes */
    PLOT_WRITTEN = 1000, /* points of a curve that go into a picture, about */
    PLOT_MARKS = 8000,   /* and of marks, which no line joins: few of many would stand in clumps */
    PLOT_GRID = 500,     /* points of a map along an axis */
    PLOT_WORDS = 4,      /* within the frame of a panel */
    PLOT_FRAMES = 1000,  /* of an animation */
    PLOT_PIXELS = 8000   /* of a picture along an axis */
};

/* ---- texts -------------------------------------------------------------------------------------- */

/* Texts are UTF-8 and reach the reader as they are: no character means anything to gnuplot or TeX. What
 * stands between PLOT_EXPR or PLOT_UNIT and PLOT_END is an expression of the language or a unit, and is
 * typeset: Fx/(mu*FN) with subscripts and Greek letters, um with its micro sign. */
#define PLOT_EXPR "\001"
#define PLOT_UNIT "\002"
#define PLOT_END "\003"

/* `expression [unit]`, typeset; without a unit (NULL or "") the expression alone. "k = 0.5", "mu = 0.3, k =
 * 0" and "FN = 20 N" are expressions, too. To be freed; NULL: out of memory. */
char *plot_label(const char *expression, const char *unit);

/* Forms of a text. */
typedef enum plot_form {
    PLOT_ASCII,    /* as typed */
    PLOT_UNICODE,  /* Fx/(μ FN), µm */
    PLOT_ENHANCED, /* gnuplot's own markup; what is not ours is escaped */
    PLOT_TEX
} plot_form;

/* The text in a form; control characters and bytes that are no UTF-8 become `?`. To be freed; NULL: out of
 * memory. */
char *plot_text(const char *text, plot_form form);

/* ---- figures ------------------------------------------------------------------------------------ */

typedef enum plot_role {
    PLOT_CURVE,    /* a line through the points; a point that is not finite is a gap */
    PLOT_MEASURED, /* marks without a line */
    PLOT_BAND,     /* the area between y and y2; without y2 the one inside, of pictures alone */
    PLOT_NOW       /* the present point, above all */
} plot_role;

typedef struct plot_series {
    plot_role role;
    int style;          /* of the series that look alike, from 0; -1: by its place among the curves */
    bool thin;          /* a helping line: half as wide, not in the cycle of styles, grey */
    char *title;        /* in the key; NULL: not there */
    double *x, *y, *y2; /* y2 of bands only */
    size_t count, room;
    size_t came, thinned; /* points in all; the first of those held, which stand for others too */
} plot_series;

/* z over a grid, as contours with their values. */
typedef struct plot_map {
    size_t nx, ny;
    double *x, *y, *z; /* z[j*nx + i] at x[i], y[j]; not finite: no value there */
    char *label;       /* of z */
} plot_map;

/* Within the frame: its middle in parts of it, from the lower left. */
typedef struct plot_word {
    const char *text;
    double at[2];
} plot_word;

typedef struct plot_panel {
    char *title, *xlabel, *ylabel; /* owned; NULL: none */
    double xlo, xhi, ylo, yhi;     /* limits; NaN: from the points */
    bool logx, logy, flipx, flipy;
    bool key_off;
    bool points; /* marked on the lines */
    bool airy;   /* room around the points along x, too; else curves that are graphs over x fill its axis */
    bool below;  /* the panel before it, and lower than that; else beside it */
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

void plot_figure_init(plot_figure *f);
void plot_figure_free(plot_figure *f);

/* NULL with the error: too many, or out of memory. */
plot_panel *plot_panel_add(plot_figure *f, calc_error *error);
/* Copies the title, which may be NULL. */
plot_series *plot_series_add(plot_panel *p, plot_role role, const char *title, calc_error *error);
/* Gives a panel its grid, z without values. */
bool plot_map_make(plot_panel *p, size_t nx, size_t ny, calc_error *error);

/* False: out of memory. */
bool plot_point(plot_series *s, double x, double y);
bool plot_band(plot_series *s, double x, double y, double y2);

/* ---- where it goes ------------------------------------------------------------------------------ */

/* page: SVG, to stand within HTML. */
typedef enum plot_terminal { PLOT_AUTO, PLOT_DUMB, PLOT_BLOCK, PLOT_SIXEL, PLOT_PAGE } plot_terminal;

typedef struct plot_target {
    const char *caption;    /* lines below a picture, as typed; NULL: none */
    const char *file;       /* .png .svg .pdf .tex .html .gif .gp; NULL: text to `out` */
    FILE *out;              /* of text */
    plot_terminal terminal; /* of text; auto: dumb */
    bool color, unicode;    /* what the terminal can show */
    bool moving;            /* `out` is a terminal whose cursor can go back up: frames in place */
    int columns, rows;      /* of the terminal; 0: 79 x 24 */
    int width, height;      /* of a picture in pixels; 0: 900 a panel (640 with several) x 675 */
    double text;            /* texts and lines of a picture, times this; 0: 1 */
    double timeout;         /* seconds for gnuplot; 0: 30 */
    file_stop stop;         /* NULL: nothing stops it */
} plot_target;

/* Can a picture go to the file? To be asked before long work; the error names what stands against it. */
bool plot_check(const char *file, file_stop stop, calc_error *error);

/* Draws a figure, or `frames` of them that have the same panels: to a .gif file, or in the terminal (where
 * not `moving` the last one alone), on axes that hold for all. Series are thinned to what is drawn of them.
 * On failure the error, and no file left behind. The report may be NULL; it is of files only. */
bool plot_draw(plot_figure *frame, size_t frames, const plot_target *target, file_report *report,
               calc_error *error);

/* ---- numbers, for tests ------------------------------------------------------------------------- */

/* Thins to about `goal` points: of each stretch the first, the last, both extremes of each coordinate, and a
 * gap. */
void plot_thin(plot_series *s, size_t goal);

#endif
