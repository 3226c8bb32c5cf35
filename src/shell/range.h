/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Ranges of tables and plots as they are written: for NAME = LO .. HI, along a load, with NAME = v1, v2, ...
 */
#ifndef SHELL_RANGE_H
#define SHELL_RANGE_H

#include "shell/command.h"
#include "study/sweep.h"

enum { RANGE_STEPS = 100000000 };

/* A sweep and where in the statement its range stands: it is read again for each curve. */
typedef struct range {
    sweep sweep;
    shell *sh;
    const lexer *statement;
    size_t at; /* of LO, or of the load */
} range;

/* The names of the range, which stand behind the expressions that use them, become known until range_forget.
 */
typedef struct range_names {
    size_t count; /* of the names before */
} range_names;
bool range_names_find(shell *sh, lexer *lx, range_names *out, bool *found);
/* The name at the cursor does. out begins as {.count = of the names}. */
bool range_wake(shell *sh, const lexer *lx, range_names *out);
void range_forget(shell *sh, const range_names *names);

/* LO .. HI of var at the cursor; word: what stands between them instead of `..`, or NULL. */
bool range_read_interval(calc *c, lexer *lx, const knob *var, const char *word, sweep_range *out);
/* At `along`, as far as the load goes. */
bool range_read_along(shell *sh, lexer *lx, range *out);
/* At `for` or `along`; steps: where none are given. The lexer must outlive the range. */
bool range_read(shell *sh, lexer *lx, range *out, size_t steps);
/* `steps N`, `log` and `with ...` at the cursor, as many as stand there. */
bool range_read_options(shell *sh, lexer *lx, sweep *s);
/* Says on standard error why some values of a sweep are missing. */
void note_missing(shell *sh, const sweep_job *job);

#endif
