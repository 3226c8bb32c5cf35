/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Linked into the program whose coverage is measured, in place of what ends a process without its exit
 * handlers: what it has counted is written before. Nothing of that is fault injection's to count or to fail.
 */
#include <fcntl.h>
#include <signal.h>
#include <stdbool.h>
#include <stdlib.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

void __gcov_dump(void);
void __gcov_reset(void);
void __wrap___gcov_exit(void);
void __real__exit(int status) __attribute__((noreturn));
int __real_raise(int number);
int __real_kill(pid_t process, int number);
pid_t __real_fork(void);
void __wrap__exit(int status) __attribute__((noreturn));
int __wrap_raise(int number);
int __wrap_kill(pid_t process, int number);
pid_t __wrap_fork(void);

static void disarm(void) {
    const int fd = open("disarm", O_RDONLY);
    if (fd >= 0)
        close(fd);
}

/* By a process of its own, which no test knows and kills, beyond the limits and the faults of the test:
 * counts that break off are lost for all. */
static void flush(void) {
    struct rlimit size;
    sigset_t all, before;
    disarm();
    sigfillset(&all);
    sigprocmask(SIG_BLOCK, &all, &before);
    const pid_t writer = __real_fork();
    if (writer == 0) {
        setsid();
        getrlimit(RLIMIT_FSIZE, &size);
        if (size.rlim_cur == RLIM_INFINITY ||
            !setrlimit(RLIMIT_FSIZE, &(struct rlimit){RLIM_INFINITY, RLIM_INFINITY}))
            __gcov_dump();
        __real__exit(0);
    }
    if (writer > 0)
        waitpid(writer, NULL, 0);
    __gcov_reset(); /* it may go on, and be written again */
    sigprocmask(SIG_SETMASK, &before, NULL);
}

/* Each object calls it after the exit handlers of the program. */
void __wrap___gcov_exit(void) {
    static bool done;
    if (!done)
        flush();
    done = true;
}

void __wrap__exit(int status) {
    if (!getenv("FRET_FAULTS")) /* a worker's calls are counted as its starter's */
        flush();
    __real__exit(status);
}

int __wrap_raise(int number) {
    if (!getenv("FRET_FAULTS"))
        flush();
    return __real_raise(number);
}

/* A worker is killed when it is of no more use: it writes first. */
static void leave(int number) {
    (void)number;
    _exit(0);
}

pid_t __wrap_fork(void) {
    const pid_t process = __real_fork();
    if (process == 0)
        signal(SIGUSR2, leave);
    return process;
}

int __wrap_kill(pid_t process, int number) {
    siginfo_t unused;
    if (process > 0 && number == SIGKILL && !getenv("FRET_FAULTS") && !__real_kill(process, SIGUSR2))
        waitid(P_PID, (id_t)process, &unused, WEXITED | WNOWAIT);
    return __real_kill(process, number);
}
