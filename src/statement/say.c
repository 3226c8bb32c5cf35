/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Notes, warnings and errors beside the answers, and where they go. Writes to the session's streams. */
#include <errno.h>
#include <poll.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "statement/answer.h"
#include "statement/progress.h"
#include "statement/record.h"

volatile sig_atomic_t shell_stop;

/* Writes a message among the answers, where programs read them (JSON). kind: "note", "warning", "error". */
static void tell_programs(const shell *sh, const char *kind, const char *text) {
    answer a;
    answer_begin(&a, &sh->set, sh->out);
    answer_message(&a, kind, text);
    answer_done(&a);
    fflush(sh->out);
}

enum { NOTE = 8192 }; /* larger than a file name */

void shell_tell(shell *sh, const char *kind, const char *before, const char *format, ...) {
    char text[NOTE];
    va_list args;
    va_start(args, format);
    vsnprintf(text, sizeof text, format, args);
    va_end(args);
    progress_wipe();
    tell_programs(sh, kind, text);
    fputs(before, sh->err);
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
    tell_programs(sh, "error", text);
    shell_print_error(sh, text);
    fflush(sh->err);
}

FILE *shell_nowhere(calc_error *error) {
    static FILE *nowhere;
    if (!nowhere && !(nowhere = fopen("/dev/null", "w")))
        calc_raise_errno(error, errno, "cannot write /dev/null");
    return nowhere;
}

bool output_closed(void) {
    struct pollfd out = {.fd = STDOUT_FILENO};
    return ferror(stdout) && poll(&out, 1, 0) > 0 && out.revents & (POLLERR | POLLHUP);
}
