/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Lines by readline: editing, history, completion. */
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <readline/history.h>
#include <readline/readline.h>

#include "shell/command.h"
#include "shell/prompt.h"

/* readline's callbacks carry no context */
static const shell *completing;
static char history_path[1200]; /* empty: none is kept */

/* readline's own getc restarts after a signal: Ctrl-C would not be seen before the next key. */
static int read_key(FILE *in) {
    unsigned char c;
    for (;;) {
        if (shell_stop)
            return EOF;
        ssize_t n = read(fileno(in), &c, 1);
        if (n == 1)
            return c;
        if (n == 0 || errno != EINTR)
            return EOF;
    }
}

static const char *file_words[] = {"source", "to", NULL};

/* All words that may stand at the cursor: i counts through one list after the other. */
static const char *candidate(size_t i, bool at_start, completion kind) {
    const char *name;
    size_t n = 0;
    if (at_start || kind == COMPLETE_TOPIC) {
        while (command_name(n))
            if (n++ == i)
                return command_name(i);
        i -= n;
    }
    if (kind == COMPLETE_GEOMETRY)
        for (n = 0; geometry_row(n); n++)
            if (n == i)
                return geometry_row(n)->name;
    if (kind == COMPLETE_SETTING) {
        static const char *const words[] = {"format", "digits", "report", "timing",  "plot",
                                            "model",  "closed", "memory", "springs", "text",
                                            "csv",    "json",   "on",     "off",     "auto"};
        if (i < sizeof words / sizeof *words)
            return words[i];
        return NULL;
    }
    if (kind == COMPLETE_GEOMETRY)
        i -= n;
    for (n = 0; (name = quantity_name(n)); n++)
        if (n == i)
            return name;
    i -= n;
    for (n = 0; (name = builtin_name(n)); n++)
        if (n == i)
            return name;
    i -= n;
    return completing ? calc_variable_name(&completing->calc, i) : NULL;
}

static bool word_at_start;
static completion word_kind;

static char *next_match(const char *text, int state) {
    static size_t i;
    const char *name;
    if (!state)
        i = 0;
    while ((name = candidate(i++, word_at_start, word_kind)))
        if (!strncmp(name, text, strlen(text)))
            return strdup(name);
    return NULL;
}

/* Does the statement up to the word end in `source` or `to`, which a file name follows? */
static bool at_file(int start) {
    while (start > 0 && rl_line_buffer[start - 1] == ' ')
        start--;
    for (const char **w = file_words; *w; w++) {
        int n = (int)strlen(*w);
        if (start >= n && !strncmp(rl_line_buffer + start - n, *w, (size_t)n) &&
            (start == n || rl_line_buffer[start - n - 1] == ' ' || rl_line_buffer[start - n - 1] == ';'))
            return true;
    }
    return false;
}

/* File names and the names of geometries hold characters that end a word elsewhere. */
static char *word_breaks(void) {
    static char plain[] = " \t;,()+-*/^=:\"", loose[] = " \t;,\"";
    int start = rl_point;
    while (start > 0 && !strchr(loose, rl_line_buffer[start - 1]))
        start--;
    int before = start;
    while (before > 0 && rl_line_buffer[before - 1] == ' ')
        before--;
    bool shape = before >= 8 && !strncmp(rl_line_buffer + before - 8, "geometry", 8);
    return shape || at_file(start) ? loose : plain;
}

static char **complete(const char *text, int start, int end) {
    (void)end;
    rl_attempted_completion_over = 1;
    int begin = start;
    while (begin > 0 && rl_line_buffer[begin - 1] != ';')
        begin--;
    while (rl_line_buffer[begin] == ' ')
        begin++;
    word_at_start = begin >= start;
    size_t len = strcspn(rl_line_buffer + begin, " ");
    const command *c = word_at_start ? NULL : command_find(rl_line_buffer + begin, len);
    word_kind = c ? c->complete : COMPLETE_QUANTITY;
    if (at_file(start)) {
        rl_attempted_completion_over = 0;
        return NULL;
    }
    return rl_completion_matches(text, next_match);
}

/* $XDG_STATE_HOME/fret/history, or the same under the home directory. */
static void open_history(void) {
    const char *state = getenv("XDG_STATE_HOME"), *home = getenv("HOME");
    char dir[1000];
    if (state && *state)
        snprintf(dir, sizeof dir, "%s", state);
    else if (home && *home)
        snprintf(dir, sizeof dir, "%s/.local/state", home);
    else
        return;
    for (char *p = dir + 1; *p; p++)
        if (*p == '/') {
            *p = 0;
            mkdir(dir, 0700);
            *p = '/';
        }
    mkdir(dir, 0700);
    size_t n = strlen(dir);
    snprintf(dir + n, sizeof dir - n, "/fret");
    mkdir(dir, 0700);
    snprintf(history_path, sizeof history_path, "%s/history", dir);
    FILE *f = fopen(history_path, "a");
    if (!f) {
        *history_path = 0;
        return;
    }
    fclose(f);
    chmod(history_path, 0600);
    read_history(history_path);
}

void prompt_begin(const shell *sh) {
    completing = sh;
    rl_readline_name = "fret";
    rl_getc_function = read_key;
    rl_attempted_completion_function = complete;
    rl_completion_word_break_hook = word_breaks;
    rl_catch_signals = 0;
    using_history();
    open_history();
}

char *prompt_line(const char *text) {
    return readline(text);
}

void prompt_dropped(void) {
    rl_callback_sigcleanup();
}

void prompt_keep(const char *line) {
    add_history(line);
    if (*history_path)
        append_history(1, history_path);
}
