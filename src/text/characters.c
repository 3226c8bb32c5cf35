/* SPDX-License-Identifier: GPL-3.0-or-later */
/* UTF-8: decoding, encoding, widths, and which characters may be shown. Depends on libc alone. */
#define _XOPEN_SOURCE 700 /* wcwidth */
#include "text/characters.h"

#include <locale.h>
#include <stdio.h>
#include <string.h>
#include <wchar.h>

size_t character_at(const char *text, size_t left, unsigned *code) {
    const unsigned char *p = (const unsigned char *)text;
    if (left == 0)
        return 0;
    const size_t n = *p < 0x80                 ? 1
                     : *p >= 0xf0 && *p < 0xf5 ? 4
                     : *p >= 0xe0 && *p < 0xf0 ? 3
                     : *p >= 0xc2 && *p < 0xe0 ? 2
                                               : 0;
    if (n == 0 || n > left)
        return 0;
    unsigned c = n == 1 ? *p : *p & (0xffU >> (n + 1));
    for (size_t i = 1; i < n; i++) {
        if ((p[i] & 0xc0) != 0x80)
            return 0;
        c = c << 6 | (p[i] & 0x3fU);
    }
    const bool overlong = (n == 3 && c < 0x800) || (n == 4 && c < 0x10000);
    if (overlong || c > 0x10ffff || (c >= 0xd800 && c < 0xe000))
        return 0;
    if (code)
        *code = c;
    return n;
}

size_t character_before(const char *text, size_t at) {
    enum { MOST = 4 };
    size_t from = at;
    do
        from -= from > 0;
    while (from > 0 && at - from < MOST && ((unsigned char)text[from] & 0xc0) == 0x80);
    return from;
}

size_t character_put(unsigned code, char to[CHARACTER_BYTES]) {
    static const unsigned first[] = {0, 0xc0, 0xe0, 0xf0};
    const unsigned more = code < 0x80 ? 0 : code < 0x800 ? 1 : code < 0x10000 ? 2 : 3;
    to[0] = (char)(first[more] | code >> (6 * more));
    for (unsigned i = 1; i <= more; i++)
        to[i] = (char)(0x80 | (code >> (6 * (more - i)) & 0x3f));
    to[more + 1] = 0;
    return more + 1;
}

bool character_shows(unsigned c) {
    static const struct {
        unsigned first, last;
    } hidden[] = {{0x0, 0x1f},        {0x7f, 0x9f},       {0xad, 0xad},      {0x34f, 0x34f},
                  {0x61c, 0x61c},     {0x115f, 0x1160},   {0x17b4, 0x17b5},  {0x180b, 0x180f},
                  {0x200b, 0x200f},   {0x2028, 0x202e},   {0x2060, 0x206f},  {0x3164, 0x3164},
                  {0xfe00, 0xfe0f},   {0xfeff, 0xfeff},   {0xffa0, 0xffa0},  {0xfff0, 0xfffb},
                  {0x1bca0, 0x1bca3}, {0x1d173, 0x1d17a}, {0xe0000, 0xe0fff}};
    if (c >= 0x20 && c < 0x7f)
        return true;
    for (size_t i = 0; i < sizeof hidden / sizeof *hidden; i++)
        if (c >= hidden[i].first && c <= hidden[i].last)
            return false;
    return true;
}

size_t character_count(const char *text, size_t len) {
    size_t count = 0;
    for (size_t i = 0, n; i < len; i += n ? n : 1, count++)
        n = character_at(text + i, len - i, NULL);
    return count;
}

/* The width by the C library's wcwidth, which terminals follow too, whatever the locale of the program is. */
static size_t code_columns(unsigned code) {
    static locale_t utf8; /* made once */
    if (code < 0x300)
        return 1;
    if (!utf8)
        utf8 = newlocale(LC_CTYPE_MASK, "C.UTF-8", (locale_t)0);
    if (!utf8)
        return 1;
    const locale_t before = uselocale(utf8);
    const int n = wcwidth((wchar_t)code);
    uselocale(before);
    return n < 0 ? 1 : (size_t)n;
}

/* The bytes of the character at text, and its columns; an invalid byte is 1 byte in 1 column. */
static size_t step(const char *text, size_t left, size_t *columns) {
    unsigned code;
    const size_t n = character_at(text, left, &code);
    *columns = n && character_shows(code) ? code_columns(code) : 1;
    return n ? n : 1;
}

size_t text_columns(const char *text, size_t len) {
    size_t count = 0;
    for (size_t i = 0, one; i < len; count += one)
        i += step(text + i, len - i, &one);
    return count;
}

size_t text_fit(const char *text, size_t len, size_t columns) {
    size_t i = 0;
    for (size_t n, one; i < len; i += n, columns -= one) {
        n = step(text + i, len - i, &one);
        if (one > columns)
            break;
    }
    return i;
}

size_t text_break(const char **text, size_t *left, size_t columns) {
    const char *row = *text;
    size_t n = text_fit(row, *left, columns), word = n, gone, one;
    while (n < *left && row[n] != ' ' && word > 0 && row[word - 1] != ' ')
        word--;
    n = word ? word : n || !*left ? n : step(row, *left, &one);
    for (gone = n; gone < *left && row[gone] == ' ';)
        gone++;
    *text += gone;
    *left -= gone;
    while (n > 0 && row[n - 1] == ' ')
        n--;
    return n;
}

size_t character_shown(const char *text, size_t left, char shown[CHARACTER_SHOWN]) {
    unsigned code = (unsigned char)*text;
    const size_t n = character_at(text, left, &code);
    if (n && character_shows(code)) {
        memcpy(shown, text, n);
        shown[n] = 0;
    } else if (n && code == '\t') {
        strcpy(shown, " ");
    } else {
        snprintf(shown, CHARACTER_SHOWN, n == 0 || code < 0x80 ? "\\x%02x" : "\\u%04x", code);
    }
    return n ? n : 1;
}

void characters_shown(const char *text, char *to, size_t size) {
    char one[CHARACTER_SHOWN];
    for (size_t left = strlen(text), step, n; left > 0; text += step, left -= step) {
        step = character_shown(text, left, one);
        n = strlen(one);
        if (n >= size)
            break;
        memcpy(to, one, n);
        to += n;
        size -= n;
    }
    *to = 0;
}
