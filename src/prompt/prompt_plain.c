/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Lines as the terminal gives them: no editing but its own, no history. */
#include <stdlib.h>

#include "prompt/prompt.h"
#include "statement/record.h"

void prompt_begin(shell *sh) {
    (void)sh;
}

char *prompt_line(const char *text) {
    char *line = NULL;
    size_t room = 0;
    FILE *to = record_terminal();
    fputs(text, to);
    fflush(to);
    ssize_t n = getline(&line, &room, stdin);
    if (n < 0) {
        clearerr(stdin); /* Ctrl-C is no error of the stream */
        fputc('\n', to);
        free(line);
        return NULL;
    }
    if (to != stdout) /* the terminal itself has shown it */
        record_aside(line);
    if (n > 0 && line[n - 1] == '\n')
        line[n - 1] = 0;
    return line;
}

bool prompt_erase(const char *text) {
    (void)text;
    return false;
}

void prompt_dropped(void) {
}

void prompt_keep(const char *line) {
    (void)line;
}
