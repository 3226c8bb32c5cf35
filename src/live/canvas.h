/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Cells on the screen of curses: 2 x 4 dots each in braille, 1 x 2 in plain characters. */
#ifndef LIVE_CANVAS_H
#define LIVE_CANVAS_H

#include "plot/cells.h"
#include "text/words.h"

/* What is drawn. */
typedef enum ink {
    INK_NONE,
    INK_FRAME,  /* axes, titles */
    INK_BOUND,  /* what friction allows */
    INK_MEMORY, /* slipped earlier */
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

/* Cells for the rectangle. False: out of memory, or no room; nothing is to be freed then. */
bool canvas_make(plot_cells *c, rect at);
/* Puts them on the screen and frees them. */
void canvas_show(plot_cells *c, rect at);

/* Text in the rectangle's row, cut to its width; what does not show is written as \x1b. */
LIKE_PRINTF(4, 5)
void put_text(rect at, int row, ink of, const char *format, ...);

/* What the screen shows, to be freed; NULL: out of memory. */
char *canvas_text(void);

#endif
