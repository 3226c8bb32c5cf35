/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Names that have help, from the tables of commands, topics, settings, models, quantities and units. */
#ifndef HELP_HELP_H
#define HELP_HELP_H

#include <stddef.h>

/* Name i of everything that has help, one table after the other; NULL after the last. */
const char *help_name(size_t i);

/* The command that has something on a word, "help" or "apropos"; NULL if neither has. */
const char *help_command_for(const char *word);

#endif
