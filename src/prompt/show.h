/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What is set, as the statements that set it again. */
#ifndef PROMPT_SHOW_H
#define PROMPT_SHOW_H

#include "statement/shell.h"

/* The scene and the user's names as statements that make them again in a session without a scene: inputs and
 * load to the last digit. whole: every step of the load, and the model; else the middle of a long load is
 * left out, and a comment says so. */
bool scene_write(shell *sh, FILE *to, bool whole);

/* What `show` can show: i = 0, 1, ... until NULL. */
const char *show_name(size_t i);

/* One of them; false: out of memory. demo.c has the scripted sessions. */
typedef bool show_part(shell *sh, FILE *to);
show_part show_settings, show_demos;
/* As text on the session's output. */
bool show_text(shell *sh, show_part *part, calc_error *error);

#endif
