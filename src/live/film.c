/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reads the screen of curses and writes what is another than before. */
#define _XOPEN_SOURCE 700
#define NCURSES_WIDECHAR 1
#define NCURSES_NOMACROS 1
#include "live/film.h"

#include <curses.h>
#include <stdio.h>
#include <stdlib.h>
#include <wchar.h>

#include "text/characters.h"
#include "text/file.h"

typedef struct film_cell {
    wchar_t sign;
    bool bold, reverse;
    short color; /* -1: the terminal's own */
} film_cell;

static const film_cell blank = {L' ', false, false, -1};

static film_cell screen_cell(const cchar_t *from) {
    wchar_t signs[CCHARW_MAX + 1] = {0};
    attr_t attributes = A_NORMAL;
    short pair = 0, back;
    film_cell c = blank;
    getcchar(from, signs, &attributes, &pair, NULL);
    if (!signs[0])
        return c;
    c.sign = signs[0];
    c.bold = (attributes & A_BOLD) != 0;
    c.reverse = (attributes & A_REVERSE) != 0;
    if (pair)
        pair_content(pair, &c.color, &back);
    return c;
}

static bool same_look(const film_cell *a, const film_cell *b) {
    return a->bold == b->bold && a->reverse == b->reverse && a->color == b->color;
}

static void put_look(FILE *to, const film_cell *c) {
    fprintf(to, "\033[0%s%s", c->bold ? ";1" : "", c->reverse ? ";7" : "");
    if (c->color >= 8)
        fprintf(to, ";38;5;%d", c->color);
    else if (c->color >= 0)
        fprintf(to, ";3%d", c->color);
    putc('m', to);
}

/* A row: runs of cells that have changed. */
static void put_screen_row(FILE *to, int y, film_cell *before, int cols, const cchar_t *now) {
    film_cell look = blank;
    char sign[CHARACTER_BYTES];
    int at = -1; /* where the next sign goes */
    for (int x = 0; x < cols; x++) {
        const film_cell c = screen_cell(&now[x]);
        if (c.sign == before[x].sign && same_look(&c, &before[x]))
            continue;
        if (at != x)
            fprintf(to, "\033[%d;%dH", y + 1, x + 1);
        if (!same_look(&c, &look))
            put_look(to, &c);
        character_put((unsigned)c.sign, sign); /* UTF-8, whatever the locale is */
        fputs(sign, to);
        before[x] = look = c;
        at = x + 1;
    }
    if (!same_look(&look, &blank))
        put_look(to, &blank);
}

static void forget(film *f) {
    free(f->cell);
    free(f->row);
    *f = (film){.cell = NULL};
}

/* An empty screen of this size. False: out of memory. */
static bool begin_film(film *f, FILE *to) {
    const bool first = !f->cell;
    const size_t n = (size_t)LINES * (size_t)COLS;
    film now = {malloc(n * sizeof *now.cell), malloc(((size_t)COLS + 1) * sizeof(cchar_t)), LINES, COLS};
    if (!now.cell || !now.row) {
        forget(&now);
        return false;
    }
    forget(f);
    *f = now;
    for (size_t i = 0; i < n; i++)
        f->cell[i] = blank;
    fputs(first ? "\033[?1049h\033[?25l\033[H\033[2J" : "\033[H\033[2J", to);
    return true;
}

static void put_screen(film *f, FILE *to, bool cursor) {
    int y, x;
    getyx(stdscr, y, x);
    for (int i = 0; i < f->rows; i++) {
        mvin_wchnstr(i, 0, f->row, f->cols);
        put_screen_row(to, i, f->cell + (size_t)i * (size_t)f->cols, f->cols, f->row);
    }
    move(y, x);
    if (cursor)
        fprintf(to, "\033[%d;%dH", y + 1, x + 1);
    fputs(cursor ? "\033[?25h" : "\033[?25l", to);
}

bool film_frame(film *f, const live_host *host, bool cursor, double seconds) {
    int cols, rows;
    file_text now;
    if (!host->filming(host->self, &cols, &rows)) {
        forget(f);
        return true;
    }
    if (!file_text_open(&now))
        return false;
    const bool ok = (f->cell && f->rows == LINES && f->cols == COLS) || begin_film(f, now.to);
    if (ok)
        put_screen(f, now.to, cursor);
    if (!file_text_close(&now)) { /* forgotten cells are sent again with the next frame */
        forget(f);
        return false;
    }
    if (ok)
        host->film(host->self, now.text, now.size, seconds);
    free(now.text);
    return ok;
}

void film_end(film *f, const live_host *host) {
    static const char back[] = "\033[0m\033[?1049l\033[?25h";
    int cols, rows;
    if (f->cell && host->filming(host->self, &cols, &rows))
        host->film(host->self, back, sizeof back - 1, 0);
    forget(f);
}
