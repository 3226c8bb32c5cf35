/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The interactive session: line editing, history, completion. */
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <readline/history.h>
#include <readline/readline.h>

#include "shell/command.h"

static const shell *completing; /* readline's callbacks carry no context */

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

/* $XDG_STATE_HOME/fret/history, or the same under the home directory; false: keep none. */
static bool history_file(char *path, size_t size) {
    const char *state = getenv("XDG_STATE_HOME"), *home = getenv("HOME");
    char dir[1000];
    if (state && *state)
        snprintf(dir, sizeof dir, "%s", state);
    else if (home && *home)
        snprintf(dir, sizeof dir, "%s/.local/state", home);
    else
        return false;
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
    snprintf(path, size, "%s/history", dir);
    FILE *f = fopen(path, "a");
    if (!f)
        return false;
    fclose(f);
    chmod(path, 0600);
    return true;
}

static void read_startup(shell *sh) {
    const char *config = getenv("XDG_CONFIG_HOME"), *home = getenv("HOME");
    char path[1100] = "";
    if (config && *config)
        snprintf(path, sizeof path, "%s/fret/fretrc", config);
    else if (home && *home)
        snprintf(path, sizeof path, "%s/.config/fret/fretrc", home);
    if (*path && !access(path, R_OK))
        shell_file(sh, path, true);
}

static char *join(char *a, const char *b) {
    size_t n = strlen(a);
    char *both = realloc(a, n + strlen(b) + 2);
    if (!both) {
        free(a);
        return NULL;
    }
    both[n] = '\n';
    strcpy(both + n + 1, b);
    return both;
}

int shell_prompt(shell *sh, bool quiet, bool read_rc) {
    char path[1200];
    source from = {NULL, true};
    sh->interactive = true;
    completing = sh;
    rl_readline_name = "fret";
    rl_getc_function = read_key;
    rl_attempted_completion_function = complete;
    rl_completion_word_break_hook = word_breaks;
    rl_catch_signals = 0;
    using_history();
    bool keep = history_file(path, sizeof path);
    if (keep)
        read_history(path);
    if (read_rc)
        read_startup(sh);
    if (!quiet && !sh->quit)
        fprintf(
            sh->out,
            "fret: partial-slip contact of graded elastic solids. `help` helps, `demo` plays a session.\n");
    while (!sh->quit) {
        fflush(sh->out);
        shell_stop = 0;
        char *line = readline("fret> ");
        while (line && !shell_stop && shell_continues(line, strlen(line))) {
            char *more = readline("....> ");
            line[strlen(line) - 1] = ' ';
            if (!more)
                break;
            line = join(line, more);
            free(more);
        }
        if (shell_stop) { /* Ctrl-C drops the line */
            fputc('\n', sh->out);
            free(line);
            rl_callback_sigcleanup();
            continue;
        }
        if (!line) {
            fputc('\n', sh->out);
            break;
        }
        if (line[strspn(line, " \t")]) {
            add_history(line);
            if (keep) /* before it runs: a crash must not lose it */
                append_history(1, path);
            shell_line(sh, &from, line, strlen(line), 1);
        }
        free(line);
    }
    fflush(sh->out);
    return EXIT_OK;
}
