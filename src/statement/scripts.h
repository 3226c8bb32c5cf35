/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The scripted sessions of scripts/, a lesson or a figure of the paper each, and the topics of help, as the
 * build has put them into the program. */
#ifndef STATEMENT_SCRIPTS_H
#define STATEMENT_SCRIPTS_H

#include <stddef.h>

typedef struct script {
    const char *name;
    const char *title;       /* one line */
    const char *const *line; /* statements and comments, or text; ended by NULL */
    const char *const
        *answer; /* to its questions, in their order, likewise; NULL: it has none, and is no lesson */
} script;

extern const script scripts[], topics[]; /* ended by a row without a name */

const char *script_name(size_t i); /* NULL after the last */

#endif
