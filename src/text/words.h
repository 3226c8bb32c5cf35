/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Looking words up in tables of names, guessing what was meant, and putting texts together. Touches nothing.
 */
#ifndef TEXT_WORDS_H
#define TEXT_WORDS_H

#include <stdbool.h>
#include <stddef.h>

/* A function whose `text`-th argument is a format, for which those from `first` on are checked. */
#if defined(__GNUC__)
#define LIKE_PRINTF(text, first) __attribute__((format(printf, text, first)))
#else
#define LIKE_PRINTF(text, first)
#endif

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

/* Adds to the text in buf, as far as there is room. False: not all of it. */
LIKE_PRINTF(3, 4)
bool text_add(char *buf, size_t size, const char *format, ...);
/* Adds a word to a list, behind what parts it from the others; starts with an empty buf. */
void list_word(char *buf, size_t size, const char *between, const char *word);

bool same_but_case(const char *a, const char *b);
/* One letter changed, missing or too many, or two swapped. */
bool one_letter_apart(const char *a, const char *b);

#endif
