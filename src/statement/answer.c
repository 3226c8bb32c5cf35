/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Passes the parts of an answer to the functions of its form. Writes to the answer's stream. */
#include "statement/answer.h"

#include <stdarg.h>

#include "statement/progress.h"
#include "text/lines.h"

static const answer_form *const forms[] = {
    [FORMAT_TEXT] = &answer_as_text, [FORMAT_CSV] = &answer_as_csv, [FORMAT_JSON] = &answer_as_json};

void answer_begin_as(answer *a, const settings *set, FILE *to, int format) {
    progress_wipe();
    *a = (answer){.set = set, .to = to, .form = forms[format]};
}

void answer_begin(answer *a, const settings *set, FILE *to) {
    answer_begin_as(a, set, to, set->format);
}

bool answer_end(answer *a, bool ok) {
    if (a->form->end)
        a->form->end(a, ok);
    return !a->lost;
}

bool answer_is_data(const settings *set) {
    return forms[set->format]->data;
}

/* ---- values ------------------------------------------------------------------------------------ */

void answer_value(answer *a, const column *c, long double si) {
    a->form->value(a, c, si);
}

bool answer_values(const settings *set, FILE *to, const column *columns, const long double *si,
                   size_t count) {
    answer a;
    answer_begin(&a, set, to);
    for (size_t i = 0; i < count; i++)
        answer_value(&a, &columns[i], si[i]);
    return answer_end(&a, true);
}

void answer_estimate(answer *a, const column *c, const estimate *e) {
    a->form->estimate(a, c, e);
}

bool answer_beside(answer *a, const column *c, const estimate *e) {
    if (a->form->beside)
        a->form->beside(a, c, e);
    return a->form->beside != NULL;
}

/* ---- events ------------------------------------------------------------------------------------ */

void answer_open(answer *a, int layout, const char *kind, const char *text) {
    a->layout = layout;
    a->any = false;
    if (a->form->open)
        a->form->open(a, kind, text);
}

void answer_done(answer *a) {
    if (a->form->close)
        a->form->close(a);
}

static void member(answer *a, const char *name, const answer_cell *c) {
    if (a->form->member)
        a->form->member(a, name, c);
}

void answer_number(answer *a, const char *name, double v) {
    member(a, name, &(answer_cell){CELL_NUMBER, .v = {.v = v}, .digits = 17});
}

void answer_string(answer *a, const char *name, const char *text) {
    member(a, name, &(answer_cell){CELL_WORDS, .words = text});
}

void answer_flag(answer *a, const char *name, bool v) {
    member(a, name, &(answer_cell){CELL_FLAG, .v = {.v = v}});
}

void answer_quantity(answer *a, const char *name, value v) {
    member(a, name, &(answer_cell){CELL_QUANTITY, .v = v, .digits = 17});
}

void answer_fact(answer *a, const char *name, const char *text) {
    member(a, name, &(answer_cell){CELL_FACT, .words = text});
}

void answer_share(answer *a, const char *name, double part) {
    if (a->form->share)
        a->form->share(a, name, part);
    else
        answer_number(a, name, part);
}

void answer_part(answer *a, const char *name, char bracket) {
    if (a->form->begin)
        a->form->begin(a, name, bracket);
}

void answer_up(answer *a) {
    if (a->form->up)
        a->form->up(a);
}

void answer_words(answer *a, const char *format, ...) {
    va_list args;
    va_start(args, format);
    if (a->layout >= a->form->words)
        vfprintf(a->to, format, args);
    va_end(args);
}

void answer_line(answer *a, const char *text) {
    if (a->layout >= a->form->words)
        help_wrapped(a->to, "", text, 8);
}

/* ---- tables ------------------------------------------------------------------------------------ */

void answer_columns_shared(answer *a, const column *columns, size_t count) {
    a->columns = columns;
    a->count = count;
}

bool answer_columns(answer *a, const char *event, const column *columns, size_t count) {
    answer_columns_shared(a, columns, count);
    return a->form->columns(a, event);
}

void answer_row(answer *a, const long double *si) {
    a->form->row(a, si);
}

bool answer_shows_next(const answer *a) {
    return !a->held || a->rows + 1 == TEXT_HELD;
}

void answer_gap(answer *a) {
    a->gap = true;
}

void answer_cells(answer *a, const answer_cell *cells) {
    if (a->form->cells)
        a->form->cells(a, cells);
}
