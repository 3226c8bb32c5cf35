/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A rectangle of cells as of a terminal, drawn on by dots, lines, signs and texts: of plots and of the
 * full-screen mode. Knows no terminal: who shows the cells tells how an ink looks. */
#ifndef PLOT_CELLS_H
#define PLOT_CELLS_H

#include <stdbool.h>
#include <stddef.h>

enum { CELL_TEXT = 12 }; /* a character, and what is put onto it */

/* What is drawn later covers what was there, but dots stay beside dots. */
typedef struct plot_cell {
    unsigned char dots;   /* bits of U+2800 in braille, else of the dots from above */
    unsigned char ink;    /* a number of the user's */
    char sign[CELL_TEXT]; /* UTF-8, in place of dots; empty: none */
} plot_cell;

/* All places are counted from the left top. */
typedef struct plot_cells {
    int cols, rows;
    int across, up;      /* dots of a cell: 2 x 4 of braille, 1 x 2, 1 x 1 */
    unsigned char faint; /* an ink whose dots give way to others in their cell; 0: none does */
    int stride;
    plot_cell *cell; /* to be freed, but not of a part */
} plot_cells;

bool plot_cells_make(plot_cells *c, int cols, int rows, int across, int up); /* false: out of memory */
/* A part of it, as far as it lies within. */
plot_cells plot_cells_part(const plot_cells *of, int column, int row, int cols, int rows);

/* What lies outside is not drawn. */
void plot_cells_dot(const plot_cells *c, int x, int y, unsigned char ink);
void plot_cells_sign(const plot_cells *c, int column, int row, const char *sign, unsigned char ink);
void plot_cells_text(const plot_cells *c, int column, int row, const char *text, unsigned char ink);

/* A pen on its way, which puts down some of the dots that it comes over. */
typedef struct plot_pen {
    const plot_cells *on;
    const char *dash; /* which ones, as "1110" */
    const char *sign; /* in place of dots; NULL: dots */
    unsigned char ink;
    size_t walked; /* dots so far */
    int x, y;      /* the last one */
} plot_pen;

plot_pen plot_pen_of(const plot_cells *on, const char *dash, unsigned char ink);
/* From and to in dots; where one is not finite, there is no line. */
void plot_pen_line(plot_pen *p, double x0, double y0, double x1, double y1);

/* What a cell shows, in UTF-8, and its ink; empty: nothing. */
unsigned char plot_cells_show(const plot_cells *c, int column, int row, char shown[CELL_TEXT]);
/* A character of braille, 3 bytes and a NUL; room for CHARACTER_BYTES. */
void plot_braille(unsigned char bits, char *to);

#endif
