/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A terminal's output as it comes, in asciicast v2: a header, then a line of JSON an event. */
#ifndef TEXT_CAST_H
#define TEXT_CAST_H

#include <stdbool.h>
#include <stddef.h>

#include "text/file.h"

typedef struct cast cast;

/* Into the log, which stays the caller's. clock: times are those of the clock, the size is the terminal's.
 * Else a script's: typed at an even pace, with time to read, the same in every run. NULL with the error. */
cast *cast_begin(file_log *log, bool clock, calc_error *error);
/* What the program writes: the ends of lines are `\n`, as for a terminal. False: it could not be kept, the
 * error says why; nothing is from then on. */
bool cast_write(cast *c, const char *bytes, size_t n, calc_error *error);
/* A script's statement, as if typed after this prompt. */
bool cast_type(cast *c, const char *prompt, const char *text, size_t n, calc_error *error);
/* In a script's: so many seconds pass. */
void cast_wait(cast *c, double seconds);
/* The size of the screen. */
void cast_size(const cast *c, int *cols, int *rows);
bool cast_has_clock(const cast *c);
/* whole: all that came has been written; else nothing more is. */
bool cast_end(cast *c, bool whole, calc_error *error);

#endif
