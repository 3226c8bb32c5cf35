/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What text, CSV and JSON each do with what is answered: commands use answer.h. Declares, and touches
 * nothing. */
#ifndef STATEMENT_ANSWER_FORM_H
#define STATEMENT_ANSWER_FORM_H

#include <stdio.h>

#include "statement/output.h"

enum { ANSWER_PARTS = 4 };

/* On its way out. */
typedef struct answer {
    const settings *set;
    FILE *to;
    const struct answer_form *form;
    bool lost; /* out of memory: answer_end tells */
    /* an object, of JSON, or the lines of a report, of text */
    int layout;
    bool any; /* something is in it */
    unsigned parts;
    char bracket[ANSWER_PARTS]; /* of JSON: which of its parts are open */
    /* values that wait for the end, of CSV: one row has them all */
    struct waiting {
        column *of;
        long double *si;
        size_t count, room, room_si;
        size_t estimate; /* the last */
    } waiting;
    /* a table */
    size_t count;
    const column *columns;
    /* of text: the first rows wait until units that suit them are chosen */
    bool headed;
    long double *held; /* rows of count values, and 1 where a blank line comes before */
    size_t rows;
    bool gap;
    int width[COLUMNS];
    long double scale[COLUMNS];
} answer;

/* ---- tables of words and rough numbers ---- */

typedef struct answer_head {
    const char *name;
    const char *unit;  /* of the numbers; "": none */
    const char *csv;   /* what CSV calls it; NULL: name and unit */
    const char *shown; /* what text calls it; NULL: text leaves it out */
    int width;         /* of text; below 0: to the left */
} answer_head;

typedef struct answer_cell {
    enum {
        CELL_WORDS,
        CELL_NUMBER,
        CELL_FLAG,
        /* of an event alone */
        CELL_QUANTITY,
        CELL_FACT, /* words that text shows too */
        CELL_SHARE
    } kind;
    const char *words;
    value v;           /* of what is no words */
    int digits;        /* of a number, for programs */
    const char *shown; /* in text; NULL: the words */
} answer_cell;

/* ---- forms ---- */

/* How text lays out an event: it has but words; one line of its quantities; a line of each. */
enum { LAYOUT_QUIET, LAYOUT_LINE, LAYOUT_PAGE, LAYOUT_NONE };

/* NULL: the form has no place for it. */
typedef struct answer_form {
    bool data; /* every line is one for programs */
    int words; /* the first layout that shows what is for readers alone */
    void (*value)(answer *a, const column *c, long double si);
    void (*estimate)(answer *a, const column *c, const estimate *e);
    void (*beside)(answer *a, const column *c, const estimate *e);
    void (*open)(answer *a, const char *kind, const char *text);
    void (*close)(answer *a);
    void (*member)(answer *a, const char *name, const answer_cell *c);
    void (*begin)(answer *a, const char *name, char bracket); /* NULL: it has no name */
    void (*up)(answer *a);
    bool (*columns)(answer *a, const char *event);
    void (*row)(answer *a, const long double *si);
    void (*heads)(answer *a, const char *event, const answer_head *heads, size_t count);
    void (*cells)(answer *a, const answer_head *heads, const answer_cell *cells, size_t count);
    void (*end)(answer *a, bool ok);
} answer_form;

enum { TEXT_HELD = 2000 }; /* rows of a table */

extern const answer_form answer_as_text, answer_as_csv, answer_as_json;

/* CSV writes these as text does. */
void text_close(answer *a);
void text_member(answer *a, const char *name, const answer_cell *c);

#endif
