/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A recorder, and the session's own streams below it. record.c is what it does. */
#ifndef STATEMENT_RECORDER_H
#define STATEMENT_RECORDER_H

#include "statement/handout.h"
#include "statement/shell.h"

enum { HELD = 1024 };

struct recorder {
    shell *sh;
    file_log log;
    FILE *out, *err;           /* of the session; NULL: a page has it alone */
    FILE *both_out, *both_err; /* with the file */
    handout page;              /* of HTML, where it is no transcript */
    FILE *to_log;              /* of a page that grows with the session; or NULL */
    bool apart;                /* what is written now is on the page in another way */
    struct recorder *outer;    /* goes on after a page that has the session alone */
    FILE *outer_out, *outer_err;
    char held[HELD]; /* of the line that is being written */
    size_t held_count;
    bool escape; /* within a colour, which a transcript does without */
    bool lost;   /* the file cannot be written any more */
};

/* Does the recorder pass on to standard output? */
static inline bool record_shows(const shell *sh) {
    return sh->record && sh->record->out == stdout;
}

#endif
