/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Text and cells on the curses screen: a cell has 2 x 4 dots in braille, 1 x 2 in plain characters. */
#ifndef LIVE_CANVAS_H
#define LIVE_CANVAS_H

#include "plot/cells.h"
#include "text/words.h"

/* What is drawn, and so its colour. */
typedef enum ink {
    INK_NONE,
    INK_FRAME,  /* axes, titles */
    INK_BOUND,  /* the friction bound */
    INK_MEMORY, /* stick zone that has slipped before */
    INK_STICK,
    INK_SLIP,
    INK_CURVE,
    INK_OTHER, /* a second curve */
    INK_POINT,
    INK_ERROR,
    INKS
} ink;

typedef struct rect {
    int top, left, rows, cols;
} rect;

/* Makes cells for the rectangle. False if out of memory or the rectangle is empty: nothing to free then. */
bool canvas_make(plot_cells *c, rect at);
/* Puts the cells on the screen and frees them. */
void canvas_show(plot_cells *c, rect at);

/* Writes text into a row of the rectangle, cut to its width; control characters appear as \x1b. */
LIKE_PRINTF(4, 5)
void put_text(rect at, int row, ink of, const char *format, ...);

/* The text on the screen, to be freed; NULL: out of memory. */
char *canvas_text(void);

#endif
