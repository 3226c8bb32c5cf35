/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Looking words up in tables of names, and guessing what was meant. Touches nothing. */
#ifndef TEXT_WORDS_H
#define TEXT_WORDS_H

#include <stdbool.h>
#include <stddef.h>

/* Finds a word in a table of names, name(0), name(1), ... until NULL. The index over them is made at the
 * first search; start it as {.name = name}. */
enum { WORDS = 128 }; /* most names of a table */
typedef struct word_index {
    const char *(*name)(size_t i);
    bool made;
    unsigned char first[64], next[WORDS]; /* chains of rows + 1, ended by 0 */
} word_index;
bool word_find(word_index *x, const char *word, size_t len, size_t *row);

/* The same of few names, without an index. */
bool word_among(const char *(*name)(size_t i), const char *word, size_t len, size_t *row);

/* Greek letters as names here write them: mu for its sign, d for a delta. */
enum { PLAIN_WORD = 64 };
void plain_letters(const char *word, size_t len, char plain[PLAIN_WORD]);

/* Nearest of count names to what was typed, within a third of its length, or NULL. name(i) lists them. */
const char *suggest(const char *typed, const char *(*name)(size_t i));

/* What a row takes, as who reads it is told: without the marks of := and +=, and the most of a number. */
void takes_text(const char *takes, char *buf, size_t size);

bool same_but_case(const char *a, const char *b);
/* One letter changed, missing or too many, or two swapped. */
bool one_letter_apart(const char *a, const char *b);

#endif
