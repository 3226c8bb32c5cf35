/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reads scripts to be stepped through: a lesson from a user's file, or a script of the full-screen mode. */
#ifndef PROMPT_LESSON_H
#define PROMPT_LESSON_H

#include "statement/shell.h"

typedef struct lesson_text {
    char *title; /* NULL: read by lesson_lines */
    char **line; /* statements and comments, ended by NULL */
    size_t count, room;
} lesson_text;

/* Reads a script, or the statements of a transcript. False with the error. Free `out` in any case. */
bool lesson_lines(const char *path, lesson_text *out, calc_error *error);
/* The same for a lesson, whose first line is its title; also runs it, without output, in a session of its own
 * and reports each mistake with its line. */
bool lesson_read(shell *sh, const char *path, lesson_text *out, calc_error *error);
void lesson_free(lesson_text *t);

#endif
