/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Input by lines, in blocks: a line too long, memory that is out and a failing disk are errors, never the
 * end. */
#include "calc/file.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { BLOCK = 1 << 16, PAUSE = 20 /* ms between looks at the stop flag */ };

static bool cannot_read(const char *name, int code, char *error, size_t size) {
    snprintf(error, size, "cannot read %s: %s", name, strerror(code));
    return false;
}

bool file_in_take(file_in *in, int fd, const char *name, file_stop stop, char *error, size_t size) {
    struct stat info;
    *in = (file_in){.fd = fd, .stop = stop, .name = strdup(name), .block = malloc(BLOCK)};
    int code = !in->name || !in->block ? ENOMEM
               : fstat(fd, &info)      ? errno
               : S_ISDIR(info.st_mode) ? EISDIR
                                       : 0;
    if (code) {
        file_in_close(in);
        return cannot_read(name, code, error, size);
    }
    in->waits = !S_ISREG(info.st_mode);
    return true;
}

bool file_in_open(file_in *in, const char *name, file_stop stop, char *error, size_t size) {
    *in = (file_in){.fd = -1};
    char *path = file_expand(name);
    if (!path)
        return cannot_read(name, ENOMEM, error, size);
    /* not to hang on a FIFO that nobody writes */
    int fd = open(path, O_RDONLY | O_CLOEXEC | O_NOCTTY | O_NONBLOCK), code = errno;
    free(path);
    if (fd < 0)
        return cannot_read(name, code, error, size);
    bool ok = file_in_take(in, fd, name, stop, error, size);
    if (ok)
        in->owned = true;
    else
        close(fd);
    return ok;
}

bool file_in_text(file_in *in, const char *text, const char *name, file_stop stop, char *error, size_t size) {
    *in = (file_in){.fd = -1, .stop = stop, .name = strdup(name), .block = strdup(text), .ended = true};
    if (!in->name || !in->block) {
        file_in_close(in);
        return cannot_read(name, ENOMEM, error, size);
    }
    in->have = strlen(text);
    return true;
}

void file_in_close(file_in *in) {
    if (in->owned)
        close(in->fd);
    free(in->name);
    free(in->block);
    free(in->line);
    *in = (file_in){.fd = -1};
}

static bool stopped(const file_in *in) {
    return in->stop && *in->stop;
}

/* The next block: FILE_GOT_LINE stands for "some bytes". */
static file_got fill(file_in *in, char *error, size_t size) {
    for (;;) {
        if (stopped(in))
            return FILE_GOT_STOP;
        if (in->waits) { /* poll, unlike read, is never restarted after a signal */
            struct pollfd ready = {.fd = in->fd, .events = POLLIN};
            int n = poll(&ready, 1, in->stop ? PAUSE : -1);
            if (n == 0 || (n < 0 && errno == EINTR))
                continue;
        }
        ssize_t n = read(in->fd, in->block, BLOCK);
        if (n > 0) {
            in->at = 0;
            in->have = (size_t)n;
            return FILE_GOT_LINE;
        }
        if (n == 0)
            return FILE_GOT_END;
        if (errno != EINTR && errno != EAGAIN) {
            cannot_read(in->name, errno, error, size);
            return FILE_GOT_ERROR;
        }
    }
}

/* Appends to the line and ends it by a NUL. */
static bool append(file_in *in, const char *bytes, size_t n, char *error, size_t size) {
    if (n > FILE_LINE_LIMIT - in->length) {
        snprintf(error, size, "%s:%llu: the line is longer than %d MB", in->name, in->number,
                 FILE_LINE_LIMIT >> 20);
        return false;
    }
    if (in->length + n + 1 > in->room) {
        size_t room = in->room ? in->room : 256;
        while (room < in->length + n + 1)
            room *= 2;
        char *grown = realloc(in->line, room);
        if (!grown) {
            snprintf(error, size, "%s:%llu: out of memory", in->name, in->number);
            return false;
        }
        in->line = grown;
        in->room = room;
    }
    if (n)
        memcpy(in->line + in->length, bytes, n);
    in->length += n;
    in->line[in->length] = 0;
    return true;
}

/* Appends a physical line without its end. */
static file_got add_line(file_in *in, char *error, size_t size) {
    bool any = false;
    for (;;) {
        if (in->at == in->have) {
            file_got got = stopped(in) ? FILE_GOT_STOP : in->ended ? FILE_GOT_END : fill(in, error, size);
            if (got == FILE_GOT_END) {
                in->ended = true;
                if (!any)
                    return FILE_GOT_END;
                break;
            }
            if (got != FILE_GOT_LINE)
                return got;
        }
        if (!any) {
            any = true;
            in->read++;
        }
        const char *from = in->block + in->at, *end = memchr(from, '\n', in->have - in->at);
        size_t n = end ? (size_t)(end - from) : in->have - in->at;
        if (!append(in, from, n, error, size))
            return FILE_GOT_ERROR;
        in->at += n + (end != NULL);
        if (end)
            break;
    }
    return FILE_GOT_LINE;
}

file_got file_in_line(file_in *in, char *error, size_t size) {
    in->length = 0;
    in->number = in->read + 1;
    return append(in, "", 0, error, size) ? add_line(in, error, size) : FILE_GOT_ERROR;
}

file_got file_in_logical(file_in *in, file_mark *mark, char *error, size_t size) {
    file_got got = file_in_line(in, error, size);
    size_t begin = 0;
    while (got == FILE_GOT_LINE) {
        size_t at = begin + mark(in->line + begin, in->length - begin);
        if (at >= in->length)
            break;
        begin = in->length + 1;
        if (!append(in, "\n", 1, error, size))
            return FILE_GOT_ERROR;
        got = add_line(in, error, size);
        if (got == FILE_GOT_END) {
            in->line[--in->length] = 0;
            return FILE_GOT_LINE;
        }
        in->line[at] = ' ';
    }
    return got;
}
