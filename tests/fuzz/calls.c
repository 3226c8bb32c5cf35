/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Runs a program and lets one of its system calls fail: `calls REPORT CALL NUMBER CODE PROGRAM ARG...`.
 * Counting begins when a file named `arm` has been read and closed, and ends when one named `disarm` is
 * opened; of the calls with this name, the one with this number (`3+`: and all from there on) fails with this
 * code of errno(3), without being made. REPORT gets the names of the calls, a line each, in their order, and
 * FAILED behind that one. What the program starts is counted until it is another program. For Linux: a filter
 * (seccomp) hands the calls to us before they are made. */
#define _GNU_SOURCE
#include <errno.h>
#include <limits.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <poll.h>
#include <signal.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/uio.h>
#include <sys/wait.h>
#include <unistd.h>

typedef struct call {
    int number;
    const char *name;
} call;

#define CALL(name)                                                                                           \
    { SYS_##name, #name }
/* Older calls are missing on newer machines. */
static const call calls[] = {
    CALL(read),     CALL(pread64),    CALL(readlinkat), CALL(write),      CALL(writev),    CALL(openat),
    CALL(close),    CALL(fsync),      CALL(renameat2),  CALL(unlinkat),   CALL(mkdirat),   CALL(clone),
    CALL(clone3),   CALL(wait4),      CALL(waitid),     CALL(mmap),       CALL(mremap),    CALL(execve),
    CALL(fstat),    CALL(newfstatat), CALL(statx),      CALL(lseek),      CALL(ftruncate), CALL(fchmod),
    CALL(fchmodat), CALL(fchown),     CALL(faccessat),  CALL(faccessat2), CALL(fcntl),     CALL(dup),
    CALL(dup3),     CALL(pipe2),      CALL(ppoll),      CALL(getrandom),  CALL(ioctl),     CALL(setpgid),
    CALL(kill),     CALL(pselect6),
#ifdef SYS_open
    CALL(open),     CALL(rename),     CALL(unlink),     CALL(mkdir),      CALL(rmdir),     CALL(readlink),
    CALL(stat),     CALL(lstat),      CALL(access),     CALL(chmod),      CALL(fork),      CALL(vfork),
    CALL(dup2),     CALL(pipe),       CALL(poll),       CALL(select),
#endif
#ifdef SYS_renameat
    CALL(renameat),
#endif
};
enum { CALLS = sizeof calls / sizeof *calls };

static int fail(const char *what) {
    perror(what);
    return 120;
}

/* ---- the program ------------------------------------------------------------------------------- */

static int filter(void) {
    struct sock_filter code[2 * CALLS + 2] = {
        BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(struct seccomp_data, nr))};
    size_t n = 1;
    for (size_t i = 0; i < CALLS; i++) {
        code[n++] = (struct sock_filter)BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, (unsigned)calls[i].number, 0, 1);
        code[n++] = (struct sock_filter)BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_USER_NOTIF);
    }
    code[n++] = (struct sock_filter)BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW);
    const struct sock_fprog program = {(unsigned short)n, code};
    if (prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0))
        return -1;
    return (int)syscall(SYS_seccomp, SECCOMP_SET_MODE_FILTER, SECCOMP_FILTER_FLAG_NEW_LISTENER, &program);
}

/* Sends a descriptor, or gets one. */
static int pass(int through, int fd) {
    char byte = 0;
    union {
        struct cmsghdr head;
        char room[CMSG_SPACE(sizeof(int))];
    } control = {.room = {0}};
    struct iovec data = {&byte, 1};
    struct msghdr message = {
        .msg_iov = &data, .msg_iovlen = 1, .msg_control = &control, .msg_controllen = sizeof control};
    control.head.cmsg_level = SOL_SOCKET;
    control.head.cmsg_type = SCM_RIGHTS;
    control.head.cmsg_len = CMSG_LEN(sizeof fd);
    if (fd >= 0) {
        memcpy(CMSG_DATA(&control.head), &fd, sizeof fd);
        return sendmsg(through, &message, 0) == 1 ? 0 : -1;
    }
    if (recvmsg(through, &message, MSG_CMSG_CLOEXEC) != 1 || !CMSG_FIRSTHDR(&message))
        return -1;
    memcpy(&fd, CMSG_DATA(CMSG_FIRSTHDR(&message)), sizeof fd);
    return fd;
}

static void run(int through, char **argv) {
    /* nothing that is filtered may be called between */
    const int listener = filter();
    if (listener < 0 || pass(through, listener))
        _exit(120);
    execvp(*argv, argv);
    _exit(120);
}

/* ---- its calls --------------------------------------------------------------------------------- */

typedef struct watch {
    pid_t main;
    char program[PATH_MAX];
    enum { ASLEEP, ARMING, ARMED, DONE } state;
    const char *call;
    long seen, wanted; /* of calls with that name */
    bool on;           /* those that follow fail too */
    int code;
    FILE *report;
} watch;

static const char *name_of(int number) {
    for (size_t i = 0; i < CALLS; i++)
        if (calls[i].number == number)
            return calls[i].name;
    return "?";
}

/* The program itself, or a copy of it that has yet to become another? */
static bool is_ours(watch *w, pid_t pid) {
    char link[64], path[PATH_MAX];
    if (pid == w->main)
        return true;
    snprintf(link, sizeof link, "/proc/%d/exe", (int)pid);
    const ssize_t n = readlink(link, path, sizeof path - 1);
    path[n > 0 ? n : 0] = 0;
    return !strcmp(path, w->program);
}

static bool opens(const struct seccomp_notif *asked, const char *name) {
    char path[PATH_MAX] = "";
    unsigned long long at = asked->data.args[asked->data.nr == SYS_openat];
    if (strcmp(name_of(asked->data.nr), "openat") && strcmp(name_of(asked->data.nr), "open"))
        return false;
    struct iovec here = {path, 16}, there = {(void *)(uintptr_t)at, 16};
    const ssize_t n = process_vm_readv((pid_t)asked->pid, &here, 1, &there, 1, 0);
    path[n > 0 ? n : 0] = 0;
    return !strcmp(path, name);
}

/* The code the call fails with, 0: it is made. */
static int judge(watch *w, const struct seccomp_notif *asked) {
    if (w->state == ARMED && is_ours(w, (pid_t)asked->pid)) {
        if (opens(asked, "disarm")) {
            w->state = DONE;
            return 0;
        }
        const char *name = name_of(asked->data.nr);
        const bool named = !strcmp(name, w->call);
        w->seen += named;
        const bool fails = named && (w->on ? w->seen >= w->wanted : w->seen == w->wanted);
        fprintf(w->report, fails ? "%s\nFAILED\n" : "%s\n", name);
        return fails ? w->code : 0;
    }
    if (w->state == ASLEEP && opens(asked, "arm"))
        w->state = ARMING;
    else if (w->state == ARMING && asked->data.nr == SYS_close)
        w->state = ARMED;
    return 0;
}

/* Answers one call; false: there will be none. */
static bool answer(watch *w, int listener) {
    struct seccomp_notif asked;
    struct seccomp_notif_resp reply = {.flags = 0};
    memset(&asked, 0, sizeof asked);
    if (ioctl(listener, SECCOMP_IOCTL_NOTIF_RECV, &asked))
        return errno == EINTR || errno == ENOENT; /* it was killed meanwhile */
    const int code = judge(w, &asked);
    reply.id = asked.id;
    reply.error = -code;
    reply.flags = code ? 0 : (unsigned)SECCOMP_USER_NOTIF_FLAG_CONTINUE;
    return !ioctl(listener, SECCOMP_IOCTL_NOTIF_SEND, &reply) || errno == ENOENT;
}

int main(int argc, char **argv) {
    int through[2], status;
    if (argc < 6)
        return 120;
    static watch w;
    w.call = argv[2];
    w.wanted = atol(argv[3]);
    w.on = strchr(argv[3], '+') != NULL;
    w.code = atoi(argv[4]);
    w.report = fopen(argv[1], "w");
    if (!w.report || !realpath(argv[5], w.program) ||
        socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, through))
        return fail("calls");
    w.main = fork();
    if (w.main == 0)
        run(through[1], argv + 5);
    close(through[1]);
    const int listener = pass(through[0], -1), ended = (int)syscall(SYS_pidfd_open, w.main, 0);
    if (listener < 0 || ended < 0)
        return fail("calls: no filter");
    for (bool more = true; more;) {
        struct pollfd events[] = {{listener, POLLIN, 0}, {ended, POLLIN, 0}};
        if (poll(events, 2, -1) < 0 && errno != EINTR)
            return fail("calls");
        more = events[0].revents & POLLIN ? answer(&w, listener) : !events[1].revents && !events[0].revents;
    }
    if (waitpid(w.main, &status, 0) != w.main || fclose(w.report))
        return fail("calls");
    if (WIFSIGNALED(status))
        raise(WTERMSIG(status));
    return WIFEXITED(status) ? WEXITSTATUS(status) : 120;
}
