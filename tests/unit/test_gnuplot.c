/* SPDX-License-Identifier: GPL-3.0-or-later */
/* gnuplot's end where it can be lost: someone else has waited for it, or signals come in between. The
 * Makefile links this program so that waits pass through the function here. */
#include <errno.h>
#include <signal.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "plot/script.h"
#include "unit.h"

static calc_error error;
static int fail_with[3]; /* what the next waits fail with, up to a 0 */
static int next_wait;

pid_t __real_waitpid(pid_t process, int *status, int how);
pid_t __wrap_waitpid(pid_t process, int *status, int how);
pid_t __wrap_waitpid(pid_t process, int *status, int how) {
    const int code = fail_with[next_wait];
    if (!code)
        return __real_waitpid(process, status, how);
    next_wait++;
    errno = code;
    return -1;
}

static bool draws(const plot_run *r) {
    error_clear(&error);
    return plot_run_gnuplot(r, &(plot_target){.file = NULL}, &error);
}

static bool fake(const char *script) {
    FILE *f = fopen("gnuplot", "w");
    return f && fprintf(f, "#!/bin/sh\n%s\n", script) > 0 && !fclose(f) && !chmod("gnuplot", 0700);
}

/* The first wait looks, the others follow a kill. */
static void lost(const plot_run *r) {
    static const struct {
        int with[3];
        bool gone; /* nothing is left to be waited for by us */
    } waits[] = {{{ECHILD}, true}, {{ECHILD, EINTR}, true}, {{ECHILD, ECHILD}, false}};
    CHECK(fake("exec /bin/sleep 100"));
    for (size_t i = 0; i < sizeof waits / sizeof *waits; i++) {
        memcpy(fail_with, waits[i].with, sizeof waits[i].with);
        next_wait = 0;
        CHECK(!draws(r) && strstr(error.text, "cannot wait for gnuplot"));
        CHECK(!fail_with[next_wait]);
        memset(fail_with, 0, sizeof fail_with);
        int status = 0;
        const pid_t left_over = __real_waitpid(-1, &status, 0);
        CHECK(waits[i].gone ? left_over < 0 && errno == ECHILD
                            : left_over > 0 && WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL);
    }
    /* interrupted before there is an end: it is waited for all the same */
    CHECK(fake("exit 0"));
    fail_with[0] = fail_with[1] = EINTR;
    next_wait = 0;
    CHECK(draws(r) && next_wait == 2);
    memset(fail_with, 0, sizeof fail_with);
    next_wait = 0;
}

int main(int argc, char **argv) {
    unit_start("test_gnuplot", argc, argv);
    char dir[] = "/tmp/fret-unit-XXXXXX";
    plot_run r;
    if (!CHECK(mkdtemp(dir) && !chdir(dir) && !setenv("TMPDIR", dir, 1) && !setenv("PATH", ".", 1)))
        return unit_finish();
    if (CHECK(plot_run_open(&r, &error))) {
        CASE(lost(&r));
        plot_run_close(&r);
    }
    CHECK(!unlink("gnuplot") && !chdir("/") && !rmdir(dir));
    return unit_finish();
}
