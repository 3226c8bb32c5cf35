/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One line on the terminal that tells how far a statement is that takes long. */
#ifndef STATEMENT_PROGRESS_H
#define STATEMENT_PROGRESS_H

#include "statement/shell.h"

/* Around every statement, named by its first `len` bytes; statements within statements belong to the
 * outermost. Shown from half a second on, ten times a second, on standard error where that is a terminal. */
void progress_begin(const shell *sh, const char *what, size_t len);
void progress_end(void);

/* Until `together`, which takes what `apart` returns, the statements within the one that runs are told of
 * each by itself: it waits for a reader between them, which is no work. */
int progress_apart(void);
void progress_together(int depth);

/* How far it is, 0..1; negative: nobody knows. */
void progress_part(double part);
/* It is still at work; for scenes. */
void progress_pulse(void);
/* In words, at once. */
void progress_words(const char *words);
/* While the screen is the full-screen mode's, nothing is shown, nor of the statement that opened it. */
void progress_hide(void);
/* Before anything is written. */
void progress_wipe(void);

#endif
