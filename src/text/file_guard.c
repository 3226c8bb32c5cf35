/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The list of what to clean up when a signal ends the program. Depends on POSIX alone. */
#include "text/file.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

typedef enum kind { NOTHING, A_FILE, A_GROUP, A_TERMINAL } kind;

enum { GUARDS = 64 };

/* A signal handler may read a row at any moment: it is filled in before its kind is set, and its path is
 * freed only when the row is used again. */
static struct {
    volatile sig_atomic_t kind;
    pid_t group;
    char *path;
    struct termios modes;
    const char *farewell;
} guards[GUARDS];

/* A free row, with a copy of the path unless that is NULL; -1: no row is free, or out of memory. */
static int take_guard(const char *path) {
    for (int i = 0; i < GUARDS; i++) {
        if (guards[i].kind != NOTHING)
            continue;
        free(guards[i].path);
        guards[i].path = path ? strdup(path) : NULL;
        return path && !guards[i].path ? -1 : i;
    }
    return -1;
}

static int set(int row, kind what) {
    if (row >= 0)
        guards[row].kind = (sig_atomic_t)what;
    return row;
}

int file_guard_file(const char *path) {
    return set(take_guard(path), A_FILE);
}

int file_guard_group(pid_t group) {
    const int row = take_guard(NULL);
    if (row >= 0)
        guards[row].group = group;
    return set(row, A_GROUP);
}

int file_guard_terminal(const struct termios *modes, const char *farewell) {
    const int row = take_guard(NULL);
    if (row >= 0) {
        guards[row].modes = *modes;
        guards[row].farewell = farewell;
    }
    return set(row, A_TERMINAL);
}

void file_unguard(int number) {
    if (number >= 0)
        guards[number].kind = NOTHING;
}

static void restore(int i) {
    const ssize_t sent = write(STDIN_FILENO, guards[i].farewell, strlen(guards[i].farewell));
    (void)sent; /* there is no way to report a failure */
    tcsetattr(STDIN_FILENO, TCSANOW, &guards[i].modes);
}

void file_emergency(void) {
    for (int i = 0; i < GUARDS; i++)
        if (guards[i].kind == A_GROUP)
            kill(-guards[i].group, SIGKILL);
    for (int i = 0; i < GUARDS; i++)
        if (guards[i].kind == A_TERMINAL)
            restore(i);
    for (int i = 0; i < GUARDS; i++)
        if (guards[i].kind == A_FILE)
            unlink(guards[i].path);
}

bool file_signal_ends(int number) {
    static const int others[] = {SIGINT,  SIGKILL, SIGSTOP, SIGTSTP,  SIGTTIN, SIGTTOU,
                                 SIGCONT, SIGCHLD, SIGURG,  SIGWINCH, SIGPIPE, SIGXFSZ,
                                 SIGSEGV, SIGBUS,  SIGFPE,  SIGILL,   SIGABRT};
    for (size_t i = 0; i < sizeof others / sizeof *others; i++)
        if (number == others[i])
            return false;
    return true;
}

void file_signals_hold(sigset_t *before) {
    sigset_t ending;
    sigemptyset(&ending);
    sigaddset(&ending, SIGINT);
    for (int n = 1; n < FILE_SIGNALS; n++)
        if (file_signal_ends(n))
            sigaddset(&ending, n);
    sigprocmask(SIG_BLOCK, &ending, before);
}

void file_signals_release(const sigset_t *before) {
    sigprocmask(SIG_SETMASK, before, NULL);
}
