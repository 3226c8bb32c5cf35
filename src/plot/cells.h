/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A raster of terminal cells on which dots, lines, signs and texts are drawn, for plots and the full-screen
 * mode. Depends on text/characters; knows no terminal: the meaning of an ink is up to the caller. */
#ifndef PLOT_CELLS_H
#define PLOT_CELLS_H

#include <stdbool.h>
#include <stddef.h>

enum { CELL_TEXT = 12 }; /* bytes of a character with its combining ones, and a NUL */

/* A cell. New dots are added to the dots in it; all else covers what was there. */
typedef struct plot_cell {
    unsigned char dots;   /* a bit for each dot: as in U+2800 for braille, else from the top */
    unsigned char ink;    /* a number whose meaning the caller chooses */
    char sign[CELL_TEXT]; /* UTF-8, shown instead of the dots; empty: none */
} plot_cell;

/* A raster. Columns, rows and dots count from the top left. */
typedef struct plot_cells {
    int cols, rows;
    int across, up;      /* dots of a cell: 2 x 4 for braille, 1 x 2 or 1 x 1 */
    unsigned char faint; /* an ink whose dots are erased by dots of another ink in the cell; 0: none */
    int stride;
    plot_cell *cell; /* freed by the caller, but not that of a part */
} plot_cells;

bool plot_cells_make(plot_cells *c, int cols, int rows, int across, int up); /* false: out of memory */
/* A rectangle of a raster, clipped to it, that shares its cells. */
plot_cells plot_cells_part(const plot_cells *of, int column, int row, int cols, int rows);

/* Draw a dot, a sign, a text; clipped to the raster. */
void plot_cells_dot(const plot_cells *c, int x, int y, unsigned char ink);
void plot_cells_sign(const plot_cells *c, int column, int row, const char *sign, unsigned char ink);
void plot_cells_text(const plot_cells *c, int column, int row, const char *text, unsigned char ink);

/* A pen that draws a dashed line; the dash pattern continues from line to line. */
typedef struct plot_pen {
    const plot_cells *on;
    const char *dash; /* pattern of dots that are drawn, as "1110" */
    const char *sign; /* drawn instead of dots; NULL: dots */
    unsigned char ink;
    size_t walked; /* dots passed so far */
    int x, y;      /* the last dot */
} plot_pen;

plot_pen plot_pen_of(const plot_cells *on, const char *dash, unsigned char ink);
/* Draws a line between two places in dots; none if a coordinate is not finite. */
void plot_pen_line(plot_pen *p, double x0, double y0, double x1, double y1);

/* Writes what a cell shows as UTF-8, empty for nothing, and returns its ink. */
unsigned char plot_cells_show(const plot_cells *c, int column, int row, char shown[CELL_TEXT]);
/* Writes the braille character with these dots, 3 bytes and a NUL; `to` has room for CHARACTER_BYTES. */
void plot_braille(unsigned char bits, char *to);

#endif
