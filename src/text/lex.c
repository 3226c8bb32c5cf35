/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The lexer, and decimal literals rounded once. Depends on text/error and text/characters. */
#include "text/lex.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "text/characters.h"

/* Not <ctype.h>, which depends on the locale: bytes above 127 belong to names in UTF-8 (micro). */
static bool digit(char c) {
    return c >= '0' && c <= '9';
}
static bool letter(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || (unsigned char)c >= 0x80;
}
bool lex_in_name(char c) {
    return letter(c) || digit(c);
}
static bool blank(char c) {
    return c == ' ' || c == '\t' || c == '\r' || c == '\n';
}

size_t lex_width(const lexer *lx) {
    return lx->len + (lx->part && lx->kind == T_END && lx->len == 0);
}

void lex_start(lexer *lx, const char *text, size_t len, calc_error *error) {
    *lx = (lexer){.text = text, .end = len, .error = error};
    lex_seek(lx, 0);
}

/* Appends the digits at p to *number, modulo 2^64, and returns where they end. */
static const char *take_digits(const char *p, const char *end, unsigned long long *number) {
    unsigned long long n = *number;
    for (unsigned d; p < end && (d = (unsigned)(*p - '0')) <= 9; p++)
        n = 10 * n + d;
    *number = n;
    return p;
}

/* The value of a mantissa (its bytes in text, with `point` as mark) times 10^exponent, by strtod. */
static double long_decimal(const char *text, size_t mantissa, char point, long exponent) {
    char small[96], *copy = mantissa + 32 < sizeof small ? small : malloc(mantissa + 32);
    if (!copy)
        return NAN;
    snprintf(copy, mantissa + 32, "%.*se%ld", (int)mantissa, text, exponent);
    char *mark = memchr(copy, point, mantissa);
    if (mark)
        *mark = '.';
    const double value = strtod(copy, NULL);
    if (copy != small)
        free(copy);
    return value;
}

size_t lex_decimal(const char *text, size_t len, char point, int shift, double *out) {
    const char *end = text + len;
    unsigned long long number = 0;
    const char *p = take_digits(text, end, &number);
    size_t digits = (size_t)(p - text), behind = 0;
    if (p < end && *p == point && !(p + 1 < end && p[1] == point)) {
        const char *from = ++p;
        p = take_digits(from, end, &number);
        behind = (size_t)(p - from);
        digits += behind;
    }
    if (digits == 0)
        return 0;
    const size_t mantissa = (size_t)(p - text);
    long written = 0;
    if (p < end && (*p == 'e' || *p == 'E')) {
        const char *q = p + 1;
        const bool minus = q < end && *q == '-';
        q += minus || (q < end && *q == '+');
        for (; q < end && digit(*q); p = ++q)
            if (written < 100000)
                written = 10 * written + (*q - '0');
        written = minus ? -written : written;
    }
#if FLT_EVAL_METHOD == 0
    /* Clinger's fast path: integer and power of ten are exact doubles, so that one operation rounds once. */
    static const double ten[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11,
                                 1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
    const long exponent = shift + written - (long)behind;
    if (digits <= 19 && number <= 1ULL << 53 && exponent >= -22 && exponent <= 22)
        *out = exponent < 0 ? (double)(long long)number / ten[-exponent]
                            : (double)(long long)number * ten[exponent];
    else
#endif
        *out = long_decimal(text, mantissa, point, written + shift);
    return (size_t)(p - text);
}

static void read_number(lexer *lx) {
    const char *s = lx->text;
    lx->kind = T_NUMBER;
    lx->len = lex_decimal(s + lx->at, lx->end - lx->at, '.', 0, &lx->number);
    if (isnan(lx->number)) {
        calc_no_memory(lx->error);
        return;
    }
    if (isfinite(lx->number) && lx->number != 0)
        return;
    bool zero = true;
    for (size_t i = lx->at; i < lx->at + lx->len && s[i] != 'e' && s[i] != 'E'; i++)
        zero = zero && (s[i] == '0' || s[i] == '.');
    if (lx->number != 0 || !zero)
        lex_fail(lx, "the number is too %s for double precision", lx->number == 0 ? "small" : "large");
}

/* ---- commas ------------------------------------------------------------------------------------ */

/* Is byte i a digit, or a point or comma between two digits? */
static bool of_number(const lexer *lx, size_t i) {
    const char *s = lx->text;
    const bool mark = s[i] == '.' || s[i] == ',';
    return digit(s[i]) || (mark && i > 0 && digit(s[i - 1]) && i + 1 < lx->end && digit(s[i + 1]));
}

bool lex_decimal_comma(const lexer *lx, size_t at, size_t *from, size_t *len) {
    if (at >= lx->end || lx->text[at] != ',' || !of_number(lx, at))
        return false;
    size_t begin = at, end = at;
    while (begin > 0 && of_number(lx, begin - 1))
        begin--;
    while (end < lx->end && of_number(lx, end))
        end++;
    *from = begin;
    *len = end - begin;
    return begin == 0 || !letter(lx->text[begin - 1]);
}

bool lex_one_value(lexer *lx) {
    size_t from, len;
    if (lx->kind != T_COMMA || !lex_decimal_comma(lx, lx->at, &from, &len))
        return true;
    const char *number = lx->text + from, *comma = lx->text + lx->at;
    const size_t before = lx->at - from, behind = len - before - 1;
    if (len > 40 || memchr(number, '.', len) || memchr(number, ',', before) || memchr(comma + 1, ',', behind))
        return calc_fail(
            lx->error, from, len,
            "a comma is no part of a number: a decimal comma is a point here, and digits are not grouped");
    char words[80] = "";
    if (behind == 3 && *number != '0') /* thousands, perhaps */
        snprintf(words, sizeof words, ", or %.*s%.*s", (int)before, number, (int)behind, comma + 1);
    return calc_fail(lx->error, from, len, "a decimal comma is a point here: write %.*s.%.*s%s", (int)before,
                     number, (int)behind, comma + 1, words);
}

/* ---- characters -------------------------------------------------------------------------------- */

/* How to write in ASCII what typeset text has instead; NULL: the character is not in the table. */
static const char *plain_of(unsigned code) {
    static const struct {
        unsigned first, last;
        const char *plain;
    } rows[] = {{0xa0, 0xa0, "an ordinary blank"},
                {0xab, 0xab, "\""},
                {0xb0, 0xb0, "deg"},
                {0xb1, 0xb1, "+-"},
                {0xb2, 0xb2, "^2"},
                {0xb3, 0xb3, "^3"},
                {0xb7, 0xb7, "*"},
                {0xbb, 0xbb, "\""},
                {0xd7, 0xd7, "*"},
                {0xf7, 0xf7, "/"},
                {0x2000, 0x200a, "an ordinary blank"},
                {0x2010, 0x2015, "-"},
                {0x201c, 0x201f, "\""},
                {0x2026, 0x2026, ".."},
                {0x202f, 0x202f, "an ordinary blank"},
                {0x2212, 0x2212, "-"},
                {0x2215, 0x2215, "/"},
                {0x221a, 0x221a, "sqrt( )"},
                {0x22c5, 0x22c5, "*"},
                {0x660, 0x669, "a digit from 0 to 9"},
                {0x6f0, 0x6f9, "a digit from 0 to 9"},
                {0x966, 0x96f, "a digit from 0 to 9"},
                {0xff01, 0xff5e, "it in ASCII"}}; /* full width */
    static const char digits[] = "0\0001\0002\0003\0004\0005\0006\0007\0008\0009";
    if (code >= 0xff10 && code <= 0xff19)
        return digits + 2 * (code - 0xff10);
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
        if (code >= rows[i].first && code <= rows[i].last)
            return rows[i].plain;
    return NULL;
}

/* Raises an error if the name holds a hidden character, one that plain_of knows, or invalid UTF-8. */
static void check_name(lexer *lx) {
    const char *s = lx->text + lx->at;
    for (size_t i = 0; i < lx->len;) {
        unsigned code;
        const size_t n = character_at(s + i, lx->len - i, &code);
        if (n == 0 || !character_shows(code)) {
            calc_raise(lx->error, lx->at + i, n ? n : 1,
                       n ? "unexpected character U+%04X" : "unexpected byte 0x%02x",
                       n ? code : (unsigned)(unsigned char)s[i]);
            return;
        }
        const char *plain = plain_of(code);
        if (plain) {
            calc_raise(lx->error, lx->at + i, n, "'%.*s' (U+%04X) is no character of the language: write %s",
                       (int)n, s + i, code, plain);
            return;
        }
        i += n;
    }
}

void lex_seek(lexer *lx, size_t at) {
    const char *s = lx->text;
    lx->last = lx->at + lx->len;
    while (at < lx->end && blank(s[at]))
        at++;
    lx->at = at;
    lx->len = 0;
    lx->kind = T_END;
    if (at >= lx->end) {
        lx->at = lx->last; /* errors about a missing token point right behind the last one */
        return;
    }
    char c = s[at], d = at + 1 < lx->end ? s[at + 1] : 0;
    lx->len = 1;
    if (digit(c) || (c == '.' && digit(d))) {
        read_number(lx);
    } else if (letter(c)) {
        bool wide = false;
        for (; at < lx->end && (letter(s[at]) || digit(s[at])); at++)
            wide = wide || (unsigned char)s[at] >= 0x80;
        lx->len = at - lx->at;
        lx->kind = T_NAME;
        if (wide)
            check_name(lx);
    } else if (c == '"') {
        size_t i = at + 1;
        while (i < lx->end && s[i] != '"')
            i++;
        lx->len = (i < lx->end ? i + 1 : i) - at;
        lx->kind = T_STRING;
        if (i >= lx->end)
            lex_fail(lx, "the quotation mark is not closed");
    } else if (c == '=' && d != '=') {
        lx->kind = T_ASSIGN;
    } else if (c == ':' && d == '=') {
        lx->kind = T_DEFINE;
        lx->len = 2;
    } else if (c == '+' && d == '=') {
        lx->kind = T_INCREMENT;
        lx->len = 2;
    } else if (c == '.' && d == '.') {
        lx->kind = T_RANGE;
        lx->len = 2;
    } else if (c == '-' && d == '>') {
        lx->len = 2;
        lex_fail(lx, "`in` asks for a unit: 2 mm in um");
    } else if (c && strchr("+-*/^(),:%|", c)) {
        lx->kind = (token_kind)c;
    } else if (c == '=' || c == '<' || c == '>' || c == '!') {
        lex_fail(lx, "there are no comparisons: '%c' is not an operator here", c);
    } else if (c == '#') {
        lex_fail(lx, "'#' within a word begins no comment: put a blank before it");
    } else if (c == '\'') {
        lex_fail(lx, "unexpected character ''': texts and names go into \"quotation marks\"");
    } else if ((unsigned char)c < 0x20 || c == 0x7f) {
        lex_fail(lx, "unexpected byte 0x%02x", (unsigned)(unsigned char)c);
    } else {
        lex_fail(lx, "unexpected character '%c'", c);
    }
}

void lex_next(lexer *lx) {
    lex_seek(lx, lx->at + lx->len);
}

bool lex_is(const lexer *lx, const char *word) {
    return lx->kind == T_NAME && strlen(word) == lx->len && !memcmp(lx->text + lx->at, word, lx->len);
}

bool lex_accept(lexer *lx, const char *word) {
    if (!lex_is(lx, word))
        return false;
    lex_next(lx);
    return true;
}

void lex_word(const lexer *lx, char word[LEX_NAME]) {
    snprintf(word, LEX_NAME, "%.*s", LEX_WORD(lx));
}

bool lex_whole(lexer *lx, const char *what, char word[LEX_NAME]) {
    if (lx->len >= LEX_NAME)
        return lex_fail(lx, "%s has at most %d characters", what, LEX_NAME - 1);
    memcpy(word, lx->text + lx->at, lx->len);
    word[lx->len] = 0;
    return true;
}

token_kind lex_peek(const lexer *lx) {
    size_t i = lx->at + lx->len;
    while (i < lx->end && blank(lx->text[i]))
        i++;
    if (i >= lx->end)
        return T_END;
    char c = lx->text[i], d = i + 1 < lx->end ? lx->text[i + 1] : 0;
    if (d == '=' && (c == '+' || c == ':'))
        return c == '+' ? T_INCREMENT : T_DEFINE;
    if (c == '=')
        return d == '=' ? T_END : T_ASSIGN;
    return letter(c) ? T_NAME : digit(c) ? T_NUMBER : (token_kind)(unsigned char)c;
}

bool lex_assigns(const lexer *lx) {
    const token_kind next = lx->kind == T_NAME ? lex_peek(lx) : T_END;
    return next == T_ASSIGN || next == T_INCREMENT || next == T_DEFINE;
}

bool lex_filename(lexer *lx, char *buf, size_t size) {
    size_t at = lx->at, n = 0;
    bool quoted = at < lx->end && lx->text[at] == '"';
    if (quoted)
        at++;
    while (at < lx->end && (quoted ? lx->text[at] != '"' : !blank(lx->text[at]))) {
        if (n + 1 < size)
            buf[n] = lx->text[at];
        n++;
        at++;
    }
    if (quoted && at == lx->end) {
        lx->len = at - lx->at;
        lx->error->raised = false; /* the lexer may have raised the same error */
        return lex_fail(lx, "the quotation mark is not closed");
    }
    if (n == 0)
        return lex_fail(lx, "expected a file name");
    lx->error->raised = false; /* the name need not be made of valid tokens */
    if (n >= size)
        return lex_fail(lx, "the file name is too long");
    buf[n] = 0;
    lx->len = at + quoted - lx->at;
    lex_next(lx);
    return true;
}
