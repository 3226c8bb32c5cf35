/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Texts in memory, written as files are. */
#define _GNU_SOURCE /* fopencookie */
#include "text/file.h"

#include <stdlib.h>
#include <string.h>

/* Room for n more bytes and the NUL. */
static bool grow_text(file_text *t, size_t n) {
    size_t room = t->room;
    while (room - t->size <= n)
        room *= 2;
    char *grown = room > t->room ? realloc(t->text, room) : t->text;
    if (!grown)
        return false;
    t->text = grown;
    t->room = room;
    return true;
}

static bool take_bytes(file_text *t, const char *bytes, size_t n) {
    t->lost = t->lost || !grow_text(t, n);
    if (t->lost)
        return false;
    memcpy(t->text + t->size, bytes, n);
    t->size += n;
    return true;
}

#if defined(__APPLE__)
static int write_text(void *cookie, const char *bytes, int n) {
    return take_bytes(cookie, bytes, (size_t)n) ? n : -1;
}

static FILE *stream(file_text *t) {
    return funopen(t, NULL, write_text, NULL, NULL);
}
#else
static ssize_t write_text(void *cookie, const char *bytes, size_t n) {
    return take_bytes(cookie, bytes, n) ? (ssize_t)n : 0;
}

static FILE *stream(file_text *t) {
    return fopencookie(t, "w", (cookie_io_functions_t){.write = write_text});
}
#endif

bool file_text_open(file_text *t) {
    enum { ROOM = 256 };
    *t = (file_text){.text = malloc(ROOM), .room = ROOM};
    if (t->text)
        t->to = stream(t);
    if (!t->to)
        free(t->text);
    return t->to != NULL;
}

bool file_text_close(file_text *t) {
    const bool ok = fclose(t->to) == 0 && !t->lost;
    t->to = NULL;
    if (ok)
        t->text[t->size] = 0;
    else
        free(t->text);
    return ok;
}
