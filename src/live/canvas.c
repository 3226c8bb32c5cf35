/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Dots, lines and text on the screen of curses. */
#define _XOPEN_SOURCE 700
#define NCURSES_WIDECHAR 1
#define NCURSES_NOMACROS 1
#include "live/canvas.h"

#include <curses.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <wchar.h>

#include "calc/characters.h"

typedef struct canvas_cell {
    unsigned char dots, ink;
    char sign;
} canvas_cell;

bool canvas_make(canvas *c, rect at, bool braille) {
    *c = (canvas){at, at.cols * (braille ? 2 : 1), at.rows * (braille ? 4 : 2), braille, NULL};
    if (at.rows <= 0)
        return false;
    c->cell = calloc((size_t)at.rows * (size_t)at.cols + 1, sizeof *c->cell);
    if (!c->cell)
        put_text(at, 0, INK_ERROR, "out of memory");
    return c->cell != NULL;
}

/* What lies outside goes to a cell behind the last, which is not shown. */
static canvas_cell *cell_of(const canvas *c, int x, int y) {
    if (x < 0 || y < 0 || x >= c->wide || y >= c->high)
        return &c->cell[c->at.rows * c->at.cols];
    return &c->cell[y / (c->braille ? 4 : 2) * c->at.cols + x / (c->braille ? 2 : 1)];
}

void canvas_dot(canvas *c, int x, int y, ink of) {
    static const unsigned char bits[4][2] = {{0x01, 0x08}, {0x02, 0x10}, {0x04, 0x20}, {0x40, 0x80}};
    canvas_cell *at = cell_of(c, x, y);
    at->dots = (unsigned char)(at->dots | (c->braille ? bits[y & 3][x & 1] : 1 << (y & 1)));
    if (of > at->ink)
        at->ink = (unsigned char)of;
}

void canvas_line(canvas *c, double x0, double y0, double x1, double y1, ink of, int every) {
    const double longest = fmax(fabs(x1 - x0), fabs(y1 - y0)), most = 8.0 * (c->wide + c->high);
    if (!isfinite(longest) || longest > most) /* unreached: scales hold what is drawn */
        return;
    const int n = (int)ceil(longest);
    for (int i = 0; i <= n; i += every) {
        const double part = n ? (double)i / n : 0;
        canvas_dot(c, (int)lround(x0 + (x1 - x0) * part), (int)lround(y0 + (y1 - y0) * part), of);
    }
}

void canvas_sign(canvas *c, int x, int y, char sign, ink of) {
    canvas_cell *at = cell_of(c, x, y);
    at->sign = sign;
    at->ink = (unsigned char)of;
}

/* Of an ink on this terminal. */
static int ink_attributes(ink of) {
    static const chtype plain[INKS] = {
        [INK_FRAME] = A_NORMAL, [INK_SLIP] = A_BOLD, [INK_POINT] = A_REVERSE, [INK_ERROR] = A_REVERSE};
    if (!has_colors() || COLOR_PAIRS <= INKS)
        return (int)plain[of];
    const chtype more = of == INK_POINT ? A_BOLD | A_REVERSE : of == INK_SLIP && COLORS < 16 ? A_BOLD : 0;
    return (int)((chtype)COLOR_PAIR((int)of) | more);
}

void canvas_show(canvas *c) {
    for (int i = 0; i < c->at.rows; i++)
        for (int j = 0; j < c->at.cols; j++) {
            const canvas_cell *at = &c->cell[i * c->at.cols + j];
            if (!at->sign && !at->dots)
                continue;
            attrset(ink_attributes((ink)at->ink));
            if (at->sign || !c->braille) {
                mvaddch(c->at.top + i, c->at.left + j,
                        (chtype)(unsigned char)(at->sign ? at->sign : " '.:"[at->dots]));
            } else {
                const wchar_t text[] = {(wchar_t)(0x2800 + at->dots), 0};
                mvaddwstr(c->at.top + i, c->at.left + j, text);
            }
        }
    attrset(A_NORMAL);
    free(c->cell);
}

void put_text(rect at, int row, ink of, const char *format, ...) {
    enum { ROOM = 2048 };
    char text[ROOM], shown[ROOM];
    va_list args;
    va_start(args, format);
    vsnprintf(text, sizeof text, format, args);
    va_end(args);
    if (row >= at.rows || at.cols <= 0)
        return;
    characters_shown(text, shown, sizeof shown);
    wchar_t wide[ROOM];
    const size_t n = mbstowcs(wide, shown, ROOM - 1);
    attrset(ink_attributes(of));
    move(at.top + row, at.left);
    if (n == (size_t)-1)
        addnstr(shown, at.cols);
    else
        addnwstr(wide, at.cols < (int)n ? at.cols : (int)n);
    attrset(A_NORMAL);
}
