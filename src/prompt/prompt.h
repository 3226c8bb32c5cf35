/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Lines typed by a user: prompt_readline.c, or prompt_plain.c where readline is not wanted (READLINE=no). */
#ifndef PROMPT_PROMPT_H
#define PROMPT_PROMPT_H

#include "statement/shell.h"

/* Once, before the first line; sh is what completion looks at, and what tells why no history is kept. */
void prompt_begin(shell *sh);
/* What has been typed, without its end, to be freed; NULL at the end of input and after Ctrl-C (shell_stop).
 * The lines of a paste come one by one, each at a prompt of its own; the last waits for Enter. continued: it
 * goes on with the line before. The terminal is at the beginning of a line then. */
char *prompt_line(const char *text, bool continued);
/* The lines of a paste that are still to come go. */
void prompt_drop(void);
/* Remembers a line for the user to recall, unless it is very long; one that holds line ends as one line. */
void prompt_keep(const char *line);

#endif
