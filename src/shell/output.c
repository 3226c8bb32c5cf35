/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "shell/output.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { NUMBER = 32 }; /* bytes that hold any number of 17 digits */

/* ---- numbers ----------------------------------------------------------------------------------- */

/* printf takes 100 to 200 ns a number, most of a table's time. One product in extended precision with an
 * exact power of ten gives the same digits, wherever its rounding cannot tip them; where it can, printf
 * decides. */
static size_t number_text(char text[NUMBER], int digits, double v) {
    static const long double ten[] = {1e0L,  1e1L,  1e2L,  1e3L,  1e4L,  1e5L,  1e6L,  1e7L,  1e8L,  1e9L,
                                      1e10L, 1e11L, 1e12L, 1e13L, 1e14L, 1e15L, 1e16L, 1e17L, 1e18L, 1e19L,
                                      1e20L, 1e21L, 1e22L, 1e23L, 1e24L, 1e25L, 1e26L, 1e27L};
    enum { EXACT = 27, OFFSET = 1100 };
    v += 0.0; /* -0 is 0 */
    long double x = fabsl((long double)v), y = 0;
    int binary;
    frexp(v, &binary);
    /* the decimal exponent, or one less: floor(log10(2^(binary-1))) */
    int e = ((binary - 1) * 30103 + OFFSET * 100000) / 100000 - OFFSET;
    for (int up = 0; up < 2; up++) {
        int shift = digits - 1 - e;
        if (!(x > 0) || !isfinite(v) || shift < -EXACT || shift > EXACT)
            return (size_t)snprintf(text, NUMBER, "%.*g", digits, v);
        y = shift < 0 ? x / ten[-shift] : x * ten[shift];
        if (y < ten[digits])
            break;
        e++;
    }
    long long d = llrintl(y);
    if (0.5L - fabsl(y - (long double)d) <= y * LDBL_EPSILON)
        return (size_t)snprintf(text, NUMBER, "%.*g", digits, v);
    if ((long double)d >= ten[digits]) {
        d /= 10;
        e++;
    }

    char digit[20];
    for (int i = digits; i-- > 0; d /= 10)
        digit[i] = (char)('0' + d % 10);
    int used = digits;
    while (used > 1 && digit[used - 1] == '0')
        used--;
    char *p = text;
    if (v < 0)
        *p++ = '-';
    bool scientific = e < -4 || e >= digits;
    int whole = scientific ? 1 : e + 1; /* digits before the point */
    if (whole <= 0) {
        memcpy(p, "0.000", (size_t)(2 - whole));
        p += 2 - whole;
        whole = 0;
    }
    memcpy(p, digit, (size_t)whole);
    p += whole;
    if (used > whole) {
        if (whole)
            *p++ = '.';
        memcpy(p, digit + whole, (size_t)(used - whole));
        p += used - whole;
    }
    if (scientific) {
        int n = abs(e);
        *p++ = 'e', *p++ = e < 0 ? '-' : '+';
        *p++ = (char)('0' + n / 10), *p++ = (char)('0' + n % 10);
    }
    *p = 0;
    return (size_t)(p - text);
}

/* In a field of `width`, to the right. */
static void put_number(FILE *to, int width, int digits, double v) {
    static const char blanks[] = "                        ";
    char text[NUMBER];
    size_t n = number_text(text, digits, v);
    for (size_t pad = (size_t)width > n ? (size_t)width - n : 0; pad;) {
        size_t part = pad < sizeof blanks - 1 ? pad : sizeof blanks - 1;
        fwrite(blanks, 1, part, to);
        pad -= part;
    }
    fwrite(text, 1, n, to);
}

void print_json_string(FILE *to, const char *text) {
    putc('"', to);
    for (;; text++) {
        size_t plain = 0;
        while ((unsigned char)text[plain] >= 0x20 && text[plain] != '"' && text[plain] != '\\')
            plain++;
        fwrite(text, 1, plain, to);
        text += plain;
        if (!*text)
            break;
        fprintf(to, (unsigned char)*text < 0x20 ? "\\u%04x" : "\\%c", (unsigned char)*text);
    }
    putc('"', to);
}

void format_value(const shell *sh, value v, char *buf, size_t size) {
    char unit_text[COLUMN_UNIT];
    long double scale = unit_choose(v.d, v.v, sh->set.digits, unit_text, sizeof unit_text);
    char number[NUMBER];
    number_text(number, sh->set.digits, (double)(v.v / scale));
    snprintf(buf, size, "%s%s%s", number, *unit_text ? " " : "", unit_text);
}

void format_exact(const shell *sh, value v, char *buf, size_t size) {
    char unit_text[COLUMN_UNIT], number[NUMBER];
    double want = (double)v.v, read = NAN;
    for (int digits = sh->set.digits; digits <= 17 && read != fabs(want); digits++) {
        long double scale = unit_choose(v.d, want, digits, unit_text, sizeof unit_text);
        size_t n = number_text(number, digits, (double)(want / scale));
        bool minus = number[0] == '-';
        read = lex_decimal(number + minus, n - minus, (int)lroundl(log10l(scale)));
    }
    if (read != fabs(want)) {
        number_text(number, 17, want);
        dim_unit(v.d, unit_text, sizeof unit_text);
    }
    snprintf(buf, size, "%s%s%s", number, *unit_text ? " " : "", unit_text);
}

/* JSON has no infinities; results never are, but a table may hold gaps. */
static void json_number(FILE *to, long double v) {
    if (isfinite((double)v))
        put_number(to, 0, 17, (double)v);
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
            if (columns[i].chosen) {
                char number[NUMBER];
                number_text(number, sh->set.digits, (double)(si[i] / columns[i].scale));
                snprintf(text, sizeof text, "%s %s", number, columns[i].unit);
            } else {
                format_value(sh, (value){si[i], columns[i].d}, text, sizeof text);
            }
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
        t->width[i] = width(t, i);
        if (t->sh->set.format == FORMAT_CSV) {
            if (i)
                putc(',', t->to);
            csv_field(t->to, c);
        } else {
            char head[COLUMN_NAME + COLUMN_UNIT + 8];
            snprintf(head, sizeof head, *c->unit ? "%s [%s]" : "%s", c->name, c->unit);
            fprintf(t->to, "%s%*s", i ? "  " : "", t->width[i], head);
        }
    }
    putc('\n', t->to);
}

void table_row(table *t, const long double *si) {
    FILE *to = t->to;
    format form = t->sh->set.format;
    for (size_t i = 0; i < t->count; i++) {
        const column *c = &t->columns[i];
        if (form == FORMAT_JSON) {
            putc(i ? ',' : '{', to);
            print_json_string(to, c->name);
            putc(':', to);
            json_number(to, si[i]);
        } else if (form == FORMAT_CSV) {
            if (i)
                putc(',', to);
            put_number(to, 0, 17, (double)(si[i] / c->scale));
        } else {
            if (i)
                fwrite("  ", 1, 2, to);
            put_number(to, t->width[i], t->sh->set.digits, (double)(si[i] / c->scale));
        }
    }
    if (form == FORMAT_JSON)
        putc('}', to);
    putc('\n', to);
}
