/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Completion: which words may stand at the cursor of a line. Reads the tables and the session, no editor. */
#ifndef HELP_COMPLETE_H
#define HELP_COMPLETE_H

#include "statement/shell.h"

typedef struct candidates {
    char **word; /* whole words that begin like the one at the cursor; each is allocated by itself */
    size_t count, room;
    size_t start; /* where the word at the cursor begins in the line */
    bool files;   /* a file name may stand there; count is 0 then */
} candidates;

/* Finds the words that can replace the word of `line` that ends at the cursor. A candidate that ends in `=`
 * or `(` needs no blank after it. Without memory some are missing. Free with candidates_free. */
void complete(shell *sh, const char *line, size_t cursor, candidates *out);
void candidates_free(candidates *c);

#endif
