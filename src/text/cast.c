/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Writes a cast: one event, one line, one write. Knows no session. */
#include "text/cast.h"

#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include "text/characters.h"
#include "text/clock.h"

enum {
    COLS = 80,
    ROWS = 30, /* of a script's screen: a plot with its statement above */
    PIECE = 4096,
    ESCAPED = 6, /* most bytes of JSON that one becomes */
    UTF8 = 4
};

/* Of a script, in seconds: a character typed, before the answer, to read what has been written, and a line of
 * it. */
static const double TYPING = 0.04, ANSWERING = 0.25, READING = 0.6, READING_LINE = 0.3, LONGEST = 3;

struct cast {
    file_log *log;
    bool clock;
    double began, at;
    int cols, rows;
    size_t lines; /* written since something was typed */
    char last;    /* byte written */
    char held[UTF8];
    size_t held_count; /* of a character that is not whole yet */
    char event[PIECE * ESCAPED + 64];
};

/* ---- events ------------------------------------------------------------------------------------ */

static bool add_event(cast *c, size_t n, calc_error *error) {
    return file_log_add(c->log, c->event, n, error);
}

/* In a string of JSON. */
static char *escape(char *to, const char *text, size_t n) {
    for (size_t i = 0; i < n;) {
        unsigned code;
        const size_t bytes = character_at(text + i, n - i, &code);
        if (!bytes)
            to += sprintf(to, "\\ufffd");
        else if (code == '\n' || code == '\r')
            to += sprintf(to, "\\%c", code == '\n' ? 'n' : 'r');
        else if (code < ' ' || code == 0x7f)
            to += sprintf(to, "\\u%04x", code);
        else if (code == '"' || code == '\\')
            to += sprintf(to, "\\%c", (char)code);
        else
            to = (char *)memcpy(to, text + i, bytes) + bytes;
        i += bytes ? bytes : 1;
    }
    return to;
}

static bool event(cast *c, char kind, const char *text, size_t n, calc_error *error) {
    if (c->clock)
        c->at = clock_wall() - c->began;
    char *to = c->event + sprintf(c->event, "[%.6f,\"%c\",\"", c->at, kind);
    to = escape(to, text, n);
    memcpy(to, "\"]\n", 3);
    return add_event(c, (size_t)(to + 3 - c->event), error);
}

static bool find_size(cast *c) {
    struct winsize now;
    const int cols = c->cols, rows = c->rows;
    if (c->clock && !ioctl(STDOUT_FILENO, TIOCGWINSZ, &now) && now.ws_col > 0 && now.ws_row > 0) {
        c->cols = now.ws_col;
        c->rows = now.ws_row;
    }
    return cols != c->cols || rows != c->rows;
}

/* ---- what comes -------------------------------------------------------------------------------- */

/* Bytes at the end that begin a character of UTF-8 and do not end it. */
static size_t begun(const char *text, size_t n) {
    const size_t at = character_before(text, n), left = n - at;
    return left < UTF8 && !character_at(text + at, left, NULL) ? left : 0;
}

/* At most PIECE/2 bytes: ends of lines grow. */
static bool write_piece(cast *c, const char *bytes, size_t n, calc_error *error) {
    char text[PIECE];
    size_t have = c->held_count;
    memcpy(text, c->held, have);
    for (size_t i = 0; i < n; i++) {
        if (bytes[i] == '\n' && c->last != '\r')
            text[have++] = '\r';
        c->lines += bytes[i] == '\n';
        c->last = text[have++] = bytes[i];
    }
    c->held_count = begun(text, have);
    have -= c->held_count;
    memcpy(c->held, text + have, c->held_count);
    return have == 0 || event(c, 'o', text, have, error);
}

bool cast_write(cast *c, const char *bytes, size_t n, calc_error *error) {
    char now[32];
    bool ok = true;
    if (find_size(c))
        ok = event(c, 'r', now, (size_t)snprintf(now, sizeof now, "%dx%d", c->cols, c->rows), error);
    enum { MOST = PIECE / 2 - UTF8 };
    for (size_t i = 0, part; ok && i < n; i += part) {
        part = n - i < MOST ? n - i : MOST;
        ok = write_piece(c, bytes + i, part, error);
    }
    return ok;
}

void cast_wait(cast *c, double s) {
    if (!c->clock)
        c->at += s;
}

bool cast_type(cast *c, const char *prompt, const char *text, size_t n, calc_error *error) {
    const double reading = READING + READING_LINE * (double)c->lines;
    bool ok = cast_write(c, prompt, strlen(prompt), error);
    cast_wait(c, reading < LONGEST ? reading : LONGEST);
    for (size_t i = 0; ok && i < n;) {
        char shown[CHARACTER_SHOWN];
        i += character_shown(text + i, n - i, shown);
        ok = cast_write(c, shown, strlen(shown), error);
        cast_wait(c, TYPING);
    }
    cast_wait(c, ANSWERING);
    ok = ok && cast_write(c, "\n", 1, error);
    c->lines = 0;
    return ok;
}

void cast_size(const cast *c, int *cols, int *rows) {
    *cols = c->cols;
    *rows = c->rows;
}

bool cast_has_clock(const cast *c) {
    return c->clock;
}

/* ---- beginning and end ------------------------------------------------------------------------- */

cast *cast_begin(file_log *log, bool clock, calc_error *error) {
    cast *c = malloc(sizeof *c);
    if (!c) {
        calc_no_memory(error);
        return NULL;
    }
    *c = (cast){.log = log, .clock = clock, .cols = COLS, .rows = ROWS};
    if (clock)
        c->began = clock_wall();
    find_size(c);
    if (add_event(c,
                  (size_t)sprintf(c->event, "{\"version\":2,\"width\":%d,\"height\":%d}\n", c->cols, c->rows),
                  error))
        return c;
    free(c);
    return NULL;
}

bool cast_end(cast *c, bool whole, calc_error *error) {
    bool ok = true;
    if (whole && !c->clock) { /* the last answer is read, too */
        const double reading = READING + READING_LINE * (double)c->lines;
        ok = event(c, 'o', "fret> ", 6, error);
        cast_wait(c, reading < LONGEST ? reading : LONGEST);
        ok = ok && event(c, 'o', "\r\n", 2, error);
    }
    free(c);
    return ok;
}
