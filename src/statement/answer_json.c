/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Answers as JSON: every line is one object, numbers in SI to the last digit. */
#include <math.h>
#include <string.h>

#include "statement/answer_form.h"
#include "text/characters.h"

/* ---- strings and numbers ----------------------------------------------------------------------- */

/* Length of the printable ASCII that begins there and stands for itself in JSON: most names are that. */
static size_t plain_length(const char *text) {
    size_t n = 0;
    while (text[n] >= ' ' && text[n] < 0x7f && text[n] != '"' && text[n] != '\\')
        n++;
    return n;
}

/* Quotation marks included; bytes that are no UTF-8 become U+FFFD. */
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

/* JSON has no infinities; results never are, but a table may hold gaps. */
static void put_digits(FILE *to, int digits, long double v) {
    if (isfinite((double)v))
        print_number(to, 0, digits, (double)v);
    else
        fputs("null", to);
}

static void put_number(FILE *to, long double v) {
    put_digits(to, 17, v);
}

/* ---- objects ----------------------------------------------------------------------------------- */

static void name_member(answer *a, const char *name) {
    if (a->any)
        putc(',', a->to);
    a->any = true;
    put_string(a->to, name);
    putc(':', a->to);
}

static void begin_object(answer *a) {
    putc('{', a->to);
    a->any = false;
}

static void end_line(answer *a) {
    fputs("}\n", a->to);
}

static void put_member(answer *a, const char *name, const char *text) {
    name_member(a, name);
    put_string(a->to, text);
}

static void put_number_member(answer *a, const char *name, double v) {
    name_member(a, name);
    put_number(a->to, v);
}

static void put_rough(answer *a, const char *name, double v, int digits) {
    name_member(a, name);
    put_digits(a->to, digits, v);
}

static void put_flag(answer *a, const char *name, bool v) {
    name_member(a, name);
    fputs(v ? "true" : "false", a->to);
}

static void put_list(answer *a, const char *name, const double *v, size_t count) {
    name_member(a, name);
    putc('[', a->to);
    for (size_t i = 0; i < count; i++) {
        if (i)
            putc(',', a->to);
        put_number(a->to, v[i]);
    }
    putc(']', a->to);
}

static void put_quantity(answer *a, const char *name, value v) {
    name_member(a, name);
    put_number(a->to, v.v);
}

static void begin_group(answer *a, const char *name) {
    name_member(a, name);
    begin_object(a);
}

static void end_group(answer *a) {
    putc('}', a->to);
    a->any = true;
}

static void begin_items(answer *a, const char *name) {
    name_member(a, name);
    putc('[', a->to);
    a->any = false;
}

static void begin_item(answer *a) {
    if (a->any)
        putc(',', a->to);
    begin_object(a);
}

static void end_items(answer *a) {
    putc(']', a->to);
    a->any = true;
}

static void open_event(answer *a, const char *kind, const char *text) {
    begin_object(a);
    put_member(a, kind, text);
}

/* ---- values and tables ------------------------------------------------------------------------- */

static void put_json_value(answer *a, const column *c, long double si) {
    char unit_text[COLUMN_UNIT];
    dim_unit(c->d, unit_text, sizeof unit_text);
    begin_object(a);
    put_member(a, "name", c->name);
    name_member(a, "value");
    put_number(a->to, si);
    put_member(a, "unit", unit_text);
    end_line(a);
}

static void put_json_estimate(answer *a, const column *c, long double si, long double deviation) {
    (void)deviation;
    put_json_value(a, c, si);
}

/* The units come first, once: rows have but numbers. */
static bool put_json_columns(answer *a, const char *event) {
    char unit_text[COLUMN_UNIT];
    open_event(a, "event", event);
    begin_group(a, "columns");
    for (size_t i = 0; i < a->count; i++) {
        dim_unit(a->columns[i].d, unit_text, sizeof unit_text);
        put_member(a, a->columns[i].name, unit_text);
    }
    end_group(a);
    end_line(a);
    return true;
}

static void put_json_row(answer *a, const long double *si) {
    begin_object(a);
    for (size_t i = 0; i < a->count; i++) {
        name_member(a, a->columns[i].name);
        put_number(a->to, si[i]);
    }
    end_line(a);
}

static void put_json_heads(answer *a, const char *event, const answer_head *heads, size_t count) {
    open_event(a, "event", event);
    begin_group(a, "columns");
    for (size_t i = 0; i < count; i++)
        put_member(a, heads[i].name, heads[i].unit);
    end_group(a);
    end_line(a);
}

static void put_cell(answer *a, const char *name, const answer_cell *c) {
    if (c->kind == CELL_WORDS)
        put_member(a, name, c->words);
    else if (c->kind == CELL_FLAG)
        put_flag(a, name, c->v != 0);
    else
        put_rough(a, name, c->v, c->digits);
}

static void put_json_cells(answer *a, const answer_head *heads, const answer_cell *cells, size_t count) {
    begin_object(a);
    for (size_t i = 0; i < count; i++)
        put_cell(a, heads[i].name, &cells[i]);
    end_line(a);
}

const answer_form answer_as_json = {
    .data = true,
    .value = put_json_value,
    .estimate = put_json_estimate,
    .open = open_event,
    .close = end_line,
    .number = put_number_member,
    .string = put_member,
    .flag = put_flag,
    .list = put_list,
    .quantity = put_quantity,
    .fact = put_member,
    .share = put_number_member,
    .group = begin_group,
    .up = end_group,
    .items = begin_items,
    .item = begin_item,
    .item_up = end_group,
    .items_up = end_items,
    .columns = put_json_columns,
    .row = put_json_row,
    .heads = put_json_heads,
    .cells = put_json_cells,
};
