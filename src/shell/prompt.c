/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The interactive session. */
#include "shell/prompt.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

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
    source from = {NULL, true};
    sh->interactive = true;
    prompt_begin(sh);
    if (read_rc)
        read_startup(sh);
    if (!quiet && !sh->quit)
        fputs("fret: partial-slip contact of graded elastic solids; try `demo` or `help`.\n", sh->out);
    while (!sh->quit) {
        fflush(sh->out);
        shell_stop = 0;
        char *line = prompt_line("fret> ");
        while (line && !shell_stop && shell_continues(line, strlen(line))) {
            char *more = prompt_line("....> ");
            line[strlen(line) - 1] = ' ';
            if (!more)
                break;
            line = join(line, more);
            free(more);
        }
        if (shell_stop) { /* Ctrl-C drops the line */
            fputc('\n', sh->out);
            free(line);
            prompt_dropped();
            continue;
        }
        if (!line) {
            fputc('\n', sh->out);
            break;
        }
        if (line[strspn(line, " \t")]) {
            prompt_keep(line); /* before it runs: a crash must not lose it */
            shell_line(sh, &from, line, strlen(line), 1);
        }
        free(line);
    }
    fflush(sh->out);
    return EXIT_OK;
}
