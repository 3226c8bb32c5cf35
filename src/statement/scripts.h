/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The sessions of scripts/ (lessons, figures of the paper) and topics of help, built into the program. */
#ifndef STATEMENT_SCRIPTS_H
#define STATEMENT_SCRIPTS_H

#include <stddef.h>

typedef struct script {
    const char *name;
    const char *title;         /* one line */
    const char *const *line;   /* statements and comments, or the text of a topic; NULL after the last */
    const char *const *answer; /* to its questions, in order, NULL after the last; NULL: it is no lesson */
} script;

extern const script scripts[], topics[]; /* a row without a name ends them */

static inline const char *script_name(size_t i) { /* NULL after the last */
    return scripts[i].name;
}

#endif
