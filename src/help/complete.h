/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What may stand at the cursor of a line. Pure: knows the tables and the session, no editor. */
#ifndef HELP_COMPLETE_H
#define HELP_COMPLETE_H

#include "statement/shell.h"

typedef struct candidates {
    char **word; /* that begin like the word at the cursor; each its own */
    size_t count, room;
    size_t start; /* of the word in the line */
    bool files;   /* a file name may stand there; there are no words then */
} candidates;

/* The candidates for the word of `line` that ends at the cursor, which they replace. One that ends in `=` or
 * `(` wants no blank behind it. Out of memory there are fewer. Free with candidates_free. */
void complete(shell *sh, const char *line, size_t cursor, candidates *out);
void candidates_free(candidates *c);

#endif
