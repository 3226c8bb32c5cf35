/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Replays a transcript as a test: runs the lines after `fret> ` and compares the answers. Lines that depend
 * on the user, the terminal or the clock may be missing, so a copy of a terminal will do as well. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "statement/output.h"
#include "statement/record.h"
#include "statement/text.h"
#include "text/lines.h"
#include "text/typeset.h"

/* ---- lines ------------------------------------------------------------------------------------- */

static bool starts_number(const char *s) {
    return (*s >= '0' && *s <= '9') || (*s == '.' && s[1] >= '0' && s[1] <= '9');
}

/* One unit in the last printed place of the number from s to end. */
static double last_place(const char *s, const char *end) {
    int places = 0;
    bool point = false;
    const char *e = end;
    for (const char *p = s; p < end; p++) {
        if (*p == 'e' || *p == 'E') {
            e = p;
            break;
        }
        places += point;
        point = point || *p == '.';
    }
    return pow(10, (e < end ? strtod(e + 1, NULL) : 0) - places);
}

/* Behind the file and line of a JSON error: a replay has neither. */
static const char *behind_place(const char *at) {
    const char *place = !strncmp(at, "\"file\":\"", 8) ? strstr(at, "\"column\":") : NULL;
    return place ? place : at;
}

/* Is the text equal, and does each number agree to the digits that `want` shows, or within the tolerance? */
static bool same_plainly(const char *want, const char *got, double tolerance) {
    while (*(want = behind_place(want)) && *(got = behind_place(got))) {
        if (starts_number(want) && starts_number(got)) {
            char *we, *ge;
            double w = strtod(want, &we), g = strtod(got, &ge);
            if (fabs(w - g) > fmax(0.500001 * last_place(want, we), tolerance * fabs(w)))
                return false;
            want = we;
            got = ge;
        } else if (*want++ != *got++) {
            return false;
        }
    }
    return *want == *got;
}

/* The line without the `FILE:LINE:COLUMN: ` of an error: a replay has other places. */
static const char *without_place(const char *line) {
    const char *error = strstr(line, ": error: ");
    const char *p = error;
    for (int colons = 0; p && p > line && colons < 2; p--)
        if (p[-1] == ':')
            colons++;
        else if (p[-1] < '0' || p[-1] > '9')
            return line;
    return error && p > line ? error + 2 : line;
}

/* The same, also if a formula was typeset in one locale and not in the other, or the place differs. */
static bool same(const char *want, const char *got, double tolerance) {
    enum { FORMULA = 600 };
    char set[2][FORMULA];
    if (same_plainly(want, got, tolerance) ||
        same_plainly(without_place(want), without_place(got), tolerance))
        return true;
    if (strlen(want) >= FORMULA / 3 || strlen(got) >= FORMULA / 3)
        return false;
    typeset(want, set[0], FORMULA);
    typeset(got, set[1], FORMULA);
    return same_plainly(set[0], set[1], tolerance);
}

/* The length of the line without blanks and carriage returns at its end. */
static size_t line_length(const char *line) {
    size_t n = strcspn(line, "\n");
    while (n > 0 && (line[n - 1] == ' ' || line[n - 1] == '\r'))
        n--;
    return n;
}

static char *line_after(char *line) {
    line += strcspn(line, "\n");
    return line + (*line != 0);
}

/* Compares the first lines of two texts, each ended by a NUL meanwhile. */
static bool same_lines(char *want, char *got, double tolerance) {
    char *const ends[] = {want + line_length(want), got + line_length(got)};
    const char were[] = {*ends[0], *ends[1]};
    *ends[0] = *ends[1] = 0;
    const bool ok = same(want, got, tolerance);
    *ends[0] = were[0];
    *ends[1] = were[1];
    return ok;
}

static bool is_blank(const char *text) {
    return strspn(text, " \r\n") == strlen(text);
}

static bool begins(const char *line, const char *words) {
    return !strncmp(line, words, strlen(words));
}

/* Does the line differ from run to run: a time, a guess, whether a file existed? */
static bool varies(const char *line) {
    const char *note = "{\"note\":\"";
    line += begins(line, note) ? strlen(note) : 0;
    return begins(line, "time: ") || begins(line, "wrote ") || begins(line, "overwrote ") ||
           begins(line, PASTED) || begins(line, "guess> ") || begins(line, "guess: ");
}

/* Compares line by line, but for optional lines (MARK_ASIDE), drawings and empty lines at the end. */
static bool compare(char *want, char *got, double tolerance) {
    while (*want || *got) {
        if (varies(want)) {
            want = line_after(want);
        } else if (varies(got)) {
            got = line_after(got);
        } else if (*got == MARK_ASIDE) {
            if (*want && same_lines(want, got + 1, tolerance))
                want = line_after(want);
            got = line_after(got);
        } else if (*got == MARK_DRAWING) {
            char *rest = line_after(got);
            while (*want && !compare(want, rest, tolerance))
                want = line_after(want);
            got = rest;
        } else if (!*got || !*want) {
            return is_blank(want) && is_blank(got);
        } else if (same_lines(want, got, tolerance)) {
            want = line_after(want);
            got = line_after(got);
        } else {
            return false;
        }
    }
    return true;
}

/* ---- a statement ------------------------------------------------------------------------------- */

typedef struct replay {
    shell sh; /* first: find_wish finds the replay by it */
    FILE *out;
    double tolerance;
    const char *path;
    size_t passed, failed;
    file_in in;
    file_got read; /* what reading the last line came to */
    bool held;     /* the last line is not taken yet */
    calc_error *error;
    char *statement;
    size_t length;
    file_text want; /* the answer in the transcript; open from a statement to the next */
    size_t at;      /* line number of the statement; 0: none yet */
    bool waits;     /* not run yet: it is run if an answer follows */
    size_t prompts; /* prompts in its output (of a demo): these begin no statement */
    size_t seen;    /* prompts in the answer in the transcript, so far */
    file_text run;  /* the answer of this run, while it grows */
    char *got;      /* complete */
} replay;

static void show(FILE *out, char mark, char *line, bool asides) {
    for (; *line; line = line_after(line)) {
        if (*line == MARK_DRAWING || (*line == MARK_ASIDE && !asides))
            continue;
        line += *line == MARK_ASIDE;
        fprintf(out, "%c ", mark);
        print_safe(out, line, strcspn(line, "\n"));
        putc('\n', out);
    }
}

/* Counts the lines that a transcript must have: no asides, drawings or times. */
static size_t count_lines(char *line) {
    size_t count = 0;
    for (; *line; line = line_after(line))
        count += *line != MARK_ASIDE && *line != MARK_DRAWING && line_length(line) > 0 && !varies(line);
    return count;
}

static size_t count_prompts(char *line) {
    size_t count = 0;
    for (; *line; line = line_after(line))
        count += begins_with_prompt(line, strcspn(line, "\n"));
    return count;
}

/* Reads a line, unless one is held. False: there is none. */
static bool hold_line(replay *r) {
    if (!r->held && r->read == FILE_GOT_LINE)
        r->held = (r->read = file_in_line(&r->in, r->error)) == FILE_GOT_LINE;
    return r->held;
}

/* Does the line held begin a statement, rather than one of a lesson that has shown it? */
static bool begins_another(const replay *r) {
    return r->seen == r->prompts && begins_with_prompt(r->in.line, r->in.length);
}

/* Takes the line held as one of the answer. */
static void take_answer(replay *r) {
    r->seen += begins_with_prompt(r->in.line, r->in.length);
    if (r->at)
        fprintf(r->want.to, "%s\n", r->in.line);
    r->held = false;
}

/* Reads the answer on, until it tells of this step or a later one, or has a prompt not shown yet. */
static wish find_wish(shell *sh, unsigned step) {
    replay *r = (replay *)sh;
    char what;
    unsigned at;
    fflush(sh->out);
    r->run.text[r->run.size] = 0;
    for (r->prompts = count_prompts(r->run.text); r->want.to && hold_line(r); take_answer(r))
        if (sscanf(r->in.line, "(%c%*3s at step %u)", &what, &at) == 2) {
            if (at != step)
                break;
            take_answer(r);
            return what == 'b' ? GO_BACK : LEAVE;
        } else if (begins_another(r)) {
            break;
        }
    return GO_ON;
}

/* Runs the statement. False: out of memory. */
static bool run_statement(replay *r) {
    free(r->got);
    r->got = NULL;
    r->seen = 0;
    if (!file_text_open(&r->run))
        return false;
    r->sh.out = r->sh.err = r->run.to;
    r->sh.quit = false;
    shell_typed(&r->sh, r->statement, r->length, r->at);
    if (!file_text_close(&r->run))
        return false;
    r->got = r->run.text;
    if (r->sh.stopped && !shell_stop)
        return false; /* out of memory */
    r->prompts = count_prompts(r->got);
    return true;
}

/* Does the statement end in ^C, like a line dropped by Ctrl-C? If an answer follows, it was run after all. */
static bool seems_dropped(const replay *r) {
    static const char end[] = "^C";
    const size_t n = sizeof end - 1, len = r->length;
    size_t own;
    return len >= n && !strcmp(r->statement + len - n, end) &&
           (len == n || !names_find(&r->sh.calc.names, end + 1, 1, &own));
}

/* False: out of memory. */
static bool begin_statement(replay *r, const char *text, size_t len) {
    free(r->statement);
    r->statement = malloc(len + 1);
    if (!r->statement || !file_text_open(&r->want))
        return false;
    memcpy(r->statement, text, len + 1);
    r->length = len;
    r->waits = seems_dropped(r);
    return r->waits || run_statement(r);
}

/* Makes notes and warnings optional after a statement that a recording put at its beginning. */
static void spare_notes(replay *r) {
    const size_t n = strlen(RECORD_GIVEN), len = r->length;
    if (len < n || strcmp(r->statement + len - n, RECORD_GIVEN) != 0)
        return;
    for (char *line = r->got; *line; line = line_after(line))
        if (begins(line, "note: ") || begins(line, "warning: "))
            *line = MARK_ASIDE;
}

static bool judge(replay *r, char *want) {
    if (shell_stop || (r->waits && is_blank(want))) /* interrupted now, or when the line was typed */
        return true;
    if (r->waits && !run_statement(r))
        return false;
    spare_notes(r);
    if (compare(want, r->got, r->tolerance)) {
        r->passed++;
    } else {
        r->failed++;
        print_safe(r->out, r->path, strlen(r->path));
        fprintf(r->out, ":%zu: fret> ", r->at);
        print_safe(r->out, r->statement, r->length);
        putc('\n', r->out);
        show(r->out, '-', want, false);
        show(r->out, '+', r->got, count_lines(want) > count_lines(r->got)); /* `want` has asides */
    }
    return true;
}

/* The answer to the statement, if there is one, is complete: compares it. False: out of memory. */
static bool judge_answer(replay *r) {
    if (!r->want.to)
        return true;
    if (!file_text_close(&r->want))
        return false;
    const bool ok = judge(r, r->want.text);
    free(r->want.text);
    return ok;
}

/* ---- the transcript ---------------------------------------------------------------------------- */

static bool take_line(replay *r) {
    file_in *in = &r->in;
    if (!begins_another(r)) {
        take_answer(r);
        return true;
    }
    size_t n = in->length;
    const size_t before = (size_t)(strip_prompt(in->line, &n) - in->line);
    r->held = false;
    if (!judge_answer(r) || file_in_rest(in, r->error) != FILE_GOT_LINE)
        return false;
    r->at = (size_t)in->number;
    return begin_statement(r, in->line + before, in->length - before);
}

static bool take_lines(replay *r) {
    bool ok = true;
    while (ok && !shell_stop && hold_line(r))
        ok = take_line(r);
    if (ok && r->read != FILE_GOT_ERROR)
        ok = judge_answer(r);
    if (!ok && !shell_stop)
        calc_no_memory(r->error); /* does nothing if an error was raised before */
    if (ok && r->read == FILE_GOT_END && r->passed + r->failed == 0)
        ok = calc_fail(r->error, 0, 0, "%s holds no lines that begin with `fret> `", r->path);
    return ok && r->read != FILE_GOT_ERROR;
}

int shell_replay(const shell *sh, const char *path, double tolerance, calc_error *error) {
    static int nesting; /* a transcript may replay others */
    enum { NESTING = 8 };
    replay r = {.tolerance = tolerance, .path = path, .in.fd = -1, .read = FILE_GOT_LINE, .error = error};
    text_out t;
    if (nesting == NESTING)
        calc_raise(error, 0, 0, "transcripts are nested more than %d deep", NESTING);
    else if (file_in_script(&r.in, path, &shell_stop, error) && !text_begin(&t, sh, TEXT_PICTURE, error))
        file_in_close(&r.in);
    if (error->raised)
        return EXIT_ERROR;
    r.out = t.to;
    shell_init(&r.sh, sh->out, sh->out);
    r.sh.replaying = true;
    r.sh.replayed = find_wish;
    nesting++;
    bool ok = take_lines(&r);
    nesting--;
    if (ok && !shell_stop) {
        print_safe(r.out, path, strlen(path));
        fprintf(r.out, ": %zu passed, %zu failed\n", r.passed, r.failed);
    }
    if (shell_stop)
        calc_interrupted(error);
    ok &= text_end(&t, true);
    file_in_close(&r.in);
    r.sh.out = r.sh.err = sh->out;
    shell_free(&r.sh);
    if (r.want.to && file_text_close(&r.want))
        free(r.want.text);
    free(r.statement);
    free(r.got);
    return shell_stop ? EXIT_INTERRUPTED : ok && !r.failed ? EXIT_OK : EXIT_ERROR;
}
