/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A lesson in a file of whoever teaches. */
#ifndef PROMPT_LESSON_H
#define PROMPT_LESSON_H

#include "statement/shell.h"

typedef struct lesson_text {
    char *title;
    char **line; /* statements and comments, ended by NULL */
    size_t count, room;
} lesson_text;

/* Reads it, and runs it unseen in a session of its own: mistakes are told line by line. False with the error;
 * to be freed whatever comes. */
bool lesson_read(shell *sh, const char *path, lesson_text *out, calc_error *error);
void lesson_free(lesson_text *t);

#endif
