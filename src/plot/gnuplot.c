/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Running gnuplot: in a folder of our own, in a process group of its own, with a time-out. It reads its
 * standard input and writes its standard output; no name of a file ever reaches it. */
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

enum { FOLDER, SCRIPT, OUT, ERR, PAUSE = 1 /* ms */ };

static char *joined(const char *dir, const char *name) {
    size_t room = strlen(dir) + strlen(name) + 2;
    char *path = malloc(room);
    if (path)
        snprintf(path, room, "%s/%s", dir, name);
    return path;
}

void plot_run_close(plot_run *r) {
    char *const files[] = {r->script, r->out, r->err};
    for (int i = 0; i < 3; i++) {
        if (files[i])
            unlink(files[i]);
        free(files[i]);
    }
    if (r->guard[FOLDER] >= 0)
        rmdir(r->dir);
    for (int i = 0; i < 4; i++)
        file_unguard(r->guard[i]);
    free(r->dir);
    *r = (plot_run){.guard = {-1, -1, -1, -1}};
}

bool plot_run_open(plot_run *r, calc_error *error) {
    const char *tmp = getenv("TMPDIR");
    tmp = tmp && *tmp ? tmp : "/tmp";
    *r = (plot_run){.guard = {-1, -1, -1, -1}, .dir = joined(tmp, "fret-XXXXXX")};
    sigset_t before;
    file_signals_hold(&before);
    int code = r->dir ? 0 : ENOMEM;
    if (!code && !mkdtemp(r->dir))
        code = errno;
    bool made = !code;
    if (made) {
        r->guard[FOLDER] = file_guard_dir(r->dir);
        r->script = joined(r->dir, "script");
        r->out = joined(r->dir, "out");
        r->err = joined(r->dir, "err");
        if (r->guard[FOLDER] < 0) {
            rmdir(r->dir);
            code = ENOMEM;
        }
    }
    char *const files[] = {r->script, r->out, r->err};
    for (int i = 0; i < 3 && !code; i++) {
        r->guard[SCRIPT + i] = files[i] ? file_guard_file(files[i]) : -1;
        if (r->guard[SCRIPT + i] < 0)
            code = ENOMEM;
    }
    file_signals_release(&before);
    if (code) {
        calc_errno(error, code, "cannot make a temporary directory in %s", tmp);
        plot_run_close(r);
    }
    return !code;
}

/* Starts gnuplot; 0 or an error number. */
static int start(const plot_run *r, char *const argv[], pid_t *pid, int *guard) {
    posix_spawn_file_actions_t actions;
    posix_spawnattr_t attributes;
    sigset_t before, defaults;
    posix_spawn_file_actions_init(&actions); /* neither of them asks for memory */
    posix_spawnattr_init(&attributes);
    int flags = O_WRONLY | O_CREAT | O_TRUNC;
    int code = posix_spawn_file_actions_addopen(&actions, 0, r->script, O_RDONLY, 0);
    code = code ? code : posix_spawn_file_actions_addopen(&actions, 1, r->out, flags, 0600);
    code = code ? code : posix_spawn_file_actions_addopen(&actions, 2, r->err, flags, 0600);
    /* a group of its own: Ctrl-C reaches fret alone, which then ends it whole */
    posix_spawnattr_setflags(&attributes,
                             POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
    posix_spawnattr_setpgroup(&attributes, 0);
    sigemptyset(&defaults);
    sigaddset(&defaults, SIGPIPE);
    sigaddset(&defaults, SIGXFSZ);
    posix_spawnattr_setsigdefault(&attributes, &defaults);
    /* gnuplot begins with the terminal that it names, and ends where that is none of its own */
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

/* The last message, without gnuplot's words of where and without anything a terminal would obey. */
static void message(const plot_run *r, char *text, size_t size) {
    char line[300];
    *text = 0;
    FILE *f = fopen(r->err, "r");
    while (f && fgets(line, sizeof line, f)) {
        line[strcspn(line, "\n")] = 0;
        const char *from = strstr(line, "line ");
        const char *said =
            from && (from == line || from[-1] == ' ') && strchr(from, ':') ? strchr(from, ':') + 1 : line;
        said += strspn(said, " \t^");
        if (*said)
            snprintf(text, size, "%s", said);
    }
    if (f)
        fclose(f);
    char *clean = plot_text(text, PLOT_UNICODE);
    snprintf(text, size, "%s", clean && *clean ? clean : "no message");
    free(clean);
}

static const char missing[] =
    "plots need gnuplot, which is not installed (Debian: apt-get install gnuplot-nox)";

static bool run(const plot_run *r, char *const argv[], const plot_target *target, calc_error *error) {
    pid_t pid;
    int guard, status = 0, code = start(r, argv, &pid, &guard);
    double timeout = target->timeout > 0 ? target->timeout : 60;
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
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0)
        return true;
    if (WIFEXITED(status) && WEXITSTATUS(status) == 127) /* a C library that finds out late */
        return calc_fail(error, 0, 0, "%s", missing);
    char text[300];
    message(r, text, sizeof text);
    return calc_fail(error, 0, 0, "gnuplot failed: %s", text);
}

bool plot_run_gnuplot(const plot_run *r, const plot_target *target, calc_error *error) {
    /* loaded as a file, not typed in: then it stops at the first error */
    char *argv[] = {"gnuplot", "-d", "/dev/stdin", NULL};
    return run(r, argv, target, error);
}
