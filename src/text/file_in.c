/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Input by lines, read in blocks: a line too long, memory that is out and a failing disk are errors, never
 * the end of the file. Depends on POSIX and this room. */
#include "text/file.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "number/array.h"
#include "text/characters.h"
#include "text/encoding.h"
#include "text/lines.h"

enum { BLOCK = 1 << 16, PAUSE = 20 /* ms between two checks of the stop flag */ };
/* UTF-16 is read into the last quarter of the block; UTF-8, at most 3/2 as long, goes to the beginning. */
enum { RAW = BLOCK / 4 * 3 };
static const char little[] = "UTF-16LE", big[] = "UTF-16BE";

/* The byte order marks. */
static const struct {
    const char *bytes;
    size_t length;
    const char *encoding; /* NULL: UTF-8 */
} marks[] = {{"\xef\xbb\xbf", 3, NULL}, {"\xff\xfe", 2, little}, {"\xfe\xff", 2, big}};
enum { MARKS = sizeof marks / sizeof *marks };

static bool cannot_read(const char *name, int code, calc_error *error) {
    return calc_errno(error, code, "cannot read %s", name);
}

bool file_in_take(file_in *in, int fd, const char *name, file_stop stop, calc_error *error) {
    struct stat info;
    *in = (file_in){.fd = fd, .stop = stop, .name = strdup(name), .block = malloc(BLOCK)};
    int code = !in->name || !in->block ? ENOMEM
               : fstat(fd, &info)      ? errno
               : S_ISDIR(info.st_mode) ? EISDIR
                                       : 0;
    if (code) {
        file_in_close(in);
        return cannot_read(name, code, error);
    }
    in->waits = !S_ISREG(info.st_mode);
    return true;
}

bool file_in_open(file_in *in, const char *name, file_stop stop, calc_error *error) {
    *in = (file_in){.fd = -1};
    char *path = file_expand(name);
    if (!path)
        return cannot_read(name, ENOMEM, error);
    /* O_NONBLOCK: open must not hang on a FIFO without a writer */
    int fd = open(path, O_RDONLY | O_CLOEXEC | O_NOCTTY | O_NONBLOCK), code = errno;
    free(path);
    if (fd < 0)
        return cannot_read(name, code, error);
    bool ok = file_in_take(in, fd, name, stop, error);
    in->owned = ok;
    if (ok)
        file_keep(fd, true);
    else
        close(fd);
    return ok;
}

bool file_in_script(file_in *in, const char *name, file_stop stop, calc_error *error) {
    return strcmp(name, "-") ? file_in_open(in, name, stop, error)
                             : file_in_take(in, STDIN_FILENO, "stdin", stop, error);
}

bool file_in_text(file_in *in, const char *text, const char *name, file_stop stop, calc_error *error) {
    *in = (file_in){.fd = -1, .stop = stop, .name = strdup(name), .block = strdup(text), .ended = true};
    if (!in->name || !in->block) {
        file_in_close(in);
        return cannot_read(name, ENOMEM, error);
    }
    in->have = strlen(text);
    in->at = strncmp(text, marks[0].bytes, marks[0].length) ? 0 : marks[0].length;
    return true;
}

bool file_in_typed(file_in *in, file_ask *ask, file_stop stop, calc_error *error) {
    const bool ok = file_in_text(in, "", "stdin", stop, error);
    in->ended = false;
    in->ask = ask;
    return ok;
}

void file_in_close(file_in *in) {
    if (in->owned) {
        file_keep(in->fd, false);
        close(in->fd);
    }
    free(in->name);
    free(in->block);
    free(in->line);
    if (in->decoder)
        iconv_close(in->decoder);
    *in = (file_in){.fd = -1};
}

static bool input_stopped(const file_in *in) {
    return in->stop && *in->stop;
}

/* Reads one byte or more into `to`: FILE_GOT_LINE, with their number in *got. */
static file_got read_some(file_in *in, char *to, size_t room, size_t *got, calc_error *error) {
    for (;;) {
        if (input_stopped(in))
            return FILE_GOT_STOP;
        if (in->waits) { /* poll, unlike read, is never restarted after a signal */
            struct pollfd ready = {.fd = in->fd, .events = POLLIN};
            int n = poll(&ready, 1, in->stop ? PAUSE : -1);
            if (n == 0 || (n < 0 && errno == EINTR))
                continue;
        }
        ssize_t n = read(in->fd, to, room);
        if (n > 0) {
            *got = (size_t)n;
            return FILE_GOT_LINE;
        }
        if (n == 0)
            return FILE_GOT_END;
        if (errno != EINTR && errno != EAGAIN) {
            cannot_read(in->name, errno, error);
            return FILE_GOT_ERROR;
        }
    }
}

/* ---- UTF-16 ------------------------------------------------------------------------------------ */

/* Decodes the n bytes that were read behind the incomplete character of in->incomplete bytes. */
static void decode(file_in *in, size_t n) {
    const size_t len = in->incomplete + n;
    in->incomplete = len;
    in->have = encoding_decode(in->decoder, 2, in->block + RAW, &in->incomplete, in->block, RAW);
    memmove(in->block + RAW, in->block + RAW + len - in->incomplete, in->incomplete);
}

/* ---- the mark ---------------------------------------------------------------------------------- */

/* Are the bytes the beginning of a mark that is longer? */
static bool begins_mark(const char *bytes, size_t n) {
    for (size_t i = 0; i < MARKS; i++)
        if (n < marks[i].length && !memcmp(bytes, marks[i].bytes, n))
            return true;
    return false;
}

/* UTF-16 without a mark is recognised if it begins with two ASCII characters; NULL: it is not UTF-16. */
static const char *encoding_without_mark(const char *bytes, size_t n) {
    const bool low = n >= 4 && bytes[0] && !bytes[1] && bytes[2] && !bytes[3],
               high = n >= 4 && !bytes[0] && bytes[1] && !bytes[2] && bytes[3];
    return low ? little : high ? big : NULL;
}

/* Reads the first bytes, skips the mark and sets up the decoder. */
static file_got read_beginning(file_in *in, calc_error *error) {
    file_got got = FILE_GOT_LINE;
    size_t n = 0;
    while (got == FILE_GOT_LINE && begins_mark(in->block, in->have)) {
        got = read_some(in, in->block + in->have, BLOCK - RAW - in->have, &n, error);
        in->have += got == FILE_GOT_LINE ? n : 0;
    }
    if (got == FILE_GOT_STOP || got == FILE_GOT_ERROR)
        return got;
    const char *encoding = encoding_without_mark(in->block, in->have);
    for (size_t i = 0; i < MARKS; i++)
        if (in->have >= marks[i].length && !memcmp(in->block, marks[i].bytes, marks[i].length)) {
            encoding = marks[i].encoding;
            in->at = marks[i].length;
        }
    in->encoding_known = true;
    if (!encoding)
        return FILE_GOT_LINE;
    if (!encoding_open(&in->decoder, encoding, "UTF-16", in->name, error))
        return FILE_GOT_ERROR;
    n = in->have - in->at;
    memmove(in->block + RAW, in->block + in->at, n);
    in->at = 0;
    decode(in, n);
    return FILE_GOT_LINE;
}

/* Fills the block from the callback and adds the last newline. */
static file_got ask_more(file_in *in) {
    free(in->block);
    in->block = in->ask(in->number <= in->read);
    if (!in->block)
        return input_stopped(in) ? FILE_GOT_STOP : FILE_GOT_END;
    in->have = strlen(in->block);
    in->block[in->have++] = '\n';
    return FILE_GOT_LINE;
}

/* Reads the next block: FILE_GOT_LINE if it holds one byte or more. */
static file_got fill_block(file_in *in, calc_error *error) {
    file_got got = FILE_GOT_LINE;
    in->at = in->have = 0;
    if (in->ask)
        return ask_more(in);
    if (!in->encoding_known)
        got = read_beginning(in, error);
    while (got == FILE_GOT_LINE && in->at == in->have) {
        size_t n = 0;
        in->at = in->have = 0;
        const size_t from = in->decoder ? RAW + in->incomplete : 0;
        got = read_some(in, in->block + from, BLOCK - from, &n, error);
        if (!in->decoder) {
            in->have = n;
        } else if (got == FILE_GOT_LINE) {
            decode(in, n);
        } else if (got == FILE_GOT_END && in->incomplete) {
            in->have = character_put(CHARACTER_LOST, in->block);
            in->incomplete = 0;
        }
    }
    return got == FILE_GOT_END && in->have > 0 ? FILE_GOT_LINE : got;
}

/* Appends to in->line and terminates it by a NUL. */
static bool append_bytes(file_in *in, const char *bytes, size_t n, calc_error *error) {
    if (n > FILE_LINE_LIMIT - in->length)
        return calc_fail(error, 0, 0, "%s:%llu: the line is longer than %d MB", in->name, in->number,
                         FILE_LINE_LIMIT >> 20);
    if (!fret_array_room(&in->line, &in->room, in->length + n + 1, 1))
        return calc_errno(error, ENOMEM, "%s:%llu", in->name, in->number);
    memcpy(in->line + in->length, bytes, n);
    in->length += n;
    in->line[in->length] = 0;
    return true;
}

/* Appends a physical line to in->line, without its LF or CR LF. */
static file_got add_line(file_in *in, calc_error *error) {
    const size_t begin = in->length;
    bool any = false;
    for (;;) {
        if (in->at == in->have) {
            file_got got = input_stopped(in) ? FILE_GOT_STOP
                           : in->ended       ? FILE_GOT_END
                                             : fill_block(in, error);
            if (got == FILE_GOT_END) {
                in->ended = !in->ask;
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
        if (!append_bytes(in, from, n, error))
            return FILE_GOT_ERROR;
        in->at += n + (end != NULL);
        if (end)
            break;
    }
    if (in->length > begin && in->line[in->length - 1] == '\r')
        in->line[--in->length] = 0;
    return FILE_GOT_LINE;
}

file_got file_in_line(file_in *in, calc_error *error) {
    in->length = 0;
    in->number = in->read + 1;
    return add_line(in, error);
}

file_got file_in_rest(file_in *in, calc_error *error) {
    for (size_t begin = 0;;) {
        char *line = in->line + begin;
        size_t left = in->length - begin;
        memset(line, ' ', (size_t)(strip_prompt(line, &left) - line));
        const size_t at = begin + shell_mark(line, in->length - begin);
        if (at == in->length)
            return FILE_GOT_LINE;
        in->line[at] = ' ';
        begin = in->length + 1;
        if (!append_bytes(in, "\n", 1, error))
            return FILE_GOT_ERROR;
        const file_got got = add_line(in, error);
        if (got == FILE_GOT_END)
            in->line[--in->length] = 0;
        if (got != FILE_GOT_LINE)
            return got == FILE_GOT_END ? FILE_GOT_LINE : got;
    }
}

file_got file_in_logical(file_in *in, calc_error *error) {
    const file_got got = file_in_line(in, error);
    return got == FILE_GOT_LINE ? file_in_rest(in, error) : got;
}
