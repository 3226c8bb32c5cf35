/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A recorder, and the session's own streams below it: what is asked of it by whoever writes. record.c is what
 * it does. */
#ifndef STATEMENT_RECORDER_H
#define STATEMENT_RECORDER_H

#include "statement/shell.h"

enum { HELD = 1024 };

struct recorder {
    shell *sh;
    file_log log;
    FILE *out, *err;           /* of the session */
    FILE *both_out, *both_err; /* with the file */
    char held[HELD];           /* of the line that is being written */
    size_t held_count;
    bool escape; /* within a colour, which a transcript does without */
    bool lost;   /* the file cannot be written any more */
};

/* Does the recorder pass on to standard output? */
bool record_shows(const shell *sh);
/* Others in place of the session's own streams, below a recorder, which are those then. */
void record_swap(shell *sh, FILE **out, FILE **err);

#endif
