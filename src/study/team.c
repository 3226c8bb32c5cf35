/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Worker processes that wait for parts: the index of a part's slot in shared memory is sent through a socket;
 * a free worker reads it, and sends it back when the part is done. Depends on POSIX and text/file. */
#include "study/team.h"

#include <errno.h>
#include <math.h>
#include <poll.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>
#ifndef MSG_NOSIGNAL /* of macOS: SIGPIPE is ignored anyway */
#define MSG_NOSIGNAL 0
#endif
#ifdef __linux__
#include <sys/prctl.h>
#endif

#include "text/file.h"

enum {
    WORKERS = 64,
    AHEAD = 3,  /* slots for each worker: a slow part does not keep the others waiting */
    WAKE = 20,  /* ms between two checks of the stop flag and for workers that have ended */
    ALIGN = 64, /* bytes: enough for any type that a part holds */
};
static const double pays = 4e-3; /* seconds, many times the cost of starting a team */

typedef struct slot {
    bool valid; /* the worker has a result; written by the worker */
    bool done;  /* the parent has been told */
} slot;

struct team {
    team_job job;
    unsigned workers, slots;
    pid_t worker[WORKERS];
    int given[2], done[2];      /* socket pairs, read at [0]: `given` by the workers, `done` by the parent */
    char *memory;               /* the slots, each with its input and result behind it */
    size_t in_at, out_at, size; /* offsets within a slot, and its bytes */
    size_t all;                 /* bytes of the mapping: this struct, then the slots */
    bool alone;                 /* a worker has died: the rest is computed here */
};

static unsigned cores(const calc *c) {
    static long there; /* asked once: sysconf reads a file */
    if (!there)
        there = sysconf(_SC_NPROCESSORS_ONLN);
    return (unsigned)fmin(c->cores ? c->cores : fmax((double)there, 1), WORKERS);
}

bool team_pays(double taken, double done, double all) {
    return taken > pays && done > 0 && taken / done * (all - done) > pays;
}

static size_t aligned(size_t bytes) {
    return (bytes + ALIGN - 1) / ALIGN * ALIGN;
}

static slot *slot_at(const team *t, unsigned i) {
    return (slot *)(t->memory + i * t->size);
}

static void *in_of(const team *t, unsigned i) {
    return t->memory + i * t->size + t->in_at;
}

static void *out_of(const team *t, unsigned i) {
    return t->memory + i * t->size + t->out_at;
}

/* ---- a worker ---------------------------------------------------------------------------------- */

/* Reads or sends the index of a slot; false: the other end is closed. */
static bool pass_index(int fd, unsigned char *i, bool reads) {
    ssize_t n;
    do
        n = reads ? read(fd, i, 1) : send(fd, i, 1, MSG_NOSIGNAL);
    while (n < 0 && errno == EINTR);
    return n == 1;
}

/* A worker must not run the parent's handlers, which remove its files for example. It ignores Ctrl-C, which
 * reaches it too: the parent ends the workers. Signals are blocked until this is done. */
static void reset_signals(const sigset_t *before) {
    signal(SIGINT, SIG_IGN);
    for (int n = 1; n < FILE_SIGNALS; n++)
        if (file_signal_ends(n) || n == SIGTSTP || n == SIGCONT || n == SIGWINCH || n == SIGCHLD)
            signal(n, SIG_DFL);
    sigprocmask(SIG_SETMASK, before, NULL);
}

static void work(const team *t, const sigset_t *before, pid_t parent) {
    unsigned char i;
    reset_signals(before);
#ifdef __linux__
    prctl(PR_SET_PDEATHSIG, SIGKILL);
#endif
    close(t->given[1]);
    close(t->done[0]);
    t->job.c->cores = 1;
    t->job.c->scene.pulse = t->job.c->now->pulse = NULL;
    for (;;) {
        /* Not exit: it would write the parent's buffers again and reset its terminal. */
        if (getppid() != parent || !pass_index(t->given[0], &i, true)) /* unreached: killed with the parent */
            _exit(0);
        slot_at(t, i)->valid = t->job.work(t->job.context, in_of(t, i), out_of(t, i));
        pass_index(t->done[1], &i, false);
    }
}

/* ---- the parent -------------------------------------------------------------------------------- */

static void close_end(int *fd) {
    if (*fd >= 0)
        close(*fd);
    *fd = -1;
}

static bool start(team *t, unsigned wanted) {
    sigset_t all, before;
    const pid_t parent = getpid();
    const team own = *t; /* for the workers: *t itself is shared and changes here */
    sigfillset(&all);
    sigprocmask(SIG_BLOCK, &all, &before);
    while (t->workers < wanted) {
        const pid_t id = fork();
        if (id == 0)
            work(&own, &before, parent);
        if (id < 0)
            break;
        t->worker[t->workers++] = id;
    }
    sigprocmask(SIG_SETMASK, &before, NULL);
    close_end(&t->given[0]);
    close_end(&t->done[1]);
    return t->workers > 0;
}

static bool open_all(team *t) {
    return !socketpair(AF_UNIX, SOCK_STREAM, 0, t->given) && !socketpair(AF_UNIX, SOCK_STREAM, 0, t->done);
}

team *team_begin(const team_job *job) {
    const unsigned wanted = cores(job->c);
    team fresh = {.job = *job, .given = {-1, -1}, .done = {-1, -1}, .slots = AHEAD * wanted};
    if (wanted < 2)
        return NULL;
    fresh.in_at = aligned(sizeof(slot));
    fresh.out_at = fresh.in_at + aligned(job->in);
    fresh.size = fresh.out_at + aligned(job->out);
    fresh.all = aligned(sizeof fresh) + fresh.slots * fresh.size;
    team *t = mmap(NULL, fresh.all, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (t == MAP_FAILED)
        return NULL;
    *t = fresh;
    t->memory = (char *)t + aligned(sizeof fresh);
    if (!open_all(t) || !start(t, wanted)) {
        team_end(t);
        return NULL;
    }
    return t;
}

static void kill_workers(team *t) {
    for (unsigned i = 0; i < t->workers; i++)
        kill(t->worker[i], SIGKILL);
    for (unsigned i = 0; i < t->workers; i++)
        while (waitpid(t->worker[i], NULL, 0) < 0 && errno == EINTR)
            ;
    t->workers = 0;
}

void team_end(team *t) {
    if (!t)
        return;
    kill_workers(t);
    for (int i = 0; i < 2; i++) {
        close_end(&t->given[i]);
        close_end(&t->done[i]);
    }
    munmap(t, t->all);
}

static bool team_stopped(const team *t) {
    return *t->job.c->scene.stop;
}

/* A worker that has ended was out of memory, or was killed: then end all, and compute the rest here. */
static void check_workers(team *t) {
    for (unsigned i = 0; i < t->workers; i++)
        if (waitpid(t->worker[i], NULL, WNOHANG) == t->worker[i]) {
            t->worker[i] = t->worker[--t->workers];
            t->alone = true;
            kill_workers(t); /* sets t->workers to 0: the loop ends */
        }
}

/* Waits until one more part is done, the stop flag is set, or there are no workers any more. */
static void wait_for_one(team *t) {
    struct pollfd done = {.fd = t->done[0], .events = POLLIN};
    unsigned char i;
    while (!t->alone && !team_stopped(t)) {
        const int n = poll(&done, 1, WAKE);
        if (n > 0 && pass_index(t->done[0], &i, true)) {
            slot_at(t, i)->done = true;
            return;
        }
        if (t->job.c->scene.pulse)
            t->job.c->scene.pulse();
        check_workers(t);
    }
}

bool team_work(team *t, const team_run *run) {
    for (size_t given = 0, taken = 0; taken < run->parts;) {
        for (; given < run->parts && given - taken < t->slots; given++) {
            unsigned char i = (unsigned char)(given % t->slots);
            *slot_at(t, i) = (slot){.done = false};
            run->give(run->context, given, in_of(t, i));
            if (!t->alone)
                pass_index(t->given[1], &i, false);
        }
        const unsigned i = (unsigned)(taken % t->slots);
        while (!slot_at(t, i)->done && !t->alone && !team_stopped(t))
            wait_for_one(t);
        if (team_stopped(t))
            return false;
        const slot *p = slot_at(t, i);
        if (!run->take(run->context, taken, in_of(t, i), p->done && p->valid ? out_of(t, i) : NULL))
            return false;
        taken++;
    }
    return true;
}
