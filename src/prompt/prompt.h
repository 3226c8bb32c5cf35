/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reads typed lines: prompt_readline.c, or prompt_plain.c when built with READLINE=no. */
#ifndef PROMPT_PROMPT_H
#define PROMPT_PROMPT_H

#include "statement/shell.h"

/* Call once, before the first line. Completion looks at sh; messages about the history go to it. */
void prompt_begin(shell *sh);
/* Shows the prompt `text` and returns the line typed, without its newline, for the caller to free; NULL at
 * the end of input and after Ctrl-C (shell_stop). The lines of a paste come one by one, each at a prompt of
 * its own; the last waits for Enter. continued: the line continues the one before. */
char *prompt_line(const char *text, bool continued);
/* Drops the lines of a paste that have not been returned yet. */
void prompt_drop(void);
/* Adds a line to the history, newlines as blanks, unless it is very long. */
void prompt_keep(const char *line);

#endif
