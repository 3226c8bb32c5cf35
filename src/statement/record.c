/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Records a session in a transcript or on a page, by streams that write to two places (file_stream). Writes
 * the file given and the session's streams. */
#include "statement/record.h"

#include <stdlib.h>
#include <string.h>

#include "statement/target.h"
#include "text/lines.h"

/* ---- streams ------------------------------------------------------------------------------------ */

/* The recorder in use, for record_aside; one session at a time records. */
static struct recorder *recording;

/* Reports an error past the recorder: the caller may be one of its streams. */
static void report_outside(struct recorder *r, const char *text) {
    shell *sh = r->sh;
    FILE *out = sh->out, *err = sh->err;
    sh->out = r->outer_out ? r->outer_out : r->out;
    sh->err = r->outer_err ? r->outer_err : r->err;
    shell_error(sh, text);
    sh->out = out;
    sh->err = err;
}

/* Stops recording after an error. */
static void stop_on_error(struct recorder *r, bool ok, const calc_error *error) {
    if (ok)
        return;
    shell *sh = r->sh;
    char text[CALC_ERROR_TEXT + 40];
    snprintf(text, sizeof text, "%s; what follows is not recorded", error->text);
    r->lost = sh->lost = true;
    report_outside(r, text);
}

static void add_to_log(struct recorder *r, const char *bytes, size_t n) {
    calc_error error;
    error_clear(&error);
    if (!r->lost)
        stop_on_error(r, file_log_add(&r->log, bytes, n, &error), &error);
}

static ssize_t write_log(void *cookie, const char *bytes, size_t n) {
    add_to_log(cookie, bytes, n);
    return (ssize_t)n;
}

/* Writes to the page or the transcript; the stream is line-buffered. */
static ssize_t write_kept(void *cookie, const char *bytes, size_t n) {
    struct recorder *r = cookie;
    if (r->page.to)
        handout_put(&r->page, PAGE_ANSWER, bytes, n);
    else
        add_to_log(r, bytes, n);
    return (ssize_t)n;
}

/* Records bytes without escape sequences. */
static void keep_bytes(struct recorder *r, const char *bytes, size_t n) {
    for (size_t i = 0; i < n && !r->apart; i++) {
        if (r->escape)
            r->escape = bytes[i] != 'm';
        else if (bytes[i] == '\033')
            r->escape = true;
        else
            putc(bytes[i], r->kept);
    }
}

static void write_both(struct recorder *r, FILE *to, const char *bytes, size_t n) {
    keep_bytes(r, bytes, n);
    if (!to)
        return;
    fwrite(bytes, 1, n, to);
    fflush(to);
}

static ssize_t write_out(void *cookie, const char *bytes, size_t n) {
    fflush(((struct recorder *)cookie)->both_err); /* keeps the order of errors and output in the record */
    write_both(cookie, ((struct recorder *)cookie)->out, bytes, n);
    return (ssize_t)n;
}

static ssize_t write_err(void *cookie, const char *bytes, size_t n) {
    write_both(cookie, ((struct recorder *)cookie)->err, bytes, n);
    return (ssize_t)n;
}

static bool free_recorder(struct recorder *r) {
    FILE *const streams[] = {r->both_out, r->both_err, r->kept}; /* `kept` last: the others write to it */
    for (size_t i = 0; i < sizeof streams / sizeof *streams; i++)
        if (streams[i])
            fclose(streams[i]);
    const bool ok = handout_end(&r->page);
    if (r->to_log)
        fclose(r->to_log);
    file_log_close(&r->log);
    free(r);
    return ok;
}

static struct recorder *make_recorder(shell *sh, calc_error *error) {
    struct recorder *r = calloc(1, sizeof *r);
    if (r) {
        *r = (struct recorder){.sh = sh, .log.fd = -1};
        r->kept = file_stream(r, write_kept);
        r->both_out = file_stream(r, write_out);
        r->both_err = file_stream(r, write_err);
        if (r->kept && r->both_out && r->both_err) {
            setvbuf(r->kept, NULL, _IOLBF, BUFSIZ);
            setvbuf(r->both_out, NULL, _IOLBF, BUFSIZ); /* line by line: the record survives a crash */
            setvbuf(r->both_err, NULL, _IOLBF, BUFSIZ);
            return r;
        }
        free_recorder(r);
    }
    calc_no_memory(error);
    return NULL;
}

static void take_over(shell *sh, struct recorder *r) {
    sh->record = recording = r;
    sh->out = r->both_out;
    sh->err = r->both_err;
}

/* ---- the beginning ------------------------------------------------------------------------------ */

static void put_statements(struct recorder *r, const char *text) {
    while (*text) {
        const size_t n = strcspn(text, "\n");
        if (*text != '#' && r->page.to)
            handout_put(&r->page, PAGE_STATEMENT, text, n + (text[n] == '\n'));
        else if (*text != '#')
            fprintf(r->kept, "fret> %.*s" RECORD_GIVEN "\n", (int)n, text);
        text += n + (text[n] == '\n');
    }
}

/* ---- recording ---------------------------------------------------------------------------------- */

bool record_as_page(const char *path) {
    return file_ends(path, ".html");
}

bool record_begin(shell *sh, const char *path, const char *beginning, calc_error *error) {
    bool over = false;
    if (sh->replaying)
        return true;
    if (record_alone(sh))
        return calc_fail(error, 0, 0, "what is played goes on a page already");
    const bool html = record_as_page(path);
    struct recorder *r = make_recorder(sh, error);
    if (!r)
        return false;
    if (html && !(r->to_log = file_stream(r, write_log)))
        calc_no_memory(error); /* before file_log_open empties the file */
    else
        file_log_open(&r->log, path, &shell_stop, &over, error);
    if (error->raised) {
        free_recorder(r);
        return false;
    }
    record_end(sh, true);
    r->out = sh->out;
    r->err = sh->err;
    if (over)
        shell_say(sh, "overwriting %s", path);
    take_over(sh, r);
    if (html)
        handout_begin(&r->page, r->to_log, "fret");
    else
        fputs("# fret " FRET_VERSION "\n", r->kept);
    put_statements(r, beginning);
    return true;
}

bool record_end(shell *sh, bool tells) {
    struct recorder *r = sh->record;
    if (!r || record_alone(sh))
        return sh->replaying;
    fflush(sh->out);
    fflush(sh->err);
    sh->out = r->out;
    sh->err = r->err;
    sh->record = recording = NULL;
    fflush(r->kept);
    if (r->page.to && !handout_end(&r->page))
        shell_error(sh, "out of memory: the page is without its answers");
    const file_report report = {.direct = !r->log.regular, .size = (unsigned long long)r->log.length};
    if (tells && !r->lost)
        target_report(sh, r->log.name, &report);
    free_recorder(r);
    return true;
}

/* The length of a line before its `record` statement: this record does not get the answers to the rest. */
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

/* The reader of lines has made blanks of the \ at the ends of physical lines. */
void record_line(shell *sh, const char *text, size_t len) {
    struct recorder *r = sh->record;
    if (!r)
        return;
    fflush(sh->out);
    len = until_record(text, len);
    if (r->page.to && len > 0) {
        const bool remark = *text == '#';
        handout_put(&r->page, remark ? PAGE_WORDS : PAGE_STATEMENT, text + remark, len - remark);
        handout_put(&r->page, remark ? PAGE_WORDS : PAGE_STATEMENT, "\n", 1);
        return;
    }
    const char *prompt = "fret> ";
    for (size_t i = 0, n; i <= len && len > 0; i += n + 1, prompt = "....> ") {
        const char *end = memchr(text + i, '\n', len - i);
        n = end ? (size_t)(end - text) - i : len - i;
        fputs(prompt, r->kept);
        fwrite(text + i, 1, n, r->kept);
        fputs(end ? "\\\n" : "\n", r->kept);
    }
}

void record_aside(const char *text) {
    if (!recording)
        return;
    fflush(recording->both_out);
    keep_bytes(recording, text, strlen(text));
}

static void swap(FILE **a, FILE **b) {
    FILE *kept = *a;
    *a = *b;
    *b = kept;
}

void record_swap(shell *sh, FILE **out, FILE **err) {
    fflush(sh->out);
    fflush(sh->err);
    swap(sh->record ? &sh->record->out : &sh->out, out);
    swap(sh->record ? &sh->record->err : &sh->err, err);
}

/* ---- pages ------------------------------------------------------------------------------------- */

bool record_page(shell *sh, FILE *to, const char *title, calc_error *error) {
    fflush(sh->out);
    fflush(sh->err);
    struct recorder *r = make_recorder(sh, error);
    if (!r)
        return false;
    handout_begin(&r->page, to, title);
    r->outer = sh->record;
    r->outer_out = sh->out;
    r->outer_err = sh->err;
    take_over(sh, r);
    return true;
}

bool record_page_end(shell *sh, calc_error *error) {
    struct recorder *r = sh->record;
    fflush(sh->out);
    fflush(sh->err);
    fflush(r->kept);
    sh->out = r->outer_out;
    sh->err = r->outer_err;
    sh->record = recording = r->outer;
    return free_recorder(r) || calc_no_memory(error);
}

void record_tell(shell *sh, const char *text) {
    if (record_alone(sh))
        report_outside(sh->record, text);
}

bool record_on_page(const shell *sh) {
    return sh->record && sh->record->page.to;
}

bool record_alone(const shell *sh) {
    return sh->record && sh->record->outer_out;
}

static void set_apart(shell *sh, bool apart) {
    struct recorder *r = sh->record;
    if (!record_on_page(sh))
        return;
    fflush(sh->out);
    fflush(sh->err);
    fflush(r->kept);
    r->apart = apart;
}

void record_replace(shell *sh, page_part part, const char *text) {
    set_apart(sh, true);
    if (record_on_page(sh))
        handout_put(&sh->record->page, part, text, strlen(text));
}

void record_replaced(shell *sh) {
    set_apart(sh, false);
}

/* ---- typed lines -------------------------------------------------------------------------------- */

/* Ends the physical lines of a continued line in \ again. */
void typed_keep(shell *sh, const char *line) {
    for (const char *p = line; *p; p++) {
        if (*p == '\n')
            putc('\\', sh->typed.to);
        putc(*p, sh->typed.to);
    }
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
