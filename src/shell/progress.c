/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Progress of statements that take long. Writes to standard error, where that is a terminal: there is one, and one line
 * of it, hence the static state. */
#include "shell/progress.h"

#include <string.h>
#include <time.h>
#include <unistd.h>

#include "shell/record.h"

enum { LINE = 60, WHAT = 20 };
static const double WAIT = 0.5, EVERY = 0.1; /* seconds */

static struct {
    int depth; /* of statements; 0: none runs */
    bool on;
    const shell *sh;
    char what[WHAT];
    double began, shown; /* in seconds */
    double part;         /* negative: not known */
    bool seen;           /* the line is on the terminal */
} now;

static double seconds(void) {
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

void progress_begin(const shell *sh, const char *what, size_t len) {
    if (now.depth++ > 0)
        return;
    now.on = (sh->err == stderr || record_shows(sh)) && !sh->replaying && isatty(STDERR_FILENO);
    if (!now.on)
        return;
    now.sh = sh;
    now.began = seconds();
    now.part = -1;
    now.seen = false;
    snprintf(now.what, sizeof now.what, "%.*s", (int)(len < WHAT ? len : WHAT - 1), what);
}

void progress_words(const char *words) {
    if (!now.on || now.depth == 0)
        return;
    if (!now.seen)
        fflush(now.sh->out);
    now.seen = true;
    fprintf(stderr, "\r%-*.*s", LINE - 1, LINE - 1, words); /* past the recorder */
    fflush(stderr);
}

void progress_pulse(void) {
    char words[LINE], left[24] = "";
    if (!now.on || now.depth == 0)
        return;
    const double t = seconds(), taken = t - now.began;
    if (taken < WAIT || t - now.shown < EVERY)
        return;
    now.shown = t;
    if (now.part > 0.01)
        snprintf(left, sizeof left, ", %.0f s to go", taken / now.part * (1 - now.part));
    if (now.part >= 0)
        snprintf(words, sizeof words, "%s: %.0f %%%s (Ctrl-C stops it)", now.what, 100 * now.part, left);
    else
        snprintf(words, sizeof words, "%s: %.0f s (Ctrl-C stops it)", now.what, taken);
    progress_words(words);
}

void progress_part(double part) {
    now.part = part;
    progress_pulse();
}

void progress_wipe(void) {
    if (!now.seen)
        return;
    now.seen = false;
    fprintf(stderr, "\r%*s\r", LINE + 2, ""); /* the ^C, too */
    fflush(stderr);
}

void progress_end(void) {
    if (--now.depth == 0)
        progress_wipe();
}
