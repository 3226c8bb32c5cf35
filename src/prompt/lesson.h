/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A script to be stepped through: a lesson in a file of whoever teaches, or the script of the full-screen
 * mode. */
#ifndef PROMPT_LESSON_H
#define PROMPT_LESSON_H

#include "statement/shell.h"

typedef struct lesson_text {
    char *title; /* NULL: lines alone */
    char **line; /* statements and comments, ended by NULL */
    size_t count, room;
} lesson_text;

/* Both read a script, or a transcript, of which what follows its prompts counts. False with the error; to be
 * freed whatever comes. */
bool lesson_lines(const char *path, lesson_text *out, calc_error *error);
/* With its title, and run unseen in a session of its own: mistakes are told line by line. */
bool lesson_read(shell *sh, const char *path, lesson_text *out, calc_error *error);
void lesson_free(lesson_text *t);

#endif
