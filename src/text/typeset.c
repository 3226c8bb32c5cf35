/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Typesetting of plain formulas by a table of words and signs. Depends on libc alone. */
#include "text/typeset.h"

#include <ctype.h>
#include <langinfo.h>
#include <locale.h>
#include <string.h>

bool typeset_unicode(void) {
    static enum { UNDECIDED, PLAIN, UNICODE } decided;
    if (decided == UNDECIDED) {
        locale_t locale = newlocale(LC_CTYPE_MASK, "", (locale_t)0);
        decided = locale && !strcmp(nl_langinfo_l(CODESET, locale), "UTF-8") ? UNICODE : PLAIN;
        if (locale)
            freelocale(locale);
    }
    return decided == UNICODE;
}

typedef struct sign {
    const char *plain, *set;
} sign;

/* Replaced as whole words or before an index: delta_x, beta_k. */
static const sign letters[] = {
    {"delta", "δ"}, {"mu", "μ"},    {"eta", "η"}, {"kappa", "κ"}, {"nu", "ν"},    {"beta", "β"},
    {"pi", "π"},    {"sigma", "σ"}, {"int", "∫"}, {"sum", "Σ"},   {"Gamma", "Γ"},
};

static const sign signs[] = {{"<=", "≤"}, {">=", "≥"}, {"-", "−"}};

static bool is_letter(char c) {
    return isalpha((unsigned char)c) != 0;
}

static bool is_word_char(char c) {
    return is_letter(c) || isdigit((unsigned char)c) || c == '_';
}

/* The length of the word at text if `letters` has it, and its sign in *set; else 0. */
static size_t match_letter(const char *text, const char **set) {
    size_t len = 0;
    while (is_letter(text[len]))
        len++;
    if (is_word_char(text[len]) && text[len] != '_')
        return 0;
    for (size_t i = 0; i < sizeof letters / sizeof *letters; i++)
        if (strlen(letters[i].plain) == len && !strncmp(text, letters[i].plain, len)) {
            *set = letters[i].set;
            return len;
        }
    return 0;
}

/* The same for `signs`, and for ^2 and ^3 unless the exponent goes on. */
static size_t match_sign(const char *text, const char **set) {
    if (text[0] == '^' && (text[1] == '2' || text[1] == '3') && !is_word_char(text[2]) && text[2] != '.') {
        *set = text[1] == '2' ? "²" : "³";
        return 2;
    }
    for (size_t i = 0; i < sizeof signs / sizeof *signs; i++)
        if (!strncmp(text, signs[i].plain, strlen(signs[i].plain))) {
            *set = signs[i].set;
            return strlen(signs[i].plain);
        }
    return 0;
}

void typeset(const char *plain, char *buf, size_t size) {
    size_t used = 0;
    bool in_word = false;
    while (*plain) {
        const char *set = plain;
        size_t len = in_word ? 0 : match_letter(plain, &set);
        if (len == 0)
            len = match_sign(plain, &set);
        const size_t taken = len ? len : 1, put = len ? strlen(set) : taken;
        if (used + put >= size) /* unreached: callers have room for all of it */
            break;
        memcpy(buf + used, set, put);
        used += put;
        in_word = is_word_char(plain[taken - 1]);
        plain += taken;
    }
    buf[used] = 0;
}
