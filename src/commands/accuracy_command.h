/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The command `accuracy`, as far as `plot accuracy` shares it. */
#ifndef COMMANDS_ACCURACY_COMMAND_H
#define COMMANDS_ACCURACY_COMMAND_H

#include "statement/command.h"
#include "study/accuracy.h"

/* Measures what has been said; progress is shown on a terminal. */
bool accuracy_study_run(shell *sh, said *given, accuracy_study *out, calc_error *error);

/* The cycle in words: "FA = 20 N at FN = 100 N, the last cycle". */
void accuracy_load_text(const shell *sh, const accuracy_study *study, char *buf, size_t size);

#endif
