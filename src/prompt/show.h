/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Writes the scene as the statements that make it again, and the tables of `show`. */
#ifndef PROMPT_SHOW_H
#define PROMPT_SHOW_H

#include "statement/shell.h"

/* Writes the scene and the user's names as statements that make them again in a session without a scene,
 * numbers exact to the last digit. whole: every step of the load, and the model; else the middle of a long
 * load becomes a comment. False: out of memory. */
bool scene_write(shell *sh, FILE *to, bool whole);

/* The i-th word that `show` takes; NULL after the last. */
const char *show_name(size_t i);

/* Writes what one of these words stands for; false: out of memory. */
typedef bool show_part(shell *sh, FILE *to);
show_part show_settings;
/* The same onto the session's output, by the pager if it is long. False with the error. */
bool show_text(shell *sh, show_part *part, calc_error *error);

#endif
