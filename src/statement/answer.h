/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The answer of a command: values, events and tables, written as text for people, or as CSV or JSON for
 * programs. A command calls these functions once; a table of functions for each form does the rest. */
#ifndef STATEMENT_ANSWER_H
#define STATEMENT_ANSWER_H

#include <stdio.h>

#include "statement/output.h"

enum { ANSWER_PARTS = 4 };

typedef struct answer {
    const settings *set;
    FILE *to;
    const struct answer_form *form;
    bool lost; /* memory ran out; answer_end returns false */
    /* the open event: a JSON object, or the lines of a report in text */
    int layout;
    bool any;                   /* a member has been written: a separator comes before the next */
    unsigned parts;             /* depth of groups and lists */
    char bracket[ANSWER_PARTS]; /* JSON: the closing bracket of each */
    /* CSV: values are kept until answer_end, which writes all of them as one row */
    struct waiting {
        column *of;
        long double *si;
        size_t count, room, room_si;
        size_t estimate; /* index of the last estimate */
    } waiting;
    /* the table */
    size_t count; /* of columns */
    const column *columns;
    /* text: the first rows are held until units that suit them are chosen */
    long double *held; /* rows of count values and a flag, a blank line comes before; then NULL */
    size_t rows;       /* in held */
    bool gap;          /* a blank line comes before the next row */
    int width[COLUMNS];
    long double scale[COLUMNS];
} answer;

/* A member of an event, or a cell of a table of words and numbers. */
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
    value v;    /* of kinds without words */
    int digits; /* significant digits of a number in CSV and JSON */
} answer_cell;

/* ---- answers ---- */

/* Begins an answer in the form of `set format`, or, for a file, in the given output_format. */
void answer_begin(answer *a, const settings *set, FILE *to);
void answer_begin_as(answer *a, const settings *set, FILE *to, int format);
/* Writes what is still held, if ok; else drops it. False: memory ran out, the answer is not complete. */
bool answer_end(answer *a, bool ok);
/* Is every line of output an object for a program (JSON)? Then no colours, animations or asides. */
bool answer_is_data(const settings *set);

/* ---- values ---- */

/* `name = value unit`. */
void answer_value(answer *a, const column *c, long double si);
/* An answer of these values alone. False: out of memory. */
bool answer_values(const settings *set, FILE *to, const column *columns, const long double *si, size_t count);
/* `name = value unit +- deviation unit`. JSON has the value alone: the rest goes into an event. */
void answer_estimate(answer *a, const column *c, const estimate *e);

/* The last estimate as computed in another way, below it in text. False: the form has no place for it. */
bool answer_beside(answer *a, const column *c, const estimate *e);

/* ---- events: what a command reports ---- */

/* What text shows of an event: only what answer_words and answer_line write; its quantities on one line; a
 * line for each quantity and fact. LAYOUT_NONE is above all of them, see answer_form. */
enum { LAYOUT_QUIET, LAYOUT_LINE, LAYOUT_PAGE, LAYOUT_NONE };
void answer_open(answer *a, int layout, const char *kind, const char *text);
#define answer_event(a, name) answer_open(a, LAYOUT_QUIET, "event", name)
#define answer_report(a, name) answer_open(a, LAYOUT_LINE, "event", name)
#define answer_page(a, name) answer_open(a, LAYOUT_PAGE, "event", name)
/* A message for programs; people read it on standard error. kind: "note", "warning", "error", "text". */
#define answer_message(a, kind, text) answer_open(a, LAYOUT_QUIET, kind, text)
/* Closes the event, report, page or message. */
void answer_done(answer *a);

/* Members of the event. JSON has all (null if not finite); text has only quantities and facts. */
void answer_number(answer *a, const char *name, double v);
void answer_string(answer *a, const char *name, const char *text);
void answer_flag(answer *a, const char *name, bool v);
void answer_quantity(answer *a, const char *name, value v);
/* A string in JSON; on a page of text a line `name: text`. */
void answer_fact(answer *a, const char *name, const char *text);
/* The part (0 to 1) of the last estimate's variance that comes from `name`; within an answer_group. */
void answer_share(answer *a, const char *name, double part);
/* answer_group opens a group of named members. answer_items opens a list, of numbers without names or of
 * groups, each opened by answer_item. answer_up closes the last that was opened. */
void answer_part(answer *a, const char *name, char bracket);
#define answer_group(a, name) answer_part(a, name, '{')
#define answer_items(a, name) answer_part(a, name, '[')
#define answer_item(a) answer_part(a, NULL, '{')
void answer_up(answer *a);
/* The same facts in words for people: in text, and on a page (answer_page) in CSV. */
LIKE_PRINTF(2, 3)
void answer_words(answer *a, const char *format, ...);
/* A line of such words, broken at blanks; continuation lines are indented. */
void answer_line(answer *a, const char *text);

/* ---- tables: a value that is not finite is a gap ---- */

/* Begins a table; `columns` must outlive it, `event` names it. False: out of memory; no answer_end then. */
bool answer_columns(answer *a, const char *event, const column *columns, size_t count);
/* The same in CSV and JSON without the header, which another share of the run writes. */
void answer_columns_shared(answer *a, const column *columns, size_t count);
void answer_row(answer *a, const long double *si);
/* Will the next row be written at once, not held? */
bool answer_shows_next(const answer *a);
/* A blank line before the next row, in text. */
void answer_gap(answer *a);

/* A row of words and numbers of few digits, in CSV and JSON; text has answer_words in place of the table. */
void answer_cells(answer *a, const answer_cell *cells);

/* ---- forms: text, CSV and JSON as tables of functions; for answer.c alone ---- */

/* A function that is NULL: the form leaves that part out. */
typedef struct answer_form {
    bool data; /* every line is an object for programs */
    int words; /* the first layout whose answer_words are shown */
    void (*value)(answer *a, const column *c, long double si);
    void (*estimate)(answer *a, const column *c, const estimate *e);
    void (*beside)(answer *a, const column *c, const estimate *e);
    void (*open)(answer *a, const char *kind, const char *text);
    void (*close)(answer *a);
    void (*member)(answer *a, const char *name, const answer_cell *c);
    void (*share)(answer *a, const char *name, double part);  /* NULL: written as a number */
    void (*begin)(answer *a, const char *name, char bracket); /* name NULL: an item of a list */
    void (*up)(answer *a);
    bool (*columns)(answer *a, const char *event);
    void (*row)(answer *a, const long double *si);
    void (*cells)(answer *a, const answer_cell *cells);
    void (*end)(answer *a, bool ok);
} answer_form;

enum { TEXT_HELD = 2000 }; /* the most rows of a table that text holds */

extern const answer_form answer_as_text, answer_as_csv, answer_as_json;

/* Used by CSV too. */
void text_close(answer *a);
void text_member(answer *a, const char *name, const answer_cell *c);

#endif
