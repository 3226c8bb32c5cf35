/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Help from the tables. */
#ifndef HELP_HELP_H
#define HELP_HELP_H

#include <stddef.h>

/* All that has help, one table after the other: i = 0, 1, ... until NULL. For completion and suggestions. */
const char *help_name(size_t i);

/* The command that tells of a word, `help` or `apropos`; NULL: none does. */
const char *help_where(const char *word);

#endif
