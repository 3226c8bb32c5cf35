/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a session writes, kept as a transcript that `--replay` accepts; and what has been typed in it. */
#ifndef SHELL_RECORD_H
#define SHELL_RECORD_H

#include "shell/shell.h"

/* Begins a transcript: these statements, for a replay begins without a scene, then whatever comes. They end
 * in a mark: what is noted or warned of there was said before. Nothing is recorded in a replay. */
#define RECORD_GIVEN " # as it was"
bool record_begin(shell *sh, const char *path, const char *beginning, calc_error *error);
/* Ends it; false: there was none. A lost write is told. */
bool record_end(shell *sh);
/* The line that will be run, physical lines and all. */
void record_line(shell *sh, const char *text, size_t len);
/* Text that reached the terminal by another way than `out`: if that is a recorder's, it is recorded. */
void record_aside(FILE *out, const char *text);
/* Does the recorder pass on to standard output? */
bool record_shows(const shell *sh);

/* What is typed at the prompt is kept for `save history`. */
void typed_keep(shell *sh, const char *line);
void typed_write(const shell *sh, FILE *to);
void typed_forget(shell *sh);

#endif
