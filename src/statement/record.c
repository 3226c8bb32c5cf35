/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Transcripts as a session goes on: streams that write to two places. Writes the file that it is given. */
#if defined(__linux__) && !defined(_GNU_SOURCE)
#define _GNU_SOURCE /* fopencookie, which musl has too */
#endif
#include "statement/record.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "statement/recorder.h"
#include "statement/target.h"
#include "text/lines.h"

/* ---- two places -------------------------------------------------------------------------------- */

/* There is one session that can record. */
static struct recorder *recording;

/* The full-screen mode has the terminal, and hands its frames to a cast. */
static bool away;

/* After an error nothing more is recorded. */
static void check(struct recorder *r, bool ok, const calc_error *error) {
    if (ok)
        return;
    shell *sh = r->sh;
    FILE *out = sh->out, *err = sh->err;
    char text[CALC_ERROR_TEXT + 40];
    snprintf(text, sizeof text, "%s; what follows is not recorded", error->text);
    r->lost = sh->lost = true;
    sh->out = r->out; /* this may be called by a stream of the recorder's, which must not write to itself */
    sh->err = r->err;
    shell_error(sh, text);
    sh->out = out;
    sh->err = err;
}

static void write_held(struct recorder *r) {
    calc_error error;
    error_clear(&error);
    if (!r->lost && r->held_count > 0)
        check(r, file_log_add(&r->log, r->held, r->held_count, &error), &error);
    r->held_count = 0;
}

/* To the transcript, line by line. */
static void put_byte(struct recorder *r, char c) {
    r->held[r->held_count++] = c;
    if (c == '\n' || r->held_count == HELD)
        write_held(r);
}

static void put_text(struct recorder *r, const char *text) {
    while (*text)
        put_byte(r, *text++);
}

static void put_cast(struct recorder *r, const char *bytes, size_t n) {
    calc_error error;
    error_clear(&error);
    if (!r->lost)
        check(r, cast_write(r->cast, bytes, n, &error), &error);
}

/* A physical line of a statement, prompt and all, with its end. */
static void type_line(struct recorder *r, const char *line, size_t n) {
    static const char prompt[] = "fret> "; /* as long as the one of lines that go on */
    enum { PROMPT = sizeof prompt - 1 };
    calc_error error;
    char shown[sizeof prompt];
    error_clear(&error);
    snprintf(shown, sizeof shown, "%.*s", PROMPT, line);
    if (!r->lost)
        check(r, cast_type(r->cast, shown, line + PROMPT, n - PROMPT, &error), &error);
}

static void write_line(struct recorder *r) {
    char *line = r->line;
    r->line = NULL;
    if (line && r->cast)
        for (const char *p = line; *p; p += strcspn(p, "\n") + 1)
            type_line(r, p, strcspn(p, "\n"));
    else if (line)
        put_text(r, line);
    free(line);
}

static void keep_plain(struct recorder *r, const char *bytes, size_t n) {
    for (size_t i = 0; i < n; i++) {
        if (r->escape)
            r->escape = bytes[i] != 'm';
        else if (bytes[i] == '\033')
            r->escape = true;
        else
            put_byte(r, bytes[i]);
    }
}

static void keep_bytes(struct recorder *r, const char *bytes, size_t n) {
    write_line(r);
    if (!r->cast)
        keep_plain(r, bytes, n);
    else if (!away)
        put_cast(r, bytes, n);
}

static void write_both(struct recorder *r, FILE *to, const char *bytes, size_t n) {
    keep_bytes(r, bytes, n);
    fwrite(bytes, 1, n, to);
    fflush(to);
}

#if defined(__APPLE__)
static int write_out(void *cookie, const char *bytes, int n) {
    fflush(((struct recorder *)cookie)->both_err);
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
    fflush(((struct recorder *)cookie)->both_err); /* errors before this output come first in the file too */
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
    file_log_close(&r->log);
    free(r->line);
    free(r);
}

/* ---- what comes first -------------------------------------------------------------------------- */

static void put_statements(struct recorder *r, const char *text) {
    while (*text) {
        const size_t n = strcspn(text, "\n");
        if (*text != '#') {
            put_text(r, "fret> ");
            for (size_t i = 0; i < n; i++)
                put_byte(r, text[i]);
            put_text(r, RECORD_GIVEN "\n");
        }
        text += n + (text[n] == '\n');
    }
}

/* ---- a recording ------------------------------------------------------------------------------- */

bool record_begin(shell *sh, const char *path, const char *beginning, calc_error *error) {
    bool over = false;
    if (sh->replaying)
        return true;
    struct recorder *r = calloc(1, sizeof *r);
    if (!r) {
        return calc_no_memory(error);
    }
    r->sh = sh;
    r->log.fd = -1;
    const bool as_cast = file_ends(path, ".cast");
    open_both(r); /* before the file is emptied */
    if (!r->both_out || !r->both_err)
        calc_no_memory(error);
    else if (file_log_open(&r->log, path, as_cast ? NULL : &shell_stop, &over, error) && as_cast)
        r->cast = cast_begin(&r->log, sh->interactive || away, error);
    if (error->raised) {
        free_recorder(r);
        return false;
    }
    record_end(sh, true);
    r->out = sh->out;
    r->err = sh->err;
    setvbuf(r->both_out, NULL, _IOLBF, BUFSIZ); /* line by line: what is recorded survives a crash */
    setvbuf(r->both_err, NULL, _IOLBF, BUFSIZ);
    if (over)
        shell_say(sh, "overwriting %s", path);
    sh->record = recording = r;
    sh->out = r->both_out;
    sh->err = r->both_err;
    if (!r->cast)
        put_statements(r, beginning);
    return true;
}

bool record_end(shell *sh, bool tells) {
    calc_error error;
    error_clear(&error);
    struct recorder *r = sh->record;
    if (!r)
        return sh->replaying;
    fflush(sh->out);
    fflush(sh->err);
    sh->out = r->out;
    sh->err = r->err;
    sh->record = recording = NULL;
    if (r->cast)
        check(r, cast_end(r->cast, !r->lost, &error), &error);
    else
        write_held(r);
    const file_report report = {.direct = !r->log.regular, .size = (unsigned long long)r->log.length};
    if (tells && !r->lost)
        target_report(sh, r->log.name, &report);
    free_recorder(r);
    return true;
}

/* The part of a line before its `record off`: answers to the rest are not recorded. */
static size_t until_off(const char *text, size_t len) {
    size_t kept = 0, end;
    for (size_t i = 0; i < len; i = end + 1) {
        char first[8], second[8], third[2];
        end = shell_statement_end(text, i, len);
        char *statement = strndup(text + i, end - i);
        const bool off = statement && sscanf(statement, "%7s %7s %1s", first, second, third) == 2 &&
                         !strcmp(first, "record") && !strcmp(second, "off");
        free(statement);
        if (off) {
            while (kept && text[kept - 1] == ' ')
                kept--;
            return kept;
        }
        kept = end;
    }
    return len;
}

/* `fret> ` and `....> ` before its physical lines, whose marks have become blanks. */
void record_line(shell *sh, const char *text, size_t len) {
    struct recorder *r = sh->record;
    file_text typed;
    if (!r || r->lost || (r->cast && (away || cast_has_clock(r->cast)))) /* a cast has it from the terminal */
        return;
    fflush(sh->out);
    write_line(r);
    len = r->cast ? len : until_off(text, len);
    if (!len)
        return;
    bool ok = file_text_open(&typed);
    for (size_t i = 0, n; ok && i <= len; i += n + 1) {
        const char *end = i < len ? memchr(text + i, '\n', len - i) : NULL;
        n = end ? (size_t)(end - text) - i : len - i;
        fprintf(typed.to, "%s%.*s%s\n", i ? "....> " : "fret> ", (int)n, text + i, end ? "\\" : "");
    }
    ok = ok && file_text_close(&typed);
    r->line = ok ? typed.text : NULL;
    calc_error error;
    error_clear(&error);
    if (!ok)
        calc_no_memory(&error);
    check(r, ok, &error);
}

void record_aside(const char *text) {
    if (!recording)
        return;
    fflush(recording->both_out);
    keep_bytes(recording, text, strlen(text));
}

/* ---- the terminal ------------------------------------------------------------------------------ */

FILE *record_terminal(void) {
    return recording && recording->cast ? recording->both_out : stdout;
}

void record_away(shell *sh, bool now) {
    fflush(sh->out);
    if (sh->record)
        write_line(sh->record);
    away = now;
}

bool record_filming(const shell *sh, int *cols, int *rows) {
    const struct recorder *r = sh->record;
    if (!r || !r->cast || r->lost)
        return false;
    cast_size(r->cast, cols, rows);
    return true;
}

void record_film(shell *sh, const char *bytes, size_t n, double seconds) {
    cast_wait(sh->record->cast, seconds);
    put_cast(sh->record, bytes, n);
}

/* ---- what is typed ----------------------------------------------------------------------------- */

/* A line that goes on over others does so again. */
void typed_keep(shell *sh, const char *line) {
    for (const char *p = line; *p; p++)
        fputs((const char[]){*p == '\n' ? '\\' : *p, *p == '\n' ? '\n' : 0, 0}, sh->typed.to);
    putc('\n', sh->typed.to);
}

bool typed_write(const shell *sh, FILE *to) {
    const file_text *t = &sh->typed;
    fflush(t->to);
    fwrite(t->text, 1, t->size, to);
    return !t->lost;
}

void typed_forget(shell *sh) {
    if (sh->typed.to && file_text_close(&sh->typed))
        free(sh->typed.text);
}
