/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The interactive session: typed and pasted lines become statements. */
#include "prompt/prompt.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "statement/output.h"
#include "statement/record.h"
#include "text/lines.h"

/* A relative path is none, as the XDG specification has it: what lies in the current directory may be a
 * stranger's. Nothing is said of a file that is not there. */
static void read_startup(shell *sh) {
    const char *config = getenv("XDG_CONFIG_HOME"), *home = getenv("HOME");
    char path[4096];
    int n = 0;
    if (config && *config == '/')
        n = snprintf(path, sizeof path, "%s/fret/fretrc", config);
    else if (home)
        n = snprintf(path, sizeof path, "%s/.config/fret/fretrc", home);
    if (n > 0 && n < (int)sizeof path && (!access(path, F_OK) || (errno != ENOENT && errno != ENOTDIR)))
        shell_file(sh, path, true);
}

/* ---- lines ------------------------------------------------------------------------------------- */

/* What has been typed or pasted and not been run yet. */
typedef struct typed {
    char *text, *next;
    bool transcript; /* some of its lines begin with a prompt: the others are answers */
    bool shows;      /* its lines one by one, as if typed */
    bool lost;       /* there was no memory for a line */
    size_t answers;  /* left out */
} typed;

static void forget(typed *t) {
    free(t->text);
    *t = (typed){.text = NULL};
}

static bool is_transcript(const char *text) {
    bool prompts = false;
    const char *line = text;
    for (; *line && !prompts; line += line[strcspn(line, "\n")] ? strcspn(line, "\n") + 1 : strlen(line)) {
        size_t len = strcspn(line, "\n");
        prompts = strip_prompt(line, &len) != line;
    }
    return prompts && strchr(text, '\n');
}

/* The next line, asked for where none is waiting; NULL: the end, or Ctrl-C. */
static const char *next_line(typed *t, const char *prompt, bool continued, size_t *len) {
    for (;;) {
        if (!t->next) {
            forget(t);
            t->text = prompt_line(prompt);
            if (!t->text || shell_stop)
                return NULL;
            t->next = t->text;
            t->transcript = is_transcript(t->text);
            t->shows = strchr(t->text, '\n') && prompt_erase(t->text);
        }
        const char *line = t->next;
        *len = strcspn(line, "\n");
        t->next = line[*len] && line[*len + 1] ? t->next + *len + 1 : NULL;
        const char *text = strip_prompt(line, len);
        while (*len > 0 && text[*len - 1] == '\r')
            --*len;
        if (text != line || !t->transcript || continued) {
            if (t->shows) {
                fputs(prompt, record_terminal());
                print_safe(record_terminal(), text, *len);
                putc('\n', record_terminal());
            }
            return text;
        }
        t->answers += *len > 0;
        if (!t->next) {
            *len = 0;
            return "";
        }
    }
}

/* to: the lines before, or NULL. NULL: out of memory, and they are freed. */
static char *append_line(char *to, size_t *size, const char *line, size_t len) {
    char *grown = realloc(to, *size + len + 2);
    if (!grown) {
        free(to);
        return NULL;
    }
    if (to)
        grown[(*size)++] = '\n';
    memcpy(grown + *size, line, len);
    *size += len;
    grown[*size] = 0;
    return grown;
}

/* A line with those that continue it; NULL: the end, Ctrl-C, or no memory, which is told apart by t->lost. */
static char *logical_line(typed *t) {
    size_t len, size = 0;
    const char *line = next_line(t, "fret> ", false, &len);
    char *whole = line ? append_line(NULL, &size, line, len) : NULL;
    while (whole && shell_continues(whole, size)) {
        line = next_line(t, "....> ", true, &len);
        whole[size - 1] = ' ';
        if (!line)
            break;
        whole = append_line(whole, &size, line, len);
    }
    t->lost = line && !whole;
    return whole;
}

/* ---- what is for the prompt alone -------------------------------------------------------------- */

/* `!COMMAND`. */
static void run_system(shell *sh, const char *line) {
    fflush(sh->out);
    const int status = system(line);
    if (status == -1)
        shell_say(sh, "the system's shell fails: %s", strerror(errno));
    else if (status != 0)
        shell_say(sh, "the command ended with status %d", status > 255 ? status / 256 : status);
}

bool shell_special(shell *sh, const source *from, const char *text) {
    char help[256];
    text += strspn(text, " \t\n");
    record_line(sh, text, strlen(text));
    if (*text != '!' && *text != '?')
        return false;
    if (*text == '!' && sh->replaying) { /* what it wrote went past the session */
        fprintf(sh->out, "%c\n", MARK_DRAWING);
    } else if (*text == '!') {
        run_system(sh, text + 1);
    } else {
        snprintf(help, sizeof help, "help %.240s", text + 1);
        shell_line(sh, from, help, strlen(help), 1);
    }
    return true;
}

static void run_line(shell *sh, const char *line) {
    static const source from = {NULL, true};
    const char *text = line + strspn(line, " \t\n");
    if (!*text)
        return;
    prompt_keep(text); /* before it runs: a crash must not lose it */
    typed_keep(sh, text);
    if (!shell_special(sh, &from, text))
        shell_line(sh, &from, text, strlen(text), 1);
}

int shell_prompt(shell *sh, bool quiet, bool read_rc) {
    typed waiting = {.text = NULL};
    sh->interactive = true;
    sh->set.pages = isatty(STDOUT_FILENO);
    if (read_rc)
        read_startup(sh);
    if (!file_text_open(&sh->typed)) {
        shell_error(sh, "out of memory");
        return EXIT_ERROR;
    }
    prompt_begin(sh);
    if (!quiet && !sh->quit)
        fputs("fret: partial-slip contact of graded elastic solids; try `demo` or `help`.\n", sh->out);
    while (!sh->quit) {
        fflush(sh->out);
        shell_stop = 0;
        char *line = logical_line(&waiting);
        if (shell_stop) { /* Ctrl-C drops the line */
            free(line);
            forget(&waiting);
            prompt_dropped();
            continue;
        }
        if (!line && waiting.lost) {
            shell_error(sh, "out of memory: the line is dropped");
            forget(&waiting);
            continue;
        }
        if (!line)
            break;
        if (waiting.answers > 0 && !waiting.next)
            shell_say(sh, PASTED "%zu line%s without a prompt taken for answers", waiting.answers,
                      waiting.answers == 1 ? "" : "s");
        run_line(sh, line);
        free(line);
        if (shell_stop) /* what was pasted behind it is dropped too */
            forget(&waiting);
    }
    forget(&waiting);
    fflush(sh->out);
    return EXIT_OK;
}
