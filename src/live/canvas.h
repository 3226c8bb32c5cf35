/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Cells on the screen of curses: 2 x 4 dots each in braille, 1 x 2 in plain characters. */
#ifndef LIVE_CANVAS_H
#define LIVE_CANVAS_H

#include "plot/cells.h"

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

typedef struct canvas {
    rect at;
    int wide, high; /* dots */
    bool braille;
    plot_cells cells;
} canvas;

/* False: out of memory, or no room; nothing is to be freed then. */
bool canvas_make(canvas *c, rect at, bool braille);
/* A character in the cell of a dot. */
void canvas_sign(const canvas *c, int x, int y, char sign, ink of);
/* Puts it on the screen and frees it. */
void canvas_show(canvas *c);

/* Text in the rectangle's row, cut to its width; what does not show is written as \x1b. */
#if defined(__GNUC__)
__attribute__((format(printf, 4, 5)))
#endif
void put_text(rect at, int row, ink of, const char *format, ...);

/* What the screen shows, to be freed; NULL: out of memory. */
char *canvas_text(void);

#endif
