/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The interactive session: reads typed and pasted lines and runs them. */
#include "prompt/prompt.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "statement/record.h"
#include "text/lines.h"

/* Runs the start-up file; one that does not exist is no error. */
static void read_startup(shell *sh) {
    char path[FILE_PATH];
    const bool before = sh->keep_going;
    sh->keep_going = true;
    if (file_own_path(path, "XDG_CONFIG_HOME", ".config", "fretrc") &&
        (!access(path, F_OK) || (errno != ENOENT && errno != ENOTDIR)))
        shell_run(sh, path, NULL);
    sh->keep_going = before;
}

/* The callback by which text/file_in gets a typed line. */
static char *ask(bool continued) {
    char *text = prompt_line(continued ? "....> " : "fret> ", continued);
    if (text && shell_stop) {
        free(text);
        text = NULL;
    }
    if (text)
        paste_lines(text, continued);
    return text;
}

/* ---- lines for the prompt alone ---------------------------------------------------------------- */

/* Runs `!COMMAND` by the system's shell. */
static void run_system(shell *sh, const char *line) {
    fflush(sh->out);
    const int status = system(line);
    if (status == -1)
        shell_say(sh, "the system's shell fails: %s", strerror(errno));
    else if (status != 0)
        shell_say(sh, "the command ended with status %d", status > 255 ? status / 256 : status);
}

void shell_typed(shell *sh, const char *text, size_t len, size_t line) {
    static const source from = {NULL, true};
    const char *typed = text + strspn(text, " \t\n");
    char help[256];
    record_line(sh, typed, strlen(typed));
    if (*typed == '!' && sh->replaying) { /* not run again; its output may stand in the transcript */
        fprintf(sh->out, "%c\n", MARK_DRAWING);
    } else if (*typed == '!') {
        run_system(sh, typed + 1);
    } else if (*typed == '?') {
        snprintf(help, sizeof help, "help %.240s", typed + 1);
        shell_line(sh, &from, help, strlen(help), 1);
    } else {
        shell_line(sh, &from, text, len, line);
    }
}

static void run_line(shell *sh, const char *line) {
    const char *text = line + strspn(line, " \t\n");
    if (!*text)
        return;
    prompt_keep(text); /* before it runs: a crash must not lose it */
    typed_keep(sh, text);
    shell_typed(sh, text, strlen(text), 1);
}

int shell_prompt(shell *sh, bool quiet, bool read_rc) {
    calc_error error = ERROR_NONE;
    file_in in;
    file_got got = FILE_GOT_LINE;
    sh->interactive = true;
    sh->set.pages = isatty(STDOUT_FILENO);
    if (read_rc)
        read_startup(sh);
    if (!file_text_open(&sh->typed) || !file_in_typed(&in, ask, &shell_stop, &error)) {
        shell_error(sh, "out of memory");
        return EXIT_ERROR;
    }
    prompt_begin(sh);
    if (!quiet && !sh->quit)
        fputs("fret: partial-slip contact of graded elastic solids; try `demo` or `help`.\n", sh->out);
    while (!sh->quit && got != FILE_GOT_END) {
        fflush(sh->out);
        shell_stop = 0;
        error_clear(&error);
        got = file_in_logical(&in, &error);
        if (got == FILE_GOT_LINE)
            run_line(sh, in.line);
        else if (got == FILE_GOT_ERROR)
            shell_error(sh, error.text);
        if (got != FILE_GOT_LINE || shell_stop) /* Ctrl-C drops the line and the rest of a paste */
            prompt_drop();
    }
    file_in_close(&in);
    fflush(sh->out);
    return EXIT_OK;
}
