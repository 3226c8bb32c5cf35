/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Transcripts as a session goes on: streams that write to two places. Writes the file that it is given. */
#if defined(__linux__) && !defined(_GNU_SOURCE)
#define _GNU_SOURCE /* fopencookie, which musl has too */
#endif
#include "shell/record.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

/* ---- two places -------------------------------------------------------------------------------- */

struct recorder {
    FILE *file;
    FILE *out, *err;           /* of the session */
    FILE *both_out, *both_err; /* with the file */
    char *line;                /* that is to be written before anything follows, or NULL */
    char *path;
    bool escape; /* within a colour, which a transcript does without */
};

/* There is one session that can record. */
static struct recorder *recording;

static void write_line(struct recorder *r) {
    if (r->line)
        fputs(r->line, r->file);
    free(r->line);
    r->line = NULL;
}

static void write_both(struct recorder *r, FILE *to, const char *bytes, size_t n) {
    write_line(r);
    for (size_t i = 0; i < n; i++) {
        if (r->escape)
            r->escape = bytes[i] != 'm';
        else if (bytes[i] == '\033')
            r->escape = true;
        else
            putc(bytes[i], r->file);
    }
    fwrite(bytes, 1, n, to);
    fflush(to);
}

#if defined(__APPLE__)
static int write_out(void *cookie, const char *bytes, int n) {
    write_both(cookie, ((struct recorder *)cookie)->out, bytes, (size_t)n);
    return n;
}

static int write_err(void *cookie, const char *bytes, int n) {
    write_both(cookie, ((struct recorder *)cookie)->err, bytes, (size_t)n);
    return n;
}

static void open_both(struct recorder *r) {
    r->both_out = funopen(r, NULL, write_out, NULL, NULL);
    r->both_err = funopen(r, NULL, write_err, NULL, NULL);
}
#else
static ssize_t write_out(void *cookie, const char *bytes, size_t n) {
    write_both(cookie, ((struct recorder *)cookie)->out, bytes, n);
    return (ssize_t)n;
}

static ssize_t write_err(void *cookie, const char *bytes, size_t n) {
    write_both(cookie, ((struct recorder *)cookie)->err, bytes, n);
    return (ssize_t)n;
}

static void open_both(struct recorder *r) {
    r->both_out = fopencookie(r, "w", (cookie_io_functions_t){.write = write_out});
    r->both_err = fopencookie(r, "w", (cookie_io_functions_t){.write = write_err});
}
#endif

static void free_recorder(struct recorder *r) {
    if (r->both_out)
        fclose(r->both_out);
    if (r->both_err)
        fclose(r->both_err);
    if (r->file)
        fclose(r->file);
    free(r->line);
    free(r->path);
    free(r);
}

/* ---- what comes first -------------------------------------------------------------------------- */

static void write_statements(FILE *to, const char *text) {
    while (*text) {
        const size_t n = strcspn(text, "\n");
        if (n > 0 && *text != '#')
            fprintf(to, "fret> %.*s" RECORD_GIVEN "\n", (int)n, text);
        text += n + (text[n] == '\n');
    }
}

/* ---- a transcript ------------------------------------------------------------------------------ */

bool record_begin(shell *sh, const char *path, const char *beginning, calc_error *error) {
    struct stat before;
    if (sh->replaying)
        return true;
    record_end(sh);
    char *real = file_expand(path);
    const bool over = real && !stat(real, &before) && before.st_size > 0;
    struct recorder *r = calloc(1, sizeof *r);
    if (r)
        *r = (struct recorder){
            .file = real ? fopen(real, "w") : NULL, .out = sh->out, .err = sh->err, .path = strdup(path)};
    const int code = r && real ? errno : ENOMEM;
    free(real);
    if (!r || !r->file || !r->path) {
        calc_errno(error, code, "cannot write %s", path);
        if (r)
            free_recorder(r);
        return false;
    }
    open_both(r);
    if (!r->both_out || !r->both_err) {
        free_recorder(r);
        return calc_no_memory(error);
    }
    write_statements(r->file, beginning);
    setvbuf(r->file, NULL, _IOLBF, BUFSIZ); /* what is recorded survives a crash */
    setvbuf(r->both_out, NULL, _IOLBF, BUFSIZ);
    setvbuf(r->both_err, NULL, _IONBF, 0);
    if (over)
        shell_note(sh, "overwriting %s", path);
    sh->record = recording = r;
    sh->out = r->both_out;
    sh->err = r->both_err;
    return true;
}

bool record_end(shell *sh) {
    struct recorder *r = sh->record;
    if (!r)
        return sh->replaying;
    fflush(sh->out);
    fflush(sh->err);
    sh->out = r->out;
    sh->err = r->err;
    sh->record = recording = NULL;
    fflush(r->file);
    if (ferror(r->file))
        shell_note(sh, "error: cannot write %s: %s", r->path, strerror(errno ? errno : EIO));
    free_recorder(r);
    return true;
}

/* `fret> ` and `....> ` before its physical lines, whose marks have become blanks. */
void record_line(shell *sh, const char *text, size_t len) {
    struct recorder *r = sh->record;
    file_text typed;
    if (!r || !file_text_open(&typed))
        return;
    fflush(sh->out);
    write_line(r);
    for (size_t i = 0, n; i <= len; i += n + 1) {
        const char *end = i < len ? memchr(text + i, '\n', len - i) : NULL;
        n = end ? (size_t)(end - text) - i : len - i;
        fprintf(typed.to, "%s%.*s%s\n", i ? "....> " : "fret> ", (int)n, text + i, end ? "\\" : "");
    }
    if (file_text_close(&typed))
        r->line = typed.text;
}

void record_aside(FILE *out, const char *text) {
    if (!recording || out != recording->both_out)
        return;
    fflush(out);
    write_line(recording);
    fputs(text, recording->file);
}

bool record_shows(const shell *sh) {
    return sh->record && sh->record->out == stdout;
}

/* ---- what is typed ----------------------------------------------------------------------------- */

struct lines {
    size_t count, room;
    char **line;
};

void typed_keep(shell *sh, const char *line) {
    if (!sh->typed)
        sh->typed = calloc(1, sizeof *sh->typed);
    struct lines *t = sh->typed;
    if (t && t->count == t->room) {
        const size_t room = t->room ? 2 * t->room : 64;
        char **grown = realloc(t->line, room * sizeof *grown);
        if (!grown)
            return;
        t->line = grown;
        t->room = room;
    }
    char *copy = t ? strdup(line) : NULL;
    if (copy)
        t->line[t->count++] = copy;
}

/* A line that went on over others does so again. */
void typed_write(const shell *sh, FILE *to) {
    for (size_t i = 0; sh->typed && i < sh->typed->count; i++) {
        for (const char *p = sh->typed->line[i]; *p; p++)
            fputs((const char[]){*p == '\n' ? '\\' : *p, *p == '\n' ? '\n' : 0, 0}, to);
        putc('\n', to);
    }
}

void typed_forget(shell *sh) {
    for (size_t i = 0; sh->typed && i < sh->typed->count; i++)
        free(sh->typed->line[i]);
    if (sh->typed)
        free(sh->typed->line);
    free(sh->typed);
    sh->typed = NULL;
}
