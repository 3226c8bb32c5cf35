/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Streams that pass their bytes to a function, and texts in memory written through them. Depends on libc. */
#define _GNU_SOURCE /* fopencookie, which musl has too */
#include "text/file.h"

#include <stdlib.h>
#include <string.h>

#include "number/array.h"

#ifdef __APPLE__
/* An adapter to funopen, whose write function counts in int; freed when the stream is closed. */
typedef struct taker {
    void *self;
    file_take *take;
} taker;

static int write_taker(void *cookie, const char *bytes, int n) {
    const taker *t = cookie;
    return (int)t->take(t->self, bytes, (size_t)n);
}

static int close_taker(void *cookie) {
    free(cookie);
    return 0;
}

FILE *file_stream(void *self, file_take *take) {
    taker *t = malloc(sizeof *t);
    if (t)
        *t = (taker){self, take};
    FILE *to = t ? funopen(t, NULL, write_taker, NULL, close_taker) : NULL;
    if (!to)
        free(t);
    return to;
}
#else
FILE *file_stream(void *self, file_take *take) {
    return fopencookie(self, "w", (cookie_io_functions_t){.write = take});
}
#endif

static bool take_bytes(file_text *t, const char *bytes, size_t n) {
    t->lost = t->lost || !fret_array_room(&t->text, &t->room, t->size + n + 1, 1);
    if (t->lost)
        return false;
    memcpy(t->text + t->size, bytes, n);
    t->size += n;
    return true;
}

static ssize_t write_text(void *cookie, const char *bytes, size_t n) {
    return take_bytes(cookie, bytes, n) ? (ssize_t)n : 0;
}

bool file_text_open(file_text *t) {
    enum { ROOM = 256 };
    *t = (file_text){.to = NULL};
    if (fret_array_room(&t->text, &t->room, ROOM, 1))
        t->to = file_stream(t, write_text);
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
