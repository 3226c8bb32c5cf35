/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The list of what must not stay behind when a signal ends the program. */
#include "calc/file.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

typedef enum kind { NOTHING, A_FILE, A_DIR, A_GROUP } kind;

enum { GUARDS = 64 };

/* A handler may look at any moment: a row is filled in before its kind is set, and its path is freed only
 * when the row is taken again. */
static struct {
    volatile sig_atomic_t kind;
    pid_t group;
    char *path;
} guards[GUARDS];

static int guard(kind what, const char *path, pid_t group) {
    for (int i = 0; i < GUARDS; i++) {
        if (guards[i].kind != NOTHING)
            continue;
        free(guards[i].path);
        guards[i].path = path ? strdup(path) : NULL;
        guards[i].group = group;
        if (path && !guards[i].path)
            return -1;
        guards[i].kind = (sig_atomic_t)what;
        return i;
    }
    return -1;
}

int file_guard_file(const char *path) {
    return guard(A_FILE, path, 0);
}

int file_guard_dir(const char *path) {
    return guard(A_DIR, path, 0);
}

int file_guard_group(pid_t group) {
    return guard(A_GROUP, NULL, group);
}

void file_unguard(int number) {
    if (number >= 0)
        guards[number].kind = NOTHING;
}

void file_emergency(void) {
    for (int i = 0; i < GUARDS; i++)
        if (guards[i].kind == A_GROUP)
            kill(-guards[i].group, SIGKILL);
    for (int i = 0; i < GUARDS; i++)
        if (guards[i].kind == A_FILE)
            unlink(guards[i].path);
    for (int i = 0; i < GUARDS; i++)
        if (guards[i].kind == A_DIR)
            rmdir(guards[i].path);
}

void file_signals_hold(sigset_t *before) {
    sigset_t ending;
    sigemptyset(&ending);
    sigaddset(&ending, SIGINT);
    sigaddset(&ending, SIGTERM);
    sigaddset(&ending, SIGHUP);
    sigaddset(&ending, SIGQUIT);
    sigprocmask(SIG_BLOCK, &ending, before);
}

void file_signals_release(const sigset_t *before) {
    sigprocmask(SIG_SETMASK, before, NULL);
}
