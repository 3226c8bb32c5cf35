/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a session writes, kept as a transcript that `--replay` accepts; and what has been typed in it. */
#ifndef STATEMENT_RECORD_H
#define STATEMENT_RECORD_H

#include "statement/shell.h"

/* Begins a transcript: these statements, for a replay begins without a scene, then whatever comes; what has
 * been recorded so far ends. Nothing is recorded in a replay. What cannot be written any more is told at
 * once, and the session goes on. The statements end in a mark: what is noted or warned of there was said
 * before. */
#define RECORD_GIVEN " # as it was"
bool record_begin(shell *sh, const char *path, const char *beginning, calc_error *error);
/* Ends it, and tells what it wrote; false: there was none. */
bool record_end(shell *sh, bool tells);
/* The line that will be run, physical lines and all. */
void record_line(shell *sh, const char *text, size_t len);
/* Text that reached the terminal by another way than the session's streams. */
void record_aside(const char *text);

/* What is typed at the prompt is kept for `save history`. */
void typed_keep(shell *sh, const char *line);
/* False: there was no memory to keep all of it. */
bool typed_write(const shell *sh, FILE *to);
void typed_forget(shell *sh);

#endif
