/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Work in many like parts on several cores: by processes that are copies of this one as it stood when the
 * team began. They share a sheet of memory and nothing else: whatever a part changes is seen nowhere but in
 * what it hands back, and digits do not depend on how many work. Prints nothing. */
#ifndef STUDY_TEAM_H
#define STUDY_TEAM_H

#include "language/calc.h"

typedef struct team team;

typedef struct team_job {
    calc *c;
    size_t in, out; /* bytes of a part as it is given, and of what comes of it */
    /* In a copy. False: nothing came of it. */
    bool (*work)(void *context, const void *in, void *out);
    void *context;
} team_job;

/* One run through parts 0, 1, ... */
typedef struct team_run {
    size_t parts;
    void (*give)(void *context, size_t part, void *in);
    /* In their order; NULL: nothing came of it, and it is to be done here. False ends the run. */
    bool (*take)(void *context, size_t part, const void *in, const void *out);
    void *context;
} team_run;

/* NULL: one core, or no process or memory to be had. */
team *team_begin(const team_job *job);
/* False: `take` ended it, or the calculator is to stop; no further run then. */
bool team_work(team *t, const team_run *run);
void team_end(team *t); /* NULL too */

/* Does a team pay, where `done` of `all` have taken so many seconds? */
bool team_pays(double taken, double done, double all);

#endif
