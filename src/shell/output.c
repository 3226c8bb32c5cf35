/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "shell/output.h"

#include <math.h>
#include <string.h>

void print_json_string(FILE *to, const char *text) {
    fputc('"', to);
    for (; *text; text++) {
        unsigned char c = (unsigned char)*text;
        if (c == '"' || c == '\\')
            fprintf(to, "\\%c", c);
        else if (c < 0x20)
            fprintf(to, "\\u%04x", c);
        else
            fputc(c, to);
    }
    fputc('"', to);
}

void format_value(const shell *sh, value v, char *buf, size_t size) {
    char unit_text[COLUMN_UNIT];
    long double scale = unit_choose(v.d, v.v, sh->set.digits, unit_text, sizeof unit_text);
    snprintf(buf, size, "%.*g%s%s", sh->set.digits, (double)(v.v / scale), *unit_text ? " " : "", unit_text);
}

/* JSON has no infinities; results never are, but a table may hold gaps. */
static void json_number(FILE *to, long double v) {
    if (isfinite((double)v))
        fprintf(to, "%.17g", (double)v);
    else
        fputs("null", to);
}

static void csv_field(FILE *to, const column *c) {
    char text[COLUMN_NAME + COLUMN_UNIT + 8];
    snprintf(text, sizeof text, *c->unit ? "%s [%s]" : "%s", c->name, c->unit);
    if (!strpbrk(text, ",\"")) {
        fputs(text, to);
        return;
    }
    fputc('"', to);
    for (const char *p = text; *p; p++) {
        if (*p == '"')
            fputc('"', to);
        fputc(*p, to);
    }
    fputc('"', to);
}

void print_values(shell *sh, const column *columns, const long double *si, size_t count) {
    FILE *to = sh->out;
    switch (sh->set.format) {
    case FORMAT_TEXT:
        for (size_t i = 0; i < count; i++) {
            char text[COLUMN_UNIT + 64];
            if (columns[i].chosen)
                snprintf(text, sizeof text, "%.*g %s", sh->set.digits, (double)(si[i] / columns[i].scale),
                         columns[i].unit);
            else
                format_value(sh, (value){si[i], columns[i].d}, text, sizeof text);
            fprintf(to, "%s = %s\n", columns[i].name, text);
        }
        break;
    case FORMAT_CSV: {
        table t = {.sh = sh, .to = to, .count = count};
        memcpy(t.columns, columns, count * sizeof *columns);
        table_begin(&t);
        table_row(&t, si);
        break;
    }
    case FORMAT_JSON:
        for (size_t i = 0; i < count; i++) {
            char unit_text[COLUMN_UNIT];
            dim_unit(columns[i].d, unit_text, sizeof unit_text);
            fputs("{\"name\":", to);
            print_json_string(to, columns[i].name);
            fputs(",\"value\":", to);
            json_number(to, si[i]);
            fputs(",\"unit\":", to);
            print_json_string(to, unit_text);
            fputs("}\n", to);
        }
        break;
    }
}

/* Width of a text column: a number with its digits, or the head. */
static int width(const table *t, size_t i) {
    size_t head = strlen(t->columns[i].name) + (*t->columns[i].unit ? strlen(t->columns[i].unit) + 3 : 0);
    size_t number = (size_t)t->sh->set.digits + 7;
    return (int)(head > number ? head : number);
}

void table_begin(table *t) {
    if (t->sh->set.format == FORMAT_JSON)
        return;
    for (size_t i = 0; i < t->count; i++) {
        const column *c = &t->columns[i];
        if (t->sh->set.format == FORMAT_CSV) {
            if (i)
                fputc(',', t->to);
            csv_field(t->to, c);
        } else {
            char head[COLUMN_NAME + COLUMN_UNIT + 8];
            snprintf(head, sizeof head, *c->unit ? "%s [%s]" : "%s", c->name, c->unit);
            fprintf(t->to, "%s%*s", i ? "  " : "", width(t, i), head);
        }
    }
    fputc('\n', t->to);
}

void table_row(table *t, const long double *si) {
    FILE *to = t->to;
    bool json = t->sh->set.format == FORMAT_JSON;
    for (size_t i = 0; i < t->count; i++) {
        const column *c = &t->columns[i];
        if (json) {
            fputc(i ? ',' : '{', to);
            print_json_string(to, c->name);
            fputc(':', to);
            json_number(to, si[i]);
        } else if (t->sh->set.format == FORMAT_CSV) {
            fprintf(to, i ? ",%.17g" : "%.17g", (double)(si[i] / c->scale));
        } else {
            fprintf(to, "%s%*.*g", i ? "  " : "", width(t, i), t->sh->set.digits, (double)(si[i] / c->scale));
        }
    }
    fputs(json ? "}\n" : "\n", to);
}
