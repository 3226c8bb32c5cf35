/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Answers as JSON: one object a line, numbers in SI with 17 digits. Writes to the answer's stream. */
#include <math.h>
#include <string.h>

#include "statement/answer.h"
#include "text/characters.h"

/* ---- strings and numbers ----------------------------------------------------------------------- */

/* Length of the beginning of `text` that needs no escape in JSON: for most names all of it. */
static size_t plain_length(const char *text) {
    size_t n = 0;
    while (text[n] >= ' ' && text[n] < 0x7f && text[n] != '"' && text[n] != '\\')
        n++;
    return n;
}

/* Writes a JSON string. Bytes that are no UTF-8 become U+FFFD. */
static void put_string(FILE *to, const char *text) {
    putc('"', to);
    size_t plain = plain_length(text);
    fwrite(text, 1, plain, to);
    text += plain;
    size_t left = strlen(text);
    while (left > 0) {
        unsigned code;
        size_t n = character_at(text, left, &code);
        if (n == 0) {
            fputs("\\ufffd", to);
            n = 1;
        } else if (code == '"' || code == '\\') {
            fprintf(to, "\\%c", *text);
        } else if (code < 0x10000 && !character_shows(code)) {
            fprintf(to, "\\u%04x", code);
        } else {
            fwrite(text, 1, n, to);
        }
        text += n;
        left -= n;
    }
    putc('"', to);
}

/* JSON has no infinities and no NaN: a gap of a table is null. */
static void put_number(FILE *to, int digits, long double v) {
    if (isfinite((double)v))
        print_number(to, 0, digits, (double)v);
    else
        fputs("null", to);
}

/* ---- objects ----------------------------------------------------------------------------------- */

/* Begins a member; name NULL: an item of a list. */
static void name_member(answer *a, const char *name) {
    if (a->any)
        putc(',', a->to);
    a->any = true;
    if (name) {
        put_string(a->to, name);
        putc(':', a->to);
    }
}

static void begin_object(answer *a) {
    putc('{', a->to);
    a->any = false;
}

static void end_line(answer *a) {
    fputs("}\n", a->to);
}

static void put_member(answer *a, const char *name, const answer_cell *c) {
    name_member(a, name);
    if (c->kind == CELL_WORDS || c->kind == CELL_FACT)
        put_string(a->to, c->words);
    else if (c->kind == CELL_FLAG)
        fputs(c->v.v != 0 ? "true" : "false", a->to);
    else
        put_number(a->to, c->digits, c->v.v);
}

static void put_text(answer *a, const char *name, const char *text) {
    put_member(a, name, &(answer_cell){CELL_WORDS, .words = text});
}

static void begin_part(answer *a, const char *name, char bracket) {
    name_member(a, name);
    putc(bracket, a->to);
    a->bracket[a->parts++] = bracket == '{' ? '}' : ']';
    a->any = false;
}

static void end_part(answer *a) {
    putc(a->bracket[--a->parts], a->to);
    a->any = true;
}

static void open_event(answer *a, const char *kind, const char *text) {
    begin_object(a);
    put_text(a, kind, text);
}

/* ---- values and tables ------------------------------------------------------------------------- */

static void put_json_value(answer *a, const column *c, long double si) {
    char unit_text[COLUMN_UNIT];
    dim_unit(c->d, unit_text, sizeof unit_text);
    begin_object(a);
    put_text(a, "name", c->name);
    name_member(a, "value");
    put_number(a->to, 17, si);
    put_text(a, "unit", unit_text);
    end_line(a);
}

static void put_json_estimate(answer *a, const column *c, const estimate *e) {
    put_json_value(a, c, e->v);
}

/* A first object names the unit of each column; rows have only numbers. */
static bool put_json_columns(answer *a, const char *event) {
    char unit_text[COLUMN_UNIT];
    open_event(a, "event", event);
    begin_part(a, "columns", '{');
    for (size_t i = 0; i < a->count; i++) {
        dim_unit(a->columns[i].d, unit_text, sizeof unit_text);
        put_text(a, a->columns[i].name, unit_text);
    }
    end_part(a);
    end_line(a);
    return true;
}

static void put_json_row(answer *a, const long double *si) {
    begin_object(a);
    for (size_t i = 0; i < a->count; i++) {
        name_member(a, a->columns[i].name);
        put_number(a->to, 17, si[i]);
    }
    end_line(a);
}

static void put_json_cells(answer *a, const answer_cell *cells) {
    begin_object(a);
    for (size_t i = 0; i < a->count; i++)
        put_member(a, a->columns[i].name, &cells[i]);
    end_line(a);
}

const answer_form answer_as_json = {
    .data = true,
    .words = LAYOUT_NONE,
    .value = put_json_value,
    .estimate = put_json_estimate,
    .open = open_event,
    .close = end_line,
    .member = put_member,
    .begin = begin_part,
    .up = end_part,
    .columns = put_json_columns,
    .row = put_json_row,
    .cells = put_json_cells,
};
