/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reads lessons from files, and reports what is wrong with one before it is played. */
#include "prompt/lesson.h"

#include <stdlib.h>
#include <string.h>

#include "number/array.h"
#include "text/characters.h"
#include "text/lines.h"

enum {
    LESSON_LINE = 400, /* most bytes of a line */
    MISTAKES = 20      /* most mistakes that are reported */
};

/* A statement that ends with this comment must fail. */
#define REFUSED "# refused"

typedef struct reading {
    shell *sh, *trial; /* trial: the session that runs the statements; both NULL: lesson_lines */
    source from;
    lesson_text *out;
    bool transcript; /* a prompt has been seen: lines without one are answers */
    size_t statements, mistakes;
    calc_error *error;
} reading;

static void drop_lines(lesson_text *t) {
    while (t->count > 0)
        free(t->line[--t->count]);
}

void lesson_free(lesson_text *t) {
    drop_lines(t);
    free(t->line);
    free(t->title);
}

/* Reports a mistake in line `number`, which is `text`. Returns true: the reading goes on. */
static bool tell_mistake(reading *r, const char *text, size_t number, calc_error *mistake) {
    shell_report(r->sh, &r->from, text, strlen(text), number, mistake->at, mistake);
    r->mistakes++;
    return true;
}

/* Is the line short enough, and does a terminal show each of its characters? Reports a mistake. */
static bool check_line(reading *r, const char *text, size_t len, size_t number) {
    calc_error *const mistake = error_quiet();
    if (len > LESSON_LINE)
        calc_raise(mistake, LESSON_LINE, 1, "a line of a lesson has at most %d bytes", LESSON_LINE);
    for (size_t i = 0, n; i < len && !mistake->raised; i += n) {
        unsigned code;
        n = character_at(text + i, len - i, &code);
        if (!n || !character_shows(code))
            calc_raise(mistake, i, 1, "a character that cannot be shown");
    }
    return !mistake->raised || !tell_mistake(r, text, number, mistake);
}

/* Runs a line and reports a mistake; false: Ctrl-C or no memory. */
static bool check_statements(reading *r, const char *text, size_t number) {
    calc_error *const mistake = error_quiet();
    const size_t len = strlen(text), end = sizeof REFUSED - 1;
    const bool meant = len >= end && !strcmp(text + len - end, REFUSED);
    bool ok = true;
    r->statements++;
    for (size_t i = 0, next; i < len && text[i] != '#' && ok; i = next + (next < len && text[next] == ';')) {
        next = shell_statement_end(text, i, len);
        ok = shell_statement(r->trial, text + i, next - i, mistake);
        if (shell_stop || mistake->stop)
            return shell_stop ? calc_interrupted(r->error) : calc_no_memory(r->error);
        if (!ok && !meant) {
            calc_word(&r->trial->calc, mistake);
            if (!mistake->raised) /* a nested file has reported its own error */
                calc_raise(mistake, 0, 0, "the file that it runs fails");
            mistake->at += i;
            return tell_mistake(r, text, number, mistake);
        }
    }
    error_clear(mistake);
    if (r->trial->quit)
        calc_raise(mistake, 0, len, "a lesson does not end the session");
    else if (ok && meant)
        calc_raise(mistake, 0, len, "this is not refused, as `# refused` says");
    r->trial->quit = false;
    return !mistake->raised || tell_mistake(r, text, number, mistake);
}

static bool add_line(reading *r, const char *text) {
    lesson_text *t = r->out;
    if (!fret_array_room(&t->line, &t->room, t->count + 2, sizeof *t->line))
        return calc_no_memory(r->error);
    t->line[t->count] = strdup(text);
    t->line[t->count + 1] = NULL;
    return t->line[t->count++] || calc_no_memory(r->error);
}

static bool take_title(reading *r, const char *text, size_t number) {
    calc_error *const mistake = error_quiet();
    if (r->transcript) {
        calc_raise(mistake, 0, 0, "a lesson begins with its title, in a line of its own");
        tell_mistake(r, text, number, mistake);
    }
    const char *title = text + strspn(text, "# ");
    r->out->title = strdup(r->transcript ? "" : title);
    return r->out->title || calc_no_memory(r->error);
}

/* Takes a logical line, newlines and tabs as blanks. False: the reading cannot go on. */
static bool take_line(reading *r, file_in *in) {
    size_t len = in->length;
    const bool prompt = begins_with_prompt(in->line, len);
    const size_t before = prompt ? (size_t)(strip_prompt(in->line, &len) - in->line) : 0;
    if (!r->trial && prompt && !r->transcript) /* the first prompt: the lines before are no statements */
        drop_lines(r->out);
    r->transcript = r->transcript || prompt;
    if (r->transcript && !prompt && (r->out->title || !r->trial))
        return true;
    if (file_in_rest(in, r->error) != FILE_GOT_LINE)
        return false;
    char *line = in->line + before;
    len = in->length - before;
    for (size_t i = 0; i < len; i++)
        if (line[i] == '\t' || line[i] == '\r' || line[i] == '\n')
            line[i] = ' ';
    while (len > 0 && line[len - 1] == ' ')
        len--;
    line[len] = 0;
    if (!r->trial)
        return add_line(r, line + strspn(line, " "));
    const size_t number = (size_t)in->number;
    if (!check_line(r, line, len, number))
        return true;
    if (!*line && !r->out->count) /* empty lines around the title */
        return true;
    if (!r->out->title && (!take_title(r, line, number) || !r->transcript))
        return r->out->title != NULL;
    return (line_is_remark(line) || check_statements(r, line, number)) && add_line(r, line);
}

static bool read_lines(reading *r, file_in *in) {
    file_got got = FILE_GOT_END;
    bool ok = true;
    while (ok && r->mistakes < MISTAKES && (got = file_in_line(in, r->error)) == FILE_GOT_LINE)
        ok = take_line(r, in);
    if (shell_stop)
        return calc_interrupted(r->error);
    if (!ok || got == FILE_GOT_ERROR)
        return false;
    if (!r->trial)
        return true;
    if (r->mistakes)
        return calc_fail(r->error, 0, 0, "%zu mistake%s in %s: it is not played", r->mistakes,
                         r->mistakes == 1         ? ""
                         : r->mistakes < MISTAKES ? "s"
                                                  : "s or more",
                         in->name);
    return r->statements || calc_fail(r->error, 0, 0,
                                      "%s holds no statement: help lessons tells what a "
                                      "lesson is",
                                      in->name);
}

static bool read_file(reading *r, const char *path) {
    file_in in;
    *r->out = (lesson_text){.line = calloc(1, sizeof *r->out->line), .room = 1};
    if (!r->out->line)
        return calc_no_memory(r->error);
    if (!file_in_open(&in, path, &shell_stop, r->error))
        return false;
    const bool ok = read_lines(r, &in);
    file_in_close(&in);
    return ok;
}

bool lesson_lines(const char *path, lesson_text *out, calc_error *error) {
    return read_file(&(reading){.out = out, .error = error}, path);
}

bool lesson_read(shell *sh, const char *path, lesson_text *out, calc_error *error) {
    enum { NESTING = 4 };
    static int nesting; /* a lesson may `demo` another */
    shell trial;
    reading r = {.sh = sh, .trial = &trial, .out = out, .from = {path, true}, .error = error};
    FILE *nowhere = shell_nowhere(error);
    *out = (lesson_text){.title = NULL};
    if (!nowhere)
        return false;
    if (nesting == NESTING)
        return calc_fail(error, 0, 0, "lessons are nested more than %d deep", NESTING);
    shell_init(&trial, nowhere, nowhere);
    trial.replaying = true; /* so that nothing is drawn, asked or recorded */
    nesting++;
    const bool ok = read_file(&r, path);
    nesting--;
    shell_free(&trial);
    return ok;
}
