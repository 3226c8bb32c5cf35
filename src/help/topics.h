/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What help tells beyond the tables of commands, quantities and units. */
#ifndef HELP_TOPICS_H
#define HELP_TOPICS_H

#include <stddef.h>
#include <stdio.h>

typedef struct topic {
    const char *name;
    const char *summary;
    const char *keywords;    /* other words to find it by */
    const char *text;        /* or NULL */
    void (*print)(FILE *to); /* more, from a table; or NULL */
    const char *example;     /* a transcript, indented by four */
} topic;

const topic *topic_row(size_t i); /* NULL after the last */
const char *topic_name(size_t i);

/* The table of units, for `show` too. */
void help_units(FILE *to);

/* How to cite the paper and the program, as text and as BibTeX. */
void help_cite(FILE *to);

/* Help on a model: a text by its number in models[]. */
const char *model_text(size_t id);

#endif
