/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A hash index over a table of names, and the distance between words. Depends on libc alone. */
#include "text/words.h"

#include <assert.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

static size_t word_slot(const word_index *x, const char *word, size_t len) {
    return ((unsigned char)word[0] * 5U + (unsigned char)word[len - 1] * 3U + len) % sizeof x->first;
}

bool word_find(word_index *x, const char *word, size_t len, size_t *row) {
    const char *name;
    if (len == 0)
        return false;
    for (size_t i = 0; !x->made && (name = x->name(i)); i++) {
        assert(i < WORDS); /* unreached: WORDS must grow with the tables */
        unsigned char *first = &x->first[word_slot(x, name, strlen(name))];
        x->next[i] = *first;
        *first = (unsigned char)(i + 1);
    }
    x->made = true;
    for (size_t i = x->first[word_slot(x, word, len)]; i; i = x->next[i - 1]) {
        name = x->name(i - 1);
        if (!strncmp(name, word, len) && !name[len]) {
            *row = i - 1;
            return true;
        }
    }
    return false;
}

bool word_among(const char *(*name)(size_t i), const char *word, size_t len, size_t *row) {
    const char *known;
    for (*row = 0; (known = name(*row)); ++*row)
        if (!strncmp(known, word, len) && !known[len])
            return true;
    return false;
}

/* Damerau's edit distance: a change of case costs 1; another, a missing or an added letter or a swap 2. */
static size_t word_distance(const char *a, const char *b) {
    enum { LONGEST = 40 };
    size_t n = strlen(b), rows[3][LONGEST + 1];
    if (n > LONGEST || strlen(a) > LONGEST)
        return 2 * LONGEST;
    for (size_t j = 0; j <= n; j++)
        rows[0][j] = 2 * j;
    size_t i = 0;
    for (; a[i]; i++) {
        const size_t *above = rows[i % 3], *twice = rows[(i + 2) % 3];
        size_t *row = rows[(i + 1) % 3];
        row[0] = 2 * (i + 1);
        for (size_t j = 0; j < n; j++) {
            bool fold = (a[i] ^ b[j]) == 0x20;
            size_t best = above[j] + (a[i] == b[j] ? 0 : fold ? 1 : 2);
            if (i && j && a[i] == b[j - 1] && a[i - 1] == b[j] && twice[j - 1] + 2 < best)
                best = twice[j - 1] + 2;
            if (row[j] + 2 < best)
                best = row[j] + 2;
            if (above[j + 1] + 2 < best)
                best = above[j + 1] + 2;
            row[j + 1] = best;
        }
    }
    return rows[i % 3][n];
}

void takes_text(const char *takes, char *buf, size_t size) {
    static const char adds[] = ", += for an increment";
    const char *more = strstr(takes, "+=") ? adds : "";
    size_t n = 0;
    for (const char *p = takes; *p && n + sizeof adds < size; p++)
        if (*p == ':' && (p[1] == '=' || (p > takes && p[-1] >= 'A' && p[-1] <= 'Z')))
            p += strspn(p + 1, "0123456789.");
        else if (!(*p == '*' && p > takes && p[-1] == ']') && !(*p == '+' && p[1] == '='))
            buf[n++] = *p;
    strcpy(buf + n, more);
}

bool text_add(char *buf, size_t size, const char *format, ...) {
    const size_t n = strlen(buf);
    va_list args;
    va_start(args, format);
    const int more = vsnprintf(buf + n, size - n, format, args);
    va_end(args);
    return more >= 0 && (size_t)more < size - n;
}

void list_word(char *buf, size_t size, const char *between, const char *word) {
    text_add(buf, size, "%s%s", *buf ? between : "", word);
}

bool same_but_case(const char *a, const char *b) {
    while (*a && (*a == *b || ((*a ^ *b) == 0x20 && (*a | 0x20) >= 'a' && (*a | 0x20) <= 'z')))
        a++, b++;
    return !*a && !*b;
}

bool one_letter_apart(const char *a, const char *b) {
    return word_distance(a, b) <= 2;
}

void plain_letters(const char *word, size_t len, char plain[PLAIN_WORD]) {
    static const char *const greek[][2] = {{"μ", "mu"},  {"µ", "mu"},    {"ν", "nu"},
                                           {"η", "eta"}, {"κ", "kappa"}, {"β", "beta_k"},
                                           {"δ", "d"},   {"Δ", "d"},     {"π", "pi"}};
    size_t n = 0;
    for (size_t i = 0; i < len;) {
        const char *as = NULL;
        for (size_t j = 0; !as && j < sizeof greek / sizeof *greek && i + 1 < len; j++)
            if (!memcmp(word + i, greek[j][0], 2))
                as = greek[j][1];
        const size_t taken = as ? strlen(as) : 1;
        if (n + taken >= PLAIN_WORD)
            break;
        memcpy(plain + n, as ? as : word + i, taken);
        n += taken;
        i += as ? 2 : 1;
    }
    plain[n] = 0;
}

const char *suggest(const char *typed, const char *(*name)(size_t i)) {
    char word[PLAIN_WORD];
    plain_letters(typed, strlen(typed), word);
    const char *best = NULL;
    size_t least = strlen(word) <= 2 ? 2 : strlen(word) <= 5 ? 3 : 5;
    const char *candidate;
    for (size_t i = 0; (candidate = name(i)); i++) {
        size_t d = word_distance(word, candidate);
        if (same_but_case(word, candidate))
            d = 1;
        if (d < least) {
            least = d;
            best = candidate;
        }
    }
    return best;
}
