/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Runs gnuplot on unnamed temporary files, in its own process group, with a time-out. It reads standard input
 * and writes standard output; no file name ever reaches it. Depends on POSIX, script.h and text. */
#define _GNU_SOURCE /* mkostemp */
#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "plot/script.h"
#include "text/clock.h"

extern char **environ;

enum { PAUSE = 1 /* ms */ };

/* A temporary file for writing and reading that disappears when it is closed. NULL with errno. */
static FILE *nameless(const char *dir) {
    char path[FILE_PATH];
    sigset_t before;
    if (snprintf(path, sizeof path, "%s/fret-XXXXXX", dir) >= (int)sizeof path) {
        errno = ENAMETOOLONG;
        return NULL;
    }
    file_signals_hold(&before); /* it must not stay if a signal comes before unlink */
    const int fd = mkostemp(path, O_CLOEXEC);
    if (fd >= 0)
        unlink(path);
    file_signals_release(&before);
    FILE *made = fd < 0 ? NULL : fdopen(fd, "w+");
    if (fd >= 0 && !made)
        close(fd);
    return made;
}

void plot_run_close(plot_run *r) {
    FILE *const files[] = {r->script, r->out, r->err};
    for (int i = 0; i < 3; i++)
        if (files[i])
            fclose(files[i]);
    *r = (plot_run){.script = NULL};
}

bool plot_run_open(plot_run *r, calc_error *error) {
    const char *tmp = getenv("TMPDIR");
    tmp = tmp && *tmp ? tmp : "/tmp";
    *r = (plot_run){.script = nameless(tmp)};
    r->out = r->script ? nameless(tmp) : NULL;
    r->err = r->out ? nameless(tmp) : NULL;
    if (r->err)
        return true;
    calc_errno(error, errno, "cannot make a temporary file in %s", tmp);
    plot_run_close(r);
    return false;
}

/* Starts gnuplot; 0 or an error number. */
static int start(const plot_run *r, pid_t *pid, int *guard) {
    /* run as a script file: read as plain standard input it would go on after an error */
    char *const argv[] = {"gnuplot", "-d", "/dev/stdin", NULL};
    posix_spawn_file_actions_t actions;
    posix_spawnattr_t attributes;
    sigset_t before, defaults;
    posix_spawn_file_actions_init(&actions); /* neither init can fail: they allocate nothing */
    posix_spawnattr_init(&attributes);
    int code = fseek(r->script, 0, SEEK_SET) ? errno : 0;
    code = code ? code : posix_spawn_file_actions_adddup2(&actions, fileno(r->script), 0);
    code = code ? code : posix_spawn_file_actions_adddup2(&actions, fileno(r->out), 1);
    code = code ? code : posix_spawn_file_actions_adddup2(&actions, fileno(r->err), 2);
    /* own process group: Ctrl-C reaches fret alone, which then kills the group */
    posix_spawnattr_setflags(&attributes,
                             POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
    posix_spawnattr_setpgroup(&attributes, 0);
    sigemptyset(&defaults);
    sigaddset(&defaults, SIGPIPE);
    sigaddset(&defaults, SIGXFSZ);
    posix_spawnattr_setsigdefault(&attributes, &defaults);
    /* gnuplot would start with the terminal named by GNUTERM, and exit if it does not know that */
    unsetenv("GNUTERM");
    file_signals_hold(&before);
    posix_spawnattr_setsigmask(&attributes, &before);
    code = code ? code : posix_spawnp(pid, "gnuplot", &actions, &attributes, argv, environ);
    *guard = code ? -1 : file_guard_group(*pid);
    file_signals_release(&before);
    posix_spawn_file_actions_destroy(&actions);
    posix_spawnattr_destroy(&attributes);
    return code;
}

typedef enum end { ENDED, STOPPED, LATE, LOST } end;

static end wait_for(pid_t pid, int guard, const plot_target *target, double timeout, int *status) {
    double limit = clock_wall() + timeout;
    for (;;) {
        const pid_t done = waitpid(pid, status, WNOHANG);
        const bool lost = done < 0 && errno != EINTR;
        const end how = plot_stopped(target) ? STOPPED : clock_wall() > limit ? LATE : lost ? LOST : ENDED;
        if (done != pid && how == ENDED) {
            poll(NULL, 0, PAUSE);
            continue;
        }
        if (done != pid) {
            kill(-pid, SIGKILL);
            while (waitpid(pid, status, 0) < 0 && errno == EINTR) {
            }
        }
        file_unguard(guard);
        return done == pid ? ENDED : how;
    }
}

/* The last message of gnuplot without its place. */
static void last_message(const plot_run *r, char *text, size_t size) {
    char line[300];
    *text = 0;
    rewind(r->err);
    while (fgets(line, sizeof line, r->err)) {
        line[strcspn(line, "\n")] = 0;
        const char *from = strstr(line, "line ");
        const char *said =
            from && (from == line || from[-1] == ' ') && strchr(from, ':') ? strchr(from, ':') + 1 : line;
        said += strspn(said, " \t^");
        if (*said)
            snprintf(text, size, "%s", said);
    }
    if (!*text)
        snprintf(text, size, "no message");
}

static const char missing[] =
    "plots need gnuplot, which is not installed (Debian: apt-get install gnuplot-nox)";

bool plot_run_gnuplot(const plot_run *r, const plot_target *target, calc_error *error) {
    pid_t pid;
    int guard, status = 0, code = start(r, &pid, &guard);
    double timeout = target->timeout > 0 ? target->timeout : 30;
    if (code == ENOENT || code == ENOTDIR)
        return calc_fail(error, 0, 0, "%s", missing);
    if (code)
        return calc_errno(error, code, "cannot run gnuplot");
    switch (wait_for(pid, guard, target, timeout, &status)) {
    case STOPPED:
        return calc_interrupted(error);
    case LATE:
        return calc_fail(error, 0, 0, "gnuplot gave no picture within %g s and was stopped", timeout);
    case LOST:
        return calc_errno(error, ECHILD, "cannot wait for gnuplot");
    case ENDED:
        break;
    }
    if (fseek(r->out, 0, SEEK_SET))
        return calc_errno(error, errno, "cannot read what gnuplot drew");
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0)
        return true;
    if (WIFEXITED(status) && WEXITSTATUS(status) == 127) /* how some C libraries report a missing program */
        return calc_fail(error, 0, 0, "%s", missing);
    char text[300];
    last_message(r, text, sizeof text);
    return calc_fail(error, 0, 0, "gnuplot failed: %s", text);
}
