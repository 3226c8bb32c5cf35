/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Worker processes for many similar parts of work: forks of this process as it is when the team begins, with
 * shared memory for inputs and results. What else a part changes stays in its worker, and digits do not
 * depend on the number of workers. Depends on POSIX, language/calc and text/file; prints nothing. */
#ifndef STUDY_TEAM_H
#define STUDY_TEAM_H

#include "language/calc.h"

typedef struct team team;

typedef struct team_job {
    calc *c;
    size_t in, out; /* bytes of the input and of the result of a part */
    /* Computes a part in a worker. False: no result. */
    bool (*work)(void *context, const void *in, void *out);
    void *context;
} team_job;

/* One run through parts 0, 1, ...; the callbacks run in the process that has begun the team. */
typedef struct team_run {
    size_t parts;
    /* Writes the input of a part. */
    void (*give)(void *context, size_t part, void *in);
    /* Receives the results in order. out NULL: none, compute the part here. False ends the run. */
    bool (*take)(void *context, size_t part, const void *in, const void *out);
    void *context;
} team_run;

/* Starts the workers. NULL: there is one core only, or processes or memory are lacking. */
team *team_begin(const team_job *job);
/* Runs all parts. False: `take` has ended it, or the stop flag is set; only team_end may follow. */
bool team_work(team *t, const team_run *run);
/* Kills the workers and frees the team; t may be NULL. */
void team_end(team *t);

/* Is a team worth starting if `done` of `all` points have taken `taken` seconds? */
bool team_pays(double taken, double done, double all);

#endif
