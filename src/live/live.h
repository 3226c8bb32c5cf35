/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The full-screen mode: the contact pressed, pushed and pulled by hand. Everything done is a statement of the
 * language, run by its host. */
#ifndef LIVE_LIVE_H
#define LIVE_LIVE_H

#include "language/calc.h"
#include "text/file.h"

/* What the program around the language does for it. */
typedef struct live_host {
    void *self;
    calc *calc;
    const int *digits; /* of printed values */
    const bool *quit;  /* the user wants to leave the program */
    const side_by_side *compared;
    volatile sig_atomic_t *stop;
    /* Runs a line of statements. What it says, errors too, goes into answer (to be freed, or NULL); false: an
     * error. */
    bool (*run)(void *self, const char *line, char **answer);
    /* The line with the word before the cursor completed as far as it is the same for all candidates; the
     * cursor moves. */
    void (*complete)(void *self, char *line, size_t size, size_t *cursor);
} live_host;

/* Work on frames: seconds of the processor, writing to the terminal included. */
typedef struct live_work {
    size_t frames;
    double total, worst;
} live_work;

/* Until the user leaves. script: lines to step through, ended by NULL, each a statement, a comment or
 * nothing; or NULL. Where there is no terminal a script plays by itself, and *screen, NULL before, is what it
 * shows in the end, as text (to be freed). False with the error where there is no terminal for it. */
bool live_run(const live_host *host, const char *const *script, live_work *work, char **screen,
              calc_error *error);

/* Its keys and what they do, for help. */
void live_keys(FILE *to);

#endif
