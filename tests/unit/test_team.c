/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A team does what one would: in order, also when a worker ends, when something is to stop, and when the
 * system has no process, no memory or no socket for it. */
#include <errno.h>
#include <fcntl.h>
#include <sys/resource.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include "unit.h"

#define unit calc_unit /* the other one is at work here */
#include "study/team.h"
#undef unit

enum { PARTS = 200 };

static volatile sig_atomic_t stop;
static int gate[2]; /* opened by a pulse */

static void pulse(void) {
    CHECK(write(gate[1], "", 1) == 1);
}

typedef struct errand {
    pid_t giver;
    size_t dies_at, stops_at, ends_at; /* parts */
    bool waits;                        /* each part for a pulse */
    size_t taken, alone;               /* parts, and those that nothing came of */
    long sum;
} errand;

static bool work(void *context, const void *in, void *out) {
    const errand *e = context;
    const size_t part = *(const size_t *)in;
    char byte;
    if (e->waits && read(gate[0], &byte, 1) != 1)
        return false;
    if (part == e->dies_at && getpid() != e->giver)
        _exit(0);
    *(long *)out = (long)(part * part);
    return part % 7 != 0;
}

static void give(void *context, size_t part, void *in) {
    (void)context;
    *(size_t *)in = part;
}

static bool take(void *context, size_t part, const void *in, const void *out) {
    errand *e = context;
    CHECK(*(const size_t *)in == part && e->taken == part);
    CHECK(!out || *(const long *)out == (long)(part * part));
    e->taken++;
    e->alone += !out;
    e->sum += (long)(part * part);
    stop = part == e->stops_at;
    return part != e->ends_at;
}

static errand begin(void) {
    stop = 0;
    return (errand){.giver = getpid(), .dies_at = PARTS, .stops_at = PARTS, .ends_at = PARTS};
}

static team *team_of(calc *c, errand *e) {
    return team_begin(
        &(team_job){.c = c, .in = sizeof(size_t), .out = sizeof(long), .work = work, .context = e});
}

static bool run(team *t, errand *e, size_t parts) {
    return team_work(t, &(team_run){.parts = parts, .give = give, .take = take, .context = e});
}

static void in_order(calc *c) {
    errand e = begin();
    team *t = team_of(c, &e);
    if (!CHECK(t != NULL))
        return;
    CHECK(run(t, &e, 0) && e.taken == 0);
    CHECK(run(t, &e, PARTS) && e.taken == PARTS && e.sum == (PARTS - 1L) * PARTS * (2 * PARTS - 1L) / 6);
    CHECK(e.alone == (PARTS + 6) / 7); /* what nothing came of */
    e.taken = 0;                       /* once more by the same workers */
    CHECK(run(t, &e, PARTS) && e.taken == PARTS);
    e.taken = 0;
    e.ends_at = 10;
    CHECK(!run(t, &e, PARTS) && e.taken == 11);
    team_end(t);
    team_end(NULL);
}

/* The rest is done by the one who gives. */
static void a_worker_ends(calc *c) {
    errand e = begin();
    e.dies_at = 20;
    team *t = team_of(c, &e);
    if (!CHECK(t != NULL))
        return;
    CHECK(run(t, &e, PARTS) && e.taken == PARTS && e.alone > PARTS / 2);
    e.taken = 0;
    CHECK(run(t, &e, PARTS) && e.taken == PARTS);
    team_end(t);
}

static void it_stops(calc *c) {
    errand e = begin();
    e.stops_at = 30;
    team *t = team_of(c, &e);
    if (!CHECK(t != NULL))
        return;
    CHECK(!run(t, &e, PARTS) && e.taken == 31);
    team_end(t);
    stop = 0;
}

static void nothing(int number) {
    (void)number;
}

/* Signals that interrupt every call change nothing, and leave no worker behind. */
static void in_a_storm(calc *c) {
    const struct sigaction wakes = {.sa_handler = nothing};
    const struct itimerval often = {{0, 1000}, {0, 1000}}, off = {{0, 0}, {0, 0}};
    struct sigaction before;
    CHECK(sigaction(SIGALRM, &wakes, &before) == 0 && setitimer(ITIMER_REAL, &often, NULL) == 0);
    for (int i = 0; i < 60; i++) {
        errand e = begin();
        team *t = team_of(c, &e);
        if (!CHECK(t != NULL))
            break;
        CHECK(run(t, &e, PARTS) && e.taken == PARTS && e.alone == (PARTS + 6) / 7);
        team_end(t);
        CHECK(waitpid(-1, NULL, WNOHANG) < 0 && errno == ECHILD);
    }
    CHECK(setitimer(ITIMER_REAL, &off, NULL) == 0 && sigaction(SIGALRM, &before, NULL) == 0);
}

/* While one waits, what is called now and then is called. */
static void it_pulses(calc *c) {
    errand e = begin();
    e.waits = true;
    CHECK(!pipe(gate));
    c->scene.pulse = pulse;
    team *t = team_of(c, &e);
    CHECK(t && run(t, &e, 4) && e.taken == 4 && e.alone == 1);
    team_end(t);
    c->scene.pulse = NULL;
    close(gate[0]);
    close(gate[1]);
}

/* Under a limit there is no team, and none is missed. */
static void limited(calc *c, int what, rlim_t most) {
    errand e = begin();
    struct rlimit before;
    CHECK(!getrlimit(what, &before));
    const struct rlimit tight = {most, before.rlim_max};
    if (setrlimit(what, &tight))
        return;
    CHECK(team_of(c, &e) == NULL);
    CHECK(!setrlimit(what, &before));
}

static void nothing_to_be_had(calc *c) {
    const int next = open("/dev/null", O_RDONLY);
    CHECK(next >= 0);
    close(next);
    limited(c, RLIMIT_NOFILE, (rlim_t)next);     /* no socket */
    limited(c, RLIMIT_NOFILE, (rlim_t)next + 2); /* one pair of two */
    errand e = begin();
    CHECK(team_begin(&(team_job){.c = c, .out = (size_t)1 << 46, .work = work, .context = &e}) == NULL);
    c->cores = 1;
    CHECK(team_of(c, &e) == NULL);
    c->cores = 1000; /* as many as there is room for */
    team *t = team_of(c, &e);
    CHECK(t && run(t, &e, PARTS) && e.taken == PARTS);
    team_end(t);
    c->cores = 2;
    CHECK(team_pays(1, 1, 2) && !team_pays(1, 1, 1) && !team_pays(1e-4, 1, 1e6) && !team_pays(1, 0, 2));
    CHECK(!team_pays(1, 1e6, 1e6 + 1));
}

int main(int argc, char **argv) {
    unit_start("team", argc, argv);
    static calc c;
    calc_init(&c, &stop);
    c.cores = 2;
    CASE(in_order(&c));
    CASE(a_worker_ends(&c));
    CASE(it_stops(&c));
    CASE(in_a_storm(&c));
    CASE(it_pulses(&c));
    CASE(nothing_to_be_had(&c));
    calc_free(&c);
    return unit_finish();
}
