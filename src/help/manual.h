/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Pages of the manual and completion for the system's shell, from the tables: for those who install the
 * program. */
#ifndef HELP_MANUAL_H
#define HELP_MANUAL_H

#include <stdio.h>

/* what: "1", "5" or "bash". usage: the options, as `--help` tells them. Returns an exit status: EXIT_USAGE
 * where there is no such page, EXIT_ERROR where there is no memory for all of it. */
int manual_write(FILE *to, const char *what, const char *usage, const char *version);

#endif
