/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a command answers, said once: as text for readers, as CSV or as JSON for programs. */
#ifndef STATEMENT_ANSWER_H
#define STATEMENT_ANSWER_H

#include <stdio.h>

#include "statement/answer_form.h"

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

/* Facts for programs; text shows only what answer_words says. */
void answer_event(answer *a, const char *name);
/* In text one line, of its quantities. */
void answer_report(answer *a, const char *name);
/* In text a line each of its quantities and its facts. */
void answer_page(answer *a, const char *name);
/* A message, for programs: readers have it on standard error. kind: "note", "warning", "error". */
void answer_message(answer *a, const char *kind, const char *text);
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
/* Facts that belong together, up to answer_up. */
void answer_group(answer *a, const char *name);
void answer_up(answer *a);
/* Several such, without a name each, or numbers of no name: answer_items, then answer_item for each of the
 * former; answer_up ends any of them. */
void answer_items(answer *a, const char *name);
void answer_item(answer *a);
/* The same facts, for readers: of text alone, and where CSV is as text. */
#if defined(__GNUC__)
__attribute__((format(printf, 2, 3)))
#endif
void answer_words(answer *a, const char *format, ...);
/* A line of them, broken at blanks; what follows of it begins at `indent`. */
void answer_line(answer *a, const char *text, size_t indent);

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

/* ---- tables of words and rough numbers ---- */

void answer_heads(answer *a, const char *event, const answer_head *heads, size_t count);
void answer_cells(answer *a, const answer_head *heads, const answer_cell *cells, size_t count);

#endif
