/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Lines typed by a user: prompt_readline.c, or prompt_plain.c where readline is not wanted (READLINE=no). */
#ifndef PROMPT_PROMPT_H
#define PROMPT_PROMPT_H

#include "statement/shell.h"

/* Once, before the first line; sh is what completion looks at, and what tells why no history is kept. */
void prompt_begin(shell *sh);
/* What has been typed, without its end, to be freed; NULL at the end of input and after Ctrl-C (shell_stop).
 * A paste may hold several lines. The terminal is at the beginning of a line then. */
char *prompt_line(const char *text);
/* Ctrl-C has dropped the line: clears what the editor holds of it. */
void prompt_dropped(void);
/* Remembers a line for the user to recall, unless it is very long; one that holds line ends as one line. */
void prompt_keep(const char *line);

/* prompt.c: the path of a file of the program's own, in the directory that the variable names, else in the
 * one below home. Returns how much of it is not ours to make; 0: nowhere. A relative directory is none, as
 * the XDG specification has it: what lies in the current directory may be a stranger's. */
enum { PROMPT_PATH = 4096 };
size_t prompt_path(char path[PROMPT_PATH], const char *variable, const char *otherwise, const char *file);

#endif
