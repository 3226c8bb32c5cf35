/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a command answers, said once: as text for readers, as CSV or as JSON for programs. */
#ifndef STATEMENT_ANSWER_H
#define STATEMENT_ANSWER_H

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

/* Of a table of words and rough numbers. */
typedef struct answer_cell {
    enum {
        CELL_WORDS,
        CELL_NUMBER,
        CELL_FLAG,
        /* of an event alone */
        CELL_QUANTITY,
        CELL_FACT /* words that text shows too */
    } kind;
    const char *words;
    value v;    /* of what is no words */
    int digits; /* of a number, for programs */
} answer_cell;

/* ---- answers ---- */

/* In the form that is set, or in another, as of a file. */
void answer_begin(answer *a, const settings *set, FILE *to);
void answer_begin_as(answer *a, const settings *set, FILE *to, int format);
/* What still waits goes out; ok: else it is dropped. False: memory is out, something has not been said. */
bool answer_end(answer *a, bool ok);
/* Are they read by a program, line by line? No colours then, nothing that moves, and no asides. */
bool answer_is_data(const settings *set);

/* ---- values ---- */

/* `name = value unit`. */
void answer_value(answer *a, const column *c, long double si);
/* Such values and no more: an answer of its own. False: out of memory. */
bool answer_values(const settings *set, FILE *to, const column *columns, const long double *si, size_t count);
/* `name = value unit +- deviation unit`. In JSON the deviation and the ends of an interval belong to the
 * event. */
void answer_estimate(answer *a, const column *c, const estimate *e);

/* The last value again, as computed another way: for readers, to compare. False: the form has no place for
 * it. */
bool answer_beside(answer *a, const column *c, const estimate *e);

/* ---- events: what a command reports ---- */

/* How text lays one out: it has but words; one line of its quantities; a line of each, and of its facts. */
enum { LAYOUT_QUIET, LAYOUT_LINE, LAYOUT_PAGE, LAYOUT_NONE };
void answer_open(answer *a, int layout, const char *kind, const char *text);
/* Facts for programs; text shows only what answer_words says. */
#define answer_event(a, name) answer_open(a, LAYOUT_QUIET, "event", name)
#define answer_report(a, name) answer_open(a, LAYOUT_LINE, "event", name)
#define answer_page(a, name) answer_open(a, LAYOUT_PAGE, "event", name)
/* A message, for programs: readers have it on standard error. kind: "note", "warning", "error". */
#define answer_message(a, kind, text) answer_open(a, LAYOUT_QUIET, kind, text)
/* Ends any of them. */
void answer_done(answer *a);

/* Not finite: it has no value. */
void answer_number(answer *a, const char *name, double v);
void answer_string(answer *a, const char *name, const char *text);
void answer_flag(answer *a, const char *name, bool v);
void answer_quantity(answer *a, const char *name, value v);
/* `name: text` of a page; else as a string. */
void answer_fact(answer *a, const char *name, const char *text);
/* What part of the last estimate's variance comes from `name`; in a group of their own. */
void answer_share(answer *a, const char *name, double part);
/* Facts that belong together, up to answer_up; or several such, without a name each, or numbers of no name:
 * answer_items, then answer_item for each of the former. */
void answer_part(answer *a, const char *name, char bracket);
#define answer_group(a, name) answer_part(a, name, '{')
#define answer_items(a, name) answer_part(a, name, '[')
#define answer_item(a) answer_part(a, NULL, '{')
void answer_up(answer *a);
/* The same facts, for readers: of text alone, and where CSV is as text. */
LIKE_PRINTF(2, 3)
void answer_words(answer *a, const char *format, ...);
/* A line of them, broken at blanks; what follows of it is indented. */
void answer_line(answer *a, const char *text);

/* ---- tables: a value that is not finite is a gap ---- */

/* The columns must stay. event: whose table it is. False: out of memory; there is nothing to end then. */
bool answer_columns(answer *a, const char *event, const column *columns, size_t count);
/* The same of CSV and JSON where another program has written the head: rows follow. */
void answer_goes_on(answer *a, const column *columns, size_t count);
void answer_row(answer *a, const long double *si);
/* Will the next row be written, not held? */
bool answer_shows_next(const answer *a);
/* A blank line before the next row, in text. */
void answer_gap(answer *a);

/* A row of words and rough numbers, for programs: readers have answer_words in place of such a table. */
void answer_cells(answer *a, const answer_cell *cells);

/* ---- forms: what text, CSV and JSON each do with what is answered; for no command ---- */

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
    void (*share)(answer *a, const char *name, double part);  /* NULL: a number */
    void (*begin)(answer *a, const char *name, char bracket); /* NULL: it has no name */
    void (*up)(answer *a);
    bool (*columns)(answer *a, const char *event);
    void (*row)(answer *a, const long double *si);
    void (*cells)(answer *a, const answer_cell *cells);
    void (*end)(answer *a, bool ok);
} answer_form;

enum { TEXT_HELD = 2000 }; /* rows of a table */

extern const answer_form answer_as_text, answer_as_csv, answer_as_json;

/* CSV writes these as text does. */
void text_close(answer *a);
void text_member(answer *a, const char *name, const answer_cell *c);

#endif
