/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The command `accuracy`, as far as `plot accuracy` shares it. */
#ifndef SHELL_ACCURACY_COMMAND_H
#define SHELL_ACCURACY_COMMAND_H

#include "shell/command.h"
#include "study/accuracy.h"

/* [FA=... | dxA=...] [within SECONDS] at the cursor, as far as it goes, measured: progress is shown on a
 * terminal. self: the row of `accuracy`, whose args are these three in this order. */
bool accuracy_study_read(shell *sh, lexer *lx, const command *self, accuracy_study *out);

/* The cycle in words: "FA = 20 N at FN = 100 N, the last cycle". */
void accuracy_load_text(const shell *sh, const accuracy_study *study, char *buf, size_t size);

#endif
