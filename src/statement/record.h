/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Records a session: as a transcript that `--replay` accepts or as a page of HTML. Keeps typed lines. */
#ifndef STATEMENT_RECORD_H
#define STATEMENT_RECORD_H

#include "statement/handout.h"
#include "statement/shell.h"

/* A recorder takes the place of the session's streams and writes to both them and the record. A lesson's page
 * (record_page) takes their place alone, and suspends the recorder before it. */
struct recorder {
    shell *sh;
    file_log log;
    FILE *out, *err;           /* the session's own streams; NULL: the page alone is written */
    FILE *both_out, *both_err; /* shell.out and shell.err: write to `out` or `err`, and to `kept` */
    FILE *kept;                /* writes to the page or the transcript; without colours */
    handout page;              /* page.to is NULL: a transcript is written */
    FILE *to_log;           /* page.to of a recording, writes to `log`; NULL: transcript or lesson's page */
    bool apart;             /* output is not recorded: the page has it in another way (record_replace) */
    struct recorder *outer; /* of a lesson's page: the recorder that goes on after it, or NULL */
    FILE *outer_out, *outer_err;
    bool escape; /* within an escape sequence (a colour), which is not recorded */
    bool lost;   /* writing failed: nothing more is recorded */
};

/* Does the recorder pass output on to standard output? */
static inline bool record_shows(const shell *sh) {
    return sh->record && sh->record->out == stdout;
}

/* Is the record of this path a page (.html)? Else it is a transcript. */
bool record_as_page(const char *path);
/* Begins a record of this path and ends the one before; in a replay it does nothing. The record begins with
 * the statements `beginning`, which set up the present scene, since a replay begins without one. In a
 * transcript they end in RECORD_GIVEN: their notes and warnings were given earlier, so a replay does not
 * expect them. A write that fails later is reported once, and the session goes on without a record. */
#define RECORD_GIVEN " # as it was"
bool record_begin(shell *sh, const char *path, const char *beginning, calc_error *error);
/* Ends the record; tells: reports its size. False: there was none (in a replay always true). */
bool record_end(shell *sh, bool tells);
/* Records the logical line that is run next, by its physical lines. */
void record_line(shell *sh, const char *text, size_t len);
/* Records text that reached the terminal past the session's streams (by the pager). */
void record_aside(const char *text);
/* Swaps the session's own streams (below a recorder, if there is one) with *out and *err. */
void record_swap(shell *sh, FILE **out, FILE **err);

/* Until record_page_end the session is written on a page only, not to its streams or record. */
bool record_page(shell *sh, FILE *to, const char *title, calc_error *error);
bool record_page_end(shell *sh, calc_error *error);
/* Is a page being written? Is it one of record_page? */
bool record_on_page(const shell *sh);
bool record_alone(const shell *sh);
/* Reports an error that ends the lesson on the streams outside the page of record_page; else does nothing. */
void record_tell(shell *sh, const char *text);
/* Puts a part on the page, if there is one, in place of what the session writes before record_replaced. */
void record_replace(shell *sh, page_part part, const char *text);
void record_replaced(shell *sh);

/* Keeps a line typed at the prompt, for `save history`. */
void typed_keep(shell *sh, const char *line);
/* Writes the lines kept. False: memory ran out, some are missing. */
bool typed_write(const shell *sh, FILE *to);
void typed_forget(shell *sh);

#endif
