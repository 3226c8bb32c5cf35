/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A session on a page of HTML, to hand out: one file, the figures in it, nothing fetched, and well-formed XML
 * too. */
#ifndef STATEMENT_HANDOUT_H
#define STATEMENT_HANDOUT_H

#include "text/file.h"

typedef enum page_part {
    PAGE_GAP, /* ends what is open */
    PAGE_TITLE,
    PAGE_WORDS,
    PAGE_STATEMENT,
    PAGE_ANSWER, /* what the session answers */
    PAGE_QUESTION,
    PAGE_CHOICE,
    PAGE_ROOM,     /* for an answer by hand */
    PAGE_SOLUTION, /* of a question: they come together, at the end */
    PAGE_FIGURE    /* SVG */
} page_part;

typedef struct handout {
    FILE *to; /* NULL: there is none */
    page_part open;
    char last;           /* that was written, but for line ends */
    unsigned figures;    /* so far */
    file_text solutions; /* to the questions */
    bool lost;           /* they found no memory */
} handout;

/* Of one that is all 0. */
void handout_begin(handout *p, FILE *to, const char *title);
/* Lines of text end in their own line ends. */
void handout_put(handout *p, page_part part, const char *text, size_t len);
/* With the solutions, also of one that has not begun; false: they are lost. */
bool handout_end(handout *p);

#endif
