/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What help tells beyond the tables of commands, quantities and units: topics, a file of scripts/help each.
 */
#ifndef HELP_TOPICS_H
#define HELP_TOPICS_H

#include <stdio.h>

#include "statement/scripts.h"

/* Of the lines of a topic the first tells other words to find it by, the second is empty. */
enum { TOPIC_KEYWORDS, TOPIC_TEXT = 2 };

const char *topic_name(size_t i); /* NULL after the last */
/* Its text, in which tables stand in place of their names, and its example. */
void help_topic(FILE *to, size_t i);

/* The table of units, for `show` too. */
void help_units(FILE *to);

/* How to cite the paper and the program, as text and as BibTeX. */
void help_cite(FILE *to);

/* Help on a model: a text by its number in models[]. */
const char *model_text(size_t id);

#endif
