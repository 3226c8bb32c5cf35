/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Processes that wait for parts: the number of a part's place on the sheet goes to whoever reads it first,
 * and comes back when the part is done. */
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
    AHEAD = 3,  /* places for each of them: what is slow does not keep the others waiting */
    WAKE = 20,  /* ms: how often a stop and the end of a process are looked for */
    ALIGN = 64, /* bytes: enough for any type that a part holds */
};
static const double pays = 4e-3; /* seconds, many times what it costs to begin */

typedef struct place {
    bool of_use; /* what came of the part */
    bool done;   /* seen by the one who gave it */
} place;

struct team {
    team_job job;
    unsigned workers, places;
    pid_t worker[WORKERS];
    int given[2], done[2]; /* the first end is read, by the workers and by the one who gives */
    char *sheet;
    size_t in_at, out_at, size; /* of a place */
    size_t all;                 /* bytes; the sheet lies behind what it belongs to */
    bool alone;                 /* a worker is gone */
};

static unsigned cores(const calc *c) {
    static long there; /* asked once: the system reads a file for it */
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

static place *place_at(const team *t, unsigned i) {
    return (place *)(t->sheet + i * t->size);
}

static void *in_of(const team *t, unsigned i) {
    return t->sheet + i * t->size + t->in_at;
}

static void *out_of(const team *t, unsigned i) {
    return t->sheet + i * t->size + t->out_at;
}

/* ---- a worker ---------------------------------------------------------------------------------- */

static bool passes(int fd, unsigned char *i, bool reads) {
    ssize_t n;
    do
        n = reads ? read(fd, i, 1) : send(fd, i, 1, MSG_NOSIGNAL);
    while (n < 0 && errno == EINTR);
    return n == 1;
}

/* Handlers belong to the process that gives: a worker must not, say, remove its files. Ctrl-C reaches workers
 * too, and the giver ends them. Signals are blocked until this is done. */
static void leave_signals(const sigset_t *before) {
    signal(SIGINT, SIG_IGN);
    for (int n = 1; n < FILE_SIGNALS; n++)
        if (file_signal_ends(n) || n == SIGTSTP || n == SIGCONT || n == SIGWINCH || n == SIGCHLD)
            signal(n, SIG_DFL);
    sigprocmask(SIG_SETMASK, before, NULL);
}

static void work(const team *t, const sigset_t *before, pid_t giver) {
    unsigned char i;
    leave_signals(before);
#ifdef __linux__
    prctl(PR_SET_PDEATHSIG, SIGKILL);
#endif
    close(t->given[1]);
    close(t->done[0]);
    t->job.c->cores = 1;
    t->job.c->scene.pulse = t->job.c->now->pulse = NULL;
    for (;;) {
        /* Not exit: what is buffered would be written twice, and the terminal is the other's to give back. */
        if (getppid() != giver || !passes(t->given[0], &i, true)) /* unreached: killed with whoever gives */
            _exit(0);
        place_at(t, i)->of_use = t->job.work(t->job.context, in_of(t, i), out_of(t, i));
        passes(t->done[1], &i, false);
    }
}

/* ---- the one who gives ------------------------------------------------------------------------- */

static void close_end(int *fd) {
    if (*fd >= 0)
        close(*fd);
    *fd = -1;
}

static bool start(team *t, unsigned wanted) {
    sigset_t all, before;
    const pid_t giver = getpid();
    const team own = *t; /* for the workers: *t itself is shared and changes here */
    sigfillset(&all);
    sigprocmask(SIG_BLOCK, &all, &before);
    while (t->workers < wanted) {
        const pid_t id = fork();
        if (id == 0)
            work(&own, &before, giver);
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
    team fresh = {.job = *job, .given = {-1, -1}, .done = {-1, -1}, .places = AHEAD * wanted};
    if (wanted < 2)
        return NULL;
    fresh.in_at = aligned(sizeof(place));
    fresh.out_at = fresh.in_at + aligned(job->in);
    fresh.size = fresh.out_at + aligned(job->out);
    fresh.all = aligned(sizeof fresh) + fresh.places * fresh.size;
    team *t = mmap(NULL, fresh.all, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (t == MAP_FAILED)
        return NULL;
    *t = fresh;
    t->sheet = (char *)t + aligned(sizeof fresh);
    if (!open_all(t) || !start(t, wanted)) {
        team_end(t);
        return NULL;
    }
    return t;
}

static void dismiss(team *t) {
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
    dismiss(t);
    for (int i = 0; i < 2; i++) {
        close_end(&t->given[i]);
        close_end(&t->done[i]);
    }
    munmap(t, t->all);
}

static bool team_stopped(const team *t) {
    return *t->job.c->scene.stop;
}

/* A process that has ended was short of memory, or was killed: the rest is done here. */
static void look_after(team *t) {
    for (unsigned i = 0; i < t->workers; i++)
        if (waitpid(t->worker[i], NULL, WNOHANG) == t->worker[i]) {
            t->worker[i] = t->worker[--t->workers];
            t->alone = true;
            dismiss(t); /* leaves no worker: the loop ends */
        }
}

/* Until one more part is done, the run is to stop, or there are no others any more. */
static void wait_for_one(team *t) {
    struct pollfd done = {.fd = t->done[0], .events = POLLIN};
    unsigned char i;
    while (!t->alone && !team_stopped(t)) {
        const int n = poll(&done, 1, WAKE);
        if (n > 0 && passes(t->done[0], &i, true)) {
            place_at(t, i)->done = true;
            return;
        }
        if (t->job.c->scene.pulse)
            t->job.c->scene.pulse();
        look_after(t);
    }
}

bool team_work(team *t, const team_run *run) {
    for (size_t given = 0, taken = 0; taken < run->parts;) {
        for (; given < run->parts && given - taken < t->places; given++) {
            unsigned char i = (unsigned char)(given % t->places);
            *place_at(t, i) = (place){.done = false};
            run->give(run->context, given, in_of(t, i));
            if (!t->alone)
                passes(t->given[1], &i, false);
        }
        const unsigned i = (unsigned)(taken % t->places);
        while (!place_at(t, i)->done && !t->alone && !team_stopped(t))
            wait_for_one(t);
        if (team_stopped(t))
            return false;
        const place *p = place_at(t, i);
        if (!run->take(run->context, taken, in_of(t, i), p->done && p->of_use ? out_of(t, i) : NULL))
            return false;
        taken++;
    }
    return true;
}
