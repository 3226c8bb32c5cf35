/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Transcripts as a session goes on: streams that write to two places. Writes the file that it is given. */
#define _GNU_SOURCE /* fopencookie, which musl has too */
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
static void put_bytes(struct recorder *r, const char *bytes, size_t n) {
    for (size_t i = 0; i < n; i++) {
        r->held[r->held_count++] = bytes[i];
        if (bytes[i] == '\n' || r->held_count == HELD)
            write_held(r);
    }
}

static void put_text(struct recorder *r, const char *text) {
    put_bytes(r, text, strlen(text));
}

/* Without colours. */
static void keep_bytes(struct recorder *r, const char *bytes, size_t n) {
    for (size_t i = 0; i < n; i++) {
        if (r->escape)
            r->escape = bytes[i] != 'm';
        else if (bytes[i] == '\033')
            r->escape = true;
        else
            put_bytes(r, bytes + i, 1);
    }
}

static void write_both(struct recorder *r, FILE *to, const char *bytes, size_t n) {
    keep_bytes(r, bytes, n);
    fwrite(bytes, 1, n, to);
    fflush(to);
}

static ssize_t write_out(void *cookie, const char *bytes, size_t n) {
    fflush(((struct recorder *)cookie)->both_err); /* errors before this output come first in the file too */
    write_both(cookie, ((struct recorder *)cookie)->out, bytes, n);
    return (ssize_t)n;
}

static ssize_t write_err(void *cookie, const char *bytes, size_t n) {
    write_both(cookie, ((struct recorder *)cookie)->err, bytes, n);
    return (ssize_t)n;
}

static void free_recorder(struct recorder *r) {
    if (r->both_out)
        fclose(r->both_out);
    if (r->both_err)
        fclose(r->both_err);
    file_log_close(&r->log);
    free(r);
}

/* ---- what comes first -------------------------------------------------------------------------- */

static void put_statements(struct recorder *r, const char *text) {
    while (*text) {
        const size_t n = strcspn(text, "\n");
        if (*text != '#') {
            put_text(r, "fret> ");
            put_bytes(r, text, n);
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
    if (!r)
        return calc_no_memory(error);
    r->sh = sh;
    r->log.fd = -1;
    r->both_out = fopencookie(r, "w", (cookie_io_functions_t){.write = write_out});
    r->both_err = fopencookie(r, "w", (cookie_io_functions_t){.write = write_err});
    if (!r->both_out || !r->both_err) /* before the file is emptied */
        calc_no_memory(error);
    else
        file_log_open(&r->log, path, &shell_stop, &over, error);
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
    put_text(r, "# fret " FRET_VERSION "\n");
    put_statements(r, beginning);
    return true;
}

bool record_end(shell *sh, bool tells) {
    struct recorder *r = sh->record;
    if (!r)
        return sh->replaying;
    fflush(sh->out);
    fflush(sh->err);
    sh->out = r->out;
    sh->err = r->err;
    sh->record = recording = NULL;
    write_held(r);
    const file_report report = {.direct = !r->log.regular, .size = (unsigned long long)r->log.length};
    if (tells && !r->lost)
        target_report(sh, r->log.name, &report);
    free_recorder(r);
    return true;
}

/* The part of a line before its `record`: answers to the rest are not recorded. */
static size_t until_record(const char *text, size_t len) {
    static const char word[] = "record ";
    enum { WORD = sizeof word - 1 };
    size_t kept = 0, end;
    for (size_t i = 0; i < len; i = end + 1) {
        end = shell_statement_end(text, i, len);
        while (i < end && text[i] == ' ')
            i++;
        if (end - i >= WORD && !memcmp(text + i, word, WORD)) {
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
    if (!r)
        return;
    fflush(sh->out);
    len = until_record(text, len);
    const char *prompt = "fret> ";
    for (size_t i = 0, n; i <= len && len > 0; i += n + 1, prompt = "....> ") {
        const char *end = memchr(text + i, '\n', len - i);
        n = end ? (size_t)(end - text) - i : len - i;
        put_text(r, prompt);
        put_bytes(r, text + i, n);
        put_text(r, end ? "\\\n" : "\n");
    }
}

void record_aside(const char *text) {
    if (!recording)
        return;
    fflush(recording->both_out);
    keep_bytes(recording, text, strlen(text));
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
