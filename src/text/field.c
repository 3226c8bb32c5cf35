/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Splits lines into fields and reads their numbers, with decimal point or comma. Depends on unit.h. */
#include "text/field.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "text/unit.h"

bool field_is_blank(char c) {
    return c == ' ' || c == '\t' || c == '\r';
}

field field_trimmed(const char *text, size_t len) {
    while (len > 0 && field_is_blank(text[len - 1]))
        len--;
    while (len > 0 && field_is_blank(*text))
        text++, len--;
    return (field){text, len};
}

static bool separates(char separator, char c) {
    return separator == ' ' ? field_is_blank(c) : c == separator;
}

bool field_next(char separator, const char *line, size_t len, size_t *at, field *out) {
    size_t i = *at;
    while (separator == ' ' && i < len && field_is_blank(line[i]))
        i++;
    if (i >= len + (separator != ' '))
        return false;
    const size_t begin = i;
    bool quoted = false;
    int depth = 0;
    for (; i < len; i++) {
        const char c = line[i];
        if (!quoted && depth == 0 && separates(separator, c))
            break;
        quoted = c == '"' ? !quoted : quoted;
        depth += quoted ? 0 : c == '[' || c == '(' ? 1 : (c == ']' || c == ')') && depth > 0 ? -1 : 0;
    }
    *out = field_trimmed(line + begin, i - begin);
    *at = i + 1;
    if (out->len >= 2 && *out->text == '"' && out->text[out->len - 1] == '"')
        *out = field_trimmed(out->text + 1, out->len - 2);
    return true;
}

/* The length of the number with sign at the beginning of a text that is not empty; 0: there is none. */
static size_t take_number(const char *text, size_t len, char point, const unit *u, double *out) {
    const bool minus = *text == '-', sign = minus || *text == '+';
    double v;
    const size_t n = unit_number(text + sign, len - sign, point, u, &v);
    if (n == 0)
        return 0;
    *out = minus ? -v : v;
    return isfinite(v) ? n + sign : 0;
}

bool field_is_number(field f, bool comma, const unit *u, double *out) {
    const char point = comma && !memchr(f.text, '.', f.len) ? ',' : '.';
    return f.len && take_number(f.text, f.len, point, u, out) == f.len;
}

static size_t digits_at(field f, size_t i) {
    const size_t begin = i;
    while (i < f.len && f.text[i] >= '0' && f.text[i] <= '9')
        i++;
    return i - begin;
}

bool field_has_thousands(field f) {
    size_t i = f.len > 0 && (*f.text == '-' || *f.text == '+'), groups = 0;
    const size_t first = digits_at(f, i);
    for (i += first; first > 0 && first <= 3; groups++) {
        size_t mark = i;
        while (mark < f.len && mark - i < 3 &&
               (strchr(" '.,", f.text[mark]) || (unsigned char)f.text[mark] >= 0x80))
            mark++; /* up to three bytes of UTF-8 */
        if (mark == i || digits_at(f, mark) != 3)
            break;
        i = mark + 3;
    }
    return groups > 0 && (i == f.len || (strchr(".,", f.text[i]) && i + 1 + digits_at(f, i + 1) == f.len));
}

bool field_is_missing(field f) {
    static const char *const words[] = {"nan",     "-nan",    "+nan",    "nan(ind)", "-nan(ind)", "1.#qnan",
                                        "-1.#ind", "na",      "n/a",     "no data",  "null",      "#div/0!",
                                        "#n/a",    "#nv",     "#value!", "#wert!",   "#num!",     "#zahl!",
                                        "#ref!",   "#bezug!", "#name?",  "#null!"};
    char word[16];
    bool found = f.len == 0;
    snprintf(word, sizeof word, "%.*s", f.len < sizeof word ? (int)f.len : 0, f.text);
    for (size_t i = 0; i < sizeof words / sizeof *words && *word; i++)
        found = found || same_but_case(word, words[i]);
    return found;
}

bool cell_next(char separator, const char *line, size_t len, size_t *at, const unit *u, cell *out) {
    const size_t n = *at < len ? take_number(line + *at, len - *at, '.', u, &out->v) : 0;
    out->is = NUMBER;
    out->ends = false;
    if (n > 0 && (*at + n == len || separates(separator, line[*at + n]))) { /* fast path: a bare number */
        out->f = (field){line + *at, n};
        *at += n + 1;
        return true;
    }
    if (!field_next(separator, line, len, at, &out->f))
        return false;
    field *f = &out->f;
    const bool comma = separator != ',' || (f->text > line && f->text[-1] == '"');
    if (field_is_number(*f, comma, u, &out->v))
        return true;
    if (field_is_missing(*f)) {
        out->is = MISSING;
        out->v = NAN;
        return true;
    }
    const char *hash = memchr(f->text, '#', f->len);
    const field before = field_trimmed(f->text, hash ? (size_t)(hash - f->text) : 0);
    const bool first = f->text == line && *at < len; /* in `1#,0,0` the # begins no comment */
    out->ends = hash && !first && field_is_number(before, comma, u, &out->v);
    out->is = out->ends ? NUMBER : hash == f->text ? COMMENT : WORD;
    return true;
}
