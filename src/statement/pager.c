/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Gives text to $PAGER, else to less or more. Starts a program at the user's terminal. */
#include "statement/pager.h"

#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include "text/characters.h"

/* Columns that a line takes, without colours. */
static size_t columns(const char *line, size_t n) {
    size_t count = 0;
    for (size_t i = 0, plain; i < n; i += plain) {
        plain = line[i] == '\033' ? strcspn(line + i, "m") + 1 : strcspn(line + i, "\033\n");
        count += line[i] == '\033' ? 0 : text_columns(line + i, plain);
    }
    return count;
}

bool pager_needed(const char *text) {
    struct winsize size = {.ws_row = 0};
    size_t rows = 1; /* the prompt */
    ioctl(STDOUT_FILENO, TIOCGWINSZ, &size);
    if (size.ws_row == 0 || size.ws_col == 0)
        return false;
    while (*text) {
        const size_t n = strcspn(text, "\n"), wide = columns(text, n);
        rows += wide > 0 ? (wide - 1) / size.ws_col + 1 : 1;
        text += n + (text[n] == '\n');
    }
    return rows > size.ws_row;
}

static bool exists(const char *program) {
    char command[64];
    snprintf(command, sizeof command, "command -v %s >/dev/null 2>&1", program);
    return system(command) == 0;
}

static const char *program(void) {
    const char *wanted = getenv("PAGER");
    if (wanted)
        return *wanted && strcmp(wanted, "cat") ? wanted : NULL;
    return exists("less") ? "less" : exists("more") ? "more" : NULL;
}

bool pager_show(const char *text) {
    const char *name = program();
    struct sigaction ignore = {.sa_handler = SIG_IGN}, before;
    if (!name)
        return false;
    setenv("LESS", "FRX", 0); /* ends by itself where all fits, and leaves the text on the screen */
    fflush(stdout);
    sigaction(SIGINT, &ignore, &before); /* Ctrl-C is the pager's, which asks for its own */
    FILE *to = popen(name, "w");
    if (to)
        fputs(text, to);
    const bool shown = to && pclose(to) == 0;
    sigaction(SIGINT, &before, NULL);
    return shown;
}
