/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Lines without readline: only the terminal's own editing, no history. */
#include <stdlib.h>

#include "prompt/prompt.h"

void prompt_begin(shell *sh) {
    (void)sh;
}

char *prompt_line(const char *text, bool continued) {
    (void)continued;
    char *line = NULL;
    size_t room = 0;
    fputs(text, stdout);
    fflush(stdout);
    ssize_t n = getline(&line, &room, stdin);
    if (n < 0) {
        clearerr(stdin); /* a read that Ctrl-C interrupted sets the error flag */
        fputc('\n', stdout);
        free(line);
        return NULL;
    }
    if (n > 0 && line[n - 1] == '\n')
        line[n - 1] = 0;
    return line;
}

void prompt_keep(const char *line) {
    (void)line;
}

void prompt_drop(void) {
}
