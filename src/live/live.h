/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The full-screen mode: keys press and push the contact and views show it. Every change is a statement of the
 * language, run by the host. */
#ifndef LIVE_LIVE_H
#define LIVE_LIVE_H

#include "language/calc.h"
#include "text/file.h"

/* What the full-screen mode needs from the program. */
typedef struct live_host {
    void *self;
    calc *calc;
    const int *digits;            /* of printed values */
    const bool *quit;             /* a statement has ended the program */
    const side_by_side *compared; /* the scenes of the last `compare` */
    volatile sig_atomic_t *stop;  /* Ctrl-C was pressed */
    /* Runs a line of statements. *answer gets its output and errors, to be freed, or NULL if out of memory.
     * False: an error. */
    bool (*run)(void *self, const char *line, char **answer);
    /* Completes the word before the cursor as far as all candidates agree, and moves the cursor behind it. */
    void (*complete)(void *self, char *line, size_t size, size_t *cursor);
} live_host;

/* Processor time [s] spent on frames, in total and in the worst turn of the loop. */
typedef struct live_work {
    size_t frames;
    double total, worst;
} live_work;

/* Runs until the user leaves. script: lines to step through, each a statement, a comment or empty, ended by
 * NULL; or NULL. Without a terminal a script plays by itself, and *screen gets the text of the last screen
 * (to be freed). False with the error if the terminal cannot be used, or out of memory. */
bool live_run(const live_host *host, const char *const *script, live_work *work, char **screen,
              calc_error *error);

/* Writes the keys and what they do, for help. */
void live_keys(FILE *to);

#endif
