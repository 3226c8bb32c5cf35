/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A session as a page of HTML to hand out: one file with the figures in it, well-formed as XML, which loads
 * nothing else. Uses `text` alone. */
#ifndef STATEMENT_HANDOUT_H
#define STATEMENT_HANDOUT_H

#include "text/file.h"

typedef enum page_part {
    PAGE_GAP, /* nothing: closes the open part */
    PAGE_TITLE,
    PAGE_WORDS, /* a remark */
    PAGE_STATEMENT,
    PAGE_ANSWER, /* output of the session */
    PAGE_QUESTION,
    PAGE_CHOICE,
    PAGE_ROOM,     /* blank space for a written answer */
    PAGE_SOLUTION, /* of a question; all of them are collected at the end of the page */
    PAGE_FIGURE    /* SVG */
} page_part;

typedef struct handout {
    FILE *to; /* NULL: there is no page */
    page_part open;
    char last;           /* last character of the last part, line ends and blanks aside */
    unsigned figures;    /* so far */
    file_text solutions; /* to the questions */
    bool lost;           /* no memory for solutions */
} handout;

/* Begins a page. *p must be all 0. */
void handout_begin(handout *p, FILE *to, const char *title);
/* Appends a part, or lines to the open part of the same kind; the text has its line ends. */
void handout_put(handout *p, page_part part, const char *text, size_t len);
/* Writes the solutions and ends the page, if one has begun. False: solutions are lost. */
bool handout_end(handout *p);

#endif
