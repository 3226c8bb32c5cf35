/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a session writes, kept as a transcript that `--replay` accepts; and what has been typed in it. */
#ifndef STATEMENT_RECORD_H
#define STATEMENT_RECORD_H

#include "statement/handout.h"
#include "statement/shell.h"

/* A recorder, and the session's own streams below it. */
struct recorder {
    shell *sh;
    file_log log;
    FILE *out, *err;           /* of the session; NULL: a page has it alone */
    FILE *both_out, *both_err; /* with the file */
    FILE *kept;                /* what is recorded, without colours: on the page, or in the file */
    handout page;              /* of HTML, where it is no transcript */
    FILE *to_log;              /* of a page that grows with the session; or NULL */
    bool apart;                /* what is written now is on the page in another way */
    struct recorder *outer;    /* goes on after a page that has the session alone */
    FILE *outer_out, *outer_err;
    bool escape; /* within a colour, which a transcript does without */
    bool lost;   /* the file cannot be written any more */
};

/* Does the recorder pass on to standard output? */
static inline bool record_shows(const shell *sh) {
    return sh->record && sh->record->out == stdout;
}

/* A page, as .html asks for, or a transcript? */
bool record_as_page(const char *path);
/* Begins it with these statements, for a replay begins without
 * a scene, then whatever comes; what has been recorded so far ends. Nothing is recorded in a replay. What
 * cannot be written any more is told at once, and the session goes on. The statements end in a mark: what is
 * noted or warned of there was said before. */
#define RECORD_GIVEN " # as it was"
bool record_begin(shell *sh, const char *path, const char *beginning, calc_error *error);
/* Ends it, and tells what it wrote; false: there was none. */
bool record_end(shell *sh, bool tells);
/* The line that will be run, physical lines and all. */
void record_line(shell *sh, const char *text, size_t len);
/* Text that reached the terminal by another way than the session's streams. */
void record_aside(const char *text);
/* Others in place of the session's own streams, below a recorder, which are those then. */
void record_swap(shell *sh, FILE **out, FILE **err);

/* Until the end the session is written on a page alone, whatever else is recorded. False: with the error. */
bool record_page(shell *sh, FILE *to, const char *title, calc_error *error);
bool record_page_end(shell *sh, calc_error *error);
/* Is there a page, and does it have the session alone? */
bool record_on_page(const shell *sh);
bool record_alone(const shell *sh);
/* An error that ends what is played, to whoever waits for the page that has the session alone. */
void record_tell(shell *sh, const char *text);
/* This on a page, if there is one, in place of what the session writes before record_together. */
void record_apart(shell *sh, page_part part, const char *text);
void record_together(shell *sh);

/* What is typed at the prompt is kept for `save history`. */
void typed_keep(shell *sh, const char *line);
/* False: there was no memory to keep all of it. */
bool typed_write(const shell *sh, FILE *to);
void typed_forget(shell *sh);

#endif
