/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a session says beside its answers: notes, errors without a place, and whom it says them to. */
#include <poll.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "shell/output.h"
#include "shell/progress.h"
#include "shell/recorder.h"

volatile sig_atomic_t shell_stop;

enum { NOTE = 8192 }; /* holds a file's name, escaped or not */

void shell_note(shell *sh, const char *format, ...) {
    char text[NOTE];
    va_list args;
    progress_wipe();
    va_start(args, format);
    vsnprintf(text, sizeof text, format, args);
    va_end(args);
    fflush(sh->out);
    print_safe(sh->err, text, strlen(text));
    fputc('\n', sh->err);
}

bool shell_aside(const shell *sh, FILE *to) {
    if (sh->replaying)
        putc(MARK_ASIDE, to);
    return sh->replaying || sh->interactive;
}

bool shell_on_terminal(const shell *sh) {
    return (sh->out == stdout || record_shows(sh)) && isatty(STDOUT_FILENO);
}

bool shell_escapes(void) {
    const char *term = getenv("TERM");
    return term && *term && strcmp(term, "dumb") != 0 && strcmp(term, "unknown") != 0;
}

void shell_print_error(const shell *sh, const char *text) {
    fputs(sh->set.color ? "\033[1;31merror:\033[0m " : "error: ", sh->err);
    print_safe(sh->err, text, strlen(text));
    putc('\n', sh->err);
}

void shell_error(shell *sh, const char *text) {
    progress_wipe();
    fflush(sh->out);
    shell_print_error(sh, text);
    fflush(sh->err);
    sh->failed = true;
}

bool shell_unread(void) {
    struct pollfd out = {.fd = STDOUT_FILENO};
    return ferror(stdout) && poll(&out, 1, 0) > 0 && out.revents & (POLLERR | POLLHUP);
}
