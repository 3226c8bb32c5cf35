/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A line on the terminal that shows the progress of a long statement. */
#ifndef STATEMENT_PROGRESS_H
#define STATEMENT_PROGRESS_H

#include "statement/shell.h"

/* Called around every statement; the first word of its text `what` is shown. Nested statements count as part
 * of the outermost. Shown after 0.5 s, ten times a second, on standard error if that is a terminal. */
void progress_begin(const shell *sh, const char *what, size_t len);
void progress_end(void);

/* Between the two calls each nested statement has a progress line of its own. For lessons and questions,
 * which wait for the user between statements. `together` takes what `apart` returned. */
int progress_suspend(void);
void progress_resume(int depth);

/* Reports the part done, 0 to 1; negative: unknown. */
void progress_part(double part);
/* Reports that work goes on; a callback for scenes. */
void progress_pulse(void);
/* Shows these words at once. */
void progress_words(const char *words);
/* Shows nothing more until the outermost statement ends: the full-screen mode has the screen. */
void progress_hide(void);
/* Wipes the line; called before anything else is written. */
void progress_wipe(void);

#endif
