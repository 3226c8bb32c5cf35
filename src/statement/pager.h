/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Text by $PAGER. */
#ifndef STATEMENT_PAGER_H
#define STATEMENT_PAGER_H

#include <stdbool.h>

/* Does the text have more lines than the terminal of standard output? False where that is none. */
bool pager_needed(const char *text);
/* Shows it; false: there is no pager, or it failed. */
bool pager_show(const char *text);

#endif
