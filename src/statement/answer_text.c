/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Answers as text for people: with units that suit and `set digits` digits. Writes to the answer's stream. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "scene/quantity.h"
#include "statement/answer.h"
#include "text/characters.h"

/* ---- values ------------------------------------------------------------------------------------ */

static void put_text_value(answer *a, const column *c, long double si) {
    char text[COLUMN_TEXT];
    format_column(c, a->set->digits, si, text, sizeof text);
    fprintf(a->to, "%s = %s\n", c->name, text);
}

static void put_text_estimate(answer *a, const column *c, const estimate *e) {
    char text[ESTIMATE_TEXT];
    format_estimate(c, a->set->digits, e, text);
    fprintf(a->to, "%s = %s\n", c->name, text);
}

static void put_beside(answer *a, const column *c, const estimate *e) {
    fputs("    ", a->to);
    put_text_estimate(a, c, e);
}

/* ---- events ------------------------------------------------------------------------------------ */

static void put_quantity(answer *a, const char *name, value v) {
    char text[160];
    const quantity *q = quantity_find(name, strlen(name));
    format_column(&(column){.d = v.d, .row = q ? q->unit : NULL}, a->set->digits, v.v, text, sizeof text);
    if (a->layout == LAYOUT_PAGE)
        fprintf(a->to, "    %s = %s\n", name, text);
    else
        fprintf(a->to, "%s%s = %s", a->any ? ", " : "  ", name, text);
    a->any = a->layout == LAYOUT_LINE;
}

void text_member(answer *a, const char *name, const answer_cell *c) {
    if (c->kind == CELL_QUANTITY && a->layout != LAYOUT_QUIET)
        put_quantity(a, name, c->v);
    else if (c->kind == CELL_FACT && a->layout == LAYOUT_PAGE)
        fprintf(a->to, "    %s: %s\n", name, c->words);
}

void text_close(answer *a) {
    if (a->layout == LAYOUT_LINE)
        putc('\n', a->to);
}

static void put_share(answer *a, const char *name, double part) {
    fprintf(a->to, "%s%s %.3g %%", a->any ? ", " : "    from ", name, 100 * part);
    a->any = true;
}

/* Ends the line that put_share has written. */
static void end_group(answer *a) {
    if (a->any)
        putc('\n', a->to);
    a->any = false;
}

/* ---- tables ------------------------------------------------------------------------------------ */

/* Writes the header. A column is as wide as its name and unit, or as a number of this many digits. */
static void text_head(answer *a) {
    for (size_t i = 0; i < a->count; i++) {
        column c = a->columns[i]; /* in the unit asked for, or in one that suits the rows held */
        column_suit(&c, a->held + i, a->rows, a->count + 1, a->set->digits);
        a->scale[i] = c.scale;
        const size_t unit_width = text_columns(c.unit, strlen(c.unit)),
                     head = text_columns(c.name, strlen(c.name)) + (*c.unit ? unit_width + 3 : 0);
        const size_t number = (size_t)a->set->digits + 7;
        a->width[i] = (int)(head > number ? head : number);
        fprintf(a->to, "%s%*s", i ? "  " : "", a->width[i] - (int)head, "");
        fprintf(a->to, *c.unit ? "%s [%s]" : "%s", c.name, c.unit);
    }
    putc('\n', a->to);
}

static void text_row(const answer *a, const long double *si) {
    if (si[a->count] != 0)
        putc('\n', a->to);
    for (size_t i = 0; i < a->count; i++) {
        const double v = (double)(si[i] / a->scale[i]);
        if (i)
            fwrite("  ", 1, 2, a->to);
        if (isfinite(v))
            print_number(a->to, a->width[i], a->set->digits, v);
        else
            fprintf(a->to, "%*s", a->width[i], "");
    }
    putc('\n', a->to);
}

static void put_held(answer *a) {
    text_head(a);
    for (size_t row = 0; row < a->rows; row++)
        text_row(a, a->held + row * (a->count + 1));
    free(a->held);
    a->held = NULL;
    a->rows = 0;
}

/* Holds the row until TEXT_HELD rows choose the units; from then on writes it at once. */
static void put_or_hold(answer *a, const long double *si) {
    long double row[COLUMNS + 1];
    memcpy(row, si, a->count * sizeof *row);
    row[a->count] = a->gap;
    a->gap = false;
    if (a->held)
        memcpy(a->held + a->rows++ * (a->count + 1), row, (a->count + 1) * sizeof *row);
    else
        text_row(a, row);
    if (a->rows == TEXT_HELD)
        put_held(a);
}

static bool put_text_columns(answer *a, const char *event) {
    (void)event;
    a->gap = false;
    a->rows = 0;
    a->held = malloc(TEXT_HELD * (a->count + 1) * sizeof *a->held);
    return a->held != NULL;
}

static void end_text_table(answer *a, bool ok) {
    if (ok && a->held)
        put_held(a);
    free(a->held);
    a->held = NULL;
}

const answer_form answer_as_text = {
    .value = put_text_value,
    .estimate = put_text_estimate,
    .beside = put_beside,
    .close = text_close,
    .member = text_member,
    .share = put_share,
    .up = end_group,
    .columns = put_text_columns,
    .row = put_or_hold,
    .end = end_text_table,
};
