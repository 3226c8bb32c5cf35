/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Cells and text on the screen of curses. */
#define _XOPEN_SOURCE 700
#define NCURSES_WIDECHAR 1
#define NCURSES_NOMACROS 1
#include "live/canvas.h"

#include <curses.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "text/characters.h"
#include "text/file.h"
#include "text/typeset.h"

bool canvas_make(plot_cells *c, rect at) {
    const bool braille = typeset_unicode();
    if (at.rows <= 0 || at.cols <= 0)
        return false;
    const bool made = plot_cells_make(c, at.cols, at.rows, braille ? 2 : 1, braille ? 4 : 2);
    if (!made)
        put_text(at, 0, INK_ERROR, "out of memory");
    return made;
}

/* How this terminal shows an ink. */
static int ink_attributes(ink of) {
    static const chtype plain[INKS] = {
        [INK_FRAME] = A_NORMAL, [INK_SLIP] = A_BOLD, [INK_POINT] = A_REVERSE, [INK_ERROR] = A_REVERSE};
    if (!has_colors() || COLOR_PAIRS <= INKS)
        return (int)plain[of];
    const chtype more = of == INK_POINT ? A_BOLD | A_REVERSE : of == INK_SLIP && COLORS < 16 ? A_BOLD : 0;
    return (int)((chtype)COLOR_PAIR((int)of) | more);
}

void canvas_show(plot_cells *c, rect at) {
    char shown[CELL_TEXT];
    for (int i = 0; i < at.rows; i++)
        for (int j = 0; j < at.cols; j++) {
            const ink of = (ink)plot_cells_show(c, j, i, shown);
            if (!*shown)
                continue;
            attrset(ink_attributes(of));
            mvaddstr(at.top + i, at.left + j, shown);
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
    attrset(ink_attributes(of));
    mvaddnstr(at.top + row, at.left, shown, (int)text_fit(shown, strlen(shown), (size_t)at.cols));
    attrset(A_NORMAL);
}

char *canvas_text(void) {
    file_text text;
    wchar_t sign[CCHARW_MAX + 1];
    char bytes[CHARACTER_BYTES];
    attr_t look;
    short pair;
    cchar_t cell;
    if (!file_text_open(&text))
        return NULL;
    for (int y = 0; y < LINES; y++) {
        int blanks = 0; /* not written yet, so that a line has none at its end */
        for (int x = 0; x < COLS; x++) {
            mvin_wch(y, x, &cell);
            getcchar(&cell, sign, &look, &pair, NULL);
            if (!sign[0] || sign[0] == L' ') {
                blanks++;
                continue;
            }
            const size_t n = character_put((unsigned)sign[0], bytes); /* UTF-8, whatever the locale is */
            fprintf(text.to, "%*s%s", blanks, "", bytes);
            blanks = 0;
            x += text_columns(bytes, n) > 1;
        }
        putc('\n', text.to);
    }
    return file_text_close(&text) ? text.text : NULL;
}
