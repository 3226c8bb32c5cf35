/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Help that is no table row's: topics (a file of scripts/help each), the list of units, citations, models. */
#ifndef HELP_TOPICS_H
#define HELP_TOPICS_H

#include <stdio.h>

#include "statement/scripts.h"

/* Line numbers of a topic: the first line holds search words, the second is empty, the text follows. */
enum { TOPIC_KEYWORDS, TOPIC_TEXT = 2 };

const char *topic_name(size_t i); /* NULL after the last */
/* Writes the text of topic i; a line such as [units] is replaced by that table. */
void help_topic(FILE *to, size_t i);

/* Writes the table of units, for `show` too. */
void help_units(FILE *to);

/* Writes how to cite the paper and the program, as text and as BibTeX. */
void help_cite(FILE *to);

const char *model_text(size_t id); /* help on models[id] */

#endif
