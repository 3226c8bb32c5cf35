/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Shows the progress of long statements: one line on standard error, hence the static state. */
#include "statement/progress.h"

#include <string.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include "statement/record.h"
#include "text/clock.h"

enum { LINE = 60, WHAT = 20 };
static const double WAIT = 0.5, EVERY = 0.1; /* seconds */

static struct {
    int depth;    /* of nested statements; 0: none runs */
    int terminal; /* is standard error a terminal? negative: isatty has not been called yet */
    bool on;      /* progress of this statement is shown */
    const shell *sh;
    char what[WHAT];     /* first word of the statement, without NUL */
    size_t len;          /* of `what` */
    double began, shown; /* time of the statement's begin, and of the last line; seconds */
    double part;         /* done, 0 to 1; negative: unknown */
    int width;           /* of the line, less than the terminal's: a line that wraps could not be wiped */
    bool seen;           /* the line is on the terminal */
} now = {.terminal = -1};

void progress_begin(const shell *sh, const char *what, size_t len) {
    if (now.depth++ > 0)
        return;
    if (now.terminal < 0)
        now.terminal = isatty(STDERR_FILENO);
    now.on = now.terminal && (sh->err == stderr || record_shows(sh));
    if (!now.on)
        return;
    now.sh = sh;
    now.began = clock_wall();
    now.part = -1;
    now.seen = false;
    for (now.len = 0; now.len < len && now.len < WHAT && !strchr(" \t\n\r", what[now.len]); now.len++)
        now.what[now.len] = what[now.len];
}

static void find_width(void) {
    struct winsize size = {.ws_col = 0};
    ioctl(STDERR_FILENO, TIOCGWINSZ, &size);
    const bool narrow = size.ws_col > 4 && size.ws_col < LINE + 3;
    now.width = narrow ? size.ws_col - 3 : LINE - 1;
}

void progress_words(const char *words) {
    if (!now.on)
        return;
    if (!now.seen) {
        fflush(now.sh->out);
        find_width();
    }
    now.seen = true;
    fprintf(stderr, "\r%-*.*s", now.width, now.width, words); /* not through sh->err: it is not recorded */
    fflush(stderr);
}

void progress_pulse(void) {
    char words[LINE + 40], left[24] = "";
    if (!now.on)
        return;
    const double t = clock_wall(), taken = t - now.began;
    if (taken < WAIT || t - now.shown < EVERY)
        return;
    now.shown = t;
    if (now.part > 0.01)
        snprintf(left, sizeof left, ", %.0f s to go", taken / now.part * (1 - now.part));
    if (now.part >= 0)
        snprintf(words, sizeof words, "%.*s: %.0f %%%s (Ctrl-C stops it)", (int)now.len, now.what,
                 100 * now.part, left);
    else
        snprintf(words, sizeof words, "%.*s: %.0f s (Ctrl-C stops it)", (int)now.len, now.what, taken);
    progress_words(words);
}

void progress_hide(void) {
    progress_wipe();
    now.on = false;
}

void progress_part(double part) {
    now.part = part;
    progress_pulse();
}

void progress_wipe(void) {
    if (!now.seen)
        return;
    now.seen = false;
    fprintf(stderr, "\r%*s\r", now.width + 2, ""); /* 2 more columns: a ^C that the terminal has echoed */
    fflush(stderr);
}

void progress_end(void) {
    progress_wipe();
    if (--now.depth == 0)
        now.on = false;
}

int progress_suspend(void) {
    const int depth = now.depth;
    progress_hide();
    now.depth = 0;
    return depth;
}

void progress_resume(int depth) {
    progress_hide();
    now.depth = depth;
}
