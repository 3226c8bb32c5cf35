/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Numbers, values and columns as text. Writes to the streams given; uses the units of `text`. */
#include "statement/output.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "text/characters.h"
#include "text/unit.h"

/* ---- numbers ----------------------------------------------------------------------------------- */

/* printf takes 100 to 200 ns longer; a table takes 0.4 us a number instead of 0.6. v is scaled by a power of
 * ten, exact up to 10^27, in one rounded operation of extended precision. Where the result is so close to
 * half an integer that this rounding could change the digits, printf writes the number. */
size_t number_text(char text[NUMBER_TEXT], int digits, double v) {
    static const long double ten[] = {1e0L,  1e1L,  1e2L,  1e3L,  1e4L,  1e5L,  1e6L,  1e7L,  1e8L,  1e9L,
                                      1e10L, 1e11L, 1e12L, 1e13L, 1e14L, 1e15L, 1e16L, 1e17L, 1e18L, 1e19L,
                                      1e20L, 1e21L, 1e22L, 1e23L, 1e24L, 1e25L, 1e26L, 1e27L};
    enum { EXACT = 27, OFFSET = 1100 };
    v += 0.0; /* -0 is 0 */
    long double x = fabsl((long double)v), y = 0;
    int binary;
    frexp(v, &binary);
    /* the decimal exponent or one less, floor(log10(2^(binary - 1))); OFFSET: the division must round down */
    int e = ((binary - 1) * 30103 + OFFSET * 100000) / 100000 - OFFSET;
    for (;; e++) {
        int shift = digits - 1 - e;
        if (!(x > 0) || !isfinite(v) || shift < -EXACT || shift > EXACT)
            return (size_t)snprintf(text, NUMBER_TEXT, "%.*g", digits, v);
        y = shift < 0 ? x / ten[-shift] : x * ten[shift];
        if (y < ten[digits])
            break;
    }
    long long d = llrintl(y);
    if (0.5L - fabsl(y - (long double)d) <= y * LDBL_EPSILON)
        return (size_t)snprintf(text, NUMBER_TEXT, "%.*g", digits, v);
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

void print_number(FILE *to, int width, int digits, double v) {
    static const char blanks[] = "                        ";
    char text[NUMBER_TEXT];
    size_t n = number_text(text, digits, v);
    for (size_t pad = (size_t)width > n ? (size_t)width - n : 0; pad;) {
        size_t part = pad < sizeof blanks - 1 ? pad : sizeof blanks - 1;
        fwrite(blanks, 1, part, to);
        pad -= part;
    }
    fwrite(text, 1, n, to);
}

double round_up(double v) {
    const double place = pow(10, floor(log10(v)));
    return ceil(v / place * (1 - 1e-9)) * place;
}

void print_safe(FILE *to, const char *text, size_t len) {
    char shown[CHARACTER_SHOWN];
    for (size_t i = 0, plain = 0; i < len; plain = 0) {
        while (i + plain < len && text[i + plain] >= ' ' && text[i + plain] < 0x7f)
            plain++;
        if (plain > 0) {
            fwrite(text + i, 1, plain, to);
            i += plain;
        } else if (text[i] == '\n') {
            putc(' ', to);
            i++;
        } else {
            i += character_shown(text + i, len - i, shown);
            fputs(shown, to);
        }
    }
}

/* ---- values ------------------------------------------------------------------------------------ */

long double column_unit(const column *c, long double v, int digits, char unit_text[COLUMN_UNIT]) {
    lexer lx;
    unit u;
    if (!c->chosen && !c->row)
        return unit_choose(c->d, v, digits, unit_text, COLUMN_UNIT);
    snprintf(unit_text, COLUMN_UNIT, "%s", c->chosen ? c->unit : c->row);
    if (c->chosen)
        return c->scale;
    lex_start(&lx, c->row, strlen(c->row), error_quiet());
    unit_parse(&lx, &u);
    return unit_scale(&u);
}

void format_value(const settings *set, value v, char *buf, size_t size) {
    format_column(&(column){.d = v.d}, set->digits, v.v, buf, size);
}

void format_column(const column *c, int digits, long double si, char *buf, size_t size) {
    char unit_text[COLUMN_UNIT], number[NUMBER_TEXT];
    const long double scale = column_unit(c, si, digits, unit_text);
    number_text(number, digits, (double)(si / scale));
    snprintf(buf, size, "%s%s%s", number, *unit_text ? " " : "", unit_text);
}

void format_estimate(const column *c, int digits, const estimate *e, char text[ESTIMATE_TEXT]) {
    char unit_text[COLUMN_UNIT], number[3][NUMBER_TEXT];
    const long double scale = column_unit(c, e->v, digits, unit_text);
    number_text(number[0], digits, (double)(e->v / scale));
    number_text(number[1], 3, (double)((e->uneven ? e->below : e->deviation) / scale));
    number_text(number[2], 3, (double)(e->above / scale));
    const char *blank = *unit_text ? " " : "";
    snprintf(text, ESTIMATE_TEXT, "%s%s%s %s%s%s%s", number[0], blank, unit_text, e->uneven ? "(-" : "+- ",
             number[1], blank, unit_text);
    if (e->uneven)
        text_add(text, ESTIMATE_TEXT, ", +%s%s%s)", number[2], blank, unit_text);
}

/* The value of a literal such as `90 deg` as the language reads it, in SI. */
static double read_back(const char *text) {
    lexer lx;
    unit u = {.factor = 1};
    lex_start(&lx, text, strlen(text), error_quiet());
    const bool minus = lx.kind == T_MINUS;
    if (minus)
        lex_next(&lx);
    const size_t at = lx.at, len = lx.len;
    lex_next(&lx);
    if (lx.kind != T_END)
        unit_parse(&lx, &u);
    double v = 0;
    unit_number(text + at, len, '.', &u, &v);
    return minus ? -v : v;
}

void format_exact(value v, char *buf, size_t size) {
    enum { LEAST = 6, MOST = 17 };
    const value kept = {(double)v.v, v.d}; /* rounded to double, as the language reads it */
    for (int digits = LEAST; digits <= MOST; digits++) {
        format_value(&(settings){.digits = digits}, kept, buf, size);
        if (read_back(buf) == kept.v)
            return;
    }
    char unit_text[COLUMN_UNIT];
    dim_unit(v.d, unit_text, sizeof unit_text);
    snprintf(buf, size, "%.*g%s%s", MOST, (double)kept.v, *unit_text ? " " : "", unit_text);
}

/* ---- columns ----------------------------------------------------------------------------------- */

char *column_name(const char *text, size_t len) {
    char *name = malloc(len + 1), before = ' ';
    size_t n = 0;
    for (size_t i = 0; name && i < len; i++) {
        const char c = text[i] == '\n' || text[i] == '\r' || text[i] == '\t' ? ' ' : text[i];
        if (c != ' ' || before != ' ') /* the indent of a continued line becomes one blank */
            name[n++] = before = c;
    }
    if (name)
        name[n] = 0;
    return name;
}

bool column_si(column *c, const char *name, dim d) {
    *c = (column){.name = column_name(name, strlen(name)), .scale = 1, .d = d};
    dim_unit(d, c->unit, sizeof c->unit);
    return c->name != NULL;
}

bool columns_distinct(column *c, size_t count) {
    enum { MARK = 16 };
    for (size_t i = count; i-- > 1;) {
        size_t before = 0;
        for (size_t j = 0; j < i; j++)
            before += !strcmp(c[j].name, c[i].name);
        const size_t size = strlen(c[i].name) + MARK;
        char *name = before ? malloc(size) : c[i].name;
        if (!name)
            return false;
        if (before) {
            snprintf(name, size, "%s (%zu)", c[i].name, before + 1);
            free(c[i].name);
        }
        c[i].name = name;
    }
    return true;
}

void columns_free(column *c, size_t count) {
    for (size_t i = 0; i < count; i++) {
        free(c[i].name);
        c[i].name = NULL;
    }
}

/* The scale of a unit that suits all values: one for the geometric mean of their smallest and largest
 * magnitudes, or, if the largest would have five digits before the point, one for the largest. Magnitudes
 * below 1e-6 of the largest count as 0. */
static long double suitable_scale(const column *c, const long double *v, size_t count, size_t stride,
                                  int digits, char unit_text[COLUMN_UNIT]) {
    long double most = 0, least = INFINITY;
    for (size_t i = 0; i < count; i++)
        if (isfinite(v[i * stride]))
            most = fmaxl(most, fabsl(v[i * stride]));
    for (size_t i = 0; i < count; i++) {
        const long double size = fabsl(v[i * stride]);
        if (isfinite(size) && size > 1e-6L * most)
            least = fminl(least, size);
    }
    const long double middle = most > 0 ? sqrtl(least) * sqrtl(most) : 0;
    const long double scale = column_unit(c, middle, digits, unit_text);
    return most < 1e4L * scale ? scale : column_unit(c, most, digits, unit_text);
}

void column_suit(column *c, const long double *v, size_t count, size_t stride, int digits) {
    if (!c->chosen)
        c->scale = suitable_scale(c, v, count, stride, digits, c->unit);
}
